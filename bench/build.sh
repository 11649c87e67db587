# Sourced by run_*.sh: builds the benchmarks in build/bench and sets $here, $build and $matrix. `./setup.sh bench`
# installs their packages.
here=$(cd "$(dirname "$0")/.." && pwd)
build=$here/build/bench
matrix=$build/bench/powercell_matrix
cmake -S "$here" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPOWERCELL_BENCH=ON >&2
cmake --build "$build" --target powercell_matrix first_result powercell >&2
