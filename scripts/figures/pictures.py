"""Figures made of pictures that the program wrote: SSRM's verdicts, and the image without and with caustics."""

from pathlib import Path

from caustics_fit import paper_numbers
from csv_table import Row, number
from figures import style
from figures.results import Result, Results, Skip
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Patch

# The colours of the program's verdict pictures, by meaning.
VERDICTS = {"resolved (as bright as what it reflects)": "0.6", "failed": (40 / 255, 70 / 255, 200 / 255),
            "failed: miss at pixel centres": (150 / 255, 190 / 255, 240 / 255),
            "resolved, but inaccurate": (220 / 255, 30 / 255, 30 / 255), "background": "black"}


def show(axis: Axes, path: Path, title: str) -> None:
    axis.imshow(plt.imread(path))
    axis.set_title(title, fontsize=7)
    axis.set_axis_off()


def one_for_each_scene(result: Result, kinds: tuple[str, ...]) -> list[Row]:
    """The first row of each scene of which all these pictures are there."""
    result.table.need("id", "scene", "camera", "width", "height")
    chosen: dict[str, Row] = {}
    for row in result.rows:
        if row["scene"] not in chosen and all(result.picture(row, kind) for kind in kinds):
            chosen[row["scene"]] = row
    return list(chosen.values())


def percent(value: float | None) -> str:
    return "?" if value is None else f"{100.0 * value:.3g} %"


def draw_verdicts(results: Results, folder: Path) -> list[Path]:
    found = results.any_of(("ssrm_tables", "quickstart"))
    result = next((r for r in found if one_for_each_scene(r, ("",))), None)
    if result is None:
        raise Skip(f"no pictures beside {' and '.join(str(r.table.path) for r in found)} (parameter picture)")
    result.table.need("alpha", "precision")
    rows = one_for_each_scene(result, ("",))
    with_views = all(result.picture(row, "view") for row in rows)
    pictures = []
    for row in rows:
        name = f"{row['scene']}, {row['camera']}"
        if with_views:
            pictures.append((result.picture(row, "view"), f"{name}: main view"))
        text = f"{percent(number(row, 'alpha'))} resolved, {percent(number(row, 'precision'))} of them right"
        pictures.append((result.picture(row), text if with_views else f"{name}\n{text}"))
    across = len(pictures) if len(pictures) < 4 and not with_views else 2
    lines = -(-len(pictures) // across)
    figure, axes = style.panels(lines, across, 3.9 / across + 0.2)
    for axis in axes:
        axis.set_axis_off()
    for axis, (path, title) in zip(axes, pictures):
        show(axis, path, title)
    style.finish(figure, [Patch(facecolor=color, label=label) for label, color in VERDICTS.items()],
                 f"{result.name}.csv and its pictures; mirror reflections of the whole view, blue and red as in the paper's figure", handlelength=1.2)
    return style.save(figure, folder, "ssrm_verdicts")


def draw_onoff(results: Results, folder: Path) -> list[Path]:
    """The paper's Figure 6: left without, right with caustics."""
    result = results.get("caustics_onoff")
    result.table.need("caustics", "total_ms", "main_view_ratio")
    rows = one_for_each_scene(result, ("off", "on"))
    if not rows:
        raise Skip(f"no pictures beside {result.table.path} (parameter picture)")
    across = 1 if len(rows) == 1 else 2  # pairs side by side
    lines = -(-len(rows) // across)
    figure, axes = style.panels(lines, 2 * across, 2.0 / across + 0.15)
    for axis in axes:
        axis.set_axis_off()
    for i, row in enumerate(rows):
        show(axes[2 * i], result.picture(row, "off"), f"{style.readable(row['scene'])}, {row['camera']}: without")
        time, ratio = number(row, "total_ms"), number(row, "main_view_ratio")
        cost = "" if time is None else f": {style.short(time)} ms" + ("" if ratio is None else f", frame × {style.short(ratio)}")
        show(axes[2 * i + 1], result.picture(row, "on"), f"with{cost}")
    style.finish(figure, [], f"{result.name}.csv and its pictures; frame: main view + caustics; {result.machine}\n"
                 f"paper: up to {paper_numbers()['frames_per_second_up_to']:g} frames/s with few lights (RTX 2060 mobile)")
    return style.save(figure, folder, "caustics_onoff")
