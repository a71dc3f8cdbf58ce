"""Ticks of axes that are not linear: at round or given values, as many as their labels have room for."""

import math
from collections.abc import Callable
from functools import lru_cache

from matplotlib import rcParams, ticker
from matplotlib.axis import Axis
from matplotlib.textpath import TextPath
from numpy import asarray

Choices = Callable[[float, float], list[list[float]]]  # of an axis from the first to the second value
MOST = 6  # labels of an axis at round values


def written(value: float, _: int = 0) -> str:
    """A plain number; with a power of ten where that would be long."""
    if value == 0.0 or 1e-3 <= abs(value) < 1e4:
        return f"{value:g}"
    power = math.floor(math.log10(abs(value)) + 1e-9)
    mantissa = value / 10.0 ** power
    return rf"$10^{{{power}}}$" if abs(mantissa - 1.0) < 1e-9 else rf"${mantissa:g}\times10^{{{power}}}$"


@lru_cache
def width(label: str, size: float) -> float:
    return TextPath((0.0, 0.0), label, size=size).get_extents().width


class RoomyTicks(ticker.Locator):
    """Of several choices of ticks the one with the most labels that do not touch."""

    def __init__(self, choices: Choices, scale: ticker.Locator):
        self.choices = choices
        self.nonsingular = scale.nonsingular  # which limits the scale can show

    def __call__(self) -> list[float]:
        low, high = sorted(self.axis.get_view_interval())
        shown = [[t for t in ticks if low <= t <= high] for ticks in self.choices(low, high)]
        return max((ticks for ticks in shown if self.have_room(ticks)), key=len, default=[])

    def have_room(self, ticks: list[float]) -> bool:
        axis, box, across = self.axis, self.axis.axes.bbox, self.axis.axis_name == "x"
        low, high = axis.get_view_interval()
        start, *places, end = axis.get_transform().transform(asarray([low, *ticks, high]))
        length = (box.width if across else box.height) * 72.0 / axis.axes.figure.dpi  # points
        places = [length * (place - start) / (end - start) for place in places]
        font = rcParams[f"{axis.axis_name}tick.labelsize"]
        sizes = [width(label, font) if across else font for label in axis.get_major_formatter().format_ticks(ticks)]
        return all(abs(b - a) > 0.5 * (s + t + font) for a, b, s, t in zip(places, places[1:], sizes, sizes[1:]))


def set_ticks(axis: Axis, choices: Choices) -> None:
    axis.set_major_locator(RoomyTicks(choices, axis.get_major_locator()))
    axis.set_major_formatter(ticker.FuncFormatter(written))
    axis.set_minor_formatter(ticker.NullFormatter())


def plain_ticks(axis: Axis, values: list[float]) -> None:
    """Ticks at exactly these values; where they are crowded, labels at every second, fourth, ... of them."""
    axis.set_minor_locator(ticker.FixedLocator(values))
    set_ticks(axis, lambda low, high: [values[::2 ** k] for k in range(len(values).bit_length())])


def log_ticks(axis: Axis) -> None:
    """A few labels at round values of a logarithmic axis."""
    set_ticks(axis, round_values)


def log_ticks_and_zero(axis: Axis, least: float) -> None:
    """The same for an axis that is logarithmic from `least` up, and ends in zero."""
    axis.set_minor_locator(ticker.NullLocator())
    set_ticks(axis, lambda low, high: [[0.0, *ticks] for ticks in round_values(least, high)])


def round_values(low: float, high: float) -> list[list[float]]:
    """Choices of values between two positive ones, the roundest first."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    every = [("1", step) for step in (3, 2, 1)]
    within = [(digits, 1) for digits in ("1 3", "1 2 5", "1 1.5 2 3 5 7", "1 1.2 1.5 2 3 4 5 7")]
    choices = [[float(f"{d}e{k}") for k in powers if k % step == 0 for d in digits.split()] for digits, step in [*every, *within]]
    if high < 3.0 * low:  # nearly linear
        choices += [list(ticker.MaxNLocator(n, steps=[1, 2, 5, 10]).tick_values(low, high)) for n in (2, 3, 4, 5)]
    inside = [[t for t in ticks if low <= t <= high] for ticks in choices]
    return [ticks for ticks in inside if len(ticks) <= MOST]
