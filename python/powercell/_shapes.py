"""Geometry of other packages as plain arrays."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._arrays import Reals, indices, reals


def _rings(polygon: Any) -> list[Reals]:
    return [reals(np.asarray(ring, dtype=float)[:, :2], "shape", (None, 2)) for ring in polygon]


def _parts_of_mapping(geometry: Any) -> list[list[Reals]]:
    kind = geometry.get("type")
    if kind == "Polygon":
        return [_rings(geometry["coordinates"])] if geometry["coordinates"] else []
    if kind == "MultiPolygon":
        return [_rings(polygon) for polygon in geometry["coordinates"]]
    if kind == "Feature":
        return _parts_of_mapping(geometry["geometry"]) if geometry["geometry"] else []
    members = {"FeatureCollection": "features", "GeometryCollection": "geometries"}.get(kind)
    if members is None:
        raise ValueError(f"shape is a {kind}; a polygon or several are expected")
    return [part for member in geometry[members] for part in _parts_of_mapping(member)]


def _is_numeric(value: Any) -> bool:
    try:
        return np.asarray(value).dtype.kind in "biuf"
    except ValueError:
        return False


def polygon_parts(shape: Any) -> list[list[Reals]]:
    """Per part its rings, the outer one first: of anything with ``__geo_interface__``, or of arrays."""
    mapping = getattr(shape, "__geo_interface__", shape if isinstance(shape, dict) else None)
    if mapping is None and not hasattr(shape, "__len__"):
        raise ValueError(f"shape is a {type(shape).__name__}; a polygon or several are expected")
    if mapping is not None:
        return _parts_of_mapping(mapping)
    if isinstance(shape, np.ndarray) or (len(shape) and _is_numeric(shape[0]) and np.ndim(shape[0]) == 1):
        return [[reals(shape, "shape", (None, 2))]]
    if all(_is_numeric(ring) and np.ndim(ring) == 2 for ring in shape):
        return [[reals(ring, f"shape: ring {k}", (None, 2)) for k, ring in enumerate(shape)]]
    return [
        [reals(ring, f"shape: part {p}, ring {k}", (None, 2)) for k, ring in enumerate(part)]
        for p, part in enumerate(shape)
    ]


def crs_of(shape: Any) -> Optional[Any]:
    return getattr(shape, "crs", None)


def require_same_crs(points: Any, domain_crs: Any) -> None:
    crs: Any = crs_of(points)
    if domain_crs is None and is_geographic(crs):
        raise ValueError(
            f"positions are in degrees ({crs.to_string()}), but the domain has no coordinate system: project both to one "
            "plane, and name it (Domain.polygon(shape, crs=...))"
        )
    if crs is not None and domain_crs is not None and crs != domain_crs:
        raise ValueError(
            f"positions are in {crs.to_string()}, but the domain is in {domain_crs}: bring them together, e.g. "
            "positions.to_crs(domain.crs)"
        )


def is_geographic(crs: Any) -> bool:
    """Whether it is in degrees, as far as it can be told."""
    if crs is not None and not hasattr(crs, "is_geographic"):
        try:
            import pyproj
        except ImportError:
            return False
        try:
            crs = pyproj.CRS.from_user_input(crs)
        except pyproj.exceptions.CRSError:
            raise ValueError(f"crs is {crs!r}, which names no coordinate system") from None
    return bool(getattr(crs, "is_geographic", False))


def _cells_of(mesh: Any, kind: str, vtk_type: int) -> Optional[Any]:
    by_name = getattr(mesh, "cells_dict", None)  # meshio: by name; PyVista: by the type of VTK
    if by_name is None:
        return None
    for key in (kind, vtk_type):
        if key in by_name:
            return by_name[key]
    raise ValueError(f"the mesh has no cells of the kind {kind}; it has {', '.join(map(str, by_name))}")


def surface_arrays(vertices: Any, triangles: Any) -> tuple[Any, Any]:
    """Vertices and triangles of arrays, or of an object of meshio, trimesh or PyVista."""
    if triangles is None:
        mesh = vertices
        points = getattr(mesh, "vertices", None) if hasattr(mesh, "faces") else None
        if points is not None:  # trimesh
            vertices, triangles = points, mesh.faces
        elif hasattr(mesh, "regular_faces"):  # PyVista
            flat = mesh if mesh.is_all_triangles else mesh.triangulate()
            vertices, triangles = flat.points, flat.regular_faces
        elif (cells := _cells_of(mesh, "triangle", 5)) is not None:
            vertices, triangles = mesh.points, cells
        else:
            raise ValueError("vertices and triangles, or a mesh of meshio, trimesh or PyVista are expected")
    return reals(vertices, "vertices", (None, 3)), indices(triangles, "triangles", 3)


def volume_arrays(vertices: Any, tetrahedra: Any) -> tuple[Any, Any]:
    """Vertices and tetrahedra of arrays, or of an object of meshio or PyVista."""
    if tetrahedra is None:
        mesh = vertices
        cells = _cells_of(mesh, "tetra", 10)
        if cells is None:
            raise ValueError("vertices and tetrahedra, or a mesh of meshio or PyVista are expected")
        vertices, tetrahedra = mesh.points, cells
    return reals(vertices, "vertices", (None, 3)), indices(tetrahedra, "tetrahedra", 4)
