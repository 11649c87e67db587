"""The warning of seeds that miss the domain."""

import warnings

import numpy as np
import pytest

import powercell as pc


def warned(domain, positions, says):
    with pytest.warns(pc.SeedsOutsideWarning, match=says) as caught:
        diagram = pc.Diagram(domain, positions)
    assert caught[0].filename == __file__  # the caller's line, not one of the package
    assert diagram.mass.sum() == pytest.approx(domain.measure, rel=1e-12)


def test_swapped_axes_are_named(rng):
    land = pc.Domain.box([12, 40], [13, 41])
    swapped = np.column_stack([rng.uniform(40, 41, 300), rng.uniform(12, 13, 300)])
    warned(land, swapped, r"300 of 300 seeds lie outside the domain's box \(x from 12 to 13, y from 40 to 41\); "
                          r"positions\[:, \[1, 0\]\] would put 100 % inside\. .* ignore powercell\.SeedsOutsideWarning")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        pc.Diagram(land, swapped[:, [1, 0]])


def test_units_are_named(rng):
    far = pc.Domain.box([5e5, 6.9e6], [6e5, 7e6])
    warned(far, rng.uniform([5, 52], [6, 53], (20, 2)), "the seeds could be in degrees and the domain in lengths")
    warned(far, rng.uniform([510, 6910], [590, 6990], (20, 2)), "1000.0 times their coordinates would lie inside")
    square = pc.Domain.box([0, 0], [1, 1])
    warned(square, 100 * rng.random((20, 2)), "0.01 times their coordinates would lie inside")
    warned(square, 10 + rng.random((20, 2)), r"20 of 20 seeds lie outside .*\)\. Seeds may lie outside")
    degrees = pc.Domain.box([5, 52], [6, 53])
    warned(degrees, rng.uniform([5e5, 5.7e6], [6e5, 5.8e6], (20, 2)), "the domain could be in degrees and the seeds in")
    warned(degrees, rng.uniform([0, 0], [1, 1], (20, 2)), r"20 of 20 seeds lie outside .*\)\. Seeds may lie outside")


def test_it_is_of_new_seeds_and_of_transport_too(rng, cube):
    inside, outside = rng.random((40, 3)), rng.random((40, 3)) + 2
    diagram = pc.Diagram(cube, inside)
    with pytest.warns(pc.SeedsOutsideWarning, match="40 of 40"):
        diagram.set_seeds(outside)
    with pytest.warns(pc.SeedsOutsideWarning, match="40 of 40") as caught:
        pc.transport(cube, outside)
    assert caught[0].filename == __file__


def test_what_is_meant_is_not_warned_of(rng, cube):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        few = rng.random((100, 3)) + [0.94, 0, 0]  # 94 of 100 or so lie outside
        few[:6] = 0.5 * rng.random((6, 3))
        pc.Diagram(cube, few)
        pc.Diagram(pc.Domain.box([0, 0, 0], [1, 1, 1], periodic=True), rng.random((50, 3)) + 7)
        flat = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        pc.Diagram(pc.Domain.surface(flat, [[0, 1, 2], [0, 2, 3]]), rng.random((20, 3)) * [1, 1, 0.2])
        pc.Diagram(cube, np.zeros((0, 3)))
        warnings.simplefilter("ignore", pc.SeedsOutsideWarning)
        pc.Diagram(cube, rng.random((20, 3)) + 2)
