#!/usr/bin/env python3
"""Prints the table of docs/applications.md, "Transport": equal masses for random seeds in the square and the cube.

usage: run_transport.py POWERCELL [--sizes-2d N,...] [--sizes-3d N,...] [--linear NAME] [--precision NAME]

Runs 'powercell transport' once for each size, in its own process. Processor time is the user and system time of that
process minus that of a run with ten seeds, which is the time to start OpenCL. Prints a Markdown table. Fails if a solve
does not converge.
"""

import argparse
import json
import os
import subprocess
import sys


def solve(tool, domain, n, options):
    before = os.times()
    done = subprocess.run([tool, "transport", "--domain", domain, "--seeds", f"random:{n}", "--json", *options],
                          stdin=subprocess.DEVNULL, capture_output=True, text=True)
    after = os.times()
    if done.returncode != 0:
        sys.exit(f"{domain}, {n} seeds: {done.stderr.strip()}")
    used = after.children_user + after.children_system - before.children_user - before.children_system
    return json.loads(done.stdout), used


def sizes(text):
    return [int(float(word)) for word in text.split(",") if word]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tool", metavar="POWERCELL")
    parser.add_argument("--sizes-2d", type=sizes, default=sizes("1e3,4e3,1.6e4,6.5536e4,1e5"))
    parser.add_argument("--sizes-3d", type=sizes, default=sizes("1e3,1e4,1e5"))
    parser.add_argument("--linear", default="auto")
    parser.add_argument("--precision", default="auto")
    arguments = parser.parse_args()
    options = ["--linear", arguments.linear, "--precision", arguments.precision]
    print("| domain | seeds | steps | diagrams | error | processor s | wall s | of it diagrams | linear |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---:|")
    for domain, counts in (("square", arguments.sizes_2d), ("cube", arguments.sizes_3d)):
        solve(arguments.tool, domain, 10, options)  # compiles kernels into the cache
        _, start = solve(arguments.tool, domain, 10, options)
        for n in counts:
            report, used = solve(arguments.tool, domain, n, options)
            seconds = report["seconds"]
            print(f"| {domain} | {n:,} | {report['steps']} | {report['diagrams']} | {report['error']:.1e} | "
                  f"{used - start:.2f} | {seconds['solve']:.2f} | {seconds['diagrams']:.2f} | "
                  f"{seconds['linear']:.2f} |", flush=True)


if __name__ == "__main__":
    main()
