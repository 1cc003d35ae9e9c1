"""Mechanisms as linear systems."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

import linkdyn
from linkdyn import _linkdyn

# m x'' + c x' + k x = f
MASS: dict[str, Any] = {
    "format": "linkdyn/1",
    "units": "SI",
    "gravity": [0, 0],
    "bodies": {
        "ground": {"points": {"O": [0, 0]}},
        "mass": {"mass": 2.5, "inertia": 1, "com": [0, 0], "points": {"P": [0, 0]}, "pose": {"position": [0.3, 0]}},
    },
    "joints": {"g": {"type": "prismatic", "between": ["ground.O", "mass.P"], "axis": [1, 0]}},
    "forces": {
        "s": {"type": "spring", "between": ["ground.O", "mass.P"], "stiffness": 400, "damping": 12, "free_length": 0.2}
    },
}


def test_a_mass_on_a_spring() -> None:
    system = linkdyn.load(MASS).linearise("mass.P.fx", ["mass.x", "mass.ax"])
    assert (system.states, system.inputs, system.outputs) == (
        ["mass.x", "mass.x.rate"],
        ["mass.P.fx"],
        ["mass.x", "mass.ax"],
    )
    assert np.allclose(system.A, np.array([[0, 1], [-160, -4.8]]), rtol=1e-12, atol=0)
    assert np.allclose(system.B, np.array([[0], [0.4]]), rtol=1e-12, atol=0)
    assert np.allclose(system.C, np.array([[1, 0], [-160, -4.8]]), rtol=1e-12, atol=0)
    assert np.allclose(system.D, np.array([[0], [0.4]]), rtol=1e-12, atol=0)
    assert np.allclose([system.x0[0], *system.u0, *system.dx0], [0.2, 0, 0, 0], atol=1e-12)
    assert np.allclose(np.sort_complex(system.poles), np.sort_complex(np.linalg.eigvals(system.A)))
    omega = np.array([0.0, 5.0, 12.6, 100.0])
    exact = 1 / (400 - 2.5 * omega**2 + 12j * omega)
    response = system.frequency_response(omega)
    assert response.shape == (4, 2, 1)
    assert np.allclose(response[:, 0, 0], exact, rtol=1e-11, atol=0)
    assert np.allclose(response[:, 1, 0], -(omega**2) * exact, rtol=1e-11, atol=1e-15)
    gain = system.gain
    assert gain is not None and abs(gain[0, 0] * 400 - 1) < 1e-11
    assert system.units["mass.P.fx"] == "N" and "mass.x" in repr(system)


def test_it_is_that_of_the_command() -> None:
    options = ["--state-space", "--inputs", "driver.motor", "--outputs", "rocker.angle", "joint.b.fx", "--at", "0.3"]
    said, _ = _linkdyn.command(["modes", "four-bar", *options, "--json"])
    told = json.loads(said.stdout)["systems"][0]
    bar = linkdyn.load("four-bar")
    system = bar.linearise(["driver.motor"], ["rocker.angle", "joint.b.fx"], at=0.3)
    assert system.answer == told and system.time == 0.3
    several = bar.linearise("driver.motor", "rocker.angle", at=[0.1, 0.3])
    assert [own.time for own in several] == [0.1, 0.3]
    assert np.array_equal(several[1].C[0], system.C[0])


def test_scipy_has_the_same_response() -> None:
    signal = pytest.importorskip("scipy.signal")
    system = linkdyn.load(MASS).linearise("mass.P.fx", "mass.x")
    omega, response = signal.freqresp(system.to_scipy(), [1.0, 10.0])
    assert np.allclose(response, system.frequency_response(omega)[:, 0, 0], rtol=1e-12)


def test_control_has_the_same_response() -> None:
    pytest.importorskip("control")
    system = linkdyn.load(MASS).linearise("mass.P.fx", "mass.x")
    other = system.to_control()
    assert other.input_labels == ["mass_P_fx"]
    assert np.allclose(other(10j), system.frequency_response(10.0)[0, 0])


def test_figures() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    system = linkdyn.load(MASS).linearise(["mass.P.fx", "force.s"], ["mass.x", "mass.vx"])
    figure = system.bode()
    assert [len(ax.lines) for ax in figure.axes] == [2, 2, 2, 2]
    drawn = system.nyquist([1.0, 2.0])
    assert drawn.lines[0].get_label() == "mass.x by mass.P.fx"


def test_what_is_not_there_is_told() -> None:
    model = linkdyn.load(MASS)
    with pytest.raises(linkdyn.LinkdynError, match=r'input "mass\.P\.fz": inputs are called driver\.NAME'):
        model.linearise("mass.P.fz")
    with pytest.raises(linkdyn.ModelError, match="no motion to linearise along"):
        model.linearise(at=0.1)
