"""Figures of the experiment `caustics`: quality and time against rays per texel and against depth, and the cost of lights."""

import math
from collections.abc import Callable
from pathlib import Path

from caustics_fit import LightCost, light_cost, light_groups, paper_numbers
from csv_table import Row, number
from figures import style
from figures.results import Result, Results, Skip
from figures.ticks import log_ticks, plain_ticks
from grouping import Group, groups_of
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

LINES = ["-", "--", ":", "-."]
Series = list[tuple[Group, list[Row]]]


def bars(rows: list[Row], column: str, low: str, high: str) -> list[list[float]]:
    """Lengths of the interval bars below and above."""
    ends = [(number(r, column), number(r, low), number(r, high)) for r in rows]
    return [[max(v - l, 0.0) if l is not None else 0.0 for v, l, _ in ends],
            [max(h - v, 0.0) if h is not None else 0.0 for v, _, h in ends]]


def spread_bars(rows: list[Row]) -> list[float]:
    """Half the interquartile range of the times."""
    return [0.5 * (number(r, "total_spread_ms") or 0.0) for r in rows]


def series_of(result: Result, x: str) -> Series:
    """Rows by everything but x, ordered by x, where x takes at least two values."""
    rows = [r for r in result.rows if r.get("caustics") != "false"]
    found = []
    for group, members in groups_of(rows, {x, "threads"}, result.keys).items():
        ordered = sorted((r for r in members if number(r, x) is not None), key=lambda r: number(r, x))
        if len({number(r, x) for r in ordered}) > 1:
            found.append((group, ordered))
    return found


def draw_series(axis: Axes, series: Series, x: str, column: str, interval: Callable[[list[Row]], list]) -> None:
    scenes, filters = scenes_of(series), filters_of(series)
    for group, rows in series:
        rows = [r for r in rows if number(r, column) is not None]
        color, marker = style.look(rows[0]["scene"], scenes) if rows else ("black", "o")
        line = LINES[filters.index(line_of(group)) % len(LINES)]
        xs, ys = [number(r, x) for r in rows], [number(r, column) for r in rows]
        axis.errorbar(xs, ys, interval(rows), color=color, marker=marker, linestyle=line, elinewidth=0.7,
                      markerfacecolor=color if line == "-" else "white")


def scenes_of(series: Series) -> list[str]:
    return list(dict.fromkeys(rows[0]["scene"] for _, rows in series))


def line_of(group: Group) -> str:
    """What tells a series from others of its scene."""
    return ", ".join(f"{style.readable(k)} {v}" for k, v in group if k != "scene")


def filters_of(series: Series) -> list[str]:
    return list(dict.fromkeys(line_of(group) for group, _ in series))


def legend(series: Series, extra: list[Line2D]) -> list[Line2D]:
    scenes, filters = scenes_of(series), filters_of(series)
    handles = [Line2D([], [], color=c, marker=m, label=style.readable(s)) for s in scenes for c, m in [style.look(s, scenes)]]
    if len(filters) > 1:
        handles += [Line2D([], [], color="0.2", marker="o", linestyle=LINES[i % len(LINES)], label=text,
                           markerfacecolor="0.2" if i == 0 else "white") for i, text in enumerate(filters)]
    return handles + extra


def floor_marks(axis: Axes, series: Series, x: str) -> bool:
    """Rings around errors that say more about the reference than about the image; whether there are any."""
    floored = [r for _, rows in series for r in rows if r.get("at_floor") == "true" and number(r, "relmse") is not None]
    axis.plot([number(r, x) for r in floored], [number(r, "relmse") for r in floored], linestyle="", marker="o", markersize=8,
              markerfacecolor="none", color="0.4", markeredgewidth=0.6)
    return bool(floored)


FLOOR = Line2D([], [], color="0.4", marker="o", markersize=8, markerfacecolor="none", linestyle="", markeredgewidth=0.6,
               label="at the reference's own error")


def paper_mark(axis: Axes, x: float, text: str = "", side: str = "left") -> None:
    """Where the paper says that something is enough: it prints no ordinate there."""
    axis.axvline(x, color=style.PAPER, linestyle=":", linewidth=1.2, zorder=2.5)
    axis.annotate(text, (x, 1.0), xycoords=axis.get_xaxis_transform(), xytext=(3 if side == "left" else -3, 0),
                  textcoords="offset points", fontsize=6, color=style.PAPER, va="top", ha=side)


def relmse_panel(axis: Axes, series: Series, x: str) -> None:
    draw_series(axis, series, x, "relmse", lambda rows: bars(rows, "relmse", "relmse_low", "relmse_high"))
    axis.set(title="error", ylabel="relMSE of one frame", yscale="log")


def time_panel(axis: Axes, series: Series, x: str) -> None:
    draw_series(axis, series, x, "total_ms", spread_bars)
    axis.set(title="time", ylabel="caustic pass, ms", yscale="log")


def needed(result: Result, x: str) -> Series:
    result.table.need("scene", x, "relmse", "relmse_low", "relmse_high", "energy_ratio", "at_floor", "total_ms", "total_spread_ms")
    return series_of(result, x)


def draw_rays(results: Results, folder: Path, name: str) -> list[Path]:
    """The paper's Figure 7."""
    result, paper = results.get(name), paper_numbers()
    series = needed(result, "rays_per_texel")
    if not series:
        raise Skip(f"{result.table.path}: column rays_per_texel: fewer than two values for any scene")
    figure, axes = style.panels(1, 2, 2.7)
    relmse_panel(axes[0], series, "rays_per_texel")
    floored = floor_marks(axes[0], series, "rays_per_texel")
    time_panel(axes[1], series, "rays_per_texel")
    ticks = sorted({number(r, "rays_per_texel") for _, rows in series for r in rows})
    for axis in axes:
        axis.set(xscale="log", xlabel="light paths per active texel of the maps")
        plain_ticks(axis.xaxis, ticks)
        paper_mark(axis, paper["rays_per_texel_enough"], "paper: enough")
        paper_mark(axis, paper["rays_per_texel_enough_filtered"], "paper:\nenough with\na filter", "right")
        axis.margins(y=0.16)
    slope_guide(axes[0], ticks)
    for axis in axes:
        log_ticks(axis.yaxis)
    style.letter(axes)
    style.finish(figure, legend(series, [FLOOR] if floored else []),
                 f"{result.name}.csv; bars: 95 % interval, interquartile range; dotted: what the paper finds enough "
                 f"(RTX 2060 mobile; it prints no numbers)\n{result.machine}")
    return style.save(figure, folder, result.name)


def slope_guide(axis: Axes, ticks: list[float]) -> None:
    """A short line of slope -1: error that is variance alone."""
    low, high = axis.get_ylim()
    right, left = ticks[-1], ticks[-1] / 4.0
    y = low * (high / low) ** 0.05
    axis.plot([left, right], [4.0 * y, y], color="black", linewidth=0.7)
    axis.annotate("1 / rays", (math.sqrt(left * right), 2.0 * y), xytext=(-3, -2), textcoords="offset points", fontsize=6, ha="right",
                  va="top")


def draw_depth(results: Results, folder: Path, name: str) -> list[Path]:
    """The paper's Figure 8."""
    result, paper = results.get(name), paper_numbers()
    series = needed(result, "mirror_depth")
    if not series:
        raise Skip(f"{result.table.path}: column mirror_depth: fewer than two values for any scene")
    figure, axes = style.panels(1, 3, 2.4)
    draw_series(axes[0], series, "mirror_depth", "energy_ratio",
                lambda rows: bars(rows, "energy_ratio", "energy_ratio_low", "energy_ratio_high"))
    axes[0].axhline(1.0, color="black", linewidth=0.7)
    axes[0].set(title="light that arrives", ylabel="energy / reference's", ylim=(0.0, None))
    relmse_panel(axes[1], series, "mirror_depth")
    floored = floor_marks(axes[1], series, "mirror_depth")
    time_panel(axes[2], series, "mirror_depth")
    ticks = sorted({number(r, "mirror_depth") for _, rows in series for r in rows})
    for axis in axes:
        axis.set(xlabel="specular events of a path, at most")
        plain_ticks(axis.xaxis, ticks)
        paper_mark(axis, paper["mirror_depth_best"])
        paper_mark(axis, paper["mirror_depth_no_gain_beyond"])
    for axis in axes[1:]:
        log_ticks(axis.yaxis)
    style.letter(axes)
    best, last = paper["mirror_depth_best"], paper["mirror_depth_no_gain_beyond"]
    handles = legend(series, [FLOOR] if floored else [])
    handles.append(Line2D([], [], color=style.PAPER, linestyle=":", label=f"paper: best at {best:g}, no gain beyond {last:g}"))
    style.finish(figure, handles, f"{result.name}.csv; bars: 95 % interval, interquartile range; the paper (RTX 2060 mobile) prints no "
                                  f"other numbers\n{result.machine}")
    return style.save(figure, folder, result.name)


def draw_lights(results: Results, folder: Path) -> list[Path]:
    """Time against the number of lights with its fit, and what one light costs beside the paper's."""
    result = results.get("caustics_lights")
    result.table.need("total_ms", "total_spread_ms", "repeats", "lights_visible", "lights_invisible")
    if not result.table.filled("total_ms"):
        raise Skip(f"{result.table.path} has no times")
    rows = [r for r in result.rows if r.get("caustics") != "false"]
    costs = [(group, cost) for group, members in light_groups(rows).items() if (cost := light_cost(members)) is not None]
    if not costs:
        raise Skip(f"{result.table.path}: the numbers of visible and invisible lights do not determine their cost")
    written = []
    for at, (group, cost) in enumerate(costs):
        figure, axes = style.panels(1, 3, 2.7, [1.7, 0.9, 0.7])
        light_times(axes[0], cost)
        light_bars(axes[1], cost)
        light_ratio(axes[2], cost)
        style.letter(axes)
        name = ", ".join(f"{k} {v}" for k, v in group)
        style.finish(figure, [], f"{result.name}.csv{f' ({name})' if name else ''}; bars: interquartile range in (a), 95 % bootstrap "
                           f"intervals over points in (b), (c); {result.machine}")
        written += style.save(figure, folder, result.name if len(costs) == 1 else f"{result.name}_{at + 1}")
    return written


def light_times(axis: Axes, cost: LightCost) -> None:
    a, b, c = cost.fit
    invisible = sorted({i for _, i, _ in cost.points})
    shades = plt.get_cmap("cividis")
    last = max(v for v, _, _ in cost.points)
    for at, count in enumerate(invisible):
        color = shades(0.9 * at / max(len(invisible) - 1, 1))
        members = sorted((r for r in cost.rows if number(r, "lights_invisible") == count), key=lambda r: number(r, "lights_visible"))
        xs = [number(r, "lights_visible") for r in members]
        axis.errorbar(xs, [number(r, "total_ms") for r in members], spread_bars(members), color=color, elinewidth=0.7,
                      marker=style.CYCLE[at % len(style.CYCLE)][1], linestyle="", label=f"{count:g}")
        axis.plot([0.0, last], [b * count + c, a * last + b * count + c], color=color, linewidth=0.9)
    axis.set(title="time and its linear fit", xlabel="lights that the camera sees", ylabel="caustic pass, ms", ylim=(0.0, None))
    plain_ticks(axis.xaxis, sorted({v for v, _, _ in cost.points}))
    handles, labels = axis.get_legend_handles_labels()
    axis.legend(handles[::-1], labels[::-1], title="lights that it\ndoes not see", title_fontsize=6.5, loc="center left",
                bbox_to_anchor=(1.0, 0.5), handlelength=1.0)


def with_interval(axis: Axes, x: float, value: float, interval: tuple[float, float], color: str) -> None:
    axis.errorbar([x], [value], [[max(value - interval[0], 0.0)], [max(interval[1] - value, 0.0)]], color=color, marker="o", capsize=2.5)


def paper_point(axis: Axes, x: float, value: float, text: str, offset: tuple[int, int], **alignment: str) -> None:
    axis.plot([x], [value], color=style.PAPER, marker="D", markerfacecolor="white", linestyle="")
    axis.annotate(text, (x, value), xytext=offset, textcoords="offset points", fontsize=6, color=style.PAPER, **alignment)


def light_bars(axis: Axes, cost: LightCost) -> None:
    paper = paper_numbers()
    for x, (value, pick, printed) in enumerate(((cost.fit[0], lambda s: s[0], paper["light_visible_ms"]),
                                                (cost.fit[1], lambda s: s[1], paper["light_invisible_ms"]))):
        with_interval(axis, x - 0.15, value, cost.interval(pick), (style.BLUE, style.ORANGE)[x])
        axis.annotate(style.short(value), (x - 0.15, value), xytext=(-5, 0), textcoords="offset points", fontsize=6, ha="right", va="center")
        paper_point(axis, x + 0.2, printed, f"paper {printed:g}", (0, -6), ha="center", va="top")
    axis.set_yscale("log")
    axis.set_xticks([0, 1], ["seen", "not seen"])
    axis.set(title="cost of a light", ylabel="ms (paper: RTX 2060 mobile)", xlim=(-0.7, 1.7))
    axis.margins(y=0.25)
    log_ticks(axis.yaxis)
    axis.grid(axis="x", visible=False)


def light_ratio(axis: Axes, cost: LightCost) -> None:
    paper, (a, b, _) = paper_numbers(), cost.fit
    with_interval(axis, 0.0, b / a, cost.interval(lambda s: s[1] / s[0]), style.GREEN)
    axis.annotate(f"{b / a:.2f}", (0.0, b / a), xytext=(-5, 0), textcoords="offset points", fontsize=6, ha="right", va="center")
    printed = paper["light_invisible_ms"] / paper["light_visible_ms"]
    paper_point(axis, 1.0, printed, f"{printed:.2f}", (5, 0), ha="left", va="center")
    axis.axhline(1.0, color="black", linewidth=0.7)
    axis.set_xticks([0, 1], ["here", "paper"])
    axis.set(title="ratio", ylabel="cost of one not seen / of one seen", xlim=(-0.7, 1.6))
    axis.set_ylim(0.0, max(1.3, 1.1 * axis.get_ylim()[1]))
    axis.grid(axis="x", visible=False)
