"""Pages of `-o view.html`, opened in a browser, and what tests of them share."""

import csv
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

import browser as chromium

TOOL = pathlib.Path(sys.argv.pop(1)).resolve()
DESKTOP = (900, 600)


def power(point, seed):
    return sum((a - b) ** 2 for a, b in zip(point, seed["position"])) - seed["weight"]


def owner(point, seeds):
    """The definition of a cell: the seed of least power distance, or None where two are nearly equal."""
    ranked = sorted(seeds, key=lambda seed: power(point, seed))
    if len(ranked) > 1 and power(point, ranked[1]) - power(point, ranked[0]) < 1e-3:
        return None
    return ranked[0]["seed"]


class Page:
    """A diagram, written as a page, as JSON and as a table, and opened."""

    def __init__(self, test, *arguments, name="view.html", size=DESKTOP, phone=False):
        self.test = test
        folder = test.folder
        done = subprocess.run([TOOL, "diagram", *map(str, arguments), "-o", name, "-o", "d.json", "--table", "t.csv"],
                              cwd=folder, text=True, capture_output=True)
        test.assertEqual(done.returncode, 0, done.stderr)
        self.cells = json.loads((folder / "d.json").read_text())["cells"]
        with (folder / "t.csv").open() as table:
            self.rows = list(csv.DictReader(table))
        self.tab = chromium.Tab(test.browser, *size, scale=3 if phone else 1, phone=phone)
        test.addCleanup(self.tab.close)
        self.tab.open(folder / name)
        test.assertEqual(self.tab.evaluate("document.documentElement.dataset.state"), "ready",
                         self.tab.evaluate("document.getElementById('message').textContent"))
        self.frame = self.tab.evaluate("JSON.parse(document.getElementById('diagram').textContent).frame")
        self.settle()
        left, top, width, height = self.box = self.tab.evaluate(
            "(({left, top, width, height}) => [left, top, width, height])(canvas.getBoundingClientRect())")
        self.part = [left / size[0], top / size[1], width / size[0], height / size[1]]

    def settle(self):
        """Waits for the fine picture of what was asked for before."""
        self.tab.wait("document.getElementById('canvas').dataset.drawn === 'fine'")

    def place(self, point):
        """Where a point of the domain is in the window."""
        at = [(x - o) / self.frame["scale"] for x, o in zip(point, self.frame["offset"])] + [0] * (3 - len(point)) + [1]
        m = [float(x) for x in self.tab.evaluate("canvas.dataset.matrix").split()]
        x, y, _, w = (sum(m[4 * k + row] * at[k] for k in range(4)) for row in range(4))
        left, top, width, height = self.box
        return left + (1 + x / w) / 2 * width, top + (1 - y / w) / 2 * height

    def choose(self, point):
        """Presses at a point of the domain, and returns the row that the page shows."""
        self.tab.press(*self.place(point))
        return self.row()

    def row(self):
        return dict(self.tab.evaluate("[...document.querySelectorAll('#row tr')].map((r) => [...r.cells].map((c) => c.textContent))"))

    def set(self, control, value, event="change"):
        self.tab.evaluate(f"""(() => {{ const node = document.getElementById({json.dumps(control)});
            if (node.type === 'checkbox') node.checked = {json.dumps(value)}; else node.value = {json.dumps(value)};
            node.dispatchEvent(new Event({json.dumps(event)})); }})()""")
        self.settle()

    def slice(self, axis):
        self.tab.evaluate(f"document.querySelector('[data-axis={axis}]').click()")
        self.settle()

    def picture(self, name):
        picture = self.tab.screenshot()
        if "POWERCELL_VIEW_PICTURES" in os.environ:
            (pathlib.Path(os.environ["POWERCELL_VIEW_PICTURES"]) / (name + ".png")).write_bytes(picture)
        return picture

    def check_row(self, seed, row):
        """The row in the page has the numbers of the table."""
        expected = self.rows[seed]
        self.test.assertEqual(row["seed"], str(seed))
        for name in ("weight", "measure", "second_moment", "neighbors"):
            self.test.assertEqual(float(row[name]), float(expected[name]), name)
        self.test.assertEqual(row["status"], expected["status"])
        self.test.assertEqual([float(x) for x in row["position"].split(",")], self.cells[seed]["position"])
        if row["status"] == "ok":
            self.test.assertEqual([float(x) for x in row["centroid"].split(",")],
                                  [float(expected[name]) for name in ("cx", "cy", "cz") if name in expected])

    def check_clean(self):
        self.test.assertEqual(self.tab.complaints(), [])


class ViewTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = chromium.Browser(chromium.find())
        cls.addClassCleanup(cls.browser.close)
        cls.eyes = chromium.Eyes(cls.browser)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.random = random.Random(1)

    def write(self, name, rows):
        with (self.folder / name).open("w", newline="") as file:
            csv.writer(file).writerows(rows)
        return name

    def seeds(self, count, low, high, weight, columns=lambda k: []):
        rows = [[*(self.random.uniform(a, b) for a, b in zip(low, high)), self.random.uniform(0, weight), *columns(k)]
                for k in range(count)]
        return rows

    def check_picks(self, page, points):
        """Presses at points, where the page must show the cell that owns them. Most must be decided."""
        decided = 0
        for point in points:
            seed = owner(point, page.cells)
            if seed is not None:
                page.check_row(seed, page.choose(point))
                decided += 1
        self.assertGreater(decided, len(points) / 2)

    def check_seen(self, picture, page, least, most=None):
        """The picture has at least so many colours that fill a part of it, and is not one of noise."""
        colours = self.eyes.colours(picture, page.part)
        large = [colour for colour, share in colours if share > 2e-4]
        self.assertGreaterEqual(len(large), least)
        self.assertLess(max(share for _, share in colours), 0.9, "the picture is blank")
        if most:
            self.assertLessEqual(len(large), most)
        return large
