"""The notebooks run from top to bottom, and their cells are typed; the programs run."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")

HERE = Path(__file__).resolve().parents[1]
NOTEBOOKS = sorted((HERE / "examples").glob("*.ipynb"))
PROGRAMS = sorted((HERE / "examples").glob("*.py"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path: Path) -> None:
    book = nbformat.read(path, as_version=4)
    assert all(not cell.get("outputs") for cell in book.cells), "kept without what came out"
    began = time.perf_counter()
    nbclient.NotebookClient(book, timeout=100, kernel_name="python3").execute()
    print(f"{path.stem}: {time.perf_counter() - began:.1f} s")
    shown = [output for cell in book.cells for output in cell.get("outputs", [])]
    errors = [output for output in shown if output.get("name") == "stderr"]
    assert not errors, errors
    figures = [output for output in shown if "image/png" in output.get("data", {})]
    assert len(figures) >= 2


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_a_program_runs(path: Path, tmp_path: Path) -> None:
    without_screen = {**os.environ, "MPLBACKEND": "agg"}
    ran = subprocess.run([sys.executable, str(path)], capture_output=True, text=True, cwd=tmp_path, env=without_screen)
    assert ran.returncode == 0, ran.stderr
    expected = {"sweep": "written: sweep.svg", "controller": "the door stands at 89.98 degrees", "impacts": "approach"}
    assert expected[path.stem] in ran.stdout
    if path.stem != "sweep":
        assert len(ran.stdout.splitlines()) > 1


def test_there_are_three_and_the_lock_has_ten_cells() -> None:
    assert [path.stem for path in NOTEBOOKS] == ["clearance", "lock", "tolerances"]
    lock = nbformat.read(HERE / "examples" / "lock.ipynb", as_version=4)
    assert sum(cell.cell_type == "code" for cell in lock.cells) == 10


def test_the_page_of_a_run_is_shown_in_its_cell() -> None:
    book = nbformat.v4.new_notebook()
    book.cells = [nbformat.v4.new_code_cell('import linkdyn\nlinkdyn.load("four-bar").run()')]
    nbclient.NotebookClient(book, timeout=60, kernel_name="python3").execute()
    assert "<iframe srcdoc=" in book.cells[0].outputs[0]["data"]["text/html"]


def test_a_bar_shows_how_far_a_run_is() -> None:
    pytest.importorskip("tqdm")
    book = nbformat.v4.new_notebook()
    line = 'linkdyn.load("double-pendulum").set({"analysis.end": 1000}).run(progress=True).status'
    book.cells = [nbformat.v4.new_code_cell(f"import linkdyn\n{line}")]
    nbclient.NotebookClient(book, timeout=60, kernel_name="python3").execute()
    # A widget where the notebook has widgets, else a line of text.
    outputs = book.cells[0].outputs
    text = "".join(output.get("text", "") for output in outputs)
    widgets = [output for output in outputs if "application/vnd.jupyter.widget-view+json" in output.get("data", {})]
    assert "100%|" in text or widgets, outputs
    assert outputs[-1]["data"]["text/plain"] == "'completed'"


def test_the_cells_are_typed(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    for path in NOTEBOOKS:
        cells = [cell.source for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code"]
        (tmp_path / f"{path.stem}.py").write_text("\n\n".join(cells) + "\n")
    words = [sys.executable, "-m", "mypy", "--strict", "--config-file", str(HERE / "pyproject.toml")]
    programs = map(str, sorted([*tmp_path.glob("*.py"), *PROGRAMS]))
    checked = subprocess.run([*words, *programs], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout
