"""The log of the library."""

from __future__ import annotations

from typing import Any, Callable, Optional

from . import _core


def set_log(sink: Optional[Callable[[str, str], Any]], level: str = "info") -> None:
    """Sends lines about the work in progress of the whole process to a function.

    Parameters
    ----------
    sink : callable or None
        A function of the level and the line, called from the computing threads, one call at a time. What it raises
        goes to ``sys.unraisablehook``. It must not call the library. None removes it: lines then go to standard
        error if the environment variable ``POWERCELL_LOG`` is ``info`` or ``detail``, else nowhere.
    level : {"info", "detail"}
        Devices, compiled kernels, each computation with its times; or also each chunk, and kernels from the cache.

    Examples
    --------
    >>> import powercell as pc
    >>> lines = []
    >>> pc.set_log(lambda level, line: lines.append(line))
    >>> mass = pc.Diagram(pc.Domain.box([0, 0], [1, 1]), [[0.5, 0.5]]).mass
    >>> pc.set_log(None)
    >>> any("1 seed" in line for line in lines)
    True
    """
    if sink is not None and not callable(sink):
        raise ValueError(f"sink is a {type(sink).__name__}; a function or None is expected")
    _core.set_log(sink, level)
