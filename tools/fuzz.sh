#!/bin/sh
# Fuzzes one target, or each in turn, and keeps what it finds.
#
#   tools/fuzz.sh TARGET MINUTES     e.g. tools/fuzz.sh meshes 60; "all" for every target, one after the other
#
# Builds the targets with clang in build/fuzz first. The growing corpus lies in build/fuzz/corpus/TARGET and begins
# with what tools/keep_reached.sh kept of earlier ones. A run starts from 300 inputs of it, drawn at random, or a slow
# target would spend its time on those it has seen.
# Inputs that failed lie in build/fuzz/findings/TARGET. Once the cause is mended, keep such an input, made as small as
# `build/fuzz/tests/fuzz_TARGET -minimize_crash=1` makes it, in tests/fuzz/corpus/TARGET under a name that says
# what it was: ctest replays it. Exits 1 when something was found.
set -eu
cd "$(dirname "$0")/.."

all=$(ls tests/fuzz/corpus)
[ $# -eq 2 ] || { sed -n '2,13s/^# \{0,1\}//p' "$0" >&2; exit 2; }
targets=$1
[ "$targets" = all ] && targets=$all
seconds=$(($2 * 60))

cmake --preset fuzz --log-level=WARNING
cmake --build --preset fuzz --parallel "${JOBS:-$(nproc)}"

# OpenCL drivers leak at exit and map memory where AddressSanitizer keeps a gap; what the library leaks is
# another test's matter. Where memory was allocated is not noted down, a third of the time of the slow targets: replay a
# finding without that option to see.
export ASAN_OPTIONS="detect_leaks=0:protect_shadow_gap=0:malloc_context_size=0${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
# PoCL's device that runs kernels in the calling thread: for a few seeds a hand-over to another takes longer than the work.
export POCL_DEVICES="${POCL_DEVICES:-basic}"
# Names are sums of the contents.
keep_new() { find "$new" -type f -exec mv -t "$corpus" {} +; }
found=0
for target in $targets; do
  corpus=build/fuzz/corpus/$target
  new=build/fuzz/new/$target
  findings=build/fuzz/findings/$target
  mkdir -p "$corpus" "$new" "$findings"
  reached=tests/fuzz/reached/$target.tar.xz
  [ ! -e "$reached" ] || tar -xJf "$reached" -C "$corpus"
  keep_new  # of a run that was killed
  find "$corpus" -type f | shuf -n 300 | paste -s -d , | tr -d '\n' >"$new.starts"
  dictionary=tests/fuzz/dictionaries/$target.dict
  set -- -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=120 -max_len=4096 -print_final_stats=1
  # With thousands of features an input, as diagrams have, entropic weights take most of the time.
  set -- "$@" -entropic=0
  [ -s "$new.starts" ] && set -- "$@" -seed_inputs="@$new.starts"
  [ -e "$dictionary" ] && set -- "$@" -dict="$dictionary"
  echo "fuzz.sh: $target for $seconds s"
  # Kernels are compiled before the clock runs, or a slow machine calls their compilation a hang.
  nice -n 19 "build/fuzz/tests/fuzz_$target" -runs=0 -timeout=900 "tests/fuzz/corpus/$target" >"$findings/log" 2>&1 ||
    { found=1; echo "fuzz.sh: $target fails on its kept corpus, see $findings/log"; continue; }
  nice -n 19 "build/fuzz/tests/fuzz_$target" "$@" -artifact_prefix="$findings/" "$new" \
    "tests/fuzz/corpus/$target" >"$findings/log" 2>&1 || {
    found=1
    grep -aE '^(finding|SUMMARY|.*runtime error)' "$findings/log" || true
    echo "fuzz.sh: $target failed; the input lies in $findings, the log is $findings/log"
  }
  keep_new
  # Inputs up to INITED were known before.
  grep -aE '^stat::(number_of_executed_units|average_exec|new_units|processor_seconds)|INITED|DONE' "$findings/log" || true
done
exit $found
