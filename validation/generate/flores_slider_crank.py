"""Reference of the case `flores-slider-crank`: the first turn at each clearance, by the equations of `slider_crank_clearance.py`.

Run: python3 flores_slider_crank.py (some minutes)
"""

from math import sqrt
from pathlib import Path

import numpy as np
import scipy
from scipy.optimize import minimize_scalar

import slider_crank_clearance as model

FOLDER = Path(__file__).resolve().parent.parent / "flores-slider-crank"
CLEARANCES = [1e-4, 2e-4, 5e-4]
TURN, ROWS = 0.012, 121
# A peak is sought around the largest value of points so far apart at most [s], a hundredth of the shortest oscillation.
APART = 1e-6


def choose(clearance):
    """The model at another clearance; with it the stiffness."""
    model.CLEARANCE = clearance
    model.STIFFNESS = 4 / (3 * model.FLEXIBILITY) * sqrt(model.BEARING * (model.BEARING - clearance) / clearance)


def normal(t, y, phase, approach):
    """Normal force."""
    p = model.Point(t, y)
    return -(p.n.conjugate() * model.accelerate(p, phase, approach)[2]).real


def peak(of, start, end):
    """Largest value of a function on an interval."""
    times = np.linspace(start, end, 20 + int((end - start) / APART))
    values = [of(t) for t in times]
    k = int(np.argmax(values))
    low, high = times[max(k - 1, 0)], times[min(k + 1, len(times) - 1)]
    found = minimize_scalar(lambda t: -of(t), bounds=(low, high), method="bounded", options={"xatol": 1e-15})
    return max(values[k], -found.fun)


def turn(clearance, rtol):
    """Rows, and impacts: time, approach speed, largest penetration and normal force."""
    choose(clearance)
    times = np.linspace(0, TURN, ROWS)
    rows, impacts = [], []
    t, y, phase, approach = 0.0, [0.0, 0.0, 0.0, 0.0], model.FLIGHT, 0.0
    while True:
        events = model.EVENTS[phase]
        run = scipy.integrate.solve_ivp(
            model.rhs, (t, TURN), y, "DOP853", args=(phase, approach), events=list(events), rtol=rtol,
            atol=[rtol * 1e-5 * clearance] * 2 + [rtol * 1e-2] * 2, max_step=model.LONGEST, dense_output=True)
        for time in times[len(rows):]:
            if time > run.t[-1]:
                break
            rows.append(model.row(time, run.sol(time), phase, approach))
        if phase != model.FLIGHT:
            depth = peak(lambda t: model.Point(t, run.sol(t)).depth, t, run.t[-1])
            force = peak(lambda t: normal(t, run.sol(t), phase, approach), t, run.t[-1])
            impacts[-1][2:] = max(impacts[-1][2], depth), max(impacts[-1][3], force)
        t, y = run.t[-1], run.y[:, -1]
        if run.status != 1:
            return np.array(rows), np.array(impacts)
        fired = next(e for e, times_of in zip(events, run.t_events) if len(times_of))
        p = model.Point(t, y)
        if fired is model.MEET:
            approach = p.closing
            impacts.append([t, approach, 0.0, 0.0])
        phase = model.piece(p) if events[fired] is None else events[fired]


def main():
    tables = {"reference.csv": ["clearance[m]", *model.NAMES],
              "impacts.csv": ["clearance[m]", "time[s]", "approach_speed[m/s]", "penetration[m]", "force[N]"]}
    lines = {name: [] for name in tables}
    for clearance in CLEARANCES:
        rows, impacts = turn(clearance, 1e-13)
        for rtol in (1e-11, 1e-12):
            other, hits = turn(clearance, rtol)
            late = abs(hits[:, 0] - impacts[:, 0]).max() if len(hits) == len(impacts) else np.inf
            print(f"c {clearance:.0e}, rtol {rtol:.0e} from 1e-13: trajectory {model.far(other, rows):.1e} of the clearance, "
                  f"{len(impacts)} impacts, {late:.1e} s", flush=True)
        lines["reference.csv"] += [[clearance, *row] for row in rows]
        lines["impacts.csv"] += [[clearance, *row] for row in impacts]
    note = f"# SciPy {scipy.__version__}, solve_ivp, DOP853, rtol 1e-13, between events\n"
    for name, columns in tables.items():
        with open(FOLDER / name, "w", encoding="utf-8") as f:
            f.write(note + ",".join(columns) + "\n")
            f.writelines(",".join(f"{float(v) + 0.0:.15g}" for v in line) + "\n" for line in lines[name])


if __name__ == "__main__":
    main()
