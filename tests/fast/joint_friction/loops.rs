//! Closed loops: change points, both directions of dynamics, clearances beside friction.

use super::*;

#[test]
fn vanishing_friction_is_none_in_proportion() {
    let mut ideal = four_bar(0.0);
    for joint in ideal["joints"].as_object_mut().expect("a map").values_mut() {
        joint.as_object_mut().expect("a map").remove("friction");
    }
    let ideal = completed(&ideal);
    let off = |mu: f64| {
        let run = completed(&four_bar(mu));
        let pairs = column(&run, "driver.motor.effort")
            .into_iter()
            .zip(column(&ideal, "driver.motor.effort"));
        pairs.fold(0.0, |most: f64, (ours, without)| {
            most.max((ours - without).abs())
        })
    };
    let [full, half, quarter] = [4e-4, 2e-4, 1e-4].map(off);
    println!("{full:e} {half:e} {quarter:e}");
    assert!(
        quarter > 1e-6 && (full / half - 2.0).abs() < 1e-3 && (half / quarter - 2.0).abs() < 1e-3
    );
    assert!(off(0.0) < 1e-13);
    assert!(
        ideal
            .trajectory
            .columns
            .iter()
            .all(|column| !column.name.ends_with(".friction"))
    );
}

/// Free motion from a state of the driven one has its accelerations when its driver's effort acts as a torque.
#[test]
fn forward_and_inverse_dynamics_agree() {
    let mut driven = four_bar(0.2);
    driven["drivers"]["motor"]["motion"] =
        json!({ "type": "polynomial", "coefficients": ["60 deg", "10 rad/s", "-2 rad/s^2"] });
    let run = completed(&driven);
    let mut free = driven.clone();
    free.as_object_mut().expect("a map").remove("drivers");
    let effort = column(&run, "driver.motor.effort")[0];
    free["forces"]["motor"] =
        json!({ "type": "torque", "body": "crank", "value": format!("{effort:e} N*m") });
    free["initial"] = json!({ "crank": { "angle": "60 deg", "angular_velocity": "10 rad/s" } });
    free["analysis"] = dynamics(0.01, 2, 1e-9);
    let start = completed(&free);
    for name in [
        "crank.alpha",
        "rocker.alpha",
        "joint.b.fx",
        "joint.c.fy",
        "joint.b.friction",
        "joint.d.friction",
    ] {
        let (ours, theirs) = (column(&start, name)[0], column(&run, name)[0]);
        assert!(
            (ours - theirs).abs() < 1e-9 * theirs.abs().max(1.0),
            "{name}: {ours} {theirs}"
        );
    }
}

/// Through change points: what exists is there, and power balances.
#[test]
fn a_parallelogram_passes_its_change_point() {
    let motion = json!({ "type": "polynomial", "coefficients": [0.5, 4.0] });
    for joint in ["o0", "p0"] {
        let mut model = parallelogram(1, false, 0.5, &motion);
        model["joints"][joint]["friction"] = coulomb(0.05, 1e-3);
        model["joints"][joint]["pin_radius"] = json!(0.004);
        model["analysis"] = json!({ "type": "inverse_dynamics", "end": 1.5, "outputs": 151 });
        let run = outcome(&model);
        let quality = &run.report.quality;
        println!(
            "{joint}: {:?} {quality:?} {:?} {:?}",
            run.report.status, run.report.events, run.report.warnings
        );
        assert!(
            quality.power_imbalance.expect("forces") < 1e-9,
            "{quality:?}"
        );
        let efforts = column(&run, "driver.motor.effort");
        assert!(
            efforts.iter().filter(|effort| effort.is_finite()).count() >= 149,
            "{efforts:?}"
        );
    }
}

/// Free motion through a change point is not without doubt, and says so; with much friction it locks there.
#[test]
fn free_motion_through_a_change_point_is_told() {
    let free = |mu: f64| {
        let mut model = parallelogram(1, false, 0.5, &json!(null));
        model.as_object_mut().expect("a map").remove("drivers");
        model["gravity"] = json!([0.0, 0.0]);
        for joint in model["joints"].as_object_mut().expect("a map").values_mut() {
            joint["friction"] = coulomb(mu, 1e-3);
            joint["pin_radius"] = json!(0.005);
        }
        model["initial"] = json!({ "c0": { "angle": 0.5, "angular_velocity": 10.0 } });
        model["analysis"] = dynamics(0.5, 501, 1e-8);
        outcome(&model)
    };
    let run = free(1e-6);
    assert_eq!(
        run.report.status,
        Status::Completed,
        "{:?}",
        run.report.message
    );
    assert!(
        run.report
            .warnings
            .iter()
            .any(|warning| warning.contains("passes a change point")),
        "{:?}",
        run.report
    );
    let run = free(0.3);
    println!(
        "{:?} {:?} {:?}",
        run.report.status, run.report.message, run.report.warnings
    );
    let message = run.report.message.expect("why it ended");
    assert!(message.contains("locks itself"), "{message}");
}

/// A clearance that rattles beside a pin that rubs: the energy ledger holds both.
#[test]
fn contacts_and_friction_share_the_ledger() {
    let mut model = pendulum(-0.2, 0.02, &coulomb(0.2, 0.01));
    model["bodies"]["tip"] = rod(0.5, [0.98, -0.2], -0.3);
    model["joints"]["b"] = pin("bar.B", "tip.A");
    model["joints"]["b"]["clearance"] = json!({ "model": "contact", "radius": 0.001, "normal": {
        "law": "lankarani_nikravesh", "stiffness": 1e7, "exponent": 1.5, "restitution": 0.7 } });
    model["initial"]["tip"] = json!({ "angle": -0.9 });
    model["analysis"] = dynamics(0.5, 51, 1e-8);
    let run = outcome(&model);
    assert_eq!(
        run.report.status,
        Status::Completed,
        "{:?}",
        run.report.message
    );
    let quality = &run.report.quality;
    println!("{quality:?}");
    assert!(
        quality.energy_imbalance.expect("a ledger") < 1e-6,
        "{quality:?}"
    );
    assert!(
        column(&run, "joint.o.friction")
            .iter()
            .any(|friction| friction.abs() > 0.02)
    );
}

/// Friction beside a massless clearance link: the link follows the force that friction has changed.
#[test]
fn friction_and_clearance_links_share_the_fixed_point() {
    let mut model = four_bar(0.2);
    model["joints"]["c"] = json!({ "type": "revolute", "between": model["joints"]["c"]["between"],
        "clearance": { "model": "massless_link", "radius": "0.1 mm" } });
    let run = outcome(&model);
    assert_eq!(
        run.report.status,
        Status::Completed,
        "{:?}",
        run.report.message
    );
    for row in 0..run.trajectory.len() {
        let [ex, ey, fx, fy] =
            ["ex", "ey", "fx", "fy"].map(|name| column(&run, &format!("joint.c.{name}"))[row]);
        close(ex.hypot(ey), 1e-4, 1e-16);
        close((ex * fy - ey * fx) / fx.hypot(fy), 0.0, 1e-9);
    }
    assert!(
        run.report.quality.power_imbalance.expect("forces") < 1e-9,
        "{:?}",
        run.report.quality
    );
}
