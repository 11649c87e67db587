#!/usr/bin/env python3
"""The options on pictures: camera, size and colours.

usage: test_pictures.py PATH_OF_POWERCELL [unittest options]
"""

import json
import re
import struct
import unittest

from tool import DATA, ToolTest

FLAT = ("diagram", "--domain", "square", "--seeds", "random:30:0:0.01")
SOLID = ("diagram", "--domain", "cube", "--seeds", "random:30")


def png_size(path):
    return struct.unpack(">II", path.read_bytes()[16:24])


class Pictures(ToolTest):
    def table(self):
        rows = ["x,y,weight,people,region,paint,empty"]
        for k in range(40):
            rows.append(f"{(k * 7 % 40 + .5) / 40},{(k * 11 % 37 + .5) / 37},{k % 5 / 1000},"
                        f"{'' if k == 3 else 1000 * k * k},{['north', 'south', 'the <isles>'][k % 3]},"
                        f"#{k + 16:02x}8040,")
        return self.write("towns.csv", "\n".join(rows) + "\n")

    def fills(self, name):
        text = (self.folder / name).read_text()
        return {int(seed): fill for seed, fill in re.findall(r'<path id="cell-(\d+)"[^>]*? fill="([^"]+)"', text)}

    def legend(self, name):
        text = (self.folder / name).read_text()
        found = re.search(r'<g class="legend".*?</g>', text, re.S)
        return re.findall(r"<text[^>]*>([^<]*)</text>", found[0]) if found else []

    def test_size(self):
        self.good(*FLAT, "-o", "a.png", "-o", "a.svg", "-o", "a.pdf", "--size", "300")
        self.assertEqual(png_size(self.folder / "a.png"), (300, 300))
        self.assertIn('width="300" height="300"', (self.folder / "a.svg").read_text())
        self.assertIn(b"/MediaBox [ 0 0 300 300 ]", (self.folder / "a.pdf").read_bytes())
        self.good(*FLAT, "-o", "b.png", "-o", "b.svg", "-o", "b.pdf", "--size", "500:200", "--color-by", "measure")
        self.assertEqual(png_size(self.folder / "b.png"), (500, 200))
        self.assertIn('width="500" height="200"', (self.folder / "b.svg").read_text())
        self.assertIn(b"/MediaBox [ 0 0 500 200 ]", (self.folder / "b.pdf").read_bytes())
        self.good(*FLAT, "-o", "c.pdf")
        self.assertIn(b"/MediaBox [ 0 0 1200 1200 ]", (self.folder / "c.pdf").read_bytes())
        self.good(*SOLID, "-o", "d.png", "--size", "320:240", "--camera", "front")
        self.assertEqual(png_size(self.folder / "d.png"), (320, 240))
        self.good("sample", "-n", "40", "-o", "e.png", "-o", "e.svg", "--cells", "f.png", "--size", "200:150")
        self.assertEqual(png_size(self.folder / "e.png"), (200, 150))
        self.assertEqual(png_size(self.folder / "f.png"), (200, 150))
        x = [float(x) for x in re.findall(r'<circle cx="([\d.]+)"', (self.folder / "e.svg").read_text())]
        self.assertTrue(25 <= min(x) < 45 and 155 < max(x) <= 175, (min(x), max(x)))  # in the middle
        self.good("remesh", DATA / "pretzel.off", "--count", "300", "-o", "g.png", "--size", "401:180", "--camera", "top")
        self.assertEqual(png_size(self.folder / "g.png"), (401, 180))

    def test_cameras_differ_and_names_are_directions(self):
        pictures = {}
        for camera in ("front", "0,-7,0", "top", "0,0,0.5", "iso", "1,-1,1", "-1,0.5,-0.2"):
            self.good(*SOLID, "-o", "d.png", "--size", "120", "--camera", camera)
            pictures[camera] = (self.folder / "d.png").read_bytes()
        self.assertEqual(pictures["front"], pictures["0,-7,0"])
        self.assertEqual(pictures["top"], pictures["0,0,0.5"])
        self.assertEqual(pictures["iso"], pictures["1,-1,1"])
        self.assertEqual(len(set(pictures.values())), 4)
        self.good(*SOLID, "-o", "u.png", "--size", "120", "--camera", "front", "--up=-1,0,1")
        self.assertNotEqual((self.folder / "u.png").read_bytes(), pictures["front"])
        self.good(*SOLID, "-o", "w.png", "--size", "120", "--camera", "front", "--no-cut")
        self.assertNotEqual((self.folder / "w.png").read_bytes(), pictures["front"])

    def test_options_that_cannot_be_meant(self):
        png = ("-o", "a.png")
        self.bad(2, "0,0,0 is no direction: all three numbers are 0", *SOLID, *png, "--camera", "0,0,0")
        self.bad(2, "'1,2' is not a direction X,Y,Z", *SOLID, *png, "--camera", "1,2")
        self.bad(2, "neither X,Y,Z nor front, back, left", *SOLID, *png, "--camera", "above")
        self.bad(2, "'1,nan,0' is not a direction", *SOLID, *png, "--up", "1,nan,0")
        self.bad(2, "the camera looks along --up 0,2,0", *SOLID, *png, "--camera", "front", "--up", "0,2,0")
        self.bad(2, "--camera turns pictures of surfaces and volumes, but the domain is flat", *FLAT, *png,
                 "--camera", "front")
        self.bad(2, "--up turns pictures", *FLAT, *png, "--up", "1,0,0")
        self.bad(2, "only volumes are opened, but the domain is a polygon", *FLAT, *png, "--no-cut")
        self.bad(2, "only volumes are opened, but the domain is a surface", "diagram", "--domain", "sphere", "--seeds",
                 "random:9", *png, "--no-cut")
        self.bad(2, "0 is not from 16 to 10000", *FLAT, *png, "--size", "0")
        self.bad(2, "-5 is not from 16 to 10000", *FLAT, *png, "--size=-5")
        self.bad(2, "1000000 is not from 16 to 10000", *FLAT, *png, "--size", "200:1000000")
        for size in ("big", "10.5", "200:", "200:200:200"):
            self.bad(2, "is neither a whole number of pixels nor W:H", *FLAT, *png, "--size=" + size)
        for option in (("--size", "300"), ("--camera", "iso"), ("--no-cut",), ("--color-by", "measure")):
            self.bad(2, option[0] + " is for pictures; name one, such as -o view.png", *SOLID, "-o", "a.vtu", *option)
            self.bad(2, "is for pictures", *SOLID, *option)
        self.bad(2, "--no-legend leaves out the legend of --color-by", *FLAT, *png, "--no-legend")
        self.bad(2, "below 200 there is no room for the legend", *FLAT, *png, "--size", "199", "--color-by", "measure")
        self.good(*FLAT, *png, "--size", "199", "--color-by", "measure", "--no-legend")
        self.bad(2, "--color-by colours cells", "sample", "-n", "9", *png, "--color-by", "measure")
        self.bad(2, "are for pictures; name one", "remesh", DATA / "pretzel.off", "--count", "900", "-o", "a.off", "--camera", "top")

    def test_unknown_columns_list_the_known_ones(self):
        self.table()
        towns = ("diagram", "--domain", "square", "--seeds", "towns.csv", "-o", "a.svg", "--color-by")
        self.bad(1, "--color-by peple: there is no such column; did you mean people\\?; the seeds' table has the columns x, y, weight, "
                    "people, region, paint, empty; beside them there are measure, weight and neighbors",
                 *towns, "peple")
        self.bad(1, "the seeds have no table with a header; known are measure, weight and neighbors", *FLAT, "-o",
                 "a.svg", "--color-by", "people")
        names = "x,y," + ",".join(f"c{k}" for k in range(300))
        self.write("wide.csv", names + "\n" + ",".join(["0.5"] * 302) + "\n")
        self.bad(1, "c9 and 290 more; beside", "diagram", "--domain", "square", "--seeds", "wide.csv", "-o", "a.svg",
                 "--color-by", "d")
        rows = "".join(f"{k / 50},{k / 50},name {k}\n" for k in range(1, 50))
        self.write("names.csv", "x,y,name\n" + rows)
        self.bad(1, "--color-by name: the column has 49 different texts, of which 40 can be told apart", "diagram",
                 "--domain", "square", "--seeds", "names.csv", "-o", "a.svg", "--color-by", "name")

    def test_columns_of_numbers_texts_and_colours(self):
        self.table()
        towns = ("diagram", "--domain", "square", "--seeds", "towns.csv")
        self.good(*towns, "-o", "n.svg", "-o", "n.png", "-o", "n.pdf", "--color-by", "People")
        fills = self.fills("n.svg")
        self.assertEqual(fills[3], "url(#no-value)")
        self.assertIn('<pattern id="no-value"', (self.folder / "n.svg").read_text())
        light = [sum(int(fills[k][c:c + 2], 16) * share for c, share in ((1, .3), (3, .6), (5, .1)))
                 for k in sorted(fills) if k != 3]
        self.assertEqual(light, sorted(light))  # more people, lighter
        legend = self.legend("n.svg")
        self.assertEqual(legend[0], "people (×10⁶)")
        self.assertIn("no value (1)", legend)
        self.assertIn("1.5", legend)
        self.assertIn("people: 4000<", (self.folder / "n.svg").read_text())
        self.good(*towns, "-o", "t.svg", "--color-by", "region")
        fills = self.fills("t.svg")
        self.assertEqual(len(set(fills.values())), 3)
        for k in fills:
            self.assertEqual(fills[k], fills[k % 3])
        self.assertEqual(self.legend("t.svg"), ["region", "north", "south", "the &lt;isles&gt;"])
        self.good(*towns, "-o", "c.svg", "--color-by", "paint")
        self.assertEqual(self.fills("c.svg"), {k: f"#{k + 16:02x}8040" for k in fills})
        self.good(*towns, "-o", "e.svg", "--color-by", "empty")
        self.assertEqual(set(self.fills("e.svg").values()), {"url(#no-value)"})
        self.good(*towns, "-o", "q.svg", "--color-by", "people", "--no-legend")
        self.assertEqual(self.legend("q.svg"), [])

    def test_the_weights_of_a_transport_are_those_found(self):
        self.table()
        towns = ("transport", "--domain", "square", "--seeds", "towns.csv", "-o")
        self.good(*towns, "w.svg", "--color-by", "weight", "--table", "w.csv")
        weights = [float(row["weight"]) for row in self.rows("w.csv")]
        fills = self.fills("w.svg")
        light = {k: int(fills[k][3:5], 16) for k in fills}  # green grows along the scale
        by_weight = [light[k] for k in sorted(light, key=weights.__getitem__)]
        self.assertEqual(by_weight, sorted(by_weight))
        self.good(*towns, "i.svg", "--color-by", "input_weight")
        self.assertEqual(len(set(self.fills("i.svg").values())), 5)

    def test_colours_of_cells_in_files_without_any(self):
        self.bad(2, "--color-by colours cells", "sample", "-n", "9", "--cells", "c.vtu", "-o", "dots.png", "--color-by", "measure")

    def test_classes_of_hidden_seeds_take_no_colour(self):
        self.write("h.csv", "x,y,w,kind\n.2,.5,0,a\n.8,.5,0,c\n.81,.5,-1,b\n")
        self.good("diagram", "--domain", "square", "--seeds", "h.csv", "-o", "h.svg", "--color-by", "kind")
        self.assertEqual(self.legend("h.svg"), ["kind", "a", "c", "hidden (1)"])

    def test_maps_have_square_metres(self):
        ring = [[11, 44], [13, 44], [13, 46], [11, 46], [11, 44]]
        self.write("map.geojson", json.dumps({"type": "Polygon", "coordinates": [ring]}))
        self.good("diagram", "--domain", "map.geojson", "--seeds", "random:20", "-o", "m.svg", "--color-by", "measure",
                  "--crs", "EPSG:4326")
        self.assertEqual(self.legend("m.svg")[0], "area (×10⁹ m²)")


if __name__ == "__main__":
    unittest.main()
