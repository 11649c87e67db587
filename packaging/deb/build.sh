#!/bin/sh
# Makes Debian packages of this source for the system that it runs on: the libraries, their development files, the tool.
# Needs the packages that ./setup.sh build installs.
# usage: DEBFULLNAME=NAME DEBEMAIL=ADDRESS packaging/deb/build.sh [FOLDER]   FOLDER: for the build; default: build/deb
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mkdir -p "${1:-$source/build/deb}" && cd "${1:-$source/build/deb}" && pwd)
: "${DEBFULLNAME:?who makes the packages is written into them: set DEBFULLNAME and DEBEMAIL}"
: "${DEBEMAIL:?who makes the packages is written into them: set DEBFULLNAME and DEBEMAIL}"
export DEBFULLNAME DEBEMAIL
umask 022

# Debian's flags, but for the optimisation and debugging of its own.
export DEB_BUILD_MAINT_OPTIONS=hardening=+all
flags() { env "DEB_$1_MAINT_STRIP=-g -O2" dpkg-buildflags --get "$1"; }
cmake -S "$source" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr \
  -DCMAKE_SKIP_INSTALL_RPATH=ON -DBUILD_SHARED_LIBS=ON -DPOWERCELL_ARCHIVES=ON \
  -DPOWERCELL_APPS=ON -DPOWERCELL_TESTS=OFF \
  -DCMAKE_C_FLAGS="$(flags CPPFLAGS) $(flags CFLAGS)" -DCMAKE_CXX_FLAGS="$(flags CPPFLAGS) $(flags CXXFLAGS)" \
  -DCMAKE_SHARED_LINKER_FLAGS="$(flags LDFLAGS)" -DCMAKE_EXE_LINKER_FLAGS="$(flags LDFLAGS)" --log-level=WARNING
cmake --build "$folder" ${JOBS:+--parallel "$JOBS"}
rm -f "$folder"/*.deb
(cd "$folder" && cpack -G DEB)
