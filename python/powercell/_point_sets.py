"""Random points, and measures of how even a set of points is."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike

from . import _core
from ._arrays import Reals
from ._density import Density, density_arguments
from ._device import DeviceLike, open_device
from ._domain import Domain
from ._frames import checked_positions
from ._names import named_arguments
from ._options import diagram_options


@named_arguments
def random_points(domain: Domain, n: int, density: Density = None, *, random_seed: int = 1) -> Reals:
    """Independent random points of a domain with a density; the same random seed gives the same points.

    Parameters
    ----------
    domain : Domain
    n : int
    density
        As for :class:`TransportSolver`.
    random_seed : int

    Returns
    -------
    (n, d) float64

    Raises
    ------
    Error
        ``invalid_argument`` if the density is positive in too small a part of the domain.

    Examples
    --------
    >>> import powercell as pc
    >>> x, y = pc.random_points(pc.Domain.box([0, 0], [1, 1]), 10_000, "x < 0.5 ? 1 : 0").T
    >>> bool(x.max() < 0.5)
    True
    """
    given = {"n": n, "random_seed": random_seed}
    points: Any = _core.random_points(domain._core, density_arguments(density, domain), given)
    return points  # type: ignore[no-any-return]


@named_arguments
def spacing(
    domain: Domain,
    positions: ArrayLike,
    *,
    uniform: bool = True,
    device: DeviceLike = None,
    precision: str = "auto",
    threads: int = 0,
) -> Any:
    """Distances and angles between Voronoi neighbours.

    Parameters
    ----------
    domain : Domain
    positions : (n, d) array_like
        At least two points in the domain, each once.
    uniform : bool
        The points are meant to have constant density.
    device, precision, threads
        As for :class:`Diagram`.

    Returns
    -------
    Spacing
        With least, mean and hexatic.

    Examples
    --------
    >>> import powercell as pc
    >>> square = pc.Domain.box([0, 0], [2, 2], periodic=True)
    >>> grid = pc.spacing(square, [[0.5, 0.5], [1.5, 0.5], [0.5, 1.5], [1.5, 1.5]])
    >>> round(grid.least, 6)  # (3/4)^(1/4)
    0.930605
    """
    points = checked_positions(domain, positions)
    options = diagram_options(precision, threads=threads)
    return _core.spacing(open_device(device), domain._core, points, uniform, options)


@named_arguments
def spectrum(box: Domain, positions: ArrayLike, highest: int = 0, *, threads: int = 0) -> Any:
    """The power spectrum of points in the plane. Random points have the power 1 on average.

    Parameters
    ----------
    box : Domain
        Its bounding box is the period.
    positions : (n, 2) array_like
    highest : int
        F, the largest component of a frequency; 0 for ``2 sqrt(n)``, rounded up.
    threads : int
        On the host; 0 for all.

    Returns
    -------
    Spectrum
        With power (2F + 1, 2F + 1), ``radial()`` and ``low_frequency()``; ``Spectrum.mean`` averages several.

    Examples
    --------
    >>> import powercell as pc
    >>> s = pc.spectrum(pc.Domain.box([0, 0], [1, 1]), [[0.0, 0.0], [0.5, 0.0]], highest=1)
    >>> s.power[1].round(12).tolist()  # of f_y = 0
    [0.0, 2.0, 0.0]
    """
    points = checked_positions(box, positions)
    return _core.spectrum(box._core, points, {"highest": highest, "threads": threads})
