#!/bin/sh
# Runs small diagrams of each kind of domain under oclgrind and fails on anything it reports: accesses out
# of bounds, races between work-items, wrong uses of the API. usage: run.sh TEST_CLIP_EXECUTABLE
set -eu
command -v oclgrind >/dev/null || { echo "skipped: no oclgrind"; exit 77; }
log=$(mktemp)
trap 'rm -f "$log"' EXIT
unset POWERCELL_DEVICE
# Not optimised: oclgrind 21.10 does not know llvm.experimental.noalias.scope.decl, which inlining leaves behind.
POWERCELL_CACHE=never oclgrind --data-races --check-api --build-options -cl-opt-disable --log "$log" \
  "$1" --test-case="small diagrams of each kind of domain"
if [ -s "$log" ]; then
  cat "$log"
  exit 1
fi
echo "oclgrind has nothing to report"
