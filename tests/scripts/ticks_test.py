#!/usr/bin/python3
"""Tests scripts/figures/ticks.py on axes of many lengths and ranges, by the boxes that matplotlib draws the labels in."""

import random
import unittest

import synthetic  # noqa: F401  (finds the scripts)
from figures import style
from figures.ticks import log_ticks, log_ticks_and_zero, plain_ticks, written
from matplotlib import pyplot as plt
from matplotlib.axis import Axis


def drawn(axis: Axis) -> list:
    """Labels of an axis as they stand in the figure, in its order."""
    axis.axes.figure.draw_without_rendering()
    low, high = sorted(axis.get_view_interval())
    return [tick.label1 for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high and tick.label1.get_text()]


class Ticks(unittest.TestCase):
    def setUp(self):
        self.generator = random.Random(5)
        self.addCleanup(plt.close, "all")

    def labels(self, axis: Axis) -> list[str]:
        """The labels, none of which touches the next."""
        labels = drawn(axis)
        boxes = [label.get_window_extent() for label in labels]
        for a, b in zip(boxes, boxes[1:]):
            gap = b.x0 - a.x1 if axis.axis_name == "x" else b.y0 - a.y1
            self.assertGreater(gap, 0.0, f"{[label.get_text() for label in labels]} in {axis.axes.bbox}, {axis.get_view_interval()}")
        return [label.get_text() for label in labels]

    def axis(self, name: str, low: float, high: float, inches: float) -> Axis:
        """A logarithmic axis of a figure so wide or high."""
        figure, (axes,) = style.panels(1, 1, inches if name == "y" else 2.0)
        figure.set_figwidth(inches if name == "x" else 7.0)
        axes.set(**{f"{name}scale": "log", f"{name}lim": (low, high)})
        return axes.xaxis if name == "x" else axes.yaxis

    def test_labels_of_a_log_axis_never_touch_and_there_are_at_least_two(self):
        for name in ("x", "y"):
            for _ in range(25):
                low = 10.0 ** self.generator.uniform(-6, 5)
                high = low * 10.0 ** self.generator.choice([0.02, 0.1, 0.3, 0.7, 1, 2, 4, 9])
                axis = self.axis(name, low, high, self.generator.uniform(1.4, 4.0))
                log_ticks(axis)
                self.assertIn(len(self.labels(axis)), range(2, 7))
                self.assertFalse([t for t in axis.get_minorticklabels() if t.get_text()])
                plt.close("all")

    def test_round_values_are_preferred(self):
        for low, high, expected in ((0.9, 1100, "1 10 100 1000"), (8, 120, "10 20 50 100"), (90, 310, "100 120 150 200 300"),
                                    (0.0122, 0.0128, "0.0122 0.0124 0.0126 0.0128")):
            axis = self.axis("y", low, high, 2.3)
            log_ticks(axis)
            self.assertEqual(self.labels(axis), expected.split())

    def test_an_axis_that_ends_in_zero_has_it_labelled(self):
        axis = self.axis("y", 1e-3, 1.5, 2.3)
        axis.axes.set_yscale("symlog", linthresh=0.002, linscale=0.5)
        axis.axes.set_ylim(bottom=-0.001)
        log_ticks_and_zero(axis, 0.004)
        self.assertEqual(self.labels(axis), "0 0.01 0.03 0.1 0.3 1".split())

    def test_given_values_keep_their_ticks_though_crowded_ones_lose_their_labels(self):
        values = [0.25 * 2 ** k for k in range(12)]
        axis = self.axis("x", 0.2, 600, 7.0)
        plain_ticks(axis, values)
        self.assertEqual(self.labels(axis), [written(v) for v in values])
        axis.axes.figure.set_figwidth(2.2)
        self.assertEqual(self.labels(axis), ["0.25", "1", "4", "16", "64", "256"])
        self.assertEqual(len(axis.get_major_ticks()) + len(axis.get_minor_ticks()), 12)


if __name__ == "__main__":
    unittest.main()
