"""Tells how far something has come: by a bar of tqdm where that is installed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeAlias

Progress: TypeAlias = bool | Callable[[float], object] | None
"""Nothing, a bar (``True``), or a function that is called with the share that is done, from 0 to 1."""


@contextmanager
def told(progress: Progress, label: str) -> Iterator[Callable[[float], object] | None]:
    """The function to call with the share that is done."""
    if progress is None or progress is False:
        yield None
        return
    if callable(progress):
        yield progress
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    with tqdm(total=100, desc=label, bar_format="{l_bar}{bar}| {elapsed}<{remaining}") as bar:

        def show(share: float) -> None:
            bar.n = round(100 * share)
            bar.refresh()

        yield show
        show(1.0)
