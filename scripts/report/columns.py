"""What a table's columns mean, which of them to show first, and how their cells read."""

import re
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from csv_table import is_number
from inputs import InputError

# Columns to show first of the experiments that are known, in this order; each where it has values.
HEADLINES = {
    "ssrm": ["alpha", "precision", "speedup_measured", "speedup_measured_vs_single", "t_ss_ms", "t_hw_ms"],
    "caustics": ["relmse", "energy_ratio", "flip", "closed_form_error_fraction", "closed_form_z", "total_ms",
                 "main_view_ratio", "efficiency"],
}
HEADLINES_AT_MOST = 6


@dataclass(frozen=True)
class Column:
    name: str
    unit: str = ""
    kind: str = "key"
    better: str = ""
    text: str = ""


def markdown_cells(line: str) -> list[str]:
    """Cells of one line of a Markdown table, whose own bars are written \\|."""
    return [cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]


def parse_description(markdown: str) -> list[Column]:
    """Columns from the output of `hybray describe EXPERIMENT --markdown`."""
    columns: list[Column] = []
    head: list[str] = []
    for line in markdown.splitlines():
        cells = markdown_cells(line) if line.startswith("|") else []
        if cells[:1] == ["column"]:
            head = cells
        elif head and len(cells) == len(head) and set(cells[0]) != {"-"}:
            said = dict(zip(head, cells))
            columns.append(Column(said["column"], said.get("unit", ""), said.get("kind", "key"), said.get("better", ""),
                                  said.get("meaning", "")))
    return columns


def describe(program: Path, experiment: str) -> list[Column]:
    """Asks the program. Throws InputError where it cannot be run or does not answer."""
    command = [str(program), "describe", experiment, "--markdown"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise InputError(f"{program}: {getattr(error, 'strerror', None) or error}") from error
    if done.returncode != 0:
        raise InputError(f"{' '.join(command)}: {done.stderr.strip() or f'exit code {done.returncode}'}")
    return parse_description(done.stdout)


def guessed(name: str, values: Iterable[str], parameters: Iterable[str]) -> Column:
    """A column that nobody described: parameters and words are keys, the suffix tells a time."""
    if name in parameters or not all(is_number(v) for v in values if v):
        return Column(name)
    return Column(name, "ms", "time") if name.endswith("_ms") else Column(name, "", "metric")


def number_text(text: str, digits: int = 4) -> str:
    """A number in `digits` significant digits, or an integer in full; what is no number stays as it is."""
    if not is_number(text):
        return text
    if re.fullmatch(r"[-+]?\d+", text):
        return f"{int(text):,}"
    value = float(text)
    if value != 0.0 and not 1e-3 <= abs(value) < 1e6:
        return f"{value:.{digits - 1}e}"
    shown = f"{value:#.{digits}g}".rstrip(".") if abs(value) < 10**digits else f"{value:,.0f}"
    return "0" if value == 0.0 else shown


def folded_into(name: str, names: Iterable[str]) -> str | None:
    """The column in whose cells this one is shown: X for X_low and X_high, X_ms for X_spread_ms."""
    for suffix, stem in (("_low", ""), ("_high", ""), ("_spread_ms", "_ms")):
        host = name.removesuffix(suffix) + stem
        if name.endswith(suffix) and host in names:
            return host
    return None


def headline(columns: list[Column], experiment: str, filled: Iterable[str]) -> list[str]:
    """Names of the columns to show first: those chosen for the experiment, else the first that know what is better."""
    filled = set(filled)
    if experiment in HEADLINES:
        return [name for name in HEADLINES[experiment] if name in filled][:HEADLINES_AT_MOST]
    measured = [c for c in columns if c.name in filled and c.kind in ("metric", "time")]
    judged = [c for c in measured if c.better]
    return [c.name for c in (judged or measured)][:HEADLINES_AT_MOST]
