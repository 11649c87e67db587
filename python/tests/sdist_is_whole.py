#!/usr/bin/env python3
"""Checks that a source distribution has every file that the build of the wheel read, as it is in the repository.

usage: sdist_is_whole.py UNPACKED BUILD     BUILD: the folder in which the wheel was built, by Ninja
"""

import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def lines(build, *tool):
    return subprocess.run(["ninja", "-C", build, "-t", *tool], capture_output=True, text=True, check=True).stdout.splitlines()


def read_by(build):
    """The repository's files that CMake and the compilers read, relative to it."""
    names = lines(build, "inputs", "all") + lines(build, "inputs", "build.ninja")
    names += [line.strip() for line in lines(build, "deps") if line.startswith(" ")]
    files = {(build / name).resolve() for name in names if not name.startswith("ninja: ")}
    return {file.relative_to(ROOT) for file in files if file.is_relative_to(ROOT) and not file.is_relative_to(ROOT / "build")}


def main():
    unpacked, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    files = read_by(build) | {pathlib.Path("pyproject.toml"), pathlib.Path("LICENSE"), pathlib.Path("python/README.md")}
    if len([file for file in files if file.suffix in (".cpp", ".hpp", ".cl")]) < 300:
        sys.exit(f"{build} is no build of the wheel: it read {len(files)} files")
    files |= {file.relative_to(ROOT) for file in (ROOT / "python" / "powercell").glob("*.py*")}
    wrong = [str(file) for file in sorted(files)
             if not (unpacked / file).exists() or (unpacked / file).read_bytes() != (ROOT / file).read_bytes()]
    if wrong:
        sys.exit("the sdist lacks, or has another version of:\n  " + "\n  ".join(wrong))
    print(f"the sdist has the {len(files)} files that the wheel is built from")


if __name__ == "__main__":
    main()
