#!/bin/sh
# Runs tests under AddressSanitizer and UndefinedBehaviorSanitizer (preset asan, built in build/asan with clang).
#
#   tools/sanitize.sh            the tests of files, memory and devices, as continuous integration does
#   tools/sanitize.sh TEST...    folders of tests/, for example exact diagram
#   tools/sanitize.sh host       every test in which most of the time is the host's; twice as long
#   tools/sanitize.sh all        every test, the slow ones and the tool's too
#
# JOBS: the number of tests at a time (default: all cores).
set -eu
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}

# Tests that read bytes of others, share memory with the caller or hand it to a device. fuzz calls every entry point, those of
# the applications too.
memory="readers report fuzz seeds cell clip collect hostile primitives cl c_api base"
# Those of arithmetic besides; exact has CGAL to compile. The others (diagram, device_diagram, transport, sampling,
# determinism, faults) take twice as long together, most of it in kernels, which are not sanitized.
host="$memory writers treemap remeshing domain linear density exact pairs laws neighbors verify"

# Without optimisation the libraries compile in half the time of -O1, which is more than the tests take longer.
cmake --preset asan --log-level=WARNING
case ${1-} in
  all)
    cmake --build --preset asan --parallel "$jobs"
    # load measures memory, which the sanitizer keeps; oclgrind has a runtime of its own.
    exec ctest --preset asan --parallel "$jobs" -E '^(load|oclgrind)$' ;;
  "") tests=$memory ;;
  host) tests=$host ;;
  *) tests=$* ;;
esac
# shellcheck disable=SC2046,SC2086 # the lists are meant to be split
cmake --build --preset asan --parallel "$jobs" --target $(printf ' test_%s' $tests)
# shellcheck disable=SC2086
exec ctest --preset asan --parallel "$jobs" -R "^($(echo $tests | tr ' ' '|'))(_reached)?\$" # fuzz is two tests
