"""Regular triangulations."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import reals
from ._device import DeviceLike, open_device
from ._frames import checked_values
from ._names import named_arguments
from ._options import diagram_options
from ._progress import Progress, fraction_bar


@named_arguments
def regular_triangulation(
    positions: ArrayLike,
    weights: Optional[ArrayLike] = None,
    *,
    device: DeviceLike = None,
    precision: str = "auto",
    threads: int = 0,
    progress: Progress = None,
) -> NDArray[np.int32]:
    """The regular triangulation (weighted Delaunay) of seeds in the plane or in space.

    Parameters
    ----------
    positions : (n, 2) or (n, 3) array_like
    weights : (n,) array_like, optional

    Returns
    -------
    (m, 3) or (m, 4) int32
        Positively oriented simplices, rows of seed indices. Seeds in none are hidden or duplicates.

    Examples
    --------
    >>> import powercell as pc
    >>> pc.regular_triangulation([[0, 0], [1, 0], [0, 1]]).tolist()
    [[0, 1, 2]]
    """
    points = reals(positions, "positions", (None, None))
    if points.shape[1] not in (2, 3):
        raise ValueError(f"positions has the shape {points.shape}; (n, 2) or (n, 3) is expected")
    given = checked_values(weights, positions, len(points), "weights")
    options = diagram_options(precision=precision, threads=threads)
    dual: Any
    with fraction_bar(progress, "triangulation") as report:
        dual = _core.regular_triangulation(open_device(device), points, given, options, report)
    return dual.simplices  # type: ignore[no-any-return]
