"""Power diagrams whose seeds are on several ranks, none of which has all of them."""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import Reals, integers
from ._cell_rows import DistributedCells
from ._device import DeviceLike, open_device
from ._domain import Domain, require_domain
from ._errors import Error
from ._frames import checked_positions, checked_values
from ._names import named_arguments
from ._options import diagram_options
from ._progress import Progress, fraction_bar, progress_function

_MOST_BYTES = 2**28  # in one call of the communicator; MPI counts in 32 bits


def _exchange_by(comm: Any) -> Callable[[list[bytes]], list[bytes]]:
    """The exchange of a message with each rank, in pieces where messages are long."""

    def exchange(messages: list[bytes]) -> list[bytes]:
        longest = max(comm.allgather(max(len(message) for message in messages)))
        piece = max(1, _MOST_BYTES // len(messages))
        if longest <= piece:
            return comm.alltoall(messages)  # type: ignore[no-any-return]
        received: list[list[bytes]] = [[] for _ in messages]
        for begin in range(0, longest, piece):
            parts = comm.alltoall([message[begin : begin + piece] for message in messages])
            for of_rank, part in zip(received, parts):
                of_rank.append(part)
        return [b"".join(parts) for parts in received]

    return exchange


def _together(comm: Any, check: Callable[[], Any]) -> Any:
    """What ``check()`` returns. If it raises on some ranks the others raise too, instead of waiting for them."""
    fault: Optional[Exception] = None
    checked = None
    try:
        checked = check()
    except Exception as error:
        fault = error
    for rank, told in enumerate(comm.allgather(fault and (str(fault), getattr(fault, "code", "invalid_argument")))):
        if fault is not None:
            raise fault
        if told is not None:
            raise Error(f"rank {rank}: {told[0]}", told[1])
    return checked


@named_arguments
def compute_distributed(
    comm: Any,
    domain: Domain,
    ids: ArrayLike,
    positions: ArrayLike,
    weights: Optional[ArrayLike] = None,
    *,
    device: DeviceLike = None,
    redistribute: bool = False,
    precision: str = "auto",
    neighbors: str = "auto",
    threads: int = 0,
    progress: Progress = None,
) -> DistributedCells:
    """Compute the cells of the seeds of all ranks; each gives its own seeds and gets their cells.

    All ranks must call it, those without seeds too, with the same domain and options. Neighbours and statuses are
    those of one :class:`Diagram` of all seeds in ascending order of ids, whatever rank has which; measures and
    walls differ from its by rounding. Seeds of a rank should be near each other, or be redistributed.

    Parameters
    ----------
    comm : mpi4py.MPI.Intracomm
        Or any object with ``Get_rank()``, ``Get_size()``, ``allgather(value)`` and ``alltoall(list of bytes)``.
    domain : Domain
        A polygon, a box or a volume of tetrahedra; a box may be periodic, or a lattice.
    ids : (n,) array_like of int
        Of the seeds, from 0, each once on all ranks.
    positions : (n, d) array_like
    weights : (n,) array_like, optional
        As for :class:`Diagram`.
    device : Device, str or list of these, optional
        Of this rank. With several ranks on the cores of a machine, set `threads` and, for PoCL, the variable
        ``POCL_MAX_PTHREAD_COUNT`` to the cores of each.
    redistribute : bool
        Compute on other ranks, each with a range of a Hilbert curve, and send the results back: for seeds that
        are not near each other on their rank, or few on some ranks and many on others.
    precision : {"auto", "double"}
    neighbors : {"auto", "tree", "flann"}
    threads : int
        On the host; 0 for all.
    progress : bool or callable, optional
        True for a bar, or a function of the fraction of what is clipped at present on this rank, which may
        return False to stop all ranks.

    Returns
    -------
    DistributedCells

    Raises
    ------
    ValueError
        An array of the wrong shape or type, by name, on the rank that has it; or no communicator.
    Error
        On all ranks: ``invalid_argument`` (an id that is there twice; domains or options that differ; a ValueError on
        another rank), ``invalid_seed`` (names the seed by its id), ``unsupported`` (surfaces, solids, single
        precision) and others. What one rank alone knows begins with its number.

    Examples
    --------
    ``mpiexec -n 4 python program.py``:

    >>> from mpi4py import MPI  # doctest: +SKIP
    >>> cells = pc.compute_distributed(MPI.COMM_WORLD, box, ids, positions, weights)  # doctest: +SKIP
    >>> cells.mass, cells.neighbors(0)  # doctest: +SKIP
    """
    missing = [name for name in ("Get_rank", "Get_size", "allgather", "alltoall") if not hasattr(comm, name)]
    if missing:
        raise ValueError(f"comm is a {type(comm).__name__} without {', '.join(missing)}; pass a communicator of mpi4py")
    if hasattr(comm, "Is_inter") and comm.Is_inter():
        raise ValueError("comm is an intercommunicator; an intracommunicator is expected")

    def check() -> tuple[NDArray[np.uint64], Reals, Optional[Reals], Any]:
        require_domain(domain)
        progress_function(progress)  # refuses what is none
        points = checked_positions(domain, positions)
        named = integers(ids, "ids", (len(points),), np.uint64, ", one for each seed")
        heavy = checked_values(weights, positions, len(points), "weights")
        return named, points, heavy, open_device(device)

    named, points, heavy, opened = _together(comm, check)
    options = diagram_options(precision, neighbors, threads=threads)
    with fraction_bar(progress, "power diagram") as report:
        core = _core.compute_distributed(
            comm.Get_rank(), comm.Get_size(), _exchange_by(comm), opened, domain._core, named, points, heavy,
            options, bool(redistribute), report,
        )
    return DistributedCells(core, domain.is_periodic)
