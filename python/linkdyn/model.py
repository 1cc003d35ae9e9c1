"""Models: reading, setting, running, asking."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from errno import ENOENT
from functools import cached_property
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, overload

import numpy as np

from . import _linkdyn
from .answer import Answer, read, whole
from .equations import Equations
from .errors import Interrupted, MissingFile, ModelError, SolveError, UnknownModel
from .family import Family, processors
from .function import Function
from .linear import LinearSystem
from .progress import Progress, told
from .run import Run
from .simulation import Simulation
from .study import Asked, Study
from .values import DIMENSIONS, Values, as_list, bounds, one_by_one

if TYPE_CHECKING:
    from .editor import Editor

__all__ = ["Model", "Source", "Value", "import_model", "load", "models"]

Source: TypeAlias = "str | bytes | PathLike[str] | Mapping[str, Any]"
"""A path, the name of a bundled model, the text of a model file, or what it says as a dictionary."""
Value: TypeAlias = "str | int | float | bool | np.number[Any] | Mapping[str, Any] | list[Any] | None"
"""A value of a model, as its JSON has it; texts such as ``"40 mm"`` or ``"2*r"`` mean what they mean in a file."""


_ONE = "response"
"""How a response is called that was given no name."""
_LARGEST = 64 * 1024 * 1024
"""Bytes of a model file at most; what is larger is refused by whoever reads it."""


def models() -> list[str]:
    """Names of the bundled models.

    >>> import linkdyn
    >>> "lock" in linkdyn.models()
    True
    """
    return _linkdyn.bundled()


def load(source: Source, allow_files: Iterable[str | PathLike[str]] = ()) -> Model:
    """Reads a model and checks it.

    :param source: the path of a model file, the name of a bundled model (where there is no such file), JSON text, or a
        dictionary of the same shape.
    :param allow_files: folders below which the model may name files, besides its own folder.
    :raises ModelError: with all faults of the model.
    :raises UnknownModel: where there is neither such a file nor a bundled model of that name; it is a ``FileNotFoundError``,
        too, where the name is that of a path.

    >>> import linkdyn
    >>> linkdyn.load("lock").name
    'Watt-I lock'
    """
    allowed = [fspath(folder) for folder in allow_files]
    if isinstance(source, Mapping):
        return Model._of_text("model", json.dumps(source, default=_plain).encode(), allowed)
    if isinstance(source, bytes):
        return Model._of_text("model", source, allowed)
    if isinstance(source, str) and source.lstrip()[:1] == "{":
        return Model._of_text("model", source.encode(), allowed)
    path = Path(fspath(source))
    if isinstance(source, str) and not path.is_file():
        try:
            return Model(_linkdyn.Mechanism.bundled(source), source, None)
        except UnknownModel:
            # What looks like a path is meant as one.
            if not path.suffix and path.name == source:
                raise
            if not path.exists():
                raise MissingFile(ENOENT, "there is no such file, and no bundled model of that name", source) from None
    with path.open("rb") as file:
        text = file.read(_LARGEST + 1)
    return Model._of_text(path.stem, text, allowed, str(path))


def import_model(source: str | bytes | PathLike[str], format: str | None = None, length: str | None = None) -> Model:
    """Reads a mechanism of another program. What of it the model lacks is in its ``left_out``.

    :param source: the path of a file, a link that PMKS+ shares, or what is in a file: bytes, or text of several lines.
    :param format: ``pmks``, ``pylinkage``, ``mjcf``, ``urdf``, ``sdf``, ``dxf``, ``svg`` or ``csv``, where name and
        content do not say it.
    :param length: the unit of its lengths, where it does not say it, such as ``mm``.
    :raises ModelError: where it can't be read.
    :raises FileNotFoundError: where there is no such file.

    >>> import linkdyn
    >>> table = "joint,x [mm],y [mm],bodies\\nA,0,0,ground crank\\nB,30,40,crank\\n"
    >>> linkdyn.import_model(table, "csv").to_dict()["joints"]
    {'A': {'type': 'revolute', 'between': ['ground.A', 'crank.A']}}
    """
    name = ""
    if isinstance(source, str) and ("://" in source or "\n" in source or source.lstrip()[:1] in ("{", "<")):
        source = source.encode()
    if not isinstance(source, bytes):
        path = Path(fspath(source))
        with path.open("rb") as file:
            name, source = path.name, file.read(_LARGEST + 1)
    text, left_out = _linkdyn.imported(name, source, format, length)
    model = Model._of_text("model", text.encode(), [])
    model.left_out = tuple(f"{place}: {what}" for place, what in left_out)
    return model


class Model:
    """A model that was read and checked. It never changes: what sets values gives another one.

    >>> import linkdyn
    >>> m = linkdyn.load("four-bar")
    >>> m.parameters["crank"]
    (0.1, 'm')
    >>> m.set({"parameters.crank": "90 mm"}).parameters["crank"]
    (0.09, 'm')
    """

    left_out: tuple[str, ...] = ()
    """What the file of another program has and the model lacks; empty of models that were not imported."""

    def __init__(self, core: _linkdyn.Mechanism, label: str, text: bytes | None, sets: tuple[str, ...] = ()) -> None:
        self._core = core
        self._label = label
        self._text = text
        self._sets = sets

    @classmethod
    def _of_text(cls, stem: str, text: bytes, allowed: list[str], path: str = "") -> Model:
        core = _linkdyn.Mechanism.read(stem, text, path, allowed)
        # Tables of files beside it are in the model from here on.
        return cls(core, stem, core.to_json().encode() if b'"file"' in text else text)

    def __repr__(self) -> str:
        return f"<linkdyn.Model {self.name!r}>"

    def __reduce__(self) -> tuple[Any, ...]:
        # So that workers of other processes can have it.
        return _restored, (self._label, self._text, self._sets)

    @property
    def name(self) -> str:
        """The model's own name, or that of its file."""
        return self._core.name

    @property
    def warnings(self) -> list[str]:
        """What is allowed in the model and yet probably a slip."""
        return self._core.warnings

    @property
    def parameters(self) -> dict[str, tuple[float, str]]:
        """Value in SI and SI unit of each parameter."""
        return {name: (value, unit) for name, value, unit in self._core.parameters}

    @property
    def units(self) -> dict[str, str]:
        """SI unit of each column that a run has."""
        return dict(self._core.columns)

    def to_json(self) -> str:
        """The model as the text of a file, with what was set since."""
        return self._core.to_json()

    def to_dict(self) -> dict[str, Any]:
        """The same as a dictionary."""
        model: dict[str, Any] = json.loads(self.to_json())
        return model

    def save(self, path: str | PathLike[str]) -> Path:
        """Writes the model as a file."""
        path = Path(path)
        path.write_text(self.to_json() + "\n", "utf-8")
        return path

    def edit(self, page: str | PathLike[str] | None = None, *, height: int = 720) -> Editor:
        """The model in the editor, in a notebook: it is drawn, dragged and typed there; text and parameters are shared.

        :param page: the file ``editor.html``; by default that of the environment's LINKDYN_EDITOR, or the package's own.
        :param height: of the widget [pixels].
        :raises ImportError: without anywidget: ``pip install linkdyn[notebook]``.
        :raises FileNotFoundError: where there is no such page.
        """
        try:
            from .editor import Editor
        except ModuleNotFoundError as fault:
            raise ImportError("the editor in a notebook needs anywidget: pip install linkdyn[notebook]") from fault
        text = self._text.decode() if self._text and not self._sets else self.to_json()
        return Editor(text, page, height)

    def _knobs(self) -> dict[str, float]:
        """Numbers of the parameters that have one of their own, in the file's units."""
        return {name: value for name, value, _ in self._core.knobs()}

    def _rewritten(self, values: Mapping[str, float]) -> str:
        """The text of the file with other numbers for such parameters."""
        return self._core.rewritten(list(values.items()))

    def set(self, values: Mapping[str, Value]) -> Model:
        """A copy with values set, all at once. Values are those of a model file: plain numbers are in its units.

        :raises ModelError: where a path leads nowhere, or the model has faults with these values.

        >>> import linkdyn
        >>> coarse = linkdyn.load("four-bar").set({"analysis.outputs": 5})
        >>> coarse.run().t.shape
        (5,)
        """
        sets = [self._set(path, value) for path, value in values.items()]
        try:
            return self._with(sets)
        except ModelError:
            plain = [f"{path}={_told(value)}" for path, value in values.items()]
            if plain != sets:
                # Expressions that are set with a parameter may want its number as it is.
                with suppress(ModelError):
                    return self._with(plain)
            raise

    def _with(self, sets: list[str]) -> Model:
        return Model(self._core.set(sets), self._label, self._text, self._sets + tuple(sets))

    def _set(self, path: str, value: Value) -> str:
        """What is set, as ``PATH=VALUE``; the number of a parameter that has a dimension with the file's unit of it."""
        name = path.removeprefix("parameters.")
        if name != path and isinstance(value, int | float | np.number) and not isinstance(value, bool):
            unit = self.parameters.get(name, (0.0, ""))[1]
            if unit:
                return f"{path}={float(value)!r} {self._unit(unit) or unit}"
        return f"{path}={_told(value)}"

    @cached_property
    def _units(self) -> dict[str, str]:
        named = self.to_dict().get("units")
        return named if isinstance(named, dict) else {}

    def _unit(self, unit: str) -> str | None:
        """The file's unit of the dimension of an SI unit, where it says one."""
        return self._units.get(DIMENSIONS.get(unit, ""))

    def run(self, *, strict: bool = True, timeout: float | None = None, progress: Progress = None) -> Run:
        """Runs the model's analysis, with the interpreter's lock released.

        :param strict: whether a run that ends early raises; else its ``status`` says so.
        :param timeout: when to give up [s].
        :param progress: ``True`` shows a bar where tqdm is installed; a function is called with the share that is done.
        :raises SolveError: where the run ended early; ``error.run`` has what was computed.
        :raises Interrupted: where Ctrl-C stopped it; ``error.run`` has what was computed.
        """
        # A run of a few milliseconds leaves the code of Python cold in the caches: what it does here is little.
        if progress is None or progress is False:
            core, stopped = self._core.run(timeout)
        else:
            with told(progress, self.name) as show:
                core, stopped = self._core.run(timeout, show)
        run = Run(core, self)
        if isinstance(stopped, KeyboardInterrupt):
            raise Interrupted("interrupted", run) from stopped
        if stopped is not None:
            raise stopped
        if strict and not core.is_complete:
            raise SolveError(f"the run ended early ({run.status}): {run.message}", run)
        return run

    def family(self, parameters: str | Iterable[str], responses: Mapping[str, str] | None = None) -> Family:
        """The family of mechanisms in which these parameters take other values: the fast way to many variants.

        :param parameters: names, with or without ``parameters.`` before them.
        :param responses: more numbers that come out of each variant, by name; after those of the model.
        """
        model = self.set({f"responses.{name}": text for name, text in responses.items()}) if responses else self
        names = [name.removeprefix("parameters.") for name in as_list(parameters)]
        return Family(model, names)

    def function(self, responses: str | Mapping[str, str], parameters: str | Iterable[str]) -> Function:
        """Responses as a function of parameters, with exact derivatives, for solvers such as those of SciPy.

        :param responses: an expression, whose values are numbers, or expressions by name, whose values are arrays.
        :param parameters: names, with or without ``parameters.`` before them.

        >>> import linkdyn
        >>> stroke = linkdyn.load("slider-crank").function("max(piston.x) - min(piston.x)", "crank")
        >>> round(stroke([0.04]), 9), stroke.jac([0.04]).round(9).tolist()
        (0.08, [2.0])
        """
        is_single = isinstance(responses, str)
        asked = {_ONE: responses} if isinstance(responses, str) else dict(responses)
        return Function(self.family(parameters, asked), list(asked), is_single=is_single)

    def gradient(self, responses: str | Mapping[str, str], parameters: str | Iterable[str]) -> dict[str, Any]:
        """Exact derivatives of responses by parameters, in SI, where the model stands; NaN where one is not known exactly.

        :param responses: an expression, or expressions by name: then there is a dictionary for each name.
        :param parameters: names, with or without ``parameters.`` before them.

        >>> import linkdyn
        >>> slopes = linkdyn.load("slider-crank").gradient("max(piston.x) - min(piston.x)", ["crank", "rod"])
        >>> round(slopes["crank"], 9), abs(slopes["rod"]) < 1e-9
        (2.0, True)
        """
        f = self.function(responses, parameters)
        slopes = f.family.gradient(f.x0[None])[0]
        found = {name: dict(zip(f.parameters, slopes[f.family.names.index(name)].tolist(), strict=True)) for name in f.names}
        return found[_ONE] if isinstance(responses, str) else found

    def compile(self) -> Equations:
        """The equations of the model, for solvers of one's own."""
        return Equations(self._core.equations())

    def simulation(self, steered: Sequence[str] = ()) -> Simulation:
        """The motion of the model's ``dynamics``, at t = 0, to be stepped by the program. Its ``end`` is ignored.

        The acceleration of drivers that are `steered` is set by the program; until then they follow their motions.

        :raises ModelError: where the analysis is not ``dynamics``, or drivers prescribe the whole motion.
        """
        return Simulation(self._core.simulation(list(steered)))

    def check(self) -> Answer:
        """Assembles and diagnoses the model without running it: mobility, loops, what is missing for which analysis.

        >>> import linkdyn
        >>> linkdyn.load("four-bar").check()["mobility"]["rank"]
        1
        """
        return read(whole(_linkdyn.check(self._core)))

    def assemblies(self, at: float = 0.0, *, most: int = 1000) -> Answer:
        """All ways in which the mechanism closes, as in ``assemblies.json``.

        :param at: the instant at which drivers have their values [s].
        :param most: the most assemblies that are looked for.

        >>> import linkdyn
        >>> len(linkdyn.load("four-bar").assemblies()["assemblies"])
        2
        """
        told, _ = whole(_linkdyn.assemblies(self._core, at, most, None))
        return read(told)

    def assembled(self, number: int, at: float = 0.0) -> Model:
        """The model in which one of :meth:`assemblies`, counted from 1, is drawn."""
        _, taken = whole(_linkdyn.assemblies(self._core, at, 1000, number))
        assert taken is not None
        return Model(taken, self._label, taken.to_json().encode())

    def synthesise(self) -> Answer:
        """Linkages for the task of the file, its ``synthesise``, as in ``synthesis.json``.

        Each has a ``model``, which :func:`load` reads.

        >>> import linkdyn
        >>> function = [[0, 0], [20, 9], [40, 21], [60, 36], [80, 55]]
        >>> task = {"format": "linkdyn/1", "units": {"angle": "deg"}, "synthesise": {"function": function}}
        >>> found = linkdyn.load(task).synthesise()
        >>> linkdyn.load(found["linkages"][0]["model"]).name
        'four-bar for a function'
        """
        return read(whole(_linkdyn.synthesise(self._core)))

    def circuits(
        self, driver: str | None = None, *, values: int | None = None, range: tuple[float, float] | None = None
    ) -> Answer:
        """Which assemblies are connected by motion while a driver is led through its values, as in ``circuits.json``.

        :param values: values of the driver at which all assemblies are looked for; 72 where nothing is said.
        :param range: the driver's least and greatest value [rad or m]; a full turn, or what its motion passes, where
            nothing is said.

        >>> import linkdyn
        >>> [circuit["turns_fully"] for circuit in linkdyn.load("four-bar").circuits()["circuits"]]
        [True, True]
        """
        return read(whole(_linkdyn.circuits(self._core, driver, values, range)))

    def workspace(self, point: str, drivers: tuple[str, str] | None = None, *, values: int | None = None) -> Answer:
        """Where two drivers can stand, where assemblies meet, and where a point gets, as in ``workspace.json``.

        :param point: a point of a body, ``coupler.P``.
        :param drivers: both drivers; the only two where nothing is said.
        :param values: values of each at which all assemblies are looked for; 49 where nothing is said.

        >>> import linkdyn
        >>> reach = linkdyn.load("excavator").workspace("bucket.tooth", ("lift", "crowd"), values=7)
        >>> reach["drivers"], reach["complete"]
        (['lift', 'crowd'], True)
        """
        return read(whole(_linkdyn.workspace(self._core, point, drivers, values)))

    def modes(self, *, pose: bool = False) -> Answer:
        """Natural frequencies, damping ratios and shapes of small motions, as in ``modes.json``.

        :param pose: about the assembled position instead of the equilibrium.
        """
        return read(whole(_linkdyn.modes(self._core, pose)))

    @overload
    def linearise(
        self,
        inputs: str | Iterable[str] = (),
        outputs: str | Iterable[str] = (),
        at: float | None = None,
        *,
        pose: bool = False,
    ) -> LinearSystem: ...

    @overload
    def linearise(
        self, inputs: str | Iterable[str] = (), outputs: str | Iterable[str] = (), *, at: Iterable[float]
    ) -> list[LinearSystem]: ...

    def linearise(
        self,
        inputs: str | Iterable[str] = (),
        outputs: str | Iterable[str] = (),
        at: float | Iterable[float] | None = None,
        *,
        pose: bool = False,
    ) -> LinearSystem | list[LinearSystem]:
        """The mechanism as a linear system, as in ``state-space.json``.

        :param inputs: ``driver.NAME`` (its torque or force, the driver being let go), ``driver.NAME.acceleration``,
            ``input.NAME``, ``force.NAME``, ``BODY.POINT.fx``, ``BODY.POINT.fy``, ``BODY.torque``; one may be given alone.
        :param outputs: columns of results, or patterns of them; the positions of the states where none are given.
        :param at: an instant of the motion of the model's analysis [s], or several, each with a system of its own; about the
            equilibrium where there is none.
        :param pose: about the assembled position instead of the equilibrium.
        :raises SolveError: where the point has no linear equations.
        """
        is_one = at is None or isinstance(at, int | float | np.number)
        times = [] if at is None else [float(at)] if isinstance(at, int | float | np.number) else [float(t) for t in at]
        told = whole(_linkdyn.linearise(self._core, as_list(inputs), as_list(outputs), pose, times))
        found = read(told)
        if found["message"] is not None:
            raise SolveError(found["message"])
        systems = [LinearSystem(own) for own in found["systems"]]
        return systems[0] if is_one else systems

    def accuracy(
        self, outputs: str | Iterable[str] = (), levels: str | None = None, *, threads: int | None = None
    ) -> Answer:
        """What tolerances and clearances do to outputs, as in ``accuracy.json``.

        :param outputs: outputs of the model's ``accuracy``, instead of all; one may be given alone.
        :param levels: ``first``, ``worst`` or ``certified``.
        :param threads: one for each processor where nobody says. The answer does not depend on it.
        """
        return read(whole(_linkdyn.accuracy(self._core, as_list(outputs), levels, threads or processors())))

    def allocate(self, outputs: str | Iterable[str] = (), *, rss: bool = False) -> tuple[Answer, Model]:
        """The cheapest tolerances that keep the limits of outputs, as ``allocate --json`` prints, and the model with them.

        :param outputs: outputs of the model's ``accuracy``, instead of all; one may be given alone.
        :param rss: whether variances add up, as for parts that scatter, instead of all at their worst.
        :raises SolveError: where the limits can't be kept.
        """
        told, best = whole(_linkdyn.allocate(self._core, as_list(outputs), rss))
        return read(told), Model(best, self._label, best.to_json().encode())

    def compare(
        self, joints: str | Iterable[str] = "all", models: str | Iterable[str] = (), columns: str | Iterable[str] = ()
    ) -> Answer:
        """Runs the model with each model of a joint's clearance and compares, as in ``compare.json``.

        :param joints: joints with clearance whose model changes; ``all`` that have one.
        :param models: clearance models, the first is what the others are compared with.
        :param columns: patterns of columns to compare.
        """
        return read(whole(_linkdyn.compare(self._core, as_list(joints), as_list(models), as_list(columns))))

    def optimise(
        self,
        vary: Mapping[str, Values | None] | None = None,
        *,
        goals: str | Iterable[str] = (),
        minimise: str | None = None,
        maximise: str | None = None,
        constraints: str | Iterable[str] = (),
        robust: float | None = None,
        starts: int | None = None,
        seed: int | None = None,
        threads: int | None = None,
    ) -> tuple[Answer, Model]:
        """Finds values of parameters: goals, least or greatest objectives, paths. What was found as in ``optimise.json``,
        and the model with it.

        :param vary: range of each parameter, as in ``{"parameters.r": "10 mm:60 mm"}`` or ``("10 mm", "60 mm")``; numbers
            of a pair are in SI, those of a text without unit are in the file's units. ``None``: around the value.
            Without any parameter, what the model says.

        >>> import linkdyn
        >>> press = linkdyn.load("slider-crank")
        >>> _, longer = press.optimise({"parameters.crank": None}, goals=["max(piston.x) - min(piston.x) = 80 mm"])
        >>> round(longer.parameters["crank"][0], 9)
        0.04
        """
        units = self.parameters
        ranges = {name: bounds(values, name, units) for name, values in (vary or {}).items()}
        asked = [_path(name) + (f"={values}" if values else "") for name, values in ranges.items()]
        least, greatest = ([text] if text is not None else [] for text in (minimise, maximise))
        told, failure, best = whole(
            _linkdyn.optimise(
                self._core,
                asked,
                as_list(goals),
                least,
                greatest,
                as_list(constraints),
                robust,
                starts,
                seed,
                threads or processors(),
            )
        )
        if failure is not None or best is None:
            raise SolveError(failure or "nothing was found")
        return read(told), Model(best, self._label, best.to_json().encode())

    def path_time(
        self,
        limits: Mapping[str, str | tuple[str, str]] | None = None,
        *,
        driver: str | None = None,
        start: str | None = None,
        end: str | None = None,
        speed: str | None = None,
        acceleration: str | None = None,
        start_speed: str | None = None,
        end_speed: str | None = None,
        intervals: int | None = None,
    ) -> tuple[Answer, Model]:
        """The fastest motion of a driver along a stroke, as in ``path-time.json``, and the model with this motion.

        :param limits: the limit of each column to both sides, or its lower and upper end, as in
            ``{"driver.motor.effort": ("-2 N*m", "5 N*m"), "joint.*": "300 N"}``.
        :param start: where the stroke begins; where the driver's own motion does.
        :param end: where it ends; where the driver's own motion does.
        :raises SolveError: where no motion keeps the limits.

        >>> import linkdyn
        >>> told, fastest = linkdyn.load("slider-crank").path_time(start="0 deg", end="90 deg", acceleration="8 rad/s^2")
        >>> round(told["time"], 6)
        0.886227
        """
        ends = {name: (value,) if isinstance(value, str) else value for name, value in (limits or {}).items()}
        asked = [f"{name}={':'.join(value)}" for name, value in ends.items()]
        told, best = whole(
            _linkdyn.path_time(self._core, driver, start, end, asked, speed, acceleration, start_speed, end_speed, intervals)
        )
        return read(told), Model(best, self._label, best.to_json().encode())

    def study(
        self,
        vary: Mapping[str, Values] | None = None,
        *,
        samples: int | None = None,
        method: str = "random",
        indices: bool = False,
        seed: int | None = None,
        responses: Mapping[str, str] | None = None,
    ) -> Study:
        """A study of many variants; :meth:`Study.run` computes them.

        :param vary: values of parameters, as in ``{"r": "40 mm:60 mm:21"}`` (from, to, count), ``"40 mm, 50 mm"`` or an
            array, whose numbers are in SI; several multiply. Without any, and without samples, what the model says.
        :param samples: draws so many sets of all parameters that have a tolerance.
        :param method: ``random``, ``sobol`` or ``latin``.
        :param indices: draws what Sobol indices need.
        :param responses: numbers that come out of each variant, besides those of the model.
        """
        units = self.parameters
        asked = Asked(
            vary=tuple((name, one_by_one(values, name, units)) for name, values in (vary or {}).items()),
            samples=samples,
            method=method,
            indices=indices,
            seed=seed,
            responses=tuple(f"{name} = {text}" for name, text in (responses or {}).items()),
        )
        return Study(self, asked)


def _restored(label: str, text: bytes | None, sets: tuple[str, ...]) -> Model:
    core = _linkdyn.Mechanism.bundled(label) if text is None else _linkdyn.Mechanism.read(label, text)
    return Model(core.set(list(sets)) if sets else core, label, text, sets)


def _told(value: Value) -> str:
    return value if isinstance(value, str) else json.dumps(value, default=_plain)


def _path(name: str) -> str:
    return name if "." in name else f"parameters.{name}"


def _plain(value: Any) -> Any:
    """Numbers and arrays of NumPy as those of Python."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Mapping):
        return dict(value)
    raise TypeError(f"{type(value).__name__} can't stand in a model: {value!r}")
