//! Bundled models whose journals are rigid.

use linkdyn_engine::analysis::{Control, Outcome, run};

/// A bundled model with journals that are rigid.
pub fn rigid(
    model: &str,
    joints: &[&str],
    radius: &str,
    restitution: f64,
    friction: f64,
    sets: &[&str],
) -> Outcome {
    let text = linkdyn_model::bundled::find(model).expect("bundled").text;
    let clearance = |joint: &&str| {
        format!(
            r#"joints.{joint}.clearance={{ "model": "three_state", "radius": "{radius}", "bearing_radius": "10 mm",
                "impact": {{ "restitution": {restitution}, "friction": {friction} }} }}"#
        )
    };
    let sets: Vec<String> = joints
        .iter()
        .map(clearance)
        .chain(sets.iter().map(|set| set.to_string()))
        .collect();
    let model = linkdyn_model::load(text.as_bytes(), &sets)
        .expect("a model")
        .model;
    run(&model, &Control::default()).expect("good input")
}
