//! Instants of a prescribed motion that are solved side by side, against those that are solved alone: too few to share.

use crate::models;
use linkdyn_engine::analysis::{Control, Outcome, run};
use serde_json::{Value, json};

/// A run over 0.37 s with so many rows; `None` if the model does not move so.
fn rows(model: &Value, kind: &str, outputs: usize) -> Option<Outcome> {
    let mut json = model.clone();
    json["analysis"] = json!({ "type": kind, "end": 0.37, "outputs": outputs });
    json.as_object_mut()?.remove("responses");
    let loaded = linkdyn_model::load(json.to_string().as_bytes(), &[]).ok()?;
    let checked = loaded.model.into_model().check().ok()?;
    let outcome = run(&checked, &Control::default()).ok()?;
    (outcome.trajectory.rows().count() == outputs).then_some(outcome)
}

#[test]
fn rows_side_by_side_are_as_alone() {
    let mut compared = 0;
    for named in models::all() {
        for kind in ["kinematics", "inverse_dynamics"] {
            let runs = (rows(&named.json, kind, 3), rows(&named.json, kind, 9));
            let (Some(few), Some(many)) = runs else {
                continue;
            };
            let all: Vec<&[f64]> = many.trajectory.rows().collect();
            let few: Vec<&[f64]> = few.trajectory.rows().collect();
            for (row, alone) in few.iter().enumerate() {
                for (column, alone) in alone.iter().enumerate() {
                    let beside = all[4 * row][column];
                    let own = all.iter().map(|row| row[column].abs());
                    let largest = own.fold(0.0, f64::max);
                    // what is zero in a column is round-off of the others
                    let round_off = 1e-12 * few[row].iter().copied().fold(1.0, f64::max);
                    assert!(
                        (beside - alone).abs() <= 1e-9 * largest + round_off
                            || beside.is_nan() && alone.is_nan(),
                        "{} {kind}: row {row}, column {column}: {beside} and {alone}",
                        named.name
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 10_000, "{compared}");
}
