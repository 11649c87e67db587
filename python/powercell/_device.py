"""OpenCL devices."""

from __future__ import annotations

from typing import Any, Optional, Union

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
    """

    _opened: dict[str, Any] = {}

    def __init__(self, info: Any) -> None:
        self._info = info
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
        return _open(device._info.selector)
    raise ValueError(f"device is a {type(device).__name__}; a Device, a str or None is expected")


def optional_device(device: Union[None, str, Device]) -> Optional[Any]:
    return None if device is None else open_device(device)
