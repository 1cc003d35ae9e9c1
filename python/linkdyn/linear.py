"""Mechanisms as linear systems."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    import control
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from scipy import signal

__all__ = ["LinearSystem"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


class LinearSystem:
    """``x' = A x + B w``, ``y = C x + D w``: how a mechanism moves about a point, in differences from that point.

    >>> import linkdyn
    >>> pendulum = linkdyn.load("pendulum").linearise(inputs="rod.torque", outputs="rod.angle")
    >>> pendulum.A.shape, pendulum.B.shape
    ((2, 2), (2, 1))
    >>> bool(abs(pendulum.frequency_response(0.0)[0, 0] - pendulum.gain[0, 0]) < 1e-12)
    True
    """

    A: Array
    """(states, states)"""
    B: Array
    """(states, inputs)"""
    C: Array
    """(outputs, states)"""
    D: Array
    """(outputs, inputs)"""
    states: list[str]
    inputs: list[str]
    outputs: list[str]
    x0: Array
    """The states at the point, in SI."""
    u0: Array
    """The inputs there: what drivers exert that are let go, and zero of other forces."""
    y0: Array
    """The outputs there."""
    dx0: Array
    """The rates of the states there: the mechanism drifts where one is not zero."""
    units: dict[str, str]
    """SI units of states, inputs and outputs."""
    time: float | None
    """The instant of the motion [s]; at rest None."""
    answer: dict[str, Any]
    """What ``state-space.json`` says of it: equilibrium, phases of contacts, errors and so on."""

    def __init__(self, answer: Mapping[str, Any]) -> None:
        self.answer = dict(answer)
        parts = {part: answer[part] for part in ("states", "inputs", "outputs")}
        names = {part: [own["name"] for own in all] for part, all in parts.items()}
        values = {part: np.array([own["value"] for own in all], dtype=float) for part, all in parts.items()}
        self.states, self.inputs, self.outputs = names["states"], names["inputs"], names["outputs"]
        self.x0, self.u0, self.y0 = values["states"], values["inputs"], values["outputs"]
        self.dx0 = np.array(answer["rates"], dtype=float)
        self.units = {own["name"]: own["unit"] for all in parts.values() for own in all}
        self.time = answer["time"]
        n, m, p = len(self.states), len(self.inputs), len(self.outputs)
        shapes = {"A": (n, n), "B": (n, m), "C": (p, n), "D": (p, m)}
        self.A, self.B, self.C, self.D = (
            np.array(answer[name], dtype=float).reshape(shape) for name, shape in shapes.items()
        )

    def __repr__(self) -> str:
        at = "rest" if self.time is None else f"t = {self.time} s"
        return f"<linkdyn.LinearSystem at {at}: states {self.states}, inputs {self.inputs}, outputs {self.outputs}>"

    @property
    def gain(self) -> Array | None:
        """``D - C A⁻¹ B``, what outputs come to by constant inputs; None if a pole is zero."""
        gain = self.answer["gain"]
        return None if gain is None else np.array(gain, dtype=float).reshape(self.D.shape)

    @cached_property
    def poles(self) -> Complex:
        """The eigenvalues of A, both of each pair, slowest first [1/s]."""
        told = [complex(pole["re"], pole["im"]) for pole in self.answer["poles"]]
        both = [part for pole in told for part in ((pole, pole.conjugate()) if pole.imag else (pole,))]
        return np.array(both, dtype=complex)

    def frequency_response(self, omega: ArrayLike) -> Complex:
        """``G(iω) = C (iω - A)⁻¹ B + D``.

        :param omega: angular frequencies [rad/s], of any shape.
        :returns: (..., outputs, inputs)
        """
        s = 1j * np.asarray(omega, dtype=float)[..., None, None]
        unit = np.eye(len(self.states))
        return np.asarray(self.C @ np.linalg.solve(s * unit - self.A, self.B + 0j * s) + self.D)

    def to_scipy(self) -> signal.StateSpace:
        """The system for ``scipy.signal``."""
        from scipy import signal

        return signal.StateSpace(self.A, self.B, self.C, self.D)

    def to_control(self) -> control.StateSpace:
        """The system for the package ``control``, with the names of states, inputs and outputs."""
        import control

        # Dots divide the names of systems and signals there.
        names = {part: [name.replace(".", "_") for name in getattr(self, part)] for part in ("states", "inputs", "outputs")}
        return control.ss(self.A, self.B, self.C, self.D, **names)

    def _omega(self, omega: ArrayLike | None) -> Array:
        if omega is not None:
            return np.asarray(omega, dtype=float)
        sizes = np.abs(self.poles)
        sizes = sizes[sizes > 0]
        low, high = (sizes.min() / 30, sizes.max() * 30) if sizes.size else (0.6, 60.0)
        # At the poles, too: peaks are narrow.
        places = [np.geomspace(low, high, 600), np.abs(self.poles.imag)]
        omega = np.unique(np.concatenate(places))
        return np.asarray(omega[(omega >= low) & (omega <= high)])

    def bode(self, omega: ArrayLike | None = None) -> Figure:
        """Amplitude and phase of each output over the frequency [Hz], with matplotlib.

        :param omega: angular frequencies [rad/s]; from the poles where none are given.
        """
        from matplotlib import pyplot

        omega = self._omega(omega)
        response = self.frequency_response(omega)
        figure: Figure = pyplot.figure(layout="constrained")
        axes = figure.subplots(2, max(1, len(self.outputs)), sharex=True, squeeze=False)
        for row, output in enumerate(self.outputs):
            for column, name in enumerate(self.inputs):
                own = response[:, row, column]
                axes[0, row].loglog(omega / (2 * np.pi), np.abs(own), label=name)
                axes[1, row].semilogx(omega / (2 * np.pi), np.degrees(np.unwrap(np.angle(own))))
            axes[0, row].set_title(f"{output} [{self.units[output]} per input]")
            axes[1, row].set_xlabel("frequency [Hz]")
            axes[0, row].legend()
        axes[0, 0].set_ylabel("amplitude")
        axes[1, 0].set_ylabel("phase [deg]")
        for ax in axes.flat:
            ax.grid(True, alpha=0.3)
        return figure

    def nyquist(self, omega: ArrayLike | None = None, ax: Axes | None = None) -> Axes:
        """The path of each response in the plane of complex numbers, with matplotlib.

        :param omega: angular frequencies [rad/s]; from the poles where none are given.
        """
        if ax is None:
            from matplotlib import pyplot

            ax = pyplot.subplots()[1]
        response = self.frequency_response(self._omega(omega))
        for row, output in enumerate(self.outputs):
            for column, name in enumerate(self.inputs):
                own = response[:, row, column]
                ax.plot(own.real, own.imag, label=f"{output} by {name}")
        ax.set_xlabel("real part")
        ax.set_ylabel("imaginary part")
        ax.legend()
        ax.grid(True, alpha=0.3)
        return ax
