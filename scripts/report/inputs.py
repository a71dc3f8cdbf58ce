"""Finds and reads the runs in a results folder: each a table with its manifest beside it."""

import csv
import io
import json
from dataclasses import dataclass, field
from pathlib import Path

from report.errors import InputError

NOT_RUNS = {"figures", "gates", "pictures"}


@dataclass
class Run:
    name: str
    folder: Path
    manifest: dict = field(default_factory=dict)
    header: list[str] = field(default_factory=list)
    rows: list[dict[str, str]] = field(default_factory=list)
    table: Path | None = None   # None: no point was done
    interrupted: bool = False   # read from what a stopped run left

    def part(self, *names: str) -> dict:
        """A nested object of the manifest; empty where it is missing."""
        value = self.manifest
        for name in names:
            value = value.get(name) if isinstance(value, dict) else None
        return value if isinstance(value, dict) else {}

    @property
    def experiment(self) -> str:
        return str(self.part("config").get("experiment", ""))


def read_text(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{file}: not UTF-8 at byte {error.start}") from error


def read_manifest(file: Path) -> dict:
    try:
        manifest = json.loads(read_text(file))
    except json.JSONDecodeError as error:
        raise InputError(f"{file}:{error.lineno}:{error.colno}: not JSON: {error.msg}") from error
    if not isinstance(manifest, dict):
        raise InputError(f"{file}: expected an object with the parts config, program, machine and run")
    return manifest


def read_table(file: Path, growing: bool) -> tuple[list[str], list[dict[str, str]]]:
    """Header and rows. The last line of a growing table may be torn and is then left out."""
    text = read_text(file)
    if growing:
        text = text[:text.rfind("\n") + 1]
    reader = csv.reader(io.StringIO(text, newline=""), strict=True)
    try:
        header = next(reader, [])
        rows = []
        for cells in reader:
            if len(cells) != len(header):
                raise InputError(f"{file}:{reader.line_num}: {len(cells)} cells, but the header has {len(header)}")
            rows.append(dict(zip(header, cells)))
    except csv.Error as error:
        raise InputError(f"{file}:{reader.line_num}: not CSV: {error}") from error
    if not header:
        raise InputError(f"{file}: empty, not even a header")
    if len(set(header)) < len(header):
        raise InputError(f"{file}:1: a column name is there twice")
    return header, rows


def read_run(folder: Path, name: str) -> Run:
    """The table NAME.csv, or where there is none NAME.csv.partial, with the manifest of the same state."""
    table, growing = folder / f"{name}.csv", folder / f"{name}.csv.partial"
    manifest, stopped = folder / "manifest.json", folder / "manifest.json.partial"
    run = Run(name, folder, interrupted=not table.exists() and (growing.exists() or stopped.exists()))
    run.table = next((file for file in (table, growing) if file.exists()), None)
    if run.table:
        run.header, run.rows = read_table(run.table, growing=run.table == growing)
    for file in (stopped, manifest) if run.interrupted else (manifest,):
        if file.exists():
            run.manifest = read_manifest(file)
            break
    return run


def names_in(folder: Path) -> list[str]:
    """Runs of one folder: the one that its manifest names, or each table where there is no manifest."""
    for file in (folder / "manifest.json", folder / "manifest.json.partial"):
        if file.exists():
            config = read_manifest(file).get("config")
            if not isinstance(config, dict) or not isinstance(config.get("file"), str):
                raise InputError(f"{file}: /config/file: expected the name of the config")
            return [Path(config["file"]).stem]
    return sorted({file.name.split(".csv")[0] for pattern in ("*.csv", "*.csv.partial") for file in folder.glob(pattern)})


def read_runs(results: Path) -> list[Run]:
    """Every run in `results` itself and in its folders, by name. Throws InputError where there is none."""
    if not results.is_dir():
        raise InputError(f"{results}: no such folder")
    folders = [results, *sorted(f for f in results.iterdir() if f.is_dir() and f.name not in NOT_RUNS)]
    runs = [read_run(folder, name) for folder in folders for name in names_in(folder)]
    if not runs:
        raise InputError(f"{results}: no table and no manifest in it or in its folders; `hybray run CONFIG` writes them")
    return runs
