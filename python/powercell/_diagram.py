"""Power diagrams."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import Indices, Reals, indices
from ._copies import device_by_name, restore_diagram
from ._device import Device, DeviceLike, open_device
from ._domain import Domain, require_domain
from ._frames import checked_seeds, checked_weights, kept_values
from ._names import named_arguments, unknown_result
from ._options import diagram_options, float_type
from ._outside import warn_of_hidden_seeds, warn_of_seeds_outside
from ._progress import Progress, fraction_bar, progress_function
from ._results import Adjacency, BoundaryWalls, Place, Status
from ._shown import Shown


class Diagram(Shown):
    """The power diagram of weighted seeds in a domain.

    The cell of seed i is the part of the domain where ``|x - p_i|^2 - w_i`` is least. Results are computed when
    they are first used, and kept until the seeds change. Arrays are read-only views of the library's memory;
    they stay valid when the seeds change, and then still have the old values.

    Parameters
    ----------
    domain : Domain
    positions : (n, d) array_like
        Seeds; d is 2 for polygons, 3 for surfaces and volumes. They may lie outside the domain; if
        most do, that is warned of. Or a table: a DataFrame of pandas with columns x, y (z), or lon, lat; a GeoDataFrame or
        GeoSeries of points; what :func:`read_seeds` returns, with its weights. Or points of Shapely.
    weights : (n,) array_like or str, optional
        Length squared (for a ball of radius r, r squared), of any sign. Default: 0, a Voronoi diagram. Where positions
        are a table, the name of a column, or a series, which goes by its labels.
    radii : (n,) array_like or str, optional
        In place of weights, which are their squares.
    device : Device, str or list of these, optional
        As for :meth:`Device.choose`. Default: the best one.
    precision : {"auto", "double", "float"} or a type of NumPy
    neighbors : {"auto", "tree", "flann"}
        How candidate neighbours are found; the cells are the same.
    decisions : {"exact", "fast"}
        ``"fast"`` accepts cells whose shape rounding may have decided.
    certify : bool
        Check each result by laws that need no reference.
    threads : int
        On the host; 0 for all.
    chunk_pairs : int
        The most pairs of a region and a seed on the device at once; 0 lets the library choose.
    initial_neighbors : int
        FLANN: length of the first neighbour lists; 0 for 16, in volumes 32.
    lift_eta : float, optional
        FLANN: the height eta of the lift ``sqrt(eta - w)``, at least the largest weight, which is the default.
    twin_queries : bool
        FLANN: query with the twin of a lifted seed instead of the seed itself.
    progress : bool or callable, optional
        True for a bar, or a function of the fraction done, which may return False to stop.
    dtype : {numpy.float64, numpy.float32}
        Of measures, centroids and walls in results; those of 32 bits are copies.

    Warns
    -----
    SeedsOutsideWarning
        Fewer than one seed in twenty lies in the domain's box.
    HiddenSeedsWarning
        More than half of the seeds have no cell, when measures are first used.

    Raises
    ------
    ValueError
        An array of the wrong shape or type, by name.
    Error
        ``invalid_seed`` (NaN or infinity: which seed), ``no_fp64``, ``out_of_device_memory`` and others.

    Examples
    --------
    >>> import powercell as pc
    >>> d = pc.Diagram(pc.Domain.box([0, 0], [1, 1]), [[0.25, 0.5], [0.75, 0.5]], weights=[0.1, 0])
    >>> d.mass.round(12).tolist()
    [0.6, 0.4]
    >>> d.adjacency.indices.tolist(), d.adjacency.data.tolist()
    ([1, 0], [1.0, 1.0])
    """

    @named_arguments
    def __init__(
        self,
        domain: Domain,
        positions: ArrayLike,
        weights: Optional[ArrayLike] = None,
        *,
        device: DeviceLike = None,
        precision: Any = "auto",
        neighbors: str = "auto",
        decisions: str = "exact",
        certify: bool = False,
        threads: int = 0,
        chunk_pairs: int = 0,
        initial_neighbors: int = 0,
        lift_eta: Optional[float] = None,
        twin_queries: bool = True,
        progress: Progress = None,
        radii: Optional[ArrayLike] = None,
        dtype: Any = np.float64,
    ) -> None:
        require_domain(domain)
        options = diagram_options(
            precision,
            neighbors,
            decisions,
            certify,
            threads,
            chunk_pairs,
            initial_neighbors,
            lift_eta,
            twin_queries,
        )
        self.domain = domain
        progress_function(progress)  # refuses what is none
        self._progress = progress
        points, given, self._table = checked_seeds(domain, positions, weights, radii)
        self._by_radii = radii is not None
        self._device, self._options, self._dtype = device, options, float_type(dtype)
        self._core: Any = _core.Diagram(open_device(device), domain._core, options)
        self._set(points, given)

    def _set(self, positions: Reals, weights: Optional[Reals]) -> None:
        self._core.set_seeds(positions, weights)
        self._positions, self._weights = positions, weights
        self._hidden_known = weights is None  # without weights only duplicates have no cell
        self._selection: Optional[Indices] = None
        warn_of_seeds_outside(self.domain, positions)

    def __reduce__(self) -> tuple[Any, ...]:
        options = {**self._options, "device": device_by_name(self._device)}
        arguments = {"domain": self.domain, "positions": self._positions, "weights": self._weights, "dtype": self._dtype, **options}
        return restore_diagram, (type(self), arguments, self._table, self._selection)

    @named_arguments
    def set_seeds(
        self, positions: ArrayLike, weights: Optional[ArrayLike] = None, *, radii: Optional[ArrayLike] = None
    ) -> None:
        """Replaces the seeds; memory and programs on the device are reused.

        Without weights as many seeds as before keep theirs, by their labels where both come from tables.

        Raises
        ------
        ValueError
            Another number of seeds without weights, where the seeds before had some.
        """
        points, given, table = checked_seeds(self.domain, positions, weights, radii)
        if given is None and self._weights is not None and self._weights.any():
            if len(points) != len(self._weights):
                raise ValueError(
                    f"{len(points)} seeds without weights follow {len(self._weights)} with weights; "
                    "pass weights, or np.zeros(n) for none"
                )
            given = kept_values(self._weights, self._table, table)
        else:
            self._by_radii = radii is not None
        self._table = table
        self._set(points, given)

    @named_arguments
    def set_weights(self, weights: Optional[ArrayLike] = None, *, radii: Optional[ArrayLike] = None) -> None:
        """New weights for the same positions, or radii; only what depends on weights is computed again. As for the class,
        a column by its name or a series by its labels, where the seeds are from a table.
        """
        checked = checked_weights(self._table, weights, radii, len(self))
        if checked is None:
            raise ValueError("weights or radii are expected; np.zeros(n) for none")
        self._by_radii = radii is not None
        self._core.set_weights(checked)
        self._weights = checked
        self._hidden_known = False

    def select(self, seeds: ArrayLike) -> None:
        """From now on computes the cells of some seeds only, against all seeds, until :meth:`select_all` or new seeds.

        Row k of the results is then of ``seeds[k]``; neighbours keep their indices among all seeds. Time goes with the
        selected cells; on a surface also with its triangles, and in a solid as for all cells.

        Parameters
        ----------
        seeds : (k,) array_like of int
            Indices of seeds, each once, in any order.

        Examples
        --------
        >>> import powercell as pc
        >>> d = pc.Diagram(pc.Domain.box([0, 0], [4, 1]), [[0.5, 0.5], [1.5, 0.5], [2.5, 0.5], [3.5, 0.5]])
        >>> d.select([2])
        >>> d.mass.round(12).tolist(), d.adjacency.indices.tolist()
        ([1.0], [1, 3])
        """
        checked = indices(seeds, "seeds")
        self._core.select(checked)
        self._selection = checked

    def select_all(self) -> None:
        """Computes all cells again."""
        self._core.select_all()
        self._selection = None

    @property
    def has_selection(self) -> bool:
        """Whether :meth:`select` is in force."""
        return bool(self._core.has_selection)

    def _require_all(self, what: str) -> None:
        if self._selection is not None:
            raise ValueError(f"{what} is of all cells, and {len(self._selection)} are selected; call select_all() first")

    @named_arguments
    def compute(self, adjacency: bool = True, cells: bool = False) -> Diagram:
        """Computes the measures, and the adjacency and cells if wanted, in as few passes as possible."""
        with fraction_bar(self._progress, "power diagram") as report:
            self._core.compute(adjacency, cells, report)
        return self

    @property
    def positions(self) -> Reals:
        """(n, d): the seeds as given."""
        return self._positions

    @property
    def weights(self) -> Reals:
        """(n,): the weights as given; 0 without any."""
        return np.zeros(len(self._positions)) if self._weights is None else self._weights

    def __len__(self) -> int:
        return len(self._positions)

    def _measures(self) -> Any:
        if self._progress:
            self.compute(adjacency=False)
        measures = self._core.measures()
        if not self._hidden_known:
            self._hidden_known = True
            warn_of_hidden_seeds(self.domain, self.weights, measures.status, self._by_radii)
        return measures

    @property
    def mass(self) -> NDArray[Any]:
        """(n,): area or volume of each cell; 0 where empty."""
        return self._measures().mass.astype(self._dtype, copy=False)  # type: ignore[no-any-return]

    @property
    def centroid(self) -> NDArray[Any]:
        """(n, d): of each cell; NaN where empty."""
        return self._measures().centroid.astype(self._dtype, copy=False)  # type: ignore[no-any-return]

    @property
    def second_moment(self) -> NDArray[Any]:
        """(n,): integral of ``|x - p_i|^2`` over each cell."""
        return self._measures().second_moment.astype(self._dtype, copy=False)  # type: ignore[no-any-return]

    @property
    def status(self) -> NDArray[np.uint8]:
        """(n,): a :class:`Status` of each seed."""
        return self._measures().status  # type: ignore[no-any-return]

    @property
    def domain_measure(self) -> float:
        return float(self._measures().domain_measure)

    @property
    def relative_error(self) -> float:
        """``|sum of the masses - domain_measure| / domain_measure``."""
        return float(self._measures().relative_error)

    @property
    def adjacency(self) -> Adjacency:
        if self._progress:
            self.compute(adjacency=True)
        place = Place(self._positions, self.domain.periods, self._selection)
        return Adjacency(self._core.adjacency(), len(self), self.domain.dimension, self._dtype, place)

    @property
    def boundary_walls(self) -> BoundaryWalls:
        """The facets of the domain that the cells have, computed in a pass of its own.

        Examples
        --------
        >>> import powercell as pc
        >>> d = pc.Diagram(pc.Domain.box([0, 0], [1, 1]), [[0.25, 0.5], [0.75, 0.5]])
        >>> d.boundary_walls.indices.tolist(), d.boundary_walls.data.tolist()
        ([0, 2, 3, 0, 1, 2], [0.5, 0.5, 1.0, 0.5, 1.0, 0.5])
        """
        return BoundaryWalls(self._core.boundary_walls(), self._dtype)

    @property
    def cells(self) -> Any:
        """The cells as convex pieces, one for each region of the domain that a cell meets (``Cells``).

        A solid has no regions: see ``joined``.
        """
        if self._progress:
            self.compute(adjacency=False, cells=True)
        return self._core.cells()

    @property
    def joined(self) -> Any:
        """The cells as wholes (``JoinedCells``): of a solid by themselves, else joined across its regions."""
        return self._core.joined()

    @property
    def dual(self) -> NDArray[np.int32]:
        """(m, 3 or 4): the regular triangulation restricted to the domain, rows of seed indices."""
        return self._core.dual().simplices  # type: ignore[no-any-return]

    @property
    def dual_shift(self) -> Optional[NDArray[np.int32]]:
        """(m, d + 1, d): in a periodic domain the image of each corner of :attr:`dual`, as in :class:`Adjacency`;
        else None."""
        shift: Any = self._core.dual().shift
        return None if shift is None else shift[:, :, : self.domain.dimension]

    @property
    def timings(self) -> Any:
        """Seconds of the last computation by parts, and counts."""
        return self._core.timings

    @property
    def precision(self) -> str:
        return str(self._core.precision)

    @property
    def neighbors(self) -> str:
        """As chosen: ``"tree"`` or ``"flann"``."""
        return str(self._core.neighbors)

    @property
    def device(self) -> Device:
        return Device._of(self._core.device)

    @named_arguments
    def verify(self, samples: int = 1000, random_seed: int = 1, progress: Progress = None) -> list[Any]:
        """Checks the laws of a power diagram; each entry has law, passed, value, tolerance and detail.

        Parameters
        ----------
        samples : int
            Random points at which all seeds are tried.
        random_seed : int
        progress : bool or callable, optional
            As for :class:`Diagram`; called after each law.
        """
        given = {"samples": samples, "random_seed": random_seed}
        with fraction_bar(progress, "checking") as report:
            return list(self._core.verify(self._positions, self._weights, given, report))

    def _summary(self) -> list[tuple[str, str]]:
        status = self.status
        return [
            ("domain", repr(self.domain)[len("<powercell.Domain: ") : -1]),
            ("seeds", f"{len(self):,}"),
            ("cells", f"{int(np.count_nonzero(status == Status.OK)):,}"),
            ("hidden", f"{int(np.count_nonzero(status == Status.HIDDEN)):,}"),
            ("duplicate", f"{int(np.count_nonzero(status == Status.DUPLICATE)):,}"),
            (
                ("sum of measures / domain", f"1 {self._measures().total / self.domain_measure - 1:+.1e}")
                if self._selection is None
                else ("selected", f"{len(self._selection):,}")
            ),
            ("device", f"{self.device.name}, {self.precision}"),
            ("time", f"{self.timings.total:.3g} s"),
        ]

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            if hasattr(type(self), name):  # what a property has raised
                return object.__getattribute__(self, name)
            raise AttributeError(unknown_result(type(self), name))

    def __repr__(self) -> str:
        return f"<powercell.Diagram of {len(self)} seeds in {self.domain!r}>"

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><th>{key}</th><td>{value}</td></tr>" for key, value in self._summary())
        return f"<table><caption>powercell.Diagram</caption>{rows}</table>"


@named_arguments
def prepare(
    domain: Domain,
    *,
    device: DeviceLike = None,
    precision: str = "auto",
    neighbors: str = "auto",
    threads: int = 0,
    progress: Progress = None,
) -> None:
    """Builds and tests the kernels that diagrams of this kind run on the device, so that the first one takes no longer
    than the next ones: computes three small ones, with all results. What is built lasts as long as the process, and in a
    cache on disk.

    Parameters
    ----------
    domain : Domain
    device, precision, neighbors, threads
        As for :class:`Diagram`.
    progress : bool or callable, optional
        True for a bar, or a function of the fraction done, which may return False to stop.

    Examples
    --------
    >>> import powercell as pc
    >>> pc.prepare(pc.Domain.box([0, 0], [1, 1]))
    """
    require_domain(domain)
    options = diagram_options(precision, neighbors, threads=threads)
    with fraction_bar(progress, "preparing") as report:
        _core.prepare(open_device(device), domain._core, options, report)
