#!/usr/bin/python3
"""Tests scripts/tables.py on a table small enough for means by hand, and on tables that it must refuse."""

import re
import tempfile
import unittest
from pathlib import Path

from synthetic import SSRM, changed, run, write


class Tables(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name)

    def table(self) -> Path:
        return write(self.root, "ssrm_tables", [
            changed(SSRM, camera="front", t_ss_ms=4, t_hw_ms=10, alpha=0.25),
            changed(SSRM, camera="side", t_ss_ms=5, t_hw_ms=13, alpha=0.5),
            changed(SSRM, camera="front", width=1920, height=1080, t_ss_ms=9, t_hw_ms=""),
            changed(SSRM, scene="street", camera="front", t_ss_ms=7, speedup_sequential=1.5)])

    def line(self, output: str, title: str, start: str) -> list[str]:
        block = output[output.index(title):].split("\n\n")[0]
        found = next(line for line in block.splitlines() if line.startswith(start))
        return re.split(r"\s{2,}", found.strip())

    def test_prints_means_over_cameras_beside_the_papers_numbers(self):
        output = run("tables.py", self.table()).stdout
        self.assertIn("4 points, 3 cameras of 2 scenes, 2 threads", output)
        self.assertEqual(self.line(output, "Table 1. SSRM time", "scene"), ["scene", "1280x720", "1920x1080"])
        self.assertEqual(self.line(output, "Table 1. SSRM time", "sphere"), ["sphere", "4.500", "9.000"])
        self.assertEqual(self.line(output, "Table 1. SSRM time", "street"), ["street", "7.000"])
        self.assertEqual(self.line(output, "Table 1. SSRM time", "paper"), ["paper (GPU)", "0.212", "0.503"])
        self.assertEqual(self.line(output, "Table 2. General tracer", "sphere: fastest"), ["sphere: fastest mode", "11.50"])
        self.assertEqual(self.line(output, "Table 2. General tracer", "  paper, Bistro"), ["paper, Bistro (GPU)", "7.65", "9.63"])
        self.assertEqual(self.line(output, "Table 3. Speedup", "street: estimate, seq"),
                         ["street: estimate, sequential (paper's formula)", "1.500"])
        self.assertEqual(self.line(output, "Table 3. Speedup", "  paper, Sphere"), ["paper, Sphere (GPU)", "1.083", "1.025"])
        self.assertEqual(self.line(output, "mean alpha 0.31", "sphere 1280x720")[1:3], ["0.375", "0.500"])

    def test_settings_that_a_run_swept_are_never_averaged_together(self):
        path = write(self.root, "ssrm_derivatives", [
            changed(SSRM, scene=scene, camera=camera, derivatives=d, t_ss_ms=t)
            for scene, camera, d, t in (("sphere", "front", "plane", 4), ("sphere", "front", "difference", 40),
                                        ("street", "front", "plane", 6), ("sphere", "side", "plane", 5),
                                        ("sphere", "side", "difference", 50))])
        output = run("tables.py", path).stdout
        self.assertIn("5 points, 3 cameras of 2 scenes", output)
        block = output[output.index("Table 1."):].split("\n\n")[0].splitlines()
        self.assertEqual([re.split(r"\s{2,}", line) for line in block[3:6]],
                         [["sphere, plane", "4.500"], ["sphere, difference", "45.000"], ["street, plane", "6.000"]])
        self.assertEqual(self.line(output, "Table 2. General tracer", "  paper, Bistro"), ["paper, Bistro (GPU)", "7.65"])

    def test_prints_the_same_cells_as_latex(self):
        output = run("tables.py", "--latex", self.table()).stdout
        self.assertIn(r"\caption{SSRM time, ms}", output)
        self.assertIn("sphere & 4.500 & 9.000 \\\\", output)
        self.assertIn(r"\quad paper, Sphere (GPU) & 1.083 & 1.025 \\", output)
        self.assertIn(r"& alpha max & precision & recall & \shortstack[r]{miss \\ fraction} &", output)
        self.assertEqual(output.count(r"\begin{tabular}"), 4)
        self.assertEqual(output.count(r"\end{table}"), 4)
        self.assertEqual(output.count("{"), output.count("}"))
        self.assertEqual(output.count(r"\addlinespace"), 2, "between the scenes of Tables 2 and 3")

    def refused(self, path: Path) -> str:
        done = run("tables.py", path)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr.count("\n"), 1)
        return done.stderr

    def test_names_file_and_column_of_what_it_cannot_use(self):
        path = write(self.root, "no_column", [{k: v for k, v in SSRM.items() if k != "t_hw_ms"}])
        self.assertEqual(self.refused(path), f"tables: {path}: column t_hw_ms is missing\n")
        path = write(self.root, "no_number", [SSRM, changed(SSRM, alpha="much")])
        self.assertEqual(self.refused(path), f"tables: {path}:3: column alpha: 'much' is not a finite number\n")
        path = write(self.root, "nan", [changed(SSRM, recall="nan")])
        self.assertIn(f"{path}:2: column recall: 'nan'", self.refused(path))
        path = write(self.root, "no_size", [changed(SSRM, width="")])
        self.assertIn(f"{path}:2: column width: '' is not a whole number", self.refused(path))

    def test_refuses_torn_empty_and_missing_files(self):
        path = self.table()
        path.write_text(path.read_text()[:-40])
        self.assertRegex(self.refused(path), rf"{re.escape(str(path))}:5: \d+ cells where the header has {len(SSRM)}")
        path.write_text(",".join(SSRM) + "\n")
        self.assertIn(f"{path}: no rows", self.refused(path))
        path.write_text("")
        self.assertIn(f"{path}: empty, not even a header", self.refused(path))
        path.write_bytes(b"scene\n\xff\xfe\n")
        self.assertIn(f"{path}: not UTF-8 at byte 6", self.refused(path))
        self.assertIn("No such file", self.refused(self.root / "nowhere.csv"))


if __name__ == "__main__":
    unittest.main()
