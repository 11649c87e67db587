"""The geometry of the cells of a diagram on a queue of pyopencl, in device memory."""

from __future__ import annotations

from typing import Any, Optional, Sequence

import numpy as np

from ._domain import Domain
from ._errors import Error

KINDS = ("pieces", "vertices", "faces", "entries of loops")
Room = tuple[int, int, int, int]


class DeviceCells:
    """The geometry of the cells of a :class:`DeviceDiagram` as convex pieces, in device memory: the arrays that
    :attr:`Diagram.cells` has. If some have too little room, then the first cells are written, as many as fit all of
    them, and nothing of the others.

    Attributes
    ----------
    counts : (4,) pyopencl.array.Array of uint64
        How many pieces, vertices, faces and entries of ``loop`` all cells have, also where they do not fit. Read, it
        can be given to ``compute(cells=)``.
    cell_offset : (n + 1,) pyopencl.array.Array of uint64
        Cell i owns the pieces ``cell_offset[i]`` to ``cell_offset[i + 1]``. Always right.
    region : (pieces,) pyopencl.array.Array of uint32
        The region of the domain that each piece lies in.
    vertex_offset, face_offset : (pieces + 1,) pyopencl.array.Array of uint64
    vertices : (v, d) pyopencl.array.Array
        A row for each of the v vertices, of the type of the positions.
    border : (faces, 2) pyopencl.array.Array of uint32
        Kind and index of what is behind each face: 0 and the seed, 1 and the facet of the domain's boundary, or 2 and
        the region where the cell goes on.
    shift : (faces, 3) pyopencl.array.Array of int32, or None
        In a periodic domain the image of the neighbour.
    loop_offset : (faces + 1,) pyopencl.array.Array of uint64, or None
        For cells in space: face f is the polygon ``loop[loop_offset[f]:loop_offset[f + 1]]``.
    loop : (entries,) pyopencl.array.Array of uint32, or None
        Indices from 0 within the vertices of the piece.
    room : four int
        How many pieces, vertices, faces and entries of ``loop`` fit.
    """

    _NAMES = (
        "counts", "cell_offset", "region", "vertex_offset", "vertices",
        "face_offset", "border", "shift", "loop_offset", "loop",
    )  # fmt: skip

    def __init__(self, queue: Any, domain: Domain, n: int, room: Room, empty: Any, dtype: np.dtype[Any]) -> None:
        """:param empty: makes an array of a shape and a type"""
        pieces, vertices, faces, entries = (max(1, number) for number in room)
        unsigned, long = np.dtype(np.uint32), np.dtype(np.uint64)
        volume = domain.cell_dimension == 3
        self._queue = queue
        self.room = room
        self.counts = empty((4,), long)
        self.cell_offset = empty((n + 1,), long)
        self.region = empty((pieces,), unsigned)
        self.vertex_offset = empty((pieces + 1,), long)
        self.vertices = empty((vertices, domain.dimension), dtype)
        self.face_offset = empty((pieces + 1,), long)
        self.border = empty((faces, 2), unsigned)
        self.shift: Optional[Any] = empty((faces, 3), np.dtype(np.int32)) if domain.is_periodic else None
        self.loop_offset: Optional[Any] = empty((faces + 1,), long) if volume else None
        self.loop: Optional[Any] = empty((entries,), unsigned) if volume else None

    def _arrays(self) -> list[Any]:
        """All arrays in the order of the bindings; None for those that the domain does not have."""
        return [getattr(self, name) for name in self._NAMES]

    def get(self) -> dict[str, np.ndarray]:
        """Waits for the diagram, and copies the arrays that there are to the host, by their names, without unused room.

        Raises
        ------
        Error
            ``invalid_argument`` if the cells exceed the room (how much they need).
        """
        counts = [int(number) for number in self.counts.get(self._queue)]
        if any(count > room for count, room in zip(counts, self.room)):
            needed, given = (", ".join(f"{c} {k}" for c, k in zip(numbers, KINDS)) for numbers in (counts, self.room))
            raise Error(
                f"the cells have {needed}, and there is room for {given}; give compute(cells={tuple(counts)})",
                "invalid_argument",
            )
        pieces, vertices, faces, entries = counts
        lengths = {
            "region": pieces, "vertex_offset": pieces + 1, "vertices": vertices, "face_offset": pieces + 1,
            "border": faces, "shift": faces, "loop_offset": faces + 1, "loop": entries,
        }  # fmt: skip
        found = {"counts": np.array(counts, np.uint64), "cell_offset": self.cell_offset.get(self._queue)}
        for name, length in lengths.items():
            array = getattr(self, name)
            if array is not None:
                found[name] = (
                    array[:length].get(self._queue) if length else np.empty((0, *array.shape[1:]), array.dtype)
                )
        if len(found["cell_offset"]) == 1:  # no seeds: nothing else has been written
            for name in ("vertex_offset", "face_offset", "loop_offset"):
                if name in found:
                    found[name] = np.zeros(1, np.uint64)
        return found

    def __repr__(self) -> str:
        numbers = ", ".join(f"{number} {kind}" for number, kind in zip(self.room, KINDS))
        return f"<powercell.DeviceCells of {len(self.cell_offset) - 1} seeds, room for {numbers}>"


def room_for(cells: Any, domain: Domain, n: int) -> Optional[Room]:
    """What `cells` asks to make room for; None if they are not wanted."""
    if cells is False:
        return None
    if cells is True:
        pieces = n if domain.region_count == 1 else 3 * (n + domain.region_count)
        return (pieces, 32 * pieces, 18 * pieces, 96 * pieces) if domain.cell_dimension == 3 else (
            pieces, 8 * pieces, 8 * pieces, 0,
        )  # fmt: skip
    numbers = [int(number) for number in cells] if isinstance(cells, (Sequence, np.ndarray)) else []
    if len(numbers) != 4 or min(numbers) < 0:
        raise ValueError(f"cells is {cells!r}; True, False or four numbers ({', '.join(KINDS)}) are expected")
    pieces, vertices, faces, entries = numbers
    return pieces, vertices, faces, entries
