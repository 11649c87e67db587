#!/usr/bin/env python3
"""One of several ranks is killed while they compute: the job must end by itself, with an error.
usage: killed.py MPIRUN [OPTIONS] TEST_MPI"""
import subprocess
import sys

command = [*sys.argv[1:], "--no-skip", "-tc=killed: *"]
try:
    run = subprocess.run(command, capture_output=True, text=True, timeout=120)
except subprocess.TimeoutExpired:
    sys.exit("the job did not end within two minutes")
print(run.stdout, run.stderr, sep="")
if run.returncode == 0:
    sys.exit("the job ended without an error")
if "a rank dies" not in run.stdout:
    sys.exit("no rank was killed")
if "went on" in run.stdout:
    sys.exit("a rank went on without the one that was killed")
print("killed: the job ended with", run.returncode)
