#!/usr/bin/env python3
"""Diagrams computed piece after piece in files.

usage: test_out_of_core.py PATH_OF_POWERCELL [unittest options]
"""

import os
import random
import signal
import subprocess
import time
import unittest

from tool import TOOL, ToolTest, npy, read_npy

MEMORY = "290M"  # so little that 30,000 seeds are some pieces


class OutOfCore(ToolTest):
    def seeds(self, count, name="s.npy", dimension=3):
        random.seed(count)
        weight = 0.5 * max(count, 1) ** (-2 / dimension)
        rows = [[random.random() for _ in range(dimension)] + [weight * random.random()] for _ in range(count)]
        (self.folder / name).write_bytes(npy(rows))
        return rows

    def command(self, *more, seeds="s.npy", memory=MEMORY, table="t.npy"):
        return ["diagram", "--domain", "cube", "--seeds", seeds, "--memory", memory, "--table", table, *more]

    def wait_for(self, process, name):
        """Until a file is finished in the folder beside the table."""
        while not (self.folder / "t.npy.parts" / name).exists():
            self.assertIsNone(process.poll())
            time.sleep(0.005)

    def test_equals_the_diagram_in_memory(self):
        self.seeds(30000)
        report = self.report(*self.command("--walls", "w.npy"))
        self.assertGreater(report["out_of_core"]["pieces"], 1)
        self.assertLess(report["relative_error"], 1e-12)
        self.assertEqual(report["files"], ["t.npy", "w.indptr.npy", "w.indices.npy", "w.data.npy"])
        self.assertFalse((self.folder / "t.npy.parts").exists())
        whole = self.report("diagram", "--domain", "cube", "--seeds", "s.npy", "--table", "m.npy", "--walls", "m.csv")
        for key in ("seeds", "cells", "hidden", "duplicate"):
            self.assertEqual(report[key], whole[key])
        ours, theirs = read_npy(self.folder / "t.npy"), read_npy(self.folder / "m.npy")
        self.assertEqual(len(ours), 30000)
        for a, b in zip(ours, theirs):
            self.assertEqual((a[0], a[-1]), (b[0], b[-1]))  # status, number of neighbours
            self.assertAlmostEqual(a[1], b[1], delta=1e-17)
        indptr, indices, data = (read_npy(self.folder / f"w.{part}.npy") for part in ("indptr", "indices", "data"))
        self.assertEqual((indptr[0], indptr[-1], len(indptr)), (0, len(indices), 30001))
        walls = self.rows("m.csv")
        self.assertEqual(indices, [int(row["neighbor"]) for row in walls])
        for a, row in zip(data, walls):
            self.assertAlmostEqual(a, float(row["measure"]), delta=1e-13)

    def test_walls_of_periodic_domains_have_shifts(self):
        self.seeds(30000)
        report = self.report(*self.command("--periodic", "--walls", "w.npy", memory="310M"))
        self.assertGreater(report["out_of_core"]["pieces"], 1)
        self.assertEqual(report["files"], ["t.npy"] + [f"w.{part}.npy" for part in ("indptr", "indices", "data", "shift")])
        self.good("diagram", "--domain", "cube", "--periodic", "--seeds", "s.npy", "--walls", "m.csv")
        walls = self.rows("m.csv")
        self.assertEqual(read_npy(self.folder / "w.indices.npy"), [int(row["neighbor"]) for row in walls])
        self.assertEqual(read_npy(self.folder / "w.shift.npy"),
                         [tuple(int(row[axis]) for axis in ("sx", "sy", "sz")) for row in walls])

    def test_csv_has_the_columns_of_a_diagram_in_memory(self):
        self.seeds(300, dimension=2)
        arguments = ["diagram", "--domain", "square", "--seeds", "s.npy"]
        self.good(*arguments, "--memory", "1G", "--table", "t.csv", "--walls", "w.csv")
        self.good(*arguments, "--table", "m.csv", "--walls", "v.csv")
        for ours, theirs in (("t.csv", "m.csv"), ("w.csv", "v.csv")):
            ours, theirs = self.rows(ours), self.rows(theirs)
            self.assertEqual(len(ours), len(theirs))
            for a, b in zip(ours, theirs):
                self.assertEqual(list(a), list(b))
                for column in a:
                    if column in ("measure", "cx", "cy", "second_moment") and b[column]:
                        self.assertAlmostEqual(float(a[column]), float(b[column]), delta=1e-14)
                    else:
                        self.assertEqual(a[column], b[column])

    def test_text_and_csv_are_read_piece_by_piece_too(self):
        rows = self.seeds(30000)
        self.good(*self.command("--quiet"))
        arrays = (self.folder / "t.npy").read_bytes()
        self.write("s.csv", "w,name,z,y,x\n" + "".join(f"{w!r},a,{z!r},{y!r},{x!r}\n" for x, y, z, w in rows))
        self.write("s.txt", "30000\n" + "".join(f"{x!r} {y!r} {z!r} {w!r}\n" for x, y, z, w in rows))
        for name, note in (("s.csv", "left out: 'name'"), ("s.txt", "wrote")):
            self.assertRegex(self.good(*self.command(seeds=name)).stdout, note)
            self.assertEqual((self.folder / "t.npy").read_bytes(), arrays)
        self.write("s.csv", "x,y,z\n1,2,3\n1,a,3\n")
        self.bad(1, r"s.csv:3: seed 1 .from 0., column 2", *self.command(seeds="s.csv"))

    def test_killed_at_any_time_it_goes_on_and_gives_the_same_bytes(self):
        self.seeds(40000)
        self.good(*self.command("--quiet"))
        whole = (self.folder / "t.npy").read_bytes()
        (self.folder / "t.npy").unlink()
        random.seed()
        kills = 0
        for attempt in range(40):
            process = subprocess.Popen([TOOL, *self.command("--quiet")], cwd=self.folder)
            try:
                process.wait(random.uniform(0.1, 0.4) * (1 + attempt / 8))
                self.assertEqual(process.returncode, 0)
                break
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                kills += 1
                if (self.folder / "t.npy").exists():  # while it removed its folder
                    break
        self.assertGreater(kills, 0)
        self.assertEqual((self.folder / "t.npy").read_bytes(), whole)
        self.good(*self.command("--quiet"))
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["s.npy", "t.npy"])

    def test_interrupted_it_keeps_what_is_finished(self):
        rows = self.seeds(40000)
        rows[:3] = [[x + 1, y, z, w] for x, y, z, w in rows[:3]]
        (self.folder / "s.npy").write_bytes(npy(rows))
        process = subprocess.Popen([TOOL, *self.command()], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        self.wait_for(process, "pieces")
        process.send_signal(signal.SIGINT)
        message = process.communicate()[1]
        self.assertEqual(process.returncode, 130, message)
        self.assertRegex(message, "t.npy.parts")
        self.assertFalse((self.folder / "t.npy").exists())
        self.assertEqual(self.report(*self.command())["outside"], 3)  # which the first run has counted

    def test_what_has_changed_meanwhile_is_refused(self):
        self.seeds(40000)
        process = subprocess.Popen([TOOL, *self.command()], cwd=self.folder, stderr=subprocess.DEVNULL)
        self.wait_for(process, "piece_0")
        process.kill()
        process.wait()
        self.bad(1, "t.npy.parts.*differs in the memory", *self.command(memory="400M"))
        os.utime(self.folder / "s.npy", ns=(0, time.time_ns()))
        self.bad(1, "t.npy.parts.*differs in the seeds", *self.command())

    def test_bad_input(self):
        rows = self.seeds(50)
        self.bad(1, "the least is [0-9]+ MiB", *self.command(memory="1M"))
        self.bad(2, "--memory needs --table or --walls", "diagram", "--domain", "cube", "--seeds", "s.npy",
                 "--memory", "1G")
        self.bad(2, "walls are written as .npy with --memory alone", "diagram", "--domain", "cube", "--seeds", "s.npy",
                 "--walls", "w.npy")
        self.write("few.txt", "3")
        self.bad(2, "has a row for each seed", "diagram", "--domain", "cube", "--seeds", "s.npy", "--table", "t.npy",
                 "--only", "few.txt")
        self.bad(2, "leave -o", *self.command("-o", "a.vtu"))
        self.bad(2, "--scale-weights", *self.command("--scale-weights", "2"))
        self.bad(2, "'-'", *self.command(table="-"))
        self.bad(1, "need a polygon, a box", "diagram", "--domain", "sphere", "--seeds", "s.npy", "--memory", "1G",
                 "--table", "t.npy")
        self.bad(1, "double precision", *self.command("--precision", "float"))
        self.bad(1, "ids are kept in memory", *self.command("--id-column", "1"))
        self.write("s.geojson", "{}")
        self.bad(1, "is not read piece by piece", *self.command(seeds="s.geojson"))
        self.bad(1, "random seeds are made in memory", "diagram", "--domain", "cube", "--seeds", "random:9", "--memory",
                 "1G", "--table", "t.npy")
        rows[17][2] = float("nan")
        (self.folder / "s.npy").write_bytes(npy(rows))
        self.bad(1, "seed 17 .row from 0., column 2", *self.command())
        rows[17][2] = 0.5
        (self.folder / "s.npy").write_bytes(npy([[x + 10, y, z, w] for x, y, z, w in rows]))
        self.bad(1, "50 of 50 seeds lie outside", *self.command())
        self.report(*self.command("--allow-outside"))

    def test_no_seeds_and_duplicates(self):
        self.seeds(0)
        self.assertEqual(self.report(*self.command())["seeds"], 0)
        self.assertEqual(read_npy(self.folder / "t.npy"), [])
        (self.folder / "s.npy").write_bytes(npy([[0.5, 0.5, 0.5, k % 3] for k in range(9)]))
        report = self.report(*self.command())
        self.assertEqual((report["cells"], report["duplicate"]), (1, 8))
        self.assertEqual([row[:2] for row in read_npy(self.folder / "t.npy")],
                         [(0, 1.0) if k == 2 else (2, 0.0) for k in range(9)])


if __name__ == "__main__":
    unittest.main()
