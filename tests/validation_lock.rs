//! The founding paper's case through the library: no fault, all claims, all files.

use std::fs;
use std::path::Path;

use linkdyn::analysis::Control;
use linkdyn::validation::{CASES, CaseReport, Verdict};

fn run(output: &Path) -> CaseReport {
    let case = CASES.first().expect("a case");
    assert_eq!(case.name, "lock", "the founding paper comes first");
    case.run(Some(output), &Control::default()).expect("runs")
}

#[test]
fn the_lock_is_validated_and_written() {
    let output = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("validation-lock-{}", std::process::id()));
    let report = run(&output);
    for claim in &report.claims {
        assert_ne!(claim.verdict, Verdict::Fault, "{claim:?}");
    }
    let names: Vec<&str> = report.claims.iter().filter_map(|claim| claim.what.split_once(':')).map(|c| c.0).collect();
    assert_eq!(names, ["C1", "C2", "C3", "C4", "C5", "C6"]);
    let change = report.claims.iter().find(|claim| claim.what.starts_with("change_point")).expect("located");
    let ours: f64 = change.ours.parse().expect("a number");
    // 50 digits, validation/generate/lock.py.
    assert!((ours - 117.512_206_516_641).abs() < 1e-8, "{ours}");

    let folder = output.join("lock");
    let read = |name: &str| fs::read_to_string(folder.join(name)).expect(name);
    assert!(read("report.md").contains("C6:"));
    // 10 rows in 4 tables, max and mean, and a header.
    assert_eq!(read("table.csv").lines().count(), 1 + 4 * 10 * 2);
    assert!(read("table.csv").contains(",47.7671,"), "the paper's figures stand as printed");
    assert!(read("singular.csv").contains("change_point[deg],117.512206516641,"));
    assert!(read("intervals.csv").contains("no assembly"));
    for figure in 4..=8 {
        let text = read(&format!("figure{figure}.csv"));
        assert_eq!(text.lines().count(), 1 + 351, "-50 to 125 deg every 0.5 deg");
        assert!(!text.contains("NaN") && !text.contains("inf"), "figure {figure}");
        // 117.5° with clearance: no assembly, no value.
        let row = text.lines().find(|line| line.starts_with("117.5,") || line.starts_with("117.49999")).expect("a row");
        assert!(row.ends_with(",,"), "{row}");
        let figure = format!("figure{figure}.svg");
        let svg = read(&figure);
        for part in ["e = 100 µm", "change point 117.51°", "no assembly", "class=\"mark\""] {
            assert!(svg.contains(part), "{figure}: {part}");
        }
        assert!(read("report.md").contains(&figure), "{figure} is not in the report");
    }
    fs::remove_dir_all(output).expect("removed");
}
