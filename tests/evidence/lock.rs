//! The founding paper's case through the library: no fault, all claims, all files.

use std::fs;
use std::path::Path;

use crate::validation::run;
use linkdyn_validation::{CASES, Verdict};

/// How each stroke ends, and at which angle.
fn expect_strokes(strokes: &str) {
    // Two clearances at three tolerances, seven single hinges, a header.
    assert_eq!(strokes.lines().count(), 1 + 2 * 3 + 7);
    for line in strokes.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [last, theta2, ideal, between]: [f64; 4] =
            [5, 6, 7, 8].map(|cell| cells[cell].parse().expect("a number"));
        match (cells[0], cells[4]) {
            // The independent angle at the end of the stroke, on the other side of the change point.
            (_, "smooth") => {
                assert_eq!((cells[3], last), ("completed", 125.0), "{line}");
                assert!(
                    (ideal - 196.503).abs() < 1e-3
                        && (theta2 - ideal).abs() < 1.0
                        && between > 190.0,
                    "{line}"
                );
            }
            // The first loop is ideal, and in line: 117.512207 deg by independent calculation, outputs are 0.1 deg apart.
            ("d" | "e" | "f", "stops in line") => {
                assert!(
                    (last - 117.512_207).abs() <= 0.2 && (between - 180.0).abs() <= 1.0,
                    "{line}"
                );
            }
            _ => panic!("{line}"),
        }
    }
}

/// A figure of the strokes with contact: all its rows, all its curves, and its place in the report.
fn expect_contact_figure(figure: usize, read: &dyn Fn(&str) -> String) {
    let text = read(&format!("figure{figure}.csv"));
    assert_eq!(
        text.lines().count(),
        1 + 1751,
        "-50 to 125 deg every 0.1 deg"
    );
    assert!(
        !text.contains("NaN") && !text.contains("inf"),
        "figure {figure}"
    );
    let svg = read(&format!("figure{figure}.svg"));
    for part in [
        ", massless",
        ", contact",
        "e = 100 µm",
        "change point 117.51°",
    ] {
        assert!(svg.contains(part), "figure {figure}: {part}");
    }
    assert!(
        read("report.md").contains(&format!("figure{figure}.svg")),
        "figure {figure} is not in the report"
    );
}

/// With contact in the clearances: strokes follow the smooth branch, and what must hold holds.
#[test]
fn the_lock_with_contact_is_validated_and_written() {
    let output = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join(format!("validation-lock-contact-{}", std::process::id()));
    let report = run("lock-contact", Some(&output));
    for claim in &report.claims {
        assert_ne!(claim.verdict, Verdict::Fault, "{claim:?}");
    }
    let names: Vec<&str> = report
        .claims
        .iter()
        .filter_map(|claim| claim.what.split_once(':'))
        .map(|c| c.0)
        .collect();
    assert_eq!(names[names.len() - 5..], ["C2", "C3", "C4", "C5", "C6"]);
    for name in &names[names.len() - 5..] {
        let claim = report
            .claims
            .iter()
            .find(|claim| claim.what.starts_with(name))
            .expect(name);
        assert!(
            ["reproduced:", "partly:", "not:"]
                .iter()
                .any(|word| claim.ours.starts_with(word)),
            "{claim:?}"
        );
    }
    let agrees = |start: &str| {
        let claim = report
            .claims
            .iter()
            .find(|claim| claim.what.starts_with(start))
            .expect(start);
        assert_eq!(claim.verdict, Verdict::Agrees, "{claim:?}");
    };
    agrees("theta2 at 125 deg");
    agrees("mean difference of theta2");
    agrees("numbers of the paper's table");
    let widest = report
        .text
        .lines()
        .max_by_key(|line| line.chars().count())
        .expect("lines");
    assert!(widest.chars().count() <= 120, "{widest}");

    let folder = output.join("lock-contact");
    let read = |name: &str| fs::read_to_string(folder.join(name)).expect(name);
    expect_strokes(&read("strokes.csv"));
    // Two parts of the stroke, five quantities, two clearances, max and mean, four steps.
    assert_eq!(read("table.csv").lines().count(), 1 + 2 * 5 * 2 * 2 * 4);
    for figure in 4..=8 {
        expect_contact_figure(figure, &read);
    }
    fs::remove_dir_all(output).expect("removed");
}

/// The map of F12 over the centres of mass, against Newton and Euler on the paper's loops (`validation/generate/lock_centres.py`):
/// θ6 of the least |F12|, turn of its direction and change of the vector near −40° by their medians.
fn expect_map(text: &str) {
    let rows: Vec<Vec<&str>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    assert_eq!(rows.len(), 49);
    for (link3, link4, expected, abrupt) in [
        ("mean", "mean", [-8.9, 0.209, 3.597], "no"),
        ("l3", "mean", [-44.1, 13.927, 1.743], "yes"),
        ("l3", "l4a", [-42.3, 15.578, 1.757], "yes"),
        ("l3", "l4b", [-36.0, 15.522, 2.000], "yes"),
        ("l3", "c", [-47.7, 7.197, 1.708], "no"),
        ("l3a", "l4a", [-17.3, 0.475, 3.392], "no"),
        ("l3a", "g", [-34.8, 11.042, 2.569], "yes"),
        ("l3a", "d", [-5.4, 0.381, 3.680], "no"),
        ("l3b", "l4b", [47.8, 0.518, 2.387], "no"),
        ("b", "d", [-50.0, 0.203, 1.174], "no"),
        ("c", "d", [26.6, 0.910, 3.416], "no"),
        ("f", "c", [42.0, 0.455, 1.808], "no"),
    ] {
        let row = rows
            .iter()
            .find(|row| row[..2] == [link3, link4])
            .expect("all choices are there");
        let found = [3, 6, 7].map(|cell| row[cell].parse::<f64>().expect("a number"));
        let is_same = found
            .iter()
            .zip(expected)
            .all(|(ours, theirs)| (ours - theirs).abs() <= 6e-4);
        assert!(
            is_same && row[8] == abrupt,
            "{row:?}, expected {expected:?}"
        );
    }
    assert_eq!(rows.iter().filter(|row| row[8] == "yes").count(), 4);
}

/// A figure of the massless links: all its rows, its gaps, and its place in the report.
fn expect_figure(figure: usize, read: &dyn Fn(&str) -> String) {
    let text = read(&format!("figure{figure}.csv"));
    assert_eq!(
        text.lines().count(),
        1 + 351,
        "-50 to 125 deg every 0.5 deg"
    );
    assert!(
        !text.contains("NaN") && !text.contains("inf"),
        "figure {figure}"
    );
    // 117.5° with clearance: no assembly, no value.
    let row = text
        .lines()
        .find(|line| line.starts_with("117.5,") || line.starts_with("117.49999"))
        .expect("a row");
    assert!(row.ends_with(",,"), "{row}");
    let figure = format!("figure{figure}.svg");
    let svg = read(&figure);
    for part in [
        "e = 100 µm",
        "change point 117.51°",
        "no assembly",
        "class=\"mark\"",
    ] {
        assert!(svg.contains(part), "{figure}: {part}");
    }
    assert!(
        read("report.md").contains(&figure),
        "{figure} is not in the report"
    );
}

#[test]
fn the_lock_is_validated_and_written() {
    let output = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join(format!("validation-lock-{}", std::process::id()));
    assert_eq!(
        CASES.first().map(|case| case.name),
        Some("lock"),
        "the founding paper comes first"
    );
    let report = run("lock", Some(&output));
    for claim in &report.claims {
        assert_ne!(claim.verdict, Verdict::Fault, "{claim:?}");
    }
    let names: Vec<&str> = report
        .claims
        .iter()
        .filter_map(|claim| claim.what.split_once(':'))
        .map(|c| c.0)
        .collect();
    assert_eq!(names, ["C1", "C2", "C3", "C4", "C5", "C6"]);
    let c2 = report
        .claims
        .iter()
        .find(|claim| claim.what.starts_with("C2:"))
        .expect("judged");
    let said = "possible for some centres of mass, which the paper does not give: 4 of 49 choices";
    assert!(
        c2.ours.starts_with(said) && c2.verdict.reason().is_some(),
        "{c2:?}"
    );
    let change = report
        .claims
        .iter()
        .find(|claim| claim.what.starts_with("change_point"))
        .expect("located");
    let ours: f64 = change.ours.parse().expect("a number");
    // 50 digits, validation/generate/lock.py.
    assert!((ours - 117.512_206_516_641).abs() < 1e-8, "{ours}");

    let folder = output.join("lock");
    let read = |name: &str| fs::read_to_string(folder.join(name)).expect(name);
    assert!(read("report.md").contains("C6:"));
    assert!(read("report.md").contains("4 of 49 choices change abruptly near -40°"));
    expect_map(&read("centres.csv"));
    // 10 rows in 4 tables, max and mean, and a header.
    assert_eq!(read("table.csv").lines().count(), 1 + 4 * 10 * 2);
    assert!(
        read("table.csv").contains(",47.7671,"),
        "the paper's figures stand as printed"
    );
    assert!(read("singular.csv").contains("change_point[deg],117.512206516641,"));
    assert!(read("intervals.csv").contains("no assembly"));
    for figure in 4..=8 {
        expect_figure(figure, &read);
    }
    fs::remove_dir_all(output).expect("removed");
}
