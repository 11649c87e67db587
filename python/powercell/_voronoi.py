"""Power diagrams with the attributes of ``scipy.spatial.Voronoi``."""

from __future__ import annotations

import itertools
from typing import Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import reals
from ._device import DeviceLike
from ._diagram import Diagram
from ._domain import Domain, require_domain
from ._frames import checked_values
from ._names import lines_of, named_arguments
from ._triangulation import regular_triangulation

Reals = NDArray[np.float64]
Integers = NDArray[np.intp]

SAME_CENTER = 1e-10  # centres of adjacent simplices, relative to their distance from the seeds: a tie
SAME_VERTEX, SAME_VERTEX_FLOAT = 1e-11, 1e-5  # vertices of cells of a domain, relative to its extent


class Voronoi:
    """Cells of the whole space or of a domain. See :func:`voronoi`.

    Attributes
    ----------
    points : (n, d) float64
    weights : (n,) float64 or None
    vertices : (m, d) float64
        Shared by the cells. Vertices that coincide by a tie are one.
    ridge_points : (r, 2) int32
        The two seeds of each wall. In a domain whose shape cuts a wall in parts a pair stands once for each.
    ridge_vertices : list of r lists
        The vertices of each wall in order, -1 first where it is unbounded.
    regions : list of lists
        The vertices of each cell, in the plane counterclockwise, with -1 first where it is unbounded.
    point_region : (n,) intp
        The region of each seed; -1 where it is hidden.
    volumes : (n,) float64
        Areas in the plane; infinite where a cell is unbounded, 0 where a seed is hidden.
    hidden : (n,) bool
        Seeds without a cell, duplicates among them.
    ridge_dict : dict
        (i, j) to the vertices of their wall.
    min_bound, max_bound : (d,) float64
        Of the seeds.
    furthest_site : bool
        False.
    """

    furthest_site = False

    def __init__(self, points: Reals, weights: Optional[Reals]) -> None:
        self.points = points
        self.weights = weights
        self.npoints, self.ndim = points.shape
        self.min_bound, self.max_bound = points.min(axis=0), points.max(axis=0)
        self.vertices: Reals = np.empty((0, self.ndim))
        self.ridge_points: NDArray[np.int32] = np.empty((0, 2), np.int32)
        self.ridge_vertices: list[list[int]] = []
        self.regions: list[list[int]] = []
        self.point_region: Integers = np.full(self.npoints, -1)
        self.volumes: Reals = np.zeros(self.npoints)
        self.hidden = np.ones(self.npoints, dtype=bool)

    def __repr__(self) -> str:
        shown = ("points", "vertices", "ridge_points", "ridge_vertices", "regions", "point_region", "volumes", "hidden")
        return lines_of("Voronoi", {name: getattr(self, name) for name in shown})

    @property
    def ridge_dict(self) -> dict[tuple[int, int], list[int]]:
        return {(int(i), int(j)): ridge for (i, j), ridge in zip(self.ridge_points, self.ridge_vertices)}

    def _set_regions(self, seed: Integers, region: list[list[int]]) -> None:
        self.regions = region
        self.point_region[seed] = np.arange(len(seed))
        self.hidden[seed] = False


@named_arguments
def voronoi(
    points: ArrayLike,
    weights: Optional[ArrayLike] = None,
    *,
    domain: Optional[Domain] = None,
    device: DeviceLike = None,
    threads: int = 0,
) -> Voronoi:
    """The cells of seeds as ``scipy.spatial.Voronoi`` has them, with weights.

    Parameters
    ----------
    points : (n, 2) or (n, 3) array_like
    weights : (n,) array_like, optional
        Squared lengths. Without them the Voronoi diagram.
    domain : Domain, optional
        Cells end at it. Without one they are those of the whole space, and some are unbounded.
    device, threads
        As for :class:`Diagram`.

    Returns
    -------
    Voronoi
        ``scipy.spatial.voronoi_plot_2d`` draws it.

    Raises
    ------
    ValueError
        Fewer than d + 1 seeds with cells, or all on a line or plane.

    Examples
    --------
    >>> import powercell as pc
    >>> v = pc.voronoi([[0, 0], [0, 2], [2, 0], [2, 2], [1, 1]])
    >>> v.vertices.tolist(), round(float(v.volumes[4]), 12)
    ([[0.0, 1.0], [1.0, 0.0], [1.0, 2.0], [2.0, 1.0]], 2.0)
    """
    seeds = reals(points, "points", (None, None))
    if seeds.shape[1] not in (2, 3):
        raise ValueError(f"points has the shape {seeds.shape}; (n, 2) or (n, 3) is expected")
    given = checked_values(weights, points, len(seeds), "weights")
    result = Voronoi(seeds, given)
    if domain is None:
        _fill_from_space(result, regular_triangulation(seeds, given, device=device, threads=threads))
    else:
        require_domain(domain)
        if domain.is_periodic:
            raise ValueError("cells of a periodic domain share no vertices; use Diagram(...).joined")
        if domain.cell_dimension != domain.dimension or domain.dimension != result.ndim:
            raise ValueError(f"a domain in {'the plane' if result.ndim == 2 else 'space'} is expected, as the seeds; use Diagram")
        diagram = Diagram(domain, seeds, given, device=device, threads=threads)
        _fill_from_cells(result, diagram)
    return result


def _components(count: int, a: Integers, b: Integers) -> Integers:
    """The least member of the component of each of `count` nodes with edges a-b."""
    label = np.arange(count)
    while True:
        before = label.copy()
        least = np.minimum(label[a], label[b])
        np.minimum.at(label, a, least)
        np.minimum.at(label, b, least)
        label = label[label]
        if np.array_equal(label, before):
            return label


def _by_angle(plane: Reals, group: Integers) -> Integers:
    """Orders rows by group, and in each counterclockwise about the mean of its points in a plane."""
    count = np.bincount(group)
    mean = np.stack([np.bincount(group, plane[:, k]) for k in (0, 1)], axis=1) / count[:, None]
    off = plane - mean[group]
    return np.lexsort((np.arctan2(off[:, 1], off[:, 0]), group))


def _across(along: Reals, x: Reals) -> Reals:
    """Coordinates of points of space in planes across directions, right-handed about them."""
    axis = np.zeros_like(along)
    axis[np.arange(len(along)), np.abs(along).argmin(axis=1)] = 1
    u = np.cross(along, axis)
    u /= np.linalg.norm(u, axis=1)[:, None]
    v = np.cross(along / np.linalg.norm(along, axis=1)[:, None], u)
    return np.stack([(x * u).sum(axis=1), (x * v).sum(axis=1)], axis=1)


def _opened(row: list[int], ends: tuple[int, int]) -> list[int]:
    """A row whose ends are neighbours in its cycle, from one end to the other, after -1."""
    if len(row) > 1:
        at = row.index(ends[0])
        row = row[at:] + row[:at]
        if row[1] == ends[1] and len(row) > 2:
            row = row[1:] + row[:1]
    return [-1, *row]


class _Simplices:
    """The regular triangulation with the centres of its simplices, and which facets they share."""

    def __init__(self, points: Reals, weights: Optional[Reals], simplices: NDArray[np.int32]) -> None:
        d = points.shape[1]
        corner = points[simplices]
        along = corner[:, 1:] - corner[:, :1]
        right = (along**2).sum(axis=2) / 2
        if weights is not None:
            right -= (weights[simplices[:, 1:]] - weights[simplices[:, :1]]) / 2
        flat = np.linalg.det(along) == 0  # too flat for doubles
        along[flat] += np.eye(d) * np.finfo(float).eps * np.abs(along[flat]).max(axis=(1, 2), initial=0)[:, None, None]
        off = np.linalg.solve(along, right[:, :, None])[:, :, 0]
        center = corner[:, 0] + off

        facets = np.sort(np.concatenate([np.delete(simplices, k, axis=1) for k in range(d + 1)]), axis=1)
        of = np.tile(np.arange(len(simplices)), d + 1)
        order = np.lexsort(facets.T[::-1])
        facets, of = facets[order], of[order]
        first = np.flatnonzero((facets[1:] == facets[:-1]).all(axis=1))
        alone = np.ones(len(facets), dtype=bool)
        alone[first] = alone[first + 1] = False
        a, b = of[first], of[first + 1]
        reach = np.maximum(np.linalg.norm(off[a], axis=1), np.linalg.norm(off[b], axis=1))
        between = corner[a, 0] - corner[b, 0] + (off[a] - off[b])  # exact far from the origin too
        tie = np.linalg.norm(between, axis=1) <= SAME_CENTER * reach
        kept, vertex = np.unique(_components(len(simplices), a[tie], b[tie]), return_inverse=True)
        place = np.lexsort(center[kept].T[::-1])  # an order that no triangulation of ties decides
        rank = np.empty_like(place)
        rank[place] = np.arange(len(place))
        self.center = center[kept[place]]
        self.vertex = rank[vertex]  # of each simplex
        self.shared = facets[first], self.vertex[a], self.vertex[b]
        self.outer = facets[alone], self.vertex[of[alone]]


def _fill_from_space(result: Voronoi, simplices: NDArray[np.int32]) -> None:
    if len(simplices) == 0:
        where = "on a line" if result.ndim == 2 else "in a plane"
        raise ValueError(f"the seeds with cells are {where} or too few; give a domain, in which they have cells")
    made = _Simplices(result.points, result.weights, simplices)
    result.vertices = made.center
    ridges = _ridges_2d(made) if result.ndim == 2 else _ridges_3d(made, result.points, simplices)
    pairs = sorted(ridges)
    result.ridge_points = np.array(pairs, np.int32).reshape(-1, 2)
    result.ridge_vertices = [ridges[pair] for pair in pairs]

    seed, vertex = np.unique(np.stack([simplices.ravel(), np.repeat(made.vertex, result.ndim + 1)]), axis=1)
    present, group = np.unique(seed, return_inverse=True)
    if result.ndim == 2:
        vertex = vertex[_by_angle(made.center[vertex], group)]
    regions = [row.tolist() for row in np.split(vertex, np.cumsum(np.bincount(group))[:-1])]
    ends: dict[int, list[int]] = {}
    for facet, at in zip(made.outer[0].tolist(), made.outer[1].tolist()):
        for k in facet:
            ends.setdefault(k, []).append(at)
    place = {int(k): at for at, k in enumerate(present)}
    for k, at in ends.items():
        row = regions[place[k]]
        regions[place[k]] = _opened(row, (at[0], at[1])) if result.ndim == 2 else [-1, *row]
    result._set_regions(present, regions)
    _set_volumes(result)
    result.volumes[list(ends)] = np.inf


def _ridges_2d(made: _Simplices) -> dict[tuple[int, int], list[int]]:
    facets, a, b = made.shared
    ridges = {(i, j): [s, t] for (i, j), s, t in zip(facets.tolist(), a.tolist(), b.tolist()) if s != t}
    ridges.update({(i, j): [-1, s] for (i, j), s in zip(made.outer[0].tolist(), made.outer[1].tolist())})
    return ridges


def _ridges_3d(
    made: _Simplices, points: Reals, simplices: NDArray[np.int32]
) -> dict[tuple[int, int], list[int]]:
    edges = np.concatenate([simplices[:, pair] for pair in itertools.combinations(range(4), 2)])
    edges.sort(axis=1)
    rows = np.unique(np.column_stack([edges, np.tile(made.vertex, 6)]), axis=0)
    edge, group = np.unique(rows[:, :2], axis=0, return_inverse=True)
    group = group.reshape(-1)
    along = points[edge[:, 1]] - points[edge[:, 0]]
    plane = _across(along[group], made.center[rows[:, 2]] - points[rows[:, 0]])
    vertex = rows[_by_angle(plane, group), 2]
    found = np.split(vertex, np.cumsum(np.bincount(group))[:-1])

    # At an edge of the hull the wall is unbounded, between the centres behind the two facets.
    facets, behind = made.outer
    hull: dict[tuple[int, int], list[int]] = {}
    for f, facet in enumerate(facets.tolist()):
        for i, j in itertools.combinations(facet, 2):
            hull.setdefault((i, j), []).append(f)
    ridges = {}
    for (i, j), row in zip(edge.tolist(), found):
        sides = hull.get((i, j))
        if sides is None:
            if len(row) > 2:
                ridges[i, j] = row.tolist()
        elif len(row) > 1:  # as in SciPy, whose walls have three vertices or more, that at infinity among them
            ridges[i, j] = _opened(row.tolist(), (int(behind[sides[0]]), int(behind[sides[1]])))
    return ridges


def _set_volumes(result: Voronoi) -> None:
    """The volume between a seed and each bounded wall of its cell, summed."""
    bounded = [k for k, row in enumerate(result.ridge_vertices) if row[0] != -1]
    if not bounded:
        return
    pair = result.ridge_points[bounded]
    rows = [result.ridge_vertices[k] for k in bounded]
    if result.ndim == 2:
        ends = result.vertices[rows]
        size = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    else:
        size = _areas(result.vertices, rows)
    between = np.linalg.norm(result.points[pair[:, 1]] - result.points[pair[:, 0]], axis=1)
    shift = np.zeros(len(pair))
    if result.weights is not None:
        shift = (result.weights[pair[:, 0]] - result.weights[pair[:, 1]]) / (2 * between)
    for side, sign in ((0, 1), (1, -1)):
        np.add.at(result.volumes, pair[:, side], size * (between / 2 + sign * shift) / result.ndim)


def _areas(vertices: Reals, rows: list[list[int]]) -> Reals:
    """Of convex polygons in space: half of the sum of triangles from the first corner."""
    count = np.array([len(row) for row in rows])
    first = np.cumsum(count) - count
    corner = vertices[np.concatenate([np.asarray(row) for row in rows])]
    off = corner - np.repeat(corner[first], count, axis=0)
    twice = np.cross(off[:-1], off[1:])
    twice[first[1:] - 1] = 0  # from the last corner of one to the first of the next
    return np.asarray(np.linalg.norm(np.add.reduceat(np.append(twice, [[0, 0, 0]], axis=0), first), axis=1) / 2)


def _same_vertices(x: Reals, distance: float) -> Integers:
    """The least row of those at the same place: two within the distance share a box in one of 2^d grids."""
    a, b = [], []
    for shift in itertools.product((0.0, 0.5), repeat=x.shape[1]):
        box = np.floor(x / (4 * distance) + shift)
        _, first, of = np.unique(box, axis=0, return_index=True, return_inverse=True)
        a.append(np.arange(len(x)))
        b.append(first[of.reshape(-1)])
    return _components(len(x), np.concatenate(a), np.concatenate(b))


def _fill_from_cells(result: Voronoi, diagram: Diagram) -> None:
    cells, domain = diagram.joined, diagram.domain
    low, high = (np.array(corner) for corner in domain.bounds)
    extent, farthest = float((high - low).max()), float(np.abs([low, high]).max())
    rounding = SAME_VERTEX * extent + 16 * float(np.finfo(float).eps) * farthest
    if diagram.precision == "float":
        rounding = SAME_VERTEX_FLOAT * extent
    kept, vertex = np.unique(_same_vertices(cells.vertices - low, rounding), return_inverse=True)
    vertex = vertex.reshape(-1)
    result.vertices = cells.vertices[kept]
    present = np.flatnonzero(np.diff(cells.vertex_offset))
    ridges: list[tuple[int, int, list[int]]] = []
    regions = []
    for i in present.tolist():
        of_cell = vertex[cells.vertex_offset[i] : cells.vertex_offset[i + 1]]
        region: list[int] = []
        for f in range(cells.face_offset[i], cells.face_offset[i + 1]):
            first, last = cells.loop_offset[f], cells.loop_offset[f + 1]
            row = of_cell[cells.loop[first:last]].tolist()
            region += row
            if result.ndim == 3:
                sides = [(*cells.face_border[f].tolist(), _without_repeats(row))]
            else:
                ends = zip(row, row[1:] + row[:1])
                sides = [(*border, list(ab)) for border, ab in zip(cells.edge_border[first:last].tolist(), ends)]
            ridges += [(i, j, side) for kind, j, side in sides if kind == 0 and i < j and len(set(side)) >= result.ndim]
        regions.append(_without_repeats(region) if result.ndim == 2 else sorted(set(region)))
    ridges.sort(key=lambda ridge: ridge[:2])
    result.ridge_points = np.array([ridge[:2] for ridge in ridges], np.int32).reshape(-1, 2)
    result.ridge_vertices = [ridge[2] for ridge in ridges]
    result._set_regions(present, regions)
    result.volumes[:] = diagram.mass


def _without_repeats(row: list[int]) -> list[int]:
    return [v for k, v in enumerate(row) if v != row[k - 1] or len(row) == 1]

