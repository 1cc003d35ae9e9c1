"""Models built in Python are those of files."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import linkdyn

MODELS = [name for name in linkdyn.models() if "," not in name]


def rebuilt(words: dict[str, object]) -> linkdyn.Mechanism:
    """The model of a file, by the methods of the builder."""
    made = linkdyn.Mechanism(units=words["units"])
    for key, value in words.items():
        match key, value:
            case "parameters", dict():
                for name, one in value.items():
                    made = made.parameter(name, **one) if isinstance(one, dict) else made.parameter(name, one)
            case "bodies", dict():
                for name, one in value.items():
                    made = made.body(name, **one)
            case "joints" | "drivers" | "forces", dict():
                add = {"joints": made.joint, "drivers": made.driver, "forces": made.force}[key]
                for name, one in value.items():
                    made = add(name, **one)
            case "points", list():
                made = made.point(*value)
            case "gravity", list():
                made = made.gravity(*value)
            case "analysis", dict():
                made = made.analysis(**value)
            case (("format" | "units"), _):
                pass
            case _:
                made = made.section(key, value)
    return made


@pytest.mark.parametrize("name", MODELS)
def test_bundled_models_can_be_built(name: str) -> None:
    words = linkdyn.load(name).to_dict()
    made = rebuilt(words)
    assert made.to_dict() == words
    assert linkdyn.load(made.to_json()).to_dict() == words


def test_a_model_that_was_built_runs_as_its_file(tmp_path: Path) -> None:
    made = rebuilt(linkdyn.load("four-bar").to_dict())
    path = made.model().save(tmp_path / "mine.json")
    one, other = made.run(), linkdyn.load(path).run()
    assert np.array_equal(one["driver.motor.effort"], other["driver.motor.effort"])


def test_what_is_wrong_is_told_at_its_place() -> None:
    made = linkdyn.Mechanism().body("ground", points={"O": [0, 0]}).joint("pin", "revolute", between=["ground.O", "rod.O"])
    with pytest.raises(linkdyn.ModelError) as caught:
        made.model()
    assert any(one.path == "joints.pin.between[1]" for one in caught.value.complaints)
    with pytest.raises(ValueError, match="already"):
        made.body("ground")


def test_numbers_of_numpy_are_numbers() -> None:
    made = linkdyn.Mechanism().body("ground", points={"O": np.array([0.0, 1.0])}).parameter("n", np.int64(3))
    assert json.loads(made.to_json())["bodies"]["ground"]["points"]["O"] == [0.0, 1.0]
