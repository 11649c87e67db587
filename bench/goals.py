#!/usr/bin/python3 -B
"""Prints the goals and the measured values as a Markdown table. Usage: goals.py [--cpu] FILE.json..."""

import math
import sys

from results import Results, count, fields_of

ALL_WEIGHTS = ["W0", "W1", "W2"]

SOLIDS = ["bracket", "gyroid"]

# name, domain or domains, distributions, numbers of seeds, goal, aim: times as fast as the fastest peer
RATIO_ROWS = [
    ("cube, 1e5 and 1e6, white and blue, W0 W1 W2", "box3", ["white", "blue"], [10**5, 10**6], 2.3, 4),
    ("cube, 1e5 and 1e6, cluster, W0 W1 W2", "box3", ["cluster"], [10**5, 10**6], 2.3, 4),
    ("square, 1e5 and 1e6, all nine", "box2", ["white", "blue", "cluster"], [10**5, 10**6], 2, 3),
    ("surface of 5,000 triangles, 5e3 and 1e5 seeds, W0 W1 W2", "surface", ["white"], [5000, 10**5], 2, 4),
    ("square, kept diagram, 10 seeds, W0 W1 W2", "box2", ["white"], [10], .5, 1),
    ("the same, 100 seeds", "box2", ["white"], [100], 1, 2),
    ("the same, 1e3 seeds", "box2", ["white"], [1000], 1.5, 3),
    ("16,000 tetrahedra, 5e3 and 1e5 seeds, W0 W1 W2", "tets", ["white"], [5000, 10**5], 2, 4),
    ("bracket and gyroid, 5e3 seeds, W0 W1 W2", SOLIDS, ["white"], [5000], 2, 3),
    ("the same, 200 and 1e3 seeds", SOLIDS, ["white"], [200, 1000], 1.5, 3),
    ("the same, 1e5 seeds", SOLIDS, ["white"], [10**5], 2.3, 3),
]


def verdict(value, least, aim, smaller_is_better=False):
    sign = -1 if smaller_is_better else 1
    if sign * value >= sign * aim:
        return "aim"
    return "yes" if sign * value >= sign * least else "**no**"


def work_ratio(results, work):
    """(ratio to the fastest peer, that peer) for one work; None if one of the two is missing."""
    ours = results.fastest(results.select(part=["ratios", "small"], stage="adjacency", provider="tree", **fields_of(work)))
    peer = results.fastest(results.select(part=["ratios", "small"], peer=True, **fields_of(work)))
    return (peer[0] / ours[0], peer[1]) if ours and peer else None


def ratio_rows(results):
    for name, domain, distributions, sizes, least, aim in RATIO_ROWS:
        ratios = {}
        domains = domain if isinstance(domain, list) else [domain]
        works = [(place, d, w, n) for place in domains for d in distributions for w in ALL_WEIGHTS for n in sizes]
        for work in works:
            found = work_ratio(results, work)
            if found:
                ratios[work] = found
        goal = f"{least} ×", f"{aim} ×"
        if not ratios:
            yield name, *goal, "not measured", "–", ""
            continue
        worst = min(ratios, key=lambda work: ratios[work][0])
        mean = math.exp(sum(math.log(r) for r, _ in ratios.values()) / len(ratios))
        place, distribution, weights, n = worst
        where = f"{place} {weights}" if len(domains) > 1 else f"{distribution} {weights}"
        note = f"lowest at {where} {count(n)}, against {ratios[worst][1]}; mean {mean:.2f}"
        value = ratios[worst][0]
        reached = verdict(value, least, aim)
        if len(ratios) < len(works):
            note += f"; {len(ratios)} of {len(works)} works"
            reached = f"partly: {reached}"
        yield name, *goal, f"{value:.2f} ×", reached, note


def growth_rows(results):
    for domain, name in (("box2", "2D"), ("box3", "3D")):
        cells = {}
        for r in results.select(part="growth", domain=domain, stage="adjacency", provider="tree"):
            if results.time(r) is not None:
                cells[r["n"]] = results.time(r) / r["n"]
        sizes = sorted(cells)
        title = f"time per cell, {name}"
        if len(sizes) < 2:
            yield title, "< 1.5 ×", "1.1 ×", "not measured", "–", ""
            continue
        value, a, b = max((cells[b] / cells[a], a, b) for a in sizes for b in sizes if a < b)
        micro = ", ".join(f"{count(n)}: {1e6 * cells[n]:.2f} µs" for n in sizes)
        title += f", {count(sizes[0])} → {count(sizes[-1])}"
        yield (title, "< 1.5 ×", "1.1 ×", f"{value:.2f} ×", verdict(value, 1.5, 1.1, True),
               f"largest increase: {count(a)} → {count(b)}; {micro}")


def periodic_rows(results):
    for domain, name in (("box3", "cube"), ("box2", "square")):
        ratios = {}
        for work in results.works(part="periodic", domain=domain):
            time = {stage: results.fastest(results.select(part="periodic", stage=stage, **fields_of(work)))
                    for stage in ("adjacency", "periodic")}
            if all(time.values()):
                ratios[work] = time["periodic"][0] / time["adjacency"][0]
        title = f"periodic {name} over the bounded one, 1e5, all nine"
        if not ratios:
            yield title, "1.15 ×", "1.05 ×", "not measured", "–", ""
            continue
        worst = max(ratios, key=ratios.get)
        mean = math.exp(sum(map(math.log, ratios.values())) / len(ratios))
        yield (title, "1.15 ×", "1.05 ×", f"{ratios[worst]:.2f} ×", verdict(ratios[worst], 1.15, 1.05, True),
               f"highest at {worst[1]} {worst[2]}; mean {mean:.2f}")


def memory_rows(results):
    for domain, name in (("box2", "square"), ("box3", "cube")):
        for r in results.select(part="memory", domain=domain, stage="measures", provider="tree"):
            value = r["bytes_per_seed"]
            with_adjacency = results.select(part="memory", domain=domain, stage="adjacency", provider="tree",
                                            n=r["n"])
            note = "".join(f"with adjacency {a['bytes_per_seed']:.0f}" for a in with_adjacency)
            yield (f"memory beyond input and output, measures only, {name} {count(r['n'])}", "400 bytes per seed",
                   "150", f"{value:.0f}", verdict(value, 400, 150, True), note)


def other_rows(results):
    cold = results.fastest(results.select(part="weights", stage="adjacency", provider="tree"))
    warm = results.fastest(results.select(part="weights", stage="weights", provider="tree"))
    if cold and warm:
        value = cold[0] / warm[0]
        n = results.select(part="weights")[0]["n"]
        yield (f"only the weights changed (3D, {count(n)})", "1.5 × as fast as with new seeds", "2.5 ×",
               f"{value:.2f} ×", verdict(value, 1.5, 2.5), f"{cold[0]:.2f} s new seeds, {warm[0]:.2f} s new weights")
    for stage, title, least, aim, note in (
            ("cold", "start to first result, empty caches", 3, 1, "the same program"),
            ("cold demo", "powercell demo, empty caches", 10, 5, "six pictures of three domains")):
        for r in results.select(part="start", stage=stage):
            value = min(r["seconds"])
            yield title, f"{least} s", f"{aim} s", f"{value:.1f} s", verdict(value, least, aim, True), note
    for r in results.select(part="start", stage="start"):
        value = min(r["seconds"])
        yield ("start to first result, warm cache", "0.3 s", "0.1 s", f"{value:.3f} s",
               verdict(value, 0.3, 0.1, True), "a program that measures 1,000 cells in the cube")
    for r in results.select(part="gpu"):
        value = r["n"] / min(r["seconds"]) / 1e6
        yield (f"{results.context['device']}, white cube, {count(r['n'])}, {r['precision']}", "10 M cells/s",
               "40 M", f"{value:.1f} M", verdict(value, 10, 40), f"stage {r['stage']}")
    if not results.select(part="gpu"):
        yield "H200, white cube, 1e7, float", "10 M cells/s", "40 M", "not measured", "–", "no GPU in this run"


def main(arguments):
    cpu = "--cpu" in arguments
    results = Results([a for a in arguments if a != "--cpu"], estimate=cpu)
    context = results.context
    print(f"{context['device']}, {context['host_threads']} threads, revision {context['revision']}. Double "
          "precision. powercell: measures and adjacency, packed tree; peers: volumes only, the fastest of the same "
          "run" + ("; estimated from processor times" if cpu else "") + ".\n")
    print("| workload | at least | aim | measured | reached | |\n|---|---|---|---:|---|---|")
    for make in (ratio_rows, periodic_rows, growth_rows, memory_rows, other_rows):
        for row in make(results):
            print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    main(sys.argv[1:])
