#!/usr/bin/python3
"""Runs `powercell diagram` on the shipped inputs with 1,500 weighted seeds each and reads every file
it writes back with other programs: VTK, meshio, an XML parser, librsvg, GEOS through shapely, a PDF
renderer. The sum of the measures found in each file must equal the domain's, which is measured here
from the input file alone.

usage: read_back.py TOOL DATA_FOLDER [WORK_FOLDER]
exit:  0 all equal, 1 something differs, 77 a module or program is missing
"""
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

try:
    import meshio
    import numpy
    import shapely.geometry
    import shapely.ops
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

SEEDS = 1500
TOLERANCE = {"double": 1e-12, "float": 1e-5}
failures = []


def check(what, value, expected, tolerance):
    error = abs(value - expected) / abs(expected)
    verdict = "ok" if error <= tolerance else "WRONG"
    print(f"  {what:34s} {value:.15g}  relative error {error:.2g}  {verdict}")
    if not error <= tolerance:
        failures.append(what)


def polygon_measure(points):
    """Area of a planar polygon in two or three coordinates, by a fan of triangles."""
    p = numpy.zeros((len(points), 3))
    p[:, : numpy.shape(points)[1]] = points
    fan = p[1:] - p[0]
    return numpy.linalg.norm(numpy.cross(fan[:-1], fan[1:]).sum(axis=0)) / 2


def polygon_flux(points, origin):
    """Integral of (x - origin).n over a planar polygon, over 3: its share of an enclosed volume."""
    p = numpy.asarray(points) - origin
    fan = p[1:] - p[0]
    return numpy.dot(numpy.cross(fan[:-1], fan[1:]).sum(axis=0), p[0]) / 6


def domain_measure(path):
    if path.suffix == ".geojson":
        data = json.loads(path.read_text())
        shapes = [f["geometry"] for f in data["features"]] if "features" in data else [data.get("geometry", data)]
        return shapely.ops.unary_union([shapely.geometry.shape(s) for s in shapes]).area
    mesh = meshio.read(path)
    if path.suffix == ".off":
        return math.fsum(polygon_measure(mesh.points[t]) for t in mesh.cells_dict["triangle"])
    corners = mesh.points[mesh.cells_dict["tetra"]]
    edges = corners[:, 1:] - corners[:, :1]
    return math.fsum(abs(numpy.linalg.det(edges)) / 6)


def sum_faces(points, faces, volume):
    """Total measure of polygons, or of the volume that they enclose."""
    if not volume:
        return math.fsum(polygon_measure(points[f]) for f in faces)
    origin = points.mean(axis=0)
    return math.fsum(polygon_flux(points[f], origin) for f in faces)


def vtk_read(path):
    reader = vtk.vtkXMLUnstructuredGridReader() if path.suffix == ".vtu" else vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def vtk_faces(data):
    points = vtk_to_numpy(data.GetPoints().GetData())
    faces = []
    for c in range(data.GetNumberOfCells()):
        cell = data.GetCell(c)
        solid = cell.GetCellDimension() == 3
        for f in range(cell.GetNumberOfFaces() if solid else 1):
            part = cell.GetFace(f) if solid else cell  # GetFace returns the same object each time
            faces.append([part.GetPointId(k) for k in range(part.GetNumberOfPoints())])
    return points, faces


def read_vtk(path, volume):
    data = vtk_read(path)
    seeds = vtk_to_numpy(data.GetCellData().GetArray("seed"))
    if seeds.min() < 0 or seeds.max() >= SEEDS:
        failures.append(f"{path.name}: seed numbers out of range")
    points, faces = vtk_faces(data)
    return sum_faces(points, faces, volume)


def read_text_faces(path):
    """Faces of an OBJ or OFF file, read line by line."""
    lines = [line.split("#")[0].split() for line in path.read_text().splitlines()]
    lines = [line for line in lines if line]
    if path.suffix == ".obj":
        points = [[float(x) for x in line[1:4]] for line in lines if line[0] == "v"]
        faces = [[int(i.split("/")[0]) - 1 for i in line[1:]] for line in lines if line[0] == "f"]
    else:
        counts = [int(x) for x in lines[1][:2]]
        points = [[float(x) for x in line[:3]] for line in lines[2 : 2 + counts[0]]]
        rows = lines[2 + counts[0] : 2 + sum(counts)]
        faces = [[int(i) for i in row[1 : 1 + int(row[0])]] for row in rows]
    return numpy.array(points), faces


def read_ply(path, volume):
    """By VTK, which keeps single precision; meshio 5.0 does not read polygons of mixed size."""
    reader = vtk.vtkPLYReader()
    reader.SetFileName(str(path))
    reader.Update()
    points, faces = vtk_faces(reader.GetOutput())
    return sum_faces(points.astype(float), faces, volume)


def read_json(path):
    data = json.loads(path.read_text())
    cells = data["cells"]
    return math.fsum(c.get("measure") or 0.0 for c in cells)


def read_geojson(path):
    data = json.loads(path.read_text())
    shapes = [shapely.geometry.shape(f["geometry"]) for f in data["features"] if f["geometry"]]
    if not all(s.is_valid for s in shapes):
        failures.append(f"{path.name}: GEOS finds invalid polygons")
    return math.fsum(s.area for s in shapes)


def read_table(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    if [int(r["seed"]) for r in rows] != list(range(SEEDS)):
        failures.append(f"{path.name}: seeds are not 0..{SEEDS - 1}")
    return math.fsum(float(r["measure"]) for r in rows)


def check_walls(path):
    with open(path, newline="") as file:
        walls = {(int(r["seed"]), int(r["neighbor"])): float(r["measure"]) for r in csv.DictReader(file)}
    if not walls or any(walls.get((j, i)) != a for (i, j), a in walls.items()):
        failures.append(f"{path.name}: walls are not symmetric")


def picture_colours(path):
    """Number of distinct colours of a PNG."""
    reader = vtk.vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return len(numpy.unique(pixels.reshape(len(pixels), -1), axis=0))


def check_picture(path):
    if path.suffix == ".png":
        png = path
    else:
        png = path.with_name(path.name + ".png")
        if path.suffix == ".svg":
            xml.etree.ElementTree.parse(path)
            command = ["rsvg-convert", "-w", "800", "-o", str(png), str(path)]
        else:
            command = ["pdftoppm", "-png", "-r", "60", "-singlefile", str(path), str(png.with_suffix(""))]
        try:
            subprocess.run(command, check=True)
        except FileNotFoundError:
            print(f"  skipped: no {command[0]} to render {path.name}")
            sys.exit(77)
    colours = picture_colours(png)
    print(f"  {path.name:34s} {colours} colours")
    if colours < 10:
        failures.append(f"{path.name}: looks empty")


def run(tool, shape, precision, folder):
    expected = domain_measure(shape)
    kind = {".geojson": "polygon", ".off": "surface", ".mesh": "volume"}[shape.suffix]
    volume = kind == "volume"
    spacing = (expected / SEEDS) ** (1 / (3 if volume else 2))
    stem = folder / f"{shape.stem}_{precision}"
    # Pictures and geometry are written in double precision, whatever computed them: one file is enough of the second.
    pictures = [".png"] + ([".svg", ".pdf"] if kind == "polygon" else [])
    geometry = [".vtu", ".vtp", ".obj", ".off", ".ply", ".json"] + ([".geojson"] if kind == "polygon" else [])
    if precision == "float" and "POWERCELL_TEST_ALL" not in os.environ:
        pictures, geometry = [], [".vtu"]
    files = {s: pathlib.Path(f"{stem}{s}") for s in pictures + geometry}
    table, walls = pathlib.Path(f"{stem}.csv"), pathlib.Path(f"{stem}_walls.csv")
    command = [tool, "diagram", "--domain", str(shape), "--precision", precision, "--json"]
    command += ["--seeds", f"random:{SEEDS}:0:{2 * spacing**2!r}:5", "--table", str(table), "--walls", str(walls)]
    for path in files.values():
        command += ["-o", str(path)]
    print(" ".join(command))
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        failures.append(f"{shape.name}: exit code {done.returncode}")
        return
    summary = json.loads(done.stdout)
    tolerance = TOLERANCE[precision]
    check("domain, by the tool", summary["domain_measure"], expected, 1e-12)
    check("measure, by the tool", summary["measure"], expected, tolerance)
    check("table", read_table(table), expected, tolerance)
    check_walls(walls)
    for suffix in geometry:
        path = files[suffix]
        if suffix in (".vtu", ".vtp"):
            found = read_vtk(path, volume)
        elif suffix in (".obj", ".off"):
            found = sum_faces(*read_text_faces(path), volume)
        elif suffix == ".ply":
            found = read_ply(path, volume)
        else:
            found = read_json(path) if suffix == ".json" else read_geojson(path)
        check(path.name, found, expected, max(tolerance, 1e-6) if suffix == ".ply" else tolerance)
    for suffix in pictures:
        check_picture(files[suffix])


def main():
    tool, data = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for shape in ("italy.geojson", "pretzel.off", "bracket.mesh"):
            for precision in TOLERANCE:
                run(tool, data / shape, precision, folder)
    for failure in failures:
        print("FAILED:", failure)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
