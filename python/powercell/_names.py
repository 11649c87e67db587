"""What results and arguments are called elsewhere, near misses of their names, and how results show themselves."""

from __future__ import annotations

import difflib
import functools
import inspect
from types import SimpleNamespace
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
    "neighbours": "adjacency",
    "ridge_vertices": "cells",
    "hidden": "status",
    "simplices": "dual",
    "triangles": "dual",
    "delaunay": "dual",
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
    "mass": "masses",
    "walls": "adjacency",
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
                what = f"{function.__qualname__.removesuffix('.__init__')}() has no argument '{name}'"
                raise TypeError(what + _suggestion(name, known, _OTHER_ARGUMENTS))
        return function(*arguments, **keywords)

    return checked  # type: ignore[return-value]


def _shown(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype} array of {value.shape}"
    if isinstance(value, (list, tuple)) and (len(value) > 8 or not all(isinstance(one, (int, float, str)) for one in value)):
        return f"{type(value).__name__} of {len(value)}"
    return f"{value:.6g}" if isinstance(value, float) else repr(value)


class Record(SimpleNamespace):
    """The fields of a result that was copied or came from another process, in place of its class."""

    def __repr__(self) -> str:
        return lines_of(self._kind, {name: value for name, value in vars(self).items() if name != "_kind"})


def _record(kind: str, fields: dict[str, Any]) -> Record:
    return Record(_kind=kind, **fields)


def lines_of(kind: str, fields: dict[str, Any]) -> str:
    values = {name: _shown(value) for name, value in fields.items()}
    line = f"{kind}({', '.join(map('='.join, values.items()))})"
    if len(line) <= 100:
        return line
    width = max(map(len, values))
    return "\n".join([kind, *(f"{name:>{width}}: {value}" for name, value in values.items())])


def show_fields(kind: type) -> None:
    """Makes a class of the extension show the names and values of its fields, where they are long a line each, and
    pickle and copy as a :class:`Record` of them.
    """
    names = [name for name, member in vars(kind).items() if name[0] != "_" and not callable(member)]

    def fields(self: Any) -> dict[str, Any]:
        return {name: getattr(self, name) for name in names}

    setattr(kind, "__repr__", lambda self: lines_of(kind.__name__, fields(self)))
    setattr(kind, "__reduce__", lambda self: (_record, (kind.__name__, fields(self))))
