"""Integrals of densities over cells and walls."""

import numpy as np
import pytest

import powercell as pc

TWO = [[0.25, 0.5], [0.75, 0.5]]


def test_integrals_of_a_line(square):
    diagram = pc.Diagram(square, TWO)
    result = pc.integrate(diagram, "2*x", walls=True)
    assert result.mass == pytest.approx([1 / 4, 3 / 4]) and result.domain_mass == pytest.approx(1)
    # The integrals of 2 x^2 over x up to 1/2 and from there: 1/12 and 7/12.
    assert result.centroid == pytest.approx(np.array([[1 / 3, 1 / 2], [7 / 9, 1 / 2]]))
    # Of 2 x (x - 1/4)^2, and of 2 x (y - 1/2)^2, which is 1/12 of the mass.
    assert result.second_moment[0] == pytest.approx(2 * (1 / 64 - 1 / 48 + 1 / 128) + 1 / 48)
    assert result.walls.indices.tolist() == [1, 0] and result.walls.data == pytest.approx([1, 1])  # 2 x = 1 there
    assert result.dimension == 2 and result.status.tolist() == [0, 0]
    assert result.total == pytest.approx(1) and result.relative_error < 1e-12
    assert result.quadrature_error == result.mass_error.max() < 1e-9
    mass = result.mass
    with pytest.raises(ValueError):
        mass[0] = 1
    del result, diagram
    assert mass == pytest.approx([1 / 4, 3 / 4])


def test_integrals_are_those_of_random_points(rng, cube):
    p, w = rng.random((20, 3)), rng.random(20) * 0.05
    result = pc.integrate(pc.Diagram(cube, p, w), lambda x, y, z: 1 + x * y)
    x = rng.random((200_000, 3))
    owner = (((x[:, None] - p) ** 2).sum(axis=2) - w).argmin(axis=1)
    share = np.bincount(owner, 1 + x[:, 0] * x[:, 1], minlength=20) / len(x)
    assert np.abs(result.mass - share).max() < 6e-3
    assert result.mass.sum() == pytest.approx(1.25, rel=1e-9) and result.walls is None


def test_a_constant_scales_the_measures(rng):
    torus = pc.Domain.box([0, 0], [1, 1], periodic=True)
    diagram = pc.Diagram(torus, rng.random((50, 2)))
    result = pc.integrate(diagram, 3, walls=True)
    assert result.mass == pytest.approx(3 * diagram.mass) and len(result.mass_error) == 0
    assert result.walls.data == pytest.approx(3 * diagram.adjacency.data)
    assert np.array_equal(result.walls.shift, diagram.adjacency.shift)
    assert result.walls.to_scipy().shape == (50, 50)
    with pytest.raises(pc.Error) as caught:
        pc.integrate(diagram, "x")
    assert caught.value.code == "unsupported"


def test_walls_if_sees_the_masses_and_may_refuse(square):
    diagram = pc.Diagram(square, TWO)
    seen = []

    def refuse(mass):
        seen.append(mass)
        return False

    assert pc.integrate(diagram, "2*x", walls=True, walls_if=refuse).walls is None
    assert seen[0] == pytest.approx([1 / 4, 3 / 4])
    assert pc.integrate(diagram, "2*x", walls=True, walls_if=lambda mass: True).walls is not None
    with pytest.raises(ZeroDivisionError):
        pc.integrate(diagram, "2*x", walls=True, walls_if=lambda mass: 1 / 0)
    assert pc.integrate(diagram, "2*x").total == pytest.approx(1)  # usable after that


def test_wrong_arguments_of_integrals(square):
    diagram = pc.Diagram(square, TWO)
    with pytest.raises(ValueError, match="diagram is a Domain"):
        pc.integrate(square)
    with pytest.raises(pc.Error, match="tolerance"):
        pc.integrate(diagram, "x", tolerance=1)
    with pytest.raises(pc.Error, match="the density is -0.5 at x = 0"):
        pc.integrate(diagram, "x - 0.5")
    diagram.select([0])
    with pytest.raises(pc.Error) as caught:
        pc.integrate(diagram, 1)
    assert caught.value.code == "unsupported"
