//! Understands the user: bad models and the exact texts of what is said about them.
//!
//! Line and column in these texts were checked by eye against the base model below.

use std::io::Write;

use linkdyn_model::{self, Value};
use proptest::prelude::*;

/// A good model; each case spoils it.
const BASE: &str = r#"{
  "format": "linkdyn/1",
  "name": "four-bar and slider",
  "units": { "length": "mm", "angle": "deg" },
  "gravity": [0, -9.81],
  "bodies": {
    "ground": { "points": { "O": [0, 0], "Q": [300, 0] } },
    "crank": { "mass": 0.8, "inertia": 7e-4, "com": [50, 0],
      "points": { "O": [0, 0], "A": [100, 0] }, "pose": { "angle": 60 } },
    "coupler": { "points": { "A": [0, 0], "B": [250, 0] } },
    "rocker": { "points": { "Q": [0, 0], "B": [200, 0] }, "note": "measured" },
    "slider": { "points": { "C": [0, 0] } }
  },
  "joints": {
    "a": { "type": "revolute", "between": ["ground.O", "crank.O"] },
    "b": { "type": "revolute", "between": ["crank.A", "coupler.A"],
      "clearance": { "model": "massless_link", "radius": 0.1 } },
    "c": { "type": "revolute", "between": ["coupler.B", "rocker.B"] },
    "d": { "type": "revolute", "between": ["ground.Q", "rocker.Q"] },
    "e": { "type": "prismatic", "between": ["ground.Q", "slider.C"], "axis": [1, 0] }
  },
  "drivers": {
    "motor": { "type": "rotation", "body": "crank", "motion": { "type": "polynomial", "coefficients": [60, "10 rad/s"] } },
    "pusher": { "type": "translation", "joint": "e", "motion": { "type": "table", "points": [[0, 0], [1, 5]] } }
  },
  "forces": {
    "return": { "type": "spring", "between": ["ground.Q", "coupler.B"], "stiffness": 200, "free_length": 150 },
    "load": { "type": "force", "at": "coupler.B", "vector": [0, 5] }
  },
  "initial": { "crank": { "angle": 60 } },
  "points": ["coupler.B"],
  "analysis": { "type": "inverse_dynamics", "end": 2.0, "outputs": 401 }
}
"#;

struct Case {
    what: &'static str,
    /// Texts and what each is replaced by, everywhere.
    edits: &'static [(&'static str, &'static str)],
    sets: &'static [&'static str],
    complaints: &'static [&'static str],
}

/// The end of the last joint, and a gear after it.
const GEAR: &str = r#""axis": [1, 0] },
    "g": { "type": "gear", "between": ["crank.O", "rocker.Q"], "ratio": -2 }"#;

const CASES: &[Case] = &[
    Case {
        what: "another format, nothing else said of it",
        edits: &[("linkdyn/1", "linkdyn/2"), (r#""mass""#, r#""mas""#)],
        sets: &[],
        complaints: &[
            r#"line 2, column 13: format: "linkdyn/2": unknown format ("linkdyn/1" is expected)"#,
        ],
    },
    Case {
        what: "format missing",
        edits: &[("  \"format\": \"linkdyn/1\",\n", "")],
        sets: &[],
        complaints: &[r#"line 1, column 1: "format" is missing (write "format": "linkdyn/1")"#],
    },
    Case {
        what: "a transmission to ground, and from one of two drivers",
        edits: &[(
            r#""outputs": 401"#,
            r#""outputs": 401, "transmission": { "output": "ground" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 32, column 89: analysis.transmission: "driver" is missing, the model has 2 of them (name the driver from which the transmission leads)"#,
            r#"line 32, column 101: analysis.transmission.output: "ground": ground is fixed, nothing is transmitted to it"#,
        ],
    },
    Case {
        what: "a transmission between things that are not there",
        edits: &[(
            r#""outputs": 401"#,
            r#""outputs": 401, "transmission": { "driver": "motr", "output": "rocket" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 32, column 101: analysis.transmission.driver: "motr": there is no driver "motr" (did you mean "motor"?)"#,
            r#"line 32, column 119: analysis.transmission.output: "rocket": there is no body "rocket" (did you mean "rocker"?)"#,
        ],
    },
    Case {
        what: "units missing",
        edits: &[(
            "  \"units\": { \"length\": \"mm\", \"angle\": \"deg\" },\n",
            "",
        )],
        sets: &[],
        complaints: &[
            r#"line 1, column 1: "units" is missing (write "units": "SI", or name other units: {"length": "mm", "angle": "deg"})"#,
        ],
    },
    Case {
        what: "units in lower case",
        edits: &[(r#"{ "length": "mm", "angle": "deg" }"#, r#""si""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 12: units: "si": unknown units (write "units": "SI", or name other units: {"length": "mm", "angle": "deg"})"#,
        ],
    },
    Case {
        what: "unit of no dimension",
        edits: &[(r#""angle": "deg""#, r#""angel": "deg""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 30: units.angel: "angel": unknown key (did you mean "angle"?)"#,
        ],
    },
    Case {
        what: "unknown unit",
        edits: &[(r#""length": "mm""#, r#""length": "millimetres""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 24: units.length: "millimetres": unknown unit "millimetres" (did you mean "mm"?)"#,
        ],
    },
    Case {
        what: "unit misspelt",
        edits: &[(r#""length": "mm""#, r#""length": "mmm""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 24: units.length: "mmm": unknown unit "mmm" (did you mean "mm"?)"#,
        ],
    },
    Case {
        what: "unit of another dimension",
        edits: &[(r#""length": "mm""#, r#""length": "kg*mm^2""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 24: units.length: "kg*mm^2": "kg*mm^2" is not a unit of length (such as "m")"#,
        ],
    },
    Case {
        what: "unit that cannot be read",
        edits: &[(r#""length": "mm""#, r#""length": "mm^""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 24: units.length: "mm^": "mm^" cannot be read as a unit (such as "m")"#,
        ],
    },
    Case {
        what: "root misspelt, its contents not missed elsewhere",
        edits: &[(r#""bodies""#, r#""bodys""#)],
        sets: &[],
        complaints: &[r#"line 6, column 3: bodys: "bodys": unknown key (did you mean "bodies"?)"#],
    },
    Case {
        what: "top key unknown",
        edits: &[(r#""name""#, r#""titel""#)],
        sets: &[],
        complaints: &[
            r#"line 3, column 3: titel: "titel": unknown key (known keys: format, units, parameters, name, about, source, gravity, bodies, joints, drivers, forces, initial, points, analysis, note)"#,
        ],
    },
    Case {
        what: "wrong type: text",
        edits: &[(r#""name": "four-bar and slider""#, r#""name": 5"#)],
        sets: &[],
        complaints: &["line 3, column 11: name: 5: text is expected, not a number"],
    },
    Case {
        what: "wrong type: object",
        edits: &[(
            r#""initial": { "crank": { "angle": 60 } }"#,
            r#""initial": []"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 30, column 14: initial: an object is expected, not a list (as in "initial": { "crank": { "angle": "60 deg" } })"#,
        ],
    },
    Case {
        what: "wrong type: list",
        edits: &[(r#""gravity": [0, -9.81]"#, r#""gravity": -9.81"#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 14: gravity: -9.81: a list is expected, not a number (as in "gravity": [0, -9.81])"#,
        ],
    },
    Case {
        what: "wrong length",
        edits: &[(r#""gravity": [0, -9.81]"#, r#""gravity": [0, 0, -9.81]"#)],
        sets: &[],
        complaints: &["line 5, column 14: gravity: a list of 2 is expected, this one has 3"],
    },
    Case {
        what: "quantity without a unit",
        edits: &[(r#""gravity": [0, -9.81]"#, r#""gravity": [0, "-9.81"]"#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 18: gravity[1]: "-9.81": the unit is missing, a unit of acceleration (such as "m/s^2")"#,
        ],
    },
    Case {
        what: "quantity of another dimension",
        edits: &[(r#""gravity": [0, -9.81]"#, r#""gravity": [0, "-9.81 m/s"]"#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 18: gravity[1]: "-9.81 m/s": "m/s" is not a unit of acceleration (such as "m/s^2")"#,
        ],
    },
    Case {
        what: "quantity that is none",
        edits: &[(r#""gravity": [0, -9.81]"#, r#""gravity": [0, "down"]"#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 18: gravity[1]: "down": this does not begin with a number (a number, or text such as "5 m/s^2")"#,
        ],
    },
    Case {
        what: "null",
        edits: &[(r#""gravity": [0, -9.81]"#, r#""gravity": [0, null]"#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 18: gravity[1]: null: a number is expected, not null (or text with a unit, such as "5 m/s^2")"#,
        ],
    },
    Case {
        what: "number too large",
        edits: &[("-9.81", "-9.81e999")],
        sets: &[],
        complaints: &[
            "line 5, column 18: not JSON: -9.81e999: the number is too large for a double",
        ],
    },
    Case {
        what: "quantity too large",
        edits: &[("-9.81", r#""1e308 km/s^2""#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 18: gravity[1]: "1e308 km/s^2": the number is too large for a double"#,
        ],
    },
    Case {
        what: "NaN",
        edits: &[("-9.81", "NaN")],
        sets: &[],
        complaints: &[
            "line 5, column 18: not JSON: 'N' where a value is expected (JSON knows neither NaN nor Infinity)",
        ],
    },
    Case {
        what: "parameters: no object",
        edits: &[(
            r#""name": "four-bar and slider""#,
            r#""parameters": ["60 mm"]"#,
        )],
        sets: &[],
        complaints: &["line 3, column 17: parameters: an object is expected, not a list"],
    },
    Case {
        what: "parameters: names and values",
        edits: &[(
            r#""name": "four-bar and slider""#,
            r#""parameters": { "note": "x", "2r": 1, "a-b": 1, "sin": 1, "A": null, "B": "5", "C": "5 mmm", "D": "r", "E": [1], "φ": 1 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 3, column 38: parameters.2r: 1: the name of a parameter consists of letters, digits and _, with a letter first (as in crank_length or r2)"#,
            r#"line 3, column 48: parameters.a-b: 1: the name of a parameter consists of letters, digits and _, with a letter first (as in crank_length or r2)"#,
            r#"line 3, column 58: parameters.sin: 1: "sin" has a meaning of its own (give the parameter another name)"#,
            r#"line 3, column 66: parameters.A: null: a number is expected, not null (or text: with a unit, such as "5 mm", or an expression, "=2*r")"#,
            r#"line 3, column 77: parameters.B: "5": the unit is missing (write a plain number without quotes)"#,
            r#"line 3, column 87: parameters.C: "5 mmm": unknown unit "mmm" (did you mean "mm"?)"#,
            r#"line 3, column 101: parameters.D: "r": this does not begin with a number (a number, text with a unit such as "5 mm", or an expression such as "=2*r")"#,
            r#"line 3, column 111: parameters.E: a number is expected, not a list (or text: with a unit, such as "5 mm", or an expression, "=2*r")"#,
            r#"line 3, column 121: parameters.φ: 1: the name of a parameter consists of letters, digits and _, with a letter first (as in crank_length or r2)"#,
        ],
    },
    Case {
        what: "parameters: circles, each once, and what follows from them not at all",
        edits: &[
            (
                r#""name": "four-bar and slider""#,
                r#""parameters": { "a": "=b+c", "b": "=2*a", "c": "1 mm", "d": "=d", "e": "=a" }"#,
            ),
            ("0.8", r#""=e""#),
        ],
        sets: &[],
        complaints: &[
            r#"line 3, column 24: parameters.a: "=b+c": the parameters follow from each other in a circle: a → b → a (give one of them a value of its own)"#,
            r#"line 3, column 63: parameters.d: "=d": the parameters follow from each other in a circle: d → d (give one of them a value of its own)"#,
        ],
    },
    Case {
        what: "expressions: faults inside, at their character",
        edits: &[
            (
                r#""name": "four-bar and slider""#,
                r#""parameters": { "r": "50 mm", "q": "=2*r + 1" }"#,
            ),
            ("-9.81", r#""= -g""#),
            ("0.8", r#""=2*(r""#),
            ("7e-4", r#""=4*q""#),
            (r#""outputs": 401"#, r#""outputs": "=4*rr""#),
            ("250", r#""\u003dr/0""#),
        ],
        sets: &["gravity[0]=3*g", "bodies.rocker.points.B[0]==r+1"],
        complaints: &[
            r#"line 3, column 44: parameters.q: "=2*r + 1": a length [m] and a plain number can't be added (a number gets a unit as in 2 m)"#,
            r#"line 5, column 22: gravity[1]: "= -g": there is no parameter "g" (the parameters: r, q; a unit stands behind a number, as in 1 g)"#,
            r#"line 8, column 28: bodies.crank.mass: "=2*(r": this "(" is not closed"#,
            r#"line 10, column 49: bodies.coupler.points.B[0]: "\u003dr/0": this divides by zero"#,
            r#"line 32, column 72: analysis.outputs: "=4*rr": there is no parameter "rr" (the parameters: r, q)"#,
            r#"--set gravity[0]=3*g: "*g" cannot be read as a unit (such as "m/s^2")"#,
            r#"--set bodies.rocker.points.B[0]==r+1: a length [m] and a plain number can't be added (a number gets a unit as in 2 m)"#,
        ],
    },
    Case {
        what: "expressions: no parameters at all",
        edits: &[("-9.81", r#""=-g""#)],
        sets: &[],
        complaints: &[
            r#"line 5, column 21: gravity[1]: "=-g": there is no parameter "g" (write it into "parameters"; a unit stands behind a number, as in 1 g)"#,
        ],
    },
    Case {
        what: "expressions: results of the wrong dimension",
        edits: &[
            (
                r#""name": "four-bar and slider""#,
                r#""parameters": { "r": "50 mm", "m": "2 kg", "f": "2 Hz", "w": "3 rad/s", "k": "5 N*m/rad" }"#,
            ),
            ("-9.81", r#""=r/1 s""#),
            ("0.8", r#""=3*r""#),
            ("7e-4", r#""=m*r""#),
            (
                r#""pose": { "angle": 60 }"#,
                r#""pose": { "angle": "=pi/3" }"#,
            ),
            ("250", r#""=r/(2 mm)""#),
            (r#""10 rad/s""#, r#""=f""#),
            (r#""stiffness": 200"#, r#""stiffness": "=k""#),
            (r#""free_length": 150"#, r#""free_length": "=sqrt(r)""#),
            (
                r#""vector": [0, 5]"#,
                r#""vector": ["=k", { "type": "harmonic", "amplitude": 1, "frequency": "=w" }]"#,
            ),
            (r#""axis": [1, 0]"#, r#""axis": ["=r", "=sin(w)"]"#),
            (r#""outputs": 401"#, r#""outputs": "=400.5+1""#),
        ],
        sets: &["analysis.end=0"],
        complaints: &[
            r#"line 5, column 18: gravity[1]: "=r/1 s": this is a velocity [m/s], where an acceleration [m/s^2] is wanted"#,
            r#"line 8, column 24: bodies.crank.mass: "=3*r": this is a length [m], where a mass [kg] is wanted"#,
            r#"line 8, column 43: bodies.crank.inertia: "=m*r": this is a quantity in kg*m, where an inertia [kg*m^2] is wanted"#,
            r#"line 9, column 68: bodies.crank.pose.angle: "=pi/3": a plain number made with pi, where an angle [rad] is wanted that is not in radians here (write it * 1 rad, or in deg)"#,
            r#"line 10, column 49: bodies.coupler.points.B[0]: "=r/(2 mm)": this is a ratio without unit, where a length [m] is wanted (multiply it by a quantity, such as 1 m)"#,
            r#"line 20, column 79: joints.e.axis[0]: "=r": this is a length [m], where a plain number is wanted (divide it by 1 m)"#,
            r#"line 20, column 87: joints.e.axis[1]: "=sin(w)": sin takes an angle, not an angular velocity [rad/s]"#,
            r#"line 23, column 108: drivers.motor.motion.coefficients[1]: "=f": this is a frequency [Hz], where an angular velocity [rad/s] is wanted (write it * 1 rad, if that is meant)"#,
            r#"line 27, column 86: forces.return.stiffness: "=k": this is an angular stiffness [N*m/rad], where a stiffness [N/m] is wanted"#,
            r#"line 27, column 107: forces.return.free_length: "=sqrt(r)": this is a quantity in m^0.5, where a length [m] is wanted"#,
            r#"line 28, column 62: forces.load.vector[0]: "=k": this is an angular stiffness [N*m/rad], where a force [N] is wanted"#,
            r#"line 28, column 119: forces.load.vector[1].frequency: "=w": this is an angular velocity [rad/s], where a frequency [Hz] is wanted (write it / 1 rad, if that is meant)"#,
            r#"line 32, column 68: analysis.outputs: "=400.5+1": a whole number is expected"#,
            "--set analysis.end=0: must be greater than 0",
        ],
    },
    Case {
        what: "expressions: a set of a parameter that nothing uses",
        edits: &[
            (
                r#""name": "four-bar and slider""#,
                r#""parameters": { "width": "50 mm" }"#,
            ),
            ("250", r#""=5*width""#),
        ],
        sets: &["parameters.widht=60 mm"],
        complaints: &[
            r#"--set parameters.widht=60 mm: no expression uses this parameter (did you mean "width"?)"#,
        ],
    },
    Case {
        what: "ground with mass and pose",
        edits: &[(r#""ground": { "#, r#""ground": { "mass": 1, "pose": {}, "#)],
        sets: &[],
        complaints: &[
            r#"line 7, column 17: bodies.ground.mass: "mass": ground is fixed, a mass of it would mean nothing"#,
            r#"line 7, column 28: bodies.ground.pose: "pose": ground is fixed, its frame is the global one"#,
        ],
    },
    Case {
        what: "negative mass and inertia, both at once",
        edits: &[(
            r#""mass": 0.8, "inertia": 7e-4"#,
            r#""mass": -0.8, "inertia": "-7 kg*mm^2""#,
        )],
        sets: &[],
        complaints: &[
            "line 8, column 24: bodies.crank.mass: -0.8: must not be negative",
            r#"line 8, column 41: bodies.crank.inertia: "-7 kg*mm^2": must not be negative"#,
        ],
    },
    Case {
        what: "centre of mass missing",
        edits: &[(r#", "com": [50, 0]"#, "")],
        sets: &[],
        complaints: &[
            r#"line 8, column 14: bodies.crank: "com" is missing, it has no default where there is mass (give the centre of mass in the body's frame, as in "com": [0, 0])"#,
        ],
    },
    Case {
        what: "points misspelt, references to them not missed",
        edits: &[(
            r#""points": { "O": [0, 0], "A""#,
            r#""pionts": { "O": [0, 0], "A""#,
        )],
        sets: &[],
        complaints: &[
            r#"line 9, column 7: bodies.crank.pionts: "pionts": unknown key (did you mean "points"?)"#,
        ],
    },
    Case {
        what: "key far from all",
        edits: &[(r#""pose""#, r#""colour""#)],
        sets: &[],
        complaints: &[
            r#"line 9, column 49: bodies.crank.colour: "colour": unknown key (known keys: mass, inertia, com, points, pose, note)"#,
        ],
    },
    Case {
        what: "note of another type",
        edits: &[(r#""measured""#, r#"["measured"]"#)],
        sets: &[],
        complaints: &["line 11, column 67: bodies.rocker.note: text is expected, not a list"],
    },
    Case {
        what: "name with a dot, references to it not missed",
        edits: &[
            (r#""rocker": {"#, r#""rock.er": {"#),
            ("rocker.B", "rock.er.B"),
            ("rocker.Q", "rock.er.Q"),
        ],
        sets: &[],
        complaints: &[
            r#"line 11, column 5: bodies.rock.er: "rock.er": a name must not contain "." (nor any of . [ ] , = * ? and control characters)"#,
        ],
    },
    Case {
        what: "empty name",
        edits: &[(r#""load": {"#, r#""": {"#)],
        sets: &[],
        complaints: &[r#"line 28, column 5: forces.: "": a name must not be empty"#],
    },
    Case {
        what: "name with a control character",
        edits: &[(r#""load": {"#, r#""lo\tad": {"#)],
        sets: &[],
        complaints: &[
            r#"line 28, column 5: forces.lo ad: "lo ad": a name must not contain "\t" (nor any of . [ ] , = * ? and control characters)"#,
        ],
    },
    Case {
        what: "bodies far from all",
        edits: &[(r#""bodies": {"#, r#""parts": {"#)],
        sets: &[],
        complaints: &[
            r#"line 1, column 1: "bodies" is missing (as in "bodies": { "crank": { "points": { "A": [0, 0], "B": [50, 0] } } })"#,
            r#"line 6, column 3: parts: "parts": unknown key (known keys: format, units, parameters, name, about, source, gravity, bodies, joints, drivers, forces, initial, points, analysis, note)"#,
        ],
    },
    Case {
        what: "no bodies",
        edits: &[(r#""bodies": {"#, r#""bodies": {}, "initials": {"#)],
        sets: &[],
        complaints: &[
            "line 6, column 13: bodies: it is empty, at least one is needed",
            r#"line 6, column 17: initials: "initials": unknown key (known keys: format, units, parameters, name, about, source, gravity, bodies, joints, drivers, forces, initial, points, analysis, note)"#,
        ],
    },
    Case {
        what: "type misspelt, and a point",
        edits: &[(
            r#""revolute", "between": ["ground.O", "crank.O"]"#,
            r#""revolut", "between": ["ground.O", "crank.P"]"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 15, column 20: joints.a.type: "revolut": unknown type (did you mean "revolute"?)"#,
            r#"line 15, column 55: joints.a.between[1]: "crank.P": body "crank" has no point "P" (its points: O, A)"#,
        ],
    },
    Case {
        what: "type missing",
        edits: &[(r#""type": "prismatic", "#, "")],
        sets: &[],
        complaints: &[
            r#"line 20, column 10: joints.e: "type" is missing (one of "revolute", "prismatic", "slot", "gear" or "fixed")"#,
        ],
    },
    Case {
        what: "type key misspelt",
        edits: &[(r#""type": "prismatic", "#, r#""typ": "prismatic", "#)],
        sets: &[],
        complaints: &[
            r#"line 20, column 12: joints.e.typ: "typ": unknown key (did you mean "type"?)"#,
        ],
    },
    Case {
        what: "type far from all",
        edits: &[(r#""prismatic""#, r#""worm""#)],
        sets: &[],
        complaints: &[
            r#"line 20, column 20: joints.e.type: "worm": unknown type (one of "revolute", "prismatic", "slot", "gear" or "fixed")"#,
        ],
    },
    Case {
        what: "type of another kind",
        edits: &[(r#""prismatic""#, "7")],
        sets: &[],
        complaints: &[
            r#"line 20, column 20: joints.e.type: 7: text is expected, not a number (one of "revolute", "prismatic", "slot", "gear" or "fixed")"#,
        ],
    },
    Case {
        what: "between missing",
        edits: &[(r#""between": ["ground.O", "crank.O"]"#, r#""note": """#)],
        sets: &[],
        complaints: &[
            r#"line 15, column 10: joints.a: "between" is missing (the two ends, as in "between": ["ground.A", "crank.A"])"#,
        ],
    },
    Case {
        what: "axis missing",
        edits: &[(r#", "axis": [1, 0]"#, "")],
        sets: &[],
        complaints: &[
            r#"line 20, column 10: joints.e: "axis" is missing (a direction in the first body, as in "axis": [1, 0])"#,
        ],
    },
    Case {
        what: "axis zero",
        edits: &[(r#""axis": [1, 0]"#, r#""axis": [0, 0.0]"#)],
        sets: &[],
        complaints: &[
            "line 20, column 78: joints.e.axis: both components are zero, which is no direction",
        ],
    },
    Case {
        what: "axis with a unit",
        edits: &[(r#""axis": [1, 0]"#, r#""axis": ["1 mm", 0]"#)],
        sets: &[],
        complaints: &[
            r#"line 20, column 79: joints.e.axis[0]: "1 mm": a plain number is expected, not text"#,
        ],
    },
    Case {
        what: "body misspelt",
        edits: &[(r#""rocker.B""#, r#""rokcer.B""#)],
        sets: &[],
        complaints: &[
            r#"line 18, column 57: joints.c.between[1]: "rokcer.B": there is no body "rokcer" (did you mean "rocker"?)"#,
        ],
    },
    Case {
        what: "body far from all",
        edits: &[(r#""rocker.B""#, r#""wheel.B""#)],
        sets: &[],
        complaints: &[
            r#"line 18, column 57: joints.c.between[1]: "wheel.B": there is no body "wheel" (the bodies: ground, crank, coupler, rocker, slider)"#,
        ],
    },
    Case {
        what: "point missing",
        edits: &[(r#"["crank.A", "coupler.A"]"#, r#"["crank.Z", "coupler.A"]"#)],
        sets: &[],
        complaints: &[
            r#"line 16, column 44: joints.b.between[0]: "crank.Z": body "crank" has no point "Z" (its points: O, A)"#,
        ],
    },
    Case {
        what: "body instead of a point",
        edits: &[(r#"["crank.A", "coupler.A"]"#, r#"["crank", "coupler.A"]"#)],
        sets: &[],
        complaints: &[
            r#"line 16, column 44: joints.b.between[0]: "crank": this is no point of a body (write it as body.point; the points of "crank": O, A)"#,
        ],
    },
    Case {
        what: "joint of a body with itself",
        edits: &[(r#"["crank.A", "coupler.A"]"#, r#"["crank.A", "crank.O"]"#)],
        sets: &[],
        complaints: &[
            r#"line 16, column 43: joints.b.between: both points are of "crank" (a joint connects two bodies)"#,
        ],
    },
    Case {
        what: "clearance of a prismatic joint",
        edits: &[(
            r#""axis": [1, 0]"#,
            r#""axis": [1, 0], "clearance": { "model": "ideal" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 20, column 86: joints.e.clearance: "clearance": only a revolute joint can have clearance"#,
        ],
    },
    Case {
        what: "slot without direction, with a clearance and an angle",
        edits: &[
            (r#""prismatic""#, r#""slot""#),
            (
                r#""axis": [1, 0]"#,
                r#""axis": [0, 0], "angle": 3, "clearance": {}"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 20, column 73: joints.e.axis: both components are zero, which is no direction"#,
            r#"line 20, column 81: joints.e.angle: "angle": the angle in a slot is free; a prismatic joint fixes it"#,
            r#"line 20, column 93: joints.e.clearance: "clearance": only a revolute joint can have clearance"#,
        ],
    },
    Case {
        what: "translation of a slot is no fault, its axis missing is",
        edits: &[
            (r#""type": "prismatic""#, r#""type": "slot""#),
            (r#", "axis": [1, 0]"#, ""),
        ],
        sets: &[],
        complaints: &[
            r#"line 20, column 10: joints.e: "axis" is missing (a direction in the first body, as in "axis": [1, 0])"#,
        ],
    },
    Case {
        what: "gear without ratio",
        edits: &[],
        sets: &[r#"joints.g={ "type": "gear", "between": ["crank.O", "rocker.Q"] }"#],
        complaints: &[
            r#"--set joints.g={ "type": "gear", "between": ["crank.O", "rocker.Q"…: "ratio" is missing (turns of the second wheel per turn of the first, as in "ratio": -2; negative for an external mesh)"#,
        ],
    },
    Case {
        what: "gear of ratio zero, with clearance, on an unknown carrier",
        edits: &[
            (r#""axis": [1, 0] }"#, GEAR),
            (
                r#""ratio": -2"#,
                r#""ratio": 0, "clearance": {}, "carrier": "rack""#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 21, column 73: joints.g.ratio: 0: must not be zero"#,
            r#"line 21, column 76: joints.g.clearance: "clearance": only a revolute joint can have clearance"#,
            r#"line 21, column 104: joints.g.carrier: "rack": there is no body "rack" (did you mean "crank"?)"#,
        ],
    },
    Case {
        what: "gear whose carrier is one of its wheels",
        edits: &[
            (r#""axis": [1, 0] }"#, GEAR),
            (r#""ratio": -2"#, r#""ratio": -2, "carrier": "rocker""#),
        ],
        sets: &[],
        complaints: &[
            r#"line 21, column 88: joints.g.carrier: "rocker": this is one of the two wheels (the carrier is the third body, on which both wheels turn)"#,
        ],
    },
    Case {
        what: "gear on a body that does not hold its wheels",
        edits: &[
            (r#""axis": [1, 0] }"#, GEAR),
            (r#""ratio": -2"#, r#""ratio": -2, "carrier": "coupler""#),
        ],
        sets: &[],
        complaints: &[
            r#"line 21, column 88: joints.g.carrier: "coupler": no revolute joints hold both crank.O and rocker.Q to body "coupler" (name the body on which both wheels turn, or leave "carrier" out)"#,
        ],
    },
    Case {
        what: "gear between points that no body carries",
        edits: &[
            (r#""axis": [1, 0] }"#, GEAR),
            (r#"["crank.O", "rocker.Q"]"#, r#"["crank.A", "rocker.Q"]"#),
        ],
        sets: &[],
        complaints: &[
            r#"line 21, column 39: joints.g.between: no third body carries both crank.A and rocker.Q (the wheels turn about these points on a body of their own: pin both to it by revolute joints)"#,
        ],
    },
    Case {
        what: "gear that locks a wheel to its own carrier",
        edits: &[
            (r#""axis": [1, 0] }"#, GEAR),
            (r#"["crank.O", "rocker.Q"]"#, r#"["ground.O", "rocker.Q"]"#),
        ],
        sets: &[],
        complaints: &[
            r#"line 21, column 39: joints.g.between: no third body carries both ground.O and rocker.Q (the wheels turn about these points on a body of their own: pin both to it by revolute joints)"#,
        ],
    },
    Case {
        what: "gear of wheels on one axis",
        edits: &[
            (r#""axis": [1, 0] }"#, GEAR),
            (r#"["ground.Q", "rocker.Q"]"#, r#"["ground.O", "rocker.Q"]"#),
        ],
        sets: &[],
        complaints: &[
            r#"line 21, column 39: joints.g.between: both wheels turn about one axis, as meshing wheels do not (write a gear for each mesh, with the wheels that lie between)"#,
        ],
    },
    Case {
        what: "clearance model unknown",
        edits: &[(r#""massless_link""#, r#""massles_link""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 31: joints.b.clearance.model: "massles_link": unknown model (did you mean "massless_link"?)"#,
        ],
    },
    Case {
        what: "clearance radius missing",
        edits: &[(r#", "radius": 0.1"#, "")],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "radius" is missing, the model "massless_link" needs the radial clearance (bearing radius − journal radius, as in "0.1 mm")"#,
        ],
    },
    Case {
        what: "clearance radius zero",
        edits: &[(
            r#""massless_link", "radius": 0.1"#,
            r#""contact", "radius": 0, "normal": { "law": "hertz", "stiffness": 1e8 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 52: joints.b.clearance.radius: 0: must be greater than 0 for the model "contact""#,
        ],
    },
    Case {
        what: "clearance radius negative",
        edits: &[(r#""radius": 0.1"#, r#""radius": "-10 um""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 58: joints.b.clearance.radius: "-10 um": must not be negative"#,
        ],
    },
    Case {
        what: "contact without a normal law",
        edits: &[(r#""massless_link""#, r#""contact""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "normal" is missing (the model "contact" needs a law of the normal force)"#,
        ],
    },
    Case {
        what: "contact without stiffness",
        edits: &[(
            r#""massless_link""#,
            r#""contact", "normal": { "law": "flores", "restitution": 0.9 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "normal.stiffness" is missing (give it, or "elastic" and "bearing_radius")"#,
        ],
    },
    Case {
        what: "contact with elastic and no bearing radius",
        edits: &[(
            r#""massless_link""#,
            r#""contact", "normal": { "law": "hertz", "elastic": { "young_modulus": "207 GPa", "poisson_ratio": 0.3 } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "bearing_radius" is missing (the stiffness follows from "elastic" and the radii)"#,
        ],
    },
    Case {
        what: "law without restitution",
        edits: &[(
            r#""massless_link""#,
            r#""contact", "normal": { "law": "hu_guo", "stiffness": 1e8 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "normal.restitution" is missing (the law "hu_guo" needs it)"#,
        ],
    },
    Case {
        what: "friction without its velocity",
        edits: &[(
            r#""massless_link""#,
            r#""contact", "normal": { "law": "hertz", "stiffness": 1e8 }, "friction": { "law": "coulomb", "coefficient": 0.1 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "friction.threshold_velocity" is missing (the law "coulomb" needs it)"#,
        ],
    },
    Case {
        what: "restitution and Poisson out of range",
        edits: &[(
            r#""massless_link""#,
            r#""ideal", "normal": { "law": "hertz", "restitution": 1.2, "elastic": { "young_modulus": 1, "poisson_ratio": 0.6 } }"#,
        )],
        sets: &[],
        complaints: &[
            "line 17, column 83: joints.b.clearance.normal.restitution: 1.2: must not be greater than 1",
            "line 17, column 138: joints.b.clearance.normal.elastic.poisson_ratio: 0.6: must not be greater than 0.5",
        ],
    },
    Case {
        what: "material of one part only",
        edits: &[(
            r#""massless_link""#,
            r#""ideal", "normal": { "law": "hertz", "elastic": { "bearing": { "young_modulus": 1, "poisson_ratio": 0.3 } } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 79: joints.b.clearance.normal.elastic: "journal" is missing"#,
        ],
    },
    Case {
        what: "law unknown",
        edits: &[(
            r#""massless_link""#,
            r#""ideal", "normal": { "law": "lankarani-nikravesh" }, "friction": { "law": "stick" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 17, column 59: joints.b.clearance.normal.law: "lankarani-nikravesh": unknown law (did you mean "lankarani_nikravesh"?)"#,
            r#"line 17, column 105: joints.b.clearance.friction.law: "stick": unknown law (one of "none", "coulomb", "ambrosio", "threlfall", "stribeck" or "lugre")"#,
        ],
    },
    Case {
        what: "two_state without a surface",
        edits: &[(r#""massless_link""#, r#""two_state""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "surface" is missing (the model "two_state" needs its stiffness and damping)"#,
        ],
    },
    Case {
        what: "three_state without a restitution",
        edits: &[(r#""massless_link""#, r#""three_state""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 20: joints.b.clearance: "impact.restitution" is missing (the model "three_state" needs it, or "normal.restitution")"#,
        ],
    },
    Case {
        what: "driver of no body",
        edits: &[(r#""body": "crank""#, r#""body": "crnak""#)],
        sets: &[],
        complaints: &[
            r#"line 23, column 44: drivers.motor.body: "crnak": there is no body "crnak" (did you mean "crank"?)"#,
        ],
    },
    Case {
        what: "driver of a point",
        edits: &[(r#""body": "crank""#, r#""body": "crank.A""#)],
        sets: &[],
        complaints: &[
            r#"line 23, column 44: drivers.motor.body: "crank.A": a body is expected, this is a point (write "crank")"#,
        ],
    },
    Case {
        what: "driver of a body relative to itself",
        edits: &[(
            r#""body": "crank""#,
            r#""body": "crank", "relative_to": "crank""#,
        )],
        sets: &[],
        complaints: &[
            r#"line 23, column 44: drivers.motor.body: "crank": the angle of "crank" relative to itself cannot be driven"#,
        ],
    },
    Case {
        what: "two drivers of one angle",
        edits: &[(
            r#""drivers": {"#,
            "\"drivers\": {\n    \"first\": { \"type\": \"rotation\", \"body\": \"ground\", \"relative_to\": \"crank\", \"motion\": { \"type\": \"constant_velocity\", \"velocity\": 1 } },",
        )],
        sets: &[],
        complaints: &[
            r#"line 24, column 14: drivers.motor: the angle between "crank" and "ground" is driven by "first" already (keep one of them)"#,
        ],
    },
    Case {
        what: "translation of no joint",
        edits: &[(r#""joint": "e""#, r#""joint": "f""#)],
        sets: &[],
        complaints: &[
            r#"line 24, column 49: drivers.pusher.joint: "f": there is no joint "f" (the joints: a, b, c, d, e)"#,
        ],
    },
    Case {
        what: "translation of a revolute joint",
        edits: &[(r#""joint": "e""#, r#""joint": "a""#)],
        sets: &[],
        complaints: &[
            r#"line 24, column 49: drivers.pusher.joint: "a": this joint is revolute, neither prismatic nor slot (a translation drives the slide of a prismatic joint or a slot)"#,
        ],
    },
    Case {
        what: "coefficient of another order",
        edits: &[(r#"[60, "10 rad/s"]"#, r#"[60, 0, "10 rad/s"]"#)],
        sets: &[],
        complaints: &[
            r#"line 23, column 111: drivers.motor.motion.coefficients[2]: "10 rad/s": "rad/s" is not a unit of angular acceleration (such as "rad/s^2")"#,
        ],
    },
    Case {
        what: "coefficient of another dimension",
        edits: &[(r#"[60, "10 rad/s"]"#, r#"["60 mm", 0, 0, "1 mm/s^3"]"#)],
        sets: &[],
        complaints: &[
            r#"line 23, column 104: drivers.motor.motion.coefficients[0]: "60 mm": "mm" is not a unit of angle (such as "rad")"#,
            r#"line 23, column 119: drivers.motor.motion.coefficients[3]: "1 mm/s^3": "mm/s^3" is not a unit of angle per second^3 (such as "rad/s^3")"#,
        ],
    },
    Case {
        what: "polynomial without coefficients",
        edits: &[(r#"[60, "10 rad/s"]"#, "[]")],
        sets: &[],
        complaints: &[
            "line 23, column 103: drivers.motor.motion.coefficients: a list of at least 1 is expected, this one has 0",
        ],
    },
    Case {
        what: "motion unknown",
        edits: &[(r#""polynomial""#, r#""sine""#)],
        sets: &[],
        complaints: &[
            r#"line 23, column 73: drivers.motor.motion.type: "sine": unknown type (did you mean "harmonic"?)"#,
        ],
    },
    Case {
        what: "table of one point",
        edits: &[("[[0, 0], [1, 5]]", "[[0, 0]]")],
        sets: &[],
        complaints: &[
            "line 24, column 93: drivers.pusher.motion.points: a list of at least 2 is expected, this one has 1",
        ],
    },
    Case {
        what: "table that goes back in time",
        edits: &[("[[0, 0], [1, 5]]", r#"[[0, 0], [1, 5], ["900 ms", 6]]"#)],
        sets: &[],
        complaints: &[
            r#"line 24, column 111: drivers.pusher.motion.points[2][0]: "900 ms": the time is not later than that of the point before (the times of a table increase)"#,
        ],
    },
    Case {
        what: "table with a short point",
        edits: &[("[[0, 0], [1, 5]]", "[[0, 0], [1]]")],
        sets: &[],
        complaints: &[
            "line 24, column 102: drivers.pusher.motion.points[1]: a list of 2 is expected, this one has 1",
        ],
    },
    Case {
        what: "spring with neither stiffness nor damping",
        edits: &[(r#""stiffness": 200, "#, "")],
        sets: &[],
        complaints: &[
            r#"line 27, column 15: forces.return: "stiffness" is missing (with "damping" alone it would be a damper)"#,
        ],
    },
    Case {
        what: "force at no point",
        edits: &[(r#""at": "coupler.B""#, r#""at": "coupler.b""#)],
        sets: &[],
        complaints: &[
            r#"line 28, column 38: forces.load.at: "coupler.b": body "coupler" has no point "b" (did you mean "coupler.B"? its points: A, B)"#,
        ],
    },
    Case {
        what: "force varies as a torque",
        edits: &[(
            r#""vector": [0, 5]"#,
            r#""vector": [0, { "type": "harmonic", "amplitude": "5 N*m", "frequency": 1 }]"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 28, column 100: forces.load.vector[1].amplitude: "5 N*m": "N*m" is not a unit of force (such as "N")"#,
        ],
    },
    Case {
        what: "frame unknown",
        edits: &[(
            r#""vector": [0, 5]"#,
            r#""vector": [0, 5], "frame": "world""#,
        )],
        sets: &[],
        complaints: &[
            r#"line 28, column 78: forces.load.frame: "world": unknown frame (one of "ground" or "body")"#,
        ],
    },
    Case {
        what: "initial of ground and of nobody",
        edits: &[(
            r#""initial": { "crank""#,
            r#""initial": { "ground": {}, "krank""#,
        )],
        sets: &[],
        complaints: &[
            "line 30, column 26: initial.ground: ground is fixed, it has no initial values",
            r#"line 30, column 39: initial.krank: there is no body "krank" (did you mean "crank"?)"#,
        ],
    },
    Case {
        what: "point twice",
        edits: &[(r#"["coupler.B"]"#, r#"["coupler.B", "coupler.B"]"#)],
        sets: &[],
        complaints: &[
            r#"line 31, column 27: points[1]: "coupler.B": the point is listed twice (first as points[0])"#,
        ],
    },
    Case {
        what: "analysis unknown",
        edits: &[(r#""inverse_dynamics""#, r#""inverse dynamics""#)],
        sets: &[],
        complaints: &[
            r#"line 32, column 25: analysis.type: "inverse dynamics": unknown type (did you mean "inverse_dynamics"?)"#,
        ],
    },
    Case {
        what: "both ways to say when",
        edits: &[(
            r#""outputs": 401"#,
            r#""outputs": 401, "sample": { "driver": "motor", "from": 0, "to": 360, "step": 1 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 32, column 52: analysis.end: 2.0: "end" and "sample" exclude each other (keep one of them)"#,
        ],
    },
    Case {
        what: "neither way to say when",
        edits: &[(r#", "end": 2.0, "outputs": 401"#, "")],
        sets: &[],
        complaints: &[
            r#"line 32, column 15: analysis: it is not said for which instants (give "end" and "outputs", or "sample")"#,
        ],
    },
    Case {
        what: "outputs missing",
        edits: &[(r#", "outputs": 401"#, "")],
        sets: &[],
        complaints: &[
            r#"line 32, column 15: analysis: "outputs" is missing (the number of output instants, both ends included)"#,
        ],
    },
    Case {
        what: "end missing",
        edits: &[(r#""end": 2.0, "#, "")],
        sets: &[],
        complaints: &[
            r#"line 32, column 15: analysis: "end" is missing (the end time, the start is 0)"#,
        ],
    },
    Case {
        what: "end and outputs out of range",
        edits: &[(r#""end": 2.0, "outputs": 401"#, r#""end": 0, "outputs": 1"#)],
        sets: &[],
        complaints: &[
            "line 32, column 52: analysis.end: 0: must be greater than 0",
            "line 32, column 66: analysis.outputs: 1: must not be less than 2",
        ],
    },
    Case {
        what: "outputs not whole",
        edits: &[("401", "401.5")],
        sets: &[],
        complaints: &["line 32, column 68: analysis.outputs: 401.5: a whole number is expected"],
    },
    Case {
        what: "sample of no driver, step zero",
        edits: &[(
            r#""end": 2.0, "outputs": 401"#,
            r#""sample": { "driver": "engine", "from": 0, "to": 360, "step": 1 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 32, column 67: analysis.sample.driver: "engine": there is no driver "engine" (the drivers: motor, pusher)"#,
        ],
    },
    Case {
        what: "sample step zero, limit of another dimension",
        edits: &[(
            r#""end": 2.0, "outputs": 401"#,
            r#""sample": { "driver": "motor", "from": 0, "to": "1 m", "step": 0 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 32, column 93: analysis.sample.to: "1 m": "m" is not a unit of angle (such as "rad")"#,
            "line 32, column 108: analysis.sample.step: 0: must not be zero",
        ],
    },
    Case {
        what: "column that is no text",
        edits: &[(
            r#""outputs": 401"#,
            r#""outputs": 401, "columns": ["crank.*", 5]"#,
        )],
        sets: &[],
        complaints: &["line 32, column 96: analysis.columns[1]: 5: text is expected, not a number"],
    },
    Case {
        what: "solver option unknown",
        edits: &[(
            r#""outputs": 401"#,
            r#""outputs": 401, "solver": { "tol": 1e-9, "rtol": 0 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 32, column 85: analysis.solver.tol: "tol": unknown key (did you mean "atol"?)"#,
            "line 32, column 106: analysis.solver.rtol: 0: must be greater than 0",
        ],
    },
    Case {
        what: "repeated key",
        edits: &[(r#""mass": 0.8,"#, r#""mass": 0.8, "mass": 0.9,"#)],
        sets: &[],
        complaints: &[
            r#"line 8, column 29: bodies.crank.mass: "mass": the key is given twice (first on line 8, column 16)"#,
        ],
    },
    Case {
        what: "comment",
        edits: &[(r#""gravity""#, "// down\n  \"gravity\"")],
        sets: &[],
        complaints: &[
            r#"line 5, column 3: not JSON: '/' where a key in double quotes is expected (JSON has no comments; use "note")"#,
        ],
    },
    Case {
        what: "comma too many",
        edits: &[(r#""outputs": 401 }"#, r#""outputs": 401, }"#)],
        sets: &[],
        complaints: &[
            "line 32, column 73: not JSON: '}' where a key in double quotes is expected (there may be a comma too many before it)",
        ],
    },
    Case {
        what: "comma missing",
        edits: &[(
            r#""name": "four-bar and slider","#,
            r#""name": "four-bar and slider""#,
        )],
        sets: &[],
        complaints: &[
            r#"line 4, column 3: not JSON: '"' where "," or "}" is expected (a comma may be missing before it)"#,
        ],
    },
    Case {
        what: "single quotes",
        edits: &[(r#""mm""#, "'mm'")],
        sets: &[],
        complaints: &[
            r#"line 4, column 24: not JSON: '\'' where a value is expected (text stands in double quotes)"#,
        ],
    },
    Case {
        what: "quote not closed",
        edits: &[(r#""mm""#, r#""mm"#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 30: not JSON: 'a' where "," or "}" is expected (a quote or a comma may be missing before it)"#,
        ],
    },
    Case {
        what: "leading zero",
        edits: &[("-9.81", "-09.81")],
        sets: &[],
        complaints: &[
            "line 5, column 18: not JSON: a number must not begin with a zero that counts nothing",
        ],
    },
    Case {
        what: "unknown escape",
        edits: &[(r#""measured""#, r#""C:\models""#)],
        sets: &[],
        complaints: &[
            r#"line 11, column 70: not JSON: an escape that JSON does not know; a backslash itself is written \\"#,
        ],
    },
    Case {
        what: "broken surrogate",
        edits: &[(r#""measured""#, r#""\ud800""#)],
        sets: &[],
        complaints: &[
            r#"line 11, column 68: not JSON: a broken \u escape (\u and four hex digits)"#,
        ],
    },
    Case {
        what: "set: unit",
        edits: &[],
        sets: &["joints.b.clearance.radius=10 parsec"],
        complaints: &[
            r#"--set joints.b.clearance.radius=10 parsec: unknown unit "parsec" (length is wanted, such as "m")"#,
        ],
    },
    Case {
        what: "set: unknown key",
        edits: &[],
        sets: &["analysis.solver.rtoll=1e-9"],
        complaints: &[r#"--set analysis.solver.rtoll=1e-9: unknown key (did you mean "rtol"?)"#],
    },
    Case {
        what: "set: point",
        edits: &[],
        sets: &["joints.b.between[1]=coupler.Z"],
        complaints: &[
            r#"--set joints.b.between[1]=coupler.Z: body "coupler" has no point "Z" (its points: A, B)"#,
        ],
    },
    Case {
        what: "set: what does not exist",
        edits: &[],
        sets: &[
            "joints.f.clearance.radius=1",
            "joints.bearing.clearance.model=contact",
            "bodies.krank.inertia=3",
            "drivers.moter.motion.coefficients[1]=3",
            "drivers.moter.motion.start=3",
            "forces.retrun.stiffness=3",
        ],
        complaints: &[
            r#"--set bodies.krank.inertia=3: there is no body "krank" (did you mean "crank"?)"#,
            r#"--set joints.f.clearance.radius=1: there is no joint "f" (the joints: a, b, c, d, e; a new one needs "type" and "between")"#,
            r#"--set joints.bearing.clearance.model=contact: there is no joint "bearing" (the joints: a, b, c, d, e; a new one needs "type" and "between")"#,
            r#"--set drivers.moter.motion.coefficients[1]=3: there is no driver "moter" (did you mean "motor"?)"#,
            r#"--set forces.retrun.stiffness=3: there is no force "retrun" (did you mean "return"?)"#,
        ],
    },
    Case {
        what: "set: what is new and whole, at once or in parts",
        edits: &[],
        sets: &[
            r#"bodies.weight={"points": {"C": [0, 0]}}"#,
            "bodies.weight.mass=0",
            "joints.w.type=fixed",
            r#"joints.w.between=["slider.C", "weight.C"]"#,
        ],
        complaints: &[],
    },
    Case {
        what: "units that are written out",
        edits: &[
            (
                r#""length": "mm", "angle": "deg""#,
                r#""length": "inch", "angle": "degrees""#,
            ),
            ("[100, 0]", r#"["5 inches", "1 millimeter"]"#),
            (r#""vector": [0, 5]"#, r#""vector": [0, "5 Newton"]"#),
        ],
        sets: &[],
        complaints: &[
            r#"line 4, column 24: units.length: "inch": unknown unit "inch" (did you mean "in"?)"#,
            r#"line 4, column 41: units.angle: "degrees": unknown unit "degrees" (did you mean "deg"?)"#,
            r#"line 9, column 38: bodies.crank.points.A[0]: "5 inches": unknown unit "inches" (did you mean "in"?)"#,
            r#"line 9, column 50: bodies.crank.points.A[1]: "1 millimeter": unknown unit "millimeter" (did you mean "mm"?)"#,
            r#"line 28, column 65: forces.load.vector[1]: "5 Newton": unknown unit "Newton" (did you mean "N"?)"#,
        ],
    },
    Case {
        what: "no units of angular velocity",
        edits: &[
            (r#""10 rad/s""#, r#""360 deg""#),
            (
                r#""crank": { "angle": 60 }"#,
                r#""crank": { "angle": 60, "angular_velocity": "6 1/s" }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 23, column 108: drivers.motor.motion.coefficients[1]: "360 deg": "deg" is not a unit of angular velocity (such as "rad/s", "deg/s" or "rpm")"#,
            r#"line 30, column 60: initial.crank.angular_velocity: "6 1/s": "1/s" is not a unit of angular velocity (such as "rad/s", "deg/s" or "rpm")"#,
        ],
    },
    Case {
        what: "decimal commas in texts",
        edits: &[(r#""free_length": 150"#, r#""free_length": "1,5 mm""#)],
        sets: &["bodies.crank.mass=0,5", "analysis.solver.rtol=0,001"],
        complaints: &[
            r#"line 27, column 106: forces.return.free_length: "1,5 mm": a number has no comma (a decimal point is a point: "1.5 mm")"#,
            r#"--set bodies.crank.mass=0,5: a number has no comma (a decimal point is a point: "0.5")"#,
            r#"--set analysis.solver.rtol=0,001: a number has no comma (a decimal point is a point: "0.001")"#,
        ],
    },
    Case {
        what: "units of no map",
        edits: &[(r#"{ "length": "mm", "angle": "deg" }"#, r#""metric""#)],
        sets: &[],
        complaints: &[
            r#"line 4, column 12: units: "metric": unknown units (write "units": "SI", or name other units: {"length": "mm", "angle": "deg"})"#,
        ],
    },
    Case {
        what: "lists and objects that are something else, each with an example",
        edits: &[
            ("[0, -9.81]", "-9.81"),
            (r#""pose": { "angle": 60 }"#, r#""pose": [50, 0, 0]"#),
            (r#"["ground.O", "crank.O"]"#, r#""ground.O, crank.O""#),
            (r#"{ "model": "massless_link", "radius": 0.1 }"#, "0.1"),
            (
                r#"["ground.Q", "rocker.Q"]"#,
                r#"["ground.Q", "rocker.Q"], "friction": 0.1"#,
            ),
            ("[1, 0]", r#""x""#),
            (
                r#"{ "type": "polynomial", "coefficients": [60, "10 rad/s"] }"#,
                "60",
            ),
            ("[0, 5] }\n", "5 }\n"),
            (
                r#""outputs": 401"#,
                r#""outputs": 401, "columns": "crank.*""#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 5, column 14: gravity: -9.81: a list is expected, not a number (as in "gravity": [0, -9.81])"#,
            r#"line 9, column 57: bodies.crank.pose: an object is expected, not a list (as in "pose": { "position": [50, 0], "angle": "60 deg" })"#,
            r#"line 15, column 43: joints.a.between: "ground.O, crank.O": a list is expected, not text (as in "between": ["ground.A", "crank.A"])"#,
            r#"line 17, column 20: joints.b.clearance: 0.1: an object is expected, not a number (as in "clearance": { "model": "massless_link", "radius": "0.1 mm" })"#,
            r#"line 19, column 81: joints.d.friction: 0.1: an object is expected, not a number (as in "friction": { "law": "coulomb", "coefficient": 0.1, "threshold_velocity": "1 mm/s" })"#,
            r#"line 20, column 78: joints.e.axis: "x": a list is expected, not text (as in "axis": [1, 0])"#,
            r#"line 23, column 63: drivers.motor.motion: 60: an object is expected, not a number (as in "motion": { "type": "constant_velocity", "velocity": "60 rpm" })"#,
            r#"line 28, column 61: forces.load.vector: 5: a list is expected, not a number (as in "vector": [0, -10])"#,
            r#"line 32, column 84: analysis.columns: "crank.*": a list is expected, not text (as in "columns": ["crank.*", "joint.b.f?"])"#,
        ],
    },
    Case {
        what: "forces as a list",
        edits: &[],
        sets: &[r#"forces=[{"type": "force"}]"#],
        complaints: &[
            r#"--set forces=[{"type": "force"}]: an object is expected, not a list (as in "forces": { "load": { "type": "force", "at": "crank.A", "vector": [0, -10] } })"#,
        ],
    },
    Case {
        what: "what a driver misses",
        edits: &[
            (
                r#""body": "crank", "motion": { "type": "polynomial", "coefficients": [60, "10 rad/s"] }"#,
                r#""motion": { "type": "harmonic", "amplitude": 1 }"#,
            ),
            (
                r#"{ "type": "table", "points": [[0, 0], [1, 5]] }"#,
                r#"{ "type": "constant_velocity" }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 23, column 14: drivers.motor: "body" is missing (the name of a body, as in "body": "crank")"#,
            r#"line 23, column 46: drivers.motor.motion: "frequency" is missing (as in "frequency": "2 Hz")"#,
            r#"line 24, column 64: drivers.pusher.motion: "velocity" is missing (as in "velocity": "60 rpm", or "10 mm/s" of a slide)"#,
        ],
    },
    Case {
        what: "drivers called as joints",
        edits: &[
            (r#""type": "rotation""#, r#""type": "revolute""#),
            (r#""type": "translation""#, r#""type": "prismatic""#),
        ],
        sets: &[],
        complaints: &[
            r#"line 23, column 24: drivers.motor.type: "revolute": unknown type (did you mean "rotation"?)"#,
            r#"line 24, column 25: drivers.pusher.type: "prismatic": unknown type (did you mean "translation"?)"#,
        ],
    },
    Case {
        what: "set: no value, no path, no entry, no object",
        edits: &[],
        sets: &[
            "gravity",
            "a..b=3",
            "gravity[2]=1",
            "gravity.y=1",
            "name.x=1",
        ],
        complaints: &[
            r#"--set gravity: there is no "=" (PATH=VALUE is expected, such as joints.b.clearance.radius="10 um")"#,
            r#"--set a..b=3: "a..b" is not a path (PATH=VALUE is expected, such as joints.b.clearance.radius="10 um")"#,
            "--set gravity[2]=1: gravity has no entry [2] (it has 2, counted from 0)",
            r#"--set gravity.y=1: gravity is a list and has no keys (the path goes on with "y")"#,
            r#"--set name.x=1: name is text and has no keys (the path goes on with "x")"#,
        ],
    },
    Case {
        what: "set: a list and an object that are none",
        edits: &[],
        sets: &[
            "gravity=[0, -9.81",
            r#"joints.b.clearance={"model": "ideal", "radius": .5}"#,
        ],
        complaints: &[
            r#"--set gravity=[0, -9.81: not JSON at character 10 of the value: it ends where "," or "]" is expected; it seems cut short (a list or an object is given as JSON: [0, -9.81] or {"type": "fixed"})"#,
            r#"--set joints.b.clearance={"model": "ideal", "radius": .5}: not JSON at character 30 of the value: '.' where a value is expected (a number begins with a digit or a minus sign, as in 0.5)"#,
        ],
    },
    Case {
        what: "set: what it makes wrong elsewhere",
        edits: &[],
        sets: &["bodies.crank.points={}"],
        complaints: &[
            r#"line 15, column 56: joints.a.between[1]: "crank.O": body "crank" has no point "O" (its points: none)"#,
            r#"line 16, column 44: joints.b.between[0]: "crank.A": body "crank" has no point "A" (its points: none)"#,
        ],
    },
    Case {
        what: "everything at once, in the order of the lines",
        edits: &[
            (r#""mass": 0.8"#, r#""mass": "0.8 kgg""#),
            (r#""rocker.B""#, r#""rocker.C""#),
            (r#""outputs": 401"#, r#""outputs": "many""#),
            (r#""measured""#, "1"),
        ],
        sets: &["analysis.solver.max_step=1 m"],
        complaints: &[
            r#"line 8, column 24: bodies.crank.mass: "0.8 kgg": unknown unit "kgg" (did you mean "kg"?)"#,
            "line 11, column 67: bodies.rocker.note: 1: text is expected, not a number",
            r#"line 18, column 57: joints.c.between[1]: "rocker.C": body "rocker" has no point "C" (its points: Q, B)"#,
            r#"line 32, column 68: analysis.outputs: "many": a plain number is expected, not text"#,
            r#"--set analysis.solver.max_step=1 m: "m" is not a unit of time (such as "s")"#,
        ],
    },
];

fn said(text: &[u8], sets: &[&str]) -> Vec<String> {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    match linkdyn_model::load(text, &sets) {
        Ok(_) => Vec::new(),
        Err(complaints) => complaints.iter().map(ToString::to_string).collect(),
    }
}

#[test]
fn every_bad_model_is_refused_in_these_words() {
    assert_eq!(
        said(BASE.as_bytes(), &[]),
        Vec::<String>::new(),
        "the base model is good"
    );
    let mut wrong = String::new();
    for case in CASES {
        let mut text = BASE.to_owned();
        for (from, to) in case.edits {
            assert!(text.contains(from), "{}: {from}", case.what);
            text = text.replace(from, to);
        }
        let said = said(text.as_bytes(), case.sets);
        if said != case.complaints {
            wrong += &format!(
                "{}:\n  said {said:#?}\n  want {:#?}\n",
                case.what, case.complaints
            );
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn what_is_no_model_at_all_gets_one_clear_complaint() {
    let deep = "[".repeat(100_000);
    let cases: [(&[u8], &str); 17] = [
        (b"", "the file is empty (a model is a JSON object)"),
        (b" \n\t", "the file is empty (a model is a JSON object)"),
        (
            b"\xEF\xBB\xBF",
            "the file is empty (a model is a JSON object)",
        ),
        (
            b"[]",
            "line 1, column 1: a model is an object, { \u{2026} }, not a list",
        ),
        (
            b"\"four-bar\"",
            "line 1, column 1: a model is an object, { \u{2026} }, not text",
        ),
        (
            b"{\n  \"a\": 1",
            "line 2, column 9: not JSON: it ends where \",\" or \"}\" is expected; it seems cut short",
        ),
        (
            b"{\n  \"a\":",
            "line 2, column 7: not JSON: it ends where a value is expected; it seems cut short",
        ),
        (
            b"{ \"a\": \"b",
            "line 1, column 8: not JSON: the text has no closing quote; it seems cut short",
        ),
        (
            b"{} {}",
            "line 1, column 4: not JSON: '{' where the end is expected (it is complete before this: take out what follows)",
        ),
        (
            b"{} that is all",
            "line 1, column 4: not JSON: 't' where the end is expected (it is complete before this: take out what follows)",
        ),
        (
            b"{} }",
            "line 1, column 4: not JSON: '}' where the end is expected (there is one closing bracket too many, here or before)",
        ),
        (
            b"{ \"a\": 1e999 }",
            "line 1, column 8: not JSON: 1e999: the number is too large for a double",
        ),
        (
            b"{ \"\xc3\xa9\": 'x' }",
            "line 1, column 8: not JSON: '\\'' where a value is expected (text stands in double quotes)",
        ),
        (
            b"{\n\"a\": \xff }",
            "line 2, column 6: the file is not UTF-8 text (a model is a JSON file; save it as UTF-8)",
        ),
        (
            b"\xff\xfe{\0}\0",
            "line 1, column 1: the file is not UTF-8 text (a model is a JSON file; save it as UTF-8)",
        ),
        (
            b"\x7fELF\x02\x01\x01",
            "line 1, column 1: not JSON: '\\u{7f}' where a value is expected",
        ),
        (
            deep.as_bytes(),
            "line 1, column 129: not JSON: nested more than 128 deep",
        ),
    ];
    for (text, words) in cases {
        assert_eq!(said(text, &[]), [words]);
    }
}

#[test]
fn a_byte_order_mark_and_windows_line_ends_do_no_harm() {
    let text = format!("\u{feff}{}", BASE.replace('\n', "\r\n"));
    assert_eq!(said(text.as_bytes(), &[]), Vec::<String>::new());
    let text = text
        .replace("0.8", "-0.8")
        .replace("\"four-bar", "\"čtyřkloub");
    assert_eq!(
        said(text.as_bytes(), &[]),
        ["line 8, column 24: bodies.crank.mass: -0.8: must not be negative"]
    );
    // on the first line the mark is no column
    assert_eq!(
        said("\u{feff}?".as_bytes(), &[]),
        ["line 1, column 1: not JSON: '?' where a value is expected"]
    );
}

#[test]
fn files_that_cannot_be_models_are_refused_by_name() {
    let folder = std::env::temp_dir().join(format!("linkdyn-complaints-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let large = folder.join("large.json");
    let mut file = std::fs::File::create(&large).unwrap();
    file.write_all(b"[[[[").unwrap();
    file.set_len(100 * 1024 * 1024).unwrap();
    let said =
        |path: &std::path::Path| linkdyn_model::load_file(path, &[]).unwrap_err()[0].to_string();
    let (folder_name, large_name) = (folder.display().to_string(), large.display().to_string());
    assert_eq!(
        said(&large),
        format!("{large_name}: 100 MB are too much for a model, at most 64 MB are read")
    );
    assert_eq!(
        said(&folder),
        format!("{folder_name}: this is a directory, not a model file")
    );
    assert_eq!(
        said(&folder.join("none.json")),
        format!("{folder_name}/none.json: there is no such file")
    );
    std::fs::remove_dir_all(&folder).unwrap();
    assert_eq!(
        linkdyn_model::load(&vec![b' '; 65 * 1024 * 1024], &[]).unwrap_err()[0].to_string(),
        "65 MB are too much for a model, at most 64 MB are read"
    );
}

#[test]
fn a_file_with_thousands_of_faults_is_not_repeated_whole() {
    let names: Vec<String> = (0..5000).map(|index| format!("\"f{index}\": 1")).collect();
    let said = said(
        BASE.replace(
            "\"load\": {",
            &format!("{}, \"load\": {{", names.join(", ")),
        )
        .as_bytes(),
        &[],
    );
    assert_eq!(said.len(), 101);
    assert_eq!(said[100], "and 4900 more faults");
}

#[test]
fn nothing_hostile_in_an_expression_hangs() {
    let with = |text: &str| said(BASE.replace("-9.81", &format!("{text:?}")).as_bytes(), &[]);
    let begin = |text: String| text.chars().take(60).collect::<String>();
    for (text, words) in [
        (
            format!("={}", "(".repeat(1_000_000)),
            "an expression has at most 4096 characters",
        ),
        (
            format!("={}1{}", "(".repeat(2000), ")".repeat(2000)),
            "nested more than 64 deep",
        ),
        (
            format!("={}", "2^".repeat(2000)),
            "nested more than 64 deep",
        ),
        (
            format!("=2{}", "^2".repeat(60)),
            "the result is too large for a double",
        ),
    ] {
        let said = with(&text);
        assert!(
            said.len() == 1 && said[0].ends_with(words),
            "{}: {:?}",
            begin(text),
            said.into_iter().map(begin)
        );
    }
    // a chain and a circle of a hundred thousand
    for last in ["1", "\"=p0\""] {
        let chain: String = (0..100_000)
            .map(|index| format!("\"p{index}\": \"=p{}+p{}\", ", index + 1, index + 1))
            .collect();
        let text = BASE
            .replace(
                "\"name\": \"four-bar and slider\"",
                &format!("\"parameters\": {{ {chain} \"p100000\": {last} }}"),
            )
            .replace("-9.81", "\"=p99990\"");
        let said = said(text.as_bytes(), &[]);
        assert_eq!(said.len(), 1, "{last}");
        let words = if last == "1" {
            "the result is too large for a double"
        } else {
            "p0 → p1 → p2 → p3 → p4 → p5 → p6 → p7 → … → p0"
        };
        assert!(said[0].contains(words), "{}", said[0]);
    }
}

#[test]
fn expressions_arrive_in_si() {
    let text = BASE
        .replace(
            "\"name\": \"four-bar and slider\"",
            "\"parameters\": { \"note\": \"sizes\", \"l\": \"=2.5*r\", \"r\": \"100 mm\", \"rho\": \"8 kg/m\", \"n\": 4,
               \"turn\": \"=2*pi * 1 rad\", \"spare\": 1 }",
        )
        .replace("0.8", "\"=rho*r\"")
        .replace("7e-4", "\"=rho*r^3/12\"")
        .replace("\"A\": [100, 0]", "\"A\": [\"=r\", \"=3*4\"]")
        .replace("\"angle\": 60 } }", "\"angle\": \"=asin(1)/3*2\" } }")
        .replace("250", "\"=l\"")
        .replace("\"axis\": [1, 0]", "\"axis\": [\"=cos(turn)\", \"=sin(0)\"]")
        .replace("\"10 rad/s\"", "\"=0.2 m/s / r * 1 rad\"")
        .replace("401", "\"=100*n+1\"");
    let model = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
        linkdyn_model::load(text.as_bytes(), &sets).unwrap_or_else(|said| panic!("{}", said[0]))
    };
    let loaded = model(&[]);
    let crank = &loaded.model.bodies["crank"];
    assert_eq!(
        (crank.mass, crank.inertia),
        (Some(0.8), Some(8.0 * 0.1_f64.powi(3) / 12.0))
    );
    assert_eq!(
        crank.points["A"],
        [0.1, 0.012],
        "a plain result is in the file's unit"
    );
    assert_eq!(crank.pose.angle, std::f64::consts::FRAC_PI_2 / 3.0 * 2.0);
    assert_eq!(loaded.model.bodies["coupler"].points["B"], [0.25, 0.0]);
    let linkdyn_model::JointKind::Prismatic { axis, .. } = &loaded.model.joints["e"].kind else {
        panic!()
    };
    assert_eq!(axis, &[1.0, 0.0]);
    let linkdyn_model::Motion::Polynomial { coefficients } = &loaded.model.drivers["motor"].motion
    else {
        panic!()
    };
    assert_eq!(coefficients[1], 2.0);
    assert_eq!(
        loaded
            .model
            .analysis
            .as_ref()
            .and_then(|analysis| analysis.outputs),
        Some(401)
    );
    assert_eq!(
        loaded.warnings,
        ["line 4, column 50: parameters.spare: 1: no expression uses this parameter"]
    );
    let resolved: Vec<_> = loaded
        .parameters
        .iter()
        .map(|p| (p.name.as_str(), p.value, p.unit.as_str()))
        .collect();
    let tau = std::f64::consts::TAU;
    assert_eq!(
        resolved,
        [
            ("l", 0.25, "m"),
            ("r", 0.1, "m"),
            ("rho", 8.0, "kg/m"),
            ("n", 4.0, ""),
            ("turn", tau, "rad"),
            ("spare", 1.0, "")
        ]
    );
    // one value changes all that follows from it; the document keeps the words
    let changed = model(&[
        "parameters.r=200 mm",
        "parameters.l==r+10 mm",
        "initial.crank.angle==30 deg",
    ]);
    assert_eq!(
        changed.model.bodies["coupler"].points["B"],
        [0.21000000000000002, 0.0]
    );
    assert_eq!(
        changed.model.initial["crank"].angle,
        Some(30f64.to_radians())
    );
    assert_eq!(changed.document["parameters"]["r"], "200 mm");
    assert_eq!(changed.document["bodies"]["crank"]["mass"], "=rho*r");
}

#[test]
fn warnings_are_no_faults() {
    let edited = |from: &str, to: &str| {
        assert!(BASE.contains(from));
        linkdyn_model::load(BASE.replace(from, to).as_bytes(), &[])
            .unwrap()
            .warnings
    };
    assert_eq!(edited("0.8", "0.9"), Vec::<String>::new());
    assert_eq!(
        edited(
            "\"crank\": { \"angle\": 60 }",
            "\"crank\": { \"angular_velocity\": 60 }"
        ),
        [
            "line 30, column 47: initial.crank.angular_velocity: 60: a plain angular_velocity is in rad/s, although \
          \"angle\" has another unit (name a unit for \"angular_velocity\" in units, or write it with its unit)"
        ]
    );
    assert_eq!(
        edited(", \"free_length\": 150", ""),
        [
            "line 27, column 15: forces.return: \"free_length\" is left out and taken as 0 (write it, even if it is 0)"
        ]
    );
    assert_eq!(
        edited("\"at\": \"coupler.B\"", "\"at\": \"ground.O\""),
        [
            "line 28, column 38: forces.load.at: \"ground.O\": ground is fixed: the force moves nothing (name a body that it is to \
          move)"
        ]
    );
}

#[test]
fn torques_on_what_can_not_move_are_warned_of() {
    let torque = |ends: &str| {
        let set = format!("forces.t={{\"type\": \"torque\", {ends}, \"value\": 5}}");
        linkdyn_model::load(BASE.as_bytes(), &[set])
            .unwrap()
            .warnings
    };
    let none = Vec::<String>::new();
    assert_eq!(torque(r#""body": "crank""#), none);
    assert_eq!(torque(r#""body": "ground", "relative_to": "crank""#), none);
    for ends in [
        r#""body": "ground""#,
        r#""body": "ground", "relative_to": "ground""#,
    ] {
        let said = torque(ends);
        assert!(
            said.len() == 1 && said[0].contains("ground is fixed: the torque moves nothing"),
            "{said:?}"
        );
    }
    let said = torque(r#""body": "crank", "relative_to": "crank""#);
    assert!(
        said.len() == 1 && said[0].contains("the same body takes the opposite"),
        "{said:?}"
    );
}

#[test]
fn numbers_arrive_in_si() {
    let text = BASE.replace("7e-4", "\"700 kg*mm^2\"").replace(
        "[0, 5] }",
        "[\"1 lbf\", { \"type\": \"harmonic\", \"amplitude\": 2, \"frequency\": 3, \"phase\": 90 }] }",
    );
    let loaded =
        linkdyn_model::load(text.as_bytes(), &["joints.b.clearance.radius=10 um".into()]).unwrap();
    let (model, degree) = (&loaded.model, std::f64::consts::PI / 180.0);
    assert_eq!(model.bodies["crank"].inertia, Some(7e-4));
    assert_eq!(model.bodies["crank"].pose.angle, 60.0 * degree);
    assert_eq!(model.bodies["coupler"].points["B"], [0.25, 0.0]);
    let linkdyn_model::JointKind::Revolute {
        clearance: Some(clearance),
        ..
    } = &model.joints["b"].kind
    else {
        panic!()
    };
    assert_eq!(clearance.radius, Some(1e-5));
    let linkdyn_model::Motion::Polynomial { coefficients } = &model.drivers["motor"].motion else {
        panic!()
    };
    assert_eq!(coefficients, &[60.0 * degree, 10.0]);
    let linkdyn_model::Motion::Table { points } = &model.drivers["pusher"].motion else {
        panic!()
    };
    assert_eq!(points, &[[0.0, 0.0], [1.0, 0.005]]);
    let linkdyn_model::ForceKind::Load {
        vector: [Value::Constant(x), Value::Motion(y)],
        ..
    } = &model.forces["load"].kind
    else {
        panic!()
    };
    assert_eq!(*x, 4.4482216152605);
    let harmonic = linkdyn_model::Motion::Harmonic {
        offset: 0.0,
        amplitude: 2.0,
        frequency: 3.0,
        phase: 90.0 * degree,
    };
    assert_eq!(*y, harmonic);
    assert_eq!(
        model.bodies.keys().collect::<Vec<_>>(),
        ["ground", "crank", "coupler", "rocker", "slider"]
    );
}

#[test]
fn the_document_is_what_was_written_and_set() {
    let sets = [
        "analysis.solver.rtol=1e-9",
        "joints.b.between[1]=rocker.B",
        "about=x=y",
        "gravity=[0, 0]",
    ]
    .map(String::from);
    let loaded = linkdyn_model::load(BASE.as_bytes(), &sets).unwrap();
    let mut expected: serde_json::Value = serde_json::from_str(BASE).unwrap();
    expected["analysis"]["solver"] = serde_json::json!({ "rtol": 1e-9 });
    expected["joints"]["b"]["between"][1] = "rocker.B".into();
    expected["about"] = "x=y".into();
    expected["gravity"] = serde_json::json!([0, 0]);
    assert_eq!(loaded.document.to_string(), expected.to_string());
    let place = |path: &str| {
        loaded
            .source
            .locate(path)
            .map(|place| (place.line, place.column))
    };
    assert_eq!(place("joints.b.between[0]"), Some((16, 44)));
    assert_eq!(place("joints.b.between[1]"), None, "it came from --set");
    assert_eq!(
        place("joints.b.speed"),
        Some((16, 5)),
        "the key of the nearest ancestor"
    );
    assert_eq!(place(""), Some((1, 1)));
}

#[test]
fn a_note_is_allowed_in_every_object() {
    // a brace that opens an object gets a note at once
    let text = BASE
        .replace(", \"note\": \"measured\"", "")
        .replace("{ ", "{ \"note\": \"why\", ")
        .replace("{\n", "{ \"note\": \"why\",\n");
    assert_eq!(
        said(text.as_bytes(), &["analysis.solver.note=why"]),
        Vec::<String>::new()
    );
}

/// Whatever comes, every complaint has words.
fn survives(text: &[u8]) {
    if let Err(complaints) = linkdyn_model::load(text, &[]) {
        assert!(!complaints.is_empty());
        assert!(
            complaints
                .iter()
                .all(|complaint| !complaint.message.is_empty())
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_bytes_make_it_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        survives(&bytes);
    }

    #[test]
    fn no_mutation_of_a_model_makes_it_panic(
        at in 0..BASE.len(), length in 0usize..40, insert in "[\\[\\]{}\":,=.0-9a-zé\\\\ -]{0,12}"
    ) {
        let mut bytes = BASE.as_bytes().to_vec();
        let end = (at + length).min(bytes.len());
        bytes.splice(at..end, insert.into_bytes());
        survives(&bytes);
    }

    #[test]
    fn no_value_in_place_of_another_makes_it_panic(which in 0usize..400, kind in 0usize..9) {
        let values = ["null", "true", "-1", "1e308", "\"\"", "\"5 mm\"", "[]", "{}", "[{\"type\": 1}, 2]"];
        let mut model: serde_json::Value = serde_json::from_str(BASE).unwrap();
        let mut left = which;
        replace(&mut model, &mut left, &serde_json::from_str(values[kind]).unwrap());
        survives(model.to_string().as_bytes());
    }

    #[test]
    fn no_expression_makes_it_panic(
        one in "[-+*/^(),.0-9a-e πµ°²=]{0,24}", two in "([-+*/^(,]|sin\\(|min\\(|sqrt\\(|a|b|pi|2|0\\.5|3 mm|1e3 N/m|\\)| ){0,12}"
    ) {
        let mut model: serde_json::Value = serde_json::from_str(BASE).unwrap();
        model["parameters"] = serde_json::json!({ "a": "2 mm", "b": format!("={two}"), "c": format!("={one}") });
        model["bodies"]["rocker"]["points"]["B"] = serde_json::json!([format!("={one}"), format!("={two}")]);
        survives(model.to_string().as_bytes());
        if let Ok(loaded) = linkdyn_model::load(model.to_string().as_bytes(), &[]) {
            prop_assert!(loaded.model.bodies["rocker"].points["B"].iter().all(|value| value.is_finite()));
        }
    }

    #[test]
    fn no_set_makes_it_panic(set in "[a-z.\\[\\]=0-9{}\": ]{0,40}", path in "(joints|bodies|analysis|units)(\\.[a-e]|\\[[0-2]\\]){0,4}=") {
        for set in [set.clone(), path + &set] {
            let _ = linkdyn_model::load(BASE.as_bytes(), &[set]);
        }
    }
}

/// Replaces the value that `left` counts down to.
fn replace(value: &mut serde_json::Value, left: &mut usize, by: &serde_json::Value) {
    if *left == 0 {
        *value = by.clone();
    }
    *left = left.wrapping_sub(1);
    match value {
        serde_json::Value::Array(items) => {
            items.iter_mut().for_each(|item| replace(item, left, by))
        }
        serde_json::Value::Object(members) => members
            .values_mut()
            .for_each(|member| replace(member, left, by)),
        _ => {}
    }
}
