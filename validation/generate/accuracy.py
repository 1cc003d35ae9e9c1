"""Accuracy of linkages with revolute joints by their vector loops, to as many digits as wanted.

Formulation (deliberately not the one of the engine, which solves with the transposed constraint Jacobian in absolute coordinates):

  loops         The unknowns are the absolute angles of the bodies, nothing else. A spanning tree of the joints is rooted in the ground; each
                joint outside it closes a loop: a sum of vectors, each turned by one angle, and of the offsets of the pins on the way.
                A pin's offset e is journal minus bearing, the second body's point minus the first one's, in global axes.
  sensitivities Implicit differentiation of the loops, forwards: one column of angles for each length and for each component of each offset.
  worst case    A stationary value of the output over the directions of the offsets: the output's gradient depends on those of the loops, which is
                a determinant for each direction and needs no multipliers. It is followed as the *needed clearance*: the output is prescribed and
                grows from its nominal value, and the clearance for which this value is the worst one is found. That path is smooth
                through change points and over to other assemblies; the first place where it has used up the clearance is the end of what
                can be reached by moving within the clearances.

Lengths are those of the model file: numbers, and the arithmetic of its expressions. Numbers are mpmath's, or doubles where only a path has to be followed.
"""

import cmath
import json
import math
import random
import re
from pathlib import Path

from mpmath import mp, mpc, mpf

CASES = Path(__file__).resolve().parent.parent
ROOT = CASES.parent
DIGITS = 40
mp.dps = 60
DEG = mp.pi / 180
UNITS = {"m": "1", "cm": "0.01", "mm": "0.001", "um": "0.000001", "rad": "1"}


# ---------------------------------------------------------------- numbers

class MP:
    """mpmath numbers; a step for differences and the residual at which Newton's method ends."""
    num, step, tiny = mpf, mpf(10) ** -28, mpf(10) ** -50

    @staticmethod
    def cis(t):
        return mpc(*mp.cos_sin(t))


class FLOAT:
    """Doubles."""
    num, step, tiny = float, 1e-7, 1e-13

    @staticmethod
    def cis(t):
        return cmath.rect(1.0, t)


def eliminate(a, columns):
    """Solves a x = b for each b of `columns`; also gives the determinant."""
    n, det = len(a), 1
    m = [list(a[i]) + [b[i] for b in columns] for i in range(n)]
    for i in range(n):
        p = max(range(i, n), key=lambda r: abs(m[r][i]))
        if not m[p][i]:
            return None, 0 * det
        if p != i:
            m[i], m[p], det = m[p], m[i], -det
        det *= m[i][i]
        for r in range(i + 1, n):
            if m[r][i]:
                f = m[r][i] / m[i][i]
                for c in range(i + 1, len(m[i])):
                    m[r][c] -= f * m[i][c]
    out = []
    for k in range(len(columns)):
        x = [0] * n
        for i in reversed(range(n)):
            x[i] = (m[i][n + k] - sum(m[i][c] * x[c] for c in range(i + 1, n))) / m[i][i]
        out.append(x)
    return out, det


def newton(n, f, x, most=30, limit=None):
    """A zero of f near x, derivatives by differences; None where it isn't found. With all digits the first derivatives are kept: x comes
    from doubles then, and each pass adds a dozen digits."""
    scale = inverse = None
    for _ in range(most):
        r = f(x)
        if inverse is None or n is FLOAT:
            columns = []
            for k in range(len(x)):
                near = list(x)
                near[k] += n.step
                columns.append([(p - q) / n.step for p, q in zip(f(near), r)])
            rows = [list(row) for row in zip(*columns)]
            unit = [[n.num(i == k) for i in range(len(x))] for k in range(len(x))] if n is MP else [r]
            inverse, _ = eliminate(rows, unit)
            if inverse is None:
                return None
        d = inverse[0] if n is FLOAT else [sum(column[i] * v for column, v in zip(inverse, r)) for i in range(len(x))]
        scale = max(map(abs, d))
        if limit and scale > limit:
            return None
        x = [p - q for p, q in zip(x, d)]
        if scale < n.tiny * 100:
            return x
    return x if n is FLOAT and scale < 1e-9 else None


# ---------------------------------------------------------------- the model file

class Model:
    """Points of the bodies of a `linkdyn/1` model in metres as functions of its parameters."""

    def __init__(self, path):
        self.path = path
        self.spec = json.loads((ROOT / path).read_text(encoding="utf-8"), parse_float=str, parse_int=str)
        units = self.spec["units"]
        self.unit = mpf(UNITS["m" if units == "SI" else units.get("length", "m")])
        self.angle_unit = DEG if units != "SI" and units.get("angle") == "deg" else mpf(1)
        words = {k: v for k, v in self.spec.get("parameters", {}).items() if k not in ("note", "about")}
        self.parameters = {k: self.number(v, {}) for k, v in words.items()}
        self.bodies, self.joints = self.spec["bodies"], self.spec["joints"]
        self.moving = [b for b in self.bodies if b != "ground"]
        self.driver, driver = next(iter(self.spec.get("drivers", {}).items()), (None, {}))
        self.driven = driver.get("body")
        places = [(b, p) for b, body in self.bodies.items() for p in body["points"]]
        self.places = places + [(b, "") for b in self.bodies]

    def number(self, word, values):
        """A number, text with a unit, or an expression; plain numbers are in the file's unit of length."""
        if not word.startswith("="):
            number, _, unit = word.partition(" ")
            return mpf(number) * (mpf(UNITS[unit]) if unit else self.unit)
        text = re.sub(r"(?<![\w.])(\d+\.?\d*(?:e[+-]?\d+)?)(?: (m|cm|mm|um)\b)?",
                      lambda m: f"(mpf('{m[1]}')*mpf('{UNITS[m[2] or 'm']}'))", word[1:])
        return mpf(eval(text.replace("^", "**"), {"__builtins__": {}}, {"mpf": mpf, "sqrt": mp.sqrt, **values}))

    def points(self, values=None):
        """All points as complex numbers, in their bodies' frames."""
        values = self.parameters if values is None else values
        out = {(b, ""): mpc(0) for b in self.bodies}
        for b, body in self.bodies.items():
            for p, (x, y) in body["points"].items():
                out[b, p] = mpc(self.number(x, values), self.number(y, values))
        return out

    def by(self, name):
        """Derivatives of all points by a parameter: central differences of the expressions, with three times the digits."""
        with mp.workdps(3 * mp.dps):
            h = mpf(10) ** -(mp.dps // 3)
            up, down = (self.points(self.parameters | {name: self.parameters[name] + s * h}) for s in (1, -1))
            return {k: v for k in up if abs(v := (up[k] - down[k]) / (2 * h)) > mpf(10) ** -50}

    def guess(self):
        return {b: float(mpf(self.bodies[b].get("pose", {}).get("angle", "0")) * self.angle_unit) for b in self.moving}


# ---------------------------------------------------------------- loops

class Loops:
    """The vector loops of a model with revolute joints and one turned body."""

    def __init__(self, model):
        self.model = model
        self.ends = {j: tuple(tuple(e.split(".")) for e in spec["between"]) for j, spec in model.joints.items()}
        assert all(spec["type"] == "revolute" for spec in model.joints.values())
        self.chain = {"ground": {}}  # origin of each body as {("point", body, point) or ("pin", joint): sign}
        closing = dict(self.ends)
        while len(self.chain) < len(model.bodies):
            joint = next(j for j, (p, q) in closing.items() if (p[0] in self.chain) != (q[0] in self.chain))
            p, q = closing.pop(joint)
            sign = 1 if p[0] in self.chain else -1
            p, q = (p, q) if sign == 1 else (q, p)
            self.chain[q[0]] = self.sum(self.chain[p[0]], {("point", *p): 1, ("pin", joint): sign, ("point", *q): -1})
        self.loops = []
        for joint, (p, q) in closing.items():
            there = self.sum(self.chain[q[0]], {("point", *q): 1})
            here = self.sum(self.chain[p[0]], {("point", *p): 1, ("pin", joint): 1})
            self.loops.append(self.sum(there, {k: -s for k, s in here.items()}))
        self.unknown = [b for b in model.moving if b != model.driven]
        assert len(self.unknown) == 2 * len(self.loops)

    @staticmethod
    def sum(*terms):
        out = {}
        for t in terms:
            for k, s in t.items():
                out[k] = out.get(k, 0) + s
        return {k: s for k, s in out.items() if s}

    # values of a sum of vectors, and its derivatives

    @staticmethod
    def value(terms, points, turn, e):
        out = 0
        for (kind, *where), s in terms.items():
            out += s * (e.get(where[0], 0) if kind == "pin" else points[tuple(where)] * turn[where[0]])
        return out

    @staticmethod
    def slope(terms, points, turn, body):
        return sum(s * 1j * points[k[1:]] * turn[body] for k, s in terms.items() if k[0] == "point" and k[1] == body)

    def turns(self, n, theta):
        return {b: n.cis(t) for b, t in theta.items()} | {"ground": 1}

    def residual(self, points, turn, e):
        return [v for terms in self.loops for z in [self.value(terms, points, turn, e)] for v in (z.real, z.imag)]

    def jacobian(self, points, turn):
        """One column per unknown angle."""
        return [[v for terms in self.loops for z in [self.slope(terms, points, turn, b)] for v in ((z.real, z.imag) if z else (0, 0))]
                for b in self.unknown]

    def close(self, n, points, theta, e=None, most=40):
        """Newton's method from the angles given; the driven one stays."""
        theta = dict(theta)
        for _ in range(most):
            turn = self.turns(n, theta)
            r = self.residual(points, turn, e or {})
            x, _ = eliminate([list(row) for row in zip(*self.jacobian(points, turn))], [[-v for v in r]])
            for b, d in zip(self.unknown, x[0]):
                theta[b] += d
            if max(map(abs, x[0])) < 100 * n.tiny:
                return theta
        raise ArithmeticError("the loops do not close")

    def follow(self, values, step=0.01):
        """Angles at the driven angles `values` [rad], on the branch of the poses in the file."""
        m = self.model
        points = {k: complex(z) for k, z in m.points().items()}
        theta = m.guess()
        out = []
        last = theta[m.driven]
        theta = self.close(FLOAT, points, theta)
        for value in values:
            count = max(1, math.ceil(abs(float(value) - last) / step))
            for k in range(1, count + 1):
                theta = self.close(FLOAT, points, theta | {m.driven: last + (float(value) - last) * k / count})
            last = float(value)
            out.append(self.close(MP, m.points(), {b: mpf(t) for b, t in theta.items()} | {m.driven: mpf(value)}))
        return out

    # outputs: ("angle", body) or ("x" or "y", body, point)

    def output(self, name):
        body, *point, what = name.split(".")
        return (what, body) if what == "angle" else (what, body, point[0] if point else "")

    def terms_of(self, output):
        _, body, point = output
        return self.sum(self.chain[body], {("point", body, point): 1})

    @staticmethod
    def part(output, z):
        if not z:
            return 0
        return z.real if output[0] == "x" else z.imag

    def reading(self, output, points, theta, turn, e):
        return theta[output[1]] if output[0] == "angle" else self.part(output, self.value(self.terms_of(output), points, turn, e))

    def gradient(self, output, points, turn):
        """Of the output by the unknown angles."""
        if output[0] == "angle":
            return [1 if b == output[1] else 0 for b in self.unknown]
        terms = self.terms_of(output)
        return [self.part(output, self.slope(terms, points, turn, b)) for b in self.unknown]

    def pin_columns(self, output, joint, direction):
        """Loops and output by the offset of a pin along a complex direction."""
        f = [v for terms in self.loops for z in [terms.get(("pin", joint), 0) * direction] for v in ((z.real, z.imag) if z else (0, 0))]
        return f, 0 if output[0] == "angle" else self.part(output, self.terms_of(output).get(("pin", joint), 0) * direction)

    def length_columns(self, output, turn, slopes):
        def vector(terms):
            return sum(s * slopes[k[1:]] * turn[k[1]] for k, s in terms.items() if k[0] == "point" and k[1:] in slopes)
        f = [v for terms in self.loops for z in [vector(terms)] for v in ((z.real, z.imag) if z else (0, 0))]
        return f, 0 if output[0] == "angle" else self.part(output, vector(self.terms_of(output)))

    def sensitivities(self, names, theta):
        """Per output: nominal, by each parameter, by each pin (complex: by e_x + i by e_y)."""
        m, points, turn = self.model, self.model.points(), self.turns(MP, theta)
        rows = [list(row) for row in zip(*self.jacobian(points, turn))]
        slopes = {p: m.by(p) for p in m.parameters}
        out = {}
        for name in names:
            output = self.output(name)
            columns = [self.length_columns(output, turn, slopes[p]) for p in slopes]
            columns += [self.pin_columns(output, j, d) for j in self.ends for d in (mpc(1), mpc(0, 1))]
            solved, _ = eliminate(rows, [f for f, _ in columns])
            up = self.gradient(output, points, turn)
            dy = [y - sum(u * v for u, v in zip(up, x)) for (_, y), x in zip(columns, solved)]
            pins = {j: mpc(dy[len(slopes) + 2 * k], dy[len(slopes) + 2 * k + 1]) for k, j in enumerate(self.ends)}
            out[name] = self.reading(output, points, theta, turn, {}), dict(zip(slopes, dy)), pins
        return out

    def by_differences(self, name, theta, parameter=None, pin=None):
        """A sensitivity once more: the whole mechanism is closed again at two neighbouring values."""
        m, output, y = self.model, self.output(name), []
        h = mpf(10) ** -22
        for s in (h, -h):
            points = m.points(m.parameters | {parameter: m.parameters[parameter] + s}) if parameter else m.points()
            e = {pin[0]: s * pin[1]} if pin else {}
            near = self.close(MP, points, theta, e)
            y.append(self.reading(output, points, near, self.turns(MP, near), e))
        return (y[0] - y[1]) / (2 * h)

    # worst cases

    def worst(self, name, groups):
        return Worst(self, self.output(name), groups)


class Worst:
    """Largest and least output over offsets of pins. `groups`: joints whose offsets stand in the same places, which are one pin with their sum."""

    def __init__(self, loops, output, groups):
        self.loops, self.output, self.groups = loops, output, groups
        for group in groups:
            columns = [loops.pin_columns(output, j, 1 + 2j) for j in group]
            same = [c == columns[0] or (c[1] == -columns[0][1] and all(p == -q for p, q in zip(c[0], columns[0][0]))) for c in columns]
            assert all(same), group
        self.points = {FLOAT: {k: complex(z) for k, z in loops.model.points().items()}, MP: loops.model.points()}

    def unpack(self, n, x, driver, fixed):
        """`x`: angles of the bodies, directions, and then the output where the clearance is given, or the clearance. An output that is a
        coordinate is an equation more."""
        size, k = len(self.loops.unknown), len(self.groups)
        theta = dict(zip(self.loops.unknown, x[:size])) | {self.loops.model.driven: driver}
        c = fixed.get("c", x[-1])
        y = fixed.get("y", x[-1])
        e = {group[0]: len(group) * c * n.cis(a) for group, a in zip(self.groups, x[size:size + k])}
        return theta, x[size:size + k], c, y, e

    def equations(self, n, driver, fixed):
        """Loops, the output's value, and for each direction the determinant that says the output is stationary."""
        loops, points = self.loops, self.points[n]

        def f(x):
            theta, alpha, _, y, e = self.unpack(n, x, driver, fixed)
            turn = loops.turns(n, theta)
            out = loops.residual(points, turn, e) + [loops.reading(self.output, points, theta, turn, e) - y]
            columns = loops.jacobian(points, turn)
            up = loops.gradient(self.output, points, turn)
            for group, a in zip(self.groups, alpha):
                down, side = loops.pin_columns(self.output, group[0], n.cis(a) * 1j)
                out.append(eliminate([c + [u] for c, u in zip(columns, up)] + [down + [side]], [])[1])
            return out
        return f

    def contributions(self, n, x, driver, fixed):
        """What a longer offset of each group would do to the output, all times the same determinant."""
        loops, points = self.loops, self.points[n]
        theta, alpha, *_ = self.unpack(n, x, driver, fixed)
        turn = loops.turns(n, theta)
        rows = [c + [u] for c, u in zip(loops.jacobian(points, turn), loops.gradient(self.output, points, turn))]
        out = []
        for group, a in zip(self.groups, alpha):
            down, side = loops.pin_columns(self.output, group[0], n.cis(a))
            out.append(eliminate(rows + [down + [side]], [])[1])
        return out

    def turned(self, x, driver, fixed):
        """Directions turned round where a group works against the others (it contributed nothing on the way there); None where all agree."""
        found = self.contributions(FLOAT, x, driver, fixed)
        lead = max(zip(found, self.groups), key=lambda pair: len(pair[1]) * abs(pair[0]))[0]
        size = len(self.loops.unknown)
        against = [size + k for k, v in enumerate(found) if v * lead < 0]
        return [v + math.pi if i in against else v for i, v in enumerate(x)] if against else None

    def start(self, theta, pins):
        """Where nothing has moved yet; the directions are those of the sensitivities, outwards."""
        alpha = [float(mp.arg(pins[g[0]])) for g in self.groups]
        return [float(theta[b]) for b in self.loops.unknown] + alpha

    def reach(self, driver, y, x, clearances, side, first, widest=0.01):
        """The ends of what can be reached from y upwards (side 1) or downwards, for growing clearances.

        `x`: angles and directions for c = 0; `first`: about the change of the output for the least clearance; `widest`: largest step. Gives
        for each clearance its sign (directions may point the other way), doubles to polish, where they lie, and how many other
        assemblies without clearance were passed, where the needed clearance changes its sign.
        """
        found, todo = [], list(clearances)
        d, y0, step = float(driver), float(y), side * first / 4
        path, passed = [(0.0, list(x) + [0.0])], 0  # change of the output, solution with the clearance last

        def solve(at, guess):
            x1 = newton(FLOAT, self.equations(FLOAT, d, {"y": y0 + at}), guess, 25, 0.3)
            if x1 is None or max(abs(p - q) for p, q in zip(x1, guess)) > 0.25:
                return None
            better = self.turned(x1, d, {"y": y0 + at})
            return newton(FLOAT, self.equations(FLOAT, d, {"y": y0 + at}), better, 25, 0.3) if better else x1

        def cross(p, q):
            """Where between two points of the path a clearance is used up."""
            while todo and abs(q[1][-1]) >= todo[0]:
                c = math.copysign(todo.pop(0), q[1][-1])
                t = (c - p[1][-1]) / (q[1][-1] - p[1][-1])
                x1 = [a + t * (b - a) if abs(b - a) < 1 else b for a, b in zip(p[1][:-1], q[1][:-1])]
                found.append((c, x1 + [y0 + p[0] + t * (q[0] - p[0])], (y0 + p[0], y0 + q[0]), passed))

        while todo:
            at, x0 = path[-1]
            t = step / (at - path[-2][0]) if len(path) > 1 else 0
            x1 = solve(at + step, [p + t * (p - q) if abs(p - q) < 1 else p for p, q in zip(x0, path[-2][1])] if t else x0)
            if x1 is None:
                step /= 2
                if abs(step) < 1e-12:
                    raise ArithmeticError("the worst case is lost")
                continue
            passed += x0[-1] * x1[-1] < 0
            cross(path[-1], (at + step, x1))
            path.append((at + step, x1))
            if todo and len(path) > 2 and abs(path[-2][1][-1]) > max(abs(path[-1][1][-1]), abs(path[-3][1][-1])):
                self.summit(path[-3:], solve, cross)
            if abs(at) > 3:
                raise ArithmeticError("no end was found")
            step = math.copysign(min(abs(step) * 1.3, widest), step)
        return found

    @staticmethod
    def summit(three, solve, cross):
        """The needed clearance passed a largest value between the points: does it use up a clearance there?"""
        (a, p), (b, q), (c, r) = three
        left, right = (q[-1] - p[-1]) / (b - a), (r[-1] - q[-1]) / (c - b)
        top = (a + b) / 2 - left * (c - a) / 2 / (right - left)
        x = solve(top, q)
        if x is not None:
            cross((b, q) if (top - b) * (b - a) > 0 else (a, p), (top, x))

    def polish(self, driver, y, c, end):
        """The end for a clearance (exact, signed as it was found), with all digits: the output's change and the unknowns."""
        _, guess, (low, high), _ = end
        x = newton(FLOAT, self.equations(FLOAT, float(driver), {"c": float(c)}), guess, 40)
        better = x and self.turned(x, float(driver), {"c": float(c)})
        if better:
            x = newton(FLOAT, self.equations(FLOAT, float(driver), {"c": float(c)}), better, 40)
        assert x is not None and not self.turned(x, float(driver), {"c": float(c)}), "a direction is open"
        low, high = sorted((low, high))
        slack = 1e-9 + 0.1 * (high - low)
        assert x is not None and low - slack < x[-1] < high + slack, "another end"
        x = newton(MP, self.equations(MP, driver, {"c": c}), [mpf(v) for v in x], 12)
        assert x is not None, "not polished"
        return x[-1] - y, x

    def ends(self, driver, y, x, clearances, first):
        """Both ends for each clearance, and how many other assemblies were passed on the way down and up."""
        out = []
        for side in (-1, 1):
            way = self.reach(driver, y, x, [float(c) for c in clearances], side, float(first))
            out.append([(self.polish(driver, y, mpf(c) * (1 if e[0] > 0 else -1), e)[0], e[3]) for c, e in zip(clearances, way)])
        return [(low[0], high[0]) for low, high in zip(*out)], [(low[1], high[1]) for low, high in zip(*out)]

    def outside(self, theta, c, ends, count=400, seed=1):
        """By how much random offsets leave the worst case (negative: they do not), in doubles: all pins at their rims, a direction for
        each group, and every fourth time one for each pin."""
        draw, loops, points, n = random.Random(seed), self.loops, self.points[FLOAT], FLOAT
        start = {b: float(t) for b, t in theta.items()}
        value = lambda near, e: float(loops.reading(self.output, points, near, loops.turns(n, near), e))
        nominal, most = value(start, {}), -math.inf
        for k in range(count):
            e = {}
            for group in self.groups:
                way = draw.uniform(0, 7)
                for j in group:
                    same = loops.pin_columns(self.output, j, 1) == loops.pin_columns(self.output, group[0], 1)
                    e[j] = c * n.cis(way) * (1 if same else -1)
                    way = draw.uniform(0, 7) if k % 4 == 3 else way
            dy = value(loops.close(n, points, start, e), e) - nominal
            most = max(most, dy - float(ends[1]), float(ends[0]) - dy)
        return most

    def scan(self, driver, y, x, c, count=60, seed=2):
        """Stationary values found from many random starts, in doubles: changes of the output."""
        draw, found = random.Random(seed), []
        size = len(self.loops.unknown)
        for _ in range(count):
            start = list(x[:size]) + [draw.uniform(0, 7) for _ in self.groups] + [float(y)]
            end = newton(FLOAT, self.equations(FLOAT, float(driver), {"c": c}), start, 40, 1.0)
            if end is not None and max(abs(p - q) for p, q in zip(end[:size], x)) < 0.5:
                found.append(end[-1] - float(y))
        return found


# ---------------------------------------------------------------- files

def text(x):
    """Forty digits; what is zero but for round-off is zero."""
    return "0" if abs(x) < mpf(10) ** -45 else mp.nstr(mpf(x), DIGITS, strip_zeros=False, min_fixed=-5, max_fixed=5)


def pin(g):
    return {"g": text(abs(g)), "gx": text(g.real), "gy": text(g.imag)}


def write(name, expected):
    """`expected.json` of a case: a value that ends a branch on one line where it is short."""
    folder = CASES / name
    folder.mkdir(exist_ok=True)
    (folder / "expected.json").write_text(layout({"case": name} | expected) + "\n", encoding="utf-8")


def layout(v, indent=0, width=150):
    flat = json.dumps(v, ensure_ascii=False)
    if not isinstance(v, (dict, list)) or len(flat) + indent < width:
        return flat
    pad = " " * (indent + 2)
    if isinstance(v, dict):
        inner = [f"{pad}{json.dumps(k)}: {layout(w, indent + 2)}" for k, w in v.items()]
        return "{\n" + ",\n".join(inner) + "\n" + " " * indent + "}"
    return "[\n" + ",\n".join(pad + layout(w, indent + 2) for w in v) + "\n" + " " * indent + "]"
