"""Semi-discrete optimal transport."""

from __future__ import annotations

from typing import Any, Optional

from numpy.typing import ArrayLike

from . import _core
from ._arrays import reals
from ._density import Density, density_arguments
from ._device import DeviceLike, open_device
from ._diagram import Diagram
from ._domain import Domain
from ._frames import checked_positions, checked_seeds, checked_values, in_order_of, values_of
from ._names import named_arguments
from ._options import diagram_options
from ._outside import warn_of_seeds_outside
from ._progress import Progress, step_bar


def _describe(step: Any) -> str:
    return f"{step.phase}, masses to {step.error:.1e}"


class TransportSolver:
    """Finds weights for which the cells of seeds have given masses, repeatedly as these change.

    Parameters
    ----------
    domain : Domain
    positions : (n, d) array_like
        Seeds, as for :class:`Diagram`.
    masses : (n,) array_like or str, optional
        Target masses, positive. Default: equal ones. A series goes by its labels; of a table the name of a column will
        do.
    density : number, str, callable or array_like, optional
        Mass per unit of area or volume: a number; a formula in x, y and z; a function of the coordinates, called
        by several threads, one at a time; an (h, w) image that fills the domain's box, its top row first; or
        values at the vertices of a mesh. Default: 1.
    weights : (n,) array_like or str, optional
        Weights to start from; likewise.
    tolerance : float
        Largest relative error of a mass; 0 for 1e-6 (single precision: 1e-3).
    max_steps : int
    rescale : bool
        Scale the masses to sum to the domain's. Otherwise they must, to 1e-9.
    linear : {"auto", "dense", "direct", "multilevel"}
    linear_residual : float
        Relative residual of an iterative linear solve, in (0, 1).
    device, precision, neighbors, threads
        As for :class:`Diagram`.
    """

    @named_arguments
    def __init__(
        self,
        domain: Domain,
        positions: ArrayLike,
        masses: Optional[ArrayLike] = None,
        density: Density = None,
        *,
        weights: Optional[ArrayLike] = None,
        tolerance: float = 0.0,
        max_steps: int = 500,
        rescale: bool = False,
        linear: str = "auto",
        linear_residual: float = 1e-4,
        device: DeviceLike = None,
        precision: str = "auto",
        neighbors: str = "auto",
        threads: int = 0,
    ) -> None:
        given = {
            "density": density_arguments(density, domain),
            "tolerance": tolerance,
            "max_steps": max_steps,
            "rescale": rescale,
            "linear": linear,
            "linear_residual": linear_residual,
        }
        options = diagram_options(precision, neighbors, threads=threads)
        self.domain = domain
        self._of_diagram: dict[str, Any] = {
            "device": device,
            "precision": precision,
            "neighbors": neighbors,
            "threads": threads,
        }
        points, start, self._table = checked_seeds(domain, positions, weights, None)
        target = checked_values(masses, positions, len(points), "masses")
        self._count = len(points)
        self._core = _core.TransportSolver(open_device(device), domain._core, given, options)
        self._core.set_seeds(points, start)
        warn_of_seeds_outside(domain, points)
        if target is not None:
            self._core.set_masses(target)

    def move_seeds(self, positions: ArrayLike) -> None:
        """Moves the seeds; the next solve starts from adjusted weights. Where both have labels, in the order of those
        given first."""
        ordered = in_order_of(positions, self._table)
        self._core.move_seeds(checked_positions(self.domain, ordered, count=self._count))

    def set_masses(self, masses: Optional[ArrayLike]) -> None:
        """Sets the target masses; None for equal ones."""
        self._core.set_masses(checked_values(masses, self._table, self._count, "masses"))

    def set_weights(self, weights: ArrayLike) -> None:
        """Sets the weights from which the next solve starts."""
        self._core.set_weights(reals(values_of(weights, self._table, "weights"), "weights", (self._count,)))

    def set_tolerance(self, tolerance: float) -> None:
        self._core.set_tolerance(tolerance)

    def set_max_steps(self, steps: int) -> None:
        """Sets the limit on the steps of all phases together."""
        self._core.set_max_steps(steps)

    @property
    def diagram(self) -> Diagram:
        """The diagram of all seeds with the weights of the last solve: a new one, which stays as it is when the solver
        goes on.

        Raises
        ------
        Error
            ``invalid_argument`` before the first solve, or if seeds were set or moved since.

        Examples
        --------
        >>> import powercell as pc
        >>> solver = pc.TransportSolver(pc.Domain.box([0, 0], [1, 1]), [[0.1, 0.5], [0.2, 0.5]], [0.75, 0.25])
        >>> result = solver.solve()
        >>> solver.diagram.mass.round(6).tolist()
        [0.75, 0.25]
        """
        positions, weights = self._core.diagram_seeds()
        found = Diagram(self.domain, positions, weights, **self._of_diagram)
        found._table = self._table
        return found

    @named_arguments
    def solve(self, progress: Progress = None) -> Any:
        """Solves from the current weights.

        Parameters
        ----------
        progress : bool or callable, optional
            True for a bar, or a function of a ``TransportStep``, which may return False to stop.

        Returns
        -------
        TransportResult
            With weights, mass, centroid, cost, converged, error and steps. A failure to converge is no error.
        """
        with step_bar(progress, "transport", _describe) as report:
            return self._core.solve(report)


def transport(
    domain: Domain,
    positions: ArrayLike,
    masses: Optional[ArrayLike] = None,
    density: Density = None,
    tolerance: float = 0.0,
    *,
    progress: Progress = None,
    **options: Any,
) -> Any:
    """Solves once: the weights for which the cells of the seeds have the masses.

    Parameters are those of :class:`TransportSolver`.

    Examples
    --------
    >>> import powercell as pc
    >>> box = pc.Domain.box([0, 0], [1, 1])
    >>> result = pc.transport(box, [[0.1, 0.5], [0.2, 0.5], [0.3, 0.5]], [0.5, 0.25, 0.25])
    >>> result.converged, result.centroid[:, 0].round(6).tolist()
    (True, [0.25, 0.625, 0.875])
    """
    solver = TransportSolver(domain, positions, masses, density, tolerance=tolerance, **options)
    return solver.solve(progress)
