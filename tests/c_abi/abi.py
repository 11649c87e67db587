#!/usr/bin/env python3
"""Lists what programs in C rely on in binary form: the exported functions with their arguments, the structs with the
offset and size of each member, and the numbers of enumerations.

usage: tests/c_abi/abi.py --cc COMPILER LIBRARY... [--write]
Compares the list with tests/c_abi/abi.txt, or renews that file (--write). Fails too where a library exports another set
of pc_ names than the headers declare."""
import argparse
import difflib
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LISTING = pathlib.Path(__file__).with_name("abi.txt")
HEADERS = [*sorted((ROOT / "include/powercell/c").glob("*.h")), ROOT / "include/powercell_opencl.h"]
SKIP = 77  # for CTest


def declarations(header):
    """The text of a header without comments and directives, in one line."""
    text = re.sub(r"/\*.*?\*/", " ", header.read_text(), flags=re.S)
    text = re.sub(r"^#.*$", "", text, flags=re.M)
    return re.sub(r"\s+", " ", text)


def macros(header):
    """NAME VALUE of the constants of a header."""
    text = re.sub(r"/\*.*?\*/", " ", header.read_text(), flags=re.S)
    return [" ".join(line.split()) for line in re.findall(r"^#define (PC_\w+ .*)$", text, flags=re.M)]


def members(body):
    """(type, name, dimensions) of each member of a struct."""
    for declaration in filter(None, (part.strip() for part in body.split(";"))):
        first, *others = declaration.split(",")
        kind, name, dimensions = re.fullmatch(r"(.*?)(\w+)((?:\[\w+\])*)", first).groups()
        yield kind.strip(), name, dimensions
        for other in others:
            yield kind.strip(), other.strip(), ""


def parse(text):
    structs = [(m[1], list(members(m[2]))) for m in re.finditer(r"typedef struct (\w+) \{(.*?)\} \w+;", text)]
    enums = [(m[1], re.findall(r"\b(PC_\w+)", m[2])) for m in re.finditer(r"typedef enum (\w+) \{(.*?)\}", text)]
    callbacks = [m[0].removeprefix("typedef ") for m in re.finditer(r"typedef [^;{]*\(\*pc_\w+\)\([^;]*\);", text)]
    functions = [m[1] for m in re.finditer(r"POWERCELL_API ([^;]*?\bpc_\w+\([^;]*\));", text)]
    return structs, enums, callbacks, functions


def measured(compiler, structs, enums):
    """Sizes, offsets and numbers, from a program that prints them."""
    lines = []
    for name, all_members in structs:
        lines.append(f'printf("struct {name} %zu\\n", sizeof({name}));')
        for kind, member, dimensions in all_members:
            lines.append(
                f'printf("  %zu+%zu {kind} {member}{dimensions}\\n", offsetof({name}, {member}), '
                f"sizeof((({name}*)0)->{member}));"
            )
    for name, values in enums:
        lines.append(f'printf("enum {name} %zu\\n", sizeof({name}));')
        lines += [f'printf("  {value} %d\\n", (int){value});' for value in values]
    source = "#include <stdio.h>\n#include <powercell.h>\n#include <powercell_opencl.h>\nint main(void) {\n"
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder, "abi")
        program.with_suffix(".c").write_text(source + "\n".join(lines) + "\nreturn 0;\n}\n")
        subprocess.run(
            [compiler, "-std=c99", "-I", ROOT / "include", program.with_suffix(".c"), "-o", program], check=True
        )
        return subprocess.run([program], check=True, capture_output=True, text=True).stdout


def exported(libraries):
    names = set()
    for library in libraries:
        flags = ["-D"] if ".so" in pathlib.Path(library).name else ["-g"]
        table = subprocess.run(["nm", *flags, "--defined-only", library], check=True, capture_output=True, text=True)
        names |= set(re.findall(r" T (pc_\w+)$", table.stdout, flags=re.M))
    return names


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--cc", required=True)
    options.add_argument("--write", action="store_true")
    options.add_argument("libraries", nargs="+")
    given = options.parse_args()
    if sys.maxsize < 2**32:
        print("the list is of machines with pointers of 64 bits")
        return SKIP

    structs, enums, callbacks, functions = parse(" ".join(map(declarations, HEADERS)))
    declared = {re.search(r"(pc_\w+)\(", function)[1] for function in functions}
    found = exported(given.libraries)
    for name in sorted(declared - found):
        print(f"{name} is declared, but not exported")
    for name in sorted(found - declared):
        print(f"{name} is exported, but not declared")

    renew = f"python3 tests/c_abi/abi.py --write --cc {given.cc} " + " ".join(given.libraries)
    text = "# What C programs rely on, where pointers have 64 bits. Made by tests/c_abi/abi.py, which tells how to renew it.\n"
    functions.sort(key=lambda function: re.search(r"pc_\w+\(", function)[0])
    text += "".join(f"function {function}\n" for function in functions)
    text += "".join(f"callback {callback}\n" for callback in sorted(callbacks))
    text += "".join(f"macro {macro}\n" for macro in sorted(sum(map(macros, HEADERS), [])))
    text += measured(given.cc, sorted(structs), sorted(enums))
    if given.write:
        LISTING.write_text(text)
    before = LISTING.read_text() if LISTING.exists() else ""
    changes = list(
        difflib.unified_diff(before.splitlines(), text.splitlines(), "tests/c_abi/abi.txt", "now", lineterm="", n=1)
    )
    if changes:
        print("\n".join(changes))
        print("\nThe binary interface has changed. Structs may grow at their end; anything else breaks programs.")
        print(f"If it is meant, renew the list, and say so in CHANGELOG.md:\n  {renew}")
    return 1 if changes or declared != found else 0


sys.exit(main())
