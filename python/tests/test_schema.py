"""The schema accepts the models that the reader accepts, and refuses those that it refuses (``tests/fast/schema.rs``)."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator  # type: ignore[import-untyped]

import linkdyn
from linkdyn import _linkdyn

# The gate copies the file beside the tests.
PLACES = [at / name for at in Path(__file__).resolve().parents for name in ("schema.json", "tests/cases/schema.json")]
CASES = json.loads(next(place for place in PLACES if place.exists()).read_text("utf-8"))


@pytest.fixture(scope="module")
def validator() -> Draft202012Validator:
    said, _ = _linkdyn.command(["schema"])
    schema = json.loads(said.stdout)
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)


def models(which: str) -> list[dict[str, Any]]:
    return [CASES["base"] | extra for extra in CASES[which]] + ([CASES["whole"]] if which == "good" else [])


def test_good_models_satisfy_the_schema(validator: Draft202012Validator) -> None:
    bundled = [json.loads(_linkdyn.command(["models", name])[0].stdout) for name in linkdyn.models()]
    assert len(bundled) > 20
    for model in models("good") + bundled:
        faults = [f"{fault.json_path}: {fault.message}" for fault in validator.iter_errors(model)]
        assert not faults, model


def test_a_bad_structure_does_not(validator: Draft202012Validator) -> None:
    for model in models("bad"):
        assert not validator.is_valid(model), model
