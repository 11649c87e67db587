#!/bin/sh
# Installs a build into a temporary folder, builds consumers against it (by CMake and by pkg-config, in C++ and in C,
# shared and static, and each host program of examples/) and runs them.
# usage: tests/packaging/run.sh BUILD_FOLDER
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "${1:?usage: run.sh BUILD_FOLDER}" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/powercell-packaging.XXXXXX")
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
step() { printf '== packaging: %s\n' "$*"; }
fail() { printf '%s\n' "$*" >&2; exit 1; }

step "install"
cmake --install "$build" --prefix "$prefix" >"$work/install.log" || { cat "$work/install.log"; exit 1; }
kinds=
[ -z "$(find "$prefix" -name 'libpowercell_core.so')" ] || kinds=shared
[ -z "$(find "$prefix" -name 'libpowercell_core.a')" ] || kinds="$kinds static"
for name in powercell.pc powercell-core.pc libpowercell_core libpowercell_applications LICENSE; do
  [ -n "$(find "$prefix" -name "$name*")" ] || fail "$name was not installed"
done
for file in man/man1/powercell.1 man/man1/powercell-diagram.1 bash-completion/completions/powercell \
  zsh/site-functions/_powercell fish/vendor_completions.d/powercell.fish; do
  [ -s "$prefix/share/$file" ] || { echo "share/$file was not installed" >&2; exit 1; }
done

step "hidden symbols"
# Only powercell:: and pc_ may be exported, and the typeinfo and vtables of powercell's types. (Weak symbols, such as
# inline members of std types, are not checked.)
for library in $(find "$prefix" -name 'libpowercell_*.so'); do
  foreign=$(nm -D --defined-only "$library" | awk '$2 == "T" || $2 == "D" || $2 == "B" { print $3 }' |
    c++filt | grep -vE '^(powercell::|pc_|(vtable|typeinfo( name)?|VTT) for powercell::)' || true)
  [ -z "$foreign" ] || fail "$library exports symbols of others:
$foreign"
  readelf -d "$library" | grep -q 'SONAME.*libpowercell_[a-z]*\.so\.[0-9]' || fail "$library has no SONAME with a version"
done

step "the moved tree"
mv "$prefix" "$work/moved"
prefix=$work/moved
PKG_CONFIG_PATH=$(find "$prefix" -name pkgconfig -type d)
LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH")
export PKG_CONFIG_PATH LD_LIBRARY_PATH CMAKE_PREFIX_PATH="$prefix"
# No file names the folder that it was built or first installed in.
! grep -rIlF -e "$build" -e "$work/prefix" "$prefix" || fail "the installed files above name the build's folders"
# shellcheck disable=SC2086
"$source/tests/packaging/consumers.sh" "$source/examples" "$work" $kinds
if [ "$kinds" = "shared static" ]; then
  step "find_package"
  "$source/tests/packaging/find_package.sh" "$work"
  cmake -S "$source/tests/packaging/c_only" -B "$work/c_only" -G Ninja -DEXAMPLES="$source/examples" >"$work/log" 2>&1 &&
    cmake --build "$work/c_only" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  "$work/c_only/host_c"
  [ ! -e "$prefix/include/powercell_mpi.h" ] || readelf -d "$work/c_only/c_particles_mpi" | grep -q 'NEEDED.*libmpi' ||
    fail "a project in C did not link MPI"
fi

step "headers"
python3 "$source/tests/headers/check.py" --cc "${CC:-cc}" --cxx "${CXX:-c++}" --include "$prefix/include"

# shellcheck disable=SC2086
"$source/tests/packaging/hosts.sh" "$prefix" "$work" $kinds

step "the installed tool"
unset LD_LIBRARY_PATH # it finds the libraries beside it
"$prefix/bin/powercell" --version
step "passed"
