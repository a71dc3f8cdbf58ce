"""Finds and reads the runs in a results folder: each a table with its manifest beside it."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from csv_table import Row, Table, read_table
from inputs import InputError, part, read_manifest, run_folders


@dataclass
class Run:
    name: str
    folder: Path
    table: Table | None = None  # None: no point was done
    manifest: dict = field(default_factory=dict)
    interrupted: bool = False   # read from what a stopped run left

    @property
    def columns(self) -> Sequence[str]:
        return self.table.columns if self.table else ()

    @property
    def rows(self) -> list[Row]:
        return self.table.rows if self.table else []

    def part(self, *names: str) -> dict:
        return part(self.manifest, *names)

    @property
    def experiment(self) -> str:
        return str(self.part("config").get("experiment", ""))


def read_run(folder: Path, name: str) -> Run:
    """The table NAME.csv, or where there is none NAME.csv.partial, with the manifest of the same state."""
    table, growing = folder / f"{name}.csv", folder / f"{name}.csv.partial"
    manifest, stopped = folder / "manifest.json", folder / "manifest.json.partial"
    run = Run(name, folder, interrupted=not table.exists() and (growing.exists() or stopped.exists()))
    if table.exists():
        run.table = read_table(table)
    elif growing.exists():
        run.table = read_table(growing, growing=True)
    run.manifest = read_manifest(stopped if run.interrupted and stopped.exists() else manifest)
    return run


def names_in(folder: Path) -> list[str]:
    """Runs of one folder: the one that its manifest names, or each table where there is no manifest."""
    for file in (folder / "manifest.json", folder / "manifest.json.partial"):
        if file.exists():
            name = part(read_manifest(file), "config").get("file")
            if not isinstance(name, str):
                raise InputError(f"{file}: /config/file: expected the name of the config")
            return [Path(name).stem]
    return sorted({file.name.split(".csv")[0] for pattern in ("*.csv", "*.csv.partial") for file in folder.glob(pattern)})


def read_runs(results: Path) -> list[Run]:
    """Every run in `results` itself and in its folders; those of one name are told apart by their folders."""
    runs = [read_run(folder, name) for folder in run_folders(results) for name in names_in(folder)]
    if not runs:
        raise InputError(f"{results}: no table and no manifest in it or in its folders; `hybray run CONFIG` writes them, and "
                         "`hybray merge` those of shards")
    several = Counter(run.name for run in runs)
    for run in runs:
        if several[run.name] > 1 and run.folder != results:
            run.name = f"{run.folder.name}/{run.name}"
    return runs
