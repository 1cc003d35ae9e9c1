"""A row of masses with stiff springs: linkdyn and SciPy's Radau in turn, at the same error: CPU seconds and their ratio.

    python validation/peers/stiff.py [--rounds 3]

Needs `pip install scipy numpy` and cargo. What is measured stands in README.md beside this script.
"""

import argparse
import json
import math
import os
import subprocess
import time

import numpy as np
import scipy.sparse as sparse
from scipy.integrate import solve_ivp

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
RATIO, PERIODS, ERROR = 1e4, 10.0, 1e-6


def row(n):
    """Stiffness matrix of masses of 1 kg, and its modes; the slowest has a period of 1 s, the fastest is RATIO times as fast."""
    ones = np.ones(n)
    free = np.diag(2 * ones) - np.diag(ones[1:], 1) - np.diag(ones[1:], -1)
    free[0, 0] = free[-1, -1] = 1

    def modes(soft):
        stiffness = free.copy()
        stiffness[0, 0] += soft
        squares, shapes = np.linalg.eigh(stiffness)
        return stiffness, np.sqrt(np.maximum(squares, 1e-300)), shapes

    low, high = 1e-16, 1.0
    for _ in range(60):
        middle = math.sqrt(low * high)
        frequencies = modes(middle)[1]
        low, high = (middle, high) if frequencies[-1] > RATIO * frequencies[0] else (low, middle)
    stiffness, frequencies, shapes = modes(low)
    unit = 2 * math.pi / frequencies[0]
    return stiffness * unit**2, frequencies * unit, shapes


def scipy_radau(n, rounds):
    """The cheapest of a ladder of tolerances that meets the error: error and least CPU time."""
    stiffness, frequencies, shapes = row(n)
    start = shapes[:, 0] / np.abs(shapes[:, 0]).max()
    parts = shapes.T @ start
    # Places and velocities of a mass beside each other: of the orders tried the one with the fastest factors.
    order = np.arange(2 * n).reshape(2, n).T.ravel()
    system = sparse.bmat([[None, sparse.eye(n)], [-sparse.csr_matrix(stiffness), None]]).tocsr()[order][:, order]
    jacobian = system.tocsc()
    initial = np.r_[start, np.zeros(n)][order]
    rows = system.tocsr()
    times = np.linspace(0, PERIODS, 24)
    exact = shapes @ (np.cos(np.outer(frequencies, times)) * parts[:, None])
    for half in range(8, 25):
        tolerance = 10 ** (-half / 2)
        best = math.inf
        for _ in range(rounds):
            before = time.process_time()
            found = solve_ivp(lambda _, y: rows @ y, (0, PERIODS), initial, method="Radau", rtol=tolerance, atol=tolerance,
                              jac=jacobian, t_eval=times)
            best = min(best, time.process_time() - before)
            error = np.abs(found.y[0::2] - exact).max()
            if error > ERROR:
                break
        if error <= ERROR:
            return error, best, tolerance
    raise RuntimeError(f"N = {n}: no tolerance meets {ERROR}")


def linkdyn():
    command = ["cargo", "bench", "--quiet", "--bench", "stiff", "--", "--json"]
    said = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return {found["masses"]: found for found in map(json.loads, said.strip().splitlines())}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--rounds", type=int, default=3)
    rounds = arguments.parse_args().rounds
    print(f"{'N':>5} {'linkdyn error':>14} {'ms':>9} {'SciPy error':>12} {'rtol':>8} {'ms':>9} {'ratio':>6}")
    for n, ours in linkdyn().items():
        error, cpu, tolerance = scipy_radau(n, rounds)
        print(f"{n:>5} {ours['error']:>14.1e} {ours['cpu'] * 1e3:>9.2f} {error:>12.1e} {tolerance:>8.0e} {cpu * 1e3:>9.1f} "
              f"{cpu / ours['cpu']:>6.1f}")


if __name__ == "__main__":
    main()
