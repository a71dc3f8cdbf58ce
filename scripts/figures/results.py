"""The tables of one results folder, with their manifests and pictures."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from csv_table import Row, Table, read_table
from grouping import KEYS
from inputs import InputError, part, read_manifest, run_folders


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
        return [k for k in dict.fromkeys([*KEYS, *part(self.manifest, "config", "sweep")]) if k in self.table.columns]

    @property
    def machine(self) -> str:
        """What measured the times, for a legend."""
        cpu = str(part(self.manifest, "machine").get("cpu", ""))
        threads = self.rows[0].get("threads", "")
        return ", ".join(part for part in (cpu, f"{threads} threads" if threads else "") if part)

    def picture(self, row: Row, kind: str = "") -> Path | None:
        """The picture that the program wrote of a point (`kind`: the end of its name, such as off), if it did."""
        parts = (row["scene"], row["camera"].replace("/", "-"), f"{row['width']}x{row['height']}", row["id"], *([kind] if kind else []))
        path = self.table.path.parent / "pictures" / ("_".join(parts) + ".png")
        return path if path.is_file() else None


class Results:
    """The tables of a folder of runs, RESULTS/RUN/TABLE.csv, or of one run, RESULTS/TABLE.csv; read when they are asked for."""

    def __init__(self, root: Path):
        self.root = root
        self.paths: dict[str, Path] = {}
        for path in sorted(path for folder in run_folders(root) for path in folder.glob("*.csv")):
            if path.stem in self.paths:
                raise InputError(f"{root}: two tables are named {path.name}: {self.paths[path.stem]} and {path}")
            self.paths[path.stem] = path
        self.read: dict[str, Result] = {}

    def get(self, name: str) -> Result:
        if name not in self.paths:
            raise Skip(f"no {name}.csv in {self.root}")
        if name not in self.read:
            path = self.paths[name]
            self.read[name] = Result(read_table(path), read_manifest(path.parent / "manifest.json"))
        if not self.read[name].rows:
            raise Skip(f"{self.paths[name]} has no rows")
        return self.read[name]

    def any_of(self, names: Sequence[str]) -> list[Result]:
        """Those of the named tables that are there; Skip where none is."""
        found, reasons = [], []
        for name in names:
            try:
                found.append(self.get(name))
            except Skip as reason:
                reasons.append(str(reason))
        if not found:
            raise Skip("; ".join(reasons))
        return found
