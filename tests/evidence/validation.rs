//! Every bundled validation case agrees with its reference.

use linkdyn_engine::analysis::Control;
use linkdyn_validation::reference::Compare;
use linkdyn_validation::{CASES, CaseKind, CaseReport, Verdict};
use std::path::Path;

/// The cases that are programs, each run by a test of its own here or in `lock`.
const CODED: [&str; 13] = [
    "lock",
    "lock-contact",
    "four-bar-spring",
    "path-synthesis",
    "restitution",
    "tolerance-ladder",
    "slider-crank-clearance",
    "flores-slider-crank",
    "journal-billiard",
    "beams",
    "elastic-links",
    "elastic-clearance",
    "lock-elastic",
];

/// Runs a case of [`CODED`].
#[track_caller]
pub fn run(name: &str, output: Option<&Path>) -> CaseReport {
    assert!(CODED.contains(&name), "{name} is not in the list");
    let case = CASES.iter().find(|case| case.name == name);
    let case = case.unwrap_or_else(|| panic!("{name} is not bundled"));
    case.run(output, &Control::default())
        .unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn every_coded_case_has_a_test() {
    let coded = CASES
        .iter()
        .filter(|case| matches!(case.kind, CaseKind::Coded { .. }));
    let names: Vec<&str> = coded.map(|case| case.name).collect();
    assert_eq!(names, CODED);
}

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
fn the_published_path_is_passed() {
    let report = run("path-synthesis", None);
    assert_eq!(report.claims.len(), 5);
    let differing: Vec<_> = report
        .claims
        .iter()
        .filter(|claim| claim.verdict != Verdict::Agrees)
        .collect();
    assert!(differing.is_empty(), "{differing:#?}");
}

#[test]
fn the_four_bar_with_a_spring_agrees() {
    let report = run("four-bar-spring", None);
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
    let report = run("restitution", None);
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
        .filter(|claim| claim.verdict.reason().is_some())
        .count();
    assert_eq!(found, 7);
}

#[test]
fn the_tolerance_ladder_has_no_fault() {
    let report = run("tolerance-ladder", None);
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
    let report = run("slider-crank-clearance", None);
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
    let report = run("journal-billiard", None);
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
    let output = std::env::temp_dir().join(format!("linkdyn-flores-{}", std::process::id()));
    let report = run("flores-slider-crank", Some(&output));
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

#[test]
fn chains_of_beams_are_the_beams_of_the_literature() {
    let report = run("beams", None);
    assert_eq!(report.claims.len(), 56);
    let claims = report.claims.iter();
    let off: Vec<_> = claims
        .filter(|claim| claim.verdict != Verdict::Agrees)
        .collect();
    assert!(off.is_empty(), "{off:#?}");
}

#[test]
fn elastic_links_are_those_of_the_literature() {
    for (name, claims) in [
        ("elastic-links", 66),
        ("elastic-clearance", 6),
        ("lock-elastic", 8),
    ] {
        let report = run(name, None);
        assert_eq!(report.claims.len(), claims, "{name}");
        let off = report.claims.iter();
        let off: Vec<_> = off
            .filter(|claim| claim.verdict != Verdict::Agrees)
            .collect();
        assert!(off.is_empty(), "{name}: {off:#?}");
    }
}
