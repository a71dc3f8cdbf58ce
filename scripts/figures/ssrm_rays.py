"""Figures of kinds of rays and of seeded cameras: when the hybrid pays, and how alpha and speedups are distributed."""

from pathlib import Path

from csv_table import Row, number, read_table
from figures import style
from figures.results import Results, Skip
from figures.ssrm import scenes_of
from figures.ticks import plain_ticks
from fitting import mean_interval
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from tables import PAPER

KIND_MARKERS = {"mirror": "o", "rough": "s", "ambient": "^", "shadow": "D"}
BOUNCES_MARKER = "P"
MOST_MODES = 4


def quantile(values: list[float], q: float) -> float:
    """By linear interpolation."""
    ordered = sorted(values)
    place = q * (len(ordered) - 1)
    low = int(place)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (place - low) * (ordered[high] - ordered[low])


def marker_of(row: Row) -> str:
    return BOUNCES_MARKER if row["mirror_depth"] not in ("", "1") else KIND_MARKERS.get(row["ray_kind"], "X")


def break_even_lines(axis: Axes, costs: list[float]) -> None:
    """T_SS / T_HW below which each formula says that the hybrid pays: alpha, 1, and 1 - (1 - alpha) c."""
    alphas = [i / 200 for i in range(1, 201)]  # many points, since the axis is logarithmic

    def with_cost(c: float) -> list[float]:
        return [max(1e-3, 1 - (1 - a) * c) for a in alphas]

    axis.plot(alphas, alphas, color="black", linewidth=1)
    axis.plot([0, 1], [1, 1], color="black", linewidth=1, linestyle=":")
    if costs:
        axis.fill_between(alphas, with_cost(quantile(costs, 0.9)), with_cost(quantile(costs, 0.1)), color="0.5", alpha=0.2, linewidth=0)
        axis.plot(alphas, with_cost(quantile(costs, 0.5)), color="0.3", linewidth=1, linestyle="--")


def draw_break_even(results: Results, folder: Path) -> list[Path]:
    result = results.get("ssrm_breakeven")
    needed = ("scene", "camera", "ray_kind", "mirror_depth", "tracer_mode", "alpha", "break_even_alpha", "unresolved_cost_ratio",
              "pays_measured")
    rows = [r for r in result.table.need(*needed).rows if number(r, "break_even_alpha") is not None]
    if not rows:
        raise Skip(f"{result.table.path} has no times")
    modes = list(dict.fromkeys(r["tracer_mode"] for r in rows))[:MOST_MODES]
    scenes = scenes_of(rows)
    figure, axes = style.panels(1, len(modes), 2.9)
    for axis, mode in zip(axes, modes):
        members = [r for r in rows if r["tracer_mode"] == mode]
        break_even_lines(axis, [c for r in members if (c := number(r, "unresolved_cost_ratio")) is not None])
        for row in members:
            color = style.look(row["scene"], scenes)[0]
            axis.plot(number(row, "alpha"), number(row, "break_even_alpha"), marker=marker_of(row), linestyle="", color=color,
                      markersize=4, markerfacecolor=color if row["pays_measured"] == "yes" else "none", markeredgewidth=0.8)
        axis.set_yscale("log")
        ratios = [number(r, "break_even_alpha") for r in rows]
        bottom, top = min(0.1, *ratios) / 1.2, max(1.5, *ratios) * 1.2
        axis.set(xlim=(0, 0.8), ylim=(bottom, top), xlabel="alpha", ylabel=r"$T_{SS}\,/\,T_{HW}$" if axis is axes[0] else "",
                 title=style.readable(mode))
        plain_ticks(axis.yaxis, [t for t in (0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20) if bottom <= t <= top])
        axis.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    style.letter(axes)
    grey = "0.2"
    shown = dict.fromkeys(marker_of(r) for r in rows)
    names = {m: k for k, m in KIND_MARKERS.items()} | {BOUNCES_MARKER: "mirror, several bounces"}
    style.finish(figure, [
        *(Line2D([], [], color=style.look(s, scenes)[0], marker="o", linestyle="", label=s) for s in scenes),
        *(Line2D([], [], color=grey, marker=m, markerfacecolor="none", linestyle="", label=names.get(m, "other")) for m in shown),
        Line2D([], [], color="black", label="paper's formula: pays below"),
        Line2D([], [], color="black", linestyle=":", label="perfect predictor: pays below"),
        Line2D([], [], color="0.3", linestyle="--", label="with the median measured c (band: 10 to 90 %)")],
        f"{result.name}.csv, a mark is a camera; filled: the measured hybrid pays; {result.machine}")
    return style.save(figure, folder, "ssrm_breakeven")


DISTRIBUTED = (("alpha", "alpha"), ("precision", "precision"), ("speedup_sequential", "speedup, paper's formula"),
               ("speedup_measured_vs_single", "measured speedup, one ray at a time"), ("speedup_measured", "measured speedup, fastest mode"))


def distribution_text(rows: list[Row], scenes: list[str]) -> str:
    """Mean with the interval of the mean, and quartiles, as a Markdown table."""
    lines = ["| scene | quantity | cameras | mean | interval of the mean | least | quartiles | greatest |", "|---|---|---|---|---|---|---|---|"]
    for scene in scenes:
        for column, title in DISTRIBUTED:
            values = [v for r in rows if r["scene"] == scene and (v := number(r, column)) is not None]
            if not values:
                continue
            mean, low, high = mean_interval(values)
            quartiles = ", ".join(f"{quantile(values, q):.4f}" for q in (0.25, 0.5, 0.75))
            lines.append(f"| {scene} | {title} | {len(values)} | {mean:.4f} | {low:.4f} to {high:.4f} | {min(values):.4f} | "
                         f"{quartiles} | {max(values):.4f} |")
    return "\n".join(lines) + "\n"


def draw_distribution(results: Results, folder: Path) -> list[Path]:
    result = results.get("ssrm_distribution")
    rows = result.table.need("scene", "camera", "alpha", "precision").rows
    rows = [r for r in rows if number(r, "alpha") is not None]
    if not rows:
        raise Skip(f"{result.table.path} has no alpha")
    scenes = scenes_of(rows)
    columns = [(c, t) for c, t in DISTRIBUTED if any(number(r, c) is not None for r in rows)]
    figure, axes = style.panels(len(columns), 1, 0.27 * len(scenes) + 0.45)
    paper = number(read_table(PAPER / "ssrm_table3.csv").need("alpha").rows[0], "alpha")
    for axis, (column, title) in zip(axes, columns):
        for place, scene in enumerate(scenes):
            values = sorted(v for r in rows if r["scene"] == scene and (v := number(r, column)) is not None)
            if not values:
                continue
            color = style.look(scene, scenes)[0]
            mean, low, high = mean_interval(values)
            axis.plot(values, [place + 0.18] * len(values), linestyle="", marker="|", color=color, markersize=5, markeredgewidth=0.5)
            axis.plot([quantile(values, 0.25), quantile(values, 0.75)], [place - 0.12] * 2, color=color, linewidth=4, alpha=0.35,
                      solid_capstyle="butt")
            axis.errorbar([mean], [place - 0.12], xerr=[[mean - low], [high - mean]], color=color, marker="o", markersize=3)
        axis.set_yticks(range(len(scenes)), scenes)
        axis.set(ylim=(len(scenes) - 0.4, -0.6), title=title)
        axis.grid(axis="y", visible=False)
        if column == "alpha":
            axis.axvline(paper, color=style.PAPER, linestyle="--", linewidth=1)
            axis.set_xlim(0.0, 1.0)
        elif column.startswith("speedup"):
            axis.axvline(1.0, color="black", linewidth=0.7)
    style.letter(axes)
    grey = "0.2"
    style.finish(figure, [
        Line2D([], [], color=grey, marker="|", linestyle="", label="a seeded camera"),
        Patch(color=grey, alpha=0.35, label="middle half"),
        Line2D([], [], color=grey, marker="o", label="mean, 95 % interval (Student's t)"),
        Line2D([], [], color=style.PAPER, linestyle="--", label=f"paper's mean alpha, {paper:g}")],
        f"{result.name}.csv; {result.machine}")
    written = style.save(figure, folder, "ssrm_distribution")
    return [*written, style.save_text(distribution_text(rows, scenes), folder, "ssrm_distribution.txt")]
