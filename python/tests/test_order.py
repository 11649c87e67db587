"""Pairs of an adjacency, and bond order against closed forms and the addition theorem."""

import numpy as np
import pytest
import powercell as pc
from numpy.polynomial import legendre

RNG = np.random.default_rng(5)


def lattice(basis, cells=3):
    """A periodic cube of `cells` unit cells along each axis."""
    basis = np.array(basis, float)
    corners = np.indices((cells,) * basis.shape[1]).reshape(basis.shape[1], -1).T
    points = (corners[:, None, :] + basis).reshape(-1, basis.shape[1]) + 0.1
    domain = pc.Domain.box([0] * basis.shape[1], [cells] * basis.shape[1], periodic=True)
    return pc.Diagram(domain, points)


@pytest.mark.parametrize(
    "basis, degree, value",
    [
        ([[0, 0, 0]], 4, 0.7637626),
        ([[0, 0, 0]], 6, 0.3535534),
        ([[0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5]], 4, 0.1909407),
        ([[0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5]], 6, 0.5745243),
        ([[0, 0]], 4, 1),
        ([[0, 0]], 6, 0),
    ],
)
def test_bond_order_of_crystals(basis, degree, value):
    assert pc.minkowski(lattice(basis), degree) == pytest.approx(value, abs=1e-7)


@pytest.mark.parametrize("degree", [0, 1, 2, 6, 11, 40])
def test_bond_order_is_that_of_the_addition_theorem(degree):
    d = pc.Diagram(pc.Domain.box([0, 0, 0], [1, 1, 1]), RNG.random((60, 3)), RNG.random(60) * 0.01)
    found = pc.minkowski(d, degree)
    sides, indptr = d.adjacency.sides(), d.adjacency.indptr
    normal = sides.vector / np.linalg.norm(sides.vector, axis=1)[:, None]
    for k in range(60):
        row = slice(indptr[k], indptr[k + 1])
        if row.start == row.stop:
            assert np.isnan(found[k])
            continue
        share = sides.measure[row] / sides.measure[row].sum()
        cosine = np.clip(normal[row] @ normal[row].T, -1, 1)
        expected = np.sqrt(max(0, share @ legendre.legval(cosine, [0] * degree + [1]) @ share))
        assert found[k] == pytest.approx(expected, abs=1e-7)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("d", [2, 3])
def test_pairs_have_each_wall_once_with_the_vector_across_it(d, periodic):
    points = RNG.random((12 if periodic else 100, d))
    diagram = pc.Diagram(pc.Domain.box([0] * d, [1] * d, periodic=periodic), points)
    i, j, vector, measure = diagram.adjacency.pairs()
    assert 2 * len(i) == len(diagram.adjacency.indices) and (i <= j).all()
    assert 2 * measure.sum() == pytest.approx(diagram.adjacency.data.sum())
    assert np.remainder(vector - points[j] + points[i] + 0.5, 1) - 0.5 == pytest.approx(0, abs=1e-12)
    # A cell has the volume of the pyramids from its seed to its walls, where no wall is the domain's.
    if periodic:
        half = np.linalg.norm(vector, axis=1) / 2 * measure / d
        assert np.bincount(i, half, 12) + np.bincount(j, half, 12) == pytest.approx(diagram.mass)
    else:
        assert vector == pytest.approx(points[j] - points[i])


def test_pairs_of_one_seed_with_its_images():
    d = pc.Diagram(pc.Domain.box([0, 0, 0], [1, 2, 3], periodic=True), [[0.5, 0.5, 0.5]])
    i, j, vector, measure = d.adjacency.pairs()
    assert i.tolist() == j.tolist() == [0, 0, 0]
    order = np.abs(vector).max(axis=1).argsort()
    assert np.abs(vector[order]) == pytest.approx(np.diag([1, 2, 3]))
    assert measure[order] == pytest.approx([6, 3, 2])


def test_pairs_of_a_selection_and_refusals():
    points = RNG.random((50, 2))
    d = pc.Diagram(pc.Domain.box([0, 0], [1, 1]), points)
    every = d.adjacency.pairs()
    d.select([7, 3])
    some = d.adjacency.pairs()
    expected = {tuple(sorted(pair)) for pair in zip(every.i.tolist(), every.j.tolist()) if {3, 7} & set(pair)}
    found = [tuple(sorted(pair)) for pair in zip(some.i.tolist(), some.j.tolist())]
    assert set(found) == expected and len(found) == len(expected) and set(some.i.tolist()) == {3, 7}
    with pytest.raises(ValueError, match="0 to 40"):
        pc.minkowski(d, 41)
    with pytest.raises(ValueError, match="surface"):
        pc.minkowski(pc.Diagram(pc.read_domain("sphere"), RNG.random((20, 3)) - 0.5), 6)
