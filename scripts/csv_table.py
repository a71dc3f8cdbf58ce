"""Reads the CSV tables that hybray writes, and says what is wrong with one: which file, which line, which column."""

import csv
import math
from dataclasses import dataclass
from pathlib import Path


class TableError(Exception):
    """A table that cannot be used. The message names the file and, where there is one, the column."""


class Row(dict[str, str]):
    """The cells of one row by column."""

    place = ""  # file and line, for messages


@dataclass(frozen=True)
class Table:
    path: Path
    columns: tuple[str, ...]
    rows: list[Row]

    def need(self, *columns: str) -> None:
        for column in columns:
            if column not in self.columns:
                raise TableError(f"{self.path}: column {column} is missing")

    def filled(self, column: str) -> bool:
        """Whether any row has something in the column."""
        return any(row.get(column) for row in self.rows)


def read_table(path: Path, *needed: str) -> Table:
    """The table of a file; a TableError where it is unreadable, has no row, rows of a wrong length or no such column."""
    try:
        with path.open(newline="", encoding="utf-8") as file:
            reader = csv.reader(file, strict=True)
            columns = tuple(next(reader, ()))
            rows = []
            for cells in reader:
                if len(cells) != len(columns):
                    raise TableError(f"{path}:{reader.line_num}: {len(cells)} cells where the header has {len(columns)}")
                row = Row(zip(columns, cells))
                row.place = f"{path}:{reader.line_num}"
                rows.append(row)
    except OSError as error:
        raise TableError(f"{path}: {error.strerror}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise TableError(f"{path}: not a CSV table ({error})") from error
    repeated = next((c for i, c in enumerate(columns) if c in columns[:i]), None)
    if repeated is not None:
        raise TableError(f"{path}: column {repeated} is there twice")
    table = Table(path, columns, rows)
    table.need(*needed)
    if not rows:
        raise TableError(f"{path}: no rows")
    return table


def number(row: Row, column: str) -> float | None:
    """The number of a cell; None where it is empty, which is how tables say "does not apply"."""
    cell = row.get(column)
    if not cell:
        return None
    try:
        value = float(cell)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise TableError(f"{row.place}: column {column}: '{cell}' is not a finite number")
    return value


def whole(row: Row, column: str) -> int:
    """The whole number of a cell that must have one."""
    value = number(row, column)
    if value is None or value != int(value):
        raise TableError(f"{row.place}: column {column}: '{row.get(column, '')}' is not a whole number")
    return int(value)
