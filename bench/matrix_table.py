#!/usr/bin/python3 -B
"""Prints all times and the ratios of powercell's as Markdown tables. Usage: matrix_table.py FILE.json..."""

import sys

from results import Results, count, fields_of

PROVIDERS = ["cgal-parallel", "cgal", "voro++-parallel", "voro++"]
NAMES = {"box2": "square", "box3": "cube", "surface": "surface", "tets": "tetrahedra", "bracket": "bracket", "gyroid": "gyroid"}


def seconds(results, **wanted):
    """(time, text) of one record; (None, "–") if there is none, (None, "slow") if it was left out as too slow."""
    records = results.select(**wanted)
    if not records:
        return None, "–"
    time = results.time(records[0])
    return (time, f"{time:.4f}") if time is not None else (None, "slow")


def ratio(ours, other):
    return f"{other / ours:.2f}" if ours and other else "–"


def print_ratios(results):
    print("| domain | seeds | weights | n | measures | and adjacency | flann | "
          + " | ".join(PROVIDERS) + " | to best peer | to flann |")
    print("|---|---|---|---:|" + "---:|" * (len(PROVIDERS) + 5))
    for work in results.works(part="ratios"):
        wanted = dict(part="ratios", **fields_of(work))
        measures = seconds(results, stage="measures", provider="tree", **wanted)
        ours = seconds(results, stage="adjacency", provider="tree", **wanted)
        flann = seconds(results, stage="adjacency", provider="flann", **wanted)
        peers = [seconds(results, peer=True, provider=p, **wanted) for p in PROVIDERS]
        best = results.fastest(results.select(peer=True, **wanted))
        domain, distribution, weights, n = work
        cells = [NAMES.get(domain, domain), distribution, weights, count(n), measures[1], ours[1], flann[1]]
        cells += [text for _, text in peers]
        cells += [ratio(ours[0], best and best[0]), ratio(ours[0], flann[0])]
        print("| " + " | ".join(cells) + " |")


def print_growth(results):
    for domain in ("box2", "box3"):
        records = [r for r in results.select(part="growth", domain=domain) if results.time(r) is not None]
        if not records:
            continue
        sizes = sorted({r["n"] for r in records})
        print(f"\nMicroseconds per cell, {NAMES[domain]}, white, W1\n")
        print("| | " + " | ".join(count(n) for n in sizes) + " |\n|---|" + "---:|" * len(sizes))
        for stage, provider in dict.fromkeys((r["stage"], r["provider"]) for r in records):
            found = {r["n"]: 1e6 * results.time(r) / r["n"] for r in records
                     if (r["stage"], r["provider"]) == (stage, provider)}
            print(f"| {provider}, {stage} | "
                  + " | ".join(f"{found[n]:.2f}" if n in found else "–" for n in sizes) + " |")


def print_memory(results):
    records = results.select(part="memory")
    if not records:
        return
    print("\nPeak memory of a fresh process beyond input and output, bytes per seed, white, W1\n")
    print("| domain | n | stage | provider | bytes per seed |\n|---|---:|---|---|---:|")
    for r in records:
        print(f"| {NAMES[r['domain']]} | {count(r['n'])} | {r['stage']} | {r['provider']} | "
              f"{r['bytes_per_seed']:.0f} |")


def main(paths):
    results = Results(paths)
    context = results.context
    print(f"{context['device']}, {context['host_threads']} threads, revision {context['revision']}. Seconds, double "
          "precision, least of several runs, taken in turns. powercell: packed tree, measures, then with adjacency. "
          "Peers: volumes only. The ratios are the times of the fastest peer and of FLANN's lists with adjacency, "
          "divided by powercell's with adjacency (above 1: powercell is faster). \"slow\": left out because it took "
          "more than 4 times as long as the fastest peer at fewer seeds (8 times below 1e5).\n")
    print_ratios(results)
    print_growth(results)
    print_memory(results)


if __name__ == "__main__":
    main(sys.argv[1:])
