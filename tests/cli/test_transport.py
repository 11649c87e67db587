#!/usr/bin/env python3
"""powercell transport as a program.

usage: test_transport.py PATH_OF_POWERCELL [unittest options]
"""

import json
import math
import unittest

from tool import DATA, ToolTest, run


class Transport(ToolTest):
    square = ("transport", "--domain", "square", "--seeds")

    def test_table_feeds_the_next_run_and_the_diagram(self):
        report = self.report(*self.square, "random:200", "--table", "t.csv", "-o", "p.png", "--log", "s.jsonl")
        self.assertTrue(report["converged"])
        self.assertLess(report["error"], 1e-6)
        self.assertAlmostEqual(report["primal"], report["dual"], delta=1e-8)
        rows = self.rows("t.csv")
        for row in rows:
            self.assertAlmostEqual(float(row["mass"]) * 200, 1, delta=1e-6)
            self.assertEqual(row["status"], "ok")
        self.assertAlmostEqual(sum(float(row["second_moment"]) for row in rows), report["primal"], delta=1e-12)
        steps = [json.loads(line) for line in (self.folder / "s.jsonl").read_text().splitlines()]
        self.assertEqual(len(steps), report["steps"] + 1)
        self.assertEqual(steps[-1]["error"], report["error"])
        self.assertEqual(sum(step["diagrams"] for step in steps), report["diagrams"])
        self.assertGreater((self.folder / "p.png").stat().st_size, 10000)
        self.assertEqual(self.report(*self.square, "t.csv")["steps"], 0)
        self.good("diagram", "--domain", "square", "--seeds", "t.csv", "--table", "d.csv")
        for ours, theirs in zip(rows, self.rows("d.csv")):
            self.assertAlmostEqual(float(ours["mass"]), float(theirs["measure"]), delta=1e-12)

    def test_masses_by_column_and_rescaled(self):
        self.write("m.csv", "name,people\n" + "".join(f"t{i},{1 + i}\n" for i in range(20)))
        self.report("transport", "--domain", DATA / "italy.geojson", "--seeds", "random:20", "--masses", "m.csv",
                    "--mass-column", "people", "--rescale", "--table", "t.csv")
        mass = [float(row["mass"]) for row in self.rows("t.csv")]
        for i in range(20):
            self.assertAlmostEqual(mass[i] / mass[0], 1 + i, delta=1e-4)

    def test_masses_from_the_table_of_the_seeds(self):
        self.write("s.csv", "name,x,y,people\na,0.2,0.3,1\nb,0.6,0.8,2\nc,0.7,0.1,5\n")
        self.good("transport", "--domain", "square", "--seeds", "s.csv", "--mass-column", "People", "--rescale",
                  "--table", "t.csv")
        for row, mass in zip(self.rows("t.csv"), (1, 2, 5)):
            self.assertEqual(float(row["people"]), mass)
            self.assertAlmostEqual(float(row["mass"]), mass / 8, delta=1e-6)
        self.bad(1, "s.csv: the table of the seeds has no column 'gold'", "transport", "--domain", "square", "--seeds",
                 "s.csv", "--mass-column", "gold")
        self.bad(1, r"seed 0 \(from 0\): the mass 'a' is not a number above 0", "transport", "--domain", "square", "--seeds",
                 "s.csv", "--mass-column", "name")

    def test_tables_as_spreadsheets_write_them(self):
        self.write("s.csv", 'City Name,lon,lat\nNew York,0.2,0.2\n"Rome, ""old""",0.7,0.7\n,,\n')
        self.write("m.csv", 'City Name,mass\nNew York,1\n"Rome, ""old""",3\n,\n')
        done = self.good(*self.square, "s.csv", "--masses", "m.csv", "--rescale", "--table", "t.csv")
        self.assertIn("seeds: x from 'lon', y from 'lat', no weights; kept: 'City Name'\n", done.stdout)
        self.assertAlmostEqual(float(self.rows("t.csv")[1]["mass"]), 0.75, delta=1e-6)

    def test_density_surface_and_volume(self):
        for domain, density in (("square", "exp(-4*(x^2+y^2))"), ("ball:4", "1+x^2"), ("sphere:6", "2")):
            with self.subTest(domain=domain):
                report = self.report("transport", "--domain", domain, "--seeds", "random:50", "--density", density,
                                     "--table", "t.csv")
                for row in self.rows("t.csv"):
                    self.assertAlmostEqual(float(row["mass"]) * 50 / report["total_mass"], 1, delta=2e-6)
        self.assertAlmostEqual(report["total_mass"], 2 * report["domain_measure"], delta=1e-9)

    def test_density_of_an_image(self):
        # Luminance of gray 128 in linear light; the ink of the right half is the rest to 1.
        light = ((128 / 255 + 0.055) / 1.055) ** 2.4
        self.image("i.png", [[0] * 16 + [128] * 16] * 8)
        for more, left, right in ((["--image", "i.png"], 1, 1 - light), (["--image", "i.png", "--bright"], 0, light)):
            with self.subTest(more=more):
                report = self.report(*self.square, "random:60", *more, "--table", "t.csv")
                self.assertAlmostEqual(report["total_mass"], (left + right) / 2, delta=1e-4)
                rows = self.rows("t.csv")
                for row in rows:
                    self.assertAlmostEqual(float(row["mass"]) * 60 / report["total_mass"], 1, delta=2e-6)
                moment = sum(float(row["mass"]) * float(row["cx"]) for row in rows)
                self.assertAlmostEqual(moment, left / 8 + right * 3 / 8, delta=1e-4)
        self.bad(2, "cannot be combined", *self.square, "random:9", "--image", "i.png", "--density", "x")
        self.bad(2, "--bright needs", *self.square, "random:9", "--bright")
        self.bad(1, "polygon", "transport", "--domain", "cube", "--seeds", "random:9", "--image", "i.png")
        self.bad(1, "blank", *self.square, "random:9", "--image", self.image("white.png", [[255] * 4] * 4))

    def test_a_jump_is_integrated(self):
        report = self.report(*self.square, "random:10", "--density", "x<0.37 && y>0.2 ? 1 : 5")
        self.assertAlmostEqual(report["total_mass"], 5 - 4 * 0.37 * 0.8, delta=1e-6)
        self.assertLess(report["quadrature_error"], 1e-6)

    def test_the_error_of_integrals_over_a_kink_is_reported(self):
        arguments = (*self.square, "random:10", "--density", "abs(x-0.37)+0.1", "--max-steps", "20", "--tolerance", "1e-11")
        done = run(*arguments, "--json", cwd=self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "integrals of the density are right to .* of a mass, not 1.0e-11; .*--image")
        report = json.loads(done.stdout)
        self.assertFalse(report["converged"])
        self.assertGreater(report["quadrature_error"], 1e-11)
        report = self.report(*arguments[:-1], "1e-5")
        self.assertTrue(report["converged"])
        self.assertLess(report["quadrature_error"], 1e-5)
        self.assertEqual(self.report(*self.square, "random:10", "--density", "1+x*y")["quadrature_error"], 0)

    def test_duplicates_are_merged_and_reported(self):
        self.write("s.csv", "x,y\n0.2,0.2\n0.7,0.7\n0.2,0.2\n")
        done = self.good(*self.square, "s.csv", "--table", "t.csv")
        self.assertIn("1 seed merged", done.stdout)
        rows = self.rows("t.csv")
        self.assertEqual([row["merged_with"] for row in rows], ["", "", "0"])
        self.assertEqual([row["status"] for row in rows], ["ok", "ok", "duplicate"])
        self.assertAlmostEqual(float(rows[0]["mass"]), 2 / 3, delta=1e-6)

    def test_bad_masses(self):
        seeds = self.write("s.csv", "x,y\n0.2,0.2\n0.7,0.7\n")
        for text, pattern in (("1\n-1\n", r"m.csv:2: seed 1 .* -1; masses must be positive"),
                              ("mass\n0\n1\n", r"m.csv:2: seed 0 .* 0; masses must be positive"),
                              ("1\nnan\n", r"m.csv:2: seed 1 .*nan"), ("1\nx\n", r"m.csv:2: seed 1.*'x'"),
                              ("1\n", r"1 masses for 2 seeds"), ("a,b\n1,2\n3,4\n", r"no column 'mass'"),
                              ("1 2\n3 4\n", r"2 columns and no header"), ("0;5\n1;5\n", r"2 columns.*separated by semicolons"),
                              ("name;mass\na;0,5\nb;0.5\n", r"m.csv:3: .*has a decimal point, but numbers before"),
                              ("mass,mass\n1,2\n3,4\n", r"m.csv:1: the header has 2 columns 'mass'"),
                              ("2\n3\n", r"the masses sum to 5, the domain's mass is 1.*option rescale")):
            with self.subTest(text=text):
                self.write("m.csv", text)
                self.bad(1, pattern, *self.square, seeds, "--masses", "m.csv", "--table", "t.csv")
        self.bad(1, "density", *self.square, seeds, "--density", "x-0.5")
        self.bad(1, "expression|formula", *self.square, seeds, "--density", "x+*")
        self.bad(2, "tolerance", *self.square, seeds, "--tolerance", "-1")

    def test_not_converged_keeps_the_best_and_fails(self):
        arguments = (*self.square, "random:300", "--max-steps", "1", "--table", "t.csv")
        done = run(*arguments, "--json", cwd=self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "not converged: after 1 step the masses.*the files hold the best")
        report = json.loads(done.stdout)
        self.assertFalse(report["converged"])
        errors = [abs(float(row["mass"]) * 300 - 1) for row in self.rows("t.csv")]
        self.assertTrue(math.isclose(max(errors), report["error"], rel_tol=1e-9))


if __name__ == "__main__":
    unittest.main()
