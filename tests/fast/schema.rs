//! The published schema agrees with the loader: what one accepts, so does the other.

use serde_json::{Value, json};

/// The example of the format's description.
const EXAMPLE: &str = r#"{
  "format": "linkdyn/1",
  "name": "Four-bar with a worn pin",
  "about": "what this is, for whom", "source": "who measured or published it",
  "units": { "length": "mm", "angle": "deg", "inertia": "kg*mm^2" },
  "gravity": [0, -9.81],
  "bodies": {
    "ground":  { "points": { "O2": [0, 0], "O4": [300, 0] } },
    "crank":   { "mass": 0.8, "inertia": 700, "com": [50, 0],
                 "points": { "O2": [0, 0], "A": [100, 0] },
                 "pose": { "position": [0, 0], "angle": 60 }, "note": "centre of mass assumed at mid-length" },
    "coupler": { "mass": 1.9, "inertia": 9000, "com": [125, 20],
                 "points": { "A": [0, 0], "B": [250, 0], "P": [125, 80] },
                 "pose": { "position": [50, 87], "angle": 20 } },
    "rocker":  { "mass": 1.5, "inertia": 5000, "com": [100, 0],
                 "points": { "O4": [0, 0], "B": [200, 0] },
                 "pose": { "position": [300, 0], "angle": 90 } }
  },
  "joints": {
    "a": { "type": "revolute", "between": ["ground.O2", "crank.O2"] },
    "b": { "type": "revolute", "between": ["crank.A", "coupler.A"],
           "clearance": { "model": "massless_link", "radius": 0.1 } },
    "c": { "type": "revolute", "between": ["coupler.B", "rocker.B"] },
    "d": { "type": "revolute", "between": ["ground.O4", "rocker.O4"] }
  },
  "drivers": {
    "motor": { "type": "rotation", "body": "crank",
               "motion": { "type": "polynomial", "coefficients": [60, "10 rad/s"] } }
  },
  "forces": {
    "return": { "type": "spring", "between": ["ground.O4", "coupler.P"],
                "stiffness": 200, "damping": 1.0, "free_length": 150 }
  },
  "initial": { "crank": { "angle": 60 } },
  "points": ["coupler.P"],
  "analysis": { "type": "inverse_dynamics", "end": 2.0, "outputs": 401 }
}
"#;

fn minimal(extra: &Value) -> Value {
    let mut model = json!({
        "format": "linkdyn/1", "units": "SI",
        "bodies": {
            "ground": { "points": { "O": [0, 0] } },
            "bar": { "points": { "O": [0, 0], "A": ["10 cm", "-1e-2 ft"] } },
            "block": { "mass": 0, "points": { "C": [0, 0] } }
        },
        "joints": {
            "pin": { "type": "revolute", "between": ["ground.O", "bar.O"] },
            "slide": { "type": "prismatic", "between": ["bar.O", "block.C"], "axis": [1, 0], "angle": "5 deg" },
            "weld": { "type": "fixed", "between": ["bar.O", "block.C"] },
            "slot": { "type": "slot", "between": ["bar.O", "block.C"], "axis": [0, -2] }
        }
    });
    for (key, value) in extra.as_object().into_iter().flatten() {
        model[key] = value.clone();
    }
    model
}

fn motion(motion: &Value) -> Value {
    json!({ "drivers": {
        "turn": { "type": "rotation", "body": "bar", "relative_to": "ground", "motion": motion },
    }})
}

fn clearance(clearance: &Value) -> Value {
    json!({ "joints": { "pin": { "type": "revolute", "between": ["ground.O", "bar.O"], "clearance": clearance } } })
}

/// Clearances of each model.
fn clearances() -> Vec<Value> {
    vec![
        minimal(&clearance(&json!({ "model": "ideal" }))),
        minimal(&clearance(
            &json!({ "model": "massless_link", "radius": 0 }),
        )),
        minimal(&clearance(&json!({
            "model": "contact", "radius": "0.5 mm", "bearing_radius": "10 mm",
            "normal": { "law": "lankarani_nikravesh", "restitution": 0.9,
                        "elastic": { "young_modulus": "207 GPa", "poisson_ratio": 0.3 } },
            "friction": { "law": "coulomb", "coefficient": 0.03, "threshold_velocity": 0.01 },
            "surface": { "stiffness": 1e8, "damping": 2e3 },
            "impact": { "restitution": 0.9, "friction": 0.03 }
        }))),
        minimal(&clearance(&json!({
            "model": "contact", "radius": "0.5 mm", "bearing_radius": "10 mm", "axial_length": "15 mm",
            "normal": { "law": "pereira", "restitution": 0.9, "elastic": {
                "bearing": { "young_modulus": "207 GPa", "poisson_ratio": 0.3 },
                "journal": { "young_modulus": 7e10, "poisson_ratio": 0.33, "note": "aluminium" } } },
            "friction": { "law": "lugre", "coefficient": 0.03, "static_coefficient": 0.05, "stribeck_velocity": "1 mm/s",
                          "bristle_stiffness": 1e5, "bristle_damping": 300, "viscous": 0.4 }
        }))),
    ]
}

/// All words of tolerances and of accuracy.
fn toleranced() -> Value {
    minimal(&json!({
        "parameters": {
            "a": { "value": "5 mm", "tolerance": "0.1 mm", "distribution": "normal", "sigma": 4, "cost": "1 mm", "note": "x" },
            "b": { "value": "=2*a", "tolerance": ["-1 %", "=a/100"], "distribution": "uniform" },
            "c": { "value": 3, "tolerance": 0.1, "distribution": "triangular" },
            "d": { "value": "=a + b + c*1 m", "cost": "=a" }
        },
        "bodies": {
            "ground": { "points": { "O": { "position": [0, "=d"], "tolerance": "0.1 mm", "note": "x" } } },
            "bar": { "points": { "O": [0, 0], "A": { "position": ["10 cm", 0] } } },
            "block": { "points": { "C": [0, 0] } }
        },
        "joints": {
            "pin": { "type": "revolute", "between": ["ground.O", "bar.O"],
                     "clearance": { "model": "ideal", "radius": ["5 um", 1e-5] } },
            "fitted": { "type": "revolute", "between": ["ground.O", "bar.A"],
                        "clearance": { "model": "ideal", "fit": "20 H7/g6" } },
            "slide": { "type": "prismatic", "between": ["bar.O", "block.C"], "axis": [1, 0], "play": "10 um" },
            "slot": { "type": "slot", "between": ["bar.O", "block.C"], "axis": [0, -2], "play": [0, "10 um"] }
        },
        "drivers": { "turn": { "type": "rotation", "body": "bar", "tolerance": "0.1 deg",
                               "motion": { "type": "polynomial", "coefficients": [0] } } },
        "accuracy": { "pins": "disc", "levels": "first", "outputs": {
            "height": { "column": "bar.A.y", "at": { "driver": "turn", "value": "5 deg" }, "limits": ["-1 mm", 1] },
            "gap": { "distance": ["ground.O", "block.C"], "note": "x" }
        } }
    }))
}

fn rises() -> Vec<Value> {
    vec![
        minimal(&motion(
            &json!({ "type": "cycloidal", "rise": "30 deg", "duration": "0.2 s" }),
        )),
        minimal(&motion(
            &json!({ "type": "modified_sine", "start": 1, "end": 0, "begin": "1 ms", "duration": 1 }),
        )),
        minimal(&motion(
            &json!({ "type": "trapezoidal_velocity", "rise": 1, "velocity": "60 rpm", "acceleration": 9 }),
        )),
        minimal(&motion(
            &json!({ "type": "s_curve", "rise": 1, "duration": 1, "ramp": 0.2, "rounding": 1 }),
        )),
        minimal(&motion(
            &json!({ "type": "s_curve", "rise": 1, "velocity": 1, "acceleration": 2, "jerk": "1 rad/s^3" }),
        )),
        minimal(&motion(
            &json!({ "type": "sequence", "repeat": 4, "segments": [
            { "law": "polynomial_4_5_6_7", "rise": 1, "duration": 1 }, { "dwell": 1, "note": "weld" }] }),
        )),
        minimal(&motion(
            &json!({ "type": "table", "interpolation": "monotone", "points": [[0, 0], [1, 1]] }),
        )),
    ]
}

fn good() -> Vec<Value> {
    let mut models = vec![
        serde_json::from_str(EXAMPLE).unwrap(),
        minimal(&json!({})),
        minimal(
            &json!({ "units": { "length": "mm", "angular_stiffness": "N*mm/deg", "note": "x" }, "note": "y" }),
        ),
        minimal(&motion(
            &json!({ "type": "polynomial", "coefficients": [0, "10 rad/s", "2 rad/s^2", 0, "1 deg/s^4"] }),
        )),
        minimal(&motion(
            &json!({ "type": "harmonic", "amplitude": "5 deg", "frequency": "2 Hz" }),
        )),
        minimal(&motion(
            &json!({ "type": "table", "points": [[0, 0], ["1 min", "1 rev"]] }),
        )),
        minimal(&motion(
            &json!({ "type": "constant_velocity", "start": 0, "velocity": "300 rpm" }),
        )),
        minimal(&motion(
            &json!({ "type": "constant_acceleration", "start": 0, "velocity": 1, "acceleration": "1 deg/s²" }),
        )),
        minimal(
            &json!({ "drivers": { "push": { "type": "translation", "joint": "slide",
            "motion": { "type": "constant_velocity", "velocity": "5 mm/s", "note": "slow" } } } }),
        ),
        minimal(&json!({ "forces": {
            "damper": { "type": "spring", "between": ["ground.O", "bar.A"], "damping": "3 N*s/m" },
            "coil": { "type": "torsion_spring", "between": ["ground", "bar"], "stiffness": "3 N*m", "free_angle": 0.1 },
            "push": { "type": "force", "at": "bar.A", "vector": ["1 kgf", 0], "frame": "body" },
            "turn": { "type": "torque", "body": "bar", "relative_to": "ground",
                      "value": { "type": "harmonic", "offset": "1 N*mm", "amplitude": 2, "frequency": 1 } }
        } })),
        minimal(
            &json!({ "initial": { "bar": { "x": 0, "y": "1 mm", "angle": 1, "vx": 0, "vy": 0, "angular_velocity": 1 } } }),
        ),
        minimal(&json!({ "analysis": { "type": "assembly" } })),
        minimal(&json!({ "parameters": {} })),
        minimal(&json!({
            "parameters": { "note": "sizes", "g": "9.81 m/s^2", "i": "= -j/2", "j": 4, "n": "=10*j+1" },
            "gravity": [0, "=-g"],
            "bodies": { "ground": { "points": { "O": [0, 0] } }, "bar": { "points": { "O": ["=j", "= 2 mm"] } } },
            "joints": { "slot": { "type": "slot", "between": ["ground.O", "bar.O"], "axis": ["=i", 1] } },
            "analysis": { "type": "kinematics", "end": "=1 s", "outputs": "=n", "solver": { "rtol": "=10^-6" } }
        })),
        minimal(
            &json!({ "analysis": { "type": "dynamics", "end": "500 ms", "outputs": 11, "columns": ["bar.*"],
            "solver": { "method": "auto", "rtol": 1e-6, "atol": 1e-9, "max_step": "1 ms", "initial_step": 1e-6,
                        "max_wall_time": "2 min" } } }),
        ),
    ];
    models.extend(rises());
    models.extend(clearances());
    models.push(toleranced());
    models[1]["bodies"]["note"] = json!("a remark, not a body");
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        if entry
            .path()
            .extension()
            .is_some_and(|extension| extension == "json")
        {
            models.push(
                serde_json::from_str(&std::fs::read_to_string(entry.path()).unwrap()).unwrap(),
            );
        }
    }
    models
}

#[test]
fn good_models_satisfy_schema_and_loader() {
    let schema = linkdyn_model::schema();
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );
    let validator = jsonschema::validator_for(&schema).unwrap();
    for model in good() {
        if let Err(error) = validator.validate(&model) {
            panic!("{}: {error}\n{model:#}", error.instance_path());
        }
        if let Err(complaints) = linkdyn_model::load(model.to_string().as_bytes(), &[]) {
            panic!("{}\n{model:#}", complaints[0]);
        }
    }
}

#[test]
fn bad_structure_satisfies_neither() {
    let validator = jsonschema::validator_for(&linkdyn_model::schema()).unwrap();
    let bad = [
        json!({ "format": "linkdyn/2" }),
        json!({ "units": { "lenght": "mm" } }),
        json!({ "units": "si" }),
        json!({ "parameters": [] }),
        json!({ "parameters": { "a-b": 1 } }),
        json!({ "parameters": { "a": "1" } }),
        json!({ "parameters": { "a": null } }),
        json!({ "parameters": { "a": { "value": 1, "tolerance": "0.1" } } }),
        json!({ "parameters": { "a": { "value": 1, "tolerance": [1] } } }),
        json!({ "parameters": { "a": { "value": 1, "tolerance": 1, "distribution": "gauss" } } }),
        json!({ "parameters": { "a": { "value": 1, "tolerance": 1, "sigma": 0 } } }),
        json!({ "parameters": { "a": { "tolerance": 1 } } }),
        json!({ "bodies": { "bar": { "points": { "A": { "tolerance": 1 } } } } }),
        json!({ "bodies": { "bar": { "points": { "A": { "position": [0, 0], "tolerance": -1 } } } } }),
        clearance(&json!({ "model": "ideal", "radius": [0] })),
        clearance(&json!({ "model": "ideal", "radius": [0, -1] })),
        clearance(&json!({ "model": "ideal", "radius": 0, "fit": "20 H7/g6" })),
        json!({ "accuracy": { "pins": "wurst" } }),
        json!({ "accuracy": { "levels": "second" } }),
        json!({ "accuracy": { "outputs": { "a": {} } } }),
        json!({ "accuracy": { "outputs": { "a": { "column": "bar.x", "distance": ["bar.A", "ground.O"] } } } }),
        json!({ "accuracy": { "outputs": { "a": { "column": "bar.x", "at": { "driver": "turn" } } } } }),
        json!({ "accuracy": { "outputs": { "a": { "column": "bar.x", "limits": 1 } } } }),
        json!({ "joints": { "mesh": { "type": "gear", "between": ["ground.O", "bar.O"], "ratio": "2" } } }),
        json!({ "gravity": [0] }),
        json!({ "gravity": [0, "9.81"] }),
        json!({ "gravity": [0, null] }),
        json!({ "bodies": {} }),
        json!({ "bodies": { "ground": { "mass": 1 } } }),
        json!({ "bodies": { "bar": { "mass": -1 } } }),
        json!({ "bodies": { "b.r": {} } }),
        json!({ "bodies": { "bar": { "note": 5 } } }),
        json!({ "joints": { "pin": { "type": "revolut", "between": ["ground.O", "bar.O"] } } }),
        json!({ "joints": { "pin": { "between": ["ground.O", "bar.O"] } } }),
        json!({ "joints": { "pin": { "type": "revolute", "between": ["ground.O", "bar"] } } }),
        json!({ "joints": { "pin": { "type": "fixed", "between": ["ground.O", "bar.O"], "clearance": { "model": "ideal" } } } }),
        json!({ "joints": { "pin": { "type": "prismatic", "between": ["ground.O", "bar.O"], "axis": [0, 0] } } }),
        json!({ "joints": { "pin": { "type": "slot", "between": ["ground.O", "bar.O"], "axis": [0, 0] } } }),
        json!({ "joints": { "pin": { "type": "slot", "between": ["ground.O", "bar.O"], "axis": [1, 0], "angle": 0 } } }),
        json!({ "joints": { "mesh": { "type": "gear", "between": ["ground.O", "bar.O"] } } }),
        json!({ "joints": { "mesh": { "type": "gear", "between": ["ground.O", "bar.O"], "ratio": 0 } } }),
        json!({ "joints": { "mesh": { "type": "gear", "between": ["ground.O", "bar.O"], "ratio": "1 deg" } } }),
        json!({ "joints": { "mesh": { "type": "rack", "between": ["ground.O", "bar.O"], "axis": [1, 0], "radius": 0 } } }),
        json!({ "joints": { "mesh": { "type": "rack", "between": ["ground.O", "bar.O"], "radius": 1 } } }),
        json!({ "joints": { "belt": { "type": "belt", "between": ["ground.O", "bar.O"], "radii": [1] } } }),
        json!({ "joints": { "b": { "type": "bushing", "between": ["ground.O", "bar.O"], "radial_stiffness": [1] } } }),
        json!({ "joints": { "b": { "type": "bushing", "between": ["ground.O", "bar.O"], "radial_stiffness": 0 } } }),
        json!({ "joints": { "b": { "type": "bushing", "between": ["ground.O", "bar.O"], "stiffness": 1 } } }),
        json!({ "drivers": { "oil": { "type": "length", "motion": { "type": "polynomial", "coefficients": [1] } } } }),
        json!({ "joints": { "belt": { "type": "belt", "between": ["ground.O", "bar.O"], "radii": [1, 1], "strands": "twisted" } } }),
        json!({ "forces": { "s": { "type": "spring", "between": ["ground.O", "bar.A"], "free_length": 1 } } }),
        motion(&json!({ "type": "polynomial", "coefficients": [] })),
        motion(&json!({ "type": "table", "points": [[0, 0], [1, 2, 3]] })),
        motion(&json!({ "type": "table", "interpolation": "cubic", "points": [[0, 0], [1, 2]] })),
        motion(&json!({ "type": "cycloidal", "duration": 1 })),
        motion(&json!({ "type": "cycloidal", "rise": 1, "end": 1, "duration": 1 })),
        motion(&json!({ "type": "cycloidal", "rise": 1, "duration": 0 })),
        motion(&json!({ "type": "s_curve", "rise": 1, "duration": 1, "velocity": 1 })),
        motion(&json!({ "type": "sequence", "segments": [{ "rise": 1 }] })),
        motion(&json!({ "type": "sequence", "segments": [{ "dwell": 1, "law": "cycloidal" }] })),
        clearance(&json!({ "model": "sloppy" })),
        clearance(&json!({ "model": "ideal", "normal": { "law": "hertz", "restitution": 2 } })),
        json!({ "analysis": { "type": "statics", "outputs": 1.5 } }),
        json!({ "analysis": { "type": "statics", "end": 0 } }),
        json!({ "analysis": { "type": "statics", "transmission": { "driver": "d" } } }),
        json!({ "analysis": { "type": "statics", "columns": [1] } }),
    ];
    for extra in bad {
        let model = minimal(&extra);
        assert!(!validator.is_valid(&model), "the schema accepts {extra}");
        assert!(
            linkdyn_model::load(model.to_string().as_bytes(), &[]).is_err(),
            "the loader accepts {extra}"
        );
    }
}

#[test]
fn every_key_of_a_clearance_says_what_it_is() {
    let schema = linkdyn_model::schema();
    for name in [
        "Clearance",
        "Normal",
        "Friction",
        "Surface",
        "Impact",
        "Material",
    ] {
        for (key, property) in schema["$defs"][name]["properties"].as_object().unwrap() {
            let said = property.get("description").is_some() || property.get("$ref").is_some();
            assert!(said, "{name}.{key}");
        }
    }
}
