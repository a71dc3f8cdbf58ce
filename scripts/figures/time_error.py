"""Run time against error, for any table that has both: the Pareto front, and what equal time and equal error read."""

from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from caustics_fit import paper_numbers
from csv_table import Row, is_number, number
from figures import style
from figures.pareto import Setting, fastest_within, front, most_exact_within
from figures.results import Result, Results, Skip
from figures.ssrm import of_size, size_shown
from figures.ticks import log_ticks, log_ticks_and_zero
from grouping import varying
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from text_table import TextTable

# What is to be computed, and not how: settings compare only where all of these are the same.
PROBLEM = ("scene", "camera", "width", "height", "near_m", "footprint_factor", "lights_visible", "lights_invisible")


@dataclass(frozen=True)
class Panel:
    title: str
    settings: list[Setting]
    reference: Setting  # the paper's setting; where it was not run, the middle of the front


@dataclass(frozen=True)
class Comparison:
    panels: list[Panel]
    error: str  # label of the error axis
    marks: str  # what stands beside points and in brackets
    note: str = ""


def compared(result: Result) -> Comparison:
    """The panels of a table; Skip where it does not hold time and error of at least two settings of one problem."""
    columns = result.table.columns
    if "t_hybrid_ms" in columns:
        comparison = of_ssrm(result)
    elif "total_ms" in columns and ("relmse" in columns or "closed_form_error_fraction" in columns):
        comparison = of_caustics(result)
    else:
        raise Skip(f"{result.table.path} has no time and error that compare")
    if not comparison.panels:
        raise Skip(f"{result.table.path} does not hold time and error of two settings of the same scene")
    return comparison


def of_caustics(result: Result) -> Comparison:
    """Caustic pass against relMSE; against the closed form where there is no reference."""
    error = next((c for c in ("relmse", "closed_form_error_fraction") if result.table.filled(c)), None)
    if error is None or not result.table.filled("total_ms"):
        raise Skip(f"{result.table.path} has no {'error' if error is None else 'time'}: "
                   f"{'relmse and closed_form_error_fraction are' if error is None else 'total_ms is'} empty")
    result.table.need("scene", "camera", "total_spread_ms", *(("relmse_low", "relmse_high") if error == "relmse" else ()))
    rows = [r for r in result.rows if number(r, error) is not None and number(r, "total_ms") is not None]
    varied = [k for k in varying(rows, result.keys) if k not in (*PROBLEM, "threads", "caustics")]
    numeric = [k for k in varied if all(is_number(r[k]) for r in rows)]

    def setting(row: Row) -> Setting:
        method = ", ".join(f"{style.readable(k)} {row[k]}" for k in varied if k not in numeric)
        value = ", ".join(f"{number(row, k):g}" for k in numeric)
        time, spread, e = number(row, "total_ms"), number(row, "total_spread_ms") or 0.0, number(row, error)
        low, high = number(row, f"{error}_low"), number(row, f"{error}_high")
        return Setting(method, value, time, e, (0.5 * spread, 0.5 * spread),
                       (max(e - low, 0.0) if low is not None else 0.0, max(high - e, 0.0) if high is not None else 0.0),
                       value, row.get("at_floor") == "true")

    paper = paper_numbers()
    chosen = {"rays_per_texel": paper["rays_per_texel_enough"], "mirror_depth": paper["mirror_depth_best"]}
    names = {"filter": "none", "emission": "map"}

    def as_paper(row: Row) -> bool:
        return all(number(row, k) == chosen[k] if k in chosen else row[k] == names.get(k, row[k]) for k in varied)

    problems: dict[tuple[str, ...], list[Row]] = defaultdict(list)
    keys = [k for k in PROBLEM if k in result.table.columns]
    for row in rows:
        problems[tuple(row[k] for k in keys)].append(row)
    several = varying(rows, keys[1:])
    panels = []
    for members in problems.values():
        if len(members) < 2:
            continue
        title = ", ".join([style.readable(members[0]["scene"]), *(members[0][k] for k in several)])
        settings = [setting(r) for r in members]
        papers = [s for s, r in zip(settings, members) if as_paper(r)]
        panels.append(Panel(title, settings, papers[0] if papers else middle(settings)))
    label = "relMSE of one frame" if error == "relmse" else "error of flux, share (closed form)"
    values = " and ".join(style.readable(k) for k in numeric)
    return Comparison(panels, label, f"numbers: {values}" if values else "")


# The ways of answering all rays that an ssrm row measured: name, columns of its time, share of rays without the right answer.
METHODS: list[tuple[str, tuple[str, ...], Callable[[float, float], float]]] = [
    ("hybrid, fastest mode", ("t_hybrid_ms",), lambda alpha, precision: alpha * (1.0 - precision)),
    ("hybrid, single rays", ("t_hybrid_single_ms",), lambda alpha, precision: alpha * (1.0 - precision)),
    ("SSRM alone", ("pyramid_ms", "t_ss_ms"), lambda alpha, precision: 1.0 - alpha * precision),
    ("tracer, fastest mode", ("t_hw_ms",), lambda alpha, precision: 0.0),
    ("tracer, single rays", ("t_hw_single_ms",), lambda alpha, precision: 0.0),
]


def of_ssrm(result: Result) -> Comparison:
    """Time to answer all rays against the share without the right answer, means over cameras, at one resolution."""
    result.table.need("scene", "camera", "width", "height", "alpha", "precision", *(c for _, cs, _ in METHODS for c in cs))
    if not result.table.filled("t_hybrid_ms"):
        raise Skip(f"{result.table.path} has no time: t_hybrid_ms is empty")
    size = size_shown(result.rows)
    rows = [r for r in of_size(result.rows, size) if number(r, "alpha") is not None and number(r, "precision") is not None]
    varied = [k for k in varying(rows, result.keys) if k not in (*PROBLEM, "threads")]
    values = list(dict.fromkeys(", ".join(row[k] for k in varied) for row in rows))
    marks = {value: chr(ord("a") + i) if value else "" for i, value in enumerate(values)}
    panels = []
    for scene in dict.fromkeys(r["scene"] for r in rows):
        by_setting: dict[str, list[Row]] = defaultdict(list)
        for row in rows:
            if row["scene"] == scene:
                by_setting[", ".join(row[k] for k in varied)].append(row)
        settings = []
        for name, columns, wrong in METHODS:
            exact = name.startswith("tracer")
            for value, members in ({"": sum(by_setting.values(), [])} if exact else by_setting).items():
                timed = [r for r in members if all(number(r, c) is not None for c in columns)]
                if timed:
                    settings.append(mean_setting(name, value, marks.get(value, ""), timed, columns, wrong))
        if len(settings) < 2:
            continue
        as_paper = next((s for s in settings if s.method == METHODS[0][0] and "difference" not in s.value), settings[0])
        panels.append(Panel(f"{style.readable(scene)}, {size[0]}x{size[1]}", settings, as_paper))
    return Comparison(panels, "rays without the right answer, share", "; ".join(f"{m}: {v}" for v, m in marks.items() if m),
                      "means over cameras, bars: least and greatest")


def mean_setting(name: str, value: str, mark: str, rows: list[Row], columns: tuple[str, ...], wrong: Callable[[float, float], float]) -> Setting:
    times = [sum(number(r, c) for c in columns) for r in rows]
    errors = [wrong(number(r, "alpha"), number(r, "precision")) for r in rows]
    time, error = sum(times) / len(times), sum(errors) / len(errors)
    return Setting(name, value, time, error, (time - min(times), max(times) - time), (error - min(errors), max(errors) - error),
                   mark)


def middle(settings: list[Setting]) -> Setting:
    best = front(settings)
    return best[len(best) // 2]


def times_as(value: float, base: float) -> str:
    """A ratio; the plain value where there is nothing to divide by."""
    return f"× {style.short(value / base, 2)}" if base > 0.0 else style.short(value, 2)


def readings(comparison: Comparison, name: str) -> TextTable:
    """For each method: the error that it reaches in the reference's time, and the time that it takes for the reference's error."""
    lines = []
    for panel in comparison.panels:
        at = panel.reference
        lines.append([panel.title, at.name, style.short(at.time), style.short(at.error), "", ""])
        for method in dict.fromkeys(s.method for s in panel.settings):
            own = [s for s in panel.settings if s.method == method]
            exact, fast = most_exact_within(own, at.time), fastest_within(own, at.error)
            lines.append([f"  {method or 'all settings'}", "", "", "",
                          "none as fast" if exact is None else f"{times_as(exact.error, at.error)}{of(exact)}",
                          "none as exact" if fast is None else f"{times_as(fast.time, at.time)}{of(fast)}"])
    marks = f" ({comparison.marks})" if comparison.marks else ""
    return TextTable(f"Equal time and equal error, {style.readable(name)}{marks}",
                     ["problem, method", "reference", "time, ms", "error", "error in its time", "time for its error"], lines,
                     f"tab:time-error-{name.replace('_', '-')}")


def of(setting: Setting) -> str:
    return f" ({setting.mark})" if setting.mark else ""


def draw(results: Results, folder: Path, name: str) -> list[Path]:
    result = results.get(name)
    comparison = compared(result)
    panels = comparison.panels
    methods = list(dict.fromkeys(s.method for p in panels for s in p.settings))
    across = len(panels) if len(panels) < 4 else 2 if len(panels) == 4 else 3
    down = -(-len(panels) // across)
    figure, axes = style.panels(down, across, 2.6 if across < 3 else 2.3)
    for axis in axes[len(panels):]:
        axis.set_axis_off()
    with_zero = any(s.error <= 0.0 for p in panels for s in p.settings)
    for i, (axis, panel) in enumerate(zip(axes, panels)):
        draw_panel(axis, panel, methods, with_zero)
        axis.set(xlabel="time, ms", ylabel=comparison.error if i % across == 0 else "")
        axis.set_title(panel.title, loc="left", pad=20)
    said = "; ".join(part for part in (comparison.note, comparison.marks) if part)
    style.finish(figure, legend_handles(methods, panels), "\n".join(part for part in (f"{name}.csv", said, result.machine) if part))
    table, stem = readings(comparison, name), f"time_error_{name}"
    return [*style.save(figure, folder, stem), style.save_text(table.text(), folder, f"{stem}.txt"),
            style.save_text(table.latex(), folder, f"{stem}.tex")]


def draw_panel(axis: Axes, panel: Panel, methods: list[str], with_zero: bool) -> None:
    axis.set_xscale("log")
    if with_zero:
        least = min((s.error for s in panel.settings if s.error > 0.0), default=1.0)
        axis.set_yscale("symlog", linthresh=0.5 * least, linscale=0.5)
    else:
        axis.set_yscale("log")
    best = front(panel.settings)
    axis.step([s.time for s in best], [s.error for s in best], where="post", color="0.8", linewidth=3.5, marker="s", markersize=8,
              zorder=1)
    for at, method in enumerate(methods):
        color, marker = style.CYCLE[at % len(style.CYCLE)]
        own = [s for s in panel.settings if s.method == method]
        axis.errorbar([s.time for s in own], [s.error for s in own], list(zip(*(s.error_bar for s in own))) if own else None,
                      list(zip(*(s.time_bar for s in own))) if own else None, color=color, marker=marker, elinewidth=0.5,
                      linewidth=0.7, linestyle="-" if any(s.mark == s.value != "" for s in own) else "", capsize=0, zorder=3)
        hollow = [s for s in own if s.floor]
        axis.plot([s.time for s in hollow], [s.error for s in hollow], color=color, marker=marker, linestyle="",
                  markerfacecolor="white", zorder=4)
    at = panel.reference
    axis.plot([at.time], [at.error], marker="o", markersize=10, markerfacecolor="none", color="black", linestyle="", zorder=5)
    for s in dict.fromkeys([*best, at]):
        if s.mark:
            axis.annotate(s.mark, (s.time, s.error), xytext=(3, 3), textcoords="offset points", fontsize=5.5, zorder=6)
    exact, fast = most_exact_within(panel.settings, at.time), fastest_within(panel.settings, at.error)
    axis.text(0.0, 1.02, f"equal time: {times_as(exact.error, at.error)} ({exact.name})\n"
                         f"equal error: {times_as(fast.time, at.time)} ({fast.name})",
              transform=axis.transAxes, fontsize=5.5, ha="left", va="bottom", color="0.2", in_layout=False)
    axis.margins(x=0.12, y=0.15)
    log_ticks(axis.xaxis)
    if with_zero:
        axis.set_ylim(bottom=-0.3 * least)
        log_ticks_and_zero(axis.yaxis, least)
    else:
        log_ticks(axis.yaxis)


def legend_handles(methods: list[str], panels: list[Panel]) -> list[Line2D]:
    handles = []
    for at, method in enumerate(methods):
        color, marker = style.CYCLE[at % len(style.CYCLE)]
        handles.append(Line2D([], [], color=color, marker=marker, label=method or "settings"))
    handles.append(Line2D([], [], color="0.8", linewidth=3.5, marker="s", markersize=8, label="Pareto front"))
    handles.append(Line2D([], [], color="black", marker="o", markersize=9, markerfacecolor="none", linestyle="",
                          label="compared with: the paper's setting, else the front's middle"))
    if any(s.floor for p in panels for s in p.settings):
        handles.append(Line2D([], [], color="0.2", marker="o", markerfacecolor="white", linestyle="",
                              label="at the reference image's own error"))
    return handles
