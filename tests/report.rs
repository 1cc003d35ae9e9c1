//! `report.html`: what stands in the file, and what a browser makes of it.

#[path = "common/browser.rs"]
mod browser;
#[path = "common/models.rs"]
mod models;

use browser::{Scratch, ask, find, open};
use linkdyn_engine::analysis::derived::derived;
use linkdyn_model::ForceKind;
use linkdyn_output::{Column, Report, Stage, Summary, Trajectory};
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
    let quantities = ["x", "y", "angle", "vx", "vy", "omega", "ax", "ay", "alpha"];
    let mut columns = vec![Column::new("time", "s")];
    let names: Vec<String> = (0..bodies).map(name).collect();
    columns.extend(
        names
            .iter()
            .flat_map(|name| quantities.map(|q| Column::new(format!("{name}.{q}"), "m"))),
    );
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

/// What the mechanism does to the ground by Newton and Euler: weights and loads less the change of momentum, with nothing of joints.
#[test]
fn shaking_is_the_balance_of_momentum() {
    let mut tried = 0;
    for (name, sets) in [
        ("slider-crank", &[][..]),
        ("stephenson-iii", &[]),
        ("four-bar", &[]),
        ("geared-five-bar", &[]),
        ("scotch-yoke", &[]),
        ("quick-return", &[]),
        ("watt-i-lock", &["analysis.sample.to=115 deg"]),
        ("quick-return", &["drivers={}", "analysis.type=dynamics"]),
    ] {
        let model = models::load_bundled(name, sets);
        let outcome = models::solve(&model);
        let (derived, _) = derived(&model, outcome.all());
        let ours = ["fx", "fy", "moment"]
            .map(|q| derived.values(&format!("shaking.{q}")).expect("shaking"));
        let of = |column: String| {
            outcome
                .trajectory
                .values(&column)
                .unwrap_or_else(|| panic!("no {column}"))
        };
        let mut sums = vec![[0.0; 3]; outcome.trajectory.len()];
        for (body, words) in model.bodies.iter().filter(|(body, _)| *body != "ground") {
            let columns = ["x", "y", "angle", "omega", "ax", "ay", "alpha"]
                .map(|q| of(format!("{body}.{q}")));
            let (m, inertia, com) = (
                words.mass.expect("m"),
                words.inertia.expect("I"),
                words.com.unwrap_or_default(),
            );
            for (row, sum) in sums.iter_mut().enumerate() {
                let [x, y, angle, omega, ax, ay, alpha] =
                    [0, 1, 2, 3, 4, 5, 6].map(|k| columns[k][row]);
                let (sin, cos) = angle.sin_cos();
                let (rx, ry) = (cos * com[0] - sin * com[1], sin * com[0] + cos * com[1]);
                let fx = m * (model.gravity[0] - (ax - alpha * ry - omega * omega * rx));
                let fy = m * (model.gravity[1] - (ay + alpha * rx - omega * omega * ry));
                sum[0] += fx;
                sum[1] += fy;
                sum[2] += (x + rx) * fy - (y + ry) * fx - inertia * alpha;
            }
        }
        for (force, words) in &model.forces {
            match &words.kind {
                ForceKind::Load { at, .. } => {
                    let [fx, fy] = ["fx", "fy"].map(|q| {
                        derived
                            .values(&format!("force.{force}.{q}"))
                            .expect("a load")
                    });
                    let [x, y, angle] = ["x", "y", "angle"].map(|q| of(format!("{}.{q}", at.body)));
                    let point = model.bodies[&at.body].points[&at.point];
                    for (row, sum) in sums.iter_mut().enumerate() {
                        let (sin, cos) = angle[row].sin_cos();
                        let px = x[row] + cos * point[0] - sin * point[1];
                        let py = y[row] + sin * point[0] + cos * point[1];
                        sum[0] += fx[row];
                        sum[1] += fy[row];
                        sum[2] += px * fy[row] - py * fx[row];
                    }
                }
                ForceKind::Torque {
                    relative_to: None, ..
                } => {
                    let torque = derived
                        .values(&format!("force.{force}.torque"))
                        .expect("a torque");
                    sums.iter_mut()
                        .zip(torque)
                        .for_each(|(sum, torque)| sum[2] += torque);
                }
                ForceKind::Torque { .. }
                | ForceKind::Spring { .. }
                | ForceKind::TorsionSpring { .. } => {}
            }
        }
        for k in 0..3 {
            let largest = sums
                .iter()
                .fold(1.0_f64, |largest, sum| largest.max(sum[k].abs()));
            for (row, sum) in sums.iter().enumerate() {
                let difference = (sum[k] - ours[k][row]).abs() / largest;
                assert!(
                    difference < 1e-9,
                    "{name} {sets:?}, row {row}, component {k}: {} and {}",
                    sum[k],
                    ours[k][row]
                );
                tried += 1;
            }
        }
    }
    assert!(tried > 5000, "{tried}");
    // The load of the slider-crank by hand: −600 + 500 sin(−90°).
    let model = models::load_bundled("slider-crank", &[]);
    let (derived, _) = derived(&model, models::solve(&model).all());
    assert!((derived.values("force.gas.fx").expect("the load")[0] + 1100.0).abs() < 1e-9);
}

/// Four-bar: Alt's transmission angle from the triangle coupler, rocker, diagonal; the ratio of the velocities.
#[test]
fn transmission_of_a_four_bar_is_that_of_its_triangle() {
    let model = models::load_bundled(
        "four-bar",
        &[r#"analysis.transmission={"output":"rocker"}"#],
    );
    let outcome = models::solve(&model);
    let (derived, notes) = derived(&model, outcome.all());
    assert!(notes.is_empty(), "{notes:?}");
    let joint = model.joints.iter().find(|(_, joint)| {
        let bodies = joint.between.each_ref().map(|end| end.body.as_str());
        bodies == ["coupler", "rocker"] || bodies == ["rocker", "coupler"]
    });
    let (name, joint) = joint.expect("a joint between coupler and rocker");
    let angle = derived
        .values(&format!("transmission.{name}.angle"))
        .expect("an angle");
    let (ratio, advantage) = (
        derived.values("transmission.ratio"),
        derived.values("transmission.advantage"),
    );
    let (ratio, advantage) = (ratio.expect("a ratio"), advantage.expect("an advantage"));
    let place = |body: &str, point: &str, row: usize| {
        let [x, y] = model.bodies[body].points[point];
        let of = |q: &str| {
            if body == "ground" {
                0.0
            } else {
                models::values(&outcome, &format!("{body}.{q}"))[row]
            }
        };
        let (sin, cos) = of("angle").sin_cos();
        [of("x") + cos * x - sin * y, of("y") + sin * x + cos * y]
    };
    // The other ends of the two links.
    let far = |body: &str, not: &str| {
        let other = model
            .joints
            .values()
            .flat_map(|joint| &joint.between)
            .find(|end| end.body == body && end.point != not);
        other.expect("another end").point.clone()
    };
    let [coupler_end, rocker_end] = ["coupler", "rocker"].map(|body| {
        let end = joint
            .between
            .iter()
            .find(|end| end.body == body)
            .expect("an end");
        (end.point.clone(), far(body, &end.point))
    });
    let [crank_omega, rocker_omega] =
        ["crank", "rocker"].map(|body| models::values(&outcome, &format!("{body}.omega")));
    for row in (0..outcome.trajectory.len()).step_by(7) {
        let pin = place("coupler", &coupler_end.0, row);
        let along = |end: [f64; 2]| [end[0] - pin[0], end[1] - pin[1]];
        let (a, b) = (
            along(place("coupler", &coupler_end.1, row)),
            along(place("rocker", &rocker_end.1, row)),
        );
        let between = (a[0] * b[1] - a[1] * b[0])
            .abs()
            .atan2((a[0] * b[0] + a[1] * b[1]).abs());
        assert!(
            (angle[row] - between).abs() < 1e-9,
            "row {row}: {} and {between}",
            angle[row]
        );
        let expected = rocker_omega[row] / crank_omega[row];
        assert!(
            (ratio[row] - expected).abs() < 1e-9 * expected.abs().max(1.0),
            "row {row}: {} and {expected}",
            ratio[row]
        );
        assert!((advantage[row] * ratio[row] - 1.0).abs() < 1e-12);
    }
}

/// Slider-crank in closed form: x = r cos θ + √(l² − r² sin² θ), the angle between rod and the normal of the guide; and a driver at rest.
#[test]
fn transmission_of_a_slider_crank_is_its_closed_form() {
    for motion in ["{}", r#"{"type":"polynomial","coefficients":[40]}"#] {
        let mut sets =
            vec![r#"analysis.transmission={"driver":"motor","output":"piston"}"#.to_string()];
        sets.extend((motion != "{}").then(|| format!("drivers.motor.motion={motion}")));
        let model = models::load_bundled(
            "slider-crank",
            &sets.iter().map(String::as_str).collect::<Vec<_>>(),
        );
        let outcome = models::solve(&model);
        let (derived, _) = derived(&model, outcome.all());
        assert_eq!(
            derived.columns[derived.column_index("transmission.ratio").expect("a ratio")].unit,
            "m/rad"
        );
        let ratio = derived.values("transmission.ratio").expect("a ratio");
        let angle = derived
            .values("transmission.wristpin.angle")
            .expect("an angle");
        let (r, l) = (0.05_f64, 0.2_f64);
        for (row, theta) in models::values(&outcome, "crank.angle")
            .into_iter()
            .enumerate()
        {
            let root = (l * l - (r * theta.sin()).powi(2)).sqrt();
            let expected = -r * theta.sin() - r * r * theta.sin() * theta.cos() / root;
            assert!(
                (ratio[row] - expected).abs() < 1e-12,
                "row {row}: {} and {expected}",
                ratio[row]
            );
            let between = (root / l).asin();
            // In the dead centres the piston has no velocity, and μ no meaning.
            assert!(
                angle[row].is_nan() || (angle[row] - between).abs() < 1e-7,
                "row {row}: {} and {between}",
                angle[row]
            );
        }
        assert!(
            angle.iter().filter(|angle| angle.is_nan()).count() <= 3,
            "{angle:?}"
        );
    }
}

#[test]
fn a_transmission_that_the_drivers_do_not_determine_is_said_to_be_none() {
    let sets = [
        r#"analysis.transmission={"driver":"motor","output":"arm"}"#,
        "analysis.type=dynamics",
    ];
    let mut model = models::load_bundled("quick-return", &sets);
    model.drivers.clear();
    let (derived, notes) = derived(&model, models::solve(&model).all());
    assert!(derived.column_index("transmission.ratio").is_none());
    assert!(
        notes.len() == 1 && notes[0].contains("do not determine the motion"),
        "{notes:?}"
    );
}
