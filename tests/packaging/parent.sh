#!/bin/sh
# Builds a project that has powercell as a part, by add_subdirectory and by FetchContent, and has hostile flags.
# usage: tests/packaging/parent.sh WORK_FOLDER
set -eu
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
work=$(cd "$1" && pwd)
fail() { printf '%s\n' "$*" >&2; exit 1; }
for fetch in ON OFF; do
  build=$work/parent-$fetch
  cmake -S "$here/parent" -B "$build" -G Ninja -DPOWERCELL_SOURCE="$(cd "$here/../.." && pwd)" -DFETCH=$fetch >"$work/parent.log" ||
    { cat "$work/parent.log"; exit 1; }
  [ "$(ctest --test-dir "$build" -N | grep -c 'Test *#')" = 1 ] || fail "powercell's tests are in the project's"
  DESTDIR=$work/parent-destination cmake --install "$build" --component development >/dev/null
  [ ! -e "$work/parent-destination" ] || fail "powercell installs itself with the project:
$(find "$work/parent-destination" -type f | head)"
done
cmake --build "$build" --target game >"$work/parent.log" || { cat "$work/parent.log"; exit 1; }
"$build/game"
