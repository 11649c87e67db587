#!/bin/sh
# Host programs whose flags, standard library or other dependencies differ from those that the installed libraries were built
# with. Called by run.sh, which has set the environment.
# usage: hosts.sh PREFIX WORK_FOLDER KIND...
set -eu
here=$(cd "$(dirname "$0")" && pwd)/hosts
prefix=$1 work=$2
shift 2
step() { printf '== packaging: %s\n' "$*"; }
fail() { printf '%s\n' "$*" >&2; exit 1; }
cxx() { ${CXX:-c++} -std=c++20 "$@"; }
libraries=$(dirname "$(find "$prefix" -name 'libpowercell_core.*' | head -n 1)")
ours='powercell::|pc_|(vtable|typeinfo( name)?|VTT) for powercell::'

case " $* " in *" static "*)
  step "symbols of the archives"
  for archive in "$libraries"/libpowercell_*.a; do
    foreign=$(nm -g --defined-only -C "$archive" | awk 'NF > 2' | cut -c 20- | grep -vE "^($ours)" || true)
    [ -z "$foreign" ] || fail "$archive has symbols of others:
$foreign"
    shown=$(readelf -Ws "$archive" | awk '$7 != "UND" && ($5 == "GLOBAL" || $5 == "WEAK" || $5 == "UNIQUE") && $6 != "HIDDEN"' | head -n 5)
    [ -z "$shown" ] || fail "$archive has symbols that what links it would show:
$shown"
  done

  step "a host with Eigen and flags of its own"
  static=$(pkg-config --cflags --libs powercell-static)
  for flags in "-O0 -mavx2" "-O0 -DEIGEN_MAX_ALIGN_BYTES=64" "-O2 -DEIGEN_DEFAULT_TO_ROW_MAJOR" "-O1 -ffast-math"; do
    # shellcheck disable=SC2046,SC2086
    cxx $flags $(pkg-config --cflags eigen3) "$here/eigen.cpp" $static -o "$work/eigen"
    grep -q avx2 /proc/cpuinfo || case $flags in *avx2*) continue ;; esac
    "$work/eigen"
  done
  ;;
esac

case " $* " in *" shared static "*)
  step "a plug-in with a copy of its own"
  # Of what the archive has nothing is shown; of inline functions in headers, which the plug-in's own objects have, as much as its
  # flags say.
  for flags in -fvisibility=hidden -fvisibility=default; do
    # shellcheck disable=SC2046
    cxx -shared -fPIC $flags "$here/plugin.cpp" $(pkg-config --cflags --libs powercell-core-static) -o "$work/plugin.so"
    shown=$(nm -D --defined-only -C "$work/plugin.so" | awk -v weak="${flags#*=}" '$2 != "W" && $2 != "V" || weak == "hidden"' | cut -c 20- |
      grep -E "^($ours)" | head -n 5 || true)
    [ -z "$shown" ] || fail "with $flags the plug-in shows its copy of powercell:
$shown"
  done
  # shellcheck disable=SC2046
  cxx "$here/plugin_host.cpp" $(pkg-config --cflags --libs powercell-core) -ldl -o "$work/plugin_host"
  "$work/plugin_host" "$work/plugin.so"
  ;;
esac

step "other standard libraries and settings of theirs"
core=$(pkg-config --cflags --libs powercell-core)
# builds COMPILER FLAG...: whether the program links
builds() {
  # shellcheck disable=SC2086
  "$@" -std=c++20 "$here/containers.cpp" $core -o "$work/containers" >"$work/log" 2>&1
}
for flags in "" -D_GLIBCXX_ASSERTIONS "-fsanitize=address,undefined"; do
  # shellcheck disable=SC2086
  builds ${CXX:-c++} $flags || { cat "$work/log"; fail "a host with '$flags' does not link"; }
  ASAN_OPTIONS=detect_leaks=0 "$work/containers"
done
# refuses MESSAGE COMPILER FLAG...
refuses() {
  message=$1
  shift
  ! builds "$@" || fail "a host with '$*' links"
  grep -q "$message" "$work/log" || { cat "$work/log"; fail "a host with '$*' is refused without '$message'"; }
}
refuses libstdcxx_with_GLIBCXX_DEBUG ${CXX:-c++} -D_GLIBCXX_DEBUG
refuses libstdcxx_with_old_strings ${CXX:-c++} -D_GLIBCXX_USE_CXX11_ABI=0
if echo '#include <vector>' | clang++ -stdlib=libc++ -fsyntax-only -x c++ - 2>/dev/null; then
  refuses libcxx clang++ -stdlib=libc++
fi

if grep -q 'libpowercell_core.so' "$work"/install.log; then
  step "nothing of OpenCL is linked"
  for library in "$libraries"/libpowercell_*.so; do
    ! nm -D -u "$library" | grep ' cl[A-Z]' || fail "$library calls OpenCL's loader by name"
    ! readelf -d "$library" | grep 'NEEDED.*OpenCL' || fail "$library needs OpenCL's loader to start"
  done
fi

step "the CMake of the page"
rm -rf "$work/page"
python3 - "$here/../../../docs/in_your_program.md" "$work/page" <<'END'
import pathlib, re, sys

page, folder = map(pathlib.Path, sys.argv[1:])
blocks = [block for block in re.findall(r"```cmake\n(.*?)```", page.read_text(), re.S) if "my_program" in block]
assert len(blocks) == 3
for number, block in enumerate(blocks):
    project = folder / str(number)
    (project / "third_party").mkdir(parents=True)
    (project / "third_party/powercell").symlink_to(page.resolve().parents[1])
    (project / "main.cpp").write_text((page.parents[1] / "tests/packaging/hosts/containers.cpp").read_text())
    (project / "CMakeLists.txt").write_text(f"cmake_minimum_required(VERSION 3.22)\nproject(page LANGUAGES C CXX)\n{block}")
END
for project in "$work"/page/?; do
  cmake -S "$project" -B "$project/build" -G Ninja >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
done
cmake --build "$work/page/0/build" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; } # the others compile powercell: parent.sh does
"$work/page/0/build/my_program"
