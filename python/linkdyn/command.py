"""What the command does, for Python: the same words, numbers and files."""

from __future__ import annotations

import json
from collections.abc import Iterable
from html import escape
from pathlib import Path
from typing import Any

from . import _linkdyn
from .errors import Complaint, InternalError, Interrupted, ModelError, SolveError

__all__ = ["Answer"]

DONE, FAULT, BAD_INPUT, STOPPED, UNWRITTEN, BROKEN, INTERRUPTED = 0, 1, 2, 3, 4, 5, 130


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


def words(text: str) -> list[str]:
    """The complaints of the command, without their beginning."""
    lines = (line.removeprefix("error: ").strip() for line in text.splitlines())
    return [line for line in lines if line]


def execute(arguments: Iterable[str]) -> _linkdyn.Said:
    """Runs the command in this process.

    :raises ModelError: where the input is bad.
    :raises SolveError: where numerics or geometry forbid to go on.
    :raises OSError: where something can't be written.
    :raises InternalError: where linkdyn itself is at fault.
    :raises Interrupted: where Ctrl-C stopped it.
    """
    said, stopped = _linkdyn.command(list(arguments))
    if stopped is not None and not isinstance(stopped, KeyboardInterrupt):
        raise stopped
    lines = words(said.stderr)
    text = "\n".join(lines)
    if stopped is not None or said.status == INTERRUPTED:
        raise Interrupted(text) from stopped
    if said.status == BAD_INPUT:
        complaints = (Complaint("", None, None, None, line, None, line) for line in lines)
        raise ModelError(text, complaints)
    if said.status == STOPPED:
        raise SolveError(text)
    if said.status == UNWRITTEN:
        raise OSError(text)
    if said.status == BROKEN:
        raise InternalError(text)
    return said


def read(directory: Path, document: str, text: str, page: str | None = None) -> Answer:
    """The answer in the files that the command wrote."""
    values: dict[str, Any] = json.loads((directory / document).read_text("utf-8"))
    path = directory / page if page else None
    shown = path.read_text("utf-8") if path and path.exists() else None
    kept = (line for line in text.splitlines() if str(directory) not in line)
    return Answer(values, "\n".join(kept), shown)
