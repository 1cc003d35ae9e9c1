//! Tolerances, ranges of clearance, fits, play, and what is asked of accuracy.

use super::Case;

const NAME: &str = r#""name": "four-bar and slider""#;
const RADIUS: &str = r#""radius": 0.1"#;
const END: &str = r#""outputs": 401 }"#;

pub const CASES: &[Case] = &[
    Case {
        what: "parameters: tolerances that are none",
        edits: &[
            (
                NAME,
                r#""parameters": {
    "a": { "value": "50 mm", "tolerance": "-0.1 mm" },
    "b": { "value": "50 mm", "tolerance": "0.1 kg" },
    "c": { "value": "50 mm", "tolerance": 0.1 },
    "d": { "value": "50 mm", "tolerance": ["0.1 mm", "-0.1 mm"] },
    "e": { "value": "0 mm", "tolerance": "2 %" },
    "f": { "value": "50 mm", "tolerance": "0.1" },
    "g": { "value": "50 mm", "tolerance": ["0.1 mm"] },
    "h": { "value": "50 mm", "tolerance": true },
    "i": { "value": "50 mm", "tolerance": "=b*b" },
    "j": { "value": 3, "tolerance": "1 mm" }
  }"#,
            ),
            ("0.8", r#""=(a+b+c+d+e+f+g+h+i+j*1 m)/1 m""#),
        ],
        sets: &[],
        complaints: &[
            r#"line 4, column 43: parameters.a.tolerance: "-0.1 mm": must not be negative (it goes to either side, or write [lower, upper])"#,
            r#"line 5, column 43: parameters.b.tolerance: "0.1 kg": this is a mass [kg], where a length [m] is wanted, as the parameter is"#,
            r#"line 6, column 43: parameters.c.tolerance: 0.1: this is a plain number, where a length [m] is wanted, as the parameter is (give it a unit, as in "0.1 mm")"#,
            r#"line 7, column 43: parameters.d.tolerance: the deviations are the wrong way round (the lower one comes first, as in ["-0.02 mm", "0.05 mm"])"#,
            r#"line 8, column 42: parameters.e.tolerance: "2 %": 2 % of 0 is nothing (write the tolerance itself)"#,
            r#"line 9, column 43: parameters.f.tolerance: "0.1": the unit is missing (give it a unit, as in "0.1 mm")"#,
            r#"line 10, column 43: parameters.g.tolerance: a list of 2 is expected, this one has 1 (lower and upper deviation, or one for both)"#,
            r#"line 11, column 43: parameters.h.tolerance: true: a number is expected, not true or false (as in "tolerance": "0.05 mm")"#,
            r#"line 12, column 43: parameters.i.tolerance: "=b*b": this is a quantity in m^2, where a length [m] is wanted, as the parameter is"#,
            r#"line 13, column 37: parameters.j.tolerance: "1 mm": this is a length [m], where a plain number is wanted, as the parameter is"#,
            r#"line 19, column 24: bodies.crank.mass: "=(a+b+c+d+e+f+g+h+i+j*1 m)/1 m": this is a ratio without unit, where a mass [kg] is wanted (multiply it by a quantity, such as 1 kg)"#,
        ],
    },
    Case {
        what: "parameters: how they are spread, and what they cost",
        edits: &[
            (
                NAME,
                r#""parameters": {
    "a": { "value": "50 mm", "tolerance": "0.1 mm", "distribution": "gauss" },
    "b": { "value": "50 mm", "tolerance": "0.1 mm", "sigma": 0 },
    "c": { "value": "50 mm", "tolerance": "0.1 mm", "distribution": "uniform", "sigma": 3 },
    "d": { "value": "50 mm", "sigma": 3 },
    "e": { "value": "50 mm", "tolerance": "0.1 mm", "cost": "-1 mm" },
    "f": { "value": "50 mm", "tolerance": "0.1 mm", "cost": 5 },
    "g": { "value": "50 mm", "tolerence": "0.1 mm" },
    "h": { "tolerance": "0.1 mm" },
    "i": { "value": { "value": 5 } },
    "j": { "value": "5 mmm", "tolerance": "0.1 mm" }
  }"#,
            ),
            ("0.8", r#""=(a+b+c+d+e+f+g+h+i+j)/1 m""#),
        ],
        sets: &[],
        complaints: &[
            r#"line 4, column 69: parameters.a.distribution: "gauss": unknown distribution (one of "normal", "uniform" or "triangular")"#,
            r#"line 5, column 62: parameters.b.sigma: 0: must be greater than 0"#,
            r#"line 6, column 89: parameters.c.sigma: 3: "uniform" has no sigma (only "normal" has one)"#,
            r#"line 7, column 39: parameters.d.sigma: 3: "sigma" is that of a tolerance, and there is none (as in "tolerance": "0.05 mm")"#,
            r#"line 8, column 61: parameters.e.cost: "-1 mm": must be greater than 0"#,
            r#"line 9, column 61: parameters.f.cost: 5: this is a plain number, where a length [m] is wanted, as the parameter is (give it a unit, as in "0.1 mm")"#,
            r#"line 10, column 30: parameters.g.tolerence: "tolerence": unknown key (did you mean "tolerance"?)"#,
            r#"line 11, column 10: parameters.h: "value" is missing (as in "value": "5 mm")"#,
            r#"line 12, column 21: parameters.i.value: a number is expected, not an object (or text: with a unit, such as "5 mm", or an expression, "=2*r")"#,
            r#"line 13, column 21: parameters.j.value: "5 mmm": unknown unit "mmm" (did you mean "mm"?)"#,
        ],
    },
    Case {
        what: "clearance: ranges",
        edits: &[(RADIUS, r#""radius": ["20 um", "5 um"]"#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 58: joints.b.clearance.radius: the range is the wrong way round (the least value comes first)"#,
        ],
    },
    Case {
        what: "clearance: ranges below zero",
        edits: &[(RADIUS, r#""radius": ["-20 um", "5 s"]"#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 59: joints.b.clearance.radius[0]: "-20 um": must not be negative"#,
            r#"line 17, column 69: joints.b.clearance.radius[1]: "5 s": "s" is not a unit of length (such as "m")"#,
        ],
    },
    Case {
        what: "clearance: ranges of one",
        edits: &[(RADIUS, r#""radius": ["20 um"]"#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 58: joints.b.clearance.radius: a list of 2 is expected, this one has 1"#,
        ],
    },
    Case {
        what: "clearance: fits that are none",
        edits: &[(RADIUS, r#""fit": "20 H7""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 55: joints.b.clearance.fit: "20 H7": this is no fit (as in "20 H7/g6": nominal diameter in mm, hole, shaft)"#,
        ],
    },
    Case {
        what: "clearance: fits that no table has",
        edits: &[(RADIUS, r#""fit": "20 H7/y6""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 55: joints.b.clearance.fit: "20 H7/y6": no table here has "y6" (the letters: a, b, c, d, e, f, g, h, js, k, m, n, p)"#,
        ],
    },
    Case {
        what: "clearance: fits that can be tight",
        edits: &[(RADIUS, r#""fit": "20 H7/k6""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 55: joints.b.clearance.fit: "20 H7/k6": this fit can be tight: hole 0 to +21 µm, shaft +2 to +15 µm, clearance -15 to +19 µm (a pin that turns needs a clearance, as in "20 H7/g6")"#,
        ],
    },
    Case {
        what: "clearance: radius and fit",
        edits: &[(RADIUS, r#""radius": 0.1, "fit": "20 H7/g6""#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 70: joints.b.clearance.fit: "20 H7/g6": "radius" and "fit" exclude each other (keep one of them)"#,
        ],
    },
    Case {
        what: "clearance: a fit that is no text",
        edits: &[(RADIUS, r#""fit": 20"#)],
        sets: &[],
        complaints: &[
            r#"line 17, column 55: joints.b.clearance.fit: 20: text is expected, not a number (as in "fit": "20 H7/g6")"#,
        ],
    },
    Case {
        what: "play, backlash and a driver's tolerance below zero",
        edits: &[
            (
                r#""axis": [1, 0] }"#,
                r#""axis": [1, 0], "play": [0.1, -0.2] },
    "g": { "type": "gear", "between": ["crank.O", "rocker.Q"], "ratio": -2, "backlash": -0.1 }"#,
            ),
            (
                r#""coefficients": [60, "10 rad/s"] }"#,
                r#""coefficients": [60, "10 rad/s"] }, "tolerance": "1 mm""#,
            ),
            (
                r#""points": [[0, 0], [1, 5]] }"#,
                r#""points": [[0, 0], [1, 5]] }, "tolerance": -1"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 20, column 94: joints.e.play: the range is the wrong way round (the least value comes first)"#,
            r#"line 20, column 100: joints.e.play[1]: -0.2: must not be negative"#,
            r#"line 21, column 89: joints.g.backlash: -0.1: must not be negative"#,
            r#"line 24, column 136: drivers.motor.tolerance: "1 mm": "mm" is not a unit of angle (such as "rad")"#,
            r#"line 25, column 126: drivers.pusher.tolerance: -1: must not be negative"#,
        ],
    },
    Case {
        what: "points: the tolerance of a place",
        edits: &[
            (
                r#""A": [100, 0]"#,
                r#""A": { "position": [100], "tolerance": -1 }"#,
            ),
            (r#""Q": [300, 0]"#, r#""Q": { "tolerance": "1 deg" }"#),
            (
                r#""B": [250, 0]"#,
                r#""B": { "position": [250, 0], "zone": 1 }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 7, column 47: bodies.ground.points.Q: "position" is missing (as in "position": [50, 0])"#,
            r#"line 7, column 62: bodies.ground.points.Q.tolerance: "1 deg": "deg" is not a unit of length (such as "m")"#,
            r#"line 9, column 51: bodies.crank.points.A.position: a list of 2 is expected, this one has 1"#,
            r#"line 9, column 71: bodies.crank.points.A.tolerance: -1: must not be negative"#,
            r#"line 10, column 72: bodies.coupler.points.B.zone: "zone": unknown key (did you mean "note"?)"#,
        ],
    },
    Case {
        what: "accuracy: columns",
        edits: &[(
            END,
            r#""outputs": 401 },
  "accuracy": { "outputs": {
    "a": { "column": "rocker.angel" },
    "b": { "column": "roker.angle" },
    "c": { "column": "coupler.P.x" },
    "d": { "column": "rocker.angle [rad]" },
    "e": { "column": "ground.x" },
    "f": { "column": "driver.moter.effort" },
    "g": { "column": "joint.z.fx" },
    "h": {},
    "i": { "column": "rocker.angle", "distance": ["crank.A", "ground.Q"] },
    "j": { "distance": ["crank.A", "crank.O"] },
    "k": { "distance": ["crank.A"] }
  } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 34, column 22: accuracy.outputs.a.column: "rocker.angel": no column of positions or forces is called so (as in "rocker.angle", "coupler.P.x", "joint.b.fx" or "driver.motor.effort")"#,
            r#"line 35, column 22: accuracy.outputs.b.column: "roker.angle": there is no body "roker" (did you mean "rocker"?)"#,
            r#"line 36, column 22: accuracy.outputs.c.column: "coupler.P.x": body "coupler" has no point "P" (its points: A, B)"#,
            r#"line 37, column 22: accuracy.outputs.d.column: "rocker.angle [rad]": the name of a column goes without its unit (write "rocker.angle")"#,
            r#"line 38, column 22: accuracy.outputs.e.column: "ground.x": ground is fixed, it has no error"#,
            r#"line 39, column 22: accuracy.outputs.f.column: "driver.moter.effort": there is no driver "moter" (did you mean "motor"?)"#,
            r#"line 40, column 22: accuracy.outputs.g.column: "joint.z.fx": there is no joint "z" (the joints: a, b, c, d, e)"#,
            r#"line 41, column 10: accuracy.outputs.h: "column" is missing (an output is a "column" of the results, or a "distance" of two points)"#,
            r#"line 42, column 50: accuracy.outputs.i.distance: "column" and "distance" exclude each other (keep one of them)"#,
            r#"line 43, column 24: accuracy.outputs.j.distance: both points are of "crank" (their distance does not depend on the mechanism)"#,
            r#"line 44, column 24: accuracy.outputs.k.distance: a list of 2 is expected, this one has 1"#,
        ],
    },
    Case {
        what: "accuracy: positions and limits",
        edits: &[(
            END,
            r#""outputs": 401 },
  "accuracy": { "pins": "wurst", "levels": "frist", "outputs": {
    "a": { "column": "rocker.angle", "at": { "driver": "motor" } },
    "b": { "column": "rocker.angle", "at": { "value": 5 } },
    "c": { "column": "rocker.angle", "at": { "driver": "pusher", "value": "5 deg" } },
    "d": { "column": "rocker.angle", "at": 5 },
    "e": { "column": "rocker.angle", "limits": ["-1 mm", "1 deg"] },
    "f": { "column": "rocker.angle", "limits": [1, -1] },
    "g": { "column": "rocker.angle", "limits": [0, 0] },
    "h": { "column": "rocker.angle", "limits": 1 },
    "i": { "column": "driver.motor.effort", "limits": ["-1 N", "1 N*m"] },
    "j": { "column": "rocker.angel", "limits": [-1, 1] },
    "k": { "column": "rocker.angle", "at": { "driver": "engine", "value": 5 } }
  } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 33, column 25: accuracy.pins: "wurst": unknown pins (did you mean "worst"?)"#,
            r#"line 33, column 44: accuracy.levels: "frist": unknown levels (did you mean "first"?)"#,
            r#"line 34, column 44: accuracy.outputs.a.at: "value" is missing (as in "value": "90 deg")"#,
            r#"line 35, column 44: accuracy.outputs.b.at: "driver" is missing, the model has 2 of them (name the driver whose value says the position)"#,
            r#"line 36, column 75: accuracy.outputs.c.at.value: "5 deg": "deg" is not a unit of length (such as "m")"#,
            r#"line 37, column 44: accuracy.outputs.d.at: 5: an object is expected, not a number (as in "at": { "driver": "motor", "value": "90 deg" })"#,
            r#"line 38, column 49: accuracy.outputs.e.limits[0]: "-1 mm": "mm" is not a unit of angle (such as "rad")"#,
            r#"line 39, column 48: accuracy.outputs.f.limits: the limits are the wrong way round (the lower deviation comes first, as in [-0.1, 0.1])"#,
            r#"line 40, column 48: accuracy.outputs.g.limits: between these limits there is nothing (as in [-0.1, 0.1])"#,
            r#"line 41, column 48: accuracy.outputs.h.limits: 1: a list is expected, not a number (as in "limits": ["-0.1 deg", "0.1 deg"])"#,
            r#"line 42, column 56: accuracy.outputs.i.limits[0]: "-1 N": "N" is not a unit of torque (such as "N*m")"#,
            r#"line 43, column 22: accuracy.outputs.j.column: "rocker.angel": no column of positions or forces is called so (as in "rocker.angle", "coupler.P.x", "joint.b.fx" or "driver.motor.effort")"#,
            r#"line 44, column 56: accuracy.outputs.k.at.driver: "engine": there is no driver "engine" (the drivers: motor, pusher)"#,
        ],
    },
    Case {
        what: "accuracy: sets beside tolerances",
        edits: &[
            (
                NAME,
                r#""parameters": { "a": "5 mm", "b": { "value": "=a", "tolerance": "1 mm" } }"#,
            ),
            ("0.8", r#""=b/1 m""#),
        ],
        sets: &[
            "parameters.a.tolerance=-1 mm",
            "parameters.b=3 parsec",
            "bodies.crank.points.A.tolerance=1 s",
            "joints.b.clearance.fit=20 H7/p6",
        ],
        complaints: &[
            r#"--set parameters.b=3 parsec: parameters.b.value: unknown unit "parsec" (an expression begins with =)"#,
            r#"--set parameters.a.tolerance=-1 mm: must not be negative (it goes to either side, or write [lower, upper])"#,
            r#"--set bodies.crank.points.A.tolerance=1 s: "s" is not a unit of length (such as "m")"#,
            r#"--set joints.b.clearance.fit=20 H7/p6: this fit can be tight: hole 0 to +21 µm, shaft +22 to +35 µm, clearance -35 to -1 µm (a pin that turns needs a clearance, as in "20 H7/g6")"#,
        ],
    },
];
