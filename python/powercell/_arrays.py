"""Checks and conversions of arguments: arrays of the exact type that the extension takes, or ValueError."""

from __future__ import annotations

from typing import Any, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Reals = NDArray[np.float64]
Indices = NDArray[np.uint32]


def _text(shape: Sequence[Optional[int]]) -> str:
    sizes = [letter if size is None else str(size) for size, letter in zip(shape, "nmk")]
    return "(" + ", ".join(sizes) + ("," if len(sizes) == 1 else "") + ")"


def is_pyopencl(value: Any) -> bool:
    """Whether it is an array of pyopencl, which is not imported for that."""
    return any(base.__module__ == "pyopencl.array" for base in type(value).__mro__)


def _plain(value: Any, name: str) -> NDArray[Any]:
    if is_pyopencl(value):
        raise ValueError(f"{name} is an array of pyopencl: pass it to DeviceDiagram, or {name}.get() to the host")
    if np.ma.is_masked(value):
        raise ValueError(f"{name} is a masked array with masked entries; fill or remove them")
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise ValueError(f"{name} is not an array: {error}") from None
    if array.dtype.kind not in "biuf":
        raise ValueError(f"{name} has the type {array.dtype}; numbers are expected")
    return array


def check_shape(found: tuple[int, ...], name: str, shape: Sequence[Optional[int]], why: str = "") -> None:
    fits = len(found) == len(shape) and all(w is None or w == s for s, w in zip(found, shape))
    if not fits:
        raise ValueError(f"{name} has the shape {found}; {_text(shape)} is expected{why}")


def reals(value: ArrayLike, name: str, shape: Sequence[Optional[int]], why: str = "") -> Reals:
    """A C-contiguous array of doubles. Copies only where the argument is something else."""
    array = _plain(value, name)
    if array.dtype.kind == "b":
        raise ValueError(f"{name} has the type bool; numbers are expected")
    if array.size == 0 and len(shape) == 2 and array.ndim < 2:
        array = array.reshape((0, shape[1] or 0))
    check_shape(array.shape, name, shape, why)
    return np.ascontiguousarray(array, dtype=np.float64)


def optional_reals(
    value: Optional[ArrayLike], name: str, shape: Sequence[Optional[int]], why: str = ""
) -> Optional[Reals]:
    return None if value is None else reals(value, name, shape, why)


def integers(value: ArrayLike, name: str, shape: Sequence[Optional[int]], dtype: Any, why: str = "") -> NDArray[Any]:
    """A C-contiguous array of that type of integers, whose values are in its range."""
    array = _plain(value, name)
    if array.size == 0 and len(shape) == 1:
        array = array.astype(dtype)
    if array.dtype.kind not in "iu":
        raise ValueError(f"{name} has the type {array.dtype}; integers are expected")
    check_shape(array.shape, name, shape, why)
    least, most = int(np.iinfo(dtype).min), int(np.iinfo(dtype).max)
    if array.size and (int(array.min()) < least or int(array.max()) > most):
        row = next(k for k, values in enumerate(array) if int(values.min()) < least or int(values.max()) > most)
        raise ValueError(f"{name}: row {row} has a number below {least} or above {most}")
    return np.ascontiguousarray(array, dtype=dtype)


def indices(value: ArrayLike, name: str, columns: Optional[int] = None) -> Indices:
    """Rows of indices from 0; without `columns` single indices."""
    return integers(value, name, (None,) if columns is None else (None, columns), np.uint32)
