"""Derivatives of responses: exact, and what solvers of others need."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

import linkdyn

ALL = ["base", "crank", "coupler", "rocker"]
EXPRESSIONS = {
    "swing": "max(rocker.angle) - min(rocker.angle)",
    "top": "max(coupler.P.y)",
    "torque": "max(abs(driver.motor.effort))",
    "push": "rms(joint.a.fx)",
    "mean": "mean(coupler.P.x)",
    "speed": "last(rocker.omega)",
    "there": "at(coupler.P.x, driver.motor = 75 deg)",
}


def differences(f: linkdyn.Function) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Central differences of order eight (responses, parameters)."""
    weights = [4 / 5, -1 / 5, 4 / 105, -1 / 280]
    columns = []
    for number, value in enumerate(f.x0):
        step = 2e-3 * value * np.eye(len(f.x0))[number]
        apart = [f(f.x0 + k * step) - f(f.x0 - k * step) for k in range(1, 5)]
        columns.append(sum(weight * own for weight, own in zip(weights, apart, strict=True)) / (2e-3 * value))
    return np.column_stack(columns)


def test_derivatives_are_those_of_differences() -> None:
    f = linkdyn.load("four-bar").function(EXPRESSIONS, ALL)
    slopes = f.jac(f.x0)
    assert slopes.shape == (7, 4)
    # Exact: none of these is a difference itself.
    assert np.array_equal(slopes, f.family.gradient([f.x0])[0])
    wanted = differences(f)
    assert np.all(np.abs(slopes - wanted) <= 1e-8 * np.abs(wanted).max(axis=1, keepdims=True))


def test_derivatives_by_masses_and_at_zero() -> None:
    numbers: dict[str, Any] = {"parameters.mass": "0.7 kg", "parameters.off": "0 mm"}
    places: dict[str, Any] = {"bodies.piston.mass": "=mass", "bodies.crank.points.A": ["=crank", "=off"]}
    model = linkdyn.load("slider-crank").set(numbers | places)
    slopes = model.gradient({"least": "min(piston.ax)", "force": "max(abs(joint.cylinder.fy))"}, ["crank", "mass", "off"])
    for name, text in {"least": "min(piston.ax)", "force": "max(abs(joint.cylinder.fy))"}.items():
        for number, parameter in enumerate(["crank", "mass", "off"]):
            f = model.function(text, ["crank", "mass", "off"])
            step = 1e-4 * (f.x0[number] or 0.05) * np.eye(3)[number]
            wanted = (8 * (f(f.x0 + step) - f(f.x0 - step)) - f(f.x0 + 2 * step) + f(f.x0 - 2 * step)) / (12 * step.sum())
            assert slopes[name][parameter] == pytest.approx(wanted, rel=1e-8, abs=1e-8), (name, parameter)


def test_derivatives_of_an_equilibrium() -> None:
    f = linkdyn.load("four-bar-spring").function({"lean": "last(left.angle)", "push": "last(joint.a.fx)"}, ["side", "rho"])
    slopes = f.family.gradient([f.x0])[0]
    wanted = differences(f)
    assert np.isfinite(slopes).all() and np.all(np.abs(slopes - wanted) <= 1e-8 * np.abs(wanted).max(axis=1, keepdims=True))


def test_a_gradient_by_name() -> None:
    press = linkdyn.load("slider-crank")
    stroke = "max(piston.x) - min(piston.x)"
    assert press.gradient(stroke, "parameters.crank") == {"crank": pytest.approx(2.0, abs=1e-12)}
    told = press.gradient({"stroke": stroke}, ["crank", "rod"])
    assert told["stroke"] == {"crank": pytest.approx(2.0, abs=1e-12), "rod": pytest.approx(0.0, abs=1e-9)}
    many = press.family("crank", {"stroke": stroke}).gradient(np.linspace(0.03, 0.06, 50), threads=2)
    assert many.shape == (50, 1, 1) and np.allclose(many, 2.0, rtol=0, atol=1e-11)


def test_what_has_no_exact_derivative_is_told_and_differenced() -> None:
    f = linkdyn.load("slider-crank").function({"when": "argmax(piston.vx)", "stroke": "max(piston.x)"}, ["crank", "rod"])
    exact = f.family.gradient([f.x0])[0]
    assert np.isnan(exact[0]).all() and np.isfinite(exact[1]).all()
    slopes = f.jac(f.x0)
    assert np.isfinite(slopes).all() and np.array_equal(slopes[1], exact[1])
    step = np.array([1e-4, 0.0])
    assert slopes[0, 0] == pytest.approx((f(f.x0 + step)[0] - f(f.x0 - step)[0]) / 2e-4, rel=1e-4)
    # Values that no mechanism has are no numbers, and neither are their derivatives.
    value, slope = f.value_and_jac([0.5, 0.2])
    assert np.isnan(value).all() and np.isnan(slope).all()


def test_scipy_finds_the_goals_of_a_four_bar() -> None:
    optimize = pytest.importorskip("scipy.optimize")
    goals = {name: EXPRESSIONS[name] for name in ("swing", "top")}
    f = pickle.loads(pickle.dumps(linkdyn.load("four-bar").function(goals, ["crank", "rocker"])))
    wanted = f.x("90 mm", "215 mm")
    goal = f(wanted)
    tight = dict.fromkeys(("ftol", "xtol", "gtol"), 1e-15)
    found = optimize.least_squares(lambda x: f(x) - goal, f.x0, jac=f.jac, x_scale=f.x0, **tight)
    assert found.nfev <= 15 and np.allclose(found.x, wanted, rtol=0, atol=1e-12)
    root = optimize.root(lambda x: f(x) - goal, f.x0, jac=f.jac)
    assert root.nfev <= 15 and np.allclose(root.x, wanted, rtol=0, atol=1e-9)


def test_scipy_finds_a_least_value() -> None:
    optimize = pytest.importorskip("scipy.optimize")
    f = linkdyn.load("four-bar").function(EXPRESSIONS["torque"], ["crank", "rocker"])
    found = optimize.minimize(f.value_and_jac, f.x0, jac=True, method="L-BFGS-B", bounds=[(0.08, 0.11), (0.18, 0.22)])
    assert found.success and found.nfev <= 15 and found.fun < f(f.x0)
