"""The mechanisms in Exudyn's words. Each function builds one in a system and returns what reads the answer after a run: errors.

`form` says which of Exudyn's formulations: `bodies`, 2D rigid bodies with revolute joints between them; `rotors`, where a body
on a pin of the ground is a rotational mass of one coordinate instead; `tree`, where an open chain is one kinematic tree in its
joint angles; further ones stand at the function of their mechanism.
"""

import sys

import numpy as np

import problems
from problems import GROUND, G

# The compiled module without checks of ranges.
sys.exudynFast = True
import exudyn as exu  # noqa: E402
import exudyn.itemInterface as items  # noqa: E402

# Makes a body that must keep its speed heavy beyond every force on it.
HEAVY = 1e9


def three(point):
    return [float(point[0]), float(point[1]), 0.0]


def coordinate(mbs, node, index):
    return mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=index))


def zero(mbs):
    return coordinate(mbs, mbs.AddNode(items.NodePointGround()), 0)


def hold(mbs, node, indices):
    origin = zero(mbs)
    for index in indices:
        mbs.AddObject(items.ObjectConnectorCoordinate(markerNumbers=[origin, coordinate(mbs, node, index)]))


class Planar:
    """Bodies and pins of a mechanism in a system."""

    def __init__(self, mbs, mechanism, form):
        self.mbs, self.mechanism = mbs, mechanism
        self.ground = mbs.AddObject(items.ObjectGround())
        pivots = {pin.second: pin for pin in mechanism.pins if pin.first == GROUND} if form == "rotors" else {}
        self.objects, self.nodes, self.zeros = {}, {}, {}
        for name, body in mechanism.bodies.items():
            if name in pivots:
                self.rotor(name, body, pivots[name])
            else:
                self.free(name, body)
            if mechanism.gravity:
                load = [0.0, -mechanism.gravity * body.mass, 0.0]
                mbs.AddLoad(items.LoadForceVector(markerNumber=self.point(name, body.com), loadVector=load))
        held = {id(pin) for pin in pivots.values()}
        self.joints = [
            mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=[
                self.point(pin.first, pin.at_first), self.point(pin.second, pin.at_second)]))
            for pin in mechanism.pins if id(pin) not in held
        ]

    def free(self, name, body):
        place, speed = body.place(body.com), body.speed(body.com)
        node = self.mbs.AddNode(items.NodeRigidBody2D(
            referenceCoordinates=[*map(float, place), body.angle], initialVelocities=[*map(float, speed), body.omega]))
        self.nodes[name], self.zeros[name] = (node, 2), body.com
        self.objects[name] = self.mbs.AddObject(items.ObjectRigidBody2D(mass=body.mass, inertia=body.inertia, nodeNumber=node))

    def rotor(self, name, body, pin):
        arm = np.asarray(body.com) - pin.at_second
        node = self.mbs.AddNode(items.Node1D(referenceCoordinates=[body.angle], initialVelocities=[body.omega]))
        self.nodes[name], self.zeros[name] = (node, 0), pin.at_second
        self.objects[name] = self.mbs.AddObject(items.ObjectRotationalMass1D(
            inertia=float(body.inertia + body.mass * arm @ arm), nodeNumber=node, referencePosition=three(pin.at_first)))

    def point(self, name, at):
        if name == GROUND:
            return self.mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=self.ground, localPosition=three(at)))
        local = three(np.asarray(at) - self.zeros[name])
        return self.mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=self.objects[name], localPosition=local))

    def angle(self, name):
        node, index = self.nodes[name]
        moved = self.mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates)
        return float(np.atleast_1d(moved)[index]) + self.mechanism.bodies[name].angle

    def watch(self):
        sensor = self.mbs.AddSensor(items.SensorMarker(
            markerNumber=self.point(*self.mechanism.watched), storeInternal=True,
            outputVariableType=exu.OutputVariableType.Position))
        return lambda: np.array(self.mbs.GetSensorStoredData(sensor))


def largest_distance(rows, loops):
    # Methods that choose their steps write near the sampling times: compare where they did.
    return float(np.hypot(*(rows[:, 1:3] - problems.swing_place(loops, rows[:, 0])).T).max())


def pendulum(mbs, form):
    """Forms: `rotors`, `tree`; `held`, a 2D body about its bearing whose translations are held by coordinate constraints, which
    explicit methods eliminate; `rod`, a mass point at a constant distance."""
    mechanism = problems.pendulum()
    if form == "tree":
        rows = tree(mbs, mechanism)
    elif form == "rotors":
        rows = Planar(mbs, mechanism, form).watch()
    else:
        rows = point_mass(mbs, form)
    return lambda: largest_distance(rows(), 0)


def point_mass(mbs, form):
    if form == "held":
        node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[0.0, 0.0, np.pi]))
        body = mbs.AddObject(items.ObjectRigidBody2D(mass=1.0, inertia=1.0, nodeNumber=node))
        marker = mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=body, localPosition=[1.0, 0.0, 0.0]))
        hold(mbs, node, (0, 1))
    else:
        node = mbs.AddNode(items.NodePoint2D(referenceCoordinates=[-1.0, 0.0]))
        body = mbs.AddObject(items.ObjectMassPoint2D(mass=1.0, nodeNumber=node))
        marker = mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=body))
        bearing = mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=mbs.AddObject(items.ObjectGround())))
        mbs.AddObject(items.ObjectConnectorDistance(markerNumbers=[bearing, marker], distance=1.0))
    mbs.AddLoad(items.LoadForceVector(markerNumber=marker, loadVector=[0.0, -G, 0.0]))
    sensor = mbs.AddSensor(items.SensorMarker(markerNumber=marker, storeInternal=True,
                                              outputVariableType=exu.OutputVariableType.Position))
    return lambda: np.array(mbs.GetSensorStoredData(sensor))


def tree(mbs, mechanism):
    """An open chain in its joint angles; returns what reads the watched point."""
    bodies, pins = list(mechanism.bodies.values()), mechanism.pins
    before = np.concatenate([[0.0], [body.angle for body in bodies[:-1]]])
    node = mbs.AddNode(items.NodeGenericODE2(
        referenceCoordinates=[body.angle - angle for body, angle in zip(bodies, before)],
        initialCoordinates=[0.0] * len(bodies), initialCoordinates_t=[body.omega for body in bodies],
        numberOfODE2Coordinates=len(bodies)))
    turns, offsets, inertias, centres = exu.Matrix3DList(), exu.Vector3DList(), exu.Matrix3DList(), exu.Vector3DList()
    for body, pin in zip(bodies, pins):
        turns.Append(np.eye(3))
        offsets.Append(three(pin.at_first))
        # About the other axes nothing turns.
        inertias.Append(np.diag([body.inertia] * 3))
        centres.Append(three(body.com))
    number = mbs.AddObject(items.ObjectKinematicTree(
        nodeNumber=node, jointTypes=[exu.JointType.RevoluteZ] * len(bodies), linkParents=list(range(-1, len(bodies) - 1)),
        jointTransformations=turns, jointOffsets=offsets, linkInertiasCOM=inertias, linkCOMs=centres,
        linkMasses=[body.mass for body in bodies], gravity=[0.0, -mechanism.gravity, 0.0]))
    sensor = mbs.AddSensor(items.SensorKinematicTree(
        objectNumber=number, linkNumber=len(bodies) - 1, localPosition=three(mechanism.watched[1]), storeInternal=True,
        outputVariableType=exu.OutputVariableType.Position))
    return lambda: np.array(mbs.GetSensorStoredData(sensor))


def four_bars(mbs, form, loops):
    rows = Planar(mbs, problems.four_bars(loops), form).watch()
    return lambda: largest_distance(rows(), loops)


def squeezer(mbs, form):
    planar = Planar(mbs, problems.squeezer(), form)
    stiffness, length, at_ground, at_body = problems.SQUEEZER_SPRING
    mbs.AddObject(items.ObjectConnectorSpringDamper(
        markerNumbers=[planar.point(GROUND, at_ground), planar.point("k3", at_body)], stiffness=stiffness, damping=0.0,
        referenceLength=length))
    mbs.AddLoad(items.LoadCoordinate(markerNumber=coordinate(mbs, *planar.nodes["k1"]), load=problems.SQUEEZER_TORQUE))
    return lambda: problems.squeezer_error({name: planar.angle(name) for name in planar.mechanism.bodies})


def chain(mbs, form, links):
    mechanism = problems.chain(links)
    rows = tree(mbs, mechanism) if form == "tree" else Planar(mbs, mechanism, form).watch()
    return lambda: float(np.hypot(*(rows()[-1, 1:3] - problems.chain_tip(links))))


def lock(mbs, form):
    """Forms: `speed`, driven by a constraint of the angular velocity; `clock`, by one of the angle, to a heavy mass that
    moves on evenly."""
    planar = Planar(mbs, problems.lock(), "bodies")
    driven = coordinate(mbs, *planar.nodes[problems.LOCK_DRIVEN])
    if form == "speed":
        words = dict(markerNumbers=[zero(mbs), driven], velocityLevel=True, offset=problems.LOCK_SPEED)
    else:
        clock = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0], initialVelocities=[problems.LOCK_SPEED]))
        mbs.AddObject(items.ObjectMass1D(mass=HEAVY, nodeNumber=clock))
        words = dict(markerNumbers=[coordinate(mbs, clock, 0), driven])
    driver = mbs.AddObject(items.ObjectConnectorCoordinate(**words))
    sensors = [mbs.AddSensor(items.SensorObject(objectNumber=number, storeInternal=True,
                                                outputVariableType=exu.OutputVariableType.Force))
               for number in [*planar.joints, driver]]

    def error():
        rows = [np.array(mbs.GetSensorStoredData(sensor)) for sensor in sensors]
        instants = np.rint(rows[0][:, 0] * problems.LOCK_INSTANTS).astype(int)
        forces = np.column_stack([row[:, 1:3] for row in rows[:-1]] + [rows[-1][:, 1]])
        # The first instant is the state at the start, in which no forces are stored yet.
        return problems.lock_error(-forces[1:], instants[1:])
    return error


def clearance(mbs, form):
    """Forms: `bodies`; `tree`, where crank and rod are a kinematic tree whose crank is so heavy that it keeps its speed."""
    problem = problems.Clearance()
    slider = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[problem.crank + problem.rod, 0.0, 0.0]))
    journal = mbs.AddObject(items.ObjectRigidBody2D(mass=problem.slider_mass, inertia=1e-4, nodeNumber=slider))
    hold(mbs, slider, (1, 2))
    bearing, angle = (clearance_tree if form == "tree" else clearance_bodies)(mbs, problem)
    data = mbs.AddNode(items.NodeGenericData(initialCoordinates=[problem.clearance, 0, 0, 0], numberOfDataCoordinates=4))
    # Its Hunt–Crossley factor 3/2 (1 − e) is Lankarani's and Nikravesh's 3/4 (1 − e²) for this restitution.
    restitution = (1 + problem.restitution**2) / 2
    mbs.AddObject(items.ObjectContactSphereSphere(
        markerNumbers=[mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=journal)), bearing], nodeNumber=data,
        spheresRadii=[problem.bearing - problem.clearance, problem.bearing], isHollowSphere1=True,
        dynamicFriction=problem.friction, frictionProportionalZone=problem.threshold, contactStiffness=problem.stiffness,
        contactStiffnessExponent=1.5, restitutionCoefficient=restitution, impactModel=1))
    place = mbs.AddSensor(items.SensorNode(nodeNumber=slider, storeInternal=True,
                                           outputVariableType=exu.OutputVariableType.Position))

    def error():
        rows = np.array(mbs.GetSensorStoredData(place))
        return problems.clearance_error(rows[:, 0], rows[:, 1], angle())
    return error


def clearance_bodies(mbs, problem):
    half = problem.crank / 2
    omega = -problem.speed * problem.crank / problem.rod
    bodies = {
        "crank": problems.Body(*problem.crank_mass, (half, 0.0), omega=problem.speed),
        "rod": problems.Body(*problem.rod_mass, (problem.rod / 2, 0.0), (problem.crank, 0.0),
                             velocity=(0.0, problem.speed * problem.crank), omega=omega),
    }
    origin = (0.0, 0.0)
    pins = (problems.Pin(GROUND, origin, "crank", origin), problems.Pin("crank", (problem.crank, 0.0), "rod", origin))
    planar = Planar(mbs, problems.Mechanism(bodies, pins, 0.0, problem.end, problem.samples), "bodies")
    crank = coordinate(mbs, *planar.nodes["crank"])
    mbs.AddObject(items.ObjectConnectorCoordinate(markerNumbers=[zero(mbs), crank], velocityLevel=True, offset=problem.speed))
    turn = mbs.AddSensor(items.SensorNode(nodeNumber=planar.nodes["rod"][0], storeInternal=True,
                                          outputVariableType=exu.OutputVariableType.Coordinates))
    bearing = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=planar.objects["rod"], localPosition=[problem.rod / 2, 0.0, 0.0]))
    return bearing, lambda: np.array(mbs.GetSensorStoredData(turn))[:, 3]


def clearance_tree(mbs, problem):
    omega = -problem.speed * problem.crank / problem.rod
    node = mbs.AddNode(items.NodeGenericODE2(
        referenceCoordinates=[0.0, 0.0], initialCoordinates=[0.0, 0.0],
        initialCoordinates_t=[problem.speed, omega - problem.speed], numberOfODE2Coordinates=2))
    turns, offsets, inertias, centres = exu.Matrix3DList(), exu.Vector3DList(), exu.Matrix3DList(), exu.Vector3DList()
    for inertia, offset, centre in ((HEAVY, 0.0, 0.0), (problem.rod_mass[1], problem.crank, problem.rod / 2)):
        turns.Append(np.eye(3))
        offsets.Append([offset, 0.0, 0.0])
        inertias.Append(np.diag([inertia] * 3))
        centres.Append([centre, 0.0, 0.0])
    number = mbs.AddObject(items.ObjectKinematicTree(
        nodeNumber=node, jointTypes=[exu.JointType.RevoluteZ] * 2, linkParents=[-1, 0], jointTransformations=turns,
        jointOffsets=offsets, linkInertiasCOM=inertias, linkCOMs=centres, linkMasses=[1.0, problem.rod_mass[0]]))
    bearing = mbs.AddMarker(items.MarkerKinematicTreeRigid(objectNumber=number, linkNumber=1,
                                                           localPosition=[problem.rod, 0.0, 0.0]))
    turn = mbs.AddSensor(items.SensorNode(nodeNumber=node, storeInternal=True,
                                          outputVariableType=exu.OutputVariableType.Coordinates))
    return bearing, lambda: np.array(mbs.GetSensorStoredData(turn))[:, 1:3].sum(axis=1)
