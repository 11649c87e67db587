#!/bin/sh
# Redoes the evaluation of the paper: computes the data, draws the plots and writes the numbers into
# bench/paper/README.md. About ten minutes for all of it on two idle cores.
#
#   bench/paper/run.sh figure3|figure4|figure6|figure8|figure9|figure10|table1|all... [--quick]
#
# --quick takes small inputs and writes to build/bench/paper-quick/ only. `./setup.sh bench` installs what it needs.
# POWERCELL_DEVICE chooses the device.
set -eu
here=$(cd "$(dirname "$0")/../.." && pwd)
build=$here/build/bench
out=$here/bench/paper/results
quick=""
wanted=""
for word in "$@"; do
  case $word in
    --quick) quick=--quick; out=$build/paper-quick ;;
    all) wanted="figure3 figure4 figure6 figure8 figure9 figure10 table1" ;;
    figure3 | figure4 | figure6 | figure8 | figure9 | figure10 | table1) wanted="$wanted $word" ;;
    *) echo "run.sh: unknown word '$word'" >&2; wanted=""; break ;;
  esac
done
[ -n "$wanted" ] || { sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 2; }

python=""
for candidate in python3 /usr/bin/python3; do
  if "$candidate" -c 'import matplotlib' 2>/dev/null; then python=$candidate; break; fi
done
[ -n "$python" ] || { echo "run.sh: no python3 has matplotlib; install Debian's python3-matplotlib" >&2; exit 1; }

cmake -S "$here" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPOWERCELL_BENCH=ON >&2
cmake --build "$build" --target paper_figures paper_models >&2
for name in $wanted; do
  case $name in
    table1) "$build/bench/paper/paper_models" $quick --out "$out" ;;
    *) "$build/bench/paper/paper_figures" $quick --out "$out" "$name" ;;
  esac
  "$python" "$here/bench/paper/plot.py" "$out" "$name"
done
page=$here/bench/paper/README.md
if [ -n "$quick" ]; then
  cp "$page" "$out/README.md"
  page=$out/README.md
fi
# shellcheck disable=SC2086 # the list is meant to be split
"$python" "$here/bench/paper/report.py" "$out" "$page" $wanted
echo "run.sh: data and plots are in $out, the numbers in $page" >&2
