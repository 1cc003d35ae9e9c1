"""Each impact of a worn piston pin in two turns of its crank, with approach speed and impulse."""

import linkdyn

motion = linkdyn.load("slider-crank-clearance").simulation()
print("    time [s]  joint     approach [m/s]  impulse [N*s]")
for event in motion.step_to(0.024):
    if event["type"] == "contact":
        print(f"{event['time']:12.6f}  {event['joint']:<8} {event['approach_speed']:15.4f} {event['impulse']:14.5f}")
