#!/usr/bin/env python3
"""powercell bench as a program.

usage: test_bench.py PATH_OF_POWERCELL [unittest options]
"""

import copy
import csv
import io
import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree

from tool import DATA, TOOL, ToolTest, interrupt, run


class Bench(ToolTest):
    kept = None
    SMALL = ("bench", "--domain", "square", "--precision", "float", "--n", 1000, "--repeat", 2)

    def measured(self, *arguments):
        self.good(*self.SMALL, "--json", "new.json", *arguments)
        return json.loads((self.folder / "new.json").read_text())

    @property
    def record(self):
        """A copy of a record of this device, which is measured once for all tests."""
        Bench.kept = Bench.kept or self.report_of(*self.SMALL)
        return copy.deepcopy(Bench.kept)

    def changed(self, change):
        """The record as the file old.json, changed before it is written."""
        record = self.record
        change(record)
        return self.write("old.json", json.dumps(record))

    def test_every_device_precision_and_domain(self):
        record = self.report_of("bench", "--quick", "--repeat", 1, "--n", 1000)
        devices = self.report("devices")["devices"]
        expected = {(d["device"], domain, precision) for d in devices for domain in ("square", "cube", "surface", "volume")
                    for precision in (("double", "float") if d["fp64"] else ("float",))}
        self.assertEqual({(r["selector"], r["domain"], r["precision"]) for r in record["rows"]}, expected)
        self.assertEqual(len(record["rows"]), len(expected))
        regions = {r["domain"]: r["regions"] for r in record["rows"]}
        self.assertEqual(regions, {"square": 1, "cube": 1, "surface": 5120, "volume": 13824})
        for row in record["rows"]:
            self.assertTrue(row["passed"])
            self.assertLess(row["relative_error"], 1e-3 if row["precision"] == "float" else 1e-9)
            for fraction in (row["arithmetic_fraction"], row["bandwidth_fraction"]):
                self.assertGreater(fraction, 0)
                self.assertLess(fraction, 1)

    def report_of(self, *arguments):
        return json.loads(self.good(*arguments, "--json", "-").stdout)

    def test_json_has_all_figures(self):
        record = self.record
        for key in ("format", "format_version", "version", "revision", "date", "devices", "rows", "passed", "seconds"):
            self.assertIn(key, record)
        self.assertRegex(record["date"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
        for key in ("name", "driver_version", "opencl_c_version", "compute_units"):
            self.assertIn(key, record["devices"][0])
        device = record["devices"][0]
        for key in ("launch_seconds", "transfer_seconds"):
            self.assertTrue(0 < device[key] < 1)
        self.assertEqual([t["bytes"] for t in device["transfers"]], [4096 * 4 ** k for k in range(9)])
        figures = [device, *device["rates"], *device["transfers"], record["rows"][0]["measures"], record["rows"][0]["adjacency"]]
        scatters = [value for figure in figures for key, value in figure.items() if key.endswith("scatter")]
        self.assertEqual(len(scatters), 2 + 2 + 2 * 9 + 2)
        self.assertTrue(all(value >= 0 for value in scatters))
        row = record["rows"][0]
        for kind in ("measures", "adjacency"):
            self.assertEqual(len(row[kind]["seconds"]), 2)
            self.assertAlmostEqual(row[kind]["cells_per_second"], 1000 / min(row[kind]["seconds"]), delta=1)
            for phase in ("total", "prepare", "pairs", "neighbors", "clip", "collect"):
                self.assertGreaterEqual(row[kind]["phases"][phase], 0)
        self.assertGreater(row["first_result_seconds"], 0)
        self.assertGreaterEqual(row["build_seconds"], 0)
        self.assertEqual(row["arithmetic_fraction"], row["work_per_cell"]["operations"]
                         * row["measures"]["cells_per_second"] / row["device_operations_per_second"])

    def test_table(self):
        device = self.report("devices")["devices"][0]
        out = self.good(*self.SMALL, "--device", device["device"]).stdout
        self.assertIn(device["name"], out)
        self.assertRegex(out, r"a launch takes [\d.]+ us ±\d+ %, a transfer [\d.]+ us ±\d+ %\n")
        self.assertRegex(out, r"GB/s copied ±\d+ %, [\d.]+ Gflop/s multiplied and added ±\d+ %\n")
        self.assertEqual(len(re.findall(r"\n +\d+ [KM]iB +[\d.]+ +±\d+ % +[\d.]+ +±\d+ %", out)), 9)
        self.assertRegex(out, r"square +float +1,000 +[\d,]+ +±\d+ % +[\d,]+ +±\d+ % +[\d.e-]+ % +[\d.e-]+ % ")
        lines = [line for line in out.splitlines() if not line.startswith(("note:", "      "))]  # a busy machine
        self.assertRegex(lines[-1], r"^1 row in \d+ s; the measures of every run sum to the domain's$")

    def test_the_figure_of_a_device(self):
        arguments = ("bench", "--quick", "--domain", "cube", "--precision", "float", "--device", "0:0", "--repeat", 1)
        out = self.good(*arguments, "--json", "a.json").stdout
        record = json.loads((self.folder / "a.json").read_text())
        figure, row = record["headlines"][0], record["rows"][1]
        self.assertEqual([(r["domain"], r["n"]) for r in record["rows"]], [("cube", 10000), ("cube", 100000)])
        self.assertEqual(figure["n"], 100000)
        self.assertAlmostEqual(figure["million_cells_per_second"] * 1e6 / row["measures"]["cells_per_second"], 1, places=12)
        self.assertRegex(out, r"\n[\d.e-]+ million cells a second ±\d+ %: cube, white, 100,000 seeds, float, .*leave --quick out")
        self.assertEqual(self.record["headlines"], [])  # without the cube

    def test_a_file_as_domain_and_quiet(self):
        done = self.good("bench", "--quick", "--domain", DATA / "bracket.mesh", "--precision", "float", "--repeat", 1,
                         "--n", 200, "--quiet", "--json", "b.json")
        self.assertEqual(done.stdout + done.stderr, "")
        self.assertGreater(json.loads((self.folder / "b.json").read_text())["rows"][0]["regions"], 1000)

    def test_kernels_are_built_anew_on_request(self):
        self.assertTrue(self.record)  # the kernels are built
        warm, cold = self.measured()["rows"][0], self.measured("--cold")["rows"][0]
        self.assertGreater(cold["build_seconds"], 2 * warm["build_seconds"])
        self.assertGreater(cold["first_result_seconds"], warm["first_result_seconds"])

    def test_compare(self):
        def faster(record):
            record["rows"][0]["adjacency"]["cells_per_second"] *= 1e6
            record["rows"][0]["n"] = 500
        old = self.changed(faster)
        # The number of seeds is that of the earlier record; the same file may be read and then replaced.
        arguments = ("bench", "--domain", "square", "--precision", "float", "--compare", old)
        out = self.good(*arguments).stdout
        self.assertRegex(out, r"square +float +500 +~?[\d.]+ +±\d+ % +0\.00 +±\d+ % ")
        self.good(*arguments, "--fail-below", 1e-9, "--json", old)
        self.good(*arguments, "--fail-below", 0.001)

    def test_the_machine_and_the_words_of_the_user_are_kept(self):
        record = self.measured("--describe", "a desk, \u00e4 \"quoted\" word")
        self.assertEqual(record["description"], "a desk, \u00e4 \"quoted\" word")
        host = record["host"]
        self.assertEqual(host["processors"], len(os.sched_getaffinity(0)))
        self.assertAlmostEqual(host["memory_bytes"] / (os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")), 1,
                               delta=0.01)
        self.assertIn(platform.release(), host["system"])
        self.assertRegex(host["opencl_loader"], r"/libOpenCL\.so")
        found = re.search(r"^model name\s*: (.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.M)
        if found:
            self.assertEqual(host["cpu"], found[1].strip())

    def test_two_saved_files_are_compared_without_measuring(self):
        def calm(record):
            record["used_by_others"] = 0
            for kind in ("measures", "adjacency"):
                record["rows"][0][kind]["scatter"] = 0
        self.changed(calm)
        record = json.loads((self.folder / "old.json").read_text())
        record["rows"][0]["measures"]["cells_per_second"] *= 2
        record["rows"][0]["adjacency"]["cells_per_second"] *= 3
        record["description"] = "twice as fast"
        self.write("new.json", json.dumps(record))
        compare = ("bench", "--compare", "old.json", "new.json")
        # No device is needed, so none is opened.
        out = self.good(*compare, env={"POWERCELL_DEVICE": "no such device"}).stdout
        self.assertRegex(out, r"square +float +1,000 +2\.00 +±0 % +3\.00 +±0 % ")
        self.assertIn("twice as fast", out)
        self.good(*compare, "--fail-below", 1.9)
        back = ("bench", "--compare", "new.json", "old.json")
        self.assertRegex(self.good(*back).stdout, r"square +float +1,000 +0\.50 +±0 % +0\.33 +±0 % ")
        done = run(*back, "--fail-below", 0.9, cwd=self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertTrue(done.stderr.endswith("0.333 of the rate in new.json, below --fail-below 0.9\n"), done.stderr)
        record["rows"][0]["adjacency"]["scatter"] = 1.9  # less than the difference, which is 2
        self.write("scattered.json", json.dumps(record))
        self.assertRegex(self.good(*compare[:-1], "scattered.json").stdout,
                         r"square +float +1,000 +2\.00 +±0 % +3\.00 +±190 % .*\n(?!~)")
        done = run("bench", "--compare", "scattered.json", "old.json", "--fail-below", 0.9, cwd=self.folder)
        self.assertIn("below --fail-below 0.9; but the runs of both scatter by 190 %, too much to tell: measure again", done.stderr)
        record["rows"][0]["adjacency"]["scatter"] = 0
        record["used_by_others"] = 1e3
        self.write("busy.json", json.dumps(record))
        self.assertIn("note: while busy.json was measured, other programs kept 1e+03 of its processors busy",
                      self.good(*compare[:-1], "busy.json").stdout)
        done = run("bench", "--compare", "busy.json", "old.json", "--fail-below", 0.9, cwd=self.folder)
        self.assertIn("below --fail-below 0.9; but while busy.json was measured, other programs kept", done.stderr)
        self.assertEqual(self.good(*compare, "--quiet").stdout, "")
        for option in (["--quick"], ["--n", "5"], ["--json", "a.json"], ["--json", "a.json", "--describe", "x"],
                       ["--csv", "a.csv"], ["--plot", "a.svg"], ["--domain", "cube"]):
            self.bad(2, f"measures nothing; leave {option[0]} out", *compare, *option)
        for row in record["rows"]:
            row["domain"] = "elsewhere"
        self.write("other.json", json.dumps(record))
        self.bad(1, "old.json and other.json have no row of the same domain", "bench", "--compare", "old.json", "other.json")
        self.bad(1, r"newer\.json: no such file; did you mean new\.json\?", "bench", "--compare", "old.json", "newer.json")

    def test_a_rate_below_the_limit_is_a_failure(self):
        old = self.changed(lambda record: record["rows"][0]["measures"].update(cells_per_second=1e12))
        done = run(*self.SMALL, "--compare", old, "--fail-below", 0.5, "--json", "new.json", cwd=self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^powercell: error: square in float with 1,000 seeds on .* 0\.000 of the rate in "
                                      r"old\.json, below --fail-below 0\.5(; but .*)?\n$")
        self.assertTrue((self.folder / "new.json").exists())

    def test_nothing_to_compare_with(self):
        def elsewhere(record):
            record["rows"][0]["device"] = "another device"
        old = self.changed(elsewhere)
        done = run(*self.SMALL, "--compare", old, cwd=self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("old.json has no row of the same device", done.stderr)

    def test_files_are_checked_before_the_benchmark(self):
        self.bad(1, r"none\.json: no such file", *self.SMALL, "--compare", "none.json")
        self.bad(1, r"a\.json: is not JSON at byte \d+; --compare takes", *self.SMALL, "--compare",
                 self.write("a.json", "{"))
        self.bad(1, r"a\.json: is JSON, but its 'format'", *self.SMALL, "--compare",
                 self.write("a.json", '{"cells": []}'))
        self.bad(1, r"a\.json: the file: .*'version'", *self.SMALL, "--compare",
                 self.write("a.json", '{"format": "powercell bench", "format_version": 1}'))
        for option, path in (("--json", "missing/a.json"), ("--csv", "missing/a.csv"), ("--plot", "missing/a.svg")):
            self.bad(1, "missing", *self.SMALL, option, path)
        self.bad(2, "an .svg", *self.SMALL, "--plot", "a.png")
        self.bad(2, "would mix on the standard output", *self.SMALL, "--json", "-", "--csv", "-")
        self.bad(1, "unknown domain 'blob'; --domain takes square", "bench", "--domain", "blob")
        self.bad(1, "resolution", "bench", "--domain", "sphere:0")
        self.bad(1, "no such device", "bench", "--device", "no such device")

    def test_the_table_of_devices_is_that_of_the_saved_records(self):
        root = DATA.parents[1]
        script, saved = root / "bench" / "devices_table.py", sorted(map(str, (root / "bench" / "results").glob("*.json")))
        table = subprocess.run([sys.executable, "-B", script, *saved], capture_output=True, text=True, check=True).stdout
        self.assertEqual(table, (root / "docs" / "records" / "devices.md").read_text())
        for path in saved:  # each is a record of today's format, and was measured in full
            self.good("bench", "--compare", path, path)
            self.assertEqual([f["n"] for f in json.loads(pathlib.Path(path).read_text())["headlines"]], [1000000])
        # Of a new record too.
        self.measured("--describe", "a | b")
        shown = subprocess.run([sys.executable, "-B", script, self.folder / "new.json"], capture_output=True, text=True,
                               check=True).stdout
        self.assertIn("a \\| b", shown)
        self.assertRegex(shown, r"(?m)^\| square \| float \| 1,000 \| [\d.e-]+ \| [\d.e-]+ \|")

    def test_figures_as_csv_and_plot(self):
        done = self.good(*self.SMALL, "--csv", "-", "--plot", "a.svg", "--json", "a.json")
        rows = list(csv.DictReader(io.StringIO(done.stdout)))
        record = json.loads((self.folder / "a.json").read_text())
        self.assertEqual(done.stderr, "")
        device = record["devices"][0]
        for row in rows:
            self.assertEqual((row["device"], row["name"]), (device["device"], device["name"]))
        values = {(r["figure"], r["precision"], r["size"]): (float(r["value"]), float(r["scatter"])) for r in rows}
        self.assertEqual(len(values), len(rows))
        for figure in ("measures", "adjacency"):
            found = record["rows"][0][figure]
            self.assertEqual(values[figure, "float", "1000"], (found["cells_per_second"], found["scatter"]))
        for found in device["transfers"]:
            for figure in ("to_device", "to_host"):
                self.assertEqual(values[figure, "", str(found["bytes"])],
                                 (found[figure + "_bytes_per_second"], found[figure + "_scatter"]))
        self.assertEqual(values["operations", "float", ""][0], device["rates"][0]["operations_per_second"])
        picture = xml.etree.ElementTree.parse(self.folder / "a.svg").getroot()
        texts = [element.text for element in picture.iter("{http://www.w3.org/2000/svg}text")]
        self.assertIn("square, float, 1,000", texts)
        self.assertIn("256 MiB", texts)

    def test_devices_of_one_record_have_the_same_rows_and_are_compared(self):
        two = {"POCL_DEVICES": "basic pthread"}
        if len(json.loads(self.good("devices", "--json", env=two).stdout)["devices"]) != 2:
            self.skipTest("this OpenCL does not show one processor as two devices")
        arguments = ("bench", "--quick", "--device", "all", "--domain", "square", "--precision", "float", "--repeat", 1)
        out = self.good(*arguments, "--json", "a.json", env=two).stdout
        record = json.loads((self.folder / "a.json").read_text())
        self.assertEqual({(r["selector"], r["n"]) for r in record["rows"]}, {("0:0", 10000), ("0:1", 10000)})
        self.assertRegex(out, r"\nRates of 0:\d over those of 0:\d\n.*\nsquare +float +10,000 +~?[\d.]+ +±0 % ")

    def test_the_machine_is_as_busy_as_the_system_says(self):
        record = self.record
        for state in (record["state_before"], record["state_after"], record["rows"][0]["state"]):
            self.assertEqual(len(state["load_averages"]), 3)
            self.assertEqual("clock_mhz" in state,
                             pathlib.Path("/sys/devices/system/cpu/cpu0/cpufreq/scaling_cur_freq").exists())
        self.assertTrue(0 <= record["used_by_others"] <= os.cpu_count() + 0.5)

    def test_interrupt_leaves_the_older_file(self):
        self.write("a.json", "older")
        process = subprocess.Popen([TOOL, "bench", "--json", "a.json"], cwd=self.folder, stderr=subprocess.PIPE,
                                   stdout=subprocess.PIPE, text=True)
        interrupt(process, 3)
        _, error = process.communicate(timeout=300)  # what is being compiled is compiled first
        self.assertEqual(process.returncode, 130, error)
        # The driver's compiler may print messages before.
        self.assertTrue(error.endswith("powercell: error: interrupted\n"), error)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["a.json"])
        self.assertEqual((self.folder / "a.json").read_text(), "older")


if __name__ == "__main__":
    unittest.main(verbosity=1)
