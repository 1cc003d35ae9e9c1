//! Joints.

use super::{Case, GEAR};

pub const CASES: &[Case] = &[
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
            r#"line 20, column 10: joints.e: "type" is missing (one of "revolute", "prismatic", "slot", "gear", "rack", "rolling", "belt", "cam", "contact", "bushing", "beam" or "fixed")"#,
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
            r#"line 20, column 20: joints.e.type: "worm": unknown type (one of "revolute", "prismatic", "slot", "gear", "rack", "rolling", "belt", "cam", "contact", "bushing", "beam" or "fixed")"#,
        ],
    },
    Case {
        what: "type of another kind",
        edits: &[(r#""prismatic""#, "7")],
        sets: &[],
        complaints: &[
            r#"line 20, column 20: joints.e.type: 7: text is expected, not a number (one of "revolute", "prismatic", "slot", "gear", "rack", "rolling", "belt", "cam", "contact", "bushing", "beam" or "fixed")"#,
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
        what: "rack without radius",
        edits: &[],
        sets: &[
            r#"joints.g={ "type": "rack", "between": ["crank.O", "rocker.Q"], "axis": [1, 0] }"#,
        ],
        complaints: &[
            r#"--set joints.g={ "type": "rack", "between": ["crank.O", "rocker.Q"…: "radius" is missing (of the wheel, as in "radius": "20 mm"; negative where the line lies to the left of its centre, looking along the axis)"#,
        ],
    },
    Case {
        what: "rack of radius zero, with an axis of no direction and limits",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "rack", "between": ["crank.O", "rocker.Q"], "axis": [0, 0], "radius": 0, "limits": [0, 1] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 72: joints.g.axis: both components are zero, which is no direction"#,
            r#"line 21, column 90: joints.g.radius: 0: must not be zero"#,
            r#"line 21, column 93: joints.g.limits: "limits": the teeth have no end: give limits to the joint that guides the rack"#,
        ],
    },
    Case {
        what: "rack on its own wheel, with backlash",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "rack", "between": ["crank.O", "crank.A"], "axis": [1, 0], "radius": "20 mm", "backlash": "0.1 mm" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 39: joints.g.between: both points are of "crank" (a joint connects two bodies)"#,
            r#"line 21, column 98: joints.g.backlash: "backlash": a rack has none: its teeth touch on both sides"#,
        ],
    },
    Case {
        what: "rack whose radius is an angle",
        edits: &[],
        sets: &[
            r#"joints.g={ "type": "rack", "between": ["crank.O", "rocker.Q"], "axis": [1, 0], "radius": "20 deg" }"#,
        ],
        complaints: &[
            r#"--set joints.g={ "type": "rack", "between": ["crank.O", "rocker.Q"…: joints.g.radius: "deg" is not a unit of length (such as "m")"#,
        ],
    },
    Case {
        what: "rolling in a ring of the same size and in a smaller one, ring on ring, and of radius zero",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "rolling", "between": ["crank.O", "rocker.Q"], "radii": [20, -20] }"#,
        )],
        sets: &[
            r#"joints.i={ "type": "rolling", "between": ["crank.O", "rocker.Q"], "radii": [-80, -20] }"#,
            r#"joints.k={ "type": "rolling", "between": ["crank.O", "rocker.Q"], "radii": [80, -20] }"#,
            r#"joints.h={ "type": "rolling", "between": ["crank.O", "rocker.Q"], "radii": [20, 0] }"#,
        ],
        complaints: &[
            r#"line 21, column 76: joints.g.radii: a ring goes around what rolls in it: its negative radius is the larger one, and the other one is positive (as in "radii": ["-60 mm", "20 mm"])"#,
            r#"--set joints.h={ "type": "rolling", "between": ["crank.O", "rocker…: joints.h.radii[1]: must not be zero"#,
            r#"--set joints.i={ "type": "rolling", "between": ["crank.O", "rocker…: joints.i.radii: a ring goes around what rolls in it: its negative radius is the larger one, and the other one is positive (as in "radii": ["-60 mm", "20 mm"])"#,
            r#"--set joints.k={ "type": "rolling", "between": ["crank.O", "rocker…: joints.k.radii: a ring goes around what rolls in it: its negative radius is the larger one, and the other one is positive (as in "radii": ["-60 mm", "20 mm"])"#,
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
];
