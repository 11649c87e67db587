"""Reads the CSV files of the figures, and what is known of the paper's own program."""
import csv
import os


def read(folder, name):
    """Rows of NAME.csv as dictionaries, numbers as floats; None if there is no such file."""
    path = os.path.join(folder, name + ".csv")
    if not os.path.exists(path):
        return None
    with open(path) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    for row in rows:
        for key, value in row.items():
            try:
                row[key] = float(value)
            except ValueError:
                pass
    return rows


def comments(folder, name):
    """The lines after '#' that say what the data were made on."""
    with open(os.path.join(folder, name + ".csv")) as file:
        return [line[2:].strip() for line in file if line.startswith("#")]


def pick(rows, **wanted):
    return [row for row in rows if all(row[key] == value for key, value in wanted.items())]


def column(rows, key):
    return [row[key] for row in rows]


# Thousand cells a second of the paper's public program (its path by nearest neighbours) on one core of an
# EPYC, measures included, by range of the weights (0, 0.5, 4 times h^2) and number of seeds.
# Measured once, not in these runs.
PAPER_PROGRAM = {
    "square": {100000: {0: 184, 0.5: 184, 4: 200}},
    "cube": {100000: {0: 19, 0.5: 18, 4: 26}},
    "surface": {5000: {0: 90, 0.5: 102, 4: 94}, 100000: {0: 123, 0.5: 145, 4: 188}},
    "volume": {5000: {0: 5.2, 0.5: 5.3, 4: 7.0}, 100000: {0: 10, 0.5: 10, 4: 14}},
}


def paper_microseconds(domain, n, weight_range):
    """Microseconds a seed of the paper's program, or None where it was not measured."""
    rate = PAPER_PROGRAM.get(domain, {}).get(int(n), {}).get(weight_range)
    return 1000 / rate if rate else None


# Neighbours asked for at first that the paper found best.
PAPER_LENGTH = {"square": (14, 18), "surface": (14, 18), "cube": (30, 35)}
