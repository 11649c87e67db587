"""Warnings of seeds that miss the domain, and of those that others hide."""

from __future__ import annotations

import sys
import warnings
from typing import Any

import numpy as np

from . import _core
from ._arrays import Reals
from ._domain import Domain


class SeedsOutsideWarning(UserWarning):
    """Fewer than one seed in twenty lies in the domain's box, which is hardly meant: coordinates in another order,
    system or unit. The message says which would fit. ``warnings.simplefilter("ignore", pc.SeedsOutsideWarning)``
    silences it; seeds outside are legal and have cells where they are the nearest.
    """


class HiddenSeedsWarning(UserWarning):
    """More than half of the seeds have no cell: weights that are radii, or of another unit, hide the others.
    ``warnings.simplefilter("ignore", pc.HiddenSeedsWarning)`` silences it.
    """


def _level_of_caller() -> int:
    """The ``stacklevel`` that names the line outside of this package, for a warning by the caller."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        level, frame = level + 1, frame.f_back
    return level


def warn_of_seeds_outside(domain: Domain, positions: Reals) -> None:
    text = _core.seeds_outside(domain._core, positions)
    if text:
        warnings.warn(
            f"{text}. Seeds may lie outside; if these are meant to, ignore powercell.SeedsOutsideWarning",
            SeedsOutsideWarning,
            stacklevel=_level_of_caller(),
        )


def warn_of_hidden_seeds(domain: Domain, weights: Reals, status: Any, by_radii: bool) -> None:
    """Where weights are to blame: seeds outside the domain have no cell either."""
    hidden = int(np.count_nonzero(status == 1))
    if 2 * hidden <= len(status):
        return
    spacing = (domain.measure / len(weights)) ** (1 / (3 if domain.kind == "volume" else 2))
    if float(np.ptp(weights)) > spacing**2:
        why = "Radii are lengths in the unit of the positions" if by_radii else (
            "A weight is a length squared: pass radii=... for radii"
        )
        warnings.warn(
            f"{hidden:,} of {len(status):,} seeds are hidden by others. {why}. If this is meant, ignore "
            "powercell.HiddenSeedsWarning",
            HiddenSeedsWarning,
            stacklevel=_level_of_caller(),
        )
