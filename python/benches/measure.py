"""Measures what people rely on: overhead of a run, memory, threads, variants for each minute, studies, Ray.

python python/benches/measure.py [overhead|memory|threads|variants|cost|ray ...]
"""

from __future__ import annotations

import hashlib
import os
import signal
import statistics
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import linkdyn
from linkdyn import _linkdyn

PEAK = {"peak": "max(abs(driver.motor.effort))"}


def spread(values: list[float]) -> str:
    """Best, median and upper quartile, in microseconds."""
    _, median, upper = statistics.quantiles(values, n=4)
    return f"{min(values) * 1e6:.0f} best, {median * 1e6:.0f} median, {upper * 1e6:.0f} upper quartile [us]"


def overhead() -> None:
    """What a run of the lock from Python takes beside the call of the library, which is timed within it; and beside one that
    is made in this thread, in turn with it."""
    lock = linkdyn.load("lock")
    beside, paired, native, whole = [], [], [], []
    for _ in range(400):
        alone = lock._core._native()
        began = time.perf_counter()
        run = lock.run()
        took = time.perf_counter() - began
        beside.append(took - run._core._took)
        paired.append(took - alone)
        native.append(alone)
        whole.append(took)
        rows = len(run.t)
        # What a run leaves is given back between the clocks, of both.
        del run
    print(f"overhead: lock, {rows} rows, 400 rounds")
    print("overhead: the library alone        ", spread(native))
    print("overhead: m.run()                  ", spread(whole))
    print("overhead: beside the call within it", spread(beside))
    print("overhead: beside a call on its own ", spread(paired))


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
    """Two threads of Python beside one: studies and families, each computed by one thread."""
    family = linkdyn.load("slider-crank").family(["crank"], PEAK)
    values = np.linspace(0.03, 0.06, 4_000)[:, np.newaxis]
    press = linkdyn.load("slider-crank").set({"analysis.outputs": 91})
    study = press.study({"crank": "40 mm:60 mm:100", "rod": "150 mm:250 mm:80"}, responses=PEAK)
    for what, work in (
        ("studies", lambda: study.run(threads=1, report=False)),
        ("families", lambda: family(values, threads=1)),
    ):
        # Short works, many times: so some of both meet a machine that does nothing else.
        pairs = [(clocks(work, work), clocks(work, together=True)) for _ in range(12)]
        one, two = ([pair[place] for pair in pairs] for place in (0, 1))
        factor = min(wall for wall, _ in one) / min(wall for wall, _ in two)
        median = statistics.median(a[0] / b[0] for a, b in pairs)
        used = statistics.median(b[1] / a[1] for a, b in pairs)
        print(
            f"threads: two {what} at once, {factor:.2f} times as fast as one after the other (best of 12 each; median of",
            f"pairs {median:.2f}), for {used:.2f} times the processor time",
        )


def clocks(*work: Callable[[], object], together: bool = False) -> tuple[float, float]:
    """Time and processor time of works one after the other, or of one done by two threads at once [s]."""
    wall, used = time.perf_counter(), time.process_time()
    if together:
        both = [threading.Thread(target=work[0]) for _ in range(2)]
        for thread in both:
            thread.start()
        for thread in both:
            thread.join()
    else:
        for one in work:
            one()
    return time.perf_counter() - wall, time.process_time() - used


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


def cost() -> None:
    """What a study is made of: shares, variants, bytes, joining, reading."""
    four_bar = big()
    with tempfile.TemporaryDirectory() as place:
        empty = [clocks(lambda: four_bar.share(1 << 40, 1 << 40, place))[0] for _ in range(50)]
        print("cost: a share with nothing to do,", spread(empty))
        _, used = clocks(lambda: four_bar.share(1, four_bar.chunks, place, threads=1))
        rows = int(four_bar.plan["rows_per_chunk"])
        each = used / rows * 1e6
        print(f"cost: a chunk has {rows} variants: {used:.2f} s of a processor, {each:.1f} us each (four-bar, 91 outputs)")
    for count in (100_000, 1_000_000):
        parts(count)


def parts(count: int) -> None:
    """What small variants cost, joining and reading among it."""
    press = linkdyn.load("slider-crank").set({"analysis.outputs": 9})
    study = press.study({"crank": "40 mm:60 mm:1000", "rod": f"150 mm:250 mm:{count // 1000}"}, responses=PEAK)
    with tempfile.TemporaryDirectory() as place:
        chunks, table = Path(place) / "chunks", Path(place) / "variants.csv"
        _, used = clocks(lambda: study.share(1, 1, place, threads=1))
        kept = sum(path.stat().st_size for path in chunks.iterdir())
        _, joined = clocks(lambda: _linkdyn.command(["study", "merge", place, "--no-report"]))
        _, read = clocks(lambda: np.loadtxt(table, delimiter=",", skiprows=1, usecols=(2, 3, 4)))
        print(
            f"cost: {count} slider-cranks, 9 outputs: {used / count * 1e6:.2f} us each,",
            f"{kept / count:.1f} bytes in chunks, {table.stat().st_size / count:.1f} in variants.csv,",
            f"joined in {joined / count * 1e6:.2f} us each, read by NumPy in {read / count * 1e6:.2f} (processor time)",
        )


def ray() -> None:
    """100 000 variants by Ray, in turn with threads of this process, and with a worker killed."""
    import psutil  # type: ignore[import-untyped]
    import ray as library

    study = big()
    cores = len(os.sched_getaffinity(0))
    shares = 2 * cores
    library.init(num_cpus=cores, log_to_driver=False, include_dashboard=False, logging_level="error")
    # Start-up of the workers is not counted.
    library.get([library.remote(lambda: __import__("linkdyn").__version__).remote() for _ in range(4 * cores)])

    def used() -> float:
        """Processor time of this process and of all that it started [s]."""
        mine = psutil.Process()
        return sum(sum(one.cpu_times()[:2]) for one in [mine, *mine.children(recursive=True)])

    def once(**settings: Any) -> tuple[float, float, str]:
        with tempfile.TemporaryDirectory() as place:
            began, before = time.perf_counter(), used()
            study.run(place, report=False, **settings)
            return time.perf_counter() - began, used() - before, digest(place)

    pairs = [(once(), once(backend="ray", shares=shares)) for _ in range(5)]
    wanted = pairs[0][0][2]
    assert all(told[2] == wanted for pair in pairs for told in pair), "other bytes"
    local = min(pair[0][0] for pair in pairs)
    each = min(pair[0][1] for pair in pairs) / shares
    print(f"ray: {study.variants} variants, {study.chunks} chunks in {shares} shares of {each:.1f} s; same bytes, {wanted}")
    for place, what in ((0, "time"), (1, "processor time")):
        best = min(pair[1][place] for pair in pairs) / min(pair[0][place] for pair in pairs) - 1
        median = statistics.median(pair[1][place] / pair[0][place] - 1 for pair in pairs)
        told = ", ".join(f"{pair[0][place]:.1f} and {pair[1][place]:.1f}" for pair in pairs)
        print(f"ray: {what} {100 * best:+.1f} % (best of 5 each), {100 * median:+.1f} % (median of pairs)")
        print(f"ray: {what} of both [s]: {told}")
    with tempfile.TemporaryDirectory() as place:

        def kill() -> None:
            time.sleep(local / 4)
            workers = [p for p in psutil.Process().children(recursive=True) if "ray::compute" in " ".join(p.cmdline())]
            for worker in workers[:1]:
                os.kill(worker.pid, signal.SIGKILL)
            print(f"ray: killed {len(workers[:1])} of {len(workers)} workers")

        thread = threading.Thread(target=kill)
        thread.start()
        study.run(place, "ray", shares=shares, report=False)
        thread.join()
        print("ray: worker killed,", "same bytes" if digest(place) == wanted else "OTHER BYTES")
    library.shutdown()


if __name__ == "__main__":
    for name in sys.argv[1:] or ["overhead", "memory", "threads", "variants", "cost", "ray"]:
        globals()[name]()
