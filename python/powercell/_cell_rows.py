"""Cells of some seeds of many: measures, and rows of walls with any seeds."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ._arrays import Reals
from ._core import ExchangeReport


class _Rows:
    """What the cells of a rank and those of a part of all rows have in common. Arrays are read-only views."""

    def __init__(self, core: Any, shifted: bool) -> None:
        self._core, self._shifted = core, shifted

    @property
    def mass(self) -> Reals:
        return self._core.measures.mass  # type: ignore[no-any-return]

    @property
    def centroid(self) -> Reals:
        return self._core.measures.centroid  # type: ignore[no-any-return]

    @property
    def second_moment(self) -> Reals:
        return self._core.measures.second_moment  # type: ignore[no-any-return]

    @property
    def status(self) -> NDArray[np.uint8]:
        return self._core.measures.status  # type: ignore[no-any-return]

    @property
    def domain_measure(self) -> float:
        return float(self._core.measures.domain_measure)

    @property
    def indptr(self) -> NDArray[np.int64]:
        return self._core.indptr  # type: ignore[no-any-return]

    @property
    def indices(self) -> NDArray[Any]:
        return self._core.indices  # type: ignore[no-any-return]

    @property
    def data(self) -> Reals:
        return self._core.data  # type: ignore[no-any-return]

    @property
    def shift(self) -> Optional[NDArray[np.int32]]:
        shift: Any = self._core.shift
        if shift is None and self._shifted:
            shift = np.empty((0, 3), np.int32)  # of rows without walls
        return None if shift is None else shift[:, : self.centroid.shape[1]]

    def neighbors(self, seed: int) -> NDArray[Any]:
        """The ids of the neighbours of one of these seeds, by its place among them."""
        if not 0 <= seed < len(self.indptr) - 1:
            raise IndexError(f"seed is {seed}; 0 to {len(self.indptr) - 2} are expected")
        return self.indices[self.indptr[seed] : self.indptr[seed + 1]]


class DistributedCells(_Rows):
    """The cells of the n seeds of one rank, in the order in which it gave them. Arrays are read-only views.

    Attributes
    ----------
    mass, second_moment : (n,) float64
        Area (volume) of the cell, and the integral of the squared distance from its seed over it.
    centroid : (n, d) float64
        NaN of empty cells.
    status : (n,) uint8
        See :class:`Status`; of duplicates that are as heavy the one of the lowest id on all ranks has the cell.
    domain_measure : float
        Of the whole domain.
    indptr : (n + 1,) int64
        Row i of the walls with other cells is ``indptr[i]`` to ``indptr[i + 1]``.
    indices : (m,) uint64
        Ids of the neighbours, which may be on any rank, ascending in each row.
    data : (m,) float64
        Length or area of the wall, as seen from the cell of the row.
    shift : (m, d) int32 or None
        In a periodic domain, else None: the image of the neighbour, as in :class:`Adjacency`.
    report : ExchangeReport
        What ranks sent to each other.
    """

    @property
    def indices(self) -> NDArray[np.uint64]:
        return super().indices.view(np.uint64)

    @property
    def report(self) -> ExchangeReport:
        return self._core.report  # type: ignore[no-any-return]

    def __repr__(self) -> str:
        return f"<powercell.DistributedCells of {len(self.indptr) - 1} seeds, {len(self.indices)} sides of walls>"


class CellRows(_Rows):
    """The cells of n consecutive seeds of :func:`compute_out_of_core`. Arrays are read-only views, and may be kept.

    Attributes
    ----------
    first : int
        Index of the first of these seeds.
    mass, second_moment : (n,) float64
        Area (volume) of the cell, and the integral of the squared distance from its seed over it.
    centroid : (n, d) float64
        NaN of empty cells.
    status : (n,) uint8
        See :class:`Status`.
    domain_measure : float
        Of the whole domain.
    indptr : (n + 1,) int64
        Row i has ``indptr[i + 1] - indptr[i]`` walls with other cells, also where these are left out.
    indices : (m,) int64
        Neighbours, by their indices among all seeds, ascending in each row; empty without ``walls=True``.
    data : (m,) float64
        Length or area of the wall, as seen from the cell of the row; likewise.
    shift : (m, d) int32 or None
        With ``walls=True`` in a periodic domain, else None: the image of the neighbour, as in :class:`Adjacency`.
    all_walls : int
        Walls of all cells, those of other rows too: what ``indptr`` would end with for all seeds.
    """

    def __init__(self, core: Any, walls: bool, periodic: bool) -> None:
        super().__init__(core, walls and periodic)
        self._walls = walls

    @property
    def first(self) -> int:
        return int(self._core.first)

    @property
    def all_walls(self) -> int:
        return int(self._core.all_walls)

    def __len__(self) -> int:
        return len(self.indptr) - 1

    def neighbors(self, seed: int) -> NDArray[Any]:
        """The neighbours of one of these seeds, by its place among them."""
        if not self._walls:
            raise ValueError("walls were only counted; pass walls=True to compute_out_of_core")
        return super().neighbors(seed)

    def __repr__(self) -> str:
        return f"<powercell.CellRows of seeds {self.first} to {self.first + len(self) - 1}>"
