"""Bond order of cells, as in studies of packings and crystals."""

from __future__ import annotations

from collections.abc import Iterator
from math import factorial, pi, prod, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._names import named_arguments

Reals = NDArray[np.float64]


@named_arguments
def minkowski(diagram: Any, l: int = 6) -> Reals:  # noqa: E741
    """The Minkowski structure metric of each cell: bond order with walls weighted by their measure.

    ``q_l = sqrt(4 pi / (2 l + 1) sum_m |sum_f A_f Y_lm(n_f) / A|^2)`` over the walls f with neighbours, with normals n_f and
    measures A_f that sum to A. In the plane ``|sum_f A_f exp(i l angle_f) / A|``. W. Mickel, S. C. Kapfer, G. E. Schroeder-Turk,
    K. Mecke: Shortcomings of the bond orientational order parameters, J. Chem. Phys. 138, 2013.

    Parameters
    ----------
    diagram : Diagram
        In the plane or in space.
    l : int
        0 to 40.

    Returns
    -------
    (n,) float64
        0 to 1. NaN for a cell without neighbours.

    Examples
    --------
    >>> import numpy as np, powercell as pc
    >>> cubic = pc.Diagram(pc.Domain.box([0, 0, 0], [3, 3, 3], periodic=True), np.indices((3, 3, 3)).reshape(3, -1).T + 0.5)
    >>> pc.minkowski(cubic, 4).round(4)[0].item(), pc.minkowski(cubic, 6).round(4)[0].item()
    (0.7638, 0.3536)
    """
    if not 0 <= l <= 40:
        raise ValueError(f"l is {l}; 0 to 40 are expected")
    if diagram.domain.cell_dimension != diagram.domain.dimension:
        raise ValueError("bond order is that of cells in the plane or in space; this domain is a surface")
    adjacency = diagram.adjacency
    sides = adjacency.sides()
    count = np.diff(adjacency.indptr)
    row = np.repeat(np.arange(len(count)), count)
    normal = sides.vector / np.linalg.norm(sides.vector, axis=1)[:, None]
    measure = np.asarray(sides.measure, dtype=np.float64)
    total = np.bincount(row, measure, len(count))
    across = normal[:, 0] + 1j * normal[:, 1]  # to the power of m: sin(polar)^m exp(i m azimuth)
    with np.errstate(invalid="ignore"):
        if normal.shape[1] == 2:
            return _size(row, measure * across**l, len(count)) / total
        square = np.zeros(len(count))
        for m, legendre in enumerate(_legendre(l, normal[:, 2])):
            part = _size(row, measure * legendre, len(count)) ** 2
            square += part if m == 0 else 2 * part  # those of m and -m are the same
            measure = measure * across
        root: Reals = np.sqrt(4 * pi / (2 * l + 1) * square)
        return root / total


def _size(row: NDArray[np.intp], values: NDArray[Any], count: int) -> Reals:
    """The absolute values of sums by row."""
    found: Reals = np.hypot(np.bincount(row, values.real, count), np.bincount(row, values.imag, count))
    return found


def _legendre(l: int, z: Reals) -> Iterator[Reals]:  # noqa: E741
    """Y_lm over sin(polar)^m exp(i m azimuth), for m = 0 to l, by the recurrence in the degree from m to l."""
    for m in range(l + 1):
        below, here = np.zeros_like(z), np.full_like(z, float(prod(range(1, 2 * m, 2))))
        for degree in range(m + 1, l + 1):
            below, here = here, ((2 * degree - 1) * z * here - (degree + m - 1) * below) / (degree - m)
        yield sqrt((2 * l + 1) / (4 * pi) * factorial(l - m) / factorial(l + m)) * here
