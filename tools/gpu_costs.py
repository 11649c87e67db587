#!/usr/bin/env python3
"""Compiles the kernels for GPUs and reads off what they cost. Run by tools/gpu_costs.sh, which fetches the compilers."""

import argparse
import concurrent.futures
import csv
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
KERNELS = ROOT / "kernels"
TABLE = ROOT / "docs" / "records" / "gpu_costs.csv"
PAGE = ROOT / "docs" / "gpu_costs.md"
MAKERS = ("NVIDIA", "AMD")
TARGETS = ("sm_80", "sm_90", "gfx90a", "gfx1100")
GROUP_SIZE = 128  # work-items of a group on GPUs (lib/cl/quirks.cpp)
KEYS = ("program", "kernel", "variant", "target")
COSTS = ("registers", "private", "spill", "waves", "code")
# Programs that clip, of which the table has the first capacity of each kind of space and the large one in 3D, or the first
# in 3D alone. The others share their code. Of programs without cells it has what runs in 3D.
MAIN = "clip/by_tree.cl"
BESIDE = ("clip/by_region.cl", "device_diagram/clip_pairs.cl", "device_diagram/clip_density.cl")
# What --check compiles of the table, in some seconds each.
CHECKED = {
    MAIN: ("float 2D", "float 3D", "double 3D"),
    "clip/by_region.cl": ("float 3D",),
    "neighbors/build_blocks.cl": ("float 3D", "double 3D"),
    "neighbors/hidden.cl": ("float 3D", "double 3D"),
}
KERNELS_LINE = "# SHA-256 of the kernels and their variants: "
CODE_SLACK = 1.05  # a rise of the code size that --check lets pass
# Programs that no diagram uses.
TESTS = ("base/", "device_rates/")
# clang does not know the work-item functions of AMD's runtime, whose headers are not in libclc.
AMD_HEADER = """#define get_global_id(d) \\
  ((size_t)(__builtin_amdgcn_workgroup_id_x() * __builtin_amdgcn_workgroup_size_x() + __builtin_amdgcn_workitem_id_x()))
"""


@dataclasses.dataclass(frozen=True)
class Job:
    program: str
    defines: tuple
    target: str  # "nvidia": both sm_..., which share the code that clang makes

    @property
    def variant(self):
        """As in "double 3D 64", with the capacity of vertices, or "-" for a program that has no variants."""
        return self.space + (f" {self.capacity}" if self.capacity > 1 else "")

    @property
    def space(self):
        """The same without the capacity."""
        value = dict(define.split("=") for define in self.defines)
        if "REAL_BITS" not in value:
            return "-"
        real = "float" if value["REAL_BITS"] == "32" else "double"
        return real + (" 2D" if value["DIMENSION"] == "2" else " surface" if value["CELL_DIMENSION"] == "2" else " 3D")

    @property
    def capacity(self):
        """Of vertices; 1 or 0 if it has no cells."""
        return int(dict(define.split("=") for define in self.defines).get("VERTEX_CAPACITY", 0))


def with_includes(program, seen=None):
    """The text of a program with that of all files that it includes."""
    seen = set() if seen is None else seen
    if program in seen:
        return ""
    seen.add(program)
    text = (KERNELS / program).read_text()
    return "".join(with_includes(name, seen) for name in re.findall(r'^#include "(.*)"', text, re.M)) + text


def programs():
    """(program, the kind of its variants: cells, plain or none), of all files with kernels."""
    for path in sorted(KERNELS.rglob("*.cl")):
        program = path.relative_to(KERNELS).as_posix()
        text = with_includes(program)
        if "__kernel void" not in text or program.startswith(TESTS):
            continue
        yield program, "cells" if "cell_t cell;" in text else "plain" if '"base/real.cl"' in text else "none"


def variants(path):
    """Those of each maker of GPUs and kind, as tuples of defines."""
    result = {(maker, "none"): [()] for maker in MAKERS}
    for line in path.read_text().splitlines():
        maker, kind, *defines = line.split()
        listed = result.setdefault((maker, kind), [])
        if tuple(defines) not in listed:
            listed.append(tuple(defines))
    return result


def recorded(jobs):
    """Those of the table."""
    first = {}
    for job in jobs:
        first.setdefault((job.program, job.space), job.capacity)

    def is_recorded(job):
        is_first, solid = job.capacity == first[job.program, job.space], job.space in ("float 3D", "double 3D", "-")
        return (is_first or solid) if job.program == MAIN else is_first and solid and (job.capacity <= 1 or job.program in BESIDE)

    return [job for job in jobs if is_recorded(job)]


def checked(jobs):
    """Of those, what --check compiles: the first capacities."""
    return [job for job in recorded(jobs) if job.space in CHECKED.get(job.program, ()) and job.capacity < 100]


def digest(jobs):
    """Of all that the costs of these depend on, but for the compilers."""
    text = json.dumps([[dataclasses.astuple(job), with_includes(job.program)] for job in jobs])
    return hashlib.sha256(text.encode()).hexdigest()


class Compiler:
    def __init__(self, arguments):
        self.clang, self.libclc, self.ptxas = arguments.clang, arguments.libclc, arguments.ptxas
        self.results = arguments.work / "results"
        self.results.mkdir(exist_ok=True)
        self.header = arguments.work / "amd.h"
        self.header.write_text(AMD_HEADER)
        self.versions = [self.run(self.clang, "--version").stdout.split("\n")[0].split(" version ")[1],
                         re.search(r"V([\d.]+)", self.run(self.ptxas, "--version").stdout).group(1)]
        self.script = pathlib.Path(__file__).read_text()

    @staticmethod
    def run(*command):
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"gpu_costs: {' '.join(map(str, command))}\n{done.stderr[-3000:]}{done.stdout[-1000:]}")
        return done

    def costs(self, job):
        """Rows of the table, from an earlier run if program and tools are the same."""
        key = json.dumps([self.script, self.versions, dataclasses.astuple(job), with_includes(job.program)])
        kept = self.results / hashlib.sha256(key.encode()).hexdigest()
        if kept.exists():
            return json.loads(kept.read_text())
        with tempfile.TemporaryDirectory() as folder:
            of_target = self.nvidia if job.target == "nvidia" else self.amd
            found = list(of_target(job, pathlib.Path(folder)))
        rows = [dict(zip(KEYS + COSTS, (job.program, kernel, job.variant, target, *costs))) for kernel, target, costs in found]
        kept.write_text(json.dumps(rows))
        return rows

    def compile(self, job, target, library, output, *more):
        link = ("-Xclang", "-mlink-builtin-bitcode", "-Xclang", f"{self.libclc}/{library}")
        return self.run(self.clang, "-x", "cl", "-cl-std=CL1.2", "-Xclang", "-finclude-default-header", "-nogpulib", "-O3", "-w",
                        "-Wno-linker-warnings", "-target", target, *link, *(f"-D{define}" for define in job.defines), *more,
                        "-I", KERNELS, "-S", "-o", output, KERNELS / job.program)

    def nvidia(self, job, folder):
        ptx, cubin = folder / "k.ptx", folder / "k.cubin"
        self.compile(job, "nvptx64-nvidia-cuda", "nvptx64--nvidiacl.bc", ptx, "-march=sm_80")
        for target in ("sm_80", "sm_90"):
            log = self.run(self.ptxas, "-v", f"-arch={target}", ptx, "-o", cubin).stderr
            sections = self.run("readelf", "-SW", cubin).stdout
            code = {name: int(size, 16) for name, size in
                    re.findall(r" \.text\.(\S+)\s+PROGBITS\s+\S+\s+\S+\s+([0-9a-f]+)", sections)}
            for part in log.split("Compiling entry function '")[1:]:
                kernel = part.split("'")[0]
                stack, stored = map(int, re.search(r"(\d+) bytes stack frame, (\d+) bytes spill stores", part).groups())
                registers = int(re.search(r"Used (\d+) registers", part).group(1))
                cumulative = re.search(r"(\d+) bytes cumulative stack", part)
                private = max(stack, int(cumulative.group(1)) if cumulative else 0)
                yield kernel, target, (registers, private, stored, resident_warps(registers), code[kernel])

    def amd(self, job, folder):
        assembly = folder / "k.s"
        log = self.compile(job, "amdgcn-amd-amdhsa", f"{job.target}-amdgcn--.bc", assembly, f"-mcpu={job.target}",
                           "-mcode-object-version=5", "-include", self.header, "-Rpass-analysis=kernel-resource-usage").stderr
        text = assembly.read_text()
        code, function = {}, ""
        for name, size in re.findall(r"; -- Begin function (\S+)|; codeLenInByte = (\d+)", text):
            function = name or function
            code[function] = int(size or 0)
        for part in log.split("Function Name: ")[1:]:
            kernel = part.split()[0]
            if f".amdhsa_kernel {kernel}\n" not in text:
                continue
            usage = dict(re.findall(r"remark:\s+([^:\n]+): (\S+) \[-Rpass", part))
            number = {name.split(" [")[0].strip(): int(value) for name, value in usage.items() if value.isdigit()}
            registers = number["VGPRs"] + number.get("AGPRs", 0)
            yield kernel, job.target, (registers, number["ScratchSize"], 4 * number["VGPRs Spill"], number["Occupancy"], code[kernel])


def resident_warps(registers):
    """Of 64 warps of a multiprocessor with 65536 registers, which are given to warps by 256 and to groups as a whole."""
    warps_of_group = GROUP_SIZE // 32
    of_warp = -(-registers * 32 // 256) * 256
    by_part = 65536 // 4 // of_warp  # each of four parts has a quarter
    return min(64, 4 * by_part // warps_of_group * warps_of_group)


def read_table():
    if not TABLE.exists():
        return {}, ""
    lines = TABLE.read_text().splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return {tuple(row[key] for key in KEYS): {cost: int(row[cost]) for cost in COSTS} for row in rows}, lines[0]


def is_of_today(jobs):
    """Whether the table was written from the kernels and variants of today."""
    return TABLE.exists() and TABLE.read_text().split("\n", 2)[1] == KERNELS_LINE + digest(jobs)


def write_table(rows, versions, jobs):
    with TABLE.open("w") as file:
        file.write(f"# clang {versions[0]}, ptxas {versions[1]}; written by tools/gpu_costs.sh --record\n")
        file.write(KERNELS_LINE + digest(jobs) + "\n")
        writer = csv.DictWriter(file, KEYS + COSTS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def markdown(rows):
    """The part of the page: of each clip kernel and variant, a column per target."""
    lines = ["| kernel | cells | " + " | ".join(TARGETS) + " |", "|---|---|" + "---|" * len(TARGETS)]
    table = {}
    for row in rows:
        if row["program"].startswith(("clip/by_", "diagram/clip_", "neighbors/")):
            cell = f"{row['registers']}, {row['private']:,}, {row['spill']:,}, {row['waves']}"
            table.setdefault((row["kernel"].removesuffix("_kernel"), row["variant"]), {})[row["target"]] = cell
    for (kernel, variant), cells in table.items():
        lines.append(f"| {kernel} | {variant} | " + " | ".join(cells[target] for target in TARGETS) + " |")
    return "\n".join(lines)


def write_page(rows, versions):
    begin, end = "<!-- table -->\n", "<!-- end of the table -->"
    before, rest = PAGE.read_text().split(begin)
    text = f"By clang {versions[0].split()[0]} and ptxas {versions[1]}.\n\n{markdown(rows)}\n"
    PAGE.write_text(before + begin + text + end + rest.split(end)[1])


def compare(rows, recorded):
    """What rose or is not in the table, and how many figures fell."""
    faults, fell = [], 0
    for row in rows:
        key = tuple(row[key] for key in KEYS)
        what = "{0} {1}, {2}, {3}".format(*key)
        if key not in recorded:
            faults.append(f"{what}: not in the table")
            continue
        for cost in COSTS:
            before, after = recorded[key][cost], row[cost]
            worse = after < before if cost == "waves" else after > (before * CODE_SLACK if cost == "code" else before)
            if worse:
                faults.append(f"{what}: {cost} {'fell' if cost == 'waves' else 'rose'} from {before:,} to {after:,}")
            fell += cost != "code" and not worse and after != before
    return faults, fell


def check(rows, versions):
    recorded, head = read_table()
    faults, fell = compare(rows, recorded)
    for fault in faults:
        print(fault)
    if faults:
        if not head or f"clang {versions[0]}, ptxas {versions[1]};" not in head:
            print(f"gpu_costs: the table is of other compilers than clang {versions[0]}, ptxas {versions[1]}: {head}")
        print(f"gpu_costs: {len(faults)} costs are not as in {TABLE.relative_to(ROOT)}; if they are worth it, "
              "tools/gpu_costs.sh --record accepts them, and the commit says why")
        sys.exit(1)
    print(f"gpu_costs: nothing rose in {len(rows)} rows of the table" +
          (f"; {fell} costs fell, tools/gpu_costs.sh --record writes them down" if fell else ""))


def main():
    parser = argparse.ArgumentParser()
    for name in ("--clang", "--libclc", "--ptxas"):
        parser.add_argument(name)
    parser.add_argument("--work", required=True, type=pathlib.Path)
    parser.add_argument("--check", nargs="?", const="some", choices=("some", "all"))
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--is-of-today", action="store_true", help="compile nothing; exit status 1: the table is older")
    parser.add_argument("programs", nargs="*")
    arguments = parser.parse_args()
    listed = variants(arguments.work / "variants.txt")
    jobs = [Job(program, of_maker[maker], target) for program, kind in programs()
            for of_maker in (dict(zip(MAKERS, both)) for both in zip(*(listed[maker, kind] for maker in MAKERS)))
            for target, maker in (("nvidia", "NVIDIA"), ("gfx90a", "AMD"), ("gfx1100", "AMD"))]
    if arguments.is_of_today:
        sys.exit(not is_of_today(recorded(jobs)))
    if arguments.programs:
        jobs = [job for job in jobs if job.program in arguments.programs]
    else:
        jobs = checked(jobs) if arguments.check == "some" else recorded(jobs)
    if not jobs:
        sys.exit(f"gpu_costs: no program of kernels/ is named so: {' '.join(arguments.programs)}")
    compiler = Compiler(arguments)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(compiler.costs, jobs))
    rows = [row for of_job in found for row in of_job]
    rows.sort(key=lambda row: (row["program"], row["kernel"]))  # keeps the order of variants
    if arguments.check:
        check(rows, compiler.versions)
    elif arguments.record:
        write_table(rows, compiler.versions, jobs)
        write_page(rows, compiler.versions)
    else:
        writer = csv.DictWriter(sys.stdout, KEYS + COSTS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
