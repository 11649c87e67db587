#!/bin/sh
# Builds the documentation site in build/site, from the documents, the headers, the Python package and the tool. All code on its
# pages runs first, which makes the pictures; a warning of Doxygen or Sphinx is an error.
#
#   docs/site/build.sh [--no-install]    then open build/site/index.html
#
# Needs ./setup.sh build, doxygen, and a Python environment with the package: that of python/tests/run.sh if it is there, else one
# that is made in build/site-work. What Sphinx needs is installed there by pip; with --no-install nothing is.
set -eu
cd "$(dirname "$0")/../.."
fail() { printf 'build.sh: error: %s\n' "$*" >&2; exit 1; }
say() { printf '== %s\n' "$*"; }
install=yes
case ${1:-} in
  '') ;;
  --no-install) install=no ;;
  *) sed -n '2,8s/^# \{0,1\}//p' docs/site/build.sh >&2; fail "unknown option '$1'" ;;
esac
work=build/site-work
mkdir -p "$work"
[ -x build/release/apps/powercell ] || fail "there is no build/release/apps/powercell; run ./setup.sh build"
command -v doxygen >/dev/null || fail "doxygen is missing; apt-get install doxygen"

python=build/python-test/venv/bin/python
if ! "$python" -c 'import powercell' 2>/dev/null; then
  python=$work/venv/bin/python
  if [ "$install" = yes ] && ! "$python" -c 'import powercell' 2>/dev/null; then
    say "a Python environment with the package"
    python3 -m venv --clear "$work/venv"
    "$python" -m pip -q install --disable-pip-version-check ".[plot,geo,mesh]" scipy
  fi
fi
if [ "$install" = yes ]; then
  if "$python" -c 'import uv' 2>/dev/null; then # python/tests/run.sh put it there
    "$python" -m uv pip install -q --python "$python" -r docs/site/requirements.txt
  else
    "$python" -m pip -q install --disable-pip-version-check -r docs/site/requirements.txt
  fi
fi
"$python" -c 'import powercell, sphinx' || fail "Python packages are missing; run it without --no-install"

say "the code of the pages"
"$python" tools/run_snippets.py --work build/snippets

say "comments of the headers"
rm -rf "$work/doxygen"
(cat docs/site/Doxyfile; echo "OUTPUT_DIRECTORY = $work/doxygen") | doxygen - >"$work/doxygen.log" 2>&1 || { cat "$work/doxygen.log"; exit 1; }

say "pages"
"$python" docs/site/assemble.py "$work/source" build/snippets
rm -rf build/site
POWERCELL_DOXYGEN="$PWD/$work/doxygen/xml" "$python" -m sphinx -q -W --keep-going -j auto -b html -d "$work/doctrees" \
  "$work/source" build/site
say "build/site/index.html"
