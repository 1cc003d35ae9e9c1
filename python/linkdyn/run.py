"""What a run leaves: columns as arrays, how it ended, a page that shows it in motion."""

from __future__ import annotations

import html
import json
from collections.abc import Iterator, Mapping
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _linkdyn
from .kept import Kept

if TYPE_CHECKING:
    import pandas
    import polars
    import xarray
    from matplotlib.axes import Axes

    from .model import Model

__all__ = ["Array", "Run"]

Array = NDArray[np.float64]


class Run(Mapping[str, Array]):
    """A finished run: a mapping from names of columns to their values.

    Values are read-only views of the memory of the run, in SI units, one for each row. NaN stands for a value that does
    not exist at that instant.

    >>> import linkdyn
    >>> r = linkdyn.load("four-bar").run()
    >>> r["driver.motor.effort"].shape == r.t.shape
    True
    >>> r.units["driver.motor.effort"]
    'N*m'
    >>> r.status
    'completed'
    """

    def __init__(self, core: _linkdyn.Run | Kept, model: Model) -> None:
        self._core = core
        self._model = model
        self._arrays: dict[str, Array] = {}

    def __reduce__(self) -> tuple[Any, ...]:
        # So that workers of other processes can hand it back.
        return Run, (Kept.of(self._core, self._model), self._model)

    def __getitem__(self, name: str) -> Array:
        """The values of a column (rows), in its SI unit; its name may end with ``[unit]``.

        Columns that ``analysis.columns`` leaves out were computed, too, and can be had by name.
        """
        found = self._arrays.get(name)
        if found is None:
            # NumPy reads the memory of the column in place, and keeps the column alive, which keeps the run.
            found = np.asarray(self._core.column(name.split("[", 1)[0]))
            self._arrays[name] = found
        return found

    def __iter__(self) -> Iterator[str]:
        return iter(self.units)

    def __len__(self) -> int:
        return len(self.units)

    def __contains__(self, name: object) -> bool:
        return name in self.units

    def __repr__(self) -> str:
        return f"<linkdyn.Run {self.status}: {len(self.t)} rows, {len(self)} columns>"

    @property
    def t(self) -> Array:
        """The instants of the rows [s]."""
        return self["time"]

    @cached_property
    def units(self) -> Mapping[str, str]:
        """The SI unit of each column, in the order of ``results.csv``."""
        return dict(self._core.columns)

    @property
    def columns(self) -> list[str]:
        """Names of the columns, in the order of ``results.csv``; ``time`` is the first."""
        return list(self.units)

    @property
    def status(self) -> str:
        """How the run ended: ``completed``, ``completed_with_gaps``, or why it ended early."""
        return self._core.status

    @property
    def message(self) -> str | None:
        """Why the run ended early, in a sentence or two."""
        return self._core.message

    @property
    def warnings(self) -> list[str]:
        """What was suspicious."""
        return self._core.warnings

    @cached_property
    def summary(self) -> dict[str, Any]:
        """What ``summary.json`` says of the run."""
        summary: dict[str, Any] = json.loads(self._core.summary())
        return summary

    @property
    def events(self) -> list[dict[str, Any]]:
        """What happened, by time: contacts, dead centres and so on, each with ``type`` and ``time`` [s]."""
        events: list[dict[str, Any]] = self.summary["events"]
        return events

    @property
    def responses(self) -> dict[str, Any]:
        """The named numbers of the run, as ``summary.json`` tells them."""
        responses: dict[str, Any] = self.summary.get("responses") or {}
        return responses

    def extremes(self, name: str) -> tuple[float, float]:
        """Smallest and largest value of a column, its peaks between the rows included.

        >>> import linkdyn
        >>> r = linkdyn.load("four-bar").run()
        >>> least, most = r.extremes("driver.motor.effort")
        >>> bool(least <= r["driver.motor.effort"].min())
        True
        """
        column = self._core.column(name.split("[", 1)[0])
        return column.min(), column.max()

    def headings(self) -> list[str]:
        """The headings of ``results.csv``: ``name[unit]``."""
        return [f"{name}[{unit}]" for name, unit in self.units.items()]

    def to_numpy(self) -> Array:
        """All columns as one table (rows, columns), a copy."""
        return np.column_stack([self[name] for name in self])

    def to_pandas(self) -> pandas.DataFrame:
        """A DataFrame of pandas with a column for each column of ``results.csv``; ``attrs["units"]`` has their units."""
        import pandas

        frame = pandas.DataFrame({name: self[name] for name in self})
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_polars(self) -> polars.DataFrame:
        """A DataFrame of Polars with a column for each column of ``results.csv``."""
        import polars

        return polars.DataFrame({name: np.ascontiguousarray(self[name]) for name in self})

    def to_xarray(self) -> xarray.Dataset:
        """A Dataset of xarray over ``time``, with a variable for each other column of ``results.csv`` and its ``units``."""
        try:
            import xarray
        except ImportError as error:
            raise ImportError('to_xarray needs xarray: pip install "linkdyn[xarray]"') from error
        columns = {name: ("time", self[name], {"units": unit}) for name, unit in self.units.items()}
        time = columns.pop("time", ("time", self.t, {"units": "s"}))
        return xarray.Dataset(columns, coords={"time": time}, attrs={"model": self._model.name, "status": self.status})

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """The table for anything that reads Arrow. Needs pyarrow or Polars, which make it."""
        try:
            import pyarrow
        except ImportError:
            return self.to_polars().__arrow_c_stream__(requested_schema)
        fields = [pyarrow.field(name, pyarrow.float64(), metadata={"unit": unit}) for name, unit in self.units.items()]
        arrays = [pyarrow.array(np.ascontiguousarray(self[name])) for name in self]
        table = pyarrow.Table.from_arrays(arrays, schema=pyarrow.schema(fields))
        stream: object = table.__arrow_c_stream__(requested_schema)
        return stream

    def write(self, directory: str | PathLike[str]) -> list[Path]:
        """Writes ``results.csv``, ``summary.json``, ``report.html`` and, of motions with contacts, ``peaks.csv``."""
        return self._core.write(Path(directory))

    def html(self) -> str:
        """The page ``report.html``: the mechanism in motion, plots and tables."""
        return self._core.html()

    def _repr_html_(self) -> str:
        page = html.escape(self.html(), quote=True)
        return f'<iframe srcdoc="{page}" width="100%" height="720" style="border:0" title="linkdyn"></iframe>'

    def plot(self, *names: str, over: str = "time", units: str | None = None, ax: Axes | None = None, **style: Any) -> Axes:
        """Draws columns with matplotlib, over time or over another column; further arguments go to ``Axes.plot``.

        A magnitude is asked for without a letter: ``joint.a.f`` of ``joint.a.fx`` and ``joint.a.fy``.

        :param units: ``"SI"`` draws in SI, where all else is in the units that the model file names.
        """
        if ax is None:
            from matplotlib import pyplot

            ax = pyplot.subplots()[1]
        x, x_unit = self._drawn(over, units)
        drawn = []
        for name in names:
            values, unit = self._drawn(name, units)
            drawn.append(unit)
            ax.plot(x, values, **({"label": name} | style))
        ax.set_xlabel(f"{over} [{x_unit}]")
        label = names[0] if len(names) == 1 else ""
        ax.set_ylabel(f"{label} [{', '.join(dict.fromkeys(drawn))}]".strip())
        if len(names) > 1:
            ax.legend()
        ax.grid(True, alpha=0.3)
        return ax

    def _drawn(self, name: str, units: str | None) -> tuple[Array, str]:
        """The values of a column in the unit in which it is drawn."""
        if units not in (None, "SI"):
            raise ValueError(f'units are those of the model file (None) or "SI", not {units!r}')
        parts = [name + letter for letter in "xy"]
        if name not in self.units and all(part in self.units for part in parts):
            values, unit = np.hypot(*(self[part] for part in parts)), self.units[parts[0]]
        else:
            values, unit = self[name], self._model.units.get(name.split("[", 1)[0], "")
        own = None if units else self._model._unit(unit)
        return (values / _linkdyn.quantity(f"1 {own}")[0], own) if own else (values, unit)
