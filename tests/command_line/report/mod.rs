//! `report.html`: what stands in the file, and what a browser makes of it.

mod answers;
mod bent;
mod beside;
mod curves;
mod drawing;
mod lead;
mod opened;
mod page;
mod screen;
mod symbols;
mod touch;

use crate::browser::{Scratch, ask, ask_in, find, open};
use linkdyn_output::{BodyQuantity, Channel, Column, Report, Stage, Summary, Trajectory};
use linkdyn_picture::report::Report as Page;
use linkdyn_picture::shape::{Body, Joint, JointKind, Shape};
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
        ..Body::default()
    };
    let mut shape = Shape {
        bodies: vec![body("ground")],
        ..Shape::default()
    };
    shape.bodies.extend(names.iter().map(|name| body(name)));
    shape.joints = (0..bodies)
        .map(|k| Joint {
            name: format!("j{k}"),
            limits: None,
            one_way: None,
            kind: JointKind::Revolute { clearance: None },
            between: [(k, 1), (k + 1, 0)],
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
        mechanism: serde_json::Value::Null,
        drawing: serde_json::Value::Null,
        responses: serde_json::Value::Null,
        load: stage,
        write: stage,
    };
    let page = Page {
        shape,
        about: None,
        source: None,
        summary: &summary,
        table: &table,
        derived: None,
        notes: Vec::new(),
    };
    let mut text = Vec::new();
    page.write(&mut text).expect("memory takes it");
    String::from_utf8(text).expect("text")
}
