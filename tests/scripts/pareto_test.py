#!/usr/bin/python3
"""Tests scripts/figures/pareto.py against the definitions, applied to all pairs."""

import random
import unittest

import synthetic  # noqa: F401  (finds the scripts)
from figures.pareto import Setting, fastest_within, front, most_exact_within


def beats(a: Setting, b: Setting) -> bool:
    return a.time <= b.time and a.error <= b.error and (a.time < b.time or a.error < b.error)


class Pareto(unittest.TestCase):
    def setUp(self):
        generator = random.Random(11)
        # Few different values, so that ties of both kinds and duplicates occur.
        self.sets = [[Setting("", str(i), generator.randint(1, size), generator.randint(0, size)) for i in range(n)]
                     for n in (1, 2, 3, 7, 20) for size in (2, 6, 40) for _ in range(40)]

    def test_front_is_what_no_other_setting_beats(self):
        for settings in self.sets:
            expected = [s for s in settings if not any(beats(other, s) for other in settings)]
            self.assertCountEqual(front(settings), expected)
            times = [s.time for s in front(settings)]
            self.assertEqual(times, sorted(times))

    def test_front_does_not_depend_on_the_order(self):
        for settings in self.sets:
            self.assertCountEqual(front(settings[::-1]), front(settings))

    def test_equal_time_and_equal_error_read_the_best_that_qualifies(self):
        for settings in self.sets:
            for at in settings:
                exact, fast = most_exact_within(settings, at.time), fastest_within(settings, at.error)
                self.assertLessEqual(exact.time, at.time)
                self.assertLessEqual(fast.error, at.error)
                for other in settings:
                    self.assertFalse(other.time <= at.time and other.error < exact.error)
                    self.assertFalse(other.error <= at.error and other.time < fast.time)

    def test_nothing_qualifies_below_the_least(self):
        settings = [Setting("", "", 2.0, 3.0)]
        self.assertIsNone(most_exact_within(settings, 1.9))
        self.assertIsNone(fastest_within(settings, 2.9))
        self.assertEqual(front([]), [])


if __name__ == "__main__":
    unittest.main()
