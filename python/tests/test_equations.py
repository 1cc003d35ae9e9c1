"""The equations of a mechanism, held against its runs and against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import linkdyn


def test_terms_of_a_pendulum_are_those_of_the_book() -> None:
    s = linkdyn.load("pendulum").compile()
    assert s.coordinates == ["rod.x", "rod.y", "rod.angle"] and (s.n, s.m) == (3, 2)
    angle, rate = 0.3, 2.0
    q = np.array([np.cos(angle), np.sin(angle), angle])
    terms = s.evaluate(q, [0.0, 0.0, rate])
    assert np.abs(terms.phi).max() < 1e-15 and np.array_equal(terms.rate, [0.0, 0.0])
    # Point mass on a rod: J of (x - cos, y - sin) up to the sign of the rows, gamma from the centripetal acceleration.
    sign = np.sign(terms.jacobian[0, 0])
    assert np.allclose(sign * terms.jacobian, [[1, 0, np.sin(angle)], [0, 1, -np.cos(angle)]], atol=1e-15)
    assert np.allclose(sign * terms.gamma, -(rate**2) * np.array([np.cos(angle), np.sin(angle)]), atol=1e-14)
    assert np.allclose(terms.force, [0, -9.81, 0]) and np.allclose(terms.mass, [1, 1, 0])
    a, _ = terms.accelerations()
    assert a[2] == pytest.approx(-9.81 * np.cos(angle), rel=1e-12)
    assert not terms.values.flags.writeable


def test_matrices_are_those_of_finite_differences() -> None:
    s = linkdyn.load("four-bar").compile()
    q, v, t = s.assemble(t=0.2), np.zeros(s.n), 0.2
    terms = s.evaluate(q, v, t)
    h = 1e-6
    for column in range(s.n):
        step = np.eye(s.n)[column] * h
        difference = (s.evaluate(q + step, v, t).phi - s.evaluate(q - step, v, t).phi) / (2 * h)
        assert np.allclose(terms.jacobian[:, column], difference, atol=1e-8)
    in_time = (s.evaluate(q, v, t + h).phi - s.evaluate(q, v, t - h).phi) / (2 * h)
    assert np.allclose(terms.rate, in_time, atol=1e-6)
    pytest.importorskip("scipy")
    assert np.array_equal(terms.sparse_jacobian().toarray(), terms.jacobian)


def test_positions_that_there_are_not_are_refused() -> None:
    s = linkdyn.load("four-bar").set({"parameters.rocker": "10 mm"}).compile()
    with pytest.raises(linkdyn.SolveError):
        s.assemble()
    with pytest.raises(ValueError, match="numbers each"):
        s.evaluate([0.0], [0.0])
