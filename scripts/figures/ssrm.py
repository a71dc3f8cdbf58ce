"""Figures of the experiment `ssrm`: its times and speedups beside the paper's, alpha over cameras, precision against recall."""

from collections import defaultdict
from pathlib import Path

from csv_table import Row, number, read_table, whole
from figures import style
from figures.results import Result, Results, Skip
from figures.ticks import log_ticks, plain_ticks
from fitting import mean_interval
from grouping import groups_of
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from tables import NEEDED, PAPER, as_latex, as_text

TABLES = ("ssrm_tables", "quickstart")  # the full one, or else the quick one
PAPER_LABEL = "paper (RTX 2080 Super)"
PAPER_MARKERS = {"Sphere": "o", "Sponza": "s", "Bistro": "D"}
PREFERRED = (1920, 1080)
MOST_NAMED_CAMERAS = 45  # more would not be readable, one below the other
MARKERS = ("o", "X", "^", "v", "D", "P", "*", "s")


def tables_result(results: Results, *needed: str) -> Result:
    return with_columns(results.any_of(TABLES)[0], *needed)


def with_columns(result: Result, *needed: str) -> Result:
    result.table.need("scene", "camera", "width", "height", *needed)
    return result


def scenes_of(rows: list[Row]) -> list[str]:
    return list(dict.fromkeys(row["scene"] for row in rows))


def size_shown(rows: list[Row]) -> tuple[int, int]:
    """The paper's middle resolution where it was run, otherwise the first."""
    sizes = [(whole(row, "width"), whole(row, "height")) for row in rows]
    return PREFERRED if PREFERRED in sizes else sizes[0]


def of_size(rows: list[Row], size: tuple[int, int]) -> list[Row]:
    return [row for row in rows if (whole(row, "width"), whole(row, "height")) == size]


def draw_tables(results: Results, folder: Path) -> list[Path]:
    result = tables_result(results, *NEEDED)
    return [style.save_text(as_text(result.table), folder, "ssrm_tables.txt"),
            style.save_text(as_latex(result.table), folder, "ssrm_tables.tex")]


def megapixels(row: Row) -> float:
    return whole(row, "width") * whole(row, "height") / 1e6


def against_size(axis: Axes, rows: list[Row], column: str) -> None:
    """Mean over cameras by scene and resolution, with the range over cameras."""
    scenes = scenes_of(rows)
    for at, scene in enumerate(scenes):
        color, marker = style.look(scene, scenes)
        by_size: dict[float, list[float]] = defaultdict(list)
        for row in rows:
            if row["scene"] == scene and number(row, column) is not None:
                by_size[megapixels(row)].append(number(row, column))
        xs = sorted(by_size)
        ys = [sum(by_size[x]) / len(by_size[x]) for x in xs]
        below = [y - min(by_size[x]) for x, y in zip(xs, ys)]
        above = [max(by_size[x]) - y for x, y in zip(xs, ys)]
        shift = 1.0 + 0.02 * (at - (len(scenes) - 1) / 2)  # so that bars do not hide one another
        axis.errorbar([x * shift for x in xs], ys, [below, above], color=color, marker=marker, elinewidth=0.6)


def paper_line(axis: Axes, xs: list[float], ys: list[float], marker: str, name: str) -> None:
    axis.plot(xs, ys, color=style.PAPER, linestyle=":", marker=marker, markerfacecolor="white")
    axis.annotate(name, (xs[-1], ys[-1]), xytext=(4, 0), textcoords="offset points", fontsize=6, color=style.PAPER, va="center")


def draw_times(results: Results, folder: Path) -> list[Path]:
    result = tables_result(results, "t_ss_ms", "t_hw_ms", "speedup_sequential", "speedup_measured")
    rows = result.rows
    if not result.table.filled("t_ss_ms"):
        raise Skip(f"{result.table.path} has no times")
    figure, axes = style.panels(2, 2, 2.15)
    for axis, column, title, label in zip(
            axes, ("t_ss_ms", "t_hw_ms", "speedup_sequential", "speedup_measured"),
            ("SSRM, all rays", "general tracer, all rays, fastest mode", "speedup by the paper's formula", "speedup as measured"),
            ("time, ms", "time, ms", r"$T_{HW}\,/\,(T_{SS} + (1-\alpha)\,T_{HW})$", r"$T_{HW}\,/\,T_{hybrid}$")):
        against_size(axis, rows, column)
        axis.set(title=title, ylabel=label, xlabel="resolution, megapixels", xscale="log")
    table1 = read_table(PAPER / "ssrm_table1.csv").need("t_ss_ms").rows
    paper_line(axes[0], [megapixels(r) for r in table1], [number(r, "t_ss_ms") for r in table1], "D", "all scenes")
    for axis, file, column in ((axes[1], "ssrm_table2.csv", "t_hw_ms"), (axes[2], "ssrm_table3.csv", "speedup_sequential")):
        for scene, marker in PAPER_MARKERS.items():
            lines = [r for r in read_table(PAPER / file).need("scene", column).rows if r["scene"] == scene]
            paper_line(axis, [megapixels(r) for r in lines], [number(r, column) for r in lines], marker, scene)
    ticks = sorted({megapixels(r) for r in [*rows, *table1]})
    for axis in axes:
        plain_ticks(axis.xaxis, ticks)
        axis.xaxis.set_major_formatter(lambda value, _: f"{value:.2g}")
        axis.set_xlim(ticks[0] / 1.2, ticks[-1] * 1.75)
    for axis in axes[:2]:
        axis.set_yscale("log")
        log_ticks(axis.yaxis)
    top = max(axis.get_ylim()[1] for axis in axes[2:])
    for axis in axes[2:]:
        axis.axhline(1.0, color="black", linewidth=0.7)
        axis.set_ylim(0.0, top)
    style.letter(axes)
    scenes = scenes_of(rows)
    handles = [Line2D([], [], color=c, marker=m, label=s) for s in scenes for c, m in [style.look(s, scenes)]]
    handles.append(Line2D([], [], color=style.PAPER, linestyle=":", marker="D", markerfacecolor="white",
                          label=f"{PAPER_LABEL}: another machine, compare the slopes"))
    style.finish(figure, handles, f"{result.name}.csv; means over cameras, bars: least and greatest camera; {result.machine}")
    return style.save(figure, folder, "ssrm_times")


def draw_alpha(results: Results, folder: Path) -> list[Path]:
    result = tables_result(results, "alpha", "alpha_max")
    size = size_shown(result.rows)
    rows = [r for r in of_size(result.rows, size) if number(r, "alpha") is not None]
    if not rows:
        raise Skip(f"{result.table.path} has no alpha")
    paper = number(read_table(PAPER / "ssrm_table3.csv").need("alpha").rows[0], "alpha")
    scenes = scenes_of(rows)
    named = len(rows) <= MOST_NAMED_CAMERAS
    height = 0.145 * len(rows) + 0.1 * len(scenes) if named else 0.5 * len(scenes)
    figure, (axis,) = style.panels(1, 1, height + 0.5)
    at, ticks, names = 0.0, [], []
    for scene in scenes:
        color, marker = style.look(scene, scenes)
        members = [r for r in rows if r["scene"] == scene]
        alphas = [number(r, "alpha") for r in members]
        step = 1.0 if named else 3.0 / len(members)
        places = [at + i * step for i in range(len(members))]
        mean, low, high = mean_interval(alphas)
        span = (places[0] - 0.45, places[-1] + 0.45)
        axis.fill_betweenx(span, max(low, 0.0), min(high, 1.0), color=color, alpha=0.16, linewidth=0)
        axis.plot([mean, mean], span, color=color, linewidth=1.4)
        bounds = [number(r, "alpha_max") for r in members]
        axis.hlines([y for y, b in zip(places, bounds) if b is not None], [a for a, b in zip(alphas, bounds) if b is not None],
                    [b for b in bounds if b is not None], color=color, linewidth=0.7)
        axis.plot(bounds, places, linestyle="", marker="|", color=color, markersize=6)
        axis.plot(alphas, places, linestyle="", marker=marker, color=color, markersize=4 if named else 2)
        ticks += places if named else [sum(places) / len(places)]
        names += [f"{scene}: {r['camera']}" for r in members] if named else [f"{scene} ({len(members)} cameras)"]
        at = places[-1] + 1.6
    axis.axvline(paper, color=style.PAPER, linestyle="--", linewidth=1)
    axis.set_yticks(ticks, names)
    axis.tick_params(axis="y", length=0)
    axis.grid(axis="y", visible=False)
    axis.set(ylim=(at - 1.0, -0.8), xlim=(0.0, 1.0),
             xlabel=f"share of rays that SSRM resolves, alpha ({size[0]}x{size[1]})")
    grey = "0.2"
    style.finish(figure, [
        Line2D([], [], color=grey, marker="o", linestyle="", label="alpha of a camera"),
        Line2D([], [], color=grey, marker="|", markersize=6, linewidth=0.7, label="up to its alpha_max (one depth layer)"),
        Patch(color=grey, alpha=0.25, label="mean of the scene, 95 % interval"),
        Line2D([], [], color=style.PAPER, linestyle="--", label=f"paper's mean, {paper:g}")],
        f"{result.name}.csv; Student's t interval over the scene's cameras, as if drawn at random")
    return style.save(figure, folder, "ssrm_alpha")


def nines(axis: Axes, least: float) -> None:
    """A precision axis on which 90, 99 and 99.9 % are as far apart as they matter."""
    axis.set_yscale("logit")
    ticks = [t for t in (0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99, 0.995, 0.998, 0.999, 0.9995, 0.9998, 0.9999) if t >= least - 0.1]
    plain_ticks(axis.yaxis, ticks)
    axis.yaxis.set_major_formatter(lambda value, _: f"{100 * value:.6g}")


def draw_precision_recall(results: Results, folder: Path) -> list[Path]:
    result = with_columns(results.any_of(("ssrm_accuracy", "ssrm_derivatives", *TABLES))[0], "precision", "recall")
    size = size_shown(result.rows)
    points = []  # (scene, setting, recall, precision)
    for group, members in groups_of(of_size(result.rows, size), {"scene", "camera", "threads"}, result.keys).items():
        setting = ", ".join(f"{style.readable(k)} {v}" for k, v in group)
        points += [(r["scene"], setting, number(r, "recall"), number(r, "precision")) for r in members]
    points = [p for p in points if p[2] is not None and p[3] is not None]
    if not points:
        raise Skip(f"{result.table.path} has no precision and recall")
    scenes, settings = list(dict.fromkeys(p[0] for p in points)), list(dict.fromkeys(p[1] for p in points))
    figure, (axis,) = style.panels(1, 1, 3.4)
    nearest = 1.0 - 0.5e-5  # a precision of 1 has no place on the axis
    for scene, setting, recall, precision in points:
        axis.plot(recall, min(precision, nearest), marker=MARKERS[settings.index(setting) % len(MARKERS)], linestyle="",
                  color=style.look(scene, scenes)[0], markersize=4.5, markerfacecolor="none", markeredgewidth=0.9)
    nines(axis, min(p[3] for p in points))
    axis.set(xlabel="recall: rays resolved right / rays whose hit the main view sees",
             ylabel="precision: right / resolved, % (logit scale)")
    handles = [Line2D([], [], color=style.look(s, scenes)[0], marker="o", linestyle="", label=s) for s in scenes]
    if len(settings) > 1:
        handles += [Line2D([], [], color="0.2", marker=MARKERS[i % len(MARKERS)], markerfacecolor="none", linestyle="", label=s)
                    for i, s in enumerate(settings)]
    style.finish(figure, handles, f"{result.name}.csv, {size[0]}x{size[1]}; a mark is a camera; the paper prints neither number, "
                                  "it finds few results inaccurate")
    return style.save(figure, folder, "ssrm_precision_recall")
