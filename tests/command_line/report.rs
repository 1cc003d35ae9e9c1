//! `report.html`: what stands in the file, and what a browser makes of it.

use crate::browser::{Scratch, ask, find, open};
use linkdyn_output::{BodyQuantity, Channel, Column, Report, Stage, Summary, Trajectory};
use linkdyn_picture::report::{self, Body, Joint, Mechanism};
use serde_json::{Value, json};
use std::fs;
use std::process::{Command, Stdio};

/// Runs the command; the files it leaves.
fn run(arguments: &[&str]) -> (String, String, Value) {
    let scratch = Scratch::new("report");
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command
        .arg("run")
        .args(arguments)
        .arg("-o")
        .arg(&scratch.0)
        .stdin(Stdio::null());
    let output = command.output().expect("the binary runs");
    let read = |name: &str| fs::read_to_string(scratch.0.join(name));
    let said = String::from_utf8_lossy(&output.stderr);
    let page =
        read("report.html").unwrap_or_else(|_| panic!("{arguments:?} leaves no report: {said}"));
    let summary = serde_json::from_str(&read("summary.json").expect("a summary")).expect("JSON");
    (page, read("results.csv").expect("results"), summary)
}

/// The JSON of a page.
fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"data\">").expect("data");
    serde_json::from_str(rest.split_once("</script>").expect("an end").0).expect("JSON")
}

/// Columns of a CSV without quotes in its names.
fn cells(csv: &str) -> (Vec<&str>, Vec<Vec<Option<f64>>>) {
    let mut lines = csv.lines();
    let heads = lines.next().expect("a header").split(',').collect();
    (
        heads,
        lines
            .map(|line| line.split(',').map(|cell| cell.parse().ok()).collect())
            .collect(),
    )
}

const HOSTILE: &str = r#"{ "format": "linkdyn/1", "name": "</script><script>window.hacked=1</script><!--<script>", "units": "SI",
  "about": "<img src=x onerror=\"window.hacked=1\"> & &lt; {{script}}", "source": "\u202eevil\u2028line",
  "bodies": { "ground": { "points": { "</script>": [0, 0] } },
    "<!--<script>": { "points": { "</script>": [0, 0], "\" onload '": [1, 0] } },
    "__proto__": { "points": { "constructor": [0, 0], "🔒\u202e\u2028": [1, 0] }, "pose": { "position": [1, 0] } } },
  "joints": { "</style><svg/onload>": { "type": "revolute", "between": ["ground.</script>", "<!--<script>.</script>"] },
    "toString": { "type": "revolute", "between": ["<!--<script>.\" onload '", "__proto__.constructor"] } },
  "drivers": { "a\"b": { "type": "rotation", "body": "<!--<script>", "motion": { "type": "constant_velocity", "velocity": 1 } },
    "🔒": { "type": "rotation", "body": "__proto__", "motion": { "type": "constant_velocity", "velocity": 2 } } },
  "points": ["__proto__.🔒\u202e\u2028"],
  "analysis": { "type": "kinematics", "end": 1, "outputs": 11 } }"#;

fn hostile() -> String {
    let scratch = Scratch::new("hostile");
    let path = scratch.0.join("model.json");
    fs::write(&path, HOSTILE).expect("written");
    run(&[path.to_str().expect("UTF-8")]).0
}

#[test]
fn a_page_needs_nothing_from_outside() {
    let (page, _, summary) = run(&["four-bar"]);
    for word in [
        " src=",
        "<link",
        "@import",
        "url(",
        "fetch(",
        "XMLHttpRequest",
        "WebSocket",
        "innerHTML =",
        "eval(",
    ] {
        let own = page
            .split("/*! https://github.com/leeoniya/uPlot")
            .next()
            .expect("a part");
        let rest = page.split_once("linkdyn = {}").expect("our scripts").1;
        assert!(!own.contains(word) && !rest.contains(word), "{word}");
    }
    let policy = page
        .split("Content-Security-Policy\" content=\"")
        .nth(1)
        .expect("a policy");
    assert!(
        policy.starts_with("default-src 'none'; script-src 'sha256-")
            && !policy.contains("'unsafe"),
        "{policy:.200}"
    );
    let data = data(&page);
    assert_eq!(data["summary"]["model"], summary["model"]);
    assert_eq!(data["summary"]["mobility"], summary["mobility"]);
    assert!(page.contains("Permission is hereby granted, free of charge"));
}

#[test]
fn names_reach_the_page_only_inside_escaped_json() {
    let page = hostile();
    let (before, rest) = page.split_once("id=\"data\">").expect("data");
    let (json, after) = rest.split_once("</script>").expect("an end");
    assert!(!json.contains(['<', '>', '&', '\u{2028}']));
    for text in ["hacked", "onerror", "toString\"", "🔒"] {
        assert!(
            !before.contains(text) && !after.split("uPlot").next().expect("a part").contains(text),
            "{text}"
        );
    }
    assert_eq!(
        data(&page)["mechanism"]["bodies"][1]["name"],
        "<!--<script>"
    );
    assert_eq!(
        data(&page)["about"],
        "<img src=x onerror=\"window.hacked=1\"> & &lt; {{script}}"
    );
}

/// Columns that are not wanted among the results are there for the drawing, and only for it.
#[test]
fn poses_are_there_even_when_the_results_leave_them_out() {
    let (page, csv, _) = run(&["four-bar", "--set", r#"analysis.columns=["driver.*"]"#]);
    assert!(!csv.contains("crank.x"), "{csv:.200}");
    let data = data(&page);
    let columns = data["columns"].as_array().expect("a list");
    assert!(columns.contains(&json!(["crank.x", "m", 0])), "{columns:?}");
    let value = columns
        .iter()
        .find(|column| column[0] == "driver.motor.value")
        .expect("the driver's value");
    assert_eq!(value[2], 1);
}

/// A page about a model that nobody could draw by hand.
fn large(bodies: usize, rows: usize, name: impl Fn(usize) -> String) -> String {
    let quantities = [
        BodyQuantity::X,
        BodyQuantity::Y,
        BodyQuantity::Angle,
        BodyQuantity::Vx,
        BodyQuantity::Vy,
        BodyQuantity::Omega,
        BodyQuantity::Ax,
        BodyQuantity::Ay,
        BodyQuantity::Alpha,
    ];
    let mut columns = vec![Column::of(Channel::Time, "", "s")];
    let names: Vec<String> = (0..bodies).map(name).collect();
    for (body, name) in names.iter().enumerate() {
        let of = |quantity| Column::of(Channel::Body(body, quantity), name, "m");
        columns.extend(quantities.map(of));
    }
    let mut table = Trajectory::new(columns);
    let width = table.width();
    for row in 0..rows {
        table.data.extend((0..width).map(|k| {
            if k == 0 {
                row as f64
            } else {
                (k as f64 * 0.1).sin() + row as f64 * 1e-3
            }
        }));
    }
    let body = |name: &str| Body {
        name: name.into(),
        points: vec![("A".into(), 0.0, 0.0), ("B".into(), 0.1, 0.0)],
        com: None,
    };
    let mut mechanism = Mechanism {
        bodies: vec![body("ground")],
        ..Mechanism::default()
    };
    mechanism.bodies.extend(names.iter().map(|name| body(name)));
    mechanism.joints = (0..bodies)
        .map(|k| Joint {
            name: format!("j{k}"),
            kind: "revolute",
            between: [(k, 1), (k + 1, 0)],
            axis: None,
            gear: None,
            clearance: None,
        })
        .collect();
    let (report, stage, settings) = (
        Report::default(),
        Stage::default(),
        json!({ "type": "dynamics" }),
    );
    let summary = Summary {
        model_name: "large",
        model_sha256: "00",
        settings: &settings,
        report: &report,
        trajectory: &table,
        drawing: serde_json::Value::Null,
        load: stage,
        write: stage,
    };
    report::to_text(&report::Page {
        summary: &summary,
        about: None,
        source: None,
        mechanism: &mechanism,
        complete: &table,
        derived: &Trajectory::default(),
        notes: Vec::new(),
    })
}

#[test]
fn a_page_stays_below_five_megabytes_and_says_what_it_leaves_out() {
    for (what, page) in [
        ("10 000 bodies", large(10_000, 101, |k| format!("body {k}"))),
        (
            "long names",
            large(400, 20, |k| format!("{k} {}", "long ".repeat(4000))),
        ),
        ("many rows", large(7, 60_000, |k| format!("body {k}"))),
    ] {
        let data = data(&page);
        println!(
            "{what}: {} bytes, {} rows, {} columns",
            page.len(),
            data["rows"],
            data["columns"].as_array().expect("a list").len()
        );
        assert!(page.len() < 5_000_000, "{what}: {}", page.len());
        assert!(
            !data["notes"].as_array().expect("a list").is_empty(),
            "{what} is cut in silence"
        );
    }
    let small = data(&large(20, 50, |k| format!("body {k}")));
    assert_eq!(
        (&small["notes"], &small["rows"], &small["bytes"]),
        (&json!([]), &json!(50), &json!(8))
    );
}

#[test]
fn every_outcome_opens_without_a_word_on_the_console() {
    let Some(browser) = find() else { return };
    let cases: &[(&[&str], &str)] = &[
        (&["four-bar"], "completed"),
        (
            &["slider-crank", "--set", "analysis.type=kinematics"],
            "completed",
        ),
        (&["geared-five-bar"], "completed"),
        (&["scotch-yoke"], "completed"),
        (&["parallel-crank"], "completed"),
        (
            &[
                "quick-return",
                "--set",
                "drivers={}",
                "--set",
                "analysis.type=dynamics",
            ],
            "completed",
        ),
        (
            &[
                "scotch-yoke",
                "--set",
                "drivers={}",
                "--set",
                "analysis.type=statics",
            ],
            "completed",
        ),
        (&["lock", "--set", "analysis.type=assembly"], "completed"),
        (
            &[
                "lock",
                "--set",
                "joints.a.clearance.model=massless_link",
                "--set",
                "joints.d.clearance.model=massless_link",
            ],
            "completed_with_gaps",
        ),
        (
            &[
                "lock",
                "--set",
                "analysis.sample.to=135 deg",
                "--set",
                "analysis.sample.step=1 deg",
            ],
            "dead_centre",
        ),
        (
            &["four-bar", "--set", r#"bodies.coupler.points.B=["9 m", 0]"#],
            "assembly_failed",
        ),
        (
            &[
                "quick-return",
                "--set",
                "drivers={}",
                "--set",
                "analysis.type=dynamics",
                "--set",
                "analysis.solver.max_wall_time=1e-9",
            ],
            "time_limit",
        ),
        (
            &["four-bar", "--set", r#"analysis.columns=["driver.*"]"#],
            "completed",
        ),
    ];
    for (arguments, status) in cases {
        let (page, _, summary) = run(arguments);
        assert_eq!(summary["status"], *status, "{arguments:?}");
        let visit = open(&browser, &page, Some(1000));
        assert!(
            visit.console.is_empty(),
            "{arguments:?}: {:#?}",
            visit.console
        );
        assert!(
            visit.dom.contains("data-ready=\"true\""),
            "{arguments:?} does not get ready"
        );
        assert!(
            !visit
                .dom
                .split("id=\"data\"")
                .next()
                .expect("a part")
                .contains("NaN"),
            "{arguments:?}"
        );
    }
}

#[test]
fn the_controls_move_the_mechanism() {
    let Some(browser) = find() else { return };
    let (page, csv, _) = run(&["four-bar"]);
    let (told, visit) = ask(
        &browser,
        &page,
        include_str!("report/controls.js"),
        Some(12_000),
    );
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    let (heads, rows) = cells(&csv);
    let last = rows.len() - 1;
    assert_eq!(told["rows"], json!(rows.len()));
    // Every pose that the page shows is the one of the file, to the last digit.
    for row in [0, 90, last] {
        let bodies = told["poses"][row.to_string()].as_array().expect("poses");
        assert_eq!(bodies.len(), 3, "{bodies:?}");
        for body in bodies {
            let name = body[0].as_str().expect("a name");
            for (k, quantity) in ["x[m]", "y[m]", "angle[rad]"].iter().enumerate() {
                let column = heads
                    .iter()
                    .position(|head| *head == format!("{name}.{quantity}"))
                    .expect("a column");
                assert_eq!(
                    body[k + 1].as_f64(),
                    rows[row][column],
                    "{name}.{quantity} in row {row}"
                );
            }
        }
    }
    assert!(
        told["inked"].as_u64() > Some(5000) && told["same"] == true && told["moves"] == true,
        "{told:#}"
    );
    let plots = told["plots"].as_array().expect("plots");
    assert!(
        plots.len() >= 4 && plots.iter().all(|plot| plot["built"] == true),
        "{plots:?}"
    );
    let number = |key: &str| {
        told[key]
            .as_u64()
            .unwrap_or_else(|| panic!("{key} in {told:#}")) as usize
    };
    assert!(number("played") > 5 && number("played") < last, "{told:#}");
    assert_eq!(number("stopped"), number("later"));
    assert_eq!(
        (number("right"), number("left"), number("end")),
        (11, 1, last)
    );
    assert_eq!(told["units"], "si");
    assert!(
        told["si"].as_str().expect("text").ends_with(" m") || told["si"] == "0 m",
        "{told:#}"
    );
    assert_eq!(told["dark"], "dark");
    assert!(number("hovered").abs_diff(last / 2) <= 1, "{told:#}");
    for line in told["lines"].as_array().expect("lines") {
        assert!(
            (line.as_f64().expect("a place") - 1.0).abs() < 0.01,
            "{told:#}"
        );
    }
    for range in told["zoomed"].as_array().expect("ranges") {
        assert_eq!(range, &json!([0.2, 0.4]));
    }
    // The driver's value in degrees.
    let value = heads
        .iter()
        .position(|head| *head == "driver.motor.value[rad]")
        .expect("a column");
    for (k, row) in [0, last].into_iter().enumerate() {
        let expected = rows[row][value].expect("a value").to_degrees();
        assert!(
            (told["across"][k].as_f64().expect("a bound") - expected).abs() < 1e-9 * expected.abs(),
            "{told:#}"
        );
    }
    assert_eq!(told["arrows"], true, "the arrows are not drawn");
}

/// A run that came to its end begins at the beginning, one that is stuck shows where.
#[test]
fn a_page_opens_where_the_run_is_stuck() {
    let Some(browser) = find() else { return };
    let stuck = [
        "lock",
        "--set",
        "analysis.sample.to=135 deg",
        "--set",
        "analysis.sample.step=1 deg",
    ];
    for (arguments, early) in [
        (&["lock", "--set", "analysis.sample.step=1 deg"][..], false),
        (&stuck, true),
    ] {
        let (page, csv, summary) = run(arguments);
        assert_eq!(summary["status"] == "dead_centre", early);
        let probe = "setTimeout(() => { const { player, rows } = linkdyn; const row = player.row, scrub = Number(document.getElementById('scrub').value); \
            player.toggle(); const played = player.row; player.pause(); answer({ row, rows, scrub, played }); }, 300);";
        let (told, visit) = ask(&browser, &page, probe, Some(2000));
        assert!(visit.console.is_empty(), "{:#?}", visit.console);
        let last = csv.lines().count() - 2;
        let opened = if early { last } else { 0 };
        assert_eq!(
            told,
            json!({ "row": opened, "rows": last + 1, "scrub": opened, "played": 0 })
        );
    }
}

#[test]
fn hostile_names_do_nothing() {
    let Some(browser) = find() else { return };
    let probe = "setTimeout(() => answer({ hacked: typeof window.hacked, scripts: document.scripts.length, \
        odd: document.querySelectorAll('img,svg:not(.chip svg),iframe').length, title: document.title, \
        heading: document.getElementById('name').textContent, origin: document.getElementById('origin').textContent, \
        bodies: [...document.querySelectorAll('#poses tbody tr')].map((line) => line.cells[0].textContent), \
        names: linkdyn.plots.shown.length }), 300);";
    let (told, visit) = ask(&browser, &hostile(), probe, Some(2000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert_eq!(
        (&told["hacked"], &told["scripts"], &told["odd"]),
        (&json!("undefined"), &json!(5), &json!(0)),
        "{told:#}"
    );
    assert_eq!(
        told["heading"],
        "</script><script>window.hacked=1</script><!--<script>"
    );
    assert_eq!(told["origin"], "\\u{202e}evil\\u{2028}line");
    assert_eq!(told["bodies"], json!(["<!--<script>", "__proto__"]));
}

/// Names that wrap have lines of their own; lengths are in the unit that suits them; settings have units; columns are those of
/// the file.
#[test]
fn what_stands_beside_the_drawing_can_be_read() {
    let Some(browser) = find() else { return };
    let scratch = Scratch::new("long-names");
    let path = scratch.0.join("model.json");
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/models/four-bar.json"))
        .expect("bundled");
    let long = text
        .replace("\"P\"", "\"outer_ball_joint_front_left_point\"")
        .replace("coupler.P", "coupler.outer_ball_joint_front_left_point");
    fs::write(&path, long.replace("coupler", "left_upper_control_arm")).expect("written");
    let sample = r#"analysis={"type":"inverse_dynamics","sample":{"driver":"motor","from":"60 deg","to":"160 deg","step":"1 deg"}}"#;
    let (page, csv, _) = run(&[path.to_str().expect("UTF-8"), "--set", sample]);
    let probe = "const boxes = [...document.querySelectorAll('#traces label')].map((label) => label.getBoundingClientRect()); \
        const units = linkdyn.units, lengths = () => [1e-5, 2e-3, 0.5, 1, 10, 2000].map(units.length); \
        const engineering = lengths(); units.system = 'si'; const si = lengths(); units.system = 'engineering'; \
        const cell = (head) => [...document.querySelectorAll('#tables th')].find((th) => th.textContent === head)?.nextSibling.textContent; \
        answer({ over: boxes.filter((box, k) => k && box.top < boxes[k - 1].bottom - 0.5).length, engineering, si, \
        wrapped: boxes.filter((box) => box.height > 30).length, from: cell('sample from'), analysis: document.getElementById('analysis').textContent });";
    let (told, visit) = ask(&browser, &page, probe, Some(1000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert!(
        told["wrapped"].as_u64() > Some(0) && told["over"] == 0,
        "{told:#}"
    );
    assert_eq!(
        told["engineering"],
        json!(["10 µm", "2 mm", "500 mm", "1 m", "10 m", "2000 m"])
    );
    assert_eq!(
        told["si"],
        json!(["1e−5 m", "0.002 m", "0.5 m", "1 m", "10 m", "2000 m"])
    );
    assert_eq!(told["from"], "60°");
    let columns = format!(", {} columns", cells(&csv).0.len());
    assert!(
        told["analysis"]
            .as_str()
            .is_some_and(|text| text.ends_with(&columns)),
        "{told:#}, {columns}"
    );
}

#[test]
fn a_page_without_results_says_so_where_the_drawing_would_be() {
    let Some(browser) = find() else { return };
    let (page, _, _) = run(&["four-bar", "--set", r#"bodies.coupler.points.B=["9 m", 0]"#]);
    let probe = "const box = (name) => document.getElementById(name).getBoundingClientRect(); \
        const [card, said] = [box('motion'), box('undrawn')]; answer({ text: document.getElementById('undrawn').textContent, \
        high: said.height, inside: said.top >= card.top && said.bottom <= card.bottom, wide: card.width });";
    let (told, _) = ask(&browser, &page, probe, Some(1000));
    assert_eq!(
        told["text"],
        "There is no result to show: assembly failed, for the reason given above."
    );
    assert!(
        told["inside"] == true
            && told["high"].as_f64() > Some(15.0)
            && told["wide"].as_f64() > Some(1000.0),
        "{told:#}"
    );
}

/// The policy refuses what is not ours, even if it got in.
#[test]
fn foreign_scripts_are_refused() {
    let Some(browser) = find() else { return };
    let (page, _, _) = run(&["four-bar", "--set", "analysis.outputs=3"]);
    let visit = open(
        &browser,
        &page.replace(
            "</body>",
            "<script>document.title = 'hacked'</script></body>",
        ),
        Some(500),
    );
    assert!(!visit.dom.contains("<title>hacked"));
    assert!(
        visit
            .console
            .iter()
            .any(|line| line.contains("Content Security Policy")),
        "{:?}",
        visit.console
    );
}

/// 2000 instants of 60 columns: the time from opening to a page that can be used. The bound leaves room for a busy machine.
#[test]
fn a_usual_page_opens_at_once() {
    let Some(browser) = find() else { return };
    for (what, page, bound) in [
        (
            "2000 rows, 64 columns",
            large(7, 2000, |k| format!("body {k}")),
            3000.0,
        ),
        (
            "10 000 bodies",
            large(10_000, 101, |k| format!("body {k}")),
            20_000.0,
        ),
    ] {
        let probe = "answer({ ready: performance.now(), plots: linkdyn.plots.list.filter((plot) => plot.u).length, known: linkdyn.shapes.known });";
        let (told, _) = ask(&browser, &page, probe, None);
        println!(
            "{what}: {} bytes, ready after {} ms",
            page.len(),
            told["ready"]
        );
        assert!(
            told["ready"].as_f64().expect("a time") < bound,
            "{what}: {told}"
        );
        assert!(
            told["plots"].as_u64() >= Some(1) && told["known"] == true,
            "{told}"
        );
    }
}
