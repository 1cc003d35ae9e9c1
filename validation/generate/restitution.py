"""Tables of the case `restitution`: a mass that meets a contact freely, for every law of the normal force, in 80 digits.

With w = v/v0 the motion m dv/dt = -F_e(d) (1 + chi w) gives E(d) = m v0^2 G(w), G(w) = int_w^1 s ds/(1 + chi s), whatever the
elastic force F_e with its energy E. The exit is G = 0, the largest penetration at w = 0, the duration int m v0 dw/(F_e (1 + chi w)).

Run: python3 restitution.py
"""

from pathlib import Path

from mpmath import acos, acosh, e, exp, lambertw, log, mp, mpf, pi, quad, sqrt

mp.dps = 80
FOLDER = Path(__file__).resolve().parent.parent / "restitution"


def exact(c):
    """Gonthier's chi = d/c, the root besides 0 of chi (1 + c) = ln((1 + chi)/(1 - chi c))."""
    equation = lambda d: log((1 + d / c) / (1 - d)) - d * (1 + 1 / c)
    return bisect(equation, (1 - c) / 8, 1 - exp(-2 / c - 3)) / c


def bisect(f, low, high):
    """A root of f between two signs."""
    sign = f(low) > 0
    assert sign != (f(high) > 0)
    while high - low > mpf(10) ** -78 * abs(high):
        middle = (low + high) / 2
        low, high = (middle, high) if (f(middle) > 0) == sign else (low, middle)
    return (low + high) / 2


# Machado et al. 2012, Hu and Guo 2015
RULES = [
    ("Hunt, Crossley", lambda c: 3 * (1 - c) / 2),
    ("Herbert, McWhannell", lambda c: 6 * (1 - c) / ((2 * c - 1) ** 2 + 3)),
    ("Lee, Wang", lambda c: 3 * (1 - c) / 4),
    ("Lankarani, Nikravesh", lambda c: 3 * (1 - c**2) / 4),
    ("Flores et al.", lambda c: 8 * (1 - c) / (5 * c)),
    ("Gonthier et al.", exact),
    ("Zhiying, Qishao", lambda c: 3 * (1 - c**2) / 4 * exp(2 * (1 - c))),
    ("Hu, Guo", lambda c: 3 * (1 - c) / (2 * c)),
]


def work(chi, w):
    """G(w)."""
    if chi == 0:
        return (1 - w**2) / 2
    return (1 - w) / chi - log((1 + chi) / (1 + chi * w)) / chi**2


def exit_ratio(chi):
    """The restitution that a factor chi delivers."""
    if chi == 0:
        return mpf(1)
    return bisect(lambda c: work(chi, -c), mpf(0), min(mpf(1), 1 / chi) * (1 - mpf(10) ** -75))


def impact(force, penetration, slope, chi, mass, speed):
    """Restitution, largest penetration, duration, peak force; force(E), penetration(E), slope(E) = dF_e/dd."""
    # round-off at the exit may be below zero
    energy = lambda w: mass * speed**2 * abs(work(chi, w))
    c = exit_ratio(chi)
    rate = lambda w: mass * speed / (force(energy(w)) * (1 + chi * w))
    duration = quad(rate, [-c, -c / 2, 0, mpf(1) / 2, 1])
    # the force is largest where dF_e/dd m v0^2 w = F_e^2 chi
    ahead = lambda w: slope(energy(w)) * mass * speed**2 * w - force(energy(w)) ** 2 * chi
    w = mpf(0) if chi == 0 else bisect(ahead, mpf(10) ** -40, 1 - mpf(10) ** -40)
    return c, penetration(energy(mpf(0))), duration, force(energy(w)) * (1 + chi * w)


def power_law(stiffness, n, chi, mass, speed):
    def depth(energy):
        return ((n + 1) * energy / stiffness) ** (1 / (n + 1))

    return impact(
        lambda energy: stiffness * depth(energy) ** n,
        depth,
        lambda energy: n * stiffness * depth(energy) ** (n - 1),
        chi,
        mass,
        speed,
    )


def cylinder(kappa, scale, chi, mass, speed):
    """d = (F/kappa) ln(scale/F)."""

    def logarithm(energy):
        # x^2 (-2 ln x - 1) = 4 kappa E/scale^2, from the left of x = 1/e
        y = 4 * kappa * energy / scale**2
        u = log(y) / 2 - 2
        for _ in range(200):
            step = (2 * u + log(-2 * u - 1) - log(y)) / (2 - 2 / (-2 * u - 1))
            u -= step
            if abs(step) < mpf(10) ** -77 * abs(u):
                return u
        raise ArithmeticError(energy)

    force = lambda energy: scale * exp(logarithm(energy))
    penetration = lambda energy: -scale / kappa * logarithm(energy) * exp(logarithm(energy))
    slope = lambda energy: kappa / (-logarithm(energy) - 1)
    found = impact(force, penetration, slope, chi, mass, speed)
    # E(d) once more as the integral of F(d), by Lambert's function; within the range that the engine keeps to
    explicit = lambda d: scale * exp(lambertw(-kappa * d / scale, -1).real)
    assert abs(quad(explicit, [0, found[1] / 100, found[1]]) / (mass * speed**2 * work(chi, mpf(0))) - 1) < mpf(10) ** -20
    assert found[1] < 2 * exp(-2) * scale / kappa
    return found


def linear(stiffness, damping, mass, speed):
    """Kelvin and Voigt's body: m d'' + D d' + K d = 0 until d'' = 0."""
    omega = sqrt(stiffness / mass)
    zeta = damping / (2 * mass * omega)
    if zeta == 1:
        angle, stretch = mpf(1), mpf(1)
    elif zeta < 1:
        stretch = sqrt(1 - zeta**2)
        angle = acos(zeta)
    else:
        stretch = sqrt(zeta**2 - 1)
        angle = acosh(zeta)
    duration = 2 * angle / (omega * stretch)
    restitution = exp(-zeta * omega * duration)
    depth = speed / omega * exp(-zeta * angle / stretch)
    peak = damping * speed
    if zeta < mpf(1) / 2:
        at = (3 * angle - pi) / stretch
        # F = -m d'', d'' = (v0 omega/stretch) e^(-zeta omega t) sin(stretch omega t - 2 angle), here sin(angle - pi) = -stretch
        peak = mass * speed * omega * exp(-zeta * at)
    return restitution, depth, duration, peak


def save(name, columns, rows, notes=()):
    with open(FOLDER / name, "w", encoding="utf-8") as f:
        f.writelines(f"# {note}\n" for note in notes)
        f.write(",".join(columns) + "\n")
        f.writelines(",".join(mp.nstr(mpf(v), 17) for v in row) + "\n" for row in rows)


FOUND = ["restitution[-]", "penetration[m]", "duration[s]", "peak[N]"]


def main():
    rows = []
    asked = [mpf(c) for c in ("0.95", "0.9", "0.8", "0.7", "0.5", "0.46", "0.3", "0.1")]
    hertz = (mpf(10) ** 9, mpf(3) / 2, mpf(1), mpf(1))
    others = [(mpf(2) * 10**7, mpf(1), mpf("0.14"), mpf("0.3")), (mpf(10) ** 10, mpf(10) / 9, mpf(5), mpf("0.01"))]
    others += [(mpf(3) * 10**12, mpf(5) / 2, mpf("0.02"), mpf(4))]
    for index, (_, rule) in enumerate(RULES):
        for c in asked:
            rows.append((index, c, *hertz, rule(c), *power_law(hertz[0], hertz[1], rule(c), *hertz[2:])))
        for stiffness, n, mass, speed in others:
            c = mpf("0.6")
            rows.append((index, c, stiffness, n, mass, speed, rule(c), *power_law(stiffness, n, rule(c), mass, speed)))
    for stiffness, n, mass, speed in [hertz, *others]:
        rows.append((len(RULES), 1, stiffness, n, mass, speed, 0, *power_law(stiffness, n, mpf(0), mass, speed)))
    notes = [f"rule {index}: {name}" for index, (name, _) in enumerate(RULES)] + [f"rule {len(RULES)}: Hertz, elastic"]
    given = ["rule[-]", "asked[-]", "stiffness[N/m^n]", "exponent[-]", "mass[kg]", "speed[m/s]", "factor[-]"]
    save("power.csv", given + FOUND, rows, notes)

    rows = []
    for ratio in ("0", "0.01", "0.1", "0.3", "0.6", "1", "1.5", "4"):
        # omega = 4000, so that the damping ratios are exact
        stiffness, mass, speed = mpf(8) * 10**6, mpf("0.5"), mpf(2)
        damping = mpf(ratio) * 4000
        rows.append((stiffness, damping, mass, speed, *linear(stiffness, damping, mass, speed)))
    save("linear.csv", ["stiffness[N/m]", "damping[N*s/m]", "mass[kg]", "speed[m/s]"] + FOUND, rows)

    rows = []
    flexibility = 2 * (1 - mpf("0.3") ** 2) / (207 * mpf(10) ** 9)
    for index in range(3):
        for bearing, clearance, length, mass, speed, c in [
            ("0.01", "0.0005", "0.02", "0.2", "0.5", "1"),
            ("0.01", "0.0005", "0.02", "5", "3", "0.46"),
            ("0.025", "0.00002", "0.04", "1", "0.05", "0.9"),
        ]:
            bearing, clearance, length, mass, speed, c = map(mpf, (bearing, clearance, length, mass, speed, c))
            kappa, journal, modulus = pi * length / flexibility, bearing - clearance, 1 / flexibility
            # where the printed formulas vanish: ln(scale/F) = 0
            scale = [
                4 * pi * modulus * clearance * length / e,
                exp(mpf(2) / 3) * mpf(16) / mpf("1.6") ** 2 * modulus * clearance * length,
                e * kappa * length**2 * clearance / (bearing * journal),
            ][index]
            chi = 3 * (1 - c**2) / 4
            given = (index, bearing, clearance, length, flexibility, mass, speed, c)
            rows.append((*given, *cylinder(kappa, scale, chi, mass, speed)))
    given = ["law[-]", "bearing_radius[m]", "clearance[m]", "length[m]", "flexibility[1/Pa]", "mass[kg]", "speed[m/s]", "asked[-]"]
    notes = ["law 0: Johnson", "law 1: Radzimovsky", "law 2: Dubowsky, Freudenstein"]
    save("cylinder.csv", given + FOUND, rows, notes)


main()
