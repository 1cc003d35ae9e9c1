"""Many variants of one mechanism, computed by all processors in one call."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from . import _linkdyn
from .errors import Interrupted
from .progress import Progress, told
from .run import Array
from .values import Units, Values, table

if TYPE_CHECKING:
    from .model import Model

__all__ = ["Family", "Variants"]


@dataclass(frozen=True)
class Variants:
    """What came out of many variants."""

    values: Array
    """(variants, responses) in SI; NaN where a variant has no such number."""
    codes: NDArray[np.uint8]
    """(variants) numbers of the words in ``Family.words``; 0 and 1 came to their end."""
    names: list[str]
    """Names of the responses."""
    fault: tuple[int, str] | None
    """Number of the first variant that the model's check refuses, and why."""

    @property
    def ok(self) -> NDArray[np.bool_]:
        """(variants) whether each came to its end."""
        return self.codes <= 1

    @cached_property
    def status(self) -> NDArray[np.str_]:
        """(variants) how each ended, in words."""
        return np.array(_linkdyn.Family.WORDS)[self.codes]

    def __getitem__(self, name: str) -> Array:
        """(variants) one response."""
        column: Array = self.values[:, self.names.index(name)]
        return column

    def __len__(self) -> int:
        return len(self.codes)


class Family:
    """A mechanism whose parameters take many values: compiled and followed once.

    >>> import linkdyn, numpy as np
    >>> press = linkdyn.load("slider-crank")
    >>> stroke = press.family(["crank"], {"stroke": "max(piston.x) - min(piston.x)"})
    >>> found = stroke(np.array([[0.04], [0.05], [0.06]]))
    >>> np.round(found["stroke"], 9).tolist()
    [0.08, 0.1, 0.12]
    """

    def __init__(self, model: Model, parameters: list[str]) -> None:
        self._model = model
        self._core = model._core.family(parameters)

    @property
    def parameters(self) -> list[str]:
        """Names of the parameters, in the order of the columns of the values."""
        return self._core.parameters

    @property
    def responses(self) -> Mapping[str, str]:
        """The SI unit of each response, in the order of the columns of what comes out."""
        return dict(self._core.responses)

    @property
    def words(self) -> list[str]:
        """Words of the numbers that tell how variants ended."""
        return _linkdyn.Family.WORDS

    def __call__(self, values: Values, *, threads: int | None = None, progress: Progress = None) -> Variants:
        """Works out the responses of many variants, with the interpreter's lock released.

        :param values: (variants, parameters) in SI, or texts such as ``"90 mm"``; of one parameter also (variants).
        :param threads: one for each processor where nobody says. What comes out does not depend on it.
        :raises Interrupted: where Ctrl-C stopped it.
        """
        rows = table(values, self.parameters, self._units)
        with told(progress, "variants") as show:
            answers, codes, fault, stopped = self._core.run(rows, threads or processors(), show)
        if isinstance(stopped, KeyboardInterrupt):
            raise Interrupted("interrupted") from stopped
        if stopped is not None:
            raise stopped
        return Variants(np.asarray(answers), np.asarray(codes), list(self.responses), fault)

    @cached_property
    def _units(self) -> Units:
        return self._model.parameters


def processors() -> int:
    """How many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
