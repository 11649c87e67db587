#!/bin/sh
# Includes point one way: diagram and verify -> stages -> primitives -> cl; the C interface and the tool
# see public headers only. Prints each include that does not, and fails.
set -eu
cd "$(dirname "$0")/.."
bad=0
# forbid FOLDER PATTERN WHY [EXCEPT]: no file below FOLDER includes what PATTERN matches, EXCEPT apart.
forbid() {
  [ -d "$1" ] || return 0
  if grep -rnE "^#include [\"<]($2)" "$1" --include='*.hpp' --include='*.h' --include='*.cpp' |
    grep -vE "${4:-^$}"; then
    echo "check_includes: $3" >&2
    bad=1
  fi
}
stages="seeds|domain|neighbors|pairs|clip|integrate|collect"
forbid lib/cl "lib/(primitives|$stages|diagram|verify|c_api)/" "lib/cl must not know what is above it"
forbid lib/primitives "lib/($stages|diagram|verify|c_api)/" "lib/primitives may include lib/cl only"
forbid lib/peaks "lib/(primitives|$stages|diagram|verify|c_api)/" "lib/peaks may include lib/cl only"
for stage in $(echo "$stages" | tr '|' ' '); do
  forbid "lib/$stage" "lib/(diagram|density|verify|c_api)/" "a stage must not include the pipeline that calls it"
done
forbid lib/c_api "lib/($stages|primitives|cl|diagram|verify)/" "the C interface is built on the public headers"
forbid include "lib/|CL/opencl.hpp|flann|Eigen|geos|muParser" "public headers must not leak what the library is made of"
forbid lib/linear "lib/(primitives|$stages|diagram|verify|c_api|cl|transport|density)/" "lib/linear knows graphs only"
# On a surface the normals of Domain::mesh() are needed, a struct without code.
forbid lib/transport "lib/(primitives|$stages|diagram|verify|c_api|cl|density)/" \
  "transport is built on the public headers and lib/linear" 'lib/domain/region_mesh\.hpp"'
forbid lib/treemap "lib/($stages|primitives|cl|diagram|verify|c_api|transport|density)/" \
  "treemaps are built on the public headers and lib/linear" 'lib/seeds/(threads|seed_set)\.hpp"'
# A mesh is refused as the domain of its triangles would be.
forbid lib/remeshing "lib/(linear|primitives|$stages|diagram|verify|c_api|cl|density|transport)/" \
  "remeshing is built on the public headers" 'lib/domain/input_checks\.hpp"'
forbid lib/periodic "lib/(primitives|$stages|diagram|verify|c_api|cl|transport|density)/" \
  "periodic diagrams are built on the public headers"
forbid lib/sampling "lib/(primitives|neighbors|pairs|clip|integrate|collect|diagram|verify|c_api|cl|transport|density|linear)/" \
  "sampling is built on the public headers and lib/periodic"
# The pictures draw the regions that Domain::mesh() hands out, a struct without code.
forbid apps "lib/" "the tool is built on the public headers" 'lib/domain/region_mesh\.hpp"'
[ $bad -eq 0 ] && echo "check_includes: includes point one way"
exit $bad
