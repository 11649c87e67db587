#!/usr/bin/env python3
"""Pages of `-o view.html` in a browser: what they show, and that they show the row of the cell that is pointed at.

usage: test_view.py PATH_OF_POWERCELL [unittest options]
exit:  77 where no Chromium is installed. POWERCELL_VIEW_PICTURES=FOLDER keeps the screenshots.
"""

import json
import math
import pathlib
import sys
import unittest

import browser as chromium
from pages import DESKTOP, Page, ViewTest, owner, power

DATA = pathlib.Path(__file__).resolve().parents[2] / "examples" / "data"
PHONE = (390, 844)
NASTY = '</script><script>document.title="broken"</script><img src=x onerror=alert(1)> "\' &amp;'


class Flat(ViewTest):
    def page(self, *arguments, **options):
        # Some seeds are hidden by a heavy one, and two are at the same place.
        rows = self.seeds(40, (0, 0), (2, 1), 0.01, lambda k: [k * k if k != 7 else "", ("river", NASTY, "lake")[k % 3]])
        rows[0][:3] = [1, 0.5, 0.06]
        rows[1][:3] = [1.01, 0.5, -0.5]
        rows[2][:2] = rows[3][:2]
        name = self.write("seeds.csv", [["x", "y", "weight", "people", NASTY], *rows])
        return Page(self, "--domain", "box:0,0:2,1", "--seeds", name, *arguments, **options)

    def test_cells_and_rows(self):
        page = self.page()
        picture = page.picture("flat")
        self.check_seen(picture, page, 30)
        self.check_picks(page, [(self.random.uniform(0.02, 1.98), self.random.uniform(0.02, 0.98)) for _ in range(15)])
        row = page.choose((0.9, 0.52))
        self.assertEqual(row["seed"], "0")
        self.assertEqual((row["people"], row[NASTY]), ("0", "river"))
        self.assertGreater(self.eyes.change(picture, page.picture("flat-chosen"), page.part), 0.002)
        self.assertEqual(page.tab.evaluate("document.title"), "view: power diagram of 40 seeds")
        counts = [sum(row["status"] == status for row in page.rows) for status in ("ok", "hidden", "duplicate")]
        self.assertRegex(page.tab.evaluate("check.textContent"), "^{} cells, {} hidden, {} duplicate; sum of measures / domain "
                         r"= 1( [+−] \d\.\de-1\d)?$".format(*counts))
        page.check_clean()

    def test_seeds_without_a_cell_are_listed(self):
        page = self.page()
        listed = page.tab.evaluate("[...document.querySelectorAll('#without-list button')].map((b) => b.textContent)")
        expected = [f"seed {k}, {row['status']}" for k, row in enumerate(page.rows) if row["status"] != "ok"]
        self.assertEqual(listed, expected)
        self.assertEqual({text.split(", ")[1] for text in listed}, {"hidden", "duplicate"})
        page.tab.evaluate("document.querySelector('#without-list button').click()")
        page.check_row(1, page.row())
        self.assertEqual(page.row()["centroid"], "–")

    def test_colours(self):
        page = self.page()
        before = page.picture("flat")
        names = page.tab.evaluate("[...colour.options].map((o) => o.textContent)")
        self.assertEqual(names, ["cells apart", "measure", "weight", "neighbors", "people", NASTY])
        page.set("dots", False)
        for k, name in enumerate(names[1:]):
            page.set("colour", str(k))
            after = page.picture(f"flat-colour-{k}")
            self.assertGreater(self.eyes.change(before, after, page.part), 0.2, name)
        # Three classes, lines, background, and what lies between at edges.
        seen = self.check_seen(after, page, 4, most=60)
        legend = page.tab.evaluate("""[...document.querySelectorAll('.classes li')].map((li) =>
            [li.children[1].textContent, getComputedStyle(li.firstChild).backgroundColor.match(/\\d+/g).map(Number)])""")
        self.assertEqual(sorted(name for name, _ in legend), sorted(["river", NASTY, "lake"]))
        for name, colour in legend:
            self.assertTrue(any(max(abs(a - b) for a, b in zip(colour, other)) <= 1 for other in seen), name)
        page.set("colour", "3")
        self.assertIn("no value (1)", page.tab.evaluate("legend.textContent"))
        ranks = page.picture("people")
        page.set("scale", "rank")
        self.assertGreater(self.eyes.change(ranks, page.picture("people-rank"), page.part), 0.05)
        page.check_clean()

    def test_colours_chosen_by_the_tool(self):
        for options, chosen in (((), "cells apart"), (("--color-by", "area"), "measure"), (("--color-by", "people"), "people")):
            page = self.page(*options)
            self.assertEqual(page.tab.evaluate("colour.selectedOptions[0].textContent"), chosen)

    def test_columns_of_any_name_can_be_chosen(self):
        # One that the page has a name for already, one that holds the weights, and colours as they are.
        table = [["x", "y", "heavy", "status", "paint"]] + [[x / 4, y / 4, 0.01 * x, f"s{x}", f"#{x}0{y}0f0"] for x in (1, 2, 3)
                                                            for y in (1, 2, 3)]
        name = self.write("s.csv", table)
        for column, shown in (("status", "input_status"), ("heavy", "heavy"), ("paint", "paint")):
            page = Page(self, "--domain", "square", "--seeds", name, "--weight-column", "heavy", "--color-by", column)
            self.assertEqual(page.tab.evaluate("colour.selectedOptions[0].textContent"), shown)
            page.set("dots", False)
            seen = page.tab.evaluate("[...document.querySelectorAll('.classes li')].map((li) => li.children[1].textContent)")
            self.assertEqual(seen, ["s1", "s2", "s3"] if column == "status" else [])
            if column == "paint":
                x, y = page.place((0.25, 0.75))
                box = [x / DESKTOP[0], y / DESKTOP[1], 1.01 / DESKTOP[0], 1.01 / DESKTOP[1]]
                self.assertEqual(self.eyes.colours(page.picture("paint"), box)[0][0], [0x10, 0x30, 0xf0])

    def test_only_the_cells_of_a_range(self):
        page = self.page()
        page.set("colour", "0")
        areas = sorted(float(row["measure"]) for row in page.rows)
        page.set("from", str(areas[-3]))
        page.set("dots", False)
        page.picture("flat-largest")
        for k, row in enumerate(page.rows):
            if row["status"] == "ok":
                seen = page.choose(page.cells[k]["centroid"])
                self.assertEqual(seen.get("seed"), str(k) if float(row["measure"]) >= areas[-3] else None)
        page.set("from", "many")
        self.assertIn("is not a number", page.tab.evaluate("hint.textContent"))
        self.check_picks(page, [(0.5, 0.5), (1.5, 0.5), (1, 0.9)])

    def test_the_scale_is_even_to_the_eye(self):
        page = self.page()
        page.set("colour", "0")
        stops = [tuple(map(int, c.split(", "))) for c in page.tab.evaluate(
            "getComputedStyle(document.querySelector('.bar')).backgroundImage.match(/\\d+, \\d+, \\d+/g)")]
        lab = [oklab(stop) for stop in stops]
        self.assertGreater(len(lab), 10)
        steps = [math.dist(a, b) for a, b in zip(lab, lab[1:])]
        self.assertLess(max(steps), 1.35 * min(steps))
        lightness = [colour[0] for colour in lab]
        self.assertTrue(all(b - a > 0.02 for a, b in zip(lightness, lightness[1:])), lightness)
        # Values and colours agree: the largest cell has the last colour, the smallest the first.
        areas = [float(row["measure"]) or math.nan for row in page.rows]
        page.set("dots", False)
        picture = page.picture("measure")
        for value, stop in ((max(a for a in areas if a == a), stops[-1]), (min(a for a in areas if a == a), stops[0])):
            cell = page.cells[areas.index(value)]
            x, y = page.place(cell["centroid"])
            box = [x / DESKTOP[0], y / DESKTOP[1], 1.01 / DESKTOP[0], 1.01 / DESKTOP[1]]
            colour = self.eyes.colours(picture, box)[0][0]
            self.assertLessEqual(max(abs(a - b) for a, b in zip(colour, stop)), 2)

    def test_moving_and_keys(self):
        page = self.page()
        before = page.picture("flat")
        left, top, width, height = page.box
        page.tab.drag(left + width / 2, top + height / 2, 90, 40)
        page.settle()
        self.assertEqual(page.row(), {})  # a drag chooses nothing
        self.assertGreater(self.eyes.change(before, page.picture("flat-moved"), page.part), 0.1)
        self.check_picks(page, [(0.6, 0.5), (1.3, 0.42), (1.1, 0.7)])
        page.tab.key("0")
        page.tab.key("+")
        page.tab.key("+")
        page.settle()
        page.tab.key("Enter")  # the cell in the middle, which is still that of the box
        page.check_row(owner((1, 0.5), page.cells), page.row())
        page.tab.key("n")
        page.check_row(1, page.row())
        page.tab.key("Escape")
        self.assertEqual(page.row(), {})
        page.tab.call("Input.dispatchMouseEvent", type="mouseWheel", x=left + 40, y=top + 200, deltaX=0, deltaY=-300)
        page.settle()
        self.check_picks(page, [(0.95, 0.5), (1.02, 0.52), (1.0, 0.45)])
        page.check_clean()

    def test_a_number_finds_its_seed(self):
        page = self.page()
        for text, found in (("17", "17"), ("40", "17"), ("x", "17"), ("", "17")):
            page.tab.evaluate(f"seed.value = {json.dumps(text)}; document.getElementById('find').requestSubmit()")
            self.assertEqual(page.row()["seed"], found)
        self.assertIn("0 to 39", page.tab.evaluate("hint.textContent"))

    def test_on_a_phone(self):
        page = self.page(size=PHONE, phone=True)
        page.picture("phone-flat")
        self.check_picks(page, [(self.random.uniform(0.1, 1.9), self.random.uniform(0.1, 0.9)) for _ in range(6)])
        self.assertLessEqual(page.tab.evaluate("document.scrollingElement.scrollWidth"), PHONE[0])
        before = page.tab.evaluate("canvas.dataset.matrix")
        x, y = page.place((1, 0.5))
        page.tab.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x - 20, "y": y}, {"x": x + 20, "y": y}])
        page.tab.call("Input.dispatchTouchEvent", type="touchMove", touchPoints=[{"x": x - 60, "y": y}, {"x": x + 60, "y": y}])
        page.tab.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        page.settle()
        after = page.tab.evaluate("canvas.dataset.matrix")
        self.assertAlmostEqual(float(after.split()[0]) / float(before.split()[0]), 3, delta=0.2)
        small = page.tab.evaluate("""[...document.querySelectorAll('button, select, input:not([type=range], [type=checkbox])')]
            .filter((node) => node.offsetParent && node.offsetHeight < 32 && !node.closest('#without-list')).map((node) => node.outerHTML)""")
        self.assertEqual(small, [])
        page.picture("phone-flat-pinched")
        page.check_clean()

    def test_dark_and_light(self):
        page = self.page()
        light = page.picture("light")
        page.tab.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        page.settle()
        dark = page.picture("dark")
        corner = [page.part[0] + 0.002, page.part[1] + 0.01, 0.01, 0.01]
        self.assertGreater(min(self.eyes.colours(light, corner)[0][0]), 240)
        self.assertLess(max(self.eyes.colours(dark, corner)[0][0]), 60)
        page.tab.evaluate("theme.click()")
        page.settle()
        self.assertGreater(min(self.eyes.colours(page.picture("light-again"), corner)[0][0]), 240)


def oklab(colour):
    """OKLab of a colour in sRGB, by the matrices of its definition."""
    def linear(channel):
        c = channel / 255
        return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4
    r, g, b = map(linear, colour)
    l, m, s = (value ** (1 / 3) for value in (
        0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b,
        0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b,
        0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b))
    return (0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s)


class Space(ViewTest):
    def cube(self, count=60):
        rows = self.seeds(count, (10, 20, 30), (11, 21, 31), 0.01)
        return Page(self, "--domain", "box:10,20,30:11,21,31", "--seeds",
                    self.write("seeds.csv", [["x", "y", "z", "weight"], *rows]))

    def spread(self, point, axis, value):
        """Random points on a side of the cube that is in sight."""
        points = [[low + self.random.uniform(0.05, 0.95) for low in point] for _ in range(5)]
        for at in points:
            at[axis] = value
        return points

    def test_faces_of_a_cube(self):
        page = self.cube()
        self.check_seen(page.picture("cube"), page, 25)
        for axis, value in ((0, 11), (1, 20), (2, 31)):  # the sides towards the camera
            self.check_picks(page, self.spread((10, 20, 30), axis, value))
        page.check_clean()

    def test_a_slice_shows_the_cells_in_its_plane(self):
        page = self.cube()
        before = page.picture("cube")
        for axis, name, value in ((2, "z", 30.5), (0, "x", 10.5), (1, "y", 20.5)):
            page.slice(name)
            self.assertGreater(self.eyes.change(before, page.picture("cube-" + name), page.part), 0.15)
            self.assertIn(f"{name} = {value}", page.tab.evaluate("document.getElementById('depth-value').textContent"))
            self.check_picks(page, self.spread((10, 20, 30), axis, value))
        page.set("depth", "250", "input")
        self.check_picks(page, self.spread((10, 20, 30), 1, 20.25))
        page.slice("view")
        self.assertGreater(self.eyes.change(before, page.picture("cube-view"), page.part), 0.15)
        page.slice("none")
        page.tab.evaluate("canvas.focus()")
        page.tab.key("Escape")
        page.settle()
        self.assertLess(self.eyes.change(before, page.picture("cube-whole"), page.part), 0.02)
        page.check_clean()

    def test_turned_about_a_slice_still_shows_its_cells(self):
        page = self.cube()
        page.slice("x")
        left, top, width, height = page.box
        page.tab.drag(left + width / 2, top + height / 2, -120, 60)
        page.settle()
        page.picture("cube-turned")
        self.check_picks(page, self.spread((10, 20, 30), 0, 10.5))

    def test_whole_cells_and_cells_apart(self):
        page = self.cube()
        page.slice("z")
        cut = page.picture("cube-z")
        page.set("whole", True)
        whole = page.picture("cube-z-whole")
        self.assertGreater(self.eyes.change(cut, whole, page.part), 0.05)
        page.slice("none")
        together = page.picture("cube")
        page.set("apart", "0.6", "input")
        apart = page.picture("cube-apart")
        self.assertGreater(self.eyes.change(together, apart, page.part), 0.2)
        self.check_seen(apart, page, 25)
        page.check_clean()

    def test_surface(self):
        page = Page(self, "--domain", "sphere:24", "--seeds", "random:50:0:0.02:3")
        self.check_seen(page.picture("sphere"), page, 25)
        # Corners of triangles that face the camera.
        back = page.tab.evaluate("canvas.dataset.matrix")
        m = [float(x) for x in back.split()]
        towards = [-m[4 * k + 3] for k in range(3)]
        norm = math.sqrt(sum(t * t for t in towards))
        seen = [v for cell in page.cells for v in cell["vertices"][::3]
                if sum(a * b for a, b in zip(v, towards)) > 0.6 * norm]
        self.check_picks(page, [tuple(v) for v in self.random.sample(seen, 12)])
        closed = page.picture("sphere")
        page.slice("view")
        self.assertGreater(self.eyes.change(closed, page.picture("sphere-view"), page.part), 0.1)
        page.check_clean()

    def test_parts_with_holes(self):
        for name, more in (("bracket.mesh", []), ("pretzel.off", ["--solid"]), ("pretzel.off", [])):
            page = Page(self, "--domain", DATA / name, *more, "--seeds", "random:200")
            picture = page.picture(name.split(".")[0] + "".join(more))
            self.check_seen(picture, page, 40)
            page.slice("view")
            self.assertGreater(self.eyes.change(picture, page.picture(name.split(".")[0] + "".join(more) + "-view"), page.part), 0.05)
            page.check_clean()

    def test_on_a_phone(self):
        rows = self.seeds(60, (0, 0, 0), (1, 1, 1), 0.01)
        page = Page(self, "--domain", "cube", "--seeds", self.write("seeds.csv", [["x", "y", "z", "weight"], *rows]),
                    size=PHONE, phone=True)
        page.slice("z")
        page.picture("phone-cube")
        self.check_picks(page, self.spread((0, 0, 0), 2, 0.5))
        self.assertLessEqual(page.tab.evaluate("document.scrollingElement.scrollWidth"), PHONE[0])
        page.check_clean()


class Periodic(ViewTest):
    def test_cells_are_whole(self):
        for domain, name in (("square", "periodic"), ("cube", "periodic-cube")):
            page = Page(self, "--domain", domain, "--periodic", "--seeds", "random:14:0:0.01:2")
            self.check_seen(page.picture(name), page, 10)
            if domain == "square":
                for cell in page.cells:  # convex: it contains its centroid, and no other cell is there
                    if cell["status"] == "ok":
                        page.check_row(cell["seed"], page.choose(cell["centroid"]))
            page.check_clean()


if __name__ == "__main__":
    if chromium.find() is None:
        print("skipped: Chromium is not installed (Debian's package chromium)")
        sys.exit(77)
    unittest.main()
