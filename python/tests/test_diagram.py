"""Diagrams against brute force and other packages, and what their results promise."""

import gc
import types
import weakref

import numpy as np
import pytest

import powercell as pc


def owners(positions, weights, x):
    """The seed of least power distance to each point, by trying all."""
    distance = ((x[:, None, :] - positions[None]) ** 2).sum(axis=2) - weights
    return distance.argmin(axis=1)


@pytest.mark.parametrize("d", [2, 3])
def test_measures_match_random_points(rng, d):
    p, w = rng.random((40, d)), rng.random(40) * 0.05
    diagram = pc.Diagram(pc.Domain.box([0] * d, [1] * d), p, w)
    x = rng.random((200_000, d))
    owner = owners(p, w, x)
    share = np.bincount(owner, minlength=40) / len(x)
    assert np.abs(diagram.mass - share).max() < 5e-3
    assert diagram.mass.sum() == pytest.approx(1, abs=1e-13)
    assert diagram.domain_measure == 1
    big = int(diagram.mass.argmax())
    assert np.abs(diagram.centroid[big] - x[owner == big].mean(axis=0)).max() < 5e-3
    moment = ((x[owner == big] - p[big]) ** 2).sum() / len(x)
    assert diagram.second_moment[big] == pytest.approx(moment, rel=0.05)
    hidden = diagram.status == pc.Status.HIDDEN
    assert np.array_equal(hidden, diagram.mass == 0)
    assert np.isnan(diagram.centroid[hidden]).all()


def test_voronoi_cells_are_those_of_scipy(rng):
    spatial = pytest.importorskip("scipy.spatial")
    p = rng.random((300, 3))
    low, high = -9 * np.ones(3), 10 * np.ones(3)
    diagram = pc.Diagram(pc.Domain.box(low, high), p)
    voronoi = spatial.Voronoi(p)
    bounded = [i for i in range(300) if -1 not in voronoi.regions[voronoi.point_region[i]]]
    inner = [
        i
        for i in bounded
        if (np.abs(voronoi.vertices[voronoi.regions[voronoi.point_region[i]]]) < 9).all()
    ]
    assert len(inner) > 100
    for i in inner:
        hull = spatial.ConvexHull(voronoi.vertices[voronoi.regions[voronoi.point_region[i]]])
        assert diagram.mass[i] == pytest.approx(hull.volume, rel=1e-9)
    pairs = {tuple(sorted(pair)) for pair in voronoi.ridge_points.tolist()}
    for i in inner:
        expected = {a + b - i for a, b in pairs if i in (a, b)}
        assert set(diagram.adjacency.neighbors(i).tolist()) == expected


def test_adjacency_is_a_sparse_matrix(rng, cube):
    sparse = pytest.importorskip("scipy.sparse")
    diagram = pc.Diagram(cube, rng.random((200, 3)))
    matrix = diagram.adjacency.to_scipy()
    assert sparse.issparse(matrix) and matrix.shape == (200, 200)
    assert abs(matrix - matrix.T).max() == 0
    assert matrix.nnz == len(diagram.adjacency.indices)


def test_results_are_read_only_views_that_outlive_the_seeds(square):
    diagram = pc.Diagram(square, [[0.25, 0.5], [0.75, 0.5]])
    mass, walls = diagram.mass, diagram.adjacency
    with pytest.raises(ValueError):
        mass[0] = 3
    assert np.shares_memory(mass, diagram.mass)
    diagram.set_weights([0.1, 0])
    assert mass.tolist() == [0.5, 0.5]
    assert diagram.mass.round(12).tolist() == [0.6, 0.4]
    diagram.set_seeds([[0.5, 0.5]], [0])
    assert diagram.mass.tolist() == [1.0] and mass.tolist() == [0.5, 0.5]
    del diagram
    gc.collect()
    assert mass.tolist() == [0.5, 0.5] and walls.data.tolist() == [1.0, 1.0]


def test_compute_makes_measures_and_adjacency_in_one_pass(rng, cube):
    diagram = pc.Diagram(cube, rng.random((500, 3))).compute(adjacency=True)
    first = diagram.timings.total
    diagram.mass, diagram.adjacency.data
    assert diagram.timings.total == first


def test_cells_joined_and_dual(rng):
    ring = np.array([[0, 0], [4, 0], [4, 4], [0, 4]])
    hole = np.array([[1, 1], [1, 3], [3, 3], [3, 1]])
    diagram = pc.Diagram(pc.Domain.polygon([ring, hole]), rng.random((30, 2)) * 4)
    cells, joined = diagram.cells, diagram.joined
    assert len(cells.cell_offset) == 31 and cells.vertices.shape[1] == 2
    assert set(np.unique(cells.border[:, 0])) <= {0, 1, 2}
    area = 0.0
    for f in range(len(joined.loop_offset) - 1):
        cell = np.searchsorted(joined.face_offset, f, side="right") - 1
        loop = joined.loop[joined.loop_offset[f] : joined.loop_offset[f + 1]]
        x, y = joined.vertices[joined.vertex_offset[cell] + loop].T
        area += (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
    assert area == pytest.approx(12)
    assert diagram.dual.shape[1] == 3 and diagram.dual.max() < 30


def test_surface_and_volume(rng):
    vertices, triangles = pc.sphere(8)
    surface = pc.Diagram(pc.Domain.surface(vertices, triangles), rng.normal(size=(50, 3)))
    assert surface.mass.sum() == pytest.approx(surface.domain.measure)
    assert surface.domain.kind == "surface" and surface.domain.cell_dimension == 2
    volume = pc.Diagram(pc.Domain.volume(*pc.ball(4)), rng.normal(size=(50, 3)) / 3)
    assert volume.mass.sum() == pytest.approx(volume.domain.measure)
    assert volume.dual.shape[1] == 4


def test_periodic_box_and_lattice(rng, cube):
    diagram = pc.Diagram(pc.Domain.box([0] * 3, [1] * 3, periodic=True), [[0.5, 0.5, 0.5]])
    assert diagram.mass == pytest.approx([1.0], abs=1e-14)
    walls = diagram.adjacency
    assert walls.indices.tolist() == [0] * 6 and walls.data == pytest.approx([1.0] * 6)
    assert sorted(map(tuple, walls.shift.tolist())) == sorted(
        [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    )
    some = pc.Diagram(pc.Domain.box([0, 0], [2, 1], periodic=[True, False]), rng.random((20, 2)))
    assert some.mass.sum() == pytest.approx(2)
    lattice = pc.Domain.lattice([[1, 0], [0.5, 0.75**0.5]])
    assert pc.Diagram(lattice, [[0.1, 0.2]]).adjacency.data == pytest.approx([3**-0.5] * 6)
    assert lattice.periods == pytest.approx(np.array([[1, 0], [0.5, 0.75**0.5]]))
    assert pc.Diagram(cube, [[0.5] * 3]).adjacency.shift is None


def test_periodic_duals_name_images(rng):
    p = rng.random((30, 2))
    domain = pc.Domain.box([0, 0], [1, 1], periodic=True)
    diagram = pc.Diagram(domain, p)
    assert len(diagram.dual) == 60 and diagram.dual_shift.shape == (60, 3, 2)  # Euler: two triangles a seed
    corners = p[diagram.dual] + diagram.dual_shift @ domain.periods
    first, second = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    area = (first[0] * second[1] - first[1] * second[0]) / 2
    assert area.sum() == pytest.approx(1) and area.min() > 0


def test_solid(rng):
    vertices, triangles = pc.sphere(8)
    solid = pc.Domain.solid(vertices, triangles)
    assert solid.is_solid and not pc.Domain.surface(vertices, triangles).is_solid
    p = rng.normal(size=(50, 3)) / 2
    diagram = pc.Diagram(solid, p)
    assert diagram.mass.sum() == pytest.approx(solid.measure, rel=1e-12)
    inside = pc.Diagram(pc.Domain.volume(*pc.ball(8)), p)
    assert np.abs(diagram.mass / diagram.mass.sum() - inside.mass / inside.mass.sum()).max() < 0.01
    joined = diagram.joined
    volume = np.zeros(50)
    for cell in range(50):
        x = joined.vertices[joined.vertex_offset[cell] : joined.vertex_offset[cell + 1]]
        for f in range(joined.face_offset[cell], joined.face_offset[cell + 1]):
            a, *rest = x[joined.loop[joined.loop_offset[f] : joined.loop_offset[f + 1]]]
            for b, c in zip(rest[:-1], rest[1:]):
                volume[cell] += np.linalg.det([a, b, c]) / 6
    assert volume == pytest.approx(diagram.mass, abs=1e-13)
    assert diagram.dual.shape[1] == 4 and len(diagram.dual) > 0
    cells = np.count_nonzero(diagram.mass)
    assert diagram.to_pyvista().n_cells == cells
    assert sum(len(block) for block in diagram.to_meshio().cell_data["seed"]) == cells
    with pytest.raises(pc.Error, match="joined"):
        diagram.cells
    with pytest.raises(pc.Error, match="open|edge"):
        pc.Domain.solid(vertices, triangles[1:])


def test_wrapped_points():
    box = pc.Domain.box([0, 0], [1, 2], periodic=[True, False])
    assert box.wrapped([[1.25, 3], [-0.25, 1]]).tolist() == [[0.25, 3], [0.75, 1]]


def test_laws_hold(rng, cube):
    diagram = pc.Diagram(cube, rng.random((100, 3)), rng.random(100) * 0.01, certify=True)
    checks = diagram.verify()
    assert checks and all(check.passed for check in checks)


def test_precision_decisions_and_threads(rng, square):
    p = rng.random((100, 2))
    exact = pc.Diagram(square, p, threads=1)
    fast = pc.Diagram(square, p, decisions="fast", neighbors="tree", chunk_pairs=10)
    single = pc.Diagram(square, p, precision="float")
    assert exact.precision == "double" and single.precision == "float"
    assert np.abs(exact.mass - fast.mass).max() < 1e-12
    assert np.abs(exact.mass - single.mass).max() < 1e-5


def test_regular_triangulation_is_that_of_scipy(rng):
    spatial = pytest.importorskip("scipy.spatial")
    p = rng.random((100, 2))
    ours = {tuple(sorted(row)) for row in pc.regular_triangulation(p).tolist()}
    assert ours == {tuple(sorted(row)) for row in spatial.Delaunay(p).simplices.tolist()}
    assert pc.regular_triangulation(p, np.arange(100.0)).shape[1] == 3


def test_objects_are_freed(rng, square):
    diagram = pc.Diagram(square, rng.random((10, 2)))
    gone = weakref.ref(diagram)
    mass = diagram.mass
    del diagram
    gc.collect()
    assert gone() is None and len(mass) == 10


def test_a_loop_of_diagrams_leaks_nothing(square):
    resource = pytest.importorskip("resource")
    p = np.random.default_rng(2).random((50, 2))

    def run(count):
        for _ in range(count):
            d = pc.Diagram(square, p)
            d.adjacency.data, d.mass, d.cells.vertices
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    before = run(300)
    assert run(2000) - before < 8_000  # KiB; 2,000 diagrams with results have 40,000


def test_cells_of_some_seeds(rng, cube):
    positions = rng.random((200, 3))
    every = pc.Diagram(cube, positions)
    some = pc.Diagram(cube, positions)
    chosen = np.array([150, 3, 77])
    some.select(chosen)
    np.testing.assert_allclose(some.mass, every.mass[chosen], rtol=1e-12)
    assert some.status.shape == (3,) and some.centroid.shape == (3, 3)
    matrix = some.adjacency.to_scipy()
    assert matrix.shape == (3, 200)
    assert abs(matrix - every.adjacency.to_scipy()[chosen]).max() < 1e-12
    assert "selected" in some._repr_html_()
    for refused in (some.to_pyvista, some.to_meshio):
        with pytest.raises(ValueError, match="call select_all"):
            refused()
    with pytest.raises(pc.Error, match="select_all"):
        some.verify()
    for wrong, message in (([0, 200], "entry 1"), ([5, 5], "again")):
        with pytest.raises(pc.Error, match=message):
            some.select(wrong)
    for wrong in ([-1], [0.5], [[1]]):
        with pytest.raises(ValueError, match="seeds"):
            some.select(wrong)
    assert len(some.mass) == 3
    some.select([])
    assert some.mass.shape == (0,)
    some.select_all()
    np.testing.assert_array_equal(some.mass, every.mass)
    some.select([1])
    some.set_seeds(positions[:50])
    assert some.mass.shape == (50,)


def test_facets_sum_to_the_boundary(rng, cube):
    walls = pc.Diagram(cube, rng.random((100, 3))).boundary_walls
    np.testing.assert_allclose(np.bincount(walls.indices, walls.data), np.ones(6), rtol=1e-12)
    assert walls.indptr.shape == (101,)


def test_flann_options_change_the_way_and_not_the_cells(rng, cube):
    p, w = rng.random((300, 3)), rng.random(300) * 0.02
    tree = pc.Diagram(cube, p, w)
    assert tree.neighbors == "tree"
    for options in ({"initial_neighbors": 4}, {"lift_eta": 0.5}, {"twin_queries": False}):
        flann = pc.Diagram(cube, p, w, neighbors="flann", **options)
        assert flann.neighbors == "flann" and flann.mass == pytest.approx(tree.mass, abs=1e-12)
    few = pc.Diagram(cube, p, w, neighbors="flann", initial_neighbors=4)
    many = pc.Diagram(cube, p, w, neighbors="flann", initial_neighbors=299)
    assert few.compute().timings.rounds > many.compute().timings.rounds == 1
    with pytest.raises(pc.Error, match="the height of the lift, -1"):
        pc.Diagram(cube, p, w, neighbors="flann", lift_eta=-1).mass
    with pytest.raises(ValueError, match="initial_neighbors is -1"):
        pc.Diagram(cube, p, initial_neighbors=-1)


def test_a_selection_shows(rng, square):
    diagram = pc.Diagram(square, rng.random((20, 2)))
    assert not diagram.has_selection
    diagram.select([3, 1])
    assert diagram.has_selection and len(diagram.mass) == 2
    diagram.select_all()
    assert not diagram.has_selection and len(diagram.mass) == 20


def test_walls_tell_how_well_their_sides_agree(rng, cube):
    grid = np.stack(np.meshgrid(*[np.arange(4) / 4 + 0.125] * 3), axis=-1).reshape(-1, 3)
    walls = pc.Diagram(cube, grid).adjacency
    assert walls.asymmetry < 1e-15
    walls = pc.Diagram(cube, rng.random((2000, 3)), precision="float").adjacency
    i, j = walls.asymmetric
    assert 1e-12 < walls.asymmetry < 1e-5 and j in walls.neighbors(i) and i in walls.neighbors(j)


def saved(d, **changed):
    fields = dict(
        kind=d.domain.kind,
        positions=d.positions,
        weights=d.weights,
        mass=d.mass,
        centroid=d.centroid,
        status=d.status,
        domain_measure=d.domain_measure,
        cells=d.joined,
    )
    return pc.SavedDiagram(**{**fields, **changed})


@pytest.mark.parametrize("kind", ["square", "cube", "sphere", "solid"])
def test_saved_diagrams_are_checked(rng, kind):
    sphere = pc.sphere(4)
    domain = {
        "square": lambda: pc.Domain.box([0, 0], [1, 1]),
        "cube": lambda: pc.Domain.box([0, 0, 0], [1, 1, 1]),
        "sphere": lambda: pc.Domain.surface(*sphere),
        "solid": lambda: pc.Domain.solid(*sphere),
    }[kind]()
    d = pc.Diagram(domain, rng.random((60, domain.dimension)), rng.random(60) * 0.01)
    checks = saved(d).verify()
    assert len(checks) > 5 and all(check.passed for check in checks), [c.detail for c in checks if not c.passed]
    assert all(check.passed for check in saved(d, centroid=None).verify())
    mass = d.mass.copy()
    largest = int(mass.argmax())
    mass[largest] *= 1.001
    wrong = [check for check in saved(d, mass=mass).verify() if not check.passed]
    assert wrong and any(str(largest) in check.detail for check in wrong)


def test_saved_diagrams_are_not_trusted(rng, square):
    d = pc.Diagram(square, rng.random((10, 2)))
    names = [name for name in dir(d.joined) if not name.startswith("_")]
    members = {name: getattr(d.joined, name) for name in names}

    def cells(**changed):
        return types.SimpleNamespace(**{**members, **changed})

    assert all(check.passed for check in saved(d, cells=cells()).verify())
    assert all(check.passed for check in saved(d, cells=cells(), weights=None).verify())
    with pytest.raises(pc.Error) as caught:
        saved(d, cells=cells(loop=members["loop"] + 1000)).verify()
    assert caught.value.code == "invalid_argument"
    with pytest.raises(pc.Error):
        saved(d, cells=cells(loop_offset=members["loop_offset"][:-1])).verify()
    torus = pc.Diagram(pc.Domain.box([0, 0], [1, 1], periodic=True), d.positions)
    for part, change in (
        ("the cells are periodic", {"cells": torus.joined}),
        ("status: row 0 is 3", {"status": np.full(10, 3)}),
        ("status: row 0 has a number below 0", {"status": np.full(10, -1)}),
        (r"mass has the shape \(9,\)", {"mass": d.mass[:9]}),
        ("kind is 'disk'", {"kind": "disk"}),
        ("precision is 'auto'", {"precision": "auto"}),
        ("cells.edge_border: row 0 is 3", {"cells": cells(edge_border=np.full((4, 2), 3))}),
        ("cells has no cell_dimension", {"cells": None}),
    ):
        with pytest.raises(ValueError, match=part):
            saved(d, **change).verify()
