"""Studies given out to Ray and Dask, where these are installed: with workers and drivers that are killed.

pip install ray distributed psutil && pytest tests/test_cluster.py
"""

from __future__ import annotations

import hashlib
import os
import signal
import subprocess
import sys
import threading
import time
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

import linkdyn

needs_ray = pytest.mark.skipif(find_spec("ray") is None, reason="Ray is not installed")
needs_dask = pytest.mark.skipif(find_spec("distributed") is None, reason="Dask is not installed")
PEAK = {"peak": "max(abs(driver.motor.effort))"}


def study() -> linkdyn.Study:
    """Thirteen chunks, each of half a second or more."""
    tolerances = {f"parameters.{name}": {"value": f"{length} mm", "tolerance": "0.1 mm"} for name, length in LENGTHS.items()}
    return linkdyn.load("four-bar").set(tolerances | {"analysis.outputs": 91}).study(samples=100_000, responses=PEAK)


LENGTHS = {"base": 300, "crank": 100, "coupler": 250, "rocker": 200}


def digest(place: Path) -> dict[str, str]:
    """Of the table, and of the sums."""
    return {name: hashlib.sha256((place / name).read_bytes()).hexdigest() for name in ("variants.csv", "study.json")}


def chunks(place: Path) -> int:
    return len(list((place / "chunks").glob("chunk-*.bin"))) if (place / "chunks").exists() else 0


@pytest.fixture(scope="module")
def once(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """What one thread of this process leaves."""
    place = tmp_path_factory.mktemp("once")
    study().run(place, threads=1, report=False)
    return digest(place)


@pytest.fixture
def ray() -> Any:
    import ray as library

    library.init(num_cpus=2, include_dashboard=False, log_to_driver=False, logging_level="error")
    yield library
    library.shutdown()


@needs_ray
@pytest.mark.parametrize("shared", [True, False])
def test_ray_gives_the_bytes_of_one_thread(tmp_path: Path, ray: Any, once: dict[str, str], shared: bool) -> None:
    shares: list[float] = []
    study().run(tmp_path, "ray", shared=shared, report=False, progress=shares.append)
    assert digest(tmp_path) == once
    assert shares[-1] == 1.0 and len(shares) >= 13


@needs_ray
def test_a_worker_of_ray_that_is_killed_changes_nothing(tmp_path: Path, ray: Any, once: dict[str, str]) -> None:
    import psutil  # type: ignore[import-untyped]

    killed: list[int] = []

    def kill() -> None:
        while not killed:
            time.sleep(0.2)
            for worker in psutil.Process().children(recursive=True):
                # A process that computes: in the middle of a share.
                if "ray::compute" in " ".join(worker.cmdline()):
                    os.kill(worker.pid, signal.SIGKILL)
                    killed.append(chunks(tmp_path))
                    return

    thread = threading.Thread(target=kill)
    thread.start()
    study().run(tmp_path, "ray", report=False)
    thread.join()
    assert killed[0] < study().chunks
    assert digest(tmp_path) == once


DRIVER = """
import sys, ray
from test_cluster import study
ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, logging_level="error")
study().run(sys.argv[1], "ray", report=False)
"""


@needs_ray
def test_a_driver_of_ray_that_is_killed_is_gone_on_with(tmp_path: Path, once: dict[str, str]) -> None:
    import ray as library

    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parent)}
    driver = subprocess.Popen([sys.executable, "-c", DRIVER, str(tmp_path)], env=environment)
    until = time.monotonic() + 120
    while chunks(tmp_path) < 3 and driver.poll() is None and time.monotonic() < until:
        time.sleep(0.02)
    assert driver.poll() is None, "it was alive"
    driver.send_signal(signal.SIGKILL)
    driver.wait()
    left = chunks(tmp_path)
    assert 3 <= left < study().chunks and not (tmp_path / "variants.csv").exists()
    library.init(num_cpus=2, include_dashboard=False, log_to_driver=False, logging_level="error")
    try:
        study().run(tmp_path, "ray", report=False)
    finally:
        library.shutdown()
    assert digest(tmp_path) == once


@needs_dask
@pytest.mark.parametrize("shared", [True, False])
def test_dask_gives_the_bytes_of_one_thread(tmp_path: Path, once: dict[str, str], shared: bool) -> None:
    import distributed

    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with cluster, distributed.Client(cluster) as client:
        study().run(tmp_path, "dask", client=client, shared=shared, report=False)
    assert digest(tmp_path) == once
