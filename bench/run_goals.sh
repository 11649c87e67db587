#!/bin/sh
# Measures every goal of this project for speed and memory and prints a Markdown table of goals and measured values. The
# JSON files are in build/bench/goals/. Takes ten to twenty minutes on two cores.
#
#   bench/run_goals.sh [--quick] [--cpu] [ratios|small|periodic|growth|memory|weights|start|gpu]...
#
# --quick omits 1e6 seeds and more. --cpu compares processor times divided by the number of threads instead of wall
# times: an estimate, for a machine that is busy with other work. If parts are named, only these are measured; the table
# has the others from earlier runs of the same revision. GPU: POWERCELL_DEVICE=gpu bench/run_goals.sh gpu
set -eu
quick=no cpu="" parts=""
for word in "$@"; do
  case $word in
    --quick) quick=yes ;;
    --cpu) cpu=--cpu ;;
    ratios | small | periodic | growth | memory | weights | start | gpu) parts="$parts $word" ;;
    *) sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
  esac
done
. "$(dirname "$0")/build.sh"
out=$build/goals
mkdir -p "$out"
if [ -z "$parts" ]; then
  rm -f "$out"/*.json
  parts="ratios small periodic growth memory weights start"
fi

large=1000000 largest2=10000000 largest3=3000000
[ $quick = no ] || { large="" largest2=100000 largest3=100000; }
some=${large:-100000}
rounds="--seconds 5 --rounds 60 --least-rounds 2"
# run PART FILE ARGUMENT...: times works and writes FILE.json.
run() { part=$1 file=$2; shift 2; "$matrix" time --part "$part" --out "$out/$file.json" "$@"; }
for part in $parts; do
  case $part in
    ratios)
      # --drop: a peer far behind the fastest one at fewer seeds cannot be the fastest.
      # At least two rounds, since the first may compile a larger variant of a kernel; many for works of milliseconds.
      # shellcheck disable=SC2086 # $large is empty with --quick
      for domain in box3 box2; do
        run ratios "$domain" --domain $domain --ours adjacency:tree --drop 1.4 $rounds --n 100000 $large
      done
      for domain in surface tets; do
        run ratios "$domain" --domain $domain --distribution white --ours adjacency:tree $rounds --n 5000 100000
      done
      # Parts as they are: thin, not convex, with holes.
      for domain in bracket gyroid; do
        run ratios "$domain" --domain $domain --distribution white --ours adjacency:tree $rounds --n 200 1000 5000 100000
      done ;;
    small)
      run small small --domain box2 --distribution white --ours adjacency:tree --seconds 4 --rounds 1000 \
        --least-rounds 100 --n 10 100 1000 ;;
    periodic)
      for domain in box3 box2; do
        run periodic periodic_$domain --domain $domain --ours adjacency:tree periodic:tree --no-peers $rounds --n 100000
      done ;;
    growth)
      # Two runs, since the first allocates memory, which costs most at the largest n.
      growth="--distribution white --weights W1 --ours adjacency:tree --no-peers --least-rounds 2"
      # shellcheck disable=SC2086 # the list is meant to be split
      {
        run growth growth2 --domain box2 $growth --n 10000 100000 $large $largest2
        run growth growth3 --domain box3 $growth --n 10000 100000 $large $largest3
      } ;;
    memory)
      "$matrix" memory --part memory --out "$out/memory.json" --domain box2 box3 --distribution white \
        --weights W1 --ours measures:tree adjacency:tree --no-peers --n "$some" ;;
    weights)
      run weights weights --domain box3 --distribution white --weights W1 --no-peers \
        --ours adjacency:tree weights:tree --n "$some" --least-rounds 2 ;;
    start) "$matrix" start --part start --out "$out/start.json" --rounds 5 --tool "$build/apps/powercell" ;;
    gpu)
      run gpu gpu --domain box3 --distribution white --weights W0 --no-peers --float --n 10000000 \
        --ours measures:tree --seconds 30 ;;
  esac
done
/usr/bin/python3 -B "$here/bench/goals.py" $cpu "$out"/*.json | tee "$out/goals.md"
