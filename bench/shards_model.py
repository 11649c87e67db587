#!/usr/bin/python3 -B
"""Fits a model of seeds in shards to what bench/shards printed: docs/scale.md, "Model".

usage: shards --n 200000 --shards 64 >>runs.txt     (and 4, 512; in space)
       shards_model.py runs.txt [--predict SEEDS SHARDS]

Prints the constants of the model for each kind of seeds, with the largest relative errors of the runs: of seeds
fetched, bytes and processor time (t, e and f in microseconds, g in milliseconds). With --predict, what one shard of
so many would get and take.
"""

import argparse

import numpy as np

NAMES = ("seeds", "weights", "n", "shards", "rounds", "fetched", "walls", "ratio", "clipped", "outlines", "requests",
         "replies", "ending", "alone", "spent", "times", "differ", "measure")
BOX = 64  # bytes that each shard tells each other


def read(files):
    runs = {}
    for name in files:
        with open(name, encoding="utf-8") as file:
            for line in file:
                cells = line.split()
                if len(cells) != len(NAMES) or not cells[2].isdigit():
                    continue  # a heading
                row = dict(zip(NAMES, cells[:2] + [float(cell) for cell in cells[2:]]))
                runs.setdefault((row["seeds"], row["weights"]), []).append(row)
    return {kind: {name: np.array([row[name] for row in rows]) for name in NAMES[2:]} for kind, rows in runs.items()}


def surface(n, p):
    """By how much the edge of a shard, a cube among others in a cube, grows by a layer one spacing thick."""
    return 2 * (1 - p ** (-1 / 3)) / (n / p) ** (1 / 3)


def fetched(depth, n, p):
    return n * ((1 + depth * surface(n, p)) ** 3 - 1)


def outlined(n, p):
    """Boxes of outlines that all shards are sent, but for a factor: by the surface of a shard, from each neighbour of
    a cube among cubes. A level of the tree of at most 512 boxes, of 8 seeds each or more, is the lowest."""
    neighbors = (3 - 2 * p ** (-1 / 3)) ** 3 - 1
    return p * neighbors * np.minimum(n / p, 8 * 512) ** (2 / 3)


def least_squares(columns, values, scale):
    """Constants of least error in units of `scale`, not below 0."""
    columns, used = np.array(columns).T / scale[:, None], list(range(len(columns)))
    found = np.zeros(columns.shape[1])
    while used:
        part = np.linalg.lstsq(columns[:, used], values / scale, rcond=None)[0]
        if part.min() >= 0:
            found[used] = part
            break
        del used[int(part.argmin())]
    return found


class Fit:
    """The constants of one kind of seeds."""

    def __init__(self, run):
        n, p = run["n"], run["shards"]
        self.rounds, self.excess = run["rounds"], run["fetched"] / run["walls"]
        self.depth = (((run["fetched"] / n + 1) ** (1 / 3) - 1) / surface(n, p)).mean()
        outlines = run["outlines"] * n - BOX * p * (p - 1)
        self.outlines = least_squares([outlined(n, p), fetched(self.depth, n, p)], outlines, outlines)
        messages = (run["requests"] + run["replies"] + run["ending"]) * n
        self.messages = least_squares([fetched(self.depth, n, p), n], messages, messages)
        self.alone = (run["alone"] / n).mean()
        self.time = least_squares([fetched(self.depth, n, p), n, p], run["spent"] - run["alone"], run["spent"])
        self.errors = [np.abs(model / measured - 1).max() for model, measured in (
            (fetched(self.depth, n, p), run["fetched"]),
            (self.bytes(n, p), run["outlines"] * n + messages),
            (run["alone"] + self.extra_time(n, p), run["spent"]))]

    def bytes(self, n, p):
        got = fetched(self.depth, n, p)
        return BOX * p * (p - 1) + self.outlines @ [outlined(n, p), got] + self.messages @ [got, n]

    def extra_time(self, n, p):
        return self.time @ [fetched(self.depth, n, p), n, p]


def print_fits(fits):
    print("| seeds | rounds | fetched / with a wall | a | error | b | c | d | error | t | e | f | g | error |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|")
    for kind, fit in fits.items():
        errors = [f"{100 * error:.0f} %" for error in fit.errors]
        print(f"| {' '.join(kind)} | {fit.rounds.min():.0f} to {fit.rounds.max():.0f} "
              f"| {fit.excess.min():.2f} to {fit.excess.max():.2f} | {fit.depth:.2f} | {errors[0]} "
              f"| {fit.outlines[0]:.0f} | {fit.outlines[1] + fit.messages[0]:.0f} | {fit.messages[1]:.1f} | {errors[1]} "
              f"| {1e6 * fit.alone:.1f} | {1e6 * fit.time[0]:.1f} | {1e6 * fit.time[1]:.1f} | {1e3 * fit.time[2]:.1f} "
              f"| {errors[2]} |")


def print_predictions(fits, n, p):
    print(f"\nA shard of {n / p:,.0f} seeds, one of {p:,.0f}:\n")
    print("| seeds | fetched | MB | of these boxes | processor time over that of one diagram |")
    print("|---|---:|---:|---:|---:|")
    for kind, fit in fits.items():
        print(f"| {' '.join(kind)} | {fetched(fit.depth, n, p) / p:,.0f} | {fit.bytes(n, p) / p / 1e6:.1f} "
              f"| {BOX * p / 1e6:.2f} | {1 + fit.extra_time(n, p) / (fit.alone * n):.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", metavar="FILE", help="what bench/shards printed")
    parser.add_argument("--predict", nargs=2, type=float, metavar=("SEEDS", "SHARDS"))
    options = parser.parse_args()
    fits = {kind: Fit(run) for kind, run in read(options.files).items()}
    print_fits(fits)
    if options.predict:
        print_predictions(fits, *options.predict)


if __name__ == "__main__":
    main()
