#!/usr/bin/env python3
"""Writes the fixtures of tests/readers/data with other programs than powercell: Gmsh, meshio and VTK.

Needs the Debian packages gmsh, python3-meshio and python3-vtk9. Run it in its folder:
    python3 make_data.py
The mesh is the unit cube in a few dozen tetrahedra, with the triangles of its faces.
"""
import pathlib
import subprocess

import meshio
import numpy
import vtk

GEO = """
SetFactory("Built-in");
Point(1) = {0, 0, 0, 0.6}; Extrude {1, 0, 0} { Point{1}; } Extrude {0, 1, 0} { Line{1}; }
Extrude {0, 0, 1} { Surface{5}; }
Mesh.SaveAll = 1;
"""


def gmsh(*arguments):
    subprocess.run(["gmsh", "-v", "1", "-nt", "1", "cube.geo", *arguments], check=True)


def vtu(grid, name, mode, compressed, header64=False, encode=True):
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(name)
    {"ascii": writer.SetDataModeToAscii, "binary": writer.SetDataModeToBinary,
     "appended": writer.SetDataModeToAppended}[mode]()
    (writer.SetCompressorTypeToZLib if compressed else writer.SetCompressorTypeToNone)()
    (writer.SetHeaderTypeToUInt64 if header64 else writer.SetHeaderTypeToUInt32)()
    writer.SetEncodeAppendedData(encode)
    writer.Write()


def legacy(grid, name, binary, version):
    writer = vtk.vtkUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(name)
    (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
    writer.SetFileVersion(version)
    writer.Write()


pathlib.Path("cube.geo").write_text(GEO)
gmsh("-3", "-format", "msh41", "-o", "cube_41_ascii.msh")
gmsh("-3", "-format", "msh41", "-bin", "-o", "cube_41_binary.msh")
gmsh("-3", "-format", "msh22", "-o", "cube_22_ascii.msh")
gmsh("-3", "-format", "msh22", "-bin", "-o", "cube_22_binary.msh")
gmsh("-3", "-format", "mesh", "-o", "cube.mesh")
gmsh("-2", "-format", "stl", "-o", "cube_ascii.stl")
gmsh("-2", "-format", "stl", "-bin", "-o", "cube_binary.stl")
gmsh("-2", "-format", "ply2", "-o", "cube_unread.ply2")
pathlib.Path("cube_unread.ply2").unlink()
pathlib.Path("cube.geo").unlink()

mesh = meshio.read("cube_22_ascii.msh")
tets = mesh.cells_dict["tetra"]
triangles = mesh.cells_dict["triangle"]
meshio.write("cube_meshio_ascii.vtk", meshio.Mesh(mesh.points, [("tetra", tets)]), binary=False)
meshio.write("cube_meshio_zlib.vtu", meshio.Mesh(mesh.points, [("tetra", tets)]), compression="zlib")
meshio.write("cube_meshio_plain.vtu", meshio.Mesh(mesh.points, [("tetra", tets)]), compression=None)
surface = meshio.Mesh(mesh.points, [("triangle", triangles)])
meshio.write("cube.off", surface)
meshio.write("cube.obj", surface)
meshio.write("cube_ascii.ply", surface, binary=False)
meshio.write("cube_binary.ply", surface, binary=True)

points = vtk.vtkPoints()
points.SetDataTypeToDouble()
for p in mesh.points:
    points.InsertNextPoint(p)
grid = vtk.vtkUnstructuredGrid()
grid.SetPoints(points)
for triangle in triangles:
    grid.InsertNextCell(vtk.VTK_TRIANGLE, 3, [int(v) for v in triangle])
for tet in tets:
    grid.InsertNextCell(vtk.VTK_TETRA, 4, [int(v) for v in tet])
vtu(grid, "cube_vtk_ascii.vtu", "ascii", False)
vtu(grid, "cube_vtk_base64.vtu", "binary", False)
vtu(grid, "cube_vtk_zlib.vtu", "binary", True, header64=True)
vtu(grid, "cube_vtk_appended_raw.vtu", "appended", False, encode=False)
vtu(grid, "cube_vtk_appended_base64.vtu", "appended", False, header64=True)
vtu(grid, "cube_vtk_appended_raw_zlib.vtu", "appended", True, encode=False)
vtu(grid, "cube_vtk_appended_base64_zlib.vtu", "appended", True)
for binary in (False, True):
    for number, version in (("42", 42), ("51", 51)):
        legacy(grid, f"cube_vtk_{number}_{'binary' if binary else 'ascii'}.vtk", binary, version)

seeds = numpy.array([[0.25, 0.5, 0.75, 0.125], [0.1, 0.2, 0.3, -4.0], [1.0, 2.0, 3.0, 0.0]])
numpy.save("seeds_c.npy", seeds)
numpy.save("seeds_fortran.npy", numpy.asfortranarray(seeds))
numpy.save("seeds_float.npy", seeds.astype(">f4"))
numpy.save("seeds_int.npy", numpy.array([[1, 2, 3], [4, 5, 6]], dtype=numpy.int32))
