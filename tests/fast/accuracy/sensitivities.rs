//! Sensitivities against central differences of other models: every number of the geometry of all models is a parameter.

use super::told::{Random, Told, ask_outputs, is_counted, parametric};
use crate::models;
use linkdyn_model::{Checked, Model};
use linkdyn_variation::{Accuracy, Refusal};
use serde_json::json;

/// Length of a step along a direction of all parameters: what is left out goes with its fourth power, round-off with its
/// inverse.
const STEP: f64 = 5e-5;
/// Off the largest by this, where change points are far.
const ALLOWED: f64 = 1e-7;
/// A deviation that an output can't have without a change of the branch \[m\] or \[rad\].
const JUMP: f64 = 0.1;
/// Instants of a stroke.
const INSTANTS: usize = 4;

/// Models whose motion no driver says, or whose joints repeat themselves.
fn refused(said: &Refusal) -> bool {
    match said {
        Refusal::Input(complaints) => complaints.iter().all(|complaint| {
            complaint.message.contains("too few drivers")
                || complaint.message.contains("hold the same freedom")
        }),
        Refusal::Failed(message) => message.contains("singular position"),
    }
}

/// The nominal values by output and pose.
fn nominal(found: &Accuracy) -> Vec<Vec<f64>> {
    let outputs = found.outputs.iter();
    outputs
        .map(|output| output.poses.iter().map(|pose| pose.nominal).collect())
        .collect()
}

struct Tally {
    worst: f64,
    what: String,
    compared: usize,
}

/// Where parameters stand among the sources.
fn sources(found: &Accuracy, names: &[&str]) -> Vec<Option<usize>> {
    names
        .iter()
        .map(|name| {
            let source = format!("parameters.{name}");
            found.sources.iter().position(|own| *own == source)
        })
        .collect()
}

/// Compares along directions of all parameters.
fn compare(name: &str, told: &Told, tally: &mut Tally, random: &mut Random) {
    let found = told.answer();
    let names: Vec<&str> = told
        .loaded
        .parameters
        .iter()
        .map(|p| p.name.as_str())
        .collect();
    let by_source = sources(&found, &names);
    let direction: Vec<f64> = names
        .iter()
        .map(|_| random.both().signum() / (names.len() as f64).sqrt())
        .collect();
    let moved = |by: f64| -> Option<Vec<Vec<f64>>> {
        let all = names.iter().copied().zip(direction.iter().map(|d| d * by));
        let all: Vec<(&str, f64)> = all.collect();
        let model: Checked = told.loaded.source.with_deviations(&all).expect("legal");
        match told.ask(&model) {
            Ok(found) => Some(nominal(&found)),
            // Just before a dead centre a deviation takes the pose away.
            Err(Refusal::Input(said))
                if said.iter().all(|fault| fault.message.contains("locks")) =>
            {
                None
            }
            Err(said) => panic!("{name}: {said:?}"),
        }
    };
    let all = [-STEP, STEP, -2.0 * STEP, 2.0 * STEP].map(moved);
    let [Some(a), Some(b), Some(c), Some(d)] = all else {
        return;
    };
    let (near, far) = ([a, b], [c, d]);
    let poses = [&near[0], &near[1], &far[0], &far[1]]
        .iter()
        .map(|all| all[0].len())
        .fold(found.outputs[0].poses.len(), usize::min);
    for pose in 0..poses {
        let own = |k: usize| &found.outputs[k].poses[pose];
        let jumps = |k: usize| {
            let all = [&near[0], &near[1], &far[0], &far[1]];
            all.iter()
                .any(|moved| (moved[k][pose] - own(k).nominal).abs() > JUMP)
        };
        let outputs = 0..found.outputs.len();
        if outputs
            .clone()
            .any(|k| own(k).contributions.is_empty() || jumps(k))
        {
            continue;
        }
        tally.compared += 1;
        for unit in ["rad", "m"] {
            let of_unit = outputs.clone().filter(|&k| found.outputs[k].unit == unit);
            let pairs: Vec<(usize, f64, f64)> = of_unit
                .map(|k| {
                    let expected = (8.0 * (near[1][k][pose] - near[0][k][pose])
                        - (far[1][k][pose] - far[0][k][pose]))
                        / (12.0 * STEP);
                    let said = direction.iter().zip(&by_source).map(|(d, source)| {
                        d * source.map_or(0.0, |source| own(k).contributions[source].sensitivity)
                    });
                    (k, said.sum(), expected)
                })
                .collect();
            let size = pairs.iter().map(|pair| pair.2.abs()).fold(1e-3, f64::max);
            for (k, said, expected) in pairs {
                let off = (said - expected).abs() / size;
                if off > tally.worst || off.is_nan() {
                    tally.worst = off;
                    tally.what = format!(
                        "{name} {} at {:?}: {said} instead of {expected}",
                        found.outputs[k].of,
                        own(k).drivers
                    );
                }
            }
        }
    }
}

/// Over the stroke, and at a value of the driver.
fn examine(name: &str, model: &Model, random: &mut Random) -> Result<Tally, Refusal> {
    let mut json = parametric(model, INSTANTS);
    for driver in json["drivers"]
        .as_object_mut()
        .expect("drivers")
        .values_mut()
    {
        driver["tolerance"] = json!(1e-9);
    }
    ask_outputs(&mut json, model, None);
    let told = Told::read(&json).unwrap_or_else(|said| panic!("{name}: {said}"));
    let found = told.ask(&told.loaded.model)?;
    let mut tally = Tally {
        worst: 0.0,
        what: String::new(),
        compared: 0,
    };
    compare(name, &told, &mut tally, random);
    if let ([driver], false) = (
        &found.outputs[0].poses[1].drivers[..],
        model.drivers.is_empty(),
    ) {
        ask_outputs(&mut json, model, Some(*driver));
        let told = Told::read(&json).unwrap_or_else(|said| panic!("{name}: {said}"));
        compare(&format!("{name} (held)"), &told, &mut tally, random);
    }
    Ok(tally)
}

#[test]
fn sensitivities_are_those_of_central_differences() {
    let mut random = Random(1);
    let (mut skipped, mut faults) = (Vec::new(), Vec::new());
    let mut tried = 0;
    for named in models::all() {
        let model = models::load(&named.json);
        // Beyond its change point a mechanism that is off goes on another branch.
        let beside = named.name == "case lock-near-change-point";
        if beside || model.drivers.is_empty() || model.analysis.is_none() || !is_counted(&model) {
            continue;
        }
        match examine(&named.name, &model, &mut random) {
            Err(said) => {
                assert!(refused(&said), "{}: {said:?}", named.name);
                skipped.push(named.name);
            }
            Ok(tally) => {
                tried += 1;
                println!(
                    "{:40} {:.1e} {:3} {}",
                    named.name, tally.worst, tally.compared, tally.what
                );
                if !(tally.worst <= ALLOWED && tally.compared > 0) {
                    faults.push(format!(
                        "{} poses, {:e}, {}",
                        tally.compared, tally.worst, tally.what
                    ));
                }
            }
        }
    }
    println!("{tried} models; not asked: {}", skipped.join(", "));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(tried >= 35, "{tried}");
}

#[test]
fn numbers_of_all_laws_of_motion_have_their_influence() {
    let mut random = Random(2);
    let motions = [
        json!({ "type": "constant_velocity", "start": 1.0, "velocity": 2.0 }),
        json!({ "type": "constant_acceleration", "start": 1.0, "velocity": 0.2, "acceleration": 0.7 }),
        json!({ "type": "harmonic", "offset": 1.1, "amplitude": 0.3, "frequency": 0.9, "phase": 0.4 }),
        json!({ "type": "table", "points": [[0.0, 1.0], [0.3, 1.4], [0.6, 1.1], [1.2, 2.0]] }),
        json!({ "type": "polynomial", "coefficients": [1.0, 0.4, -0.3, 0.1] }),
        json!({ "type": "table", "interpolation": "periodic", "points": [[0.0, 1.0], [0.3, 1.4], [0.6, 1.1], [1.2, 1.3]] }),
        json!({ "type": "cycloidal", "start": 1.0, "rise": 0.7, "duration": 0.8 }),
        json!({ "type": "s_curve", "start": 1.0, "end": 1.7, "duration": 0.8 }),
        json!({ "type": "sequence", "start": 1.0, "repeat": 2, "segments": [
            { "law": "modified_sine", "rise": 0.7, "duration": 0.3 },
            { "law": "trapezoidal_velocity", "end": 1.2, "duration": 0.2 }] }),
    ];
    for motion in motions {
        let mut json = models::load_bundled("four-bar", &[]).to_json();
        json["drivers"]["motor"]["motion"] = motion.clone();
        let model = models::load(&json);
        let tally = examine(&motion.to_string(), &model, &mut random).expect("an answer");
        println!("{:.1e} {}", tally.worst, tally.what);
        assert!(
            tally.compared > 0 && tally.worst <= ALLOWED,
            "{}: {:e}",
            tally.what,
            tally.worst
        );
    }
}
