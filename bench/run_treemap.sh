#!/bin/sh
# Prints the figures of docs/applications.md, "Treemap": time, worst leaf and aspect ratio; then measures the written
# files with tests/applications/treemap/measure_again.py.
#
#   bench/run_treemap.sh [TREE]   TREE: a table or JSON to lay out besides the generated ones; the paper's is the
#                                 tree of the Linux kernel, rows id;parent;name;weight
#
# POWERCELL names the tool (default: build/release/apps/powercell). Needs Python 3 with shapely.
set -eu
cd "$(dirname "$0")/.."
tool=${POWERCELL:-build/release/apps/powercell}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# made NAME PYTHON: writes NAME.csv, a table of rows id, parent, value, by the given statements.
made() {
  python3 - "$folder/$1.csv" <<PYTHON
import random, sys
source = random.Random(1)
with open(sys.argv[1], "w") as file:
    file.write("id,parent,value\n0,,\n")
    row = lambda i, parent, value: file.write(f"{i},{parent},{value}\n")
$2
PYTHON
}

# figures TITLE TREE THREADS [OPTION...]: prints one line of the table.
figures() {
  title=$1 tree=$2 threads=$3
  shift 3
  python3 - "$tool" "$title" "$tree" "$threads" "$@" <<'PYTHON'
import json, resource, subprocess, sys
tool, title, tree, threads, *options = sys.argv[1:]
done = subprocess.run([tool, "treemap", tree, "--threads", threads, "--json", *options], capture_output=True, text=True)
if done.returncode != 0:
    sys.exit(f"{title}: {done.stderr}")
report = json.loads(done.stdout)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(f"{title:32s} {threads:>7s} {report['leaves']:>9,d} {report['seconds']['layout']:8.2f} "
      f"{used.ru_utime + used.ru_stime:9.2f} {100 * report['worst_leaf_error']:12.2g} {report['mean_aspect']:7.3f}")
PYTHON
}

made flat "    for k in range(10000): row(k + 1, 0, 10 ** source.uniform(0, 6))"
made deep "    for k in range(1111110): row(k + 1, k // 10, source.uniform(1, 10))"
printf '%-32s %7s %9s %8s %9s %12s %7s\n' tree threads leaves 'layout s' processor 'worst %' aspect
for threads in 1 2; do
  [ $# -eq 0 ] || figures "$(basename "$1")" "$1" $threads
  figures "10^4 siblings over 10^6 : 1" "$folder/flat.csv" $threads
  figures "10^6 leaves, ten per group" "$folder/deep.csv" $threads
done
echo "layout s: wall time of the layout; processor: processor seconds of all threads, including reading"
tree=${1:-$folder/flat.csv}
"$tool" treemap "$tree" --quiet -o "$folder/out.json" -o "$folder/out.svg"
/usr/bin/python3 tests/applications/treemap/measure_again.py "$tree" "$folder/out.json" "$folder/out.svg"
