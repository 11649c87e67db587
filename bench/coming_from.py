#!/usr/bin/env python3
"""Runs the snippets of docs/coming_from.md: powercell's, and those of the packages that are there, whose arrays must be the same.

usage: coming_from.py       fails if a snippet fails or two sides differ
"""

import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs" / "coming_from.md"
PROGRAM = """
#include <cstdio>
#include <vector>
#include <voro++/voro++.hh>
int main() {
  int n = 0;
  if (std::scanf("%%d", &n) != 1) return 1;
  std::vector<double> x(3 * n), r(n), volumes(n);
  for (double& value : x) if (std::scanf("%%lf", &value) != 1) return 1;
  for (double& value : r) if (std::scanf("%%lf", &value) != 1) return 1;
%s
  for (double volume : volumes) std::printf("%%.17g\\n", volume);
}
"""


def snippets():
    """(package, code, line) of each, in order; the first is of the seeds."""
    text = PAGE.read_text()
    for block in re.finditer(r"```(?:python|cpp)\n(?:#|//) (\S+)\n(.*?)```", text, re.S):
        yield block[1], block[2], text[: block.start()].count("\n") + 2


def run_voro(code, names):
    with tempfile.TemporaryDirectory() as folder:
        program = f"{folder}/voro"
        subprocess.run(["c++", "-O2", "-x", "c++", "-", "-o", program, "-lvoro++"], input=PROGRAM % code, text=True, check=True)
        numbers = [len(names["points"]), *names["points"].ravel(), *names["radii"]]
        done = subprocess.run([program], input=" ".join(map(repr, map(float, numbers))).replace(".0 ", " ", 1), text=True, check=True,
                              stdout=subprocess.PIPE)
    return {"volumes": np.array(done.stdout.split(), float)}


def is_there(package):
    if package == "voro++":
        return bool(shutil.which("c++")) and pathlib.Path("/usr/include/voro++/voro++.hh").exists()
    return importlib.util.find_spec(package) is not None


def differences(one, other, seeds):
    """What both sides computed and is not the same."""
    common = [name for name, value in one.items() if isinstance(value, np.ndarray) and name not in seeds and name in other]
    if not common:
        yield "they compute nothing in common"
    for name in common:
        a, b = np.asarray(one[name], float), np.asarray(other[name], float)
        if a.shape != b.shape or not np.allclose(a, b, rtol=1e-6, atol=1e-9):
            yield f"{name} differs"


def check():
    """Runs all; the faults. Ours follows theirs in the page."""
    (_, code, _), *rest = snippets()
    seeds, faults, theirs = {}, [], None
    exec(code, seeds)
    for package, code, line in rest:
        if not is_there(package):
            print(f"coming_from: line {line}: {package} is not there, its snippet was not run", file=sys.stderr)
            theirs = None
            continue
        try:
            if package == "voro++":
                names = run_voro(code, seeds)
            else:
                exec(compile(code, f"{PAGE}:{line}", "exec"), names := dict(seeds))
        except Exception as error:
            faults.append(f"line {line}: {package}: {type(error).__name__}: {error}")
            names = None
        if package != "powercell":
            theirs = names
        else:
            if theirs is not None and names is not None:
                faults += [f"line {line}: {text}" for text in differences(theirs, names, seeds)]
            theirs = None
    return faults


if __name__ == "__main__":
    found = check()
    print("\n".join(found) or "coming_from: the snippets give the same")
    sys.exit(bool(found))
