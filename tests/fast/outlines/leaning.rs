//! Statics on outlines: a body pushed against one rests on it, however small the outline is against the way behind it.

use crate::mechanisms::{column, completed, model, near, pin};
use linkdyn_engine::analysis::Control;
use serde_json::{Value, json};

const PUSH: f64 = 500.0;

/// A shoe about (20, −80) mm with a round tip at (95, 0) mm, pushed at (20, 80) mm by a force along x: N·80 = F·160 where the tip
/// touches straight ahead.
fn shoe(outline: Value, more: Value) -> Value {
    let bodies = json!({
        "ground": { "points": { "O": [0, 0], "P": [0.02, -0.08] } },
        "shoe": { "points": { "P": [0.02, -0.08], "Q": [0.095, 0], "E": [0.02, 0.08] } } });
    let mut lining = json!({ "type": "contact", "between": ["ground.O", "shoe.Q"], "radius": 0.005, "outline": outline });
    for (key, value) in more.as_object().expect("keys") {
        lining[key] = value.clone();
    }
    let joints = json!({ "pivot": pin("ground.P", "shoe.P"), "lining": lining });
    let mut model = model(bodies, joints, json!({}));
    model["gravity"] = json!([0, 0]);
    model["forces"] =
        json!({ "cylinder": { "type": "force", "at": "shoe.E", "vector": [PUSH, 0] } });
    model["analysis"] = json!({ "type": "statics" });
    model
}

fn ring(radius: f64) -> Value {
    json!([
        [radius, 0],
        [0, -radius, -radius],
        [-radius, 0, -radius],
        [0, radius, -radius],
        [radius, 0, -radius]
    ])
}

fn wall(x: f64, half: f64) -> Value {
    json!([[x, half], [x, -half]])
}

#[test]
fn a_shoe_rests_on_what_is_before_it() {
    for outline in [ring(0.1), wall(0.1, 0.1), wall(0.1, 0.02), wall(0.1, 0.3)] {
        let run = completed(&shoe(outline.clone(), json!({})));
        near(
            column(&run, "joint.lining.normal_force")[0],
            2.0 * PUSH,
            1e-6,
        );
        near(column(&run, "shoe.angle")[0], 0.0, 1e-9);
    }
}

#[test]
fn a_gap_is_closed_first() {
    // by x cos θ − y sin θ of the tip about the pivot
    let run = completed(&shoe(wall(0.1005, 0.1), json!({})));
    let theta = column(&run, "shoe.angle")[0];
    near(
        0.02 + 0.075 * theta.cos() - 0.08 * theta.sin() + 0.005,
        0.1005,
        1e-9,
    );
    let arm = 0.075 * theta.sin() + 0.08 * theta.cos();
    near(
        column(&run, "joint.lining.normal_force")[0],
        PUSH * 0.16 * theta.cos() / arm,
        1e-6,
    );
}

#[test]
fn an_outline_that_yields_is_met_alike() {
    let run = completed(&shoe(wall(0.1, 0.05), json!({ "stiffness": 1e6 })));
    let theta = column(&run, "shoe.angle")[0];
    let depth = 0.02 + 0.075 * theta.cos() - 0.08 * theta.sin() + 0.005 - 0.1;
    let arm = 0.075 * theta.sin() + 0.08 * theta.cos();
    near(1e6 * depth, PUSH * 0.16 * theta.cos() / arm, 1e-5);
}

/// The tip stands where the ring begins and ends, 1 mm deep.
#[test]
fn a_start_in_the_material_over_a_seam_is_refused() {
    let mut model = shoe(ring(0.1), json!({}));
    model["joints"]["lining"]["radius"] = json!(0.006);
    for analysis in ["statics", "dynamics"] {
        model["analysis"] = match analysis {
            "statics" => json!({ "type": "statics" }),
            _ => json!({ "type": "dynamics", "end": 1e-3, "outputs": 3 }),
        };
        model["bodies"]["shoe"]["mass"] = json!(1);
        model["bodies"]["shoe"]["inertia"] = json!(1);
        model["bodies"]["shoe"]["com"] = json!([0, 0]);
        let loaded = crate::mechanisms::loaded(&model);
        let refused = linkdyn_engine::analysis::run(&loaded.model, &Control::default());
        let said = refused.expect_err("it is in the material").to_string();
        assert!(
            said.contains("the mechanism starts with the tip 0.001 m deep in the outline"),
            "{said}"
        );
    }
}
