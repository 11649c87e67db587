"""Densities as arguments: None, a number, a formula, a function, an image, or values at vertices."""

from __future__ import annotations

from typing import Any, Callable, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import Reals, reals
from ._diagram import Diagram
from ._domain import Domain, require_domain
from ._names import named_arguments
from ._progress import fraction_bar

Density = Union[None, float, str, Callable[..., float], ArrayLike]


def density_arguments(density: Density, domain: Domain) -> tuple[str, Any]:
    require_domain(domain)
    if density is None:
        return "constant", 1.0
    if isinstance(density, str):
        return "formula", density
    if callable(density):
        return "function", density
    if np.ndim(density) == 0:
        value = float(density)  # type: ignore[arg-type]
        return "constant", value
    if np.ndim(density) == 2:
        low, high = domain.bounds
        return "image", (reals(density, "density", (None, None)), list(low), list(high))
    return "nodal", reals(density, "density", (None,), ", one value for each vertex, or an image")


@named_arguments
def integrate(
    diagram: Diagram,
    density: Density = None,
    *,
    walls: bool = False,
    walls_if: Optional[Callable[[Reals], bool]] = None,
    tolerance: float = 0.0,
    threads: int = 0,
) -> Any:
    """Integrates a density over the cells of a diagram. In a periodic domain it must be constant.

    Parameters
    ----------
    diagram : Diagram
        Of all seeds: none are selected. Its ``progress`` reports what has to be computed of it.
    density
        As for :class:`TransportSolver`.
    walls : bool
        Integrate over the walls too.
    walls_if : callable, optional
        A function of the masses (n,), called before the walls are integrated unless the density is constant; False
        skips them.
    tolerance : float
        Relative tolerance of the masses of a formula or function where looser than 1e-9, in [0, 1).
    threads : int
        On the host; 0 for all.

    Returns
    -------
    DensityIntegrals
        With mass, centroid, second_moment, walls, domain_mass and quadrature_error.

    Raises
    ------
    Error
        ``invalid_argument`` (a density that is negative somewhere: where), ``unsupported`` (periodic; selected seeds).

    Examples
    --------
    >>> import powercell as pc
    >>> d = pc.Diagram(pc.Domain.box([0, 0], [1, 1]), [[0.25, 0.5], [0.75, 0.5]])
    >>> pc.integrate(d, "2*x").mass.round(9).tolist()
    [0.25, 0.75]
    """
    if not isinstance(diagram, Diagram):
        raise ValueError(f"diagram is a {type(diagram).__name__}; a powercell.Diagram is expected")
    given = {"walls": walls, "walls_if": walls_if, "tolerance": tolerance, "threads": threads}
    with fraction_bar(diagram._progress, "power diagram") as report:
        return diagram._core.integrate(density_arguments(density, diagram.domain), given, report)
