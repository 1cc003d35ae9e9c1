//! Elastic links: struts, starts, warnings, and what follows from the rows of results. `validation/elastic-links` has their digits.

use crate::mechanisms::*;
use serde_json::{Value, json};

/// EI of the bars below [N·m²].
const BENDING: f64 = 2e11 * 0.02 * 0.01 * 0.01 * 0.01 / 12.0;

fn rectangle() -> Value {
    json!({ "type": "rectangle", "width": 0.02, "height": 0.01 })
}

/// A bar of 1 m from O to T with M in its middle.
fn bar(more: &Value) -> Value {
    let mut elastic = json!({ "from": "O", "to": "T", "section": rectangle(), "young_modulus": 2e11, "density": 7850.0 });
    for (key, value) in more.as_object().into_iter().flatten() {
        elastic[key] = value.clone();
    }
    json!({ "points": { "O": [0.0, 0.0], "M": [0.5, 0.0], "T": [1.0, 0.0] }, "elastic": elastic })
}

/// P L/4 · tan(u)/u and P L³/48 EI · 3 (tan u − u)/u³, u = π/2 √(N/N_E) (Timoshenko and Gere, Theory of Elastic Stability, 1961, sec. 1.3).
#[test]
fn a_strut_bends_as_struts_do() {
    let half = std::f64::consts::FRAC_PI_2;
    let (push, load) = (0.5 * (2.0 * half).powi(2) * BENDING, 1e-3);
    let mut strut = bar(&json!({ "modes": 4 }));
    let mut cut = rectangle();
    for (key, value) in [("from", "O"), ("to", "T")] {
        cut[key] = json!(value);
    }
    strut["section"] = cut;
    let model = json!({ "format": "linkdyn/1", "units": "SI",
        "bodies": { "ground": { "points": { "O": [0.0, 0.0], "T": [1.0, 0.0] } }, "bar": strut },
        "joints": { "a": { "type": "revolute", "between": ["ground.O", "bar.O"] },
            "b": { "type": "slot", "between": ["ground.T", "bar.T"], "axis": [1.0, 0.0] } },
        "forces": { "load": { "type": "force", "at": "bar.M", "vector": [0.0, load] },
            "push": { "type": "force", "at": "bar.T", "vector": [-push, 0.0] } },
        "points": ["bar.M"], "analysis": { "type": "statics" } });
    let run = completed(&model);
    let u = half * 0.5_f64.sqrt();
    let moment = load / 4.0 * u.tan() / u;
    let deflection = load / (48.0 * BENDING) * 3.0 * (u.tan() - u) / u.powi(3);
    close(
        column(&run, "section.bar.bending_moment")[0],
        moment,
        1e-4 * moment,
    );
    close(column(&run, "bar.M.y")[0], deflection, 1e-4 * deflection);
    let imbalance = run.report.quality.section_imbalance.expect("known");
    assert!(imbalance < 1e-12, "{imbalance}");
}

/// ω² of a pinned bar under a push falls in proportion to it, to nothing at Euler's load: between plain pins, too, whose end comes closer.
#[test]
fn a_push_lowers_the_frequency_of_a_bar_between_pins() {
    let euler = std::f64::consts::PI.powi(2) * BENDING;
    let lowest = |push: f64| {
        let model = json!({ "format": "linkdyn/1", "units": "SI",
            "bodies": { "ground": { "points": { "O": [0.0, 0.0], "T": [1.0, 0.0] } }, "bar": bar(&json!({ "modes": 1 })),
                "slider": { "mass": 0.0, "inertia": 0.0, "points": { "T": [0.0, 0.0] }, "pose": { "position": [1.0, 0.0] } } },
            "joints": { "a": { "type": "revolute", "between": ["ground.O", "bar.O"] },
                "b": { "type": "revolute", "between": ["bar.T", "slider.T"] },
                "c": { "type": "prismatic", "between": ["ground.T", "slider.T"], "axis": [1.0, 0.0] } },
            "forces": { "push": { "type": "force", "at": "slider.T", "vector": [-push, 0.0] } },
            "analysis": { "type": "dynamics", "end": 1.0, "outputs": 2 } });
        let model = linkdyn_model::load(model.to_string().as_bytes(), &[])
            .expect("sound")
            .model;
        let found = linkdyn_engine::analysis::modes(&model, false, &Default::default());
        found.expect("modes").modes[0].frequency()
    };
    let free = lowest(0.0);
    let known = std::f64::consts::PI * (euler / (7850.0 * 0.02 * 0.01)).sqrt();
    close(free, known, 1e-9 * free);
    close(lowest(0.75 * euler), 0.5 * free, 1e-9 * free);
}

/// A crank, drawn a little off, that starts at full speed with a chain for its rod: nothing is strained at the start.
#[test]
fn chains_start_straight_and_without_a_blow() {
    for how in [json!({ "elements": 8 }), json!({ "modes": 2 })] {
        let mut rod = bar(&how);
        rod["pose"] = json!({ "position": [0.21, 0.01] });
        let model = json!({ "format": "linkdyn/1", "units": "SI",
            "bodies": { "ground": { "points": { "O": [0.0, 0.0] } },
                "crank": { "mass": 1.0, "inertia": 0.01, "com": [0.0, 0.0], "points": { "O": [0.0, 0.0], "A": [0.2, 0.0] } },
                "bar": rod,
                "slider": { "mass": 1.0, "inertia": 0.0, "com": [0.0, 0.0], "points": { "B": [0.0, 0.0] }, "pose": { "position": [1.2, 0.0] } } },
            "joints": { "main": { "type": "revolute", "between": ["ground.O", "crank.O"] },
                "pin": { "type": "revolute", "between": ["crank.A", "bar.O"] },
                "wrist": { "type": "revolute", "between": ["bar.T", "slider.B"] },
                "guide": { "type": "prismatic", "between": ["ground.O", "slider.B"], "axis": [1.0, 0.0] } },
            "drivers": { "motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "start": 0.5, "velocity": 10.0 } } },
            "analysis": { "type": "dynamics", "end": 1e-3, "outputs": 2 } });
        let run = completed(&model);
        // The force of the rigid rod is some 30 N; a chain that is stretched by 1e-3 would pull with 4e4 N.
        let [x, y] = ["fx", "fy"].map(|axis| column(&run, &format!("joint.wrist.{axis}"))[0]);
        assert!(x.hypot(y) < 300.0, "{how}: {x} {y}");
        let strain = column(&run, "energy.potential")[0];
        assert!(strain.abs() < 1e-9, "{how}: {strain}");
    }
}

/// What leaves the range of few modes is said; shaking forces follow from the rows, in which mass points have no columns.
#[test]
fn what_bends_far_is_told() {
    let model = |load: f64| {
        json!({ "format": "linkdyn/1", "units": "SI",
            "bodies": { "ground": { "points": { "O": [0.0, 0.0] } }, "bar": bar(&json!({ "frame": "tangent", "damping": 0.1 })) },
            "joints": { "clamp": { "type": "fixed", "between": ["ground.O", "bar.O"] } },
            "forces": { "load": { "type": "force", "at": "bar.T", "vector": [0.0, load] } },
            "analysis": { "type": "dynamics", "end": 0.1, "outputs": 11 },
            "responses": { "shaking": { "value": "max(abs(shaking.fy))" } } })
    };
    // w/L = P L²/3 EI, and twice that where the load is sudden.
    let far = completed(&model(0.45 * BENDING));
    let said = &far.report.warnings;
    assert!(
        said.iter()
            .any(|said| said.contains("where few modes describe it no more")),
        "{said:?}"
    );
    let near = completed(&model(1e-3 * BENDING));
    assert!(
        near.report.warnings.is_empty(),
        "{:?}",
        near.report.warnings
    );
    let shaking = near.responses[0].value.expect("a value");
    let reaction = column(&near, "joint.clamp.fy");
    let largest = reaction
        .iter()
        .fold(0.0, |most: f64, own| most.max(own.abs()));
    close(shaking, largest, 1e-9 * largest);
}
