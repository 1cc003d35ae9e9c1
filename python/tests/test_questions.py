"""Questions to a model, families of variants."""

from __future__ import annotations

import json
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import linkdyn
from linkdyn import _linkdyn

PRESS = {"stroke": "max(piston.x) - min(piston.x)"}


def test_check_and_modes_are_those_of_the_command() -> None:
    for name, question in (("four-bar", "check"), ("double-pendulum", "modes")):
        said, _ = _linkdyn.command([question, name, "--json"])
        answer = getattr(linkdyn.load(name), question)()
        assert answer == json.loads(said.stdout)
        assert answer.text and answer._repr_html_()


def test_linkages_are_those_of_the_command_and_are_loaded(tmp_path: Path) -> None:
    angles = [[30, 20], [50, 32], [70, 47], [90, 64], [110, 82]]
    task = {"format": "linkdyn/1", "units": {"length": "mm", "angle": "deg"}, "synthesise": {"function": angles}}
    (tmp_path / "task.json").write_text(json.dumps(task))
    said, _ = _linkdyn.command(["synthesise", str(tmp_path / "task.json"), "--json"])
    answer = linkdyn.load(task).synthesise()
    told = json.loads(said.stdout)
    assert answer["linkages"] == told["linkages"] and answer["tried"] == told["tried"]
    assert answer.page and "<animate" in answer.page
    for one in answer["linkages"]:
        run = linkdyn.load(one["model"]).run()
        assert np.ptp(run["rocker.angle"]) > 0.1
    with pytest.raises(linkdyn.ModelError, match="synthesise"):
        linkdyn.load("four-bar").synthesise()


def test_a_workspace_is_that_of_the_command() -> None:
    words = ["--workspace", "bucket.tooth", "--drivers", "lift,crowd", "--values", "9"]
    said, _ = _linkdyn.command(["assemblies", "excavator", *words, "--json"])
    answer = linkdyn.load("excavator").workspace("bucket.tooth", ("lift", "crowd"), values=9)
    assert answer == json.loads(said.stdout) and answer.page
    with pytest.raises(linkdyn.ModelError, match=r"bucket\.toot"):
        linkdyn.load("excavator").workspace("bucket.toot", ("lift", "crowd"))


def test_accuracy_is_that_of_the_command() -> None:
    said, _ = _linkdyn.command(["accuracy", "lock", "--levels", "first", "--json"])
    answer = linkdyn.load("lock").accuracy(levels="first", threads=2)
    told = json.loads(said.stdout)
    assert answer.keys() == told.keys() and answer["outputs"] == told["outputs"]
    assert answer.page and answer.page.startswith("<!doctype html>")


COSTLY: dict[str, Any] = {
    "parameters.crank": {"value": "50 mm", "tolerance": "0.05 mm", "cost": "1 mm"},
    "parameters.rod": {"value": "200 mm", "tolerance": "0.1 mm", "cost": "2 mm"},
    "accuracy": {"outputs": {"far": {"column": "piston.x", "at": {"value": "90 deg"}, "limits": [-0.25, 0.25]}}},
}


def test_tolerances_are_allocated_as_by_the_command() -> None:
    model = linkdyn.load("slider-crank").set(COSTLY)
    sets = [word for path, value in COSTLY.items() for word in ("--set", f"{path}={json.dumps(value)}")]
    for rss in (False, True):
        said, _ = _linkdyn.command(["allocate", "slider-crank", *sets, "--json", *(["--rss"] if rss else [])])
        answer, cheap = model.allocate("far", rss=rss)
        told = json.loads(said.stdout)
        assert answer.keys() == told.keys() and answer["parameters"] == told["parameters"]
        assert answer.text and cheap.to_dict()["parameters"]["rod"]["tolerance"] != "0.1 mm"
    assert model.accuracy("far", "first").keys() == model.accuracy(["far"], levels="first").keys()
    with pytest.raises(linkdyn.ModelError, match="nothing may be off"):
        linkdyn.load("slider-crank").set({"accuracy": COSTLY["accuracy"]}).allocate()
    with pytest.raises(linkdyn.ModelError, match="levels"):
        model.accuracy("far", "frist")


def test_compare_names_the_models() -> None:
    answer = linkdyn.load("lock").compare(models=["ideal", "massless_link"], columns=["driver.*.effort"])
    assert "massless_link" in json.dumps(answer) and answer.page


def test_a_goal_is_found_and_the_model_with_it() -> None:
    answer, longer = linkdyn.load("slider-crank").optimise({"crank": None}, goals=[f"{PRESS['stroke']} = 80 mm"])
    assert longer.parameters["crank"][0] == pytest.approx(0.04, abs=1e-9)
    assert answer


def test_a_family_gives_what_runs_give() -> None:
    model = linkdyn.load("slider-crank").set({"parameters.rod": "210 mm"})
    cranks = np.linspace(0.03, 0.06, 40)
    family = model.family(["parameters.crank"], PRESS | {"peak": "max(abs(driver.motor.effort))"})
    assert family.parameters == ["crank"] and family.responses == {"stroke": "m", "peak": "N*m"}
    found = family(cranks)
    assert found.values.shape == (40, 2) and found.ok.all() and set(found.status) == {"completed"}
    assert not found.values.flags.writeable
    assert np.allclose(found["stroke"], 2 * cranks, rtol=0, atol=1e-12)
    asked = model.set({"responses.peak": "max(abs(driver.motor.effort))"})
    for crank, peak in list(zip(cranks, found["peak"], strict=True))[::13]:
        told = asked.set({"parameters.crank": f"{crank} m"}).run().responses["peak"]["value"]
        assert peak == pytest.approx(told, rel=1e-9)


def test_threads_do_not_change_what_comes_out() -> None:
    family = linkdyn.load("slider-crank").family(["crank", "rod"], {"peak": "max(abs(driver.motor.effort))"})
    values = np.random.default_rng(1).uniform([0.03, 0.15], [0.06, 0.3], (500, 2))
    one, three = family(values, threads=1), family(values, threads=3)
    assert one.values.tobytes() == three.values.tobytes()
    assert one.codes.tobytes() == three.codes.tobytes()
    # Two threads of Python at once, with one family.
    found: list[linkdyn.Variants] = []
    threads = [threading.Thread(target=lambda: found.append(family(values, threads=1))) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [each.values.tobytes() for each in found] == [one.values.tobytes()] * 2


def test_variants_that_fail_are_told() -> None:
    family = linkdyn.load("slider-crank").family(["crank"], PRESS)
    found = family([0.05, 0.5, float("nan"), -1.0])
    assert found.status[0] == "completed" and not found.ok[1:].any(), found
    assert np.isnan(found["stroke"][1:]).all()
    assert found.fault and found.fault[0] == 2 and found.fault[1]
    with pytest.raises(ValueError, match="shape"):
        family(np.zeros((3, 2)))
    assert len(family(np.zeros((0, 1)))) == 0


def test_variants_are_a_table_of_their_responses() -> None:
    family = linkdyn.load("slider-crank").family(["crank", "rod"], PRESS | {"peak": "max(abs(driver.motor.effort))"})
    found = family([[0.05, 0.2], [0.5, 0.2]])
    assert list(found) == found.keys() == ["stroke", "peak"] and len(found) == 2
    assert "peak" in found and "crank" not in found
    assert {name: values.tolist() for name, values in dict(found).items()}.keys() == {"stroke", "peak"}
    with pytest.raises(KeyError, match='no response is called "strok"; did you mean "stroke"'):
        found["strok"]
    with pytest.raises(linkdyn.UnknownName):
        found[0]  # type: ignore[index]
    table = linkdyn.load("slider-crank").study({"crank": "40 mm, 50 mm"}, responses=PRESS).run()
    with pytest.raises(linkdyn.UnknownName, match='did you mean "stroke"'):
        table["strok"]
    pytest.importorskip("pandas")
    frame = found.to_pandas()
    assert list(frame.columns) == ["status", "parameters.crank", "parameters.rod", "stroke", "peak"]
    assert frame["parameters.crank"].tolist() == [0.05, 0.5] and frame["status"][0] == "completed"
    assert frame.attrs["units"] == {"parameters.crank": "m", "parameters.rod": "m", "stroke": "m", "peak": "N*m"}
    assert table.to_pandas().attrs["units"] == {"parameters.crank": "m", "stroke": "m"}


def test_families_and_runs_go_to_other_processes() -> None:
    joblib = pytest.importorskip("joblib")
    model = linkdyn.load("slider-crank").set({"parameters.rod": "210 mm", "analysis.outputs": 37})
    family = model.family("crank", PRESS)
    values = [[0.04], [0.05]], [[0.06]]
    found = joblib.Parallel(n_jobs=2)(joblib.delayed(family)(own, threads=1) for own in values)
    assert [own["stroke"].tolist() for own in found] == [family(own)["stroke"].tolist() for own in values]
    sizes = ["40 mm", "50 mm"]
    models = [model.set({"parameters.crank": size}) for size in sizes]
    runs = joblib.Parallel(n_jobs=2)(joblib.delayed(linkdyn.Model.run)(own) for own in models)
    for own, run in zip(models, runs, strict=True):
        assert run.to_numpy().tobytes() == own.run().to_numpy().tobytes()


def test_the_bundled_models_are_listed() -> None:
    names = linkdyn.models()
    assert {"lock", "four-bar", "slider-crank"} <= set(names)
    for name in names[:3]:
        assert linkdyn.load(name).name


def test_a_model_of_a_dictionary_is_asked_like_any(tmp_path: Path) -> None:
    model = linkdyn.load(linkdyn.load("double-pendulum").to_dict()).set({"units": "SI"})
    assert model.modes()["modes"] == linkdyn.load("double-pendulum").modes()["modes"]
    assert not list(tmp_path.iterdir())
