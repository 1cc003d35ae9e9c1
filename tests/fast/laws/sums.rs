//! What must add up.

use super::*;

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
                "normal_force" | "tangential_force" | "state" | "tight" | "slack" => 1.0,
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
