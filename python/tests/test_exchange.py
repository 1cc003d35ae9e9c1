"""Files of other programs."""

from __future__ import annotations

from pathlib import Path

import pytest

import linkdyn

# The gate copies the folder beside the tests.
PLACES = [at / "linkages" for at in (Path(__file__).parent, Path(__file__).parents[2] / "crates/exchange/tests")]
FILES = next(place for place in PLACES if place.exists())


def test_a_link_moves_as_its_positions_say() -> None:
    lines = (FILES / "pmks-links.txt").read_text().splitlines()
    links = dict(line.split("\t") for line in lines if not line.startswith("#"))
    model = linkdyn.import_model("https://app.pmksplus.com/?" + links["four-bar"])
    assert model.left_out == ("page: colours, grid, labels, scale and what is selected",)
    run = model.set({"points": ["BC.C"], "analysis.type": "kinematics"}).run()
    assert run["BC.C.x"][0] == pytest.approx(0.03009, abs=1e-12)


def test_files_texts_and_bytes_are_the_same(tmp_path: Path) -> None:
    path = FILES / "mechanism-plate.json"
    read = [linkdyn.import_model(one, length="mm") for one in (path, str(path), path.read_text(), path.read_bytes())]
    assert len({model.to_json() for model in read}) == 1 and read[0].left_out == ()
    assert read[0].to_dict()["units"] == {"length": "mm"}
    assert linkdyn.load("four-bar").left_out == ()


def test_what_can_not_be_read_is_told() -> None:
    with pytest.raises(linkdyn.ModelError, match="no header of a table of points") as caught:
        linkdyn.import_model("a,b\n1,2\n", "csv")
    (complaint,) = caught.value.complaints
    assert complaint.path == "line 1" and complaint.hint == "body,point,x [mm],y [mm] or joint,x [mm],y [mm],bodies"
    with pytest.raises(linkdyn.ModelError, match="no format"):
        linkdyn.import_model("a,b\n", "stl")
    with pytest.raises(FileNotFoundError):
        linkdyn.import_model("nowhere.csv")
