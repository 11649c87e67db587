#!/usr/bin/python3
"""Checks files that `powercell treemap` wrote by shapely (GEOS) against the tree, which is read by code independent
of the tool. Every leaf with a value must have its area; children must lie in their parent, fill it and not overlap.

usage: measure_again.py TREE LAYOUT.json [PICTURE.svg]   (TREE: a table with a header, or JSON)
exit:  0 passed, 1 failed, 77 shapely is missing
"""
import csv
import json
import math
import re
import sys
import xml.etree.ElementTree

try:
    import shapely.geometry
    import shapely.ops
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

AREA = 1e-6      # largest relative error of a leaf's area
TILING = 1e-9    # share of the parent's area that children may leave free or cover twice
ROUNDING = 0.0005 * math.sqrt(2)  # pixels: coordinates in the SVG are multiples of 1/1000


def read_tree(path):
    """id -> (parent or None, value)"""
    rows = {}
    if path.endswith(".json"):
        data = json.load(open(path, encoding="utf-8"))
        if isinstance(data, list):
            for row in data:
                parent = row.get("parent")
                rows[str(row["id"])] = (None if parent is None else str(parent), row.get("value", row.get("size", 0)))
            return rows
        open_nodes = [(data, None, "")]
        while open_nodes:
            node, parent, above = open_nodes.pop()
            own, number = above + node["name"], 2
            while own in rows:
                own, number = f"{above}{node['name']}#{number}", number + 1
            rows[own] = (parent, node.get("value", node.get("size", 0)))
            open_nodes += [(child, own, own + "/") for child in reversed(node.get("children", []))]
        return rows
    with open(path, newline="", encoding="utf-8") as file:
        first = file.readline()
        file.seek(0)
        for row in csv.reader(file, delimiter=";" if ";" in first else ","):
            rows[row[0]] = (row[1] or None, row[-1])
    rows.pop("id", None), rows.pop("nodeId", None)
    rows = {key: (parent, float(value or 0)) for key, (parent, value) in rows.items()}
    if not any(parent is None for parent, _ in rows.values()):
        rows["0"] = (None, 0)
    return rows


def expected_values(rows):
    """id -> sum of the positive leaves below it, for those above 0"""
    children = {}
    for node, (parent, _) in rows.items():
        children.setdefault(parent, []).append(node)
    order = list(children[None])
    for node in order:
        order += children.get(node, [])
    assert len(order) == len(rows), "the tree is not connected"
    values = {}
    for node in reversed(order):
        below = children.get(node)
        values[node] = sum(values[c] for c in below) if below else max(rows[node][1], 0)
    return {node: v for node, v in values.items() if v > 0}, children, order[0]


def overlap(polygons):
    """Area covered twice, by the sum of the areas and that of the union."""
    return abs(sum(p.area for p in polygons) - shapely.ops.unary_union(polygons).area)


def main():
    tree, layout = sys.argv[1:3]
    values, children, root = expected_values(read_tree(tree))
    written = {row["id"]: row for row in json.load(open(layout, encoding="utf-8"))}
    faults = []
    if set(written) != set(values):
        lost, extra = sorted(set(values) - set(written)), sorted(set(written) - set(values))
        faults.append(f"missing: {lost[:5]} ({len(lost)}), not in the tree: {extra[:5]} ({len(extra)})")
    polygon = {key: shapely.geometry.Polygon(row["polygon"]) for key, row in written.items()}
    whole = polygon[root].area
    leaves, worst, free, twice, outside = 0, (0, ""), 0, 0, 0
    for node, value in values.items():
        if node not in polygon:
            continue
        if not polygon[node].is_valid:
            faults.append(f"{node}: the polygon is not valid")
        if abs(written[node]["value"] / value - 1) > 1e-12:
            faults.append(f"{node}: the value is {written[node]['value']}, not {value}")
        below = [polygon[c] for c in children.get(node, []) if c in polygon]
        if not below:
            leaves += 1
            worst = max(worst, (abs(polygon[node].area / whole / (value / values[root]) - 1), node))
            continue
        parent = polygon[node]
        free = max(free, abs(parent.area - sum(p.area for p in below)) / parent.area)
        reach = 1e-9 * math.sqrt(parent.area)
        inside = parent.buffer(reach, join_style=2)
        outside += sum(not inside.contains(p) for p in below)
        if len(below) > 1:
            twice = max(twice, overlap(below) / parent.area)
    print(f"{leaves} leaves; worst area off by {100 * worst[0]:.3g} % ({worst[1]})")
    print(f"of a parent at most {free:.2g} is left free and {twice:.2g} covered twice; {outside} children reach out")
    if worst[0] > AREA:
        faults.append("an area is off by more than allowed")
    if free > TILING or twice > TILING or outside:
        faults.append("children do not tile their parent")
    if len(sys.argv) > 3:
        check_svg(sys.argv[3], values, children, written, faults)
    for fault in faults:
        print("WRONG:", fault)
    sys.exit(1 if faults else 0)


def check_svg(path, values, children, written, faults):
    """Areas of the drawn leaves, up to the rounding of their corners."""
    drawn = {}
    for element in xml.etree.ElementTree.parse(path).iter("{http://www.w3.org/2000/svg}path"):
        if element.get("class") == "g":
            continue
        numbers = [float(x) for x in re.findall(r"-?[\d.]+", element.get("d"))]
        drawn[element.get("data-id")] = shapely.geometry.Polygon(list(zip(numbers[::2], numbers[1::2])))
    leaves = {n for n in values if not any(c in values for c in children.get(n, []))}
    if set(drawn) != leaves:
        faults.append(f"{path}: {len(drawn)} leaves are drawn, {len(leaves)} are in the tree")
    total, whole = sum(values[n] for n in leaves), sum(p.area for p in drawn.values())
    worst = 0
    for node, polygon in drawn.items():
        if node in values:
            error = abs(polygon.area - whole * values[node] / total)
            worst = max(worst, error / (ROUNDING * polygon.length + 1e-6 * polygon.area + 4 * ROUNDING**2))
    print(f"{path}: {len(drawn)} leaves drawn, areas off by at most {worst:.2g} of what rounding corners may do")
    if worst > 1:
        faults.append(f"{path}: an area is off by more than rounding")


main()
