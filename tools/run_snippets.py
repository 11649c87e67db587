#!/usr/bin/env python3
"""Runs the code in the documents: each fenced block of C++, C, Python and shell in README.md, docs/ and docs/site/.

usage: run_snippets.py [PAGE.md...] [--build build/release] [--work build/snippets] [--jobs N]

Needs a built library and tool, and runs in a Python that has the package (python/tests/run.sh makes one). Fails with the
place of each block that fails, of each file that a block should have written (-o, --table, ...) or that its page shows
(`/made/PAGE/FILE`) and that is not there or no picture, and of each command that is hidden from it in an indented block.

- A page's blocks run in its order in one folder, WORK/PAGE, where the repository's folders are found.
- A block of C or C++ without main() is a part of one, after `powercell::Device device = ...`.
- Blocks that only install are not run, and those after a comment of one line: <!-- not run: the reason -->.
- A block of Python sees the names of the one before after <!-- continues -->.
- bench/coming_from.py and python/tests/run.sh run what is in docs/coming_from.md and python/README.md.
"""

import argparse
import concurrent.futures
import dataclasses
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
RUN = {"cpp", "c", "python", "sh"}
TEXT = {"text", "json", "cmake", "bibtex"}
ELSEWHERE = {"docs/coming_from.md": "bench/coming_from.py"}
INSTALLERS = re.compile(r"(\./setup\.sh|pip3? install|(sudo )?apt(-get)? |git clone|cd )")
COMMANDS = re.compile(r"    (powercell|\./setup|bench/|cmake|build/|ctest|tools/|bundle/|python3?|pip3?|apt-get|sudo|export) ?\S")
OUTPUTS = {"-o", "--output", "--table", "--walls", "--log", "--analysis", "--report", "--cells", "--json-file"}
LIMIT = 300  # seconds for one block

# Compiled once, before all blocks of C++.
CPP_HEADER = """#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <powercell/powercell.hpp>
#include <vector>
"""
CPP_PART = """int main() {
  [[maybe_unused]] const powercell::Device device = powercell::Device::choose();
#line %d "%s"
%s
}
"""


@dataclasses.dataclass
class Block:
    page: pathlib.Path
    line: int  # of its first line of code
    language: str
    code: str
    reason: str = ""  # why it is not run
    continues: bool = False

    @property
    def place(self):
        return f"{self.page.relative_to(ROOT)}:{self.line}"


def words_before(lines, number):
    """The comment before a fence."""
    while number > 0 and not lines[number - 1].strip():
        number -= 1
    return lines[number - 1].strip() if number else ""


def blocks_of(page, faults):
    """The blocks to run, and those that are marked not to be."""
    lines = page.read_text().split("\n")
    fence, found = None, []
    for number, line in enumerate(lines):
        if fence is None:
            start = re.fullmatch(r"```(\w*|\{.*)", line)
            if start:
                fence = (number, start[1])
            elif COMMANDS.match(line):
                faults.append(f"{page.relative_to(ROOT)}:{number + 1}: a command in an indented block, which nobody runs; fence it")
        elif line == "```":
            begin, language = fence
            fence = None
            if language not in RUN | TEXT and not language.startswith("{"):  # a directive of the site
                faults.append(f"{page.relative_to(ROOT)}:{begin + 1}: a block in '{language}', which nobody runs")
            if language not in RUN:
                continue
            code = "\n".join(lines[begin + 1 : number]) + "\n"
            before = words_before(lines, begin)
            mark = re.fullmatch(r"<!-- not run: (.+) -->", before)
            reason = mark[1] if mark else installs_only(language, code)
            found.append(Block(page, begin + 2, language, code, reason, before == "<!-- continues -->"))
    if fence is not None:
        faults.append(f"{page.relative_to(ROOT)}:{fence[0] + 1}: the block does not end")
    return found


def installs_only(language, code):
    lines = [line for line in code.split("\n") if line.strip() and not line.startswith((" ", "#"))]
    return "it installs" if language == "sh" and all(INSTALLERS.match(line) for line in lines) else ""


class Page:
    """The blocks of a page and the folder where they run."""

    def __init__(self, path, blocks, work, environment):
        self.path, self.blocks, self.environment, self.faults = path, blocks, environment, []
        relative = path.relative_to(ROOT).with_suffix("")
        self.name = "-".join(part for part in relative.parts if part not in ("docs", "site")) or relative.stem
        self.folder = work / self.name

    def prepare(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        for entry in ROOT.iterdir():
            if entry.is_dir() and entry.name != ".git":
                (self.folder / entry.name).symlink_to(entry)

    def call(self, block, command, **more):
        """Whether the command succeeded; its output is part of the fault."""
        try:
            done = subprocess.run(command, cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  stdin=subprocess.DEVNULL, text=True, timeout=LIMIT, **more)
        except subprocess.TimeoutExpired:
            self.faults.append(f"{block.place}: it takes more than {LIMIT} s")
            return False
        if done.returncode:
            self.faults.append(f"{block.place}: exit status {done.returncode}\n{done.stdout[-3000:].rstrip()}")
        return done.returncode == 0

    def program(self, block):
        return self.folder / f"line-{block.line}"

    def compile(self, block, flags):
        if block.language == "cpp" and not re.search(r"\bint main\(", block.code):
            code = CPP_PART % (block.line, self.path, block.code)
        else:
            code = f'#line {block.line} "{self.path}"\n{block.code}'
            if "#include <powercell" not in code:
                self.faults.append(f"{block.place}: a program that does not include powercell")
        source = self.program(block).with_suffix("." + block.language)
        source.write_text(code)
        self.call(block, [*compiler(block.language), str(source), "-o", str(self.program(block)), *flags[block.language]])

    def run(self):
        for block in self.blocks:
            if block.reason:
                continue
            if block.language == "sh":
                if self.call(block, ["sh", "-eu", "-c", block.code]):
                    self.check_outputs(block)
            elif block.language != "python" and self.program(block).exists():
                self.call(block, [str(self.program(block))])
        self.run_python()
        self.check_pictures()

    def run_python(self):
        """All blocks of Python in one process, with names of their own."""
        blocks = [block for block in self.blocks if block.language == "python" and not block.reason]
        if not blocks:
            return
        program = ["import warnings; warnings.simplefilter('error')"]
        for block in blocks:
            if not block.continues or block is blocks[0]:
                program.append("names = {'__name__': '__main__'}")
            lines = "\n" * (block.line - 1) + block.code
            program.append(f"exec(compile({lines!r}, {str(self.path)!r}, 'exec'), names)")
        (self.folder / "blocks.py").write_text("\n".join(program) + "\n")
        self.call(blocks[0], [sys.executable, "blocks.py"])

    def check_outputs(self, block):
        for command in re.sub(r"\\\n", " ", block.code).split("\n"):
            try:
                words = shlex.split(command, comments=True)
            except ValueError:
                continue  # a part of a text of several lines
            if "powercell" not in words[:1]:
                continue
            for option, name in zip(words, words[1:]):
                if option in OUTPUTS and name != "-":
                    self.check_file(block.place, name)

    def check_file(self, place, name):
        path = self.folder / name
        start = path.read_bytes()[:200] if path.is_file() and not path.is_symlink() else b""
        signature = {".png": b"\x89PNG\r\n", ".pdf": b"%PDF", ".svg": b"<svg"}.get(path.suffix, b"")
        if not start or signature not in start:
            self.faults.append(f"{place}: {name} was not written")

    def check_pictures(self):
        for number, line in enumerate(self.path.read_text().split("\n")):
            for page, name in re.findall(r"/made/([\w-]+)/([\w.-]+)", line):
                if page != self.name:
                    self.faults.append(f"{self.path.relative_to(ROOT)}:{number + 1}: pictures of this page are /made/{self.name}/...")
                else:
                    self.check_file(f"{self.path.relative_to(ROOT)}:{number + 1}", name)


def compiler(language):
    common = ["-O0", "-Wall", "-Wextra", "-Werror"]
    if language == "c":
        return [os.environ.get("CC", "cc"), "-std=c99", "-pedantic", *common]
    return [os.environ.get("CXX", "c++"), "-std=c++20", *common]


def install(build, work):
    """Installs the build, as users find it, and returns the environment and the flags that programs need to find it."""
    prefix = work / "prefix"
    shutil.rmtree(prefix, ignore_errors=True)
    subprocess.run(["cmake", "--install", build, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
    packages = next(prefix.rglob("pkgconfig"))
    libraries = packages.parent
    environment = dict(os.environ)
    environment.update(PATH=f"{prefix / 'bin'}:{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}", MPLBACKEND="agg",
                       PKG_CONFIG_PATH=str(packages), LD_LIBRARY_PATH=str(libraries), CMAKE_PREFIX_PATH=str(prefix), PYVISTA_OFF_SCREEN="true")
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", "powercell"], env=environment, check=True, stdout=subprocess.PIPE,
                           text=True).stdout.split()
    header = work / "blocks.hpp"
    header.write_text(CPP_HEADER)
    subprocess.run([*compiler("cpp"), "-x", "c++-header", header, "-o", f"{header}.gch", f"-I{prefix / 'include'}"], check=True)
    return environment, {"c": [*flags, "-lm"], "cpp": ["-include", str(header), *flags]}


def leave_out_repeated(pages):
    """Of blocks of shell that are the same on several pages the first is run."""
    first = {}
    for page in pages:
        for block in page.blocks:
            if block.language == "sh" and not block.reason:
                earlier = first.setdefault(block.code, block)
                if earlier is not block:
                    block.reason = f"the same as {earlier.place}"


def state_of_repository():
    """The files that git sees changed, to find blocks that write into the repository."""
    done = subprocess.run(["git", "-C", ROOT, "status", "--porcelain"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return set(done.stdout.split("\n"))


def pages_of(arguments):
    if arguments:
        return [page.resolve() for page in arguments]
    return [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), *sorted((ROOT / "docs" / "site").rglob("*.md"))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "build" / "snippets")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    begin = time.monotonic()
    work = arguments.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    faults, pages, before = [], [], state_of_repository()
    environment, flags = install(arguments.build, work)
    for path in pages_of(arguments.pages):
        if str(path.relative_to(ROOT)) in ELSEWHERE:
            continue
        blocks = blocks_of(path, faults)
        pages.append(Page(path, blocks, work, environment))
        pages[-1].prepare()
    leave_out_repeated(pages)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        programs = [(page, block) for page in pages for block in page.blocks if block.language in ("c", "cpp") and not block.reason]
        list(pool.map(lambda program: program[0].compile(program[1], flags), programs))
        list(pool.map(Page.run, pages))
    for page in pages:
        faults += page.faults
    faults += [f"changed in the repository while the blocks ran: {change[3:]}" for change in sorted(state_of_repository() - before)]
    blocks = [block for page in pages for block in page.blocks]
    for block in blocks:
        if block.reason:
            print(f"{block.place}: not run: {block.reason}")
    print("\n".join(faults) or f"run_snippets: {sum(not block.reason for block in blocks)} blocks of {len(pages)} pages run, "
          f"in {time.monotonic() - begin:.0f} s")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
