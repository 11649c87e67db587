# Sourced by run_*.sh: builds the benchmarks in build/bench and sets $matrix and $build. `./setup.sh bench`
# installs what they need.
here=$(cd "$(dirname "$0")/.." && pwd)
build=$here/build/bench
matrix=$build/bench/powercell_matrix
cmake -S "$here" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPOWERCELL_BENCH=ON >&2
cmake --build "$build" --target powercell_matrix first_result >&2
