#!/usr/bin/env python3
"""The version is written in CMakeLists.txt (project) and everywhere else where it must stand as text the same.

usage: tests/versions/check.py"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def found(file, pattern):
    """All that the pattern's group finds in a file; none is a fault too."""
    return re.findall(pattern, (ROOT / file).read_text(), re.M)


(version,) = found("CMakeLists.txt", r"^project\(powercell VERSION (\S+) ")
major, minor, patch = version.split(".")
places = [
    ("include/powercell/version.hpp", r'^#define POWERCELL_VERSION "(.*)"$', version),
    ("include/powercell/version.hpp", r"^#define POWERCELL_VERSION_MAJOR (.*)$", major),
    ("include/powercell/version.hpp", r"^#define POWERCELL_VERSION_MINOR (.*)$", minor),
    ("include/powercell/version.hpp", r"^#define POWERCELL_VERSION_PATCH (.*)$", patch),
    ("pyproject.toml", r'^version = "(.*)"$', version),
    ("CITATION.cff", r"^version: (.*)$", version),
    ("packaging/vcpkg/powercell/vcpkg.json", r'^  "version": "(.*)",$', version),
    ("packaging/spack/package.py", r'^    version\("(.*?)"', version),
]
faults = 0
for file, pattern, wanted in places:
    versions = found(file, pattern)
    if versions != [wanted]:
        print(f"{file}: {pattern} finds {versions}, and CMakeLists.txt says {wanted}")
        faults += 1
sys.exit(1 if faults else 0)
