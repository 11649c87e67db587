#!/usr/bin/env python3
"""Tables of cells and walls, cells of some seeds, and solids.

usage: test_tables.py PATH_OF_POWERCELL [unittest options]
"""

import json
import math
import unittest

from tool import DATA, ToolTest


def polygon_area(p):
    """Of a flat polygon in space."""
    twice = [0, 0, 0]
    for k in range(1, len(p) - 1):
        a, b = [p[k][c] - p[0][c] for c in range(3)], [p[k + 1][c] - p[0][c] for c in range(3)]
        for c in range(3):
            twice[c] += a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3]
    return math.hypot(*twice) / 2


class Tables(ToolTest):
    def test_tables(self):
        self.good("diagram", "--domain", "square", "--seeds", "random:200:0:0.01", "--table", "t.csv", "--walls",
                  "w.csv", "-o", "a.json", "-o", "a.svg")
        rows = self.rows("t.csv")
        self.assertEqual([int(row["seed"]) for row in rows], list(range(200)))
        self.assertEqual(list(rows[0]), "seed,x,y,weight,status,measure,cx,cy,second_moment,neighbors".split(","))
        self.assertAlmostEqual(sum(float(row["measure"]) for row in rows), 1, delta=1e-12)
        for row in rows:
            self.assertIn(row["status"], ("ok", "hidden"))
            self.assertEqual(row["cx"] == "", row["status"] == "hidden")
        walls = {(int(r["seed"]), int(r["neighbor"])): float(r["measure"])
                 for r in self.rows("w.csv")}
        for (i, j), measure in walls.items():
            self.assertEqual(walls[j, i], measure)
        for row in rows:
            self.assertEqual(int(row["neighbors"]), sum(1 for i, _ in walls if i == int(row["seed"])))

    def test_facets_of_cells(self):
        self.good("diagram", "--domain", "cube", "--seeds", "random:50", "--table", "t.csv", "--walls", "w.csv",
                  "--facets")
        walls = self.rows("w.csv")
        self.assertEqual(list(walls[0]), ["seed", "neighbor", "measure", "facet"])
        sides = [0.0] * 6
        for wall in walls:
            self.assertNotEqual(wall["neighbor"] == "", wall["facet"] == "")
            if wall["facet"]:
                sides[int(wall["facet"])] += float(wall["measure"])
        for side in sides:
            self.assertAlmostEqual(side, 1, delta=1e-12)
        self.bad(2, "--facets adds rows to --walls", "diagram", "--domain", "cube", "--seeds", "random:5", "--facets",
                   "--table", "t.csv")

    def test_walls_and_facets_are_the_surface_of_a_cell(self):
        """The faces in JSON add up to the rows of a seed, seed by seed and border by border."""
        for domain in ("cube", "ball:3", "square", "disk:9"):
            self.good("diagram", "--domain", domain, "--seeds", "random:40", "--walls", "w.csv", "--facets", "-o",
                      "c.json")
            rows = {}
            for wall in self.rows("w.csv"):
                border = int(wall["neighbor"]) if wall["neighbor"] else -1 - int(wall["facet"])
                rows[int(wall["seed"]), border] = float(wall["measure"])
            found = {}
            for cell in json.loads((self.folder / "c.json").read_text())["cells"]:
                for face, border in zip(cell["faces"], cell["borders"]):
                    p = [(cell["vertices"][v] + [0])[:3] for v in face]
                    if isinstance(border, list):
                        parts = [(b, math.dist(p[k], p[(k + 1) % len(p)])) for k, b in enumerate(border)]
                    else:
                        parts = [(border, polygon_area(p))]
                    for b, size in parts:
                        found[cell["seed"], b] = found.get((cell["seed"], b), 0) + size
            for key in rows.keys() | found.keys():
                with self.subTest(domain=domain, seed_and_border=key):
                    self.assertAlmostEqual(rows.get(key, 0), found.get(key, 0), delta=1e-11)

    def test_some_of_the_cells(self):
        (self.folder / "s.csv").write_text("name,x,y\n" + "".join(
            f"{'abcdefgh'[k]},{.1 + .1 * k},{(.37 * k) % 1}\n" for k in range(8)))
        self.good("diagram", "--domain", "square", "--seeds", "s.csv", "--table", "all.csv", "--walls", "w.csv")
        every = {row["seed"]: row for row in self.rows("all.csv")}
        (self.folder / "few.txt").write_text("# two of them\nseed\n5\n\n2\n")
        report = self.report("diagram", "--domain", "square", "--seeds", "s.csv", "--only", "few.txt", "--table",
                             "few.csv", "--walls", "few_walls.csv")
        self.assertEqual((report["seeds"], report["selected"], report["relative_error"]), (8, 2, None))
        rows = self.rows("few.csv")
        self.assertEqual([row["seed"] for row in rows], ["5", "2"])
        for row in rows:
            self.assertEqual(row["neighbors"], every[row["seed"]]["neighbors"])
            self.assertAlmostEqual(float(row["measure"]), float(every[row["seed"]]["measure"]), delta=1e-14)
        self.assertEqual({wall["seed"] for wall in self.rows("few_walls.csv")}, {"5", "2"})
        (self.folder / "names.txt").write_text("f\nc\n")
        self.good("diagram", "--domain", "square", "--seeds", "s.csv", "--id-column", "name", "--only", "names.txt",
                  "--table", "named.csv")
        self.assertEqual([row["name"] for row in self.rows("named.csv")], ["f", "c"])
        for text, message in (("5\n9\n", "few.txt:2: seed 9 of 8"), ("1\n1\n", "few.txt:2: seed '1' is in"),
                              ("1.5\n", "few.txt:1: '1.5' is not the index")):
            (self.folder / "few.txt").write_text(text)
            self.bad(1, message, "diagram", "--domain", "square", "--seeds", "s.csv", "--only", "few.txt", "--table",
                     "t.csv")
        self.bad(2, "-o draws and writes all cells", "diagram", "--domain", "square", "--seeds", "s.csv", "--only",
                   "few.txt", "-o", "a.svg")

    def test_solids(self):
        for shape, holes in (("sphere:10", 0), (DATA / "pretzel.off", 3)):
            with self.subTest(shape=shape):
                report = self.report("diagram", "--domain", shape, "--solid", "--seeds", "random:300", "--certify",
                                     "--table", "t.csv", "--walls", "w.csv")
                self.assertEqual(report["cells"], 300)
                self.assertLess(report["relative_error"], 1e-13)
                self.assertIn("solid", report["notes"][0])
                self.assertEqual(len((self.folder / "t.csv").read_text().splitlines()), 301)
                walls = [line.split(",") for line in (self.folder / "w.csv").read_text().splitlines()[1:]]
                self.assertIn([walls[0][1], walls[0][0], walls[0][2]], walls)
        self.good("transport", "--domain", "torus:10", "--solid", "--seeds", "random:20", "--table", "t.csv")

    def test_geometry_of_solids(self):
        files = [f"a.{extension}" for extension in ("vtu", "vtp", "obj", "ply", "off", "json", "png")]
        outputs = [word for name in files for word in ("-o", name)]
        self.good("diagram", "--domain", DATA / "pretzel.off", "--solid", "--seeds", "random:50", *outputs)
        for name in files:
            self.assertGreater((self.folder / name).stat().st_size, 10_000, name)
        self.good("verify", "a.json")


if __name__ == "__main__":
    unittest.main(verbosity=1)
