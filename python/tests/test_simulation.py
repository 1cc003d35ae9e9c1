"""Simulations that are stepped: beside runs, closed forms, and themselves from a checkpoint."""

from __future__ import annotations

import json

import numpy as np
import pytest

import linkdyn

BALL = {
    "format": "linkdyn/1",
    "units": "SI",
    "gravity": [0, -9.81],
    "bodies": {
        "ground": {"points": {"O": [0, 0]}},
        "ball": {"mass": 2, "inertia": 0.1, "com": [0, 0], "points": {"P": [0, 0]}, "pose": {"position": [0, 0.8]}},
    },
    "joints": {
        "guide": {
            "type": "prismatic",
            "between": ["ground.O", "ball.P"],
            "axis": [0, 1],
            "limits": [0, 2],
            "restitution": 0.5,
        }
    },
    "initial": {"ball": {"y": 0.8, "vy": 0}},
    "analysis": {"type": "dynamics", "end": 1, "outputs": 11},
}


def test_it_goes_as_the_run_does() -> None:
    m = linkdyn.load("double-pendulum").set({"analysis.end": 0.5, "analysis.outputs": 6})
    r, s = m.run(), m.simulation()
    for row, time in enumerate(r.t):
        s.step_to(float(time))
        for place, name in enumerate(s.coordinates):
            if name.endswith("angle"):
                assert s.q[place] == pytest.approx(r[name][row], abs=1e-6)
                assert s[name] == s.q[place]


def upright() -> linkdyn.Model:
    start = {"initial.rod.angle": 0, "bodies.rod.pose.angle": 0}
    return linkdyn.load("pendulum").set(start)


# A torque that balances gravity and drives a pendulum to rest at 30 degrees:
# theta'' = -8 (theta - goal) - 5 theta', exact for a unit mass on a unit rod.
GOAL = float(np.deg2rad(30.0))


def torque(q: np.ndarray, v: np.ndarray, t: float) -> np.ndarray:
    return np.array([0.0, 0.0, 9.81 * np.cos(q[2]) - 8.0 * (q[2] - GOAL) - 5.0 * v[2]])


def exact(t: float) -> float:
    roots = np.roots([1.0, 5.0, 8.0])
    weights = np.linalg.solve(np.array([np.ones(2), roots]), np.array([-GOAL, 0.0]))
    return GOAL + float(np.real(weights @ np.exp(roots * t)))


def test_a_law_takes_part_within_steps() -> None:
    s = upright().simulation()
    s.set_law(torque)
    for k in range(1, 61):
        s.step_to(0.1 * k)
        assert s.q[2] == pytest.approx(exact(0.1 * k), abs=1e-6)


def test_a_controller_samples_and_holds() -> None:
    s = upright().simulation()
    for k in range(600):
        s.set_forces(torque(s.q, s.v, s.time))
        s.step_to(0.01 * (k + 1))
    assert s.q[2] == pytest.approx(GOAL, abs=1e-3)
    s.set_forces({"rod.angle": 1.0})
    with pytest.raises(linkdyn.UnknownName, match=r"rod\.x"):
        s.set_forces({"rod.z": 1.0})
    with pytest.raises(ValueError, match="3 numbers"):
        s.set_forces([1.0])


def test_impacts_are_told_as_they_happen() -> None:
    s = linkdyn.load(BALL).simulation()
    speed, time = np.sqrt(2 * 9.81 * 0.8), np.sqrt(2 * 0.8 / 9.81)
    for _ in range(3):
        (event,) = s.step_to_event(10.0)
        assert (event["type"], event["joint"], event["stop"]) == ("contact", "guide", "lower")
        assert s.time == event["time"] == pytest.approx(time, abs=1e-9)
        assert event["approach_speed"] == pytest.approx(speed, abs=1e-8)
        assert event["impulse"] == pytest.approx(2 * 1.5 * speed, abs=1e-8)
        speed /= 2
        time += 2 * speed / 9.81


def test_from_a_checkpoint_it_goes_on_bit_by_bit() -> None:
    s = linkdyn.load("slider-crank-clearance").simulation()
    s.step_to(0.002)
    there = s.checkpoint()

    def walk() -> tuple[str, bytes]:
        told = [event for k in range(10) for event in s.step_to(0.002 + 0.001 * (k + 1))]
        return json.dumps(told), s.q.tobytes()

    once = walk()
    s.restore(there)
    assert s.time == 0.002 and walk() == once


def test_a_law_that_fails_is_raised() -> None:
    s = upright().simulation()

    def fails(q: np.ndarray, v: np.ndarray, t: float) -> np.ndarray:
        raise ZeroDivisionError("in the law")

    s.set_law(fails)
    with pytest.raises(ZeroDivisionError, match="in the law"):
        s.step_to(1.0)


def test_what_can_not_be_stepped_says_why() -> None:
    with pytest.raises(linkdyn.ModelError, match=r"analysis\.type"):
        linkdyn.load("four-bar").simulation()
    s = linkdyn.load("pendulum").simulation()
    s.step_to(1.0)
    with pytest.raises(linkdyn.ModelError, match="does not step back"):
        s.step_to(0.5)
