#!/usr/bin/python3
"""Fits the cost of caustics per light, a visible + b invisible + c, to the CSV of a `caustics` run, and prints it
beside the paper's; with it time and error against rays per texel (Fig. 7) and mirror depth (Fig. 8), where they are swept."""

import argparse
import csv
import math
import random
import sys
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path

PAPER_A, PAPER_B = 1.3, 1.05  # ms for each light in view and each out of view (512 x 512 map, depth 1, 1 ray per texel)
RESAMPLES, SEED = 2000, 1
# Standard error of the median of n normal times is 1.2533 sigma / sqrt(n), and their interquartile range 1.3490 sigma.
QUARTILES_TO_MEDIAN = 1.2533 / 1.3490
NEEDED = ("total_ms", "total_spread_ms", "repeats", "lights_visible", "lights_invisible")
# Parameters that tell two rows of one table apart.
KEYS = ("scene", "camera", "width", "height", "caustics", "map_resolution", "rays_per_texel", "mirror_depth", "lights_visible",
        "lights_invisible", "emission", "first_surface", "visibility", "mixed", "gather_radius", "camera_paths",
        "roulette_threshold", "filter", "threads")
# What stands beside a swept parameter, where the table has it.
SHOWN = ("total_ms", "relmse", "reference_relmse", "energy_ratio", "rmse", "median_relative_error", "closed_form_error_fraction",
          "closed_form_z", "truncated_fraction", "efficiency")
LIGHTS = {"lights_visible", "lights_invisible"}
Row = dict[str, str]
Vector = list[float]


def number(row: Row, column: str) -> float | None:
    try:
        value = float(row.get(column) or "nan")
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def solve(matrix: list[Vector], right: Vector) -> Vector | None:
    """Gaussian elimination with pivoting; None where the matrix is singular to rounding."""
    n = len(right)
    rows = [[*matrix[i], right[i]] for i in range(n)]
    scale = max((abs(v) for row in matrix for v in row), default=0.0)
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        if abs(rows[i][i]) <= 1e-11 * scale:
            return None
        for k in range(i + 1, n):
            factor = rows[k][i] / rows[i][i]
            rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][j] * x[j] for j in range(i + 1, n))) / rows[i][i]
    return x


def least_squares(terms: list[Vector], values: Vector, weights: Vector) -> Vector | None:
    n = len(terms[0])
    normal = [[sum(w * t[i] * t[j] for t, w in zip(terms, weights)) for j in range(n)] for i in range(n)]
    return solve(normal, [sum(w * t[i] * v for t, v, w in zip(terms, values, weights)) for i in range(n)])


def squares(terms: list[Vector], values: Vector, fit: Vector) -> float:
    return sum((v - sum(f * t for f, t in zip(fit, term))) ** 2 for term, v in zip(terms, values))


def quantile(values: Vector, q: float) -> float:
    ordered, at = sorted(values), q * (len(values) - 1)
    below = math.floor(at)
    above = min(below + 1, len(ordered) - 1)
    return ordered[below] + (at - below) * (ordered[above] - ordered[below])


def f_tail(f: float, d1: int, d2: int) -> float:
    """P(F > f) of Fisher's F with d1 and d2 degrees of freedom: the regularised incomplete beta function I_x(d2/2, d1/2)
    at x = d2 / (d2 + d1 f), by its integral over t = x s^(2/d2), which has no singularity."""
    if f <= 0.0:
        return 1.0
    a, b, x = d2 / 2.0, d1 / 2.0, d2 / (d2 + d1 * f)
    steps = 2000
    # Integral of t^(a-1) (1-t)^(b-1) over [0, x] = x^a / a * integral over s in [0, 1] of (1 - x s^(1/a))^(b-1).
    total = sum((1.0 - x * ((i + 0.5) / steps) ** (1.0 / a)) ** (b - 1.0) for i in range(steps)) / steps
    log_beta = math.lgamma(a) + math.lgamma(b) - math.lgamma(a + b)
    return min(1.0, math.exp(a * math.log(x) - math.log(a) - log_beta) * total)


def markdown(head: list[str], lines: list[list[str]]) -> None:
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" + "---:|" * (len(head) - 1))
    for line in lines:
        print("| " + " | ".join(line) + " |")


def show(value: float | None, digits: int = 3) -> str:
    return "" if value is None else f"{value:.{digits}f}"


def significant(value: float | None) -> str:
    return "" if value is None else f"{value:.3g}"


def groups_of(rows: list[Row], varied: set[str]) -> dict[tuple[str, ...], list[Row]]:
    """Rows that differ in the varied parameters alone."""
    keys = [k for k in KEYS if k in rows[0] and k not in varied]
    groups: dict[tuple[str, ...], list[Row]] = defaultdict(list)
    for row in rows:
        groups[tuple(f"{k}={row[k]}" for k in keys)].append(row)
    constant = set.intersection(*(set(g) for g in groups))
    return {tuple(part for part in g if part not in constant): r for g, r in groups.items()}


def title(text: str, group: tuple[str, ...]) -> None:
    print(f"\n### {text}" + (f" ({', '.join(group)})" if group else "") + "\n")


def fit_lights(rows: list[Row]) -> bool:
    """Prints the fit of one group; False where the numbers of lights do not determine it."""
    usable = [r for r in rows if all(number(r, c) is not None for c in ("total_ms", "lights_visible", "lights_invisible"))]
    points = [(number(r, "lights_visible"), number(r, "lights_invisible"), number(r, "total_ms")) for r in usable]
    terms, values = [[v, i, 1.0] for v, i, _ in points], [t for _, _, t in points]
    fit = least_squares(terms, values, [1.0] * len(points)) if len(points) > 3 else None
    if fit is None:
        return False
    a, b, c = fit
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
        return False

    def interval(pick: Callable[[Vector], float]) -> str:
        values_of = [pick(sample) for sample in drawn]
        return f"{quantile(values_of, 0.025):.3f} to {quantile(values_of, 0.975):.3f}"

    markdown(["cost of a light", "here", "95 % interval", "paper (RTX 2060 mobile)"],
             [["a: visible, ms", show(a), interval(lambda s: s[0]), show(PAPER_A, 2)],
              ["b: invisible, ms", show(b), interval(lambda s: s[1]), show(PAPER_B, 2)],
              ["c: without lights, ms", show(c), interval(lambda s: s[2]), ""],
              ["b / a", show(b / a), interval(lambda s: s[1] / s[0]), show(PAPER_B / PAPER_A, 2)]])

    linear = squares(terms, values, fit)
    freedom = len(points) - 3
    print(f"\n{len(points)} points. Residual of the linear model: {math.sqrt(linear / freedom):.3f} ms RMS, "
          f"{100.0 * math.sqrt(linear / len(points)) / (sum(values) / len(values)):.1f} % of the mean time; largest "
          f"{max(abs(v - sum(f * t for f, t in zip(fit, term))) for term, v in zip(terms, values)):.3f} ms.")
    errors = [QUARTILES_TO_MEDIAN * number(r, "total_spread_ms") / math.sqrt(number(r, "repeats")) for r in usable
              if number(r, "total_spread_ms") is not None and number(r, "repeats")]
    if errors:
        print(f"Expected from the spread of the repeats: {math.sqrt(sum(e * e for e in errors) / len(errors)):.3f} ms RMS "
              "(standard error of a median of normal times).")
    curvature(points, values, linear)
    return True


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
        markdown([column, *shown, *([] if first is None else ["time / first"])], lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table", type=Path, help="CSV written by `hybray run` of a caustics config")
    path = parser.parse_args().table
    try:
        with path.open(newline="") as file:
            rows = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError) as error:
        print(f"caustics_fit: {path}: {getattr(error, 'strerror', None) or error}", file=sys.stderr)
        return 2
    missing = [c for c in NEEDED if not rows or c not in rows[0]]
    if missing:
        print(f"caustics_fit: {path}: not a table of the experiment caustics with at least one row "
              f"(column {missing[0]} is missing)", file=sys.stderr)
        return 2
    rows = [r for r in rows if r.get("caustics") != "false"]  # of the main view alone
    if not rows:
        print(f"caustics_fit: {path}: no point has caustics", file=sys.stderr)
        return 2
    print(f"{len(rows)} points. Times of other machines do not compare; the ratio b / a does.")
    fitted = False
    for group, members in groups_of(rows, LIGHTS).items():
        if len({(r["lights_visible"], r["lights_invisible"]) for r in members}) < 4:
            continue
        title("Cost of lights", group)
        if not fit_lights(members):
            print("The numbers of visible and invisible lights do not determine a, b and c: vary both.")
        fitted = True
    against(rows, "rays_per_texel", "Rays per texel (the paper's Fig. 7)")
    against(rows, "mirror_depth", "Specular depth (the paper's Fig. 8)")
    if not fitted:
        print("\nNo fit of the lights: it needs at least four points that differ in their numbers alone.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
