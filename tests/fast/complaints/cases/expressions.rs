//! Parameters and expressions.

use super::Case;

pub const CASES: &[Case] = &[
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
];
