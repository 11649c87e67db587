"""What results are called elsewhere, and near misses of their names."""

from __future__ import annotations

import difflib

_OTHER_NAMES = {
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


def unknown_result(kind: type, name: str) -> str:
    """The message for an attribute that a class does not have."""
    known = [other for other in dir(kind) if other[0] != "_"]
    close = [] if name[0] == "_" else difflib.get_close_matches(name, known, 1)
    other = _OTHER_NAMES.get(name, close[0] if close else "")
    return f"a {kind.__name__} has no '{name}'" + (f"; did you mean '{other}'?" if other else "")
