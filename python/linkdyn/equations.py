"""The equations of a mechanism, for those who write their own solver.

::

    M a + Jᵀ λ = Q + F     J a = γ     J v = −φ_t     φ = 0

q are x, y of the centre of mass [m] and the angle [rad] of each body, v and a their derivatives, F what is added from
outside. Multipliers λ are what the first body of a joint exerts on the second, and efforts of drivers.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from . import _linkdyn
from .errors import SolveError
from .run import Array

if TYPE_CHECKING:
    from scipy.sparse import csr_array

__all__ = ["Equations", "Terms"]

# Steps of Newton's iteration that a position near a solution never needs.
_MOST_STEPS = 50
# Where it has closed, as part of the mechanism's own length [1].
_CLOSED = 1e-12


@dataclass(frozen=True)
class Terms:
    """The terms of the equations at a state; all arrays are read-only."""

    phi: Array
    """φ (m): constraints, joints before drivers [m or rad]."""
    rate: Array
    """φ_t (m): J v = −φ_t."""
    gamma: Array
    """γ (m): J a = γ."""
    force: Array
    """Q (n): gravity, springs, loads, contacts [N, N·m]."""
    mass: Array
    """Diagonal of M (n) [kg, kg·m²]."""
    rows: list[int]
    """Rows of the entries of J."""
    columns: list[int]
    """Columns of the entries of J."""
    values: Array
    """Values of the entries of J."""

    @cached_property
    def jacobian(self) -> Array:
        """J = ∂φ/∂q (m, n), dense."""
        dense = np.zeros((len(self.phi), len(self.force)))
        np.add.at(dense, (self.rows, self.columns), self.values)
        return dense

    def sparse_jacobian(self) -> csr_array:
        """J as a sparse array of SciPy (m, n)."""
        from scipy.sparse import coo_array

        shape = (len(self.phi), len(self.force))
        return coo_array((self.values, (self.rows, self.columns)), shape=shape).tocsr()

    def accelerations(self, force: ArrayLike | None = None) -> tuple[Array, Array]:
        """a (n) and λ (m), with more forces F (n); where constraints are redundant, those λ of least norm."""
        n, m = len(self.force), len(self.phi)
        matrix = np.zeros((n + m, n + m))
        matrix[range(n), range(n)] = self.mass
        matrix[n:, :n] = self.jacobian
        matrix[:n, n:] = self.jacobian.T
        right = np.concatenate([self.force if force is None else self.force + np.asarray(force), self.gamma])
        try:
            found = np.linalg.solve(matrix, right)
        except np.linalg.LinAlgError:
            found = np.linalg.lstsq(matrix, right)[0]
        return found[:n], found[n:]


class Equations:
    """The equations that a model is compiled to.

    >>> import linkdyn
    >>> s = linkdyn.load("pendulum").compile()
    >>> q = s.assemble()
    >>> terms = s.evaluate(q, s.project(q, [0.0] * s.n), 0.0)
    >>> terms.jacobian.shape
    (2, 3)
    """

    def __init__(self, core: _linkdyn.Equations) -> None:
        self._core = core

    @cached_property
    def coordinates(self) -> list[str]:
        """Names of the coordinates (n): ``body.x``, ``body.y`` of the centre of mass, ``body.angle``."""
        return self._core.coordinates

    @property
    def n(self) -> int:
        """Number of coordinates."""
        return len(self.coordinates)

    @property
    def m(self) -> int:
        """Number of rows of constraints; those of drivers come last."""
        return self._core.rows[0]

    @property
    def guess(self) -> Array:
        """Coordinates (n) where the file draws the bodies."""
        return np.array(self._core.guess)

    def evaluate(self, q: ArrayLike, v: ArrayLike, t: float = 0.0) -> Terms:
        """The terms at coordinates and velocities (n) and a time [s].

        Clearance links are closed, and contacts begin at this state: what they would remember is not known.
        """
        q, v = np.ascontiguousarray(q, dtype=np.float64), np.ascontiguousarray(v, dtype=np.float64)
        rows, columns, told = self._core.terms(q, v, float(t))
        values, phi, rate, gamma, force, mass = (np.asarray(one) for one in told)
        return Terms(phi, rate, gamma, force, mass, rows, columns, values)

    def assemble(self, q: ArrayLike | None = None, t: float = 0.0) -> Array:
        """The position nearby where all constraints close (n), by Newton's iteration with steps of least norm.

        :raises SolveError: where it finds none.
        """
        at = self.guess if q is None else np.array(q, dtype=np.float64)
        still = np.zeros(self.n)
        for _ in range(_MOST_STEPS):
            terms = self.evaluate(at, still, t)
            if not np.isfinite(terms.phi).all():
                break
            step = np.linalg.lstsq(terms.jacobian, -terms.phi)[0]
            at += step
            if np.abs(step).max(initial=0.0) <= _CLOSED * max(1.0, float(np.abs(at).max(initial=0.0))):
                return at
        raise SolveError("no position was found in which all constraints close")

    def project(self, q: ArrayLike, v: ArrayLike, t: float = 0.0) -> Array:
        """The velocities nearest to v that the constraints allow (n)."""
        terms = self.evaluate(q, v, t)
        speed: Array = np.array(v, dtype=np.float64)
        speed += np.linalg.lstsq(terms.jacobian, -terms.rate - terms.jacobian @ speed)[0]
        return speed
