#!/usr/bin/env python3
"""One progress bar a run, from 0 to 100 %, and times that add up, with an empty cache of kernels and with a full one.

usage: test_progress.py POWERCELL [unittest arguments]
"""
import os
import tempfile
import unittest

from tool import ALL_INPUTS, DATA, TerminalTest

COMPUTING = {"diagram": "total", "transport": "solve", "sample": "sample", "remesh": "remesh", "treemap": "layout",
             "verify": "check"}


class ProgressTest(TerminalTest):
    def tree(self, leaves):
        return self.write("tree.csv", "id,parent,name,value\nr,,R,\n" +
                          "".join(f"{i},r,L{i},{1 + i % 7}\n" for i in range(leaves)))

    def test_one_bar_for_each_command(self):
        runs = {
            "diagram": ["--domain", "cube", "--seeds", "random:200000", "--table", "t.csv", "-o", "c.off"],
            "transport": ["--domain", "square", "--seeds", "random:20000", "--table", "t.csv"],
            "sample": ["-n", "4000", "-o", "p.csv"],
            "remesh": [DATA / "pretzel.off", "--count", "1000", "-o", "m.off"],
            "treemap": [self.tree(6000), "-o", "m.svg"],
            "verify": ["--count", "4000"],
            "bench": ["--quick", "--n", "100000", "--domain", "cube", "--precision", "double", "--device", "cpu"],
        }
        for command, arguments in runs.items():
            with self.subTest(command):
                lines = self.check_bar(self.on_terminal(command, *arguments))
                if self.seconds > 2 and command != "treemap":  # whose steps may be few
                    self.assertTrue([line for line in lines if " left" in line], lines)

    def test_sampling_in_all_modes(self):
        for mode in (["--mode", "quantise", "--iterations", "30", "--movement", "0"], ["--periodic"],
                     ["--domain", "cube"], ["--descent", "lbfgs", "--iterations", "4", "--hexatic", "0.4"]):
            with self.subTest(mode):
                self.check_bar(self.on_terminal("sample", "-n", "5000", "-o", "p.csv", *mode))

    def test_no_bar_where_none_is_wanted(self):
        for silent in ("--quiet", "--json"):
            self.assertEqual(self.on_terminal("transport", "--domain", "square", "--seeds", "random:20000", silent), "")
        self.assertEqual(self.good("transport", "--domain", "square", "--seeds", "random:20000").stderr, "")

    def test_a_failure_leaves_no_bar(self):
        shown = self.on_terminal("transport", "--domain", "square", "--seeds", "random:60000", "--max-steps", "1", code=1)
        self.assertRegex(shown, r"(^|\r *\r)powercell: error: not converged[^\r\n]*\r?\n$")

    def test_compiling_is_shown(self):
        with tempfile.TemporaryDirectory() as cache:
            shown = self.on_terminal("diagram", "--domain", "square", "--seeds", "random:1000", "--table", "t.csv",
                                     env={"POCL_CACHE_DIR": cache, "POWERCELL_CACHE": "never"})
        self.assertTrue([line for line in self.check_bar(shown) if "compiling kernels, first run only" in line])

    def check_times(self, command, report, uncompiled):
        seconds = report["seconds"]
        stages = "read", "repair", "open", COMPUTING[command], "check", "build", "write"
        parts = sum(seconds.get(key, 0) for key in stages)
        if command == "verify":
            parts -= seconds["check"]  # once
        self.assertAlmostEqual(parts, seconds["run"], delta=0.1 + 0.02 * seconds["run"])
        self.assertTrue(all(value >= 0 for value in seconds.values()), seconds)
        # PoCL keeps programs itself, and builds those of an earlier run in no time, which is not 0.
        if uncompiled or "Portable Computing Language" in self.good("devices").stdout:
            self.assertGreater(seconds["build"], 1 if uncompiled else 0)
        if command == "diagram":
            inner = sum(seconds[key] for key in ("prepare", "pairs", "neighbors", "clip", "collect", "certify"))
            self.assertLessEqual(inner, seconds["total"] + 1e-9)
            self.assertAlmostEqual(inner, seconds["total"], delta=0.02 + 0.05 * seconds["total"])
        if command == "remesh":
            inner = sum(seconds[key] for key in ("sample", "dual", "relax"))
            self.assertAlmostEqual(inner, seconds["remesh"], delta=0.1)
        if command == "sample":
            run = report["runs"][0]
            self.assertLess(run["seconds"], seconds["sample"] + 1e-3)
            self.assertLess(sum(step["seconds"] for step in run["steps"]), run["seconds"] + 1e-3)
            self.assertLess(run["processor_seconds"], os.cpu_count() * run["seconds"] + 0.1)

    def test_times_with_an_empty_and_with_a_full_cache(self):
        runs = {
            "diagram": ["--domain", "cube", "--seeds", "random:500", "-o", "d.vtu"],
            "transport": ["--domain", "square", "--seeds", "random:500", "-o", "t.svg"],
            "sample": ["-n", "200", "-o", "s.svg", "--cells", "cells.svg"],
            "remesh": [DATA / "pretzel.off", "--count", "400", "--method", "transport", "-o", "m.off"],
            "treemap": [self.tree(4200), "-o", "m.svg"],
            "verify": ["--count", "200"],
        }
        # Each compiles for seconds, and the others go by the same code.
        compiled_here = {"diagram", "sample", "treemap"} if ALL_INPUTS else {"treemap"}
        for command, arguments in runs.items():
            with self.subTest(command), tempfile.TemporaryDirectory() as cache:
                env = {"POCL_CACHE_DIR": cache, "POWERCELL_CACHE_DIR": cache} if command in compiled_here else {}
                first, warm = (self.report(command, *arguments, env=env) for _ in range(2))
                self.check_times(command, first, command in compiled_here)
                self.check_times(command, warm, False)
                first, warm = first["seconds"], warm["seconds"]
                # What was compiled counts as that and as nothing else. Machines are busy: a factor of two is allowed.
                compiled = first["build"] - warm["build"]
                for key in (COMPUTING[command], "write"):
                    if key in first:
                        self.assertLess(first[key], 2 * warm[key] + 0.2 + 0.05 * compiled, (key, first, warm))
                self.assertLess(first["open"], 2 * warm["open"] + 0.5)


if __name__ == "__main__":
    unittest.main(verbosity=2)
