"""Helpers for the tests of the tool: running it in a temporary folder, and checking its errors.

A script that imports this has the path of the tool as its first argument.
"""

import ast
import csv
import dataclasses
import json
import os
import pathlib
import pty
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

TOOL = pathlib.Path(sys.argv.pop(1)).resolve()
DATA = pathlib.Path(__file__).resolve().parents[2] / "examples" / "data"
ALL_INPUTS = "POWERCELL_TEST_ALL" in os.environ  # tests/README.md, "Time"
SHAPES = {"italy.geojson": 2, "pretzel.off": 3, "bracket.mesh": 3}


def run(*arguments, cwd=None, env=None, timeout=300):
    return subprocess.run([TOOL, *map(str, arguments)], cwd=cwd, timeout=timeout, text=True,
                          stdin=subprocess.DEVNULL, capture_output=True,
                          env={**os.environ, **(env or {})})


def interrupt(process, seconds):
    """Sends SIGINT that many seconds after the tool has set its handler, which takes a while on a busy machine."""
    status = pathlib.Path(f"/proc/{process.pid}/status")
    while process.poll() is None:
        if int(re.search(r"^SigCgt:\s*(\w+)", status.read_text(), re.M)[1], 16) >> (signal.SIGINT - 1) & 1:
            break
        time.sleep(0.01)
    time.sleep(seconds)
    process.send_signal(signal.SIGINT)


def png(rows, bits=8):
    """A gray picture with these numbers in the file."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    code = ">H" if bits == 16 else ">B"
    data = b"".join(b"\0" + b"".join(struct.pack(code, v) for v in row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), bits, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))


def npy(rows):
    """An array of numbers in a file of NumPy."""
    header = f"{{'descr': '<f8', 'fortran_order': False, 'shape': ({len(rows)}, {len(rows[0]) if rows else 4}), }}"
    header += " " * (-(len(header) + 11) % 64) + "\n"
    return (b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode() +
            b"".join(struct.pack(f"<{len(row)}d", *row) for row in rows))


def read_npy(path):
    """The rows of an array of one dimension."""
    data = path.read_bytes()
    size = struct.unpack_from("<H", data, 8)[0]
    assert data[:8] == b"\x93NUMPY\x01\x00" and (10 + size) % 64 == 0
    header = ast.literal_eval(data[10:10 + size].decode())
    codes = {"|u1": "B", "<u4": "I", "<i4": "i", "<i8": "q", "<f8": "d"}
    types = header["descr"]
    form = "<" + "".join(codes[t] for _, t in types) if isinstance(types, list) else "<" + codes[types]
    rows = list(struct.iter_unpack(form, data[10 + size:]))
    assert (len(rows),) == header["shape"] and not header["fortran_order"]
    return rows if isinstance(types, list) else [row[0] for row in rows]


@dataclasses.dataclass
class Option:
    """An option as --help shows it: "-o, --output FILE" and its text."""
    title: str
    text: str

    @property
    def names(self):
        return re.findall(r"(?<!\S)--?[a-z][a-z-]*", self.title)

    @property
    def value(self):
        """The placeholder of its value; empty for a flag."""
        last = self.title.split(", ")[-1]
        return last.split(" ", 1)[1] if " " in last else ""


class ToolTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def good(self, *arguments, **options):
        done = run(*arguments, cwd=self.folder, **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def report(self, *arguments, **options):
        return json.loads(self.good(*arguments, "--json", **options).stdout)

    def bad(self, code, pattern, *arguments, **options):
        """Fails with `code` and one printable line that matches `pattern`, and leaves no file."""
        before = sorted(self.folder.rglob("*"))
        done = run(*arguments, cwd=self.folder, **options)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertTrue(done.stderr.startswith("powercell: error: "), done.stderr)
        self.assertRegex(done.stderr, pattern)
        self.assertTrue(done.stderr[:-1].isprintable() and done.stderr.endswith("\n"), repr(done.stderr))
        self.assertLess(len(done.stderr), 1000)
        self.assertEqual(done.stdout, "")
        self.assertEqual(sorted(self.folder.rglob("*")), before)
        return done

    def commands(self):
        listed = self.good("--help").stdout.split("\nCommands:\n")[1].split("\n\n")[0]
        return re.findall(r"^  ([a-z]\S*)", listed, re.M)

    def options(self, command):
        """The options of a command, as its help lists them."""
        found = []
        shown = self.good(command, "--help").stdout
        for line in shown.split("\nExamples:\n")[0].splitlines():
            if line.startswith("  -"):
                title, _, text = line[2:].partition("  ")
                found.append(Option(title, text.strip()))
            elif found and line.startswith(" " * 28):
                found[-1].text = (found[-1].text + " " + line.strip()).strip()
        return found

    def rows(self, name):
        with (self.folder / name).open() as file:
            return list(csv.DictReader(file))

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def image(self, name, rows, bits=8):
        (self.folder / name).write_bytes(png(rows, bits))
        return name


class TerminalTest(ToolTest):
    """Runs whose standard error is a terminal."""

    def on_terminal(self, *arguments, env=None, code=0, stdout=None):
        """What a run with that exit code shows on a terminal as its standard error."""
        ours, theirs = pty.openpty()
        start = time.monotonic()
        process = subprocess.Popen([TOOL, *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=stdout or subprocess.DEVNULL, stderr=theirs, env={**os.environ, **(env or {})})
        os.close(theirs)
        shown = b""
        while True:
            try:
                more = os.read(ours, 1 << 16)
            except OSError:  # how a pseudo terminal ends
                break
            shown += more
        os.close(ours)
        self.assertEqual(process.wait(), code, shown.decode())
        self.seconds = time.monotonic() - start
        return shown.decode()

    def check_bar(self, shown):
        # PoCL's compiler prints how many warnings it has kept to itself.
        shown = re.sub(r"\d+ warnings? generated\.\r?\n", "", shown)
        lines = [line for line in shown.split("\r") if line.strip()]
        if not lines:
            self.assertLess(self.seconds, 1.5)  # a fast machine
            return []
        percents = []
        for line in lines:
            self.assertRegex(line, r"^\[[= ]{24}\] [ \d]{3} %  \w")
            self.assertLess(len(line), 80)
            percents.append(int(re.search(r"(\d+) %", line)[1]))
        self.assertEqual(percents, sorted(percents))
        self.assertEqual(percents[-1], 100)
        self.assertRegex(shown, r"\r *\r$")  # erased
        return lines
