#!/bin/sh
# Compares powercell with CGAL and voro++ for every combination of domain, distribution, weights and number of seeds,
# and measures how the time per cell grows with the number of seeds, and peak memory. Writes JSON, a Markdown table and
# plots to build/bench/matrix/ and prints the table.
#
#   bench/run_matrix.sh [--quick] [--n N]... [--report]
#
# --n: numbers of seeds of the ratios, for all domains; default 1000 10000 100000 (surface and tets: 5000 100000).
# --quick: only white seeds and W1, and growth and memory up to 1e5, instead of 1e7 (square) and 3e6 (cube).
# --report: only makes the table and plots again. The default takes a quarter of an hour on two cores.
set -eu
quick=no sizes="" report=no
while [ $# -gt 0 ]; do
  case $1 in
    --quick) quick=yes ;;
    --report) report=yes ;;
    --n) [ $# -ge 2 ] || exit 2; sizes="$sizes $2"; shift ;;
    *) sed -n '2,10s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
  esac
  shift
done
if [ $report = yes ]; then
  here=$(cd "$(dirname "$0")/.." && pwd)
  build=$here/build/bench
else
  . "$(dirname "$0")/build.sh"
fi
out=$build/matrix
mkdir -p "$out"

measure() {
  rm -f "$out"/*.json
  works="" growth2="1000 10000 100000" growth3="1000 10000 100000" memory=100000
  if [ $quick = yes ]; then
    works="--distribution white --weights W1"
  else
    growth2="$growth2 1000000 10000000" growth3="$growth3 1000000 3000000" memory=1000000
  fi
  # shellcheck disable=SC2086 # lists are meant to be split
  {
    for domain in box2 box3 surface tets; do
      case $domain in box*) n="1000 10000 100000" ;; *) n="5000 100000" ;; esac
      "$matrix" time --part ratios --out "$out/$domain.json" --domain $domain $works --n ${sizes:-$n} \
        --ours adjacency:tree measures:tree adjacency:flann --drop 4 --seconds 3 --least-rounds 3
    done
    white="--distribution white --weights W1"
    # At 1e7 only peers close to the fastest at 1e5 run; the others would take minutes.
    "$matrix" time --part growth --out "$out/growth2.json" --domain box2 $white --n $growth2 \
      --ours adjacency:tree measures:tree --drop 1.4 --seconds 3 --least-rounds 2
    "$matrix" time --part growth --out "$out/growth3.json" --domain box3 $white --n $growth3 \
      --ours adjacency:tree measures:tree --drop 1.4 --seconds 3 --least-rounds 2
    "$matrix" memory --part memory --out "$out/memory.json" --domain box2 box3 $white --n $memory \
      --ours measures:tree adjacency:tree measures:flann adjacency:flann
  }
}

[ $report = yes ] || measure
/usr/bin/python3 -B "$here/bench/matrix_table.py" "$out"/*.json | tee "$out/matrix.md"
/usr/bin/python3 -B "$here/bench/plots.py" "$out" "$out"/*.json
