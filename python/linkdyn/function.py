"""Responses as a function of parameters, with exact derivatives: for the solvers of others."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from .run import Array
from .values import si

if TYPE_CHECKING:
    from .family import Family

__all__ = ["Function"]

_STEP = float(np.cbrt(np.finfo(float).eps))
"""Of central differences, by the size of a parameter."""


class Function:
    """Responses of a mechanism as a function of parameters, all in SI: f(x), and its derivatives ``jac(x)``.

    >>> import linkdyn
    >>> press = linkdyn.load("slider-crank")
    >>> f = press.function({"stroke": "max(piston.x) - min(piston.x)", "least": "min(piston.x)"}, "crank")
    >>> f.x0.tolist()
    [0.05]
    >>> f(f.x0).round(9).tolist(), f.jac(f.x0).round(9).tolist()
    ([0.1, 0.15], [[2.0], [-1.0]])
    """

    family: Family
    """What computes the values."""
    names: list[str]
    """Names of the responses that the values have."""

    def __init__(self, family: Family, names: list[str], *, is_single: bool) -> None:
        self.family = family
        self.names = names
        self._is_single = is_single
        there = family.names
        self._places = [there.index(name) for name in names]

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.family, self.names, self._is_single)

    @property
    def parameters(self) -> list[str]:
        """Names of the parameters, in the order of x."""
        return self.family.parameters

    @property
    def x0(self) -> Array:
        """The values of the model."""
        units = self.family._units
        return np.array([units[name][0] for name in self.parameters])

    def x(self, *values: Any) -> Array:
        """Values as x: numbers in SI, or texts such as ``"90 mm"``."""
        units = self.family._units
        if len(values) != len(self.parameters):
            raise ValueError(f"there are {len(self.parameters)} parameters, not {len(values)}")
        pairs = zip(values, self.parameters, strict=True)
        return np.array([si(value, name, units[name][1]) for value, name in pairs])

    def __call__(self, x: ArrayLike) -> Any:
        """(responses) the values, a number where one text was asked for; NaN where there is none."""
        found = self.family(self._row(x), threads=1)
        return self._told(found.values[0])

    def jac(self, x: ArrayLike) -> Array:
        """(responses, parameters) the derivatives; (parameters) where one text was asked for.

        They are exact where the engine has exact ones, see :meth:`Family.gradient`, else central differences.
        """
        return self.value_and_jac(x)[1]

    def value_and_jac(self, x: ArrayLike) -> tuple[Any, Array]:
        """Both at once, as ``jac=True`` of SciPy wants it."""
        row = self._row(x)
        found, all_slopes = self.family.value_and_gradient(row, threads=1)
        slopes = all_slopes[0].copy()
        rough = np.isnan(slopes[self._places]).any(axis=0)
        if rough.any() and not np.isnan(found.values[0, self._places]).any():
            self._differences(row[0], np.flatnonzero(rough), slopes)
        return self._told(found.values[0]), self._told(slopes)

    def _differences(self, x: Array, columns: np.ndarray[Any, Any], slopes: Array) -> None:
        """Puts differences where no derivative is known."""
        steps = _STEP * np.where(x == 0.0, np.abs(x).max() or 1.0, np.abs(x))[columns]
        moved = np.repeat(x[np.newaxis], 2 * len(columns), axis=0)
        for number, (column, step) in enumerate(zip(columns, steps, strict=True)):
            moved[2 * number : 2 * number + 2, column] += step, -step
        values = self.family(moved).values
        apart = moved[::2] - moved[1::2]
        for number, column in enumerate(columns):
            slope = (values[2 * number] - values[2 * number + 1]) / apart[number, column]
            missing = np.isnan(slopes[:, column])
            slopes[missing, column] = slope[missing]

    def _row(self, x: ArrayLike) -> Array:
        return np.asarray(x, dtype=np.float64).reshape(1, len(self.parameters))

    def _told(self, values: Array) -> Any:
        chosen = values[self._places]
        if not self._is_single:
            return chosen
        return float(chosen[0]) if chosen.ndim == 1 else chosen[0]


def _restored(family: Family, names: list[str], is_single: bool) -> Function:
    return Function(family, names, is_single=is_single)
