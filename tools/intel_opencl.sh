#!/bin/sh
# Intel's OpenCL for CPUs beside the system's: fetched from PyPI into a folder, nothing else is touched.
#
#   tools/intel_opencl.sh FOLDER                   fetch it (some 240 MB), if it is not there yet
#   tools/intel_opencl.sh FOLDER COMMAND [ARG...]  and run a command that sees this platform alone
#
# For example the tests, in a tree built by ./setup.sh test:
#   tools/intel_opencl.sh ~/intel-opencl ctest --test-dir build/release --output-on-failure
# Its licence is Intel's: see FOLDER/share/doc/opencl/licensing. Needs python3 with pip, on x86-64.
set -eu
version=2026.2.0

[ $# -ge 1 ] || { sed -n '2,10s/^# \{0,1\}//p' "$0" >&2; exit 2; }
mkdir -p "$1"
folder=$(cd "$1" && pwd)
shift

if [ ! -e "$folder/ready-$version" ]; then
  # The runtime, what it names as its needs, and the compiler's libraries, which it needs and does not name.
  packages="intel-opencl-rt==$version intel-cmplr-lib-rt==$version"
  wheels=$(mktemp -d "$folder/wheels.XXXXXX")
  trap 'rm -rf "$wheels"' EXIT
  # shellcheck disable=SC2086 # the list is meant to be split
  python3 -m pip download --quiet --only-binary :all: --dest "$wheels" $packages >&2
  # --prefix, --no-deps and --no-index: into the folder alone, from the files alone.
  python3 -m pip install --quiet --no-deps --no-index --no-warn-script-location --root-user-action ignore \
    --ignore-installed --prefix "$folder" "$wheels"/*.whl >&2
  rm -rf "$wheels"
  rm -f "$folder"/lib/libOpenCL.so*  # a loader of its own: the system's finds the driver by its ICD file
  mkdir -p "$folder/vendors"
  echo "$folder/lib/libintelocl.so" >"$folder/vendors/intel.icd"
  : >"$folder/ready-$version"
fi

[ $# -gt 0 ] || { echo "in place: $folder" >&2; exit 0; }
OCL_ICD_VENDORS=$folder/vendors
LD_LIBRARY_PATH=$folder/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
POWERCELL_CACHE_DIR=${POWERCELL_CACHE_DIR:-$folder/cache}
export OCL_ICD_VENDORS LD_LIBRARY_PATH POWERCELL_CACHE_DIR
exec "$@"
