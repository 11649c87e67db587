#!/bin/sh
# clang-tidy over the changed C++ files; a warning fails (.clang-tidy has the checks and the names).
#
#   tools/check_tidy.sh            files changed since the branch left main, or else in the last commit
#   tools/check_tidy.sh REVISION   files changed since REVISION
#   tools/check_tidy.sh --most N   as without arguments, but at most N files; prints how many are left out
#   tools/check_tidy.sh --all      every file
#
# A changed header is checked by one source that includes it. The compiler options come from build/tidy, which is
# configured here. JOBS: the number of files at a time (default: all cores).
set -eu
cd "$(dirname "$0")/.."
command -v clang-tidy >/dev/null || { echo "check_tidy: needs clang-tidy: apt-get install clang-tidy" >&2; exit 2; }
folders="lib apps tests bench examples"

# The revision where the branch left main; on main itself the one before the last commit.
base_revision() {
  for main in origin/main main; do
    base=$(git merge-base HEAD "$main" 2>/dev/null) || continue
    [ "$base" = "$(git rev-parse HEAD)" ] || { echo "$base"; return; }
  done
  git rev-parse --quiet --verify 'HEAD~1'
}

changed() {
  git diff --name-only --diff-filter=d "$1" -- '*.cpp' '*.hpp' '*.inl' '*.h'
  git ls-files --others --exclude-standard '*.cpp' '*.hpp' '*.inl' '*.h'
}

# One source that includes header $1: the one of the same name if it exists.
source_of() {
  own=${1%.*}.cpp
  [ ! -e "$own" ] || { echo "$own"; return; }
  # shellcheck disable=SC2086 # the list is meant to be split
  grep -rlF --include='*.cpp' -e "#include \"$1\"" -e "#include <${1#include/}>" $folders | sort | head -n 1
}

since='' most=''
case ${1-} in
  --all) ;;
  --most) most=${2:?check_tidy: --most needs a number} ;;
  *) since=${1-} ;;
esac
if [ "${1-}" = --all ]; then
  # shellcheck disable=SC2086
  files=$(git ls-files -- $folders | grep '\.cpp$')
else
  [ -n "$since" ] || since=$(base_revision) || {
    echo "check_tidy: skipped, as there is neither main nor an earlier commit to compare with"
    exit 0
  }
  files=$(changed "$since" | while read -r file; do
    case $file in *.cpp) echo "$file" ;; *) source_of "$file" ;; esac
  done | sort -u)
fi

mpi=OFF petsc=OFF
! command -v mpicxx >/dev/null || mpi=ON
[ $mpi = OFF ] || ! pkg-config --exists PETSc || petsc=ON
cmake --preset tidy -DPOWERCELL_MPI=$mpi -DPOWERCELL_PETSC=$petsc --log-level=WARNING >/dev/null
# There are options only for files that the build compiles.
list=$(echo "$files" | while read -r file; do
  ! grep -qF "\"$PWD/$file\"" build/tidy/compile_commands.json || echo "$file"
done)
[ -n "$list" ] || { echo "check_tidy: no changed file to check"; exit 0; }
count=$(echo "$list" | wc -l)
if [ -n "$most" ] && [ "$count" -gt "$most" ]; then
  echo "check_tidy: $((count - most)) of $count changed files are left out; without --most they are checked"
  list=$(echo "$list" | head -n "$most")
fi

# Besides its findings clang-tidy prints how many warnings it suppressed.
check() {
  echo "$list" | xargs -P "${JOBS:-$(nproc)}" -n 1 sh -c '
    clang-tidy --quiet -p build/tidy "$1" 2>&1 || { echo "check_tidy: $1" ; exit 1; }' check_tidy
}
if findings=$(check); then
  echo "check_tidy: $(echo "$list" | wc -l) files without a warning"
else
  echo "$findings" | grep -v 'warnings generated\.$' >&2
  exit 1
fi
