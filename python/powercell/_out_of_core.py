"""Power diagrams of more seeds than memory holds."""

from __future__ import annotations

import os
from typing import Any, Callable, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import Reals, check_shape, is_pyopencl, reals
from ._cell_rows import CellRows
from ._core import OutOfCoreReport
from ._device import DeviceLike, open_device
from ._domain import Domain, require_domain
from ._errors import Error
from ._names import named_arguments
from ._options import diagram_options
from ._progress import Progress, fraction_bar


def _stamp(array: Any) -> Optional[str]:
    """Tells an array in a file that is mapped for reading from other arrays, and from itself after a change of the file;
    None for what is no such array."""
    if not isinstance(array, np.memmap) or array.filename is None or array.mode != "r":
        return None
    try:
        status = os.stat(array.filename)
    except OSError:  # the file was removed, and lives as long as the array
        return None
    whole: Any = array
    while isinstance(whole.base, np.ndarray):
        whole = whole.base
    begin = getattr(whole, "offset", 0) + array.__array_interface__["data"][0] - whole.__array_interface__["data"][0]
    return (
        f"{os.path.realpath(array.filename)}, {status.st_size} bytes, changed at {status.st_mtime_ns}: "
        f"{array.dtype.str} {array.shape} {array.strides} at {begin}"
    )


class _Rows:
    """An array of which some rows are read at a time."""

    def __init__(self, value: Any, name: str, shape: Sequence[Optional[int]], why: str) -> None:
        self._name, self._columns = name, tuple(shape[1:])
        sliced = hasattr(value, "shape") and hasattr(value, "__getitem__") and not is_pyopencl(value)
        if not sliced or 0 in value.shape:
            value = reals(value, name, shape, why)
        check_shape(tuple(value.shape), name, shape, why)
        self._value = value
        self.stamp = _stamp(value)
        self.read(0, 0)  # refuses what are no numbers

    def __len__(self) -> int:
        return int(self._value.shape[0])

    def read(self, first: int, count: int) -> Reals:
        block = reals(self._value[first : first + count], self._name, (count, *self._columns))
        if self.stamp is not None and _stamp(self._value) != self.stamp:
            raise Error(f"{self._name}: {self._value.filename} was changed while it was read; run it again", "invalid_file")
        return block


def _name_of(name: Optional[str], seeds: Sequence[_Rows]) -> str:
    """What tells these seeds from others in a run that goes on."""
    if name is not None:
        if not isinstance(name, str) or not name:
            raise ValueError(f"name is {name!r}; a text is expected that tells these seeds from others")
        return name
    stamps = [rows.stamp for rows in seeds]
    if None in stamps:
        raise ValueError(
            "name is missing: a run that goes on after a stop must know that its seeds are the same, which only arrays that "
            'numpy.load(..., mmap_mode="r") maps tell by themselves; pass another name whenever the seeds differ'
        )
    return "; ".join(str(stamp) for stamp in stamps)


@named_arguments
def compute_out_of_core(
    domain: Domain,
    positions: ArrayLike,
    weights: Optional[ArrayLike] = None,
    *,
    take: Callable[[CellRows], Any],
    folder: Union[str, os.PathLike[str]],
    memory: int = 2**32,
    walls: bool = False,
    name: Optional[str] = None,
    piece_seeds: int = 0,
    device: DeviceLike = None,
    precision: str = "auto",
    neighbors: str = "auto",
    threads: int = 0,
    progress: Progress = None,
) -> OutOfCoreReport:
    """Compute the cells of more seeds than memory holds, piece after piece in files, and give them to a function.

    Statuses and neighbours are those of one :class:`Diagram` of all seeds; measures and walls differ from its by
    rounding. A call that was stopped, by a signal, an exception, ``progress`` or a kill, goes on with the pieces that it
    has finished when it is repeated, and gives the same bits as if it had not been stopped.

    Parameters
    ----------
    domain : Domain
        A polygon, a box or a volume of tetrahedra; a box may be periodic, or a lattice.
    positions : (n, d) array_like
        What has a shape and can be sliced by rows is read twice, some rows at a time, and never as a whole: arrays of
        ``numpy.load(path, mmap_mode="r")``, data sets of h5py or zarr. Numbers of any type become doubles.
    weights : (n,) array_like, optional
        Likewise.
    take : callable
        Gets a :class:`CellRows`, the cells of some consecutive seeds; called in ascending order of seeds, after all pieces
        are computed. It may keep them. With no seeds it is not called.
    folder : str or path
        A folder that is made for what is finished so far and removed at the end; it needs some 100 bytes for each seed,
        and 12 more for each side of a wall. One that is there already is gone on with if it has pieces of the same
        computation, and else refused.
    memory : int
        Bytes that the call may take beside what the process takes before. The pieces follow from it.
    walls : bool
        Give neighbours and walls too, not only their numbers.
    name : str, optional
        Tells these seeds from others, for a run that goes on. Needed unless positions, and weights where there are any, are
        files that NumPy maps for reading, which are told by their paths, sizes and times of change.
    piece_seeds : int
        Most seeds of a piece, as far as memory allows; 0 for 2**22.
    device : Device, str or list of these, optional
    precision : {"auto", "double"}
    neighbors : {"auto", "tree", "flann"}
    threads : int
        On the host; 0 for all.
    progress : bool or callable, optional
        True for a bar, or a function of the fraction done, which may return False to stop.

    Returns
    -------
    OutOfCoreReport

    Raises
    ------
    ValueError
        An argument of the wrong shape or type, by its name.
    Error
        ``invalid_argument`` (too little memory, with the least that is enough; a folder of another computation, with what
        differs), ``invalid_seed`` (the first one, by its index), ``invalid_file`` (a file that is changed while it is
        read), ``write_failed`` (disk full and the like), ``unsupported`` (surfaces, solids, single precision),
        ``interrupted`` and others. What a function raises comes out as it is.

    Examples
    --------
    >>> import os, tempfile, numpy as np, powercell as pc
    >>> folder = tempfile.TemporaryDirectory()
    >>> path = os.path.join(folder.name, "seeds.npy")
    >>> np.save(path, np.random.default_rng(1).random((1000, 3), dtype=np.float32))
    >>> volumes = np.lib.format.open_memmap(os.path.join(folder.name, "volumes.npy"), "w+", shape=(1000,))
    >>> def take(rows):
    ...     volumes[rows.first:rows.first + len(rows)] = rows.mass
    >>> seeds, cube = np.load(path, mmap_mode="r"), pc.Domain.box([0, 0, 0], [1, 1, 1])
    >>> report = pc.compute_out_of_core(cube, seeds, take=take, folder=os.path.join(folder.name, "parts"))
    >>> report.cells, bool(abs(volumes.sum() - 1) < 1e-12)
    (1000, True)
    >>> del seeds, volumes
    >>> folder.cleanup()
    """
    require_domain(domain)
    if not callable(take):
        raise ValueError(f"take is a {type(take).__name__}; a function of powercell.CellRows is expected")
    d, periodic = domain.dimension, domain.is_periodic
    points = _Rows(positions, "positions", (None, d), f", since the domain is {'in the plane' if d == 2 else 'in space'}")
    heavy = None if weights is None else _Rows(weights, "weights", (len(points),), ", one for each seed")
    named = _name_of(name, [points] if heavy is None else [points, heavy])

    def read(first: int, count: int) -> tuple[Reals, Optional[Reals]]:
        return points.read(first, count), None if heavy is None else heavy.read(first, count)

    given = {"folder": os.fsdecode(folder), "memory": memory, "walls": bool(walls), "piece_seeds": piece_seeds}
    options = diagram_options(precision, neighbors, threads=threads)
    opened = open_device(device)
    with fraction_bar(progress, "power diagram") as report:
        return _core.compute_out_of_core(
            opened, domain._core, len(points), named, read, lambda core: take(CellRows(core, bool(walls), periodic)),
            given, options, report,
        )
