"""Figure of the experiment `ssrm_layers`: alpha, precision, time and memory against depth layers and guard band."""

from collections import defaultdict
from pathlib import Path

from csv_table import Row, number, whole
from figures import style
from figures.results import Results, Skip
from figures.ticks import plain_ticks
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

NEEDED = ("scene", "camera", "layers", "guard_band", "alpha_gain", "precision", "single_precision", "buffer_bytes", "single_buffer_bytes",
          "speedup_over_single_layer")
STYLES = ("-", "--", ":", "-.")


def mean_by_layers(rows: list[Row], value) -> tuple[list[int], list[float]]:
    """Means over the cameras, for each number of layers that has one."""
    found: dict[int, list[float]] = defaultdict(list)
    for row in rows:
        if (y := value(row)) is not None:
            found[whole(row, "layers")].append(y)
    layers = sorted(found)
    return layers, [sum(found[k]) / len(found[k]) for k in layers]


def gained_precision(row: Row) -> float | None:
    """Points of precision more than with one layer."""
    mine, single = number(row, "precision"), number(row, "single_precision")
    return None if mine is None or single is None else 100.0 * (mine - single)


def memory_ratio(row: Row) -> float:
    return number(row, "buffer_bytes") / number(row, "single_buffer_bytes")


def draw(results: Results, folder: Path) -> list[Path]:
    result = results.get("ssrm_layers")
    result.table.need(*NEEDED)
    rows = [r for r in result.rows if number(r, "alpha_gain") is not None]
    if not rows:
        raise Skip(f"{result.table.path} has no alpha_gain")
    scenes = list(dict.fromkeys(r["scene"] for r in rows))
    bands = sorted({number(r, "guard_band") for r in rows})
    figure, axes = style.panels(2, 2, 2.1)
    readings = (("alpha over that of one layer without band", r"$\alpha\,/\,\alpha_1$", lambda r: number(r, "alpha_gain")),
                ("precision less that of one layer without band", "points", gained_precision),
                ("speed of the hybrid over one layer without band", r"$T_{1}\,/\,T$", lambda r: number(r, "speedup_over_single_layer")),
                ("memory of the buffers, likewise", "ratio", memory_ratio))
    for axis, (title, label, value) in zip(axes, readings):
        against_layers(axis, rows, scenes, bands, value)
        axis.set(title=title, ylabel=label, xlabel="depth layers")
        plain_ticks(axis.xaxis, sorted({whole(r, "layers") for r in rows}))
    for axis, level in zip(axes, (1.0, 0.0, 1.0, 1.0)):
        axis.axhline(level, color="black", linewidth=0.6)
    style.letter(axes)
    handles = [Line2D([], [], color=c, marker=m, label=s) for s in scenes for c, m in [style.look(s, scenes)]]
    handles += [Line2D([], [], color="0.2", linestyle=STYLES[i % len(STYLES)], label=f"guard band {style.short(b)}")
                for i, b in enumerate(bands)]
    style.finish(figure, handles, f"{result.name}.csv; means over cameras; layers and band are charged to the time; {result.machine}")
    return style.save(figure, folder, "ssrm_layers")


def against_layers(axis: Axes, rows: list[Row], scenes: list[str], bands: list[float], value) -> None:
    for scene in scenes:
        color, marker = style.look(scene, scenes)
        for i, band in enumerate(bands):
            xs, ys = mean_by_layers([r for r in rows if r["scene"] == scene and number(r, "guard_band") == band], value)
            axis.plot(xs, ys, color=color, marker=marker, linestyle=STYLES[i % len(STYLES)])
