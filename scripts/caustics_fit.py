#!/usr/bin/python3
"""Fits the cost of caustics per light, a visible + b invisible + c, to the CSV of a `caustics` run, and prints it
beside the paper's; with it time and error against rays per texel (Fig. 7) and mirror depth (Fig. 8), where they are swept."""

import argparse
import math
import random
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from csv_table import Row, Table, number, read_table
from fitting import Vector, f_tail, least_squares, quantile, squares
from grouping import Group, groups_of
from inputs import InputError
from text_table import TextTable

PAPER = Path(__file__).resolve().parent.parent / "results" / "paper" / "caustics.csv"
RESAMPLES, SEED = 2000, 1
# Standard error of the median of n normal times is 1.2533 sigma / sqrt(n), and their interquartile range 1.3490 sigma.
QUARTILES_TO_MEDIAN = 1.2533 / 1.3490
NEEDED = ("total_ms", "total_spread_ms", "repeats", "lights_visible", "lights_invisible")
# What stands beside a swept parameter, where the table has it.
SHOWN = ("total_ms", "relmse", "reference_relmse", "energy_ratio", "rmse", "median_relative_error", "closed_form_error_fraction",
          "closed_form_z", "truncated_fraction", "efficiency")
LIGHTS = {"lights_visible", "lights_invisible"}


def show(value: float | None, digits: int = 3) -> str:
    return "" if value is None else f"{value:.{digits}f}"


def significant(value: float | None) -> str:
    return "" if value is None else f"{value:.3g}"


def title(text: str, group: Group) -> None:
    print(f"\n### {text}" + (f" ({', '.join(f'{k}={v}' for k, v in group)})" if group else "") + "\n")


@dataclass(frozen=True)
class LightCost:
    """Least squares of total_ms = a visible + b invisible + c, ms, over the points of one group."""

    rows: list[Row]
    points: list[tuple[float, float, float]]  # visible, invisible, ms; of each row
    fit: tuple[float, float, float]
    samples: list[Vector]  # fits of resampled points
    noise: float | None  # what the spread of the repeats leads to expect of a residual, ms RMS

    def interval(self, pick: Callable[[Vector], float]) -> tuple[float, float]:
        values = [pick(sample) for sample in self.samples]
        return quantile(values, 0.025), quantile(values, 0.975)

    def residuals(self) -> Vector:
        a, b, c = self.fit
        return [t - (a * v + b * i + c) for v, i, t in self.points]


def light_cost(rows: list[Row]) -> LightCost | None:
    """The fit of one group; None where the numbers of lights do not determine it, or no time is above zero."""
    usable = [r for r in rows if all(number(r, c) is not None for c in ("total_ms", "lights_visible", "lights_invisible"))]
    points = [(number(r, "lights_visible"), number(r, "lights_invisible"), number(r, "total_ms")) for r in usable]
    terms, values = [[v, i, 1.0] for v, i, _ in points], [t for _, _, t in points]
    fit = least_squares(terms, values, [1.0] * len(points)) if len(points) > 3 and any(values) else None
    if fit is None:
        return None
    # Bootstrap over points, by resampled counts as weights; draws that do not determine the fit are drawn again.
    generator, drawn = random.Random(SEED), []
    for _ in range(20 * RESAMPLES):
        counts = [0.0] * len(points)
        for _ in points:
            counts[generator.randrange(len(points))] += 1.0
        sample = least_squares(terms, values, counts)
        if sample is not None:
            drawn.append(sample)
            if len(drawn) == RESAMPLES:
                break
    if len(drawn) < RESAMPLES:
        return None
    errors = [QUARTILES_TO_MEDIAN * number(r, "total_spread_ms") / math.sqrt(number(r, "repeats")) for r in usable
              if number(r, "total_spread_ms") is not None and number(r, "repeats")]
    noise = math.sqrt(sum(e * e for e in errors) / len(errors)) if errors else None
    return LightCost(usable, points, (fit[0], fit[1], fit[2]), drawn, noise)


def paper_numbers() -> dict[str, float]:
    """What the caustics paper prints, by quantity."""
    return {row["quantity"]: number(row, "value") for row in read_table(PAPER).need("quantity", "value").rows}


def light_groups(rows: list[Row]) -> dict[Group, list[Row]]:
    """Groups of rows that differ in their numbers of lights alone, in at least four ways."""
    return {group: members for group, members in groups_of(rows, LIGHTS).items()
            if len({(r["lights_visible"], r["lights_invisible"]) for r in members}) >= 4}


def print_lights(cost: LightCost) -> None:
    paper, (a, b, c) = paper_numbers(), cost.fit
    paper_a, paper_b = paper["light_visible_ms"], paper["light_invisible_ms"]

    def interval(pick: Callable[[Vector], float]) -> str:
        return "{:.3f} to {:.3f}".format(*cost.interval(pick))

    lines = [["a: visible, ms", show(a), interval(lambda s: s[0]), show(paper_a, 2)],
             ["b: invisible, ms", show(b), interval(lambda s: s[1]), show(paper_b, 2)],
             ["c: without lights, ms", show(c), interval(lambda s: s[2]), ""],
             ["b / a", show(b / a), interval(lambda s: s[1] / s[0]), show(paper_b / paper_a, 2)]]
    print(TextTable("", ["cost of a light", "here", "95 % interval", "paper (RTX 2060 mobile)"], lines).markdown(), end="")

    values, residuals = [t for _, _, t in cost.points], cost.residuals()
    linear = sum(r * r for r in residuals)
    print(f"\n{len(values)} points. Residual of the linear model: {math.sqrt(linear / (len(values) - 3)):.3f} ms RMS, "
          f"{100.0 * math.sqrt(linear / len(values)) / (sum(values) / len(values)):.1f} % of the mean time; largest "
          f"{max(abs(r) for r in residuals):.3f} ms.")
    if cost.noise is not None:
        print(f"Expected from the spread of the repeats: {cost.noise:.3f} ms RMS (standard error of a median of normal times).")
    curvature(cost.points, values, linear)


def curvature(points: list[tuple[float, float, float]], values: Vector, linear: float) -> None:
    """Adds v^2, v i and i^2, as far as the points determine them, and tests them together by Fisher's F."""
    extra = [("visible²", lambda v, i: v * v), ("visible·invisible", lambda v, i: v * i), ("invisible²", lambda v, i: i * i)]
    kept: list = []
    terms = [[v, i, 1.0] for v, i, _ in points]
    fit: Vector | None = None
    for name, term in extra:
        longer = [[*t, term(v, i)] for t, (v, i, _) in zip(terms, points)]
        attempt = least_squares(longer, values, [1.0] * len(values)) if len(values) > len(longer[0]) else None
        if attempt is not None:
            terms, fit = longer, attempt
            kept.append(name)
    if fit is None:
        print("Linearity is not tested: too few different numbers of lights for quadratic terms.")
        return
    quadratic, freedom = squares(terms, values, fit), len(values) - len(fit)
    f = (linear - quadratic) / len(kept) / (quadratic / freedom) if quadratic > 0.0 else math.inf
    p = f_tail(f, len(kept), freedom) if math.isfinite(f) else 0.0
    bend = max(abs(sum(q * t for q, t in zip(fit[3:], term[3:]))) for term in terms) / max(values)
    verdict = "matter" if p < 0.05 else "do not matter"
    coefficients = ", ".join(f"{name} {q:+.4f}" for name, q in zip(kept, fit[3:]))
    print(f"Quadratic terms ({coefficients} ms) {verdict}: F({len(kept)}, {freedom}) = {f:.2f}, p = {p:.3f}; "
          f"at most {100.0 * bend:.1f} % of the longest time.")


def against(rows: list[Row], column: str, text: str) -> None:
    """Error and time against one swept parameter."""
    for group, members in groups_of(rows, {column}).items():
        ordered = sorted((r for r in members if number(r, column) is not None), key=lambda r: number(r, column))
        if len({number(r, column) for r in ordered}) < 2:
            continue
        shown = [c for c in SHOWN if any(number(r, c) is not None for r in ordered)]
        title(text, group)
        first = number(ordered[0], "total_ms")
        lines = []
        for row in ordered:
            error, own, time = number(row, "relmse"), number(row, "reference_relmse"), number(row, "total_ms")
            floor = " (at the floor)" if error is not None and own is not None and error < 3.0 * own else ""
            cells = [significant(number(row, c)) + (floor if c == "relmse" else "") for c in shown]
            lines.append([row[column], *cells, significant(time / first if time is not None and first else None)])
        if first is None:
            lines = [line[:-1] for line in lines]
        print(TextTable("", [column, *shown, *([] if first is None else ["time / first"])], lines).markdown(), end="")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table", type=Path, help="CSV written by `hybray run` of a caustics config")
    try:
        return report(read_table(parser.parse_args().table).need(*NEEDED))
    except InputError as error:
        print(f"caustics_fit: {error}", file=sys.stderr)
        return 2


def report(table: Table) -> int:
    rows = [r for r in table.rows if r.get("caustics") != "false"]  # of the main view alone
    if not rows:
        raise InputError(f"{table.path}: no point has caustics")
    print(f"{len(rows)} points. Times of other machines do not compare; the ratio b / a does.")
    groups = light_groups(rows)
    for group, members in groups.items():
        title("Cost of lights", group)
        cost = light_cost(members)
        if cost is None:
            print("The numbers of visible and invisible lights do not determine a, b and c: vary both.")
        else:
            print_lights(cost)
    against(rows, "rays_per_texel", "Rays per texel (the paper's Fig. 7)")
    against(rows, "mirror_depth", "Specular depth (the paper's Fig. 8)")
    if not groups:
        print("\nNo fit of the lights: it needs at least four points that differ in their numbers alone.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
