"""Run time against error: which settings no other one beats, and what equal time and equal error read."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Setting:
    """One way of computing: smaller is better in both."""

    method: str  # settings of one method form a curve
    value: str  # which one on that curve
    time: float  # ms
    error: float
    time_bar: tuple[float, float] = (0.0, 0.0)  # lengths below and above
    error_bar: tuple[float, float] = (0.0, 0.0)
    mark: str = ""  # stands for the value in figures and tables
    floor: bool = False  # the error says more about the reference than about the setting

    @property
    def name(self) -> str:
        return ", ".join(part for part in (self.method, self.mark) if part)


def front(settings: Sequence[Setting]) -> list[Setting]:
    """The settings that no other one beats (as fast and as exact, and better in one of the two), fastest first."""
    best: list[Setting] = []
    for s in sorted(settings, key=lambda s: (s.time, s.error)):
        if not best or s.error < best[-1].error or (s.error, s.time) == (best[-1].error, best[-1].time):
            best.append(s)
    return best


def most_exact_within(settings: Sequence[Setting], time: float) -> Setting | None:
    """Equal time: the most exact of the settings that take no longer; the faster of two that are as exact."""
    return min((s for s in settings if s.time <= time), key=lambda s: (s.error, s.time), default=None)


def fastest_within(settings: Sequence[Setting], error: float) -> Setting | None:
    """Equal error: the fastest of the settings whose error is no larger; the more exact of two that are as fast."""
    return min((s for s in settings if s.error <= error), key=lambda s: (s.time, s.error), default=None)
