"""Many variants of one mechanism, computed by all processors in one call."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _linkdyn
from .errors import Interrupted, unknown
from .progress import Progress, told
from .run import Array
from .values import Units, Values, table

if TYPE_CHECKING:
    import pandas

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
    inputs: Array = field(default_factory=lambda: np.zeros((0, 0)))
    """(variants, parameters) values in SI."""
    units: Mapping[str, str] = field(default_factory=dict)
    """The SI unit of each parameter and response."""

    @property
    def ok(self) -> NDArray[np.bool_]:
        """(variants) whether each came to its end."""
        return self.codes <= 1

    @cached_property
    def status(self) -> NDArray[np.str_]:
        """(variants) how each ended, in words."""
        return np.array(_linkdyn.Family.WORDS)[self.codes]

    def __getitem__(self, name: str) -> Array:
        """(variants) one response.

        :raises UnknownName: a ``KeyError``, where no response has this name.
        """
        if name not in self.names:
            raise unknown("response", name, self.names)
        column: Array = self.values[:, self.names.index(name)]
        return column

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __contains__(self, name: object) -> bool:
        return name in self.names

    def keys(self) -> list[str]:
        """Names of the responses: ``dict(variants)`` has their values."""
        return list(self.names)

    def to_pandas(self) -> pandas.DataFrame:
        """A DataFrame of pandas with a row for each variant: how it ended, parameters, responses.

        ``attrs["units"]`` has the units.
        """
        import pandas

        parameters = [name for name in self.units if name not in self.names]
        columns = dict(zip(parameters, self.inputs.T, strict=True)) | dict(self)
        frame = pandas.DataFrame({"status": self.status} | columns)
        frame.attrs["units"] = dict(self.units)
        return frame

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

    def __reduce__(self) -> tuple[Any, ...]:
        # So that workers of other processes can have it.
        return Family, (self._model, self.parameters)

    @property
    def parameters(self) -> list[str]:
        """Names of the parameters, in the order of the columns of the values."""
        return self._core.parameters

    @property
    def responses(self) -> Mapping[str, str]:
        """The SI unit of each response, in the order of the columns of what comes out."""
        return dict(self._core.responses)

    @property
    def names(self) -> list[str]:
        """Names of the responses, in their order."""
        return list(self.responses)

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
        return self._run(values, threads, progress, slopes=False)[0]

    def gradient(self, values: Values, *, threads: int | None = None, progress: Progress = None) -> Array:
        """(variants, responses, parameters) exact derivatives in SI; NaN where one is not known exactly.

        Known are those of motions that drivers prescribe, and of stable equilibria: of smooth extremes, of values at an
        instant, and of sums over the rows.

        :param values: as those of a call.

        >>> import linkdyn
        >>> press = linkdyn.load("slider-crank").family("crank", {"stroke": "max(piston.x) - min(piston.x)"})
        >>> press.gradient(["50 mm"]).round(9).tolist()
        [[[2.0]]]
        """
        return self.value_and_gradient(values, threads=threads, progress=progress)[1]

    def value_and_gradient(
        self, values: Values, *, threads: int | None = None, progress: Progress = None
    ) -> tuple[Variants, Array]:
        """What a call gives, and :meth:`gradient`, at once."""
        variants, slopes = self._run(values, threads, progress, slopes=True)
        return variants, slopes.reshape(-1, len(self.responses), len(self.parameters))

    def _run(self, values: Values, threads: int | None, progress: Progress, *, slopes: bool) -> tuple[Variants, Array]:
        parameters = self.parameters
        rows = table(values, parameters, self._units)
        with told(progress, "variants") as show:
            answers, codes, fault, stopped, found = self._core.run(rows, threads or processors(), show, slopes)
        if isinstance(stopped, KeyboardInterrupt):
            raise Interrupted("interrupted") from stopped
        if stopped is not None:
            raise stopped
        names = list(self.responses)
        units = {f"parameters.{name}": self._units[name][1] for name in parameters} | dict(self.responses)
        return Variants(np.asarray(answers), np.asarray(codes), names, fault, rows, units), np.asarray(found)

    @cached_property
    def _units(self) -> Units:
        return self._model.parameters


def processors() -> int:
    """How many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
