"""Results of diagrams: states of seeds, and rows of walls."""

from __future__ import annotations

import enum
from functools import cached_property
from typing import Any, Optional

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

    def __init__(self, core: Any, seeds: int, dimension: int, dtype: Any = np.float64) -> None:
        self._core = core
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
