#!/bin/sh
# Runs small diagrams of each kind of domain under oclgrind and fails if it reports anything: accesses out of bounds,
# races between work-items, invalid uses of the API. usage: run.sh TEST_CLIP_EXECUTABLE
set -eu
command -v oclgrind >/dev/null || { echo "skipped: oclgrind is not installed"; exit 77; }
log=$(mktemp)
trap 'rm -f "$log"' EXIT
unset POWERCELL_DEVICE
# Without optimisation, since inlining leaves llvm.experimental.noalias.scope.decl, which oclgrind 21.10 does not know.
POWERCELL_CACHE=never oclgrind --data-races --check-api --build-options -cl-opt-disable --log "$log" \
  "$1" --test-case="small diagrams of each kind of domain"
if [ -s "$log" ]; then
  cat "$log"
  exit 1
fi
echo "oclgrind reports nothing"
