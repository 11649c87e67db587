#!/usr/bin/env python3
"""Runs notebooks, each in a fresh kernel, and fails if a cell raises an error or a notebook was committed with outputs.

usage: run_notebooks.py NOTEBOOK.ipynb... [--pictures FOLDER]     needs nbclient and ipykernel

With --pictures the pictures that they show are written there, as NAME-CELL.png.
"""

import argparse
import base64
import pathlib
import re
import sys
import time

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError


def run(path, pictures):
    """Returns what is wrong; empty if nothing is."""
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    if any(cell.outputs or cell.execution_count for cell in code):
        return "it was saved with outputs; clear them"
    begin = time.monotonic()
    try:
        NotebookClient(notebook, timeout=300, kernel_name="python3", extra_arguments=["--log-level=40"],
                       resources={"metadata": {"path": str(path.parent)}}).execute()
    except CellExecutionError as error:
        return re.sub(r"\x1b\[[0-9;]*m", "", str(error))[-1500:]  # without colours
    shown = 0
    for number, cell in enumerate(code):
        for output in cell.outputs:
            picture = output.get("data", {}).get("image/png")
            shown += picture is not None
            if picture is not None and pictures:
                (pictures / f"{path.stem}-{number}.png").write_bytes(base64.b64decode(picture))
    print(f"{path.name}: {time.monotonic() - begin:.1f} s, {shown} picture{'' if shown == 1 else 's'}")
    return "" if shown else "it shows no picture"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("notebooks", nargs="+", type=pathlib.Path)
    parser.add_argument("--pictures", type=pathlib.Path)
    arguments = parser.parse_args()
    if arguments.pictures:
        arguments.pictures.mkdir(parents=True, exist_ok=True)
    faults = 0
    for path in arguments.notebooks:
        fault = run(path.resolve(), arguments.pictures)
        if fault:
            print(f"{path}: {fault}", file=sys.stderr)
            faults += 1
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
