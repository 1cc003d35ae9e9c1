//! Laws that hold for every mechanism: what must not change when the same mechanism is told otherwise, and what must add up.
//!
//! Every bundled model and every model of a reference case is tried. Differences are measured against the largest value with
//! the same unit in the run, since round-off of one force is that of all forces its equations hold; torques also against
//! force times length, velocities against angular velocity times length.

use crate::models::{Named, all, load, load_bundled, solve, values};
use crate::transform::{
    is_absolute, mirror, rename_and_reverse, renamed, rotate, swap, swapped_signs, translate,
    turned,
};
use crate::write::{SI, WORKSHOP};
use linkdyn_engine::analysis::Outcome;
use linkdyn_model::{Analysis, AnalysisKind, ClearanceModel, DriverKind, JointKind, Model};
use linkdyn_output::{Column, Status};
use std::collections::{BTreeMap, HashMap};

/// Every model of a prescribed motion with its analysis as it is; `dynamics.rs` has the laws of free motion. Clearance is
/// left out: what a massless link does depends on the outputs.
fn each_model() -> Vec<(String, Model)> {
    let models = all()
        .into_iter()
        .map(|Named { name, json }| (name, load(&json)));
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
        JointKind::Revolute {
            clearance: None, ..
        }
        | JointKind::Prismatic { .. }
        | JointKind::Slot { .. }
        | JointKind::Gear { .. }
        | JointKind::Fixed { .. } => false,
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
            _ => return None,
        };
        let pair = [x, y].map(|quantity| self.get(&format!("{owner}.{quantity}")));
        Some((
            usize::from(quantity == y),
            pair,
            quantity == x && x == "x" || quantity == y && y == "y",
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
        .filter(|event| event.kind == "change_point")
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

#[test]
fn turning_the_world_turns_the_results() {
    let angle = 0.7;
    let found = each_model().into_iter().map(|(name, model)| {
        let (original, turned_run) = (solve(&model), solve(&rotate(&model, angle)));
        let differences = differ(&original, &turned_run, |row, column| {
            let value = match row.vector(&column.name) {
                Some((component, pair, _)) => turned(pair, angle)[component],
                None => {
                    let absolute = driver_of(column, ".value")
                        .is_some_and(|driver| is_absolute(&model.drivers[driver]));
                    row.get(&column.name)
                        + if quantity(column) == "angle" || absolute {
                            angle
                        } else {
                            0.0
                        }
                }
            };
            (column.name.clone(), value)
        });
        (name, original, differences)
    });
    hold("rotate", found.collect());
}

#[test]
fn moving_the_world_changes_nothing_but_places() {
    let by = [0.31, -0.17];
    let found = each_model().into_iter().map(|(name, model)| {
        let (original, moved) = (solve(&model), solve(&translate(&model, by)));
        let weight: f64 = model.bodies.values().filter_map(|body| body.mass).sum();
        let lifted = -weight * (model.gravity[0] * by[0] + model.gravity[1] * by[1]);
        let differences = differ(&original, &moved, |row, column| {
            let value = row.get(&column.name);
            let shift = match row.vector(&column.name) {
                Some((component, _, true)) => by[component],
                Some((_, _, false)) => 0.0,
                None if column.name == "energy.potential" => lifted,
                None => 0.0,
            };
            (column.name.clone(), value + shift)
        });
        (name, original, differences)
    });
    hold("translate", found.collect());
}

#[test]
fn a_mirror_changes_signs_only() {
    let found = each_model().into_iter().map(|(name, model)| {
        let (original, mirrored) = (solve(&model), solve(&mirror(&model)));
        let differences = differ(&original, &mirrored, |row, column| {
            let turns =
                |driver: &str| matches!(model.drivers[driver].kind, DriverKind::Rotation { .. });
            let sign = match (row.vector(&column.name), quantity(column)) {
                (Some((0, _, _)), _) | (None, "angle" | "omega" | "alpha" | "torque") => -1.0,
                (None, "sliding_speed" | "tangential_force") => -1.0,
                (None, "friction") if column.unit == "N*m" => -1.0,
                (None, "value") if driver_of(column, ".value").is_some_and(turns) => -1.0,
                (None, "effort") if driver_of(column, ".effort").is_some_and(turns) => -1.0,
                (Some(_) | None, _) => 1.0,
            };
            (column.name.clone(), sign * row.get(&column.name))
        });
        (name, original, differences)
    });
    hold("mirror", found.collect());
}

#[test]
fn names_and_order_do_not_matter() {
    let found = each_model().into_iter().map(|(name, model)| {
        let (original, other) = (solve(&model), solve(&rename_and_reverse(&model)));
        let differences = differ(&original, &other, |row, column| {
            let parts: Vec<&str> = column.name.split('.').collect();
            let new = match parts[..] {
                ["joint", joint, quantity] => format!("joint.{}.{quantity}", renamed(joint)),
                ["driver", driver, quantity] => format!("driver.{}.{quantity}", renamed(driver)),
                ["energy", _] | [_] => column.name.clone(),
                [body, quantity] => format!("{}.{quantity}", renamed(body)),
                [body, point, quantity] => {
                    format!("{}.{}.{quantity}", renamed(body), renamed(point))
                }
                _ => panic!("{parts:?}"),
            };
            (new, row.get(&column.name))
        });
        (name, original, differences)
    });
    hold("rename", found.collect());
}

#[test]
fn reactions_are_opposite_and_equal() {
    let found = each_model().into_iter().map(|(name, model)| {
        let (original, other) = (solve(&model), solve(&swap(&model)));
        let differences = differ(&original, &other, |row, column| {
            let joint = column
                .name
                .strip_prefix("joint.")
                .and_then(|rest| rest.split('.').next());
            let [force, torque] =
                joint.map_or([1.0; 2], |joint| swapped_signs(&model.joints[joint]));
            // The eccentricity, journal minus bearing, is zero here and has either sign.
            let sign = match quantity(column) {
                "torque" => torque,
                "normal_force" | "tangential_force" | "state" => 1.0,
                // Bearing and journal have other radii.
                "sliding_speed" => return ("time".into(), row.get("time")),
                _ => force,
            };
            (column.name.clone(), sign * row.get(&column.name))
        });
        (name, original, differences)
    });
    hold("swap", found.collect());
}

#[test]
fn units_are_only_words() {
    let found = each_model().into_iter().map(|(name, model)| {
        let original = solve(&load(&SI.write(&model)));
        let workshop = solve(&load(&WORKSHOP.write(&model)));
        let differences = differ(&original, &workshop, |row, column| {
            (column.name.clone(), row.get(&column.name))
        });
        (name, original, differences)
    });
    hold("units", found.collect());
}

/// The same model with another number of equally spaced outputs.
fn with_outputs(model: &Model, intervals: usize) -> Model {
    let mut model = model.clone();
    let analysis = model.analysis.as_mut().expect("an analysis");
    match &mut analysis.sample {
        Some(sample) => sample.step = (sample.to - sample.from) / intervals as f64,
        None => analysis.outputs = Some(intervals + 1),
    }
    model
}

#[test]
fn outputs_do_not_change_the_motion() {
    let mut found = Vec::new();
    for (name, model) in each_model() {
        let runs: Vec<(usize, Outcome)> = [2, 3, 7, 36, 71, 176, 1751, 2000]
            .map(|outputs: usize| (outputs - 1, solve(&with_outputs(&model, outputs - 1))))
            .into();
        let (finest, reference) = &runs[6];
        let scales = scales(reference);
        let mut differences = Differences::new();
        for (intervals, run) in &runs {
            assert_eq!(
                run.report.status,
                Status::Completed,
                "{name}: {intervals}: {:?}",
                run.report.message
            );
            assert_eq!(run.trajectory.len(), intervals + 1, "{name}");
            for k in 0..=*intervals {
                // Instant k of `intervals` is instant k·finest/intervals of the finest, where that is whole.
                if (k * finest) % intervals != 0 {
                    continue;
                }
                let (ours, theirs) = (
                    run.trajectory.row(k),
                    reference.trajectory.row(k * finest / intervals),
                );
                for ((column, ours), theirs) in run.trajectory.columns.iter().zip(ours).zip(theirs)
                {
                    let difference = if ours == theirs {
                        0.0
                    } else {
                        (ours - theirs).abs() / scales[column.unit]
                    };
                    let largest = differences.entry(column.unit).or_default();
                    *largest = if difference.is_nan() {
                        f64::INFINITY
                    } else {
                        largest.max(difference)
                    };
                }
            }
        }
        let reference = runs.into_iter().nth(6).expect("the finest but one").1;
        found.push((name, reference, differences));
    }
    hold("outputs", found);
}

#[test]
fn kept_columns_are_the_same_to_the_last_bit() {
    for (name, mut model) in each_model() {
        let whole = solve(&model);
        let kept: Vec<Column> = whole
            .trajectory
            .columns
            .iter()
            .step_by(7)
            .cloned()
            .collect();
        model.analysis.as_mut().expect("an analysis").columns =
            kept.iter().map(|column| column.name.clone()).collect();
        let part = solve(&model);
        assert_eq!(part.trajectory.columns[..], kept, "{name}");
        for column in &kept {
            let bits = |outcome: &Outcome| {
                values(outcome, &column.label())
                    .into_iter()
                    .map(f64::to_bits)
                    .collect::<Vec<_>>()
            };
            assert!(bits(&whole) == bits(&part), "{name}: {}", column.name);
        }
        assert_eq!(whole.report.statistics, part.report.statistics, "{name}");
    }
}

#[test]
fn runs_repeat_to_the_last_bit() {
    for (name, model) in each_model() {
        let (first, second) = (solve(&model), solve(&model));
        let bits = |outcome: &Outcome| {
            outcome
                .trajectory
                .data
                .iter()
                .map(|value| value.to_bits())
                .collect::<Vec<_>>()
        };
        assert!(bits(&first) == bits(&second), "{name}");
        assert_eq!(first.report.statistics, second.report.statistics, "{name}");
        assert_eq!(first.report.events, second.report.events, "{name}");
    }
}

/// Power of drivers and forces against the change of kinetic energy, and constraints against round-off: twelve digits of
/// the mechanism's size, nine of the power that flows (accelerations and forces lose some digits to the condition of J).
#[test]
fn constraints_hold_and_power_balances() {
    for (name, model) in each_model() {
        let quality = solve(&model).report.quality;
        println!("{name}: {quality:?}");
        assert!(quality.constraint_residual <= 1e-12, "{name}: {quality:?}");
        assert!(
            quality.power_imbalance.expect("forces are known") <= 1e-9,
            "{name}: {quality:?}"
        );
    }
}

/// The analysis from 0 to the last instant, with `outputs` instants equally spaced in time.
fn in_time(model: &Model, outputs: usize) -> Model {
    let mut model = model.clone();
    let end = *values(&solve(&model), "time").last().expect("rows");
    let analysis = model.analysis.as_ref().expect("an analysis");
    model.analysis = Some(Analysis {
        end: Some(end),
        outputs: Some(outputs),
        sample: None,
        ..analysis.clone()
    });
    model
}

/// Velocities are the derivatives of places, accelerations those of velocities: by differences of fourth order, whose error
/// h⁴ f⁗′/30 is told by taking h and 2h (a factor 16).
#[test]
fn velocities_and_accelerations_are_derivatives() {
    let mut faults = Vec::new();
    for (name, model) in each_model() {
        let outcome = solve(&in_time(&model, 2001));
        let step = values(&outcome, "time")[1];
        let scales = scales(&outcome);
        for column in outcome.trajectory.columns.iter() {
            let (owner, rate) = match column.name.rsplit_once('.') {
                Some((owner, "x")) => (owner, "vx"),
                Some((owner, "y")) => (owner, "vy"),
                Some((owner, "angle")) => (owner, "omega"),
                Some((owner, "vx")) => (owner, "ax"),
                Some((owner, "vy")) => (owner, "ay"),
                Some((owner, "omega")) => (owner, "alpha"),
                Some(_) | None => continue,
            };
            let (f, rates) = (
                values(&outcome, &column.name),
                values(&outcome, &format!("{owner}.{rate}")),
            );
            let rate_column = outcome
                .trajectory
                .column_index(&format!("{owner}.{rate}"))
                .expect("there");
            let (size, scale) = (
                scales[column.unit],
                scales[outcome.trajectory.columns[rate_column].unit],
            );
            let mut worst = (0.0, 0);
            for k in 4..f.len() - 4 {
                let difference = |h: usize| {
                    (8.0 * (f[k + h] - f[k - h]) - (f[k + 2 * h] - f[k - 2 * h]))
                        / (12.0 * step * h as f64)
                };
                let (fine, coarse) = (difference(1), difference(2));
                // The coarse error is about 16 times the fine one; round-off of f is divided by the step.
                let error = (fine - coarse).abs() + 1e-12 * (scale + size / step);
                let share = (fine - rates[k]).abs() / error;
                if share > worst.0 {
                    worst = (share, k);
                }
            }
            if worst.0 > 1.0 {
                let k = worst.1;
                faults.push(format!(
                    "{name}: {owner}.{rate} at row {k}: {} times its tolerance",
                    worst.0
                ));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Work of the driver is the change of energy where nothing else does work (Simpson's rule over 2000 intervals).
#[test]
fn work_becomes_energy() {
    for (name, crank) in [
        ("four-bar", "crank"),
        ("parallel-crank", "crank1"),
        ("stephenson-iii", "crank"),
        ("lock", "link6"),
    ] {
        let model = in_time(
            &load_bundled(
                name,
                &["analysis={\"type\":\"inverse_dynamics\",\"end\":0.8,\"outputs\":3}"],
            ),
            2001,
        );
        let outcome = solve(&model);
        let (time, effort, omega) = (
            values(&outcome, "time"),
            values(&outcome, "driver.motor.effort"),
            values(&outcome, &format!("{crank}.omega")),
        );
        let power: Vec<f64> = effort
            .iter()
            .zip(&omega)
            .map(|(effort, omega)| effort * omega)
            .collect();
        let energy: Vec<f64> = values(&outcome, "energy.kinetic")
            .iter()
            .zip(values(&outcome, "energy.potential"))
            .map(|(kinetic, potential)| kinetic + potential)
            .collect();
        let step = time[1] - time[0];
        let (mut work, mut largest) = (0.0, 0.0_f64);
        for k in (2..time.len()).step_by(2) {
            work += step / 3.0 * (power[k - 2] + 4.0 * power[k - 1] + power[k]);
            largest = largest.max((work - (energy[k] - energy[0])).abs());
        }
        let flow = energy
            .iter()
            .fold(0.0, |m: f64, e| m.max((e - energy[0]).abs()));
        println!("{name}: {largest:e} of {flow} J");
        assert!(largest <= 1e-8 * flow, "{name}: {largest:e} of {flow} J");
    }
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
