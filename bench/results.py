"""Reads the results that powercell_matrix wrote, selects records and finds the fastest."""

import json
import os
import sys


class Results:
    """Records of the JSON files with the device and revision of the newest file. `estimate`: use processor times,
    divided by the number of threads for contenders that use all of them, instead of wall times: an estimate of the
    wall time on an idle machine."""

    def __init__(self, paths, estimate=False):
        self.estimate = estimate
        self.records = []
        self.context = {}
        for path in sorted(paths, key=os.path.getmtime, reverse=True):
            with open(path, encoding="utf-8") as file:
                data = json.load(file)
            if self.context and data["context"] != self.context:
                print(f"skipping {path}: its device or revision differs from the newest file's", file=sys.stderr)
                continue
            self.context = data["context"]
            self.records += data["records"]

    def select(self, **wanted):
        """Records whose fields have these values, or one of the values of a list."""

        def fits(record):
            for field, value in wanted.items():
                values = value if isinstance(value, (list, tuple, set)) else [value]
                if record.get(field) not in values:
                    return False
            return True

        return [r for r in self.records if fits(r)]

    def time(self, record):
        """Least time of the runs; None if it was not run."""
        if "seconds" not in record:
            return None
        if not self.estimate:
            return min(record["seconds"])
        on_all_threads = not record["peer"] or record["provider"].endswith("-parallel")
        if on_all_threads and record["peer"] and record["domain"] == "box2":
            return None  # CGAL inserts on one thread in 2D, so there is no estimate
        return min(record["cpu_seconds"]) / (self.context["host_threads"] if on_all_threads else 1)

    def fastest(self, records):
        """The (time, provider) of least time; None if none was run."""
        times = [(self.time(r), r["provider"]) for r in records if self.time(r) is not None]
        return min(times) if times else None

    def works(self, **wanted):
        """Distinct (domain, distribution, weights, n), in the order of the runs."""
        return list(dict.fromkeys(work_of(r) for r in self.select(**wanted)))


def work_of(record):
    return record["domain"], record["distribution"], record["weights"], record["n"]


def fields_of(work):
    return dict(zip(("domain", "distribution", "weights", "n"), work))


def count(n):
    """1000000 -> "1e6", for tables."""
    digits = f"{n:.0e}".replace("e+0", "e").replace("e+", "e")
    return digits if float(digits) == n else f"{n}"
