"""powercell.voronoi against scipy.spatial.Voronoi, and against Diagram where there are weights or a domain."""

import itertools
import pathlib

import numpy as np
import pytest
import powercell as pc

spatial = pytest.importorskip("scipy.spatial")
RNG = np.random.default_rng(7)
TURN = np.arange(12) * np.pi / 6
CASES = {
    "plane": RNG.random((300, 2)),
    "space": RNG.random((300, 3)),
    "square grid": np.array(list(itertools.product(range(6), repeat=2)), float),
    "cubic grid": np.array(list(itertools.product(range(4), repeat=3)), float),
    "circle": np.concatenate([np.stack([np.cos(TURN), np.sin(TURN)], axis=1), [[0, 0]]]),
    "square's corners": np.concatenate([RNG.random((20, 2)), list(itertools.product((0, 1), repeat=2))]),
    "cube's corners": np.concatenate([RNG.random((30, 3)), list(itertools.product((0, 1), repeat=3))]),
    "integers": np.unique(RNG.integers(0, 5, (60, 3)), axis=0).astype(float),
    "three": np.array([[0, 0], [1, 0], [0, 1.0]]),
    "far away": RNG.random((50, 2)) + 1000,
    # scipy/spatial/tests/test_qhull.py
    "scipy's simple": np.array(
        [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (2, 2)], float
    ),
}


def places(vertices, row):
    found = vertices[[k for k in row if k >= 0]]
    return found[np.lexsort(np.round(found, 6).T)]


@pytest.mark.parametrize("name", CASES)
def test_ridges_and_regions_are_those_of_scipy(name):
    points = CASES[name]
    mine, theirs = pc.voronoi(points), spatial.Voronoi(points)
    assert mine.vertices.shape == theirs.vertices.shape
    assert set(mine.ridge_dict) == {tuple(sorted(pair)) for pair in theirs.ridge_points.tolist()}
    for pair, row in theirs.ridge_dict.items():
        own = mine.ridge_dict[min(pair), max(pair)]
        assert len(own) == len(row) and (-1 in own) == (-1 in row)
        expected = places(theirs.vertices, row)
        assert places(mine.vertices, own) == pytest.approx(expected, rel=1e-6, abs=1e-6)
    for i in range(len(points)):
        own, row = mine.regions[mine.point_region[i]], theirs.regions[theirs.point_region[i]]
        assert len(own) == len(row) and (-1 in own) == (-1 in row)
        if -1 in row:
            assert np.isinf(mine.volumes[i])
        else:
            hull = spatial.ConvexHull(theirs.vertices[row])
            assert mine.volumes[i] == pytest.approx(hull.volume, rel=1e-9)
    assert not mine.hidden.any() and not mine.furthest_site


def turn_of(corners):
    a, b = corners - np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0) - corners
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def test_regions_of_the_plane_go_round_and_begin_where_they_are_open():
    v = pc.voronoi(CASES["plane"])
    for row in v.regions:
        if row[0] != -1:
            assert (turn_of(v.vertices[row]) > 0).all()
        elif len(row) > 3:
            assert (turn_of(v.vertices[row[1:]])[1:-1] > 0).all()


def test_walls_of_space_are_convex_polygons_in_order():
    v = pc.voronoi(CASES["space"])
    for (i, j), row in v.ridge_dict.items():
        corners = v.vertices[[k for k in row if k >= 0]]
        axis = v.points[j] - v.points[i]
        sides = np.roll(corners, -1, axis=0) - corners
        turn = np.cross(np.roll(sides, 1, axis=0), sides) @ axis
        turn = turn[1:-1] if row[0] == -1 else turn
        assert (turn > 0).all() or (turn < 0).all() or len(corners) < 4


@pytest.mark.parametrize("d", [2, 3])
def test_with_weights_the_inner_cells_are_those_of_a_box(d):
    points, weights = RNG.random((400, d)), RNG.random(400) * 0.004
    box = pc.Domain.box([0] * d, [1] * d)
    diagram = pc.Diagram(box, points, weights)
    v = pc.voronoi(points, weights)
    inside = ((v.vertices > 0) & (v.vertices < 1)).all(axis=1)
    inner = [
        i
        for i in np.flatnonzero(~v.hidden)
        if -1 not in v.regions[v.point_region[i]] and inside[v.regions[v.point_region[i]]].all()
    ]
    assert len(inner) > 100
    assert v.volumes[inner] == pytest.approx(diagram.mass[inner], rel=1e-10)
    assert (diagram.mass[v.hidden] == 0).all()


@pytest.mark.parametrize("d", [2, 3])
def test_cells_of_a_domain_have_their_neighbours_and_share_vertices(d):
    points, weights = RNG.random((200, d)), RNG.random(200) * 0.004
    box = pc.Domain.box([0] * d, [1] * d)
    diagram, v = pc.Diagram(box, points, weights), pc.voronoi(points, weights, domain=box)
    expected = {(min(i, j), max(i, j)) for i in range(200) for j in diagram.adjacency.neighbors(i).tolist()}
    assert set(v.ridge_dict) == expected
    assert v.volumes.tolist() == diagram.mass.tolist()
    assert (v.hidden == (diagram.mass == 0)).all()
    shared = np.bincount(np.concatenate(v.regions), minlength=len(v.vertices))
    inside = ((v.vertices > 1e-9) & (v.vertices < 1 - 1e-9)).all(axis=1)
    assert (shared[inside] == d + 1).all()
    for (i, j), row in v.ridge_dict.items():
        x = v.vertices[row]
        power = [((x - points[k]) ** 2).sum(axis=1) - weights[k] for k in (i, j)]
        assert power[0] == pytest.approx(power[1], abs=1e-12)


@pytest.mark.parametrize("name", ["disk", "ball", "italy.geojson", "bracket.mesh"])
def test_walls_that_a_domain_cuts_in_parts_are_all_there(name):
    path = pathlib.Path(__file__).resolve().parents[2] / "examples" / "data" / name
    domain = pc.read_domain(str(path) if path.exists() else name)
    points = np.asarray(domain.random_points(60)[1])
    diagram, v = pc.Diagram(domain, points), pc.voronoi(points, domain=domain)
    size = np.zeros(60)
    for (i, j), row in zip(v.ridge_points, v.ridge_vertices):
        x = v.vertices[row] - v.vertices[row[0]]
        part = np.linalg.norm(x[1]) if domain.dimension == 2 else np.linalg.norm(np.cross(x[1:-1], x[2:]).sum(axis=0)) / 2
        size[[i, j]] += part
    walls = np.add.reduceat(np.append(diagram.adjacency.data, 0), diagram.adjacency.indptr[:-1])
    assert size == pytest.approx(walls, rel=1e-6)


def test_far_from_the_origin_vertices_are_shared_and_ties_one():
    grid = np.array(list(itertools.product(range(6), repeat=2)), float) + 2.0**20
    assert len(pc.voronoi(grid).vertices) == 25
    box = pc.Domain.box(grid.min(axis=0) - 0.5, grid.max(axis=0) + 0.5)
    assert len(pc.voronoi(grid, domain=box).vertices) == 49
    random = RNG.random((50, 2)) + 1e6
    v = pc.voronoi(random, domain=pc.Domain.box([1e6, 1e6], [1e6 + 1, 1e6 + 1]))
    assert len(v.vertices) == 2 * len(v.points) + 2  # Euler, with three walls or sides at each vertex


def test_scipy_draws_it():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    figure = spatial.voronoi_plot_2d(pc.voronoi(CASES["plane"]))
    assert len(figure.axes[0].collections) == 2


def test_refusals_say_what_to_do():
    for points in ([[0, 0]], [[0, 0], [1, 1], [2, 2]]):
        with pytest.raises(ValueError, match="give a domain"):
            pc.voronoi(points)
    assert pc.voronoi([[0.5, 0.5]], domain=pc.Domain.box([0, 0], [1, 1])).volumes.tolist() == [1]
    with pytest.raises(ValueError, match=r"\(n, 2\) or \(n, 3\)"):
        pc.voronoi(np.zeros((5, 4)))
    with pytest.raises(ValueError, match="periodic"):
        pc.voronoi([[0.5, 0.5]], domain=pc.Domain.box([0, 0], [1, 1], periodic=True))
    with pytest.raises(ValueError, match="a domain in space"):
        pc.voronoi(np.eye(3), domain=pc.read_domain("sphere"))
    duplicates = pc.voronoi([[0, 0], [1, 0], [0, 1], [0, 0]])
    assert duplicates.hidden.tolist() == [False, False, False, True] and duplicates.point_region[3] == -1
    assert repr(duplicates).startswith("Voronoi") and "ridge_vertices: list of 3" in repr(duplicates)
