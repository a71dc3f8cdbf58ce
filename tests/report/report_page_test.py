#!/usr/bin/python3
"""Opens a page of scripts/report.py in headless Chromium and uses it: report_page_test.py RESULTS [UNITTEST_OPTION...].

RESULTS must hold a run of `ssrm` and one of `caustics`, both with pictures; scripts/test_report.sh makes them.
"""

import csv
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy
from PIL import Image
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

from browser import LOW_CONTRAST, Browser  # noqa: E402

REPORT = Path(__file__).resolve().parents[2] / "scripts" / "report.py"
RESULTS = Path()


def table_of(experiment: str) -> Path:
    """The table of the run whose pictures are those of the experiment."""
    for file in sorted(RESULTS.glob("*/*.csv")):
        header = file.read_text().split("\n", 1)[0].split(",")
        if ("alpha" if experiment == "ssrm" else "relmse") in header:
            return file
    raise FileNotFoundError(f"{RESULTS}: no table of {experiment}")


class ReportPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory()
        cls.page = Path(cls.folder.name) / "report.html"
        subprocess.run([str(REPORT), str(RESULTS), "-o", str(cls.page)], check=True)
        cls.browser = Browser()
        cls.driver = cls.browser.driver

    @classmethod
    def tearDownClass(cls) -> None:
        cls.browser.quit()
        cls.folder.cleanup()

    def find(self, selector: str, within: object = None) -> object:
        return (within or self.driver).find_element(By.CSS_SELECTOR, selector)

    def find_all(self, selector: str, within: object = None) -> list:
        return (within or self.driver).find_elements(By.CSS_SELECTOR, selector)

    def press(self, *keys: str) -> None:
        """To whatever has the focus."""
        ActionChains(self.driver).send_keys(*keys).perform()

    def focus(self, element: object) -> None:
        self.browser.run("arguments[0].focus()", element)

    def comparer(self, table: Path) -> object:
        return self.find(f"#run-{table.stem.replace('_', '-')} .comparer")

    def shown(self, comparer: object) -> numpy.ndarray:
        return numpy.asarray(self.browser.picture_of(self.find(".pane", comparer)), dtype=float)

    def choose(self, comparer: object, mode: str) -> None:
        self.browser.run("arguments[0].click()", self.find(f".mode input[value={mode}]", comparer))

    def test_opens_without_a_complaint_and_asks_for_nothing_but_itself(self):
        self.browser.open(self.page)
        self.assertEqual(self.find("h1").text, "hybray report")
        self.browser.run("for (const details of document.querySelectorAll('details')) details.open = true;")
        for element in self.find_all("select.view"):
            for option in range(len(Select(element).options)):
                Select(element).select_by_index(option)
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual(self.browser.requests(), [self.page.as_uri()])

    def test_its_policy_forbids_what_would_need_a_network(self):
        self.browser.open(self.page)
        refused = self.driver.execute_async_script("""
            const done = arguments[0], refused = new Set();
            addEventListener("securitypolicyviolation", (event) => refused.add(event.effectiveDirective));
            fetch("https://example.invalid/").catch(() => {});
            new Image().src = "https://example.invalid/a.png";
            for (const [tag, attribute] of [["script", "src"], ["iframe", "src"], ["link", "href"]]) {
              const element = document.createElement(tag);
              element.rel = "stylesheet";
              element[attribute] = "https://example.invalid/";
              document.head.append(element);
            }
            setTimeout(() => done([...refused].sort()), 500);""")
        self.assertEqual(refused, ["connect-src", "frame-src", "img-src", "script-src-elem", "style-src-elem"])

    def sort_with(self, key: str, table: Path, column: str) -> tuple[list[str], str | None]:
        """Presses a key on a column's button; the column's values as they then stand, and what aria-sort says."""
        section = f"#run-{table.stem.replace('_', '-')} .rows"
        button = next(b for b in self.find_all(f"{section} thead button") if b.get_attribute("textContent").startswith(column))
        self.focus(button)
        self.press(key)
        return self.browser.run("""
            const head = document.activeElement.closest("th");
            const cells = [...head.closest("table").tBodies[0].rows].map((row) => row.cells[head.cellIndex]);
            return [cells.map((cell) => cell.dataset.v ?? cell.textContent.trim()), head.getAttribute("aria-sort")];""")

    def test_the_keyboard_sorts_a_table_up_and_down_and_back(self):
        for experiment, column in (("ssrm", "alpha"), ("caustics", "relmse")):
            table = table_of(experiment)
            with table.open(newline="") as file:
                cells = [row[column] for row in csv.DictReader(file)]
            filled, empty = [c for c in cells if c], [c for c in cells if not c]
            self.browser.open(self.page)
            up, down = sorted(filled, key=float), sorted(filled, key=float, reverse=True)
            self.assertEqual(self.sort_with(Keys.ENTER, table, column), [up + empty, "ascending"])
            self.assertEqual(self.sort_with(Keys.SPACE, table, column), [down + empty, "descending"])
            self.assertEqual(self.sort_with(Keys.ENTER, table, column), [cells, None])

    def test_the_choice_of_columns_and_the_search_change_what_a_table_shows(self):
        table = table_of("ssrm")
        self.browser.open(self.page)
        rows = self.find(f"#run-{table.stem} .rows")
        visible = lambda: [h.text for h in self.find_all("thead th", rows) if h.is_displayed()]  # noqa: E731
        main = len(visible())
        self.focus(self.find("input[type=radio]:checked", rows))
        self.press(Keys.ARROW_RIGHT)
        self.assertFalse(any("t_ss" in name for name in visible()), "Metrics")
        self.press(Keys.ARROW_RIGHT)
        self.assertTrue(any("t_ss" in name for name in visible()), "Times")
        self.press(Keys.ARROW_RIGHT)
        self.assertGreater(len(visible()), 2 * main, "All")
        with table.open(newline="") as file:
            cameras = [row["camera"] for row in csv.DictReader(file)]
        self.find("input[type=search]", rows).send_keys(cameras[0])
        shown = [row for row in self.find_all("tbody tr", rows) if row.is_displayed()]
        self.assertEqual(len(shown), cameras.count(cameras[0]))
        self.assertIn(f"{len(shown)} of {len(cameras)}", self.find(".count", rows).text)

    def pair(self, comparer: object) -> tuple[numpy.ndarray, numpy.ndarray]:
        """The files behind A and B of the caustics, as they were written, found by what the page says they are."""
        table = table_of("caustics")
        with table.open(newline="") as file:
            rows = list(csv.DictReader(file))
        view = Select(self.find("select.view", comparer)).first_selected_option.text.replace(", ", "_")
        kinds = {"caustics alone": "caustics", "reference of the caustics": "reference"}
        pictures = []
        for side in "ab":
            option = Select(self.find(f"select.{side}", comparer)).first_selected_option
            point = dict(key.split(" ") for key in option.find_element(By.XPATH, "..").get_attribute("label").split(", "))
            identity = next(row["id"] for row in rows if all(row[name] == value for name, value in point.items()))
            file = table.parent / "pictures" / f"{view}_{identity}_{kinds[option.text]}.png"
            pictures.append(numpy.asarray(Image.open(file).convert("RGB"), dtype=float))
        return pictures[0], pictures[1]

    def test_the_slider_moves_the_border_between_the_two_pictures_pixel_by_pixel(self):
        self.browser.open(self.page)
        comparer = self.comparer(table_of("caustics"))
        Select(self.find("select.zoom", comparer)).select_by_value("1")
        a, b = self.pair(comparer)
        self.assertGreater(numpy.abs(a - b).max(), 0, "the two must differ for the test to mean anything")
        slider, width = self.find(".at", comparer), a.shape[1]
        self.focus(slider)
        for key, share in ((None, 0.5), (Keys.HOME, 0.0), (Keys.END, 1.0), (Keys.PAGE_DOWN, None)):
            if key:
                self.press(key)
            share = float(slider.get_attribute("value")) / 100 if share is None else share
            self.assertAlmostEqual(float(slider.get_attribute("value")) / 100, share)
            picture, border = self.shown(comparer), round(share * width)
            self.assertEqual(picture.shape, a.shape)
            # Three pixels on either side belong to the line that marks the border.
            numpy.testing.assert_array_equal(picture[:, :max(border - 3, 0)], a[:, :max(border - 3, 0)])
            # The clipped picture need not begin on a whole pixel of the screen, and its outermost are then blended.
            numpy.testing.assert_array_equal(picture[1:-1, border + 3:-1], b[1:-1, border + 3:-1])
        before = self.shown(comparer)
        pane = self.find(".pane", comparer)
        ActionChains(self.driver).move_to_element(pane).click_and_hold().move_by_offset(-width // 4, 0).release().perform()
        # The page may see the pointer a little after the driver has moved it.
        deadline = time.monotonic() + 5
        while abs(float(slider.get_attribute("value")) - 25.0) > 1.0 and time.monotonic() < deadline:
            time.sleep(0.02)
        self.assertAlmostEqual(float(slider.get_attribute("value")), 25.0, delta=1.0)
        self.assertGreater(numpy.abs(self.shown(comparer) - before).max(), 0)

    def test_flip_shows_one_picture_and_then_the_other(self):
        self.browser.open(self.page)
        comparer = self.comparer(table_of("caustics"))
        Select(self.find("select.zoom", comparer)).select_by_value("1")
        self.choose(comparer, "flip")
        a, b = self.pair(comparer)
        button = self.find(".flip", comparer)
        self.focus(button)
        for key, picture, pressed in ((None, a, "false"), (Keys.ENTER, b, "true"), (Keys.SPACE, a, "false")):
            if key:
                self.press(key)
            numpy.testing.assert_array_equal(self.shown(comparer), picture)
            self.assertEqual(button.get_attribute("aria-pressed"), pressed)

    def test_difference_shows_the_amplified_difference_of_the_two(self):
        self.browser.open(self.page)
        comparer = self.comparer(table_of("caustics"))
        Select(self.find("select.zoom", comparer)).select_by_value("1")
        self.choose(comparer, "difference")
        a, b = self.pair(comparer)
        gain = self.find(".gain", comparer)
        self.focus(gain)
        for key, factor in ((Keys.HOME, 1), (Keys.ARROW_RIGHT, 2), (Keys.ARROW_RIGHT, 4)):
            self.press(key)
            # The browser rounds each of its two steps, the difference and the product, to 8 bits.
            expected = numpy.clip(factor * numpy.abs(a - b), 0, 255)
            self.assertLessEqual(numpy.abs(self.shown(comparer) - expected).max(), factor + 1)

    def test_side_by_side_shows_both(self):
        self.browser.open(self.page)
        comparer = self.comparer(table_of("caustics"))
        Select(self.find("select.zoom", comparer)).select_by_value("1")
        self.choose(comparer, "side")
        a, b = self.pair(comparer)
        for side, picture in (("a", a), ("b", b)):
            image = self.find(f".pane img.{side}", comparer)
            self.assertTrue(image.is_displayed())
            self.assertEqual(image.get_attribute("naturalWidth"), str(picture.shape[1]))
        boxes = [self.find(f".pane img.{side}", comparer).rect for side in "ab"]
        self.assertLessEqual(boxes[0]["x"] + boxes[0]["width"], boxes[1]["x"])

    def test_whatever_can_be_used_or_looked_at_has_a_name(self):
        self.browser.open(self.page)
        self.browser.run("for (const details of document.querySelectorAll('details')) details.open = true;")
        seen = self.browser.accessible()
        roles = {role for role, _ in seen}
        for role in ("button", "link", "combobox", "slider", "radio", "searchbox", "image", "region", "navigation", "main"):
            self.assertTrue(role in roles or (role == "image" and "img" in roles), role)
        named = {"button", "link", "combobox", "slider", "radio", "searchbox", "image", "img", "region", "group"}
        nameless = [role for role, name in seen if role in named and not name and role != "group"]
        self.assertEqual(nameless, [])

    def test_its_structure_is_sound(self):
        self.browser.open(self.page)
        levels = [int(level) for level in self.browser.run(
            "return [...document.querySelectorAll('h1, h2, h3, h4, h5, h6')].map((h) => h.tagName[1])")]
        self.assertEqual(levels.count(1), 1)
        self.assertTrue(all(b <= a + 1 for a, b in zip(levels, levels[1:])), levels)
        ids = self.browser.run("return [...document.querySelectorAll('[id]')].map((e) => e.id)")
        self.assertEqual(len(ids), len(set(ids)))
        dangling = self.browser.run("""return [...document.querySelectorAll('a[href^="#"]')].map((a) => a.hash.slice(1))
                                              .filter((id) => !document.getElementById(decodeURIComponent(id)))""")
        self.assertEqual(dangling, [])
        self.assertEqual(self.browser.run("return document.documentElement.lang"), "en")

    def test_the_focus_can_be_seen_and_the_first_stop_skips_the_contents(self):
        self.browser.open(self.page)
        self.press(Keys.TAB)
        self.assertIn("Skip", self.browser.run("return document.activeElement.textContent"))
        for _ in range(40):
            self.press(Keys.TAB)
            outline = self.browser.run("""
                const e = document.activeElement, own = getComputedStyle(e), next = e.nextElementSibling;
                const styles = e.matches(".choice input") ? getComputedStyle(next) : own;
                return styles.outlineStyle === "none" ? e.outerHTML : "";""")
            self.assertEqual(outline, "")

    def test_text_keeps_its_contrast_in_light_and_in_dark(self):
        for scheme in ("light", "dark"):
            self.browser.open(self.page, prefers_color_scheme=scheme)
            self.browser.run("for (const details of document.querySelectorAll('details')) details.open = true;")
            self.assertEqual(self.browser.run(LOW_CONTRAST), [], scheme)
        self.browser.open(self.page, prefers_color_scheme="dark")
        dark = self.browser.run("return getComputedStyle(document.body).backgroundColor")
        self.assertLess(max(int(v) for v in dark.removeprefix("rgb(").removesuffix(")").split(",")), 60)

    def test_a_phone_scrolls_tables_but_not_the_page_sideways_and_keeps_their_first_column(self):
        self.browser.open(self.page, width=390, height=844)
        self.assertEqual(self.browser.run("return document.documentElement.scrollWidth"), 390)
        scroller = self.find(f"#run-{table_of('ssrm').stem} .rows .scroll")
        moved = self.browser.run("""
            const box = arguments[0], cell = box.querySelector("tbody th"), before = cell.getBoundingClientRect().x;
            box.scrollLeft = 10000;
            return [box.scrollLeft, cell.getBoundingClientRect().x - before, cell.getBoundingClientRect().width];""", scroller)
        self.assertGreater(moved[0], 100)
        self.assertAlmostEqual(moved[1], 0, delta=1)
        self.assertLess(moved[2], 390 / 2)

    def test_less_motion_is_respected(self):
        self.browser.open(self.page, prefers_reduced_motion="reduce")
        self.assertEqual(self.browser.run("return getComputedStyle(document.documentElement).scrollBehavior"), "auto")

    def test_without_scripts_everything_is_there_to_read(self):
        self.browser.open(self.page, scripts=False)
        self.assertTrue(self.find(".gallery img").is_displayed())
        self.assertFalse(self.find(".comparer").is_displayed())
        self.assertTrue(all(head.is_displayed() for head in self.find_all(f"#run-{table_of('ssrm').stem} .rows thead th")))

    def test_it_prints(self):
        self.browser.open(self.page)
        printed = self.browser.call("Page.printToPDF")
        self.assertGreater(len(printed["data"]), 20_000)
        self.browser.call("Emulation.setEmulatedMedia", media="print")
        self.assertFalse(self.find("nav").is_displayed())
        self.assertFalse(self.find(".tools").is_displayed())


if __name__ == "__main__":
    if len(sys.argv) < 2 or not Path(sys.argv[1]).is_dir():
        sys.exit(__doc__)
    RESULTS = Path(sys.argv.pop(1)).resolve()
    unittest.main()
