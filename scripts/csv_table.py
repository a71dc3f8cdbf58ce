"""Reads the CSV tables that hybray writes, and says what is wrong with one: which file, which line, which column."""

import csv
import io
import math
from dataclasses import dataclass
from pathlib import Path

from inputs import InputError, read_text


class Row(dict[str, str]):
    """The cells of one row by column."""

    place = ""  # file and line, for messages


@dataclass(frozen=True)
class Table:
    path: Path
    columns: tuple[str, ...]
    rows: list[Row]

    def need(self, *columns: str) -> "Table":
        """The table itself; an InputError where it has no row, or no such column."""
        for column in columns:
            if column not in self.columns:
                raise InputError(f"{self.path}: column {column} is missing")
        if not self.rows:
            raise InputError(f"{self.path}: no rows")
        return self

    def filled(self, column: str) -> bool:
        """Whether any row has something in the column."""
        return any(row.get(column) for row in self.rows)


def read_table(path: Path, growing: bool = False) -> Table:
    """The table of a file. The last line of a growing one may be torn, and is then left out."""
    text = read_text(path)
    if growing:
        text = text[:text.rfind("\n") + 1]
    reader = csv.reader(io.StringIO(text, newline=""), strict=True)
    try:
        columns = tuple(next(reader, ()))
        rows = []
        for cells in reader:
            place = f"{path}:{reader.line_num}"
            if len(cells) != len(columns):
                raise InputError(f"{place}: {len(cells)} cells where the header has {len(columns)}")
            row = Row(zip(columns, cells))
            row.place = place
            rows.append(row)
    except csv.Error as error:
        raise InputError(f"{path}:{reader.line_num}: not CSV: {error}") from error
    if not columns:
        raise InputError(f"{path}: empty, not even a header")
    repeated = next((c for i, c in enumerate(columns) if c in columns[:i]), None)
    if repeated is not None:
        raise InputError(f"{path}:1: column {repeated} is there twice")
    return Table(path, columns, rows)


def is_number(cell: str) -> bool:
    """Whether a cell holds a finite number."""
    try:
        return math.isfinite(float(cell))
    except ValueError:
        return False


def number(row: Row, column: str) -> float | None:
    """The number of a cell; None where it is empty, which is how tables say "does not apply"."""
    cell = row.get(column)
    if not cell:
        return None
    if not is_number(cell):
        raise InputError(f"{row.place}: column {column}: '{cell}' is not a finite number")
    return float(cell)


def whole(row: Row, column: str) -> int:
    """The whole number of a cell that must have one."""
    value = number(row, column)
    if value is None or value != int(value):
        raise InputError(f"{row.place}: column {column}: '{row.get(column, '')}' is not a whole number")
    return int(value)
