#!/usr/bin/env python3
"""The tool as a program: subcommands, errors and files.

usage: test_cli.py PATH_OF_POWERCELL [unittest options]
"""

import json
import os
import pathlib
import re
import subprocess
import time
import unittest

from tool import DATA, SHAPES, TOOL, ToolTest, interrupt


class Usage(ToolTest):
    def test_help_has_examples(self):
        for command in [[]] + [[name] for name in self.commands()]:
            self.assertIn("Examples:", self.good(*command, "--help").stdout)

    def test_version(self):
        self.assertRegex(self.good("--version").stdout, r"^\d+\.\d+\.\d+\n$")

    def test_wrong_usage_is_one_line_and_2(self):
        for arguments in ([], ["no-such"], ["diagram"], ["diagram", "--domain", "square"],
                          ["diagram", "--domain", "square", "--seeds", "random:5", "--precision", "half"],
                          ["diagram", "--domain", "square", "--seeds", "random:5", "--neighbors", "best"],
                          ["diagram", "--domain", "square", "--seeds", "random:5", "--threads", "-1"],
                          ["diagram", "--domain", "square", "--seeds", "random:5", "--kind", "solid"],
                          ["verify", "--count", "0"], ["demo", "--frobnicate"], ["bench", "--n", "0"],
                          ["bench", "--repeat", "0"], ["bench", "--precision", "half"],
                          ["bench", "--fail-below", "0.9"],
                          ["bench", "--compare", "a.json", "--fail-below", "0"]):
            with self.subTest(arguments=arguments):
                self.bad(2, "--help", *arguments)


class Devices(ToolTest):
    def test_table_and_json_agree(self):
        devices = self.report("devices")["devices"]
        self.assertGreater(len(devices), 0)
        table = self.good("devices").stdout
        for device in devices:
            self.assertRegex(device["device"], r"^\d+:\d+$")
            self.assertIn(device["name"], table)
            self.assertGreater(device["memory_bytes"], 0)
            self.assertIsNone(device["refused"])

    def test_number_and_name_choose_a_device(self):
        device = self.report("devices")["devices"][0]
        for selector in (device["device"], device["name"].upper()):
            report = self.report("diagram", "--domain", "square", "--seeds", "random:10", "--device", selector)
            self.assertEqual(report["device"], device["name"])

    def test_a_group_of_devices_gives_the_table_of_one(self):
        env = {"POCL_DEVICES": "basic pthread"}  # where the driver is PoCL
        devices = self.report("devices", env=env)["devices"]
        names = [device["device"] for device in devices]
        arguments = ("diagram", "--domain", "cube", "--seeds", "random:30000", "--table")
        self.good(*arguments, "one.csv", "--device", names[-1], env=env)
        report = self.report(*arguments, "all.csv", "--device", "all", env=env)
        self.assertEqual(set(report["device"].split(" + ")), {device["name"] for device in devices})
        self.good(*arguments, "list.csv", env={**env, "POWERCELL_DEVICE": ",".join(names)})
        if len({device["name"] for device in devices if device["name"].startswith(("basic", "pthread"))}) == len(devices):
            one = (self.folder / "one.csv").read_bytes()
            for table in ("all.csv", "list.csv"):
                self.assertEqual((self.folder / table).read_bytes(), one)

    def test_groups_that_cannot_be_are_refused(self):
        name = self.report("devices")["devices"][0]["device"]
        arguments = ("diagram", "--domain", "square", "--seeds", "random:10", "--device")
        self.bad(1, f"{name} .* is named twice", *arguments, f"{name},{name}")
        self.bad(1, "empty name", *arguments, f"{name},")
        env = {"POCL_DEVICES": "basic pthread"}
        if len(self.report("devices", env=env)["devices"]) > 1:
            for command in ("verify", "tune"):
                self.bad(1, "for one device", command, "--device", "all", env=env)

    def test_unknown_device_lists_the_known_ones(self):
        name = self.report("devices")["devices"][0]["name"]
        arguments = ("diagram", "--domain", "square", "--seeds", "random:10")
        self.bad(1, re.escape(name), *arguments, "--device", "no such device")
        self.bad(1, re.escape(name), *arguments, env={"POWERCELL_DEVICE": "99:99"})

    def test_an_inexact_device_is_refused_with_the_reason(self):
        library = self.folder / "inexact.so"
        source = pathlib.Path(__file__).with_name("inexact_device.c")
        subprocess.run(["cc", "-shared", "-fPIC", "-o", library, source], check=True, timeout=60)
        inexact = {"LD_PRELOAD": str(library)}
        arguments = ("diagram", "--domain", "square", "--seeds", "random:10")
        reason = r"computes wrongly: a / b in double for .* of which the proofs of cells allow 2.5; .*POWERCELL_FP64=never"
        self.bad(1, reason, *arguments, env=inexact)
        devices = json.loads(self.good("devices", "--json", env=inexact).stdout)["devices"]
        for device in devices:
            self.assertRegex(device["refused"], reason)
        self.assertRegex(self.good("devices", env=inexact).stdout, f"refused: .*{reason}")
        self.good(*arguments, env={**inexact, "POWERCELL_FP64": "never"})
        self.bad(1, "POWERCELL_FP64 is 'no'; 'never' is expected", *arguments, env={"POWERCELL_FP64": "no"})

    def test_pocl_without_a_cache_says_what_to_set(self):
        names = [device["name"] for device in self.report("devices")["devices"]]
        if len(names) != 1 or "pthread" not in names[0]:
            self.skipTest("not PoCL's device alone")
        for arguments in (("devices",), ("diagram", "--domain", "square", "--seeds", "random:10")):
            self.bad(1, "PoCL is installed but has no device: .* set POCL_CACHE_DIR", *arguments,
                     env={"POCL_CACHE_DIR": "/proc/nowhere"})

    def test_log_on_request_only(self):
        arguments = ("diagram", "--domain", "square", "--seeds", "random:10", "--json")
        self.assertEqual(self.good(*arguments, env={"POWERCELL_LOG": ""}).stderr, "")
        told = self.good(*arguments, env={"POWERCELL_LOG": "info"})
        self.assertEqual(json.loads(told.stdout)["seeds"], 10)
        self.assertRegex(told.stderr, "powercell: 10 seeds, 10 pairs in ")
        self.assertNotIn("10 of 10 pairs", told.stderr)
        self.assertIn("10 of 10 pairs", self.good(*arguments, env={"POWERCELL_LOG": "detail"}).stderr)


class Diagram(ToolTest):
    def test_report_has_the_promised_keys(self):
        report = self.report("diagram", "--domain", "square", "--seeds", "random:1000:0:0.002")
        for key in ("seeds", "cells", "hidden", "duplicate", "measure", "domain_measure", "relative_error", "device",
                    "precision", "neighbors", "version", "seconds", "files"):
            self.assertIn(key, report)
        for key in ("total", "prepare", "pairs", "neighbors", "clip", "collect", "read", "build", "write"):
            self.assertGreaterEqual(report["seconds"][key], 0)
        self.assertEqual(report["cells"] + report["hidden"] + report["duplicate"], 1000)
        self.assertGreater(report["hidden"], 0)
        self.assertEqual(report["domain_measure"], 1)

    def test_phases_add_up_to_the_total_with_and_without_compilation(self):
        for domain in ("sphere:8", "torus:6"):  # some kernels of the second are compiled already
            with self.subTest(domain=domain):
                seconds = self.report("diagram", "--domain", domain, "--seeds", "random:50",
                                      env={"POCL_CACHE_DIR": str(self.folder)})["seconds"]
                parts = [seconds[key] for key in ("prepare", "pairs", "neighbors", "clip", "collect")]
                self.assertGreaterEqual(min(parts), 0)
                self.assertLessEqual(sum(parts), seconds["total"] + 1e-9)

    def test_repeats_are_timed_one_by_one_and_change_nothing(self):
        arguments = "diagram", "--domain", "square", "--seeds", "random:300"
        once, often = self.report(*arguments), self.report(*arguments, "--repeat", "4")
        self.assertEqual(once["repeats"], [once["seconds"]["total"]])
        self.assertEqual(len(often["repeats"]), 4)
        self.assertGreater(min(often["repeats"]), 0)
        self.assertEqual(often["repeats"][-1], often["seconds"]["total"])
        self.assertEqual(often["measure"], once["measure"])
        self.assertRegex(self.good(*arguments, "--repeat", "4").stdout, r"; first [0-9.e-]+ s, least of the 3 after it [0-9.e-]+ s\n$")
        self.bad(2, "--repeat", *arguments, "--repeat", "0")

    def test_ends_with_the_self_check(self):
        out = self.good("diagram", "--domain", "cube", "--seeds", "random:50").stdout
        self.assertRegex(out.splitlines()[-1], r"^50 cells, 0 hidden, 0 duplicate; sum of measures / domain = 1 [+-] ")

    def test_quiet_prints_nothing(self):
        done = self.good("diagram", "--domain", "square", "--seeds", "random:50", "-o", "a.svg", "--quiet")
        self.assertEqual(done.stdout + done.stderr, "")
        self.assertTrue((self.folder / "a.svg").exists())

    def test_shipped_shapes_in_either_precision(self):
        for shape in SHAPES:
            for precision, allowed in (("double", 1e-12), ("float", 1e-5)):
                with self.subTest(shape=shape, precision=precision):
                    report = self.report("diagram", "--domain", DATA / shape, "--seeds", "random:5000:-0.5:0.5:3",
                                         "--precision", precision)
                    self.assertEqual(report["precision"], precision)
                    self.assertLessEqual(report["relative_error"], allowed)

    def test_neighbour_providers_agree(self):
        masses = []
        for neighbors in ("tree", "flann"):
            self.report("diagram", "--domain", "cube", "--seeds", "random:500:0:0.02:4", "--neighbors", neighbors,
                        "--table", "t.csv")
            rows = self.rows("t.csv")
            masses.append([(row["status"], float(row["measure"])) for row in rows])
        for tree, flann in zip(*masses):
            self.assertEqual(tree[0], flann[0])
            self.assertAlmostEqual(tree[1], flann[1], delta=1e-12)

    def test_results_have_the_same_bits_every_time(self):
        tables = []
        for threads in (1, 2):
            self.good("diagram", "--domain", DATA / "italy.geojson", "--seeds", "random:500", "--table", "t.csv",
                      "--threads", threads)
            tables.append((self.folder / "t.csv").read_bytes())
        self.assertEqual(*tables)

    def test_every_output_format(self):
        common = [".png", ".vtu", ".vtp", ".obj", ".ply", ".off", ".msh", ".json", ".html"]
        for shape, dimension in SHAPES.items():
            bodies = [".stl", ".tess"] if shape == "bracket.mesh" else []
            flat = [".svg", ".pdf", ".geojson"] if dimension == 2 else []
            names = ["out" + extension for extension in common + bodies + flat]
            with self.subTest(shape=shape):  # all in one run, which takes a tenth of the time
                report = self.report("diagram", "--domain", DATA / shape, "--seeds", "random:60",
                                     *(word for name in names for word in ("-o", name)))
                self.assertEqual((report["files"], sorted(p.name for p in self.folder.iterdir())), (names, sorted(names)))
                for path in self.folder.iterdir():
                    self.assertGreater(path.stat().st_size, 200)
                    path.unlink()

    def test_whole_cells(self):
        """A cell of a mesh is one polyhedron or several convex pieces, which share their points."""
        base = ["diagram", "--domain", DATA / "bracket.mesh", "--seeds", "random:40"]
        report = self.report(*base, "-o", "pieces.vtu")
        self.good(*base, "-o", "whole.vtu", "--whole-cells")
        counts = {}
        for name in ("pieces", "whole"):
            text = (self.folder / (name + ".vtu")).read_text()
            counts[name] = [int(n) for n in re.search(r'NumberOfPoints="(\d+)" NumberOfCells="(\d+)"', text).groups()]
            self.assertEqual("piece_measure" in text, name == "pieces")
        self.assertEqual(counts["whole"][1], report["cells"])
        self.assertGreater(counts["pieces"][1], report["cells"])
        self.assertLess(counts["pieces"][0], 4 * counts["pieces"][1])  # a piece has at least four, all of its own
        self.bad(2, "--whole-cells is for .vtu files", *base, "--whole-cells", "-o", "a.json")
        self.bad(2, "--whole-cells is for volumes", "diagram", "--domain", "square", "--seeds", "random:9",
                 "--whole-cells", "-o", "a.vtu")

    def test_formats_that_do_not_suit_the_domain(self):
        for domain, name, message in (("square", "a.stl", r"a\.stl: \.stl holds closed bodies"),
                                      ("sphere", "a.tess", r"a\.tess: \.tess holds tessellations of polygons and volumes")):
            self.bad(1, message, "diagram", "--domain", domain, "--seeds", "random:9", "-o", name)
        self.bad(1, r"\.tess is written for bounded domains", "diagram", "--domain", "cube", "--periodic", "--seeds",
                 "random:9", "-o", "a.tess")

    def test_few_and_equal_seeds(self):
        for text, cells, duplicate in (("# none\n", 0, 0), ("0.5 0.5 0\n", 1, 0), ("0.5 0.5 0\n" * 3, 1, 2),
                                       ("0.2 0.5 1\n0.8 0.5 1\n", 2, 0)):
            with self.subTest(text=text):
                report = self.report("diagram", "--domain", "square", "--seeds", self.write("s.txt", text))
                self.assertEqual((report["cells"], report["duplicate"]), (cells, duplicate))


class Names(ToolTest):
    """Unusual file names."""

    def test_names_that_are_not_utf8_are_replaced_in_json(self):
        name = os.fsdecode(b"\xff.svg")
        report = self.report("diagram", "--domain", "square", "--seeds", "random:9", "-o", name)
        self.assertEqual(report["files"], ["\ufffd.svg"])
        self.assertEqual([path.name for path in self.folder.iterdir()], [name])
        seeds = os.fsdecode(b"\xff.csv")
        self.write(seeds, "0.3 0.4\n0.7 0.5\n")
        self.report("verify", "--domain", "square", "--seeds", seeds)
        self.assertEqual(self.report("transport", "--domain", "square", "--seeds", seeds, "--log", name)["files"],
                         ["\ufffd.svg"])
        self.assertEqual(self.report("sample", "-n", 300, "-o", name)["files"], ["\ufffd.svg"])
        self.assertEqual(self.report("remesh", "torus:12", "--count", 200, "-o", name[0] + ".off")["files"], ["\ufffd.off"])


    def test_line_ends_in_names_leave_messages_on_one_line(self):
        self.bad(1, r"no\?such\.csv", "diagram", "--domain", "square", "--seeds", "no\nsuch.csv")


class WrongUsage(ToolTest):
    """Wrong arguments exit with 2."""

    def test_unknown_commands(self):
        self.bad(2, "unknown command 'diagramm'", "diagramm")
        self.bad(2, "unknown option '--domain'", "--domain", "square")

    def test_numbers_out_of_range_are_reported_in_few_digits(self):
        treemap = ("treemap", "t.csv", "-o", "t.svg")
        for says, arguments in ((r"--tolerance: 0 is not above 0 ", (*treemap, "--tolerance", "0")),
                                (r"--size: 1e9 is not from 64 to 20000 ", (*treemap, "--size", "1e9")),
                                (r"--size: 'x' is not a number ", (*treemap, "--size", "x")),
                                (r"--repeat: -1 is not above 0 ", ("bench", "--repeat", "-1")),
                                (r"--tolerance: 1 is not from 1e-16 to 0\.999 ",
                                 ("transport", "--domain", "square", "--seeds", "random:9", "--tolerance", "1"))):
            with self.subTest(arguments=arguments):
                self.bad(2, says, *arguments)

    def test_options_that_need_others(self):
        self.bad(2, "dot-contrast requires --image", "sample", "--dot-contrast", "0.5")
        self.bad(2, "either a saved diagram or", "verify", "a.json", "--seeds", "random:9")

    def test_wrong_kinds_of_domains(self):
        self.bad(1, "domain square is a polygon, but a surface is wanted", "remesh", "square",
                 "--count", "9", "-o", "m.off")


class DiagramErrors(ToolTest):
    def diagram(self, *arguments):
        return ("diagram", "--domain", "square", "--seeds", "random:20", *arguments)

    def test_unreadable_files(self):
        self.bad(1, "no-such.off", "diagram", "--domain", "no-such.off", "--seeds", "random:20")
        self.bad(1, "no-such.csv", "diagram", "--domain", "square", "--seeds", "no-such.csv")
        self.write("d.xyz", "1 2 3\n")
        self.bad(1, r"d\.xyz", "diagram", "--domain", "d.xyz", "--seeds", "random:20")

    def test_bad_seeds_name_file_and_line(self):
        self.bad(1, r"s\.txt:2", "diagram", "--domain", "square", "--seeds", self.write("s.txt", "0 0 0\n0 nan 0\n"))
        self.bad(1, r"s\.txt:3", "diagram", "--domain", "square",
                 "--seeds", self.write("s.txt", "0 0 0\n.5 .5 0\n0 zero 0\n"))
        self.bad(2, "random", "diagram", "--domain", "square", "--seeds", "random:many")

    def test_bad_domains_name_the_element(self):
        self.write("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")
        self.bad(1, r"m\.off", "diagram", "--domain", "m.off", "--seeds", "random:5")
        self.write("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n")
        self.bad(1, r"m\.off", "diagram", "--domain", "m.off", "--seeds", "random:5")
        self.write("bow.wkt", "POLYGON((0 0, 1 1, 1 0, 0 1, 0 0))")
        self.bad(1, "bow", "diagram", "--domain", "bow.wkt", "--seeds", "random:5")

    def test_solids_that_are_refused(self):
        pyramid = "OFF\n4 {} 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
        faces = ("3 0 2 1", "3 0 1 3", "3 0 3 2", "3 1 2 3")
        for name, rows, why in (("open", faces[:3], r"m\.off: .*open.*edge from"),
                                ("turned", faces[:3] + ("3 1 3 2",), r"m\.off: .*inside out in a part")):
            with self.subTest(name):
                self.write("m.off", pyramid.format(len(rows)) + "\n".join(rows) + "\n")
                self.bad(1, why, "diagram", "--domain", "m.off", "--solid", "--seeds", "random:5")
        self.bad(1, "--solid takes the inside of a closed surface", "diagram", "--domain", "cube", "--solid",
                 "--seeds", "random:5")
        self.bad(2, "--solid.*--kind is volume", "diagram", "--domain", "sphere:3", "--solid", "--kind", "volume",
                 "--seeds", "random:5")

    def test_elements_given_twice_and_overlaps_are_reported(self):
        pyramid = "OFF\n4 {} 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
        faces = ("3 0 2 1", "3 0 1 3", "3 0 3 2", "3 1 2 3")
        self.write("once.off", pyramid.format(4) + "\n".join(faces) + "\n")
        self.write("twice.off", pyramid.format(6) + "\n".join((*faces, "3 1 3 0", "3 0 1 1")) + "\n")
        arguments = "diagram", "--domain", "twice.off", "--seeds", "random:3"
        done = self.good(*arguments, "--json")
        report = json.loads(done.stdout)
        self.assertEqual(report["domain_measure"],
                         self.report("diagram", "--domain", "once.off", "--seeds", "random:3")["domain_measure"])
        self.assertEqual(len(report["notes"]), 3)  # the first describes the file
        self.assertIn("powercell: note: twice.off: left out 1 triangle given twice", done.stderr)
        self.assertIn("triangle 4, the same as 1", done.stderr)
        self.assertIn("flat triangle, the first is triangle 5", done.stderr)
        self.assertEqual(self.good(*arguments, "--quiet").stderr, "")
        # Two tetrahedra without a common vertex, one of which contains the other.
        self.write("t.tet", "8 2\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n1 1 1\n3 1 1\n1 3 1\n1 1 3\n0 1 2 3\n4 5 6 7\n")
        self.bad(1, r"t\.tet: tetrahedra 0 and 1 overlap around \(1\.5, 1\.5, 1\.5\)", "diagram", "--domain", "t.tet",
                 "--seeds", "random:3")

    def test_each_error_names_the_place(self):
        for text, says in (("0 0 0\n0 inf 0\n", r"s:2: seed 1 .*'inf' is not a finite number"),
                           ("0 0 0\n0 0\n", r"s:2: seed 1 .*2 columns"), ("0 0 1e999\n", "s:1: .*too large"),
                           ("1e300 0 0\n0 0 0\n", "seed 0: coordinate x is 1e.300"), ("9\n0 0\n", "9 seeds are announced"),
                           ("id,lon,w\n0,0,0\n", "s:1: the header names "), ("1 1\n0,5 1\n", "s:2: .*decimal commas are not read"),
                           ("0 0\x1b[31m\x07 1\n", "s:1: .*is not a number")):
            with self.subTest(seeds=text):
                self.bad(1, says, "diagram", "--domain", "square", "--seeds", self.write("s", text))
        for name, text, says in (("e.off", "", "e.off: is empty"), ("e.wkt", "POLYGON EMPTY", "e.wkt: holds no polygon"),
                                 ("n.ply", "\0\1\2", "n.ply:1: does not begin with 'ply'"),
                                 ("h.wkt", "POLYGON((0 0,1 0,0 1,0 0),(2 2,3 2,2 3,2 2))", "h.wkt: part 0: .*hole"),
                                 ("f.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
                                            "1 1 0 0\nTetrahedra 1\n1 2 3 4 0\nEnd\n", "f.mesh: .*empty: all 1 .*flat"),
                                 ("l.off", "OFF\n1099511627776 1 0\n0 0 0\n", "l.off:2: 1099511627776 vertices")):
            with self.subTest(domain=text):
                self.bad(1, says, "diagram", "--domain", self.write(name, text), "--seeds", "random:5")
        self.bad(2, "N is above 1073741824", "diagram", "--domain", "square", "--seeds", "random:1073741825")

    def test_outputs_are_refused_before_anything_is_computed(self):
        self.bad(2, r"a\.xyz: unknown extension.*--help", *self.diagram("-o", "a.xyz", "-o", "a.svg"))
        self.bad(1, "svg", "diagram", "--domain", "cube", "--seeds", "random:20", "-o", "a.svg")

    def test_unwritable_files(self):
        self.bad(1, "missing", *self.diagram("-o", "missing/a.svg"))
        self.bad(1, "missing", *self.diagram("--table", "missing/t.csv"))
        if os.path.exists("/dev/full"):
            self.bad(1, "/dev/full", *self.diagram("--table", "/dev/full"))

    def test_unwritable_files_are_reported_before_the_computation(self):
        (self.folder / "folder").mkdir()
        late = ("--domain", "square", "--seeds", "no-such.csv")
        for command, option in (("diagram", "--table"), ("diagram", "--walls"), ("transport", "--table"),
                                ("transport", "--log"), ("sample", "--analysis"), ("sample", "--cells"),
                                ("remesh", "--report")):
            start = {"sample": ("--domain", "no-such.off"), "remesh": ("no-such.off", "--count", 9)}.get(command, late)
            with self.subTest(command=command, option=option):
                self.bad(1, r"nodir/t\.svg: cannot create it", command, *start, option, "nodir/t.svg")
                self.bad(1, r"folder: cannot open it", command, *start, option, "folder")
                name = "t.off" if command == "remesh" else "t.svg"
                self.bad(2, rf"\./{name} and {name} are the same file.*'powercell {command} --help'", command, *start,
                         option, name, "-o", "./" + name)
        self.bad(1, r"nodir/t\.svg: cannot create it", "treemap", "no-such.csv", "-o", "nodir/t.svg")
        self.bad(2, "the same file", "treemap", "no-such.csv", "-o", "t.svg", "-o", "t.svg")
        self.good(*self.diagram("--table", "/dev/null", "--walls", "/dev/null"))

    def test_a_pipe_is_written_once(self):
        os.mkfifo(self.folder / "pipe")
        process = subprocess.Popen([TOOL, *self.diagram("--table", "pipe")], cwd=self.folder, stdout=subprocess.PIPE)
        self.assertEqual(len((self.folder / "pipe").read_text().splitlines()), 21)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0)

    def test_a_dash_is_standard_output(self):
        for command in ("diagram", "transport"):
            for option, begin in (("--table", "seed,x,y,weight,status,"), ("--walls", "seed,neighbor,measure\n")):
                with self.subTest(command=command, option=option):
                    done = self.good(command, "--domain", "square", "--seeds", "random:20", option, "-")
                    self.assertTrue(done.stdout.startswith(begin), done.stdout)
                    self.assertNotIn("cells, ", done.stdout)
                    self.assertIn("20 cells, ", done.stderr)
                    self.assertEqual(list(self.folder.iterdir()), [])
        self.good(*self.diagram("--table", "t.csv"))
        self.assertEqual(self.good(*self.diagram("--table", "-", "--quiet")).stdout, (self.folder / "t.csv").read_text())
        self.bad(2, "two files '-' would mix on the standard output; name files", *self.diagram("--table", "-", "--walls", "-"))
        self.bad(2, "--json and the file '-' would mix", *self.diagram("--table", "-", "--json"))
        self.bad(1, "no-such.csv", "diagram", "--domain", "square", "--seeds", "no-such.csv", "--table", "-")

    def test_a_reader_that_leaves_early_is_no_error(self):
        for arguments in (("diagram", "--domain", "square", "--seeds", "random:50000", "--table", "-"),
                          self.diagram(), ("devices",)):
            with self.subTest(arguments=arguments):
                process = subprocess.Popen([TOOL, *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE, text=True)
                if "-" in arguments:
                    self.assertTrue(process.stdout.readline().startswith("seed,x,y,"))
                process.stdout.close()
                error = process.stderr.read()
                process.stderr.close()
                self.assertEqual(process.wait(timeout=60), 0, error)
                self.assertNotIn("error", error)

    def test_an_older_file_survives_a_failure(self):
        self.write("a.svg", "older")
        self.bad(1, "missing", *self.diagram("--table", "missing/t.csv"))
        self.assertEqual((self.folder / "a.svg").read_text(), "older")

    def test_a_full_standard_output_is_an_error(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full here")
        with open("/dev/full", "w") as full:
            done = subprocess.run([TOOL, *self.diagram()], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("standard output", done.stderr)

    def test_interrupt_leaves_nothing(self):
        # While kernels are built, seeds are made and cells are clipped. The driver's compiler may print messages before.
        for wait in (0.1, 0.2, 0.3, 0.4, 1.5):
            process = subprocess.Popen([TOOL, "diagram", "--domain", "cube", "--seeds", "random:3000000", "-o",
                                        "a.vtu", "--table", "t.csv"], cwd=self.folder, stderr=subprocess.PIPE,
                                       stdout=subprocess.PIPE, text=True)
            interrupt(process, wait)
            out, error = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 130, error)
            self.assertTrue(error.endswith("powercell: error: interrupted\n"), error)
            self.assertEqual(error.count("powercell: error"), 1, error)
            self.assertEqual(out, "")
            self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main(verbosity=1)
