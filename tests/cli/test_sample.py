#!/usr/bin/env python3
"""powercell sample as a program.

usage: test_sample.py PATH_OF_POWERCELL [unittest options]
"""

import json
import math
import re
import struct
import unittest
import zlib

from tool import ToolTest, png, run


class Sample(ToolTest):
    def test_periodic_analysis(self):
        report = self.report("sample", "-n", "200", "--periodic", "--runs", "2", "--analysis", "a.json",
                             "-o", "p.csv", "-o", "p.svg", "-o", "p.png")
        self.assertLess(report["mean"]["capacity_error"], 1e-6)
        self.assertTrue(0.8 < report["mean"]["mean_distance"] < 0.95)
        self.assertTrue(0.55 < report["mean"]["hexatic"] < 0.68)
        self.assertLess(report["spectrum"]["low_frequency"], 0.01)
        low = {one["cutoff"]: one["power"] for one in report["spectrum"]["low_frequencies"]}
        self.assertEqual(low[0.5], report["spectrum"]["low_frequency"])
        self.assertTrue(0 < low[0.3] < low[0.4] < low[0.44] < low[0.5] < low[0.6] < 0.02)
        analysis = json.loads((self.folder / "a.json").read_text())
        side = 2 * analysis["spectrum"]["highest"] + 1
        self.assertEqual(len(analysis["spectrum"]["power"]), side * side)
        self.assertEqual(len(analysis["runs"]), 2)
        rows = self.rows("p.csv")
        self.assertEqual(len(rows), 200)
        for row in rows:
            self.assertAlmostEqual(float(row["mass"]) * 200, 1, delta=1e-6)
            self.assertTrue(0 <= float(row["x"]) <= 1 and 0 <= float(row["y"]) <= 1)
        # Recomputes the spectrum from the points of the file; the first run is half of the mean.
        self.assertEqual((self.folder / "p.svg").read_text().count("<circle"), 200)

    def test_table_is_a_diagram_of_equal_masses(self):
        self.report("sample", "-n", "50", "--domain", "disk", "--mode", "quantise", "--movement", "0.01",
                    "-o", "p.txt", "--cells", "c.svg")
        self.good("diagram", "--domain", "disk", "--seeds", "p.txt", "--table", "t.csv")
        areas = [float(row["measure"]) for row in self.rows("t.csv")]
        self.assertEqual(len(areas), 50)
        for area in areas:
            self.assertAlmostEqual(area * 50 / sum(areas), 1, delta=1e-6)
        self.assertIn("<path", (self.folder / "c.svg").read_text())

    def test_dots_have_the_ink_of_the_image(self):
        for bits, white in ((8, 255), (16, 65535)):
            # Black below, white above, and a gray of the file in between.
            self.image("i.png", [[white] * 30] * 10 + [[white // 2] * 30] * 10 + [[0] * 30] * 10, bits)
            self.report("sample", "-n", "300", "--image", "i.png", "-o", "i.svg", "-o", "i.csv")
            rows = self.rows("i.csv")
            self.assertFalse([row for row in rows if float(row["y"]) > 20.5])
            below = [row for row in rows if float(row["y"]) < 10]
            self.assertGreater(len(below), 150)
            circles = re.findall(r'<circle cx="([\d.]+)" cy="([\d.]+)" r="([\d.]+)"',
                                 (self.folder / "i.svg").read_text())
            self.assertEqual(len(circles), 300)
            scale = 1600 / 30
            ink = sum(math.pi * float(r) ** 2 for _, _, r in circles) / scale**2
            half = 1 - ((0.5 + 0.055) / 1.055) ** 2.4  # sRGB
            self.assertAlmostEqual(ink, 300 * (1 + half), delta=4)

    def test_bright_parts(self):
        self.image("i.png", [[255] * 8 + [0] * 8] * 8)
        self.report("sample", "-n", "40", "--image", "i.png", "--bright", "-o", "i.csv")
        self.assertTrue(all(float(row["x"]) < 8 for row in self.rows("i.csv")))

    def colour_image(self, name, rows):
        """A picture of rows of (r, g, b)."""
        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        data = b"".join(b"\0" + b"".join(bytes(pixel) for pixel in row) for row in rows)
        size = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
        (self.folder / name).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size) +
                                         chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))

    def test_dots_in_the_colours_of_the_image(self):
        left, right, white = (180, 30, 30), (20, 60, 160), (255, 255, 255)
        self.colour_image("i.png", [[left] * 10 + [white] * 4 + [right] * 10] * 20)
        self.good("sample", "-n", "150", "--image", "i.png", "--color", "-o", "i.csv", "-o", "i.svg", "-o", "i.png.png",
                  "-o", "i.txt")
        rows = self.rows("i.csv")
        svg = (self.folder / "i.svg").read_text()
        fills = re.findall(r'<circle [^>]*fill="#(\w+)"/>', svg)
        self.assertEqual(len(fills), 150)
        # Cells away from the gap have one colour each; the paper in it has no ink.
        for row, fill in zip(rows, fills):
            colour = tuple(int(row[c]) for c in "rgb")
            meant = left if float(row["x"]) < 12 else right
            if not 6 < float(row["x"]) < 18:
                self.assertLessEqual(max(abs(a - b) for a, b in zip(colour, meant)), 1, row)
            self.assertEqual(bytes(colour).hex(), fill)
        self.assertEqual(len((self.folder / "i.txt").read_text().split("\n")[0].split()), 3)
        # Bright parts on dark paper.
        self.good("sample", "-n", "60", "--image", "i.png", "--color", "--bright", "-o", "b.svg")
        self.assertRegex((self.folder / "b.svg").read_text(), '<rect [^>]*fill="#101012"')
        # Where a cell has two colours, its dot has their mean in linear light by their ink.
        self.colour_image("two.png", [[left, right]])
        self.good("sample", "-n", "1", "--image", "two.png", "--color", "--dot-contrast", "0", "-o", "two.csv")
        light = [lambda c: (c / 255 / 12.92 if c / 255 <= .04045 else ((c / 255 + .055) / 1.055) ** 2.4)][0]
        ink = [1 - sum(w * light(c) for w, c in zip((.2126, .7152, .0722), colour)) for colour in (left, right)]
        row = self.rows("two.csv")[0]
        for k, c in enumerate("rgb"):
            mean = (ink[0] * light(left[k]) + ink[1] * light(right[k])) / sum(ink)
            self.assertAlmostEqual(light(int(row[c])), mean, delta=.004)

    def test_colours_without_one_of_the_channels(self):
        black, red, white = (0, 0, 0), (255, 0, 0), (255, 255, 255)
        for bright, seen in (((), {(0, 0, 0), (255, 0, 0)}), (("--bright",), {(255, 0, 0)})):
            self.colour_image("i.png", [[black] * 10 + [red] * 10 + [black if bright else white] * 10] * 10)
            self.good("sample", "-n", "40", "--image", "i.png", "--color", *bright, "-o", "i.csv")
            colours = {tuple(int(row[c]) for c in "rgb") for row in self.rows("i.csv")}
            self.assertLessEqual(seen, colours)
            self.assertTrue(all(g == b == 0 for _, g, b in colours), colours)

    def test_colours_need_an_image_and_a_place(self):
        self.image("ink.png", [[0] * 4] * 4)
        self.bad(2, "--color requires --image", "sample", "-n", "9", "--color", "-o", "a.svg")
        for files in ((), ("-o", "a.txt"), ("--cells", "a.svg")):
            self.bad(2, "--color is for pictures and tables of points", "sample", "-n", "9", "--image", "ink.png",
                     "--color", *files)

    def test_experiments_of_the_paper(self):
        report = self.report("sample", "--paper", "2", "-n", "100", "--iterations", "10")
        self.assertEqual(report["runs"][0]["iterations"], 10)
        self.assertLess(report["mean"]["capacity_error"], 1e-6)
        report = self.report("sample", "--paper", "3", "-n", "60", "--iterations", "3")
        self.assertIsNone(report["mean"]["hexatic"])
        self.assertLess(report["mean"]["capacity_error"], 1e-6)

    def test_bad_input(self):
        self.image("blank.png", [[255] * 4] * 4)
        self.image("ink.png", [[0] * 4] * 4)
        (self.folder / "cut.png").write_bytes(png([[0] * 40] * 40)[:60])
        self.write("text.png", "not a picture")
        for code, pattern, arguments in [
                (1, "blank", ["--image", "blank.png"]),
                (1, "not a PNG or JPEG", ["--image", "text.png"]),
                (1, "damaged", ["--image", "cut.png"]),
                (1, "missing.png", ["--image", "missing.png"]),
                (1, "polygon", ["--image", "ink.png", "--domain", "sphere"]),
                (1, "formula", ["--density", "1 +"]),
                (1, "x = ", ["--density", "x - 0.5"]),
                (2, "cannot be combined", ["--density", "x", "--image", "ink.png"]),
                (1, "constant", ["--density", "1+x", "--periodic"]),
                (1, "box", ["--domain", "disk", "--periodic"]),
                (1, "axes", ["--periodic=w"]),
                (1, "--image", ["--image", "ink.png", "--periodic"]),
                (1, "1,5", ["--density", "1,5+x"]),
                (2, "extension", ["-o", "points.jpg"]),
                (1, "need a polygon domain", ["--domain", "cube", "-o", "points.png"]),
                (1, "--paper", ["--paper", "2", "--domain", "disk"]),
                (2, "paper", ["--paper", "4"]),
                (2, "mode", ["--mode", "pink"]),
                (2, "points", ["-n", "0"]),
                (2, "points", ["-n", "-3"]),
        ]:
            self.bad(code, pattern, "sample", "-n", "20", *arguments)

    def test_one_point_has_no_distances(self):
        done = run("sample", "-n", "1", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("distances", done.stdout)

    def test_spectra_of_many_points_only_on_request(self):
        for more, told in [([], False), (["--analysis", "a.json"], True)]:
            done = run("sample", "-n", "5000", "--periodic", "--iterations", "1", *more, cwd=self.folder)
            self.assertRegex(done.stderr, "the hexatic order is .*, not 0.610")
            self.assertEqual("low-frequency" in done.stdout, told)

    def thin_plate(self, name, thickness):
        """The square [0, 1]^2 and another one above, closed by a rim."""
        corners = [(x, y, z) for z in (0, thickness) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        rim = [(k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4) for k in range(4)]
        faces = [(3, 2, 1, 0), (4, 5, 6, 7), *rim]
        return self.write(name, "".join(f"v {x} {y} {z}\n" for x, y, z in corners) +
                          "".join(f"f {a + 1} {b + 1} {c + 1}\nf {a + 1} {c + 1} {d + 1}\n" for a, b, c, d in faces))

    def test_sides_of_a_thin_plate(self):
        spacing = math.sqrt(2 / 500)
        for part in (0.1, 0.25, 0.5):
            self.thin_plate("plate.obj", part * spacing)
            report = self.report("sample", "-n", "500", "--domain", "plate.obj", "-o", "p.csv")
            found = report["runs"][0]
            self.assertEqual(sum(found["layers"]), 500)
            self.assertEqual(len(found["layers"]), 2)
            below = sum(float(row["z"]) < part * spacing / 2 for row in self.rows("p.csv"))
            self.assertAlmostEqual(below, 250, delta=3 + 500 * part * spacing)
            self.assertGreater(found["mean_distance"], 0.84)
            self.assertRegex(report["notes"][0], "2 layers")
        # The number of points that the note of the last one names has cells that keep to their sides.
        self.assertGreater(found["apart"]["share"], 0.01)
        count = re.search(r"some ([\d,]+) points", report["notes"][0])[1].replace(",", "")
        report = self.report("sample", "-n", count, "--domain", "plate.obj")
        self.assertEqual(report["notes"], [])
        self.assertEqual(report["runs"][0]["layers"], [])
        self.assertLess(report["runs"][0]["apart"]["share"], 0.01)

    def test_parts_apart_are_noted(self):
        self.thin_plate("plate.obj", 0.1 * math.sqrt(2 / 500))
        done = self.good("sample", "-n", "500", "--domain", "plate.obj", "--mode", "quantise", "--movement",
                         "0", "--iterations", "3")
        self.assertRegex(done.stderr, r"note: plate.obj: [3-5]\d % of the area .* --mode blue")
        fingers = [[x, y] for k in range(20) for x, y in ((k, 0), (k, 20), (k + .9, 20), (k + .9, 0))]
        ring = [[0, -1], *fingers, [19.9, -1], [0, -1]]
        self.write("comb.json", json.dumps({"type": "Polygon", "coordinates": [ring]}))
        report = self.report("sample", "-n", "100", "--domain", "comb.json")
        self.assertGreater(report["runs"][0]["apart"]["share"], 0.1)
        self.assertRegex(report["notes"][0], r"of the area lies in parts of \d+ cells")
        self.assertEqual(self.report("sample", "-n", "100", "--domain", "disk")["notes"], [])

    def test_inside_a_closed_surface(self):
        side = ["1 2 4", "1 4 3", "5 7 8", "5 8 6", "1 5 6", "1 6 2", "3 4 8", "3 8 7", "1 3 7", "1 7 5", "2 6 8",
                "2 8 4"]
        corners = [f"v {x} {y} {z}" for z in (0, 2) for y in (0, 3) for x in (0, 5)]
        self.write("box.obj", "\n".join(corners + [f"f {one}" for one in side]) + "\n")
        on = self.good("sample", "-n", "40", "--domain", "box.obj", "-o", "on.csv")
        self.assertIn("points lie on it (--solid takes its inside)", on.stdout)
        inside = self.good("sample", "-n", "40", "--domain", "box.obj", "--solid", "-o", "in.csv")
        self.assertIn("box.obj: solid", inside.stdout)
        for name, total, deep in (("on.csv", 62, False), ("in.csv", 30, True)):
            rows = self.rows(name)
            self.assertAlmostEqual(sum(float(row["mass"]) for row in rows), total, delta=1e-4)
            depth = [min(min(float(row[axis]), high - float(row[axis])) for axis, high in zip("xyz", (5, 3, 2)))
                     for row in rows]
            self.assertEqual(max(depth) > 0.5, deep)
        self.assertNotIn("lie on it", self.good("sample", "-n", "9", "--domain", "box.obj", "--kind", "surface").stdout)
        self.bad(1, "--solid takes the inside of a closed surface, but square is a polygon", "sample", "--domain",
                 "square", "--solid")

    def test_not_converged_is_reported_and_the_best_kept(self):
        done = run("sample", "-n", "100", "--mode", "quantise", "--movement", "1e-9", "--iterations", "2",
                   "-o", "p.csv", cwd=self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "not converged after 2 iterations")
        self.assertEqual(len(self.rows("p.csv")), 100)


if __name__ == "__main__":
    unittest.main(verbosity=2)
