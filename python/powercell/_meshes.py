"""Repair and remeshing of triangle meshes, and simple shapes."""

from __future__ import annotations

from typing import Any, Optional

from numpy.typing import ArrayLike

from . import _core
from ._device import DeviceLike, optional_device
from ._names import named_arguments
from ._progress import Progress, fraction_bar
from ._shapes import surface_arrays


@named_arguments
def remesh(
    vertices: Any,
    triangles: Optional[ArrayLike] = None,
    count: int = 5000,
    *,
    method: str = "fpo",
    gradation: float = 0.2,
    contrast: float = 4.0,
    sharp_angle: float = 45.0,
    rounds: int = 20,
    relaxations: int = 15,
    random_seed: int = 1,
    repair: bool = True,
    device: DeviceLike = None,
    progress: Progress = None,
) -> Any:
    """A new triangle mesh of a surface with a given number of vertices and well-shaped triangles.

    Parameters
    ----------
    vertices : (nv, 3) array_like
        Or, alone, a mesh of meshio, trimesh or PyVista.
    triangles : (nt, 3) array_like of int
    count : int
        Vertices of the new mesh.
    method : {"fpo", "transport"}
        Farthest-point optimisation, or points moved to centroids of cells of equal mass.
    gradation, contrast : float
        Limits on the gradient of the edge length, and on the ratio of two; 1 for an even mesh.
    sharp_angle : float
        Degrees; edges with a larger angle between normals are kept.
    rounds, relaxations, random_seed : int
    repair : bool
        Mend faults of the input first; see ``result.repair.acts``.

    Returns
    -------
    RemeshResult
        With vertices, triangles, sizing, repair, collapsed, inseparable and intersections (a count and a place).

    Examples
    --------
    >>> import powercell as pc
    >>> pc.remesh(*pc.sphere(8), count=200).vertices.shape
    (200, 3)
    """
    if count < 4:
        raise ValueError(f"count is {count}; at least 4 is expected")
    points, corners = surface_arrays(vertices, triangles)
    given = {
        "method": method,
        "count": count,
        "gradation": gradation,
        "contrast": contrast,
        "sharp_angle": sharp_angle,
        "rounds": rounds,
        "relaxations": relaxations,
        "random_seed": random_seed,
        "repair": repair,
    }
    with fraction_bar(progress, "remeshing") as report:
        return _core.remesh(points, corners, given, optional_device(device), report)


@named_arguments
def repair(vertices: Any, triangles: Optional[ArrayLike] = None, weld: float = -1.0) -> Any:
    """Mends faults of a triangle mesh that lose nothing of its shape.

    Parameters
    ----------
    vertices, triangles
        As for :func:`remesh`.
    weld : float
        Distance up to which boundary edges are joined; below 0: chosen from the coordinates.

    Returns
    -------
    RepairedMesh
        With ``mesh.vertices``, ``mesh.triangles`` and ``report``: ``acts`` and ``left`` in words, ``degenerate``,
        ``welded`` and others as counts with a place.
    """
    points, corners = surface_arrays(vertices, triangles)
    return _core.repair(points, corners, weld)


def mesh_quality(vertices: Any, triangles: Optional[ArrayLike] = None) -> Any:
    """Quality of a triangle mesh: q_min, q_mean, angles, topology."""
    return _core.mesh_quality(*surface_arrays(vertices, triangles))


def farthest_from(a: Any, b: Any, samples: int = 200_000) -> float:
    """How far one surface is from another: the largest distance from ``b`` of the vertices of ``a`` and of points
    spread over it. A lower bound of the one-sided Hausdorff distance, short by at most the spacing of the points.

    Parameters
    ----------
    a, b
        Each a pair of vertices and triangles, as for :func:`remesh`, or a mesh of meshio, trimesh or PyVista.
    samples : int
        About how many points.

    Examples
    --------
    >>> import powercell as pc
    >>> vertices, triangles = pc.sphere(8)
    >>> round(pc.farthest_from((2 * vertices, triangles), (vertices, triangles)), 6)
    1.0
    """
    both = [surface_arrays(*mesh) if isinstance(mesh, tuple) else surface_arrays(mesh, None) for mesh in (a, b)]
    return float(_core.farthest_from(*both[0], *both[1], {"samples": samples}))


def sphere(resolution: int = 16) -> tuple[Any, Any]:
    """Vertices and triangles of the unit sphere: 10 r^2 + 2 and 20 r^2."""
    mesh = _core.shape_sphere(resolution)
    return mesh.vertices, mesh.triangles


def torus(resolution: int = 32) -> tuple[Any, Any]:
    """Vertices and triangles of the torus with radii 1 and 0.4 about the z axis."""
    mesh = _core.shape_torus(resolution)
    return mesh.vertices, mesh.triangles


def ball(resolution: int = 8) -> tuple[Any, Any]:
    """Vertices and tetrahedra of the unit ball: 8 r^3 tetrahedra."""
    mesh = _core.shape_ball(resolution)
    return mesh.vertices, mesh.tetrahedra
