"""Voronoi treemaps."""

from __future__ import annotations

from typing import Any, Mapping, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import Reals, reals
from ._device import DeviceLike, optional_device
from ._names import named_arguments
from ._progress import Progress, fraction_bar


class Treemap:
    """A layout. Arrays are indexed by node.

    Attributes
    ----------
    names : list of str
    parent : (n,) int64
        -1 for the root.
    value : (n,)
        Of a group the sum of its leaves.
    kind : (n,) uint8
        0 leaf, 1 group, 2 dropped (has no polygon).
    depth : (n,) uint32
    worst_error : float
        The largest relative error of a leaf's area.
    worst_leaf : int
        The leaf that has it.
    not_converged : list of int
        Groups whose areas missed the tolerance.
    mean_aspect : float
        Of the leaves: the ratio of the longer to the shorter principal axis.
    leaves : int
    diagrams, newton_steps : int
        Of all groups together.
    seeds : (n, 2)
        Near the centroids; NaN where a node has no polygon.
    """

    def __init__(self, core: Any, parent: np.ndarray, names: list[str]) -> None:
        self._core, self.parent, self.names = core, parent, names
        self.value, self.kind, self.depth = core.value, core.kind, core.depth
        self.worst_error, self.not_converged = core.worst_error, list(core.not_converged)
        self.worst_leaf: int = core.worst_leaf
        self.mean_aspect, self.leaves = core.mean_aspect, core.leaves
        self.diagrams: int = core.diagrams
        self.newton_steps: int = core.newton_steps
        self.seeds: Reals = core.seeds

    def polygon(self, node: int) -> Reals:
        """(m, 2): the corners of a node's polygon, counter-clockwise; none if it was dropped."""
        offset = self._core.vertex_offset
        return self._core.vertices[offset[node] : offset[node + 1]]  # type: ignore[no-any-return]

    def __len__(self) -> int:
        return len(self.parent)

    def __repr__(self) -> str:
        return f"<powercell.Treemap of {self.leaves} leaves, areas to {self.worst_error:.1e}>"


def _flatten(tree: Mapping[str, Any]) -> tuple[list[int], list[float], list[str]]:
    parent, value, names = [-1], [0.0], [""]
    waiting = [(0, tree)]
    while waiting:
        node, children = waiting.pop()
        for name, child in children.items():
            parent.append(node)
            names.append(str(name))
            if isinstance(child, Mapping):
                value.append(0.0)
                waiting.append((len(parent) - 1, child))
            else:
                value.append(float(child))
    return parent, value, names


def _square() -> Reals:
    return np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


@named_arguments
def treemap(
    tree: Union[Mapping[str, Any], ArrayLike],
    value: Optional[ArrayLike] = None,
    outline: Optional[ArrayLike] = None,
    *,
    names: Optional[list[str]] = None,
    previous: Optional[Treemap] = None,
    tolerance: float = 1e-6,
    rounds: int = 25,
    random_seed: int = 1,
    threads: int = 0,
    large_group: int = 4096,
    device: DeviceLike = None,
    progress: Progress = None,
) -> Treemap:
    """Draws a weighted tree as nested convex cells whose areas are proportional to the values.

    Parameters
    ----------
    tree : mapping or (n,) array_like of int
        Nested mappings from names to values or further mappings; or the parent of each node, -1 for the root.
    value : (n,) array_like
        With parents: the values of the leaves.
    outline : (m, 2) array_like, optional
        Corners of a convex polygon. Default: the unit square.
    names : list of str, optional
        With parents: for error messages.
    previous : Treemap, optional
        An earlier layout of the same nodes to stay close to.
    tolerance : float
        Largest relative error of an area.
    rounds : int
        Moves of seeds to centroids; more make rounder cells.
    random_seed, threads : int
        0 threads for all.
    large_group : int
        Groups of more siblings are laid out on the device, others on the host.
    device : Device, str or list of these, optional
        As for :meth:`Device.choose`.

    Examples
    --------
    >>> import powercell as pc
    >>> t = pc.treemap({"a": 3, "b": {"c": 1, "d": 2}})
    >>> t.names, t.leaves
    (['', 'a', 'b', 'c', 'd'], 3)
    """
    if isinstance(tree, Mapping):
        if value is not None:
            raise ValueError("value is for trees given by parents; a mapping has its own")
        flat_parent, flat_value, names = _flatten(tree)
        parent, values = np.array(flat_parent, np.int64), np.array(flat_value)
    else:
        parent = np.asarray(tree)
        if parent.ndim != 1 or parent.dtype.kind not in "iu":
            raise ValueError("tree has to be a mapping, or an (n,) array of integers: the parent of each node")
        parent = np.ascontiguousarray(parent, np.int64)
        values = reals(value if value is not None else [], "value", (len(parent),), ", one for each node")
    labels = [] if names is None else [str(name) for name in names]
    if labels and len(labels) != len(parent):
        raise ValueError(f"names has {len(labels)} entries; one for each of {len(parent)} nodes is expected")
    ring = _square() if outline is None else reals(outline, "outline", (None, 2))
    start = None
    if previous is not None:
        if len(previous) != len(parent):
            raise ValueError(f"previous has {len(previous)} nodes; {len(parent)} are expected")
        start = np.array(_core.relative_positions(previous.parent, previous._core)).reshape(-1, 2)
    given = {
        "tolerance": tolerance,
        "rounds": rounds,
        "random_seed": random_seed,
        "threads": threads,
        "large_group": large_group,
        "names": labels,
    }
    with fraction_bar(progress, "treemap") as report:
        core = _core.treemap(parent, values, ring, start, given, optional_device(device), report)
    return Treemap(core, parent, labels)
