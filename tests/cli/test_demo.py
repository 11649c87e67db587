#!/usr/bin/env python3
"""The demo: its pictures, its page, and the commands on it, which make the same pictures.

usage: test_demo.py PATH_OF_POWERCELL [unittest options]
"""

import html.parser
import json
import os
import pathlib
import re
import shlex
import struct
import tempfile
import unittest

from tool import DATA, TerminalTest

PICTURES = ["italy", "pretzel", "bracket", "treemap", "stipples", "remesh"]
FILES = ["italy.geojson", "pretzel.off", "bracket.mesh", "italy_regions.csv", "photo.png"]
VOID = {"meta", "img", "br"}


class Page(html.parser.HTMLParser):
    """The parts of a page; a tag that is not closed in its order is an error."""

    def __init__(self, text):
        super().__init__()
        self.open, self.images, self.links, self.commands, self.headings, self.figures = [], [], [], [], [], []
        self.text = ""
        self.feed(text)
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag == "img":
            self.images.append(attributes)
        if tag == "a":
            self.links.append(attributes["href"])
        if tag == "h2":
            self.headings.append("")
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag

    def handle_data(self, data):
        self.text += data
        if self.open[-2:] == ["pre", "code"]:
            self.commands.append(data)
        if self.open[-1:] == ["h2"]:
            self.headings[-1] += data
        if self.open[-1:] == ["dd"]:
            self.figures.append(data)


class Demo(TerminalTest):
    @classmethod
    def setUpClass(cls):
        """One run with nothing in the caches, on a terminal."""
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.home = pathlib.Path(folder.name)
        cls.made = cls.home / "powercell-demo"
        test = cls("test_the_page")
        test.folder = cls.home
        caches = {"POCL_CACHE_DIR": str(cls.home / "pocl"), "POWERCELL_CACHE_DIR": str(cls.home / "own"), "POWERCELL_LOG": ""}
        with open(cls.home / "out", "w+") as out:
            cls.shown = test.on_terminal("demo", env=caches, stdout=out)
            out.seek(0)
            cls.out = out.read()
        cls.lines = test.check_bar(cls.shown)
        cls.page = Page((cls.made / "index.html").read_text())
        # Another one, with the kernels that are there, beside the documents.
        test.folder = cls.elsewhere = cls.home / "elsewhere"
        (cls.elsewhere / "docs").mkdir(parents=True)
        cls.documents = {path.name: path.read_text() for path in (DATA.parents[1] / "docs").glob("*.md")}
        for name in ["README.md"] + [f"docs/{name}" for name in cls.documents]:
            (cls.elsewhere / name).write_text("")
        cls.again = test.report("demo", "-o", os.fsdecode(b"\xff"))

    def test_what_is_printed(self):
        for name in PICTURES:
            self.assertRegex(self.out, rf"(?m)^{name} +\S")
        self.assertEqual(self.out.count("sum of measures / domain = 1"), 3)
        self.assertRegex(self.out.splitlines()[-1], r"^Open powercell-demo/index\.html$")

    def test_compiling_is_shown_as_it_happens(self):
        told = [re.search(r"compiling kernels, (\d+) of (\d+), once for (\S+)", line) for line in self.lines]
        told = [(int(match[1]), int(match[2])) for match in told if match]
        if not told and "kernels were compiled" not in self.out:
            self.skipTest("a fast machine")
        self.assertEqual(told, sorted(told))
        self.assertEqual({whole for _, whole in told}, {told[-1][1]})
        # As many as there are: known before, and counted when all are compiled; loading those of powercell's own cache, where
        # the driver has none, does not count.
        kept = any((self.home / "own").glob("*.clbin"))
        self.assertEqual(self.again["programs"], 0 if kept else told[-1][1])
        self.assertGreater(told[-1][0], told[-1][1] / 2)

    def test_the_inputs_are_those_of_the_examples(self):
        for name in FILES:
            self.assertEqual((self.made / name).read_bytes(), (DATA / name).read_bytes())

    def test_the_page(self):
        self.assertEqual([image["src"] for image in self.page.images], [name + ".png" for name in PICTURES])
        for image in self.page.images:
            data = (self.made / image["src"]).read_bytes()
            self.assertGreater(len(data), 20000)
            self.assertEqual((int(image["width"]), int(image["height"])), struct.unpack(">II", data[16:24]))
            self.assertGreater(len(image["alt"]), 20)
        self.assertEqual(len(set(self.page.headings)), len(PICTURES))
        for link in self.page.links:
            self.assertTrue((self.made / link).exists(), link)
        text = (self.made / "index.html").read_text()
        self.assertNotRegex(text, r"https?://|<script|@import|url\(")  # nothing from elsewhere
        self.assertIn('name="viewport" content="width=device-width, initial-scale=1"', text)
        self.assertIn("radius √w", self.page.text)  # what the discs are
        self.assertEqual(len(self.page.commands), len(PICTURES))

    def test_the_commands_make_the_same_pictures(self):
        for name, command in zip(PICTURES, self.page.commands):
            with self.subTest(name):
                program, *words = shlex.split(command)
                self.assertEqual(program, "powercell")
                self.assertEqual(words[-2:], ["-o", name + ".png"])
                words[-1] = str(self.folder / "again.png")
                before, self.folder = self.folder, self.made
                report = self.report(*words)
                self.folder = before
                self.assertEqual((self.folder / "again.png").read_bytes(), (self.made / f"{name}.png").read_bytes())
                if "hidden" in report:
                    line = next(line for line in self.out.splitlines() if line.startswith(name))
                    self.assertIn(f"{report['cells']} cells, {report['hidden']} hidden", line)
                    self.assertGreater(report["hidden"], 0)

    def test_the_same_again(self):
        self.assertEqual([picture["name"] for picture in self.again["pictures"]], PICTURES)
        self.assertTrue(self.again["open"].startswith("\ufffd"))
        for name in PICTURES:
            self.assertEqual((self.elsewhere / os.fsdecode(b"\xff") / f"{name}.png").read_bytes(),
                             (self.made / f"{name}.png").read_bytes())

    def test_links_to_the_documents_where_they_are(self):
        self.assertNotIn("docs/guide.md", (self.made / "index.html").read_text())
        folder = self.elsewhere / os.fsdecode(b"\xff")
        links = [link for link in Page((folder / "index.html").read_text()).links if ".md" in link]
        self.assertGreater(len(links), 8)
        for link in links:
            path, _, section = link.partition("#")
            self.assertTrue((folder / path).exists(), link)
            headings = [re.sub(r"[^\w -]", "", h).strip().lower().replace(" ", "-")
                        for h in re.findall(r"(?m)^#+ (.*)$", self.documents.get(pathlib.Path(path).name, ""))]
            if section:
                self.assertIn(section, headings)

    def test_a_folder_that_cannot_be_created(self):
        self.write("taken", "")
        self.bad(1, "taken", "demo", "-o", "taken")


if __name__ == "__main__":
    unittest.main(verbosity=1)
