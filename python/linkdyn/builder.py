"""Building models in Python: the words of a model file, key by key."""

from __future__ import annotations

import copy
import json
from typing import Any

from .model import Model, _plain, load
from .run import Run

__all__ = ["Mechanism"]


class Mechanism:
    """A model in the making. Each method adds something, and gives the mechanism back; :meth:`model` checks it.

    It knows no words of its own: what stands in a call stands in the file, as the book's page "Format" has it. The ground is
    a body like any other.

    >>> import linkdyn
    >>> crank = (
    ...     linkdyn.Mechanism(units="SI")
    ...     .parameter("r", "50 mm")
    ...     .body("ground", points={"O": [0, 0]})
    ...     .body("crank", points={"O": [0, 0], "P": ["=r", 0]})
    ...     .joint("pin", "revolute", between=["ground.O", "crank.O"])
    ...     .driver("motor", "rotation", body="crank", motion={"type": "polynomial", "coefficients": [0, 1]})
    ...     .point("crank.P")
    ...     .analysis("kinematics", end=1, outputs=11)
    ... )
    >>> round(float(crank.run()["crank.P.y"][-1]), 9)
    0.042073549
    """

    def __init__(self, name: str | None = None, *, units: Any = "SI", **words: Any) -> None:
        self._words: dict[str, Any] = {"format": "linkdyn/1"}
        if name is not None:
            self._words["name"] = name
        self._words["units"] = units
        self._words.update(words)

    def _add(self, section: str, name: str, value: Any) -> Mechanism:
        entries = self._words.setdefault(section, {})
        if name in entries:
            raise ValueError(f"{section} has {name!r} already")
        entries[name] = value
        return self

    def parameter(self, name: str, value: Any, **more: Any) -> Mechanism:
        """A parameter; ``tolerance`` and what else it has by name."""
        return self._add("parameters", name, {"value": value, **more} if more else value)

    def body(self, name: str, **words: Any) -> Mechanism:
        """A body: ``points``, ``mass``, ``center``, ``inertia``, ``pose`` and so on."""
        return self._add("bodies", name, words)

    def joint(self, name: str, type: str, *, between: list[str], **words: Any) -> Mechanism:
        """A joint between two points, written ``body.point``."""
        return self._add("joints", name, {"type": type, "between": between, **words})

    def driver(self, name: str, type: str, **words: Any) -> Mechanism:
        """A driver with its ``motion``."""
        return self._add("drivers", name, {"type": type, **words})

    def force(self, name: str, type: str, **words: Any) -> Mechanism:
        """A spring, a damper, a load and so on."""
        return self._add("forces", name, {"type": type, **words})

    def response(self, name: str, value: str, **words: Any) -> Mechanism:
        """A number that comes out of a run."""
        return self._add("responses", name, {"value": value, **words} if words else value)

    def point(self, *names: str) -> Mechanism:
        """Points whose motion stands among the results."""
        self._words.setdefault("points", []).extend(names)
        return self

    def gravity(self, x: Any, y: Any) -> Mechanism:
        """Gravity, as the file has it."""
        self._words["gravity"] = [x, y]
        return self

    def analysis(self, type: str, **words: Any) -> Mechanism:
        """What a run computes."""
        self._words["analysis"] = {"type": type, **words}
        return self

    def section(self, name: str, value: Any) -> Mechanism:
        """Any other part of a model file, such as ``initial`` or ``accuracy``."""
        self._words[name] = value
        return self

    def to_dict(self) -> dict[str, Any]:
        """The model as a dictionary."""
        return copy.deepcopy(self._words)

    def to_json(self) -> str:
        """The model as the text of a file."""
        return json.dumps(self._words, indent=2, ensure_ascii=False, default=_plain)

    def model(self) -> Model:
        """The model, checked.

        :raises ModelError: with all faults.
        """
        return load(self.to_json())

    def run(self, **how: Any) -> Run:
        """Checks and runs it, see :meth:`Model.run`."""
        return self.model().run(**how)
