"""Cases of forward dynamics: benchmarks with published digits, closed forms, and motions integrated here.

The motions integrated here use the angles of the bodies (and slides along ground) as coordinates: every point is a sum of turned vectors,
loops are closed by multipliers (index 1), and SciPy's DOP853 integrates at 1e-13. Joint forces follow from the free bodies.

Run: python3 dynamics.py [case …]
"""

import json
import sys
from math import atan2, cos, hypot, pi, sin, sqrt
from pathlib import Path

import numpy as np
from mpmath import asin, ellipfun, ellipk, mp, mpf
from mpmath import sqrt as root
from planar import text
from scipy.integrate import solve_ivp

HERE = Path(__file__).resolve().parent
CASES = HERE.parent
mp.dps = 40
OWN = "own dimensions"


def pin(first, second):
    return {"type": "revolute", "between": [first, second]}


def link(mass, inertia, com, pose, **points):
    return {"mass": mass, "inertia": inertia, "com": list(com), "points": {k: list(v) for k, v in points.items()},
            "pose": {"position": [round(float(v), 6) for v in pose[:2]], "angle": round(float(pose[2]), 6)}}


def along(p, q):
    return (p[0], p[1], atan2(q[1] - p[1], q[0] - p[0]))


def dynamics(end, outputs, rtol, atol):
    return {"type": "dynamics", "end": end, "outputs": outputs, "solver": {"rtol": rtol, "atol": atol}}


def model(name, about, source, gravity, **parts):
    return {"format": "linkdyn/1", "name": name, "about": about, "source": source, "units": "SI", "gravity": gravity, **parts}


def turn(angle, a):
    c, s = cos(angle), sin(angle)
    return np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])


def perp(a):
    return np.array([-a[1], a[0]])


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


class Free:
    """A mechanism of pins, and of slides on the ground, in the bodies' angles and the slides."""

    def __init__(self, words):
        self.words, self.bodies = words, {k: v for k, v in words["bodies"].items() if k != "ground"}
        self.joints = {n: (j["type"], *[tuple(e.split(".")) for e in j["between"]], j) for n, j in words["joints"].items()}
        self.index, self.slides, self.origin = {}, {}, {"ground": []}
        self.closing, waiting = [], dict(self.joints)
        # Slides first: a spanning tree from the ground, whatever is left over closes a loop.
        for name, (kind, first, second, joint) in self.joints.items():
            if kind == "prismatic":
                assert first[0] == "ground" and joint.get("angle", 0) == 0
                self.slides[second[0]], self.index[second[0]] = np.array(joint["axis"], float) / hypot(*joint["axis"]), len(self.index)
                at = np.array(self.local(first), float) - np.array(self.local(second), float)
                self.origin[second[0]] = [("fixed", at), ("slide", second[0])]
                del waiting[name]
        while waiting:
            for name, (kind, first, second, joint) in list(waiting.items()):
                if first[0] in self.origin and second[0] in self.origin:
                    self.closing.append((first, second))
                elif first[0] in self.origin or second[0] in self.origin:
                    if second[0] in self.origin:
                        first, second = second, first
                    self.index[second[0]] = len(self.index)
                    self.origin[second[0]] = self.chain(first) + [("turned", second[0], -np.array(self.local(second), float))]
                else:
                    continue
                del waiting[name]
        self.n = len(self.index)

    def local(self, end):
        return self.words["bodies"][end[0]]["points"][end[1]]

    def upright(self, body):
        return body == "ground" or body in self.slides

    def chain(self, end, local=None):
        """A point as a sum of terms."""
        a = np.array(self.local(end) if local is None else local, float)
        return self.origin[end[0]] + [("fixed", a) if self.upright(end[0]) else ("turned", end[0], a)]

    def com(self, body):
        return self.chain((body,), self.bodies[body].get("com", [0, 0]))

    def angle(self, body, z):
        return 0.0 if self.upright(body) else z[self.index[body]]

    def turning(self, body):
        row = np.zeros(self.n)
        if not self.upright(body):
            row[self.index[body]] = 1.0
        return row

    def jets(self, chain, z, w):
        """Place, ∂place/∂z, and what is quadratic in the rates in its acceleration."""
        p, jac, bias = np.zeros(2), np.zeros((2, self.n)), np.zeros(2)
        for kind, *rest in chain:
            if kind == "fixed":
                p += rest[0]
                continue
            k = self.index[rest[0]]
            if kind == "slide":
                p += z[k] * self.slides[rest[0]]
                jac[:, k] += self.slides[rest[0]]
            else:
                a = turn(z[k], rest[1])
                p += a
                jac[:, k] += perp(a)
                bias -= w[k] ** 2 * a
        return p, jac, bias

    def applied(self, z, w):
        """[(body, place, ∂place/∂z, force)], [(body, torque)], potential energy."""
        forces, torques, potential = [], [], 0.0
        g = np.array(self.words["gravity"], float)
        for name, body in self.bodies.items():
            p, jac, _ = self.jets(self.com(name), z, w)
            forces.append((name, p, jac, body["mass"] * g))
            potential -= body["mass"] * g @ p
        for f in self.words.get("forces", {}).values():
            if f["type"] == "spring":
                ends = [tuple(e.split(".")) for e in f["between"]]
                (p, jp, _), (q, jq, _) = [self.jets(self.chain(e), z, w) for e in ends]
                d = q - p
                length = hypot(*d)
                rate = d @ ((jq - jp) @ w) / length
                pull = f["stiffness"] * (length - f["free_length"]) + f.get("damping", 0) * rate
                forces += [(ends[0][0], p, jp, pull * d / length), (ends[1][0], q, jq, -pull * d / length)]
                potential += f["stiffness"] * (length - f["free_length"]) ** 2 / 2
            elif f["type"] == "torsion_spring":
                a, b = f["between"]
                stretch = self.angle(b, z) - self.angle(a, z) - f.get("free_angle", 0)
                moment = f["stiffness"] * stretch + f.get("damping", 0) * (self.turning(b) - self.turning(a)) @ w
                torques += [(a, moment), (b, -moment)]
                potential += f["stiffness"] * stretch**2 / 2
            elif f["type"] == "torque":
                torques.append((f["body"], f["value"]))
            else:
                end = tuple(f["at"].split("."))
                forces.append((end[0], *self.jets(self.chain(end), z, w)[:2], np.array(f["vector"], float)))
        return forces, torques, potential

    def closure(self, z, w):
        rows = [[x - y for x, y in zip(self.jets(self.chain(a), z, w), self.jets(self.chain(b), z, w))] for a, b in self.closing]
        if not rows:
            return np.zeros(0), np.zeros((0, self.n)), np.zeros(0)
        return [np.concatenate(part) for part in zip(*rows)]

    def acceleration(self, z, w):
        mass, rhs = np.zeros((self.n, self.n)), np.zeros(self.n)
        for name, body in self.bodies.items():
            _, jac, bias = self.jets(self.com(name), z, w)
            t = self.turning(name)
            mass += body["mass"] * jac.T @ jac + body["inertia"] * np.outer(t, t)
            rhs -= body["mass"] * jac.T @ bias
        forces, torques, _ = self.applied(z, w)
        for _, _, jac, force in forces:
            rhs += jac.T @ force
        for body, torque in torques:
            rhs += self.turning(body) * torque
        _, c, bias = self.closure(z, w)
        whole = np.block([[mass, c.T], [c, np.zeros((len(c), len(c)))]])
        return np.linalg.solve(whole, np.concatenate([rhs, -bias]))[: self.n]

    def start(self):
        """The state of `initial`, the rest closed from the poses by Newton's method."""
        z, w, fixed = np.zeros(self.n), np.zeros(self.n), []
        for body, k in self.index.items():
            spec, given = self.words["bodies"][body], self.words.get("initial", {}).get(body, {})
            if body in self.slides:
                joint = next(j for j in self.joints.values() if j[0] == "prismatic" and j[2][0] == body)
                off = np.array(spec["pose"]["position"], float) - self.origin[body][0][1]
                z[k] = off @ self.slides[body]
                assert joint[1][0] == "ground"
            else:
                z[k] = spec["pose"]["angle"]
                if "angle" in given:
                    z[k], w[k] = given["angle"], given["angular_velocity"]
                    fixed.append(k)
        rest = [k for k in range(self.n) if k not in fixed]
        for _ in range(30):
            phi, c, _ = self.closure(z, w)
            if not len(phi):
                return z, w
            z[rest] -= np.linalg.solve(c[:, rest], phi)
        phi, c, _ = self.closure(z, w)
        assert abs(phi).max() < 1e-15, phi
        w[rest] = -np.linalg.solve(c[:, rest], c[:, fixed] @ w[fixed])
        return z, w

    def integrate(self, times, rtol):
        z, w = self.start()
        n = self.n

        def f(_, y):
            return np.concatenate([y[n:], self.acceleration(y[:n], y[n:])])

        run = solve_ivp(f, (0, times[-1]), np.concatenate([z, w]), method="DOP853", t_eval=times, rtol=rtol, atol=rtol)
        assert run.success
        return run.y.T

    def row(self, t, y):
        """Columns and values at a state."""
        z, w = y[: self.n], y[self.n :]
        a = self.acceleration(z, w)
        out, kinetic, places, inertial = {"time[s]": t}, 0.0, {}, []
        units = ["m", "m", "rad", "m/s", "m/s", "rad/s", "m/s^2", "m/s^2", "rad/s^2"]
        for name, body in self.bodies.items():
            p, jac, bias = self.jets(self.origin[name], z, w)
            spin, alpha = self.turning(name) @ w, self.turning(name) @ a
            values = [*p, self.angle(name, z), *(jac @ w), spin, *(jac @ a + bias), alpha]
            for quantity, unit, value in zip("x y angle vx vy omega ax ay alpha".split(), units, values):
                out[f"{name}.{quantity}[{unit}]"] = value
            places[name], jac, bias = self.jets(self.com(name), z, w)
            kinetic += body["mass"] * (jac @ w) @ (jac @ w) / 2 + body["inertia"] * spin**2 / 2
            inertial += [*(body["mass"] * (jac @ a + bias)), body["inertia"] * alpha]
        order = {name: 3 * k for k, name in enumerate(self.bodies)}
        forces, torques, potential = self.applied(z, w)

        def load(vector, body, place, force, torque=0.0):
            if body != "ground":
                k = order[body]
                vector[k : k + 2] += force
                vector[k + 2] += cross(place - places[body], force) + torque

        # Free bodies: inertial = known + reactions.
        rhs = np.array(inertial)
        for body, place, _, force in forces:
            load(rhs, body, place, -force)
        for body, torque in torques:
            load(rhs, body, np.zeros(2), np.zeros(2), -torque)
        matrix, unknowns = [], []
        for name, (kind, first, second, joint) in self.joints.items():
            place = self.jets(self.chain(second), z, w)[0]
            if kind == "revolute":
                modes = [(np.array([1.0, 0]), 0.0), (np.array([0, 1.0]), 0.0)]
            else:
                modes = [(perp(self.slides[second[0]]), 0.0), (np.zeros(2), 1.0)]
            for force, torque in modes:
                column = np.zeros(len(rhs))
                load(column, second[0], place, force, torque)
                load(column, first[0], place, -force, -torque)
                matrix.append(column)
                unknowns.append((name, force, torque))
        matrix = np.array(matrix).T
        solved = np.linalg.lstsq(matrix, rhs, rcond=None)[0]
        off = abs(matrix @ solved - rhs).max()
        assert off <= 1e-9 * max(1.0, abs(rhs).max()), off
        for name, (kind, *_) in self.joints.items():
            mine = [(force, torque, s) for (of, force, torque), s in zip(unknowns, solved) if of == name]
            out[f"joint.{name}.fx[N]"], out[f"joint.{name}.fy[N]"] = sum(force * s for force, _, s in mine)
            if kind == "prismatic":
                out[f"joint.{name}.torque[N*m]"] = sum(torque * s for _, torque, s in mine)
        out["energy.kinetic[J]"], out["energy.potential[J]"] = kinetic, potential
        return out


def write(name, words, rows, how, tolerance=None, compare=None):
    folder = CASES / name
    folder.mkdir(exist_ok=True)
    case = {"about": words["about"], "source": words["source"], "model": words}
    if tolerance:
        # Position, velocity, and the rest where it differs.
        position, velocity, rest = (*tolerance, tolerance[-1])[:3]
        case["tolerance"] = {"position": position, "velocity": velocity, "acceleration": rest, "force": rest, "effort": rest}
    if compare:
        case["compare"] = [{"column": "*", "tolerance_absolute": compare}]
    (folder / "case.json").write_text(text(case) + "\n", encoding="utf-8")
    columns = list(rows[0]) + [c for c in rows[-1] if c not in rows[0]]
    with open(folder / "reference.csv", "w", encoding="utf-8") as f:
        f.write(",".join(columns) + "\n")
        for row in rows:
            cells = (row.get(c, "") for c in columns)
            f.write(",".join(v if isinstance(v, str) else f"{float(v):.17g}" for v in cells) + "\n")
    (folder / "SOURCE.md").write_text(f"# {name}\n\n{how.strip()}\n", encoding="utf-8")
    print(f"{name}: {len(rows)} rows")


def integrated(name, words, every, how, tolerance):
    """A case whose rows are integrated here, twice, to tell their error."""
    free = Free(words)
    analysis = words["analysis"]
    times = [analysis["end"] * k / (analysis["outputs"] - 1) for k in range(0, analysis["outputs"], every)]
    fine, coarse = [free.integrate(times, rtol) for rtol in (1e-13, 1e-12)]
    gap = max(abs(free.closure(y[: free.n], y[free.n :])[0]).max(initial=0.0) for y in fine)
    off = abs(fine - coarse).max()
    how += f"""

Integrated by `../generate/dynamics.py` in the bodies' angles (and slides), loops closed by multipliers, DOP853 of SciPy at rtol = atol = 1e-13. At 1e-12 the
states differ by {off:.1e}; the loops gape by {gap:.1e} m at most. Joint forces follow from the free bodies by Newton and Euler."""
    print(f"{name}: estimated error {off:.1e}, gap {gap:.1e}")
    write(name, words, [free.row(t, y) for t, y in zip(times, fine)], how, tolerance)


# ---- Benchmarks

A01 = "IFToMM multibody benchmark library, problem A01 (simple pendulum)"
A02 = "IFToMM multibody benchmark library, problem A02 (N four-bar mechanism)"
IVP = "Test Set for Initial Value Problem Solvers (Mazzia and Magherini)"
COPIES = "copies of the library's solution files in the public repositories Jiaqi-knight/simEngine3D and mikevignos/simEngine3D-Vignos"


def official(file):
    lines = (HERE / "data" / file).read_text(encoding="utf-8").splitlines()
    return [line.split(",") for line in lines if not line.startswith("#")]


def pendulum(about, end, outputs, rtol, atol):
    return model(
        "Simple pendulum", about, A01, [0, -9.81],
        bodies={"ground": {"points": {"O": [0, 0]}},
                "bob": {"mass": 1, "inertia": 0, "com": [1, 0], "points": {"O": [0, 0], "B": [1, 0]}, "pose": {"angle": pi}}},
        joints={"pin": pin("ground.O", "bob.O")}, initial={"bob": {"angle": pi, "angular_velocity": 0}},
        points=["bob.B"], analysis=dynamics(end, outputs, rtol, atol))


def a01_pendulum():
    words = pendulum("A point mass on a massless rod falls from the horizontal: to 20 s, and after 2000 s.", 2000, 4001, 1e-12, 1e-13)
    words["analysis"]["columns"] = ["bob.*"]
    rows = [{"time[s]": t, "bob.B.x[m]": x, "bob.B.y[m]": y} for t, x, y in official("a01.csv")]
    write("a01-pendulum", words, rows, f"""
Problem A01 of the IFToMM multibody benchmark library: m = 1 kg, L = 1 m, g = 9.81 m/s², at rest at x = −1 m. Rows are the library's own
solution, read in {COPIES}: six digits, every 0.5 s to 20 s, and 2000 s.
Tolerance: 1e-6 m, of which 5e-7 is their rounding.""", compare=1e-6)


def a01_pendulum_exact():
    words = pendulum("A point mass on a massless rod falls from the horizontal, against elliptic functions.", 20, 41, 1e-11, 1e-13)
    g, m, rows = mpf("9.81"), mpf(1) / 2, []
    for k in range(41):
        # φ from the lowest position, −π/2 at the start: sin(φ/2) = √m sn(√g t − K).
        u = root(g) * k / 2 - ellipk(m)
        phi = 2 * asin(root(m) * ellipfun("sn", u, m=m))
        rate = 2 * root(g * m) * ellipfun("cn", u, m=m)
        x, y = mp.sin(phi), -mp.cos(phi)
        pull = rate**2 - g * y
        rows.append({"time[s]": k / 2, "bob.angle[rad]": phi + 3 * mp.pi / 2, "bob.omega[rad/s]": rate, "bob.alpha[rad/s^2]": -g * x,
                     "bob.B.x[m]": x, "bob.B.y[m]": y, "bob.B.vx[m/s]": -y * rate, "bob.B.vy[m/s]": x * rate,
                     "joint.pin.fx[N]": -pull * x, "joint.pin.fy[N]": -pull * y,
                     "energy.kinetic[J]": rate**2 / 2, "energy.potential[J]": g * y})
    write("a01-pendulum-exact", words, rows, """
The pendulum of `a01-pendulum`, by Jacobi's elliptic functions with 40 digits: sin(φ/2) = k sn(√(g/L) t − K), k² = 1/2, φ from the
lowest position. The rod pulls with m (L φ̇² + g cos φ).""", tolerance=(1e-9, 1e-8))


def four_bars(n, end, outputs, rtol, atol):
    bodies, joints = {"ground": {"points": {f"A{k}": [k, 0] for k in range(n + 1)}}}, {}
    rod = {"mass": 1, "inertia": 1 / 12, "com": [0.5, 0]}
    for k in range(n + 1):
        bodies[f"rocker{k}"] = link(**rod, pose=(k, 0, pi / 2), A=(0, 0), B=(1, 0))
        joints[f"a{k}"] = pin(f"ground.A{k}", f"rocker{k}.A")
    for k in range(n):
        bodies[f"coupler{k}"] = link(**rod, pose=(k, 1, 0), L=(0, 0), R=(1, 0))
        joints[f"l{k}"] = pin(f"rocker{k}.B", f"coupler{k}.L")
        joints[f"r{k}"] = pin(f"coupler{k}.R", f"rocker{k + 1}.B")
    return model(f"{n} four-bars", f"{n} square four-bars side by side with one degree of freedom, flat twice in a turn.", A02, [0, -9.81],
                 bodies=bodies, joints=joints, initial={"rocker0": {"angle": pi / 2, "angular_velocity": -1}},
                 points=["rocker0.B"], analysis=dynamics(end, outputs, rtol, atol))


def a02_exact(n, t):
    """sin θ, cos θ and θ' of the rockers, which stay parallel: θ'' = c sin θ from θ = 0, θ' = 1."""
    c = mpf("9.81") * 3 * (3 * n + 1) / (2 * (4 * n + 1))
    m = 4 * c / (1 + 4 * c)
    u = root(1 + 4 * c) / 2 * t + ellipk(m)
    sn, cn = ellipfun("sn", u, m=m), ellipfun("cn", u, m=m)
    return -2 * sn * cn, 2 * sn**2 - 1, root(1 + 4 * c * cn**2)


def a02_four_bars_2():
    n, rows = 2, []
    for k in range(101):
        s, c, rate = a02_exact(n, mpf(k) / 10)
        row = {"time[s]": k / 10, "rocker0.B.x[m]": s, "rocker0.B.y[m]": c, "rocker0.B.vx[m/s]": c * rate, "rocker0.B.vy[m/s]": -s * rate}
        for i in range(n + 1):
            row[f"rocker{i}.omega[rad/s]"] = -rate
        for i in range(n):
            row |= {f"coupler{i}.x[m]": i + s, f"coupler{i}.y[m]": c, f"coupler{i}.angle[rad]": 0, f"coupler{i}.omega[rad/s]": 0}
        row["energy.kinetic[J]"] = rate**2 / 2 * (mpf(n + 1) / 3 + n)
        row["energy.potential[J]"] = mpf("9.81") * c * (mpf(n + 1) / 2 + n)
        rows.append(row)
    x, y, _ = a02_exact(2, mpf(10))
    write("a02-four-bars-2", four_bars(n, 10, 101, 1e-11, 1e-12), rows, f"""
Problem A02 of the IFToMM multibody benchmark library with two loops (the library's "double four bar mechanism"): uniform rods of 1 m and 1 kg, upright,
the first joint at 1 m/s. All rockers stay parallel, so that θ'' = (g/L) · 3(3N+1)/(2(4N+1)) · sin θ, θ from upright; its solution by Jacobi's elliptic
functions with 40 digits. Every turn passes two flat positions, where each loop could fold over. At t = 10 s the formula gives ({mp.nstr(x, 12)}, {mp.nstr(y, 12)});
Exudyn's example fourBarMechanismIftomm.py prints (0.3284573768, 0.9445187937) at h = 1.25e-4.""", tolerance=(1e-8, 1e-7))


def a02_four_bars_40():
    words = four_bars(40, 20, 81, 1e-10, 1e-11)
    words["analysis"]["columns"] = ["rocker0.*", "rocker40.*"]
    rows, far = [], 0
    for t, x, y in official("a02.csv"):
        s, c, _ = a02_exact(40, mpf(t))
        far = max(far, abs(mpf(x) - s), abs(mpf(y) - c))
        rows.append({"time[s]": t, "rocker0.B.x[m]": x, "rocker0.B.y[m]": y})
    write("a02-four-bars-40", words, rows, f"""
Problem A02 of the IFToMM multibody benchmark library: 40 loops, 81 uniform rods of 1 m and 1 kg, upright, the first joint at 1 m/s. Rows are the library's
own solution (an ADAMS run), read in {COPIES}: six digits, every 0.25 s.
From the closed form of `a02-four-bars-2` they differ by up to {mp.nstr(far, 2)} m, so they are compared to 5e-6 m.""", compare=5e-6)


def andrews():
    a, b, c = (-0.06934, -0.00227), (-0.03635, 0.03273), (0.014, 0.072)
    beta, theta, gamma, phi, delta, omega, epsilon = (
        -0.0617138900142764496358948458001, 0.0, 0.455279819163070380255912382449, 0.222668390165885884674473185609,
        0.487364979543842550225598953530, -0.222668390165885884674473185609, 1.23054744454982119249735015568)
    f, g, h = turn(beta, (0.007, 0)), np.array(a) + turn(delta, (0.04, 0)), np.array(a) + turn(epsilon, (0, -0.04))
    words = model(
        "Andrews' squeezer", "Seven bodies, three loops and a stiff spring, driven by a constant torque for 30 ms.", IVP, [0, 0],
        bodies={"ground": {"points": {"O": [0, 0], "A": list(a), "B": list(b), "C": list(c)}},
                "OF": link(0.04325, 2.194e-6, (0.00092, 0), (0, 0, beta), O=(0, 0), F=(0.007, 0)),
                "FE": link(0.00365, 4.410e-7, (-0.0115, 0), (*f, beta + theta), F=(0, 0), E=(-0.028, 0)),
                "BDE": link(0.02373, 5.255e-6, (0.01043, -0.01874), (*b, gamma), B=(0, 0), D=(0.02, -0.018), E=(0, -0.035)),
                "GE": link(0.00706, 5.667e-7, (0, -0.00579), (*g, phi + delta), G=(0, 0), E=(0, -0.02)),
                "AG": link(0.07050, 1.169e-5, (0.02308, 0.00916), (*a, delta), A=(0, 0), G=(0.04, 0)),
                "HE": link(0.00706, 5.667e-7, (0.00579, 0), (*h, omega + epsilon), H=(0, 0), E=(0.02, 0)),
                "AH": link(0.05498, 1.912e-5, (-0.00449, -0.01228), (*a, epsilon), A=(0, 0), H=(0, -0.04))},
        joints={"O": pin("ground.O", "OF.O"), "F": pin("OF.F", "FE.F"), "E1": pin("FE.E", "BDE.E"), "E2": pin("FE.E", "GE.E"),
                "E3": pin("FE.E", "HE.E"), "B": pin("ground.B", "BDE.B"), "G": pin("AG.G", "GE.G"), "A1": pin("ground.A", "AG.A"),
                "A2": pin("ground.A", "AH.A"), "H": pin("AH.H", "HE.H")},
        forces={"spring": {"type": "spring", "between": ["ground.C", "BDE.D"], "stiffness": 4530, "free_length": 0.07785},
                "motor": {"type": "torque", "body": "OF", "value": 0.033}},
        initial={"OF": {"angle": beta, "angular_velocity": 0}}, analysis=dynamics(0.03, 31, 1e-12, 1e-12))
    free, times = Free(words), [0.03 * k / 30 for k in range(0, 31, 3)]
    rows = [free.row(t, y) for t, y in zip(times, free.integrate(times, 1e-13))]
    # The published end: angles of bodies are sums of the test set's.
    q = ["15.81077119629904", "-15.75637105984298", "0.04082224013073101", "-0.5347301163226948", "0.5244099658805304", "0.5347301163226948",
         "1.048080741042263"]
    v = ["1139.920302151208", "-1424.379294994111", "11.03291221937134", "19.29337464421385", "0.5735699284790808", "-19.29337464421385",
         "0.3231791658026955"]
    rates = ["-24631.76316946196", "51850.37701610329", "324102.5686413781", "566749.3645176213", "16743.62929479361", "-566749.3645176222",
             "9826.520791458422"]
    multipliers = ["199.1753333731910", "-29.75531228015052", "23.06654119098399", "31.45271365475927", "22.64249232082739", "11.61740700019673"]
    sums = {"OF": [0], "FE": [0, 1], "BDE": [2], "GE": [3, 4], "AG": [4], "HE": [5, 6], "AH": [6]}
    end, worst = {"time[s]": "0.03"}, {}
    for column, values in (("angle[rad]", q), ("omega[rad/s]", v), ("alpha[rad/s^2]", rates)):
        for body, parts in sums.items():
            end[f"{body}.{column}"] = sum(mpf(values[k]) for k in parts)
    for k, value in enumerate(multipliers):
        end[f"joint.E{k // 2 + 1}.{'fy' if k % 2 else 'fx'}[N]"] = value
    for column, value in list(end.items())[1:]:
        unit = column[column.index("[") + 1 : -1]
        worst[unit] = max(worst.get(unit, 0), abs(float(value) - rows[-1][column]))
    rows[-1] = end
    found = ", ".join(f"{d:.1e} {unit}" for unit, d in worst.items())
    print(f"andrews: published end met to {found}")
    write("andrews", words, rows, f"""
Andrews' squeezing mechanism as in the {IVP}; it is problem A03 of the IFToMM
library, too. No gravity, a spring C–D, a constant torque on the crank OF. Body frames are those of the test set's angles: OF β, FE β + Θ, BDE γ, GE Φ + δ, AG δ, HE Ω + ε, AH ε.

The row at 0.03 s is the test set's reference solution (PSIDE, tolerance 1e-14): angles, their derivatives, and the six multipliers, which are the forces of
FE on BDE, GE and HE in E. The other rows are integrated by `../generate/dynamics.py` (angles of the bodies, loops closed by multipliers, DOP853 at 1e-13), which meets
the published row to {found}. These differences are one of 1e-9 rad in β, or 1e-12 s on the way, and remain the same whatever the tolerance; accelerations,
which grow by 1e6 within 1e-12 s, and forces are compared to 1e-6.""", tolerance=(1e-9, 1e-7, 1e-6))


def cart_pole():
    mass, g = 1e-6, 9.81
    words = model(
        "Cart and pole with a light cart", "A pendulum on a cart of a millionth of its mass: turns of a microsecond between long swings.",
        "N. Parsons, light-cartpole-benchmark", [0, -g],
        bodies={"ground": {"points": {"O": [0, 0]}}, "cart": link(mass, 0, (0, 0), (0, 0, 0), C=(0, 0)),
                "pole": link(1, 0, (1, 0), (0, 0, 0), C=(0, 0), P=(1, 0))},
        joints={"rail": {"type": "prismatic", "between": ["ground.O", "cart.C"], "axis": [1, 0]}, "pin": pin("cart.C", "pole.C")},
        initial={"cart": {"x": 0, "vx": 0}, "pole": {"angle": 0, "angular_velocity": 0}}, analysis=dynamics(10, 201, 1e-11, 1e-12))

    def f(_, y):
        s, c = sin(y[0]), cos(y[0])
        return [y[1], -((mass + 1) * g * s + y[1] ** 2 * s * c) / (mass + s * s)]

    times = [10 * k / 200 for k in range(201)]
    fine, coarse = [solve_ivp(f, (0, 10), [pi / 2, 0], method="DOP853", t_eval=times, rtol=r, atol=r).y[0] for r in (1e-13, 1e-12)]
    rows = [{"time[s]": t, "cart.x[m]": (1 - sin(th)) / (mass + 1), "pole.angle[rad]": th - pi / 2} for t, th in zip(times, fine)]
    table = {2: (1.203674462722e-3, 1.521726637241122), 9: (0.8841044742496597, 0.1161556635401167), 10: (1.604228354236889, -0.6487991074309897),
             20: (1.998934624975155, -1.524675515758723), 200: (1.999763282461620, -1.549129441897076)}
    worst = max(max(abs(rows[k]["cart.x[m]"] - x), abs(fine[k] - th)) for k, (x, th) in table.items())
    write("cart-pole", words, rows, f"""
Cart and pole after the public repository Noah-Parsons/light-cartpole-benchmark: cart 1e-6 kg, bob 1 kg, rod 1 m, g = 9.81 m/s², from rest with the rod horizontal.
Near the lowest point the cart is thrown to the other side: the rod turns at 4429 rad/s for about a microsecond. The rows are the equation of the angle alone, θ from
the lowest position, θ'' = −((M+m) g sin θ + m θ'² sin θ cos θ)/(M + m sin² θ), integrated by DOP853 of SciPy at 1e-13 (at 1e-12 it differs by {abs(fine - coarse).max():.1e}),
and x from the conserved momentum. They meet the benchmark's table of quadratures to {worst:.1e}; its limit of 1e-6 is the tolerance.""", compare=1e-6)
    print(f"cart-pole: table met to {worst:.1e}")


def car_axis():
    words = model(
        "Car axis", "A chassis on two springs over a road of sines; its left end slides on a massless, tilting axle.", IVP, [0, -1],
        bodies={"ground": {"points": {"O": [0, 0], "L": [1, 0]}},
                "axle": link(0, 0, (0, 0), (0, 0, 0), O=(0, 0), B=(1, 0)),
                "lift": link(0, 0, (0, 0), (1, 0, 0), P=(0, 0)),
                "chassis": link(1e-3, 2.5e-4, (0.5, 0), (0, 0.5, 0), l=(0, 0), r=(1, 0))},
        joints={"hinge": pin("ground.O", "axle.O"), "road": {"type": "prismatic", "between": ["ground.L", "lift.P"], "axis": [0, 1]},
                "roller": {"type": "slot", "between": ["lift.P", "axle.B"], "axis": [1, 0]},
                "left": {"type": "slot", "between": ["axle.O", "chassis.l"], "axis": [0, 1]}},
        drivers={"bump": {"type": "translation", "joint": "road", "motion": {"type": "harmonic", "amplitude": 0.1, "frequency": 10 / (2 * pi)}}},
        forces={"front": {"type": "spring", "between": ["ground.O", "chassis.l"], "stiffness": 1, "free_length": 0.5},
                "back": {"type": "spring", "between": ["axle.B", "chassis.r"], "stiffness": 1, "free_length": 0.5}},
        initial={"chassis": {"y": 0.5, "angle": 0, "vy": 0, "angular_velocity": 0}},
        points=["chassis.l", "chassis.r"], analysis=dynamics(3, 31, 1e-11, 1e-12))
    yb = mp.sin(30) / 10
    xb, multiplier = root(1 - yb * yb), mpf("-0.00473688659084893324729")
    end = {"time[s]": "3", "chassis.l.x[m]": "0.0493455784275402809122", "chassis.l.y[m]": "0.496989460230171153861",
           "chassis.r.x[m]": "1.04174252488542151681", "chassis.r.y[m]": "0.373911027265361256927",
           "chassis.l.vx[m/s]": "-0.0770583684040972357970", "chassis.l.vy[m/s]": "0.00744686658723778553466",
           "chassis.r.vx[m/s]": "0.0175568157537232222276", "chassis.r.vy[m/s]": "0.770341043779251976443",
           "joint.left.fx[N]": multiplier * xb, "joint.left.fy[N]": multiplier * yb}
    write("car-axis", words, [end], f"""
Car axis of the {IVP}, at its end, 3 s: published digits. The rod between two masses of M ε²/2 = 5e-4 kg is one rigid body with their mass and
moment of inertia. The axle of length 1 m is a massless body on the ground's origin; its right end is at the height r sin ωt, brought there by a driven massless lift
in whose horizontal slot it rolls, and the left mass slides in a slot square to it. The first multiplier times (x_b, y_b) is the force in that slot.""",
          tolerance=(1e-9, 1e-8))


# ---- Integrated here


def slider_crank_torque():
    crank, rod, start = 0.08, 0.25, 0.4
    a = (crank * cos(start), crank * sin(start))
    x = a[0] + sqrt(rod**2 - a[1] ** 2)
    words = model(
        "Slider-crank under torque", "A constant torque spins a slider-crank up against a load on the slider.", OWN, [0, -9.81],
        bodies={"ground": {"points": {"O": [0, 0]}},
                "crank": link(0.6, 1.5e-3, (0.02, 0.004), (0, 0, start), O=(0, 0), A=(crank, 0)),
                "rod": link(0.45, 2.6e-3, (0.1, 0.003), along(a, (x, 0)), A=(0, 0), B=(rod, 0)),
                "slider": link(0.9, 1e-3, (0.01, 0.005), (x, 0, 0), B=(0, 0), N=(0.03, 0.02))},
        joints={"o": pin("ground.O", "crank.O"), "a": pin("crank.A", "rod.A"), "b": pin("slider.B", "rod.B"),
                "guide": {"type": "prismatic", "between": ["ground.O", "slider.B"], "axis": [1, 0]}},
        forces={"motor": {"type": "torque", "body": "crank", "value": 2.5},
                "load": {"type": "force", "at": "slider.N", "vector": [-8, 3]}},
        initial={"crank": {"angle": start, "angular_velocity": 3}}, analysis=dynamics(1, 101, 1e-11, 1e-12))
    integrated("slider-crank-torque", words, 5, "Slider-crank spun up by a constant torque through many dead centres of its slider, masses off the links' "
               "axes. Own dimensions.", (1e-8, 1e-7))


def double_pendulum_springs():
    words = model(
        "Double pendulum with springs", "Two pendulums, a spring to the ground, a torsion spring and dampers.", OWN, [0.5, -9.81],
        bodies={"ground": {"points": {"O": [0.1, 0.2], "W": [0.9, 0.3]}},
                "upper": link(1.4, 0.05, (0.3, 0.02), (0.1, 0.2, -0.3), O=(0, 0), A=(0.6, 0.1)),
                "lower": link(0.8, 0.02, (0.2, -0.03), (0.7, 0.1, -1.2), A=(-0.05, 0), T=(0.5, 0))},
        joints={"o": pin("ground.O", "upper.O"), "a": pin("lower.A", "upper.A")},
        forces={"coil": {"type": "spring", "between": ["ground.W", "lower.T"], "stiffness": 60, "damping": 0.8, "free_length": 0.5},
                "hinge": {"type": "torsion_spring", "between": ["upper", "lower"], "stiffness": 4, "damping": 0.03, "free_angle": -0.5}},
        initial={"upper": {"angle": -0.3, "angular_velocity": 1.5}, "lower": {"angle": -1.2, "angular_velocity": -2}},
        analysis=dynamics(4, 161, 1e-11, 1e-12))
    integrated("double-pendulum-springs", words, 8, "Two degrees of freedom, springs and dampers, gravity aslant. Own dimensions.", (1e-8, 1e-7))


def loosened(case, name, about, initial, analysis):
    words = json.loads((CASES / case / "case.json").read_text(encoding="utf-8"))["model"]
    words.update(name=name, about=about, source=OWN, initial=initial, analysis=analysis)
    del words["drivers"]
    words.pop("points", None)
    return words


def assur_class_iii_free():
    words = loosened("assur-class-iii", "Free triad", "The triad of assur-class-iii let loose: a torque, a damped spring and weights move its crank.",
                     {"crank": {"angle": 1.1, "angular_velocity": 0.5}}, dynamics(1.5, 151, 1e-11, 1e-12))
    words["forces"]["motor"] = {"type": "torque", "body": "crank", "value": 1.2}
    integrated("assur-class-iii-free", words, 10, "The linkage of `assur-class-iii` without its driver, under a torque on the crank. Own dimensions.",
               (1e-8, 1e-7))


def free_six_bar():
    words = loosened("stephenson-iii", "Free six-bar", "The six-bar of stephenson-iii turning by itself, without friction.",
                     {"crank": {"angle": 0.5, "angular_velocity": 40}}, dynamics(1, 101, 1e-11, 1e-12))
    del words["forces"]
    integrated("free-six-bar", words, 5, "The linkage of `stephenson-iii` without driver and loads, for some six turns. Own masses.", (1e-7, 1e-6))


ALL = [a01_pendulum, a01_pendulum_exact, a02_four_bars_2, a02_four_bars_40, andrews, cart_pole, car_axis, slider_crank_torque,
       double_pendulum_springs, assur_class_iii_free, free_six_bar]

if __name__ == "__main__":
    for make in ALL:
        if len(sys.argv) < 2 or make.__name__.replace("_", "-") in sys.argv[1:]:
            make()
