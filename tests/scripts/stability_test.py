#!/usr/bin/python3
"""The table of breaking points, from rows whose breaking points are known."""

import tempfile
import unittest
from pathlib import Path

from synthetic import changed, run, write

POINT = {"id": "0", "scene": "corner", "camera": "floor", "width": "640", "height": "360", "marcher": "paper", "far_near_ratio": "0",
         "far_plane": "finite", "depth_convention": "reversed", "depth_format": "float32", "depth_rounding": "nearest",
         "derivatives": "plane", "scene_scale": "1", "offset_m": "0", "origin": "world", "incidence_deg": "", "jitter_x_px": "0",
         "jitter_y_px": "0", "ray_offset": "scaled", "tracer": "robust", "labels_flipped_fraction": "0.001", "depth_error_fraction": "1e-7",
         "trace_wrong_fraction": "0", "further_false_hits": "0", "march_self_hits": "0", "trace_self_hits": "0", "threads": "2"}


class BreakingPoints(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def table(self, rows):
        write(self.root, "stability", rows)
        done = run("figures.py", self.root, "--only", "stability")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = (self.root / "figures" / "stability.txt").read_text().splitlines()
        return {line[:40].strip(): line[40:].split() for line in lines}

    def test_names_the_first_value_of_an_axis_at_which_any_scene_breaks(self):
        rows = [changed(POINT, scene=scene, marcher=marcher) for scene in ("corner", "sphere") for marcher in ("paper", "plane")]
        for offset in (10, 1000, 100000):
            for scene in ("corner", "sphere"):
                for marcher in ("paper", "plane"):
                    bad = scene == "sphere" and offset >= 1000 and marcher == "plane"
                    rows.append(changed(POINT, scene=scene, marcher=marcher, offset_m=offset, labels_flipped_fraction=0.02 if bad else 0.009,
                                        further_false_hits=3 if offset == 10 else 50, trace_self_hits=1 if offset == 100000 else 0))
        found = self.table(rows)["off by a share of the coordinates"]
        # labels of paper and plane, false hits of both, stored depth, traced rays, self-hits
        self.assertEqual(found, ["-", "1000", "1000", "1000", "-", "-", "100000"])

    def test_goes_down_from_the_harmless_end_where_a_scene_shrinks(self):
        rows = [POINT] + [changed(POINT, scene_scale=s, ray_offset="fixed", trace_wrong_fraction=w)
                          for s, w in (("0.1", 0), ("0.01", 0.02), ("0.001", 0.3), ("1000", 0.5), ("10", 0))]
        write(self.root, "stability", rows)
        self.assertEqual(run("figures.py", self.root, "--only", "stability").returncode, 0)
        text = (self.root / "figures" / "stability.txt").read_text()
        larger, smaller = text.index("scene made larger (10 to 1000)"), text.index("scene made smaller (0.1 to 0.001)")
        self.assertRegex(text[larger:smaller], r"off by 0\.1 mm +- +- +- +1000 +-")
        self.assertRegex(text[smaller:], r"off by 0\.1 mm +- +- +- +0\.01 +-")

    def test_skips_a_table_without_rows_of_its_kind(self):
        write(self.root, "stability", [changed(POINT, labels_flipped_fraction="")])
        done = run("figures.py", self.root, "--only", "stability")
        self.assertEqual(done.returncode, 0)
        self.assertIn("skipped  stability", done.stdout)


if __name__ == "__main__":
    unittest.main()
