"""Forward dynamics of linkdyn, Exudyn and MuJoCo on the same mechanisms, in turn: error, CPU seconds, ratio.

    python validation/peers/run.py [--rounds 3] [--only A02-10]

Needs `pip install exudyn mujoco scipy numpy` and cargo; a peer that can't be imported is left out, and the table says so.
What is measured, and with which settings, stands in README.md beside this script.
"""

import argparse
import importlib
import json
import math
import os
import subprocess
import time

import numpy as np
from scipy.integrate import solve_ivp

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
G = 9.81
END = 10.0
SAMPLES = np.linspace(0.0, END, 101)



def alpha(steps, tolerance, linear):
    """Generalised alpha, index 3, with these numbers of steps: number, spectral radius, Newton tolerance, linear solver."""
    return [("alpha", number, 0.9, tolerance, linear) for number in steps]


def rk4(steps):
    return [(step, "RK4") for step in steps]


def implicit(steps):
    return [(step, "implicitfast") for step in steps]


# Row of our bench: error wanted, loops of A02 (0: the pendulum, None: the squeezer), ladders of settings for Exudyn and
# for MuJoCo, from cheap to dear. Of each ladder the first setting that meets the error counts, of several ladders the one that
# is cheapest then; where none meets it, the most accurate setting.
ROWS = {
    "A01-1e-6": (1e-6, 0, [[("dopri5", rtol) for rtol in (1e-7, 1e-8, 1e-9, 1e-10)]], [rk4((1e-2, 5e-3, 2e-3, 1e-3))]),
    "A02-1-1e-4": (1e-4, 1, [alpha((5000, 10000, 12500, 20000), 1e-5, "dense")], [rk4((2e-3, 1e-3, 5e-4, 2e-4))]),
    "A02-1-1e-6": (1e-6, 1, [alpha((60000, 125000, 200000), 1e-8, "dense")], [rk4((5e-4, 2e-4, 1e-4, 5e-5))]),
    "A02-10-1e-4": (1e-4, 10, [alpha((10000, 14000, 20000), 1e-6, "sparse")],
                    [rk4((2e-3, 1e-3, 5e-4, 2e-4)), implicit((1e-3, 5e-4, 2e-4))]),
    "A02-40-1e-4": (1e-4, 40, [alpha((10000, 14000, 20000), 1e-6, "sparse")],
                    [rk4((2e-3, 1e-3, 5e-4)), implicit((1e-3, 5e-4, 2e-4))]),
    "A03-1e-3": (1e-3, None, [alpha((300, 450, 600, 1000), 1e-8, "dense")], [rk4((3e-5, 2e-5, 1e-5))]),
    "A03-1e-6": (1e-6, None, [alpha((10000, 20000, 30000, 60000), 1e-8, "dense")], [rk4((5e-6, 3e-6, 2e-6, 1e-6))]),
}

# ---------------------------------------------------------------- exact answers


def place(loops, times):
    """Place of the point that is watched, by integrating the one equation that is left to round-off."""
    if loops == 0:
        factor, start = -G, [math.pi, 0.0]
    else:
        factor = -G * ((loops + 1) / 2 + loops) / ((loops + 1) / 3 + loops)
        start = [math.pi / 2, -1.0]
    found = solve_ivp(lambda _, y: [y[1], factor * math.cos(y[0])], (0, times[-1]), start, method="DOP853",
                      rtol=3e-14, atol=1e-15, t_eval=times)
    return np.c_[np.cos(found.y[0]), np.sin(found.y[0])]


SQUEEZER_END = np.array([15.81077119629904, -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
                         0.5244099658805304, 0.5347301163226948, 1.048080741042263])


def distance(xy, times, loops):
    return float(np.hypot(*(xy - place(loops, times)).T).max())


def squeezer_error(angles):
    """From absolute angles of k1 … k7."""
    k = [None, *angles]
    relative = [k[1], k[2] - k[1], k[3], k[4] - k[5], k[5], k[6] - k[7], k[7]]
    return float(np.abs((np.array(relative) - SQUEEZER_END) / SQUEEZER_END).max())


# ---------------------------------------------------------------- mechanisms


def rods(loops):
    """A02: (centre, angle, velocity, angular velocity) of rockers, then of couplers."""
    rockers = [((i, 0.5), math.pi / 2, (0.5, 0.0), -1.0) for i in range(loops + 1)]
    return rockers + [((i + 0.5, 1.0), 0.0, (1.0, 0.0), 0.0) for i in range(loops)]


def squeezer():
    """A03: bearings, and each body as (mass, inertia, frame origin, angle, centre of mass in its frame)."""
    beta, gamma, phi, delta, omega, epsilon = (-0.06171389001427645, 0.45527981916307037, 0.2226683901658859,
                                               0.4873649795438425, -0.2226683901658859, 1.2305474445498212)
    o, a, b, c = (np.array(p) for p in ([0, 0], [-0.06934, -0.00227], [-0.03635, 0.03273], [0.014, 0.072]))

    def at(origin, angle, x, y):
        return origin + np.array([x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)])

    f, h, g = at(o, beta, 0.007, 0), at(a, delta, 0.04, 0), at(a, epsilon, 0, -0.04)
    bodies = {
        "k1": (0.04325, 2.194e-6, o, beta, (0.00092, 0.0)), "k2": (0.00365, 4.410e-7, f, beta, (-0.0115, 0.0)),
        "k3": (0.02373, 5.255e-6, b, gamma, (0.01874, 0.01043)),
        "k4": (0.00706, 5.667e-7, h, phi + delta, (0.0, -0.00579)),
        "k5": (0.07050, 1.169e-5, a, delta, (0.02308, 0.00916)),
        "k6": (0.00706, 5.667e-7, g, omega + epsilon, (0.00579, 0.0)),
        "k7": (0.05498, 1.912e-5, a, epsilon, (0.01228, -0.00449)),
    }
    return dict(O=o, A=a, B=b, C=c), bodies


# ---------------------------------------------------------------- solvers: functions that run once → (error, CPU seconds)


def linkdyn(name):
    def run():
        command = ["cargo", "bench", "--quiet", "--bench", "dynamics", "--", "--json", name]
        said = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
        row = json.loads(said.strip().splitlines()[-1])
        return row["error"], row["cpu"]
    return run


def exudyn(loops, how):
    exu = importlib.import_module("exudyn")
    items = importlib.import_module("exudyn.itemInterface")

    container = exu.SystemContainer()
    mbs = container.AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    nodes, bodies = [], []

    def fixed(x, y):
        return mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=ground, localPosition=[float(x), float(y), 0]))

    def body(mass, inertia, centre, angle, velocity=(0.0, 0.0), omega=0.0, gravity=True):
        node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[*map(float, centre), angle],
                                                 initialVelocities=[*velocity, omega]))
        number = mbs.AddObject(items.ObjectRigidBody2D(mass=mass, inertia=inertia, nodeNumber=node))
        if gravity:
            marker = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=number))
            mbs.AddLoad(items.LoadMassProportional(markerNumber=marker, loadVector=[0, -G, 0]))
        nodes.append(node)
        bodies.append(number)
        return number

    def point(number, x, y):
        return mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=number, localPosition=[float(x), float(y), 0]))

    def pin(first, second):
        mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=[first, second]))

    watched, end = None, END
    if loops is None:
        end = 0.03
        ground_points, parts = squeezer()
        number, com = {}, {}
        for key, (mass, inertia, origin, angle, centre) in parts.items():
            turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
            number[key] = body(mass, inertia, origin + turn @ np.array(centre), angle, gravity=False)
            com[key] = np.array(centre)

        def of(key, x, y):
            return point(number[key], *(np.array([x, y]) - com[key]))

        pin(fixed(*ground_points["O"]), of("k1", 0, 0))
        pin(of("k1", 0.007, 0), of("k2", 0, 0))
        pin(fixed(*ground_points["B"]), of("k3", 0, 0))
        pin(fixed(*ground_points["A"]), of("k5", 0, 0))
        pin(of("k5", 0.04, 0), of("k4", 0, 0))
        pin(fixed(*ground_points["A"]), of("k7", 0, 0))
        pin(of("k7", 0, -0.04), of("k6", 0, 0))
        for key, x, y in (("k3", 0, -0.035), ("k4", 0, -0.02), ("k6", 0.02, 0)):
            pin(of("k2", -0.028, 0), of(key, x, y))
        mbs.AddObject(items.ObjectConnectorSpringDamper(
            markerNumbers=[fixed(*ground_points["C"]), of("k3", 0.02, -0.018)],
            stiffness=4530.0, damping=0.0, referenceLength=0.07785))
        marker = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=nodes[0], coordinate=2))
        mbs.AddLoad(items.LoadCoordinate(markerNumber=marker, load=0.033))
    elif loops == 0:
        # A point mass on a body about the bearing; explicit solvers eliminate the two coordinate constraints.
        node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[0, 0, math.pi]))
        number = mbs.AddObject(items.ObjectRigidBody2D(mass=1.0, inertia=1.0, nodeNumber=node))
        watched = point(number, 1, 0)
        mbs.AddLoad(items.LoadForceVector(markerNumber=watched, loadVector=[0, -G, 0]))
        origin = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
        for coordinate in (0, 1):
            marker = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate))
            mbs.AddObject(items.ObjectConnectorCoordinate(markerNumbers=[origin, marker]))
    else:
        ends = []
        for centre, angle, velocity, omega in rods(loops):
            number = body(1.0, 1 / 12, centre, angle, velocity, omega)
            ends.append((point(number, -0.5, 0), point(number, 0.5, 0)))
        for i in range(loops + 1):
            pin(fixed(i, 0), ends[i][0])
        for i in range(loops):
            coupler = ends[loops + 1 + i]
            pin(ends[i][1], coupler[0])
            pin(coupler[1], ends[i + 1][1])
        watched = ends[0][1]
    sensor = None
    if watched is not None:
        sensor = mbs.AddSensor(items.SensorMarker(markerNumber=watched, storeInternal=True,
                                                  outputVariableType=exu.OutputVariableType.Position))
    mbs.Assemble()
    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    integration.endTime = end
    integration.verboseMode = 0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = end / 100
    settings.parallel.numberOfThreads = 1
    solver = exu.DynamicSolverType.GeneralizedAlpha
    if how[0] == "dopri5":
        solver = exu.DynamicSolverType.DOPRI5
        integration.numberOfSteps = 100
        integration.automaticStepSize = True
        integration.relativeTolerance, integration.absoluteTolerance = how[1], how[1] * 1e-2
        integration.initialStepSize = 1e-5
    else:
        _, steps, radius, tolerance, linear = how
        integration.numberOfSteps = steps
        integration.generalizedAlpha.spectralRadius = radius
        integration.newton.relativeTolerance = tolerance
        integration.newton.useModifiedNewton = True
        integration.adaptiveStep = False
        settings.linearSolver.solverType = getattr(
            exu.LinearSolverType, {"dense": "EXUdense", "sparse": "EigenSparse"}[linear])

    def run():
        begin = time.process_time()
        mbs.SolveDynamic(settings, solverType=solver, storeSolver=True, showHints=False, showCausingItems=False)
        cpu = time.process_time() - begin
        if loops is None:
            angles = np.array(mbs.systemData.GetODE2Coordinates(), float).reshape(-1, 3)[:, 2]
            return squeezer_error(angles + np.array([part[3] for part in squeezer()[1].values()])), cpu
        rows = np.array(mbs.GetSensorStoredData(sensor))
        # Solvers with a step size of their own write near the sampling times: compare where they did.
        return distance(rows[:, 1:3], rows[:, 0], loops), cpu
    return run


def mujoco(loops, how):
    mj = importlib.import_module("mujoco")

    step, integrator = how

    def inertial(mass, inertia, x, y):
        return f'<inertial pos="{x!r} {y!r} 0" mass="{mass!r}" diaginertia="{inertia!r} {inertia!r} {inertia!r}"/>'

    def body(name, x, y, angle, mass, inertia, com, inside=""):
        return (f'<body name="{name}" pos="{float(x)!r} {float(y)!r} 0" euler="0 0 {angle!r}">'
                f'<joint type="hinge" axis="0 0 1"/>{inertial(mass, inertia, *com)}{inside}</body>')

    def connect(first, second, x):
        return f'<connect body1="{first}" body2="{second}" anchor="{x!r} 0 0"/>'

    world, equality, tendon, gravity, end = "", "", "", -G, END
    if loops is None:
        gravity, end = 0.0, 0.03
        ground, parts = squeezer()

        def part(key, x, y, angle, inside=""):
            mass, inertia, _, _, com = parts[key]
            return body(key, x, y, angle, mass, inertia, com, inside)

        angle = {key: value[3] for key, value in parts.items()}
        world = f'<site name="C" pos="{ground["C"][0]} {ground["C"][1]} 0"/>'
        world += part("k1", 0, 0, angle["k1"], part("k2", 0.007, 0, 0.0))
        world += part("k3", *ground["B"], angle["k3"], '<site name="D" pos="0.02 -0.018 0"/>')
        world += part("k5", *ground["A"], angle["k5"], part("k4", 0.04, 0, angle["k4"] - angle["k5"]))
        world += part("k7", *ground["A"], angle["k7"], part("k6", 0, -0.04, angle["k6"] - angle["k7"]))
        equality = "".join(connect("k2", other, -0.028) for other in ("k3", "k4", "k6"))
        tendon = ('<tendon><spatial stiffness="4530" springlength="0.07785"><site site="C"/><site site="D"/>'
                  "</spatial></tendon>")
    elif loops == 0:
        world = body("rod", 0, 0, math.pi, 1.0, 1e-12, (1.0, 0.0))
    else:
        rod = (1.0, 1 / 12, (0.5, 0.0))
        for i in range(loops + 1):
            coupler = body(f"c{i}", 1, 0, -math.pi / 2, *rod) if i < loops else ""
            world += body(f"r{i}", i, 0, math.pi / 2, *rod, coupler)
        # A coupler's far end, (1, 0) in its frame, is the next rocker's.
        equality = "".join(connect(f"c{i}", f"r{i + 1}", 1.0) for i in range(loops))
    model = mj.MjModel.from_xml_string(
        f'<mujoco><option timestep="{step!r}" integrator="{integrator}" gravity="0 {gravity} 0" iterations="100" '
        'tolerance="1e-12" solver="Newton"><flag contact="disable"/></option>'
        '<compiler angle="radian" boundmass="0" boundinertia="0"/>'
        f'<default><equality solref="{2 * step!r} 1" solimp="0.9999 0.9999 0.001 0.5 2"/></default>'
        f"<worldbody>{world}</worldbody><equality>{equality}</equality>{tendon}</mujoco>")
    data = mj.MjData(model)
    samples = len(SAMPLES) - 1 if loops is not None else 1
    chunk = round(end / step) // samples

    def run():
        mj.mj_resetData(model, data)
        if loops is None:
            data.qfrc_applied[0] = 0.033
        elif loops > 0:
            # Depth first: rocker, coupler, rocker, …; couplers turn relative to rockers.
            data.qvel[0::2], data.qvel[1::2] = -1.0, 1.0
        angles = np.zeros(samples + 1)
        begin = time.process_time()
        for k in range(1, samples + 1):
            mj.mj_step(model, data, nstep=chunk)
            angles[k] = data.qpos[0]
        cpu = time.process_time() - begin
        if loops is None:
            k1, k2, k3, k5, k4, k7, k6 = data.qpos
            start = np.array([part[3] for part in squeezer()[1].values()])
            return squeezer_error(start + np.array([k1, k1 + k2, k3, k5 + k4, k5, k7 + k6, k7])), cpu
        angles += math.pi if loops == 0 else math.pi / 2
        return distance(np.c_[np.cos(angles), np.sin(angles)], SAMPLES, loops), cpu
    return run


# ---------------------------------------------------------------- table


def cheapest(make, loops, ladders, wanted):
    """The run to measure."""
    found = []
    for ladder in ladders:
        for how in ladder:
            run = make(loops, how)
            try:
                error, cpu = run()
            except Exception as refusal:  # A solver that gives up at a loose setting may go on at a tighter one.
                print(f"<!-- {make.__name__} {how}: {type(refusal).__name__} -->")
                continue
            missed = error > wanted
            found.append((missed, error if missed else cpu, len(found), run))
            if not missed:
                break
    return min(found)[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=3, help="every solver once per round, in turn")
    parser.add_argument("--only", default="", help="rows whose name begins so")
    options = parser.parse_args()
    print("| row | linkdyn: error, CPU s | Exudyn: error, CPU s, ratio | MuJoCo: error, CPU s, ratio |")
    print("| --- | --- | --- | --- |")
    for name, (wanted, loops, *ladders) in ROWS.items():
        if not name.startswith(options.only):
            continue
        runs = [linkdyn(name)]
        for make, several in zip((exudyn, mujoco), ladders):
            try:
                runs.append(cheapest(make, loops, several, wanted))
            except ImportError:
                runs.append(None)
        best = [None] * len(runs)
        for _ in range(options.rounds):
            for k, run in enumerate(runs):
                if run:
                    error, cpu = run()
                    best[k] = (error, min(cpu, best[k][1] if best[k] else cpu))
        ours = best[0]
        cells = [f"{ours[0]:.1e}, {ours[1]:.2g}"]
        cells += [f"{b[0]:.1e}, {b[1]:.2g}, {b[1] / ours[1]:.0f}" if b else "not installed" for b in best[1:]]
        print("| " + " | ".join([name, *cells]) + " |", flush=True)


if __name__ == "__main__":
    main()
