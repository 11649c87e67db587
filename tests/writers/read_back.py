"""Reads the writers' files with other programs: VTK, meshio and, if installed, rsvg-convert and pdftoppm.

read_back.py TEST_WRITERS. Exit code 77 where VTK is not importable."""
import collections
import json
import os
import shutil
import subprocess
import sys
import tempfile

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    import numpy
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

try:
    import meshio
except ImportError:
    meshio = None


def check(condition, what):
    if not condition:
        sys.exit("FAILED: " + what)


def read(reader, path):
    reader.SetFileName(path)
    reader.Update()
    check(reader.GetErrorCode() == 0, path + ": VTK reports an error")
    return reader.GetOutput()


def arrays(data):
    cell = data.GetCellData()
    return {cell.GetArrayName(k): vtk_to_numpy(cell.GetArray(k)) for k in range(cell.GetNumberOfArrays())}


def areas(data):
    sizer = vtk.vtkCellSizeFilter()
    sizer.SetInputData(data)
    sizer.Update()
    return arrays(sizer.GetOutput())["Area"]


def polyhedron_volumes(data):
    """By the divergence theorem on VTK's faces (VTK's own volumes of polyhedra are inaccurate)."""
    points = vtk_to_numpy(data.GetPoints().GetData())
    volume = numpy.zeros(data.GetNumberOfCells())
    for cell in range(len(volume)):
        faces = vtk.vtkIdList()
        data.GetFaceStream(cell, faces)
        at = 1
        for _ in range(faces.GetId(0)):
            count = faces.GetId(at)
            p = points[[faces.GetId(at + 1 + k) for k in range(count)]]
            volume[cell] += sum(numpy.dot(p[0], numpy.cross(p[k], p[k + 1])) for k in range(1, count - 1)) / 6
            at += count + 1
    return volume


def near(a, b, tolerance=1e-9):
    return numpy.allclose(a, b, rtol=tolerance, atol=tolerance * max(1e-300, numpy.max(numpy.abs(b))))


def check_grid(folder, kind, measures):
    data = read(vtk.vtkXMLUnstructuredGridReader(), f"{folder}/{kind}.vtu")
    fields = arrays(data)
    size = polyhedron_volumes(data) if kind == "volume" else areas(data)
    check(near(size, fields["piece_measure"]), f"{kind}.vtu: VTK's sizes are not the piece measures")
    check(near(numpy.bincount(fields["seed"], size, len(measures)), measures), f"{kind}.vtu: sizes by seed")
    check(near(fields["measure"], measures[fields["seed"]]), f"{kind}.vtu: measure of the cell")
    return data.GetNumberOfCells()


def check_meshio(folder, kind, pieces, measures):
    if meshio is None:
        return
    mesh = meshio.read(f"{folder}/{kind}.vtu")
    check(sum(len(block.data) for block in mesh.cells) == pieces, f"{kind}.vtu: meshio reads other cells")
    found = numpy.zeros(len(measures))
    for seeds, sizes in zip(mesh.cell_data["seed"], mesh.cell_data["piece_measure"]):
        found += numpy.bincount(numpy.ravel(seeds), numpy.ravel(sizes), len(measures))
    check(near(found, measures), f"{kind}.vtu: sizes by seed as meshio reads them")


def check_polygons(folder, kind, measures):
    data = read(vtk.vtkXMLPolyDataReader(), f"{folder}/{kind}.vtp")
    area = areas(data).sum()
    if kind == "volume":
        closed(data, arrays(data)["seed"], measures)
        facet, neighbor = arrays(data)["facet"], arrays(data)["neighbor"]
        check(numpy.array_equal(facet == -1, neighbor != -1), "volume.vtp: faces have a facet or a neighbour")
        check(near(areas(data)[facet != -1].sum(), 6), "volume.vtp: the faces on facets are not the cube's")
    else:
        check(near(area, measures.sum()), f"{kind}.vtp: area")
    for extension, reader in (("ply", vtk.vtkPLYReader()), ("obj", vtk.vtkOBJReader())):
        other = read(reader, f"{folder}/{kind}.{extension}")
        check(other.GetNumberOfCells() == data.GetNumberOfCells(), f"{kind}.{extension}: polygons")
        check(near(areas(other).sum(), area, 1e-5), f"{kind}.{extension}: area")  # VTK reads these as float


def closed(data, seeds, measures):
    """The faces of each cell enclose its volume, by the divergence theorem."""
    points = vtk_to_numpy(data.GetPoints().GetData())
    volume = numpy.zeros(len(measures))
    for cell in range(data.GetNumberOfCells()):
        ids = data.GetCell(cell).GetPointIds()
        p = points[[ids.GetId(k) for k in range(ids.GetNumberOfIds())]]
        for k in range(1, len(p) - 1):
            volume[seeds[cell]] += numpy.dot(p[0], numpy.cross(p[k], p[k + 1])) / 6
    check(near(volume, measures), "volume.vtp: the faces do not enclose the cells")


def polyhedra(data):
    """Per cell its faces as tuples of point numbers."""
    cells = []
    for cell in range(data.GetNumberOfCells()):
        stream, faces, at = vtk.vtkIdList(), [], 1
        data.GetFaceStream(cell, stream)
        for _ in range(stream.GetId(0)):
            count = stream.GetId(at)
            faces.append(tuple(stream.GetId(at + 1 + k) for k in range(count)))
            at += count + 1
        cells.append(faces)
    return cells


def turned(loop):
    """The loop from its least point on."""
    least = loop.index(min(loop))
    return loop[least:] + loop[:least]


def check_shared(path, boundary_area, genus_zero):
    """Inner faces are there exactly twice, with the same points the other way round; all others lie at the boundary.
    genus_zero: whether all cells are balls: V - E + F = 2"""
    data = read(vtk.vtkXMLUnstructuredGridReader(), path)
    points, cells = vtk_to_numpy(data.GetPoints().GetData()), polyhedra(data)
    times = collections.Counter(turned(face) for faces in cells for face in faces)
    check(set(times.values()) == {1}, path + ": a face is twice the same way round")
    outside = [face for face in times if turned(face[::-1]) not in times]
    area = sum(numpy.linalg.norm(sum(numpy.cross(points[f[k]] - points[f[0]], points[f[k + 1]] - points[f[0]])
                                     for k in range(1, len(f) - 1))) / 2 for f in outside)
    check(near(area, boundary_area), f"{path}: faces of one cell have the area {area}, the boundary {boundary_area}")
    for faces in cells:
        edges = {frozenset(e) for f in faces for e in zip(f, f[1:] + f[:1])}
        euler = len({p for f in faces for p in f}) - len(edges) + len(faces)
        check(euler == 2 or not genus_zero, f"{path}: V - E + F = {euler}")
    return data


def check_whole(folder, measures):
    data = check_shared(f"{folder}/whole.vtu", 6, True)
    fields = arrays(data)
    check(sorted(fields["seed"]) == sorted(numpy.flatnonzero(measures)), "whole.vtu: one polyhedron for each cell")
    check(near(polyhedron_volumes(data), measures[fields["seed"]]), "whole.vtu: volumes")
    check("region" not in fields and "piece_measure" not in fields, "whole.vtu: data of pieces")
    if meshio is not None:
        mesh = meshio.read(f"{folder}/whole.vtu")
        check(sum(len(block.data) for block in mesh.cells) == len(fields["seed"]), "whole.vtu: meshio's cells")


def check_stl(folder, measures):
    """VTK tells the solids apart by their order; each is closed and has its cell's volume."""
    reader = vtk.vtkSTLReader()
    reader.ScalarTagsOn()
    data = read(reader, f"{folder}/volume.stl")
    tags = vtk_to_numpy(data.GetCellData().GetScalars())
    with open(f"{folder}/volume.stl") as file:
        seeds = [int(line.split("_")[1]) for line in file if line.startswith("solid ")]
    check(seeds == list(numpy.flatnonzero(measures)), "volume.stl: a solid for each cell")
    check(len(set(tags)) == len(seeds), "volume.stl: VTK finds other solids")
    for tag, seed in enumerate(seeds):
        part = vtk.vtkThreshold()
        part.SetInputData(data)
        part.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS,
                                    data.GetCellData().GetScalars().GetName())
        part.SetLowerThreshold(tag)
        part.SetUpperThreshold(tag)
        surface = vtk.vtkGeometryFilter()
        surface.SetInputConnection(part.GetOutputPort())
        edges = vtk.vtkFeatureEdges()
        edges.SetInputConnection(surface.GetOutputPort())
        edges.FeatureEdgesOff()
        edges.ManifoldEdgesOff()
        edges.NonManifoldEdgesOff()
        edges.Update()
        check(edges.GetOutput().GetNumberOfCells() == 0, f"volume.stl: cell {seed} is open")
        mass = vtk.vtkMassProperties()
        mass.SetInputConnection(surface.GetOutputPort())
        mass.Update()
        check(near(mass.GetVolume(), measures[seed], 1e-4), f"volume.stl: the volume of cell {seed}")  # single precision


def check_msh(folder, kind, measures):
    if meshio is None:
        return
    mesh = meshio.read(f"{folder}/{kind}.msh")
    names = {(tag, dimension): name for name, (tag, dimension) in mesh.field_data.items()}
    cells = 3 if kind == "volume" else 2
    found = sorted(int(name[5:]) for (_, dimension), name in names.items() if dimension == cells)
    check(found == list(numpy.flatnonzero(measures)), f"{kind}.msh: groups of cells")
    if kind == "volume":
        return
    area = numpy.zeros(len(measures))
    for block, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
        if block.type != "triangle":
            continue
        p = mesh.points[block.data]
        size = numpy.linalg.norm(numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
        area += numpy.bincount([int(names[int(t), 2][5:]) for t in tags], size, len(measures))
    check(near(area, measures), f"{kind}.msh: areas of the cells")


def pixels(path):
    image = read(vtk.vtkPNGReader(), path)
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[:, :, :3].astype(float)


def check_pictures(folder):
    flat = pixels(f"{folder}/polygon.png")
    if shutil.which("rsvg-convert"):
        subprocess.run(["rsvg-convert", f"{folder}/polygon.svg", "-o", f"{folder}/svg.png"], check=True)
        other = pixels(f"{folder}/svg.png")
        check(other.shape == flat.shape, "polygon.svg: another size than the PNG")
        check(numpy.abs(other - flat).mean() < 2, "polygon.svg: another picture than the PNG")
    if shutil.which("pdftoppm"):
        subprocess.run(["pdftoppm", "-png", "-r", "96", "-singlefile", f"{folder}/polygon.pdf", f"{folder}/pdf"],
                       check=True)
        other = pixels(f"{folder}/pdf.png")
        rows, columns = min(other.shape[0], flat.shape[0]), min(other.shape[1], flat.shape[1])
        check(abs(other.shape[0] - flat.shape[0]) < 3, "polygon.pdf: another size than the PNG")
        check(numpy.abs(other[-rows:, :columns] - flat[-rows:, :columns]).mean() < 6, "polygon.pdf: another picture")


def main():
    with tempfile.TemporaryDirectory() as folder:
        environment = dict(os.environ, POWERCELL_WRITERS_FOLDER=folder)
        subprocess.run([sys.argv[1], "--test-case=files for other programs"], env=environment, check=True)
        for kind in ("polygon", "surface", "volume"):
            with open(f"{folder}/{kind}.json") as file:
                measures = numpy.array([cell["measure"] for cell in json.load(file)["cells"]])
            check_meshio(folder, kind, check_grid(folder, kind, measures), measures)
            check_polygons(folder, kind, measures)
            check_msh(folder, kind, measures)
            if kind == "volume":
                check_whole(folder, measures)
                check_shared(f"{folder}/volume.vtu", 6, True)
                check_stl(folder, measures)
        check_pictures(folder)
    print("read back by VTK" + (" and meshio" if meshio else ""))


main()
