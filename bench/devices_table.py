#!/usr/bin/python3 -B
"""Prints the saved records of 'powercell bench' as a document: docs/records/devices.md.

usage: devices_table.py FILE.json... >docs/records/devices.md
       powercell bench --json bench/results/NAME.json --describe 'the machine, and what else ran'
"""

import json
import sys

HEAD = """# Devices measured

Made by `bench/devices_table.py bench/results/*.json >docs/records/devices.md`. To add a device, save a record of it in
`bench/results/` and run that again:

    powercell bench --json bench/results/NAME.json --describe 'the machine, and what else ran'
    powercell bench --compare bench/results/OLD.json bench/results/NAME.json

Cells a second from seeds in host memory to results there, of the best run; white seeds with weights. Columns and
their meaning: [performance](../performance.md#powercell-bench). Rates of different machines and dates are comparable as
far as the scatter allows: by how much longer than the best the lower quartile of the runs took (of three the middle one).
"""


def million(rate):
    return f"{rate / 1e6:.3g}"


def gigabytes(count):
    return f"{count / 2**30:.0f} GiB"


def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def table(head, rows, right=()):
    print("| " + " | ".join(head) + " |")
    print("|" + "|".join("---:" if k in right else "---" for k in range(len(head))) + "|")
    for row in rows:
        print("| " + " | ".join(cell(text) for text in row) + " |")


def scatter(row):
    """None in records that were saved before scatter was."""
    found = [row[kind]["scatter"] for kind in ("measures", "adjacency") if "scatter" in row[kind]]
    return max(found) if found else None


def print_headlines(records):
    print("\n## A million seeds in the cube\n\nMillion cells a second, measures alone.\n")
    rows = []
    for record in records:
        for figure in record["headlines"]:
            if figure["n"] == 1000000:
                rows.append((figure["million_cells_per_second"], figure["device"], figure["precision"],
                             record["host"]["cpu"], record["date"][:10]))
    rows.sort(reverse=True)
    table(["device", "precision", "10⁶ cells/s", "host", "measured"],
          [[device, precision, f"{rate:.3g}", host, date] for rate, device, precision, host, date in rows], right=(2,))


def busy(record):
    """Records that were saved before this was do not say it."""
    if record.get("used_by_others") is None:
        return []
    return [["others", f"used {record['used_by_others']:.2g} processors meanwhile"]]


def print_rates(device):
    """Of records that have them."""
    for rates in device.get("rates", []):
        print(f"\n{cell(device['name'])}, {rates['precision']}: {rates['operations_per_second'] / 1e9:.3g} Gflop/s "
              f"±{100 * rates['operations_scatter']:.0f} %, {rates['copied_bytes_per_second'] / 1e9:.3g} GB/s copied "
              f"±{100 * rates['copied_scatter']:.0f} %.")
    if not device.get("transfers"):
        return
    print(f"\nTransfers of {cell(device['name'])}, GB/s:\n")
    table(["bytes", "to the device", "", "to the host", ""],
          [[f"{t['bytes']:,}", f"{t['to_device_bytes_per_second'] / 1e9:.3g}", f"±{100 * t['to_device_scatter']:.0f} %",
            f"{t['to_host_bytes_per_second'] / 1e9:.3g}", f"±{100 * t['to_host_scatter']:.0f} %"]
           for t in device["transfers"]], right=range(5))


def print_record(name, record):
    devices = "; ".join(f"{d['name']} ({d['platform']}, {d['driver_version']}, {d['compute_units']} units)"
                        for d in record["devices"])
    host = record["host"]
    print(f"\n## {name}\n")
    if record["description"]:
        print(cell(record["description"]) + "\n")
    table(["what", "which"], [
        ["device", devices], ["host", f"{host['cpu']}, {host['processors']} processors, {gigabytes(host['memory_bytes'])}"],
        ["system", host["system"]], ["OpenCL loader", host["opencl_loader"]],
        ["powercell", f"{record['version']} {record['revision'] or ''}".strip()],
        ["measured", record["date"] + (f", {record['repeat']} runs" if record["repeat"] else "") + (", kernels compiled anew" if record["cold"] else "")],
        *busy(record)])
    for device in record["devices"]:
        print_rates(device)
    print()
    good = [row for row in record["rows"] if row["passed"]]
    several = len(record["devices"]) > 1
    first = ["device"] if several else []
    table([*first, "domain", "precision", "seeds", "10⁶ cells/s", "with adjacency", "arithmetic", "bandwidth", "scatter"],
          [[*([row["device"]] if several else []), row["domain"], row["precision"], f"{row['n']:,}", million(row["measures"]["cells_per_second"]),
            million(row["adjacency"]["cells_per_second"]), f"{100 * row['arithmetic_fraction']:.2g} %",
            f"{100 * row['bandwidth_fraction']:.2g} %",
            "" if scatter(row) is None else f"{100 * scatter(row):.0f} %"] for row in good],
          right=range(2 + len(first), 8 + len(first)))
    for row in record["rows"]:
        if not row["passed"]:
            print(f"\nFailed: {row['domain']} in {row['precision']}: {cell(row['failure'])}")


def main(paths):
    records = []
    for path in sorted(paths):
        with open(path, encoding="utf-8") as file:
            records.append((path.rsplit("/", 1)[-1].removesuffix(".json"), json.load(file)))
    print(HEAD, end="")
    if not records:
        print("\nNo record is saved yet.")
        return
    print_headlines([record for _, record in records])
    for name, record in records:
        print_record(name, record)


if __name__ == "__main__":
    main(sys.argv[1:])
