#!/usr/bin/env python3
"""Prints the mean power below several cut-off frequencies: of the spectrum that `powercell sample --periodic --analysis
FILE.json` wrote, and of plain Lloyd iterations (Voronoi cells, no capacities) of as many random points and runs.

usage: low_frequencies.py FILE.json [LLOYD_ITERATIONS ...]
"""
import itertools
import json
import math
import sys

import numpy as np
from scipy.spatial import Voronoi

CUTOFFS = (0.3, 0.35, 0.4, 0.44, 0.5, 0.55, 0.6)  # of sqrt(n)
COPIES = [(0, 0)] + [shift for shift in itertools.product((-1, 0, 1), repeat=2) if shift != (0, 0)]


def centroids(points):
    """Centroids of the Voronoi cells of points in the periodic unit square."""
    margin = 6 / math.sqrt(len(points))
    copies = np.concatenate([points + shift for shift in COPIES])
    kept = np.all((copies > -margin) & (copies < 1 + margin), axis=1)
    kept[:len(points)] = True
    diagram = Voronoi(copies[kept])
    result = np.empty_like(points)
    for i, point in enumerate(points):
        corner = diagram.vertices[diagram.regions[diagram.point_region[i]]] - point
        corner = corner[np.argsort(np.arctan2(corner[:, 1], corner[:, 0]))]
        following = np.roll(corner, -1, axis=0)
        area = corner[:, 0] * following[:, 1] - corner[:, 1] * following[:, 0]
        result[i] = point + ((corner + following) * area[:, None]).sum(0) / (3 * area.sum())
    return result % 1


def spectrum(points, highest):
    f = np.arange(-highest, highest + 1)
    x, y = (np.exp(-2j * np.pi * np.outer(f, points[:, k])) for k in (0, 1))
    return np.abs(y @ x.T) ** 2 / len(points)


def low(power, count, cutoff):
    f = np.arange(power.shape[0]) - power.shape[0] // 2
    radius = np.hypot(*np.meshgrid(f, f))
    return power[(radius > 0) & (radius <= cutoff * math.sqrt(count))].mean()


def main():
    with open(sys.argv[1]) as file:
        data = json.load(file)["spectrum"]
    count, runs, highest = data["points"], data["runs"], data["highest"]
    rows = {sys.argv[1]: np.array(data["power"]).reshape(2 * highest + 1, -1)}
    stops = [int(argument) for argument in sys.argv[2:]] or [20, 40]
    for run in range(runs):
        points = np.random.default_rng(run + 1).random((count, 2))
        for iteration in range(1, max(stops) + 1):
            points = centroids(points)
            if iteration in stops:
                name = f"plain Lloyd, {iteration} iterations"
                rows[name] = rows.get(name, 0) + spectrum(points, highest) / runs
    print("cut-off " + "".join(f"{cutoff:10.2f}" for cutoff in CUTOFFS))
    for name, power in rows.items():
        print(name)
        print("  power " + "".join(f"{low(power, count, cutoff):10.2e}" for cutoff in CUTOFFS))
        print("  ratio " + "".join(f"{low(power, count, cutoff) / low(rows[sys.argv[1]], count, cutoff):10.1f}"
                                    for cutoff in CUTOFFS))


if __name__ == "__main__":
    main()
