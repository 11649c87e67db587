#!/usr/bin/env python3
"""powercell verify as a program: devices, seeds in a domain, correct and tampered saved diagrams.

usage: test_verify.py PATH_OF_POWERCELL [unittest options]
"""

import json
import unittest

from tool import DATA, ToolTest, run


class Verify(ToolTest):
    def test_a_device(self):
        report = self.report("verify", "--count", 300, "--samples", 200)
        self.assertTrue(report["passed"])
        self.assertEqual(len(report["checks"]), 9)
        for check in report["checks"]:
            self.assertGreaterEqual(len(check["laws"]), 3)
            for law in check["laws"]:
                self.assertTrue(law["passed"])
                self.assertLessEqual(law["value"], law["tolerance"])

    def test_files(self):
        out = self.good("verify", "--domain", DATA / "italy.geojson", "--seeds", "random:300:0:500").stdout
        self.assertIn("all laws hold", out)
        self.bad(2, "together", "verify", "--domain", "square")

    def saved(self, shape):
        self.good("diagram", "--domain", shape, "--seeds", "random:80:0:0.02:5", "-o", "a.json", "--quiet")
        return json.loads((self.folder / "a.json").read_text())

    def test_a_saved_diagram(self):
        for shape in ("square", "disk", "cube", "sphere"):
            with self.subTest(shape=shape):
                self.saved(shape)
                out = self.good("verify", "a.json").stdout
                self.assertEqual(out.count("  ok "), 8, out)

    def test_domains_far_longer_than_thick(self):
        # Tilted, so that the rounding of the length is 4e-10 of the thickness, by which the sides of a wall differ too.
        self.write("needle.wkt", "POLYGON((0 0, 0.9553364891256060 0.2955202066613396,"
                                 " 0.9553364861704039 0.2955202162147045, -2.955202066613396e-9 9.55336489125606e-9, 0 0))")
        self.write("seeds.csv", "x,y\n0.1,1.5\n" + "".join(f"{0.9553 * k / 9},{0.29552 * k / 9}\n" for k in range(10)))
        self.good("diagram", "--domain", "needle.wkt", "--seeds", "seeds.csv", "--certify", "-o", "a.json")
        self.good("verify", "a.json")
        self.good("verify", "--domain", "needle.wkt", "--seeds", "seeds.csv")
        saved = json.loads((self.folder / "a.json").read_text())
        next(c for c in saved["cells"] if c["status"] == "ok")["measure"] *= 1 + 1e-6
        self.broken(saved, "partition")

    def broken(self, saved, law):
        self.write("a.json", json.dumps(saved))
        done = run("verify", "a.json", cwd=self.folder)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, "FAIL *" + law)

    def test_tampered_diagrams(self):
        saved = self.saved("square")
        cell = next(c for c in saved["cells"] if c["status"] == "ok")
        cell["measure"] *= 1.001
        self.broken(saved, "partition")
        self.broken(saved, "pieces")
        saved = self.saved("square")
        cell = next(c for c in saved["cells"] if any(b is not None and b >= 0 for f in c["borders"] for b in f))
        cell["weight"] += 0.01
        self.broken(saved, "bisectors")
        self.broken(saved, "ownership")

    def test_tampered_summaries_and_centroids(self):
        for shape in ("square", "cube", "sphere"):
            saved = self.saved(shape)
            cell = next(c for c in saved["cells"] if c["status"] == "ok")
            cell["centroid"][1] += 0.001
            with self.subTest(shape=shape):
                self.broken(saved, "centroids")
        saved = self.saved("square")
        cell = next(c for c in saved["cells"] if c["status"] == "ok")
        for key in saved["check"].keys() - {"relative_error"}:
            with self.subTest(key=key):
                self.broken(saved | {"check": saved["check"] | {key: 7}}, "summary")
        self.broken(saved | {"cells": []}, "summary")
        gone = {"measure": 0, "status": "hidden", "centroid": None, "vertices": [], "faces": [], "borders": []}
        self.broken(saved | {"cells": [c | gone if c is cell else c for c in saved["cells"]]}, "partition")
        self.bad(1, "no cells", "verify", self.write(
            "a.json", json.dumps({"domain": saved["domain"], "cells": []})))
        del saved["check"]
        for cell in saved["cells"]:
            del cell["centroid"]
        self.write("a.json", json.dumps(saved))
        self.assertIn("all laws hold", self.good("verify", "a.json").stdout)

    def test_a_saved_diagram_far_from_the_origin(self):
        self.write("far.wkt", "POLYGON((1000000 1000000, 1000001 1000000, 1000001.2 1000000.7, 1000000 1000000))")
        self.good("diagram", "--domain", "far.wkt", "--seeds", "random:3000:0:0.0001", "-o", "far.json", "--quiet")
        self.good("verify", "far.json")
        saved = json.loads((self.folder / "far.json").read_text())
        cell = next(c for c in saved["cells"] if c["status"] == "ok")
        cell["vertices"][0][0] += 1e-7
        self.broken(saved, "pieces")

    def test_each_law_finds_a_fault_of_its_own(self):
        for shape in ("disk", "ball", "sphere"):
            def cells(saved):
                return (c for c in saved["cells"] if c["status"] == "ok")
            with self.subTest(shape=shape):
                saved = self.saved(shape)
                next(cells(saved))["status"] = "hidden"
                self.broken(saved, "statuses")
                saved = self.saved(shape)
                saved["cells"][1]["position"] = saved["cells"][0]["position"]
                self.broken(saved, "statuses")
                saved = self.saved(shape)
                for cell in cells(saved):  # slightly larger cells: walls leave their bisectors
                    cell["vertices"] = [[x * 1.0001 for x in v] for v in cell["vertices"]]
                self.broken(saved, "bisectors")
                saved = self.saved(shape)
                cell = next(c for c in cells(saved) if len(c["faces"]) > 1 or shape == "disk")
                for f, borders in enumerate(cell["borders"]):  # its walls become walls with another seed
                    cell["borders"][f] = ([b if b is None or b < 0 else 79 for b in borders]
                                          if isinstance(borders, list) else 79 if (borders or 0) > 0 else borders)
                self.broken(saved, "symmetry")

    def test_files_that_are_not_saved_diagrams(self):
        self.bad(1, "no such file", "verify", "none.json")
        self.bad(1, "not JSON", "verify", self.write("a.json", '{"domain": {'))
        self.bad(1, "a.json", "verify", self.write("a.json", '{"cells": []}'))
        self.bad(1, "cell 0", "verify", self.write(
            "a.json", '{"domain": {"kind": "polygon", "measure": 1}, "cells": [{"seed": 0}]}'))
        for place in (1e80, -1, 0.5):
            for says, key in (("is not a count", "faces"), ("is not an integer", "borders")):
                saved = self.saved("square")
                saved["cells"][0][key][0][0] = place
                if key == "faces" or place != -1:
                    self.bad(1, f"cell 0: .*({says})", "verify", self.write("a.json", json.dumps(saved)))


if __name__ == "__main__":
    unittest.main()
