"""Writes the tables and verdicts of the data into bench/paper/README.md: report.py FOLDER FILE NAME...
The text between '<!-- NAME -->' and '<!-- /NAME -->' is replaced. Verdicts follow from the data."""
import math
import statistics
import sys

import data

SLOWER = 1.05  # less than this is noise of the timing


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---|" + "---:|" * (len(head) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def microseconds(value):
    return f"{value:.2f}" if value < 10 else f"{value:.1f}" if value < 100 else f"{value:.0f}"


def figure3(rows):
    lines, ratios = [], {"seed": [], "twin": []}
    for query, name in (("seed", "lifted seed"), ("twin", "twin")):
        for domain in ("square", "cube"):
            for weight_range in sorted({r["range"] for r in rows}):
                part = data.pick(rows, domain=domain, range=weight_range, query=query)
                first, last = part[0], part[-1]
                ratio = last["flann_us"] / first["flann_us"]
                ratios[query].append(ratio)
                lines.append([f"{name}, {domain}, w ≤ {weight_range:g} h²", f"{last['factor']:g}",
                              f"{first['neighbors']:.1f} → {last['neighbors']:.1f}",
                              f"{microseconds(first['flann_us'])} → {microseconds(last['flann_us'])}",
                              f"{ratio:.2f}", microseconds(first["tree_us"])])
    seed, twin = min(ratios["seed"]), ratios["twin"]
    return table(["query", "η up to, × largest weight", "neighbours tried", "µs", "time ratio", "tree µs"], lines) + f"""

**{"Agrees" if seed > SLOWER else "Does not agree"} where lists are searched at the lifted seed**: the largest η takes \
{seed:.2f} to {max(ratios["seed"]):.1f} times as long as the least one. **{"Agrees" if min(twin) > SLOWER else
"Does not agree"} where they are searched at the twin**: there the ratio is {min(twin):.2f} to {max(twin):.2f}."""


def figure4(rows):
    lines, verdicts = [], []
    for domain in ("square", "surface", "cube"):
        part = data.pick(rows, domain=domain)
        best = min(part, key=lambda r: r["flann_us"])
        good = [r["L"] for r in part if r["flann_us"] < best["flann_us"] * SLOWER]
        low, high = data.PAPER_LENGTH[domain]
        there = min((r for r in part if low <= r["L"] <= high), key=lambda r: r["flann_us"])
        agrees = there["flann_us"] < best["flann_us"] * SLOWER
        verdicts.append(f"{'agrees' if agrees else 'does not agree'} ({domain})")
        lines.append([domain, f"{low}–{high}", f"{best['L']:g}", f"{good[0]:g}–{good[-1]:g}",
                      f"{100 * there['first_share']:.0f} %", f"{there['flann_us'] / best['flann_us']:.2f}",
                      microseconds(best["flann_us"]), microseconds(best["tree_us"])])
    return table(["domain", "the paper's best L", "ours", "within 5 % of it", "cells done at the paper's L",
                  "time there / least", "least µs", "tree µs"], lines) + f"\n\n**{', '.join(verdicts).capitalize()}.**"


def figure6(rows):
    lines, fewer = [], True
    for domain in ("square", "cube"):
        for weight_range in (0, 0.5, 4):
            twin, seed = (data.pick(rows, domain=domain, range=weight_range, query=q)[0] for q in ("twin", "seed"))
            if weight_range > 0:
                fewer = fewer and twin["neighbors"] < seed["neighbors"] and twin["flann_us"] < seed["flann_us"]
            lines.append([f"{domain}, w ≤ {weight_range:g} h²", f"{100 * twin['hidden']:.0f} %",
                          f"{seed['neighbors']:.1f}", f"{twin['neighbors']:.1f}", f"{twin['cuts']:.1f}",
                          microseconds(seed["flann_us"]), microseconds(twin["flann_us"]),
                          microseconds(twin["tree_us"])])
    return table(["seeds", "hidden", "neighbours without twins", "with twins", "of these, cuts", "µs without", "µs with",
                  "tree µs"], lines) + f"\n\n**{'Agrees' if fewer else 'Does not agree'}**: with weights, twins " + (
                      "save neighbours and time." if fewer else "do not always save neighbours and time.")


CLASSES = (("even", 0.7, 1), ("white", 0.4, 0.55), ("clustered", 0, 0.3))
RANGES = (("narrow (< 0.1 h²)", 0, 0.1), ("middle", 0.3, 1), ("wide (> 4 h²)", 4, 1e9))


def figure8(rows):
    lines, spread = [], {}
    for domain in ("square", "cube"):
        for way, name in (("flann_us", "lists"), ("tree_us", "tree")):
            medians = []
            for _, low, high in CLASSES:
                for _, narrow, wide in RANGES:
                    values = [r[way] for r in rows if r["domain"] == domain and low <= r["uniformity"] < high
                              and narrow <= r["range"] < wide]
                    medians.append(statistics.median(values) if values else math.nan)
            lines.append([f"{domain}, {name}"] + [microseconds(m) for m in medians])
            spread[domain, name] = max(medians) / min(medians)
    head = ["µs, median"] + [f"{c[0]}, {r[0].split(' ')[0]}" for c in CLASSES for r in RANGES]
    return table(head, lines) + "\n\nSlowest over fastest of these classes: " + ", ".join(
        f"{domain}, {name}: {value:.1f}" for (domain, name), value in spread.items()) + "."


def growth(rows, domain):
    lines, slopes, gains = [], [], {"flann_us": [], "tree_us": []}
    for weight_range in (0, 0.5, 4):
        part = data.pick(rows, range=weight_range)
        for row in part:
            if row["n"] not in (1000, 5000, 10000, 100000, 300000):
                continue
            paper = data.paper_microseconds(domain, row["n"], weight_range)
            for way, list_of in gains.items():
                list_of += [paper / row[way]] if paper else []
            lines.append([f"w ≤ {weight_range:g} h², n = {int(row['n']):,}", f"{row['pairs'] / row['n']:.1f}",
                          microseconds(row["flann_us"]), microseconds(row["tree_us"]),
                          microseconds(paper) if paper else "–"])
        first, last = part[0], part[-1]
        for way in ("flann_us", "tree_us"):
            slopes.append(1 + math.log(last[way] / first[way]) / math.log(last["n"] / first["n"]))
    speed = ", ".join(f"{name} {min(gains[way]):.2f} to {max(gains[way]):.2f}"
                      for way, name in (("flann_us", "lists"), ("tree_us", "tree")) if gains[way])
    speed = f" Speed relative to the paper's program, a core each: {speed}." if speed else ""
    return table(["seeds", "pairs a seed", "lists µs", "tree µs", "the paper's program, µs"], lines) + f"""

Over the whole range the time grows as n to the power {min(slopes):.2f} to {max(slopes):.2f} \
(lists and tree, all weights).{speed}"""


def table1(rows):
    lines = []
    for model in dict.fromkeys(r["model"] for r in rows):
        for n in sorted({r["n"] for r in rows}):
            lists, tree = (data.pick(rows, model=model, n=n, provider=p)[0] for p in ("flann", "tree"))
            share = {key: f"{100 * lists[key] / lists['total_s']:.0f} %" for key in ("pairs_s", "neighbors_s", "clip_s")}
            lines.append([f"{model} ({lists['kind']})", f"{int(lists['regions']):,}", f"{int(n):,}",
                          f"{lists['pairs'] / n:.1f}", microseconds(lists["us"]), *share.values(),
                          microseconds(tree["us"]), f"{100 * tree['clip_s'] / tree['total_s']:.0f} %",
                          f"{lists['us'] / tree['us']:.2f}"])
    return table(["model", "regions", "seeds", "pairs a seed", "lists µs", "pairs", "neighbours", "clipping", "tree µs",
                  "search and clipping", "lists / tree"], lines)


FIGURES = {"figure3": figure3, "figure4": figure4, "figure6": figure6, "figure8": figure8, "table1": table1,
           "figure9": lambda rows: growth(rows, "surface"), "figure10": lambda rows: growth(rows, "volume")}


def main():
    folder, path = sys.argv[1:3]
    with open(path) as file:
        text = file.read()
    for name in sys.argv[3:]:
        begin, end = f"<!-- {name} -->", f"<!-- /{name} -->"
        if text.count(begin) != 1 or text.count(end) != 1:
            sys.exit(f"report.py: {path} must have one {begin} and one {end}")
        before, after = text.split(begin)[0], text.split(end)[1]
        _, device, measured = data.comments(folder, name)[:3]
        made_on = f"{measured.split(',')[0].capitalize()} by `bench/paper/run.sh {name}`, {device.removeprefix('device: ')}."
        text = f"{before}{begin}\n{FIGURES[name](data.read(folder, name))}\n\n*{made_on}*\n{end}{after}"
    with open(path, "w") as file:
        file.write(text)


main()
