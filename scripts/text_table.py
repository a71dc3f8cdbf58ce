"""A small table of strings, and how it looks as plain text, Markdown and LaTeX."""

import re
import textwrap
from dataclasses import dataclass

LATEX = {"\\": r"\textbackslash{}", "&": r"\&", "%": r"\%", "$": r"\$", "#": r"\#", "_": r"\_", "{": r"\{", "}": r"\}",
         "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "×": r"$\times$", "<": r"\textless{}", ">": r"\textgreater{}"}


@dataclass(frozen=True)
class TextTable:
    title: str
    head: list[str]
    lines: list[list[str]]
    label: str = ""  # for \ref in LaTeX

    def text(self) -> str:
        widths = [max(len(line[i]) for line in [self.head, *self.lines]) for i in range(len(self.head))]
        shown = [self.title]
        for line in [self.head, ["-" * w for w in widths], *self.lines]:
            cells = (cell.ljust(w) if i == 0 else cell.rjust(w) for i, (cell, w) in enumerate(zip(line, widths)))
            shown.append("  ".join(cells).rstrip())
        return "\n".join(shown) + "\n"

    def markdown(self) -> str:
        rule = "|" + "---|" + "---:|" * (len(self.head) - 1)
        return "\n".join([bars(self.head), rule, *(bars(line) for line in self.lines)]) + "\n"

    def latex(self) -> str:
        """A table environment, shrunk where it is wider than the text; needs \\usepackage{booktabs,graphicx}."""
        caption = escaped(re.sub(r"^Table \d+\. ", "", self.title))  # LaTeX counts by itself
        parts = [r"\begin{table}", r"\centering", rf"\caption{{{caption}}}"]
        parts += [rf"\label{{{self.label}}}"] if self.label else []
        parts += [r"\resizebox{\ifdim\width>\linewidth\linewidth\else\width\fi}{!}{%"]
        parts += [rf"\begin{{tabular}}{{l{'r' * (len(self.head) - 1)}}}", r"\toprule"]
        parts += [" & ".join([escaped(self.head[0]), *map(stacked, self.head[1:])]) + r" \\", r"\midrule"]
        for before, line in zip([self.head, *self.lines], self.lines):
            parts += [r"\addlinespace"] if belongs(before) and not belongs(line) else []
            parts.append(ampersands(line))
        return "\n".join([*parts, r"\bottomrule", r"\end{tabular}}", r"\end{table}"]) + "\n"


def bars(cells: list[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def escaped(text: str) -> str:
    return "".join(LATEX.get(c, c) for c in text)


def stacked(head: str) -> str:
    """The name of a column, in several lines where it is long."""
    lines = [escaped(line) for line in textwrap.wrap(head.replace("_", " "), 10, break_long_words=False)]
    return lines[0] if len(lines) == 1 else r"\shortstack[r]{" + r" \\ ".join(lines) + "}"


def belongs(cells: list[str]) -> bool:
    """Whether leading blanks set a line off as belonging to the one above."""
    return cells[0].startswith("  ")


def ampersands(cells: list[str]) -> str:
    return (r"\quad " if belongs(cells) else "") + " & ".join(escaped(cell.strip()) for cell in cells) + r" \\"
