"""Makes an OpenCL runtime from a Python package visible where the system has none."""

from __future__ import annotations

import os
import sys
from importlib import metadata
from pathlib import Path

VENDORS = Path("/etc/OpenCL/vendors")
PACKAGE, LIBRARY = "intel-opencl-rt", "libintelocl.so"  # powercell[cpu]


def packaged_runtime() -> str:
    """The path of the package's library; empty if it is not installed."""
    try:
        files = metadata.files(PACKAGE) or []
    except metadata.PackageNotFoundError:
        return ""
    return next((str(Path(str(f.locate())).resolve()) for f in files if f.name == LIBRARY), "")


def show_packaged_runtime() -> None:
    """Called before the extension is loaded: the OpenCL loader reads its variables once. What the user has set
    stays."""
    if not sys.platform.startswith("linux") or "OCL_ICD_VENDORS" in os.environ or any(VENDORS.glob("*.icd")):
        return
    if library := packaged_runtime():
        os.environ["OCL_ICD_VENDORS"] = library
