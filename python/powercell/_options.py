"""Options that diagrams have everywhere."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

_PRECISIONS = {"float32": "float", "float64": "double"}


def precision_name(precision: Any) -> Any:
    """What the core calls a precision: types of NumPy are answered too."""
    if not isinstance(precision, str):
        try:
            precision = np.dtype(precision).name
        except TypeError:
            raise ValueError(f"precision is {precision!r}; 'auto', 'double', 'float' or a type of NumPy is expected") from None
    return _PRECISIONS.get(precision, precision)


def float_type(dtype: Any) -> Any:
    """A type of NumPy that results may have."""
    found = np.dtype(dtype)
    if found not in (np.float32, np.float64):
        raise ValueError(f"dtype is {found}; float32 or float64 is expected")
    return found


def diagram_options(
    precision: Any = "auto",
    neighbors: str = "auto",
    decisions: str = "exact",
    certify: bool = False,
    threads: int = 0,
    chunk_pairs: int = 0,
    initial_neighbors: int = 0,
    lift_eta: Optional[float] = None,
    twin_queries: bool = True,
) -> dict[str, Any]:
    return {
        "precision": precision_name(precision),
        "neighbors": neighbors,
        "decisions": decisions,
        "certify": certify,
        "threads": threads,
        "chunk_pairs": chunk_pairs,
        "initial_neighbors": initial_neighbors,
        "lift_eta": lift_eta,
        "twin_queries": twin_queries,
    }
