"""Seeds as users have them: radii, tables, series with labels, and what is refused."""

import warnings

import numpy as np
import pytest

import powercell as pc

SQUARE = pc.Domain.box([0, 0], [1, 1])
POINTS = np.random.default_rng(1).random((40, 2))
WEIGHTS = 0.01 * np.random.default_rng(2).random(40)


def test_radii_are_squared():
    radii = np.sqrt(WEIGHTS)
    assert np.array_equal(pc.Diagram(SQUARE, POINTS, radii=radii).mass, pc.Diagram(SQUARE, POINTS, radii * radii).mass)
    with pytest.raises(ValueError, match="pass one of them"):
        pc.Diagram(SQUARE, POINTS, WEIGHTS, radii=radii)
    with pytest.raises(ValueError, match="radii: row 3 is negative"):
        pc.Diagram(SQUARE, POINTS, radii=np.where(np.arange(40) == 3, -1, radii))


def test_new_weights_may_be_radii():
    diagram = pc.Diagram(SQUARE, POINTS)
    diagram.set_weights(radii=np.sqrt(WEIGHTS))
    assert np.array_equal(diagram.mass, pc.Diagram(SQUARE, POINTS, radii=np.sqrt(WEIGHTS)).mass)
    with pytest.raises(ValueError, match="weights or radii are expected"):
        diagram.set_weights()


def test_most_seeds_hidden_is_warned_of_once():
    radii = np.linspace(0.5, 60, 40)
    diagram = pc.Diagram(SQUARE, POINTS, radii)
    with pytest.warns(pc.HiddenSeedsWarning, match=r"of 40 seeds are hidden.* radii="):
        hidden = np.count_nonzero(diagram.status == pc.Status.HIDDEN)
    assert hidden > 20
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert diagram.mass.sum() == pytest.approx(1)
        assert pc.Diagram(SQUARE, POINTS, WEIGHTS).mass.sum() == pytest.approx(1)
        assert pc.Diagram(SQUARE, np.repeat(POINTS, 3, axis=0)).mass.sum() == pytest.approx(1)  # duplicates
        far = np.concatenate([POINTS[:5], 5 + POINTS])  # outside, not hidden by weights
        assert np.count_nonzero(pc.Diagram(SQUARE, far, 1e-4 * np.arange(45)).status == pc.Status.HIDDEN) > 25
    diagram.set_weights(2 * radii)
    with pytest.warns(pc.HiddenSeedsWarning):
        diagram.mass


def test_set_seeds_keeps_weights_or_refuses_to_guess():
    diagram = pc.Diagram(SQUARE, POINTS, WEIGHTS)
    moved = POINTS[::-1].copy()
    diagram.set_seeds(moved)
    assert np.array_equal(diagram.mass, pc.Diagram(SQUARE, moved, WEIGHTS).mass)
    with pytest.raises(ValueError, match="10 seeds without weights follow 40 with weights; pass weights, or np.zeros"):
        diagram.set_seeds(POINTS[:10])
    assert len(diagram) == 40
    diagram.set_seeds(POINTS[:10], np.zeros(10))
    diagram.set_seeds(POINTS[:20])
    assert np.array_equal(diagram.mass, pc.Diagram(SQUARE, POINTS[:20]).mass)
    diagram.set_seeds(POINTS, radii=np.sqrt(WEIGHTS))
    assert diagram.weights == pytest.approx(WEIGHTS)


def test_rows_are_signed_integers():
    adjacency = pc.Diagram(SQUARE, POINTS).adjacency
    assert adjacency.indptr.dtype == np.int64 and adjacency.indices.dtype == np.int32
    rows = np.repeat(np.arange(40), np.diff(adjacency.indptr))
    assert (adjacency.indices - rows).min() < 0
    assert adjacency.to_scipy().nnz == len(rows)
    walls = pc.Diagram(SQUARE, POINTS).boundary_walls
    assert walls.indptr.dtype == np.int64 and walls.indices.dtype == np.int32
    cells, joined = pc.Diagram(SQUARE, POINTS).cells, pc.Diagram(SQUARE, POINTS).joined
    assert len(np.repeat(np.arange(40), np.diff(cells.cell_offset))) == len(cells.region)
    assert {cells.region.dtype, cells.border.dtype, joined.loop.dtype} == {np.dtype(np.int32)}
    assert pc.regular_triangulation(POINTS).dtype == pc.Diagram(SQUARE, POINTS).dual.dtype == np.int32


def test_tables_go_by_names_and_labels():
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame({"y": POINTS[:, 1], "x": POINTS[:, 0]}, index=[f"s{k}" for k in range(40)])
    series = pandas.Series(WEIGHTS, index=table.index)
    expected = pc.Diagram(SQUARE, POINTS, WEIGHTS).mass
    assert np.array_equal(pc.Diagram(SQUARE, table, series).mass, expected)
    assert np.array_equal(pc.Diagram(SQUARE, table, series.sample(frac=1, random_state=1)).mass, expected)
    with pytest.raises(ValueError, match=r"weights has other labels than positions; pass weights\.to_numpy\(\)"):
        pc.Diagram(SQUARE, table, series.reset_index(drop=True))
    assert np.array_equal(pc.Diagram(SQUARE, table, series.reset_index(drop=True).to_numpy()).mass, expected)
    table["w"] = WEIGHTS
    assert np.array_equal(pc.Diagram(SQUARE, table, "w").mass, expected)
    with pytest.raises(ValueError, match="positions has a column 'w' that is not used; pass weights='w', or drop it"):
        pc.Diagram(SQUARE, table)
    with pytest.raises(ValueError, match="only where positions are a table"):
        pc.Diagram(SQUARE, POINTS, "w")
    geopandas = pytest.importorskip("geopandas")
    points = geopandas.GeoDataFrame(table, geometry=geopandas.points_from_xy(POINTS[:, 0], POINTS[:, 1]))
    assert np.array_equal(pc.Diagram(SQUARE, points, "w").mass, expected)
    assert np.array_equal(pc.Diagram(SQUARE, points, radii="w").mass, pc.Diagram(SQUARE, POINTS, WEIGHTS**2).mass)
    with pytest.raises(ValueError, match=r"weights is 'v'; the columns are \["):
        pc.Diagram(SQUARE, points, "v")


def test_other_names_are_answered():
    diagram = pc.Diagram(SQUARE, POINTS)
    for name, known in (("volumes", "mass"), ("centroids", "centroid"), ("adjacancy", "adjacency"), ("neighbours", "adjacency")):
        with pytest.raises(AttributeError, match=f"no '{name}'; did you mean '{known}'"):
            getattr(diagram, name)
    with pytest.raises(AttributeError, match="no 'qqqq'$"):
        diagram.qqqq
    with pytest.raises(ValueError, match="positions has the type bool"):
        pc.Diagram(SQUARE, POINTS > 0.5)


def test_other_arguments_are_answered():
    for call, meant in (
        (lambda: pc.Diagram(SQUARE, POINTS, weight=WEIGHTS), "weights"),
        (lambda: pc.Diagram(SQUARE, POINTS, radius=WEIGHTS), "radii"),
        (lambda: pc.Diagram(SQUARE, sites=POINTS), "positions"),
        (lambda: pc.Diagram(SQUARE, POINTS).set_seeds(POINTS, weigths=WEIGHTS), "weights"),
        (lambda: pc.Domain.box([0, 0], [1, 1], period=True), "periodic"),
        (lambda: pc.transport(SQUARE, POINTS, tol=1e-3), "tolerance"),
        (lambda: pc.transport(SQUARE, POINTS, mass=WEIGHTS), "masses"),
        (lambda: pc.Diagram(SQUARE, POINTS).compute(walls=True), "adjacency"),
        (lambda: pc.transport(SQUARE, POINTS, max_iter=5), "max_steps"),
        (lambda: pc.sample(SQUARE, 10, seed=1), "random_seed"),
        (lambda: pc.treemap({"a": 1}, n_jobs=2), "threads"),
    ):
        with pytest.raises(TypeError, match=f"has no argument .*; did you mean '{meant}'\\?"):
            call()
    with pytest.raises(TypeError, match=r"^Diagram\(\) has no argument 'gravity'$"):
        pc.Diagram(SQUARE, POINTS, gravity=9.81)
    with pytest.raises(TypeError, match="positions"):  # what Python says itself
        pc.Diagram(SQUARE, POINTS, positions=POINTS)


def test_applications_take_the_seeds_of_diagrams():
    pandas = pytest.importorskip("pandas")
    geopandas = pytest.importorskip("geopandas")
    wanted = 1 + np.arange(40.0)
    wanted /= wanted.sum()
    expected = pc.transport(SQUARE, POINTS, wanted)
    labels = [f"s{k}" for k in range(40)]
    table = geopandas.GeoDataFrame(
        {"share": wanted}, geometry=geopandas.points_from_xy(*POINTS.T), index=labels
    )
    assert np.array_equal(pc.transport(SQUARE, table, "share").weights, expected.weights)
    shuffled = pandas.Series(wanted, index=labels).sample(frac=1, random_state=1)
    solver = pc.TransportSolver(SQUARE, table, shuffled)
    assert np.array_equal(solver.solve().weights, expected.weights)
    solver.set_masses(shuffled)
    solver.set_weights(pandas.Series(expected.weights, index=labels).iloc[::-1])
    assert solver.solve().mass == pytest.approx(wanted, rel=1e-6)
    diagram = pc.Diagram(SQUARE, pandas.DataFrame(POINTS, columns=["x", "y"], index=labels))
    diagram.set_weights(pandas.Series(expected.weights, index=labels).iloc[::-1])
    assert diagram.mass == pytest.approx(wanted, rel=1e-6)
    assert np.array_equal(pc.spacing(SQUARE, table).least, pc.spacing(SQUARE, POINTS).least)
    assert pc.sample(SQUARE, table, iterations=1).positions.shape == (40, 2)


def test_single_precision_is_given_when_asked_for():
    double, single = pc.Diagram(SQUARE, POINTS, WEIGHTS), pc.Diagram(SQUARE, POINTS, WEIGHTS, dtype=np.float32)
    for name in ("mass", "centroid", "second_moment"):
        assert getattr(single, name).dtype == np.float32
        assert np.array_equal(getattr(single, name), getattr(double, name).astype(np.float32), equal_nan=True)
    assert single.adjacency.data.dtype == single.boundary_walls.data.dtype == np.float32
    assert double.mass.dtype == double.adjacency.data.dtype == np.float64
    with pytest.raises(ValueError, match="dtype is int64; float32 or float64 is expected"):
        pc.Diagram(SQUARE, POINTS, dtype=int)


def test_results_show_their_fields():
    assert repr(pc.spacing(SQUARE, POINTS)).startswith("Spacing(least=0.")
    text = repr(pc.transport(SQUARE, POINTS))
    assert "converged: True" in text and "weights: float64 array of (40,)" in text
    assert "object at" not in repr(pc.Diagram(SQUARE, POINTS).joined) + repr(pc.sample(SQUARE, 5))


def test_columns_of_maps_go_by_their_names():
    pandas = pytest.importorskip("pandas")
    expected = pc.Diagram(SQUARE, POINTS).mass
    for x, y in (("lon", "lat"), ("Easting", "Northing"), ("longitude", "latitude")):
        table = pandas.DataFrame({y: POINTS[:, 1], x: POINTS[:, 0], "name": "a"})
        assert np.array_equal(pc.Diagram(SQUARE, table).mass, expected)
    unnamed = pandas.DataFrame(POINTS)
    assert np.array_equal(pc.Diagram(SQUARE, unnamed.convert_dtypes()).mass, expected)
    for wrong in ({"x": 1.0, "z": 2.0}, {"x": 1.0, "X": 2.0}, {"a": 1.0, "b": 2.0, "c": 3.0}):
        with pytest.raises(ValueError, match=r"positions has the columns \[.*\]; x, y are expected"):
            pc.Diagram(SQUARE, pandas.DataFrame([wrong]))
    with pytest.raises(ValueError, match="positions: the column 'x' has the type (object|str); numbers are expected"):
        pc.Diagram(SQUARE, pandas.DataFrame({"x": ["a"], "y": [1.0]}))


def test_labels_are_followed_in_loops():
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame(POINTS, columns=["x", "y"], index=[f"s{k}" for k in range(40)])
    weights = pandas.Series(WEIGHTS, index=table.index)
    diagram = pc.Diagram(SQUARE, table, weights)
    first = diagram.mass
    diagram.set_seeds(table[::-1])
    assert np.array_equal(diagram.weights, WEIGHTS[::-1]) and diagram.mass == pytest.approx(first[::-1])
    moved = pc.TransportSolver(SQUARE, table)
    with pytest.raises(ValueError, match="positions has other labels than before; pass positions.to_numpy"):
        moved.move_seeds(table.rename(index=lambda name: name + "x"))
    with pytest.raises(ValueError, match="points: row 0 is a str; points are expected|points is 'x'"):
        pc.sample(SQUARE, "x")
    with pytest.raises(ValueError, match="other labels than before; pass weights"):
        diagram.set_seeds(table.rename(index=lambda name: name + "x"))
    solver = pc.TransportSolver(SQUARE, table, weights + 1, rescale=True)
    expected = solver.solve().weights
    solver.move_seeds(table[::-1])
    assert solver.solve().weights == pytest.approx(expected)
    geopandas = pytest.importorskip("geopandas")
    cells = solver.diagram.to_geopandas()
    assert isinstance(cells, geopandas.GeoDataFrame) and list(cells.index) == list(table.index)


def test_what_read_seeds_returns_are_seeds(tmp_path):
    path = tmp_path / "seeds.csv"
    rows = [f"{x},{y},{w},{k + 1}" for k, ((x, y), w) in enumerate(zip(POINTS, WEIGHTS))]
    path.write_text("\n".join(["x,y,weight,size", *rows]))
    seeds = pc.read_seeds(path)
    diagram = pc.Diagram(SQUARE, seeds)
    assert np.array_equal(diagram.mass, pc.Diagram(SQUARE, POINTS, WEIGHTS).mass)
    assert np.array_equal(pc.Diagram(SQUARE, seeds, 0 * WEIGHTS).mass, pc.Diagram(SQUARE, POINTS).mass)
    assert pc.transport(SQUARE, seeds, "size", rescale=True).mass[1:] == pytest.approx(np.arange(2, 41) / 820, rel=1e-5)
    with pytest.raises(ValueError, match=r"positions is 'seeds\.csv'; read_seeds\(\) reads files"):
        pc.Diagram(SQUARE, "seeds.csv")
    for header, cell, message in (
        ("x,y,radius (mm)", "1", "radius_column="),
        ("x,y,w", "a", "'a'"),
        ("x,y,w", "", r"seeds\.csv:2"),
    ):
        path.write_text(f"{header}\n0.5,0.5,{cell}\n")
        with pytest.raises(pc.Error, match=message) as caught:
            pc.read_seeds(path)
        assert "--" not in str(caught.value) and "3 coordinates" not in str(caught.value)


def test_columns_of_positions_may_be_chosen(tmp_path):
    path = tmp_path / "seeds.csv"
    path.write_text("id,lon,lat,X_m,Y_m\n" + "".join(f"{k},1,2,{x},{y}\n" for k, (x, y) in enumerate(POINTS)))
    seeds = pc.read_seeds(path, position_columns=("X_m", "Y_m"))
    assert seeds.positions == pytest.approx(POINTS)
    path.write_text("x,X,y\n1,2,3\n")
    with pytest.raises(pc.Error, match="choose with position_columns"):
        pc.read_seeds(path, dimension=2)
    assert pc.read_seeds(path, position_columns=("2", "3")).positions.tolist() == [[2, 3]]


def test_geometries_that_are_no_points_are_named():
    shapely = pytest.importorskip("shapely")
    geopandas = pytest.importorskip("geopandas")
    box = shapely.box(0, 0, 1, 1)
    for wrong in (geopandas.GeoSeries([shapely.Point(0, 0), box]), [shapely.Point(0, 0), box]):
        with pytest.raises(ValueError, match="positions: row 1 is a Polygon; points are expected"):
            pc.Diagram(SQUARE, wrong)
    with pytest.raises(ValueError, match="positions is a single Point; a list of points is expected"):
        pc.Diagram(SQUARE, shapely.Point(0, 0))
    high = geopandas.GeoSeries.from_xy(*POINTS.T, z=POINTS[:, 0])
    cube = pc.Domain.box([0, 0, 0], [1, 1, 1])
    assert np.array_equal(pc.Diagram(cube, high).positions[:, 2], POINTS[:, 0])
    assert np.array_equal(pc.Diagram(SQUARE, high).positions, POINTS)


def test_degrees_are_refused():
    shapely = pytest.importorskip("shapely")
    geopandas = pytest.importorskip("geopandas")
    box = shapely.box(0, 0, 1, 1)
    with pytest.raises(ValueError, match="shape is in degrees"):
        pc.Domain.polygon(box, crs=4326)
    with pytest.raises(ValueError, match="names no coordinate system"):
        pc.Domain.polygon(geopandas.GeoSeries([box], crs=3035), crs="banana")
    with pytest.raises(ValueError, match="crs is 'banana', which names no coordinate system"):
        pc.Domain.polygon(box, crs="banana")
    with pytest.raises(ValueError, match=r"shape is in EPSG:3035, but crs is 25832; use shape\.to_crs\(25832\)"):
        pc.Domain.polygon(geopandas.GeoSeries([box], crs=3035), crs=25832)
    points = geopandas.GeoSeries.from_xy(*POINTS.T, crs=4326)
    with pytest.raises(ValueError, match="positions are in degrees .EPSG:4326., but the domain has no coordinate system"):
        pc.Diagram(SQUARE, points)
    assert pc.Domain.polygon(box, crs=4326, degrees=True).crs == 4326


def test_pictures_take_values_by_label_and_show_images():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame(POINTS, columns=["x", "y"], index=[f"s{k}" for k in range(40)])
    table["kind"] = pandas.Categorical(["a", "b"] * 20)
    diagram = pc.Diagram(SQUARE, table)
    values = pandas.Series(np.arange(40.0), index=table.index)
    drawn = [diagram.plot(color=color).collections[0].get_array() for color in (values, values[::-1], "kind")]
    assert np.array_equal(drawn[0], drawn[1]) and np.array_equal(drawn[2], [0, 1] * 20)
    assert diagram.plot(color="red").collections[0].get_array() is None
    with pytest.raises(ValueError, match=r"color has the shape \(3,\); \(40,\) is expected"):
        diagram.plot(color=values.to_numpy()[:3])
    periodic = pc.Diagram(pc.Domain.box([0, 0], [1, 1], periodic=True), POINTS)
    paths = periodic.plot().collections[0].get_paths()
    assert len(paths) > 40  # cells that cross the border are there on both sides
    area = sum(polygon.area for polygon in shapely_boxes(paths))
    assert area == pytest.approx(1)
    pyplot.close("all")


def shapely_boxes(paths):
    """What is seen of paths in the unit square."""
    shapely = pytest.importorskip("shapely")
    seen = shapely.box(0, 0, 1, 1)
    return [shapely.Polygon(path.to_polygons()[0]).intersection(seen) for path in paths]


def test_results_leave_a_process():
    import copy
    import pickle

    result = pc.transport(SQUARE, POINTS)
    for other in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):
        assert other.cost == result.cost and np.array_equal(other.weights, result.weights)
        assert repr(other) == repr(result)
    diagram = pc.Diagram(SQUARE, POINTS)
    rows, joined = pickle.loads(pickle.dumps((diagram.adjacency, diagram.joined)))
    assert np.array_equal(rows.indices, diagram.adjacency.indices) and len(rows.neighbors(0)) > 2
    assert np.array_equal(joined.loop, diagram.joined.loop)


def test_shifts_are_in_periods():
    for low, high in (([0, 0], [2, 1]), ([0, 0, 0], [2, 1, 1])):
        domain = pc.Domain.box(low, high, periodic=True)
        points = np.random.default_rng(3).random((30, len(low))) * high
        diagram = pc.Diagram(domain, points)
        rows = np.repeat(np.arange(30), np.diff(diagram.adjacency.indptr))
        images = points[diagram.adjacency.indices] + diagram.adjacency.shift @ domain.periods
        assert np.linalg.norm(images - points[rows], axis=1).max() < 2
        assert diagram.dual_shift.shape[1:] == (len(low) + 1, len(low))
        assert diagram.cells.shift.shape[1] == diagram.joined.shift.shape[1] == len(low)
