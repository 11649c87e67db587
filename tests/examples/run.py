#!/usr/bin/env python3
"""Runs a program: it must succeed, print nothing to standard error, and each pattern must match a part of what it
prints, in their order.
usage: tests/examples/run.py PROGRAM PATTERN...
       tests/examples/run.py --command PROGRAM ARGUMENT... -- PATTERN..."""
import re
import subprocess
import sys

command, patterns = sys.argv[1:2], sys.argv[2:]
if command == ["--command"]:
    end = patterns.index("--")
    command, patterns = patterns[:end], patterns[end + 1 :]
program = command[0]
run = subprocess.run(command, capture_output=True, text=True, timeout=300)
print(run.stdout, run.stderr, sep="")
faults = []
if run.returncode != 0:
    faults.append(f"it ended with {run.returncode}")
if run.stderr:
    faults.append("it printed to standard error")
rest = run.stdout
for pattern in patterns:
    found = re.search(pattern, rest)
    if found:
        rest = rest[found.end() :]
    else:
        faults.append(f"it did not print, or not in this place: {pattern}")
if not patterns:
    faults.append("no pattern was given")
for fault in faults:
    print(f"{program}: {fault}")
sys.exit(1 if faults else 0)
