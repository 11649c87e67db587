"""The check of diagrams that were saved."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import integers, reals

_SIZES = {"dimension", "cell_dimension"}
_NUMBERS = {"vertex_offset": np.uint64, "face_offset": np.uint64, "loop_offset": np.uint64, "loop": np.uint32}
_BORDERS = ("face_border", "edge_border")


def _in_range(values: Any, most: int, name: str) -> Any:
    if values.size and values.max() > most:
        raise ValueError(f"{name}: row {int(values.argmax())} is {int(values.max())}; 0 to {most} are expected")
    return values


def _cells(cells: Any) -> dict[str, Any]:
    missing = (_SIZES | set(_NUMBERS) | set(_BORDERS) | {"vertices"}) - set(dir(cells))
    if missing:
        raise ValueError(f"cells has no {', '.join(sorted(missing))}; the members of JoinedCells are expected")
    if getattr(cells, "shift", None) is not None:
        raise ValueError("the cells are periodic; without the domain only bounded ones can be checked")
    d = int(cells.dimension)
    found: dict[str, Any] = {name: int(getattr(cells, name)) for name in _SIZES}
    for name, dtype in _NUMBERS.items():
        found[name] = integers(getattr(cells, name), f"cells.{name}", (None,), dtype)
    for name in _BORDERS:
        found[name] = integers(getattr(cells, name), f"cells.{name}", (None, 2), np.uint32)
        _in_range(found[name][:, 0], 2, f"cells.{name}")
    found["vertices"] = reals(cells.vertices, "cells.vertices", (None, d)).ravel()
    return found


@dataclass(frozen=True)
class SavedDiagram:
    """A diagram without its domain, as it may have been saved: arrays that are not trusted. Not of periodic domains.

    Attributes
    ----------
    kind : {"polygon", "surface", "volume"}
    positions : (n, d) array_like
    mass : (n,) array_like
    status : (n,) array_like of int
        A :class:`Status` of each seed.
    domain_measure : float
    cells
        Anything with the members of ``JoinedCells``, as of :attr:`Diagram.joined`.
    weights : (n,) array_like, optional
    centroid : (n, d) array_like, optional
    precision : {"double", "float"}
        In which it was computed.

    Examples
    --------
    >>> import powercell as pc
    >>> d = pc.Diagram(pc.Domain.box([0, 0], [1, 1]), [[0.25, 0.5], [0.75, 0.5]])
    >>> saved = pc.SavedDiagram("polygon", d.positions, d.mass, d.status, d.domain_measure, d.joined)
    >>> all(check.passed for check in saved.verify())
    True
    """

    kind: str
    positions: ArrayLike
    mass: ArrayLike
    status: ArrayLike
    domain_measure: float
    cells: Any
    weights: Optional[ArrayLike] = None
    centroid: Optional[ArrayLike] = None
    precision: str = "double"

    def verify(self, samples: int = 1000, random_seed: int = 1) -> list[Any]:
        """Checks the laws as :meth:`Diagram.verify`; vertices of the cells take the place of random points.

        Raises
        ------
        Error
            ``invalid_argument`` if the arrays do not fit together (which cell).
        """
        cells = _cells(self.cells)
        points = reals(self.positions, "positions", (None, cells["dimension"]))
        n, why = len(points), ", one for each seed"
        weights = np.zeros(n) if self.weights is None else reals(self.weights, "weights", (n,), why)
        centroid = np.zeros(0) if self.centroid is None else reals(self.centroid, "centroid", points.shape).ravel()
        given = {
            "kind": self.kind,
            "precision": self.precision,
            "dimension": cells["dimension"],
            "mass": reals(self.mass, "mass", (n,), why),
            "centroid": centroid,
            "status": _in_range(integers(self.status, "status", (n,), np.uint8, why), 2, "status"),
            "domain_measure": float(self.domain_measure),
            "samples": samples,
            "random_seed": random_seed,
        }
        return list(_core.verify_saved(points, weights, given, cells))
