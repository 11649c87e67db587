"""What results and arguments are called elsewhere, near misses of their names, and how results show themselves."""

from __future__ import annotations

import difflib
import functools
import inspect
from typing import Any, Callable, Iterable, TypeVar

import numpy as np

_Function = TypeVar("_Function", bound=Callable[..., Any])

_OTHER_RESULTS = {
    "area": "mass",
    "areas": "mass",
    "volume": "mass",
    "volumes": "mass",
    "measure": "mass",
    "measures": "mass",
    "centroids": "centroid",
    "neighbours": "neighbors",
    "points": "positions",
    "ridge_points": "adjacency",
    "regions": "cells",
    "vertices": "cells",
    "radii": "weights",
}
_OTHER_ARGUMENTS = {
    "seeds": "positions",
    "points": "positions",
    "sites": "positions",
    "coordinates": "positions",
    "generators": "positions",
    "box": "domain",
    "bounds": "domain",
    "radius": "radii",
    "areas": "masses",
    "volumes": "masses",
    "tol": "tolerance",
    "eps": "tolerance",
    "max_iter": "max_steps",
    "maxiter": "max_steps",
    "n_jobs": "threads",
    "workers": "threads",
    "periodicity": "periodic",
    "callback": "progress",
    "verbose": "progress",
    "seed": "random_seed",
    "random_state": "random_seed",
    "rng": "random_seed",
}


def _suggestion(name: str, known: Iterable[str], others: dict[str, str]) -> str:
    public = [one for one in known if one[0] != "_"]
    close = [] if name[0] == "_" else difflib.get_close_matches(name, public, 1)
    other = others.get(name, "")
    found = other if other in public else close[0] if close else ""
    return f"; did you mean '{found}'?" if found else ""


def unknown_result(kind: type, name: str) -> str:
    """The message for an attribute that a class does not have."""
    return f"a {kind.__name__} has no '{name}'" + _suggestion(name, dir(kind), _OTHER_RESULTS)


def named_arguments(function: _Function) -> _Function:
    """The function, which names the argument that was meant where it is called by an unknown keyword."""
    parameters = inspect.signature(function).parameters.values()
    known = [one.name for one in parameters if one.kind in (one.POSITIONAL_OR_KEYWORD, one.KEYWORD_ONLY)]

    @functools.wraps(function)
    def checked(*arguments: Any, **keywords: Any) -> Any:
        for name in keywords:
            if name not in known:
                free = known[len(arguments) :]
                what = f"{function.__qualname__.removesuffix('.__init__')}() has no argument '{name}'"
                raise TypeError(what + _suggestion(name, free, _OTHER_ARGUMENTS))
        return function(*arguments, **keywords)

    return checked  # type: ignore[return-value]


def _shown(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype} array of {value.shape}"
    if isinstance(value, (list, tuple)) and len(value) > 8:
        return f"{type(value).__name__} of {len(value)}"
    return f"{value:.6g}" if isinstance(value, float) else repr(value)


def show_fields(kind: type) -> None:
    """Makes a class of the extension show the names and values of its fields, where they are long a line each."""
    fields = [name for name, member in vars(kind).items() if name[0] != "_" and not callable(member)]
    width = max(map(len, fields), default=0)

    def show(self: Any) -> str:
        values = [_shown(getattr(self, name)) for name in fields]
        line = f"{kind.__name__}({', '.join(map('='.join, zip(fields, values)))})"
        if len(line) <= 100:
            return line
        return "\n".join([kind.__name__, *(f"{name:>{width}}: {value}" for name, value in zip(fields, values))])

    setattr(kind, "__repr__", show)
