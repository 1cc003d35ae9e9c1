//! About rest: next to modes and statics.

use super::*;
use crate::models;
use linkdyn_engine::analysis::modes;

/// All bundled mechanisms that have modes have them as poles.
#[test]
fn poles_are_those_of_modes() {
    let mut compared = 0;
    for name in [
        "pendulum",
        "double-pendulum",
        "four-bar-spring",
        "bicycle-suspension",
        "double-wishbone",
        "solar-array",
        "excavator",
        "toggle-clamp",
    ] {
        for sets in [&[][..], &["drivers={}"]] {
            let model = models::checked(&models::load_bundled(name, sets));
            let control = Control::default();
            let Ok(found) = modes(&model, false, &control) else {
                continue;
            };
            if found.modes.is_empty() {
                continue;
            }
            let own = state_space(&model, &StateSpaceQuestion::default(), &control);
            let own = own
                .unwrap_or_else(|said| panic!("{name}: {said:?}"))
                .remove(0);
            let mut poles: Vec<[f64; 2]> = found.modes.iter().map(|mode| mode.eigenvalue).collect();
            // A mode that moves freely is a pair of poles.
            let free = poles.iter().filter(|pole| **pole == [0.0; 2]).count();
            poles.splice(0..0, vec![[0.0; 2]; free]);
            assert_eq!(
                own.poles.len(),
                poles.len(),
                "{name}: {:?} {poles:?}",
                own.poles
            );
            for (pole, mode) in own.poles.iter().zip(&poles) {
                let off = (pole[0] - mode[0]).hypot(pole[1] - mode[1]);
                let size = mode[0].hypot(mode[1]);
                println!("{name}: {pole:?} {mode:?} {:e}", off / size);
                assert!(
                    off <= 1e-12 * size,
                    "{name}: {pole:?} {mode:?} {:e}",
                    off / size
                );
            }
            compared += 1;
        }
    }
    assert!(compared >= 6, "{compared}");
}

/// G(0) is the slope of statics by a torque.
#[test]
fn the_static_gain_is_the_slope_of_statics() {
    let mut model: Value = serde_json::from_str(
        linkdyn_model::bundled::find("four-bar-spring")
            .expect("bundled")
            .text,
    )
    .expect("JSON");
    model["forces"]["motor"] = json!({ "type": "torque", "body": "left", "value": 0.5 });
    model["points"] = json!(["coupler.C"]);
    let columns = ["left.angle", "coupler.C.x", "joint.c.fx", "joint.a.fx"];
    let found = linear(&model, &["force.motor"], &columns);
    let gain = found.gain.expect("it is stable");
    let at = |torque: f64| {
        let mut model = model.clone();
        model["forces"]["motor"]["value"] = json!(0.5 + torque);
        let run = completed(&model);
        columns.map(|name| column(&run, name)[0])
    };
    // Order eight, so that no digit is lost to the curvature.
    let h = 0.05;
    let pairs = [1.0, 2.0, 3.0, 4.0].map(|k| (at(k * h), at(-k * h)));
    for (row, name) in columns.iter().enumerate() {
        let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
        let parts = weights.iter().zip(&pairs);
        let slope: f64 = parts
            .map(|(w, (ahead, behind))| w * (ahead[row] - behind[row]) / h)
            .sum();
        let off = (gain[row][0] / slope - 1.0).abs();
        println!("{name}: {slope} {off:e}");
        assert!(off <= 1e-10, "{name}: {} {slope} {off:e}", gain[row][0]);
    }
}
