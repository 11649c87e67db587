#!/usr/bin/env python3
"""Holds docs/interfaces.md to the truth: its tables name every public function, type and member of the C++ headers, no
other, and each with a twin in C and in Python or the reason why there is none. Twins in C are in tests/c_abi/abi.txt or are
functions of powercell_mpi.h, which no library has; those in Python in the package or its bindings.

usage: tests/interfaces/check.py"""
import pathlib
import re
import sys

from cpp_headers import public_names

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCUMENT = ROOT / "docs/interfaces.md"
ABI = (ROOT / "tests/c_abi/abi.txt").read_text()
IN_HEADERS = re.findall(r"^static inline [\w ]+\b(pc_mpi_\w+)\(", (ROOT / "include/powercell_mpi.h").read_text(), flags=re.M)
faults = []


def tables():
    """{(header, C++ name): (C, Python)} of the document."""
    rows, header = {}, None
    for number, line in enumerate(DOCUMENT.read_text().splitlines(), 1):
        heading = re.fullmatch(r"## powercell/(\w+\.hpp)", line)
        header = heading[1] if heading else header
        row = re.fullmatch(r"\| `([\w:]+)` \| (.+) \| (.+) \|", line)
        if row and header:
            if (header, row[1]) in rows:
                faults.append(f"line {number}: {row[1]} is there twice")
            rows[header, row[1]] = row[2], row[3]
        elif line.startswith("|") and header and not re.match(r"\| C\+\+ |\|-", line):
            faults.append(f"line {number}: not a row of a name, C and Python: {line}")
    return rows


def struct_members():
    members, current = {}, None
    for line in ABI.splitlines():
        struct = re.match(r"struct (\w+)", line)
        if not line.startswith("  "):
            current = members.setdefault(struct[1], set()) if struct else None
        elif current is not None:
            current.add(re.search(r"(\w+)(\[\w+\])*$", line)[1])
    return members


MEMBERS = struct_members()
SOURCES = {
    path: path.read_text()
    for folder, ends in (("python/powercell", ".py .pyi"), ("python/src", ".cpp .hpp"))
    for path in sorted((ROOT / folder).iterdir())
    if path.suffix in ends.split()
}


def c_fault(twin):
    struct, _, member = twin.partition(".")
    if member:
        return None if member in MEMBERS.get(struct, ()) else "no such member in tests/c_abi/abi.txt"
    return None if struct in IN_HEADERS or re.search(rf"\b{struct}\b", ABI) else "not in tests/c_abi/abi.txt"


def python_fault(twin):
    """`Class.member`, `function(argument=)`: the file that defines the first name, of the package or else of the
    bindings, defines the others too."""
    first, *others = re.findall(r"\w+", twin.removeprefix("len"))
    defines = rf"^(class|def) {first}\b|^{first}\b.*=|nb::class_<[\w:]+>\(m, \"{first}\""
    files = [path for path, text in SOURCES.items() if re.search(defines, text, flags=re.M)]
    package = [path for path in files if path.parent.name == "powercell"]
    for path in package or files:
        if all(defines_member(SOURCES[path], other) for other in others):
            return None
    return "not in python/powercell or python/src"


def defines_member(text, name):
    ways = rf"def {name}\b|self\.{name}\b|\"{name}\"|VECTOR\((\w+, )?{name}\)|\b{name}(:| =) "
    return re.search(ways, text)


def check(name, language, cell, fault_of):
    if cell.startswith("- "):
        if len(cell) < len("- not yet"):
            faults.append(f"{name}: no reason why {language} has no twin")
        return
    twins = re.findall(r"`([^`]+)`", cell)
    if not twins:
        faults.append(f"{name}: neither a twin nor a reason (- ...) for {language}: {cell}")
    for twin in twins:
        fault = fault_of(twin)
        if fault:
            faults.append(f"{name}: {twin}: {fault}")


def check_parser(headers):
    """Functions that a plain search finds are among the names, so that none is lost by the parser."""
    for header, names in headers.items():
        text = re.sub(r"//.*", "", (ROOT / "include/powercell" / header).read_text())
        functions = re.findall(r"POWERCELL_API [^;{()=]*?\b(\w+)\(", text)
        functions += re.findall(r"^  (?:static )?(?:const )?[\w:<>]+[&*]? (\w+)\([^;{]*\)(?: const)?;", text, flags=re.M)
        short = {name.split("::")[-1] for name in names} | {name for name in functions if name.isupper()}  # macros
        faults.extend(f"{header}: {name} was not parsed" for name in functions if name not in short | {"__attribute__"})


headers = public_names(ROOT)
check_parser(headers)
rows = tables()
expected = {(header, name) for header, names in headers.items() for name in names}
faults.extend(f"{header}: {name} is not in docs/interfaces.md" for header, name in sorted(expected - rows.keys()))
faults.extend(f"{header}: {name} is in docs/interfaces.md only" for header, name in sorted(rows.keys() - expected))
for (_, name), (c, python) in rows.items():
    check(name, "C", c, c_fault)
    check(name, "Python", python, python_fault)
if len(expected) < 400:
    faults.append(f"only {len(expected)} names were found in the headers")
print("\n".join(faults) or f"interfaces: {len(expected)} names of C++, their twins are there")
sys.exit(1 if faults else 0)
