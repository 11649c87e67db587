"""Where the system has no OpenCL: the loader that a wheel carries, and a driver from a Python package."""

from __future__ import annotations

import ctypes
import os
import sys
from importlib import metadata
from pathlib import Path

LOADER = "libOpenCL.so.1"
CARRIED = Path(__file__).with_name("carried") / LOADER  # python/repair_wheel.py puts it there
VENDORS = Path("/etc/OpenCL/vendors")
PACKAGE, LIBRARY = "intel-opencl-rt", "libintelocl.so"  # powercell[cpu]


def open_carried_loader() -> None:
    """The library opens a loader by its name and finds one that is open already. Without any it says so when it is used."""
    for name in (LOADER, str(CARRIED)):
        try:
            ctypes.CDLL(name)  # it stays open
            return
        except OSError:
            pass


def packaged_driver() -> str:
    """The path of the package's library; empty if it is not installed."""
    try:
        files = metadata.files(PACKAGE) or []
    except metadata.PackageNotFoundError:
        return ""
    return next((str(Path(str(f.locate())).resolve()) for f in files if f.name == LIBRARY), "")


def show_packaged_driver() -> None:
    """Loaders read their variables at their first call. What the user has set stays."""
    variables = "OCL_ICD_VENDORS", "OCL_ICD_FILENAMES"  # of ocl-icd and of Khronos' loader; each ignores the other's
    if any(name in os.environ for name in variables) or any(VENDORS.glob("*.icd")):
        return
    if library := packaged_driver():
        os.environ.update(dict.fromkeys(variables, library))


def provide_opencl() -> None:
    """Called before the extension is loaded."""
    if sys.platform.startswith("linux"):
        open_carried_loader()
        show_packaged_driver()
