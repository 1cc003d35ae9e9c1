//! Values that `--set` gives.

use super::Case;

pub const CASES: &[Case] = &[
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
];
