//! One-way clutches.

use super::*;
use linkdyn_engine::analysis::{Control, run as solve};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The root of a function that falls through zero between two places.
fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// A torque T0 cos wt drives a rotor, which drives a load with a constant drag TL through a clutch:
///
/// ```text
/// together   (J1 + J2) ω̇ = T0 cos wt − TL          until J2 T0 cos wt + J1 TL = 0
/// apart      J1 ω̇1 = T0 cos wt,  J2 ω̇2 = −TL       until ω1 = ω2
/// ```
#[test]
fn a_clutch_locks_and_frees_where_it_should() {
    let ([j1, j2], t0, drag, w) = ([0.5_f64, 0.3], 2.0_f64, 0.4, 3.0_f64);
    let clutch = json!({ "one_way": "forward" });
    let mut model = shaft([j1, j2], [0.0, 0.0], &clutch, 3.0);
    model["forces"] = json!({
        "motor": { "type": "torque", "body": "rotor", "value": "=2 N*m*cos(3 rad/s*time)" },
        "drag": { "type": "torque", "body": "load", "value": -drag } });
    let run = completed(&model);
    let freed = (-drag * j1 / (j2 * t0)).acos() / w;
    let together = |t: f64| (t0 * (w * t).sin() / w - drag * t) / (j1 + j2);
    let top = together(freed);
    let rotor = |t: f64| top + t0 / (j1 * w) * ((w * t).sin() - (w * freed).sin());
    let load = |t: f64| top - drag / j2 * (t - freed);
    let locked = root(freed + 0.3, freed + 2.0, |t| load(t) - rotor(t));
    let met = episodes(&run);
    let (first, second) = (met[0].1, met[1].1);
    assert_eq!(met[0].0.stop, Some("one_way"));
    near(first.start, 0.0, 0.0);
    near(first.end.expect("it frees"), freed, 1e-9);
    near(second.start, locked, 1e-9);
    near(first.energy_lost, 0.0, 1e-12);
    near(second.energy_lost, 0.0, 1e-12);
    let of = |name: &str| column(&run, name);
    let (time, omegas, stop) = (
        of("time"),
        [of("rotor.omega"), of("load.omega")],
        of("joint.clutch.stop"),
    );
    let mut seen = [0; 3];
    for (k, &t) in time.iter().enumerate() {
        let (rotor, load, torque) = if t < freed {
            seen[0] += 1;
            let torque = (j2 * t0 * (w * t).cos() + j1 * drag) / (j1 + j2);
            (together(t), together(t), torque)
        } else if t < locked {
            seen[1] += 1;
            (rotor(t), load(t), 0.0)
        } else if second.end.is_none_or(|end| t < end) {
            seen[2] += 1;
            let both = together(t) - together(locked) + load(locked);
            let torque = (j2 * t0 * (w * t).cos() + j1 * drag) / (j1 + j2);
            (both, both, torque)
        } else {
            continue;
        };
        near(omegas[0][k], rotor, 1e-11);
        near(omegas[1][k], load, 1e-11);
        near(stop[k], torque, 1e-9);
    }
    assert!(seen.iter().all(|seen| *seen > 4), "{seen:?}");
}

/// A lever that a driver swings, −A cos wt, takes a drum along by a clutch; a backstop keeps the drum from turning back under its
/// drag TL. In each period it goes from rest with the lever, leaves it at sin wt1 … and coasts to rest:
///
/// ```text
/// A w² cos wt1 = −TL/J,   advance = A (1 − cos wt1) + (A w sin wt1)²/(2 TL/J)
/// ```
#[test]
fn an_oscillating_lever_turns_a_drum_one_way() {
    let (amplitude, w, inertia, drag) = (0.4_f64, 5.0_f64, 0.3, 1.8);
    let clutch = json!({ "one_way": "forward" });
    let mut model = shaft([inertia, 0.5], [0.0, 0.0], &clutch, 3.0 * TAU / w);
    // The drum turns on ground, and the lever on the drum.
    join(&mut model["joints"]["bearing"], &clutch);
    model["joints"]["clutch"]["between"] = json!(["load.O", "rotor.O"]);
    model["drivers"] = json!({ "swing": { "type": "rotation", "body": "load",
        "motion": { "type": "harmonic", "amplitude": amplitude, "frequency": w / TAU, "phase": -FRAC_PI_2 } } });
    model["initial"] = json!({ "rotor": { "angle": 0.0, "angular_velocity": 0.0 } });
    model["forces"] = json!({ "drag": { "type": "torque", "body": "rotor", "value": -drag } });
    model["analysis"]["outputs"] = json!(4);
    let run = completed(&model);
    let decline = drag / inertia;
    let leaves = (-decline / (amplitude * w * w)).acos();
    let speed = amplitude * w * leaves.sin();
    assert!(
        leaves + w * speed / decline < TAU,
        "it rests before the lever is back"
    );
    let advance = amplitude * (1.0 - leaves.cos()) + speed * speed / (2.0 * decline);
    let angle = column(&run, "rotor.angle");
    for (period, angle) in angle.iter().enumerate() {
        near(*angle, advance * period as f64, 1e-8);
    }
    let ends: Vec<f64> = episodes(&run)
        .iter()
        .filter(|(event, _)| event.joint.as_deref() == Some("clutch"))
        .filter_map(|(_, episode)| episode.end)
        .collect();
    near(ends[0], leaves / w, 1e-8);
    near(ends[1], (leaves + TAU) / w, 1e-8);
    assert!(PI / w < ends[0] + TAU / w);
}

/// What closes on a rotor that its backstop holds: against the backstop both come to rest, the other way it takes the rotor along.
#[test]
fn a_backstop_takes_its_share_of_impacts() {
    let (j1, j2) = (0.5, 0.3);
    for (omega, after) in [(-5.0, 0.0), (5.0, j2 * 5.0 / (j1 + j2))] {
        let lock = json!({ "lock": { "from": "time >= 0.5 s" } });
        let mut model = shaft([j1, j2], [0.0, omega], &lock, 1.0);
        model["joints"]["bearing"]["one_way"] = json!("forward");
        // It holds already.
        model["forces"] = json!({ "back": { "type": "torque", "body": "rotor", "value": "=-1 N*m*step(0.5 s - t)" } });
        let run = completed(&model);
        let last = |name: &str| *column(&run, name).last().expect("rows");
        near(last("rotor.omega"), after, 1e-11);
        near(last("load.omega"), after, 1e-11);
        let kinetic = 0.5 * j2 * omega * omega - 0.5 * (j1 + j2) * after * after;
        near(last("energy.dissipated"), kinetic, 1e-10);
        near(
            last("energy.kinetic"),
            0.5 * (j1 + j2) * after * after,
            1e-10,
        );
    }
}

/// Drivers that turn a joint against its clutch are told, and so is a start that does.
#[test]
fn turning_against_the_clutch_is_told() {
    let clutch = json!({ "one_way": "forward" });
    let mut model = shaft([0.5, 0.3], [0.0, 0.0], &clutch, 1.0);
    model["initial"] = json!({});
    model["drivers"] = json!({
        "a": { "type": "rotation", "body": "rotor", "motion": { "type": "constant_velocity", "velocity": 2.0 } },
        "b": { "type": "rotation", "body": "load", "motion": { "type": "constant_velocity", "velocity": 1.0 } } });
    model["analysis"] = json!({ "type": "kinematics", "end": 1.0, "outputs": 3 });
    let run = completed(&model);
    let said = "the drivers turn joint \"clutch\" the way that its one-way clutch holds, most at t = 0 s: a motion that is \
                prescribed does not stop there";
    assert_eq!(run.report.warnings, [said]);
    model["joints"]["clutch"]["one_way"] = json!("backward");
    assert!(completed(&model).report.warnings.is_empty());

    let model = shaft([0.5, 0.3], [2.0, 1.0], &clutch, 1.0);
    let said = solve(&loaded(&model).model, &Control::default());
    assert_eq!(
        said.expect_err("refused").to_string(),
        "joints.clutch.one_way: the mechanism starts with the joint turning the way that its clutch holds (turn the clutch \
         round, or give initial velocities the other way)"
    );
}
