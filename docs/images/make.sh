#!/bin/sh
# Makes the pictures of docs/guide.md, docs/gallery.md and docs/applications.md anew, with the tool that POWERCELL names or the
# one that was built here. Needs Python with numpy and Pillow: python3, or what PYTHON names. (docs/performance.md names the scripts of its plots.)
#
#   docs/images/make.sh [FOLDER]     FOLDER: where to; default: docs/images
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
python=${PYTHON:-python3}
case $python in */*) python=$(realpath -s "$python") ;; esac
"$python" -c 'import numpy, PIL' || { echo "make.sh: $python has no numpy or no Pillow; name another one with PYTHON" >&2; exit 1; }
tool=$(realpath "${POWERCELL:-$root/build/release/apps/powercell}")
folder=$(mkdir -p "${1:-$root/docs/images}" && cd "${1:-$root/docs/images}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$root" # treemaps of folders begin with the folder's name as given

# The guide: two discs, the weight of one seed that grows, a polygon with holes.
printf '%s\n' x,y,w 0.36,0.5,0.09 0.68,0.5,0.04 >"$work/seeds.csv"
"$tool" diagram --quiet --domain square --seeds "$work/seeds.csv" -o "$folder/two-discs.svg"
number=0
for weight in -0.02 0.01 0.05 0.105; do
  number=$((number + 1))
  printf '%s\n' x,y,w 0.42,0.48,$weight 0.16,0.22,0.004 0.52,0.14,0.004 0.84,0.26,0.004 0.86,0.62,0.004 \
    0.6,0.5,0.004 0.64,0.86,0.004 0.26,0.84,0.004 0.12,0.56,0.004 >"$work/seeds.csv"
  "$tool" diagram --quiet --domain square --seeds "$work/seeds.csv" -o "$folder/weight-$number.svg"
done
"$tool" diagram --quiet --domain docs/images/holes.geojson --seeds random:60:0:0.05:3 -o "$folder/holes.svg"

# The gallery: three shapes of the demo, then the applications.
"$tool" demo --quiet -o "$work/demo"
for name in italy pretzel bracket; do cp "$work/demo/$name.png" "$folder/"; done
"$tool" transport --quiet --domain examples/data/italy.geojson --seeds random:300 -o "$folder/transport.png"
"$tool" diagram --quiet --domain examples/data/italy.geojson --seeds random:300 --color-by measure --size 640 -o "$folder/areas.png"
"$tool" remesh --quiet examples/data/pretzel.off --count 3000 -o "$folder/remesh.png"
"$python" examples/data/make_photo.py "$work/photo.png" 640
"$tool" sample --quiet -n 6000 --image "$work/photo.png" -o "$folder/stipples.svg"
"$tool" treemap --quiet lib --shape 16:9 --size 1200 -o "$folder/treemap.png"

# As wide as pages show them: the tool's pictures are made for print.
"$python" - "$folder" <<'END'
import pathlib, sys
from PIL import Image

for name, width in {"italy": 543, "pretzel": 700, "bracket": 625, "transport": 520, "areas": 594, "remesh": 1650}.items():
    path = pathlib.Path(sys.argv[1]) / f"{name}.png"
    picture = Image.open(path).convert("RGB")
    picture = picture.resize((width, round(picture.height * width / picture.width)), Image.Resampling.LANCZOS)
    if name == "remesh":  # few colours and many thin lines
        picture = picture.quantize(256)
    picture.save(path, optimize=True)
END
