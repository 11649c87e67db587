"""Seeds from the tables of pandas and GeoPandas, which are not imported for that."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import Reals, optional_reals, reals
from ._domain import Domain
from ._shapes import require_same_crs


def _geometry_points(positions: Any, dimension: int) -> Optional[ArrayLike]:
    """The coordinates of points of Shapely: a MultiPoint, or a list or array of points; None for other positions."""
    points = list(positions.geoms) if hasattr(positions, "geoms") else positions
    is_array = getattr(points, "dtype", None) == object or hasattr(points, "geom_type")  # the latter of GeoPandas
    if not (isinstance(points, (list, tuple)) or is_array) or getattr(points, "ndim", 1) == 0 or len(points) == 0:
        return None
    if getattr(next(iter(points)), "geom_type", "") != "Point":
        return None
    wrong = [k for k, point in enumerate(points) if getattr(point, "geom_type", "") != "Point" or point.is_empty]
    if wrong:
        raise ValueError(f"positions: row {wrong[0]} is not a point, as the others are")
    if dimension == 3 and not all(point.has_z for point in points):
        raise ValueError("positions are points in the plane, and the domain is in space")
    return np.array([[getattr(point, axis) for axis in "xyz"[:dimension]] for point in points], dtype=np.float64)


def _points_of(positions: Any, dimension: int, crs: Optional[str]) -> ArrayLike:
    """The points of a table or of geometries; other positions as they are. Columns x, y, z go by their names."""
    geometry = getattr(positions, "geometry", None)
    if geometry is not None and hasattr(geometry, "x"):
        require_same_crs(positions, crs)
        return np.column_stack([geometry.x, geometry.y])
    if not hasattr(positions, "columns"):
        points = _geometry_points(positions, dimension)
        return positions if points is None else points
    names = [str(name).strip().lower() for name in positions.columns]
    axes = list("xyz"[:dimension])
    if not all(names.count(axis) == 1 for axis in axes):
        return positions  # type: ignore[no-any-return]
    if len(names) > dimension:
        chosen = [positions.columns[names.index(axis)] for axis in axes]
        raise ValueError(f"positions has the columns {list(positions.columns)}; pass table[{chosen}]")
    return positions.iloc[:, [names.index(axis) for axis in axes]]  # type: ignore[no-any-return]


def is_table(value: Any) -> bool:
    """Whether its rows have labels, as those of pandas."""
    return hasattr(getattr(value, "index", None), "equals")  # lists have an `index` too


def table_columns(table: Any) -> dict[str, Any]:
    """The columns of a table, or of None, without its geometry. A series has none."""
    geometry = getattr(getattr(table, "geometry", None), "name", None)
    return {key: table[key] for key in getattr(table, "columns", []) if key != geometry}


def values_of(values: Any, positions: Any, name: str) -> Any:
    """A column of `positions` by its name, or a series by its labels; others as they are."""
    if isinstance(values, str):
        if not hasattr(positions, "columns"):
            raise ValueError(f"{name} is {values!r}: only of a table, as of GeoPandas, it may be the name of a column")
        if values not in positions.columns:
            raise ValueError(f"{name} is {values!r}; the columns are {list(positions.columns)}")
        return positions[values]
    if not is_table(values) or not is_table(positions) or values.index.equals(positions.index):
        return values
    labels, rows = values.index, positions.index
    if not (labels.is_unique and rows.is_unique and len(labels) == len(rows) and rows.isin(labels).all()):
        raise ValueError(f"{name} has other labels than positions; pass {name}.to_numpy() if they are in the same order")
    return values.reindex(rows)


def checked_values(values: Any, positions: Any, count: int, name: str) -> Optional[Reals]:
    """Values for the rows of `positions`, which are `count`; None for None."""
    return optional_reals(values_of(values, positions, name), name, (count,), ", one for each seed")


def checked_positions(domain: Domain, positions: Any, name: str = "positions", count: Optional[int] = None) -> Reals:
    """Positions from an array, a table or geometries; `count` of them, where it is given."""
    d = domain.dimension
    given = _points_of(positions, d, domain.crs)
    return reals(given, name, (count, d), f", since the domain is {'in the plane' if d == 2 else 'in space'}")


def checked_seeds(
    domain: Domain, positions: Any, weights: Optional[Any], radii: Optional[Any]
) -> tuple[Reals, Optional[Reals], Optional[Any]]:
    """Positions, weights and, of pandas and GeoPandas, the table that they are from.

    Raises
    ------
    ValueError
        An array of the wrong shape or type, by name; weights and radii; a negative radius.
    """
    if isinstance(positions, (list, tuple)) and len(positions) == 0:
        raise ValueError(f"positions is empty; np.empty((0, {domain.dimension})) is a diagram without seeds")
    points = checked_positions(domain, positions)
    table = positions if is_table(positions) else None
    if radii is not None and weights is not None:
        raise ValueError("weights and radii are given; weights are the squares of radii: pass one of them")
    checked = checked_values(radii, positions, len(points), "radii")
    if checked is None:
        return points, checked_values(weights, positions, len(points), "weights"), table
    if (checked < 0).any():
        raise ValueError(f"radii: row {int(np.argmax(checked < 0))} is negative")
    return points, checked * checked, table
