"""pyvoro's functions, computed by powercell: ``import powercell.compat.pyvoro as pyvoro``.

Arguments and results are those of pyvoro 1.3. Decisions are exact, and ``dispersion`` and ``z_height``, which choose the
blocks of voro++, change nothing. A seed hidden by others has a cell of volume 0 without faces. The order of vertices and
faces is another.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from .. import Diagram, Domain

Cells = list[dict[str, Any]]
WALL = 0  # the kind of a border with another cell


def compute_voronoi(
    points: Any,
    limits: Any,
    dispersion: float = 0,
    radii: Any = (),
    periodic: Sequence[bool] = (False, False, False),
) -> Cells:
    """The cells of seeds in a box.

    Parameters
    ----------
    points : n sequences of 3 floats, or (n, 3) array
    limits : 3 pairs
        Low and high of the box along each axis.
    dispersion : float
        Not used.
    radii : n floats, optional
        Radii of balls: the cells are those of weights radii**2.
    periodic : 3 bools

    Returns
    -------
    list of dict
        For each seed ``volume``, ``vertices``, ``adjacency`` (the neighbours of each vertex along edges), ``faces`` (each with
        ``vertices`` in a loop and ``adjacent_cell``) and ``original``, the point as given. ``adjacent_cell`` is -1 and -2 at the low
        and high side of x, -3 and -4 of y, -5 and -6 of z. Vertices are of the class of the points.

    Raises
    ------
    ValueError
        Sizes; a point outside the box.
    """
    return _cells(points, limits, radii, periodic, 3)


def compute_2d_voronoi(
    points: Any,
    limits: Any,
    dispersion: float = 0,
    radii: Any = (),
    periodic: Sequence[bool] = (False, False),
    z_height: float = 0.5,
) -> Cells:
    """The same in the plane, where ``volume`` is an area and a face an edge of two vertices."""
    return _cells(points, limits, radii, periodic, 2)


def _cells(points: Any, limits: Any, radii: Any, periodic: Sequence[bool], d: int) -> Cells:
    given = [list(point) for point in points]
    seeds = np.asarray(given, dtype=float).reshape(-1, d) if given else np.empty((0, d))
    if len(seeds) != len(given):
        raise ValueError(f"points: {d} coordinates each are expected")
    sides = np.asarray(limits, dtype=float)
    if sides.shape != (d, 2):
        raise ValueError(f"limits has the shape {sides.shape}; {d} pairs of low and high are expected")
    low, high = sides[:, 0], sides[:, 1]
    bounded = ~np.asarray(periodic, dtype=bool)
    outside = (((seeds < low) | (seeds > high)) & bounded).any(axis=1)
    if outside.any():
        raise ValueError(f"point {int(outside.argmax())} is outside the limits")
    size: Optional[NDArray[np.float64]] = None
    if len(radii) > 0:
        size = np.asarray(radii, dtype=float)
    if not given:
        return []
    diagram = Diagram(Domain.box(low, high, periodic=list(periodic)), seeds, radii=size)
    made = _constructor(points[0])
    joined, volume = diagram.joined, diagram.mass.tolist()
    faces = _faces_3d(joined) if d == 3 else _faces_2d(joined)
    vertices, first = joined.vertices.tolist(), joined.vertex_offset.tolist()
    cells = []
    for i, begin in enumerate(first[:-1]):
        corners = vertices[begin : first[i + 1]]
        cells.append(
            {
                "volume": volume[i],
                "vertices": corners if made is list else [made(x) for x in corners],
                "adjacency": _adjacency(faces[i], len(corners)),
                "faces": [
                    {"adjacent_cell": j if kind == WALL else _side([corners[k] for k in loop], low, high), "vertices": loop}
                    for kind, j, loop in faces[i]
                ],
                "original": points[i],
            }
        )
    return cells


def _constructor(point: Any) -> Callable[[list[float]], Any]:
    return np.array if isinstance(point, np.ndarray) else type(point)


Face = tuple[int, int, list[int]]  # kind and index of the border, vertices


def _faces_3d(joined: Any) -> list[list[Face]]:
    border, loop, offset = joined.face_border.tolist(), joined.loop.tolist(), joined.loop_offset.tolist()
    face = [(kind, j, loop[offset[f] : offset[f + 1]]) for f, (kind, j) in enumerate(border)]
    first = joined.face_offset.tolist()
    return [face[a:b] for a, b in zip(first, first[1:])]


def _faces_2d(joined: Any) -> list[list[Face]]:
    border, loop, offset = joined.edge_border.tolist(), joined.loop.tolist(), joined.loop_offset.tolist()
    edges = [
        [(*border[a + k], [loop[a + k], loop[a + (k + 1) % (b - a)]]) for k in range(b - a)]
        for a, b in zip(offset, offset[1:])
    ]
    first = joined.face_offset.tolist()
    return [[edge for f in range(a, b) for edge in edges[f]] for a, b in zip(first, first[1:])]


def _adjacency(faces: list[Face], count: int) -> list[list[int]]:
    neighbors: list[list[int]] = [[] for _ in range(count)]
    for _, _, loop in faces:
        a = loop[-1]
        for b in loop:
            if b not in neighbors[a]:
                neighbors[a].append(b)
            if a not in neighbors[b]:
                neighbors[b].append(a)
            a = b
    return neighbors


def _side(corners: list[list[float]], low: NDArray[np.float64], high: NDArray[np.float64]) -> int:
    """voro++'s number of the side of the box that a face is in."""
    x = np.array(corners)
    off = np.stack([np.abs(x - low).max(axis=0), np.abs(x - high).max(axis=0)], axis=1) / (high - low)[:, None]
    return -1 - int(off.argmin())
