#!/bin/sh
# Makes the small pictures of docs/guide.md anew, with the tool that POWERCELL names or the one that was built here.
set -eu
cd "$(dirname "$0")"
tool=${POWERCELL:-../../build/release/apps/powercell}
seeds=$(mktemp --suffix=.csv)
trap 'rm -f "$seeds"' EXIT

printf '%s\n' x,y,w 0.36,0.5,0.09 0.68,0.5,0.04 >"$seeds"
"$tool" diagram --quiet --domain square --seeds "$seeds" -o two-discs.svg

# The weight of the first seed grows.
number=0
for weight in -0.02 0.01 0.05 0.105; do
  number=$((number + 1))
  printf '%s\n' x,y,w 0.42,0.48,$weight 0.16,0.22,0.004 0.52,0.14,0.004 0.84,0.26,0.004 0.86,0.62,0.004 \
    0.6,0.5,0.004 0.64,0.86,0.004 0.26,0.84,0.004 0.12,0.56,0.004 >"$seeds"
  "$tool" diagram --quiet --domain square --seeds "$seeds" -o weight-$number.svg
done

"$tool" diagram --quiet --domain holes.geojson --seeds random:60:0:0.05:3 -o holes.svg
