"""What ``progress=`` may be: None, True for a bar, or a function."""

from __future__ import annotations

import warnings
from contextlib import contextmanager
from typing import Any, Callable, Iterator, Optional, Union

Progress = Union[None, bool, Callable[[Any], Optional[bool]]]


def progress_function(progress: Progress) -> Optional[Callable[[Any], Optional[bool]]]:
    """The caller's function, if one was given."""
    if callable(progress):
        return progress
    if progress is None or isinstance(progress, bool):
        return None
    raise ValueError(f"progress is a {type(progress).__name__}; True, False, None or a function is expected")


def _bar(text: str, total: Optional[float]) -> Any:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        warnings.warn("progress=True shows a bar where tqdm is installed: pip install tqdm", stacklevel=4)
        return None
    form = "{l_bar}{bar}| [{elapsed}<{remaining}]" if total else None
    return tqdm(total=total, desc=text, bar_format=form)


@contextmanager
def fraction_bar(progress: Progress, text: str) -> Iterator[Optional[Callable[[Any], Optional[bool]]]]:
    """The function for calls that report the fraction done."""
    function = progress_function(progress)
    if function or not progress:
        yield function
        return
    bar = _bar(text, 1.0)
    if bar is None:
        yield None
        return

    def update(fraction: float) -> None:
        bar.update(max(0.0, fraction - bar.n))

    with bar:
        yield update


@contextmanager
def step_bar(
    progress: Progress, text: str, describe: Callable[[Any], str]
) -> Iterator[Optional[Callable[[Any], Optional[bool]]]]:
    """The function for calls that report steps whose number is not known."""
    function = progress_function(progress)
    if function or not progress:
        yield function
        return
    bar = _bar(text, None)
    if bar is None:
        yield None
        return

    def update(step: Any) -> None:
        bar.set_postfix_str(describe(step), refresh=False)
        bar.update(1)

    with bar:
        yield update
