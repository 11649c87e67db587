#!/bin/sh
# What each kernel costs on GPUs, as compilers for them say, without a GPU: registers, private memory, spills, resident
# warps, code size. docs/gpu_costs.md explains the figures and has the table.
#
#   tools/gpu_costs.sh [PROGRAM...]   print them, of all variants of kernels/PROGRAM (clip/by_tree.cl), else of the table
#   tools/gpu_costs.sh --check        compare some of the recorded table, if the kernels have changed since; fails where one rose
#   tools/gpu_costs.sh --check all    all of it, always
#   tools/gpu_costs.sh --record       write the table and its part of the page: so a rise is accepted
#
# Fetches clang, libclc (Debian's packages) and ptxas (from the Python package index) into build/gpu_costs, once, some
# 90 MB, and installs nothing. Needs c++, readelf, python3 with pip, on x86-64. Exit status 77: the packages cannot be had.
set -eu
cd "$(dirname "$0")/.."
work=$PWD/build/gpu_costs
debian_packages="clang-19 libclang-cpp19 libllvm19 libclang-common-19-dev libclc-19"
ptxas_package="nvidia-cuda-nvcc-cu12==12.9.86"

case ${1-} in -h | --help) sed -n '2,12s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
mkdir -p "$work"

# The variants, as the host names their defines.
cat >"$work/variants.cpp" <<'END'
#include <cstdio>
#include "lib/cl/quirks.hpp"
#include "lib/scene/variant.hpp"

using namespace powercell;

static void print(const char* maker, const char* kind, const Variant& variant) {
  std::printf("%s %s", maker, kind);
  for (const std::string& define : variant.defines()) std::printf(" %s", define.c_str());
  std::printf("\n");
}

int main() {
  for (const char* maker : {"NVIDIA", "AMD"}) {
    DeviceInfo gpu;
    gpu.type = DeviceInfo::Type::gpu;
    gpu.vendor = maker;
    for (const bool float32 : {true, false})
      for (Variant variant : all_variants(float32, 1)) {
        variant.lane_width = cl::lane_width(cl::quirks_of(gpu).settings, variant.cell_dimension);
        print(maker, "cells", variant);
        variant.capacity = {1, 1};
        print(maker, "plain", variant);
      }
  }
}
END
c++ -std=c++20 -I . -I include "$work/variants.cpp" lib/scene/variant.cpp lib/cl/quirks.cpp lib/report/error.cpp lib/report/standard_library.cpp \
  -o "$work/variants"
env -u POWERCELL_LANES "$work/variants" >"$work/variants.txt"

if [ "${1-}" = --check ] && [ "${2-}" != all ] && python3 tools/gpu_costs.py --work "$work" --is-of-today; then
  echo "gpu_costs: the recorded table is that of the kernels of today"
  exit
fi

# absent WHAT: the packages cannot be fetched, and nothing was checked.
absent() {
  echo "gpu_costs: nothing was compared: $1 cannot be fetched (see $work/fetch.log)" >&2
  exit 77
}

for package in $debian_packages; do
  [ ! -e "$work/$package.ready" ] || continue
  rm -f "$work/$package"_*.deb
  (cd "$work" && apt-get download -q "$package") >>"$work/fetch.log" 2>&1 || absent "Debian's package $package"
  dpkg -x "$work/$package"_*.deb "$work/root" && rm -f "$work/$package"_*.deb
  : >"$work/$package.ready"
done
if [ ! -e "$work/$ptxas_package.ready" ]; then
  rm -rf "$work/wheels"
  python3 -m pip download --quiet --no-deps --only-binary :all: --dest "$work/wheels" "$ptxas_package" \
    >>"$work/fetch.log" 2>&1 || absent "the Python package $ptxas_package"
  python3 -c 'import sys, zipfile
archive = zipfile.ZipFile(sys.argv[1])
open(sys.argv[2], "wb").write(archive.read("nvidia/cuda_nvcc/bin/ptxas"))' "$work"/wheels/*.whl "$work/ptxas"
  chmod +x "$work/ptxas"
  rm -rf "$work/wheels"
  : >"$work/$ptxas_package.ready"
fi

root=$work/root/usr/lib
LD_LIBRARY_PATH=$root/x86_64-linux-gnu:$root/llvm-19/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export LD_LIBRARY_PATH
exec python3 tools/gpu_costs.py --clang "$root/llvm-19/bin/clang" --libclc "$root/clc" --ptxas "$work/ptxas" \
  --work "$work" "$@"
