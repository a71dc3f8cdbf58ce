#!/usr/bin/python3
"""Tests scripts/caustics_fit.py on tables whose cost per light is known."""

import csv
import random
import re
import subprocess
import sys
import tempfile
import unittest
from collections.abc import Callable
from pathlib import Path

sys.dont_write_bytecode = True
SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "caustics_fit.py"
sys.path.insert(0, str(SCRIPT.parent))
import fitting  # noqa: E402


def table_of_lights(time: Callable[[int, int], float], noise: float, **keys: str) -> list[dict]:
    generator = random.Random(7)
    return [{"scene": "lamps", "rays_per_texel": "1", "mirror_depth": "1", **keys, "lights_visible": v, "lights_invisible": i,
             "total_ms": time(v, i) + generator.gauss(0.0, noise), "total_spread_ms": 1.349 / 1.2533 * noise * 3.0,
             "repeats": 9, "relmse": 0.1}
            for v in (0, 1, 2, 4, 8) for i in (0, 1, 2, 4, 8)]


class CausticsFit(unittest.TestCase):
    def output(self, rows: list[dict]) -> str:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "lights.csv"
            with path.open("w", newline="") as file:
                writer = csv.DictWriter(file, list(rows[0]))
                writer.writeheader()
                writer.writerows(rows)
            done = subprocess.run(["/usr/bin/python3", str(SCRIPT), str(path)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def fitted(self, output: str, name: str) -> tuple[float, float, float]:
        match = re.search(rf"^\| {re.escape(name)}[^|]*\| ([-.\d]+) \| ([-.\d]+) to ([-.\d]+) \|", output, re.MULTILINE)
        self.assertIsNotNone(match, output)
        return float(match[1]), float(match[2]), float(match[3])

    def test_finds_the_cost_of_each_light_with_an_interval_about_it(self):
        noise = 0.05
        output = self.output(table_of_lights(lambda v, i: 2.5 * v + 1.5 * i + 4.0, noise))
        # Standard error of a slope: noise / sqrt(sum of squared deviations) = 0.05 / sqrt(5 * 40) = 0.0035.
        for name, truth in (("a: visible", 2.5), ("b: invisible", 1.5)):
            value, low, high = self.fitted(output, name)
            self.assertAlmostEqual(value, truth, delta=4 * 0.0035)
            self.assertLess(low, value)
            self.assertGreater(high, value)
            self.assertLess(high - low, 6 * 0.0035)
        self.assertAlmostEqual(self.fitted(output, "b / a")[0], 0.6, delta=0.01)
        self.assertIn("| 1.30 |", output)
        self.assertIn("| 0.81 |", output)
        self.assertIn("do not matter", output)
        residual = float(re.search(r"Residual of the linear model: ([.\d]+) ms", output)[1])
        self.assertAlmostEqual(residual, noise, delta=noise * 4 / (2 * 22) ** 0.5)
        self.assertIn("repeats: 0.050 ms RMS", output)  # the table's spread stands for a median's error of the noise

    def test_finds_a_cost_that_bends(self):
        output = self.output(table_of_lights(lambda v, i: 2.5 * v + 1.5 * i + 4.0 + 0.05 * v * v, 0.05))
        self.assertIn("ms) matter:", output)
        self.assertAlmostEqual(float(re.search(r"visible² ([-+.\d]+),", output)[1]), 0.05, delta=0.005)

    def test_fits_each_scene_by_itself(self):
        rows = table_of_lights(lambda v, i: 2 * v + i + 1.0, 0.01) + \
            table_of_lights(lambda v, i: 4 * v + 3 * i + 1.0, 0.01, scene="atrium")
        first, second = self.output(rows).split("### Cost of lights (scene=atrium)")
        self.assertAlmostEqual(self.fitted(first, "a: visible")[0], 2.0, delta=0.01)
        self.assertAlmostEqual(self.fitted(second, "a: visible")[0], 4.0, delta=0.01)

    def test_says_when_the_lights_do_not_determine_the_fit(self):
        rows = [r for r in table_of_lights(lambda v, i: v + i + 1.0, 0.01) if r["lights_visible"] == r["lights_invisible"]]
        self.assertIn("do not determine a, b and c", self.output(rows))
        self.assertIn("No fit of the lights", self.output(rows[:2]))

    def test_shows_error_and_time_against_rays_per_texel_and_marks_the_floor(self):
        rows = [{"scene": "ring", "mirror_depth": "3", "rays_per_texel": str(r), "lights_visible": 1, "lights_invisible": 0,
                 "total_ms": 2.0 * r, "total_spread_ms": 0.1, "repeats": 5, "relmse": 0.1 / r, "reference_relmse": 0.01}
                for r in (4.0, 0.5, 1.0)]
        output = self.output(rows)
        self.assertIn("Fig. 7", output)
        self.assertNotIn("Fig. 8", output)
        lines = [line for line in output.splitlines() if re.match(r"\| \d", line)]
        self.assertEqual([line.split("|")[1].strip() for line in lines], ["0.5", "1.0", "4.0"])
        self.assertEqual([line.split("|")[-2].strip() for line in lines], ["1", "2", "8"])
        self.assertEqual(["floor" in line for line in lines], [False, False, True])

    def test_leaves_out_points_without_caustics_and_columns_without_numbers(self):
        rows = [{"scene": "ring", "caustics": on, "mirror_depth": depth, "lights_visible": 1, "lights_invisible": 0,
                 "total_ms": 2.0 if on == "true" else "", "total_spread_ms": 0.1, "repeats": 5, "relmse": "",
                 "truncated_fraction": 0.5 / depth if on == "true" else ""} for depth in (1, 2) for on in ("true", "false")]
        output = self.output(rows)
        self.assertIn("2 points.", output)
        self.assertEqual(output.count("Fig. 8"), 1)
        self.assertIn("| mirror_depth | total_ms | truncated_fraction | time / first |", output)
        self.assertIn("| 2 | 2 | 0.25 | 1 |", output)
        for row in rows:  # without times
            row["total_ms"] = ""
        self.assertIn("| mirror_depth | truncated_fraction |\n", self.output(rows))

    def test_refuses_another_table(self):
        for content in ("", "scene,t_ss_ms\nsphere,1\n"):
            with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
                file.write(content)
                file.flush()
                done = subprocess.run(["/usr/bin/python3", str(SCRIPT), file.name], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn("caustics_fit: ", done.stderr)
        self.assertEqual(subprocess.run(["/usr/bin/python3", str(SCRIPT), "nowhere.csv"], capture_output=True).returncode, 2)

    def test_tail_of_f_is_that_of_printed_tables(self):
        for value, d1, d2, tail in ((3.7083, 3, 10, 0.05), (4.9646, 1, 10, 0.05), (3.4928, 2, 20, 0.05),
                                    (6.5523, 3, 10, 0.01), (161.4476, 1, 1, 0.05), (4.8166, 3, 22, 0.01)):
            self.assertAlmostEqual(fitting.f_tail(value, d1, d2), tail, delta=1e-3 * tail + 2e-5, msg=f"F({d1}, {d2})")


    def test_quantiles_of_t_are_those_of_printed_tables(self):
        for freedom, quantile in ((1, 12.7062), (2, 4.3027), (4, 2.7764), (5, 2.5706), (10, 2.2281), (30, 2.0423)):
            self.assertAlmostEqual(fitting.t_quantile_975(freedom), quantile, delta=1e-3 * quantile, msg=str(freedom))

    def test_interval_of_a_mean_is_students(self):
        # 1, 2, 3: mean 2, standard deviation 1, t(2) = 4.3027, half = 4.3027 / sqrt(3).
        mean, low, high = fitting.mean_interval([1.0, 2.0, 3.0])
        self.assertAlmostEqual(mean, 2.0)
        self.assertAlmostEqual(high - mean, 2.4841, delta=2e-3)
        self.assertAlmostEqual(mean - low, high - mean)
        self.assertEqual(fitting.mean_interval([0.3]), (0.3, 0.3, 0.3))


if __name__ == "__main__":
    unittest.main()
