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
    with pytest.raises(ValueError, match=r"columns \['y', 'x', 'w'\]; pass table\[\['x', 'y'\]\]"):
        pc.Diagram(SQUARE, table, "w")
    with pytest.raises(ValueError, match="only of a table"):
        pc.Diagram(SQUARE, POINTS, "w")
    geopandas = pytest.importorskip("geopandas")
    points = geopandas.GeoDataFrame(table, geometry=geopandas.points_from_xy(POINTS[:, 0], POINTS[:, 1]))
    assert np.array_equal(pc.Diagram(SQUARE, points, "w").mass, expected)
    assert np.array_equal(pc.Diagram(SQUARE, points, radii="w").mass, pc.Diagram(SQUARE, POINTS, WEIGHTS**2).mass)
    with pytest.raises(ValueError, match=r"weights is 'v'; the columns are \["):
        pc.Diagram(SQUARE, points, "v")


def test_other_names_are_answered():
    diagram = pc.Diagram(SQUARE, POINTS)
    for name, known in (("volumes", "mass"), ("centroids", "centroid"), ("adjacancy", "adjacency")):
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
