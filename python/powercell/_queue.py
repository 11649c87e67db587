"""Diagrams from device memory to device memory, on a queue of pyopencl."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _core, _looks
from ._arrays import is_pyopencl
from ._device import Device
from ._device_cells import DeviceCells, room_for
from ._device_results import DeviceAdjacency, DeviceBoundaryWalls, DeviceMeasures, DeviceUncertain, empty
from ._domain import Domain, require_domain
from ._names import named_arguments
from ._options import diagram_options

PRECISIONS = {"float64": "double", "float32": "float"}


class DeviceDiagram:
    """Power diagrams from device memory to device memory, on a queue of the caller.

    Seeds, measures and statuses are arrays of pyopencl on the queue's device, and nothing is copied to the host.
    :meth:`compute` has the device do all the work: cells with more than some 128 faces in one region of the domain are
    reported as :attr:`DeviceStatus.UNFINISHED`, with NaN for measures, and ties are decided by rounding.
    :meth:`repair` computes those cells exactly.

    Parameters
    ----------
    domain : Domain
        No solid.
    queue : pyopencl.CommandQueue or Device
        An in-order queue, or the device that :meth:`Device.from_queue` made of one.
    pair_capacity : int
        For domains of several regions, the room for pairs of a seed and a region; seeds beyond it are
        unfinished. With 0 there is room for all, and :meth:`compute` waits for the queue once to read their
        number.
    image_capacity : int
        For periodic domains, the room for images of seeds behind the borders; if there are more, cells are
        unfinished. Even seeds have 0.5 each if they are 10^5 in a cube, 0.2 if 10^6. With 0 there is room for
        all, and :meth:`compute` waits for the queue once to read their number. It waits in no other case.
    wall_capacity : int
        The room for walls and boundary walls while rows are made of them. Cells whose walls do not fit are
        unfinished; which these are may change from call to call. With 0 there is room for more walls than random
        seeds have.
    chunk_pairs : int
        The most pairs of one kernel launch; 0 lets the library choose.

    Raises
    ------
    Error
        ``unsupported`` for a solid, ``invalid_argument`` for an out-of-order queue.
    ValueError
        ``queue`` is something else.
    """

    @named_arguments
    def __init__(
        self,
        domain: Domain,
        queue: Union[Device, Any],
        *,
        pair_capacity: int = 0,
        image_capacity: int = 0,
        wall_capacity: int = 0,
        chunk_pairs: int = 0,
    ) -> None:
        require_domain(domain)
        self.device = queue if isinstance(queue, Device) else Device.from_queue(queue)
        if self.device.queue is None:
            raise ValueError("queue is a Device without a queue of pyopencl; make it with Device.from_queue")
        if not 0 <= pair_capacity < 2**32:
            raise ValueError(f"pair_capacity is {pair_capacity}; 0 (room for all) to 2^32 - 1 are expected")
        if not 0 <= image_capacity < 2**32:
            raise ValueError(f"image_capacity is {image_capacity}; 0 (room for all) to 2^32 - 1 are expected")
        if not 0 <= wall_capacity <= 2**31:
            raise ValueError(f"wall_capacity is {wall_capacity}; 0 (enough for most) to 2^31 are expected")
        self.domain = domain
        self._pair_capacity = pair_capacity
        self._image_capacity = image_capacity
        self._wall_capacity = wall_capacity
        self._chunk_pairs = chunk_pairs
        self._cores: dict[str, Any] = {}
        self._core(PRECISIONS["float64" if self.device.fp64 else "float32"])

    def _core(self, precision: str) -> Any:
        """The diagram in the precision of the arrays; the programs of each are built when first used."""
        if precision not in self._cores:
            options = diagram_options(precision, chunk_pairs=self._chunk_pairs)
            core = _core.DeviceDiagram(self.device._open(), self.domain._core, options)
            core.set_pair_capacity(self._pair_capacity)
            core.set_image_capacity(self._image_capacity)
            core.set_wall_capacity(self._wall_capacity)
            self._cores[precision] = core
        return self._cores[precision]

    @named_arguments
    def compute(
        self,
        positions: Any,
        weights: Optional[Any] = None,
        *,
        adjacency: Union[bool, int] = False,
        uncertain: Union[bool, int] = False,
        cells: Union[bool, Sequence[int], np.ndarray] = False,
        boundary_walls: Union[bool, int] = False,
        density: Optional[Any] = None,
        out: Optional[DeviceMeasures] = None,
    ) -> DeviceMeasures:
        """Enqueues the diagram of n seeds, and returns without waiting for it.

        Parameters
        ----------
        positions : (n, d) pyopencl.array.Array of float64 or float32
            Its type is also the precision of the computation. Commands of other queues that write it are waited
            for if the array knows their events, as arrays of pyopencl do.
        weights : (n,) pyopencl.array.Array, optional
            Of the same type. Default: 0.
        adjacency : bool or int
            Whether walls are wanted too, or the number of entries to make room for: two for each wall. True makes
            room for 8 a seed in the plane and on surfaces, 20 in space.
        uncertain : bool or int
            Whether the seeds that :meth:`repair` would compute are listed, or the number to make room for. True makes
            room for all seeds.
        cells : bool, or four int
            Whether the geometry of the cells is wanted, for which all are clipped twice more, or the numbers of
            pieces, vertices, faces and entries of loops to make room for, as :attr:`DeviceCells.counts` has them. True
            makes room for random seeds: of :attr:`DeviceCells.counts` of a smaller diagram one learns how much others
            need. The first call with cells builds programs, which waits.
        boundary_walls : bool or int
            Whether the parts of the domain's boundary that each cell has are wanted, or the number of entries to make
            room for. True makes room for three for each seed and each facet of the boundary.
        density : (nv,) pyopencl.array.Array, optional
            Of the type of ``positions``, a value for each vertex of a surface or volume, linear in each triangle or
            tetrahedron, as :class:`TransportSolver` takes it. Measures are then the integrals of the density over the cells,
            the centroid NaN where the mass is 0; statuses, walls and geometry stay those of the cells alone. A cell
            with a part in a region at a corner of which the value is negative, not finite or above 10^100 (float32:
            10^30) has NaN for all its measures. The first call with a density builds programs, which waits.
        out : DeviceMeasures, optional
            Of an earlier call with as many seeds of this type: its arrays are written again, those of the adjacency,
            the list, the cells and the boundary walls where it has them and they are wanted. Otherwise new ones come from the allocator of
            ``positions``.

        Returns
        -------
        DeviceMeasures
            On the queue of the diagram; later commands of that queue see the results.

        Raises
        ------
        ValueError
            An array of the wrong shape, type or layout, by name.
        Error
            ``invalid_argument`` for an array in another context, ``unsupported`` for a density in a domain without
            triangles or tetrahedra, ``no_fp64``, ``out_of_device_memory``, ``opencl``.
        """
        cl, queue = _looks.package("pyopencl"), self.device.queue
        core, n, used, pointers = self._seeds(positions, weights)
        used += self._density(density, positions)
        results = DeviceMeasures(
            queue,
            *self._measures(n, positions, out),
            self._rows(adjacency, n, positions, out),
            self._list(uncertain, n, positions, out),
            self._cells(cells, n, positions, out),
            self._boundary(boundary_walls, n, positions, out),
            None,
        )
        results.density = density
        values = 0 if density is None else _pointer(used[-1])
        written = results._arrays()
        arrays = [array for array in written if array is not None]
        events = [event.int_ptr for array in [*used, *arrays] for event in array.events]
        results.event = cl.Event.from_int_ptr(core.enqueue(*pointers, _pointers(written), values, events), retain=False)
        for array in arrays:
            array.add_event(results.event)
        return results

    def repair(self, positions: Any, weights: Optional[Any] = None, *, out: DeviceMeasures) -> int:
        """Computes the cells of the list ``out.uncertain`` exactly, and puts them into the results, which are then those
        of a :class:`Diagram` without the invalid seeds: the statuses and, where they are given, the adjacency, the
        boundary walls and the pieces and faces of cells are exact.
        Waits for the queue, and works on the host, with the Global Interpreter Lock released.

        Parameters
        ----------
        positions, weights : pyopencl.array.Array
            As given to :meth:`compute`.
        out : DeviceMeasures
            What that call returned, with ``uncertain``, and whose density is used.

        Returns
        -------
        int
            How many cells were computed.

        Raises
        ------
        ValueError
            An array of the wrong shape, type or layout, by name; results without a list.
        Error
            ``invalid_argument`` if the list has no room for all uncertain seeds, rows for their entries, or the cells for
            their pieces (how many there are): nothing is changed then. ``out_of_device_memory``, ``opencl``.
        """
        if out.uncertain is None:
            raise ValueError("out has no list of uncertain seeds; give compute(uncertain=True)")
        core, n, used, pointers = self._seeds(positions, weights)
        self._measures(n, positions, out)
        used += self._density(out.density, positions)
        values = 0 if out.density is None else _pointer(used[-1])
        arrays = [array for array in out._arrays() if array is not None]
        for array in [*used, *arrays]:
            array.finish()
        count = int(core.repair(*pointers, _pointers(out._arrays()), values))
        out._parts.clear()
        return count

    def _seeds(self, positions: Any, weights: Optional[Any]) -> tuple[Any, int, list[Any], tuple[int, int, int]]:
        """The diagram in the precision of the seeds, their number, their arrays, and positions, weights and number for
        the bindings."""
        _check(positions, "positions", (None, self.domain.dimension), None)
        n = int(positions.shape[0])
        if weights is not None:
            _check(weights, "weights", (n,), positions.dtype)
        core = self._core(PRECISIONS[positions.dtype.name])
        used = [whole(array, self.device.queue) for array in (positions, weights) if array is not None]
        return core, n, used, (_pointer(used[0]), _pointer(used[1]) if weights is not None else 0, n)

    def _density(self, density: Optional[Any], positions: Any) -> list[Any]:
        """The array of the density, if there is one."""
        if density is None:
            return []
        _check(density, "density", (None,), positions.dtype)
        mesh = self.domain.regions
        if self.domain.kind != "polygon" and mesh.shape != "box" and len(density) != len(mesh.vertices):
            raise ValueError(f"density has {len(density)} values; {len(mesh.vertices)} are expected, one for each vertex")
        return [whole(density, self.device.queue)]

    def _measures(self, n: int, positions: Any, out: Optional[DeviceMeasures]) -> tuple[Any, Any]:
        """The memory of measures and statuses."""
        queue, allocator, columns = self.device.queue, positions.allocator, 2 + self.domain.dimension
        if out is None:
            return (
                empty(queue, (n, columns), positions.dtype, allocator),
                empty(queue, (n,), np.dtype(np.uint32), allocator),
            )
        _check(out.measures, "out.measures", (n, columns), positions.dtype)
        return out.measures, out.status

    def _list(
        self, uncertain: Union[bool, int], n: int, positions: Any, out: Optional[DeviceMeasures]
    ) -> Optional[DeviceUncertain]:
        """The memory of the list of uncertain seeds, if it is wanted."""
        if uncertain is False:
            return None
        if uncertain is not True and not (isinstance(uncertain, int) and 0 < uncertain < 2**32):
            raise ValueError(f"uncertain is {uncertain!r}; True, False or a number of seeds from 1 to 2^32 - 1 is expected")
        room = max(1, n) if uncertain is True else uncertain
        if out is not None and out.uncertain is not None and room <= len(out.uncertain.seeds):
            return out.uncertain
        queue, allocator, unsigned = self.device.queue, positions.allocator, np.dtype(np.uint32)
        return DeviceUncertain(
            queue, empty(queue, (1,), unsigned, allocator), empty(queue, (room,), unsigned, allocator)
        )

    def _cells(self, cells: Any, n: int, positions: Any, out: Optional[DeviceMeasures]) -> Optional[DeviceCells]:
        """The memory of the geometry, if it is wanted."""
        room = room_for(cells, self.domain, n)
        if room is None:
            return None
        if out is not None and out.cells is not None:
            if len(out.cells.cell_offset) != n + 1:
                raise ValueError(f"out.cells is of {len(out.cells.cell_offset) - 1} seeds; {n} are expected")
            _check(out.cells.vertices, "out.cells.vertices", (None, self.domain.dimension), positions.dtype)
            if cells is True or all(wanted <= there for wanted, there in zip(room, out.cells.room)):
                return out.cells
        queue, allocator = self.device.queue, positions.allocator
        return DeviceCells(
            queue, self.domain, n, room, lambda shape, dtype: empty(queue, shape, dtype, allocator), positions.dtype
        )

    def _rows(
        self, adjacency: Union[bool, int], n: int, positions: Any, out: Optional[DeviceMeasures]
    ) -> Optional[DeviceAdjacency]:
        """The memory of the adjacency, if it is wanted."""
        there: Optional[DeviceAdjacency] = _rows_there("adjacency", adjacency, n, positions, out)
        if adjacency is False or there is not None:
            return there
        each = 20 if self.domain.cell_dimension == 3 else 8
        room = max(1, each * n) if adjacency is True else adjacency
        queue, allocator = self.device.queue, positions.allocator
        return DeviceAdjacency(
            queue,
            *_new_rows(queue, n, room, positions),
            empty(queue, (room, 3), np.dtype(np.int32), allocator) if self.domain.is_periodic else None,
        )

    def _boundary(
        self, wanted: Union[bool, int], n: int, positions: Any, out: Optional[DeviceMeasures]
    ) -> Optional[DeviceBoundaryWalls]:
        """The memory of the boundary walls, if they are wanted."""
        there: Optional[DeviceBoundaryWalls] = _rows_there("boundary_walls", wanted, n, positions, out)
        if wanted is False or there is not None:
            return there
        room = 3 * (n + int(self.domain.regions.boundary_count)) if wanted is True else wanted
        return DeviceBoundaryWalls(self.device.queue, *_new_rows(self.device.queue, n, max(1, room), positions))

    def __repr__(self) -> str:
        return f"<powercell.DeviceDiagram in {self.domain!r} on {self.device.name!r}>"


def _rows_there(name: str, wanted: Union[bool, int], n: int, positions: Any, out: Optional[DeviceMeasures]) -> Any:
    """The rows of that name of earlier results, if they are wanted again and there is room."""
    if wanted is False:
        return None
    if wanted is not True and not (isinstance(wanted, int) and 0 < wanted < 2**32):
        raise ValueError(f"{name} is {wanted!r}; True, False or a number of entries from 1 to 2^32 - 1 is expected")
    rows = None if out is None else getattr(out, name)
    if rows is None:
        return None
    _check(rows.data, f"out.{name}.data", (None,), positions.dtype)
    if len(rows.indptr) != n + 1:
        raise ValueError(f"out.{name} is of {len(rows.indptr) - 1} seeds; {n} are expected")
    return rows if wanted is True or wanted <= len(rows.indices) else None


def _new_rows(queue: Any, n: int, room: int, positions: Any) -> tuple[Any, Any, Any]:
    """Offsets of n rows, and indices and reals of `room` entries."""
    unsigned, allocator = np.dtype(np.uint32), positions.allocator
    return (
        empty(queue, (n + 1,), unsigned, allocator),
        empty(queue, (room,), unsigned, allocator),
        empty(queue, (room,), positions.dtype, allocator),
    )


def _check(array: Any, name: str, shape: tuple[Optional[int], ...], dtype: Optional[np.dtype[Any]]) -> None:
    if not is_pyopencl(array):
        raise ValueError(
            f"{name} is a {type(array).__name__}; an array of pyopencl is expected (Diagram takes those of NumPy)"
        )
    letters = ", ".join("n" if size is None else str(size) for size in shape) + ("," if len(shape) == 1 else "")
    if len(array.shape) != len(shape) or any(w is not None and w != s for s, w in zip(array.shape, shape)):
        raise ValueError(f"{name} has the shape {array.shape}; ({letters}) is expected")
    if dtype is not None and array.dtype != dtype:
        raise ValueError(f"{name} has the type {array.dtype}; {dtype} is expected, as positions have")
    if array.dtype.name not in PRECISIONS or not array.dtype.isnative:
        raise ValueError(f"{name} has the type {array.dtype}; float64 or float32 is expected")
    if not array.flags.c_contiguous:
        raise ValueError(f"{name} is not C-contiguous; its rows must follow each other in memory")


def whole(array: Any, queue: Any) -> Any:
    """The array at the beginning of its buffer; one that is not is copied on the device."""
    return array.copy(queue) if array.size and array.offset else array


def _pointer(array: Any) -> int:
    if array.size == 0:
        return 0
    pointer = getattr(array.base_data, "int_ptr", None)
    if pointer is None:
        raise ValueError("an array is in shared virtual memory; buffers are expected")
    return int(pointer)


def _pointers(arrays: list[Any]) -> list[int]:
    return [0 if array is None else _pointer(array) for array in arrays]
