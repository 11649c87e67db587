#!/bin/sh
# Keeps of what fuzzing grew the fewest inputs that reach all of the code reached, in tests/fuzz/reached/TARGET.tar.xz.
#
#   tools/keep_reached.sh TARGET...     e.g. tools/keep_reached.sh meshes grids; after tools/fuzz.sh has run them
#
# Takes build/fuzz/corpus/TARGET and what is kept already. ctest replays these inputs, and fuzz.sh starts from them.
# Inputs that take long are left out: the replay is to be short.
set -eu
cd "$(dirname "$0")/.."
longest=200  # milliseconds, with sanitizers

[ $# -gt 0 ] || { sed -n '2,7s/^# \{0,1\}//p' "$0" >&2; exit 2; }
export ASAN_OPTIONS="detect_leaks=0:protect_shadow_gap=0:malloc_context_size=0${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
export POCL_DEVICES="${POCL_DEVICES:-basic}"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for target; do
  fuzzer=build/fuzz/tests/fuzz_$target
  archive=tests/fuzz/reached/$target.tar.xz
  [ -x "$fuzzer" ] || { echo "keep_reached.sh: no $fuzzer; run tools/fuzz.sh first" >&2; exit 1; }
  rm -rf "${work:?}"/*
  mkdir -p "$work/before" "$work/$target" "build/fuzz/corpus/$target"
  [ ! -e "$archive" ] || tar -xJf "$archive" -C "$work/before"
  # By edges of the code, not by how often they are taken: thousands of inputs differ in that alone.
  "$fuzzer" -set_cover_merge=1 -use_counters=0 -max_len=4096 -timeout=900 "$work/$target" \
    "tests/fuzz/corpus/$target" "$work/before" "build/fuzz/corpus/$target" >"$work/log" 2>&1 || {
    tail -n 5 "$work/log" >&2
    exit 1
  }
  find "$work/$target" -type f -exec "$fuzzer" -timeout=900 {} + >"$work/log" 2>&1 || {
    echo "keep_reached.sh: an input of $target fails; mend that first" >&2
    tail -n 5 "$work/log" >&2
    exit 1
  }
  awk -v longest="$longest" '/^Executed / && $4 > longest { print $2 }' "$work/log" | xargs -r rm
  tar --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner -cJf "$archive" -C "$work/$target" .
  echo "$target: $(find "$work/$target" -type f | wc -l) inputs, $(stat -c %s "$archive") bytes"
done
