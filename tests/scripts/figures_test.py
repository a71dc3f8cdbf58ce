#!/usr/bin/python3
"""Tests scripts/figures.py: the same bytes each time, what it skips, what it refuses, and what the readings say."""

import json
import os
import re
import shutil
import tempfile
import unittest
import xml.dom.minidom
from pathlib import Path

from synthetic import CAUSTICS, LAYERS, SSRM, changed, lights, rays, run, write

import matplotlib  # noqa: E402  (after synthetic: it says where the scripts are)

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402


class Figures(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name)

    def everything(self) -> None:
        ssrm = [changed(SSRM, scene=s, camera=c, width=w, height=h, alpha=a, t_ss_ms=w / 100, id=f"{s}{c}{w}")
                for s in ("sphere", "street") for c, a in (("front", 0.3), ("side", 0.4)) for w, h in ((1280, 720), (1920, 1080))]
        write(self.root, "ssrm_tables", ssrm)
        write(self.root, "ssrm_derivatives", [changed(SSRM, derivatives=d, precision=p)
                                              for d, p in (("plane", 1), ("difference", 0.7))])
        write(self.root, "ssrm_accuracy", [changed(SSRM, scene=s, marcher=m, check=c, thickness_m=t, precision=p, recall=0.7, id=i)
                                           for s in ("sphere", "street", "atrium")
                                           for i, (m, c, t, p) in enumerate([("paper", "none", "", 0.98), ("paper", "strict", "", 1),
                                                                             ("dda", "none", 0.1, 0.8), ("dda", "none", 1, 0.6),
                                                                             ("hiz", "none", 0.1, 0.9), ("hiz", "none", 1, 0)])])
        write(self.root, "ssrm_speed", [
            changed(SSRM, marcher=m, scene=s, **{f"speedup_{d}{e}": 1 + 0.1 * len(d + m) for e in ("", "_vs_single")
                                                 for d in ("measured", "predicted", "centre", "exact", "oracle", "free")})
            for m in ("paper", "plane") for s in ("sphere", "street")])
        write(self.root, "ssrm_scaling", [
            changed(SSRM, scene=s, width=w, height=w * 9 // 16, marcher=m, triangles=t, rays=1000, t_ss_ms=w / 1000)
            for m in ("paper", "plane") for s, w, t in (("atrium_10", 1920, 1000), ("atrium", 1920, 200000), ("sponza", 1280, 2), ("sponza", 1920, 2))])
        write(self.root, "ssrm_layers", [changed(LAYERS, layers=n, guard_band=b, scene=s, alpha_gain=1 + 0.1 * n + b)
                                         for n in (1, 2, 3) for b in (0, 0.25) for s in ("sphere", "bistro")])
        write(self.root, "ssrm_breakeven", [
            changed(SSRM, ray_kind=k, mirror_depth=d, tracer_mode=m, break_even_alpha=b, pays_measured=p)
            for k, d, b, p in (("mirror", 1, 0.3, "yes"), ("mirror", 2, 0.6, "no"), ("shadow", 1, 3, "no"))
            for m in ("fastest", "single")])
        write(self.root, "ssrm_distribution", [changed(SSRM, camera=f"seeded/{n}", alpha=(n + 1) / 10) for n in range(4)])
        write(self.root, "caustics_rays_objects", rays() + [changed(r, scene="wine_glass", at_floor="true") for r in rays()])
        write(self.root, "caustics_depth_objects", [changed(CAUSTICS, mirror_depth=d, total_ms=d + 3) for d in (1, 2, 3, 4)])
        write(self.root, "caustics_lights", lights())
        write(self.root, "caustics_onoff", [CAUSTICS])
        self.picture("ssrm_tables", "sphere_front_1280x720_spherefront1280.png")
        for kind in ("off", "on"):
            self.picture("caustics_onoff", f"glass_ball_front_320x180_0_{kind}.png")
        (self.root / "caustics_lights" / "manifest.json").write_text(json.dumps({"machine": {"cpu": "A CPU"}}))

    def picture(self, name: str, file: str) -> None:
        (self.root / name / "pictures").mkdir(exist_ok=True)
        plt.imsave(self.root / name / "pictures" / file, [[[0.2, 0.4, 0.6]] * 16] * 9)

    def test_the_same_tables_give_the_same_bytes(self):
        self.everything()
        outputs = []
        for seed in ("1", "2"):
            output = self.root / f"figures{seed}"
            done = run("figures.py", self.root, "-o", output, env=os.environ | {"PYTHONHASHSEED": seed})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr, "")
            outputs.append({path.name: path.read_bytes() for path in output.iterdir()})
        self.assertEqual(outputs[0].keys(), outputs[1].keys())
        for name, content in outputs[0].items():
            self.assertEqual(content, outputs[1][name], name)
        for name in ("ssrm_times", "ssrm_verdicts", "ssrm_alpha", "ssrm_precision_recall", "ssrm_designs", "ssrm_scaling", "ssrm_thickness", "ssrm_layers", "ssrm_breakeven",
                     "ssrm_distribution", "caustics_onoff", "caustics_rays_objects",
                     "caustics_depth_objects", "caustics_lights", "time_error_ssrm_tables", "time_error_caustics_rays_objects"):
            pdf, svg, png = (outputs[0][f"{name}.{kind}"] for kind in ("pdf", "svg", "png"))
            self.assertTrue(pdf.startswith(b"%PDF-") and png.startswith(b"\x89PNG"), name)
            self.assertNotIn(b"/CreationDate", pdf)
            self.assertNotIn(b"/Type3", pdf)
            self.assertNotIn(b"dc:date", svg)
            xml.dom.minidom.parseString(svg)
        self.assertIn(b"A CPU", self.text_of(outputs[0]["caustics_lights.svg"]))

    def test_tells_how_seeded_cameras_are_distributed(self):
        write(self.root, "ssrm_distribution", [changed(SSRM, camera=f"seeded/{n}", alpha=a) for n, a in enumerate((0.1, 0.2, 0.3, 0.6))])
        done = run("figures.py", self.root, "--only", "ssrm_distribution")
        self.assertEqual(done.returncode, 0, done.stderr)
        line = next(x for x in (self.root / "figures" / "ssrm_distribution.txt").read_text().splitlines() if "| alpha |" in x)
        # Mean 0.3, standard deviation sqrt(0.14 / 3) = 0.21602, Student's t with 3 degrees of freedom 3.18245.
        self.assertEqual(line, "| sphere | alpha | 4 | 0.3000 | -0.0437 to 0.6437 | 0.1000 | 0.1750, 0.2500, 0.3750 | 0.6000 |")

    @staticmethod
    def text_of(svg: bytes) -> bytes:
        """SVG keeps the text of its glyph outlines in comments."""
        return b"\n".join(re.findall(rb"<!-- (.*?) -->", svg))

    def test_a_second_run_leaves_its_own_output_out(self):
        write(self.root, "ssrm_tables", [SSRM])
        self.assertEqual(run("figures.py", self.root, "--only", "ssrm_tables").returncode, 0)
        (self.root / "figures" / "ssrm_tables.csv").write_text("not,a,result\n")
        self.assertEqual(run("figures.py", self.root, "--only", "ssrm_tables").returncode, 0)

    def test_skips_a_table_without_rows_and_takes_the_next(self):
        path = write(self.root, "ssrm_tables", [SSRM])
        path.write_text(path.read_text().splitlines()[0] + "\n")
        write(self.root, "quickstart", [SSRM])
        done = run("figures.py", self.root, "--only", "ssrm_*", "--only", "time_error_ssrm_tables")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("made     ssrm_tables: ", done.stdout)
        self.assertIn(f"skipped  time_error_ssrm_tables: {path} has no rows\n", done.stdout)

    def test_leaves_shards_to_the_merged_table(self):
        path = write(self.root, "ssrm_tables", [SSRM])
        shutil.copytree(path.parent, path.parent / "shard-1-of-2")
        done = run("figures.py", path.parent, "--only", "ssrm_tables")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_names_the_place_in_a_damaged_manifest(self):
        manifest = write(self.root, "ssrm_tables", [SSRM]).parent / "manifest.json"
        manifest.write_text('{"config": oops}')
        done = run("figures.py", self.root, "--only", "ssrm_times")
        self.assertEqual((done.returncode, done.stderr), (2, f"figures: ssrm_times: {manifest}:1:12: not JSON: Expecting value\n"))
        manifest.write_text('{"config": 1, "machine": []}')  # says nothing, and harms nothing
        self.assertEqual(run("figures.py", self.root, "--only", "ssrm_times").returncode, 0)

    def test_says_what_it_skips_and_why(self):
        write(self.root, "quickstart", [SSRM])
        done = run("figures.py", self.root)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("made     ssrm_tables: ssrm_tables (txt, tex)\n", done.stdout)
        self.assertIn(f"skipped  caustics_lights: no caustics_lights.csv in {self.root}\n", done.stdout)
        self.assertIn("skipped  ssrm_verdicts: no pictures beside", done.stdout)
        self.assertEqual(len(re.findall(r"^(made|skipped) ", done.stdout, re.MULTILINE)), 19)
        self.assertFalse(list((self.root / "figures").glob("caustics*")))

    def test_names_file_and_column_and_draws_the_others(self):
        write(self.root, "ssrm_tables", [SSRM])
        without = [{k: v for k, v in row.items() if k != "relmse_low"} for row in rays()]
        path = write(self.root, "caustics_rays_objects", without)
        done = run("figures.py", self.root, "--only", "caustics_rays_objects", "--only", "ssrm_tables")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, f"figures: caustics_rays_objects: {path}: column relmse_low is missing\n")
        self.assertIn("made     ssrm_tables", done.stdout)
        path = write(self.root, "caustics_rays_objects", [*rays(), changed(CAUSTICS, total_ms="long")])
        done = run("figures.py", self.root, "--only", "caustics_rays_objects")
        self.assertEqual((done.returncode, done.stderr), (
            2, f"figures: caustics_rays_objects: {path}:12: column total_ms: 'long' is not a finite number\n"))

    def test_reads_equal_time_and_equal_error(self):
        write(self.root, "caustics_rays_objects", rays())
        self.assertEqual(run("figures.py", self.root, "--only", "time_error*").returncode, 0)
        text = (self.root / "figures" / "time_error_caustics_rays_objects.txt").read_text()
        cells = [re.split(r"\s{2,}", line.strip()) for line in text.splitlines()]
        # The paper's setting, one ray and no filter, takes 10 ms for an error of 100. With the filter half a ray takes 6 ms for
        # an error of 50, one ray 11 ms; a quarter of a ray takes 3.5 ms for an error of 100.
        self.assertIn(["glass ball", "filter none, 1", "10", "100"], cells)
        self.assertIn(["filter none", "× 1 (1)", "× 1 (1)"], cells)
        self.assertIn(["filter wavelet", "× 0.5 (0.5)", "× 0.35 (0.25)"], cells)
        latex = (self.root / "figures" / "time_error_caustics_rays_objects.tex").read_text()
        self.assertIn(r"\quad filter wavelet &  &  &  & $\times$ 0.5 (0.5) & $\times$ 0.35 (0.25) \\", latex)

    def test_leaves_out_points_without_a_number(self):
        write(self.root, "ssrm_tables", [changed(SSRM, camera="side", alpha=""), changed(SSRM, camera="top", t_hybrid_ms=""),
                                         changed(SSRM, t_hybrid_single_ms=""), SSRM])
        write(self.root, "caustics_lights", [changed(lights()[0], lights_visible=""), *lights()])
        write(self.root, "caustics_rays", [changed(r, relmse=0) for r in rays()])
        done = run("figures.py", self.root, "--only", "time_error_ssrm*", "--only", "ssrm_alpha", "--only", "caustics_lights",
                   "--only", "time_error_caustics_rays")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertNotIn("skipped", done.stdout)
        text = (self.root / "figures" / "time_error_ssrm_tables.txt").read_text()
        self.assertRegex(text, r"sphere, 1280x720 +hybrid, fastest mode +12 ")
        write(self.root, "ssrm_tables", [changed(SSRM, alpha="", precision="")])
        self.assertIn("skipped  time_error_ssrm_tables: ", run("figures.py", self.root, "--only", "time_error_ssrm*").stdout)

    def test_names_the_columns_that_pictures_are_found_by(self):
        path = write(self.root, "quickstart", [{k: v for k, v in SSRM.items() if k != "camera"}])
        done = run("figures.py", self.root, "--only", "ssrm_verdicts")
        self.assertEqual((done.returncode, done.stderr), (2, f"figures: ssrm_verdicts: {path}: column camera is missing\n"))

    def test_compares_settings_of_one_problem_only(self):
        slow = [changed(r, width=640, height=360, total_ms=1000) for r in rays()]
        write(self.root, "caustics_rays", rays() + slow)
        self.assertEqual(run("figures.py", self.root, "--only", "time_error*").returncode, 0)
        text = (self.root / "figures" / "time_error_caustics_rays.txt").read_text()
        self.assertRegex(text, r"glass ball, 320, 180 +filter none, 1 +10 +100")
        self.assertRegex(text, r"glass ball, 640, 360 +filter none, 1 +1000 +100")

    def test_refuses_what_it_cannot_choose_between(self):
        path = write(self.root, "ssrm_tables", [SSRM])
        other = path.rename(self.root / "ssrm_tables.csv")
        write(self.root, "ssrm_tables", [SSRM])
        done = run("figures.py", self.root)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr, f"figures: {self.root}: two tables are named ssrm_tables.csv: {path} and {other}\n")

    def test_refuses_wrong_arguments(self):
        write(self.root, "ssrm_tables", [SSRM])
        done = run("figures.py", self.root, "--only", "figure_9")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--only figure_9: no such figure; there are ssrm_tables, ", done.stderr)
        done = run("figures.py", self.root / "nowhere")
        self.assertEqual((done.returncode, done.stderr), (
            2, f"figures: {self.root / 'nowhere'}: no such folder; `hybray run` makes one\n"))

    def test_says_which_package_is_missing(self):
        done = run("figures.py", interpreter=["/usr/bin/python3", "-S"])  # without Debian's packages
        self.assertEqual(done.returncode, 2)
        self.assertIn("matplotlib is missing; scripts/setup.sh installs it", done.stderr)

    def test_quickstart_tables_need_no_packages(self):
        path = write(self.root, "quickstart", [SSRM])
        self.assertEqual(run("tables.py", path, interpreter=["/usr/bin/python3", "-S"]).returncode, 0)


if __name__ == "__main__":
    unittest.main()
