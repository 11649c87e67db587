#!/bin/sh
# Every formula and section of docs/mathematics.md that a comment or a document cites must be there, and the numbers of
# the formulas must ascend. A citation is "(12b)" in a comment or a document, "mathematics, 17-20" (both ends are
# checked), or the file's name followed by the title of a section in quotes. Prints each fault, and fails.
set -eu
cd "$(dirname "$0")/.."

{
  find lib kernels include apps tests bench examples -type f \( -name '*.?pp' -o -name '*.h' -o -name '*.c' \
    -o -name '*.cl' -o -name '*.inl' \)
  find README.md docs bench/paper -name '*.md' -not -path 'docs/records/*' -not -path docs/mathematics.md
} | sort | xargs awk '
  function fault(text) { print text; bad = 1 }

  # Reads the headings and the numbers of the formulas.
  function read_definitions(file, line, number, letter, place, last) {
    while ((getline line < file) > 0) {
      if (line ~ /^## /) heading[substr(line, 4)] = 1
      if (!match(line, /^    \([0-9]+[a-h]?\)/)) continue
      number = substr(line, 6, RLENGTH - 6)
      letter = number
      gsub(/[0-9]/, "", letter)
      place = number * 10 + index("abcdefgh", letter) * (letter != "")
      if (place <= last) fault(file ": formula (" number ") follows a larger number")
      last = place
      defined[number] = 1
      ++formulas
    }
    if (!formulas) fault(file ": no formula found")
  }

  # The comment on the present line; of a document, all of it.
  function comment(line, end) {
    line = $0
    if (FILENAME ~ /\.md$/) return line
    if (!inside) {
      if (line ~ /^[^"]*\/\//) { sub(/^.*\/\//, "", line); return line }
      if (!match(line, /\/\*/)) return ""
      line = substr(line, RSTART + 2)
      inside = 1
    }
    end = index(line, "*/")
    if (end) { inside = 0; line = substr(line, 1, end - 1) }
    return line
  }

  function check_number(number) {
    ++citations
    if (!(number in defined)) fault(FILENAME ":" FNR ": formula (" number ") is not in docs/mathematics.md")
  }

  # Numbers in parentheses, and after the word "mathematics".
  function check_numbers(line, rest, list, word, n, k) {
    rest = line
    while (match(rest, /(^|[^A-Za-z0-9_\])])\([0-9][0-9]?[a-h]?\)/)) {
      number = substr(rest, RSTART, RLENGTH)
      rest = substr(rest, RSTART + RLENGTH)
      gsub(/[^0-9a-d]/, "", number)
      check_number(number)
    }
    if (!match(line, /mathematics(\.md)?\)?,? [0-9]+[a-h]?((-|–)[0-9]+[a-h]?)?/)) return
    list = substr(line, RSTART, RLENGTH)
    sub(/^[^0-9]*/, "", list)
    n = split(list, word, /-|–/)
    for (k = 1; k <= n; ++k) check_number(word[k])
  }

  # Sections cited in the file before: its comments are joined, since a citation may be broken over lines.
  function check_sections(name) {
    gsub(/[ \t]+/, " ", comments)
    while (match(comments, /mathematics(\.md)?\)?,? "[^"]*"/)) {
      name = substr(comments, RSTART, RLENGTH - 1)
      comments = substr(comments, RSTART + RLENGTH)
      sub(/^[^"]*"/, "", name)
      ++citations
      if (!(name in heading)) fault(file ": section \"" name "\" is not in docs/mathematics.md")
    }
    comments = ""
  }

  BEGIN { read_definitions("docs/mathematics.md") }
  FNR == 1 { check_sections(); inside = 0; file = FILENAME }
  {
    text = comment()
    check_numbers(text)
    gsub(/^[ \t*\/]+/, "", text)
    comments = comments " " text
  }
  END {
    check_sections()
    if (!bad) print "check_formulas: " citations " citations of " formulas " formulas are right"
    exit bad
  }'
