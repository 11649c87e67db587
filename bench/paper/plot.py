"""Draws the figures: plot.py FOLDER NAME... reads FOLDER/NAME.csv and writes FOLDER/NAME.png."""
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

import data

TREE, TWIN, SEED, PAPER = "tab:blue", "tab:orange", "tab:red", "black"
TIME = "µs of processor time a seed"


def panels(rows, columns, width=4.2, height=3.1):
    figure, axes = plt.subplots(rows, columns, figsize=(width * columns, height * rows), squeeze=False)
    for axis in axes.flat:
        axis.grid(True, which="major", alpha=0.3)
    return figure, axes


def style(value):
    """Lines of the ranges of weights."""
    return {0: "-", 0.5: "--", 2: "-.", 4: ":"}[value]


def ticks(axis, values):
    axis.set_xticks(values, [f"{v:g}" for v in values])
    axis.tick_params(axis="x", which="minor", bottom=False, labelbottom=False)


def log_scale(axis):
    """A logarithmic scale labelled 1, 2, 5, 10 and so on."""
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}" if value < 1000 else f"{value:,.0f}"))
    axis.set_minor_formatter(NullFormatter())


def figure3(rows):
    figure, axes = panels(2, 2)
    for column, domain in enumerate(("square", "cube")):
        for key, axis in (("neighbors", axes[0][column]), ("flann_us", axes[1][column])):
            for weight_range in sorted({r["range"] for r in rows}):
                for query, color, name in (("seed", SEED, "lifted seed"), ("twin", TWIN, "twin")):
                    part = data.pick(rows, domain=domain, range=weight_range, query=query)
                    axis.plot(data.column(part, "factor"), data.column(part, key), color=color, marker=".",
                              ls=style(weight_range), label=f"query {name}, w ≤ {weight_range:g} h²")
                if key == "flann_us":
                    axis.axhline(part[0]["tree_us"], color=TREE, ls=style(weight_range),
                                 label=f"tree, w ≤ {weight_range:g} h²")
            axis.set_xscale("log")
            axis.set_yscale("log")
            log_scale(axis.yaxis)
            ticks(axis, [1, 2, 5, 10, 30, 100])
            axis.set_xlabel("η / largest weight")
        axes[0][column].set_title(f"{domain}, n = {rows_n(rows, domain)}")
    axes[0][0].set_ylabel("neighbours tried a seed")
    axes[1][0].set_ylabel(TIME)
    axes[1][1].legend(fontsize=7)
    return figure


def rows_n(rows, domain):
    return f"{int(data.pick(rows, domain=domain)[0]['n']):,}"


def figure4(rows):
    figure, axes = panels(1, 3)
    for axis, domain in zip(axes[0], ("square", "surface", "cube")):
        part = data.pick(rows, domain=domain)
        low, high = data.PAPER_LENGTH[domain]
        axis.axvspan(low, high, color="gray", alpha=0.25, label=f"the paper's best, {low}–{high}")
        axis.plot(data.column(part, "L"), data.column(part, "flann_us"), color=TWIN, marker=".", label="lists")
        best = min(part, key=lambda row: row["flann_us"])
        axis.plot(best["L"], best["flann_us"], "o", ms=10, mfc="none", color=TWIN, label=f"least: L = {best['L']:g}")
        axis.axhline(part[0]["tree_us"], color=TREE, label="tree")
        axis.set_ylim(bottom=0)
        axis.set_xlabel("L, neighbours asked for at first")
        axis.set_title(f"{domain}, n = {rows_n(rows, domain)}")
        axis.legend(fontsize=7, loc="lower right")
    axes[0][0].set_ylabel(TIME)
    return figure


def figure6(rows):
    figure, axes = panels(2, 2)
    for column, domain in enumerate(("square", "cube")):
        twin, seed = (data.pick(rows, domain=domain, query=query) for query in ("twin", "seed"))
        ranges = [f"{r:g}" for r in data.column(twin, "range")]
        counts, times = axes[0][column], axes[1][column]
        for key, axis in (("neighbors", counts), ("flann_us", times)):
            axis.plot(ranges, data.column(seed, key), color=SEED, marker=".", label="lists, without twins")
            axis.plot(ranges, data.column(twin, key), color=TWIN, marker=".", label="lists, with twins")
        counts.plot(ranges, data.column(twin, "cuts"), color="gray", ls=":", label="of these, cuts (with twins)")
        times.plot(ranges, data.column(twin, "tree_us"), color=TREE, marker=".", label="tree")
        for axis in (counts, times):
            axis.set_ylim(bottom=0)
            axis.set_xlabel("range of the weights / h²")
            axis.legend(fontsize=7)
        counts.set_title(f"{domain}, n = {rows_n(rows, domain)}")
    axes[0][0].set_ylabel("neighbours tried a seed")
    axes[1][0].set_ylabel(TIME)
    return figure


def figure8(rows):
    figure, axes = panels(2, 2, 4.6, 3.4)
    bins = 10 if len(rows) < 1000 else 24
    for line, domain in enumerate(("square", "cube")):
        part = data.pick(rows, domain=domain)
        x = np.array(data.column(part, "uniformity"))
        y = np.log10(data.column(part, "range"))
        both = np.array(data.column(part, "flann_us") + data.column(part, "tree_us"))
        norm = LogNorm(np.percentile(both, 1), np.percentile(both, 99))
        edges_x, edges_y = np.linspace(0, 0.95, bins + 1), np.linspace(y.min(), y.max(), bins + 1)
        for axis, key, name in ((axes[line][0], "flann_us", "lists"), (axes[line][1], "tree_us", "tree")):
            total, _, _ = np.histogram2d(x, y, (edges_x, edges_y), weights=data.column(part, key))
            count, _, _ = np.histogram2d(x, y, (edges_x, edges_y))
            mean = np.where(count > 0, total / np.maximum(count, 1), np.nan)
            axis.grid(False)
            mesh = axis.pcolormesh(edges_x, 10**edges_y, mean.T, norm=norm, cmap="viridis")
            axis.set_yscale("log")
            axis.set_title(f"{domain}, {name} ({len(part):,} sets)")
            axis.set_xlabel("uniformity of the locations")
            figure.colorbar(mesh, ax=axis, label=TIME, format="%g").minorticks_off()
            bar = figure.axes[-1]
            marks = [v for v in (1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 200, 500) if norm.vmin <= v <= norm.vmax]
            bar.set_yticks(marks, [f"{v:g}" for v in marks])
        axes[line][0].set_ylabel("range of the weights / h²")
    return figure


def seconds(rows, way):
    return [1e-6 * row[way + "_us"] * row["n"] for row in rows]


def growth(rows, domain):
    figure, axes = panels(1, 2, 5, 3.6)
    for weight_range in sorted({r["range"] for r in rows}):
        part = data.pick(rows, range=weight_range)
        n = data.column(part, "n")
        for way, color in (("flann", TWIN), ("tree", TREE)):
            name = f"{'lists' if way == 'flann' else 'tree'}, w ≤ {weight_range:g} h²"
            axes[0][0].plot(n, data.column(part, way + "_us"), color=color, ls=style(weight_range), marker=".",
                            label=name)
            axes[0][1].plot(n, seconds(part, way), color=color, ls=style(weight_range), marker=".", label=name)
        for size in (5000, 100000):
            paper = data.paper_microseconds(domain, size, weight_range)
            axes[0][0].plot(size, paper, "x", color=PAPER,
                            label="the paper's program" if (size, weight_range) == (5000, 0) else None)
    guide = np.array([min(r["n"] for r in rows), max(r["n"] for r in rows)])
    scale = max(seconds(rows, "flann")) / guide[1]
    axes[0][1].plot(guide, scale * guide, color="gray", lw=1, label="proportional to n")
    for axis in axes[0]:
        axis.set_xscale("log")
        axis.set_yscale("log")
        log_scale(axis.yaxis)
        axis.set_xlabel("n")
    axes[0][0].set_ylabel(TIME)
    axes[0][1].set_ylabel("seconds of processor time")
    axes[0][0].legend(fontsize=7)
    axes[0][1].legend(fontsize=7)
    return figure


def table1(rows):
    largest = max(r["n"] for r in rows)
    rows = data.pick(rows, n=largest)
    models = list(dict.fromkeys(r["model"] for r in rows))
    figure, axes = panels(1, 1, 7.5, 3.8)
    axis = axes[0][0]
    for shift, provider, color, name in ((-0.2, "flann", TWIN, "lists"), (0.2, "tree", TREE, "tree")):
        values = [data.pick(rows, model=m, provider=provider)[0]["us"] for m in models]
        axis.bar(np.arange(len(models)) + shift, values, 0.38, color=color, label=name)
        for k, value in enumerate(values):
            axis.text(k + shift, value, f"{value:.2g}" if value < 10 else f"{value:.0f}", ha="center", va="bottom", fontsize=7)
    axis.set_yscale("log")
    log_scale(axis.yaxis)
    axis.set_ylim(top=2 * max(r["us"] for r in rows))
    axis.set_xticks(range(len(models)), [f"{m}\n{int(data.pick(rows, model=m)[0]['regions']):,}" for m in models], fontsize=8)
    axis.set_xlabel("model, convex regions")
    axis.set_ylabel(TIME)
    axis.set_title(f"n = {int(largest):,}, weights up to h²/2")
    axis.legend(fontsize=8)
    return figure


FIGURES = {"figure3": figure3, "figure4": figure4, "figure6": figure6, "figure8": figure8, "table1": table1,
           "figure9": lambda rows: growth(rows, "surface"), "figure10": lambda rows: growth(rows, "volume")}


def main():
    folder = sys.argv[1]
    for name in sys.argv[2:]:
        rows = data.read(folder, name)
        if rows is None:
            sys.exit(f"plot.py: there is no {name}.csv in {folder}")
        figure = FIGURES[name](rows)
        figure.tight_layout()
        figure.savefig(os.path.join(folder, name + ".png"), dpi=100, metadata={"Software": None})
        plt.close(figure)


main()
