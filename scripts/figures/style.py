"""How all figures look, and how they are written: the same bytes for the same tables."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot as plt
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

WIDTH = 7.0  # inches: two columns of a paper
# Colours that colour-blind readers tell apart (Okabe and Ito), dark enough for lines on white.
BLUE, ORANGE, GREEN, VERMILLION, PURPLE, SKY, BLACK = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#000000"
CYCLE = [(BLUE, "o"), (ORANGE, "s"), (GREEN, "^"), (VERMILLION, "D"), (PURPLE, "v"), (SKY, "P"), (BLACK, "X")]
# A scene looks the same in every figure.
SCENES = {"sphere": 0, "atrium": 1, "sponza": 2, "street": 3, "bistro": 4,
          "glass_ball": 0, "metal_ring": 1, "water_pool": 2, "wine_glass": 3, "atrium_lamps": 4, "sponza_caustics": 5}
PAPER = "0.35"  # grey: the paper's numbers, from another machine

plt.rcParams.update({
    "pdf.fonttype": 42, "svg.hashsalt": "hybray", "svg.fonttype": "path", "savefig.dpi": 200, "figure.dpi": 100,
    "font.family": "DejaVu Sans", "font.size": 7.5, "axes.titlesize": 8, "axes.labelsize": 7.5, "legend.fontsize": 7,
    "xtick.labelsize": 7, "ytick.labelsize": 7, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
    "axes.axisbelow": True, "grid.color": "0.9", "grid.linewidth": 0.5, "axes.linewidth": 0.6, "lines.linewidth": 1.1,
    "lines.markersize": 4, "legend.frameon": False, "errorbar.capsize": 1.5,
    "figure.constrained_layout.use": True, "axes.formatter.useoffset": False, "image.interpolation": "antialiased",
})


def look(scene: str, among: list[str]) -> tuple[str, str]:
    """Colour and marker of a scene; of one without a place of its own, by its place among those shown."""
    return CYCLE[SCENES.get(scene, among.index(scene) if scene in among else 0) % len(CYCLE)]


def readable(name: str) -> str:
    return name.replace("_", " ")


def short(value: float, digits: int = 3) -> str:
    """So many digits, without an exponent unless it is very small."""
    return f"{float(f'{value:.{digits}g}'):.10g}"


def panels(rows: int, columns: int, height: float, widths: list[float] | None = None) -> tuple[Figure, list[Axes]]:
    """A grid of panels of that height, inches, row by row."""
    figure = plt.figure(figsize=(WIDTH, rows * height))
    grid = figure.add_gridspec(rows, columns, width_ratios=widths)
    return figure, [figure.add_subplot(grid[i, k]) for i in range(rows) for k in range(columns)]


def finish(figure: Figure, handles: list[Artist], text: str, handlelength: float = 2.2) -> None:
    """Makes room below the panels, and writes there a legend, in as few lines as fit, and where the numbers come from."""
    renderer = figure.canvas.get_renderer()
    room = 0.13 * len(text.splitlines()) + 0.06
    legend = None
    for columns in range(len(handles), 0, -1):
        legend = figure.legend(handles=handles, ncol=columns, loc="lower center", bbox_to_anchor=(0.5, 0.0), borderaxespad=0.0,
                               handlelength=handlelength)
        legend.set_in_layout(False)
        if legend.get_window_extent(renderer).width <= 0.98 * figure.bbox.width or columns == 1:
            break
        legend.remove()
    height = legend.get_window_extent(renderer).height / figure.dpi if legend else 0.0
    width, panels_height = figure.get_size_inches()
    total = panels_height + room + height
    figure.set_size_inches(width, total)
    figure.set_constrained_layout_pads(w_pad=0.05, h_pad=0.04)
    figure.get_layout_engine().set(rect=(0.0, (room + height) / total, 1.0, panels_height / total))
    if legend:
        legend.set_bbox_to_anchor((0.5, room / total))
    figure.text(0.01, 0.04 / total, text, fontsize=6, color="0.35", ha="left", va="bottom", in_layout=False)


def letter(axes: list[Axes]) -> None:
    """Writes (a), (b), ... before the titles."""
    for i, axis in enumerate(axes):
        axis.set_title(f"({chr(ord('a') + i)}) {axis.get_title()}", loc="left")
        axis.set_title("")


def settle(figure: Figure) -> None:
    """Lays the panels out once and for all. The solver's last bits vary from run to run, so the places are rounded."""
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    for axis in figure.axes:
        axis.set_position([round(edge, 6) for edge in axis.get_position(original=True).bounds])


def save(figure: Figure, folder: Path, stem: str) -> list[Path]:
    """Writes PDF, SVG and PNG, without dates or versions, and closes the figure."""
    metadata = {"pdf": {"Creator": "hybray", "Producer": None, "CreationDate": None}, "svg": {"Date": None, "Creator": "hybray"},
                "png": {"Software": "hybray"}}
    settle(figure)
    written = []
    for kind, entries in metadata.items():
        path = folder / f"{stem}.{kind}"
        figure.savefig(path, metadata=entries)
        written.append(path)
    plt.close(figure)
    return written


def save_text(text: str, folder: Path, name: str) -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path
