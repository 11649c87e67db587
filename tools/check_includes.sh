#!/bin/sh
# Includes point one way. Each folder may include those before it in the lists below, and no other; the kernels
# likewise. The applications see the public headers, lib/base and each other; the C interface the public headers and
# lib/base; the tool the public headers alone. Prints each include that breaks this, and fails.
set -eu
cd "$(dirname "$0")/.."

# Stages of the core, each above those before it.
core="base report cl primitives domain regions seeds periodic scene cell neighbors clip pairs solid integrate collect verify diagram device_diagram exchange out_of_core"
kernels="base cell seeds periodic neighbors clip pairs integrate device_diagram"
applications="linear density transport sampling remeshing treemap c_api"

bad=0
# complain FILES PATTERN WHY: no file of FILES includes what PATTERN matches.
complain() {
  found=$(grep -rnE "^#include [\"<]($2)" "$1" --include='*.hpp' --include='*.h' --include='*.cpp' --include='*.inl' \
    --include='*.cl') || return 0
  printf '%s\ncheck_includes: %s\n' "$found" "$3" >&2
  bad=1
}
# one_way ROOT PREFIX OTHERS STAGE...: below ROOT each stage includes only itself and those before it, and every folder is a
# stage or one of OTHERS.
one_way() {
  root=$1 prefix=$2 others=$3
  shift 3
  for folder in "$root"/*/; do
    case " $others $* " in
      *" $(basename "$folder") "*) ;;
      *) echo "check_includes: $folder has no place in the order that this script checks" >&2; bad=1 ;;
    esac
  done
  while [ $# -gt 1 ]; do
    stage=$1
    shift
    above=$(echo "$*" | tr ' ' '|')
    complain "$root/$stage" "$prefix($above)/" "$root/$stage must not include what is above it ($above)"
  done
}

# shellcheck disable=SC2086 # the lists are meant to be split
{
  one_way lib lib/ "applications c_api device_rates" $core
  one_way lib/applications lib/applications/ "" $applications
  one_way kernels '' "device_rates primitives" $kernels
}
inner=$(echo "$core" | sed 's/^base //' | tr ' ' '|')
complain lib/applications "lib/($inner|device_rates)/" "the applications are built on the public headers and lib/base"
for folder in $applications; do
  [ "$folder" = c_api ] || complain "lib/applications/$folder" "lib/c_api/" "the applications are below the C interface"
done
complain lib/device_rates "lib/(primitives|domain|regions|seeds|scene|cell|neighbors|clip|pairs|solid|integrate|collect|verify|diagram|device_diagram|exchange|out_of_core)/" \
  "lib/device_rates may include lib/cl only"
complain lib/c_api "lib/($inner|device_rates|applications)/" "the C interface is built on the public headers and lib/base"
complain apps "lib/" "the tool is built on the public headers"
complain include "lib/|CL/opencl.hpp|flann|Eigen|geos|muParser" "public headers must not leak what the library is made of"
for folder in $core; do
  complain "lib/$folder" "lib/(applications|c_api)/" "lib/$folder is below the applications and the C interface"
done
[ $bad -eq 0 ] && echo "check_includes: includes point one way"
exit $bad
