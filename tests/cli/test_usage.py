#!/usr/bin/env python3
"""First use: help, defaults, and the closest match of what is mistyped.

usage: test_usage.py PATH_OF_POWERCELL [unittest options]
"""

import re
import unittest

from tool import DATA, ToolTest


class Help(ToolTest):
    def test_help_of_a_command_in_two_ways(self):
        self.assertEqual(self.good("help").stdout, self.good("--help").stdout)
        commands = self.commands()
        self.assertGreater(len(commands), 8)
        for command in commands:
            with self.subTest(command):
                self.assertEqual(self.good("help", command).stdout, self.good(command, "--help").stdout)
        self.assertNotIn("manuals", commands)  # of the build

    def test_help_of_a_command_that_does_not_exist(self):
        self.bad(2, r"unknown command 'diagrm'; did you mean diagram\? ", "help", "diagrm")
        self.bad(2, r"unknown command 'zebra' \(see", "help", "zebra")
        self.bad(2, "unexpected argument 'more'", "help", "diagram", "more")

    def test_every_option_has_a_default_or_is_required(self):
        for command in self.commands():
            options = self.options(command)
            self.assertIn("--help", [name for option in options for name in option.names])
            for option in options:
                with self.subTest(command=command, option=option.title):
                    self.assertNotEqual(option.text, "")
                    if option.value:
                        self.assertRegex(option.text, r"\[(.*; )?(default: \S|required)")

    def test_defaults_are_those_that_are_used(self):
        shown = {o.names[-1]: re.search(r"default: ([^;\]]*)", o.text)[1] for o in self.options("treemap")
                 if "default: " in o.text}
        self.write("t.csv", "name,value\na,1\nb,2\nc,4\n")
        self.good("treemap", "t.csv", "-o", "a.json")
        self.good("treemap", "t.csv", "-o", "b.json", *(word for name in ("--shape", "--rounds", "--tolerance", "--seed",
                  "--size", "--threads") for word in (name, shown[name])))
        self.assertEqual(*((self.folder / name).read_text() for name in ("a.json", "b.json")))
        used = self.report("diagram", "--domain", "square", "--seeds", "random:9")
        shown = {o.names[-1]: o.text for o in self.options("diagram")}
        for name in ("--precision", "--neighbors", "--decisions"):
            value = re.search(r"default: (\w+)", shown[name])[1]
            given = self.report("diagram", "--domain", "square", "--seeds", "random:9", name, value)
            times = {"seconds": 0, "repeats": 0}
            self.assertEqual({**used, **times}, {**given, **times})

    def test_lines_fit_a_terminal(self):
        for command in [[]] + [[name] for name in self.commands()]:
            for line in self.good(*command, "--help").stdout.splitlines():
                self.assertLessEqual(len(line), 110, line)


class ClosestMatch(ToolTest):
    def test_options(self):
        begin = ("diagram", "--seeds", "random:5")
        self.bad(2, r"unknown option '--domian'; did you mean --domain\? \(see 'powercell diagram --help'\)", *begin,
                 "--domian", "square")
        self.bad(2, r"'--domian'; did you mean --domain\?", *begin, "--domian=square")
        self.bad(2, r"'-domain'; did you mean --domain\?", *begin, "-domain", "square")
        self.bad(2, r"'--prec'; did you mean --precision\?", *begin, "--domain", "square", "--prec", "float")
        self.bad(2, r"unknown option '--frobnicate' \(see", *begin, "--domain", "square", "--frobnicate")
        self.bad(2, "unknown option '--count' of this command; verify, remesh have it", *begin, "--count", "5")
        self.bad(2, "'--json' before a command", "--json", "diagram")

    def test_a_swap_in_any_option_is_understood(self):
        """Each long option of each command with its two middle letters swapped."""
        for command in self.commands():
            known = {name for option in self.options(command) for name in option.names}
            for name in sorted(known):
                k = len(name) // 2
                typed = name[:k] + name[k + 1] + name[k] + name[k + 2:] if len(name) > 6 else name
                if typed in known:
                    continue
                with self.subTest(command=command, typed=typed):
                    error = self.bad(2, "unknown option", command, typed).stderr
                    self.assertIn(f"unknown option '{typed}'; did you mean {name}?", error)

    def test_commands(self):
        for typed, meant in (("diagramm", "diagram"), ("diag", "diagram"), ("Demo", "demo"), ("tranpsort", "transport"),
                             ("benhc", "bench")):
            self.bad(2, fr"unknown command '{typed}'; did you mean {meant}\?", typed, "--domain", "square")
        self.bad(2, r"unknown command 'cells' \(see", "cells")

    def test_words(self):
        begin = ("diagram", "--domain", "square", "--seeds", "random:5")
        self.bad(2, r"--precision: 'duble' is none of auto, double, float; did you mean double\?", *begin, "--precision",
                 "duble")
        self.bad(2, r"--decisions: 'slow' is none of exact, fast \(see", *begin, "--decisions", "slow")
        self.bad(2, r"--method: 'fop' is none of fpo, transport; did you mean fpo\?", "remesh", "sphere", "--count", "9",
                 "--method", "fop")
        self.bad(2, r"--paper: '4' is none of 2, 3 ", "sample", "--paper", "4")
        self.bad(2, r"a\.pngg: unknown extension .*; did you mean \.png\?", *begin, "-o", "a.pngg")

    def test_domains_and_files(self):
        for typed, meant in (("sqaure", "square"), ("shpere:40", "sphere"), ("Torus", "torus"), ("bx:0,0:1,1", "box:")):
            self.bad(1, fr"no such file; did you mean {meant}\?", "diagram", "--domain", typed, "--seeds", "random:5")
        self.bad(1, r"unknown domain 'cub'; .*did you mean cube\?", "bench", "--domain", "cub")
        (self.folder / "data").mkdir()
        self.write("data/towns.csv", "0.5 0.5 0\n")
        begin = ("diagram", "--domain", "square", "--seeds")
        self.bad(1, r"data/towns\.cvs: no such file; did you mean data/towns\.csv\?", *begin, "data/towns.cvs")
        self.bad(1, r"towns\.csv: no such file; check the path", *begin, "towns.csv")
        self.bad(1, r"no/towns\.csv: no such file; check the path", *begin, "no/towns.csv")
        self.bad(1, r"; did you mean .*pretzel\.off\?", "remesh", DATA / "pretzl.off", "--count", "9")

    def test_columns(self):
        self.write("s.csv", "name,turnover,px,py\na,1,0.2,0.3\nb,2,0.7,0.6\n")
        begin = ("--domain", "square", "--seeds", "s.csv", "--x-column", "px", "--y-column", "py")
        self.bad(1, r"no column 'turnovr'; .*; did you mean turnover\?", "diagram", *begin, "--weight-column", "turnovr")
        self.bad(1, r"no column 'trunover'; .*; did you mean turnover\?", "transport", *begin, "--mass-column", "trunover")


if __name__ == "__main__":
    unittest.main(verbosity=1)
