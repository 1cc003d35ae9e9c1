//! Gradients of what follows from rows: transmission angles, shaking forces and applied loads against closed forms.

use super::{assert_met, family, gradient};
use linkdyn_engine::analysis::Family;
use linkdyn_model::Given;
use serde_json::json;

/// The angle of transmission by the law of cosines: cos μ = (b² + c² − (d − a)²)/2bc where crank and base lie in line.
#[test]
fn a_transmission_angle_has_the_slopes_of_the_law_of_cosines() {
    let sets = [
        "analysis.type=kinematics",
        "analysis.outputs=50",
        "analysis.transmission={\"output\":\"rocker\"}",
    ];
    let least = "min(transmission.c.angle)";
    let ratio = "at(transmission.ratio, driver.motor = 360 deg)";
    let names = ["base", "crank", "coupler", "rocker"];
    let family = family("four-bar", &sets, &[least, ratio], &names);
    assert!(family.is_tracked());
    for [d, a, b, c] in [[0.3, 0.1, 0.25, 0.2], [0.31, 0.09, 0.26, 0.21]] {
        let (values, found) = gradient(&family, &[d, a, b, c]);
        let cos = (b * b + c * c - (d - a).powi(2)) / (2.0 * b * c);
        let other = (b * b + c * c - (d + a).powi(2)) / (2.0 * b * c);
        assert!(
            cos > 0.0 && cos > -other,
            "the crank's near end has the least angle"
        );
        assert!((values[0] - cos.acos()).abs() < 1e-12, "{values:?}");
        let by = -1.0 / (1.0 - cos * cos).sqrt();
        let by_span = by * (a - d) / (b * c);
        let exact = [
            by_span,
            -by_span,
            by * (1.0 / c - cos / b),
            by * (1.0 / b - cos / c),
        ];
        assert_met(least, &found[..4], &exact);
        // In line, velocity ratio by the instant centre: ω₄/ω₂ = a/(a − d).
        assert!((values[1] - a / (a - d)).abs() < 1e-12, "{values:?}");
        let square = (a - d) * (a - d);
        assert_met(ratio, &found[4..], &[a / square, -d / square, 0.0, 0.0]);
    }
}

/// A mass m at c on a shaft shakes the ground with m c ω², in line with it.
#[test]
fn a_shaking_force_has_the_slopes_of_its_closed_form() {
    let mut model = json!({ "format": "linkdyn/1", "units": "SI",
        "parameters": { "m": "2 kg", "c": "0.3 m", "w": "7 rad/s", "push": "4 N" },
        "bodies": { "ground": { "points": { "O": [0.0, 0.0] } },
            "rotor": { "mass": "=m", "inertia": 0.01, "com": ["=c", 0.0], "points": { "O": [0.0, 0.0] } } },
        "joints": { "o": { "type": "revolute", "between": ["ground.O", "rotor.O"] } },
        "forces": { "p": { "type": "force", "at": "rotor.O", "vector": ["=push", 0.0], "frame": "body" } },
        "drivers": { "motor": { "type": "rotation", "body": "rotor",
            "motion": { "type": "constant_velocity", "start": -1.0, "velocity": "=w" } } },
        "analysis": { "type": "inverse_dynamics", "end": 0.5, "outputs": 23 } });
    let responses = json!({ "most": "max(shaking.fx)", "least": "min(shaking.fx)",
        "across": "at(shaking.fy, driver.motor = 0.5 rad)", "moment": "rms(shaking.moment)",
        "load": "at(force.p.fy, driver.motor = 0.5 rad)" });
    model["responses"] = responses;
    let loaded = linkdyn_model::load(model.to_string().as_bytes(), &[]).expect("sound");
    let family = Family::new(&loaded, &["m", "c", "w", "push"], Given::Values).expect("it runs");
    assert!(family.is_tracked());
    let [m, c, w, push] = [2.2, 0.28, 7.5, 3.0];
    let (values, found) = gradient(&family, &[m, c, w, push]);
    let largest = m * c * w * w;
    let sin = 0.5_f64.sin();
    // The load goes through the joint to the ground.
    let parts = |by: f64, own: f64| {
        [
            by * largest / m,
            by * largest / c,
            2.0 * by * largest / w,
            own,
        ]
    };
    assert!(
        (values[0] - largest - push).abs() < 1e-11 * largest,
        "{values:?}"
    );
    assert_met("most", &found[..4], &parts(1.0, 1.0));
    assert!(
        (values[2] - (largest + push) * sin).abs() < 1e-11 * largest,
        "{values:?}"
    );
    assert_met("across", &found[8..12], &parts(sin, sin));
    assert!((values[4] - push * sin).abs() < 1e-12, "{values:?}");
    assert_met("load", &found[16..], &[0.0, 0.0, 0.0, sin]);
}
