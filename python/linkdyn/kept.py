"""Runs that came from another process: their numbers, without the memory of the engine."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _linkdyn
from .errors import LinkdynError, unknown

if TYPE_CHECKING:
    from .model import Model

__all__ = ["Kept"]


@dataclass(frozen=True)
class Column:
    """The values of a column, and its extremes with peaks between the rows."""

    values: NDArray[np.float64]
    ends: tuple[float, float]

    @property
    def __array_interface__(self) -> dict[str, Any]:
        return self.values.__array_interface__

    def min(self) -> float:
        """Smallest value."""
        return self.ends[0]

    def max(self) -> float:
        """Largest value."""
        return self.ends[1]


@dataclass(frozen=True)
class Kept:
    """What a run left, wherever it ran: stands for the engine's own."""

    model: Model
    status: str
    is_complete: bool
    message: str | None
    warnings: list[str]
    columns: list[tuple[str, str]]
    told: str
    """The text of ``summary.json``."""
    names: list[str]
    """Of all columns that were computed, also of those that ``columns`` leaves out."""
    table: NDArray[np.float64]
    """(rows, names)"""
    ends: list[tuple[float, float]]
    """(names) smallest and largest values."""

    @classmethod
    def of(cls, core: _linkdyn.Run | Kept, model: Model) -> Kept:
        """The numbers of a run of a model."""
        if isinstance(core, Kept):
            return core
        names = list(model.units)
        columns = [core.column(name) for name in names]
        return cls(
            model,
            core.status,
            core.is_complete,
            core.message,
            core.warnings,
            core.columns,
            core.summary(),
            names,
            np.column_stack([np.asarray(column) for column in columns]),
            [(column.min(), column.max()) for column in columns],
        )

    def column(self, name: str) -> Column:
        """A column that was computed."""
        if name not in self.names:
            raise unknown("column", name, self.names)
        place = self.names.index(name)
        values = self.table[:, place]
        values.flags.writeable = False
        return Column(values, self.ends[place])

    def summary(self) -> str:
        """The text of ``summary.json``."""
        return self.told

    def html(self) -> str:
        """The text of ``report.html``."""
        return self._again().html()

    def write(self, directory: Path) -> list[Path]:
        """Writes the files of the command."""
        return self._again().write(directory)

    def _again(self) -> _linkdyn.Run:
        """The same run once more, since only the engine makes pages and files."""
        core, stopped = self.model._core.run()
        if stopped is not None:
            raise stopped
        if core.status != self.status:
            raise LinkdynError(f"the run ended early ({self.status}): its page and files are made where it ran")
        return core
