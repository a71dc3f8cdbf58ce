"""A small table of strings, and how it looks as plain text, Markdown and LaTeX."""

import re
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
        """A table environment; needs \\usepackage{booktabs}."""
        caption = escaped(re.sub(r"^Table \d+\. ", "", self.title))  # LaTeX counts by itself
        parts = [r"\begin{table}", r"\centering", rf"\caption{{{caption}}}"]
        parts += [rf"\label{{{self.label}}}"] if self.label else []
        parts += [rf"\begin{{tabular}}{{l{'r' * (len(self.head) - 1)}}}", r"\toprule", ampersands(self.head), r"\midrule"]
        parts += [ampersands(line) for line in self.lines]
        return "\n".join([*parts, r"\bottomrule", r"\end{tabular}", r"\end{table}"]) + "\n"


def bars(cells: list[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def escaped(text: str) -> str:
    return "".join(LATEX.get(c, c) for c in text)


def ampersands(cells: list[str]) -> str:
    # A leading blank sets a line off as belonging to the one above.
    shown = [(r"\quad " if cell.startswith("  ") else "") + escaped(cell.strip()) for cell in cells]
    return " & ".join(shown) + r" \\"
