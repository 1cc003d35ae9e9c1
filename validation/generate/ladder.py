"""References and SciPy's errors of the case `tolerance-ladder`: DOP853 on minimal coordinates, rtol = atol from 1e-5 to 1e-10.

Run: python3 ladder.py
"""

import csv
import json
from math import cos, pi, sin

import numpy as np
import scipy
from dynamics import CASES, Free, a02_exact
from mpmath import asin, ellipfun, ellipk, mp, mpf
from mpmath import sqrt as root
from scipy.integrate import solve_ivp

FOLDER = CASES / "tolerance-ladder"
NOTE = f"# SciPy {scipy.__version__}, solve_ivp, DOP853, rtol = atol\n"
LADDER = [10.0**-k for k in range(5, 11)]


def save(name, columns, rows, note=""):
    with open(FOLDER / name, "w", encoding="utf-8") as f:
        f.write(note + ",".join(columns) + "\n")
        f.writelines(",".join(f"{float(v):.17g}" for v in row) + "\n" for row in rows)


def rows_of(case, *columns):
    with open(CASES / case / "reference.csv", encoding="utf-8") as f:
        return np.array([[float(row[c]) for c in ("time[s]", *columns)] for row in csv.DictReader(f)])


def a01_exact(t):
    g, m = mpf("9.81"), mpf(1) / 2
    phi = 2 * asin(root(m) * ellipfun("sn", root(g) * t - ellipk(m), m=m))
    return mp.sin(phi), -mp.cos(phi)


def solve(f, start, times, tolerance):
    run = solve_ivp(f, (0, times[-1]), start, method="DOP853", t_eval=times, rtol=tolerance, atol=tolerance)
    assert run.success
    return run.y, run.nfev


def distance(exact):
    return lambda y: np.hypot(np.cos(y[0]) - exact[:, 1], np.sin(y[0]) - exact[:, 2]).max()


def cart(_, y):
    mass, g = 1e-6, 9.81
    s, c = sin(y[1]), cos(y[1])
    push = c * (y[3] ** 2 - g * s) / (mass + c * c)
    return [y[2], y[3], push, push * s - g * c]


class Squeezer(Free):
    """In the crank's angle alone: loops closed by Newton's method from the point before."""

    def __init__(self):
        super().__init__(json.loads((CASES / "andrews" / "case.json").read_text(encoding="utf-8"))["model"])
        self.z, self.w = self.start()
        self.crank = self.index["OF"]
        self.rest = [k for k in range(self.n) if k != self.crank]

    def __call__(self, _, y):
        z, w = self.z.copy(), np.zeros(self.n)
        z[self.crank], w[self.crank] = y
        for _ in range(30):
            phi, c, _ = self.closure(z, w)
            step = np.linalg.solve(c[:, self.rest], phi)
            z[self.rest] -= step
            if abs(step).max() < 1e-13:
                break
        else:
            raise ArithmeticError("the loops do not close")
        _, c, _ = self.closure(z, w)
        w[self.rest] = -np.linalg.solve(c[:, self.rest], c[:, self.crank] * w[self.crank])
        self.z = z
        return [y[1], self.acceleration(z, w)[self.crank]]


def main():
    times = [mpf(k) / 10 for k in range(101)]
    exact = [(t, *a01_exact(t), *a02_exact(1, t)[:2]) for t in times]
    points = [f"{name}.{axis}[m]" for name in ("A01", "A02-1") for axis in "xy"]
    save("reference.csv", ["time[s]", *points], exact)
    long = [(t, *a02_exact(2, t)[:2], *a02_exact(40, t)[:2]) for t in range(0, 201, 2)]
    save("long.csv", ["time[s]", *[f"A02-{n}.{axis}[m]" for n in (2, 40) for axis in "xy"]], long)

    exact = np.array(exact, dtype=float)
    crank = rows_of("andrews", "OF.angle[rad]")
    sway = rows_of("cart-pole", "cart.x[m]", "pole.angle[rad]")
    c = 9.81 * 12 / 10

    def rms(y):
        return np.sqrt(np.mean((y[:2].T - sway[:, 1:]) ** 2))

    problems = {
        "A01": (lambda: lambda _, y: [y[1], -9.81 * cos(y[0])], [pi, 0], exact[:, 0], distance(exact[:, [0, 1, 2]])),
        "A02-1": (lambda: lambda _, y: [y[1], -c * cos(y[0])], [pi / 2, -1], exact[:, 0], distance(exact[:, [0, 3, 4]])),
        "andrews": (Squeezer, [crank[0, 1], 0], crank[:, 0], lambda y: abs(y[0] - crank[:, 1]).max()),
        "cart-pole": (lambda: cart, [0, 0, 0, 0], sway[:, 0], rms),
    }
    rows = []
    for tolerance in LADDER:
        row = [tolerance]
        for make, start, times, error in problems.values():
            y, evaluations = solve(make(), start, times, tolerance)
            row += [error(y), evaluations]
        rows.append(row)
        print(" ".join(f"{v:10.3g}" for v in row))
    columns = ["tolerance[-]", *[f"{name}.{what}[-]" for name in problems for what in ("error", "evaluations")]]
    save("scipy.csv", columns, rows, NOTE)

    long, rows = np.array(long, dtype=float), []
    for n, at in ((2, [0, 1, 2]), (40, [0, 3, 4])):
        c = 9.81 * 3 * (3 * n + 1) / (2 * (4 * n + 1))
        y, _ = solve(lambda _, y: [y[1], -c * cos(y[0])], [pi / 2, -1], long[:, 0], 1e-8)
        energy = y[1] ** 2 / 2 + c * np.sin(y[0])
        rows.append((n, distance(long[:, at])(y), np.ptp(energy) / (y[1] ** 2 / 2).max()))
        print(*rows[-1])
    save("long-scipy.csv", ["loops[-]", "error[m]", "drift[-]"], rows, NOTE)


if __name__ == "__main__":
    main()
