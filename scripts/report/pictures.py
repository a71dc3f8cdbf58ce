"""The pictures of a run, grouped into views that can be compared, and the bytes that the page embeds."""

import base64
import hashlib
import io
import re
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from PIL import Image, UnidentifiedImageError

from inputs import InputError
from report.runs import Run

# What the experiments write behind a point's id, and what it shows.
KINDS = {
    "": ("verdicts", "Grey: right hit, as bright as what it reflects. Red: false hit. Blue: unknown. Light blue: miss. "
                     "Black: no ray."),
    "view": ("main view", ""),
    "off": ("without caustics", ""),
    "on": ("with caustics", ""),
    "caustics": ("caustics alone", ""),
    "reference": ("reference of the caustics", ""),
    "flip": ("HDR-FLIP map", "HDR-FLIP maps: perceived difference from the reference, its exposures fixed by the reference."),
}
# Pairs to begin a comparison with, the first that a point has.
FIRST_PAIRS = [("caustics", "reference"), ("off", "on"), ("view", "")]
SMALLEST_SIDE = 64  # pixels; no picture is shrunk below, whatever the budget
NAME = re.compile(r"(?P<view>.+_\d+x\d+)_(?P<id>[0-9a-f]{16})(?:_(?P<kind>\w+))?\.(?P<type>png|exr)")


@dataclass
class Picture:
    """One image, embedded once; several labels where points wrote the same bytes."""
    key: str
    data: bytes
    width: int
    height: int
    labels: list[tuple[str, str]] = field(default_factory=list)  # (kind, point)
    uri: str = ""


@dataclass
class View:
    name: str
    pictures: list[Picture] = field(default_factory=list)
    first: tuple[str, str] = ("", "")  # keys to compare at the beginning
    notes: list[str] = field(default_factory=list)
    exr: list[tuple[str, Path]] = field(default_factory=list)

    def by_point(self) -> list[tuple[str, list[Picture]]]:
        """Pictures below the point that wrote them first."""
        points: dict[str, list[Picture]] = {}
        for picture in self.pictures:
            points.setdefault(picture.labels[0][1], []).append(picture)
        return list(points.items())

    @property
    def has_flip(self) -> bool:
        return any(kind == label_of("flip") for picture in self.pictures for kind, _ in picture.labels)


def label_of(kind: str) -> str:
    return KINDS.get(kind, (kind.replace("_", " "), ""))[0]


def open_picture(data: bytes, file: Path) -> Image.Image:
    try:
        image = Image.open(io.BytesIO(data))
        image.load()
        return image
    except (OSError, SyntaxError, UnidentifiedImageError, Image.DecompressionBombError) as error:
        raise InputError(f"{file}: not a readable picture: {error}") from error


def view_name(row: dict[str, str], stem: str) -> str:
    if row.get("scene") and row.get("camera"):
        return f"{row['scene']}, {row['camera']}, {stem.rsplit('_', 1)[1]}"
    return stem.replace("_", " ")


class Album:
    """All pictures of the page. The same bytes are embedded once for each run."""

    def __init__(self) -> None:
        self.pictures: dict[str, Picture] = {}
        self.note = ""

    def take(self, run: Run, file: Path) -> Picture:
        try:
            data = file.read_bytes()
        except OSError as error:
            raise InputError(f"{file}: {error.strerror}") from error
        key = f"picture-{run.name}-{hashlib.sha256(data).hexdigest()[:16]}"
        if key not in self.pictures:
            self.pictures[key] = Picture(key, data, *open_picture(data, file).size)
        return self.pictures[key]

    def views(self, run: Run, point_labels: dict[str, str]) -> tuple[list[View], int]:
        """Views of a run, in the order of its table, and the number of files of points that it does not have."""
        rows = {row.get("id", ""): row for row in run.rows}
        order = {identity: i for i, identity in enumerate(rows)}
        kinds = list(KINDS)
        found, strangers = [], 0
        for file in sorted((run.folder / "pictures").glob("*")):
            match = NAME.fullmatch(file.name)
            if match and match["id"] in rows:
                kind = match["kind"] or ""
                found.append((order[match["id"]], kinds.index(kind) if kind in kinds else len(kinds), match, kind, file))
            elif file.suffix in (".png", ".exr"):
                strangers += 1
        views: dict[str, View] = {}
        points: dict[tuple[str, str], dict[str, str]] = {}
        for _, _, match, kind, file in sorted(found, key=lambda f: (f[0], f[1], f[4].name)):
            view = views.setdefault(match["view"], View(view_name(rows[match["id"]], match["view"])))
            point = point_labels.get(match["id"], "")
            if match["type"] == "exr":
                view.exr.append((" · ".join(filter(None, (label_of(kind), point))), file))
                continue
            picture = self.take(run, file)
            picture.labels.append((label_of(kind), point))
            if picture not in view.pictures:
                view.pictures.append(picture)
            points.setdefault((match["view"], match["id"]), {})[kind] = picture.key
            note = KINDS.get(kind, ("", ""))[1]
            if note and note not in view.notes:
                view.notes.append(note)
        for stem, view in views.items():
            view.first = first_pair([kinds for (of, _), kinds in points.items() if of == stem],
                                    [p.key for p in view.pictures])
        return [view for view in views.values() if view.pictures or view.exr], strangers

    def encode(self, side: int, budget: int) -> None:
        """Gives every picture its data URI: without loss, shrunk where it is larger than `side` pixels. Where all
        together would take more than `budget` bytes, they are compressed with loss, then shrunk further."""
        pictures, lossy = list(self.pictures.values()), False
        while True:
            with ThreadPoolExecutor() as pool:
                uris = list(pool.map(lambda picture: data_uri(picture, side, lossy), pictures))
            if sum(map(len, uris)) <= budget or side <= SMALLEST_SIDE:
                break
            side, lossy = side // 2 if lossy else side, True
        for picture, uri in zip(pictures, uris):
            picture.uri = uri
        self.note = encoding_note(pictures, side, lossy)


def first_pair(points: list[dict[str, str]], keys: list[str]) -> tuple[str, str]:
    for a, b in FIRST_PAIRS:
        for kinds in points:
            if a in kinds and b in kinds and kinds[a] != kinds[b]:
                return kinds[a], kinds[b]
    return (keys[0], keys[1] if len(keys) > 1 else keys[0]) if keys else ("", "")


def data_uri(picture: Picture, side: int, lossy: bool) -> str:
    image = Image.open(io.BytesIO(picture.data)).convert("RGB")
    large = max(image.size) > side
    if large:
        image.thumbnail((side, side), Image.Resampling.BOX)
    buffer = io.BytesIO()
    # Without loss, more effort saves a tenth of the bytes for five times the time.
    image.save(buffer, "WEBP", lossless=not lossy, quality=90 if lossy else 20, method=4 if lossy else 2)
    data, kind = buffer.getvalue(), "webp"
    if not large and len(picture.data) <= len(data):
        data, kind = picture.data, "png"
    return f"data:image/{kind};base64,{base64.b64encode(data).decode('ascii')}"


def encoding_note(pictures: Iterable[Picture], side: int, lossy: bool) -> str:
    shrunk = sum(max(p.width, p.height) > side for p in pictures)
    parts = []
    if shrunk:
        parts.append(f"{shrunk} {'picture is' if shrunk == 1 else 'pictures are'} shown at {side} pixels along the longer side")
    if lossy:
        parts.append("pictures are compressed with loss, and differences show that too")
    return "; ".join(parts).capitalize() + "." if parts else ""
