"""A simulation that the program steps: a controller, a co-simulation, a game.

::

    M a + Jᵀ λ = Q + F

q are x, y of the centre of mass [m] and the angle [rad] of each body, F (n) forces from outside: per body a force at its
centre of mass [N] and a torque [N·m]. A force f at a point that stands (dx, dy) from the centre of mass has the torque
dx f_y - dy f_x.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _linkdyn
from .errors import Interrupted, UnknownName
from .run import Array

__all__ = ["Checkpoint", "Simulation"]

Checkpoint = _linkdyn.Checkpoint
"""A point to which a simulation can go back."""


class Simulation:
    """The motion of a model at an instant, which can be stepped on. :meth:`Model.simulation` makes it.

    >>> import linkdyn
    >>> s = linkdyn.load("pendulum").simulation()
    >>> events = s.step_to(0.5)
    >>> s.time, bool(s["rod.angle"] == s.q[2])
    (0.5, True)
    """

    def __init__(self, core: _linkdyn.Simulation) -> None:
        self._core = core
        self.coordinates: list[str] = core.coordinates
        """Names of the coordinates (n): ``body.x``, ``body.y`` of the centre of mass, ``body.angle``."""

    @property
    def time(self) -> float:
        """The instant [s]."""
        return self._core.time

    @property
    def q(self) -> Array:
        """Coordinates (n) [m, rad]."""
        return np.array(self._core.position)

    @property
    def v(self) -> Array:
        """Their rates (n) [m/s, rad/s]."""
        return np.array(self._core.velocity)

    def __getitem__(self, column: str) -> float:
        """The value of a result column; NaN where it does not exist."""
        return self._core.value(column)

    def set_forces(self, forces: ArrayLike | Mapping[str, float]) -> None:
        """F from now on, until it is set again: all of it (n), or by names of coordinates, the others zero.

        >>> import linkdyn
        >>> s = linkdyn.load("pendulum").simulation()
        >>> s.set_forces({"rod.angle": 2.5})
        """
        if isinstance(forces, Mapping):
            unknown = [name for name in forces if name not in self.coordinates]
            if unknown:
                raise UnknownName(f"no coordinate is called {unknown[0]!r}; there are {', '.join(self.coordinates)}")
            forces = [forces.get(name, 0.0) for name in self.coordinates]
        self._core.set_forces(np.ascontiguousarray(forces, dtype=np.float64))

    @property
    def inputs(self) -> dict[str, float]:
        """Values of the model's inputs, in SI units."""
        return {name: self._core.input(name) for name in self._core.inputs()}

    def set_input(self, name: str, value: float) -> None:
        """Set an input of the model, in SI units: constant from now on, until it is set again."""
        self._core.set_input(name, value)

    def set_acceleration(self, driver: str, acceleration: float) -> None:
        """Set the acceleration of a driver [rad/s² or m/s²]: it goes on from its value and rate.

        The simulation must have been begun with it: ``model.simulation(steered=["motor"])``.
        """
        self._core.set_acceleration(driver, acceleration)

    def set_law(self, law: Callable[[Array, Array, float], ArrayLike]) -> None:
        """F(q, v, t) (n) from now on: a smooth function without memory, which is called at every evaluation within steps."""

        def asked(t: float, q: object, v: object) -> Array:
            return np.ascontiguousarray(law(np.asarray(q), np.asarray(v), t), dtype=np.float64)

        self._core.set_law(asked)

    def step_to(self, time: float) -> list[dict[str, Any]]:
        """Steps to a later instant [s], which is met exactly. Returns what happened on the way, as in ``events`` of
        ``summary.json``: an impact with its ``approach_speed`` and ``impulse``, a touch when it is over.

        :raises SolveError: where the motion can't go on.
        """
        return self._step(time, False)

    def step_to_event(self, time: float) -> list[dict[str, Any]]:
        """The same, but stops at the first event; nothing where it came to ``time``."""
        return self._step(time, True)

    def _step(self, time: float, stops_at_events: bool) -> list[dict[str, Any]]:
        events, stopped = self._core.step(float(time), stops_at_events)
        if isinstance(stopped, KeyboardInterrupt):
            raise Interrupted("interrupted") from stopped
        if stopped is not None:
            raise stopped
        return [json.loads(event) for event in events]

    def checkpoint(self) -> Checkpoint:
        """Keeps the motion as it is, with the forces that act."""
        return self._core.checkpoint()

    def restore(self, checkpoint: Checkpoint) -> None:
        """Goes back to where it was. The same steps lead to the same values from there, bit by bit.

        >>> import linkdyn
        >>> s = linkdyn.load("pendulum").simulation()
        >>> start = s.checkpoint()
        >>> events = s.step_to(0.5)
        >>> s.restore(start)
        >>> s.time
        0.0
        """
        self._core.restore(checkpoint)
