"""Functional mock-up units in an importer that is not ours: FMPy, which also checks their descriptions."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

import linkdyn
from linkdyn import _linkdyn

fmpy = pytest.importorskip("fmpy")
LIBRARY = os.environ.get("LINKDYN_FMU_LIBRARY", "")
pytestmark = pytest.mark.skipif(not LIBRARY, reason="LINKDYN_FMU_LIBRARY does not name the library of units")

TIGHT = ["--set", "analysis.solver.rtol=1e-11", "--set", "analysis.solver.atol=1e-13"]

# A wheel that a torque turns against a torsion spring.
WHEEL = """{ "format": "linkdyn/1", "units": "SI", "parameters": { "inertia": "2 kg*m^2" },
  "bodies": { "ground": { "points": { "O": [0, 0] } },
    "wheel": { "mass": 1, "inertia": "=inertia", "com": [0, 0], "points": { "O": [0, 0] } } },
  "joints": { "pin": { "type": "revolute", "between": ["ground.O", "wheel.O"] } },
  "inputs": { "torque": "0 N*m" },
  "forces": { "motor": { "type": "torque", "body": "wheel", "value": "=input.torque" } },
  "analysis": { "type": "dynamics", "end": 1, "outputs": 11 } }"""


def export(path: Path, model: str, *options: str) -> str:
    unit = str(path / "unit.fmu")
    said, _ = _linkdyn.command(["export", model, "--fmu", "--library", LIBRARY, "-o", unit, *options])
    assert said.status == 0, said.stderr
    return unit


@pytest.mark.parametrize("version", ["2", "3"])
@pytest.mark.parametrize("model", ["double-pendulum", "slider-crank-clearance", "toggle-clamp"])
def test_a_unit_moves_as_a_run_does(tmp_path: Path, model: str, version: str) -> None:
    unit = export(tmp_path, model, "--fmi", version, *TIGHT)
    from fmpy.validation import validate_fmu

    assert validate_fmu(unit) == []
    about = fmpy.read_model_description(unit)
    outputs = [one.name for one in about.modelVariables if one.causality == "output"]
    step, stop = float(about.defaultExperiment.stepSize), float(about.defaultExperiment.stopTime)
    mechanism = linkdyn.load(model).set("analysis.solver.rtol", 1e-11).set("analysis.solver.atol", 1e-13)
    run = mechanism.run()
    # Impacts on impacts make every error larger, and so the end of a long motion anyone's.
    stop = min(stop, 20 * step)
    found = fmpy.simulate_fmu(unit, stop_time=stop, output_interval=step, output=outputs)
    rows = len(found)
    assert rows == 21
    np.testing.assert_allclose(found["time"], run["time"][:rows], atol=1e-12)
    for name in outputs[:-1]:
        expected = run[name][:rows]
        size = np.abs(expected).max()
        assert np.abs(found[name] - expected).max() <= 1e-9 * size, name


@pytest.mark.parametrize("version", ["2", "3"])
def test_inputs_and_parameters_of_a_unit(tmp_path: Path, version: str) -> None:
    (tmp_path / "wheel.json").write_text(WHEEL)
    unit = export(tmp_path, str(tmp_path / "wheel.json"), "--fmi", version, "--output", "wheel.omega")
    times = np.array([0.0, 1.0])
    signals = np.array([(time, 6.0) for time in times], dtype=[("time", float), ("input.torque", float)])
    found = fmpy.simulate_fmu(
        unit,
        stop_time=1,
        output_interval=0.1,
        start_values={"parameters.inertia": 3.0},
        input=signals,
        output=["wheel.omega"],
    )
    np.testing.assert_allclose(found["wheel.omega"], 2 * found["time"], atol=1e-12)
