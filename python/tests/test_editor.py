"""The editor in a notebook: what Python shares with the page."""

from pathlib import Path

import pytest
import traitlets

import linkdyn

TEXT = """{
  "format": "linkdyn/1",
  "units": { "length": "mm", "angle": "deg" },
  "parameters": { "l": "80 mm", "n": 2, "double": "=2*l" },
  "bodies": { "ground": { "points": { "O": [0, 0] } }, "bar": { "points": { "O": [0, 0], "A": ["=l", 0] } } },
  "joints": { "o": { "type": "revolute", "between": ["ground.O", "bar.O"] } }
}
"""


@pytest.fixture
def page(tmp_path: Path) -> Path:
    page = tmp_path / "page.html"
    page.write_text("<p>", "utf-8")
    return page


def test_text_and_parameters_go_together(page: Path) -> None:
    editor = linkdyn.load(TEXT).edit(page)
    assert (editor.text, editor.height) == (TEXT, 720)
    assert editor.parameters == {"l": 80, "n": 2}
    seen: list[str] = []
    editor.observe(lambda change: seen.append(change["new"]), "text")
    editor.parameters = {"l": 95.5}
    assert editor.text == TEXT.replace("80 mm", "95.5 mm")
    assert editor.parameters == {"l": 95.5, "n": 2}
    assert seen == [editor.text]
    assert editor.model.parameters["l"] == (0.0955, "m")
    # What the page writes.
    editor.text = TEXT.replace("80 mm", "70 mm")
    assert editor.parameters["l"] == 70


def test_a_text_with_faults_leaves_the_parameters(page: Path) -> None:
    editor = linkdyn.load(TEXT).edit(page)
    editor.text = "{"
    assert editor.parameters == {"l": 80, "n": 2}
    with pytest.raises(linkdyn.ModelError):
        _ = editor.model
    with pytest.raises(traitlets.TraitError, match="the text has faults"):
        editor.parameters = {"l": 1.0}


def test_unknown_parameters_are_refused(page: Path) -> None:
    editor = linkdyn.load(TEXT).edit(page)
    with pytest.raises(traitlets.TraitError, match="no parameter 'double'; there are l, n"):
        editor.parameters = {"double": 3.0}
    assert editor.text == TEXT


def test_what_was_set_is_in_the_text(page: Path) -> None:
    editor = linkdyn.load(TEXT).set({"parameters.l": 60}).edit(page)
    assert editor.parameters["l"] == 60


def test_the_page_is_found_or_missed(page: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LINKDYN_EDITOR", str(page))
    assert linkdyn.load("four-bar").edit()._page == "<p>"
    with pytest.raises(FileNotFoundError, match=r"not\.html: the page of the editor is not there"):
        linkdyn.load("four-bar").edit("not.html")
