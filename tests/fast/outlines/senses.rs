//! What a restitution compares: with friction an impact may gain energy by Newton's and by Poisson's hypothesis, not by Stronge's.

use super::*;

/// A rod whose end falls on the ground, turning: seven numbers, then e and μ.
fn rod(reach: f64, start: [f64; 6], impact: Value) -> Value {
    let [inertia, y, angle, vx, vy, omega] = start;
    let pose = json!({ "position": [0.0, y], "angle": angle });
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "rod": { "mass": 1.0, "inertia": inertia, "com": [0.0, 0.0], "points": { "P": [reach, 0.0] }, "pose": pose } });
    let mut foot =
        json!({ "type": "contact", "between": ["ground.O", "rod.P"], "outline": floor() });
    join(&mut foot, impact);
    let mut model = model(bodies, json!({ "foot": foot }), json!({}));
    model["gravity"] = json!([0.0, -GRAVITY]);
    model["initial"] = json!({ "rod": { "x": 0.0, "y": y, "angle": angle, "vx": vx, "vy": vy, "angular_velocity": omega } });
    model["analysis"] = json!({ "type": "dynamics", "end": 0.02, "outputs": 3 });
    model
}

/// Restitution and friction of a contact.
fn impact(restitution: f64, mu: f64, sense: Option<&str>) -> Value {
    let friction = json!({ "law": "coulomb", "coefficient": mu, "threshold_velocity": 1e-3 });
    let mut impact = json!({ "restitution": restitution, "friction": friction });
    if let Some(sense) = sense {
        impact["sense"] = json!(sense);
    }
    impact
}

/// Energies that impacts have lost [J].
fn losses(run: &Outcome) -> Vec<f64> {
    let episodes = run.report.events.iter().filter_map(|event| event.episode);
    episodes.map(|episode| episode.energy_lost).collect()
}

/// Sliding stops and turns round in this one.
fn turning(sense: Option<&str>) -> Outcome {
    let start = [
        0.010_676_938_625_209_99,
        0.349_315_662_459_954_66,
        -0.901_033_325_888_284_3,
        -0.256_976_680_050_570_84,
        -0.604_537_832_863_564_9,
        -7.336_466_567_430_384,
    ];
    completed(&rod(
        0.444_297_853_326_215_1,
        start,
        impact(0.896, 1.124, sense),
    ))
}

#[test]
fn an_impact_that_gains_energy_is_told() {
    let told = |run: &Outcome| run.report.warnings.clone();
    let newton = turning(None);
    assert_eq!(
        told(&newton),
        [
            "joint \"foot\": the impact at t = 0.000380752 s gains 1.33 J, for its restitution compares velocities, which with friction \
             may; \"sense\": \"energetic\" in joints.foot never does"
        ]
    );
    assert_eq!(losses(&newton), losses(&turning(Some("kinematic"))));
    let poisson = turning(Some("kinetic"));
    assert!(losses(&poisson)[0] > losses(&newton)[0]);
    let stronge = turning(Some("energetic"));
    assert!(told(&stronge).is_empty() && losses(&stronge)[0] > 0.0);
}

/// Rods of all kinds, thrown in all ways.
#[test]
fn an_energetic_restitution_never_gains() {
    let mut seed = 5_u64;
    let mut number = |low: f64, high: f64| {
        seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        low + (high - low) * (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut impacts, mut gained) = (0, 0);
    for _ in 0..200 {
        let (reach, angle) = (number(0.1, 0.6), number(-2.8, -0.3));
        let gap = 1e-3;
        let start = [
            number(0.002, 0.1),
            gap - reach * f64::sin(angle),
            angle,
            number(-3.0, 3.0),
            number(-3.0, -0.5),
            number(-9.0, 9.0),
        ];
        let (restitution, mu) = (number(0.1, 1.0), number(0.05, 1.5));
        let run = |sense| completed(&rod(reach, start, impact(restitution, mu, sense)));
        let energetic = run(Some("energetic"));
        let lost = losses(&energetic);
        impacts += lost.len();
        assert!(lost.iter().all(|lost| *lost > -1e-9), "{start:?}: {lost:?}");
        let warnings = &energetic.report.warnings;
        assert!(
            !warnings.iter().any(|text| text.contains("gain")),
            "{warnings:?}"
        );
        gained += usize::from(losses(&run(None)).iter().any(|lost| *lost < -1e-9));
    }
    // The same rods do gain by Newton's hypothesis.
    assert!(
        impacts > 100 && gained > 2,
        "{impacts} impacts, {gained} runs"
    );
}
