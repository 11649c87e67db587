#!/usr/bin/env python3
"""Maps: coordinate systems of the inputs, areas on the ground, and what the files say of them.

usage: test_maps.py PATH_OF_POWERCELL [unittest options]
"""

import json
import math
import unittest

from tool import ToolTest

A, F = 6378137.0, 1 / 298.257223563  # WGS 84
E = math.sqrt(F * (2 - F))


def authalic(latitude):
    """Twice the area from the equator to a parallel, per radian of longitude, over A squared (Snyder (3-12))."""
    s = math.sin(math.radians(latitude))
    return (1 - E * E) * (s / (1 - E * E * s * s) - math.log((1 - E * s) / (1 + E * s)) / (2 * E))


def box_area(west, south, east, north):
    return A * A / 2 * math.radians(east - west) * (authalic(north) - authalic(south))


def ring_area(ring):
    """Of straight edges in longitude and latitude, by Simpson's rule along each."""
    total = 0
    for (x0, y0), (x1, y1) in zip(ring, ring[1:]):
        mean = (authalic(y0) + 4 * authalic((y0 + y1) / 2) + authalic(y1)) / 6
        total -= math.radians(x1 - x0) * mean
    return A * A / 2 * total


def shape_area(geometry):
    if geometry is None:
        return 0
    parts = [geometry["coordinates"]] if geometry["type"] == "Polygon" else geometry["coordinates"]
    return sum(ring_area(ring) for part in parts for ring in part)  # holes are clockwise


def box(west, south, east, north):
    return [[[west, south], [east, south], [east, north], [west, north], [west, south]]]


class Maps(ToolTest):
    def domain(self, coordinates, crs=None, name="land.geojson", kind="Polygon"):
        document = {"type": "Feature", "properties": {}, "geometry": {"type": kind, "coordinates": coordinates}}
        if crs:
            document["crs"] = {"type": "name", "properties": {"name": crs}}
        return self.write(name, json.dumps(document))

    def shops(self, name="shops.csv", columns="shop,lon,lat,weight"):
        rows = [f"Shop {i},{6.7 + i % 5 * 1.9},{45.9 + i // 5 * 1.7 + i % 3 * 0.3},{(i % 4) * 1e9}" for i in range(25)]
        return self.write(name, columns + "\n" + "\n".join(rows) + "\n")

    def test_lengths_called_degrees_are_refused(self):
        self.domain(box(100, 200, 300, 900), crs="EPSG:4326")
        self.bad(1, r"land.geojson: the point \(\S+, 200\) is no longitude and latitude in degrees, as EPSG:4326 has them; name "
                    "the system", "diagram", "--domain", "land.geojson", "--seeds", "random:10")

    def check_ground_areas(self, features, rows, total):
        measures = [float(row["measure"]) for row in rows]
        self.assertAlmostEqual(sum(measures) / total, 1, delta=1e-6)
        for feature, measure in zip(features, measures):
            self.assertAlmostEqual(shape_area(feature["geometry"]), measure, delta=1e-6 * measure)

    def test_degrees_are_projected_where_something_says_degrees(self):
        total = box_area(6, 45, 16, 55)
        for crs, arguments, says in (("urn:ogc:def:crs:OGC:1.3:CRS84", (), "as the file says"),
                                     ("EPSG:4326", (), "as the file says"), (None, ("--crs", "EPSG:4326"), ""),
                                     (None, (), "as the columns 'lon' and 'lat' say")):
            with self.subTest(crs=crs, arguments=arguments):
                land = self.domain(box(6, 45, 16, 55), crs)
                out = self.good("diagram", "--domain", land, "--seeds", self.shops(), "--table", "t.csv", "-o",
                                "cells.geojson", *arguments).stdout
                self.assertIn("projected to the equal-area plane +proj=laea +lat_0=50 +lon_0=11 ", out)
                self.assertIn("areas and weights are in m2", out)
                self.assertIn(says, out)
                cells = json.loads((self.folder / "cells.geojson").read_text())
                self.assertEqual(cells.get("crs", {}).get("properties", {}).get("name"), crs)
                rows = self.rows("t.csv")
                self.check_ground_areas(cells["features"], rows, total)
                for row in rows:
                    if row["cx"]:
                        self.assertTrue(6 < float(row["cx"]) < 16 and 45 < float(row["cy"]) < 55)
                self.assertEqual(rows[7]["lon"], "10.5")

    def test_weights_and_random_seeds_are_of_the_plane(self):
        land = self.domain(box(6, 45, 16, 55), "EPSG:4326")
        # Two seeds on a meridian, near the middle, where distances are right: the weight moves the wall by w / 2d.
        self.write("two.csv", "lon,lat,weight\n11,49.5,0\n11,50.5,1e9\n")
        self.good("diagram", "--domain", land, "--seeds", "two.csv", "-o", "c.json", "-o", "c.geojson")
        ring = json.loads((self.folder / "c.geojson").read_text())["features"][0]["geometry"]["coordinates"][0]
        wall = max(y for x, y in ring if abs(x - 11) < 0.01)
        degree = 111229  # metres from 49.5 to 50.5
        self.assertAlmostEqual(wall, 50 - 1e9 / (2 * degree) / degree, delta=1e-4)
        saved = json.loads((self.folder / "c.json").read_text())
        self.assertEqual(saved["domain"]["crs"], "EPSG:4326")
        self.assertIn("+proj=laea", saved["domain"]["projection"])
        self.good("verify", "c.json")
        report = self.report("diagram", "--domain", land, "--seeds", "random:300:0:1e9", "--table", "r.csv")
        self.assertEqual((report["crs"], report["outside"]), ("EPSG:4326", 0))
        rows = self.rows("r.csv")
        self.assertTrue(all(6 < float(r["x"]) < 16 and 45 < float(r["y"]) < 55 for r in rows))
        again = self.report("diagram", "--domain", land, "--seeds", "r.csv", "--table", "r2.csv")
        self.assertEqual(again["cells"], report["cells"])
        for a, b in zip(rows, self.rows("r2.csv")):
            self.assertAlmostEqual(float(a["measure"]), float(b["measure"]), delta=1e-9 * report["measure"])

    def test_transport_gives_equal_areas_on_the_ground(self):
        land = self.domain(box(6, 45, 16, 55), "EPSG:4326")
        self.report("transport", "--domain", land, "--seeds", self.shops(columns="shop,lon,lat,_"), "--table", "t.csv",
                    "-o", "c.geojson")
        features = json.loads((self.folder / "c.geojson").read_text())["features"]
        for feature in features:
            self.assertAlmostEqual(shape_area(feature["geometry"]), box_area(6, 45, 16, 55) / 25,
                                   delta=3e-6 * box_area(6, 45, 16, 55) / 25)
        self.assertTrue(all(6 < float(row["cx"]) < 16 for row in self.rows("t.csv")))

    def test_weights_that_hardly_count_are_noted(self):
        land = self.domain(box(6, 45, 16, 55), "EPSG:4326")
        self.write("s.csv", "lon,lat,turnover\n8,47,100\n12,52,900\n")
        arguments = ("diagram", "--domain", land, "--seeds", "s.csv", "--weight-column", "turnover")
        self.assertIn("so they hardly count (--scale-weights", self.good(*arguments).stdout)
        self.assertNotIn("hardly", self.good(*arguments, "--scale-weights", "auto").stdout)

    def test_sampling_says_that_it_does_not_project(self):
        out = self.good("sample", "--domain", self.domain(box(6, 45, 16, 55), "EPSG:4326"), "-n", 20).stdout
        self.assertIn("map: EPSG:4326 is sampled as a plane of degrees; project the file", out)

    def test_numbers_that_look_like_degrees_stay_in_the_plane(self):
        for coordinates, measure in ((box(0, 0, 1, 1), 1), (box(6, 45, 16, 55), 100)):
            land = self.domain(coordinates)
            done = self.good("diagram", "--domain", land, "--seeds", "random:9")
            self.assertIn("map: the coordinates may be degrees, but nothing says so: computed as a plane", done.stdout)
            self.assertIn("--crs EPSG:4326", done.stdout)
            self.assertNotIn("map:", self.good("diagram", "--domain", land, "--seeds", "random:9", "--no-project").stdout)
            self.assertEqual(self.report("diagram", "--domain", land, "--seeds", "random:9")["domain_measure"], measure)
        self.assertNotIn("map:", self.good("diagram", "--domain", self.domain(box(0, 0, 500, 500)), "--seeds",
                                           "random:9").stdout)
        land = self.domain(box(6, 45, 16, 55), "EPSG:4326")
        report = self.report("diagram", "--domain", land, "--seeds", self.shops(), "--no-project", "-o", "c.geojson")
        self.assertAlmostEqual(report["measure"], 100, delta=1e-9)
        self.assertIn("square degrees", report["notes"][1])
        self.assertIn('"EPSG:4326"', (self.folder / "c.geojson").read_text())

    def test_planes_keep_their_system(self):
        square = box(400000, 5000000, 600000, 5300000)
        for land, arguments in ((self.domain(square, "urn:ogc:def:crs:EPSG::32633"), ()),
                                (self.domain(square, name="plain.geojson"), ("--crs", "EPSG:32633")),
                                (self.write("p.wkt", "SRID=32633;POLYGON((4e5 5e6,6e5 5e6,6e5 5.3e6,4e5 5.3e6,4e5 5e6))"), ())):
            with self.subTest(land=land):
                report = self.report("diagram", "--domain", land, "--seeds", "random:20", "-o", "c.geojson", *arguments)
                self.assertAlmostEqual(report["domain_measure"], 6e10, delta=1)
                self.assertRegex(report["notes"][1], r"UTM zone 33N\).* \(unit: metre\), 0\.9992 to 0\.99945 times those on")
                self.assertEqual(json.loads((self.folder / "c.geojson").read_text())["crs"]["properties"]["name"],
                                 "urn:ogc:def:crs:EPSG::32633")
        # Projected, the area is that on the ground: 1 / 0.9996^2 on the central meridian, a bit less beside it.
        report = self.report("diagram", "--domain", "p.wkt", "--seeds", "random:20", "--project", "-o", "c.geojson")
        self.assertAlmostEqual(report["measure"] / 6e10, 1 / 0.9993, delta=2e-4)

    def test_seeds_in_degrees_on_a_plane(self):
        land = self.domain(box(400000, 5000000, 600000, 5300000), "EPSG:32633")
        self.write("d.csv", "name,lon,lat\na,14.5,46\nb,15.5,47\nc,15,45.5\n")
        report = self.report("diagram", "--domain", land, "--seeds", "d.csv", "--table", "t.csv")
        self.assertEqual((report["outside"], report["cells"]), (0, 3))
        self.assertIn("seeds are in OGC:CRS84, as the columns 'lon' and 'lat' say, and were transformed", report["notes"][1])
        rows = self.rows("t.csv")
        self.assertEqual((rows[0]["lon"], rows[0]["lat"]), ("14.5", "46"))
        self.assertTrue(4e5 < float(rows[0]["cx"]) < 6e5)
        points = [(14.5, 46), (15.5, 47), (15, 45.5)] + [(14.6 + i / 10, 46.1 + i % 3 / 10) for i in range(9)]
        plain = self.write("d.txt", "".join(f"{x:g} {y:g}\n" for x, y in points))
        self.bad(1, "could be in degrees and the domain in lengths: say so with --seeds-crs EPSG:4326", "diagram",
                 "--domain", land, "--seeds", plain)
        again = self.report("diagram", "--domain", land, "--seeds", plain, "--seeds-crs", "EPSG:4326")
        self.assertAlmostEqual(again["measure"], report["measure"], delta=1)
        self.assertEqual((again["outside"], again["cells"]), (0, 12))
        self.write("swapped.txt", "".join(f"{y:g} {x:g}\n" for x, y in points))
        self.bad(1, "transformed to the domain's coordinate system: check", "diagram", "--domain", land, "--seeds",
                 "swapped.txt", "--seeds-crs", "EPSG:4326")

    def test_seeds_in_degrees_in_an_unnamed_plane_are_refused(self):
        land = self.domain(box(-40, -638, 960, 400))  # kilometres of some plane, where (12, 42) is a place too
        self.write("d.csv", "name,lon,lat\na,14.5,46\nb,15.5,47\nc,15,45.5\n")
        self.bad(1, r"land\.geojson: has the point \(\S+, 400\), which is not in degrees, but the seeds' columns 'lon' and 'lat' "
                 "are: name its coordinate system with --crs, or .* --no-project", "diagram", "--domain", land, "--seeds", "d.csv")
        self.assertAlmostEqual(self.report("diagram", "--domain", land, "--seeds", "d.csv", "--no-project")["measure"], 1038000,
                               delta=1e-6)

    def test_swapped_names_of_columns_are_degrees_too(self):
        land = self.domain(box(6, 45, 16, 55))
        self.write("d.csv", "name,lat,lon\na,14.5,46\nb,15.5,47\nc,15,45.5\n")
        report = self.report("diagram", "--domain", land, "--seeds", "d.csv", "--x-column", "lat", "--y-column", "lon")
        self.assertAlmostEqual(report["measure"] / box_area(6, 45, 16, 55), 1, delta=1e-2)

    def test_across_180_degrees(self):
        land = self.domain([box(177, -19, 180, -16), box(-180, -19, -178, -16)], "EPSG:4326", kind="MultiPolygon")
        self.write("s.csv", "lon,lat\n178,-17\n-179,-18\n179.9,-18.5\n")
        report = self.report("diagram", "--domain", land, "--seeds", "s.csv", "--table", "t.csv", "-o", "c.geojson")
        self.assertEqual(report["outside"], 0)
        self.check_ground_areas(json.loads((self.folder / "c.geojson").read_text())["features"], self.rows("t.csv"),
                                box_area(177, -19, 182, -16))

    def test_refusals_say_the_way_out(self):
        land = self.domain(box(6, 45, 16, 55))
        for says, arguments in (("PROJ does not know .* 'EPSG:99999'; give one such as EPSG:4326", ("--crs", "EPSG:99999")),
                                ("nothing names its coordinate system; give --crs", ("--project",)),
                                ("nothing names its coordinate system; give --crs", ("--seeds-crs", "EPSG:4326"))):
            self.bad(1, says, "diagram", "--domain", land, "--seeds", "random:5", *arguments)
        self.bad(1, "--crs, --seeds-crs and --project are for polygons of maps", "diagram", "--domain", "square",
                 "--seeds", "random:5", "--crs", "EPSG:4326")
        self.bad(2, "excludes", "diagram", "--domain", land, "--seeds", "random:5", "--project", "--no-project")
        globe = self.domain(box(-180, -90, 180, -60), "EPSG:4326", "globe.geojson")
        self.bad(1, r"globe\.geojson: its polygons reach around a pole .*EPSG:6932.*--no-project", "diagram", "--domain",
                 globe, "--seeds", "random:5")
        self.assertIn("EPSG:4258 (ETRS89), by --crs (the file says EPSG:4326)", self.report(
            "diagram", "--domain", self.domain(box(6, 45, 16, 55), "EPSG:4326"), "--seeds", "random:5", "--crs", "EPSG:4258",
            "-o", "c.geojson")["notes"][1])
        self.assertIn("urn:ogc:def:crs:EPSG::4258", (self.folder / "c.geojson").read_text())
        odd = self.domain(box(6, 45, 16, 55), "urn:local:grid", "odd.geojson")
        report = self.report("diagram", "--domain", odd, "--seeds", "random:5", "-o", "c.geojson")
        self.assertIn("PROJ does not know the coordinate system 'urn:local:grid'", report["notes"][1])
        self.assertIn("urn:local:grid", (self.folder / "c.geojson").read_text())


if __name__ == "__main__":
    unittest.main(verbosity=1)
