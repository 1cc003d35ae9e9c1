//! A model whose run lasts long enough to be interrupted.

/// A driven slider-crank and, beside it, a pendulum; long enough for everybody.
pub fn text(analysis: &str) -> String {
    let drivers = match analysis {
        "dynamics" => "",
        _ => {
            r#""drivers": {
            "motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "velocity": 6 } },
            "shaker": { "type": "rotation", "body": "bob",
                        "motion": { "type": "harmonic", "amplitude": 1, "frequency": 0.7 } } },"#
        }
    };
    format!(
        r#"{{ "format": "linkdyn/1", "name": "long", "units": "SI", "gravity": [0, -9.81],
        "bodies": {{ "ground": {{ "points": {{ "O": [0, 0], "Q": [2, 0] }} }},
            "crank": {{ "mass": 1, "inertia": 0.1, "com": [0, 0], "points": {{ "O": [0, 0], "A": [0.1, 0] }} }},
            "rod": {{ "mass": 1, "inertia": 0.01, "com": [0.2, 0], "points": {{ "A": [0, 0], "B": [0.4, 0] }}, "pose": {{ "position": [0.1, 0] }} }},
            "piston": {{ "mass": 1, "inertia": 0, "com": [0, 0], "points": {{ "B": [0, 0] }}, "pose": {{ "position": [0.5, 0] }} }},
            "bob": {{ "mass": 1, "inertia": 0, "com": [0.5, 0], "points": {{ "Q": [0, 0] }}, "pose": {{ "position": [2, 0] }} }} }},
        "joints": {{ "a": {{ "type": "revolute", "between": ["ground.O", "crank.O"] }},
            "b": {{ "type": "revolute", "between": ["crank.A", "rod.A"] }},
            "c": {{ "type": "revolute", "between": ["rod.B", "piston.B"] }},
            "d": {{ "type": "prismatic", "between": ["ground.O", "piston.B"], "axis": [1, 0] }},
            "q": {{ "type": "revolute", "between": ["ground.Q", "bob.Q"] }} }},
        {drivers}
        "analysis": {{ "type": "{analysis}", "end": 1e4, "outputs": 100001, "columns": ["piston.x", "bob.angle"] }} }}"#
    )
}
