"""A text says its unit everywhere; numbers of arrays are in SI; what is set is in the units of the file."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import linkdyn

STROKE = {"stroke": "max(piston.x) - min(piston.x)"}
GOAL = f"{STROKE['stroke']} = 80 mm"


def press() -> linkdyn.Model:
    return linkdyn.load("slider-crank")


def test_a_text_says_the_same_everywhere() -> None:
    told = press().set({"parameters.crank": "40 mm", **{f"responses.{name}": text for name, text in STROKE.items()}})
    wanted = told.run().responses["stroke"]["value"]
    family = press().family("crank", STROKE)
    values: Any
    for values in (["40 mm"], ["4 cm"], np.array(["40 mm"]), [["40 mm"]], [0.04]):
        assert family(values)["stroke"].tolist() == pytest.approx([wanted], rel=1e-12)
    for values in ("40 mm", ["40 mm"], ("4 cm",), 0.04, np.array([0.04])):
        table = press().study({"crank": values}, responses=STROKE).run()
        assert table["crank"].tolist() == [0.04] and table["stroke"].tolist() == pytest.approx([wanted], rel=1e-12)
    for values in ("10 mm:60 mm", ("10 mm", "60 mm"), [0.01, "60 mm"], np.array([0.01, 0.06]), "10:60", None):
        _, found = press().optimise({"crank": values}, goals=GOAL)
        assert found.parameters["crank"][0] == pytest.approx(0.04, abs=1e-9)


def test_arrays_of_several_parameters() -> None:
    family = press().family(["crank", "parameters.rod"], STROKE)
    texts, numbers = family([["40 mm", 0.2], [0.05, "20 cm"]]), family([[0.04, 0.2], [0.05, 0.2]])
    assert texts.values.tobytes() == numbers.values.tobytes()
    cranks = np.linspace(0.04, 0.06, 7)
    table = press().study({"crank": cranks, "rod": ["200 mm", 0.25]}, responses=STROKE).run()
    assert np.array_equal(np.unique(table["crank"]), cranks) and set(table["rod"]) == {0.2, 0.25}


def test_what_is_set_is_in_the_units_of_the_file() -> None:
    bar = linkdyn.load("four-bar")
    for plain in (90, 90.0, np.float64(90), np.int64(90)):
        assert bar.set({"parameters.crank": plain}).parameters["crank"] == (0.09, "m")
    told = bar.set({"parameters.crank": "90 mm"})
    assert np.array_equal(bar.set({"parameters.crank": 90}).run()["rocker.angle"], told.run()["rocker.angle"])
    # A number stays one where that is what the model wants.
    both = bar.set({"parameters.ratio": 0.9, "parameters.crank": "=ratio*100 mm"})
    assert both.parameters["crank"][0] == pytest.approx(0.09) and both.parameters["ratio"] == (0.9, "")
    assert both.set({"parameters.ratio": 1}).parameters["crank"] == (0.1, "m")
    both = bar.set({"parameters.a": "30 mm", "parameters.crank": "=3*a"})
    lengths = both.set({"parameters.a": 0.9, "parameters.crank": "=100*mod(a, 1)*1 mm"})
    assert lengths.parameters["crank"] == (0.09, "m")
    with pytest.raises(linkdyn.ModelError, match="crank"):
        bar.set({"parameters.crank": -90})


def test_values_of_another_dimension_are_refused() -> None:
    family = press().family("crank", STROKE)
    with pytest.raises(linkdyn.UnitError, match=r"crank: '40 N' is in N, crank is in m"):
        family(["40 N"])
    with pytest.raises(linkdyn.UnitError, match="forty"):
        family(["forty"])
    with pytest.raises(ValueError, match="shape"):
        family([["40 mm", "200 mm"]])
    with pytest.raises(ValueError, match="lower and an upper bound, not 3"):
        press().optimise({"crank": (0.01, 0.02, 0.03)}, goals=GOAL)
    with pytest.raises(linkdyn.ModelError, match="is a plain number, crank is in m"):
        press().study({"crank": ["40"]}, responses=STROKE).run()
    with pytest.raises(linkdyn.ModelError, match='did you mean "crank"'):
        press().study({"crnk": [0.04]}, responses=STROKE).run()
