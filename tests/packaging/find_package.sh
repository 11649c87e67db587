#!/bin/sh
# What find_package accepts and what it refuses, by name, for an installed powercell with shared and static libraries
# that CMAKE_PREFIX_PATH and PKG_CONFIG_PATH lead to.
# usage: tests/packaging/find_package.sh WORK
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=${1:?usage: find_package.sh WORK}
version=$(pkg-config --modversion powercell)
major=${version%%.*}
minor=${version#*.}
minor=${minor%%.*}

# request LANGUAGES REQUEST TARGETS: configures a project with find_package(powercell REQUEST); all are lists of CMake.
request() {
  folder=$work/request-$(echo "$1" | tr ';' '-')
  rm -f "$folder/CMakeCache.txt" # what was found; what is known of compilers stays
  cmake -S "$here/find_package" -B "$folder" -G Ninja \
    -DLANGUAGES="$1" -DREQUEST="$2" -DTARGETS="$3" >"$work/request.log" 2>&1
}
accepts() {
  request "$@" || { cat "$work/request.log" >&2; echo "find_package(powercell $2) was refused" >&2; exit 1; }
}
# refuses LANGUAGES REQUEST WORDS: the message has the words.
refuses() {
  ! request "$1" "$2" "" || { echo "find_package(powercell $2) was accepted" >&2; exit 1; }
  tr -s ' \n' '  ' <"$work/request.log" | grep -qF -e "$3" || {
    cat "$work/request.log" >&2
    echo "find_package(powercell $2) was refused without the words: $3" >&2
    exit 1
  }
}

# With a language: without one CMake does not look into folders of an architecture, where Debian has libraries.
accepts C "" "powercell::core;powercell::applications;powercell::powercell"
accepts C "$major.$minor;COMPONENTS;core" powercell::core
accepts C "$version;COMPONENTS;core;applications" powercell::powercell
accepts C "COMPONENTS;opencl" "powercell::core;powercell::opencl"
accepts C "COMPONENTS;shared;OPTIONAL_COMPONENTS;gui" powercell::powercell
for other in "$major.$((minor + 1))" "$((major + 1)).0" "$version.1"; do
  refuses C "$other" "compatible with requested version \"$other\""
done
refuses C "COMPONENTS;gui" "no component 'gui', only: core, applications, opencl, mpi, petsc, shared, static"
refuses C "COMPONENTS;shared;static" "'shared' and 'static'"

if [ -e "$(pkg-config --variable=includedir powercell-core)/powercell/mpi.hpp" ]; then
  accepts CXX "COMPONENTS;mpi" "powercell::core;powercell::mpi"
  accepts C "COMPONENTS;mpi" "powercell::core;powercell::mpi"
  refuses NONE "COMPONENTS;mpi;shared" "need MPI 3, which CMake does not find for C"
  accepts NONE "COMPONENTS;core;shared;OPTIONAL_COMPONENTS;mpi" powercell::core
else
  refuses CXX "COMPONENTS;mpi" "without the component 'mpi', which needs a build"
  accepts CXX "COMPONENTS;core;OPTIONAL_COMPONENTS;mpi" powercell::core
fi
if [ -e "$(pkg-config --variable=includedir powercell-core)/powercell/petsc.hpp" ]; then
  accepts CXX "COMPONENTS;petsc" "powercell::powercell;powercell::mpi;powercell::petsc"
  accepts C "COMPONENTS;core;OPTIONAL_COMPONENTS;petsc" powercell::core
  refuses C "COMPONENTS;petsc" "needs that the language CXX is enabled"
else
  refuses CXX "COMPONENTS;petsc" "without the component 'petsc', which needs a build"
  accepts CXX "COMPONENTS;core;OPTIONAL_COMPONENTS;petsc" powercell::core
fi

refuses C "COMPONENTS;static" "enable the language CXX"
# The core needs nothing of the applications.
mkdir -p "$work/core_only"
ln -sf "$(pkg-config --variable=pcfiledir liblz4)/liblz4.pc" "$work/core_only"
export PKG_CONFIG_LIBDIR="$work/core_only" PKG_CONFIG_PATH=
accepts "C;CXX" "COMPONENTS;core;static" powercell::core
refuses "C;CXX" "COMPONENTS;applications;static" "need 'muparser'"
