//! `linkdyn modes`: natural frequencies, damping and shapes of small motions about the equilibrium.

mod moving;

use std::f64::consts::TAU;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use serde_json::{Value, json};

use super::exit::{Exit, Failure};
use super::interrupt;
use super::open::{ModelOptions, Opened};
use super::page::{Page, number};
use super::progress::Line;
use super::streams::{complain, print};
use super::words::{equilibrium, mobility, status_words};
use linkdyn_engine::analysis::{self, Control, Linearised, Mode};
use linkdyn_output::{Column, Directory, Trajectory, csv, summary};

const TABLE: &str = "modes.csv";
const SUMMARY: &str = "modes.json";
const PAGE: &str = "modes.html";
/// Digits of numbers in the table, and of shapes.
const DIGITS: usize = 6;
const SHAPE_DIGITS: usize = 3;
/// Modes whose shapes are printed.
const MOST_SHAPES: usize = 8;

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    #[command(flatten)]
    model: ModelOptions,
    /// Linearise about the assembled position instead of the equilibrium
    #[arg(long)]
    pose: bool,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
    /// Write modes.csv, modes.json, and modes.html, in which the shapes move, into this directory (made where missing)
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

const HELP: &str = "  linkdyn modes double-pendulum
  linkdyn modes scotch-yoke --set \"drivers={}\" -o out

How the equilibrium is found: linkdyn docs theory. What the files hold: linkdyn docs results.";

/// Linearises, writes, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let opened = options.model.open()?;
    let directory = options.output.as_deref().map(Directory::open).transpose()?;
    let control = Control {
        interrupted: interrupt::watch(),
        ..Control::default()
    };
    let line = Line::start(Instant::now(), &opened.name, || None);
    let found = analysis::modes(&opened.loaded.model, options.pose, &control);
    drop(line);
    let mut found = found.map_err(|complaints| opened.bad_input(complaints))?;
    found
        .warnings
        .splice(0..0, opened.loaded.warnings.iter().cloned());
    // The page comes first: a warning says why there is none.
    let moving = directory
        .as_ref()
        .map(|directory| moving::write(directory, PAGE, (&opened, options.pose), &mut found));
    let moving = moving.transpose()?.flatten();
    let json = to_json(&opened, options.pose, &found);
    let mut written = Vec::new();
    if let Some(directory) = directory {
        written.push(directory.write_with(TABLE, |file| csv::write(&table(&found), file))?);
        written.push(directory.write(SUMMARY, format!("{json:#}\n").as_bytes())?);
        written.extend(moving);
    }
    print(&if options.json {
        format!("{json:#}\n")
    } else {
        page(&opened, options.pose, &found, &written)
    })?;
    let exit = Exit::from(found.status);
    if exit == Exit::Done && interrupt::is_set() {
        complain("interrupted; the modes are complete all the same");
        return Ok(Exit::Interrupted);
    }
    if exit != Exit::Done {
        complain(found.message.as_deref().unwrap_or(found.status.word()));
    }
    Ok(exit)
}

/// About which position.
fn about(pose: bool) -> &'static str {
    if pose {
        "assembled position"
    } else {
        "equilibrium"
    }
}

/// The modes for people.
fn page(opened: &Opened, pose: bool, found: &Linearised, written: &[PathBuf]) -> String {
    let mut page = Page::default();
    page.line(format!(
        "{} ({}): modes about the {}, {}",
        opened.name,
        opened.label,
        about(pose),
        status_words(found.status)
    ));
    page.row("mobility", mobility(&found.mobility));
    let place = if pose { "position" } else { "equilibrium" };
    page.rows(place, found.equilibrium.iter().map(equilibrium));
    let places = found.bodies.iter().map(|(name, place)| {
        let [x, y, angle] = place.map(|value| number(value, DIGITS));
        format!("{name}: x {x} m, y {y} m, angle {angle} rad")
    });
    page.rows("bodies", places);
    if !found.modes.is_empty() {
        let header =
            row(["mode", "f [Hz]", "ω₀ [rad/s]", "ζ [–]", "eigenvalue [1/s]"].map(String::from));
        page.rows(
            "modes",
            std::iter::once(header).chain(found.modes.iter().enumerate().map(mode_row)),
        );
    }
    page.rows(
        "shapes",
        found
            .modes
            .iter()
            .enumerate()
            .take(MOST_SHAPES)
            .map(|mode| shape(found, mode)),
    );
    page.rows("warnings", &found.warnings);
    page.rows(
        "written",
        written.iter().map(|path| path.display().to_string()),
    );
    page.text().to_string()
}

fn row([mode, hertz, omega, zeta, eigenvalue]: [String; 5]) -> String {
    format!("{mode:6}{hertz:14}{omega:14}{zeta:14}{eigenvalue}")
}

fn mode_row((k, mode): (usize, &Mode)) -> String {
    let [re, im] = mode.eigenvalue;
    let eigenvalue = match (re == 0.0, im == 0.0) {
        (_, true) => number(re, DIGITS),
        (true, false) => format!("± {} i", number(im, DIGITS)),
        (false, false) => format!("{} ± {} i", number(re, DIGITS), number(im, DIGITS)),
    };
    let omega = mode.frequency();
    let zeta = mode
        .damping_ratio()
        .map_or("–".into(), |zeta| number(zeta, DIGITS));
    row([
        (k + 1).to_string(),
        number(omega / TAU, DIGITS),
        number(omega, DIGITS),
        zeta,
        eigenvalue,
    ])
}

/// `1: crank 0, 0, 1; …`: a shape as far as it is in phase.
fn shape(found: &Linearised, (k, mode): (usize, &Mode)) -> String {
    // Round-off beside the largest component, which is 1, is not shown.
    let digits = |value: f64| {
        if value.abs() < 1e-12 {
            "0".into()
        } else {
            number(value, SHAPE_DIGITS)
        }
    };
    let complex = |[re, im]: [f64; 2]| match im.abs() < 1e-12 {
        true => digits(re),
        false => format!(
            "{}{}{} i",
            digits(re),
            if im < 0.0 { " − " } else { " + " },
            digits(im.abs())
        ),
    };
    let bodies = found.bodies.iter().zip(&mode.shape);
    let bodies =
        bodies.map(|((name, _), shape)| format!("{name} ({})", shape.map(complex).join(", ")));
    format!("{}: {}", k + 1, bodies.collect::<Vec<_>>().join(", "))
}

/// A row per mode.
fn table(found: &Linearised) -> Trajectory {
    let mut columns: Vec<Column> = [
        ("mode", "-"),
        ("frequency", "Hz"),
        ("omega", "rad/s"),
        ("damping_ratio", "-"),
        ("eigenvalue.re", "1/s"),
        ("eigenvalue.im", "rad/s"),
    ]
    .map(|(name, unit)| Column::new(name, unit))
    .into();
    for (name, _) in &found.bodies {
        for (quantity, unit) in [("x", "m"), ("y", "m"), ("angle", "rad")] {
            columns.extend(
                ["re", "im"].map(|part| Column::new(format!("{name}.{quantity}.{part}"), unit)),
            );
        }
    }
    let mut table = Trajectory::new(columns);
    for (k, mode) in found.modes.iter().enumerate() {
        let omega = mode.frequency();
        let zeta = mode.damping_ratio().unwrap_or(f64::NAN);
        let mut row = vec![
            (k + 1) as f64,
            omega / TAU,
            omega,
            zeta,
            mode.eigenvalue[0],
            mode.eigenvalue[1],
        ];
        row.extend(mode.shape.iter().flatten().flatten());
        table.push_row(&row);
    }
    table
}

/// Everything, for programs.
fn to_json(opened: &Opened, pose: bool, found: &Linearised) -> Value {
    let shape = |mode: &Mode| -> serde_json::Map<String, Value> {
        let bodies = found.bodies.iter().zip(&mode.shape);
        bodies
            .map(|((name, _), [x, y, angle])| {
                (name.clone(), json!({ "x": x, "y": y, "angle": angle }))
            })
            .collect()
    };
    let mode = |mode: &Mode| {
        json!({
            "frequency": mode.frequency() / TAU,
            "omega": mode.frequency(),
            "damping_ratio": mode.damping_ratio(),
            "eigenvalue": mode.eigenvalue,
            "shape": shape(mode),
        })
    };
    let bodies: serde_json::Map<String, Value> = found
        .bodies
        .iter()
        .map(|(name, [x, y, angle])| (name.clone(), json!({ "x": x, "y": y, "angle": angle })))
        .collect();
    json!({
        "status": found.status.word(),
        "message": found.message,
        "engine": env!("CARGO_PKG_VERSION"),
        "model": { "name": opened.name, "sha256": opened.sha256 },
        "about": if pose { "pose" } else { "equilibrium" },
        "equilibrium": found.equilibrium.as_ref().map(summary::equilibrium),
        "bodies": bodies,
        "mass": found.mass,
        "damping": found.damping,
        "stiffness": found.stiffness,
        "modes": found.modes.iter().map(mode).collect::<Vec<_>>(),
        "warnings": found.warnings,
    })
}
