#!/usr/bin/python3
"""Prints the SSRM paper's Tables 1 to 3, as measured here, beside the paper's own, from the CSV of an `ssrm` run."""

import argparse
import sys
from collections import defaultdict
from pathlib import Path

from csv_table import Row, Table, number, read_table, whole
from grouping import groups_of
from inputs import InputError
from text_table import TextTable

PAPER = Path(__file__).resolve().parent.parent / "results" / "paper"
# Which of the paper's scenes a scene stands for.
COUNTERPART = {"sphere": "Sphere", "atrium": "Sponza", "sponza": "Sponza", "street": "Bistro", "bistro": "Bistro"}
TABLE2 = [("fastest mode", "t_hw_ms", 2), ("one ray at a time", "t_hw_single_ms", 2)]
TABLE3 = [("estimate, sequential (paper's formula)", "speedup_sequential", 3),
          ("estimate, partitioned (perfect predictor)", "speedup_partitioned", 3),
          ("measured against the fastest mode", "speedup_measured", 3),
          ("measured, single rays on both sides", "speedup_measured_vs_single", 3)]
ACCURACY = [("alpha", 3), ("alpha_max", 3), ("precision", 4), ("recall", 3), ("miss_fraction", 3), ("steps_per_ray", 1),
            ("unresolved_cost_ratio", 2), ("break_even_alpha", 2)]
NEEDED = ("scene", "camera", "width", "height", "threads", "t_ss_ms", *(c for _, c, _ in [*TABLE2, *TABLE3]),
          *(c for c, _ in ACCURACY))
Size = tuple[int, int]


def mean(rows: list[Row], column: str) -> float | None:
    values = [v for row in rows if (v := number(row, column)) is not None]
    return sum(values) / len(values) if values else None


def shown(value: float | None, digits: int) -> str:
    return "" if value is None else f"{value:.{digits}f}"


def scene_of(label: str) -> str:
    return label.split(",")[0]


class Measured:
    """The rows of one run, averaged over cameras for each scene and resolution, and for each value of what else the run swept:
    "sponza, lanes"."""

    def __init__(self, table: Table):
        self.cells: dict[tuple[str, int, int], list[Row]] = defaultdict(list)
        for setting, rows in groups_of(table.rows, ("scene", "camera", "width", "height")).items():
            for row in rows:
                label = ", ".join([row["scene"], *(value for _, value in setting)])
                self.cells[label, whole(row, "width"), whole(row, "height")].append(row)
        order = list(dict.fromkeys(row["scene"] for row in table.rows))
        self.scenes = sorted(dict.fromkeys(label for label, _, _ in self.cells), key=lambda label: order.index(scene_of(label)))
        self.scene_count = len(order)
        self.sizes = sorted({(w, h) for _, w, h in self.cells}, key=lambda s: s[0] * s[1])
        self.heads = [f"{w}x{h}" for w, h in self.sizes]
        self.cameras = len({(row["scene"], row["camera"]) for row in table.rows})

    def line(self, scene: str, column: str, digits: int) -> list[str]:
        return [shown(mean(self.cells.get((scene, w, h), []), column), digits) for w, h in self.sizes]


class Paper:
    """The paper's numbers, as it prints them, by scene and resolution."""

    def __init__(self) -> None:
        self.table1 = {self.size(r): r for r in read_table(PAPER / "ssrm_table1.csv").need("t_ss_ms", "t_ss_implied_ms").rows}
        self.table2 = {(r["scene"], *self.size(r)): r["t_hw_ms"] for r in read_table(PAPER / "ssrm_table2.csv").need("t_hw_ms").rows}
        speedups = read_table(PAPER / "ssrm_table3.csv").need("speedup_sequential", "alpha").rows
        self.table3 = {(r["scene"], *self.size(r)): r["speedup_sequential"] for r in speedups}
        self.alpha = speedups[0]["alpha"]  # the average that it states, the same in every row

    @staticmethod
    def size(row: Row) -> Size:
        return whole(row, "width"), whole(row, "height")

    @staticmethod
    def line(table: dict, scene: str, sizes: list[Size]) -> list[str]:
        return [table.get((COUNTERPART.get(scene_of(scene), ""), w, h), "") for w, h in sizes]


def table1(m: Measured, paper: Paper) -> TextTable:
    lines = [[scene, *m.line(scene, "t_ss_ms", 3)] for scene in m.scenes]
    for label, column in (("paper (GPU)", "t_ss_ms"), ("  implied by its Table 3", "t_ss_implied_ms")):
        lines.append([label, *(paper.table1.get(size, {}).get(column, "") for size in m.sizes)])
    return TextTable("Table 1. SSRM time, ms", ["scene", *m.heads], lines, "tab:ssrm-time")


def paired(title: str, label: str, m: Measured, rows: list[tuple[str, str, int]], paper: Paper, table: dict) -> TextTable:
    lines = []
    for scene in m.scenes:
        lines += [[f"{scene}: {text}", *m.line(scene, column, digits)] for text, column, digits in rows]
        lines.append([f"  paper, {COUNTERPART.get(scene_of(scene), '-')} (GPU)", *paper.line(table, scene, m.sizes)])
    return TextTable(title, ["scene", *m.heads], lines, label)


def accuracy(m: Measured, paper: Paper) -> TextTable:
    lines = [[f"{scene} {w}x{h}", *(shown(mean(m.cells[scene, w, h], c), d) for c, d in ACCURACY)]
             for scene in m.scenes for w, h in m.sizes if (scene, w, h) in m.cells]
    return TextTable(f"What the tables rest on (the paper: mean alpha {paper.alpha})", ["scene", *(c for c, _ in ACCURACY)], lines,
                     "tab:ssrm-accuracy")


def text_tables(m: Measured) -> list[TextTable]:
    paper = Paper()
    return [table1(m, paper),
            paired("Table 2. General tracer on all rays, ms", "tab:general-tracer", m, TABLE2, paper, paper.table2),
            paired("Table 3. Speedup of the hybrid over the general tracer", "tab:speedup", m, TABLE3, paper, paper.table3),
            accuracy(m, paper)]


def preface(table: Table, m: Measured) -> str:
    return (f"{len(table.rows)} points, {m.cameras} cameras of {m.scene_count} scenes, {table.rows[0]['threads']} threads; "
            "means over cameras. Speedups compare within one row; times of other machines do not compare.\n")


def as_text(table: Table) -> str:
    m = Measured(table)
    return "\n".join([preface(table, m), *(t.text() for t in text_tables(m))])


def as_latex(table: Table) -> str:
    """Table environments with \\usepackage{booktabs,graphicx}."""
    m = Measured(table)
    return "\n".join([f"% {preface(table, m)}", *(t.latex() for t in text_tables(m))])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table", type=Path, help="CSV written by `hybray run` of an ssrm config")
    parser.add_argument("--latex", action="store_true", help="LaTeX, with booktabs and graphicx, instead of text")
    arguments = parser.parse_args()
    try:
        table = read_table(arguments.table).need(*NEEDED)
        print(as_latex(table) if arguments.latex else as_text(table), end="")
    except InputError as error:
        print(f"tables: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
