"""Figures and printed tables that another script drew into RESULTS/figures."""

import base64
from dataclasses import dataclass, field
from pathlib import Path

from inputs import read_text

SVG_AT_MOST = 2_000_000  # bytes; above, the PNG beside it is shown


@dataclass
class Drawn:
    name: str
    uri: str = ""
    text: str = ""                                   # of NAME.txt
    files: list[Path] = field(default_factory=list)  # to link to


def image_uri(vector: Path | None, raster: Path | None) -> str:
    """SVG inside an <img> runs no script and loads nothing."""
    file = raster if raster and (not vector or vector.stat().st_size > SVG_AT_MOST) else vector
    if not file:
        return ""
    kind = "svg+xml" if file.suffix == ".svg" else "png"
    return f"data:image/{kind};base64,{base64.b64encode(file.read_bytes()).decode('ascii')}"


def read_figures(results: Path) -> list[Drawn]:
    files: dict[str, dict[str, Path]] = {}
    for file in sorted((results / "figures").rglob("*")):
        if file.suffix in (".svg", ".png", ".pdf", ".txt", ".tex"):
            name = file.relative_to(results / "figures").with_suffix("").as_posix()
            files.setdefault(name, {})[file.suffix] = file
    return [Drawn(name.replace("_", " ").replace("/", ": "), image_uri(of.get(".svg"), of.get(".png")),
                  read_text(of[".txt"]) if ".txt" in of else "", list(of.values())) for name, of in files.items()]
