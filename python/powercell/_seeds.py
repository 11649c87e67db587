"""Tables of seeds."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, field
from typing import Any, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._arrays import Reals
from ._domain import Domain
from ._errors import Error
from ._names import named_arguments


@dataclass(frozen=True)
class Seeds:
    """Seeds of a file, in its order."""

    positions: Reals
    """(n, d)"""
    weights: Reals
    """(n,), length squared; 0 without a column of weights."""
    columns: dict[str, np.ndarray] = field(default_factory=dict)
    """All columns of a table with a header, as text or, where all fields are numbers, as numbers."""
    crs: Optional[str] = None
    """Coordinate system that the file says; None otherwise."""
    taken: str = ""
    """Which columns were taken for what."""

    def __len__(self) -> int:
        return len(self.weights)

    def __getitem__(self, column: str) -> np.ndarray:
        return self.columns[column]


def _column(fields: list[str]) -> np.ndarray:
    try:
        return np.array([float(text.replace(",", ".")) for text in fields])
    except ValueError:
        return np.array(fields)


_Columns = Tuple[Sequence[str], str, str]  # of positions, weight and radius


def _read(path: str, dimension: int, columns: _Columns) -> Any:
    try:
        return _core.read_seeds(path, dimension, [str(name) for name in columns[0]], *columns[1:])
    except Error as error:  # in the words of the tool
        text = re.sub(r"--(weight|radius)-column( (?=['\"]))?", lambda m: f"{m[1]}_column" + ("=" if m[2] else ""), str(error))
        text = re.sub(r"--x-column((,| and) --[yz]-column)+|--x-column( 2)? and so on|--[xyz]-column", "position_columns", text)
        raise Error(text, error.code) from None


def _find_dimension(path: str, columns: _Columns) -> int:
    if columns[0]:
        return len(columns[0])
    try:
        table = _read(path, 2, columns)
    except Error as in_plane:
        try:
            _read(path, 3, columns)
        except Error:
            raise in_plane from None
        return 3
    if table.names:
        return 3 if any(name.strip().lower() in ("z", "z_coord", "pz") for name in table.names) else 2
    if table.count == 4:
        return 3
    if table.count == 3:
        raise ValueError(
            f"{path}: rows of three numbers may be 'x y weight' or 'x y z': pass dimension=2 or 3, or domain="
        )
    return 2


@named_arguments
def read_seeds(
    path: Union[str, os.PathLike[str]],
    domain: Optional[Domain] = None,
    *,
    dimension: Optional[int] = None,
    position_columns: Sequence[str] = (),
    weight_column: str = "",
    radius_column: str = "",
) -> Seeds:
    """Reads seeds as the tool's ``--seeds`` does: text, CSV, points in GeoJSON or GeoPackage, .npy.

    Parameters
    ----------
    path : str or path
    domain : Domain, optional
        Says how many coordinates a seed has.
    dimension : {2, 3}, optional
        The same. Without both it is found from the columns, where these leave no doubt.
    position_columns : sequence of str
        Two or three columns by their names, or numbers from 1, for x, y (and z). Default: found by their names.
    weight_column, radius_column : str
        Likewise; weights are the squares of radii.
    """
    name, chosen = os.fspath(path), (position_columns, weight_column, radius_column)
    if dimension is None:
        found = domain.dimension if domain is not None else _find_dimension(name, chosen)
    elif dimension in (2, 3):
        found = dimension
    else:
        raise ValueError(f"dimension is {dimension}; 2 or 3 is expected")
    table = _read(name, found, chosen)
    columns = {key: _column(table.column(k)) for k, key in enumerate(table.names)}
    return Seeds(table.positions, table.weights, columns, table.crs or None, table.taken)
