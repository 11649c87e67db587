"""Densities as arguments: None, a number, a formula, a function, an image, or values at vertices."""

from __future__ import annotations

from typing import Any, Callable, Union

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import reals
from ._domain import Domain

Density = Union[None, float, str, Callable[..., float], ArrayLike]


def density_arguments(density: Density, domain: Domain) -> tuple[str, Any]:
    if density is None:
        return "constant", 1.0
    if isinstance(density, str):
        return "formula", density
    if callable(density):
        return "function", density
    if np.ndim(density) == 0:
        value = float(density)  # type: ignore[arg-type]
        return "constant", value
    if np.ndim(density) == 2:
        low, high = domain.bounds
        return "image", (reals(density, "density", (None, None)), list(low), list(high))
    return "nodal", reals(density, "density", (None,), ", one value for each vertex, or an image")
