"""Functional mock-up units in an importer that is not ours: FMPy, which also checks their descriptions."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

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
    mechanism = linkdyn.load(model).set({"analysis.solver.rtol": 1e-11, "analysis.solver.atol": 1e-13})
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


def test_a_state_leads_to_the_same_bits_in_another_instance(tmp_path: Path) -> None:
    from fmpy.fmi3 import FMU3Slave

    unit = export(tmp_path, "slider-crank-clearance")
    about = fmpy.read_model_description(unit)
    folder = fmpy.extract(unit, str(tmp_path / "unit"))
    references = [one.valueReference for one in about.modelVariables if one.type == "Float64"]
    step = float(about.defaultExperiment.stepSize)

    def begun() -> Any:
        instance = FMU3Slave(
            guid=about.guid,
            unzipDirectory=folder,
            modelIdentifier=about.coSimulation.modelIdentifier,
            instanceName="one",
        )
        instance.instantiate()
        instance.enterInitializationMode()
        instance.exitInitializationMode()
        return instance

    def walk(instance: Any, begin: int, end: int) -> list[list[float]]:
        rows = []
        for index in range(begin, end):
            instance.doStep(currentCommunicationPoint=index * step, communicationStepSize=step)
            rows.append(instance.getFloat64(references))
        return rows

    one, other = begun(), begun()
    walk(one, 0, 40)
    state = one.getFMUState()
    expected = walk(one, 40, 120)
    one.setFMUState(state)
    assert walk(one, 40, 120) == expected
    taken = other.deserializeFMUState(one.serializeFMUState(state))
    other.setFMUState(taken)
    assert walk(other, 40, 120) == expected
    for instance, kept in ((one, state), (other, taken)):
        instance.freeFMUState(kept)
        instance.terminate()
        instance.freeInstance()


def test_steps_end_at_events_where_the_importer_takes_part(tmp_path: Path) -> None:
    unit = export(tmp_path, "solar-array")
    found = fmpy.simulate_fmu(unit, stop_time=10, output_interval=0.5, early_return_allowed=True, use_event_mode=True)
    times = found["time"]
    between = times[np.abs(times / 0.5 - np.round(times / 0.5)) > 1e-6]
    events = [event["time"] for event in linkdyn.load("solar-array").run().events if event["time"] < 10]
    for event in events:
        assert np.abs(between - event).min() < 1e-6, (event, between)
