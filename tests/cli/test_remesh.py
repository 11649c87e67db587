#!/usr/bin/env python3
"""powercell remesh as a program.

usage: test_remesh.py PATH_OF_POWERCELL [unittest options]
"""

import json
import unittest

from tool import DATA, ToolTest


class Remesh(ToolTest):
    def test_files_report_and_figures(self):
        report = self.report("remesh", DATA / "pretzel.off", "--count", 700, "--rounds", 2, "-o", "a.off", "-o", "a.obj",
                             "-o", "a.ply", "-o", "a.stl", "-o", "a.png", "--report", "q.json")
        mesh = report["mesh"]
        self.assertEqual((mesh["vertices"], mesh["triangles"], mesh["euler_characteristic"]), (700, 1408, -4))
        self.assertTrue(mesh["manifold"])
        self.assertGreater(mesh["q_min"], 0.5)
        self.assertLess(max(report["hausdorff"].values()), 0.03 * report["diagonal"])
        self.assertEqual(json.loads((self.folder / "q.json").read_text())["mesh"], mesh)
        self.assertEqual((self.folder / "a.png").read_bytes()[:4], b"\x89PNG")
        for name in "a.off", "a.obj", "a.ply", "a.stl":
            again = self.report("diagram", "--domain", name, "--seeds", "random:10")
            self.assertAlmostEqual(again["relative_error"], 0, places=9)
        first = (self.folder / "a.off").read_text().split()
        self.assertEqual(first[1:3], ["700", "1408"])

    def test_vertices_at_the_same_position_are_merged(self):
        corners = [[k & 1, k >> 1 & 1, k >> 2 & 1] for k in range(8)]
        faces = [0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]
        points = [" ".join(map(str, corners[k])) for face in faces for k in face]
        self.write("cube.off", "\n".join(["OFF", "24 6 0", *points, *(f"4 {k} {k + 1} {k + 2} {k + 3}" for k in
                                                                       range(0, 24, 4))]) + "\n")
        report = self.report("remesh", "cube.off", "--count", 100, "--rounds", 2, "-o", "a.off")
        self.assertEqual((report["input"]["vertices"], report["input"]["euler_characteristic"]), (8, 2))
        self.assertEqual((report["mesh"]["euler_characteristic"], report["mesh"]["boundary_loops"]), (2, 0))

    def test_transport(self):
        report = self.report("remesh", "torus:12", "--count", 200, "--method", "transport", "--rounds", 2)
        self.assertEqual(report["method"], "transport")
        self.assertEqual((report["mesh"]["vertices"], report["mesh"]["triangles"]), (200, 400))
        self.bad(2, "--method", "remesh", "torus:12", "--count", 50, "--method", "other")

    def test_stl_beyond_single_precision(self):
        for name, scale, shift in ("far", 1, 1e7), ("large", 1e39, 0), ("small", 1e-46, 0), ("good", 1e3, 1e5):
            corners = [[scale * (k == i) * s + shift * (k == 0) for k in range(3)] for i in range(3) for s in (1, -1)]
            faces = "024", "214", "134", "304", "205", "125", "315", "035"
            self.write(name + ".off", "\n".join(["OFF", "6 8 0", *(" ".join(map(repr, p)) for p in corners),
                                                 *("3 " + " ".join(face) for face in faces)]) + "\n")
            arguments = "remesh", name + ".off", "--count", 60, "--rounds", 1, "-o"
            if name == "good":
                self.report(*arguments, "good.stl")
                continue
            self.bad(1, "STL has single precision", *arguments, name + ".stl")
            self.assertFalse((self.folder / (name + ".stl")).exists())
            self.report(*arguments, name + ".ply")

    def test_faults_are_repaired_and_named(self):
        # A tetrahedron with a corner 1e-7 off in one triangle, one turned over, one degenerate, one repeated.
        self.write("faults.off", "OFF\n7 7 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1e-7 0 0\n1 0 1e-7\n0 1 1e-7\n"
                   "3 4 6 5\n3 0 1 3\n3 1 2 3\n3 0 2 3\n3 1 1 2\n3 0 1 3\n3 0 3 3\n")
        done = self.good("remesh", "faults.off", "--count", 40, "--rounds", 1, "--json", "-o", "a.off")
        for act in "two corners at one position", "corners of an earlier one", "joined 3 pairs", "turned 1 triangle":
            self.assertIn(act, done.stderr)
        report = json.loads(done.stdout)
        self.assertEqual([report["repair"][k]["count"] for k in ("degenerate", "repeated", "welded", "turned")],
                         [2, 1, 3, 1])
        self.assertEqual((report["mesh"]["euler_characteristic"], report["mesh"]["boundary_loops"]), (2, 0))
        self.assertEqual((report["repair"]["components"], report["intersections"]), (1, 0))

    def test_surfaces_that_cannot_be_remeshed(self):
        pages = "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n"
        self.write("pages.off", pages)
        self.bad(1, r"pages\.off: .*edge between vertices 0 and 1 belongs to 3", "remesh", "pages.off", "--count", 50,
                 "--no-repair", "-o", "b.off")
        self.bad(1, "too few points", "remesh", "torus:12", "--count", 4, "-o", "b.off")
        self.bad(1, "no-such.off", "remesh", "no-such.off", "--count", 50)
        self.bad(1, "polygon", "remesh", DATA / "italy.geojson", "--count", 50)
        self.bad(2, r"\.xyz", "remesh", "torus:12", "--count", 50, "-o", "b.xyz")
        self.bad(1, "gradation", "remesh", "torus:12", "--count", 50, "--gradation", 0)
        self.bad(2, "--count", "remesh", "torus:12")


if __name__ == "__main__":
    unittest.main(verbosity=1)
