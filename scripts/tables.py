#!/usr/bin/python3
"""Prints the SSRM paper's Tables 1 to 3, as measured here, beside the paper's own, from the CSV of an `ssrm` run."""

import argparse
import csv
import sys
from collections import defaultdict
from pathlib import Path

PAPER = Path(__file__).resolve().parent.parent / "results" / "paper"
# Which of the paper's scenes a scene stands for.
COUNTERPART = {"sphere": "Sphere", "atrium": "Sponza", "sponza": "Sponza", "street": "Bistro", "bistro": "Bistro"}
Row = dict[str, str]


def read(path: Path) -> list[Row]:
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def mean(rows: list[Row], column: str) -> float | None:
    values = [float(row[column]) for row in rows if row.get(column)]
    return sum(values) / len(values) if values else None


def text(value: float | None, digits: int) -> str:
    return "" if value is None else f"{value:.{digits}f}"


def show(title: str, head: list[str], lines: list[list[str]]) -> None:
    widths = [max(len(line[i]) for line in [head, *lines]) for i in range(len(head))]
    print(f"\n{title}")
    for line in [head, ["-" * w for w in widths], *lines]:
        print("  ".join(cell.ljust(w) if i == 0 else cell.rjust(w) for i, (cell, w) in enumerate(zip(line, widths))).rstrip())


class Measured:
    """The rows of one run, averaged over cameras for each scene and resolution."""

    def __init__(self, rows: list[Row]):
        self.cells: dict[tuple[str, int, int], list[Row]] = defaultdict(list)
        for row in rows:
            self.cells[row["scene"], int(row["width"]), int(row["height"])].append(row)
        self.scenes = list(dict.fromkeys(scene for scene, _, _ in self.cells))
        self.sizes = sorted({(w, h) for _, w, h in self.cells}, key=lambda s: s[0] * s[1])
        self.heads = [f"{w}x{h}" for w, h in self.sizes]

    def line(self, scene: str, column: str, digits: int) -> list[str]:
        return [text(mean(self.cells.get((scene, w, h), []), column), digits) for w, h in self.sizes]


class Paper:
    """The paper's numbers by scene and resolution."""

    def __init__(self) -> None:
        self.table1 = {(int(r["width"]), int(r["height"])): r for r in read(PAPER / "ssrm_table1.csv")}
        self.table2 = {(r["scene"], int(r["width"]), int(r["height"])): r["t_hw_ms"] for r in read(PAPER / "ssrm_table2.csv")}
        self.table3 = {(r["scene"], int(r["width"]), int(r["height"])): r["speedup_sequential"]
                       for r in read(PAPER / "ssrm_table3.csv")}

    def line(self, table: dict, scene: str, sizes: list[tuple[int, int]]) -> list[str]:
        return [table.get((COUNTERPART.get(scene, ""), w, h), "") for w, h in sizes]


def table1(m: Measured, paper: Paper) -> None:
    lines = [[scene, *m.line(scene, "t_ss_ms", 3)] for scene in m.scenes]
    for label, column in (("paper (GPU)", "t_ss_ms"), ("  implied by its Table 3", "t_ss_implied_ms")):
        lines.append([label, *(paper.table1.get(size, {}).get(column, "") for size in m.sizes)])
    show("Table 1. SSRM time, ms", ["scene", *m.heads], lines)


def paired(title: str, m: Measured, rows: list[tuple[str, str, int]], paper: Paper, table: dict) -> None:
    lines = []
    for scene in m.scenes:
        lines += [[f"{scene}: {label}", *m.line(scene, column, digits)] for label, column, digits in rows]
        lines.append([f"  paper, {COUNTERPART.get(scene, '-')} (GPU)", *paper.line(table, scene, m.sizes)])
    show(title, ["scene", *m.heads], lines)


def accuracy(m: Measured) -> None:
    columns = [("alpha", 3), ("alpha_max", 3), ("precision", 4), ("recall", 3), ("miss_fraction", 3), ("steps_per_ray", 1),
               ("unresolved_cost_ratio", 2), ("break_even_alpha", 2)]
    lines = [[f"{scene} {w}x{h}", *(text(mean(m.cells[scene, w, h], c), d) for c, d in columns)]
             for scene in m.scenes for w, h in m.sizes if (scene, w, h) in m.cells]
    show("What the tables rest on (the paper: mean alpha 0.31)", ["scene", *(c for c, _ in columns)], lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table", type=Path, help="CSV written by `hybray run` of an ssrm config")
    path = parser.parse_args().table
    try:
        rows = read(path)
    except OSError as error:
        print(f"tables: {path}: {error.strerror}", file=sys.stderr)
        return 2
    if not rows or "t_ss_ms" not in rows[0]:
        print(f"tables: {path}: not a table of the experiment ssrm with at least one row", file=sys.stderr)
        return 2
    m, paper = Measured(rows), Paper()
    cameras = len({(row["scene"], row["camera"]) for row in rows})
    print(f"{len(rows)} points, {cameras} cameras of {len(m.scenes)} scenes, {rows[0]['threads']} threads; "
          "means over cameras. Speedups compare within one row; times of other machines do not compare.")
    table1(m, paper)
    paired("Table 2. General tracer on all rays, ms", m,
           [("fastest mode", "t_hw_ms", 2), ("one ray at a time", "t_hw_single_ms", 2)], paper, paper.table2)
    paired("Table 3. Speedup of the hybrid over the general tracer", m,
           [("estimate, sequential (paper's formula)", "speedup_sequential", 3),
            ("estimate, partitioned (perfect predictor)", "speedup_partitioned", 3),
            ("measured against the fastest mode", "speedup_measured", 3),
            ("measured, single rays on both sides", "speedup_measured_vs_single", 3)], paper, paper.table3)
    accuracy(m)
    return 0


if __name__ == "__main__":
    sys.exit(main())
