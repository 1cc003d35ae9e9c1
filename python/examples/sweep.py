"""The greatest torque of a four-bar's motor over the length of its crank, as a figure: writes sweep.svg."""

import sys

import matplotlib.pyplot as plt
import numpy as np

import linkdyn

family = linkdyn.load("four-bar").family(["crank"], {"peak": "max(abs(driver.motor.effort))"})
lengths = np.linspace(0.06, 0.11, 51)
peaks = family(lengths[:, np.newaxis])["peak"]

figure, axes = plt.subplots()
axes.plot(1e3 * lengths, peaks)
axes.set_xlabel("crank [mm]")
axes.set_ylabel("greatest torque [N*m]")
path = sys.argv[1] if len(sys.argv) > 1 else "sweep.svg"
figure.savefig(path)
print("written:", path)
