"""The page itself: everything that was read, filled into template.html."""

import base64
import hashlib
import os
import urllib.parse
from dataclasses import dataclass, field
from pathlib import Path

import jinja2
from markupsafe import Markup

from report.columns import Column, describe
from report.figures import read_figures
from report.gates import read_gates
from report.pictures import Album, View
from report.runs import Run, read_runs
from report.summary import count, duration, failures, notes, plural, provenance, state
from report.tables import Table, make_table

PARTS = Path(__file__).resolve().parent
IN_VIEW_NAME = {"scene", "camera", "width", "height"}


@dataclass
class Section:
    """One run, with all that the page says of it."""
    run: Run
    anchor: str
    table: Table
    columns: list[Column]
    views: list[View] = field(default_factory=list)
    stale_pictures: int = 0


def point_labels(table: Table) -> dict[str, str]:
    """What tells a point from the others of its view: "rays_per_texel 2, filter none", by its id."""
    keys = [(i, s.column.name) for i, s in enumerate(table.columns)
            if s.column.kind == "key" and s.column.name not in IN_VIEW_NAME | {"id"} and s.sets]
    at = next((i for i, s in enumerate(table.columns) if s.column.name == "id"), None)
    return {} if at is None else {
        row[at].value: ", ".join(f"{name} {row[i].text}" for i, name in keys if row[i].text) for row in table.rows}


def make_section(run: Run, described: list[Column], album: Album) -> Section:
    table, columns = make_table(run, described)
    section = Section(run, "run-" + "".join(c if c.isalnum() else "-" for c in run.name), table, columns)
    section.views, section.stale_pictures = album.views(run, point_labels(table))
    return section


def glossary(sections: list[Section]) -> dict[str, list[Column]]:
    """Columns by experiment, those that say what they mean."""
    found: dict[str, dict[str, Column]] = {}
    for section in sections:
        known = found.setdefault(section.run.experiment, {})
        known.update({c.name: c for c in section.columns if c.text})
    return {experiment: list(columns.values()) for experiment, columns in found.items() if columns}


def source_hash(text: str) -> str:
    """For a Content-Security-Policy that allows just this style or script."""
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii") + "'"


def breakable(name: str) -> Markup:
    """A name, which may be broken after an underscore where it is long."""
    return Markup("_<wbr>").join(name.split("_")) if len(name) > 16 else Markup.escape(name)


def make_page(results: Path, output: Path, program: Path | None, title: str, side: int, budget: int) -> str:
    """The page's text. Throws InputError."""
    runs = read_runs(results)
    described = {name: describe(program, name) for name in sorted({r.experiment for r in runs} - {""})} if program else {}
    album = Album()
    sections = [make_section(run, described.get(run.experiment, []), album) for run in runs]
    album.encode(side, budget)
    gates = read_gates(results)

    def link(file: Path) -> str:
        return urllib.parse.quote(os.path.relpath(file.resolve(), output.resolve().parent))

    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(PARTS), autoescape=True, undefined=jinja2.StrictUndefined,
                                     trim_blocks=True, lstrip_blocks=True)
    environment.filters |= {"breakable": breakable, "duration": duration, "link": link, "plural": plural}
    environment.globals |= {"count": count, "failures": failures, "provenance": provenance, "state": state}
    style, script = ((PARTS / name).read_text(encoding="utf-8") for name in ("report.css", "report.js"))
    return environment.get_template("template.html").render(
        title=title, sections=sections, gates=gates, figures=read_figures(results), album=album,
        notes=notes(runs, gates), glossary=glossary(sections),
        style=Markup(style), script=Markup(script), style_hash=source_hash(style), script_hash=source_hash(script))
