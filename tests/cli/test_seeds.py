#!/usr/bin/env python3
"""Tables of seeds as people have them: their columns, marks and geometries, and seeds that miss the domain.

usage: test_seeds.py PATH_OF_POWERCELL [unittest options]
"""

import csv
import json
import re
import sqlite3
import struct
import subprocess
import unittest

from tool import TOOL, ToolTest


def numbers(state=1):
    """Numbers from 0 to 1, the same every time."""
    while True:
        state = state * 1103515245 + 12345 & 0x7fffffff
        yield state / 0x80000000


class Columns(ToolTest):
    def test_columns_of_seeds_are_reported(self):
        self.write("s.csv", "w,lon,lat\n0.01,0.2,0.3\n0,0.6,0.8\n")
        out = self.good("diagram", "--domain", "square", "--seeds", "s.csv", "--table", "t.csv").stdout
        self.assertIn("seeds: x from 'lon', y from 'lat', weight from 'w'\n", out)
        self.assertEqual([(row["lon"], row["lat"], row["w"]) for row in self.rows("t.csv")],
                         [("0.2", "0.3", "0.01"), ("0.6", "0.8", "0")])
        told = "seeds: x from 'lon', y from 'lat', weight from 'w'; kept: 'seed', 'status', 'measure'"
        self.assertIn(told, self.good("diagram", "--domain", "square", "--seeds", "t.csv").stdout)
        self.assertIn(told, self.good("verify", "--domain", "square", "--seeds", "t.csv").stdout)
        self.assertEqual(self.report("diagram", "--domain", "square", "--seeds", "t.csv")["cells"], 2)

    shops = ('Code;"Shop; name";x;y;Turnover;r;zip;status\n'
             'A1;"Rossi; figli";0.2;0.3;120.5;0.3;00184;open\n'
             'B2;"Café ""Uno""";0.7;0.6;80;0.1;20121;closed\n'
             'C3;Rue # 5;0.4;0.8;;0.2;50123;open\n')

    def test_columns_of_the_table_go_into_the_files(self):
        self.write("s.csv", self.shops)
        out = self.good("diagram", "--domain", "square", "--seeds", "s.csv", "--radius-column", "r", "--id-column", "code",
                        "--table", "t.csv", "--walls", "w.csv", "-o", "c.geojson", "-o", "c.vtu").stdout
        self.assertIn("weight from 'r' squared; kept: 'Shop; name', 'Turnover', 'zip', 'status'", out)
        lines = (self.folder / "t.csv").read_text().splitlines()
        self.assertEqual(lines[0], 'Code;"Shop; name";x;y;Turnover;r;zip;input_status;seed;weight;status;measure;cx;cy;'
                                   'second_moment;neighbors')
        self.assertTrue(lines[1].startswith('A1;"Rossi; figli";0.2;0.3;120.5;0.3;00184;open;0;0.09;ok;'))
        self.assertTrue(lines[3].startswith('C3;"Rue # 5";0.4;0.8;;0.2;50123;open;2;'))
        walls = (self.folder / "w.csv").read_text().splitlines()
        self.assertEqual(walls[0], "seed;neighbor;measure;id;neighbor_id")
        self.assertRegex(walls[1], r"^0;1;0\.\d+;A1;B2$")
        features = json.loads((self.folder / "c.geojson").read_text())["features"]
        self.assertEqual([feature["id"] for feature in features], ["A1", "B2", "C3"])
        properties = features[1]["properties"]
        self.assertEqual(list(properties), ["Code", "Shop; name", "x", "y", "Turnover", "r", "zip", "input_status", "seed",
                                            "weight", "status", "measure"])
        self.assertEqual((properties["Shop; name"], properties["Turnover"], properties["zip"], properties["input_status"]),
                         ('Café "Uno"', 80, "20121", "closed"))
        self.assertIsNone(features[2]["properties"]["Turnover"])
        vtu = (self.folder / "c.vtu").read_text()
        self.assertIn('<DataArray type="Float64" Name="Turnover"', vtu)
        self.assertNotIn("Shop", vtu)

    def test_radii_with_units_are_not_left_out(self):
        self.write("s.csv", "x (mm),y (mm),radius (mm)\n.2,.3,.1\n.6,.5,.2\n")
        diagram = ("diagram", "--domain", "square", "--seeds", "s.csv")
        self.bad(1, r"--radius-column 'radius \(mm\)' to use the squares", *diagram)
        self.assertIn("weight from 'radius (mm)' squared", self.good(*diagram, "--radius-column", "radius (mm)").stdout)

    def test_a_table_that_is_read_again_gives_the_same(self):
        for text, options in ((self.shops, ("--radius-column", "r")), ("a,b,c,d\n1,.2,.3,4\n2,.6,.5,5\n",
                              ("--x-column", "b", "--y-column", "c")), ("a,b,c\n.2,.3,.01\n.6,.5,.02\n", ()),
                              ("x (mm),y (mm),weight (mm2)\n.2,.3,.01\n.6,.5,.02\n", ()),
                              ("x (mm),y (mm),weight (kg)\n.2,.3,.01\n.6,.5,.02\n", ("--weight-column", "weight (kg)")),
                              ("x_m,y_m,r_m\n.2,.3,.1\n.6,.5,.2\n", ("--radius-column", "r_m"))):
            self.write("s.csv", text)
            for command in ("diagram", "transport"):
                with self.subTest(text=text, command=command):
                    self.good(command, "--domain", "square", "--seeds", "s.csv", "--table", "t.csv", *options)
                    self.good("diagram", "--domain", "square", "--seeds", "t.csv", "--table", "t2.csv")
                    self.good("diagram", "--domain", "square", "--seeds", "t2.csv", "--table", "t3.csv")
                    self.assertEqual((self.folder / "t2.csv").read_text(), (self.folder / "t3.csv").read_text())
                    separator = ";" if ";" in text else ","
                    first, again = (list(csv.DictReader((self.folder / name).read_text().splitlines(), delimiter=separator))
                                    for name in ("t.csv", "t2.csv"))
                    for a, b in zip(first, again):
                        weights = [row.get("weight", row.get("weight (mm2)")) for row in (a, b)]  # columns keep their names
                        self.assertEqual((weights[0], a["status"]), (weights[1], b["status"]))
                        self.assertAlmostEqual(float(a.get("measure") or a["mass"]), float(b["measure"]), delta=1e-12)

    def test_weights_are_scaled(self):
        self.write("s.csv", "x,y,people\n.2,.3,1000\n.7,.6,3000\n")
        out = self.good("diagram", "--domain", "square", "--seeds", "s.csv", "--weight-column", "people",
                        "--scale-weights", "1e-5", "--table", "t.csv").stdout
        self.assertIn("weights: multiplied by 1e-05", out)
        for row, weight in zip(self.rows("t.csv"), (0.01, 0.03)):
            self.assertAlmostEqual(float(row["weight"]), weight, delta=1e-15)
        # The range becomes a quarter of the mean area.
        self.good("diagram", "--domain", "square", "--seeds", "s.csv", "--weight-column", "people",
                  "--scale-weights", "auto", "--table", "t.csv")
        low, high = (float(row["weight"]) for row in self.rows("t.csv"))
        self.assertAlmostEqual(high - low, 0.5 / 4, delta=1e-12)
        self.assertAlmostEqual(high / low, 3, delta=1e-12)
        self.bad(2, "neither a number above 0 nor 'auto'", "diagram", "--domain", "square", "--seeds", "s.csv",
                 "--scale-weights", "-1")

    def test_seeds_from_standard_input(self):
        done = subprocess.run([TOOL, "diagram", "--domain", "square", "--seeds", "-", "--json"], input="0.2 0.5\n0.8 0.5\n",
                              text=True, capture_output=True)
        self.assertEqual(json.loads(done.stdout)["cells"], 2)
        done = subprocess.run([TOOL, "diagram", "--domain", "square", "--seeds", "-"], input="0.2 nan\n",
                              text=True, capture_output=True)
        self.assertIn("standard input:1: seed 0", done.stderr)

    def test_seeds_that_miss_the_domain_are_refused_with_the_way_out(self):
        random = numbers()
        points = [[f"{next(random):.6f}" for _ in range(3)] for _ in range(300)]
        ids = self.write("ids.txt", "".join(f"{i + 1} {' '.join(p)}\n" for i, p in enumerate(points)))
        swapped = self.write("swapped.csv", "".join(f"{40 + float(p[0])},{12 + float(p[1])},0.1\n" for p in points))
        named = self.write("named.csv", "id,lon,lat,X_m,Y_m\n" + "".join(
            f"{i},1,2,{12 + float(p[0])},{40 + float(p[1])}\n" for i, p in enumerate(points)))
        self.write("land.wkt", "POLYGON((12 40,13 40,13 41,12 41,12 40))")
        cases = (("cube", ids, r"299 of 300 seeds lie outside the domain's box \(x from 0 to 1, y from 0 to 1, z from 0 "
                               r"to 1\); they were read as x from column 1, .* weight from column 4; with x from column 2, "
                               r".*: try (--x-column 2 --y-column 3 --z-column 4);"),
                 ("land.wkt", swapped, "300 of 300 seeds .*: try (--x-column 2 --y-column 1 --weight-column 3);"),
                 ("land.wkt", named, "300 of 300 .*; they were read as x from 'lon', .*: try (--x-column 'X_m' --y-column 'Y_m');"))
        for domain, seeds, says in cases:
            with self.subTest(seeds=seeds):
                for command in ("diagram", "transport", "verify"):
                    error = self.bad(1, f"{seeds}: {says}", command, "--domain", domain, "--seeds", seeds).stderr
                advice = re.search(says, error).group(1).replace("'", "").split()
                report = self.report("diagram", "--domain", domain, "--seeds", seeds, *advice)
                self.assertEqual((report["outside"], report["cells"]), (0, 300))
                allowed = self.report("diagram", "--domain", domain, "--seeds", seeds, "--allow-outside")
                self.assertGreaterEqual(allowed["outside"], 299)

    def test_units_that_differ_are_named(self):
        self.write("far.wkt", "POLYGON((5e5 6.9e6,6e5 6.9e6,6e5 7e6,5e5 7e6,5e5 6.9e6))")
        for x, y, says in ((5, 52, "the seeds could be in degrees and the domain in lengths"),
                           (510, 6910, "1000 times their coordinates would lie inside")):
            rows = "".join(f"{x + i * y / 1000:g} {y + i:g}\n" for i in range(12))
            self.bad(1, says, "diagram", "--domain", "far.wkt", "--seeds", self.write("s.txt", rows))

    def test_few_seeds_outside_are_taken_with_a_note(self):
        self.write("land.wkt", "POLYGON((12 40,13 40,13 41,12 41,12 40))")
        out = self.good("diagram", "--domain", "land.wkt", "--seeds", self.write("s.txt", "40.2 12.4\n40.8 12.6\n")).stdout
        self.assertIn("2 of 2 seeds lie outside the domain's box (x from 12 to 13, y from 40 to 41); they were read as x "
                      "from column 1, y from column 2, no weights; with x from column 2, y from column 1 100 % would lie "
                      "inside: try --x-column 2 --y-column 1\n", out)

    def test_some_seeds_outside_are_counted(self):
        seeds = self.write("s.txt", "0.2 0.5\n0.8 0.5\n1.2 0.5\n")
        self.assertIn("1 of 3 seeds lies outside the domain's box\n",
                      self.good("diagram", "--domain", "square", "--seeds", seeds).stdout)
        self.assertEqual(self.report("transport", "--domain", "square", "--seeds", seeds)["outside"], 1)
        # Seeds may lie off a surface: above a flat one all are outside its box.
        self.write("flat.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n")
        self.write("above.txt", "0.3 0.3 0.1\n0.7 0.6 0.1\n")
        self.assertEqual(self.report("diagram", "--domain", "flat.off", "--seeds", "above.txt")["outside"], 0)


class Points(ToolTest):
    """Points of maps, with attributes."""

    def check_files(self, seeds, separator=","):
        out = self.good("diagram", "--domain", "square", "--seeds", seeds, "--table", "t.csv", "--walls", "w.csv",
                        "-o", "c.geojson").stdout
        self.assertIn("seeds: positions from ", out)
        text = (self.folder / "t.csv").read_text()
        rows = list(csv.DictReader(text.splitlines(), delimiter=separator))
        self.assertEqual([(float(row["x"]), float(row["y"]), row["name"], float(row["w"])) for row in rows],
                         [(0.25, 0.5, "A", 0.1), (0.75, 0.5, "B, old", 0)])
        self.assertAlmostEqual(sum(float(row["measure"]) for row in rows), 1, delta=1e-12)
        walls = csv.DictReader((self.folder / "w.csv").read_text().splitlines(), delimiter=separator)
        self.assertEqual([float(wall["measure"]) for wall in walls], [1, 1])
        features = json.loads((self.folder / "c.geojson").read_text())["features"]
        self.assertEqual([feature["properties"]["name"] for feature in features], ["A", "B, old"])
        # What was written is read again.
        self.good("diagram", "--domain", "square", "--seeds", "t.csv", "--table", "t2.csv")
        self.assertEqual([row["measure"] for row in self.rows("t2.csv")], [row["measure"] for row in rows])

    def test_geojson(self):
        features = [{"type": "Feature", "properties": {"name": name, "w": w},
                     "geometry": {"type": "Point", "coordinates": [x, 0.5]}}
                    for x, name, w in ((0.25, "A", 0.1), (0.75, "B, old", 0))]
        self.check_files(self.write("p.geojson", json.dumps({"type": "FeatureCollection", "features": features})))

    def test_well_known_text(self):
        self.check_files(self.write("p.csv", 'name,geom,w\nA,POINT (.25 .5),0.1\n"B, old",POINT (.75 .5),0\n'))
        self.good("diagram", "--domain", "square", "--seeds", self.write("p.wkt", "POINT (.2 .5)\nPOINT (.6 .5)\n"),
                  "--table", "t.csv")
        for row, measure in zip(self.rows("t.csv"), (0.4, 0.6), strict=True):
            self.assertAlmostEqual(float(row["measure"]), measure, delta=1e-12)

    def test_geopackage(self):
        with sqlite3.connect(self.folder / "p.gpkg") as package:
            package.execute("CREATE TABLE gpkg_spatial_ref_sys (srs_id, organization, organization_coordsys_id, definition)")
            package.execute("CREATE TABLE gpkg_geometry_columns (table_name, column_name, geometry_type_name, srs_id)")
            package.execute("INSERT INTO gpkg_geometry_columns VALUES ('shops', 'geom', 'POINT', -1)")
            package.execute("CREATE TABLE shops (fid INTEGER PRIMARY KEY, geom BLOB, name TEXT, w REAL)")
            for x, name, w in ((0.25, "A", 0.1), (0.75, "B, old", 0)):
                point = b"GP\0\1" + struct.pack("<i", -1) + b"\1" + struct.pack("<Idd", 1, x, 0.5)
                package.execute("INSERT INTO shops (geom, name, w) VALUES (?, ?, ?)", (point, name, w))
        package.close()
        self.check_files("p.gpkg")
        self.check_files("p.gpkg:shops")

    def test_decimal_commas_come_back(self):
        seeds = self.write("s.csv", "name;x;y;w;rent\nA;0,25;0,5;0,1;7,5\nB;0,75;0,5;0;8\n")
        out = self.good("diagram", "--domain", "square", "--seeds", seeds, "--table", "t.csv", "--walls", "w.csv",
                        "-o", "c.geojson").stdout
        self.assertIn("; decimal commas\n", out)
        first = (self.folder / "t.csv").read_text().splitlines()[1].split(";")
        self.assertEqual(first[:5], ["A", "0,25", "0,5", "0,1", "7,5"])
        self.assertAlmostEqual(float(first[7].replace(",", ".")), 0.6, delta=1e-12)  # seed, status, measure
        self.good("diagram", "--domain", "square", "--seeds", self.write("d.csv", "x;y\n0,2;0,5\n0,75;0,1\n"),
                  "--walls", "w.csv")
        self.assertRegex((self.folder / "w.csv").read_text(), r"\n0;1;[01],\d+\n")
        properties = json.loads((self.folder / "c.geojson").read_text())["features"][0]["properties"]
        self.assertEqual((properties["rent"], properties["x"]), (7.5, 0.25))
        # Advice on other columns reads them the same way.
        rows = "".join(f"{40 + i / 20:g};{12 + i / 20:g}\n".replace(".", ",") for i in range(20))
        self.write("land.wkt", "POLYGON((12 40,13 40,13 41,12 41,12 40))")
        self.bad(1, "try --x-column 'b' --y-column 'a';", "diagram", "--domain", "land.wkt", "--seeds",
                 self.write("swapped.csv", "a;b\n" + rows))

    def test_weights_that_hide_most_seeds_are_named(self):
        rows = [(k % 17 / 17 + .01, k % 23 / 23 + .01, 40 * (k % 7)) for k in range(300)]
        (self.folder / "w.csv").write_text("x,y,weight\n" + "".join(f"{x},{y},{w}\n" for x, y, w in rows))
        command = ("diagram", "--domain", "square", "--seeds", "w.csv")
        said = self.good(*command).stdout
        self.assertIn("of 300 seeds are hidden", said)
        hidden = self.report(*command)["hidden"]
        self.assertGreater(hidden, 150)
        advised = self.report(*command, "--scale-weights", "auto")
        self.assertLess(advised["hidden"], hidden / 10)
        self.assertNotIn("are hidden, as", "".join(advised["notes"]))


if __name__ == "__main__":
    unittest.main()
