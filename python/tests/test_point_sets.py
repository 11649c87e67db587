"""Random points, spacing, spectra and distances of surfaces, against what is known of them."""

import numpy as np
import pytest

import powercell as pc


def test_random_points_have_the_density(square, cube):
    x, y = pc.random_points(square, 40_000, "3*x^2").T
    assert x.mean() == pytest.approx(3 / 4, abs=5e-3)  # the integral of x times 3 x^2
    assert y.mean() == pytest.approx(1 / 2, abs=5e-3)
    assert np.array_equal(pc.random_points(cube, 100), pc.random_points(cube, 100))
    assert not np.array_equal(pc.random_points(cube, 100), pc.random_points(cube, 100, random_seed=2))
    steps = pc.random_points(square, 1000, lambda x, y: float(y > 0.9))
    assert steps.shape == (1000, 2) and steps[:, 1].min() > 0.9
    with pytest.raises(ZeroDivisionError):
        pc.random_points(square, 10, lambda x, y: 1 / 0)
    with pytest.raises(ValueError, match="n is -1"):
        pc.random_points(square, -1)


def test_points_of_regions_lie_in_them():
    vertices, triangles = pc.sphere(3)
    domain = pc.Domain.surface(vertices, triangles)
    region, points = domain.random_points(2000)
    a, b, c = (vertices[triangles[region, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    assert np.abs(((points - a) * normal).sum(axis=1)).max() < 1e-12
    parts = sum(np.linalg.norm(np.cross(p - points, q - points), axis=1) for p, q in ((a, b), (b, c), (c, a)))
    assert parts == pytest.approx(np.linalg.norm(normal, axis=1))
    areas = np.linalg.norm(np.cross(*(vertices[triangles[:, k]] - vertices[triangles[:, 0]] for k in (1, 2))), axis=1)
    expected = 2000 * areas / areas.sum()
    assert np.abs(np.bincount(region, minlength=len(triangles)) - expected).max() < 5 * expected.max() ** 0.5


def test_spacing_of_lattices_and_random_points(rng):
    # A hexagonal lattice: rows of 8 points at distance 1, 8 rows at distance sqrt(3/4), every second one shifted.
    height = 0.75**0.5
    x, y = np.meshgrid(np.arange(8.0), np.arange(8.0))
    hexagons = np.column_stack([(x + y % 2 / 2).ravel(), (y * height).ravel()])
    torus = pc.Domain.box([0, 0], [8, 8 * height], periodic=True)
    exact = pc.spacing(torus, hexagons)
    assert (exact.least, exact.mean, exact.hexatic) == pytest.approx((1, 1, 1))
    p = rng.random((2000, 2)) * [8, 8 * height]
    random = pc.spacing(torus, p)
    d = np.abs(p[:, None] - p[None])
    d = np.linalg.norm(np.minimum(d, torus.bounds[1] - d), axis=2)
    np.fill_diagonal(d, 9)
    densest = (torus.measure / len(p) * 2 / 3**0.5) ** 0.5
    assert random.least == pytest.approx(d.min() / densest)
    assert random.mean == pytest.approx(d.min(axis=1).mean() / densest)
    assert random.hexatic == pytest.approx(0.37, abs=0.02)
    space = pc.spacing(pc.Domain.box([0, 0, 0], [1, 1, 1]), rng.random((50, 3)))
    assert np.isnan(space.hexatic) and 0 < space.least < space.mean
    for wrong in ([[1, 1]], [[1, 1], [2, 2], [1, 1]]):
        with pytest.raises(pc.Error) as caught:
            pc.spacing(torus, wrong)
        assert caught.value.code == "invalid_argument"


def test_spectra_match_their_definition(rng, square):
    first, second = (pc.spectrum(square, p, highest=6) for p in rng.random((2, 40, 2)))
    p = np.random.default_rng(1).random((2, 40, 2))[0]  # the points of the first
    f = np.arange(-6, 7)
    waves = np.exp(-2j * np.pi * (f[None, :, None] * p[:, 0] + f[:, None, None] * p[:, 1])).sum(axis=2)
    assert first.power == pytest.approx(np.abs(waves) ** 2 / 40)
    assert (first.highest, first.points, first.runs) == (6, 40, 1)
    both = pc.Spectrum.mean([first, second])
    assert both.runs == 2 and both.power == pytest.approx((first.power + second.power) / 2)
    length = np.hypot(*np.meshgrid(f, f))
    low = (length > 0) & (length <= 0.5 * 40**0.5)
    assert first.low_frequency() == pytest.approx(first.power[low].mean())
    radial = first.radial()
    assert radial.mean.shape == radial.anisotropy.shape == (6,)
    ring = first.power[(length >= 1.5) & (length < 2.5)]
    assert radial.mean[1] == pytest.approx(ring.mean())
    assert radial.anisotropy[1] == pytest.approx(ring.var() / ring.mean() ** 2, rel=0.2)
    many = pc.spectrum(square, rng.random((3000, 2)), highest=40)
    assert np.delete(many.power.ravel(), 40 * 81 + 40).mean() == pytest.approx(1, abs=0.1)
    with pytest.raises(pc.Error) as caught:
        pc.Spectrum.mean([first, pc.spectrum(square, p, highest=5)])
    assert caught.value.code == "invalid_argument"


def test_distance_of_surfaces():
    vertices, triangles = pc.sphere(6)
    inner = (0.5 * vertices, triangles)
    assert pc.farthest_from(inner, (vertices, triangles)) == pytest.approx(0.5, abs=0.02)
    assert pc.farthest_from((vertices, triangles), inner) == pytest.approx(0.5, abs=0.02)
    assert pc.farthest_from((vertices, triangles), (vertices, triangles)) < 1e-12
    far = (vertices + [3, 0, 0], triangles)
    assert pc.farthest_from(far, (vertices, triangles)) == pytest.approx(3, abs=1e-9)
    with pytest.raises(ValueError, match="triangles"):
        pc.farthest_from((vertices, triangles[:, :2]), far)
