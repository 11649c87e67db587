#!/bin/sh
# What the documents name must be there: the target and the section of each relative link, and each path of this
# repository in the text (`lib/clip`, `powercell/diagram.hpp`, with * for several files). Documents of the repository
# that comments name are checked too. Revision hashes and dates belong into docs/records/; elsewhere a date follows the
# word "measured". Prints each fault, and fails.
set -eu
cd "$(dirname "$0")/.."

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git ls-files -co --exclude-standard -- '*.md' | sort -u | while read -r file; do
  [ ! -e "$file" ] || echo "$file"
done >"$work/all"
# Records and the changelog tell of files that may be gone.
grep -v -e '^docs/records/' -e '^CHANGELOG\.md$' "$work/all" >"$work/present"
complain() { echo "$*" >>"$work/faults"; }
: >"$work/faults"

# anchors FILE: the names that links use for its headings.
anchors() {
  sed -n '/^```/,/^```/d; s/^##* //p' "$1" | sed 's/[`*]//g; s/\[\([^]]*\)\]([^)]*)/\1/g' | LC_ALL=C.UTF-8 sed \
    's/[^[:alnum:] _-]//g; s/ /-/g; s/.*/\L&/'
}

while read -r file; do
  sed '/^```/,/^```/d' "$file" | grep -oE '\]\([^)]+\)|(src|href)="[^"]+"' |
    sed -e 's/^](//' -e 's/)$//' -e 's/^[a-z]*="//' -e 's/"$//' >"$work/links" || true
  while read -r link; do
    case $link in http://* | https://* | mailto:*) continue ;; esac
    path=${link%%#*}
    target=$file
    [ -z "$path" ] || target=$(dirname "$file")/$path
    [ -e "$target" ] || { complain "$file: the link $link leads nowhere"; continue; }
    case $link in
      *'#'*) anchors "$target" | grep -qxF -e "${link#*#}" || complain "$file: no section for the link $link" ;;
    esac
  done <"$work/links"
done <"$work/all"

while read -r file; do
  # Paths from the root of the repository, and public headers.
  grep -oE '(^|[ `"(*])(\.ci|apps|bench|cmake|docs|examples|include|kernels|lib|tests|tools)/[A-Za-z0-9_./*-]+' "$file" |
    sed -e 's/^[ `"(*]//' -e 's/[.,:]*$//' | grep -vE '/([a-z]+_)?[A-Z]{3,}(\.[a-z]+)?$' >"$work/paths" || true  # TARGET is any one
  grep -oE '`powercell(/[a-z_]+\.hpp|\.h)`' "$file" | sed -e 's/`//g' -e 's|^|include/|' >>"$work/paths" || true
  while read -r path; do
    # shellcheck disable=SC2086 # * stands for several files
    ls -d $path >/dev/null 2>&1 || complain "$file: there is no $path"
  done <"$work/paths"
  awk -v file="$file" '
    /20[0-9][0-9]-[0-9][0-9]/ && (before $0) !~ /easured/ { print file ":" FNR ": a date, but not of a measurement" }
    match($0, /(revision|commit|at) `?[0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f]/) {
      print file ":" FNR ": a revision"
    }
    { before = $0 }' "$file" >>"$work/faults"
done <"$work/present"

git grep -noE 'docs/[a-z_/]+\.md' -- lib kernels include apps tests bench tools examples ':!*.md' |
  while IFS=: read -r file line path; do
    [ -e "$path" ] || complain "$file:$line: there is no $path"
  done

if [ -s "$work/faults" ]; then
  cat "$work/faults"
  exit 1
fi
echo "check_docs: links and paths of $(wc -l <"$work/all") documents are right"
