//! Accelerations by one sparse matrix, against those by tangents, published positions and laws.

use super::{completed, energy_drift};
use crate::benchmarks::{chain, chain_tip};
use crate::mechanisms::{column, model, pin, rod};
use crate::models::{Named, all, load};
use linkdyn_engine::analysis::Outcome;
use linkdyn_model::AnalysisKind;
use linkdyn_output::Status;
use serde_json::{Value, json};
use std::collections::HashMap;
use std::f64::consts::PI;

/// Differences of the two ways, by the largest value of the unit.
const SAME: f64 = 1e-6;
/// The same where contacts multiply what differs.
const SAME_WITH_CONTACTS: f64 = 1e-4;

pub(super) fn solved(json: &Value, accelerations: &str, solver: &Value) -> Outcome {
    let mut json = json.clone();
    json["analysis"]["solver"] = solver.clone();
    json["analysis"]["solver"]["accelerations"] = json!(accelerations);
    linkdyn_engine::analysis::run(
        &crate::models::checked(&load(&json)),
        &linkdyn_engine::analysis::Control::default(),
    )
    .unwrap_or_else(|complaints| panic!("{complaints:?}"))
}

/// Largest difference of any column, by the largest value of its unit, and whether all bits are the same.
pub(super) fn difference(one: &Outcome, other: &Outcome) -> (f64, bool) {
    let columns = &one.trajectory.columns;
    let mut largest: HashMap<&str, f64> = HashMap::new();
    for row in one.trajectory.rows() {
        for (column, value) in columns.iter().zip(row) {
            let most = largest.entry(column.unit).or_default();
            *most = most.max(value.abs());
        }
    }
    let mut worst = 0.0_f64;
    for (row, beside) in one.trajectory.rows().zip(other.trajectory.rows()) {
        for ((column, a), b) in columns.iter().zip(row).zip(beside) {
            let scale = largest[column.unit].max(1e-9);
            worst = worst.max(if a.is_nan() && b.is_nan() {
                0.0
            } else {
                (a - b).abs() / scale
            });
        }
    }
    (worst, one.trajectory.data == other.trajectory.data)
}

/// Every free motion of the bundled models and the reference cases, solved both ways. A curve of one coordinate has its
/// tangent either way.
#[test]
fn both_ways_give_the_same_motion() {
    let (mut other_bits, mut compared) = (0, 0);
    for Named { name, json } in all() {
        let model = load(&json);
        let analysis = model.analysis.as_ref();
        if !analysis.is_some_and(|analysis| analysis.kind == AnalysisKind::Dynamics) {
            continue;
        }
        let has_contacts = json["joints"].to_string().contains("\"contact\"")
            || json["joints"].to_string().contains("_state\"");
        let solver = if has_contacts {
            json!({ "rtol": 1e-8, "atol": 1e-12 })
        } else {
            json!({ "rtol": 1e-10, "atol": 1e-13 })
        };
        let [dense, sparse] = ["dense", "sparse"].map(|way| solved(&json, way, &solver));
        assert_eq!(dense.report.status, sparse.report.status, "{name}");
        if dense.report.status != Status::Completed {
            continue;
        }
        let (worst, is_same) = difference(&dense, &sparse);
        println!("{name}: {worst:e}, the same bits: {is_same}");
        let most = if has_contacts {
            SAME_WITH_CONTACTS
        } else {
            SAME
        };
        assert!(worst <= most, "{name}: off by {worst:e}");
        compared += 1;
        other_bits += usize::from(!is_same);
    }
    assert!(
        compared >= 10 && other_bits >= 4,
        "{other_bits} of {compared}"
    );
}

/// Tips after one second by another engine.
#[test]
fn chains_fall_as_in_another_engine() {
    for links in [10, 20] {
        let tip = chain_tip(links);
        let outcome = solved(
            &chain(links),
            "sparse",
            &json!({ "rtol": 1e-8, "atol": 1e-11 }),
        );
        for (axis, expected) in ["x", "y"].iter().zip(tip) {
            let name = format!("l{}.B.{axis}", links - 1);
            let found = *column(&outcome, &name).last().expect("rows");
            assert!(
                (found - expected).abs() < 3e-7,
                "{links} links, {axis}: {found}, not {expected}"
            );
        }
        assert!(energy_drift(&outcome) < 1e-7);
    }
}

/// A ladder of loops that floats freely: three rails of rods and the rungs between them, turning and bending.
fn net(cells: usize) -> Value {
    let mut bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } } });
    let mut joints = json!({});
    for rail in 0..3 {
        for k in 0..cells {
            let name = format!("r{rail}_{k}");
            bodies[&name] = rod(1.0, [k as f64, rail as f64], 0.0);
            if k > 0 {
                joints[format!("p{rail}_{k}")] =
                    pin(&format!("r{rail}_{}.B", k - 1), &format!("{name}.A"));
            }
        }
    }
    for rail in 0..2 {
        for k in 0..cells {
            let name = format!("s{rail}_{k}");
            bodies[&name] = rod(1.0, [k as f64, rail as f64], PI / 2.0);
            joints[format!("a{rail}_{k}")] = pin(&format!("r{rail}_{k}.A"), &format!("{name}.A"));
            joints[format!("b{rail}_{k}")] =
                pin(&format!("r{}_{k}.A", rail + 1), &format!("{name}.B"));
        }
    }
    let mut net = model(bodies, joints, json!({}));
    net["gravity"] = json!([0.0, 0.0]);
    net["initial"] = json!({ format!("r0_{}", cells - 1): { "angular_velocity": 2.0 },
        "s1_0": { "angular_velocity": -1.5 } });
    net
}

/// Momentum and angular momentum of a net at each output, and the largest share of a body.
fn momenta(net: &Value, outcome: &Outcome) -> (Vec<[f64; 3]>, f64) {
    let mut sums = vec![[0.0; 3]; outcome.trajectory.len()];
    let mut size = 0.0_f64;
    let names = net["bodies"].as_object().expect("bodies").keys();
    for name in names.filter(|name| *name != "ground") {
        let of = |q: &str| column(outcome, &format!("{name}.{q}"));
        let (x, y, angle) = (of("x"), of("y"), of("angle"));
        let (vx, vy, omega) = (of("vx"), of("vy"), of("omega"));
        for (row, sum) in sums.iter_mut().enumerate() {
            // columns are of the body's origin, half a rod from its centre of mass
            let (sin, cos) = angle[row].sin_cos();
            let (cx, cy) = (x[row] + 0.5 * cos, y[row] + 0.5 * sin);
            let (ux, uy) = (
                vx[row] - 0.5 * sin * omega[row],
                vy[row] + 0.5 * cos * omega[row],
            );
            let own = [ux, uy, cx * uy - cy * ux + omega[row] / 12.0];
            sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
            size = own.iter().fold(size, |most, part| most.max(part.abs()));
        }
    }
    (sums, size)
}

/// Momentum and angular momentum of a free net stay what they are, and so does its energy, but for the errors of the steps.
#[test]
fn a_free_net_of_loops_keeps_its_momenta_and_its_energy() {
    let mut net = net(12);
    let mut drifts = Vec::new();
    // beyond 1e-8 round-off says more, with dense matrices as well
    for rtol in [1e-6, 1e-8] {
        net["analysis"] = json!({ "type": "dynamics", "end": 2.0, "outputs": 41,
            "solver": { "rtol": rtol, "atol": 1e-3 * rtol, "accelerations": "sparse" } });
        let outcome = completed(&net);
        let freedom = outcome.report.mobility.rank;
        assert!(freedom >= 14, "{freedom} degrees of freedom");
        let (sums, size) = momenta(&net, &outcome);
        let off = |sum: &[f64; 3]| {
            let parts = sum.iter().zip(&sums[0]);
            parts.fold(0.0, |most, (sum, start)| {
                f64::max(most, (sum - start).abs() / size)
            })
        };
        let drift = sums.iter().map(off).fold(energy_drift(&outcome), f64::max);
        let steps = outcome.report.statistics.steps as f64;
        println!("{freedom} degrees of freedom, rtol {rtol:e}: {drift:e} in {steps} steps");
        assert!(
            drift <= 10.0 * rtol * steps,
            "{drift:e} at {rtol:e} in {steps} steps"
        );
        drifts.push(drift);
    }
    assert!(drifts[1] < 1e-2 * drifts[0], "{drifts:?}");
}

/// Friction in the pins of a chain, whose size follows from multipliers, found both ways.
#[test]
fn friction_in_a_chain_is_the_same_both_ways() {
    let mut chain = chain(6);
    for (_, joint) in chain["joints"].as_object_mut().expect("joints") {
        joint["friction"] =
            json!({ "law": "threlfall", "coefficient": 0.1, "threshold_velocity": 0.01 });
        joint["pin_radius"] = json!(0.01);
    }
    chain["analysis"]["end"] = json!(0.3);
    let solver = json!({ "rtol": 1e-9, "atol": 1e-12 });
    let [dense, sparse] = ["dense", "sparse"].map(|way| solved(&chain, way, &solver));
    let (worst, is_same) = difference(&dense, &sparse);
    assert!(worst < 1e-6 && !is_same, "off by {worst:e}");
}
