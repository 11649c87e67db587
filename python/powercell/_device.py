"""OpenCL devices."""

from __future__ import annotations

import os
import threading
from collections.abc import Sequence
from typing import Any, NamedTuple, Optional, Union
from weakref import WeakValueDictionary

from . import _core


class Device:
    """An OpenCL device of this machine, or a group of several, of which the attributes are those of the first.

    Attributes
    ----------
    name, platform, vendor, driver, opencl_c_version : str
    selector : str
        ``"P:D"``, as :meth:`choose` takes it.
    kind : str
        ``"cpu"``, ``"gpu"``, ``"accelerator"`` or ``"other"``.
    fp64 : bool
        Whether the device has double precision.
    compute_units : int
    clock_mhz : int
    memory, largest_allocation : int
        Bytes of global memory, and of its largest single buffer.
    max_work_group_size : int
    unified_memory : bool
        Whether its memory is the host's.
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
        self.opencl_c_version: str = info.opencl_c_version
        self.selector: str = info.selector
        self.kind: str = info.kind
        self.fp64: bool = info.fp64
        self.compute_units: int = info.compute_units
        self.clock_mhz: int = info.clock_mhz
        self.memory: int = info.memory
        self.largest_allocation: int = info.largest_allocation
        self.max_work_group_size: int = info.max_work_group_size
        self.unified_memory: bool = info.unified_memory

    @classmethod
    def choose(cls, selector: str = "") -> Device:
        """The device that ``selector`` names: part of its or its platform's name, ``"cpu"``, ``"gpu"`` or
        ``"P:D"`` (platform and device). Empty: the environment variable ``POWERCELL_DEVICE``, else the best
        GPU, else a CPU. Several of these with commas between name a :meth:`group`, and ``"all"`` that of all
        devices, the best first.

        Raises
        ------
        Error
            ``device_not_found``; ``self_test_failed`` if it computes known results incorrectly;
            ``invalid_argument`` if a device is named twice.
        """
        return cls._of(_open(selector))

    @classmethod
    def group(cls, devices: Sequence[Union[str, Device]]) -> Device:
        """Several devices as one. Diagrams share the clipping of their cells out to all of them by their speeds,
        and do what is not shared on the first. Whatever takes a ``device`` takes a list of them too.

        Parameters
        ----------
        devices : sequence of Device or str
            Each once.

        Raises
        ------
        Error
            ``invalid_argument`` for no device, or one that is there twice.

        >>> import powercell as pc
        >>> len(pc.Device.group(pc.devices()[:1]).members)
        1
        """
        return cls._of(open_device(list(devices)))

    @classmethod
    def _of(cls, core: Any) -> Device:
        # A single device is opened by its name, once a process; a group has no name.
        return cls(core.info, core if len(core.members) > 1 else None)

    @property
    def members(self) -> list[Device]:
        """The devices of a group, in their order; of a single device itself."""
        members = [] if self._core is None else self._core.members
        return [self] if len(members) < 2 else [Device(core.info, core) for core in members]

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

    @property
    def build_seconds(self) -> float:
        """Seconds spent on compiling kernels since the device was opened; 0 if all came from the cache."""
        return float(self._open().build_seconds)

    def _open(self) -> Any:
        return _open(self._info.selector) if self._core is None else self._core

    def __repr__(self) -> str:
        members = self.members
        if len(members) > 1:
            return f"<powercell.Device, a group of {members!r}>"
        return f"<powercell.Device {self.name!r}, {self.kind}, {self.compute_units} compute units>"


def devices() -> list[Device]:
    """All OpenCL devices of this machine, in the order of the OpenCL loader.

    >>> import powercell as pc
    >>> all(device.kind in ("cpu", "gpu", "accelerator", "other") for device in pc.devices())
    True
    """
    return [Device(info) for info in _core.devices()]


class UnusableDevice(NamedTuple):
    """A device that OpenCL lists and that cannot be used, or a platform that cannot list its devices."""

    platform: int
    device: int  #: Index within the platform; -1 for the whole platform.
    name: str  #: Of the device or platform.
    reason: str


def unusable_devices() -> list[UnusableDevice]:
    """What :func:`devices` leaves out, with the reason.

    >>> import powercell as pc
    >>> all(unusable.reason for unusable in pc.unusable_devices())
    True
    """
    return [UnusableDevice(*row) for row in _core.unusable_devices()]


def _open(selector: str) -> Any:
    with Device._opening:
        if selector not in Device._opened:
            Device._opened[selector] = _core.Device.choose(selector)
        return Device._opened[selector]


if hasattr(os, "register_at_fork"):  # OpenCL does not survive a fork, and what was opened refuses all calls
    os.register_at_fork(after_in_child=Device._opened.clear)


#: What names a device: of a group a list.
DeviceLike = Union[None, str, Device, "Sequence[Union[str, Device]]"]


def open_device(device: DeviceLike) -> Any:
    """The opened device: each is opened, tested and given its programs once a process."""
    if device is None:
        return _open("")
    if isinstance(device, str):
        return _open(device)
    if isinstance(device, Device):
        return device._open()
    if isinstance(device, (list, tuple)):
        if any(member is None for member in device):
            raise ValueError("a device of the list is None; a Device or a str is expected")
        return _core.Device.group([open_device(member) for member in device])
    raise ValueError(f"device is a {type(device).__name__}; a Device, a str, a list of these or None is expected")


def optional_device(device: DeviceLike) -> Optional[Any]:
    return None if device is None else open_device(device)


class KernelBuilds(NamedTuple):
    """Compilation of kernels in this process, on all devices and in all threads."""

    running: bool
    """Whether a kernel is being compiled now."""
    seconds: float
    """Wall-clock time spent so far."""
    processor_seconds: float
    """Of this process meanwhile."""


def kernel_builds() -> KernelBuilds:
    """The compilation of kernels so far.

    >>> import powercell as pc
    >>> pc.kernel_builds().running
    False
    """
    return KernelBuilds(*_core.kernel_builds())


class DeviceRates(NamedTuple):
    """Rates of two small kernels, each the best of several launches. The scatter of a figure, here and below: by how
    much longer than the best run their lower quartile took, relative to the best."""

    copied_bytes: float
    """Bytes read plus bytes written per second while a large buffer is copied."""
    operations: float
    """Multiplications plus additions per second; a fused one counts as two."""
    copied_scatter: float
    operations_scatter: float


def measure_device_rates(device: Union[None, str, Device] = None, precision: str = "auto") -> DeviceRates:
    """The best rates that a device reaches. Takes about a second and up to 512 MiB of its memory.

    Parameters
    ----------
    device : Device or str, optional
        As for :meth:`Device.choose`.
    precision : {"auto", "double", "float"}

    Raises
    ------
    Error
        ``no_fp64``, ``self_test_failed`` (a wrong result), ``out_of_device_memory``.
    """
    return DeviceRates(*_core.measure_device_rates(open_device(device), precision))


class DeviceLatencies(NamedTuple):
    """Seconds on the host from a call to its end, each the least of many: what work costs however small it is."""

    launch: float
    """Enqueuing a kernel of one work-item and waiting for it."""
    transfer: float
    """Reading one number from device memory."""
    launch_scatter: float
    transfer_scatter: float


def measure_device_latencies(device: Union[None, str, Device] = None) -> DeviceLatencies:
    """What a launch and a transfer cost, in a few milliseconds.

    Parameters
    ----------
    device : Device or str, optional
        As for :meth:`Device.choose`.

    Raises
    ------
    Error
        ``self_test_failed`` (a wrong result).
    """
    return DeviceLatencies(*_core.measure_device_latencies(open_device(device)))


class DeviceTransfers(NamedTuple):
    """Bytes a second from one memory to the other, measured on the host from the call to its end, each the best of
    several."""

    to_device: float
    """From ordinary host memory."""
    to_host: float
    to_device_scatter: float
    to_host_scatter: float


def measure_device_transfers(device: Union[None, str, Device] = None, bytes: int = 1 << 20) -> DeviceTransfers:
    """How fast bytes go to a device and back. Takes a fifth of a second, or longer for many.

    Parameters
    ----------
    device : Device or str, optional
        As for :meth:`Device.choose`.
    bytes : int
        In one transfer.

    Raises
    ------
    Error
        ``self_test_failed`` (other bytes came back), ``out_of_device_memory``, ``invalid_argument``.
    """
    return DeviceTransfers(*_core.measure_device_transfers(open_device(device), bytes))
