#!/bin/sh
# Makes the Debian packages and tries them as users do: lintian, a fresh minimal system of the release that runs here, the
# tool there without anything for development, then programs against the libraries, by CMake and pkg-config, in C++ and C,
# shared and static. Needs root, Debian's packages lintian and mmdebstrap, and what packaging/deb/build.sh needs.
# usage: packaging/deb/check.sh [FOLDER]   FOLDER: for the build and the system; default: build/deb
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mkdir -p "${1:-$source/build/deb}" && cd "${1:-$source/build/deb}" && pwd)
step() { printf '== deb: %s\n' "$*"; }
fail() { printf 'deb/check.sh: error: %s\n' "$*" >&2; exit 1; }
[ "$(id -u)" -eq 0 ] || fail "a system in a folder needs root"
for tool in lintian mmdebstrap; do
  command -v $tool >/dev/null || fail "$tool is missing: apt-get install lintian mmdebstrap"
done
. /etc/os-release

step "build"
export DEBFULLNAME="${DEBFULLNAME:-the powercell authors}" DEBEMAIL="${DEBEMAIL:-powercell@example.org}"
"$source/packaging/deb/build.sh" "$folder"

step "lintian"
lintian --allow-root --fail-on error,warning --tag-display-limit 0 "$folder"/*.deb

step "dependencies"
# field PACKAGE NAME: a field of a package's control file.
field() { dpkg-deb -f "$folder/$1"_*.deb "$2"; }
# wants PACKAGE FIELD PATTERN...: the field has each of the patterns.
wants() {
  package=$1 name=$2
  shift 2
  for pattern in "$@"; do
    field "$package" "$name" | grep -qE -e "(^|, )$pattern(,|$)" ||
      fail "$package: $name has no '$pattern': $(field "$package" "$name")"
  done
}
version=$(field powercell Version)
same="\(= $version\)"
wants libpowercell-core0 Depends 'libc6 \(>= .*' 'libstdc\+\+6 \(>= .*'
wants libpowercell-core0 Recommends 'pocl-opencl-icd \| opencl-icd'
wants libpowercell-applications0 Depends "libpowercell-core0 $same" 'libmuparser2v5 \(>= .*'
wants powercell Depends "libpowercell-core0 $same" "libpowercell-applications0 $same" 'libcairo2 \(>= .*' 'libgeos-c1v5 \(>= .*' 'libproj25 \(>= .*'
wants powercell Recommends 'pocl-opencl-icd \| opencl-icd'
wants libpowercell-dev Depends "libpowercell-core0 $same" "libpowercell-applications0 $same" 'opencl-c-headers \| opencl-headers' \
  libmuparser-dev
for package in libpowercell-core0 libpowercell-applications0 powercell; do
  ! field $package Depends | grep -E 'hdf5|mpi|flann|-dev' || fail "$package depends on what it does not use"
done
for package in libpowercell-core0 libpowercell-applications0 libpowercell-dev; do
  ! field $package Depends | grep geos || fail "$package depends on GEOS, which only the tool uses"
done

step "a fresh $PRETTY_NAME"
root=$folder/root
rm -rf "$root"
# With the sources and the settings of apt that this system has.
mkdir -p "$folder/apt"
cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null >"$folder/apt/all.list" || true
cat /etc/apt/sources.list.d/*.sources 2>/dev/null >"$folder/apt/all.sources" || true
sources=
for file in "$folder"/apt/all.*; do [ ! -s "$file" ] || sources="$sources $file"; done
# shellcheck disable=SC2086
mmdebstrap --quiet --mode=root --variant=minbase "$VERSION_CODENAME" "$root" $sources
mkdir -p "$root/work"
cp "$folder"/*.deb "$root/work"
cp -r "$source/examples" "$source/tests/packaging" "$root/work"
inside() { chroot "$root" /usr/bin/env -i HOME=/work/home PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 \
  DEBIAN_FRONTEND=noninteractive sh -euc "$1"; }
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount -t sysfs -o ro sysfs "$root/sys"
trap 'umount "$root/proc" "$root/dev" "$root/sys"' EXIT
cp /etc/resolv.conf "$root/etc/resolv.conf"

step "the tool, with what apt brings along"
inside 'apt-get -qq update
  cd /work
  apt-get -qq -y install ./powercell_*.deb ./libpowercell-core0_*.deb ./libpowercell-applications0_*.deb >apt.log 2>&1 || { cat apt.log; exit 1; }
  ! dpkg -l | grep -E "^ii +[^ ]*-dev[: ]"
  powercell --version
  powercell devices
  powercell diagram --domain examples/data/italy.geojson --seeds random:50 -o map.svg --table areas.csv
  [ "$(wc -l <areas.csv)" -eq 51 ]
  grep -q "<svg" map.svg'

step "programs against the libraries"
inside 'cd /work
  apt-get -qq -y --no-install-recommends install ./libpowercell-dev_*.deb >apt.log 2>&1 || { cat apt.log; exit 1; }
  apt-get -qq -y --no-install-recommends install g++ cmake ninja-build pkgconf >apt.log 2>&1 || { cat apt.log; exit 1; }
  mkdir built
  packaging/consumers.sh examples built shared static
  packaging/find_package.sh built'

step "nothing stays behind"
inside 'cd /work
  dpkg -L powercell libpowercell-dev libpowercell-core0 libpowercell-applications0 | sort -u >files
  apt-get -qq -y purge powercell libpowercell-dev libpowercell-core0 libpowercell-applications0 >apt.log 2>&1
  while read -r file; do [ ! -f "$file" ] || { echo "$file stays behind"; exit 1; }; done <files'
step "passed"
