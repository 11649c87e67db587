"""OpenCL devices."""

from __future__ import annotations

import threading
from typing import Any, Optional, Union
from weakref import WeakValueDictionary

from . import _core


class Device:
    """An OpenCL device of this machine.

    Attributes
    ----------
    name, platform, vendor, driver : str
    kind : str
        ``"cpu"``, ``"gpu"``, ``"accelerator"`` or ``"other"``.
    fp64 : bool
        Whether the device has double precision.
    compute_units : int
    memory : int
        Global memory in bytes.
    queue : pyopencl.CommandQueue or None
        That of :meth:`from_queue`.
    """

    _opened: dict[str, Any] = {}
    _opening = threading.Lock()
    _of_queues: WeakValueDictionary[int, Device] = WeakValueDictionary()

    def __init__(self, info: Any, core: Any = None, queue: Any = None) -> None:
        self._info = info
        self._core = core
        self.queue = queue
        self.name: str = info.name
        self.platform: str = info.platform
        self.vendor: str = info.vendor
        self.driver: str = info.driver
        self.kind: str = info.kind
        self.fp64: bool = info.fp64
        self.compute_units: int = info.compute_units
        self.memory: int = info.memory

    @classmethod
    def choose(cls, selector: str = "") -> Device:
        """The device that ``selector`` names: part of its or its platform's name, ``"cpu"``, ``"gpu"`` or
        ``"P:D"`` (platform and device). Empty: the environment variable ``POWERCELL_DEVICE``, else the best
        GPU, else a CPU.

        Raises
        ------
        Error
            ``device_not_found``; ``self_test_failed`` if it computes known results incorrectly.
        """
        return cls(_open(selector).info)

    @classmethod
    def from_queue(cls, queue: Any) -> Device:
        """The device of a queue of pyopencl, for diagrams on that queue: :class:`DeviceDiagram`, and whatever
        takes a ``device``.

        Parameters
        ----------
        queue : pyopencl.CommandQueue
            In order. The queue and its context live as long as the device and its diagrams.

        Raises
        ------
        Error
            ``invalid_argument`` for an out-of-order queue; ``self_test_failed``.
        """
        pointer = getattr(queue, "int_ptr", None)
        if pointer is None or not hasattr(queue, "flush"):
            raise ValueError(f"queue is a {type(queue).__name__}; a pyopencl.CommandQueue is expected")
        found = cls._of_queues.get(pointer)  # while it lives it holds the queue, so the pointer is not another's
        if found is None:
            core = _core.device_from_queue(pointer)
            found = cls._of_queues[pointer] = cls(core.info, core, queue)
        return found

    def _open(self) -> Any:
        return _open(self._info.selector) if self._core is None else self._core

    def __repr__(self) -> str:
        return f"<powercell.Device {self.name!r}, {self.kind}, {self.compute_units} compute units>"


def devices() -> list[Device]:
    """All OpenCL devices of this machine, in the order of the OpenCL loader.

    >>> import powercell as pc
    >>> all(device.kind in ("cpu", "gpu", "accelerator", "other") for device in pc.devices())
    True
    """
    return [Device(info) for info in _core.devices()]


def _open(selector: str) -> Any:
    _core.require_same_process()
    with Device._opening:
        if selector not in Device._opened:
            Device._opened[selector] = _core.Device.choose(selector)
        return Device._opened[selector]


def open_device(device: Union[None, str, Device]) -> Any:
    """The opened device: each is opened, tested and given its programs once a process."""
    _core.require_same_process()
    if device is None:
        return _open("")
    if isinstance(device, str):
        return _open(device)
    if isinstance(device, Device):
        return device._open()
    raise ValueError(f"device is a {type(device).__name__}; a Device, a str or None is expected")


def optional_device(device: Union[None, str, Device]) -> Optional[Any]:
    return None if device is None else open_device(device)
