"""Makes an OpenCL runtime from a Python package visible where the system has none."""

from __future__ import annotations

import os
import sys
from importlib import metadata
from pathlib import Path

_RUNTIMES = ("intel-opencl-rt",)


def _system_has_one() -> bool:
    folder = os.environ.get("OCL_ICD_VENDORS", "/etc/OpenCL/vendors")
    path = Path(folder)
    return path.is_file() or any(path.glob("*.icd"))


def _library_of(package: str) -> str:
    try:
        files = metadata.files(package) or []
    except metadata.PackageNotFoundError:
        return ""
    for file in files:
        if file.name == "libintelocl.so":
            return str(Path(str(file.locate())).resolve())
    return ""


def show_packaged_runtimes() -> None:
    """Called before the extension is loaded: the OpenCL loader reads these variables once."""
    if not sys.platform.startswith("linux") or "OCL_ICD_FILENAMES" in os.environ or _system_has_one():
        return
    found = [library for library in map(_library_of, _RUNTIMES) if library]
    if found:
        os.environ["OCL_ICD_FILENAMES"] = ":".join(found)
