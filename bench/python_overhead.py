#!/usr/bin/env python3
"""What Python costs: measures and adjacency of seeds in the cube from Python and from C++, in turns, in one run.

usage: python_overhead.py BUILD [--n N] [--rounds R]

BUILD is a build folder with the shared libraries (build/release); bench/python_overhead.cpp is compiled against it. Runs in an
environment that has the powercell package of the same sources. Two processes keep a diagram each and take rounds by turns.
Prints the least and the median of each in seconds and processor seconds, their ratios, and the peak of memory over what was
resident before the first diagram. Fails if Python takes more than 3 % longer, by processor time, in the median.
"""

import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
MOST = 1.03


def memory(key):
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(key + ":"))


def work(path):
    """The Python side; as bench/python_overhead.cpp."""
    import powercell as pc

    positions = np.fromfile(path).reshape(-1, 3)
    diagram = pc.Diagram(pc.Domain.box([0, 0, 0], [1, 1, 1]), positions[:0])
    before = memory("VmRSS")
    for _ in sys.stdin:
        wall, processor = time.perf_counter(), time.process_time()
        diagram.set_seeds(positions)
        diagram.compute(adjacency=True)
        mass, graph = diagram.mass, diagram.adjacency
        arrays = mass, diagram.centroid, diagram.status, graph.indptr, graph.indices, graph.data
        took, used = time.perf_counter() - wall, time.process_time() - processor
        print(took, used, before, memory("VmHWM"), repr(float(mass.sum())), sum(a.nbytes for a in arrays) // 1024, flush=True)
        del mass, graph, arrays  # else the next round has these results beside its own


def build(folder, into):
    program = str(into / "python_overhead")
    libraries = pathlib.Path(folder).resolve() / "lib"
    subprocess.run(["c++", "-std=c++20", "-O2", f"-I{ROOT}", f"-I{ROOT / 'include'}", str(ROOT / "bench/python_overhead.cpp"),
                    "-o", program, f"-L{libraries}", "-lpowercell_core", f"-Wl,-rpath,{libraries}"], check=True)
    return program


class Side:
    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
        self.rounds = []

    def turn(self, keep):
        self.process.stdin.write("\n")
        values = [float(word) for word in self.process.stdout.readline().split()]
        if not values:
            sys.exit("python_overhead: a side ended")
        if abs(values[4] - 1) > 1e-9:
            sys.exit(f"python_overhead: the measures sum to {values[4]}")
        if keep:
            self.rounds.append(values)

    def column(self, k):
        return [values[k] for values in self.rounds]

    def memory(self):
        return (self.rounds[-1][3] - self.rounds[-1][2]) / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", metavar="BUILD")
    parser.add_argument("--n", type=lambda text: int(float(text)), default=100_000)
    parser.add_argument("--rounds", type=int, default=30)
    parser.add_argument("--work", metavar="SEEDS.bin", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.work:
        work(arguments.work)
        return
    with tempfile.TemporaryDirectory() as folder:
        seeds = f"{folder}/seeds.bin"
        np.random.default_rng(1).random((arguments.n, 3)).tofile(seeds)
        sides = {"C++": Side([build(arguments.build, pathlib.Path(folder)), seeds]),
                 "Python": Side([sys.executable, __file__, arguments.build, "--work", seeds])}
        for turn in range(arguments.rounds + 2):  # two to warm up
            for side in list(sides.values())[:: -1 if turn % 2 else 1]:
                side.turn(keep=turn >= 2)
        for side in sides.values():
            side.process.stdin.close()
            side.process.wait()
    print("| | least s | median s | least processor s | median processor s | MiB at most |\n|---|---:|---:|---:|---:|---:|")
    for name, side in sides.items():
        wall, used = side.column(0), side.column(1)
        print(f"| {name} | {min(wall):.4f} | {statistics.median(wall):.4f} | {min(used):.4f} | {statistics.median(used):.4f} "
              f"| {side.memory():.0f} |")
    ours, theirs = sides["Python"], sides["C++"]
    ratios = [statistics.median(a / b for a, b in zip(ours.column(k), theirs.column(k))) for k in (0, 1)]
    print(f"\nPython / C++, median of {arguments.rounds} pairs of rounds: {ratios[0]:.3f} by the clock, {ratios[1]:.3f} by processor "
          f"time. The results that Python sees take {ours.rounds[-1][5] / 1024:.0f} MiB.")
    sys.exit(ratios[1] > MOST)


if __name__ == "__main__":
    main()
