"""Checks every reference.csv against its own model, from the printed numbers alone.

Absolute coordinates and nothing of the solver that made the rows: joints hold (position, velocity, acceleration), drivers follow their
motion, forces and moments of each body balance, the power balance closes (drivers, gravity, springs, dampers and loads against the rate of
kinetic energy), energies are right. Each residual is divided by the sum of the magnitudes of its terms; all must be below 1e-12.

Run: python3 check.py [case …]
"""

import csv
import json
import sys
from pathlib import Path

from mpmath import mp, mpf
from planar import MP, Mechanism, cross, dot, minus, perp, times

CASES = Path(__file__).resolve().parent.parent
LIMIT = mpf(10) ** -12


class Worst:
    """Largest relative residual per kind of check."""

    def __init__(self):
        self.value = {}

    def add(self, kind, terms, floor=0):
        size = sum(abs(t) for t in terms) + floor
        if size:
            self.value[kind] = max(self.value.get(kind, mpf(0)), abs(sum(terms)) / size)


def check(folder):
    model = json.loads((folder / "case.json").read_text(encoding="utf-8"))["model"]
    m, worst = Mechanism(model), Worst()
    with open(folder / "reference.csv", encoding="utf-8") as f:
        table = list(csv.reader(f))
    header, rows = table[0], table[1:]
    assert header == m.columns(), "columns"
    size = max(abs(v) for b in m.bodies.values() for p in b.points.values() for v in p)
    for line in rows:
        assert len(line) == len(header)
        row = {k: mpf(v) for k, v in zip(header, line)}
        t = row["time[s]"]
        zero = mpf(0)
        state = {"ground": ((zero, zero), (zero, zero), (zero, zero), zero, zero, zero, (mpf(1), zero))}
        for b in m.moving:
            g = lambda c: row[f"{b}.{c}"]
            th = g("angle[rad]")
            state[b] = ((g("x[m]"), g("y[m]")), (g("vx[m/s]"), g("vy[m/s]")), (g("ax[m/s^2]"), g("ay[m/s^2]")), th, g("omega[rad/s]"),
                        g("alpha[rad/s^2]"), (mp.cos(th), mp.sin(th)))
        fast = max(max(map(abs, s[1] + (s[4],))) for s in state.values())
        hard = max(max(map(abs, s[2] + (s[5],))) for s in state.values())
        # joints: what must vanish, with its two derivatives
        for j in m.joints.values():
            (p1, v1, a1), (p2, v2, a2) = (m.point(MP, state, e) for e in j.ends)
            if j.kind == "gear":
                triples = [m.mesh(MP, state, j)]
            elif j.kind in ("prismatic", "slot"):
                triples = [m.along(MP, state, j, perp(m.axis(MP, state, j)))]
            else:
                triples = [(p2[i] - p1[i], v2[i] - v1[i], a2[i] - a1[i]) for i in (0, 1)]
            if j.kind not in ("revolute", "slot", "gear"):
                s1, s2 = (state[e[0]] for e in j.ends)
                triples.append((s2[3] - s1[3] - j.angle, s2[4] - s1[4], s2[5] - s1[5]))
            for x, v, a in triples:
                worst.add("joint position", [x], size + 1)
                worst.add("joint velocity", [v], fast)
                worst.add("joint acceleration", [a], hard + fast**2)
        for d in m.drivers.values():
            for k, (x, y) in enumerate(zip(m.driven(MP, state, d), d.motion(MP, t))):
                worst.add("driver motion", [x, -y], (1, fast, hard + fast**2)[k])
        for end in m.points:
            for vector, units, add in zip(m.point(MP, state, end), (("x[m]", "y[m]"), ("vx[m/s]", "vy[m/s]"), ("ax[m/s^2]", "ay[m/s^2]")),
                                          (1, fast, hard + fast**2)):
                for v, u in zip(vector, units):
                    worst.add("points", [v, -row[f"{'.'.join(end)}.{u}"]], add)
        # forces: (body, place, force, torque)
        everything, rubbing = m.applied(MP, t, state), []
        for j in m.joints.values():
            f = (row[f"joint.{j.name}.fx[N]"], row[f"joint.{j.name}.fy[N]"])
            q = row.get(f"joint.{j.name}.torque[N*m]", zero)
            at = m.point(MP, state, j.ends[1])[0]
            everything += [(j.ends[1][0], at, f, q), (j.ends[0][0], at, times(-1, f), -q)]
            rub = zero
            if j.friction:
                rub = row[f"joint.{j.name}.friction[{'N*m' if j.kind == 'revolute' else 'N'}]"]
                u = (zero, zero) if j.kind == "revolute" else m.axis(MP, state, j)
                worst.add("friction", [rub, -m.rub(MP, state, j, (f[0] - rub * u[0], f[1] - rub * u[1], q))], abs(rub))
                rubbing.append(rub * (state[j.ends[1][0]][4] - state[j.ends[0][0]][4] if j.kind == "revolute"
                                      else m.along(MP, state, j, u)[1]))
                if j.kind == "revolute":
                    everything += [(j.ends[1][0], at, (zero, zero), rub), (j.ends[0][0], at, (zero, zero), -rub)]
            if j.kind in ("prismatic", "slot"):
                worst.add("prismatic force across its axis", [dot(f, m.axis(MP, state, j)), -rub], abs(f[0]) + abs(f[1]))
            if j.kind == "gear":  # a single force, at the pitch point and along the tangent there
                touch, e = m.pitch(MP, state, j)
                worst.add("tooth force along the tangent", [dot(f, perp(e))], abs(f[0]) + abs(f[1]))
                worst.add("tooth force at the pitch point", [q, -cross(minus(touch, at), f)], abs(q))
        power, parts = rubbing, []
        for d in m.drivers.values():
            unit, effort = ("rad", "N*m") if d.kind == "rotation" else ("m", "N")
            e = row[f"driver.{d.name}.effort[{effort}]"]
            worst.add("driver value", [row[f"driver.{d.name}.value[{unit}]"], -d.motion(MP, t)[0]], 1)
            power.append(e * d.motion(MP, t)[1])
            if d.kind == "rotation":
                everything += [(d.body, state[d.body][0], (zero, zero), e), (d.other, state[d.other][0], (zero, zero), -e)]
            else:
                at, u = m.point(MP, state, d.joint.ends[1])[0], m.axis(MP, state, d.joint)
                everything += [(d.joint.ends[1][0], at, times(e, u), zero), (d.joint.ends[0][0], at, times(-e, u), zero)]
        sums = {b: ([], [], []) for b in m.moving}
        largest = mpf(0)
        for b, at, f, q in everything:
            largest = max(largest, abs(f[0]), abs(f[1]))
            if b != "ground":
                c = m.point(MP, state, (b, ""), com=True)[0]
                sums[b][0].append(f[0])
                sums[b][1].append(f[1])
                sums[b][2].extend([q, cross(minus(at, c), f)])
        for b, (fx, fy, q) in sums.items():
            body, (_, _, a) = m.bodies[b], m.point(MP, state, (b, ""), com=True)
            worst.add("force sums", fx + [-body.mass * a[0]], largest)
            worst.add("force sums", fy + [-body.mass * a[1]], largest)
            worst.add("moment sums", q + [-body.inertia * state[b][5]], largest * size)
        # power and energy; the powers of springs and loads from their lengths, angles and rates, not from the forces above
        for b in m.moving:
            v = m.point(MP, state, (b, ""), com=True)[1]
            power += [m.bodies[b].mass * g * u for g, u in zip(m.gravity, v)]
        for f in m.forces.values():
            if f.kind == "spring":
                (p1, v1, _), (p2, v2, _) = (m.point(MP, state, e) for e in f.ends)
                length = mp.hypot(*minus(p2, p1))
                rate = dot(minus(p2, p1), minus(v2, v1)) / length
                power += [-f.k * (length - f.free) * rate, -f.c * rate**2]
            elif f.kind == "torsion_spring":
                s1, s2 = (state[b] for b in f.bodies)
                power += [-f.k * (s2[3] - s1[3] - f.free) * (s2[4] - s1[4]), -f.c * (s2[4] - s1[4]) ** 2]
            elif f.kind == "force":
                v, (c, s) = m.point(MP, state, f.at)[1], state[f.at[0]][6]
                x, y = (value(MP, t)[0] for value in f.vector)
                power += [x * v[0], y * v[1]] if f.frame == "ground" else [x * dot((c, s), v), y * dot((-s, c), v)]
            else:
                power.append(f.value(MP, t)[0] * (state[f.body][4] - state[f.other][4]))
        kinetic = potential = zero
        for b in m.moving:
            body = m.bodies[b]
            p, v, a = m.point(MP, state, (b, ""), com=True)
            parts += [-body.mass * v[0] * a[0], -body.mass * v[1] * a[1], -body.inertia * state[b][4] * state[b][5]]
            kinetic += (body.mass * dot(v, v) + body.inertia * state[b][4] ** 2) / 2
            potential -= body.mass * dot(m.gravity, p)
        for f in m.forces.values():
            if f.kind == "spring":
                d = minus(*(m.point(MP, state, e)[0] for e in f.ends))
                potential += f.k * (mp.sqrt(dot(d, d)) - f.free) ** 2 / 2
            elif f.kind == "torsion_spring":
                potential += f.k * (state[f.bodies[1]][3] - state[f.bodies[0]][3] - f.free) ** 2 / 2
        worst.add("power balance", power + parts)
        worst.add("energy", [row["energy.kinetic[J]"], -kinetic], abs(kinetic))
        worst.add("energy", [row["energy.potential[J]"], -potential], 1 + abs(potential))
    return worst.value, len(rows)


def main():
    failed = False
    for folder in sorted(p.parent for p in CASES.glob("*/reference.csv")):
        # only cases whose rows are full solutions of a model kept beside them
        if sys.argv[1:] and folder.name not in sys.argv[1:]:
            continue
        if '"type": "dynamics"' in (folder / "case.json").read_text(encoding="utf-8"):
            continue  # parts of a solution, integrated with an error of their own
        found, count = check(folder)
        bad = {k: v for k, v in found.items() if v > LIMIT}
        failed |= bool(bad)
        top = max(found, key=found.get)
        print(f"{folder.name:26} {count:3} rows  worst {mp.nstr(found[top], 2):>8} ({top})  power {mp.nstr(found['power balance'], 2):>8}"
              + ("  FAILED " + str({k: mp.nstr(v, 2) for k, v in bad.items()}) if bad else ""))
    sys.exit(failed)


if __name__ == "__main__":
    main()
