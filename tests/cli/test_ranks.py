#!/usr/bin/env python3
"""powercell_mpi, whose files are those of powercell.

usage: test_ranks.py POWERCELL POWERCELL_MPI MPIRUN OPTION_OF_RANKS [unittest options]
"""

import json
import os
import pathlib
import random
import re
import subprocess
import sys
import unittest

from tool import DATA, ToolTest, npy, read_npy

RANKS_TOOL, MPIRUN, OPTION = (sys.argv.pop(1) for _ in range(3))
RANKS_TOOL = pathlib.Path(RANKS_TOOL).resolve()

try:
    import vtk
except ImportError:
    vtk = None


class Ranks(ToolTest):
    def on(self, ranks, *arguments, code=0):
        """Runs on that many ranks. \\return what the first one printed, and its error"""
        done = subprocess.run([MPIRUN, OPTION, str(ranks), RANKS_TOOL, *map(str, arguments)], cwd=self.folder,
                              capture_output=True, text=True, timeout=200)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def refused(self, ranks, code, pattern, *arguments):
        """Fails on all ranks, and one of them says why."""
        before = sorted(self.folder.rglob("*"))
        done = self.on(ranks, *arguments, code=code)
        lines = [line for line in done.stderr.splitlines() if line.startswith("powercell_mpi: error: ")]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertRegex(lines[0], pattern)
        self.assertEqual(sorted(self.folder.rglob("*")), before)

    def seeds(self, count, dimension=3, outside=0):
        random.seed(count)
        weight = 0.5 * max(count, 1) ** (-2 / dimension)
        rows = [[random.random() + (i < outside) for _ in range(dimension)] + [weight * random.random()]
                for i in range(count)]
        (self.folder / "s.npy").write_bytes(npy(rows))

    def check_tables(self, count, ranks, domain):
        command = ["diagram", "--domain", domain, "--seeds", "s.npy"]
        whole = self.report(*command, "--table", "m.npy", "--walls", "m.csv")
        report = json.loads(self.on(ranks, *command, "--table", "t.npy", "--walls", "w.npy", "--json").stdout)
        for key in ("seeds", "selected", "cells", "hidden", "duplicate", "outside", "domain_measure", "precision"):
            self.assertEqual(report[key], whole[key], key)
        self.assertEqual(report["ranks"], ranks)
        self.assertEqual(report["exchange"]["fetched"] > 0, ranks > 1)
        self.assertLess(report["relative_error"], 1e-12)
        self.assertEqual(report["files"], ["t.npy", "w.indptr.npy", "w.indices.npy", "w.data.npy"])
        ours, theirs = read_npy(self.folder / "t.npy"), read_npy(self.folder / "m.npy")
        self.assertEqual((len(ours), len(theirs)), (count, count))
        for a, b in zip(ours, theirs):
            self.assertEqual((a[0], a[-1]), (b[0], b[-1]))  # status, number of neighbours
            self.assertAlmostEqual(a[1], b[1], delta=1e-15)
        indptr, indices, data = (read_npy(self.folder / f"w.{part}.npy") for part in ("indptr", "indices", "data"))
        self.assertEqual((indptr[0], indptr[-1], len(indptr)), (0, len(indices), count + 1))
        walls = self.rows("m.csv")
        self.assertEqual(indices, [int(row["neighbor"]) for row in walls])
        for a, row in zip(data, walls):
            self.assertAlmostEqual(a, float(row["measure"]), delta=1e-12)

    def test_tables_are_those_of_one_process(self):
        self.seeds(3000, outside=5)
        self.check_tables(3000, 3, "cube")

    def test_more_ranks_than_seeds(self):
        self.seeds(2, dimension=2)
        self.check_tables(2, 3, "square")

    def test_walls_of_periodic_domains_have_shifts(self):
        self.seeds(1000)
        command = ["diagram", "--domain", "cube", "--periodic=xz", "--seeds", "s.npy"]
        self.good(*command, "--walls", "m.csv")
        theirs = self.rows("m.csv")
        self.assertIn("wrote w.shift.npy", self.on(3, *command, "--walls", "w.npy").stdout)
        shift = read_npy(self.folder / "w.shift.npy")
        self.assertEqual(shift, [tuple(int(row[axis]) for axis in ("sx", "sy", "sz")) for row in theirs])
        self.assertEqual(read_npy(self.folder / "w.indices.npy"), [int(row["neighbor"]) for row in theirs])
        self.on(2, *command, "--walls", "w.csv")
        ours = self.rows("w.csv")
        self.assertEqual([{**row, "measure": 0} for row in ours], [{**row, "measure": 0} for row in theirs])
        for a, b in zip(ours, theirs):
            self.assertAlmostEqual(float(a["measure"]), float(b["measure"]), delta=1e-12)

    def test_csv_of_many_rows(self):
        rows = [(random.random(), random.random()) for _ in range(70000)]  # more than are sent at a time
        self.write("s.csv", "x,y\n" + "".join(f"{x},{y}\n" for x, y in rows))
        command = ["diagram", "--domain", "square", "--seeds", "s.csv"]
        self.on(2, *command, "--table", "t.csv", "--quiet")
        self.good(*command, "--table", "m.csv")
        ours, theirs = self.rows("t.csv"), self.rows("m.csv")
        self.assertEqual(len(ours), len(theirs))
        for a, b in zip(ours, theirs):
            self.assertEqual({k: v for k, v in a.items() if k in ("seed", "x", "y", "w", "status", "neighbors")},
                             {k: v for k, v in b.items() if k in ("seed", "x", "y", "w", "status", "neighbors")})

    def measures(self, path, reader):
        """By the seed: the sum of the pieces in a file."""
        reader.SetFileName(str(self.folder / path))
        reader.Update()
        data = reader.GetOutput().GetCellData()
        seed, size = data.GetArray("seed"), data.GetArray("piece_measure")
        self.assertEqual(reader.GetErrorCode(), 0)
        sums = {}
        for k in range(seed.GetNumberOfTuples()):
            sums[seed.GetValue(k)] = sums.get(seed.GetValue(k), 0) + size.GetValue(k)
        return sums, reader.GetOutput().GetNumberOfCells()

    @unittest.skipUnless(vtk, "needs VTK")
    def test_a_rank_without_cells_has_a_piece_like_the_others(self):
        self.seeds(2)
        self.on(3, "diagram", "--domain", "cube", "--seeds", "s.npy", "-o", "t.pvtu")
        types = {re.search(r'type="(\w+)" Name="seed"', path.read_text())[1] for path in (self.folder / "t").iterdir()}
        self.assertEqual(types, {"Int64"})
        sums, cells = self.measures("t.pvtu", vtk.vtkXMLPUnstructuredGridReader())
        self.assertEqual((sorted(sums), cells), ([0, 1], 2))
        self.assertAlmostEqual(sum(sums.values()), 1, delta=1e-14)

    @unittest.skipUnless(vtk, "needs VTK")
    def test_pieces_are_those_of_one_process(self):
        self.seeds(500)
        for domain in ("cube", DATA / "bracket.mesh"):  # convex, and not
            with self.subTest(domain):
                if domain != "cube":  # around the bracket
                    self.good("sample", "--domain", domain, "-n", "150", "--iterations", "0", "-o", "s.csv")
                command = ["diagram", "--domain", domain, "--seeds", "s.npy" if domain == "cube" else "s.csv"]
                self.good(*command, "-o", "m.vtu")
                out = self.on(3, *command, "-o", "t.pvtu").stdout
                self.assertIn("wrote t.pvtu", out)
                ours = self.measures("t.pvtu", vtk.vtkXMLPUnstructuredGridReader())
                theirs = self.measures("m.vtu", vtk.vtkXMLUnstructuredGridReader())
                self.assertEqual(ours[1], theirs[1])
                self.assertEqual(ours[0].keys(), theirs[0].keys())
                total = sum(theirs[0].values())
                for seed, size in theirs[0].items():
                    self.assertAlmostEqual(ours[0][seed], size, delta=1e-12 * total)

    def test_what_is_refused_is_said_once(self):
        self.seeds(50)
        table = ("--table", "t.npy")
        self.refused(2, 2, "nothing would be written", "diagram", "--domain", "cube", "--seeds", "s.npy")
        self.refused(2, 2, "unknown option '--tabel'; did you mean --table", "diagram", "--domain", "cube", "--tabel", "x")
        self.refused(2, 1, "missing.npy: cannot be read: No such file", "diagram", "--domain", "cube", "--seeds", "missing.npy", *table)
        self.refused(2, 1, r"random seeds are made in memory; use powercell diagram", "diagram", "--domain", "cube",
                     "--seeds", "random:10", *table)
        self.refused(2, 1, "surface", "diagram", "--domain", "sphere", "--seeds", "s.npy", *table)
        self.refused(2, 2, "a.vtu: powercell_mpi writes .pvtu files", "diagram", "--domain", "cube", "--seeds", "s.npy",
                     "-o", "a.vtu")
        self.refused(2, 1, "missing/t.npy", "diagram", "--domain", "cube", "--seeds", "s.npy", "--table", "missing/t.npy")
        self.refused(2, 1, "49 of 50 seeds lie outside", "diagram", "--domain", "box:5,5,5:6,6,6", "--seeds",
                     self.far(), *table)
        data = bytearray((self.folder / "s.npy").read_bytes())
        data[-32:-24] = b"\0" * 6 + b"\xf8\x7f"  # not a number, in a row of the last rank
        (self.folder / "s.npy").write_bytes(data)
        self.refused(3, 1, "rank 2: .*s.npy.*49", "diagram", "--domain", "cube", "--seeds", "s.npy", *table)

    def far(self):
        return self.write("far.csv", "x,y,z\n" + "0.5,0.5,0.5\n" * 49 + "5.5,5.5,5.5\n")

    def test_help_once(self):
        out = self.on(3, "diagram", "--help").stdout
        self.assertEqual(out.count("Compute a power diagram on all ranks and write it"), 1)
        self.assertIn(".pvtu", out)


if __name__ == "__main__":
    os.environ.setdefault("POCL_MAX_PTHREAD_COUNT", "1")
    unittest.main(verbosity=1)
