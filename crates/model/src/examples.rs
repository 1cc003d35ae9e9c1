//! How to write each key whose value is more than a number: what complaints show where it is missing or of another kind.

/// How to write `units`.
pub(super) const UNITS: &str =
    r#""units": "SI", or name other units: {"length": "mm", "angle": "deg"}"#;

const MOTION: &str = r#""motion": { "type": "constant_velocity", "velocity": "60 rpm" }"#;

/// Keys and how to write them; what is to be said before that.
const EXAMPLES: [(&str, &str, &str); 49] = [
    ("format", "", r#""format": "linkdyn/1""#),
    ("units", "", UNITS),
    ("gravity", "", r#""gravity": [0, -9.81]"#),
    (
        "between",
        "the two ends, ",
        r#""between": ["ground.A", "crank.A"]"#,
    ),
    (
        "axis",
        "a direction in the first body, ",
        r#""axis": [1, 0]"#,
    ),
    (
        "ratio",
        "turns of the second wheel per turn of the first, ",
        r#""ratio": -2; negative for an external mesh"#,
    ),
    (
        "pose",
        "",
        r#""pose": { "position": [50, 0], "angle": "60 deg" }"#,
    ),
    ("position", "", r#""position": [50, 0]"#),
    ("com", "", r#""com": [50, 0]"#),
    ("motion", "", MOTION),
    ("coefficients", "", r#""coefficients": [0, "10 rad/s"]"#),
    ("amplitude", "", r#""amplitude": "30 deg""#),
    ("frequency", "", r#""frequency": "2 Hz""#),
    (
        "velocity",
        "",
        r#""velocity": "60 rpm", or "10 mm/s" of a slide"#,
    ),
    (
        "acceleration",
        "",
        r#""acceleration": "2 rad/s^2", or "10 mm/s^2" of a slide"#,
    ),
    ("duration", "", r#""duration": "0.2 s""#),
    (
        "segments",
        "",
        r#""segments": [{ "law": "cycloidal", "rise": "30 deg", "duration": "0.2 s" }, { "dwell": "0.1 s" }]"#,
    ),
    ("body", "the name of a body, ", r#""body": "crank""#),
    (
        "joint",
        "the name of a prismatic joint or a slot, ",
        r#""joint": "guide""#,
    ),
    ("at", "a point of a body, ", r#""at": "crank.A""#),
    ("vector", "", r#""vector": [0, -10]"#),
    ("value", "", r#""value": "5 N*m""#),
    (
        "clearance",
        "",
        r#""clearance": { "model": "massless_link", "radius": "0.1 mm" }"#,
    ),
    (
        "normal",
        "",
        r#""normal": { "law": "hunt_crossley", "stiffness": 1e9, "restitution": 0.9 }"#,
    ),
    (
        "friction",
        "",
        r#""friction": { "law": "coulomb", "coefficient": 0.1, "threshold_velocity": "1 mm/s" }"#,
    ),
    (
        "surface",
        "",
        r#""surface": { "stiffness": "1e8 N/m", "damping": "2e3 N*s/m" }"#,
    ),
    ("impact", "", r#""impact": { "restitution": 0.9 }"#),
    (
        "elastic",
        "",
        r#""elastic": { "young_modulus": "207 GPa", "poisson_ratio": 0.3 }"#,
    ),
    ("young_modulus", "", r#""young_modulus": "207 GPa""#),
    ("poisson_ratio", "", r#""poisson_ratio": 0.3"#),
    ("columns", "", r#""columns": ["crank.*", "joint.b.f?"]"#),
    (
        "sample",
        "",
        r#""sample": { "driver": "motor", "from": 0, "to": "360 deg", "step": "1 deg" }"#,
    ),
    ("driver", "the name of a driver, ", r#""driver": "motor""#),
    ("output", "the name of a body, ", r#""output": "rocker""#),
    ("solver", "", r#""solver": { "rtol": 1e-8 }"#),
    (
        "transmission",
        "",
        r#""transmission": { "output": "rocker" }"#,
    ),
    (
        "analysis",
        "",
        r#""analysis": { "type": "kinematics", "end": 1, "outputs": 101 }"#,
    ),
    (
        "bodies",
        "",
        r#""bodies": { "crank": { "points": { "A": [0, 0], "B": [50, 0] } } }"#,
    ),
    (
        "joints",
        "",
        r#""joints": { "a": { "type": "revolute", "between": ["ground.A", "crank.A"] } }"#,
    ),
    (
        "drivers",
        "",
        r#""drivers": { "motor": { "type": "rotation", "body": "crank", "motion": { … } } }"#,
    ),
    (
        "forces",
        "",
        r#""forces": { "load": { "type": "force", "at": "crank.A", "vector": [0, -10] } }"#,
    ),
    (
        "initial",
        "",
        r#""initial": { "crank": { "angle": "60 deg" } }"#,
    ),
    ("stiffness", "", r#""stiffness": "1e8 N/m""#),
    (
        "radial_stiffness",
        "",
        r#""radial_stiffness": "800 N/mm", or "radial_stiffness": ["800 N/mm", "200 N/mm"] along x and y of the first body"#,
    ),
    ("tolerance", "", r#""tolerance": "0.05 mm""#),
    ("fit", "", r#""fit": "20 H7/g6""#),
    ("column", "", r#""column": "rocker.angle""#),
    ("distance", "", r#""distance": ["ground.O", "coupler.P"]"#),
    ("limits", "", r#""limits": ["-0.1 deg", "0.1 deg"]"#),
];

/// The row of the key at the end of a path.
fn row(path: &str) -> Option<(&'static str, &'static str)> {
    let steps: Vec<&str> = path.split('.').collect();
    let key = *steps.last()?;
    match steps.as_slice() {
        // A name that somebody gave.
        [
            "bodies" | "joints" | "drivers" | "forces" | "initial" | "parameters",
            _,
        ] => None,
        ["responses", _, "value"] => Some(("", r#""value": "max(piston.x) - min(piston.x)""#)),
        ["responses", _, "limits"] => Some(("", r#""limits": [79, 81]"#)),
        ["outputs", ..] => Some((
            "",
            r#""outputs": { "leverage": "d(axle.y)/d(force.shock.length)" }"#,
        )),
        ["responses", ..] => Some((
            "",
            r#""responses": { "stroke": "max(piston.x) - min(piston.x)" }"#,
        )),
        ["joints", _, "radii"] => Some(("of both pulleys, ", r#""radii": ["30 mm", "60 mm"]"#)),
        ["joints", _, "radius"] => Some((
            "of the wheel, ",
            r#""radius": "20 mm"; negative where the line lies to the left of its centre, looking along the axis"#,
        )),
        ["parameters", _, "value"] => Some(("", r#""value": "5 mm""#)),
        ["study", "vary", ..] => Some(("", r#""vary": { "r": "40 mm:60 mm:21" }"#)),
        ["study"] => Some(("", r#""study": { "vary": { "r": "40 mm:60 mm:21" } }"#)),
        ["optimise"] => Some((
            "",
            r#""optimise": { "design": { "r": ["10 mm", "60 mm"] }, "constraints": ["stroke = 80 mm"] }"#,
        )),
        ["optimise", "design"] => Some(("", r#""design": { "r": ["10 mm", "60 mm"] }"#)),
        ["optimise", "objective"] => Some((
            "",
            r#""objective": { "minimise": "max(abs(driver.motor.effort))" }"#,
        )),
        ["optimise", "objective", _] => {
            Some(("", r#""minimise": "max(abs(driver.motor.effort))""#))
        }
        ["optimise", ..] if key.starts_with("constraints") => {
            Some(("", r#""constraints": ["stroke = 80 mm", "peak < 40 N*m"]"#))
        }
        ["optimise", "curve"] => Some((
            "",
            r#""curve": { "point": "coupler.P", "through": [[10, 40], [20, 45], [30, 40]] }"#,
        )),
        ["optimise", "curve", "point"] => Some(("", r#""point": "coupler.P""#)),
        ["optimise", "curve", key] if key.starts_with("through") => {
            Some(("", r#""through": [[10, 40], [20, 45], [30, 40]]"#))
        }
        ["optimise", "curve", "at"] => Some(("", r#""at": [0, "120 deg", "240 deg"]"#)),
        ["accuracy"] => Some((
            "",
            r#""accuracy": { "outputs": { "swing": { "column": "rocker.angle" } } }"#,
        )),
        ["accuracy", "outputs"] => Some((
            "",
            r#""outputs": { "swing": { "column": "rocker.angle" } }"#,
        )),
        ["accuracy", "outputs", _] => Some(("", r#""swing": { "column": "rocker.angle" }"#)),
        ["accuracy", .., "at"] => Some(("", r#""at": { "driver": "motor", "value": "90 deg" }"#)),
        ["accuracy", .., "at", "value"] => Some(("", r#""value": "90 deg""#)),
        ["bodies", _, "points", _, "tolerance"] => Some(("", r#""tolerance": "0.1 mm""#)),
        ["joints", _, "active" | "lock"] => Some(("", r#""lock": { "from": "time >= 1 s" }"#)),
        ["joints", _, _, "from" | "until"] => Some(("", r#""from": "door.angle >= 90 deg""#)),
        [.., "points", _] => Some(("", r#""A": [50, 0]"#)),
        ["points"] => Some(("", r#""points": ["coupler.P"]"#)),
        ["bodies", _, "points"] => Some(("", r#""points": { "A": [0, 0], "B": [50, 0] }"#)),
        [.., "points"] => Some(("", r#""points": [[0, 0], [1, "90 deg"]]"#)),
        // In SI with the law's exponent; only that of a linear law has a unit that can be written.
        [.., "normal", "stiffness"] => Some((
            "",
            r#""stiffness": 1e9, in N/m^exponent; only "kelvin_voigt" takes a unit"#,
        )),
        _ => EXAMPLES
            .iter()
            .find(|row| row.0 == key)
            .map(|row| (row.1, row.2)),
    }
}

/// How to write the value at a path, with its key.
pub(super) fn example(path: &str) -> Option<&'static str> {
    row(path).map(|(_, example)| example)
}

/// How to write a key of the object at a path where it is missing.
pub(super) fn of_missing(path: &str, key: &str) -> Option<String> {
    let (before, example) = row(&super::node::join(path, key))?;
    Some(match key {
        "format" | "units" => format!("write {example}"),
        _ => format!("{before}as in {example}"),
    })
}
