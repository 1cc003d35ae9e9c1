"""Equations that ``linkdyn export --equations`` writes, checked against the engine's own at many states.

The engine has three coordinates a body and multipliers for every joint, the module has minimal coordinates: they share no
matrix.
"""

from __future__ import annotations

import importlib.util
import json
import math
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import linkdyn
from linkdyn import _linkdyn

# Relative to the largest acceleration or effort: both are solved in double precision, with condition numbers up to 1e4.
CLOSE = 1e-12
# LaTeX has ten digits.
PRINTED = 1e-8

# Radians, or fifths of a metre, of mechanisms that lock sooner than others.
REACH = {"four-bar with a spring": 0.05}
# A stiff spring pulls by the difference of two large numbers: stiffness, length and arm of the shock of 80 N/mm [N m].
STIFF = {"four-bar with a spring": 80e3 * 0.25 * 0.06}


def body(mass: float, inertia: float, com: list[float], points: dict[str, list[float]], **rest: Any) -> dict[str, Any]:
    return {"mass": mass, "inertia": inertia, "com": com, "points": points, **rest}


def pin(one: str, other: str) -> dict[str, Any]:
    return {"type": "revolute", "between": [one, other]}


def at(x: float, y: float, angle: float = 0.0) -> dict[str, Any]:
    return {"pose": {"position": [x, y], "angle": angle}}


def model(bodies: dict[str, Any], joints: dict[str, Any], **rest: Any) -> dict[str, Any]:
    analysis = {"type": "dynamics", "end": 1, "outputs": 3, "solver": {"rtol": 1e-11, "atol": 1e-13}}
    head = {"format": "linkdyn/1", "units": "SI", "gravity": [0.3, -9.81], "bodies": bodies, "joints": joints}
    return {**head, "analysis": analysis, **rest}


def cart_pole(**rest: Any) -> dict[str, Any]:
    bodies = {
        "ground": {"points": {"O": [0, 0.1], "wall": [-2, 0.4]}},
        "cart": body(1.3, 0.02, [0.05, 0.02], {"O": [0, 0], "A": [0.1, 0.2]}, **at(0.3, 0.1, 0.2)),
        "pole": body(0.4, 0.03, [0.02, -0.35], {"A": [0, 0], "P": [0, -0.7]}, **at(0.36, 0.32, 0.5)),
    }
    rail = {"type": "prismatic", "between": ["ground.O", "cart.O"], "axis": [3, 1], "angle": 0.2}
    joints = {"rail": rail, "hinge": pin("cart.A", "pole.A")}
    forces = {
        "rope": {"type": "spring", "between": ["ground.wall", "pole.P"], "stiffness": 30, "damping": 2, "free_length": 1.9},
        "hinge": {"type": "torsion_spring", "between": ["pole", "cart"], "stiffness": 2, "damping": 0.1, "free_angle": 0.3},
        "push": {
            "type": "force",
            "at": "cart.A",
            "frame": "body",
            "vector": [{"type": "harmonic", "offset": 1, "amplitude": 3, "frequency": 2, "phase": 0.3}, -2],
        },
    }
    return model(bodies, joints, **{"forces": forces, **rest})


def slider_crank(**rest: Any) -> dict[str, Any]:
    words = linkdyn.load("slider-crank").to_dict()
    words["analysis"] = {"type": "dynamics", "end": 1, "outputs": 3}
    return {**words, **rest}


def loops(name: str, **rest: Any) -> dict[str, Any]:
    words = linkdyn.load(name).to_dict()
    words["analysis"] = {"type": "dynamics", "end": 1, "outputs": 3}
    return {**words, **rest}


def five_bar(**rest: Any) -> dict[str, Any]:
    a, b = [-0.2, 0.0], [0.2, 0.0]
    top = [0.0, 0.45]
    left, right = [-0.35, 0.2], [0.35, 0.25]

    def bar(start: list[float], end: list[float], names: str, mass: float) -> dict[str, Any]:
        d = [end[0] - start[0], end[1] - start[1]]
        length = math.hypot(*d)
        points: dict[str, list[float]] = {names[0]: [0, 0], names[1]: [length, 0]}
        return body(
            mass, mass * length**2 / 12, [length / 2, 0.01], points, **at(start[0], start[1], math.atan2(d[1], d[0]))
        )

    bodies = {
        "ground": {"points": {"A": a, "B": b}},
        "left": bar(a, left, "AL", 0.5),
        "upper_left": bar(left, top, "LT", 0.7),
        "upper_right": bar(right, top, "RT", 0.6),
        "right": bar(b, right, "BR", 0.4),
    }
    joints = {
        "a": pin("ground.A", "left.A"),
        "l": pin("left.L", "upper_left.L"),
        "t": pin("upper_left.T", "upper_right.T"),
        "r": pin("right.R", "upper_right.R"),
        "b": pin("right.B", "ground.B"),
    }
    forces = {
        "elbow": {"type": "torsion_spring", "between": ["left", "upper_left"], "damping": 0.05},
        "base": {"type": "torsion_spring", "between": ["ground", "right"], "stiffness": 3, "damping": 0.02},
        "dash": {"type": "spring", "between": ["left.L", "right.R"], "damping": 4},
        "ram": {"type": "actuator", "between": ["ground.A", "upper_right.R"], "force": 5},
        "motor": {"type": "torque", "body": "left", "relative_to": "upper_left", "value": 0.3},
    }
    return model(bodies, joints, **{"forces": forces, **rest})


def oscillating() -> dict[str, Any]:
    """A rod that slides through a block that turns, with a block welded to it askew: no slide is along the ground."""
    bodies = {
        "ground": {"points": {"O": [0, 0], "C": [0.5, 0.1]}},
        "crank": body(0.5, 0.002, [0.05, 0], {"O": [0, 0], "A": [0.12, 0]}, **at(0, 0, 1.0)),
        "rod": body(0.8, 0.01, [0.2, 0.03], {"A": [0, 0], "E": [0.6, 0.1]}, **at(0.0648, 0.101, 0.0)),
        "block": body(0.2, 0.001, [0.01, 0], {"C": [0, 0]}, **at(0.5, 0.1, 0.3)),
        "head": body(0.3, 0.004, [0.02, 0.05], {"E": [0, 0], "T": [0.1, 0.1]}, **at(0.66, 0.2, 0.7)),
    }
    joints = {
        "o": pin("ground.O", "crank.O"),
        "a": pin("crank.A", "rod.A"),
        "c": pin("ground.C", "block.C"),
        "guide": {"type": "prismatic", "between": ["rod.A", "block.C"], "axis": [1, 0], "angle": 0.3},
        "weld": {"type": "fixed", "between": ["rod.E", "head.E"], "angle": 0.7},
    }
    forces = {"wind": {"type": "force", "at": "head.T", "vector": [2, {"type": "polynomial", "coefficients": [1, -3, 2]}]}}
    return model(bodies, joints, forces=forces)


def adrift() -> dict[str, Any]:
    """Two bodies that no joint holds to the ground, with springs; names that are no identifiers."""
    bodies = {
        "ground": {"points": {"O": [0, 0]}},
        "lambda": body(2, 0.1, [0.1, 0.2], {"1a": [0.3, 0], "ä_b": [-0.3, 0.1]}, **at(1, 1, 0.4)),
        "class": body(1, 0.05, [0, 0.1], {"1a": [0, 0], "a b": [0.2, 0]}, **at(1.3, 1.2, 0.1)),
        "a b": body(0.5, 0.02, [0.0, 0.0], {"x": [0, 0]}, **at(-1, 0.5, 0.0)),
        "a_b": body(0.6, 0.03, [0.0, 0.1], {"com": [0, 0], "y": [0.1, 0]}, **at(-1.2, 0.7, 0.0)),
        "曲柄": body(0.1, 0.01, [0.0, 0.1], {"x": [0, 0]}, **at(2, 2, 0.0)),
    }
    joints = {
        "π": pin("lambda.1a", "class.1a"),
        "in": {"type": "prismatic", "between": ["a_b.com", "a b.x"], "axis": [1, -0.7]},
    }
    forces = {
        "if": {"type": "spring", "between": ["ground.O", "lambda.ä_b"], "stiffness": 40, "damping": 1, "free_length": 0.5},
        "IF": {"type": "spring", "between": ["a_b.y", "class.a b"], "stiffness": 10, "free_length": 0.2},
        "else": {"type": "spring", "between": ["曲柄.x", "a b.x"], "stiffness": 10, "damping": 0.5},
    }
    return model(bodies, joints, forces=forces)


def turning(body: str, motion: dict[str, Any], **rest: Any) -> dict[str, Any]:
    return {"drivers": {"motor": {"type": "rotation", "body": body, "motion": motion, **rest}}}


QUADRATIC = {"type": "polynomial", "coefficients": [1.2, 3, -0.7, 0.2]}
SLIDING = {"type": "harmonic", "offset": 0.25, "amplitude": 0.1, "frequency": 1.5}
ACCELERATED = {"type": "constant_acceleration", "start": 2.1, "velocity": 1, "acceleration": 2}
TRANSLATION = {"drivers": {"belt": {"type": "translation", "joint": "rail", "motion": SLIDING}}}
RELATIVE = turning("pole", {"type": "constant_velocity", "start": 0.3, "velocity": 2}, relative_to="cart")

MODELS = {
    "pendulum": lambda: linkdyn.load("pendulum").to_dict(),
    "double pendulum": lambda: linkdyn.load("double-pendulum").to_dict(),
    "cart-pole": cart_pole,
    "cart-pole, cart driven": lambda: cart_pole(**TRANSLATION),
    "cart-pole, pole driven in the cart": lambda: cart_pole(**RELATIVE),
    "slider-crank, driven": slider_crank,
    "slider-crank": lambda: slider_crank(drivers={}),
    "four-bar, driven": lambda: loops("four-bar"),
    "four-bar with a spring": lambda: loops("bicycle-suspension", drivers={}),
    "six-bar": lambda: loops("stephenson-iii", drivers={}),
    "six-bar, driven": lambda: loops("stephenson-iii"),
    "five-bar": five_bar,
    "five-bar, a crank driven": lambda: five_bar(**turning("left", ACCELERATED)),
    "oscillating block": oscillating,
    "quick-return": lambda: loops("quick-return"),
    "adrift": adrift,
}


def export(words: dict[str, Any], language: str, folder: Path) -> Path:
    source = folder / "model.json"
    source.write_text(json.dumps(words))
    target = folder / ("equations.py" if language == "python" else "equations.tex")
    said, stopped = _linkdyn.command(["export", str(source), "--equations", language, "-o", str(target)])
    assert stopped is None and said.status == 0, said.stderr
    return target


def module(words: dict[str, Any], folder: Path) -> ModuleType:
    path = export(words, "python", folder)
    spec = importlib.util.spec_from_file_location("equations", path)
    assert spec is not None and spec.loader is not None
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


def relative(found: Any, expected: Any) -> float:
    """Largest difference by the largest magnitude."""
    found, expected = np.asarray(found), np.asarray(expected)
    return float(np.max(np.abs(found - expected), initial=0) / max(np.max(np.abs(expected), initial=0), 1e-3))


def states(made: ModuleType, name: str) -> list[tuple[float, Any, Any]]:
    """Instants and states near the start, as far as the loops of these mechanisms reach."""
    random = np.random.default_rng(7)
    free = len(made.INDEPENDENT)
    near = np.array(made.START)[made.INDEPENDENT]
    scales = np.array([1.0 if made.COORDINATES[k].startswith("phi") else 0.2 for k in made.INDEPENDENT])
    wide = 2.0 if not hasattr(made, "GIVEN") else REACH.get(name, 0.25)
    draw = random.uniform(-1, 1, (20, 2, free))
    return [(0.02 * k, near + wide * scales * u, 5 * scales * du) for k, (u, du) in enumerate(draw)]


@pytest.mark.parametrize("name", MODELS)
def test_accelerations_and_efforts_are_those_of_the_engine(name: str, tmp_path: Path) -> None:
    words = MODELS[name]()
    made = module(words, tmp_path)
    engine = linkdyn.load(tmp_path / "model.json").compile()
    assert [f"{one}.x" for one in made.BODIES] == engine.coordinates[::3]
    for t, u, du in states(made, name):
        p, dp, ddp, efforts = made.motion(t, u, du)
        centres, slopes, turns = made.centres(p), made.slopes(p), made.TURNS

        def coordinates(plane: Any, angle: Any) -> Any:
            return np.column_stack([plane.real, plane.imag, angle]).ravel()

        q = coordinates(centres, turns @ p + made.OFFSETS)
        v = coordinates(slopes @ dp, turns @ dp)
        a = coordinates(slopes @ ddp + made.bends(p, dp), turns @ ddp)
        terms = engine.evaluate(q, v, t)
        assert np.max(np.abs(terms.phi), initial=0) < 1e-12, (name, t)
        assert relative(terms.jacobian @ v, -terms.rate) < CLOSE, (name, t)
        accelerations, multipliers = terms.accelerations()
        assert relative(a, accelerations) < CLOSE, (name, t, u)
        drivers = len(made.DRIVERS)
        assert relative(efforts, multipliers[len(multipliers) - drivers :]) < CLOSE, (name, t)
        assert np.array_equal(made.acceleration(t, u, du), ddp[made.INDEPENDENT])
        assert np.array_equal(made.effort(t, u, du, guess=p), made.motion(t, u, du, guess=p)[3])


@pytest.mark.parametrize("name", MODELS)
def test_the_module_checks_itself(name: str, tmp_path: Path) -> None:
    path = export(MODELS[name](), "python", tmp_path)
    rows = [(here, there) for _, here, there in module(MODELS[name](), tmp_path).check()]
    here, there = np.array(rows).T
    assert relative(here, there) < 1e-11, name
    said = subprocess.run([sys.executable, path], capture_output=True, text=True, check=True)
    assert said.stdout.splitlines()[0].split() == ["at", "the", "start", "here", "linkdyn"]
    assert len(said.stdout.splitlines()) == len(rows) + 1 and "nan" not in said.stdout
    lint = [sys.executable, "-m", "ruff", "check", "--isolated", "--line-length", "100", "--select", "E,F,W,B,N8", str(path)]
    checked = subprocess.run(lint, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout


def test_the_double_pendulum_goes_as_the_run(tmp_path: Path) -> None:
    integrate = pytest.importorskip("scipy.integrate")
    words = linkdyn.load("double-pendulum").to_dict()
    words["analysis"] = {"type": "dynamics", "end": 1, "outputs": 11, "solver": {"rtol": 1e-12, "atol": 1e-14}}
    made = module(words, tmp_path)
    run = linkdyn.load(tmp_path / "model.json").run()

    def rate(t: float, y: Any) -> Any:
        return np.concatenate([y[2:], made.acceleration(t, y[:2], y[2:])])

    start = np.concatenate([made.START, made.START_RATES])
    found = integrate.solve_ivp(rate, (0, 1), start, method="DOP853", rtol=1e-12, atol=1e-14, t_eval=run["time"])
    for row, column in enumerate(["upper.angle", "lower.angle", "upper.omega", "lower.omega"]):
        assert np.max(np.abs(found.y[row] - run[column])) < 1e-9, column


def test_a_loop_keeps_its_branch_over_a_turn(tmp_path: Path) -> None:
    made = module(loops("four-bar", drivers={}), tmp_path)
    begin = made.START[made.INDEPENDENT]
    once = made.positions(begin + 2 * np.pi)
    assert np.allclose(np.exp(1j * once), np.exp(1j * made.START), atol=1e-12)
    with pytest.raises(ValueError, match="no numbers"):
        made.positions([np.nan])
    with pytest.raises(ValueError, match="too far"):
        made.positions([1e9])


def test_loops_that_do_not_close_are_told(tmp_path: Path) -> None:
    made = module(loops("bicycle-suspension", drivers={}), tmp_path)
    with pytest.raises((ArithmeticError, np.linalg.LinAlgError)):
        made.positions(made.START[made.INDEPENDENT] + 3.0)


REFUSED = [
    (
        ["geneva", "python"],
        'geneva: line 17, column 13: joints.slot: a joint of type "contact" is not written as equations '
        "(revolute, prismatic and fixed joints are)",
    ),
    (
        ["engine", "python"],
        'engine: line 30, column 84: forces.gas.force: "=area*(gas(crank.angle) - 1 bar)": a formula of the motion is not '
        "written as equations (constants and laws of time are)",
    ),
    (
        ["jansen-leg", "latex"],
        "jansen-leg: line 9, column 13: bodies: 7 moving bodies are too many for equations in LaTeX (6 at most; "
        "`--equations python` writes more)",
    ),
    (
        ["parallel-crank", "python"],
        "parallel-crank: line 26, column 10: joints.b: the loop that this joint closes depends on others here, and a "
        "redundant joint or a singular position is not written as equations (remove what is redundant, `linkdyn check` "
        "names it, or start from another position)",
    ),
    (
        ["chebyshev", "python"],
        'chebyshev: line 11, column 16: bodies.left: dynamics needs the mass of body "left" (give "mass"; 0 is allowed '
        "where the joints determine its motion)",
    ),
]


@pytest.mark.parametrize(("asked", "text"), REFUSED)
def test_what_is_not_written_is_told_and_writes_no_file(asked: list[str], text: str, tmp_path: Path) -> None:
    target = tmp_path / "equations"
    said, _ = _linkdyn.command(["export", asked[0], "--equations", asked[1], "-o", str(target)])
    assert said.status == 2 and said.stderr.splitlines()[0] == f"error: {text}"
    assert not target.exists()


def python_of(tex: str) -> str:
    """A line of LaTeX as Python."""
    text = tex.replace("&", "").replace("\\,", "*").replace("\\quad", "").replace("\\cdot 10^", "*10.0**")
    text = re.sub(r"\\dot\{(\\varphi|s|x|y)\}_\{\\text\{((?:[^{}]|\{\})*)\}\}", r"d[r'\1', r'\2']", text)
    text = re.sub(r"(\\varphi|\bs|\bx|\by)_\{\\text\{((?:[^{}]|\{\})*)\}\}", r"c[r'\1', r'\2']", text)
    text = re.sub(r"([lFTXY]|\bw)_\{\\text\{((?:[^{}]|\{\})*)\}(,\d+)?\}", r"own['\1', r'\2\3']", text)
    text = re.sub(r"\\frac\{((?:[^{}]|\{[^{}]*\})*)\}\{((?:[^{}]|\{[^{}]*\})*)\}", r"((\1)/(\2))", text)
    text = re.sub(r"\^\{(\d+)\}", r"**\1", text).replace("{", "(").replace("}", ")")
    return text.replace("\\cos", "np.cos").replace("\\sin", "np.sin")


def read(document: str, p: Any, dp: Any, t: float) -> dict[str, float]:
    """Entries of M, h, Q, g, J and gamma that a document has at a state."""
    symbols = re.findall(r"^\$p_\{(\d+)\} = (\\varphi|s|x|y)_\{\\text\{(.*?)\}\}\$ &", document, re.MULTILINE)
    c = {(letter, name): p[int(k) - 1] for k, letter, name in symbols}
    d = {(letter, name): dp[int(k) - 1] for k, letter, name in symbols}
    assert len(c) == len(p)
    own: dict[Any, float] = {}
    found: dict[str, float] = {}
    for block in re.findall(r"\\begin\{align\*\}\n(.*?)\n\\end\{align\*\}", document, re.DOTALL):
        for line in re.split(r"\\\\\n(?!&\\quad)", block):
            left, _, right = line.partition(" &= ")
            if not re.match(r"[MhQgJlFTXYw]_|\\gamma_", left):
                continue
            right = right.replace("\\\\\n", "").removesuffix(" = 0")
            value = eval(python_of(right), {"np": np, "c": c, "d": d, "own": own, "t": t})
            symbol = re.fullmatch(r"([lFTXYw])_\{\\text\{(.*)\}(,\d+)?\}(\^\{2\})?", left)
            if symbol:
                own[symbol[1], symbol[2] + (symbol[3] or "")] = math.sqrt(value) if symbol[4] else value
            else:
                found[left] = value
    return found


@pytest.mark.parametrize("name", MODELS)
def test_the_document_has_the_numbers_of_the_module(name: str, tmp_path: Path) -> None:
    words = MODELS[name]()
    document = export(words, "latex", tmp_path).read_text()
    made = module(words, tmp_path)
    assert document.count("{") == document.count("}") and document.count("$") % 2 == 0
    begun = re.findall(r"\\(begin|end)\{(\w+\*?)\}", document)
    opened: list[str] = []
    for what, environment in begun:
        if what == "begin":
            opened.append(environment)
        else:
            assert opened.pop() == environment
    assert not opened
    for t, u, du in states(made, name)[:5]:
        p, dp, _, _ = made.motion(t, u, du)
        entries = read(document, p, dp, t)
        mass, terms, forces = made.mass(p), made.velocity_terms(p, dp), made.forces(p, dp, t)
        count = len(p)
        expected = {f"M_{{{i + 1},{j + 1}}}": mass[i, j] for i in range(count) for j in range(i, count)}
        expected |= {f"h_{{{i + 1}}}": terms[i] for i in range(count)}
        expected |= {f"Q_{{{i + 1}}}": forces[i] for i in range(count)}
        if hasattr(made, "GIVEN"):
            # Here x and y of a loop stand together, there all x before all y.
            rows = len(made.closures(p))
            order = [2 * (k % (rows // 2)) + k // (rows // 2) for k in range(rows)]
            for values, letter in [(made.closures(p), "g"), (made.gamma(p, dp), "\\gamma")]:
                expected |= {f"{letter}_{{{row + 1}}}": value for row, value in zip(order, values, strict=True)}
            for row, values in zip(order, made.jacobian(p), strict=True):
                expected |= {f"J_{{{row + 1},{i + 1}}}": value for i, value in enumerate(values)}
        assert set(entries) <= set(expected)
        for letter in ["M", "h", "Q", "g", "J", "\\gamma"]:
            names = [one for one in expected if one.startswith(f"{letter}_")]
            values = [entries.get(one, 0.0) for one in names]
            scale = max([1.0, *(abs(expected[one]) for one in names)])
            if letter == "Q":
                scale = max(scale, STIFF.get(name, 0.0))
            for entry, value in zip(names, values, strict=True):
                assert abs(value - expected[entry]) < PRINTED * scale, (entry, value, expected[entry])
