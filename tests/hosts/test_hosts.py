#!/usr/bin/env python3
"""Programs that link the library, on machines and in processes that are not as they should be: drivers that fail, devices that
look like others, forks, other rounding modes, no OpenCL at all.

usage: test_hosts.py FOLDER_OF_PROGRAMS PATH_OF_POWERCELL [unittest options]
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAMS = pathlib.Path(sys.argv.pop(1))
POWERCELL = sys.argv.pop(1)
POCL = pathlib.Path("/etc/OpenCL/vendors/pocl.icd")
TWO_DEVICES = {"POCL_DEVICES": "basic pthread"}


def run(program, *arguments, **variables):
    environment = {name: value for name, value in os.environ.items() if not name.startswith("POWERCELL_")}
    environment["POWERCELL_CACHE_DIR"] = os.environ.get("POWERCELL_CACHE_DIR", str(pathlib.Path.home() / ".cache/powercell"))
    environment.update(variables)
    command = [POWERCELL if program == "powercell" else str(PROGRAMS / f"host_{program}"), *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=600, env=environment)


@unittest.skipUnless(POCL.exists(), "the tests pretend with PoCL's devices")
class Machines(unittest.TestCase):
    def check(self, done, status, *patterns):
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        for pattern in patterns:
            self.assertRegex(done.stdout + done.stderr, pattern)


class BrokenPlatforms(Machines):
    def vendors(self, first):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        (folder / ("a.icd" if first else "z.icd")).write_text(str(PROGRAMS / "broken_platform.so") + "\n")
        shutil.copy(POCL, folder / "pocl.icd")
        return f"{folder}/"

    def test_a_platform_that_lists_no_devices_is_set_aside(self):
        for first in (True, False):
            for status, name in ((-6, "CL_OUT_OF_HOST_MEMORY"), (-5, "CL_OUT_OF_RESOURCES"), (-4, "CL_MEM_OBJECT_ALLOCATION_FAILURE"), (-32, "CL_INVALID_PLATFORM")):
                with self.subTest(first=first, status=status):
                    machine = {"OCL_ICD_VENDORS": self.vendors(first), "BROKEN_STATUS": str(status)}
                    used = run("measure", **machine)
                    self.check(used, 0, r"used (pthread|cpu)", rf"unusable [01]:-1 Broken Driver: listing its devices: .*{name}",
                               r"log: the platform [01] Broken Driver is set aside")
                    broken = int(re.search(r"unusable (\d)", used.stdout)[1])  # loaders have orders of their own
                    works = 1 - broken
                    self.check(run("measure", "cpu", **machine), 0)
                    self.check(run("measure", f"{works}:0", **machine), 0)
                    self.check(run("measure", "broken", **machine), 2, "device_not_found: .*\"broken\".*Broken Driver: listing")
                    self.check(run("measure", f"{broken}:0", **machine), 2, "device_not_found: .*Broken Driver: listing")
                    self.check(run("own_queue", **machine), 0, rf"used {works}:0")
                    self.check(run("powercell", "devices", **machine), 0, rf"{broken}:\* .*Broken Driver: set aside: .*{name}",
                               rf"{works}:0 +cpu")

    def test_a_platform_without_a_name(self):
        machine = {"OCL_ICD_VENDORS": self.vendors(True), "BROKEN_NAME": "1"}
        self.check(run("measure", **machine), 0, "unusable [01]:-1 a platform without a name", "used ")
        self.check(run("own_queue", **machine), 0)

    def test_no_other_platform(self):
        folder = self.vendors(True)
        os.remove(folder + "pocl.icd")
        self.check(run("measure", OCL_ICD_VENDORS=folder), 2, "device_not_found: .*Broken Driver: listing its devices", "pocl-opencl-icd")
        listed = json.loads(run("powercell", "devices", "--json", OCL_ICD_VENDORS=folder).stdout)
        self.assertEqual(listed["devices"], [])
        self.assertEqual([unusable["name"] for unusable in listed["set_aside"]], ["Broken Driver"])

    def test_a_driver_that_ends_the_process(self):
        machine = {"OCL_ICD_VENDORS": self.vendors(True), "BROKEN_ENDS": "1"}
        self.check(run("powercell", "devices", **machine), 0, r"0:0 +cpu", r"the driver of \S+/a\.icd is set aside: .*libmissing\.so")
        listed = json.loads(run("powercell", "devices", "--json", **machine).stdout)
        self.assertEqual(len(listed["devices"]), 1)
        self.assertIn("libmissing.so", listed["set_aside"][0]["reason"])
        os.remove(machine["OCL_ICD_VENDORS"] + "pocl.icd")
        self.check(run("powercell", "devices", **machine), 1, r"a\.icd is set aside", "no OpenCL device")

    def test_files_that_name_no_driver(self):
        folder = pathlib.Path(self.vendors(True))
        (folder / "a.icd").write_text("libdoesnotexist.so\n")
        (folder / "b.icd").write_text("")
        (folder / "c.icd").write_bytes(bytes(range(128, 256)))
        self.check(run("measure", OCL_ICD_VENDORS=f"{folder}/"), 0)
        (folder / "pocl.icd").unlink()
        self.check(run("measure", OCL_ICD_VENDORS=f"{folder}/"), 2, "device_not_found")
        self.check(run("measure", OCL_ICD_VENDORS="/nonexistent/"), 2, "device_not_found")


class FakeDevices(Machines):
    def fake(self, program, *arguments, **devices):
        wishes = ";".join(f"{place[-1]}.{key}={value}" for place, keys in devices.items() for key, value in keys.items())
        return run(program, *arguments, **TWO_DEVICES, LD_PRELOAD=str(PROGRAMS / "fake_devices.so"), FAKE_DEVICES=wishes)

    def test_a_card_comes_before_an_integrated_gpu(self):
        integrated = {"type": "gpu", "name": "Iris", "vendor": "Intel(R) Corporation", "units": 96, "clock": 1300, "unified": 1}
        card = {"type": "gpu", "name": "Card", "vendor": "NVIDIA Corporation", "units": 46, "clock": 2475, "unified": 0}
        apu = {"type": "gpu", "name": "APU", "vendor": "Advanced Micro Devices, Inc.", "units": 12, "clock": 2800, "unified": 1}
        arc = {"type": "gpu", "name": "Arc", "vendor": "Intel(R) Corporation", "units": 512, "clock": 2400, "unified": 0}
        small = {**card, "name": "Small", "units": 8}
        for devices, best in (((integrated, card), "Card"), ((card, integrated), "Card"), ((card, arc), "Card"),
                              ((arc, small), "Arc"), ((small, card), "Card"), ((apu, integrated), "APU"), ((apu, small), "Small")):
            with self.subTest(devices=[device["name"] for device in devices]):
                self.check(self.fake("measure", d0=devices[0], d1=devices[1]), 0, f"used {best}\n")
                self.check(self.fake("measure", "gpu", d0=devices[0], d1=devices[1]), 0, f"used {best}\n")

    def test_the_next_device_is_taken_where_the_best_fails(self):
        for what, status in (("build", -11), ("build", -6), ("context", -5), ("context", -2), ("queue", -6), ("info", -6)):
            with self.subTest(what=what, status=status):
                old = {"type": "gpu", "name": "Old", "units": 8, what: status}
                done = self.fake("measure", d0=old)
                self.check(done, 0, "used (pthread|cpu)", "log: .* is set aside: .*")
                self.assertNotIn("used Old", done.stdout)
                self.check(self.fake("measure", "all", d0=old), 0, "used (pthread|cpu)")
                for name in ("old", "0:0"):
                    self.check(self.fake("measure", name, d0=old), 2, r"(?m)^(build_failed|opencl|out_of_device_memory|device_not_found): ")

    def test_all_devices_fail(self):
        broken = {"build": -11}
        self.check(self.fake("measure", d0={**broken, "name": "One"}, d1={**broken, "name": "Two"}), 2, "build_failed: ")


class Processes(Machines):
    def test_forks(self):
        self.check(run("forked", "before"), 0)
        self.check(run("forked", "cached"), 0)
        self.check(run("forked", "ended"), 0)
        for when in ("listed", "used", "kept"):
            with self.subTest(when):
                self.check(run("forked", when), 2, "unsupported: this process was forked from one that had used OpenCL.*spawn")

    def test_rounding_modes(self):
        right = run("environment", "near", "first")
        self.check(right, 0, "white ", "polygon ")
        for mode in ("up", "down", "zero", "flush", "trap"):
            for when in ("first", "late"):
                with self.subTest(mode=mode, when=when):
                    done = run("environment", mode, when)
                    self.check(done, 0)
                    self.assertEqual(done.stdout, right.stdout)

    def test_nothing_links_a_loader(self):
        for program in ("measure", "forked"):
            needed = subprocess.run(["ldd", str(PROGRAMS / f"host_{program}")], capture_output=True, text=True).stdout
            self.assertIn("libpowercell_core", needed)
            self.assertNotIn("libOpenCL", needed)
        self.assertNotIn("libOpenCL", subprocess.run(["ldd", POWERCELL], capture_output=True, text=True).stdout)

    def test_no_loader(self):
        """In a namespace where an empty file stands in the place of each loader."""
        loaders = re.findall(r"=> (/\S*libOpenCL\S*)", subprocess.run(["ldconfig", "-p"], capture_output=True, text=True).stdout)
        with tempfile.NamedTemporaryFile() as empty:
            mounts = " && ".join(f"mount --bind {empty.name} {os.path.realpath(loader)}" for loader in loaders)
            for program, status in (("measure", 2), ("powercell devices", 3)):
                command = [POWERCELL, "devices"] if program.startswith("powercell") else [str(PROGRAMS / "host_measure")]
                done = subprocess.run(["unshare", "-m", "sh", "-c", f"mount --make-rprivate / && {mounts} && exec \"$@\"", "sh", *command],
                                      capture_output=True, text=True)
                if "unshare" in done.stderr or "mount:" in done.stderr:
                    self.skipTest("no namespaces here: " + done.stderr.strip())
                self.assertNotIn(done.returncode, (0, 127), done.stderr)
                self.check(done, done.returncode, "no OpenCL on this machine .*libOpenCL", "pocl-opencl-icd")


if __name__ == "__main__":
    unittest.main()
