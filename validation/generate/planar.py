"""Planar linkages in relative joint coordinates, to as many digits as wanted.

Formulation (deliberately not the one of the engine, which works with absolute coordinates of the centres of mass,
a constraint Jacobian and multipliers):

  motion     A spanning tree of the joints is rooted in the ground. The unknowns are the joints' own coordinates (relative
             angle of a revolute, slide of a prismatic joint). Joints outside the tree (slots and gears always) close the loops and drivers
             prescribe a coordinate; these scalar equations are solved by Newton's method. Velocities and accelerations
             follow by implicit differentiation: the tree recursion carries the time derivatives of the vectors along.
  reactions  Newton and Euler for each body cut free: sum of forces = m a, sum of moments about the centre of mass = J alpha,
             written with the forces at the joint points; all bodies together are a linear system in the joint forces and the
             driver efforts. Where joints are redundant, the solution of least Euclidean norm (forces in N, torques in N*m).
  friction   Coulomb's, with a ramp, in joints: torques and forces by the reactions just found, and the free bodies again, until
             nothing changes any more.
  check      Each driver effort once more by virtual power (Jourdain), from the partial velocities of the tree
             recursion, without any joint force.

The numbers are mpmath's (`MP`), or doubles (`FLOAT`) where only a path has to be followed.
"""

import json
import math
import re

import mpmath
import numpy
from mpmath import mp, mpf

mp.dps = 40


# ---------------------------------------------------------------- numbers

class MP:
    """mpmath numbers."""
    sin, cos, sqrt, atan2 = mp.sin, mp.cos, mp.sqrt, mp.atan2

    @staticmethod
    def pi():
        return +mp.pi

    @staticmethod
    def num(x):
        return mpf(x)

    @staticmethod
    def solve(a, b):
        x = mp.lu_solve(mp.matrix(a), mp.matrix(b))
        return [x[i] for i in range(len(x))]


class FLOAT:
    """Doubles, for following a path and for singular values."""
    sin, cos, sqrt, atan2 = math.sin, math.cos, math.sqrt, math.atan2

    @staticmethod
    def pi():
        return math.pi

    @staticmethod
    def num(x):
        return float(x)

    @staticmethod
    def solve(a, b):
        return list(numpy.linalg.solve(numpy.array(a, float), numpy.array(b, float)))


# ---------------------------------------------------------------- model file → SI

def _units():
    p = mp.pi
    lb = {"m": 1, "km": 1000, "dm": "0.1", "cm": "0.01", "mm": "0.001", "um": "1e-6"}
    base = {k: (mpf(v), "L") for k, v in lb.items()}
    base.update({k: (mpf(v), "M") for k, v in {"kg": 1, "g": "0.001", "t": 1000}.items()})
    base.update({k: (mpf(v), "T") for k, v in {"s": 1, "ms": "0.001", "min": 60}.items()})
    base.update({k: (mpf(v), "F") for k, v in {"N": 1, "kN": 1000}.items()})
    base.update({"rad": (mpf(1), "A"), "deg": (p / 180, "A"), "rev": (2 * p, "A")})
    return base


def unit_factor(text):
    """SI value of a unit such as `kg*mm^2` or `rad/s^2`."""
    if text in ("rpm",):
        return 2 * mp.pi / 60
    base = _units()
    value, sign = mpf(1), 1
    for token in re.split(r"([*/])", text.strip()):
        if token in "*/":
            sign = 1 if token == "*" else -1
            continue
        name, _, power = token.strip().partition("^")
        value *= base[name][0] ** (sign * int(power or 1))
    return value


SI = dict(length="m", angle="rad", mass="kg", inertia="kg*m^2", force="N", torque="N*m", stiffness="N/m", damping="N*s/m",
          angular_stiffness="N*m/rad", angular_damping="N*m*s/rad", velocity="m/s", angular_velocity="rad/s",
          acceleration="m/s^2", angular_acceleration="rad/s^2", time="s")


def perp(a):
    return (-a[1], a[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def plus(*vectors):
    return (sum(v[0] for v in vectors), sum(v[1] for v in vectors))


def times(s, a):
    return (s * a[0], s * a[1])


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1])


class Motion:
    """A law of time with its first two derivatives; coefficients in SI."""

    def __init__(self, reader, spec, dimension, rate, second_rate):
        q = reader.quantity
        self.kind = spec["type"]
        if self.kind == "polynomial":
            dims = [dimension, rate, second_rate]
            unit = unit_factor(reader.units.get(dimension, SI[dimension]))
            self.c = []
            for k, value in enumerate(spec["coefficients"]):
                # a plain coefficient is in the driven dimension's unit per second^k, a text carries its own unit
                self.c.append(q(value, dims[k]) if isinstance(value, str) else value * unit)
        elif self.kind == "constant_velocity":
            self.c = [q(spec["start"], dimension), q(spec["velocity"], rate)]
        elif self.kind == "constant_acceleration":
            self.c = [q(spec["start"], dimension), q(spec["velocity"], rate), q(spec["acceleration"], second_rate) / 2]
        elif self.kind == "harmonic":
            self.offset, self.amplitude = q(spec["offset"], dimension), q(spec["amplitude"], dimension)
            self.frequency, self.phase = spec["frequency"], q(spec["phase"], "angle")
        else:
            raise ValueError(self.kind)

    def __call__(self, n, t):
        t = n.num(t)
        if self.kind == "harmonic":
            w = 2 * n.pi() * n.num(self.frequency)
            s, c = n.sin(w * t + n.num(self.phase)), n.cos(w * t + n.num(self.phase))
            a = n.num(self.amplitude)
            return n.num(self.offset) + a * s, a * w * c, -a * w * w * s
        f = d = dd = n.num(0)
        for c in reversed([n.num(c) for c in self.c]):
            dd = dd * t + 2 * d
            d = d * t + f
            f = f * t + c
        return f, d, dd


class Constant:
    def __init__(self, value):
        self.value = value

    def __call__(self, n, t):
        return n.num(self.value), n.num(0), n.num(0)


class Joint:
    pass


class Body:
    pass


class Mechanism:
    """A `linkdyn/1` model, all numbers in SI and with all digits."""

    def __init__(self, model):
        model = json.loads(json.dumps(model) if isinstance(model, dict) else model, parse_float=mpf, parse_int=mpf)
        self.units = {} if model["units"] == "SI" else model["units"]
        q = self.quantity
        self.gravity = tuple(q(v, "acceleration") for v in model.get("gravity", [mpf(0), mpf(0)]))
        self.bodies = {}
        for name, spec in model["bodies"].items():
            body = Body()
            body.name = name
            body.points = {k: tuple(q(v, "length") for v in p) for k, p in spec["points"].items()}
            body.mass = q(spec.get("mass", mpf(0)), "mass")
            body.inertia = q(spec.get("inertia", mpf(0)), "inertia")
            body.com = tuple(q(v, "length") for v in spec.get("com", [mpf(0), mpf(0)]))
            pose = spec.get("pose", {})
            body.guess = tuple(q(v, "length") for v in pose.get("position", [mpf(0), mpf(0)])) + (
                q(pose.get("angle", mpf(0)), "angle"),)
            self.bodies[name] = body
        if "ground" not in self.bodies:
            raise ValueError("no ground")
        self.moving = [b for b in self.bodies if b != "ground"]
        self.joints = {}
        for name, spec in model["joints"].items():
            joint = Joint()
            joint.name, joint.kind = name, spec["type"]
            joint.ends = [tuple(e.split(".")) for e in spec["between"]]
            joint.angle = q(spec.get("angle", mpf(0)), "angle")
            if joint.kind in ("prismatic", "slot"):
                ax = [mpf(v) for v in spec["axis"]]
                joint.axis = times(1 / mp.hypot(*ax), ax)
            if joint.kind == "gear":  # meshes as drawn where no angle is given
                joint.carrier, joint.ratio = spec["carrier"], mpf(spec["ratio"])
                drawn = [self.bodies[b].guess[2] for b in (joint.ends[0][0], joint.ends[1][0], joint.carrier)]
                if "angle" not in spec:
                    joint.angle = drawn[1] - drawn[2] - joint.ratio * (drawn[0] - drawn[2])
            rubs = spec.get("friction")
            joint.friction = rubs and (q(rubs["coefficient"], "number"), q(rubs["threshold_velocity"], "velocity"))
            joint.size = q(spec.get("pin_radius", spec.get("guide_length", mpf(0))), "length")
            self.joints[name] = joint
        self.drivers = {}
        for name, spec in model.get("drivers", {}).items():
            d = Joint()
            d.name, d.kind = name, spec["type"]
            if d.kind == "rotation":
                d.body, d.other = spec["body"], spec.get("relative_to", "ground")
                d.motion = Motion(self, spec["motion"], "angle", "angular_velocity", "angular_acceleration")
            else:
                d.joint = self.joints[spec["joint"]]
                d.motion = Motion(self, spec["motion"], "length", "velocity", "acceleration")
            self.drivers[name] = d
        self.forces = {}
        for name, spec in model.get("forces", {}).items():
            f = Joint()
            f.name, f.kind = name, spec["type"]
            if f.kind == "spring":
                f.ends = [tuple(e.split(".")) for e in spec["between"]]
                f.k, f.c = q(spec.get("stiffness", mpf(0)), "stiffness"), q(spec.get("damping", mpf(0)), "damping")
                f.free = q(spec.get("free_length", mpf(0)), "length")
            elif f.kind == "torsion_spring":
                f.bodies = spec["between"]
                f.k = q(spec.get("stiffness", mpf(0)), "angular_stiffness")
                f.c = q(spec.get("damping", mpf(0)), "angular_damping")
                f.free = q(spec.get("free_angle", mpf(0)), "angle")
            elif f.kind == "force":
                f.at, f.frame = tuple(spec["at"].split(".")), spec.get("frame", "ground")
                f.vector = [self.value(v, "force") for v in spec["vector"]]
            elif f.kind == "torque":
                f.body, f.other = spec["body"], spec.get("relative_to", "ground")
                f.value = self.value(spec["value"], "torque")
            else:
                raise ValueError(f.kind)
            self.forces[name] = f
        self.points = [tuple(p.split(".")) for p in model.get("points", [])]
        self.analysis = model["analysis"]
        self._tree()
        self.rows = None
        self.rubbing = {}

    def quantity(self, value, dimension):
        """A number in the file's unit of `dimension`, or a text `value unit`, in SI."""
        if isinstance(value, str):
            number, unit = value.split(None, 1)
            return mpf(number) * unit_factor(unit)
        return mpf(value) * (1 if dimension == "number" else unit_factor(self.units.get(dimension, SI[dimension])))

    def value(self, spec, dimension):
        if isinstance(spec, dict):
            return Motion(self, spec, dimension, None, None)
        return Constant(self.quantity(spec, dimension))

    # ------------------------------------------------------------ spanning tree

    def _tree(self):
        """Breadth first from the ground: for each body the joint it hangs on, and the joints left over (loops)."""
        reached, queue, used = {"ground"}, ["ground"], set()
        self.tree = []  # (joint, parent end, child end)
        while queue:
            here = queue.pop(0)
            for joint in self.joints.values():
                if joint.kind in ("slot", "gear"):  # these only close loops
                    continue
                for k in (0, 1):
                    if joint.ends[k][0] == here and joint.ends[1 - k][0] not in reached:
                        child = joint.ends[1 - k][0]
                        reached.add(child)
                        queue.append(child)
                        used.add(joint.name)
                        self.tree.append((joint, k, 1 - k))
        assert reached == set(self.bodies), set(self.bodies) - reached
        self.closing = [j for j in self.joints.values() if j.name not in used]
        self.coordinates = [j.name for j, _, _ in self.tree if j.kind != "fixed"]
        self._cache = {}

    def local(self, n, key, value):
        """A constant in the numbers of `n`."""
        k = (n, mp.prec if n is MP else 0, key)
        if k not in self._cache:
            self._cache[k] = tuple(n.num(v) for v in value) if isinstance(value, (tuple, list)) else n.num(value)
        return self._cache[k]

    def point(self, n, state, end, com=False):
        """Position, velocity, acceleration of a body point."""
        body, name = end
        s = self.local(n, (body, name, com), self.bodies[body].com if com else self.bodies[body].points[name])
        p, v, a, th, w, al, (c, sn) = state[body]
        r = (c * s[0] - sn * s[1], sn * s[0] + c * s[1])
        q = perp(r)
        return plus(p, r), plus(v, times(w, q)), plus(a, times(al, q), times(-w * w, r))

    def axis(self, n, state, joint):
        """Unit axis of a prismatic joint or a slot in global axes."""
        e = self.local(n, (joint.name, "axis"), joint.axis)
        c, s = state[joint.ends[0][0]][6]
        return (c * e[0] - s * e[1], s * e[0] + c * e[1])

    def forward(self, n, q, dq, ddq):
        """Body frames from joint coordinates: {body: (p, v, a, angle, omega, alpha, (cos, sin))}."""
        zero = n.num(0)
        o = (zero, zero)
        state = {"ground": (o, o, o, zero, zero, zero, (n.num(1), zero))}
        i = 0
        for joint, kp, kc in self.tree:
            parent, child = joint.ends[kp][0], joint.ends[kc][0]
            p, v, a = self.point(n, state, joint.ends[kp])
            _, _, _, th, w, al, cs = state[parent]
            sign = 1 if kp == 0 else -1
            if joint.kind == "revolute":
                th, w, al = th + q[i], w + dq[i], al + ddq[i]
                i += 1
            elif joint.kind == "fixed":
                th = th + sign * self.local(n, (joint.name, "angle"), joint.angle)
            else:
                th = th + sign * self.local(n, (joint.name, "angle"), joint.angle)
                if kp == 0:
                    u = self.axis(n, state, joint)
                else:  # the axis is fixed in the child, which turns with the parent
                    e = self.local(n, (joint.name, "axis"), joint.axis)
                    c, s = n.cos(th), n.sin(th)
                    u = (c * e[0] - s * e[1], s * e[0] + c * e[1])
                uq, s, ds, dds = perp(u), sign * q[i], sign * dq[i], sign * ddq[i]
                p = plus(p, times(s, u))
                v = plus(v, times(ds, u), times(s * w, uq))
                a = plus(a, times(dds, u), times(2 * ds * w, uq), times(s * al, uq), times(-s * w * w, u))
                i += 1
            c, s = n.cos(th), n.sin(th)
            b = self.local(n, joint.ends[kc] + (False,), self.bodies[child].points[joint.ends[kc][1]])
            r = (c * b[0] - s * b[1], s * b[0] + c * b[1])
            rq = perp(r)
            state[child] = (minus(p, r), minus(v, times(w, rq)), plus(a, times(-al, rq), times(w * w, r)), th, w, al, (c, s))
        return state

    def along(self, n, state, joint, direction):
        """Component of (second point − first point) along a direction that turns with the first body, with two derivatives."""
        p1, v1, a1 = self.point(n, state, joint.ends[0])
        p2, v2, a2 = self.point(n, state, joint.ends[1])
        d, dv, da = minus(p2, p1), minus(v2, v1), minus(a2, a1)
        w, al = state[joint.ends[0][0]][4:6]
        e, eq = direction, perp(direction)
        return (dot(e, d), dot(e, dv) + w * dot(eq, d),
                dot(e, da) + 2 * w * dot(eq, dv) + al * dot(eq, d) - w * w * dot(e, d))

    def closure(self, n, state):
        """Left sides of the loop and driver equations: triples (value, rate, second rate)."""
        out = []
        for j in self.closing:
            if j.kind in ("revolute", "fixed"):
                first, second = self.point(n, state, j.ends[0]), self.point(n, state, j.ends[1])
                out += [tuple(second[k][i] - first[k][i] for k in range(3)) for i in (0, 1)]
            elif j.kind in ("prismatic", "slot"):
                out.append(self.along(n, state, j, perp(self.axis(n, state, j))))
            if j.kind == "gear":
                out.append(self.mesh(n, state, j))
            if j.kind in ("prismatic", "fixed"):
                s1, s2 = state[j.ends[0][0]], state[j.ends[1][0]]
                out.append((s2[3] - s1[3] - self.local(n, (j.name, "angle"), j.angle), s2[4] - s1[4], s2[5] - s1[5]))
        return out + [self.driven(n, state, d) for d in self.drivers.values()]

    def mesh(self, n, state, joint):
        """How far the second wheel's turn is ahead of the first's, both seen from the carrier."""
        one, two, arm = (state[b][3:6] for b in (joint.ends[0][0], joint.ends[1][0], joint.carrier))
        ratio, angle = self.local(n, (joint.name, "ratio"), joint.ratio), self.local(n, (joint.name, "angle"), joint.angle)
        ahead = [(b - c) - ratio * (a - c) for a, b, c in zip(one, two, arm)]
        return ahead[0] - angle, ahead[1], ahead[2]

    def pitch(self, n, state, joint):
        """Pitch point of a gear and the tangent there: where wheels with these pitch radii touch."""
        first, second = (self.point(n, state, e)[0] for e in joint.ends)
        d = minus(second, first)
        r1, r2 = 1, -1 / joint.ratio  # signed radii in any measure: external where both have one sign
        return plus(first, times(r1 / (r1 + r2), d)), perp(times(1 / mp.hypot(*d), d))

    def driven(self, n, state, d):
        if d.kind == "rotation":
            a, b = state[d.body], state[d.other]
            return a[3] - b[3], a[4] - b[4], a[5] - b[5]
        return self.along(n, state, d.joint, self.axis(n, state, d.joint))

    def wanted(self, n, t):
        loops = sum({"revolute": 2, "prismatic": 2, "fixed": 3, "slot": 1, "gear": 1}[j.kind] for j in self.closing)
        return [(n.num(0),) * 3] * loops + [d.motion(n, t) for d in self.drivers.values()]

    def jacobian(self, n, q):
        """d(closure)/dq, column by column, from the velocities of unit joint rates."""
        m, zero = len(self.coordinates), n.num(0)
        zeros = [zero] * m
        cols = []
        for k in range(m):
            unit = list(zeros)
            unit[k] = n.num(1)
            cols.append([c[1] for c in self.closure(n, self.forward(n, q, unit, zeros))])
        full = [[cols[k][i] for k in range(m)] for i in range(len(cols[0]))]
        if self.rows is None:
            self.rows = self._independent(full)
        return [full[i] for i in self.rows]

    def _independent(self, full):
        """Indices of as many independent equations as there are unknowns (all of them unless joints are redundant)."""
        a = numpy.array(full, float)
        if a.shape[0] == a.shape[1]:
            return list(range(a.shape[0]))
        keep, rest, basis = [], list(range(a.shape[0])), []
        # drivers first, then loops, each by what it adds
        order = sorted(rest, key=lambda i: i < a.shape[0] - len(self.drivers))
        for i in order:
            r = a[i].copy()
            for b in basis:
                r -= (r @ b) * b
            if numpy.linalg.norm(r) > 1e-6 * numpy.linalg.norm(a[i]):
                basis.append(r / numpy.linalg.norm(r))
                keep.append(i)
        assert len(keep) == a.shape[1], (len(keep), a.shape)
        return sorted(keep)

    # ------------------------------------------------------------ motion

    def guess(self, n, poses=None):
        """Joint coordinates of guessed body poses."""
        poses = poses or {b: body.guess for b, body in self.bodies.items()}
        zero = n.num(0)
        state = {}
        for b, (x, y, th) in poses.items():
            th = n.num(th)
            state[b] = ((n.num(x), n.num(y)), (zero, zero), (zero, zero), th, zero, zero, (n.cos(th), n.sin(th)))
        state["ground"] = ((zero, zero), (zero, zero), (zero, zero), zero, zero, zero, (n.num(1), zero))
        q = []
        for joint, kp, kc in self.tree:
            if joint.kind == "revolute":
                q.append(state[joint.ends[kc][0]][3] - state[joint.ends[kp][0]][3])
            elif joint.kind == "prismatic":
                q.append(self.along(n, state, joint, self.axis(n, state, joint))[0])
        return q

    def position(self, n, t, q, tolerance, most=60):
        """Newton's method on the closure equations."""
        zeros = [n.num(0)] * len(q)
        want = self.wanted(n, t)
        small = 0
        for count in range(most):
            have = self.closure(n, self.forward(n, q, zeros, zeros))
            res = [want[i][0] - have[i][0] for i in range(len(want))]
            jac = self.jacobian(n, q)
            dq = n.solve(jac, [res[i] for i in self.rows])
            q = [a + b for a, b in zip(q, dq)]
            if max(abs(d) for d in dq) < tolerance:
                small += 1
                if small == 2:
                    return q
        raise ArithmeticError(f"no position at t = {t}")

    def rates(self, n, t, q):
        """Joint rates and second rates by implicit differentiation."""
        zeros = [n.num(0)] * len(q)
        want, jac = self.wanted(n, t), self.jacobian(n, q)
        dq = n.solve(jac, [want[i][1] for i in self.rows])
        bias = self.closure(n, self.forward(n, q, dq, zeros))
        ddq = n.solve(jac, [want[i][2] - bias[i][2] for i in self.rows])
        return dq, ddq

    def follow(self, times_, substeps=40, poses=None, smallest=None, start=None):
        """Joint coordinates at the given instants, each to full precision, on the branch of the start guess.

        The path between the instants is followed in doubles with small steps; the smallest singular value of the closure
        Jacobian along it goes into the list `smallest`.
        """
        n = FLOAT
        q = start or self.guess(n, poses)
        t = 0.0
        q = self.position(n, t, q, 1e-12)
        out = []
        for instant in times_:
            goal = float(instant)
            steps = max(1, substeps) if goal > t else 0
            h = (goal - t) / steps if steps else 0.0
            for k in range(steps):
                dq, ddq = self.rates(n, t, q)
                guess = [a + h * b + h * h / 2 * c for a, b, c in zip(q, dq, ddq)]
                t = t + h if k < steps - 1 else goal
                q = self.position(n, t, guess, 1e-12)
                assert max(abs(a - b) for a, b in zip(q, guess)) < 0.05, f"step too large at {t}"
                if smallest is not None:
                    smallest.append(numpy.linalg.svd(numpy.array(self.jacobian(n, q)), compute_uv=False)[-1])
            out.append(self.position(MP, instant, [mpf(x) for x in q], mpf(10) ** (-mp.dps + 8)))
        return out

    def state(self, t, q):
        n = MP
        dq, ddq = self.rates(n, t, q)
        state = self.forward(n, q, dq, ddq)
        have, want = self.closure(n, state), self.wanted(n, t)
        worst = max(abs(have[i][k] - want[i][k]) for i in range(len(want)) for k in range(3))
        assert worst < mpf(10) ** (-mp.dps + 12), f"closure {mp.nstr(worst, 3)} at t = {t}"
        return state

    # ------------------------------------------------------------ forces

    def applied(self, n, t, state):
        """Forces that are no reactions: list of (body, point of attack in global axes, force, torque)."""
        zero = n.num(0)
        out = []
        for b in self.moving:
            m = self.bodies[b].mass
            out.append((b, self.point(n, state, (b, ""), com=True)[0], times(n.num(m), self.gravity), zero))
        for f in self.forces.values():
            if f.kind == "spring":
                (p1, v1, _), (p2, v2, _) = (self.point(n, state, e) for e in f.ends)
                d, dv = minus(p2, p1), minus(v2, v1)
                length = n.sqrt(dot(d, d))
                e = times(1 / length, d)
                pull = times(f.k * (length - f.free) + f.c * dot(e, dv), e)
                out += [(f.ends[0][0], p1, pull, zero), (f.ends[1][0], p2, times(-1, pull), zero)]
            elif f.kind == "torsion_spring":
                s1, s2 = state[f.bodies[0]], state[f.bodies[1]]
                torque = f.k * (s2[3] - s1[3] - f.free) + f.c * (s2[4] - s1[4])
                out += [(f.bodies[0], s1[0], (zero, zero), torque), (f.bodies[1], s2[0], (zero, zero), -torque)]
            elif f.kind == "force":
                v = tuple(x(n, t)[0] for x in f.vector)
                if f.frame == "body":
                    c, s = state[f.at[0]][6]
                    v = (c * v[0] - s * v[1], s * v[0] + c * v[1])
                out.append((f.at[0], self.point(n, state, f.at)[0], v, zero))
            else:
                torque = f.value(n, t)[0]
                out += [(f.body, state[f.body][0], (zero, zero), torque), (f.other, state[f.other][0], (zero, zero), -torque)]
        for j in self.joints.values():
            rub = self.rubbing.get(j.name)
            if rub is not None:
                at, (first, second) = self.point(n, state, j.ends[1])[0], (e[0] for e in j.ends)
                force, torque = ((zero, zero), rub) if j.kind == "revolute" else (times(rub, self.axis(n, state, j)), zero)
                out += [(second, at, force, torque), (first, at, times(-1, force), -torque)]
        return out

    def rub(self, n, state, j, reaction):
        """Friction of a joint: torque on the second body of a revolute joint, force along the axis of a prismatic one.

        `reaction` is what the joint carries without it.
        """
        mu, threshold = j.friction
        fx, fy, torque = reaction
        if j.kind == "revolute":
            sliding, load, arm = j.size * (state[j.ends[1][0]][4] - state[j.ends[0][0]][4]), n.sqrt(fx * fx + fy * fy), j.size
        else:
            across, arm = dot((fx, fy), perp(self.axis(n, state, j))), 1
            edges = [across / 2 + s * torque / j.size for s in (1, -1)] if j.size else [across]
            sliding, load = self.along(n, state, j, self.axis(n, state, j))[1], sum(abs(e) for e in edges)
        return -mu * arm * load * max(-1, min(1, sliding / threshold))

    def reactions(self, t, state):
        """Joint forces {joint: (fx, fy, torque)} and driver efforts {driver: effort}; friction is left in `rubbing`."""
        self.rubbing = {j.name: mpf(0) for j in self.joints.values() if j.friction}
        for _ in range(400):
            joints, efforts = self.carried(t, state)
            rubbing = {name: self.rub(MP, state, self.joints[name], joints[name]) for name in self.rubbing}
            change = max([abs(rubbing[k] - self.rubbing[k]) for k in rubbing] + [mpf(0)])
            if change < mpf(10) ** (-mp.dps + 8):
                return joints, efforts
            self.rubbing = rubbing
        raise ArithmeticError(f"friction does not settle at t = {t}")

    def carried(self, t, state):
        """What joints and drivers carry, from the free bodies with all other forces."""
        n, zero, one = MP, mpf(0), mpf(1)
        com = {b: self.point(n, state, (b, ""), com=True) for b in self.moving}
        row = {b: 3 * i for i, b in enumerate(self.moving)}
        unknowns = []  # (owner, what, [(body, force, torque about its centre of mass)])

        def act(first, second, at, force, torque):
            """Unit unknown: `force`, `torque` on the second body at a global point, the opposite on the first."""
            column = []
            for b, sign in ((second, 1), (first, -1)):
                if b != "ground":
                    column.append((b, times(sign, force), sign * (torque + cross(minus(at, com[b][0]), force))))
            return column

        for j in self.joints.values():
            first, second = j.ends[0][0], j.ends[1][0]
            at = self.point(n, state, j.ends[1])[0]
            if j.kind in ("revolute", "fixed"):
                unknowns.append((j.name, (one, zero, zero), act(first, second, at, (one, zero), zero)))
                unknowns.append((j.name, (zero, one, zero), act(first, second, at, (zero, one), zero)))
            elif j.kind == "gear":  # a tangential force at the pitch point, told at the second wheel's centre
                touch, e = self.pitch(n, state, j)
                unknowns.append((j.name, e + (cross(minus(touch, at), e),), act(first, second, touch, e, zero)))
            else:
                e = perp(self.axis(n, state, j))
                unknowns.append((j.name, e + (zero,), act(first, second, at, e, zero)))
            if j.kind in ("prismatic", "fixed"):
                unknowns.append((j.name, (zero, zero, one), act(first, second, at, (zero, zero), one)))
        joint_unknowns = len(unknowns)
        for d in self.drivers.values():
            if d.kind == "rotation":
                unknowns.append((d.name, None, act(d.other, d.body, com.get(d.body, [(zero, zero)])[0], (zero, zero), one)))
            else:
                e, ends = self.axis(n, state, d.joint), d.joint.ends
                at = self.point(n, state, ends[1])[0]
                unknowns.append((d.name, None, act(ends[0][0], ends[1][0], at, e, zero)))
        size = 3 * len(self.moving)
        a, rhs = mp.zeros(size, len(unknowns)), mp.zeros(size, 1)
        for k, (_, _, column) in enumerate(unknowns):
            for b, force, torque in column:
                a[row[b], k] += force[0]
                a[row[b] + 1, k] += force[1]
                a[row[b] + 2, k] += torque
        for b in self.moving:
            body, acc = self.bodies[b], com[b][2]
            rhs[row[b]], rhs[row[b] + 1] = body.mass * acc[0], body.mass * acc[1]
            rhs[row[b] + 2] = body.inertia * state[b][5]
        for b, at, force, torque in self.applied(n, t, state):
            if b != "ground":
                rhs[row[b]] -= force[0]
                rhs[row[b] + 1] -= force[1]
                rhs[row[b] + 2] -= torque + cross(minus(at, com[b][0]), force)
        if a.cols == a.rows:
            x = mp.lu_solve(a, rhs)
        else:  # more unknowns than equations: least norm
            x = a.T * mp.lu_solve(a * a.T, rhs)
            self.compare_with_pinv(a, rhs, x)
        joints = {j: (zero, zero, zero) for j in self.joints}
        for k in range(joint_unknowns):
            name, direction, _ = unknowns[k]
            joints[name] = tuple(f + x[k] * e for f, e in zip(joints[name], direction))
        efforts = {unknowns[k][0]: x[k] for k in range(joint_unknowns, len(unknowns))}
        return joints, efforts

    @staticmethod
    def compare_with_pinv(a, rhs, x):
        """The least-norm solution again in doubles with numpy's pseudo-inverse."""
        other = numpy.linalg.pinv(numpy.array(a.tolist(), float)) @ numpy.array(rhs.tolist(), float)
        mine = numpy.array(x.tolist(), float)
        assert numpy.linalg.norm(other - mine) < 1e-11 * numpy.linalg.norm(mine)

    def virtual_power(self, t, q, state):
        """Driver efforts by Jourdain's principle, without any reaction."""
        n = MP
        zeros = [mpf(0)] * len(q)
        jac = self.jacobian(n, q)
        first = len(self.wanted(n, t)) - len(self.drivers)
        applied = self.applied(n, t, state)
        out = {}
        for k, name in enumerate(self.drivers):
            # partial velocities: the motion with unit rate of this driver, all others at rest
            unit = [mpf(1) if i == first + k else mpf(0) for i in self.rows]
            partial = self.forward(n, q, n.solve(jac, unit), zeros)
            power = mpf(0)
            for b in self.moving:
                body = self.bodies[b]
                acc = self.point(n, state, (b, ""), com=True)[2]
                vel = self.point(n, partial, (b, ""), com=True)[1]
                power += body.mass * dot(acc, vel) + body.inertia * state[b][5] * partial[b][4]
            for b, at, force, torque in applied:
                if b != "ground":
                    p, v, _, _, w, _, _ = partial[b]
                    power -= dot(force, plus(v, times(w, perp(minus(at, p))))) + torque * w
            out[name] = power
        return out

    # ------------------------------------------------------------ results

    def columns(self):
        names = ["time[s]"]
        for b in self.moving:
            names += [f"{b}.{c}" for c in ("x[m]", "y[m]", "angle[rad]", "vx[m/s]", "vy[m/s]", "omega[rad/s]", "ax[m/s^2]",
                                           "ay[m/s^2]", "alpha[rad/s^2]")]
        for p in self.points:
            names += [f"{'.'.join(p)}.{c}" for c in ("x[m]", "y[m]", "vx[m/s]", "vy[m/s]", "ax[m/s^2]", "ay[m/s^2]")]
        for j in self.joints.values():
            names += [f"joint.{j.name}.fx[N]", f"joint.{j.name}.fy[N]"]
            names += [f"joint.{j.name}.torque[N*m]"] if j.kind not in ("revolute", "slot") else []
            names += [f"joint.{j.name}.friction[{'N*m' if j.kind == 'revolute' else 'N'}]"] if j.friction else []
        for d in self.drivers.values():
            unit, effort = ("rad", "N*m") if d.kind == "rotation" else ("m", "N")
            names += [f"driver.{d.name}.value[{unit}]", f"driver.{d.name}.effort[{effort}]"]
        return names + ["energy.kinetic[J]", "energy.potential[J]"]

    def row(self, t, q):
        """All result columns at one instant."""
        n = MP
        state = self.state(t, q)
        joints, efforts = self.reactions(t, state)
        power = self.virtual_power(t, q, state)
        scale = max([abs(e) for e in efforts.values()] + [max(map(abs, f)) for f in joints.values()] + [mpf(1)])
        for name, effort in efforts.items():
            assert abs(effort - power[name]) < scale * mpf(10) ** (-mp.dps + 14), (name, effort, power[name])
        out = [mpf(t)]
        for b in self.moving:
            p, v, a, th, w, al, _ = state[b]
            out += [*p, th, *v, w, *a, al]
        for end in self.points:
            for vector in self.point(n, state, end):
                out += list(vector)
        for j in self.joints.values():
            force = list(joints[j.name][: 2 if j.kind in ("revolute", "slot") else 3])
            if j.friction and j.kind == "prismatic":  # all that the guide does
                force[:2] = plus(force[:2], times(self.rubbing[j.name], self.axis(n, state, j)))
            out += force + ([self.rubbing[j.name]] if j.friction else [])
        for d in self.drivers.values():
            out += [self.driven(n, state, d)[0], efforts[d.name]]
        kinetic = potential = mpf(0)
        for b in self.moving:
            body = self.bodies[b]
            p, v, _ = self.point(n, state, (b, ""), com=True)
            kinetic += (body.mass * dot(v, v) + body.inertia * state[b][4] ** 2) / 2
            potential -= body.mass * dot(self.gravity, p)
        for f in self.forces.values():
            if f.kind == "spring":
                d = minus(self.point(n, state, f.ends[1])[0], self.point(n, state, f.ends[0])[0])
                potential += f.k * (n.sqrt(dot(d, d)) - f.free) ** 2 / 2
            elif f.kind == "torsion_spring":
                potential += f.k * (state[f.bodies[1]][3] - state[f.bodies[0]][3] - f.free) ** 2 / 2
        return out + [kinetic, potential]

    def differentiation_error(self, t, q):
        """Largest relative difference of velocities and accelerations from central differences of neighbouring positions."""
        h = mpf(10) ** (-(mp.dps // 4))
        near = []
        for s in (-1, 0, 1):
            x = self.position(MP, t + s * h, q, mpf(10) ** (-mp.dps + 8))
            near.append(self.state(t + s * h, x))
        worst = mpf(0)
        for b in self.moving:
            for k in (0, 1):
                for i in (0, 1):
                    slope = (near[2][b][k][i] - near[0][b][k][i]) / (2 * h)
                    worst = max(worst, abs(slope - near[1][b][k + 1][i]) / (1 + abs(slope)))
            for k in (3, 4):
                slope = (near[2][b][k] - near[0][b][k]) / (2 * h)
                worst = max(worst, abs(slope - near[1][b][k + 1]) / (1 + abs(slope)))
        return worst


# ---------------------------------------------------------------- files

def text(model, indent=0, width=116):
    """JSON that people can read: what fits on a line stays on it."""
    def flat(v):
        return json.dumps(v, ensure_ascii=False)
    pad = "  " * (indent + 1)
    if isinstance(model, dict) and model:
        if indent >= 2 and len(flat(model)) + 2 * indent < width:
            return "{ " + ", ".join(f"{flat(k)}: {text(v, 99)}" for k, v in model.items()) + " }"
        parts = [f"{pad}{flat(k)}: {text(v, indent + 1 if indent < 99 else 99)}" for k, v in model.items()]
        if indent >= 99:
            return "{ " + ", ".join(f"{flat(k)}: {text(v, 99)}" for k, v in model.items()) + " }"
        return "{\n" + ",\n".join(parts) + "\n" + "  " * indent + "}"
    return flat(model)


def cell(x):
    """17 significant digits; what is zero but for round-off is zero."""
    return "0" if abs(x) < mpf(10) ** (-mp.dps + 15) else f"{float(x):.17g}"


def write_reference(folder, columns, rows):
    with open(folder / "reference.csv", "w", encoding="utf-8") as f:
        f.write(",".join(columns) + "\n")
        for row in rows:
            f.write(",".join(cell(x) for x in row) + "\n")


TOLERANCE = {"position": 1e-10, "velocity": 1e-8, "acceleration": 1e-8, "force": 1e-8, "effort": 1e-8}


def absolute_assembly(machine, t=0.0):
    """Body poses by least-change Newton steps in absolute coordinates from the poses guessed in the file, in doubles.

    A user of the model starts there too; both must arrive at the same assembly for the case to be well posed.
    """
    n = FLOAT
    names = machine.moving
    x = numpy.array([float(v) for b in names for v in machine.bodies[b].guess])

    def residual(x):
        poses = {b: tuple(x[3 * i: 3 * i + 3]) for i, b in enumerate(names)} | {"ground": (0.0, 0.0, 0.0)}
        state = {}
        for b, (px, py, th) in poses.items():
            state[b] = ((px, py), (0.0, 0.0), (0.0, 0.0), th, 0.0, 0.0, (math.cos(th), math.sin(th)))
        out = []
        for j in machine.joints.values():
            p1, p2 = (machine.point(n, state, e)[0] for e in j.ends)
            if j.kind == "gear":
                out.append(machine.mesh(n, state, j)[0])
                continue
            if j.kind in ("prismatic", "slot"):
                out.append(cross(machine.axis(n, state, j), minus(p2, p1)))
            else:
                out += list(minus(p2, p1))
            if j.kind not in ("revolute", "slot"):
                out.append(state[j.ends[1][0]][3] - state[j.ends[0][0]][3] - float(j.angle))
        for d in machine.drivers.values():
            out.append(machine.driven(n, state, d)[0] - d.motion(n, t)[0])
        return numpy.array(out)

    for _ in range(50):
        r = residual(x)
        h = 1e-7
        jac = numpy.array([(residual(x + h * e) - residual(x - h * e)) / (2 * h) for e in numpy.eye(len(x))]).T
        dx = numpy.linalg.lstsq(jac, -r, rcond=1e-9)[0]
        x = x + dx
        if numpy.abs(dx).max() < 1e-11:
            return x
    raise ArithmeticError("no assembly from the guessed poses")


def produce(folder, model, case, how, outputs=None, every=1, tolerance=None, poses=None, digits=None):
    """Solves a model, checks the solution against itself, and writes the three files of a case.

    `case`: (about, source). `how`: what SOURCE.md says first. `every`: a reference row at each so many output instants.
    With `poses` (joint-by-joint rough body poses) the poses of the file are computed and rounded to `digits`.
    """
    machine = Mechanism(model)
    if poses is not None:
        q = machine.follow([mpf(0)], poses=poses)[0]
        state = machine.state(mpf(0), q)
        for b in machine.moving:
            unit = [unit_factor(machine.units.get(k, SI[k])) for k in ("length", "angle")]
            place = [round(float(v / unit[0]), digits[0]) for v in state[b][0]]
            model["bodies"][b]["pose"] = {"position": place, "angle": round(float(state[b][3] / unit[1]), digits[1])}
        machine = Mechanism(model)
    end, count = mpf(repr(float(model["analysis"]["end"]))), model["analysis"]["outputs"]
    assert (count - 1) % every == 0
    instants = [end * k / (count - 1) for k in range(0, count, every)]
    smallest = []
    path = machine.follow(instants, substeps=12 * every, smallest=smallest)
    # the guessed poses of the file lead to this very assembly
    state = machine.state(instants[0], path[0])
    found, mine = absolute_assembly(machine), [float(v) for b in machine.moving for v in (*state[b][0], state[b][3])]
    assert max(abs(a - b) for a, b in zip(found, mine)) < 1e-9, "another assembly from the guessed poses"
    rows = [machine.row(t, q) for t, q in zip(instants, path)]
    middle = len(instants) // 2
    slope = max(machine.differentiation_error(instants[k], path[k]) for k in (1, middle))
    assert slope < mpf(10) ** -16, mp.nstr(slope, 3)
    write_case(folder, *case, model, tolerance)
    write_reference(folder, machine.columns(), rows)
    loops = len(machine.closing)
    (folder / "SOURCE.md").write_text(f"""# {folder.name}

{how}

- Bodies {len(machine.moving)}, joints {len(machine.joints)}, loops {loops}, drivers {len(machine.drivers)}; {len(rows)} rows, every {every} of {count} output instants.
- Formulation: `../generate/planar.py` (relative joint coordinates on a spanning tree, loop equations, implicit differentiation, free bodies by
  Newton and Euler), {mp.dps} digits, rounded to 17. Loop and driver equations hold to 1e-{mp.dps - 12} with their first and second derivatives.
- Each driver effort agrees with the one from virtual power to 1e-{mp.dps - 14} of the largest force; velocities and accelerations agree with central
  differences of neighbouring positions to {mp.nstr(slope, 2)} (the differences' own error).
- Smallest singular value of the loop and driver equations (SI, joint coordinates) along the path: {min(smallest):.2g}. Away from singular positions.
- The poses in the file lead to this assembly also by least-change Newton steps in absolute coordinates.
""", encoding="utf-8")
    print(f"{folder.name}: {len(machine.moving)} bodies, {loops} loops, smallest singular value {min(smallest):.3g}, slopes {mp.nstr(slope, 2)}")
    return machine


def write_case(folder, about, source, model, tolerance=None):
    folder.mkdir(parents=True, exist_ok=True)
    case = {"about": about, "source": source, "model": model, "tolerance": tolerance or TOLERANCE}
    (folder / "case.json").write_text(text(case) + "\n", encoding="utf-8")
