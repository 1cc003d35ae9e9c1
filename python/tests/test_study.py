"""Studies: the same bytes whoever computes them."""

from __future__ import annotations

import hashlib
import os
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import linkdyn
from linkdyn import _linkdyn, backends

PEAK = {"peak": "max(abs(driver.motor.effort))"}


def study() -> linkdyn.Study:
    """Three chunks."""
    model = linkdyn.load("slider-crank").set({"analysis.outputs": 37})
    return model.study({"crank": "40 mm:60 mm:200", "rod": "150 mm:250 mm:100"}, responses=PEAK)


def digest(directory: Path) -> dict[str, str]:
    """Of each file that a study leaves."""
    files = sorted(path for path in directory.rglob("*") if path.is_file() and path.suffix in (".csv", ".json", ".bin"))
    return {str(path.relative_to(directory)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


@pytest.fixture(scope="module")
def once(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """What one thread of the command leaves."""
    place = tmp_path_factory.mktemp("command")
    words = ["study", "slider-crank", "--set", "analysis.outputs=37", "--threads", "1", "--no-report", "-o", str(place)]
    for path, values in (("crank", "40 mm:60 mm:200"), ("rod", "150 mm:250 mm:100")):
        words += ["--vary", f"parameters.{path}={values}"]
    words += ["--response", f"peak = {PEAK['peak']}"]
    said, _ = _linkdyn.command(words)
    assert said.status == 0, said.stderr
    return digest(place)


def test_a_study_leaves_the_files_of_the_command(tmp_path: Path, once: dict[str, str]) -> None:
    table = study().run(tmp_path, report=False)
    assert digest(tmp_path) == once
    assert study().variants == 20_000 == len(table["peak"]) == len(table.status)
    assert table.units["peak"] == "N*m" and table["crank"].max() == 0.06
    assert np.nanmax(table["peak"]) == table.summary["summary"]["responses"]["peak"]["max"]
    assert "<td>peak</td><td>N*m</td>" in table._repr_html_()


@pytest.mark.parametrize("shared", [True, False])
def test_shares_of_processes_give_the_same_bytes(tmp_path: Path, once: dict[str, str], shared: bool) -> None:
    pytest.importorskip("joblib")
    shares: list[float] = []
    study().run(tmp_path, "joblib", jobs=2, shared=shared, report=False, progress=shares.append)
    assert digest(tmp_path) == once
    assert shares == sorted(shares) and shares[-1] == 1.0


def test_what_is_there_is_not_computed_again(tmp_path: Path, once: dict[str, str]) -> None:
    given: list[list[tuple[int, int]]] = []

    def spy(study: linkdyn.Study, shares: list[tuple[int, int]], directory: Path, **_: Any) -> Iterator[object]:
        given.append(shares)
        for share in shares[:2]:
            backends.keep(backends.compute(study, share, None), directory)
            yield share
        if len(given) == 1:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        study().run(tmp_path, spy, report=False)
    study().run(tmp_path, spy, report=False)
    assert given[1] == given[0][2:] and len(given[0]) == study().chunks
    assert digest(tmp_path) == once


def test_a_chunk_that_is_damaged_is_computed_again(tmp_path: Path, once: dict[str, str]) -> None:
    study().run(tmp_path, report=False)
    chunk = tmp_path / "chunks" / study().chunk_files(2, study().chunks)[0]
    chunk.write_bytes(chunk.read_bytes()[:-7])
    study().run(tmp_path, report=False)
    assert digest(tmp_path) == once


def test_a_worker_that_is_killed_changes_nothing(tmp_path: Path, once: dict[str, str]) -> None:
    """As it is with Ray: a process of a share dies by SIGKILL, and the share is given out again."""

    def dying(study: linkdyn.Study, shares: list[tuple[int, int]], directory: Path, **_: Any) -> Iterator[object]:
        child = os.fork()
        if child == 0:
            for share in shares:
                backends.compute(study, share, str(directory))
            os._exit(0)
        # As soon as the first chunk is there, it is at the second.
        while not (directory / "chunks" / study.chunk_files(*shares[0])[0]).exists():
            pass
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        yield shares[0]

    study().run(tmp_path, dying, report=False)
    assert digest(tmp_path) == once


def test_an_object_store_has_the_same_bytes(tmp_path: Path, once: dict[str, str]) -> None:
    fsspec = pytest.importorskip("fsspec")
    store = fsspec.filesystem("memory")
    table = study().run("memory://bucket/study", report=False)
    assert table.directory == "memory://bucket/study" and len(table["peak"]) == 20_000
    store.get("/bucket/study/", str(tmp_path / "got"), recursive=True)
    assert digest(tmp_path / "got") == once
    # What is there is not computed again; what is broken is.
    first, second = (f"/bucket/study/chunks/{name}" for name in study().chunk_files(1, 1)[:2])
    when = store.modified(first)
    store.pipe_file(second, store.cat_file(second)[:-7])
    store.rm("/bucket/study/variants.csv")
    study().run("memory://bucket/study", report=False)
    assert store.modified(first) == when
    assert hashlib.sha256(store.cat_file(second)).hexdigest() in once.values()
    assert hashlib.sha256(store.cat_file("/bucket/study/variants.csv")).hexdigest() == once["variants.csv"]


@pytest.mark.parametrize("shared", [True, False])
def test_processes_write_to_a_store(tmp_path: Path, once: dict[str, str], shared: bool) -> None:
    pytest.importorskip("fsspec")
    pytest.importorskip("joblib")
    study().run(f"file://{tmp_path}/out", "joblib", jobs=2, shared=shared, report=False)
    assert digest(tmp_path / "out") == once


def test_a_store_of_another_study_is_refused(tmp_path: Path) -> None:
    pytest.importorskip("fsspec")
    url = f"file://{tmp_path}/out"
    linkdyn.load("slider-crank").study({"crank": "40 mm, 50 mm"}, responses=PEAK).run(url, report=False)
    with pytest.raises(linkdyn.ModelError, match="another study"):
        study().run(url)


def test_a_directory_of_another_study_is_refused(tmp_path: Path) -> None:
    linkdyn.load("slider-crank").study({"crank": "40 mm, 50 mm"}, responses=PEAK).run(tmp_path, report=False)
    with pytest.raises(linkdyn.ModelError, match="another study"):
        study().run(tmp_path)


def test_backends_that_there_are_not_are_named() -> None:
    with pytest.raises(ValueError, match="ray"):
        study().run(backend="rya")
