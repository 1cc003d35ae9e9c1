"""Studies: many variants of a model, on this machine or on others, with the same bytes either way.

A study is cut into shares (as by ``--shard i/n`` of the command). Each share follows from its number alone, so that it does
not matter who computes it, how often, or after whom. What is there already is not computed again.
"""

from __future__ import annotations

import csv
import html
import json
import re
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from . import _linkdyn
from .answer import Answer, read, whole
from .errors import Interrupted, unknown
from .family import processors
from .progress import Progress, told
from .run import Array
from .store import Store, is_url

if TYPE_CHECKING:
    import pandas

    from .model import Model

__all__ = ["Backend", "Study", "Table"]

Backend: TypeAlias = "str | Callable[..., Iterator[object]]"
"""``local``, ``ray``, ``dask``, ``joblib``, or a function like those of ``linkdyn.backends``."""

# What a spreadsheet would take for a formula has an apostrophe before it in a file.
_ESCAPED = re.compile(r"'+[=+\-@]")

_ABOUT = ("variant", "status")
_SHOWN = ("mean", "deviation", "min", "max")

# More shares than chunks: the last one has nothing to do but to say what the study is.
_MANY = 1 << 40


def _name(head: str) -> str:
    """The heading that was written as this cell."""
    return head[1:] if _ESCAPED.match(head) else head


@dataclass
class Rows:
    """The variants of a study as columns."""

    statuses: list[str]
    units: dict[str, str]
    columns: dict[str, Array]

    @classmethod
    def of_answers(cls, statuses: list[str], units: list[tuple[str, str]], answers: _linkdyn.Answers) -> Rows:
        """Where the library has them in memory."""
        values = np.asarray(answers)
        return cls(statuses, dict(units), {name: values[:, place] for place, (name, _) in enumerate(units)})

    @classmethod
    def of_file(cls, path: Path) -> Rows:
        """Those of ``variants.csv``."""
        with path.open(encoding="utf-8", newline="") as file:
            heads, *rows = csv.reader(file)
        names = [_name(head).split("[", 1)[0] for head in heads]
        columns: dict[str, list[str]] = {name: [row[place] for row in rows] for place, name in enumerate(names)}
        statuses = columns["status"]
        values = {
            name: np.array([float(cell) if cell else np.nan for cell in cells])
            for name, cells in columns.items()
            if name not in _ABOUT
        }
        return cls(statuses, units_of_file(path), values)


def units_of_file(path: Path) -> dict[str, str]:
    """The unit of each column of ``variants.csv``."""
    with path.open(encoding="utf-8", newline="") as file:
        heads = (_name(head).partition("[") for head in next(csv.reader(file)))
        return {name: unit.rstrip("]") for name, _, unit in heads if name not in _ABOUT}


class Table(Mapping[str, Array]):
    """The variants of a study that is done: what was varied and what came out, as columns in SI units."""

    summary: dict[str, Any]
    """What ``study.json`` says."""
    directory: Path | str | None
    """Where the files are, if they are kept: a path, or a URL."""
    page: str | None
    """The page ``report.html``."""

    def __init__(self, source: Rows | Path, answer: Answer) -> None:
        self._source = source
        self.summary = dict(answer)
        self.text = answer.text
        self.page = answer.page
        self.directory = None

    @cached_property
    def _rows(self) -> Rows:
        # Of a study that is kept the file is read when it is asked for: it may be larger than the memory.
        return self._source if isinstance(self._source, Rows) else Rows.of_file(self._source)

    @cached_property
    def status(self) -> NDArray[np.str_]:
        """(variants) how each ended."""
        return np.array(self._rows.statuses)

    @property
    def units(self) -> dict[str, str]:
        """The SI unit of each column; empty of plain numbers."""
        return self._rows.units if isinstance(self._source, Rows) else units_of_file(self._source)

    def __getitem__(self, name: str) -> Array:
        """The values (variants) of a response, or of a parameter, with or without ``parameters.`` before it.

        :raises UnknownName: a ``KeyError``, where there is none of this name.
        """
        columns = self._rows.columns
        found = columns.get(name)
        if found is None:
            found = columns.get(f"parameters.{name}")
        if found is None:
            raise unknown("column", name, columns)
        return found

    def __iter__(self) -> Iterator[str]:
        return iter(self.units)

    def __len__(self) -> int:
        return len(self.units)

    def __repr__(self) -> str:
        return f"<linkdyn.Table {self.summary['variants']} variants: {', '.join(self)}>"

    def to_pandas(self) -> pandas.DataFrame:
        """A DataFrame of pandas with a row for each variant; ``attrs["units"]`` has the units."""
        import pandas

        frame = pandas.DataFrame({"status": self.status} | dict(self))
        frame.attrs["units"] = dict(self.units)
        return frame

    def _repr_html_(self) -> str:
        cells = []
        for asked in self.summary["responses"]:
            told_of = self.summary["summary"]["responses"][asked["name"]]
            values = [asked["name"], asked["unit"]]
            values += [f"{told_of[key]:.6g}" if told_of.get(key) is not None else "" for key in _SHOWN]
            cells.append("<tr>" + "".join(f"<td>{html.escape(value)}</td>" for value in values) + "</tr>")
        heads = "".join(f"<th>{head}</th>" for head in ("response", "unit", *_SHOWN))
        table = f"<table><tr>{heads}</tr>{''.join(cells)}</table>"
        if self.page is None:
            return table
        page = html.escape(self.page, quote=True)
        return f'{table}<iframe srcdoc="{page}" width="100%" height="720" style="border:0" title="study"></iframe>'


@dataclass(frozen=True)
class Asked:
    """What a study is asked for."""

    vary: tuple[tuple[str, str], ...] = ()
    samples: int | None = None
    method: str = "random"
    indices: bool = False
    seed: int | None = None
    responses: tuple[str, ...] = ()


@dataclass(frozen=True)
class Study:
    """What is to be varied, and what comes out; nothing is computed before :meth:`run`.

    >>> import linkdyn
    >>> press = linkdyn.load("slider-crank")
    >>> study = press.study({"crank": "40 mm:60 mm:5"}, responses={"stroke": "max(piston.x) - min(piston.x)"})
    >>> study.variants
    5
    >>> study.run()["stroke"].round(9).tolist()
    [0.08, 0.09, 0.1, 0.11, 0.12]
    """

    model: Model
    asked: Asked

    @cached_property
    def _core(self) -> _linkdyn.Variants:
        asked = self.asked
        return _linkdyn.Variants(
            self.model._core,
            list(asked.vary),
            asked.samples,
            asked.method,
            asked.indices,
            asked.seed,
            list(asked.responses),
        )

    def __reduce__(self) -> tuple[Any, ...]:
        # So that workers of other processes can have it.
        return Study, (self.model, self.asked)

    @cached_property
    def plan(self) -> dict[str, Any]:
        """What the study is, as in ``study.json`` before anything was computed."""
        plan: dict[str, Any] = json.loads(self._core.plan())
        return plan

    @property
    def variants(self) -> int:
        """How many variants there are."""
        return int(self.plan["variants"])

    @property
    def chunks(self) -> int:
        """How many chunks they are kept in: the most shares that can be given out."""
        return -(-self.variants // int(self.plan["rows_per_chunk"]))

    def share(self, index: int, of: int, directory: str | PathLike[str], threads: int | None = None) -> None:
        """Computes a share, from 1, into a directory or URL; what is there already is kept."""
        if is_url(directory):
            with tempfile.TemporaryDirectory() as folder:
                self.share(index, of, folder, threads)
                store, chunks = Store(str(directory)), Path(folder) / "chunks"
                for path in sorted(chunks.iterdir()):
                    store.put(f"chunks/{path.name}", path.read_bytes())
            return
        if not whole(self._core.share(directory, (index, of), threads or processors())):
            raise Interrupted("interrupted")

    def chunk_files(self, index: int, of: int) -> list[str]:
        """Names of the files of a share, in the directory ``chunks``."""
        return [f"chunk-{chunk:08}.bin" for chunk in range(index - 1, self.chunks, of)]

    def run(
        self,
        directory: str | PathLike[str] | None = None,
        backend: Backend = "local",
        *,
        shares: int | None = None,
        shared: bool = True,
        report: bool = True,
        threads: int | None = None,
        progress: Progress = None,
        **settings: Any,
    ) -> Table:
        """Computes all variants, sums up, and reads what came out.

        :param directory: where chunks are kept as they come, and files are written: a path, a URL of fsspec such as
            ``s3://bucket/study``, or none for a temporary one. A study that was stopped goes on from there.
        :param backend: who computes: ``local`` (threads of this process), ``ray``, ``dask``, ``joblib``, or a function.
        :param shares: into how many shares it is cut for others; by default as many as there are chunks, 256 at most.
        :param shared: whether others see the same directory; else they hand back what they computed.
        :param report: whether the page ``report.html`` is written.
        :param threads: threads of this process, one for each processor where nobody says.
        :param settings: more for the backend, see ``linkdyn.backends``.
        :raises Interrupted: where Ctrl-C stopped it.
        """
        if directory is None and backend == "local":
            with told(progress, "study") as show:
                said, statuses, units, values = whole(self._core.run(report, threads or processors(), show))
            return Table(Rows.of_answers(statuses, units, values), read(said))
        with ExitStack() as stack:
            place = Path(stack.enter_context(tempfile.TemporaryDirectory())) if directory is None else directory
            if is_url(place):
                table = self._in_store(str(place), backend, shares, shared, report, threads, progress, settings)
                table.directory = str(place)
                return table
            place = Path(place)
            if backend != "local":
                self._by_others(place, place, backend, shares, shared, progress, settings)
            table = self._joined(place, report, threads, progress, is_kept=directory is not None)
            table.directory = place if directory is not None else None
            return table

    def _in_store(
        self,
        url: str,
        backend: Backend,
        shares: int | None,
        shared: bool,
        report: bool,
        threads: int | None,
        progress: Progress,
        settings: dict[str, Any],
    ) -> Table:
        from .backends import by_this

        store = Store(url)
        with tempfile.TemporaryDirectory() as folder:
            place = Path(folder)
            if "study.json" in store.names(""):
                store.fetch("study.json", place)
            if backend == "local":
                backend, settings = by_this, {"threads": threads}
            self._by_others(place, url, backend, shares, shared, progress, settings)
            for name in sorted(store.names("chunks")):
                store.fetch(f"chunks/{name}", place)
            fetched = {path: path.stat().st_mtime_ns for path in place.rglob("*.bin")}
            table = self._joined(place, report, threads, None, is_kept=False)
            for path in sorted(path for path in place.rglob("*") if path.is_file()):
                if fetched.get(path) != path.stat().st_mtime_ns:
                    store.put(path.relative_to(place).as_posix(), path.read_bytes())
            return table

    def _joined(self, place: Path, report: bool, threads: int | None, progress: Progress, *, is_kept: bool) -> Table:
        """Computes what others left out or broke, and joins all, by the same code whoever computed."""
        with told(progress, "study") as show:
            answer = read(whole(self._core.join(place, report, threads or processors(), show)))
        if report:
            answer.page = (place / "report.html").read_text("utf-8")
        path = place / "variants.csv"
        return Table(path if is_kept else Rows.of_file(path), answer)

    def _by_others(
        self,
        place: Path,
        target: Path | str,
        backend: Backend,
        shares: int | None,
        shared: bool,
        progress: Progress,
        settings: dict[str, Any],
    ) -> None:
        """Has shares computed into the target, which is this place or a URL."""
        from . import backends

        compute = backends.find(backend) if isinstance(backend, str) else backend
        # Says in the directory what the study is, or refuses one of another study.
        self.share(_MANY, _MANY, place)
        if isinstance(target, Path):
            there = {path.name for path in (place / "chunks").iterdir()}
        else:
            store = Store(target)
            store.put("study.json", (place / "study.json").read_bytes())
            there = store.names("chunks")
        of = max(1, min(shares or 256, self.chunks))
        missing = [(index, of) for index in range(1, of + 1) if not there.issuperset(self.chunk_files(index, of))]
        with told(progress, "study") as show:
            for done, _ in enumerate(compute(self, missing, target, shared=shared, **settings), 1):
                if show is not None:
                    show(done / len(missing))
