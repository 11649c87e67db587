#!/bin/sh
# Installs a build into a temporary folder, builds consumers against it (by CMake and by pkg-config, in C++ and in C,
# and each host program of examples/) and runs them.
# usage: tests/packaging/run.sh BUILD_FOLDER
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "${1:?usage: run.sh BUILD_FOLDER}" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/powercell-packaging.XXXXXX")
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
step() { printf '== packaging: %s\n' "$*"; }

step "install"
cmake --install "$build" --prefix "$prefix" >"$work/install.log" || { cat "$work/install.log"; exit 1; }
libraries=$(find "$prefix" -name 'libpowercell_*.so' -o -name 'libpowercell_*.a')
for name in powercell.pc powercell-core.pc libpowercell_core libpowercell_applications; do
  [ -n "$(find "$prefix" -name "$name*")" ] || { echo "$name was not installed" >&2; exit 1; }
done

step "hidden symbols"
# Only powercell:: and pc_ may be exported, and the typeinfo and vtables of powercell's types. (Weak symbols, such as
# inline members of std types, are not checked.)
for library in $libraries; do
  case $library in *.a) continue ;; esac
  foreign=$(nm -D --defined-only "$library" | awk '$2 == "T" || $2 == "D" || $2 == "B" { print $3 }' |
    c++filt | grep -vE '^(powercell::|pc_|(vtable|typeinfo( name)?|VTT) for powercell::)' || true)
  [ -z "$foreign" ] || { printf '%s exports symbols of others:\n%s\n' "$library" "$foreign" >&2; exit 1; }
  readelf -d "$library" | grep -q 'SONAME.*libpowercell_[a-z]*\.so\.[0-9]' ||
    { echo "$library has no SONAME with a version" >&2; exit 1; }
done

step "the moved tree: find_package"
mv "$prefix" "$work/moved"
prefix=$work/moved
PKG_CONFIG_PATH=$(find "$prefix" -name pkgconfig -type d)
export PKG_CONFIG_PATH
cmake -S "$source/examples" -B "$work/examples" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >"$work/log" ||
  { cat "$work/log"; exit 1; }
cmake --build "$work/examples"
for program in host_cpp host_c own_queue c_cells c_periodic c_own_queue c_transport c_sampling c_remeshing c_treemap; do
  step "run $program"
  "$work/examples/$program"
done
# A program that only makes diagrams must not link the applications or their dependencies.
for program in host_cpp c_cells; do
  ! ldd "$work/examples/$program" | grep -E 'powercell_applications|muparser' ||
    { echo "$program links more than the core" >&2; exit 1; }
done

step "pkg-config"
flags="$(pkg-config --cflags --libs powercell)"
libdir=$(dirname "$(find "$prefix" -name 'libpowercell_core.*' | head -n 1)")
# shellcheck disable=SC2086
${CXX:-c++} -std=c++20 "$source/examples/host_cpp.cpp" -o "$work/by_pkg_config_cpp" $flags
# shellcheck disable=SC2086
${CC:-cc} -std=c99 "$source/examples/host_c.c" -o "$work/by_pkg_config_c" $flags -lm
LD_LIBRARY_PATH=$libdir "$work/by_pkg_config_cpp"
LD_LIBRARY_PATH=$libdir "$work/by_pkg_config_c"

# shellcheck disable=SC2046
${CXX:-c++} -std=c++20 "$source/examples/host_cpp.cpp" -o "$work/by_core" $(pkg-config --cflags --libs powercell-core)
LD_LIBRARY_PATH=$libdir "$work/by_core" >/dev/null

step "every public header compiles alone"
for header in $(cd "$prefix/include" && find . -name '*.hpp' | sed 's|^\./||' | sort); do
  echo "#include <$header>" | ${CXX:-c++} -std=c++20 -Wall -Wextra -Werror -fsyntax-only -x c++ \
    -I "$prefix/include" - || { echo "header $header does not compile alone" >&2; exit 1; }
done
for header in $(cd "$prefix/include" && find . -name '*.h' | sed 's|^\./||' | sort); do
  echo "#include <$header>" | ${CC:-cc} -std=c99 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -x c \
    -I "$prefix/include" - || { echo "header $header does not compile alone" >&2; exit 1; }
done

step "the installed tool"
"$prefix/bin/powercell" --version
step "passed"
