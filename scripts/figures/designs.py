"""Designs of the hybrid side by side: speedups over the general tracer, from the experiment `ssrm_speed`."""

from pathlib import Path

from csv_table import Row, number
from figures import style
from figures.results import Results, Skip
from figures.ssrm import scenes_of, with_columns
from matplotlib.axes import Axes
from matplotlib.patches import Patch

# Column without its end, name, colour.
DESIGNS = (("measured", "march all", style.BLUE), ("predicted", "predictor", style.SKY), ("centre", "remaining segment, centre", style.GREEN),
           ("predicted_centre", "predictor and that segment", style.VERMILLION), ("exact", "remaining segment, exact", style.ORANGE),
           ("oracle", "perfect predictor", style.PURPLE), ("free", "free marcher", style.BLACK))


def bars(axis: Axes, rows: list[Row], end: str) -> None:
    """Means over cameras, a group for each scene and marcher, with the range over cameras."""
    groups = [(s, m) for s in scenes_of(rows) for m in dict.fromkeys(r["marcher"] for r in rows)]
    width = 0.8 / len(DESIGNS)
    for k, (design, _, color) in enumerate(DESIGNS):
        for at, (scene, marcher) in enumerate(groups):
            values = [number(r, f"speedup_{design}{end}") for r in rows if (r["scene"], r["marcher"]) == (scene, marcher)]
            values = [v for v in values if v is not None]
            if values:
                mean = sum(values) / len(values)
                axis.bar(at - 0.4 + (k + 0.5) * width, mean, width, color=color, yerr=[[mean - min(values)], [max(values) - mean]],
                         error_kw={"elinewidth": 0.5, "ecolor": "0.4"})
    axis.axhline(1.0, color="black", linewidth=0.7)
    axis.set_xticks(range(len(groups)), [f"{style.readable(s)}\n{m}" for s, m in groups])
    axis.grid(axis="x", visible=False)


def draw(results: Results, folder: Path) -> list[Path]:
    result = with_columns(results.get("ssrm_speed"), "marcher", "speedup_measured", "speedup_measured_vs_single")
    rows = [r for r in result.rows if number(r, "speedup_measured") is not None]
    if not rows:
        raise Skip(f"{result.table.path} has no times")
    figure, axes = style.panels(2, 1, 2.0)
    for axis, end, title in ((axes[0], "_vs_single", "against single rays, single rays on both sides"), (axes[1], "", "against the fastest mode")):
        bars(axis, rows, end)
        axis.set(title=title, ylabel="speedup")
    style.letter(axes)
    handles = [Patch(color=color, label=name) for _, name, color in DESIGNS]
    style.finish(figure, handles, f"{result.name}.csv; means over cameras, bars: least and greatest camera; {result.machine}")
    return style.save(figure, folder, "ssrm_designs")
