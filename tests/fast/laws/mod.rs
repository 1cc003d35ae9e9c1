//! Laws that hold for every mechanism: what must not change when the same mechanism is told otherwise, and what must add up.
//!
//! Every bundled model and every model of a reference case is tried. Differences are measured against the largest value with
//! the same unit in the run, since round-off of one force is that of all forces its equations hold; torques also against
//! force times length, velocities against angular velocity times length.

mod otherwise;
mod sums;

use crate::models::{Named, all, load, load_bundled, solve, values};
use crate::transform::{
    is_absolute, mirror, rename_and_reverse, renamed, rotate, swap, swapped_signs, translate,
    turned,
};
use crate::write::{SI, WORKSHOP};
use linkdyn_engine::analysis::Outcome;
use linkdyn_model::{Analysis, AnalysisKind, ClearanceModel, DriverKind, JointKind, Model};
use linkdyn_output::{Column, EventKind, Status};
use std::collections::{BTreeMap, HashMap};

/// Every model of a prescribed motion with its analysis as it is; `dynamics.rs` has the laws of free motion. Clearance is
/// left out: what a massless link does depends on the outputs.
fn each_model() -> Vec<(String, Model)> {
    let models = all()
        .into_iter()
        .map(|Named { name, json }| (name, load(&json)))
        // Outputs name directions of the plane and things of the model, which the laws turn and rename.
        .map(|(name, model)| {
            let outputs = Default::default();
            (name, Model { outputs, ..model })
        });
    let prescribed = |model: &Model| {
        model
            .analysis
            .as_ref()
            .is_some_and(|a| a.kind == AnalysisKind::InverseDynamics)
    };
    models
        .filter(|(_, model)| prescribed(model) && !has_clearance(model))
        .collect()
}

fn has_clearance(model: &Model) -> bool {
    model.joints.values().any(|joint| match &joint.kind {
        JointKind::Revolute {
            clearance: Some(clearance),
            ..
        } => clearance.model != ClearanceModel::Ideal,
        _ => false,
    })
}

/// Largest relative differences of one comparison, by unit.
type Differences = BTreeMap<&'static str, f64>;

/// Largest magnitude per unit; velocities, accelerations, torques and energies at least what angular velocities and forces
/// make of them at the mechanism's size.
fn scales(outcome: &Outcome) -> HashMap<&'static str, f64> {
    let mut scales: HashMap<&'static str, f64> = HashMap::new();
    for (column, extremes) in outcome
        .trajectory
        .columns
        .iter()
        .zip(outcome.trajectory.extremes())
    {
        let largest = extremes.map_or(0.0, |e| e.min.abs().max(e.max.abs()));
        let scale = scales.entry(column.unit).or_default();
        *scale = scale.max(largest);
    }
    let of = |unit: &str| scales.get(unit).copied().unwrap_or_default();
    let (length, omega, force) = (of("m"), of("rad/s"), of("N"));
    let least = [
        ("m/s", omega * length),
        ("rad/s^2", omega * omega),
        ("m/s^2", omega * omega * length),
        ("N*m", force * length),
        ("J", force * length),
    ];
    for (unit, least) in least {
        scales
            .entry(unit)
            .and_modify(|scale| *scale = scale.max(least));
    }
    scales
}

/// A row of the original run.
struct Row<'a> {
    values: HashMap<&'a str, f64>,
}

impl Row<'_> {
    fn get(&self, column: &str) -> f64 {
        self.values[column]
    }

    /// The vector a component belongs to, with its place in it; none for scalars.
    fn vector(&self, column: &str) -> Option<(usize, [f64; 2], bool)> {
        let (owner, quantity) = column.rsplit_once('.')?;
        let [x, y] = match quantity {
            "x" | "y" => ["x", "y"],
            "vx" | "vy" => ["vx", "vy"],
            "ax" | "ay" => ["ax", "ay"],
            "fx" | "fy" => ["fx", "fy"],
            "ex" | "ey" => ["ex", "ey"],
            "contact_x" | "contact_y" => ["contact_x", "contact_y"],
            _ => return None,
        };
        let pair = [x, y].map(|quantity| self.get(&format!("{owner}.{quantity}")));
        Some((
            usize::from(quantity == y),
            pair,
            ["x", "y", "contact_x", "contact_y"].contains(&quantity),
        ))
    }
}

/// Compares a run with what the original lets expect: `expected` gives the column there and its value.
fn differ(
    original: &Outcome,
    other: &Outcome,
    expected: impl Fn(&Row, &Column) -> (String, f64),
) -> Differences {
    let (from, to) = (&original.trajectory, &other.trajectory);
    assert_eq!(
        original.report.status, other.report.status,
        "{:?}",
        other.report.message
    );
    assert_eq!((from.len(), from.width()), (to.len(), to.width()));
    let indices: HashMap<String, usize> = to
        .columns
        .iter()
        .enumerate()
        .map(|(k, c)| (c.name.clone(), k))
        .collect();
    let scales = scales(original);
    let mut differences = Differences::new();
    for (row, other_row) in from.rows().zip(to.rows()) {
        let row = Row {
            values: from
                .columns
                .iter()
                .map(|c| c.name.as_str())
                .zip(row.iter().copied())
                .collect(),
        };
        for column in from.columns.iter() {
            let (name, value) = expected(&row, column);
            let ours = other_row[indices[&name]];
            let difference = match (value.is_nan(), ours.is_nan()) {
                (true, true) => 0.0,
                (false, false) if value == ours => 0.0,
                (false, false) => (value - ours).abs() / scales[column.unit],
                (true, false) | (false, true) => f64::INFINITY,
            };
            let largest = differences.entry(column.unit).or_default();
            *largest = largest.max(difference);
        }
    }
    differences
}

/// Relative round-off allowed where J is regular: some hundred operations at a condition of up to 100.
const REGULAR: f64 = 1e-12;

/// Relative round-off allowed in a run, by unit.
///
/// A change point costs digits. Within a window around it positions come from a polynomial good to 1e-12, and a derivative
/// loses the window's width of about 1/30 rad each time. The reactions of the singular loop grow as 1/δ with the distance δ from
/// the change point [rad]; its place is known to 1e-12 rad, so they are known to 1e-12/δ.
fn allowed(run: &Outcome, unit: &str) -> f64 {
    let nearest = run
        .report
        .events
        .iter()
        .filter(|event| event.kind == EventKind::ChangePoint)
        .filter_map(|event| {
            let driver = format!("driver.{}.value", event.driver.as_deref()?);
            let distances = values(run, &driver)
                .into_iter()
                .map(|value| (value - event.value.unwrap_or(f64::NAN)).abs());
            Some(distances.fold(f64::INFINITY, f64::min))
        });
    match (nearest.reduce(f64::min), unit) {
        (None, _) => REGULAR,
        (Some(distance), "N") => 1e-12 / distance,
        (Some(_), "m/s" | "rad/s") => 30.0 * 1e-12,
        (Some(_), "m/s^2" | "rad/s^2") => 30.0 * 30.0 * 1e-12,
        (Some(_), _) => REGULAR,
    }
}

fn words(differences: &Differences) -> String {
    let words = |(unit, difference): (&&str, &f64)| format!("{difference:.1e} [{unit}]");
    differences.iter().map(words).collect::<Vec<_>>().join(", ")
}

/// Asserts that no difference is above what round-off allows; all at once.
#[track_caller]
fn hold(law: &str, found: Vec<(String, Outcome, Differences)>) {
    let mut faults = Vec::new();
    for (name, run, differences) in found {
        println!("{law}: {name}: {}", words(&differences));
        for (unit, difference) in differences {
            if difference > allowed(&run, unit) {
                faults.push(format!(
                    "{law}: {name}: {unit} differs by {difference:.1e} of the largest"
                ));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The quantity of a column, behind its last dot.
fn quantity(column: &Column) -> &str {
    column
        .name
        .rsplit_once('.')
        .map_or("", |(_, quantity)| quantity)
}

/// The driver a column tells about.
fn driver_of<'a>(column: &'a Column, rest: &str) -> Option<&'a str> {
    column.name.strip_prefix("driver.")?.strip_suffix(rest)
}

/// A mechanism with one massless clearance link, ideal for radius 0.
fn with_clearance(name: &str, joint: &str, radius: f64) -> Model {
    let clearance = if radius > 0.0 {
        "massless_link"
    } else {
        "ideal"
    };
    // The ideal model takes no notice of its radius.
    let radius = if radius > 0.0 { radius } else { 1e-5 };
    let mut sets = vec![format!(
        "joints.{joint}.clearance={{\"model\":\"{clearance}\",\"radius\":\"{radius} m\"}}"
    )];
    if name == "lock" {
        sets.push(
            "analysis.sample={\"driver\":\"motor\",\"from\":\"-50 deg\",\"to\":\"100 deg\",\"step\":\"0.5 deg\"}"
                .into(),
        );
    }
    load_bundled(name, &sets.iter().map(String::as_str).collect::<Vec<_>>())
}

/// With the radius the difference to the ideal mechanism goes to zero, in proportion: halved by half the radius.
#[test]
fn a_vanishing_clearance_is_an_ideal_joint() {
    for (name, joint) in [
        ("four-bar", "b"),
        ("slider-crank", "crankpin"),
        ("stephenson-iii", "e"),
        ("lock", "a"),
        ("lock", "f"),
    ] {
        let ideal = solve(&with_clearance(name, joint, 0.0));
        let far = |radius: f64| {
            let outcome = solve(&with_clearance(name, joint, radius));
            assert_eq!(outcome.report.status, Status::Completed, "{name}");
            assert!(
                outcome.report.warnings.is_empty(),
                "{name} {joint} {radius}: {:?}",
                outcome.report.warnings
            );
            let places = ideal
                .trajectory
                .columns
                .iter()
                .filter(|column| column.name.ends_with(".x") || column.name.ends_with(".y"));
            let distances = places.map(|column| {
                let pairs = values(&ideal, &column.name)
                    .into_iter()
                    .zip(values(&outcome, &column.name));
                pairs.fold(0.0, |m: f64, (ideal, ours)| m.max((ideal - ours).abs()))
            });
            distances.fold(0.0, f64::max)
        };
        let distances = [4e-6, 2e-6, 1e-6].map(far);
        let ratios = [distances[0] / distances[1], distances[1] / distances[2]];
        println!("{name} {joint}: {distances:?}, ratios {ratios:?}");
        assert!(
            ratios.iter().all(|ratio| (ratio - 2.0).abs() <= 0.02),
            "{name} {joint}: {distances:?}, ratios {ratios:?}"
        );
    }
}
