"""Figure and table of the experiment `stability`: where buffers, march and tracer break, one axis at a time."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from csv_table import Row, number, whole
from figures import style
from figures.results import Results, Skip
from figures.ticks import log_ticks
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from text_table import TextTable

# What a point has that nothing is done to.
UNDISTURBED = {"far_near_ratio": "0", "far_plane": "finite", "depth_convention": "reversed", "depth_format": "float32",
               "depth_rounding": "nearest", "derivatives": "plane", "scene_scale": "1", "offset_m": "0", "origin": "world",
               "incidence_deg": "", "jitter_x_px": "0", "jitter_y_px": "0", "ray_offset": "scaled", "tracer": "robust"}
BROKEN = 0.01  # share of labels, or relative error, from which on something counts as broken
FLOOR = 1e-5  # of the figure: less is drawn there
DASHES = {"paper": "-", "plane": "--"}


@dataclass(frozen=True)
class Series:
    """Points that differ along one axis, from harmless to harmful."""

    label: str
    column: str
    settings: dict[str, str] = field(default_factory=dict)
    keep: Callable[[float], bool] = lambda value: True
    descending: bool = False

    def rows(self, rows: list[Row], marcher: str | None = None) -> list[Row]:
        settings = UNDISTURBED | self.settings
        free = {self.column, "width", "height"}
        sizes = {True: None, False: usual_size(rows)}[self.column == "pixels"]
        found = [r for r in rows if all(r[k] == v for k, v in settings.items() if k not in free)
                 and (marcher is None or r["marcher"] == marcher) and self.value(r) is not None and self.keep(self.value(r))
                 and (sizes is None or (r["width"], r["height"]) == sizes)]
        return sorted(found, key=self.value, reverse=self.descending)

    def value(self, row: Row) -> float | None:
        return whole(row, "width") * whole(row, "height") if self.column == "pixels" else number(row, self.column)


def usual_size(rows: list[Row]) -> tuple[str, str]:
    sizes = [(r["width"], r["height"]) for r in rows]
    return max(dict.fromkeys(sizes), key=sizes.count)


def formats() -> list[Series]:
    def of(label: str, **settings: str) -> Series:
        return Series(label, "far_near_ratio", settings, lambda v: v > 0)
    standard = {"depth_convention": "standard"}
    return [of("float, reversed"), of("float, reversed, infinite far", far_plane="infinite"), of("float, standard", **standard),
            of("float, standard, toward the viewer", depth_rounding="viewer", **standard), of("24 bit, reversed", depth_format="unorm24"),
            of("24 bit, standard", depth_format="unorm24", **standard),
            of("24 bit, standard, infinite far", depth_format="unorm24", far_plane="infinite", **standard),
            of("24 bit, standard, toward the viewer", depth_format="unorm24", depth_rounding="viewer", **standard),
            of("16 bit, standard", depth_format="unorm16", **standard),
            of("16 bit, standard, toward the viewer", depth_format="unorm16", depth_rounding="viewer", **standard)]


# Where rays start.
STARTS = {"scaled": "off by a share of the coordinates", "fixed": "off by 0.1 mm", "none": "on the surface",
          "split": "marched on, traced off the surface"}


def places() -> list[Series]:
    return [*(Series(label, "offset_m", {"ray_offset": name}, lambda v: v > 0) for name, label in STARTS.items()),
            Series("relative to the eye, off by a share", "offset_m", {"origin": "camera"}, lambda v: v > 0),
            Series("relative to the eye, marched on, traced off", "offset_m", {"origin": "camera", "ray_offset": "split"}, lambda v: v > 0)]


def scales(down: bool) -> list[Series]:
    return [Series(label, "scene_scale", {"ray_offset": name}, (lambda v: v < 1) if down else (lambda v: v > 1), down)
            for name, label in STARTS.items() if name != "split"]


AXES: dict[str, list[Series]] = {
    "far / near": formats(),
    "offset from the origin, m": places(),
    "scene made larger": scales(False),
    "scene made smaller": scales(True),
    "incidence, degrees": [Series("float, reversed", "incidence_deg")],
    "pixels": [Series("float, reversed", "pixels"), Series("float, reversed, marched on, traced off", "pixels", {"ray_offset": "split"})],
}


def harmless(rows: list[Row], like: Row) -> Row | None:
    found = [r for r in rows if all(r[k] == v for k, v in UNDISTURBED.items()) and (r["width"], r["height"]) == usual_size(rows)
             and (r["scene"], r["marcher"]) == (like["scene"], like["marcher"])]
    return found[0] if found else None


def further_false(rows: list[Row], row: Row) -> bool:
    """More false hits beyond those of double precision than the undisturbed point has, by three standard deviations."""
    base = harmless(rows, row)
    expected = whole(base, "further_false_hits") if base else 0
    return whole(row, "further_false_hits") > expected + 3.0 * math.sqrt(expected + 1)


def above(column: str) -> Callable[[list[Row], Row], bool]:
    return lambda rows, row: (number(row, column) or 0.0) > BROKEN


def any_self(rows: list[Row], row: Row) -> bool:
    return whole(row, "march_self_hits") > 0 or whole(row, "trace_self_hits") > 0


# Column of the table: its head, the marcher it is of (None: either, they see the same), and what is broken.
TESTS = [("labels, paper", "paper", above("labels_flipped_fraction")), ("labels, plane", "plane", above("labels_flipped_fraction")),
         ("false hits, paper", "paper", further_false), ("false hits, plane", "plane", further_false),
         ("stored depth", None, above("depth_error_fraction")), ("traced rays", None, above("trace_wrong_fraction")),
         ("self-hits", None, any_self)]


def first_broken(rows: list[Row], series: Series, marcher: str | None, broken: Callable[[list[Row], Row], bool]) -> str:
    members = series.rows(rows, marcher)
    if not members:
        return ""
    return next((f"{series.value(r):.6g}" for r in members if broken(rows, r)), "-")


def breaking_points(rows: list[Row]) -> TextTable:
    lines = []
    for axis, all_series in AXES.items():
        here = [s for s in all_series if s.rows(rows)]
        if here:
            ends = [here[0].value(here[0].rows(rows)[i]) for i in (0, -1)]
            lines.append([f"{axis} ({ends[0]:.6g} to {ends[1]:.6g})", *[""] * len(TESTS)])
        lines += [[f"  {s.label}", *(first_broken(rows, s, marcher, broken) for _, marcher, broken in TESTS)] for s in here]
    return TextTable("Breaking points: the first value of an axis at which, in any scene, more than 1 % is wrong, a further false hit or a "
                     "self-hit appears; -: none in the range.", ["axis", *(head for head, _, _ in TESTS)], lines, "tab:stability")


def draw_axis(axis: Axes, rows: list[Row], drawn: list[Series], column: str) -> list[Line2D]:
    handles = []
    if not any(series.rows(rows) for series in drawn):
        axis.set_axis_off()
        return handles
    for i, series in enumerate(drawn):
        color, marker = style.CYCLE[i % len(style.CYCLE)]
        for marcher, dashes in DASHES.items():
            worst: dict[float, float] = {}
            for row in series.rows(rows, marcher):
                worst[series.value(row)] = max(worst.get(series.value(row), FLOOR), number(row, column) or 0.0)
            axis.plot(list(worst), list(worst.values()), color=color, marker=marker, linestyle=dashes)
        handles.append(Line2D([], [], color=color, marker=marker, label=series.label))
    axis.axhline(BROKEN, color="black", linewidth=0.6)
    # Room above for the legend.
    axis.set(xscale="log", yscale="log", ylim=(0.6 * FLOOR, 10.0 ** (0.55 * len(handles))))
    log_ticks(axis.xaxis)
    axis.set_yticks([10.0 ** e for e in range(-5, 1)])
    axis.minorticks_off()
    return handles


def draw(results: Results, folder: Path) -> list[Path]:
    result = results.get("stability")
    result.table.need("scene", "marcher", "width", "height", *UNDISTURBED, "labels_flipped_fraction", "depth_error_fraction",
                      "trace_wrong_fraction", "further_false_hits", "march_self_hits", "trace_self_hits")
    rows = [r for r in result.rows if number(r, "labels_flipped_fraction") is not None]
    if not rows:
        raise Skip(f"{result.table.path} has no labels")
    shown = formats()
    figure, axes = style.panels(2, 2, 2.5)
    draws = ((axes[0], [shown[i] for i in (0, 2, 4, 5, 8)], "far / near", "labels_flipped_fraction", "labels flipped"),
             (axes[1], places(), "offset from the origin, m", "labels_flipped_fraction", "labels flipped"),
             (axes[2], [*scales(True), *scales(False)], "scale of the scene", "trace_wrong_fraction", "traced rays that are wrong"),
             (axes[3], AXES["pixels"], "pixels", "labels_flipped_fraction", "labels flipped"))
    for axis, series, label, column, title in draws:
        if series[0].column == "scene_scale":
            series = [Series(s.label, s.column, s.settings) for s in series[:3]]
        handles = draw_axis(axis, rows, series, column)
        axis.set(title=title, xlabel=label)
        if handles:
            axis.legend(handles=handles, fontsize=5.5, loc="upper left")
    style.letter(axes)
    handles = [Line2D([], [], color="0.2", linestyle=dashes, label=f"marcher {marcher}") for marcher, dashes in DASHES.items()]
    style.finish(figure, handles, f"{result.name}.csv; the worst scene of {', '.join(dict.fromkeys(r['scene'] for r in rows))}; the line is "
                 f"at 1 %; less than {FLOOR:g} is drawn there")
    table = breaking_points(rows)
    return [*style.save(figure, folder, "stability"), style.save_text(table.text(), folder, "stability.txt"),
            style.save_text(table.latex(), folder, "stability.tex")]
