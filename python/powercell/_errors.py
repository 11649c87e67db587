"""The exception of the library."""

from __future__ import annotations


class Error(RuntimeError):
    """A failure of the library. ``code`` is its kind, e.g. ``"invalid_seed"``; the message says the place."""

    code: str

    def __init__(self, message: str, code: str = "internal") -> None:
        super().__init__(message)
        self.code = code

    def __reduce__(self) -> tuple[type[Error], tuple[str, str]]:
        return type(self), (str(self), self.code)
