"""linkdyn, Exudyn and MuJoCo on the same mechanisms, in turn: error, CPU seconds, ratio, as a table in Markdown.

    python validation/peers/run.py [--rounds 3] [--only A02-10]
    python validation/peers/run.py --search [--only A02-10]

Needs `pip install exudyn mujoco scipy numpy` and cargo; a peer that can't be imported is left out, and the table says so.
With `--search` the whole grid of the peers' settings is tried instead, which takes minutes to hours a row: it says what to keep.
What is measured stands in README.md beside this script.
"""

import argparse
import dataclasses
import importlib
import importlib.metadata
import json
import math
import os
import platform
import subprocess
from dataclasses import dataclass

import numpy as np

import problems
from search import attempt, search

PEERS = {"Exudyn": "with_exudyn", "MuJoCo": "with_mujoco"}
# A short run is repeated for as long, and as often, as linkdyn's bench does it; a dear one is made once in all rounds.
SECONDS, MOST, SHORT, DEAR = 0.5, 200, 1.0, 10.0


@dataclass(frozen=True)
class Row:
    """A problem, its number of loops or links, the error wanted, the bench that has our row."""

    problem: str
    size: int
    wanted: float
    bench: str = "dynamics"

    @property
    def name(self):
        size = f"-{self.size}" if self.size else ""
        return f"{self.problem}{size}-{np.format_float_scientific(self.wanted, trim='-', exp_digits=1)}"


ROWS = [
    Row("A01", 0, 1e-6),
    Row("A02", 1, 1e-4), Row("A02", 1, 1e-6), Row("A02", 10, 1e-4), Row("A02", 40, 1e-4), Row("A02", 100, 1e-4),
    Row("A02", 1000, 1e-3),
    Row("A03", 0, 1e-3), Row("A03", 0, 1e-6),
    Row("chain", 10, 1e-5), Row("chain", 50, 1e-5), Row("chain", 100, 1e-5),
    Row("lock", 0, 1e-4, "six_bar"),
    Row("clearance", 0, 1e-2, "contact"), Row("clearance", 0, 1e-3, "contact"),
]


# ---------------------------------------------------------------- solvers: functions that run once → (error, CPU seconds)


def linkdyn(row):
    def run():
        command = ["cargo", "bench", "--quiet", "--bench", row.bench, "--", "--json", row.name]
        said = subprocess.run(command, cwd=problems.ROOT, check=True, capture_output=True, text=True).stdout
        found = json.loads(said.strip().splitlines()[-1])
        if row.problem == "lock":
            every = problems.LOCK_INSTANTS // (len(found["forces"]) - 1)
            found["error"] = problems.lock_error(found["forces"], np.arange(0, problems.LOCK_INSTANTS + 1, every))
        return found["error"], found["cpu"]
    return run


def repeated(run):
    """The same with the least CPU time of as many runs as linkdyn's bench makes."""
    def least():
        error, cpu = run()
        times = min(max(int(SECONDS / max(cpu, 1e-4)), 3), MOST) if cpu < SHORT else 1
        return error, min([cpu, *(run()[1] for _ in range(times - 1))])
    return least


def cheapest(peer, row, kept):
    """Of the settings kept the one that meets the error soonest, else the most accurate one."""
    found = [attempt(peer, row, dataclasses.replace(setting, size=size)) for setting, sizes in kept for size in sizes]
    met = [each for each in found if each.error <= row.wanted]
    if not met:
        return min(found, key=lambda each: each.error)
    # Those that are near are measured once more before one is chosen.
    least = min(each.cpu for each in met)
    near = sorted((each for each in met if each.cpu < 1.5 * least), key=lambda each: each.cpu)[:4]
    for each in near if least < SHORT else []:
        each.cpu = min([each.cpu, *(attempt(peer, row, each.setting).cpu for _ in range(3))])
    return min(near, key=lambda each: each.cpu)


def module(name):
    try:
        return importlib.import_module(PEERS[name])
    except ImportError as missing:
        if missing.name == PEERS[name]:
            raise
        return None


# ---------------------------------------------------------------- table


class Column:
    """A peer on a row: its chosen setting, and its least CPU time so far."""

    def __init__(self, name, row):
        self.peer, self.text, self.chosen, self.best = module(name), "", None, None
        if self.peer is None:
            self.text = "not installed"
            return
        kept = self.peer.KEPT.get(row.name, ())
        if not kept:
            self.text = "has not the problem"
            return
        self.chosen = cheapest(self.peer, row, kept)
        self.run = repeated(self.peer.prepare(row, self.chosen.setting))

    def measure(self):
        if self.chosen is None or (self.best and self.best[1] > DEAR):
            return
        error, cpu = self.run()
        self.best = (error, min(cpu, self.best[1] if self.best else math.inf))

    def cell(self, wanted, ours):
        if self.chosen is None:
            return self.text
        error, cpu = self.best
        missed = ", not met" if error > wanted else ""
        ratio = cpu / ours
        return f"{error:.1e}{missed}, {cpu:.2g}, {f'{ratio:.2g}' if ratio < 10 else f'{ratio:.0f}'}"


def measure(row, rounds):
    """The table's line, and the settings that were chosen."""
    ours, columns = linkdyn(row), {name: Column(name, row) for name in PEERS}
    best = (math.nan, math.inf)
    for _ in range(rounds):
        error, cpu = ours()
        best = (error, min(cpu, best[1]))
        for column in columns.values():
            column.measure()
    cells = [column.cell(row.wanted, best[1]) for column in columns.values()]
    line = "| " + " | ".join([row.name, f"{best[0]:.1e}, {best[1]:.2g}", *cells]) + " |"
    return line, [f"- {row.name}, {name}: {column.chosen.setting}" for name, column in columns.items() if column.chosen]


def machine():
    """Processor and versions."""
    processor = platform.processor()
    if os.path.exists("/proc/cpuinfo"):
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            named = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
        processor = named[0] if named else processor
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=problems.ROOT, capture_output=True, text=True)
    versions = [f"linkdyn {commit.stdout.strip()}"]
    for name in PEERS:
        try:
            versions.append(f"{name} {importlib.metadata.version(name.lower())}")
        except importlib.metadata.PackageNotFoundError:
            versions.append(f"{name} not installed")
    return f"{processor}; {', '.join(versions)}; Python {platform.python_version()}"


def print_table(rows, rounds):
    print(machine())
    print("\n| row | linkdyn: error, CPU s | Exudyn: error, CPU s, ratio | MuJoCo: error, CPU s, ratio |")
    print("| --- | --- | --- | --- |")
    chosen = []
    for row in rows:
        line, settings = measure(row, rounds)
        chosen += settings
        print(line, flush=True)
    print("\nSettings:\n")
    print("\n".join(chosen))


def print_search(rows, names):
    print(machine())
    for row in rows:
        for name in names:
            peer = module(name)
            if peer is None or not peer.grid(row):
                continue
            for found in search(peer, row, problems.span(row.problem)[1]):
                print(f"- {row.name}, {name}: {found.error:.1e}, {found.cpu:.3g} s: {found.setting}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3, help="every solver once per round, in turn")
    parser.add_argument("--only", default="", help="rows whose name begins so")
    parser.add_argument("--search", action="store_true", help="try the whole grid of settings instead")
    parser.add_argument("--peer", choices=PEERS, action="append", help="search this peer's alone")
    options = parser.parse_args()
    rows = [row for row in ROWS if row.name.startswith(options.only)]
    if options.search:
        print_search(rows, options.peer or PEERS)
    else:
        print_table(rows, options.rounds)


if __name__ == "__main__":
    main()
