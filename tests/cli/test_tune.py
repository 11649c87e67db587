#!/usr/bin/env python3
"""powercell tune as a program.

usage: test_tune.py PATH_OF_POWERCELL [unittest options]
"""

import os
import pathlib
import re
import subprocess
import unittest

from tool import TOOL, ToolTest, interrupt

# A setting whose values need no kernels of their own.
SMALL = ("tune", "--only", "chunk_pairs", "--n", 300, "--repeat", 2)


class Tune(ToolTest):
    def setUp(self):
        super().setUp()
        self.cache = self.folder / "cache"
        self.env = {"POWERCELL_CACHE_DIR": str(self.cache), "POWERCELL_LANES": ""}

    def files(self):
        return list(self.cache.glob("settings-*"))

    def keep_by_hand(self, **numbers):
        """The file of settings of the device, as the tool would write it. Its path."""
        device = self.report("devices", env=self.env)["devices"][0]
        before = self.report("tune", "--reset", "--device", device["device"], env=self.env)
        settings = {**before["settings"], **numbers}
        names = ("group_size", "polygon_lanes", "polyhedron_lanes", "chunk_pairs", "launch_pairs")
        version = self.good("--version").stdout.split()[-1]
        lines = ["powercell device settings 1", "platform " + device["platform"], "vendor " + device["vendor"],
                 "device " + device["name"], "type " + device["type"], "driver " + device["driver_version"],
                 "library " + version, *(f"{name} {settings[name]}" for name in names), "end", ""]
        self.cache.mkdir(exist_ok=True)
        pathlib.Path(before["file"]).write_text("\n".join(lines))
        return before["file"]

    def test_what_was_tried_and_chosen(self):
        record = self.report(*SMALL, env=self.env)
        (step, *confirmed) = record["steps"]
        self.assertEqual(step["setting"], "chunk_pairs")
        first = step["trials"][0]
        self.assertEqual(first["value"], record["defaults"]["chunk_pairs"])
        self.assertGreaterEqual(len(step["trials"]), 3)
        for trial in step["trials"]:
            self.assertIsNone(trial["failure"])
            self.assertIn("cube in float", [run["job"] for run in trial["runs"]])
            for run in trial["runs"]:
                self.assertEqual((run["n"], len(run["seconds"])), (300, 2))
                self.assertGreater(min(run["seconds"]), 0)
        self.assertEqual(record["before"], record["defaults"])
        changed = record["chosen"] != record["defaults"]
        self.assertEqual(record["written"], changed)
        self.assertEqual([str(file) for file in self.files()], [record["file"]] if changed else [])
        self.assertLessEqual(len(confirmed), 1)

    def test_a_file_is_used_until_it_is_reset(self):
        table = self.good(*SMALL, "--dry-run", env=self.env).stdout
        self.assertRegex(table, r"(?m)^chunk_pairs .*cube in float$")
        self.assertRegex(table, r"(?m) (kept|chosen)$")
        self.assertEqual(self.files(), [])
        arguments = ("diagram", "--domain", "square", "--seeds", "random:3000", "--table", "-", "--quiet")
        told = {**self.env, "POWERCELL_LOG": "info"}
        default = self.good(*arguments, env=told)
        self.assertNotIn("settings of", default.stderr)
        file = self.keep_by_hand(polygon_lanes=4, chunk_pairs=1024)
        settings = self.good(*arguments, env=told)
        self.assertIn(f" from {file}", settings.stderr)
        self.assertRegex(settings.stderr, "LANE_WIDTH=4")
        self.assertEqual(settings.stdout, default.stdout)
        overruled = self.good(*arguments, env={**told, "POWERCELL_LANES": "8"})
        self.assertNotIn("LANE_WIDTH=4", overruled.stderr)
        self.keep_by_hand(polygon_lanes=5)
        ignored = self.good(*arguments, env=told)
        self.assertIn(f"are not taken from {file}: polygon_lanes is out of range: 5", ignored.stderr)
        self.assertEqual(ignored.stdout, default.stdout)
        self.assertIn(f"removed {file}", self.good("tune", "--reset", env=self.env).stdout)
        self.assertEqual(self.files(), [])
        self.assertIn("the defaults are used already", self.good("tune", "--reset", env=self.env).stdout)

    def test_settings_that_are_not_measured_stay(self):
        file = pathlib.Path(self.keep_by_hand(polygon_lanes=4))
        kept = file.read_text()
        record = self.report(*SMALL, "--dry-run", env=self.env)
        self.assertEqual((record["before"]["polygon_lanes"], record["chosen"]["polygon_lanes"]), (4, 4))
        self.assertEqual(file.read_text(), kept)
        self.good(*SMALL, env=self.env)
        self.assertIn("\npolygon_lanes 4\n", file.read_text())

    def test_interrupt_leaves_no_file(self):
        process = subprocess.Popen([TOOL, "tune", "--only", "chunk_pairs", "--n", "20000", "--repeat", "100"],
                                   cwd=self.folder, text=True, env={**os.environ, **self.env},
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        interrupt(process, 1)
        error = process.communicate(timeout=300)[1]
        self.assertEqual(process.returncode, 130, error)
        self.assertTrue(error.endswith("powercell: error: interrupted\n"), error)
        self.assertEqual(self.files(), [])

    def test_refusals(self):
        self.bad(1, "POWERCELL_LANES overrules the lanes that are to be measured; unset it", "tune",
                 env={**self.env, "POWERCELL_LANES": "4"})
        self.bad(2, r"--only: 'group' is none of .*; did you mean group_size\?", "tune", "--only", "group", env=self.env)
        self.bad(2, "--reset removes a file, and --dry-run changes none", "tune", "--reset", "--dry-run", env=self.env)
        self.bad(2, "--repeat", "tune", "--repeat", "1", env=self.env)
        self.bad(1, re.escape("no OpenCL device matches"), "tune", "--device", "no such device", env=self.env)


if __name__ == "__main__":
    unittest.main()
