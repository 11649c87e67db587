"""Seeds from tables: of pandas and GeoPandas, which are not imported for that, and of files."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import Reals, optional_reals, reals
from ._domain import Domain, require_domain
from ._seeds import Seeds
from ._shapes import is_geographic, require_same_crs

_AXES = {"x": 0, "lon": 0, "longitude": 0, "lng": 0, "easting": 0, "y": 1, "lat": 1, "latitude": 1, "northing": 1, "z": 2}
_WEIGHTS = {"w", "weight", "weights", "r", "radius", "radii"}


def is_table(value: Any) -> bool:
    """Whether its rows have labels, as those of pandas."""
    return hasattr(getattr(value, "index", None), "equals")  # lists have an `index` too


def table_columns(table: Any) -> dict[str, Any]:
    """The columns of a table, or of None, without its geometry. A series has none."""
    geometry = getattr(getattr(table, "geometry", None), "name", None)
    return {key: table[key] for key in getattr(table, "columns", []) if key != geometry}


def _points_of_geometry(points: Any, dimension: int, name: str) -> ArrayLike:
    """The coordinates of points of Shapely."""
    kinds = [getattr(point, "geom_type", type(point).__name__) for point in points]
    wrong = [k for k, point in enumerate(points) if kinds[k] != "Point" or point.is_empty]
    if wrong:
        what = f"a {kinds[wrong[0]]}" if kinds[wrong[0]] != "Point" else "empty"
        raise ValueError(f"{name}: row {wrong[0]} is {what}; points are expected")
    if dimension == 3 and not all(point.has_z for point in points):
        raise ValueError(f"{name} are points in the plane, and the domain is in space")
    return np.array([[getattr(point, axis) for axis in "xyz"[:dimension]] for point in points], dtype=np.float64)


def _numbers(column: Any, name: str, key: Any) -> Any:
    """A column of numbers, also of the types of pandas that know of missing values."""
    if isinstance(column.dtype, np.dtype) and column.dtype.kind in "biuf":
        return column
    try:
        if column.dtype.kind == "O" or not isinstance(column.dtype, np.dtype):
            return column.to_numpy(dtype=np.float64, na_value=np.nan)
    except (TypeError, ValueError):
        pass
    raise ValueError(f"{name}: the column {key!r} has the type {column.dtype}; numbers are expected")


def _points_of_frame(table: Any, domain: Domain, name: str) -> ArrayLike:
    """Columns x, y, z, or what maps call them, by their names; where none has such a name, in their order."""
    axes: list[list[Any]] = [[] for _ in range(3)]
    for key in table.columns:
        axis = _AXES.get(str(key).strip().lower())
        if axis is not None:
            axes[axis].append(key)
    d = domain.dimension
    if all(len(keys) == 1 for keys in axes[:d]):
        keys = [axes[k][0] for k in range(d)]
        in_degrees = any(str(key).strip().lower().startswith(("lon", "lat", "lng")) for key in keys)
        if in_degrees and domain.crs is not None and not is_geographic(domain.crs):
            raise ValueError(f"{name} has the columns {keys}, in degrees, but the domain is in {domain.crs}")
        return np.column_stack([_numbers(table[key], name, key) for key in keys])
    if any(axes) or len(table.columns) != d:
        expected = "x, y" if d == 2 else "x, y, z"
        raise ValueError(f"{name} has the columns {list(table.columns)}; {expected} are expected")
    return np.column_stack([_numbers(table[key], name, key) for key in table.columns])


def _points_of(positions: Any, domain: Domain, name: str) -> ArrayLike:
    """The points of a table or of geometries; other positions as they are."""
    if isinstance(positions, str):
        raise ValueError(f"{name} is {positions!r}; read_seeds() reads files")
    if isinstance(positions, Seeds):
        return positions.positions
    geometry = getattr(positions, "geometry", None)
    if geometry is not None and hasattr(geometry, "geom_type"):
        require_same_crs(positions, domain.crs)
        if domain.dimension == 2 and (geometry.geom_type == "Point").all() and not geometry.is_empty.any():
            return np.column_stack([geometry.x, geometry.y])
        return _points_of_geometry(list(geometry), domain.dimension, name)
    if isinstance(getattr(positions, "geom_type", None), str) and not hasattr(positions, "geoms"):
        raise ValueError(f"{name} is a single {positions.geom_type}; a list of points is expected")
    if hasattr(positions, "columns"):
        return _points_of_frame(positions, domain, name)
    points = list(positions.geoms) if hasattr(positions, "geoms") else positions
    is_array = getattr(points, "dtype", None) == object or hasattr(points, "geom_type")  # the latter of GeoPandas
    if not (isinstance(points, (list, tuple)) or is_array) or getattr(points, "ndim", 1) == 0 or len(points) == 0:
        return points
    if not hasattr(points[0], "geom_type"):
        return points
    return _points_of_geometry(list(points), domain.dimension, name)


def values_by_label(values: Any, positions: Any, name: str) -> Any:
    """A column of `positions` by its name, or a series by its labels; others as they are."""
    if isinstance(values, str):
        if not hasattr(positions, "columns"):
            raise ValueError(f"{name} is {values!r}: only where positions are a table it may be the name of a column")
        if values not in positions.columns:
            raise ValueError(f"{name} is {values!r}; the columns are {list(positions.columns)}")
        return positions[values]
    if not is_table(values) or not is_table(positions) or values.index.equals(positions.index):
        return values
    return _in_order_of(values, positions, name)


def values_of(values: Any, positions: Any, name: str) -> Any:
    """The same, numbers."""
    found = values_by_label(values, positions, name)
    return _numbers(found, name, values) if isinstance(values, str) else found


def _in_order_of(values: Any, positions: Any, name: str, others: str = "positions") -> Any:
    labels, rows = values.index, positions.index
    if not (labels.is_unique and rows.is_unique and len(labels) == len(rows) and rows.isin(labels).all()):
        raise ValueError(f"{name} has other labels than {others}; pass {name}.to_numpy() if they are in the same order")
    return values.reindex(rows)


def in_order_of(moved: Any, before: Any) -> Any:
    """New positions of the same seeds, in the order in which they came in, where both have labels."""
    if not is_table(moved) or not is_table(before) or moved.index.equals(before.index):
        return moved
    return _in_order_of(moved, before, "positions", "before")


def kept_values(values: Reals, before: Any, now: Any) -> Reals:
    """Values of the rows of one table for those of another, by their labels where both have some."""
    if not is_table(before) or not is_table(now) or before.index.equals(now.index):
        return values
    known = before.index.is_unique and now.index.is_unique
    places = before.index.get_indexer(now.index) if known else np.array([-1])
    if (places < 0).any():
        raise ValueError("positions has other labels than before; pass weights")
    found: Reals = values[places]
    return found


def checked_values(values: Any, positions: Any, count: int, name: str) -> Optional[Reals]:
    """Values for the rows of `positions`, which are `count`; None for None."""
    return optional_reals(values_of(values, positions, name), name, (count,), ", one for each seed")


def checked_positions(domain: Domain, positions: Any, name: str = "positions", count: Optional[int] = None) -> Reals:
    """Positions from an array, a table or geometries; `count` of them, where it is given."""
    require_domain(domain)
    d = domain.dimension
    given = _points_of(positions, domain, name)
    return reals(given, name, (count, d), f", since the domain is {'in the plane' if d == 2 else 'in space'}")


def checked_seeds(
    domain: Domain, positions: Any, weights: Optional[Any], radii: Optional[Any]
) -> tuple[Reals, Optional[Reals], Optional[Any]]:
    """Positions, weights and the table that they are from, or None.

    Raises
    ------
    ValueError
        An array of the wrong shape or type, by name; weights and radii; a negative radius; a table with weights that are
        not used.
    """
    if isinstance(positions, (list, tuple)) and len(positions) == 0:
        raise ValueError(f"positions is empty; np.empty((0, {domain.dimension})) is a diagram without seeds")
    points = checked_positions(domain, positions)
    table = positions if is_table(positions) or isinstance(positions, Seeds) else None
    given = checked_weights(positions, weights, radii, len(points))
    return points, _own_weights(positions) if given is None else given, table


def checked_weights(positions: Any, weights: Optional[Any], radii: Optional[Any], count: int) -> Optional[Reals]:
    """Weights for the rows of `positions`, which are `count`, from these or radii; None for neither."""
    if radii is not None and weights is not None:
        raise ValueError("weights and radii are given; weights are the squares of radii: pass one of them")
    checked = checked_values(radii, positions, count, "radii")
    if checked is None:
        return checked_values(weights, positions, count, "weights")
    if (checked < 0).any():
        raise ValueError(f"radii: row {int(np.argmax(checked < 0))} is negative")
    return checked * checked


def _own_weights(positions: Any) -> Optional[Reals]:
    """The weights of what :func:`read_seeds` returned."""
    if isinstance(positions, Seeds):
        return positions.weights
    if is_table(positions) and not hasattr(positions, "geometry"):
        for key in table_columns(positions):
            if str(key).strip().lower() in _WEIGHTS:
                word = "radii" if str(key).strip().lower().startswith("r") else "weights"
                raise ValueError(f"positions has a column {key!r} that is not used; pass {word}={key!r}, or drop it")
    return None
