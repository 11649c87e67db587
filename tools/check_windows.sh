#!/bin/sh
# Builds the core and its C interface for Windows by MinGW-w64 (cmake/mingw.cmake), as a DLL and a static library, and a program
# in C with each. Without optimisation, and nothing is run. Needs g++-mingw-w64-x86-64-posix.
set -eu
cd "$(dirname "$0")/.."
command -v x86_64-w64-mingw32-g++-posix >/dev/null || {
  echo "check_windows: there is no x86_64-w64-mingw32-g++-posix; './setup.sh gates' installs it" >&2
  exit 1
}
cmake -S . -B build/check_windows -G Ninja --toolchain cmake/mingw.cmake -DPOWERCELL_APPLICATIONS=OFF \
  -DPOWERCELL_FLANN=OFF -DPOWERCELL_APPS=OFF -DPOWERCELL_TESTS=OFF \
  -DCMAKE_CXX_FLAGS_RELEASE="-O0 -Werror" --log-level=WARNING
cmake --build build/check_windows
lib=build/check_windows/lib
for linked in "-L$lib -lpowercell_core" "-DPOWERCELL_STATIC $lib/libpowercell_core.a -static -lstdc++ -lpthread"; do
  # shellcheck disable=SC2086 # the flags are meant to be split
  x86_64-w64-mingw32-gcc-posix -std=c99 -Wall -Wextra -pedantic -Werror -Iinclude examples/host_c.c $linked \
    -o build/check_windows/host_c.exe
done
echo "check_windows: the core is built for Windows"
