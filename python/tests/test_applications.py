"""Transport, sampling, remeshing, repair and treemaps."""

import numpy as np
import pytest

import powercell as pc


def test_transport_meets_masses(rng, square):
    p, masses = rng.random((100, 2)), rng.random(100) + 0.1
    result = pc.transport(square, p, masses, rescale=True)
    assert result.converged and result.error < 1e-6
    assert result.mass == pytest.approx(masses / masses.sum(), rel=1e-6)
    diagram = pc.Diagram(square, p, result.weights)
    assert diagram.mass == pytest.approx(result.mass, rel=1e-6)
    assert result.cost == pytest.approx(diagram.second_moment.sum(), rel=1e-6)
    assert result.steps[-1].error == pytest.approx(result.error, abs=1e-6)
    with pytest.raises(pc.Error) as caught:
        pc.transport(square, p, masses)
    assert caught.value.code == "invalid_argument"


def test_densities_in_all_forms(square):
    p = [[0.25, 0.5], [0.75, 0.5]]
    # The masses are 1/4 of the whole, x < 1/2 for 2 x; the wall is where the integral is half: sqrt(1/2).
    for density in ("2*x", lambda x, y: 2 * x):
        result = pc.transport(square, p, density=density)
        assert result.total_mass == pytest.approx(1)
        diagram = pc.Diagram(square, p, result.weights)
        assert diagram.mass[0] == pytest.approx(0.5**0.5, abs=1e-6)
    image = pc.transport(square, p, density=np.array([[1.0, 3.0]]))
    assert image.total_mass == pytest.approx(2)
    assert pc.transport(square, p, density=5).total_mass == pytest.approx(5)
    vertices, triangles = pc.sphere(4)
    surface = pc.Domain.surface(vertices, triangles)
    nodal = pc.transport(surface, vertices[:20] * 0.9, density=np.ones(len(vertices)))
    assert nodal.total_mass == pytest.approx(surface.measure)


def test_solver_follows_moving_seeds(rng, square):
    solver = pc.TransportSolver(square, rng.random((50, 2)))
    first = solver.solve()
    kept = first.weights.copy()
    solver.move_seeds(first.centroid)
    second = solver.solve()
    assert second.converged and second.cost < first.cost
    assert np.array_equal(first.weights, kept)  # results are owned


def test_samples_are_blue(square):
    dots = pc.sample(square, 200)
    assert dots.converged and dots.capacity_error < 1e-6
    distance = np.linalg.norm(dots.positions[:, None] - dots.positions[None], axis=2)
    np.fill_diagonal(distance, 9)
    assert distance.min() > 0.6 * (2 / 3**0.5 / 200) ** 0.5
    again = pc.sample(square, dots.positions, mode="quantise", iterations=3, movement=0)
    assert again.energy < dots.energy


def test_remesh_and_repair():
    vertices, triangles = pc.sphere(10)
    new = pc.remesh(vertices, triangles, count=300)
    assert new.vertices.shape == (300, 3) and new.triangles.shape[1] == 3
    quality = pc.mesh_quality(new.vertices, new.triangles)
    assert quality.manifold and quality.euler_characteristic == 2 and quality.q_mean > 0.8
    soup = vertices[triangles].reshape(-1, 3)
    twice = np.vstack([np.arange(len(soup)).reshape(-1, 3), [[0, 0, 1]]])
    fixed = pc.repair(soup, twice)
    assert any("repeated" in act or "two corners" in act or "degenerate" in act for act in fixed.report.acts)
    assert pc.mesh_quality(fixed.mesh.vertices, fixed.mesh.triangles).manifold


def test_treemaps():
    tree = {"a": 3, "b": {"c": 1, "d": 2, "e": {"f": 4}}}
    first = pc.treemap(tree)
    assert first.worst_error < 1e-6
    for node, name in enumerate(first.names):
        x, y = first.polygon(node).T
        area = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
        assert area == pytest.approx({"": 1, "a": 0.3, "b": 0.7, "c": 0.1, "d": 0.2, "e": 0.4, "f": 0.4}[name])
    parents = pc.treemap([-1, 0, 0], [0, 1, 3], outline=[[0, 0], [2, 0], [1, 2]], names=["all", "p", "q"])
    assert parents.names == ["all", "p", "q"] and parents.leaves == 2
    near = pc.treemap(tree, previous=first)
    for node in range(len(first)):
        assert near.polygon(node).mean(axis=0) == pytest.approx(first.polygon(node).mean(axis=0), abs=1e-6)
    with pytest.raises(ValueError, match="names has 1"):
        pc.treemap([-1, 0, 0], [0, 1, 3], names=["all"])
    with pytest.raises(pc.Error, match="q"):
        pc.treemap([-1, 0, 0], [0, 1, np.nan], names=["all", "p", "q"])
