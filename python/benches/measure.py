"""Measures what people rely on: overhead of a run, memory, threads, variants for each minute, Ray.

python python/benches/measure.py [overhead|memory|threads|variants|ray ...]
"""

from __future__ import annotations

import hashlib
import os
import signal
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import linkdyn

PEAK = {"peak": "max(abs(driver.motor.effort))"}


def overhead() -> None:
    """What a run of the lock takes beside the assembly and the solution."""
    lock = linkdyn.load("lock")
    extra, whole = [], []
    for _ in range(300):
        began = time.perf_counter()
        run = lock.run()
        took = time.perf_counter() - began
        timing = run.summary["timing"]
        extra.append(took - timing["assemble"]["wall"] - timing["solve"]["wall"])
        whole.append(took)
    print(
        f"overhead: {min(extra) * 1e6:.0f} us of {min(whole) * 1e3:.2f} ms",
        f"(best of 300, lock, {len(run.t)} rows)",
    )


def memory() -> None:
    """Resident memory over ten thousand runs."""

    def resident() -> float:
        pages = int(Path("/proc/self/statm").read_text().split()[1])
        return pages * os.sysconf("SC_PAGE_SIZE") / 1e6

    lock = linkdyn.load("lock").set({"analysis.sample.step": "1 deg"})
    seen = []
    for number in range(10_001):
        run = lock.run()
        run["driver.motor.effort"].sum()
        if number % 1000 == 0:
            seen.append(round(resident(), 1))
    print("memory [MB] at each thousand runs:", seen)


def threads() -> None:
    """Two threads of Python beside one."""
    family = linkdyn.load("slider-crank").family(["crank"], PEAK)
    values = np.linspace(0.03, 0.06, 4_000)[:, np.newaxis]

    def work() -> None:
        family(values, threads=1)

    def alone() -> None:
        work()
        work()

    def together() -> None:
        both = [threading.Thread(target=work) for _ in range(2)]
        for thread in both:
            thread.start()
        for thread in both:
            thread.join()

    def best(what: Callable[[], None]) -> float:
        took = []
        for _ in range(5):
            began = time.perf_counter()
            what()
            took.append(time.perf_counter() - began)
        return min(took)

    one, two = best(alone), best(together)
    print(f"threads: {one:.2f} s one after the other, {two:.2f} s together, factor {one / two:.2f}")


def variants() -> None:
    """Variants of the four-bar for each minute."""
    model = linkdyn.load("four-bar").set({"analysis.outputs": 36})
    family = model.family(["crank", "coupler"], PEAK)
    values = np.random.default_rng(1).uniform([0.08, 0.24], [0.1, 0.28], (100_000, 2))
    for workers in (1, 2):
        began = time.perf_counter()
        found = family(values, threads=workers)
        took = time.perf_counter() - began
        print(f"variants: {len(values) / took * 60:.3g} a minute with {workers} threads, {found.ok.mean():.3f} complete")
    began = time.perf_counter()
    for crank, coupler in values[:500]:
        run = model.set({"parameters.crank": f"{crank} m", "parameters.coupler": f"{coupler} m"}).run()
        abs(run["driver.motor.effort"]).max()
    print(f"variants: {500 / (time.perf_counter() - began) * 60:.3g} a minute by set and run, one by one")


def digest(place: str) -> str:
    return hashlib.sha256((Path(place) / "variants.csv").read_bytes()).hexdigest()[:16]


def big() -> linkdyn.Study:
    tolerances = {
        f"parameters.{name}": {"value": f"{length} mm", "tolerance": "0.1 mm"}
        for name, length in {"base": 300, "crank": 100, "coupler": 250, "rocker": 200}.items()
    }
    return linkdyn.load("four-bar").set(tolerances | {"analysis.outputs": 91}).study(samples=100_000, responses=PEAK)


def ray() -> None:
    """100 000 variants by Ray, and with a worker killed."""
    import psutil  # type: ignore[import-untyped]
    import ray as library

    study = big()
    print(f"ray: {study.variants} variants, {study.chunks} chunks")
    cores = len(os.sched_getaffinity(0))
    library.init(num_cpus=cores, log_to_driver=False, include_dashboard=False, logging_level="error")
    with tempfile.TemporaryDirectory() as place:
        began = time.perf_counter()
        study.run(place, report=False)
        local, wanted = time.perf_counter() - began, digest(place)
    print(f"ray: local {local:.2f} s, {wanted}")
    # Start-up of the workers is not counted.
    library.get([library.remote(lambda: __import__("linkdyn").__version__).remote() for _ in range(4 * cores)])
    for shares in (2 * cores, 4 * cores):
        with tempfile.TemporaryDirectory() as place:
            began = time.perf_counter()
            study.run(place, "ray", shares=shares, report=False)
            took = time.perf_counter() - began
            same = "same bytes" if digest(place) == wanted else "OTHER BYTES"
            print(f"ray: {shares} shares {took:.2f} s, {100 * (took / local - 1):+.1f} %, {same}")
    with tempfile.TemporaryDirectory() as place:

        def kill() -> None:
            time.sleep(local / 4)
            workers = [p for p in psutil.Process().children(recursive=True) if "ray::compute" in " ".join(p.cmdline())]
            for worker in workers[:1]:
                os.kill(worker.pid, signal.SIGKILL)
            print(f"ray: killed {len(workers[:1])} of {len(workers)} workers")

        thread = threading.Thread(target=kill)
        thread.start()
        study.run(place, "ray", shares=4 * cores, report=False)
        thread.join()
        print("ray: worker killed,", "same bytes" if digest(place) == wanted else "OTHER BYTES")
    library.shutdown()


if __name__ == "__main__":
    for name in sys.argv[1:] or ["overhead", "memory", "threads", "variants", "ray"]:
        globals()[name]()
