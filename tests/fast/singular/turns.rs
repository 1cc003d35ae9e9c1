//! Many passages.

use super::*;
use linkdyn_output::EventKind;

#[test]
fn every_passage_of_a_change_point_is_an_event() {
    let motion = json!({ "type": "harmonic", "offset": 1.0, "amplitude": 1.5, "frequency": 1.0, "phase": 0.0 });
    let mut model = parallelogram(1, false, 1.0, &motion);
    model["analysis"] = json!({ "type": "kinematics", "end": 2.0, "outputs": 2 });
    let run = outcome(&model);
    let times: Vec<f64> = run.report.events.iter().map(|e| e.time).collect();
    // 1 + 1.5 sin 2πt = 0
    let first = 0.5 + (1.0_f64 / 1.5).asin() / (2.0 * PI);
    let want = [first, 1.5 - first, 1.0 + first, 2.5 - first];
    assert_eq!(times.len(), 4, "{times:?}");
    for (time, want) in times.iter().zip(want) {
        assert!((time - want).abs() < 1e-9, "{times:?} {want}");
    }
}

#[test]
fn several_drivers_pass_change_points_in_time() {
    let motion = json!({ "type": "constant_acceleration", "start": PI / 3.0, "velocity": 0.0, "acceleration": 12.0 });
    let mut model = parallelogram(1, false, PI / 3.0, &motion);
    let other = json!({ "type": "polynomial", "coefficients": [0.7, 3.0, 0.7] });
    let second = parallelogram(1, true, 0.7, &other);
    for (name, body) in second["bodies"].as_object().expect("a map") {
        if name == "ground" {
            for (point, place) in body["points"].as_object().expect("a map") {
                model["bodies"]["ground"]["points"][format!("x{point}")] = place.clone();
            }
        } else {
            model["bodies"][format!("x{name}")] = body.clone();
        }
    }
    for (name, joint) in second["joints"].as_object().expect("a map") {
        let moved = |k: usize| {
            let text = joint["between"][k].as_str().expect("text");
            text.strip_prefix("ground.")
                .map_or_else(|| format!("x{text}"), |point| format!("ground.x{point}"))
        };
        model["joints"][format!("x{name}")] = pin(&moved(0), &moved(1));
    }
    model["drivers"]["second"] = json!({ "type": "rotation", "body": "xc0", "motion": other });
    let run = outcome(&model);
    let times: Vec<f64> = run.report.events.iter().map(|e| e.time).collect();
    let first = ((PI - PI / 3.0) / 6.0).sqrt();
    let third = ((2.0 * PI - PI / 3.0) / 6.0).sqrt();
    let second = (-3.0 + (9.0 + 2.8 * (PI - 0.7)).sqrt()) / 1.4;
    let mut want = [first, second, third];
    want.sort_by(f64::total_cmp);
    assert_eq!(times.len(), 3, "{times:?}");
    for (time, want) in times.iter().zip(want) {
        assert!((time - want).abs() < 1e-10, "{times:?} {want}");
    }
    for k in ["c1", "xc1", "xcm"] {
        let crank = if k == "c1" { "c0" } else { "xc0" };
        let pairs = column(&run, &format!("{k}.angle"))
            .into_iter()
            .zip(column(&run, &format!("{crank}.angle")));
        assert!(
            pairs.fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) < 1e-11,
            "{k}"
        );
    }
}

#[test]
fn many_turns_are_followed_by_one() {
    // 50 turns: the flat positions of every turn are events, the cranks stay parallel, and no outputs are needed between.
    let motion = json!({ "type": "constant_velocity", "start": 1.0, "velocity": 100.0 * PI });
    let mut model = parallelogram(2, true, 1.0, &motion);
    model["analysis"] = json!({ "type": "kinematics", "end": 1.0, "outputs": 301 });
    let run = outcome(&model);
    assert_eq!(run.report.status, Status::Completed);
    let flat = degrees(&run, EventKind::ChangePoint);
    assert_eq!(flat.len(), 100, "{:?}", &flat[..4]);
    for (k, value) in flat.iter().enumerate() {
        assert!(
            (value - 180.0 * (k + 1) as f64).abs() < 1e-7,
            "{k}: {value}"
        );
    }
    let (first, last) = (column(&run, "c0.angle"), column(&run, "c2.angle"));
    let worst = first
        .iter()
        .zip(&last)
        .fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    assert!(worst < 1e-11 && first[300] > 300.0, "{worst}");
    assert!(
        run.report.statistics.steps < 100,
        "{:?}",
        run.report.statistics
    );
}

#[test]
fn turns_that_do_not_come_back_are_followed_all_the_way() {
    // A crank that winds a second body up by a gear of ratio 1/3 comes back after three turns only.
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0], "Q": [0.3, 0.0] } },
                         "crank": rod(0.1, [0.0, 0.0], 0.0), "wheel": rod(0.1, [0.3, 0.0], 0.0) });
    let joints = json!({ "o": pin("ground.O", "crank.A"), "q": pin("ground.Q", "wheel.A"),
        "mesh": { "type": "gear", "between": ["crank.A", "wheel.A"], "ratio": -1.0 / 3.0, "angle": 0.0 } });
    let motor = json!({ "motor": { "type": "rotation", "body": "crank",
        "motion": { "type": "constant_velocity", "start": 0.0, "velocity": 100.0 } } });
    let run = outcome(&model(bodies, joints, motor));
    for (crank, wheel) in column(&run, "crank.angle")
        .iter()
        .zip(column(&run, "wheel.angle"))
    {
        assert!(
            (wheel + crank / 3.0).abs() < 1e-13 * crank.max(1.0),
            "{crank} {wheel}"
        );
    }
}
