//! Every bundled validation case agrees with its reference.

use linkdyn_engine::analysis::Control;
use linkdyn_validation::reference::Compare;
use linkdyn_validation::{CASES, CaseKind, Verdict};

#[test]
fn every_reference_case_agrees() {
    let mut faults = Vec::new();
    let mut cases = 0;
    for case in CASES {
        let CaseKind::Reference(_) = case.kind else {
            continue;
        };
        cases += 1;
        match case.run(None, &Control::default()) {
            Ok(report) => {
                assert!(
                    !report.claims.is_empty(),
                    "{}: nothing was compared",
                    case.name
                );
                let differing = report
                    .claims
                    .iter()
                    .filter(|claim| claim.verdict != Verdict::Agrees);
                faults.extend(differing.map(|claim| format!("{}: {claim:?}", case.name)));
            }
            Err(error) => faults.push(format!("{}: {error}", case.name)),
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(cases >= 17, "only {cases} reference cases are bundled");
}

#[test]
fn the_four_bar_with_a_spring_agrees() {
    let case = CASES
        .iter()
        .find(|case| case.name == "four-bar-spring")
        .expect("bundled");
    let report = case.run(None, &Control::default()).expect("runs");
    assert_eq!(report.claims.len(), 7);
    assert!(
        report
            .claims
            .iter()
            .all(|claim| claim.verdict == Verdict::Agrees),
        "{:#?}",
        report.claims
    );
}

#[test]
fn every_normal_law_delivers_what_it_must() {
    let case = CASES
        .iter()
        .find(|case| case.name == "restitution")
        .expect("bundled");
    let report = case.run(None, &Control::default()).expect("runs");
    assert_eq!(report.claims.len(), 25);
    let faults: Vec<_> = report
        .claims
        .iter()
        .filter(|claim| claim.verdict == Verdict::Fault)
        .collect();
    assert!(faults.is_empty(), "{faults:#?}");
    // Of the eight rules for the factor one returns what it is asked for.
    let found = report
        .claims
        .iter()
        .filter(|claim| claim.verdict == Verdict::Finding)
        .count();
    assert_eq!(found, 7);
}

#[test]
fn the_tolerance_ladder_has_no_fault() {
    let case = CASES
        .iter()
        .find(|case| case.name == "tolerance-ladder")
        .expect("bundled");
    let report = case.run(None, &Control::default()).expect("runs");
    assert_eq!(report.claims.len(), 15);
    let faults: Vec<_> = report
        .claims
        .iter()
        .filter(|claim| claim.verdict == Verdict::Fault)
        .collect();
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn the_slider_crank_with_clearance_agrees() {
    let case = CASES
        .iter()
        .find(|case| case.name == "slider-crank-clearance")
        .expect("bundled");
    let report = case.run(None, &Control::default()).expect("runs");
    assert_eq!(report.claims.len(), 19);
    let faults: Vec<_> = report
        .claims
        .iter()
        .filter(|claim| claim.verdict != Verdict::Agrees)
        .collect();
    assert!(faults.is_empty(), "{}\n{faults:#?}", report.text);
}

#[test]
fn the_journal_as_a_billiard_ball_agrees() {
    let case = CASES
        .iter()
        .find(|case| case.name == "journal-billiard")
        .expect("bundled");
    let report = case.run(None, &Control::default()).expect("runs");
    assert_eq!(report.claims.len(), 29);
    let faults: Vec<_> = report
        .claims
        .iter()
        .filter(|claim| claim.verdict != Verdict::Agrees)
        .collect();
    assert!(faults.is_empty(), "{}\n{faults:#?}", report.text);
}

#[test]
fn the_slider_crank_of_flores_has_no_fault() {
    let case = CASES
        .iter()
        .find(|case| case.name == "flores-slider-crank")
        .expect("bundled");
    let output = std::env::temp_dir().join(format!("linkdyn-flores-{}", std::process::id()));
    let report = case.run(Some(&output), &Control::default()).expect("runs");
    assert_eq!(report.claims.len(), 55);
    let faults: Vec<_> = report
        .claims
        .iter()
        .filter(|claim| claim.verdict == Verdict::Fault)
        .collect();
    assert!(faults.is_empty(), "{}\n{faults:#?}", report.text);
    let read = |name: &str| {
        std::fs::read_to_string(output.join("flores-slider-crank").join(name)).expect(name)
    };
    // Turns 10 to 60 at three clearances; the last five turns in 360 steps each.
    assert_eq!(read("poincare.csv").lines().count(), 1 + 3 * 51);
    for name in ["orbit-0.1mm", "orbit-0.2mm", "orbit-0.5mm"] {
        assert_eq!(
            read(&format!("{name}.csv")).lines().count(),
            1 + 5 * 360 + 1
        );
        assert!(
            read(&format!("{name}.svg")).contains("clearance circle"),
            "{name}"
        );
    }
    assert!(read("poincare.svg").matches("acceleration, c = 0.").count() == 3);
    std::fs::remove_dir_all(output).expect("removed");
}

/// A tolerance that anything meets would make agreement worthless.
#[test]
fn no_case_is_lax() {
    for case in CASES {
        let CaseKind::Reference(reference) = case.kind else {
            continue;
        };
        let words = reference.read().expect("valid words");
        let entries = words.comparisons();
        assert!(!entries.is_empty(), "{}", case.name);
        for Compare {
            column,
            tolerance_relative,
            tolerance_absolute,
            ..
        } in &entries
        {
            let sum = tolerance_relative + tolerance_absolute;
            assert!(
                sum <= 1e-5,
                "{}: {column} is compared to {sum:e} only",
                case.name
            );
        }
    }
}
