"""Cost of the march against triangles and pixels: the SSRM paper's main claim."""

from collections.abc import Callable
from pathlib import Path

from csv_table import Row, number, whole
from figures import style
from figures.results import Results, Skip
from figures.ssrm import megapixels, scenes_of, with_columns
from figures.ticks import log_ticks, plain_ticks
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

STYLES = {"paper": ("o", "-"), "plane": ("s", "--")}  # of the marchers
TRACER = ("^", ":")


def per_ray(row: Row, column: str) -> float:
    """Nanoseconds."""
    return 1e6 * number(row, column) / whole(row, "rays")


def line(axis: Axes, rows: list[Row], x: Callable[[Row], float], column: str, color: str, look: tuple[str, str]) -> None:
    rows = sorted(rows, key=x)
    axis.plot([x(r) for r in rows], [per_ray(r, column) for r in rows], color=color, marker=look[0], linestyle=look[1])


def draw(results: Results, folder: Path) -> list[Path]:
    result = with_columns(results.get("ssrm_scaling"), "marcher", "triangles", "rays", "t_ss_ms", "t_hw_ms", "steps_per_ray")
    rows = [r for r in result.rows if number(r, "t_ss_ms") is not None]
    if not rows:
        raise Skip(f"{result.table.path} has no times")
    size = max((whole(r, "width") for r in rows), key=lambda w: len({r["triangles"] for r in rows if whole(r, "width") == w}))
    scaled = [r for r in rows if r["scene"].startswith("atrium") and whole(r, "width") == size]
    figure, axes = style.panels(1, 3, 2.3)
    for marcher, look in STYLES.items():
        line(axes[0], [r for r in scaled if r["marcher"] == marcher], lambda r: whole(r, "triangles"), "t_ss_ms", style.BLUE, look)
    line(axes[0], [r for r in scaled if r["marcher"] == "paper"], lambda r: whole(r, "triangles"), "t_hw_ms", style.VERMILLION, TRACER)
    axes[0].set(title="one generator, one camera", xlabel="triangles", ylabel="time a ray, ns", xscale="log", yscale="log")
    sizes: dict[str, list[Row]] = {}
    for scene in scenes_of(rows):
        members = [r for r in rows if r["scene"] == scene]
        if len({megapixels(r) for r in members}) > 1:
            sizes[scene] = members
    scenes = list(sizes)
    for axis, value, title in ((axes[1], lambda r: per_ray(r, "t_ss_ms"), "march"),
                               (axes[2], lambda r: number(r, "steps_per_ray"), "depth samples")):
        for scene, members in sizes.items():
            for marcher, (marker, dashes) in STYLES.items():
                own = sorted((r for r in members if r["marcher"] == marcher), key=megapixels)
                first = value(own[0]) if own else 1.0
                axis.plot([megapixels(r) for r in own], [value(r) / first for r in own], color=style.look(scene, scenes)[0],
                          marker=marker, linestyle=dashes)
        axis.set(title=title, xlabel="resolution, megapixels", ylabel="a ray, relative to the smallest", xscale="log")
        plain_ticks(axis.xaxis, sorted({megapixels(r) for m in sizes.values() for r in m}))
        axis.xaxis.set_major_formatter(lambda v, _: f"{v:.2g}")
    log_ticks(axes[0].xaxis)
    log_ticks(axes[0].yaxis)
    top = max(axis.get_ylim()[1] for axis in axes[1:])
    for axis in axes[1:]:
        axis.set_ylim(min(0.9, *(a.get_ylim()[0] for a in axes[1:])), top)
    style.letter(axes)
    handles = [Line2D([], [], color=style.BLUE, marker=m, linestyle=d, label=f"marcher {name}") for name, (m, d) in STYLES.items()]
    handles.append(Line2D([], [], color=style.VERMILLION, marker=TRACER[0], linestyle=TRACER[1], label="general tracer, fastest mode"))
    handles += [Line2D([], [], color=style.look(s, scenes)[0], label=s) for s in scenes]
    style.finish(figure, handles, f"{result.name}.csv; {result.machine}")
    return style.save(figure, folder, "ssrm_scaling")
