#!/usr/bin/env python3
"""Compiles the public headers as programs include them: each alone and twice, all in both orders, in C from C99 on and in C++
from C++98 on (those of C++ from C++20 on), under strict warnings, beside the macros of windows.h and X11, and before and after
OpenCL's headers of another version. No compiler may print anything.

usage: tests/headers/check.py --cc COMPILER --cxx COMPILER [--include FOLDER]
Those of MPI and PETSc are compiled alone, where pkg-config finds these; other checks are left out with a line that says so."""
import argparse
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
options = argparse.ArgumentParser()
options.add_argument("--cc", required=True)
options.add_argument("--cxx", required=True)
options.add_argument("--include", default=str(ROOT / "include"))
given = options.parse_args()

PACKAGES = {
    "powercell/mpi.hpp": ["mpi-cxx"],
    "powercell_mpi.h": ["mpi-c"],
    "powercell/petsc.hpp": ["PETSc", "mpi-cxx"],
}
C_STANDARDS = ["c99", "gnu99", "c11", "c17", "gnu2x"]
CXX_STANDARDS = ["c++98", "gnu++98", "c++11", "c++14", "c++17", "c++20", "c++2b", "c++2c"]  # the last are 23 and 26
STRICT = "-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wundef -Wcast-align -Wformat=2 -Wswitch-enum".split()
STRICT_C = STRICT + "-Wstrict-prototypes -Wc++-compat".split()
STRICT_CXX = STRICT + "-Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion -Wredundant-decls".split()
EVERYTHING = "-Weverything -Wno-c++98-compat -Wno-c++98-compat-pedantic -Wno-pre-c++20-compat-pedantic -Wno-padded".split()
# What other headers define. They come after the standard library's, which no header of ours can help.
STANDARD = "algorithm array cmath cstddef cstdint functional limits memory numeric span stdexcept string string_view utility vector"
MACROS = """#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
""" + "".join(
    f"#define {name}\n"
    for name in "near far small interface ERROR IN OUT OPTIONAL VOID CONST None Status Bool True False Success Always Unsorted OK "
    "check major minor DEBUG NO YES Nil CurrentTime".split()
)
faults, count = [], 0


def includes(headers):
    return "".join(f"#include <{header}>\n" for header in headers)


def run(compiler, language, flags, source):
    command = [*compiler.split(), *flags, "-I", given.include, "-fsyntax-only", "-x", language, "-"]
    return subprocess.run(command, input=source, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def check(what, compiler, language, flags, source, refusal=None, silent=True):
    """Compiles without a word, or is refused with these."""
    global count
    count += 1
    result = run(compiler, language, flags, source)
    good = refusal in result.stdout if refusal else result.returncode == 0 and not (silent and result.stdout)
    if not good:
        lines = [line for line in result.stdout.splitlines() if "error" in line or "warning" in line]
        faults.append(f"{what}, {compiler} {' '.join(flags)}: {(lines or result.stdout.splitlines() or ['nothing'])[0]}")


def known(compiler, language, standards):
    return [standard for standard in standards if run(compiler, language, [f"-std={standard}"], "").returncode == 0]


def flags_of(header):
    """Of the packages that a header needs; None if one of them is missing."""
    packages = PACKAGES.get(header, [])
    found = subprocess.run(["pkg-config", "--cflags", *packages], capture_output=True, text=True) if packages else None
    if found and found.returncode:
        print(f"left out: {header}, since pkg-config finds not all of {' '.join(packages)}")
        return None
    return found.stdout.replace("-I", "-isystem ").split() if found else []  # their own faults are not ours


def headers(ends):
    folder = pathlib.Path(given.include)
    return sorted(str(path.relative_to(folder)) for path in folder.rglob(f"*{ends}"))


def check_c(headers):
    for header in headers:
        flags = flags_of(header)
        if flags is not None:
            source = includes([header] * 2) + "int main(void) { return 0; }\n"
            check(f"{header} twice", given.cc, "c", ["-std=c99", *STRICT_C, *flags], source)
            check(f"{header} twice", given.cxx, "c++", ["-std=c++98", *STRICT, *flags], source)
    own = [header for header in headers if header not in PACKAGES]
    for standard in known(given.cc, "c", C_STANDARDS):
        check("the C headers", given.cc, "c", [f"-std={standard}", *STRICT_C], includes(own))
    for standard in known(given.cxx, "c++", CXX_STANDARDS):
        for order in (own, own[::-1]):
            check("the C headers", given.cxx, "c++", [f"-std={standard}", *STRICT_CXX], includes(order))


def check_cxx(headers):
    for header in headers:
        flags = flags_of(header)
        if flags is not None:
            check(f"{header} twice", given.cxx, "c++", ["-std=c++20", *STRICT_CXX, *flags], includes([header] * 2))
    own = [header for header in headers if header not in PACKAGES]
    for standard in known(given.cxx, "c++", ["c++20", "gnu++20", "c++2b", "c++2c"]):
        check("all headers", given.cxx, "c++", [f"-std={standard}", *STRICT_CXX], includes(own[::-1]))
    for flags in (["-fno-exceptions"], ["-fno-rtti"], ["-ffast-math"], ["-funsigned-char"], ["-DPOWERCELL_STATIC"]):
        check("all headers", given.cxx, "c++", ["-std=c++20", *flags], includes(own))
    hostile = includes(STANDARD.split()) + MACROS + includes(own)
    check("all headers after macros", given.cxx, "c++", ["-std=c++20"], hostile)
    check("an older C++", given.cxx, "c++", ["-std=c++17"], includes(["powercell/powercell.hpp"]), "powercell needs C++20")


def check_clang(cxx_headers):
    clang = shutil.which("clang++")
    if not clang:
        print("left out: clang++, which is not installed")
        return
    own = [header for header in cxx_headers if header not in PACKAGES]
    check("all headers", clang, "c++", ["-std=c++20", *EVERYTHING, "-Wno-reserved-macro-identifier"], includes(own))
    check("the C headers", clang.removesuffix("++"), "c", ["-std=c99", *EVERYTHING], includes(["powercell_opencl.h"]))


def check_opencl():
    """The version of OpenCL is the program's, in any order of headers."""
    if run(given.cxx, "c++", [], "#include <CL/opencl.hpp>\n").returncode:
        print("left out: CL/opencl.hpp, which is not installed")
        return
    define = "#define CL_TARGET_OPENCL_VERSION 300\n"
    c_api, ours = includes(["CL/cl.h"]), includes(["powercell/opencl.hpp", "powercell_opencl.h"])
    cxx_api = "#define CL_HPP_TARGET_OPENCL_VERSION 300\n#define CL_HPP_MINIMUM_OPENCL_VERSION 200\n#include <CL/opencl.hpp>\n"
    same = "static_assert(__is_same(decltype(powercell::DeviceResults::measures), cl_mem));\n"
    use = same + "auto* f = &clCreateCommandQueueWithProperties;\n"
    flags = ["-std=c++20", *STRICT_CXX]
    for source in (define + c_api + ours, ours + define + c_api, define + ours + c_api):
        check("OpenCL 3.0 in C++", given.cxx, "c++", flags, source + use)
    for source in (c_api + ours, ours + c_api):  # its header notes that it chose a version
        check("OpenCL of no version", given.cxx, "c++", flags, source + use, silent=False)
    for source in (cxx_api + ours, ours + cxx_api):
        check("CL/opencl.hpp", given.cxx, "c++", ["-std=c++20"], source + use + "cl::QueueProperties p;\n")
    check("no version", given.cxx, "c++", flags, ours + "#ifdef CL_TARGET_OPENCL_VERSION\n#error\n#endif\n")
    ours = includes(["powercell_opencl.h"])
    use = "pc_status f(cl_mem values);\npc_status f(cl_mem values) { return pc_device_diagram_set_density(0, values); }\n"
    for standard in known(given.cc, "c", C_STANDARDS):
        for source in (define + c_api + ours, ours + define + c_api):
            check("OpenCL 3.0 in C", given.cc, "c", [f"-std={standard}", *STRICT_C], source + use)


def check_targets():
    """Targets of 32 bits are refused; a DLL exports, and programs that use one need no macro."""
    narrow = ["-w", "-U__SIZEOF_POINTER__", "-D__SIZEOF_POINTER__=4"]
    check("32 bits", given.cc, "c", narrow, includes(["powercell.h"]), "powercell needs a target of 64 bits")
    shown = includes(["powercell/c/export.h"]) + "#define STRING(x) #x\n#define SHOWN(x) STRING(x)\n"
    for flags, value in ((["-DPOWERCELL_BUILDING"], "__declspec(dllexport)"), (["-DPOWERCELL_STATIC"], ""), ([], "")):
        source = shown + f'_Static_assert(sizeof SHOWN(POWERCELL_API) == sizeof "{value}", "");\n'
        check(f"POWERCELL_API is '{value}'", given.cc, "c", ["-std=c11", "-D_WIN32", "-D_WIN64", *flags], source)


cxx_headers, c_headers = headers(".hpp"), headers(".h")
if len(cxx_headers) < 25 or len(c_headers) < 20:
    faults.append(f"only {len(cxx_headers)} and {len(c_headers)} headers were found")
check_c(c_headers)
check_cxx(cxx_headers)
check_clang(cxx_headers)
check_opencl()
check_targets()
print("\n".join(faults) or f"headers: {count} compilations of {len(cxx_headers)} headers of C++ and {len(c_headers)} of C")
sys.exit(1 if faults else 0)
