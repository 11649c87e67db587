#!/bin/sh
# Builds the Python package's wheel, installs it in a virtual environment of its own, and tests it there: its tests, the
# examples in its documents, the notebooks, and its types. Needs python3-venv, python3-dev and the packages that ./setup.sh installs.
# With ccache as in .ci/run, objects come from build/release: the extension has the same.
#
#   python/tests/run.sh [FOLDER]   FOLDER: for the environment and the wheel; default: build/python-test
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mkdir -p "${1:-$root/build/python-test}" && cd "${1:-$root/build/python-test}" && pwd)
say() { printf '== %s\n' "$*"; }

say "an environment"
python3 -m venv --clear "$folder/venv"
python="$folder/venv/bin/python"
"$python" -m pip -q install --disable-pip-version-check uv # installs in a fifth of pip's time
"$python" -m uv pip install -q --python "$python" pip pytest pytest-timeout mypy scipy scipy-stubs shapely geopandas matplotlib meshio pyvista \
  trimesh tqdm pyopencl intel-opencl-rt intel-cmplr-lib-rt nbclient ipykernel pyvoro2 mpi4py

say "the wheel"
rm -f "$folder"/*.whl
export CC="${CC:-cc}" CXX="${CXX:-c++}" # Python's own compiler has another name, under which ccache finds nothing
"$python" -m pip -q wheel "$root" --no-deps -w "$folder" --config-settings=build-dir="$root/build/python-wheel"
"$python" -m pip -q install "$folder"/powercell-*.whl

cd "$folder" # imports find the installed package
say "tests"
"$python" -m pytest -q --timeout 300 -p no:cacheprovider -W error::pytest.PytestUnhandledThreadExceptionWarning \
  "$root/python/tests"
say "examples"
"$python" - "$root/python/README.md" <<'END'
import doctest, importlib, pkgutil, re, sys
import powercell
failed = 0
for module in pkgutil.iter_modules(powercell.__path__):
    failed += doctest.testmod(importlib.import_module(f"powercell.{module.name}")).failed
failed += doctest.testmod(powercell).failed
if failed:
    sys.exit(f"{failed} examples of docstrings fail")
for number, code in enumerate(re.findall(r"```python\n(.*?)```", open(sys.argv[1]).read(), re.S)):
    exec(compile(code, f"{sys.argv[1]}: example {number}", "exec"), {})
END
"$python" "$root/bench/coming_from.py"
say "notebooks"
"$python" "$root/tools/run_notebooks.py" "$root"/examples/notebooks/*.ipynb
say "types"
"$python" -m mypy --config-file "$root/pyproject.toml" -p powercell
say "the Python package works"
