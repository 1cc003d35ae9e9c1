//! Where laws end, and what is refused.

use super::*;

fn complaints(model: &Value) -> String {
    let loaded = match load(model.to_string().as_bytes(), &[]) {
        Ok(loaded) => loaded,
        Err(complaints) => {
            return complaints
                .iter()
                .map(ToString::to_string)
                .collect::<Vec<_>>()
                .join("\n");
        }
    };
    let complaints = run(&loaded.model, &Control::default()).expect_err("bad input");
    complaints
        .iter()
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join("\n")
}

#[test]
fn a_start_in_the_wall_says_how_deep() {
    let start = |x: f64| {
        journal(
            lankarani(0.9),
            none(),
            json!({ "x": x, "y": 0.0 }),
            1e-4,
            2,
            1e-8,
        )
    };
    let said = complaints(&start(0.0125));
    assert!(
        said.contains("joint \"pin\" starts with its journal 0.0025 m deep"),
        "{said}"
    );
    assert!(
        said.contains("eccentricity 0.0125 m") && said.contains("clearance 0.01 m"),
        "{said}"
    );
    // A little is a contact like any other.
    let outcome = completed(&start(0.0101));
    assert!(column(&outcome, "joint.pin.normal_force")[0] > 0.0);
}

/// Beyond its range a law's force is made up: the run says so once, with the number; within it says nothing.
#[test]
fn a_run_says_that_it_left_the_range_of_a_law() {
    // Johnson's formula ends at 8 e⁻³ of the clearance.
    let range = 8.0 * (-3.0_f64).exp() * cylinders::CLEARANCE;
    for (speed, leaves) in [(0.5, false), (20.0, true)] {
        let start = json!({ "x": 0.0, "y": 0.0, "vx": speed, "vy": 0.0 });
        let outcome = completed(&cylinder("johnson", 0.9, 0.0, start, 0.002, 1e-8));
        let impacts = episodes(&outcome);
        let deepest = impacts
            .iter()
            .map(|episode| episode.peak_penetration)
            .fold(0.0, f64::max);
        assert!(
            !impacts.is_empty() && (deepest > range) == leaves,
            "{deepest:e} {range:e}"
        );
        let said: Vec<&String> = outcome
            .report
            .warnings
            .iter()
            .filter(|warning| warning.contains("normal law"))
            .collect();
        assert_eq!(said.len(), usize::from(leaves), "{said:?}");
        if let [said] = said[..] {
            let si = linkdyn_model::display::DisplayUnits::default();
            let numbers = [
                si.length_to(deepest, 4),
                si.length_to(range, 4),
                "\"pin\"".into(),
            ];
            assert!(numbers.iter().all(|number| said.contains(number)), "{said}");
        }
    }
}

#[test]
fn a_run_says_that_a_journal_sank_in() {
    // The journal's radius is 40 mm.
    for (stiffness, sinks) in [(1e8, false), (1e4, true)] {
        let start = json!({ "x": 0.0, "y": 0.0, "vx": 2.0, "vy": 0.0 });
        let outcome = completed(&journal(
            json!({ "law": "hertz", "stiffness": stiffness }),
            none(),
            start,
            0.1,
            3,
            1e-6,
        ));
        let deepest = episodes(&outcome)
            .iter()
            .map(|episode| episode.peak_penetration)
            .fold(0.0, f64::max);
        assert_eq!(deepest > 0.004, sinks, "{deepest:e}");
        let said = outcome
            .report
            .warnings
            .iter()
            .any(|said| said.contains("of the journal's radius"));
        assert_eq!(said, sinks, "{:?}", outcome.report.warnings);
    }
}

#[test]
fn bad_parameters_are_bad_input() {
    let start = || json!({});
    let with = |normal: Value, friction: Value| {
        complaints(&journal(normal, friction, start(), 1e-3, 2, 1e-8))
    };
    for (said, words) in [
        (with(lankarani(1.5), none()), "restitution"),
        (
            with(json!({ "law": "hertz", "stiffness": -1.0 }), none()),
            "stiffness",
        ),
        (
            with(
                json!({ "law": "hertz", "stiffness": 1e9, "exponent": 0.5 }),
                none(),
            ),
            "exponent",
        ),
        (
            with(
                lankarani(0.9),
                json!({ "law": "coulomb", "coefficient": -0.1, "threshold_velocity": 0.01 }),
            ),
            "coefficient",
        ),
        (
            with(
                lankarani(0.9),
                json!({ "law": "coulomb", "coefficient": 0.1, "threshold_velocity": 0.0 }),
            ),
            "threshold_velocity",
        ),
    ] {
        assert!(said.contains(words), "{words} is not in {said}");
    }
    let mut wide = journal(lankarani(0.9), none(), start(), 1e-3, 2, 1e-8);
    wide["joints"]["pin"]["clearance"]["bearing_radius"] = json!(0.01);
    assert!(
        complaints(&wide).contains("bearing_radius"),
        "{}",
        complaints(&wide)
    );
    let mut massless = journal(lankarani(0.9), none(), start(), 1e-3, 2, 1e-8);
    massless["bodies"]["disc"]["mass"] = json!(0.0);
    let said = complaints(&massless);
    assert!(said.contains("disc"), "{said}");
}
