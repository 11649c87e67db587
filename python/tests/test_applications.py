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


def test_the_solver_gives_its_diagram(rng, square):
    p, masses = rng.random((60, 2)), rng.random(60) + 0.5
    solver = pc.TransportSolver(square, p, masses, rescale=True, linear="multilevel", linear_residual=1e-8)
    with pytest.raises(pc.Error) as caught:
        solver.diagram
    assert caught.value.code == "invalid_argument"
    result = solver.solve()
    diagram = solver.diagram
    assert np.array_equal(diagram.positions, p) and np.array_equal(diagram.weights, result.weights)
    assert diagram.mass == pytest.approx(masses / masses.sum(), rel=1e-6)
    solver.move_seeds(result.centroid)
    with pytest.raises(pc.Error):
        solver.diagram
    assert diagram.mass == pytest.approx(masses / masses.sum(), rel=1e-6)  # is no part of the solver


def test_steps_of_the_solver_tell_what_they_did(rng, square):
    p, masses = rng.random((200, 2)), rng.random(200) + 0.5
    solver = pc.TransportSolver(square, p, masses, rescale=True, linear="multilevel", linear_residual=1e-9)
    result = solver.solve()
    solved = [step for step in result.steps if step.linear != "automatic"]
    assert {step.linear for step in solved} == {"multilevel"} and len(solved) == result.newton_steps > 0
    assert all(step.linear_iterations > 0 and step.linear_residual <= 1e-9 for step in solved)
    assert {step.phase for step in result.steps} == {"start", "newton"}
    assert all(step.exponent == 1 and step.spread == 0 for step in result.steps)
    fresh = pc.TransportSolver(square, p, masses, rescale=True)
    fresh.set_max_steps(1)
    limited = fresh.solve()
    assert not limited.converged and limited.newton_steps <= 1 < result.newton_steps
    with pytest.raises(pc.Error, match="max_steps is negative"):
        fresh.set_max_steps(-1)
    with pytest.raises(pc.Error):
        pc.TransportSolver(square, p, linear_residual=1.5)


def test_seeds_at_one_position_are_counted(square):
    result = pc.transport(square, [[0.2, 0.5], [0.8, 0.5], [0.2, 0.5]])
    assert result.merged == 1 and result.merged_with.tolist() == [0, 1, 0]
    assert result.mass == pytest.approx([2 / 3, 1 / 3, 0], rel=1e-6)


def test_samples_tell_of_thin_plates(square):
    flat = pc.sample(square, 50)
    assert (flat.apart.cells, flat.apart.share, flat.apart.distance) == (0, 0, 0)
    assert len(flat.layers) == 0 and (flat.layer_spacing.least, flat.layer_spacing.mean) == (0, 0)
    # The surface of a plate 0.01 thick: both of its large faces are layers, with about half of the points each.
    x, y = np.meshgrid(np.linspace(0, 1, 9), np.linspace(0, 1, 9))
    top = np.column_stack([x.ravel(), y.ravel(), np.zeros(81)])
    k = (np.arange(8) + 9 * np.arange(8)[:, None]).ravel()
    faces = np.vstack([np.column_stack([k, k + 1, k + 10]), np.column_stack([k, k + 10, k + 9])])
    around = np.concatenate([np.arange(9), 8 + 9 * np.arange(1, 9), 79 - np.arange(8), 63 - 9 * np.arange(7)])
    a, b = around, np.roll(around, -1)
    sides = np.vstack([np.column_stack([a, b + 81, b]), np.column_stack([a, a + 81, b + 81])])
    plate = pc.Domain.surface(np.vstack([top, top + [0, 0, 0.01]]), np.vstack([faces[:, ::-1], faces + 81, sides]))
    assert plate.measure == pytest.approx(2.04)
    dots = pc.sample(plate, 100)
    assert len(dots.layers) >= 2 and sum(dots.layers) == 100
    assert sorted(dots.layers)[-2:] == pytest.approx([50, 50], abs=5)
    assert 0.5 < dots.layer_spacing.least < dots.layer_spacing.mean < 1.1
    # A cell has a part apart where it reaches through to the other face, but not around the rim.
    _, places = plate.random_points(50_000)
    owner = (((places[:, None] - dots.positions) ** 2).sum(axis=2) - dots.weights).argmin(axis=1)
    through = np.abs(places[:, 2] - dots.positions[owner, 2]) > 0.005
    around = np.isin(owner, owner[(places[:, 2] > 1e-9) & (places[:, 2] < 0.01 - 1e-9)])  # connected over the rim
    assert dots.apart.share == pytest.approx((through & ~around).mean(), abs=0.02)
    assert dots.apart.cells == pytest.approx(len(np.unique(owner[through & ~around])), abs=2)
    assert dots.apart.distance == pytest.approx(0.01, rel=0.5)


def test_counts_of_repair_and_quality():
    vertices, triangles = pc.sphere(6)
    soup = vertices[triangles].reshape(-1, 3)
    corners = np.arange(len(soup)).reshape(-1, 3)
    turned = np.vstack([corners, [[0, 0, 1]], corners[:2]])
    turned[5] = turned[5, ::-1]
    report = pc.repair(soup, turned).report
    assert report.changed and report.degenerate.count == 1 and report.repeated.count == 2 and report.turned.count == 1
    assert report.degenerate.first == pytest.approx(soup[0])
    assert report.welded.count == report.flat.count == report.left_flat.count == report.intersections.count == 0
    assert not pc.repair(vertices, triangles).report.changed
    quality = pc.mesh_quality(vertices, triangles)
    edges = np.roll(vertices[triangles], -1, axis=1) - vertices[triangles]
    unit = edges / np.linalg.norm(edges, axis=2, keepdims=True)
    angles = np.degrees(np.arccos(-(unit * np.roll(unit, 1, axis=1)).sum(axis=2)))
    assert quality.angle_min_mean == pytest.approx(angles.min(axis=1).mean())
    new = pc.remesh(vertices, triangles, count=100)
    assert new.intersections.count == 0 and new.inseparable is None and not new.collapsed
    assert min(new.seconds_sample, new.seconds_dual, new.seconds_relax) >= 0 < new.seconds_sample


def test_numbers_of_treemaps():
    values = np.arange(1.0, 41)
    on_host = pc.treemap({str(k): v for k, v in enumerate(values)})
    on_device = pc.treemap({str(k): v for k, v in enumerate(values)}, large_group=10)
    for layout in (on_host, on_device):
        assert layout.worst_error < 1e-6 and layout.diagrams >= layout.newton_steps > 0
        x, y = layout.polygon(layout.worst_leaf).T
        area = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
        error = abs(area / (layout.value[layout.worst_leaf] / values.sum()) - 1)
        assert error == pytest.approx(layout.worst_error, rel=1e-3)
        assert layout.seeds.shape == (41, 2)
        assert all(np.abs(layout.seeds[k] - layout.polygon(k).mean(axis=0)).max() < 0.1 for k in range(1, 41))
    with pytest.raises(ValueError, match="large_group is -1"):
        pc.treemap({"a": 1}, large_group=-1)


def test_transport_has_the_default_tolerance_of_the_solver():
    # Seeds 1e-9 apart: weights in double precision meet the masses to some 1e-5 only.
    rng = np.random.default_rng(3)
    seeds = np.concatenate([0.4 + 1e-8 * rng.random((200, 2)), rng.random((100, 2))])
    domain = pc.Domain.box([0, 0], [1, 1])
    result = pc.transport(domain, seeds)
    assert result.converged and result.tolerance == 1e-6
    assert result.converged == pc.TransportSolver(domain, seeds).solve().converged
    given = pc.transport(domain, seeds, tolerance=1e-9)
    assert not given.converged and given.error < given.rounding_error
