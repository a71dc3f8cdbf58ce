"""The tables of one results folder, with their manifests and pictures."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from csv_table import Row, Table, TableError, read_table
from grouping import KEYS


class Skip(Exception):
    """Why a figure cannot be made from what is there."""


@dataclass(frozen=True)
class Result:
    """One table, with the pictures and the manifest beside it."""

    table: Table
    manifest: dict

    @property
    def name(self) -> str:
        return self.table.path.stem

    @property
    def rows(self) -> list[Row]:
        return self.table.rows

    @property
    def keys(self) -> list[str]:
        """The parameters, those of the config's sweep included, as columns."""
        swept = self.manifest.get("config", {}).get("sweep", {})
        return [k for k in dict.fromkeys([*KEYS, *swept]) if k in self.table.columns]

    @property
    def machine(self) -> str:
        """What measured the times, for a legend."""
        cpu = self.manifest.get("machine", {}).get("cpu", "")
        threads = self.rows[0].get("threads", "")
        return ", ".join(part for part in (cpu, f"{threads} threads" if threads else "") if part)

    def picture(self, row: Row, kind: str = "") -> Path | None:
        """The picture that the program wrote of a point (`kind`: the end of its name, such as off), if it did."""
        parts = (row["scene"], row["camera"], f"{row['width']}x{row['height']}", row["id"], *([kind] if kind else []))
        path = self.table.path.parent / "pictures" / ("_".join(parts) + ".png")
        return path if path.is_file() else None


class Results:
    """The tables of a folder of runs, RESULTS/RUN/TABLE.csv, or of one run, RESULTS/TABLE.csv; read when they are asked for."""

    def __init__(self, root: Path, leave_out: Path):
        self.root = root
        self.paths: dict[str, Path] = {}
        for path in sorted([*root.glob("*.csv"), *root.glob("*/*.csv")]):
            if path.parent == leave_out:
                continue
            if path.stem in self.paths:
                raise TableError(f"{root}: two tables are named {path.name}: {self.paths[path.stem]} and {path}")
            self.paths[path.stem] = path
        self.read: dict[str, Result] = {}

    def get(self, name: str) -> Result:
        if name not in self.paths:
            raise Skip(f"no {name}.csv in {self.root}")
        if name not in self.read:
            path = self.paths[name]
            self.read[name] = Result(read_table(path), manifest_beside(path))
        return self.read[name]

    def any_of(self, names: Sequence[str]) -> list[Result]:
        """Those of the named tables that are there; Skip where none is."""
        found = [self.get(name) for name in names if name in self.paths]
        if not found:
            raise Skip(f"no {' or '.join(f'{name}.csv' for name in names)} in {self.root}")
        return found


def manifest_beside(path: Path) -> dict:
    manifest = path.parent / "manifest.json"
    try:
        content = json.loads(manifest.read_text(encoding="utf-8")) if manifest.is_file() else {}
    except (OSError, ValueError) as error:
        raise TableError(f"{manifest}: not a manifest ({error})") from error
    if not isinstance(content, dict):
        raise TableError(f"{manifest}: not a manifest (not an object)")
    return content
