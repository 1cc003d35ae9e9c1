"""Values as they are given: texts say their unit, numbers are in SI."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _linkdyn
from .errors import UnitError

__all__ = ["DIMENSIONS", "Units", "Values", "as_list", "bounds", "one_by_one", "si", "table"]

Values: TypeAlias = "ArrayLike | Sequence[object]"
"""A text such as ``"90 mm"``, a number in SI, or an array of these."""
Units: TypeAlias = "Mapping[str, tuple[float, str]]"
"""Value in SI and SI unit of each parameter."""

DIMENSIONS = {
    "m": "length",
    "rad": "angle",
    "kg": "mass",
    "kg*m^2": "inertia",
    "N": "force",
    "N*m": "torque",
    "N/m": "stiffness",
    "N*s/m": "damping",
    "N*m/rad": "angular_stiffness",
    "N*m*s/rad": "angular_damping",
    "m/s": "velocity",
    "rad/s": "angular_velocity",
    "m/s^2": "acceleration",
    "rad/s^2": "angular_acceleration",
    "s": "time",
    "Pa": "stress",
}
"""How ``units`` of a file calls what is in an SI unit."""


def si(value: Any, name: str, unit: str) -> float:
    """A value of a parameter in SI, which a text gives with its unit.

    :raises UnitError: where a text says no quantity of this dimension.

    >>> si("90 mm", "crank", "m")
    0.09
    """
    if not isinstance(value, str):
        return float(value)
    try:
        number, own = _linkdyn.quantity(value)
    except ValueError as error:
        raise UnitError(f"{name}: {error}") from error
    if own != unit:
        kinds = [f"in {one}" if one else "a plain number" for one in (own, unit)]
        raise UnitError(f"{name}: {value!r} is {kinds[0]}, {name} is {kinds[1]}")
    return number


def table(values: Values, parameters: Sequence[str], units: Units) -> NDArray[np.float64]:
    """Values (variants, parameters) in SI, of one parameter also (variants)."""
    try:
        rows = np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        told = np.array(values, dtype=object)
        if told.ndim == 1 and len(parameters) == 1:
            told = told[:, np.newaxis]
        if told.ndim != 2 or told.shape[1] != len(parameters):
            raise ValueError(f"values have the shape (variants, {len(parameters)}), not {told.shape}") from None
        columns = [[si(own, name, units[name][1]) for own in told[:, k]] for k, name in enumerate(parameters)]
        return np.array(columns, dtype=np.float64).T.copy()
    return rows[:, np.newaxis] if rows.ndim == 1 and len(parameters) == 1 else rows


def one_by_one(values: Values, name: str, units: Units) -> str:
    """Values of a study as its text: as they are, or one by one."""
    return values if isinstance(values, str) else ", ".join(_texts(values, name, units))


def bounds(values: Values | None, name: str, units: Units) -> str | None:
    """The range of a search as its text: as it is, or of lower and upper bound."""
    if values is None or isinstance(values, str):
        return values
    ends = _texts(values, name, units)
    if len(ends) != 2:
        raise ValueError(f"{name}: a range is a lower and an upper bound, not {len(ends)} values")
    return ":".join(ends)


def as_list(names: str | Iterable[str]) -> list[str]:
    """Names, of which one may be given alone."""
    return [names] if isinstance(names, str) else list(names)


def _texts(values: Values, name: str, units: Units) -> list[str]:
    # What no parameter is called has no unit, and is refused with the names that there are.
    unit = units.get(name.removeprefix("parameters."), (0.0, ""))[1]
    each = np.array(values, dtype=object).ravel()
    return [one if isinstance(one, str) else f"{float(one)!r} {unit}".rstrip() for one in each]
