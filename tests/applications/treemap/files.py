#!/usr/bin/python3
"""Tests the command `powercell treemap`: every input and output format, updates, and refusals. The written files are
measured by measure_again.py.

usage: files.py PATH_OF_POWERCELL
exit:  0 passed, 1 failed, 77 shapely is missing
"""
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import unittest

TOOL = str(pathlib.Path(sys.argv.pop(1)).resolve())
CHECK = pathlib.Path(__file__).with_name("measure_again.py")

try:
    import shapely.geometry  # noqa: F401
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)


def made_rows(count, seed=1):
    """Rows of a tree with values over four orders of magnitude, some of them 0 or negative."""
    source = random.Random(seed)
    rows = [("r", "", "the root", "")]
    for k in range(count):
        parent = rows[source.randrange(max(0, len(rows) - 40), len(rows))][0]
        value = 10 ** source.uniform(0, 4) if source.random() > 0.05 else source.choice([0, -3])
        rows.append((f"n{k}", parent, f'node "{k}" & <{k}>, é', repr(value)))
    return rows


class Treemap(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_tool(self, *arguments):
        return subprocess.run([TOOL, "treemap", *map(str, arguments)], cwd=self.folder, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=300)

    def good(self, *arguments):
        done = self.run_tool(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return name

    def table(self, name, rows, separator=","):
        quote = lambda field: '"' + field.replace('"', '""') + '"'
        lines = [separator.join(["id", "parent", "name", "value"])]
        lines += [separator.join([i, p, quote(n), v]) for i, p, n, v in rows]
        return self.write(name, "\n".join(lines) + "\n")

    def measured_again(self, *files):
        done = subprocess.run([sys.executable, CHECK, *files], cwd=self.folder, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_table_to_every_format(self):
        self.table("t.csv", made_rows(1500))
        report = json.loads(self.good("t.csv", "-o", "t.json", "-o", "t.svg", "-o", "t.png", "-o", "t.pdf", "--json"))
        self.assertLess(report["worst_leaf_error"], 1e-6)
        self.assertGreater(len(report["dropped"]), 10)
        self.measured_again("t.csv", "t.json", "t.svg")
        self.assertEqual((self.folder / "t.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual((self.folder / "t.pdf").read_bytes()[:5], b"%PDF-")

    def test_shapes(self):
        self.table("t.csv", made_rows(150))
        ring = [[0, 0], [5, 0], [6, 3], [2, 4], [0, 0]]
        self.write("field.geojson", json.dumps({"type": "Polygon", "coordinates": [ring]}))
        for shape in ("1:1", "3:1.5", "circle", "circle:7", "hexagon", "field.geojson"):
            with self.subTest(shape=shape):
                self.good("t.csv", "--shape", shape, "-o", "t.json", "-o", "t.svg")
                self.measured_again("t.csv", "t.json", "t.svg")

    def test_nested_and_listed_json(self):
        nested = {"name": "top", "children": [
            {"name": "a", "children": [{"name": "x", "value": 1}, {"name": "x", "size": 2.5}]},
            {"name": "b", "value": 4}, {"name": "nothing", "value": 0}]}
        self.write("n.json", json.dumps(nested))
        self.assertIn("dropped 1 nodes without a value above 0: top/nothing", self.good("n.json", "-o", "out.json"))
        self.measured_again("n.json", "out.json")
        # The output is a list of rows and can be laid out again.
        self.good("out.json", "-o", "again.json")
        self.measured_again("n.json", "again.json")

    def test_ids_of_equal_names_are_distinct(self):
        children = [{"name": name, "value": 1} for name in ("x", "x", "x#2", "x", "x#2")]
        self.write("n.json", json.dumps({"name": "r", "children": children}))
        self.good("n.json", "-o", "out.json")
        ids = [row["id"] for row in json.loads((self.folder / "out.json").read_text())]
        self.assertEqual(ids, ["r", "r/x", "r/x#2", "r/x#2#2", "r/x#3", "r/x#2#3"])
        self.good("n.json", "--previous", "out.json", "-o", "again.json")
        (self.folder / "t.csv").write_bytes(b"id,parent,name,value\nr,,r,\n\xe9,r,caf\xe9,1\n\xe8,r,b,1\n")
        self.refused("t.csv:3: the id is not valid UTF-8; save the table as UTF-8", 1, "t.csv", "-o", "t.svg")

    def test_empty_rows_of_spreadsheets_are_skipped(self):
        self.write("t.csv", 'id,parent,name,value\nr,,root,\n,,,\na,r,"an ""a""",1\nb,r,b,2\n,,,\n')
        self.good("t.csv", "-o", "t.json")
        self.measured_again("t.csv", "t.json")

    def test_semicolons_with_an_implied_root(self):
        self.write("t.txt", "nodeId;parentId;name;weight\n1;0;a;1\n2;1;b;2.5\n3;1;c;1e-3\n4;0;d;1\n")
        self.good("t.txt", "-o", "t.json")
        self.measured_again("t.txt", "t.json")

    def test_folder(self):
        (self.folder / "scan" / "sub").mkdir(parents=True)
        for name, size in (("a.bin", 1000), ("sub/b.bin", 3000), ("sub/c.bin", 500), ("empty", 0)):
            (self.folder / "scan" / name).write_bytes(b"x" * size)
        (self.folder / "scan" / "loop").symlink_to(self.folder / "scan")
        self.good("scan", "-o", "s.json")
        values = {row["id"]: row["value"] for row in json.loads((self.folder / "s.json").read_text())}
        self.assertEqual(values, {".": 4500, "a.bin": 1000, "sub": 3500, "sub/b.bin": 3000, "sub/c.bin": 500})

    def test_a_chain_of_only_children_has_one_label(self):
        chain = {"name": "gamma", "children": [{"name": "delta", "value": 1}]}
        chain = {"name": "alpha", "children": [{"name": "beta", "children": [chain]}]}
        self.write("t.json", json.dumps({"name": "top", "children": [chain, {"name": "other", "value": 1}]}))
        self.good("t.json", "-o", "t.svg")
        labels = re.findall(r"<text[^>]*>([^<]*)</text>", (self.folder / "t.svg").read_text(encoding="utf-8"))
        self.assertEqual(sorted(labels), ["alpha", "other"])

    def test_a_long_chain_is_drawn_once(self):
        groups = "".join(f"g{k},{f'g{k - 1}' if k > 0 else 'top'},\n" for k in range(1000))
        self.write("t.csv", f"id,parent,value\ntop,,\nother,top,3\n{groups}leaf,g999,1\n")
        self.good("t.csv", "-o", "t.svg")
        picture = (self.folder / "t.svg").read_text(encoding="utf-8")
        self.assertLess(len(picture), 100_000)
        self.assertEqual(len(re.findall("<path ", picture)), 4)  # both leaves, the group around 'leaf', and all

    def test_update_stays_close(self):
        rows = made_rows(300)
        self.table("t.csv", rows)
        self.good("t.csv", "-o", "old.json")
        self.good("t.csv", "--previous", "old.json", "-o", "same.json")
        source = random.Random(5)
        changed = [(i, p, n, repr(float(v) * source.uniform(0.9, 1.1)) if v else v) for i, p, n, v in rows]
        self.table("new.csv", changed + [("fresh", "r", "fresh", "5000")])
        self.good("new.csv", "--previous", "old.json", "-o", "new.json")
        self.good("new.csv", "--seed", "9", "-o", "other.json")
        self.measured_again("new.csv", "new.json")
        seeds = [{r["id"]: r["seed"] for r in json.loads((self.folder / f"{name}.json").read_text())}
                 for name in ("old", "same", "new", "other")]

        def moved(other):
            return sum(abs(complex(*p) - complex(*other[i])) for i, p in seeds[0].items() if i in other) / len(seeds[0])
        self.assertLess(moved(seeds[1]), 0.02)
        self.assertLess(moved(seeds[2]), 0.15 * moved(seeds[3]))

    def test_update_keeps_the_colours_of_branches(self):
        def drawn(name, values, *previous):
            rows = [("r", "", "root", "")] + [(i, "r", i, repr(v)) for i, v in values.items()]
            self.table(f"{name}.csv", rows)
            self.good(f"{name}.csv", *previous, "-o", f"{name}.svg", "-o", f"{name}.json")
            text = (self.folder / f"{name}.svg").read_text(encoding="utf-8")
            return {i: re.search(rf'<path[^>]*data-id="{i}"[^>]*fill="([^"]+)"', text).group(1) for i in values}

        first = drawn("first", {"a": 5, "b": 4, "c": 3, "d": 2})
        # Another order of values, one branch gone, one new that is the largest.
        second = drawn("second", {"a": 2, "b": 5, "d": 4, "e": 9}, "--previous", "first.json")
        third = drawn("third", {"e": 1, "d": 2, "b": 3, "a": 4}, "--previous", "second.json")
        self.assertEqual(len(set(first.values())), 4)
        self.assertEqual({i: second[i] for i in "abd"}, {i: first[i] for i in "abd"})
        self.assertEqual(third, second)
        self.assertEqual(len(set(second.values())), 4)
        # Layouts of earlier versions have no hues.
        rows = json.loads((self.folder / "first.json").read_text())
        self.assertEqual([row.pop("hue", None) for row in rows], [None, 0, 1, 2, 3])
        self.write("old.json", json.dumps(rows))
        self.assertEqual(drawn("again", {"a": 5, "b": 4, "c": 3, "d": 2}, "--previous", "old.json"), first)

    def test_update_keeps_the_colours_of_leaves(self):
        def drawn(name, rows, *previous):
            self.table(f"{name}.csv", rows)
            self.good(f"{name}.csv", *previous, "-o", f"{name}.svg", "-o", f"{name}.json")
            text = (self.folder / f"{name}.svg").read_text(encoding="utf-8")
            return dict(re.findall(r'<path[^>]*data-id="([^"]+)"[^>]*fill="([^"]+)"', text))

        rows = [("r", "", "r", "")] + [(f"b{k}", "r", f"b{k}", "") for k in range(6)]
        rows += [(f"n{k}", f"b{k % 6}", f"n{k}", str(1 + k)) for k in range(60)]
        first = drawn("first", rows)
        # Other values, one of them 0, another order, and rows that come and go.
        leaves = [(i, p, n, str((7 * k) % 31)) for k, (i, p, n, _) in enumerate(rows[8:])]
        second = drawn("second", rows[:7] + [("new", "b0", "new", "5")] + leaves[::-1], "--previous", "first.json")
        both = first.keys() & second.keys()
        self.assertGreater(len(both), 50)
        self.assertEqual({i: second[i] for i in both}, {i: first[i] for i in both})

    def fills(self, name):
        text = (self.folder / name).read_text(encoding="utf-8")
        return dict(re.findall(r'<path[^>]*data-id="([^"]+)"[^>]*fill="([^"]+)"', text))

    def legend(self, name):
        text = (self.folder / name).read_text(encoding="utf-8")
        found = re.search(r'<g class="legend".*?</g>', text, re.S)
        return re.findall(r"<text[^>]*>([^<]*)</text>", found[0]) if found else []

    def test_a_colour_column(self):
        rows = "id,parent,name,value,growth,kind,paint\nr,,root,,,,#112233\ng,r,g,,7,old,\n"
        rows += "a,g,a,1,1,new,#abc\nb,g,b,2,,,\nc,r,c,3,-5,new,\nd,r,d,3,,,#00ff00\n"
        self.write("t.csv", rows)
        self.good("t.csv", "--color-by", "growth", "-o", "n.svg", "-o", "n.png", "-o", "n.pdf")
        fills = self.fills("n.svg")
        light = {i: sum(int(f[k:k + 2], 16) for k in (1, 3, 5)) for i, f in fills.items() if f[0] == "#"}
        self.assertTrue(light["c"] < light["a"] < light["b"])  # b has the 7 of its group
        self.assertEqual(fills["d"], "url(#no-value)")
        self.assertEqual(self.legend("n.svg")[0], "growth")
        self.assertIn("no value (1)", self.legend("n.svg"))
        self.good("t.csv", "--color-by", "Kind", "-o", "k.svg")
        fills = self.fills("k.svg")
        self.assertEqual(fills["a"], fills["c"])
        self.assertNotEqual(fills["a"], fills["b"])
        self.assertEqual(self.legend("k.svg"), ["Kind", "new", "old", "no value (1)"])
        self.good("t.csv", "--color-by", "paint", "-o", "p.svg")
        self.assertEqual(self.fills("p.svg"), {"a": "#aabbcc", "b": "#112233", "c": "#112233", "d": "#00ff00"})
        self.good("t.csv", "--color-by", "kind", "--no-legend", "-o", "q.svg")
        self.assertEqual(self.legend("q.svg"), [])
        # The same from JSON, nested and listed, with numbers, booleans and texts.
        leaves = [{"name": "a", "value": 1, "hot": True}, {"name": "b", "value": 2, "hot": "x"}, {"name": "c", "value": 1}]
        self.write("n.json", json.dumps({"name": "r", "children": leaves}))
        self.good("n.json", "--color-by", "hot", "-o", "j.svg")
        self.assertEqual(self.legend("j.svg"), ["hot", "true", "x", "no value (1)"])
        listed = [{"id": "r"}] + [{"id": x, "parent": "r", "value": 1, "t": k} for k, x in enumerate("abcdefg")]
        self.write("l.json", json.dumps(listed))
        self.good("l.json", "--color-by", "t", "-o", "l.svg")
        self.assertEqual(self.legend("l.svg"), ["t", "6", "5", "4", "3", "2", "1", "0"][:1] +
                         sorted(self.legend("l.svg")[1:]))
        self.assertEqual(len(set(self.fills("l.svg").values())), 7)
        # In tables of levels, the colour is no level.
        self.write("v.csv", "land,town,value,sea\nI,Roma,1,yes\nI,Milano,1,no\nF,Paris,2,no\n")
        self.assertIn("from the columns land, town\n", self.good("v.csv", "--color-by", "sea", "-o", "v.svg"))
        fills = self.fills("v.svg")
        self.assertEqual(fills["F/Paris"], fills["I/Milano"])
        self.assertNotEqual(fills["F/Paris"], fills["I/Roma"])

    def test_colour_columns_that_are_refused(self):
        self.write("t.csv", "id,parent,name,value\nr,,root,\na,r,a,1\n")
        svg = ("-o", "t.svg")
        self.refused("there is no such column; the table has id, parent, name, value", 1, "t.csv", "--color-by", "x", *svg)
        self.write("h.csv", "r,,root,\na,r,a,1\n")
        self.refused("h.csv has no header", 1, "h.csv", "--color-by", "x", *svg)
        self.write("n.json", json.dumps({"name": "r", "value": 1}))
        self.refused("no node of n.json has a value in a member of that name", 1, "n.json", "--color-by", "x", *svg)
        self.write("m.json", json.dumps({"name": "r", "value": 1, "x": [1]}))
        self.refused("'r': its colour is neither a string nor a number", 1, "m.json", "--color-by", "x", *svg)
        self.refused("is a folder, which has no columns", 1, ".", "--color-by", "x", *svg)
        rows = "".join(f"{k},r,{k},1,text {k}\n" for k in range(50))
        self.write("w.csv", "id,parent,name,value,c\nr,,root,,\n" + rows)
        self.refused("the column has 50 different texts, of which 40", 1, "w.csv", "--color-by", "c", *svg)
        self.refused("--color-by is for pictures", 2, "t.csv", "--color-by", "name", "-o", "t.json")
        self.refused("--no-legend leaves out", 2, "t.csv", "--no-legend", *svg)
        self.refused("below 200 there is no room", 2, "t.csv", "--color-by", "name", "--size", "150", *svg)

    def test_groups_of_the_second_level_keep_their_shades(self):
        rows = [("r", "", "r", "")] + [(f"b{k}", "r", f"b{k}", "") for k in range(3)]
        rows += [(f"g{k}", f"b{k % 3}", f"g{k}", "") for k in range(21)]
        rows += [(f"n{k}", f"g{k % 21}", f"n{k}", str(1 + k % 13)) for k in range(120)]
        self.table("t.csv", rows)
        self.good("t.csv", "-o", "first.json", "-o", "first.svg")
        shades = {r["id"]: r["shade"] for r in json.loads((self.folder / "first.json").read_text()) if "shade" in r}
        self.assertEqual(set(shades), {f"g{k}" for k in range(21)})
        self.table("t.csv", rows[:4] + rows[:3:-1])
        self.good("t.csv", "--previous", "first.json", "-o", "second.json", "-o", "second.svg")
        self.assertEqual({r["id"]: r["shade"] for r in json.loads((self.folder / "second.json").read_text())
                          if "shade" in r}, shades)
        self.assertEqual(self.fills("second.svg"), self.fills("first.svg"))

    def test_own_values_of_groups_that_are_not_used_are_reported(self):
        group = {"name": "g", "value": 10, "children": [{"name": "a", "value": 1}, {"name": "b", "value": 5}]}
        tree = {"name": "r", "children": [group, {"name": "c", "value": 3}]}
        self.write("t.json", json.dumps(tree))
        says = "the own values of 1 group differ and are not used: 'r/g' has 10, its leaves 6"
        self.assertIn(says, self.good("t.json", "-o", "out.json"))
        self.assertIn(says, self.good("t.json", "-o", "out.json", "--json"))
        self.measured_again("t.json", "out.json")
        group["value"] = 6
        self.write("t.json", json.dumps(tree))
        self.assertNotIn("own values", self.good("t.json", "-o", "out.json"))
        self.assertNotIn("own values", self.good("out.json", "-o", "again.json"))

    def test_several_roots_are_held_by_one(self):
        self.write("t.csv", "id,parent,name,value\na,,a,1\nb,,b,2\nc,b,c,2\n")
        self.assertIn("2 rows have no parent; a root holds them", self.good("t.csv", "-o", "out.json"))
        rows = {row["id"]: row for row in json.loads((self.folder / "out.json").read_text())}
        self.assertEqual({i: (r.get("parent"), r["value"]) for i, r in rows.items() if i != "0"},
                         {"a": ("0", 1), "b": ("0", 2), "c": ("b", 2)})
        self.assertEqual((rows["0"]["name"], rows["0"]["value"]), ("t.csv", 3))

    def areas(self, text, note, *options):
        self.write("t.csv", text)
        self.assertIn(note, self.good("t.csv", *options, "-o", "out.json"))
        rows = json.loads((self.folder / "out.json").read_text())
        whole = shapely.geometry.Polygon(rows[[r.get("parent") or "" for r in rows].index("")]["polygon"]).area
        return {r["id"]: (r.get("parent") or "", r["name"],
                          round(shapely.geometry.Polygon(r["polygon"]).area / whole, 5)) for r in rows}

    def test_tables_without_parents(self):
        # Names and values, with a comma, a point and a slash in names.
        got = self.areas('name,value\n"St. Gallen",1\n"A/B",3\n', "2 rows have no parent")
        self.assertEqual(got, {"St. Gallen": ("0", "St. Gallen", .25), "A/B": ("0", "A/B", .75),
                               "0": ("", "t.csv", 1)})
        # Paths as in the examples of d3: points with a row for each group, slashes with or without.
        flare = {"f": ("", "f", 1), "f.a": ("f", "a", .75), "f.a.x": ("f.a", "x", .25), "f.a.y": ("f.a", "y", .5),
                 "f.b": ("f", "b", .25)}
        got = self.areas("id,value\nf,\nf.a,\nf.a.x,1\nf.a.y,2\nf.b,1\n", "ids are taken as paths separated by '.'")
        self.assertEqual(got, flare)
        got = self.areas("id,value\nf/a/x,1\nf/a/y,2\nf/b,1\n", "ids are taken as paths separated by '/'")
        slash = lambda text: text.replace(".", "/")
        self.assertEqual(got, {slash(i): (slash(p), n, a) for i, (p, n, a) in flare.items()})
        # Ids with points but without groups are names.
        got = self.areas("id,value\nx.txt,1\ny.txt,1\n", "2 rows have no parent")
        self.assertEqual(set(got), {"x.txt", "y.txt", "0"})
        # Tidy columns, from the top level down.
        got = self.areas("land,town,value\nI/J,Roma,1\nI/J,Milano,1\nF,Paris,2\n", "from the columns land, town")
        self.assertEqual(got["I%2FJ"], ("0", "I/J", .5))
        self.assertEqual(got["I%2FJ/Roma"], ("I%2FJ", "Roma", .25))
        self.assertEqual(got["F/Paris"], ("F", "Paris", .5))

    def test_columns_of_other_names_hold_the_values(self):
        table = "land,town,people,party,founded\nI,Roma,1,a,753\nI,Milano,1,b,600\nF,Paris,2,a,250\n"
        got = self.areas(table, "from the columns land, town", "--value-column", "People")  # what follows is no level
        self.assertEqual(got["I/Roma"], ("I", "Roma", .25))
        self.assertEqual(got["F"], ("0", "F", .5))
        got = self.areas("people,land,town\n1,I,Roma\n1,I,Milano\n2,F,Paris\n", "from the columns land, town", "--value-column",
                         "people")
        self.assertEqual(got["I/Roma"], ("I", "Roma", .25))
        self.write("t.csv", table)
        self.refused("t.csv:1: 5 fields where 4 are expected (id, parent, name, value); of a header, choose the column of the "
                     "values with --value-column: land, town, people, party, founded", 1, "t.csv", "-o", "t.svg")
        self.refused("--value-column peple: there is no such column; did you mean people?; the table has land,", 1, "t.csv",
                     "--value-column", "peple", "-o", "t.svg")
        self.write("h.csv", "id,parent,people\nr,,\na,r,1\n")
        self.refused("the header has no column value, weight, size or area; choose one of id, parent, people with "
                     "--value-column", 1, "h.csv", "-o", "t.svg")
        self.write("n.json", json.dumps({"name": "r", "children": [{"name": "a", "people": 3}, {"name": "b", "people": 1}]}))
        self.good("n.json", "--value-column", "people", "-o", "n.svg")
        self.refused("no node of n.json has a value in a member of that name; did you mean people?", 1, "n.json", "--value-column", "peple",
                     "-o", "t.svg")
        self.refused("--value-column x: . is a folder", 1, ".", "--value-column", "x", "-o", "t.svg")

    def test_a_line_that_announces_the_separator_is_no_row(self):
        for start in ("", "\ufeff"):
            got = self.areas(start + "sep=;\r\nid;parent;name;value\r\n0;;r;\r\n1;0;a;1\r\n2;0;b;3\r\n", "")
            self.assertEqual(got, {"0": ("", "r", 1), "1": ("0", "a", .25), "2": ("0", "b", .75)})

    def test_refusals_name_the_place_and_leave_nothing(self):
        head = "id,parent,name,value\nr,,root,\n"
        cases = {
            "t.csv:4: 'b' has the parent 'zz', which has no row": head + "a,r,a,1\nb,zz,b,1\n",
            "is among its own ancestors": head + "a,b,a,1\nb,a,b,1\n",
            "t.csv:3: the value of 'a': 'ten' is not a number": head + "a,r,a,ten\n",
            "t.csv:3: the value of 'a': 'nan'": head + "a,r,a,nan\n",
            "t.csv:4: the id 'a' is also that of line 3": head + "a,r,a,1\na,r,a,2\n",
            "t.csv:3: 3 fields where 4 are expected": head + "a,r,1\n",
            "t.csv:3: a quote is opened and never closed": head + 'a,r,"a,1\n',
            "t.csv:3: there is text after a closing quote": head + 'a,r,"a"b,1\n',
            "nothing to lay out": head + "a,r,a,0\n",
            "t.csv:3: the row has no id": head + ",r,a,1\n",
            "the value of 'b' (t.csv:4) is 1e-20 of the sum": head + "a,r,a,1\nb,r,b,1e-20\n",
            "the header has no column value": "id,parent,name\nr,,root\n",
            "has no rows": "id,parent,name,value\n",
        }
        for says, text in cases.items():
            with self.subTest(says=says):
                self.write("t.csv", text)
                self.refused(says, 1, "t.csv", "-o", "t.svg", "-o", "t.json")
        for says, text in {"is not JSON from this line on": '{"name": "a", "children": [',
                           "'a/b': its value \"3\" is not a number": '{"name":"a","children":[{"name":"b","value":"3"}]}',
                           "'a': its children are not a list": '{"name":"a","children":{"name":"b"}}',
                           "element 2: is not an object": '[{"id":1},3]',
                           "the value of '3' (t.json: element 3) is 1e-20":
                           '[{"id":1},{"id":2,"parent":1,"value":1},{"id":3,"parent":1,"value":1e-20}]',
                           "the value of 'a/c' is 1e-20":
                           '{"name":"a","children":[{"name":"b","value":1},{"name":"c","value":1e-20}]}',
                           "neither an object": "3"}.items():
            with self.subTest(says=says):
                self.write("t.json", text)
                self.refused(says, 1, "t.json", "-o", "t.svg")

    def test_an_outline_that_is_concave_by_rounding_only(self):
        self.table("t.csv", made_rows(50))
        ring = [[round(8.5 + .004 * math.cos(k * math.pi / 600), 7), round(47.3 + .002 * math.sin(k * math.pi / 600), 7)]
                for k in range(1200)]
        self.write("round.geojson", json.dumps({"type": "Polygon", "coordinates": [ring + ring[:1]]}))
        self.assertIn("its convex hull is used", self.good("t.csv", "--shape", "round.geojson", "-o", "t.json"))
        self.measured_again("t.csv", "t.json")

    def test_shapes_that_are_refused(self):
        self.table("t.csv", made_rows(5))
        arrow = {"type": "Polygon", "coordinates": [[[0, 0], [2, 1], [0, 2], [1, 1], [0, 0]]]}
        self.write("arrow.geojson", json.dumps(arrow))
        ring = {"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]],
                                                   [[1, 1], [2, 1], [2, 2], [1, 1]]]}
        self.write("ring.geojson", json.dumps(ring))
        self.refused("not convex at (1, 1)", 1, "t.csv", "--shape", "arrow.geojson", "-o", "t.svg")
        self.refused("1 parts, 1 holes", 1, "t.csv", "--shape", "ring.geojson", "-o", "t.svg")
        self.refused("above 0", 1, "t.csv", "--shape", "0:1", "-o", "t.svg")
        self.refused("3 to 10000 corners", 1, "t.csv", "--shape", "circle:2", "-o", "t.svg")
        self.refused("unknown extension of an output file", 2, "t.csv", "-o", "t.svg", "-o", "t.xls")
        self.refused("", 1, "absent.csv", "-o", "t.svg")
        self.refused("--help", 2, "t.csv", "--rounds", "-1", "-o", "t.svg")
        self.refused("is not a list of nodes", 1, "t.csv", "--previous", "arrow.geojson", "-o", "t.svg")

    def refused(self, says, code, *arguments):
        before = sorted(self.folder.rglob("*"))
        done = self.run_tool(*arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(says, done.stderr)
        self.assertTrue(done.stderr.startswith("powercell: error: "), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(sorted(self.folder.rglob("*")), before)


if __name__ == "__main__":
    unittest.main()
