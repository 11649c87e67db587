#!/usr/bin/env python3
"""Writes pretzel.off: python3 make_pretzel.py pretzel.off   (Debian's package python3-vtk9)

The surface is the zero set of a smooth minimum of the distances to three tilted tori: closed, of genus 3. It is
contoured on a grid, smoothed and decimated to 6,000 triangles. No unit.
"""

import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

GRID = 128
TRIANGLES = 6000
BLEND = 0.10  # distance within which two rings blend


def torus(x, y, z, angle):
    """Distance to a ring of radii .62 and .19, its centre .66 from the axis, tilted about its radius."""
    c, s = np.cos(angle), np.sin(angle)
    u, v = c * x + s * y - 0.66, -s * x + c * y
    tilt = np.radians(24)
    v, w = np.cos(tilt) * v + np.sin(tilt) * z, -np.sin(tilt) * v + np.cos(tilt) * z
    return np.hypot(np.hypot(u, v) - 0.62, w) - 0.19


def field():
    axis = np.linspace(-1.65, 1.65, GRID)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    rings = [torus(x, y, z, 2 * np.pi * k / 3) for k in range(3)]
    return axis, -BLEND * np.log(sum(np.exp(-d / BLEND) for d in rings))


def surface():
    axis, values = field()
    image = vtk.vtkImageData()
    image.SetDimensions(GRID, GRID, GRID)
    image.SetOrigin(axis[0], axis[0], axis[0])
    image.SetSpacing(*[axis[1] - axis[0]] * 3)
    image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
    contour = vtk.vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0.0)
    smooth = vtk.vtkWindowedSincPolyDataFilter()
    smooth.SetInputConnection(contour.GetOutputPort())
    smooth.SetNumberOfIterations(30)
    smooth.SetPassBand(0.05)
    contour.Update()
    thin = vtk.vtkQuadricDecimation()
    thin.SetInputConnection(smooth.GetOutputPort())
    thin.SetTargetReduction(1 - TRIANGLES / contour.GetOutput().GetNumberOfPolys())
    thin.Update()
    mesh = thin.GetOutput()
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    triangles = vtk_to_numpy(mesh.GetPolys().GetData()).reshape(-1, 4)[:, 1:]
    return points, triangles


def check(points, triangles):
    """Checks that the mesh is closed, oriented and of genus 3 (Euler characteristic -4)."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    key = edges[:, 0].astype(np.int64) * len(points) + edges[:, 1]
    twin = edges[:, 1].astype(np.int64) * len(points) + edges[:, 0]
    assert len(np.unique(key)) == len(key) and set(key) == set(twin), "not closed"
    assert len(points) - len(edges) // 2 + len(triangles) == -4, "not of genus 3"


def main():
    points, triangles = surface()
    check(points, triangles)
    with open(sys.argv[1], "w") as out:
        out.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        out.writelines("%.5f %.5f %.5f\n" % tuple(p) for p in points)
        out.writelines("3 %d %d %d\n" % tuple(t) for t in triangles)


main()
