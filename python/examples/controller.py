"""A controller opens a door to 90 degrees, a hundred times a second, and overshoots: the door meets its stop."""

import numpy as np

import linkdyn

door = (
    linkdyn.Mechanism(units={"length": "m", "angle": "deg"}, gravity=[0, 0])
    .body("ground", points={"O": [0, 0]})
    .body("door", mass="20 kg", inertia="1.7 kg*m^2", com=[0.5, 0], points={"O": [0, 0]})
    .joint("hinge", "revolute", between=["ground.O", "door.O"], limits=[-5, 95], restitution=0.3)
    .analysis("dynamics", end=8, outputs=2)
    .model()
    .simulation()
)
goal = np.deg2rad(90.0)
for tick in range(1, 801):
    door.set_forces({"door.angle": 60.0 * (goal - door.q[2]) - 12.0 * door.v[2]})
    for event in door.step_to(0.01 * tick):
        if event["type"] == "contact":
            speed, impulse = event["approach_speed"], event["impulse"]
            print(f"{event['time']:.4f} s: {event['stop']} stop, approach {speed:.3f} rad/s, impulse {impulse:.3f} N*m*s")
print(f"at {door.time} s the door stands at {np.rad2deg(door.q[2]):.2f} degrees")
