"""What domains and diagrams are made from, for copies and other processes."""

from __future__ import annotations

from typing import Any


def restore_domain(kind: type, name: str, arguments: tuple[Any, ...], crs: Any, measure: float) -> Any:
    """A domain by the name of what made it and the arguments of that.

    Raises
    ------
    ValueError
        The file that it was read from has another measure now.
    """
    domain = kind._make(name, arguments, crs)  # type: ignore[attr-defined]
    if domain.measure != measure:
        raise ValueError(f"{arguments[0]} has changed since the domain was read from it: read it again")
    return domain


def restore_diagram(kind: type, arguments: dict[str, Any], table: Any, selection: Any) -> Any:
    """A diagram by what it was made of. Its results are computed again when they are asked for."""
    diagram = kind(**arguments)
    diagram._table = table
    if selection is not None:
        diagram.select(selection)
    return diagram


def device_by_name(device: Any) -> Any:
    """The device of a diagram as another process can open it."""
    members = device if isinstance(device, (list, tuple)) else [device]
    if device is None or all(isinstance(member, str) for member in members):
        return device
    raise TypeError(
        "the diagram has a device that cannot be copied; make it with the device's name, as in device='0:0'"
    )
