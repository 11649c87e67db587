#!/usr/bin/env python3
"""Lays out the sources of the site: the pages of the repository in one tree, and generated pages of the reference.

usage: assemble.py SOURCES SNIPPETS     SNIPPETS: the folder of tools/run_snippets.py, which has the pictures and the tool

Pages of docs/, docs/site/ and some others go to the places of `places`; relative links are turned to these. Links to headers go to
the reference, those to other files to copies, and those to folders become plain text. Formulas are set, and citations of
their numbers become links.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

import formulas
import powercell

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
OTHERS = {
    "CHANGELOG.md": "changelog.md",
    "CONTRIBUTING.md": "contributing.md",
    "README.md": "readme.md",
    "THIRD_PARTY.md": "third_party.md",
    "bench/paper/README.md": "paper.md",
    "examples/data/README.md": "data.md",
    "packaging/README.md": "packaging.md",
    "python/README.md": "python.md",
    "tests/README.md": "tests.md",
}
LINK = re.compile(r'(?P<image>!?)\[(?P<text>(?:[^\[\]]|\[[^\]]*\])*)\]\((?P<target>[^)\s]+)\)|(?P<attribute>src|href)="(?P<value>[^"]+)"')
CITATION = re.compile(r"(?<![\w\])])\((\d\d?[a-h]?)\)")


def places():
    """The pages of the repository, and where they go in the tree."""
    result = dict(OTHERS)
    for page in sorted((ROOT / "docs").rglob("*.md")):
        inside = page.relative_to(ROOT / "docs")
        result[f"docs/{inside}"] = str(inside.relative_to("site") if inside.parts[0] == "site" else inside)
    for header in (ROOT / "include").rglob("*.h*"):
        name = str(header.relative_to(ROOT / "include"))
        result[f"include/{name}"] = reference_of(name)
    return result


def reference_of(header):
    """The page of a header: powercell/c/domain.h, powercell/domain.hpp, powercell.h."""
    stem = pathlib.PurePosixPath(header).stem
    return f"reference/{'c' if header.endswith('.h') else 'cpp'}/{stem}.md"


class Assembly:
    def __init__(self, sources, snippets):
        self.sources, self.snippets, self.places = sources, snippets, places()
        text = (ROOT / "docs" / "mathematics.md").read_text()
        self.numbers = set(re.findall(r"^    \((\d+[a-h]?)\)", text, re.M))
        self.faults = []

    def write(self, name, text):
        path = self.sources / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def page(self, origin, place):
        """Writes a page of the repository."""
        lines, result, fence, prose = (ROOT / origin).read_text().split("\n"), [], "", []

        def end_prose():  # links may be broken over lines
            if prose:
                result.append(self.text("\n".join(prose), origin, place))
                prose.clear()

        number = 0
        while number < len(lines):
            line = lines[number]
            start = re.match(r"(`{3,})", line)
            end = number
            if start and (not fence or line.startswith(fence)):
                fence = "" if fence else start[1]
                end_prose()
                result.append(line)
            elif not fence and origin == "docs/mathematics.md" and re.match(r"    \S", line):
                while end + 1 < len(lines) and re.match(r"    \S", lines[end + 1]):
                    end += 1
                end_prose()
                result.append(formulas.block(lines[number : end + 1]))
            elif fence:
                result.append(line)
            else:
                prose.append(line)
            number = end + 1
        end_prose()
        self.write(place, "\n".join(result))

    def text(self, text, origin, place):
        """Text outside of code. Code spans stay, except formulas of the mathematics."""
        text = LINK.sub(lambda match: self.link(match, origin, place), text)
        if origin == "docs/mathematics.md":
            text = formulas.in_spans(text)
        if origin.startswith("docs/") and not origin.startswith("docs/records/"):
            parts = re.split(r"(`[^`]*`)", text)
            parts[::2] = [CITATION.sub(lambda match: self.citation(match, place), part) for part in parts[::2]]
            text = "".join(parts)
        return text

    def citation(self, match, place):
        if match[1] not in self.numbers:
            return match[0]
        page = os.path.relpath("mathematics.html", os.path.dirname(place) or ".")
        return f'<a class="citation" href="{page}#formula-{match[1]}">({match[1]})</a>'

    def link(self, match, origin, place):
        target = match["target"] or match["value"]
        if re.match(r"[a-z]+:|#", target):
            return match[0]
        path, _, anchor = target.partition("#")
        wanted = os.path.normpath(os.path.join(os.path.dirname(origin), path))
        where = self.moved(wanted, raw=bool(match["attribute"]))
        if where is None:
            if not (ROOT / wanted).is_dir():
                self.faults.append(f"{origin}: the link {target} leads nowhere")
            return match["text"] or match[0]
        new = os.path.relpath(where, os.path.dirname(place) or ".") + ("#" + anchor if anchor else "")
        if match["attribute"]:
            return f'{match["attribute"]}="{new}"'
        return f'{match["image"]}[{match["text"]}]({new})'

    def moved(self, wanted, raw):
        """Where a file of the repository is in the tree; None for folders and what is not there."""
        if wanted in self.places:
            return self.places[wanted]
        origin = ROOT / wanted
        if not origin.is_file():
            return None
        where = os.path.relpath(wanted, "docs") if wanted.startswith("docs/") else f"files/{wanted}"
        copy = self.sources / ("extra" if raw else "") / where
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(origin, copy)
        return where

    def headers(self):
        """A page for each header, from its comments, and their indices."""
        for language, ending in (("cpp", ".hpp"), ("c", ".h")):
            names = sorted(str(header.relative_to(ROOT / "include")) for header in (ROOT / "include").rglob("*" + ending))
            for name in names:
                self.write(reference_of(name), f"# {name}\n\n```{{doxygenfile}} {pathlib.PurePosixPath(name).name}\n```\n")
            pages = "\n".join(pathlib.PurePosixPath(reference_of(name)).stem for name in names)
            self.write(f"reference/{language}/index.md", INDEX[language].format(pages=pages))

    def tool(self):
        """The help of the tool and of each of its commands, as it prints it."""
        program = self.snippets / "prefix" / "bin" / "powercell"

        def help_of(*command):
            done = subprocess.run([program, *command, "--help"], check=True, stdout=subprocess.PIPE, text=True)
            return f"```text\n{done.stdout.strip()}\n```\n"

        top = help_of()
        listed = re.search(r"^(?:SUBCOMMANDS|Subcommands|Commands):\s*\n((?:[ \t]+.*\n|\n(?=[ \t]))+)", top, re.M)
        commands = re.findall(r"^ {2}([a-z]+) ", listed[1], re.M) if listed else []
        if len(commands) < 8:
            self.faults.append(f"reference/tool.md: only these commands are in the tool's help: {commands}")
        text = "# The tool\n\nWhat `powercell --help` and `powercell COMMAND --help` print. Words and formats are explained in\n"
        text += "[the guide](../guide.md#the-tool).\n\n" + top
        for command in commands:
            text += f"\n## powercell {command}\n" + help_of(command)
        self.write("reference/tool.md", text)

    def python(self):
        """Everything in the package's __all__, by autodoc."""
        names = sorted(powercell.__all__, key=str.lower)
        classes = [name for name in names if isinstance(getattr(powercell, name), type)]
        functions = [name for name in names if name not in classes]
        parts = [f"# Python: all names\n\n{PYTHON}"]
        for title, kind, members in (("Functions", "autofunction", functions), ("Classes", "autoclass", classes)):
            parts.append(f"## {title}\n")
            for name in members:
                options = "   :members:\n   :undoc-members:\n" if kind == "autoclass" else ""
                # What a class has from another one of the package is its own to a reader.
                own = getattr(getattr(powercell, name), "__mro__", ())[1:]
                if any(base.__module__.startswith("powercell.") for base in own):
                    options += "   :inherited-members: object\n"
                parts.append(f"### {name}\n\n```{{eval-rst}}\n.. {kind}:: powercell.{name}\n{options}```\n")
        self.write("reference/python.md", "\n".join(parts))

    def made_pictures(self):
        """The pictures that the pages' snippets made."""
        for page in (ROOT / "docs").rglob("*.md"):
            for folder, name in re.findall(r"/made/([\w-]+)/([\w.-]+)", page.read_text()):
                copy = self.sources / "made" / folder / name
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(self.snippets / folder / name, copy)

    def run(self):
        shutil.rmtree(self.sources, ignore_errors=True)
        (self.sources / "extra").mkdir(parents=True)
        (self.sources / "_static").mkdir()
        here = pathlib.Path(__file__).resolve().parent
        for name in ("conf.py", "search.js"):
            shutil.copyfile(here / name, self.sources / name)
        shutil.copyfile(here / "style.css", self.sources / "_static" / "style.css")
        for origin, place in self.places.items():
            if origin.endswith(".md"):
                self.page(origin, place)
        self.headers()
        self.tool()
        self.python()
        self.made_pictures()


PYTHON = """
The package's own words. What there is and how it fits together: [Python](../python.md); the C++ and C twins of each name:
[interfaces](../interfaces.md).
"""

INDEX = {
    "cpp": """# C++ headers

One page for each header, from its comments. `#include <powercell/powercell.hpp>` brings all but `opencl.hpp`, `mpi.hpp` and `regions.hpp`.
Start with [diagram.hpp](diagram.md), [domain.hpp](domain.md) and [results.hpp](results.md).

```{{toctree}}
:maxdepth: 1

{pages}
```
""",
    "c": """# C headers

One page for each header, from its comments. `#include <powercell.h>` brings all but `powercell_opencl.h` and `powercell_mpi.h`; how errors, results and
options come is on the page of [powercell.h](powercell.md).

```{{toctree}}
:maxdepth: 1

{pages}
```
""",
}

if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    assembly = Assembly(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
    assembly.run()
    if assembly.faults:
        sys.exit("\n".join(assembly.faults))
