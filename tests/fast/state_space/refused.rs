//! What can't be linearised, and why; and what is said of what can.

use super::*;

#[track_caller]
fn says(model: &Value, question: &StateSpaceQuestion, known: &str) {
    assert_eq!(refused(model, question), known);
}

#[test]
fn inputs_that_are_none_are_told() {
    let model = cart_pole();
    for (inputs, said) in [
        (
            &["driver.bellt"][..],
            "input \"driver.bellt\": there is no driver \"bellt\" (did you mean \"belt\"?)",
        ),
        (
            &["input.u"],
            "input \"input.u\": there is no input \"u\", the model has none",
        ),
        (
            &["force.wind"],
            "input \"force.wind\": there is no force \"wind\", the model has none",
        ),
        (
            &["pole.X.fx"],
            "input \"pole.X.fx\": there is no point of \"pole\" called \"X\" (there are: P, T)",
        ),
        (
            &["wheel.torque"],
            "input \"wheel.torque\": there is no body \"wheel\" (there are: cart, pole)",
        ),
        (
            &["ground.torque"],
            "input \"ground.torque\": the ground does not move",
        ),
        (
            &["belt"],
            "input \"belt\": inputs are called driver.NAME, driver.NAME.acceleration, input.NAME, force.NAME, BODY.POINT.fx, BODY.POINT.fy or BODY.torque",
        ),
        (
            &["pole.torque", "pole.torque"],
            "input \"pole.torque\": it is an input already",
        ),
        (
            &["driver.belt", "driver.belt.acceleration"],
            "input \"driver.belt.acceleration\": its driver is an input already, \"driver.belt.effort\"",
        ),
    ] {
        says(&model, &question(inputs, &[]), said);
    }
    let mut pushed = model;
    pushed["forces"] = json!({ "wind": { "type": "force", "at": "pole.T", "vector": [0.0, 0.0] } });
    says(
        &pushed,
        &question(&["force.wind"], &[]),
        "input \"force.wind\": the force is zero at this point and has no direction (push the point itself, BODY.POINT.fx or .fy)",
    );
}

#[test]
fn outputs_that_are_none_are_told() {
    let model = cart_pole();
    for (output, said) in [
        (
            "pole.angel",
            "output \"pole.angel\": no column is called so (did you mean \"pole.angle\"?)",
        ),
        (
            "q*",
            "output \"q*\": no column is called so (names are those of results.csv, without units)",
        ),
    ] {
        says(&model, &question(&["driver.belt"], &[output]), said);
    }
}

#[test]
fn points_that_are_none_are_told() {
    let model = cart_pole();
    let at = |times: &[f64]| StateSpaceQuestion {
        at: times.to_vec(),
        ..question(&["driver.belt"], &[])
    };
    says(
        &model,
        &at(&[0.5, 1.5]),
        "at 1.5 s: the motion is known from 0 to 1 s",
    );
    says(
        &model,
        &at(&[f64::NAN]),
        "at – s: the motion is known from 0 to 1 s",
    );
    let mut still = model.clone();
    still["analysis"] = json!({ "type": "statics" });
    let hint = "use \"kinematics\", \"inverse_dynamics\" or \"dynamics\", or linearise about rest";
    says(
        &still,
        &at(&[0.0]),
        &format!("analysis: this analysis has no motion to linearise along ({hint})"),
    );
    still.as_object_mut().expect("a model").remove("analysis");
    says(
        &still,
        &at(&[0.0]),
        &format!(
            "analysis: the model has no analysis, and so no motion to linearise along ({hint})"
        ),
    );
    let held = slider_crank(
        0.1,
        0.3,
        0.6,
        false,
        &json!({ "type": "polynomial", "coefficients": [0.6, 4.0] }),
    );
    says(
        &held,
        &question(&["slider.B.fx"], &[]),
        "nothing is free to move, and there are no states; drivers and joints hold everything (let a driver go: the input driver.NAME)",
    );
    // Two drivers at one crank: neither moves alone.
    let mut shared = held;
    shared["drivers"]["other"] = json!({ "type": "translation", "joint": "g",
        "motion": { "type": "polynomial", "coefficients": [slider_position(0.1, 0.3, 0.6)] } });
    shared["drivers"]["motor"]["motion"]["coefficients"] = json!([0.6]);
    says(
        &shared,
        &question(&["driver.motor"], &[]),
        "input \"driver.motor\": the driver shares its motion with others, or with redundant joints, and can't move alone (leave out the others)",
    );
}

/// A mass that lies on a stop by its weight: what is held is said, and at rest friction is left out.
#[test]
fn contacts_of_the_point_are_told() {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "mass": { "mass": 2.5, "inertia": 1.0, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] },
                  "pose": { "position": [0.0, 0.3] } } });
    let guide = json!({ "type": "prismatic", "between": ["ground.O", "mass.P"], "axis": [0.0, 1.0],
        "limits": [0.1, 0.5], "stiffness": 1e4, "damping": 300.0 });
    let mut model = model(bodies, json!({ "g": guide }), json!({}));
    model["analysis"] = json!({ "type": "dynamics", "end": 3.0, "outputs": 4 });
    let found = linear(&model, &["mass.P.fy"], &["mass.y", "joint.g.stop"]);
    assert_eq!(found.phases, ["the lower stop of joint \"g\" presses"]);
    let stiffness: f64 = 1e4;
    near(found.a[1][0], -stiffness / 2.5, 1e-8);
    // The stop gets shorter by F/k, and carries F more.
    let gain = found.gain.expect("it holds");
    near(gain[0][0], 1.0 / stiffness, 1e-15);
    near(gain[1][0].abs(), 1.0, 1e-10);
    let moving = moving(&model, &["mass.P.fy"], &["mass.y", "joint.g.stop"], 3.0);
    assert_eq!(
        moving.phases,
        ["the lower stop of joint \"g\" is in contact"]
    );
}
