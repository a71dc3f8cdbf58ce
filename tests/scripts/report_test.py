#!/usr/bin/python3
"""Tests scripts/report.py, without a browser, on folders made by hand."""

import base64
import html
import io
import json
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from PIL import Image

sys.dont_write_bytecode = True
SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))

from report.columns import Column, number_text, parse_description  # noqa: E402
from report.gates import read_junit  # noqa: E402
from report.runs import Run, read_run, read_runs  # noqa: E402
from report.summary import duration, notes_of_run, state  # noqa: E402
from report.tables import make_table  # noqa: E402

DESCRIPTION = """## made_up
Only here.

| parameter | unit | default | accepts | meaning |
|---|---|---|---|---|
| size | px | 1 | an integer | not a column |

| column | unit | kind | better | meaning |
|---|---|---|---|---|
| id |  | key |  | id of the point |
| scene |  | key |  | scene |
| size | px | key |  | how large |
| mode |  | key |  | found by measurement |
| error | 1 | metric | lower | mean of \\|x - r\\| / r |
| error_low | 1 | metric |  | lower end of the 95 % interval of error |
| error_high | 1 | metric |  | upper end of the 95 % interval of error |
| total_ms | ms | time | lower | all of it |
| total_spread_ms | ms | time |  | interquartile range of total_ms |
| never | 1 | metric | lower | always empty |
| threads |  | count |  | threads in use |
"""
TABLE = """id,scene,size,mode,error,error_low,error_high,total_ms,total_spread_ms,never,threads
00000000000000a1,ball,1,fast,0.25,0.2,0.31,1234.5678,0.5,,2
00000000000000a2,ball,2,fast,0.00001234,,,7,0.25,,2
00000000000000a3,ring,1,slow,0.75,0.7,0.8,9.5,0.125,,2
"""
MANIFEST = {
    "config": {"file": "made_up.json", "experiment": "made_up", "title": "Nothing & <more>", "seed": 1,
               "parameters": {"scene": "ball"}, "sweep": {"scene": ["ball", "ring"], "size": [1, 2]}, "set": ["size=1"], "filter": []},
    "program": {"version": "0.1.0", "git_commit": "0123456789abcdef0123456789abcdef01234567", "git_dirty": False,
                "build_type": "Release", "compiler": "GNU 12", "flags": "-O3", "libraries": {"Embree": "3.13.5"}},
    "machine": {"cpu": "A processor", "instruction_sets": ["avx2"], "hardware_threads": 2, "memory_bytes": 2**30},
    "scenes": {"ball": {"content_hash": "feedfacefeedface", "triangles": 1024}},
    "skipped_scenes": [],
    "run": {"points": 3, "points_done": 3, "points_failed": 0, "complete": True, "threads": 2, "timing": True, "wall_time_s": 75.2},
}


def described() -> list[Column]:
    return parse_description(DESCRIPTION)


class Folder:
    """A results folder of one run."""

    def __init__(self, table: str | None = TABLE, manifest: dict | str | None = MANIFEST):
        self.temporary = tempfile.TemporaryDirectory()
        self.path = Path(self.temporary.name) / "out"
        self.run = self.path / "made_up"
        (self.run / "pictures").mkdir(parents=True)
        if table is not None:
            self.write("made_up.csv", table)
        if manifest is not None:
            self.write("manifest.json", manifest if isinstance(manifest, str) else json.dumps(manifest))

    def __del__(self) -> None:
        self.temporary.cleanup()

    def write(self, name: str, text: str) -> Path:
        file = self.run / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

    def read(self) -> Run:
        return read_run(self.run, "made_up")

    def picture(self, name: str, color: tuple[int, int, int], size: tuple[int, int] = (16, 8)) -> Path:
        file = self.run / "pictures" / name
        image = Image.new("RGB", size, color)
        image.putpixel((1, 1), (1, 2, 3))
        image.save(file)
        return file

    def program(self) -> Path:
        """A stand-in for hybray that describes the experiment."""
        file = Path(self.temporary.name) / "hybray"
        file.write_text(f"#!/usr/bin/python3\nimport sys\nassert sys.argv[1:] == ['describe', 'made_up', '--markdown']\n"
                        f"print({DESCRIPTION!r})\n")
        file.chmod(0o755)
        return file

    def report(self, *options: str) -> subprocess.CompletedProcess:
        return subprocess.run([str(SCRIPTS / "report.py"), str(self.path), "--program", str(self.program()), *options],
                              capture_output=True, text=True)


class Reading(unittest.TestCase):
    def test_a_description_gives_the_columns_but_not_the_parameters(self):
        columns = described()
        self.assertEqual(len(columns), 11)
        self.assertEqual(columns[4], Column("error", "1", "metric", "lower", "mean of |x - r| / r"))

    def test_a_description_may_say_more_of_a_column_than_the_page_needs(self):
        columns = parse_description("| column | unit | kind | tolerance | better | meaning |\n|---|---|---|---|---|---|\n"
                                    "| error | 1 | metric | 1e-6 | lower | text |\n")
        self.assertEqual(columns, [Column("error", "1", "metric", "lower", "text")])

    def test_numbers_keep_four_digits_and_words_are_left_alone(self):
        for text, shown in (("0.99996", "1.000"), ("14.6", "14.60"), ("123456", "123,456"), ("18742.9", "18,743"), ("0", "0"),
                            ("0.0", "0"), ("0.00001234", "1.234e-05"), ("-0.5", "-0.5000"), ("1234.5678", "1235"),
                            ("packet16", "packet16"), ("", ""), ("1e300", "1.000e+300"), ("nan", "nan")):
            self.assertEqual(number_text(text), shown)

    def test_durations_read_like_durations(self):
        for seconds, text in ((0.25, "0.25 s"), (59.4, "59.4 s"), (75.2, "1 min 15 s"), (7380, "2 h 03 min"), (None, ""), ("x", "")):
            self.assertEqual(duration(seconds), text)

    def test_a_stopped_run_is_read_from_what_it_left_without_its_torn_last_line(self):
        folder = Folder(None, None)
        folder.write("made_up.csv.partial", TABLE + "00000000000000a4,ring,2,sl")
        folder.write("manifest.json.partial", json.dumps(MANIFEST))
        run = folder.read()
        self.assertTrue(run.interrupted)
        self.assertEqual([row["id"][-2:] for row in run.rows], ["a1", "a2", "a3"])
        self.assertEqual(run.experiment, "made_up")
        self.assertEqual(state(run), ("interrupted", "warn"))

    def test_a_finished_table_stands_though_a_later_run_was_stopped(self):
        folder = Folder()
        folder.write("made_up.csv.partial", TABLE.splitlines()[0] + "\n")
        self.assertEqual(len(folder.read().rows), 3)

    def test_runs_of_one_name_are_told_apart_by_their_folders(self):
        folder = Folder()
        shutil.copytree(folder.run, folder.path / "other")
        self.assertEqual([run.name for run in read_runs(folder.path)], ["made_up/made_up", "other/made_up"])

    def test_shards_are_left_to_the_merged_run(self):
        folder = Folder()
        shutil.copytree(folder.run, folder.run / "shard-1-of-2")
        self.assertEqual([run.name for run in read_runs(folder.run)], ["made_up"])

    def test_gates_are_read_from_junit_the_failed_ones_first(self):
        folder = Folder()
        file = folder.write("gates/a.xml", """<testsuite><testcase name="one"/><testcase name="two"><skipped message="known"/></testcase>
            <testcase name="three" classname="hybray.made_up"><failure message="0.2 &lt; 0.3">more
            0.2 &lt; 0.3</failure></testcase><testcase name="four"><error>broken</error></testcase></testsuite>""")
        self.assertEqual([(g.name, g.result, g.message) for g in read_junit(file)],
                         [("three", "failed", "0.2 < 0.3\nmore"), ("four", "failed", "broken"), ("two", "skipped", "known"), ("one", "passed", "")])


class Tables(unittest.TestCase):
    def table(self, manifest: dict = MANIFEST):
        return make_table(Folder(manifest=manifest).read(), described())[0]

    def test_intervals_and_spreads_stand_beside_their_number(self):
        table = self.table()
        names = [shown.column.name for shown in table.columns]
        self.assertNotIn("error_low", names)
        self.assertNotIn("total_spread_ms", names)
        self.assertEqual(table.rows[0][names.index("error")].interval, "0.2000 to 0.3100")
        self.assertEqual(table.rows[1][names.index("error")].interval, "")
        self.assertEqual(table.rows[0][names.index("total_ms")].interval, "± 0.50")
        self.assertEqual(table.rows[0][names.index("total_ms")].value, "1234.5678", "sorted by every digit")

    def test_what_never_changes_or_is_empty_leaves_the_table_but_not_the_page(self):
        table = self.table()
        self.assertEqual(table.constants, [("threads", "2")])
        self.assertEqual(table.empty, ["never"])

    def test_main_columns_are_what_the_config_sweeps_and_the_headline(self):
        table = self.table()
        self.assertEqual([s.column.name for s in table.columns if "main" in s.sets], ["scene", "size", "error", "total_ms"])
        self.assertEqual([s.column.name for s in table.columns if not s.sets], ["mode", "id"], "only among all columns")

    def test_headline_numbers_are_the_median_and_range_of_the_rows_that_have_one(self):
        table = self.table()
        self.assertEqual([(f.column.name, f.text, f.range) for f in table.headline],
                         [("error", "0.2500", "1.234e-05 to 0.7500"), ("total_ms", "9.500", "7.000 to 1235")])
        self.assertEqual(table.by_key, "scene")
        self.assertEqual([(name, figures[0].text) for name, figures in table.groups], [("ball", "0.1250"), ("ring", "0.7500")])

    def test_without_a_description_words_and_parameters_are_keys_and_ms_is_a_time(self):
        run = Folder().read()
        kinds = {column.name: column.kind for column in make_table(run, [])[1]}
        self.assertEqual({name: kinds[name] for name in ("scene", "size", "mode", "error", "total_ms")},
                         {"scene": "key", "size": "key", "mode": "key", "error": "metric", "total_ms": "time"})


    def test_an_id_that_looks_like_a_number_is_none(self):
        table = make_table(Folder(TABLE.replace("a1,", "01,").replace("a2,", "02,").replace("a3,", "03,")).read(), described())[0]
        self.assertEqual([row[-1].text for row in table.rows], [f"000000000000000{i}" for i in (1, 2, 3)])


class Notes(unittest.TestCase):
    def notes(self, table: str = TABLE, **parts: object) -> list[tuple[str, str]]:
        return [(note.level, note.text) for note in notes_of_run(Folder(table, MANIFEST | parts).read())]

    def test_a_sound_run_needs_none(self):
        self.assertEqual(self.notes(), [])

    def test_failures_skipped_scenes_and_a_changed_tree_are_said(self):
        notes = self.notes(run=MANIFEST["run"] | {"points": 4, "points_failed": 1, "complete": False, "timing": False},
                           skipped_scenes=["sponza"], program=MANIFEST["program"] | {"git_dirty": True})
        self.assertEqual([level for level, _ in notes], ["bad", "warn", "warn", "warn"])
        for (_, text), word in zip(notes, ("1 of 4 points failed", "sponza", "without timing", "uncommitted")):
            self.assertIn(word, text)

    def test_errors_at_the_floor_of_their_reference_are_said(self):
        table = TABLE.replace("scene,size", "scene,at_floor").replace("ball,1", "ball,true").replace("ball,2", "ball,false")
        self.assertIn("1 of 3 rows", self.notes(table.replace("ring,1", "ring,false"))[0][1])

    def test_a_table_without_a_manifest_is_said_to_be_of_unknown_origin(self):
        self.assertIn("unknown", notes_of_run(Folder(manifest=None).read())[0].text)


class Page(unittest.TestCase):
    def page(self, folder: Folder, *options: str) -> str:
        done = folder.report(*options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (folder.path / "report.html").read_text()

    def test_the_same_inputs_give_the_same_bytes(self):
        folder = Folder()
        folder.picture("ball_front_16x8_00000000000000a1_on.png", (200, 10, 10))
        self.assertEqual(self.page(folder), self.page(folder))

    def test_it_refers_to_nothing_outside_but_by_relative_links(self):
        folder = Folder()
        folder.picture("ball_front_16x8_00000000000000a1_on.png", (200, 10, 10))
        (folder.run / "pictures" / "ball_front_16x8_00000000000000a1_on.exr").write_bytes(b"floats")
        page = self.page(folder)
        self.assertEqual(re.findall(r"""(?:src|href)=["'](?!data:|#)([^"']*)""", page),
                         ["made_up/made_up.csv", "made_up/manifest.json", "made_up/pictures/ball_front_16x8_00000000000000a1_on.exr"])
        self.assertNotRegex(page, r"https?://|@import|url\(")
        self.assertIn("default-src 'none'; img-src data:;", page)

    def test_text_from_the_inputs_stays_text(self):
        evil = "<script>alert(1)</script>"
        manifest = MANIFEST | {"config": MANIFEST["config"] | {"title": evil}, "machine": {"cpu": evil}}
        page = self.page(Folder(TABLE.replace("ring", evil), manifest), "--title", evil)
        self.assertEqual(page.count("<script>"), 1)
        self.assertIn(html.escape(evil), page)

    def pictures(self, page: str) -> list[Image.Image]:
        data = re.findall(r'<img id="[^"]*" src="data:image/\w+;base64,([^"]*)"', page)
        return [Image.open(io.BytesIO(base64.b64decode(text))) for text in data]

    def test_pictures_are_embedded_once_without_loss(self):
        folder = Folder()
        file = folder.picture("ball_front_16x8_00000000000000a1_off.png", (9, 80, 200))
        folder.picture("ball_front_16x8_00000000000000a2_off.png", (9, 80, 200))
        folder.picture("ball_front_16x8_00000000000000a2_on.png", (90, 80, 200))
        page = self.page(folder)
        embedded = self.pictures(page)
        self.assertEqual(len(embedded), 2, "the first two are the same picture")
        self.assertEqual(embedded[0].convert("RGB").tobytes(), Image.open(file).convert("RGB").tobytes())
        self.assertEqual(page.count('data-kind="without caustics"'), 2)
        self.assertIn('data-point="size 2"', page)

    def test_pictures_of_points_that_the_table_lacks_are_left_out_and_counted(self):
        folder = Folder()
        folder.picture("ball_front_16x8_00000000000000a1_on.png", (1, 1, 1))
        folder.picture("ball_front_16x8_00000000000000ff_on.png", (2, 2, 2))
        page = self.page(folder)
        self.assertEqual(len(self.pictures(page)), 1)
        self.assertIn("1 more file", page)

    def test_large_pictures_are_shrunk_to_the_limit(self):
        folder = Folder()
        folder.picture("ball_front_64x32_00000000000000a1_on.png", (1, 90, 1), (64, 32))
        self.assertEqual(self.pictures(self.page(folder, "--max-side", "16"))[0].size, (16, 8))
        self.assertIn("1 picture is shown at 16 pixels", self.page(folder, "--max-side", "16"))

    def test_all_pictures_together_keep_to_the_budget_and_the_page_says_how(self):
        folder = Folder()
        noise = random.Random(7).randbytes(3 * 1100 * 1100)  # which nothing compresses
        Image.frombytes("RGB", (1100, 1100), noise).save(folder.run / "pictures" / "ball_front_1100x1100_00000000000000a1_on.png")
        self.assertGreater((folder.run / "pictures" / "ball_front_1100x1100_00000000000000a1_on.png").stat().st_size, 1_000_000)
        page = self.page(folder, "--max-mb", "1")
        self.assertLess(len(page), 1_100_000)
        self.assertIn("compressed with loss", page.lower())

    def test_a_run_of_which_every_point_failed_still_stands_in_the_summary(self):
        ran = MANIFEST["run"] | {"points": 3, "points_done": 0, "points_failed": 3, "complete": False}
        page = self.page(Folder(None, MANIFEST | {"run": ran}))
        self.assertIn("3 of 3 points failed", page)
        self.assertIn("The table has no row.", page)

    def test_a_manifest_with_parts_of_the_wrong_kind_is_shown_as_far_as_it_goes(self):
        page = self.page(Folder(manifest={"config": {"file": "made_up.json", "experiment": "made_up", "sweep": 1}, "program": 7,
                                          "machine": {"memory_bytes": "much"}, "scenes": [1], "run": {"points": "3"}}))
        self.assertIn("incomplete", page)

    def test_failed_gates_and_points_come_first(self):
        manifest = MANIFEST | {"run": MANIFEST["run"] | {
            "points": 4, "points_failed": 1, "complete": False,
            "failures": [{"id": "00000000000000a4", "parameters": {"scene": "ring", "size": 2, "near": 0.1}, "message": "out of memory"}]}}
        folder = Folder(manifest=manifest)
        folder.write("gates/g.xml", '<testsuite><testcase name="error at most 0.1"><failure message="0.75"/></testcase></testsuite>')
        page = self.page(folder)
        summary = page[page.index('id="summary"'):page.index("What ran")]
        self.assertIn("1 of 4 points failed", summary)
        self.assertIn("1 of 1 gate failed", summary)
        self.assertIn("scene = ring, size = 2", page)
        self.assertIn("out of memory", page)

    def test_figures_are_embedded_as_vectors_with_links_to_the_rest(self):
        folder = Folder()
        (folder.path / "figures").mkdir()
        for name, text in (("alpha.svg", '<svg xmlns="http://www.w3.org/2000/svg"/>'), ("alpha.pdf", "%PDF"), ("table.txt", "a < b")):
            (folder.path / "figures" / name).write_text(text)
        page = self.page(folder)
        self.assertIn("data:image/svg+xml;base64,", page)
        self.assertIn('href="figures/alpha.pdf"', page)
        self.assertIn("a &lt; b", page)


class Complaints(unittest.TestCase):
    def refused(self, folder: Folder, *words: str) -> None:
        done = folder.report()
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for word in ("report: ", *words):
            self.assertIn(word, done.stderr)
        self.assertFalse((folder.path / "report.html").exists())

    def test_an_empty_folder_is_an_error(self):
        self.refused(Folder(None, None), "no table and no manifest")

    def test_a_missing_folder_is_an_error(self):
        folder = Folder()
        folder.path = folder.path / "not_there"
        self.refused(folder, "not_there", "no such folder")

    def test_a_short_row_is_named_by_its_line(self):
        self.refused(Folder(TABLE + "00000000000000a4,ring\n"), "made_up.csv:5", "2 cells where the header has 11")

    def test_an_empty_table_and_an_open_quote_are_errors(self):
        self.refused(Folder(""), "made_up.csv", "not even a header")
        self.refused(Folder(TABLE + '"open,'), "made_up.csv:5", "not CSV")

    def test_a_damaged_manifest_is_named_by_its_place(self):
        self.refused(Folder(manifest='{\n  "config": oops'), "manifest.json:2:13", "not JSON")
        self.refused(Folder(manifest="[]"), "manifest.json", "expected an object")
        self.refused(Folder(manifest='{"config": {}}'), "manifest.json", "/config/file")

    def test_damaged_pictures_and_gates_are_named(self):
        folder = Folder()
        file = folder.picture("ball_front_16x8_00000000000000a1_on.png", (1, 1, 1))
        file.write_bytes(file.read_bytes()[:50])
        self.refused(folder, file.name, "not a readable picture")
        folder = Folder()
        folder.write("gates/g.xml", "<testsuite>")
        self.refused(folder, "g.xml:1:", "not XML")

    def test_a_program_that_does_not_run_is_named(self):
        folder = Folder()
        done = subprocess.run([str(SCRIPTS / "report.py"), str(folder.path), "--program", "/not/there"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (2, "report: /not/there: No such file or directory\n"))


if __name__ == "__main__":
    unittest.main()
