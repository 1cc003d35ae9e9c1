"""Runs: the same numbers as the command's, in place, without the interpreter's lock."""

from __future__ import annotations

import csv
import json
import os
import pickle
import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

import linkdyn
from linkdyn import _linkdyn

HERE = Path(__file__).parent
MODELS = HERE.parents[1] / "models"


def command(*arguments: str) -> _linkdyn.Said:
    said, stopped = _linkdyn.command(list(arguments))
    assert stopped is None
    return said


@pytest.mark.parametrize("name", ["lock", "four-bar", "slider-crank-clearance"])
def test_columns_are_the_bytes_of_the_commands_csv(name: str, tmp_path: Path) -> None:
    assert command("run", name, "-o", str(tmp_path)).status == 0
    with open(tmp_path / "results.csv", newline="") as file:
        rows = list(csv.reader(file))
    run = linkdyn.load(name).run()
    assert run.headings() == rows[0]
    for place, column in enumerate(run):
        told = np.array([float(row[place] or "nan") for row in rows[1:]])
        assert told.tobytes() == np.where(np.isnan(run[column]), np.nan, run[column]).tobytes(), column


def test_the_summary_is_that_of_the_command(tmp_path: Path) -> None:
    command("run", "lock", "-o", str(tmp_path))
    told = json.loads((tmp_path / "summary.json").read_text())
    own = linkdyn.load("lock").run().summary
    changing = {"timing", "time", "times", "started", "stages"}
    assert told.keys() == own.keys()
    same = [key for key in told if key not in changing and told[key] == own[key]]
    assert set(told) - set(same) <= changing | {"work"}, set(told) - set(same)


def test_arrays_are_views_of_the_run() -> None:
    run = linkdyn.load("lock").run()
    effort = run["driver.motor.effort"]
    assert effort.shape == (1751,) and effort.dtype == np.float64
    again = np.asarray(run._core.column("driver.motor.effort"))
    assert effort.__array_interface__["data"] == again.__array_interface__["data"]
    # Neighbours in a row stand side by side: no column was copied out of the table.
    names = run.columns
    first, second = run[names[0]], run[names[1]]
    apart = second.__array_interface__["data"][0] - first.__array_interface__["data"][0]
    assert apart == 8 and first.strides == (8 * len(names),)
    assert not effort.flags.writeable and effort.base is not None
    with pytest.raises(ValueError):
        effort[0] = 1.0
    # The memory lives as long as an array does.
    before = effort.copy()
    del run, again, first, second
    linkdyn.load("lock").run()
    assert np.array_equal(before, effort, equal_nan=True)


def test_models_are_read_from_whatever_holds_them(tmp_path: Path) -> None:
    bundled = linkdyn.load("four-bar")
    path = bundled.save(tmp_path / "mine.json")
    for source in (path, str(path), bundled.to_json(), bundled.to_json().encode(), bundled.to_dict()):
        same = linkdyn.load(source)
        assert np.array_equal(same.run()["driver.motor.effort"], bundled.run()["driver.motor.effort"])
    there = pickle.loads(pickle.dumps(bundled.set({"parameters.crank": "90 mm"})))
    assert there.parameters["crank"] == (0.09, "m")


def test_what_is_legal_only_together_is_set_together() -> None:
    model = linkdyn.load("four-bar")
    both = model.set({"parameters.a": "3 mm", "parameters.crank": "=30*a"})
    assert both.parameters["crank"] == (0.09, "m")
    with pytest.raises(linkdyn.ModelError):
        model.set({"parameters.crank": "=30*a"})
    assert "a" not in model.parameters


def test_tables_of_others() -> None:
    run = linkdyn.load("four-bar").set({"analysis.outputs": 5}).run()
    pandas, polars = pytest.importorskip("pandas"), pytest.importorskip("polars")
    pyarrow = pytest.importorskip("pyarrow")
    frame = run.to_pandas()
    assert list(frame.columns) == run.columns and frame.attrs["units"]["time"] == "s"
    assert isinstance(frame, pandas.DataFrame)
    assert run.to_polars().equals(polars.DataFrame(run))
    table = pyarrow.table(run)
    assert table.column_names == run.columns
    assert table.field("driver.motor.effort").metadata == {b"unit": b"N*m"}
    assert np.array_equal(table["driver.motor.effort"].to_numpy(), run["driver.motor.effort"])


def test_a_run_that_ends_early_raises_and_keeps_what_there_is() -> None:
    model = linkdyn.load("slider-crank-clearance")
    with pytest.raises(linkdyn.SolveError) as caught:
        model.run(timeout=0.0)
    run = caught.value.run
    assert run is not None and run.status == "time_limit"
    assert "time_limit" in str(caught.value)
    assert model.run(timeout=0.0, strict=False).status == "time_limit"


@contextmanager
def interrupted(after: float) -> Iterator[None]:
    """Presses Ctrl-C so many seconds from now, unless the block is over before."""
    timer = threading.Timer(after, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        timer.join()


def long_model() -> linkdyn.Model:
    """A motion that takes seconds."""
    model = linkdyn.load("double-pendulum")
    return model.set({"analysis.end": 20000, "analysis.outputs": 200001})


def test_an_interrupt_stops_a_run_and_keeps_what_there_is() -> None:
    model = long_model()
    began = time.perf_counter()
    with interrupted(0.4), pytest.raises(KeyboardInterrupt) as caught:
        model.run()
    assert time.perf_counter() - began < 5.0
    assert isinstance(caught.value, linkdyn.Interrupted)
    run = caught.value.run
    assert run is not None and run.status == "interrupted"
    assert 0 < len(run.t) < 200001 and np.isfinite(run.t).all()


def test_an_interrupt_stops_a_command() -> None:
    press = linkdyn.load("slider-crank").set({"responses.peak": "max(abs(driver.motor.effort))"})
    with interrupted(0.4), pytest.raises(linkdyn.Interrupted):
        press.optimise({"crank": "20 mm:60 mm", "rod": "150 mm:400 mm"}, minimise="peak", starts=100_000)


def test_what_a_handler_of_signals_raises_comes_through() -> None:
    class Enough(Exception):
        pass

    def handle(*_: object) -> None:
        raise Enough

    old = signal.signal(signal.SIGALRM, handle)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with pytest.raises(Enough):
            long_model().run()
    finally:
        signal.signal(signal.SIGALRM, old)


def test_other_threads_go_on_during_a_run() -> None:
    model = long_model().set({"analysis.end": 1000, "analysis.outputs": 1001})
    beats = []
    over = threading.Event()

    def beat() -> None:
        while not over.wait(0.01):
            beats.append(time.perf_counter())

    thread = threading.Thread(target=beat, daemon=True)
    thread.start()
    began = time.perf_counter()
    model.run()
    ended = time.perf_counter()
    over.set()
    thread.join()
    inside = [one for one in beats if began < one < ended]
    assert len(inside) > 0.2 * (ended - began) / 0.01, (len(inside), ended - began)


def test_brief_runs_are_like_others() -> None:
    model = linkdyn.load("four-bar")
    first = model.run()
    shares: list[float] = []
    again = model.run(progress=shares.append, timeout=10.0)
    assert np.array_equal(first.to_numpy(), again.to_numpy(), equal_nan=True)
    with pytest.raises(linkdyn.SolveError):
        model.run(timeout=0.0)
    # Ctrl-C between brief runs, and in them.
    with interrupted(0.2), pytest.raises(KeyboardInterrupt):
        while True:
            model.run()


def test_many_threads_run_at_once() -> None:
    model = linkdyn.load("four-bar")
    wanted = model.run()["driver.motor.effort"].tobytes()
    seen: list[bool] = []

    def work() -> None:
        seen.extend(model.run()["driver.motor.effort"].tobytes() == wanted for _ in range(5))

    # More than threads are kept for.
    threads = [threading.Thread(target=work) for _ in range(24)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(seen) == 120 and all(seen)


def test_a_run_within_the_progress_of_a_run() -> None:
    inner: list[int] = []
    model = linkdyn.load("four-bar")
    slow = long_model().set({"analysis.end": 1000, "analysis.outputs": 1001})
    slow.run(progress=lambda _: inner.append(len(model.run().t)))
    assert inner and set(inner) == {401}


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no processes are forked here")
def test_a_forked_process_runs_by_threads_of_its_own() -> None:
    model = linkdyn.load("four-bar")
    wanted = model.run()["driver.motor.effort"].tobytes()
    child = os.fork()
    if child == 0:
        signal.alarm(20)
        os._exit(0 if model.run()["driver.motor.effort"].tobytes() == wanted else 1)
    assert os.waitpid(child, 0)[1] == 0


def test_progress_is_told() -> None:
    shares: list[float] = []
    long_model().set({"analysis.end": 1000, "analysis.outputs": 1001}).run(progress=shares.append)
    assert shares and shares == sorted(shares) and 0.0 <= shares[0] <= shares[-1] <= 1.0


def test_the_page_of_a_run_shows_in_a_notebook() -> None:
    shown = linkdyn.load("four-bar").run()._repr_html_()
    assert shown.startswith("<iframe srcdoc=") and "&lt;!doctype html&gt;" in shown


def test_a_run_goes_through_a_pickle(tmp_path: Path) -> None:
    model = linkdyn.load("slider-crank").set({"analysis.columns": ["piston.*"], "analysis.outputs": 37})
    run = model.run()
    kept = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(run))))
    assert kept.columns == run.columns and kept.units == run.units and repr(kept) == repr(run)
    assert kept.to_numpy().tobytes() == run.to_numpy().tobytes()
    # Also what analysis.columns leaves out, and what the rows do not show.
    for name in ("piston.x", "driver.motor.effort"):
        assert np.array_equal(kept[name], run[name]) and kept.extremes(name) == run.extremes(name)
    assert kept.summary == run.summary and kept.warnings == run.warnings and not kept["time"].flags.writeable
    with pytest.raises(linkdyn.UnknownName, match=r"piston\.x"):
        kept["piston.xx"]
    (tmp_path / "kept").mkdir()
    kept.write(tmp_path / "kept")
    run.write(tmp_path / "run")
    assert (tmp_path / "kept" / "results.csv").read_bytes() == (tmp_path / "run" / "results.csv").read_bytes()
    assert kept.html().startswith("<!doctype html>")


def test_a_run_that_ended_early_goes_through_a_pickle() -> None:
    with pytest.raises(linkdyn.SolveError) as caught:
        linkdyn.load("slider-crank-clearance").run(timeout=0.0)
    error = pickle.loads(pickle.dumps(caught.value))
    assert error.run.status == "time_limit" and str(error) == str(caught.value)
    with pytest.raises(linkdyn.LinkdynError, match="where it ran"):
        error.run.html()


def test_a_dataset_of_xarray(monkeypatch: pytest.MonkeyPatch) -> None:
    run = linkdyn.load("four-bar").set({"analysis.outputs": 5}).run()
    with monkeypatch.context() as without:
        without.setitem(sys.modules, "xarray", None)
        with pytest.raises(ImportError, match=r'pip install "linkdyn\[xarray\]"'):
            run.to_xarray()
    pytest.importorskip("xarray")
    data = run.to_xarray()
    assert data.sizes == {"time": 5} and list(data) == run.columns[1:]
    effort = data["driver.motor.effort"]
    assert effort.units == "N*m" and np.array_equal(effort, run["driver.motor.effort"])
    assert data.time.units == "s" and data.attrs == {"model": "Four-bar", "status": "completed"}


def test_figures_are_in_the_units_of_the_file() -> None:
    pytest.importorskip("matplotlib").use("Agg")
    run = linkdyn.load("four-bar").run()
    ax = run.plot("coupler.P.y", over="crank.angle")
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("crank.angle [deg]", "coupler.P.y [mm]")
    assert ax.get_lines()[0].get_ydata() == pytest.approx(run["coupler.P.y"] * 1e3)
    assert ax.get_lines()[0].get_xdata() == pytest.approx(np.degrees(run["crank.angle"]))
    ax = run.plot("coupler.P.y", over="crank.angle", units="SI")
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("crank.angle [rad]", "coupler.P.y [m]")
    assert np.array_equal(ax.get_lines()[0].get_ydata(), run["coupler.P.y"])
    with pytest.raises(ValueError, match="SI"):
        run.plot("coupler.P.y", units="mm")


def test_figures() -> None:
    pytest.importorskip("matplotlib").use("Agg")
    run = linkdyn.load("four-bar").run()
    ax = run.plot("joint.a.f", "joint.b.f")
    assert ax.get_ylabel() == "[N]" and ax.get_xlabel() == "time [s]"
    drawn = ax.get_lines()[0].get_ydata()
    assert np.array_equal(drawn, np.hypot(run["joint.a.fx"], run["joint.a.fy"]))
