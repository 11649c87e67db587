#!/usr/bin/env python3
"""powercell beside other Python packages: seconds for the same cells, how exact they are, and what each can do.

usage: peers_python.py [--n N,...] [--transport N,...] [--rounds R] [--limit SECONDS] [--out FILE.md]
       peers_python.py --install FOLDER [--wheel FILE] ...   makes a virtual environment there, installs powercell (of this
           clone, or the wheel) and each of the others into it, and runs itself in it

White seeds in the square and the cube, the same for all, in rounds by turns; the least time of each counts, with the processor
time of that round and the ratio to powercell's. A package is left
out where its time at fewer seeds says that it would pass the limit. Its volumes are compared with powercell's and their sum
with the domain's. Packages that cannot be installed or loaded are listed with the error that was seen. At last the snippets of
docs/coming_from.md run, those of others too, and must give the same volumes (bench/coming_from.py). Prints Markdown.
"""

import argparse
import importlib
import itertools
import json
import os
import pathlib
import platform
import subprocess
import sys
import time
import venv
from importlib import metadata

os.environ.setdefault("OMP_PROC_BIND", "false")  # else Kokkos prints advice

ROOT = pathlib.Path(__file__).resolve().parent.parent
REASONS = "reasons.json"


def install_error(text):
    lines = [line.strip() for line in text.splitlines()]
    compiler = [line[line.index("error: ") :] for line in lines if " error: " in line]
    tool = [line for line in lines if line.startswith(("CMake Error", "ERROR: "))]
    return (compiler or tool or ["no error was printed"])[0]


def pip(python, *packages, **options):
    return subprocess.run([python, "-m", "pip", "-q", "install", "--disable-pip-version-check", "--prefer-binary", *packages], **options)


def install(folder, wheel):
    """An environment with powercell, and so NumPy. Returns its Python."""
    folder = pathlib.Path(folder).resolve()
    venv.create(folder, with_pip=True, clear=True)
    python = str(folder / "bin" / "python")
    pip(python, str(wheel or ROOT), check=True)
    return python


def install_peers():
    """The others, into the environment that this runs in."""
    from python_peers import PEERS

    reasons = {}
    for peer in PEERS[1:]:
        done = pip(sys.executable, peer.package, *getattr(peer, "more", []), capture_output=True, text=True)
        if done.returncode:
            reasons[peer.name] = "pip: " + install_error(done.stderr)
    pathlib.Path(sys.prefix, REASONS).write_text(json.dumps(reasons))


def load(reasons):
    """The peers that can be imported; the reasons of the others are added."""
    from python_peers import PEERS

    found = []
    for peer in PEERS:
        try:
            importlib.import_module(peer.module)
            found.append(peer)
        except BaseException as error:  # some packages exit, or fail to compile
            text = f"import: {type(error).__name__}: {error}".splitlines()[0]
            reasons.setdefault(peer.name, text)
    return found


class Case:
    def __init__(self, name, n, d, periodic, weighted):
        import numpy as np

        rng = np.random.default_rng(n + d)
        self.name, self.n, self.d, self.periodic = name, n, d, periodic
        self.p = rng.random((n, d))
        self.w = 0.3 * rng.random(n) * n ** (-2 / d) if weighted else None
        self.unit = self.box = [0.0] * d, [1.0] * d


CASES = [("square", 2, False, False), ("square, weights", 2, False, True), ("cube", 3, False, False), ("cube, weights", 3, False, True),
         ("periodic cube", 3, True, False), ("periodic cube, weights", 3, True, True)]


class Entry:
    """What one package did in one case."""

    def __init__(self):
        self.seconds, self.error, self.slow, self.volumes, self.sides = {}, "", False, None, None

    def run(self, peer, case, what):
        case.box = case.unit
        begin, busy = time.perf_counter(), time.process_time()
        try:
            result = getattr(peer, what)(case)
        except Exception as error:
            self.error = f"{type(error).__name__}: {error}".splitlines()[0][:160]
            return
        took = time.perf_counter() - begin, time.process_time() - busy
        self.seconds[what] = min(took, self.seconds.get(what, took))
        self.box = case.box
        volumes, sides = result if what == "neighbours" else (result, None)
        if self.volumes is None:
            self.volumes = volumes() if callable(volumes) else volumes  # what the package leaves to its caller is not timed
        self.sides = sides if sides is not None else self.sides


def too_slow(before, what, n, limit):
    """before: (seeds, entry) of fewer seeds, or None."""
    return before is not None and before[1].seconds.get(what, (0, 0))[0] * n / before[0] > limit


def measure(peers, case, before, arguments):
    entries = {}
    for _ in range(arguments.rounds):
        for peer in peers:
            entry = entries.setdefault(peer.name, Entry())
            for what in ("volumes", "neighbours"):
                if entry.error or not peer.does(case) or not hasattr(peer, what):
                    continue
                if too_slow(before.get(peer.name), what, case.n, arguments.limit):
                    entry.slow = True
                    continue
                entry.run(peer, case, what)
    for name, entry in entries.items():
        if entry.seconds:
            before[name] = case.n, entry
    return entries


def seconds(entry, what, ours):
    took = entry.seconds.get(what)
    if took is None:
        return "left out: slow" if entry.slow else "–"
    return f"{took[0]:.3g}, {took[1]:.3g} ({took[0] / ours.seconds[what][0]:.2g} ×)"


def row(peer, case, entry, ours):
    import numpy as np

    if entry.error:
        return f"| {peer.name} | {entry.error} | | | | |"
    sum_error = worst = "–"
    if entry.volumes is not None:
        import powercell as pc

        volumes = np.asarray(entry.volumes, float)
        want, domain = ours.volumes, 1.0
        if entry.box is not case.unit:  # a peer that chose its own
            low, high = entry.box
            domain, want = float(np.prod(high - low)), pc.Diagram(pc.Domain.box(low, high), case.p).mass
        sum_error, worst = f"{volumes.sum() / domain - 1:.0e}", f"{np.abs(volumes - want).max() / want.mean():.0e}"
    sides = "–" if entry.sides is None else f"{entry.sides - ours.sides:+,}"
    return (f"| {peer.name} | {seconds(entry, 'volumes', ours)} | {seconds(entry, 'neighbours', ours)} | {sum_error} | {worst} | {sides} |")


def tables(peers, arguments):
    before = {}
    for name, d, periodic, weighted in CASES:
        for n in arguments.n:
            case = Case(name, n, d, periodic, weighted)
            entries = measure(peers, case, before.setdefault(name, {}), arguments)
            yield f"\n## {name}, {n:,} seeds\n"
            yield "| | volumes | with neighbours | sum / domain − 1 | worst cell, of the mean | neighbours |"
            yield "|---|---:|---:|---:|---:|---:|"
            for peer in peers:
                if peer.does(case):
                    yield row(peer, case, entries[peer.name], entries["powercell"])


def transport(peers, arguments):
    """Weights for which white seeds in the square have cells of equal area."""
    import numpy as np

    for n in arguments.transport:
        case, entries = Case("transport", n, 2, False, False), {}
        for _ in range(arguments.rounds):
            for peer in peers:
                if hasattr(peer, "transport"):
                    entries.setdefault(peer.name, Entry()).run(peer, case, "transport")
        yield f"\n## transport to equal areas, square, {n:,} seeds\n"
        yield "| | time | worst area, relative |\n|---|---:|---:|"
        for name, entry in entries.items():
            worst = "–" if entry.volumes is None else f"{np.abs(np.asarray(entry.volumes) * n - 1).max():.0e}"
            yield f"| {name} | {entry.error or seconds(entry, 'transport', entries['powercell'])} | {worst} |"


def abilities(peers):
    yield "\n## What each can do\n"
    yield "| | version | weights | domains | periodic | walls | geometry | transport | note |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for peer in peers:
        c = peer.can
        yield (f"| {peer.name} | {metadata.version(peer.package)} | {c['weights']} | {c['domains']} | {c['periodic']} | {c['walls']} "
               f"| {c['cells']} | {c['transport']} | {peer.note} |")


def sizes(text):
    """Of "1e4,1e5"; none of ""."""
    return [int(float(word)) for word in text.split(",") if word]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--install", metavar="FOLDER")
    parser.add_argument("--wheel", metavar="FILE")
    parser.add_argument("--peers", action="store_true", help="install the others into this environment first")
    parser.add_argument("--n", type=sizes, default=[10_000, 100_000])
    parser.add_argument("--transport", type=sizes, default=[2000, 20_000], metavar="N,...")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--limit", type=float, default=30)
    parser.add_argument("--out", metavar="FILE.md")
    arguments = parser.parse_args()
    if arguments.install:
        python = install(arguments.install, arguments.wheel)
        rest = ["--peers", "--n", ",".join(map(str, arguments.n)), "--transport", ",".join(map(str, arguments.transport)),
                "--rounds", str(arguments.rounds), "--limit", str(arguments.limit)]
        rest += ["--out", arguments.out] if arguments.out else []
        sys.exit(subprocess.run([python, __file__, *rest]).returncode)

    if arguments.peers:
        install_peers()
    reasons_file = pathlib.Path(sys.prefix) / REASONS
    reasons = json.loads(reasons_file.read_text()) if reasons_file.exists() else {}
    peers = load(reasons)
    import coming_from
    import powercell as pc
    from python_peers import THREADS

    out = open(arguments.out, "w") if arguments.out else sys.stdout
    device = pc.Device.choose()
    pc.Diagram(pc.Domain.box([0, 0, 0], [1, 1, 1]), [[0.5] * 3]).compute()  # programs are built once
    print(f"{device.name}, {THREADS} threads; Python {platform.python_version()}; least of {arguments.rounds} rounds: seconds, processor seconds (ratio of the seconds to powercell's).", file=out)
    failures = coming_from.check()
    for line in itertools.chain(tables(peers, arguments), transport(peers, arguments), abilities(peers)):
        print(line, file=out, flush=True)
    if reasons:
        print("\nNot compared:\n", file=out)
        for name, reason in reasons.items():
            print(f"- {name}: {reason}", file=out)
    for line in failures:
        print(line, file=sys.stderr)
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
