"""What questions are answered with."""

from __future__ import annotations

import json
from html import escape
from typing import Any, TypeVar

from .errors import Interrupted

__all__ = ["Answer"]

T = TypeVar("T")
Told = tuple[str, str, str | None]
"""JSON, words, and a page."""


class Answer(dict[str, Any]):
    """What a question was answered with: the JSON that the command writes, and the words that it prints.

    >>> import linkdyn
    >>> answer = linkdyn.load("double-pendulum").modes()
    >>> len(answer["modes"])
    2
    >>> "double" in answer.text
    True
    """

    text: str
    """The answer for people."""
    page: str | None
    """The answer as a page of HTML."""

    def __init__(self, values: dict[str, Any], text: str = "", page: str | None = None) -> None:
        super().__init__(values)
        self.text = text
        self.page = page

    def _repr_html_(self) -> str:
        if self.page is None:
            return f"<pre>{escape(self.text or json.dumps(self, indent=1))}</pre>"
        page = escape(self.page, quote=True)
        return f'<iframe srcdoc="{page}" width="100%" height="720" style="border:0" title="linkdyn"></iframe>'


def whole(done: tuple[T | None, BaseException | None]) -> T:
    """What was asked for.

    :raises Interrupted: where Ctrl-C stopped it.
    """
    value, stopped = done
    if isinstance(stopped, KeyboardInterrupt):
        raise Interrupted("interrupted") from stopped
    if stopped is not None:
        raise stopped
    if value is None:
        raise Interrupted("interrupted")
    return value


def read(told: Told) -> Answer:
    """An answer of the library."""
    values, text, page = told
    return Answer(json.loads(values), text, page)
