"""The table of a run as the page shows it, and its headline numbers."""

from dataclasses import dataclass
from statistics import median

from csv_table import is_number
from report.columns import Column, folded_into, guessed, headline, number_text
from report.runs import Run


@dataclass
class Cell:
    text: str           # as shown
    value: str          # as in the table, to sort by
    interval: str = ""  # beside it: "0.31 to 0.35", "± 0.2"


@dataclass
class ShownColumn:
    column: Column
    numeric: bool
    sets: str  # which choices of columns show it: some of "main metric time", besides all
    interval_width: int = 0  # characters of its widest interval


@dataclass
class Figure:
    """A headline number: median over the rows that have it, with their range."""
    column: Column
    value: float
    text: str
    range: str


@dataclass
class Table:
    columns: list[ShownColumn]
    rows: list[list[Cell]]
    constants: list[tuple[str, str]]  # columns with one value in every row
    empty: list[str]                  # columns without any value
    headline: list[Figure]
    by_key: str                       # the key whose values `groups` are, or ""
    groups: list[tuple[str, list[Figure | None]]]

    def range_width(self, at: int) -> int:
        """Characters of the widest range in a column of `groups`."""
        return max((len(figures[at].range) for _, figures in self.groups if figures[at]), default=0)


def declared_columns(run: Run, described: list[Column]) -> list[Column]:
    """The table's columns in its order, described where the experiment does."""
    known = {column.name: column for column in described}
    parameters = {"id", "scene", "camera", *run.part("config", "parameters"), *run.part("config", "sweep")}
    return [known.get(name) or guessed(name, (row[name] for row in run.rows), parameters) for name in run.columns]


def figure(column: Column, rows: list[dict[str, str]]) -> Figure | None:
    values = [float(row[column.name]) for row in rows if is_number(row[column.name])]
    if not values:
        return None
    middle, low, high = (number_text(repr(v)) for v in (median(values), min(values), max(values)))
    return Figure(column, median(values), middle, f"{low} to {high}" if low != high else "")


def interval(row: dict[str, str], name: str) -> str:
    low, high, spread = row.get(f"{name}_low"), row.get(f"{name}_high"), row.get(f"{name.removesuffix('_ms')}_spread_ms")
    if low and high:
        return f"{number_text(low)} to {number_text(high)}"
    return f"± {number_text(spread, 2)}" if spread and name.endswith("_ms") else ""


def cell_text(column: Column, value: str) -> str:
    """Keys are what somebody chose: without added zeros, commas or lost digits, but for those of a computed one. An id may look
    like a number, and is none."""
    if column.name == "id":
        return value
    if column.kind != "key" or not is_number(value):
        return number_text(value)
    return value if len(value) <= 8 else f"{float(value):.6g}"


def tells_points_apart(run: Run, column: Column) -> bool:
    """Whether a key is among what the config sweeps, rather than a consequence; every key where no manifest says so."""
    if not run.manifest or column.name in ("scene", "camera"):
        return True
    swept = run.part("config", "sweep")
    return column.name in swept or column.name.removesuffix(f"_{column.unit}") in swept or (
        column.name in ("width", "height") and "resolution" in swept)


def make_table(run: Run, described: list[Column]) -> tuple[Table, list[Column]]:
    """The table, and its columns with what they mean."""
    columns = declared_columns(run, described)
    values = {column.name: [row[column.name] for row in run.rows] for column in columns}
    empty = [name for name, cells in values.items() if not any(cells)]
    folded = {column.name for column in columns if folded_into(column.name, values)}
    constant = {column.name for column in columns
                if len(run.rows) > 1 and column.kind in ("key", "count") and len(set(values[column.name])) == 1} - {"id"}
    first = headline(columns, run.experiment, set(values) - set(empty))

    shown = [c for c in columns if c.name not in folded and c.name not in empty and c.name not in constant and c.name != "id"]
    keys = [c for c in shown if c.kind == "key"]
    # What a row is comes first, in the table's order; then the headline numbers; then the rest.
    order = sorted(keys, key=lambda c: not tells_points_apart(run, c)) + [c for name in first for c in shown if c.name == name]
    order += [c for c in shown if c not in order] + [c for c in columns if c.name == "id"]
    sets = {c.name: " ".join((["main"] if c.name in first else []) + ([c.kind] if c.kind in ("metric", "time") else []))
            for c in order}
    sets |= {c.name: "main metric time" for c in keys if tells_points_apart(run, c)}

    by_key = next((c.name for c in keys if c.name == "scene"), keys[0].name if keys else "")
    groups = list(dict.fromkeys(values[by_key])) if by_key else []
    numbers = {c.name: c for c in columns}
    rows = [[Cell(cell_text(c, row[c.name]), row[c.name], interval(row, c.name))
             for c in order] for row in run.rows]
    return Table(
        columns=[ShownColumn(c, all(is_number(v) for v in values[c.name] if v), sets[c.name],
                             max((len(row[i].interval) for row in rows), default=0)) for i, c in enumerate(order)],
        rows=rows,
        constants=[(name, cell_text(numbers[name], values[name][0])) for name in values if name in constant and name not in empty],
        empty=[name for name in empty if name not in folded],
        headline=[f for name in first if (f := figure(numbers[name], run.rows))],
        by_key=by_key if 1 < len(groups) <= 24 else "",
        groups=[(cell_text(numbers[by_key], group), [figure(numbers[name], [row for row in run.rows if row[by_key] == group])
                                                     for name in first]) for group in groups],
    ), columns
