"""What a diagram on a queue of pyopencl writes, in device memory."""

from __future__ import annotations

import enum
from typing import Any, ClassVar, Optional

import numpy as np

from . import _looks
from ._device_cells import DeviceCells
from ._errors import Error


class DeviceStatus(enum.IntEnum):
    """State of a seed of a :class:`DeviceDiagram`: those of :class:`Status`, and two more."""

    OK = 0
    HIDDEN = 1
    DUPLICATE = 2
    INVALID = 3
    """NaN, infinity, or so large that its square is not finite; it does not affect the others."""
    UNFINISHED = 4
    """Only the host can compute its cell: :meth:`DeviceDiagram.repair` has it done. The cells of the others are
    right."""


class _DeviceRows:
    """Entries of each seed, as compressed sparse rows in device memory: what :class:`DeviceAdjacency` and
    :class:`DeviceBoundaryWalls` have in common."""

    _NAME: ClassVar[str]  # of the argument of compute() that asks for them

    def __init__(self, queue: Any, indptr: Any, indices: Any, data: Any) -> None:
        self._queue = queue
        self.indptr = indptr
        self.indices = indices
        self.data = data

    def get(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Waits for the diagram, and copies ``indptr``, ``indices`` and ``data`` to the host, without unused room.

        Raises
        ------
        Error
            ``invalid_argument`` if the entries exceed the room (how many there are).
        """
        indptr = self.indptr.get(self._queue)
        return indptr, self._entries(self.indices, indptr), self._entries(self.data, indptr)

    def _entries(self, array: Any, indptr: np.ndarray) -> np.ndarray:
        """What rows have of an array, if there is room for all of them."""
        count, room = int(indptr[-1]), len(self.indices)
        if count > room:
            raise Error(
                f"there are {count} entries, and room for {room}; give compute({self._NAME}={count})",
                "invalid_argument",
            )
        host: np.ndarray = array[:count].get(self._queue) if count else np.empty((0, *array.shape[1:]), array.dtype)
        return host

    def __repr__(self) -> str:
        seeds, room = len(self.indptr) - 1, len(self.indices)
        return f"<powercell.{type(self).__name__} of {seeds} seeds, room for {room} entries>"


class DeviceAdjacency(_DeviceRows):
    """The walls of a :class:`DeviceDiagram`, as compressed sparse rows in device memory.

    Attributes
    ----------
    indptr : (n + 1,) pyopencl.array.Array of uint32
        Row i is ``indices[indptr[i]:indptr[i + 1]]``. Right also where the other arrays are too short.
    indices : (room,) pyopencl.array.Array of uint32
        Neighbours, ascending within a row. Rows that end beyond the room are not written, the others are whole.
    data : (room,) pyopencl.array.Array
        The length or area of each wall, the same from both sides.
    shift : (room, 3) pyopencl.array.Array of int32, or None
        In a periodic domain the image of each neighbour, as :attr:`Adjacency.shift`, with 0 behind the dimension.
    """

    _NAME = "adjacency"

    def __init__(self, queue: Any, indptr: Any, indices: Any, data: Any, shift: Optional[Any] = None) -> None:
        super().__init__(queue, indptr, indices, data)
        self.shift = shift

    def get_shift(self) -> Optional[np.ndarray]:
        """Waits for the diagram, and copies the shifts to the host, without unused room; None where there are none.

        Raises
        ------
        Error
            As :meth:`get`.
        """
        return None if self.shift is None else self._entries(self.shift, self.indptr.get(self._queue))


class DeviceBoundaryWalls(_DeviceRows):
    """The parts of the domain's boundary that the cells of a :class:`DeviceDiagram` have, as compressed sparse rows in
    device memory.

    Attributes
    ----------
    indptr : (n + 1,) pyopencl.array.Array of uint32
        Row i is ``indices[indptr[i]:indptr[i + 1]]``. Right also where the other arrays are too short.
    indices : (room,) pyopencl.array.Array of uint32
        Facets, with the numbers that :class:`BoundaryWalls` has, ascending within a row. Rows that end beyond the room
        are not written, the others are whole.
    data : (room,) pyopencl.array.Array
        Length or area of the part of the facet that belongs to the cell.
    """

    _NAME = "boundary_walls"


class DeviceUncertain:
    """The seeds of a :class:`DeviceDiagram` whose cells only the host can decide, in device memory: those that are
    unfinished, and those of whose cells rounding may have decided the shape.

    Attributes
    ----------
    count : (1,) pyopencl.array.Array of uint32
        How many they are, also where they do not fit.
    seeds : (room,) pyopencl.array.Array of uint32
        Their indices, ascending; as many as there is room for.
    """

    def __init__(self, queue: Any, count: Any, seeds: Any) -> None:
        self._queue = queue
        self.count = count
        self.seeds = seeds

    def get(self) -> np.ndarray:
        """Waits for the diagram, and copies the indices to the host.

        Raises
        ------
        Error
            ``invalid_argument`` if they exceed the room (how many there are).
        """
        count = int(self.count.get(self._queue)[0])
        if count > len(self.seeds):
            raise Error(
                f"{count} seeds are uncertain, and there is room for {len(self.seeds)}; give compute(uncertain={count})",
                "invalid_argument",
            )
        return self.seeds[:count].get(self._queue) if count else np.empty(0, np.uint32)

    def __repr__(self) -> str:
        return f"<powercell.DeviceUncertain with room for {len(self.seeds)} seeds>"


class DeviceMeasures:
    """The measures of a :class:`DeviceDiagram`, in device memory.

    Attributes
    ----------
    measures : (n, 2 + d) pyopencl.array.Array
        Rows of mass, centroid and second moment. 0, NaN..., 0 where the cell is empty; all NaN for seeds that
        are invalid or unfinished. With a density its integrals.
    status : (n,) pyopencl.array.Array of uint32
        A :class:`DeviceStatus` of each seed.
    adjacency : DeviceAdjacency or None
        If :meth:`DeviceDiagram.compute` was asked for it.
    uncertain : DeviceUncertain or None
        The same.
    cells : DeviceCells or None
        The same.
    boundary_walls : DeviceBoundaryWalls or None
        The same.
    density : pyopencl.array.Array or None
        What was given to :meth:`DeviceDiagram.compute`: measures are its integrals then.
    event : pyopencl.Event
        Of the last command.
    """

    def __init__(
        self,
        queue: Any,
        measures: Any,
        status: Any,
        adjacency: Optional[DeviceAdjacency],
        uncertain: Optional[DeviceUncertain],
        cells: Optional[DeviceCells],
        boundary_walls: Optional[DeviceBoundaryWalls],
        event: Any,
    ) -> None:
        self._queue = queue
        self.measures = measures
        self.status = status
        self.adjacency = adjacency
        self.uncertain = uncertain
        self.cells = cells
        self.boundary_walls = boundary_walls
        self.density: Optional[Any] = None
        self.event = event
        self._parts: dict[str, Any] = {}

    def __len__(self) -> int:
        return int(self.measures.shape[0])

    def _arrays(self) -> list[Any]:
        """All arrays in the order of the bindings; None for those that are not wanted."""
        rows, listed, parts = self.adjacency, self.uncertain, self.boundary_walls
        return [
            self.measures,
            self.status,
            *((rows.indptr, rows.indices, rows.data, rows.shift) if rows else (None,) * 4),
            *((listed.count, listed.seeds) if listed else (None, None)),
            *(self.cells._arrays() if self.cells else [None] * len(DeviceCells._NAMES)),
            *((parts.indptr, parts.indices, parts.data) if parts else (None,) * 3),
        ]

    def _columns(self, name: str, first: int, shape: tuple[int, ...]) -> Any:
        """An array of some columns, copied on the device when first used."""
        if name not in self._parts:
            cl = _looks.package("pyopencl")
            whole = self.measures
            part = empty(self._queue, shape, whole.dtype, whole.allocator)
            if len(self):
                size, row = whole.dtype.itemsize, whole.strides[0]
                width = size * (shape[1] if len(shape) > 1 else 1)
                done = cl.enqueue_copy(
                    self._queue, part.base_data, whole.base_data,
                    src_origin=(first * size, 0, 0), dst_origin=(0, 0, 0), region=(width, len(self), 1),
                    src_pitches=(row, row * len(self)), dst_pitches=(width, width * len(self)),
                )  # fmt: skip
                part.add_event(done)
            self._parts[name] = part
        return self._parts[name]

    @property
    def mass(self) -> Any:
        """(n,): area or volume of each cell, or integral of the density over it."""
        return self._columns("mass", 0, (len(self),))

    @property
    def centroid(self) -> Any:
        """(n, d)"""
        d = self.measures.shape[1] - 2
        return self._columns("centroid", 1, (len(self), d))

    @property
    def second_moment(self) -> Any:
        """(n,): integral of ``|x - p_i|^2`` over each cell."""
        return self._columns("second_moment", self.measures.shape[1] - 1, (len(self),))

    def count(self) -> dict[DeviceStatus, int]:
        """How many seeds have each status. Waits for the diagram and reads the statuses."""
        numbers = np.bincount(self.status.get(self._queue).ravel(), minlength=len(DeviceStatus))
        return {state: int(numbers[state]) for state in DeviceStatus}

    def check(self) -> DeviceMeasures:
        """Waits for the diagram, and makes sure that each seed has its cell.

        Raises
        ------
        Error
            ``invalid_seed`` or ``unsupported`` if seeds are invalid or unfinished (how many, and the first).
        """
        status = self.status.get(self._queue)
        for state, code, reason in (
            (DeviceStatus.INVALID, "invalid_seed", "NaN, infinite or too large"),
            (DeviceStatus.UNFINISHED, "unsupported", "left to the host: give compute(uncertain=True), and repair()"),
        ):
            seeds = np.flatnonzero(status == state)
            if len(seeds):
                raise Error(f"{len(seeds)} of {len(status)} seeds are {reason}; the first is seed {seeds[0]}", code)
        return self

    def __repr__(self) -> str:
        return f"<powercell.DeviceMeasures of {len(self)} seeds>"


def empty(queue: Any, shape: tuple[int, ...], dtype: np.dtype[Any], allocator: Any) -> Any:
    """An array of pyopencl, not filled."""
    return _looks.package("pyopencl.array").empty(queue, shape, dtype, allocator=allocator)
