#!/bin/sh
# Installs missing packages, builds powercell and runs it. For Debian 12 and distributions based on it.
#
#   ./setup.sh demo   install, build, draw the demo pictures
#   ./setup.sh test   install, build everything, run the tests
#   ./setup.sh build  install and build only
#   ./setup.sh bench  install the packages of the benchmarks too and run bench/run_goals.sh
#   ./setup.sh gates  install the packages of the tests and of the gates in CONTRIBUTING.md; builds nothing
#
# Options after the action: --no-install (only build, with packages installed by other means), --jobs N (default: all
# cores). It can be run again: installed packages and built files are not touched.
set -eu

# Packages to build the library and the tool and to run them on the CPU.
build_packages="cmake ninja-build g++ pkg-config
  ocl-icd-opencl-dev opencl-c-headers pocl-opencl-icd
  libflann-dev liblz4-dev libgeos-dev libproj-dev libsqlite3-dev libboost-dev libmuparser-dev
  libeigen3-dev
  libcli11-dev nlohmann-json3-dev libfmt-dev libcairo2-dev libpng-dev libjpeg-dev libpugixml-dev
  zlib1g-dev"

# Packages of the tests besides those: the libraries that results are compared with, and the programs that read written
# files.
test_packages="doctest-dev libcgal-dev voro++-dev libtbb-dev libopenmpi-dev openmpi-bin libpetsc-real-dev
  bash zsh fish groff-base man-db mandoc
  clang opencl-clhpp-headers oclgrind librsvg2-bin libxml2-utils poppler-utils python3 python3-dev python3-venv python3-meshio python3-shapely python3-vtk9"

# Packages of the benchmarks besides those: their driver, and the plots.
bench_packages="libbenchmark-dev python3-matplotlib python3-scipy"

# Packages of the gates besides those of the tests.
gate_packages="git ccache chromium clang-format clang-tidy doxygen g++-mingw-w64-x86-64-posix"

say() { printf '\n\033[1m== %s\033[0m\n' "$*" >&2; }
fail() { printf 'setup.sh: error: %s\n' "$*" >&2; exit 1; }
usage() { sed -n '2,11s/^# \{0,1\}//p' "$0"; }

# install PACKAGE...: installs those that are not installed yet.
install() {
  command -v dpkg-query >/dev/null || fail "this is not a Debian system; install the equivalents of: $*
  and run '$0 $action --no-install'"
  missing=""
  for package in "$@"; do
    state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) || state=absent
    [ "$state" = installed ] || missing="$missing $package"
  done
  [ -n "$missing" ] || return 0
  say "Installing$missing"
  as_root=""
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "root or sudo is needed to install$missing"
    as_root="sudo"
  fi
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq update </dev/null ||
    fail "apt-get update failed; check the network connection"
  # shellcheck disable=SC2086 # the list is meant to be split
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install $missing \
    </dev/null >"${TMPDIR:-/tmp}/powercell-apt.$$.log" 2>&1 || {
    tail -n 20 "${TMPDIR:-/tmp}/powercell-apt.$$.log" >&2
    fail "apt-get install failed; its full output is in ${TMPDIR:-/tmp}/powercell-apt.$$.log"
  }
  rm -f "${TMPDIR:-/tmp}/powercell-apt.$$.log"
}

# build ON|OFF: builds the release preset, with or without tests, among which are those of MPI and PETSc.
build() {
  say "Building in build/release with $jobs jobs"
  cmake --preset release -DPOWERCELL_TESTS="$1" -DPOWERCELL_MPI="$1" -DPOWERCELL_PETSC="$1" --log-level=WARNING
  cmake --build build/release --parallel "$jobs"
}

action=${1:-help}
[ $# -eq 0 ] || shift
jobs=$(nproc)
wanted=yes
while [ $# -gt 0 ]; do
  case $1 in
    --no-install) wanted=no ;;
    --jobs) [ $# -ge 2 ] || fail "--jobs needs a number"; jobs=$2; shift ;;
    *) usage >&2; fail "unknown option '$1'" ;;
  esac
  shift
done
case $action in
  demo | build) packages=$build_packages ;;
  test) packages="$build_packages $test_packages" ;;
  bench) packages="$build_packages $test_packages $bench_packages" ;;
  gates) packages="$build_packages $test_packages $gate_packages" ;;
  -h | --help | help) usage; exit 0 ;;
  *) usage >&2; fail "unknown action '$action'" ;;
esac

cd "$(dirname "$0")"
# shellcheck disable=SC2086
[ "$wanted" = no ] || install $packages
case $action in
  gates) say "The packages of .ci/run are installed" ;;
  build) build OFF; say "Built: build/release/apps/powercell" ;;
  demo) build OFF; say "Running powercell demo"; build/release/apps/powercell demo ;;
  bench) bench/run_goals.sh ;;
  test) build ON; say "Testing"; ctest --test-dir build/release --output-on-failure --parallel "$((2 * jobs))" ;; # many wait now and then
esac
