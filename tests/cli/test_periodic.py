#!/usr/bin/env python3
"""Periodic domains in the tool.

usage: test_periodic.py PATH_OF_POWERCELL [unittest options]
"""

import json
import unittest

from tool import ToolTest


class Periodic(ToolTest):
    def test_walls_have_both_sides_with_opposite_shifts(self):
        for domain, flags, seeds, d in (("square", ["--periodic"], "random:30:0:0.02", 2),
                                        ("cube", ["--periodic=xz"], "random:40", 3),
                                        ("box:-1,2:3,2.5", ["--periodic=x"], "random:5", 2),
                                        ("lattice:1,0/0.5,0.8", [], "random:1", 2),
                                        ("lattice:1,0,0/0.3,1.1,0/-0.2,0.4,0.9", [], "random:20", 3)):
            with self.subTest(domain=domain):
                report = self.report("diagram", "--domain", domain, *flags, "--seeds", seeds, "--walls", "w.csv",
                                     "--table", "t.csv", "-o", "cells.vtu" if d == 3 else "cells.svg")
                self.assertLess(report["relative_error"], 1e-12)
                shift = ["sx", "sy", "sz"][:d]
                walls = {}
                for row in self.rows("w.csv"):
                    self.assertEqual(list(row), ["seed", "neighbor", "measure", *shift])
                    walls[(row["seed"], row["neighbor"], *(int(row[s]) for s in shift))] = row["measure"]
                self.assertGreater(len(walls), 3)
                for (i, j, *by), measure in walls.items():
                    self.assertEqual(measure, walls[(j, i, *(-s for s in by))])
                self.assertTrue(any(any(key[2:]) for key in walls))
                if domain == "cube":
                    self.assertFalse(any(key[3] for key in walls))

    def test_a_seed_outside_stands_for_its_image(self):
        (self.folder / "in.csv").write_text("x,y,w\n0.25,0.5,0\n0.75,0.5,0.05\n")
        (self.folder / "out.csv").write_text("x,y,w\n-2.75,0.5,0\n0.75,7.5,0.05\n")
        for name in ("in", "out"):
            self.good("diagram", "--domain", "square", "--periodic", "--seeds", f"{name}.csv", "--table",
                      f"{name}_t.csv", "--walls", f"{name}_w.csv")
        for here, there in zip(self.rows("in_t.csv"), self.rows("out_t.csv")):
            self.assertAlmostEqual(float(here["measure"]), float(there["measure"]), 12)
            for c in "xy":
                self.assertAlmostEqual(float(here["c" + c]) - float(here[c]), float(there["c" + c]) - float(there[c]), 12)
        shifts = {(row["seed"], row["neighbor"], row["sx"], row["sy"]) for row in self.rows("out_w.csv")}
        self.assertIn(("0", "1", "-3", "-7"), shifts)

    def test_seeds_outside_are_counted(self):
        (self.folder / "out.csv").write_text("x,y,z\n0.5,0.5,0.5\n-0.5,0.5,0.25\n0.25,0.5,1.5\n0.1,0.2,0.3\n")
        for domain, flags, outside in (("cube", ["--periodic"], 2), ("cube", ["--periodic=x"], 2), ("cube", [], 2),
                                       ("lattice:1,0,0/0.2,1,0/0,0,1", [], 2)):
            with self.subTest(domain=domain, flags=flags):
                command = ("diagram", "--domain", domain, *flags, "--seeds", "out.csv")
                self.assertEqual(self.report(*command)["outside"], outside)
                self.assertIn("1 of 4 seeds lies outside" if flags == ["--periodic=x"] else "2 of 4 seeds lie outside",
                              self.good(*command).stdout)

    def test_laws_of_diagrams_but_not_of_saved_ones(self):
        self.good("diagram", "--domain", "square", "--periodic", "--seeds", "random:8", "-o", "d.json")
        saved = json.loads((self.folder / "d.json").read_text())
        self.assertEqual(saved["domain"]["periods"], [[1, 0], [0, 1]])
        for cell in saved["cells"]:
            for borders, shifts in zip(cell["borders"], cell["shifts"]):
                self.assertEqual(len(borders), len(shifts))
        self.bad(1, "periodic", "verify", "d.json")
        self.good("verify", "--domain", "square", "--periodic", "--seeds", "random:50")
        self.good("verify", "--domain", "lattice:1,0,0/.3,1,0/0,.2,1", "--seeds", "random:50")

    def test_transport_and_its_walls(self):
        report = self.report("transport", "--domain", "cube", "--periodic", "--seeds", "random:30", "--walls", "w.csv")
        self.assertTrue(report["converged"])
        self.assertIn("sz", self.rows("w.csv")[0])

    def test_what_cannot_be_periodic_is_refused(self):
        for expected, arguments in (("not a box", ["--domain", "disk", "--periodic"]),
                                    ("axes", ["--domain", "square", "--periodic=z"]),
                                    ("periodic already", ["--domain", "lattice:1,0/0,1", "--periodic"]),
                                    ("dependent", ["--domain", "lattice:1,0/2,0"]),
                                    ("as many vectors", ["--domain", "lattice:1,0,0/0,1,0"]),
                                    ("corner", ["--domain", "box:1,2"]),
                                    ("not a number", ["--domain", "box:1,2:3,four"]),
                                    ("not less than", ["--domain", "box:0,0:1,0"]),
                                    ("10\\^6", ["--domain", "box:0,0:1,1e-7", "--periodic"])):
            with self.subTest(arguments=arguments):
                self.bad(1, expected, "diagram", *arguments, "--seeds", "random:5")


if __name__ == "__main__":
    unittest.main(verbosity=1)
