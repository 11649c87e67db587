#!/usr/bin/python3 -B
"""Plots the results of powercell_matrix. Usage: plots.py FOLDER FILE.json...; writes ratios.png, growth.png and
memory.png if there are results for them."""

import math
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from results import Results, count, fields_of
from matrix_table import NAMES

COLORS = {"tree": "#0b6e4f", "flann": "#8d99ae", "cgal": "#e07a5f", "cgal-parallel": "#b23a48",
          "voro++": "#6a8caf", "voro++-parallel": "#2b4c7e"}


def ratio_of(results, work, against):
    """powercell's speed relative to the fastest peer ("peer") or to FLANN's lists; None if one is missing."""
    wanted = dict(part="ratios", **fields_of(work))
    ours = results.fastest(results.select(stage="adjacency", provider="tree", **wanted))
    if against == "peer":
        other = results.fastest(results.select(peer=True, **wanted))
    else:
        other = results.fastest(results.select(stage="adjacency", provider="flann", **wanted))
    return other[0] / ours[0] if ours and other else None


def plot_ratios(results, path):
    """A square for each work: rows are domain and n, columns distribution and weights."""
    works = results.works(part="ratios")
    if not works:
        return False
    rows = sorted({(w[0], w[3]) for w in works}, key=lambda r: (list(NAMES).index(r[0]), r[1]))
    columns = list(dict.fromkeys((w[1], w[2]) for w in works))
    figure, axes = plt.subplots(1, 2, figsize=(3.5 + 1.3 * len(columns), 1.6 + 0.42 * len(rows)), sharey=True)
    for axis, against, title in zip(axes, ("peer", "flann"), ("fastest peer", "FLANN's lists")):
        values = [[ratio_of(results, (d, *column, n), against) for column in columns] for d, n in rows]
        colors = [[math.nan if v is None else math.log2(v) for v in line] for line in values]
        axis.imshow(colors, cmap="RdYlGn", vmin=-2, vmax=2, aspect="auto")
        for y, line in enumerate(values):
            for x, value in enumerate(line):
                axis.text(x, y, "–" if value is None else f"{value:.2f}", ha="center", va="center", fontsize=8)
        axis.set_xticks(range(len(columns)), [f"{d}\n{w}" for d, w in columns], fontsize=8)
        axis.set_yticks(range(len(rows)), [f"{NAMES[d]} {count(n)}" for d, n in rows], fontsize=8)
        axis.set_title(title, fontsize=10)
    figure.suptitle("Speed of powercell with adjacency, relative", fontsize=11)
    figure.tight_layout()
    figure.savefig(path, dpi=130)
    return True


def plot_growth(results, path):
    domains = [d for d in ("box2", "box3") if results.select(part="growth", domain=d)]
    if not domains:
        return False
    figure, axes = plt.subplots(1, len(domains), figsize=(5 * len(domains), 3.8), squeeze=False)
    for axis, domain in zip(axes[0], domains):
        records = [r for r in results.select(part="growth", domain=domain) if results.time(r) is not None]
        for stage, provider in dict.fromkeys((r["stage"], r["provider"]) for r in records):
            points = sorted((r["n"], 1e6 * results.time(r) / r["n"]) for r in records
                            if (r["stage"], r["provider"]) == (stage, provider))
            dashed = provider == "tree" and stage == "measures"
            label = provider if provider != "tree" else f"powercell, {stage}"
            axis.plot(*zip(*points), marker="o", markersize=4, linestyle="--" if dashed else "-",
                      color=COLORS.get(provider), label=label)
        axis.set_xscale("log")
        axis.set_ylim(0, 1.3 * axis.get_ylim()[1])  # room for the legend
        axis.set_xlabel("seeds")
        axis.set_ylabel("microseconds per cell")
        axis.set_title(f"{NAMES[domain]}, white, W1", fontsize=10)
        axis.legend(fontsize=8)
        axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=130)
    return True


def plot_memory(results, path):
    records = results.select(part="memory")
    if not records:
        return False
    figure, axis = plt.subplots(figsize=(7, 0.9 + 0.3 * len(records)))
    names = [f"{NAMES[r['domain']]} {count(r['n'])}, {r['provider']}, {r['stage']}" for r in records]
    bars = axis.barh(names, [r["bytes_per_seed"] for r in records],
                     color=[COLORS.get(r["provider"]) for r in records])
    axis.bar_label(bars, fmt="%.0f", fontsize=8, padding=2)
    axis.invert_yaxis()
    axis.margins(x=0.12)
    axis.tick_params(labelsize=8)
    axis.set_xlabel("peak memory beyond input and output, bytes per seed")
    figure.tight_layout()
    figure.savefig(path, dpi=130)
    return True


def main(folder, paths):
    results = Results(paths)
    for name, plot in (("ratios", plot_ratios), ("growth", plot_growth), ("memory", plot_memory)):
        path = os.path.join(folder, name + ".png")
        if plot(results, path):
            print(f"wrote {path}", file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
