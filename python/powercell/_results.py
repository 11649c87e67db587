"""Results of diagrams: states of seeds, and rows of walls."""

from __future__ import annotations

import enum
from functools import cached_property
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from . import _looks


class Status(enum.IntEnum):
    """State of a seed."""

    OK = 0
    """Its cell has a positive measure."""
    HIDDEN = 1
    """Its cell in the domain is empty."""
    DUPLICATE = 2
    """Another seed at the same position has a larger weight, or the same and a lower index."""


class Pairs(NamedTuple):
    """Each wall once. See :meth:`Adjacency.pairs`."""

    i: NDArray[Any]
    j: NDArray[Any]
    vector: NDArray[np.float64]
    measure: NDArray[Any]


class Place(NamedTuple):
    """Where the seeds of an adjacency are."""

    positions: NDArray[np.float64]
    periods: NDArray[np.float64]
    rows: Optional[NDArray[Any]]  # the seed of each row; None for all seeds


class Adjacency:
    """The pairs of cells that share a wall, as compressed sparse rows like those of ``scipy.sparse``.

    Attributes
    ----------
    indptr : (n + 1,) int64
    indices : (m,) int32
        Neighbours, ascending in each row.
    data : (m,)
        Length or area of the wall, of the ``dtype`` of the diagram.
    asymmetry : float
        The largest difference of a wall as seen from its two sides, before these were averaged.
    asymmetric : (int, int)
        The seeds of that wall; equal if there was none.
    shift : (m, d) int32 or None
        In a periodic domain the image of the neighbour, in units of ``Domain.periods``: the wall is with the
        neighbour moved by ``shift @ periods``.
    """

    def __init__(
        self, core: Any, seeds: int, dimension: int, dtype: Any = np.float64, place: Optional[Place] = None
    ) -> None:
        self._core = core
        self._place = place
        self._seeds = seeds
        self._dimension = dimension
        self._dtype = dtype

    @property
    def indptr(self) -> NDArray[np.int64]:
        return self._core.indptr  # type: ignore[no-any-return]

    @property
    def indices(self) -> NDArray[np.int32]:
        found: Any = self._core.indices
        return found if self._seeds <= 2**31 else found.view(np.uint32).astype(np.int64)  # type: ignore[no-any-return]

    @cached_property
    def data(self) -> NDArray[Any]:
        return self._core.data.astype(self._dtype, copy=False)  # type: ignore[no-any-return]

    @property
    def shift(self) -> Optional[NDArray[np.int32]]:
        shift: Any = self._core.shift
        return None if shift is None else shift[:, : self._dimension]

    @property
    def asymmetry(self) -> float:
        return float(self._core.asymmetry)

    @property
    def asymmetric(self) -> tuple[int, int]:
        return self._core.asymmetric  # type: ignore[no-any-return]

    def neighbors(self, seed: int) -> NDArray[np.int32]:
        """The neighbours of one seed, or of a selected seed by its place in the selection."""
        if not 0 <= seed < len(self.indptr) - 1:
            raise IndexError(f"seed is {seed}; 0 to {len(self.indptr) - 2} are expected")
        return self.indices[self.indptr[seed] : self.indptr[seed + 1]]

    def sides(self) -> Pairs:
        """Each wall from each of its cells, in the order of ``indices``. As :meth:`pairs`."""
        if self._place is None:
            raise ValueError("this adjacency has no positions; take that of a Diagram")
        positions, periods, rows = self._place
        i = np.repeat(np.arange(len(self.indptr) - 1) if rows is None else np.asarray(rows), np.diff(self.indptr))
        j = self.indices
        vector = positions[j] - positions[i]
        if self.shift is not None:
            vector += self.shift @ periods
        return Pairs(i, j, vector, self.data)

    def pairs(self) -> Pairs:
        """Each wall once.

        Returns
        -------
        i, j : (p,) int
            Its seeds, i <= j; of a selection i is selected.
        vector : (p, d) float64
            From seed i to seed j, in a periodic domain to the image of j beyond the wall.
        measure : (p,)
            Length or area of the wall.

        Examples
        --------
        >>> import powercell as pc
        >>> box = pc.Domain.box([0, 0], [3, 1], periodic=[True, False])
        >>> pairs = pc.Diagram(box, [[0.5, 0.5], [1.5, 0.5], [2.5, 0.5]]).adjacency.pairs()
        >>> pairs.i.tolist(), pairs.j.tolist(), pairs.vector[:, 0].tolist(), pairs.measure.tolist()
        ([0, 0, 1], [1, 2, 2], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0])
        """
        i, j, vector, measure = self.sides()
        once = i < j
        if self.shift is not None:  # of a seed and its own image the first in the order of shifts
            leading = np.zeros(len(i), dtype=np.int64)
            for axis in range(self._dimension - 1, -1, -1):
                leading = np.where(self.shift[:, axis] != 0, self.shift[:, axis], leading)
            once |= (i == j) & (leading > 0)
        if self._place is not None and self._place.rows is not None:
            once |= ~np.isin(j, self._place.rows)
        return Pairs(i[once], j[once], vector[once], measure[once])

    def to_scipy(self) -> Any:
        """An (n, n) ``scipy.sparse.csr_array`` of the walls' measures. Images of one neighbour are summed.

        Of k selected seeds it is (k, n).
        """
        csr_array = _looks.package("scipy.sparse").csr_array
        kind = np.int32 if len(self.indices) < 2**31 else np.int64
        parts: Any = (np.array(self.data), self.indices.astype(kind), self.indptr.astype(kind))
        matrix = csr_array(parts, shape=(len(self.indptr) - 1, self._seeds))
        if self.shift is not None:
            matrix.sum_duplicates()
        return matrix

    def __repr__(self) -> str:
        return f"<powercell.Adjacency of {len(self.indptr) - 1} cells, {len(self.indices)} sides of walls>"


class BoundaryWalls:
    """The facets of the domain that each cell has, as compressed sparse rows.

    Attributes
    ----------
    indptr : (n + 1,) int64
    indices : (m,) int32
        Facets, ascending in each row. In a box of space 0 to 5 are -x +x -y +y -z +z, in one of the plane 0 to 3
        are -y +x +y -x; of a solid they are its triangles.
    data : (m,)
        Length or area of the part of the facet that belongs to the cell, of the ``dtype`` of the diagram.
    """

    def __init__(self, core: Any, dtype: Any = np.float64) -> None:
        self._core = core
        self._dtype = dtype

    @property
    def indptr(self) -> NDArray[np.int64]:
        return self._core.indptr  # type: ignore[no-any-return]

    @property
    def indices(self) -> NDArray[np.int32]:
        return self._core.indices  # type: ignore[no-any-return]

    @cached_property
    def data(self) -> NDArray[Any]:
        return self._core.data.astype(self._dtype, copy=False)  # type: ignore[no-any-return]

    def __repr__(self) -> str:
        return f"<powercell.BoundaryWalls of {len(self.indptr) - 1} cells, {len(self.indices)} parts of facets>"
