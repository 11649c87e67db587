#!/bin/sh
# Every C++, C and OpenCL file must be formatted as .clang-format says. Lists those that are not, and fails.
#
#   tools/check_format.sh         check
#   tools/check_format.sh --fix   format them
#
# Other versions of clang-format than 14 (Debian 12) format some lines differently and are refused.
set -eu
cd "$(dirname "$0")/.."

for clang_format in clang-format-14 clang-format ""; do
  case $("$clang_format" --version 2>/dev/null || true) in *"version 14."*) break ;; esac
done
[ -n "$clang_format" ] || { echo "check_format: needs clang-format 14: apt-get install clang-format-14" >&2; exit 2; }

# Tracked files and new ones that git does not ignore, without those deleted from the working tree.
files=$(git ls-files --cached --others --exclude-standard '*.cpp' '*.hpp' '*.h' '*.c' '*.inl' '*.cl' |
  while read -r file; do [ ! -e "$file" ] || echo "$file"; done)
[ -n "$files" ] || { echo "check_format: git lists no file to check" >&2; exit 2; }

# shellcheck disable=SC2086 # the list is meant to be split; no path has a blank
if places=$("$clang_format" --dry-run -Werror $files 2>&1); then
  echo "check_format: $(echo "$files" | wc -l) files are formatted"
  exit 0
fi
bad=$(echo "$places" | sed -n 's/^\([^:]*\):[0-9]*:[0-9]*: error: .*/\1/p' | sort -u)
[ -n "$bad" ] || { echo "$places" >&2; exit 2; }
echo "$bad" >&2
if [ "${1-}" = --fix ]; then
  # shellcheck disable=SC2086
  "$clang_format" -i $bad
  echo "check_format: formatted the files above"
else
  echo "check_format: these files are not formatted; tools/check_format.sh --fix formats them" >&2
  exit 1
fi
