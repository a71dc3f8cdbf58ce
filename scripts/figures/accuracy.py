"""Strict against heuristic marching: precision and recall of the experiment `ssrm_accuracy` over thickness."""

from pathlib import Path

from csv_table import Row, number
from figures import style
from figures.results import Results, Skip
from figures.ssrm import nines, of_size, scenes_of, size_shown, with_columns
from matplotlib.lines import Line2D

TABLE = "ssrm_accuracy"
CURVES = {"dda": ("linear, thickness", style.VERMILLION, "o"), "hiz": ("Hi-Z, thickness and confidence", style.ORANGE, "s")}
CHECKS = {"none": "o", "triangle": "^", "continuity": "v", "conservative": "D", "strict": "*"}
NEAREST = 1.0 - 0.5e-5  # a precision of 1 has no place on the axis


def mean(rows: list[Row], column: str) -> float:
    return sum(number(r, column) for r in rows) / len(rows)


def place(rows: list[Row]) -> tuple[float, float]:
    """Recall and precision, means over the cameras."""
    return mean(rows, "recall"), min(max(mean(rows, "precision"), 1.0 - NEAREST), NEAREST)


def by(rows: list[Row], column: str) -> dict[str, list[Row]]:
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(row[column], []).append(row)
    return groups


def draw(results: Results, folder: Path) -> list[Path]:
    result = with_columns(results.any_of((TABLE,))[0], "marcher", "check", "thickness_m", "precision", "recall")
    size = size_shown(result.rows)
    rows = [r for r in of_size(result.rows, size) if number(r, "precision") is not None and number(r, "recall") is not None]
    if not rows:
        raise Skip(f"{result.table.path} has no precision and recall")
    scenes = scenes_of(rows)
    figure, axes = style.panels((len(scenes) + 1) // 2, min(2, len(scenes)), 2.5)
    for axis in axes[len(scenes):]:
        axis.set_visible(False)
    least = min(place(group)[1] for group in by(rows, "precision").values())
    strict: dict[str, str] = {}
    for axis, scene in zip(axes, scenes):
        for marcher, members in by([r for r in rows if r["scene"] == scene], "marcher").items():
            if marcher in CURVES:
                _, color, marker = CURVES[marcher]
                for check, checked in by(members, "check").items():
                    curve = sorted(by(checked, "thickness_m").items(), key=lambda item: float(item[0]))
                    places = [place(group) for _, group in curve]
                    axis.plot([p[0] for p in places], [p[1] for p in places], color=color, marker=marker, markersize=3,
                              linestyle="-" if check == "none" else ":")
                    for at in (0, -1):
                        axis.annotate(f"{float(curve[at][0]):g} m", places[at], xytext=(3, 3), textcoords="offset points", fontsize=6)
                continue
            color = strict.setdefault(marcher, (style.BLUE, style.GREEN, style.PURPLE, style.SKY)[len(strict) % 4])
            for check, checked in by(members, "check").items():
                recall, precision = place(checked)
                axis.plot(recall, precision, color=color, marker=CHECKS.get(check, "X"), linestyle="", markersize=6)
        nines(axis, least)
        axis.set(title=scene, xlabel="recall", ylabel="precision, % (logit scale)")
    style.letter(axes[:len(scenes)])
    handles = [Line2D([], [], color=color, marker=marker, markersize=3, label=label)
               for name, (label, color, marker) in CURVES.items() if name in by(rows, "marcher")]
    handles += [Line2D([], [], color=color, marker="o", linestyle="", label=f"strict: {name}") for name, color in strict.items()]
    handles += [Line2D([], [], color="0.3", marker=CHECKS[check], linestyle="", label=f"check: {check}")
                for check in CHECKS if check in by(rows, "check")]
    style.finish(figure, handles, f"{result.name}.csv, {size[0]}x{size[1]}; means over the cameras; numbers at a curve's ends: thickness")
    return style.save(figure, folder, "ssrm_thickness")
