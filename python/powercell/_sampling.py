"""Blue noise and quantisers."""

from __future__ import annotations

import operator
from typing import Any, Union

from numpy.typing import ArrayLike

from . import _core
from ._density import Density, density_arguments
from ._device import DeviceLike, open_device
from ._domain import Domain, require_domain
from ._frames import checked_positions
from ._names import named_arguments
from ._options import diagram_options
from ._progress import Progress, step_bar


def _describe(step: Any) -> str:
    return f"gradient {step.gradient:.2e}, hexatic order {step.hexatic:.2f}"


@named_arguments
def sample(
    domain: Domain,
    points: Union[int, ArrayLike],
    density: Density = None,
    *,
    mode: str = "blue",
    descent: str = "auto",
    iterations: int = 0,
    hexatic: float = 0.61,
    movement: float = 1e-4,
    capacity_tolerance: float = 1e-6,
    random_seed: int = 1,
    device: DeviceLike = None,
    precision: str = "auto",
    threads: int = 0,
    progress: Progress = None,
) -> Any:
    """Points whose power cells have equal masses of a density.

    Parameters
    ----------
    domain : Domain
    points : int or (n, d) array_like
        Their number, or the points to start from.
    density
        As for :class:`TransportSolver`.
    mode : {"blue", "quantise"}
        Even but irregular, or of least energy.
    descent : {"auto", "lloyd", "lbfgs"}
    iterations : int
        Limit; 0 lets the mode choose.
    hexatic, movement, capacity_tolerance : float
        Stopping rules: the hexatic order of blue noise in the plane; the gradient over the spacing; the largest
        relative error of a mass.
    random_seed : int
        Of the initial points.

    Returns
    -------
    SamplingResult
        With positions (n, d), weights, mass, converged, energy, relative_energy, steps, layers, layer_spacing and
        apart (parts of cells that are not connected with the part that has the point).

    Examples
    --------
    >>> import powercell as pc
    >>> dots = pc.sample(pc.Domain.box([0, 0], [1, 1]), 100)
    >>> dots.converged, dots.positions.shape
    (True, (100, 2))
    """
    require_domain(domain)
    start: Any
    try:
        start = operator.index(points)  # type: ignore[arg-type]
    except TypeError:
        start = checked_positions(domain, points, "points")
    else:
        if start < 1:
            raise ValueError(f"points is {start}; at least 1 is expected")
    given = {
        "density": density_arguments(density, domain),
        "mode": mode,
        "descent": descent,
        "iterations": iterations,
        "hexatic": hexatic,
        "movement": movement,
        "capacity_tolerance": capacity_tolerance,
        "random_seed": random_seed,
    }
    options = diagram_options(precision, threads=threads)
    with step_bar(progress, "sampling", _describe) as report:
        return _core.sample(open_device(device), domain._core, start, given, options, report)
