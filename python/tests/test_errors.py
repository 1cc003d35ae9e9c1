"""Faults reach Python in the words of the command, and no panic crosses the border."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path

import pytest

import linkdyn
from linkdyn import _linkdyn

FAULTY = """{
  "format": "linkdyn/1",
  "units": "SI",
  "bodies": { "ground": { "points": { "O": [0, 0] } }, "crank": { "points": { "P": [0, 0], "Q": ["1 kg", 0] } } },
  "joints": { "pin": { "type": "revolut", "between": ["ground.O", "crank.P"] } },
  "wrong": 1
}"""


def test_complaints_are_those_of_the_command(tmp_path: Path) -> None:
    path = tmp_path / "faulty.json"
    path.write_text(FAULTY)
    said, _ = _linkdyn.command(["run", str(path)])
    told = [line.removeprefix(f"error: {path}: ") for line in said.stderr.splitlines()]
    with pytest.raises(linkdyn.ModelError) as caught:
        linkdyn.load(path)
    complaints = caught.value.complaints
    assert [one.text for one in complaints] == told and len(told) >= 3
    assert str(caught.value) == "\n".join(told)
    kind = next(one for one in complaints if one.path == "joints.pin.type")
    assert kind.line == 5 and kind.column and kind.hint and "revolute" in kind.hint, kind
    assert pickle.loads(pickle.dumps(caught.value)).complaints == complaints


def test_complaints_of_what_was_set() -> None:
    with pytest.raises(linkdyn.ModelError) as caught:
        linkdyn.load("four-bar").set({"parameters.crnk": 1})
    assert caught.value.complaints[0].path == "parameters.crnk"


def test_names_that_there_are_not() -> None:
    with pytest.raises(linkdyn.UnknownModel, match="fourbar"):
        linkdyn.load("fourbar")
    run = linkdyn.load("four-bar").run()
    with pytest.raises(KeyError, match=r"did you mean \"driver.motor.effort\""):
        run["driver.motor.efort"]
    with pytest.raises(linkdyn.UnknownName, match="crank"):
        linkdyn.load("four-bar").family(["crnk"])
    for path in (Path("nowhere.json"), "nowhere.json", "models/nowhere"):
        with pytest.raises(FileNotFoundError, match="nowhere") as caught:
            linkdyn.load(path)
        assert caught.value.filename == str(path) and isinstance(caught.value, linkdyn.UnknownModel | OSError)
    with pytest.raises(linkdyn.UnknownModel, match="there is no such file"):
        linkdyn.load("nowhere.json")


def test_bad_questions_are_told_in_the_words_of_the_command() -> None:
    with pytest.raises(linkdyn.ModelError) as caught:
        linkdyn.load("four-bar").accuracy(["nothing"])
    said, _ = _linkdyn.command(["accuracy", "four-bar", "--output", "nothing"])
    assert [one.text for one in caught.value.complaints] == [
        line.removeprefix("error: four-bar: ") for line in said.stderr.splitlines()
    ]


def test_messages_speak_of_arguments(tmp_path: Path) -> None:
    press, stroke = linkdyn.load("slider-crank"), "max(piston.x) - min(piston.x)"
    responses = {"stroke": stroke}
    worn = linkdyn.load("slider-crank-clearance")
    told: dict[str, Callable[[], object]] = {
        'say vary={"r": "10 mm:60 mm"}': lambda: press.optimise(),
        'say goals=["stroke = 80 mm"], minimise=EXPRESSION or maximise=': lambda: press.optimise({"crank": None}),
        'as in {"r": "10 mm:60 mm"}': lambda: press.optimise({"crank": "1:2:3"}, goals="x = 1"),
        "an inequality is one of the constraints": lambda: press.optimise({"crank": None}, goals="x > 1"),
        'minimise "x", maximise "y"': lambda: press.optimise({"crank": None}, minimise="x", maximise="y"),
        'as in {"r": "40 mm:60 mm:21"} or {"r": "40 mm, 50 mm"}': lambda: press.study(
            {"crank": "1:2"}, responses=responses
        ).run(),
        'say vary={"NAME": "FROM:TO:COUNT"}, or samples=N': lambda: press.study(responses=responses).run(),
        'add responses={"stroke": ': lambda: press.study({"crank": "50 mm"}).run(),
        'responses "a = max("': lambda: press.study({"crank": "50 mm"}, responses={"a": "max("}).run(),
        "samples: no parameter has": lambda: press.study(samples=3, responses=responses).run(),
        'models: there is no clearance model "x"': lambda: worn.compare(models="x"),
        'columns "x": matches no column': lambda: worn.compare(columns="x"),
        "as joints says": lambda: worn.compare("x"),
        "set parameters.crank=9 zoll": lambda: press.set({"parameters.crank": "9 zoll"}),
    }
    for words, ask in told.items():
        with pytest.raises(linkdyn.ModelError) as caught:
            ask()
        for text in (str(caught.value), *(one.text for one in caught.value.complaints)):
            assert words in text and "--" not in text, text


@pytest.mark.parametrize("is_watched", [False, True])
def test_no_panic_crosses_the_border(is_watched: bool) -> None:
    with pytest.raises(linkdyn.InternalError, match="injected"):
        _linkdyn._panic(is_watched)
    # Life goes on.
    assert linkdyn.load("four-bar").run().status == "completed"


def test_a_panic_of_the_command_leaves_its_streams_as_they_were() -> None:
    with pytest.raises(linkdyn.InternalError):
        _linkdyn._panic(True)
    assert _linkdyn.command(["models"])[0].status == 0


def test_text_that_is_nested_deeply_is_refused() -> None:
    for depth in (200, 100_000):
        with pytest.raises(linkdyn.ModelError):
            linkdyn.load('{"format":' + "[" * depth)


def test_a_timeout_is_a_time() -> None:
    for bad in (-1.0, float("nan")):
        with pytest.raises(ValueError, match="timeout"):
            linkdyn.load("four-bar").run(timeout=bad)
