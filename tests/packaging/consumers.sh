#!/bin/sh
# Builds the host programs of examples/ against an installed powercell, by CMake and by pkg-config, in C++ and C, and runs
# them. Outside of the system's folders CMAKE_PREFIX_PATH, PKG_CONFIG_PATH and LD_LIBRARY_PATH lead to it.
# usage: tests/packaging/consumers.sh EXAMPLES WORK KIND...   KIND: shared or static
set -eu
examples=$(cd "${1:?usage: consumers.sh EXAMPLES WORK KIND...}" && pwd)
work=${2:?a folder for what is built}
shift 2
# Open MPI refuses root and more ranks than cores without these.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
step() { printf '== packaging: %s\n' "$*"; }
fail() { printf '%s\n' "$*" >&2; exit 1; }

# check_links PROGRAM KIND PART: a static program needs no library of powercell at run time, and one that only makes
# diagrams none of the applications and of what they need.
check_links() {
  needed=$(readelf -d "$1" | grep NEEDED)
  case $2 in
    shared) echo "$needed" | grep -q libpowercell_core || fail "$1 does not link the shared library" ;;
    static) ! echo "$needed" | grep libpowercell_ || fail "$1 links a shared library of powercell" ;;
  esac
  [ "$3" != core ] || ! ldd "$1" | grep -E 'powercell_applications|muparser' || fail "$1 links more than the core"
}

# by_pkg_config COMPILER LANGUAGE PROGRAM KIND: compiled once, linked with each implementation of pkg-config that is there.
by_pkg_config() {
  suffix=
  options=
  # Where there are both kinds, the static one has names of its own; alone it is meant with and without --static.
  if [ "$4" = static ]; then
    options=--static
    ! pkg-config --exists powercell-static || suffix=-static
  fi
  # shellcheck disable=SC2046
  $1 -std="$2" -c "$examples/$3" -o "$work/program.o" $(pkg-config --cflags "powercell$suffix")
  tools=pkg-config
  ! command -v pkgconf >/dev/null || [ "$(readlink -f "$(command -v pkgconf)")" = "$(readlink -f "$(command -v pkg-config)")" ] ||
    tools="pkg-config pkgconf"
  for tool in $tools; do
    for module in powercell-core powercell; do
      # shellcheck disable=SC2046,SC2086
      $1 "$work/program.o" -o "$work/program" $($tool $options --libs $module$suffix) -lm
      check_links "$work/program" "$4" "${module#powercell-}"
      step "$3 by $tool $module$suffix"
      "$work/program"
    done
  done
}

for kind in "$@"; do
  step "by CMake ($kind)"
  shared=ON
  programs="host_cpp host_c own_queue heat_on_device c_cells c_out_of_core c_periodic c_own_queue c_transport c_sampling c_remeshing c_treemap"
  if [ "$kind" = static ]; then # the code is the same, so some suffice
    shared=OFF
    programs="host_cpp c_cells c_transport"
  fi
  if [ -e "$(pkg-config --variable=includedir powercell-core)/powercell/mpi.hpp" ]; then
    programs="$programs particles_mpi c_particles_mpi"
  fi
  # shellcheck disable=SC2086
  cmake -S "$examples" -B "$work/$kind" -G Ninja -Dpowercell_SHARED_LIBS=$shared >"$work/log" 2>&1 &&
    cmake --build "$work/$kind" --target $programs >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  for program in $programs; do
    part=applications
    launcher=
    case $program in *_mpi) launcher="mpirun -n 2" ;; esac
    case $program in host_* | *_mpi | own_queue | heat_on_device | c_cells | c_out_of_core | c_periodic | c_own_queue) part=core ;; esac
    check_links "$work/$kind/$program" "$kind" $part
    step "$program ($kind)"
    $launcher "$work/$kind/$program"
  done
  by_pkg_config "${CXX:-c++}" c++20 host_cpp.cpp "$kind"
  by_pkg_config "${CC:-cc}" c99 host_c.c "$kind"
done
