#!/bin/sh
# Builds the benchmarks and prints the comparison with CGAL and voro++ as a markdown table; the same
# run's JSON goes to build/bench/table.json. Arguments: n (default 100000), then more for powercell_bench.
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
build=$here/build/bench
n=${1:-100000}
[ $# -eq 0 ] || shift
cmake -S "$here" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPOWERCELL_BENCH=ON >&2
cmake --build "$build" --target powercell_bench >&2
"$build/bench/powercell_bench" --table \
  --benchmark_filter="^measures/box[23]/white/W[012]/[a-z]*/[a-z+-]*/$n/" \
  --benchmark_out="$build/table.json" --benchmark_out_format=json "$@"
