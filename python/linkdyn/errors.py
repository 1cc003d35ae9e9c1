"""What can go wrong, as exceptions.

Everything that linkdyn raises on its own is a :class:`LinkdynError`, except :class:`Interrupted`, which is a
``KeyboardInterrupt``. Files that can't be read or written raise ``OSError``.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .run import Run

__all__ = [
    "Complaint",
    "InternalError",
    "Interrupted",
    "LinkdynError",
    "ModelError",
    "SolveError",
    "UnitError",
    "UnknownModel",
    "UnknownName",
]


@dataclass(frozen=True)
class Complaint:
    """One fault of a model: where, what stands there, what is wrong, what would mend it."""

    path: str
    """Path in the model, such as ``joints.b.between[1]``; empty for the file as a whole."""
    line: int | None
    """Line in the text, from 1; none of what was set."""
    column: int | None
    """Column in characters, from 1."""
    found: str | None
    """The offending text."""
    message: str
    """What is wrong."""
    hint: str | None
    """What would mend it."""
    text: str
    """All of it in one line, in the words of the command."""

    def __str__(self) -> str:
        return self.text


_PLURALS = {name: f"{name}s" for name in ("constraint", "goal", "joint", "output", "response")}
_NAME = (
    r"--(allow-files|columns|constraint|goal|indices|joint|levels|maximise|minimise|models|output|response|robust|samples"
    r"|seed|set|starts|threads|vary)\b"
)
_IN_PYTHON: list[tuple[re.Pattern[str], Callable[[re.Match[str]], str]]] = [
    (re.compile(r'(?:--vary )?"parameters\.(\w+)=([^"]*)"'), lambda own: f'{{"{own[1]}": "{own[2]}"}}'),
    (re.compile(r'(?<=add )--response "(\w+) = ([^"]*)"'), lambda own: f'responses={{"{own[1]}": "{own[2]}"}}'),
    (re.compile(r'(?<=say )--goal ("[^"]*")'), lambda own: f"goals=[{own[1]}]"),
    (re.compile(r"(?<=say )(?=\{)"), lambda _: "vary="),
    (re.compile(r"\ba --constraint"), lambda _: "one of the constraints"),
    (re.compile(rf"{_NAME} (?=[A-Z]+\b)"), lambda own: f"{_argument(own[1])}="),
    (re.compile(_NAME), lambda own: _argument(own[1])),
]


def _argument(option: str) -> str:
    return _PLURALS.get(option, option.replace("-", "_"))


def _in_python(told: Any) -> Any:
    """What a message says of options of the command, said of arguments."""
    if isinstance(told, str) and ("--" in told or "as in" in told):
        for pattern, of in _IN_PYTHON:
            told = pattern.sub(of, told)
    return told


class LinkdynError(Exception):
    """Something could not be done."""


class ModelError(LinkdynError, ValueError):
    """A model, or what was asked of it, has faults: all of them at once.

    >>> import linkdyn
    >>> try:
    ...     linkdyn.load("four-bar").set({"parameters.crank": "100 millimetres"})
    ... except linkdyn.ModelError as error:
    ...     print(error.complaints[0].path)
    parameters.crank
    """

    complaints: list[Complaint]
    """The faults, in the order of the lines."""

    def __init__(self, text: str, complaints: Iterable[Sequence[Any] | Complaint] = ()) -> None:
        super().__init__(_in_python(text))
        self.complaints = [one if isinstance(one, Complaint) else Complaint(*map(_in_python, one)) for one in complaints]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self), self.complaints)


class UnknownModel(LinkdynError, LookupError):
    """No file and no bundled model has this name."""


class MissingFile(UnknownModel, FileNotFoundError):
    """There is no such file, and no bundled model has this name."""

    def __init__(self, number: int, text: str, path: str) -> None:
        super().__init__(number, text, path)
        self.errno, self.strerror, self.filename = number, text, path

    def __str__(self) -> str:
        return f"{self.filename}: {self.strerror}"


class UnknownName(LinkdynError, KeyError):
    """No parameter or column has this name."""

    def __str__(self) -> str:
        # KeyError shows the repr of its argument, which is for keys, not for sentences.
        return str(self.args[0]) if self.args else ""


def unknown(what: str, name: str, known: Iterable[str]) -> UnknownName:
    """The exception of a name that there is not, with the most similar one that there is."""
    near = get_close_matches(str(name), known, 1)
    hint = f'; did you mean "{near[0]}"?' if near else ""
    return UnknownName(f'no {what} is called "{name}"{hint}')


class UnitError(LinkdynError, ValueError):
    """A text is no unit, or a value has another dimension than its parameter."""


class SolveError(LinkdynError, RuntimeError):
    """A run ended early: the solver cannot continue, or its time is over."""

    run: Run | None
    """What was computed until then."""

    def __init__(self, text: str, run: Run | None = None) -> None:
        super().__init__(text)
        self.run = run


class Interrupted(KeyboardInterrupt):
    """Ctrl-C stopped it; what was computed until then is kept."""

    run: Run | None
    """What was computed until then."""

    def __init__(self, text: str = "", run: Run | None = None) -> None:
        super().__init__(text)
        self.run = run


class InternalError(LinkdynError, RuntimeError):
    """A fault of linkdyn itself; please report it with the model."""
