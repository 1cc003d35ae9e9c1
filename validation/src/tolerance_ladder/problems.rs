//! The problems of the ladder, how they are run, and how their errors are measured.

use serde_json::{Value, json};

use crate::table::Table;
use crate::{CaseError, Setting};
use linkdyn_engine::analysis::{self, Outcome};
use linkdyn_model::{self, Checked};
use linkdyn_output::Status;

const REFERENCE: &str = include_str!("../../tolerance-ladder/reference.csv");
const PENDULUM: &str = include_str!("../../a01-pendulum/case.json");
const SQUEEZER: &str = include_str!("../../andrews/case.json");
const SQUEEZER_ROWS: &str = include_str!("../../andrews/reference.csv");
const CART: &str = include_str!("../../cart-pole/case.json");
const CART_ROWS: &str = include_str!("../../cart-pole/reference.csv");
/// A02 with two loops.
pub const FOUR_BARS: &str = include_str!("../../a02-four-bars-2/case.json");

/// How an error is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// The largest distance (of one column or two) over all instants.
    Largest,
    /// The root of the mean square over all values.
    Rms,
}

/// A rung's problem.
pub struct Problem {
    pub name: &'static str,
    pub model: Value,
    pub end: f64,
    pub outputs: usize,
    /// Of the model, then of the reference.
    pub columns: Vec<&'static str>,
    pub reference: Vec<Vec<f64>>,
    pub measure: Measure,
}

/// The problems of the ladder.
pub fn problems() -> Result<Vec<Problem>, CaseError> {
    let closed = table(REFERENCE)?;
    let (squeezer, cart) = (table(SQUEEZER_ROWS)?, table(CART_ROWS)?);
    Ok(vec![
        Problem {
            name: "A01",
            model: model_of(PENDULUM)?,
            end: 10.0,
            outputs: 101,
            columns: vec!["bob.B.x[m]", "bob.B.y[m]"],
            reference: columns(&closed, &["A01.x[m]", "A01.y[m]"])?,
            measure: Measure::Largest,
        },
        Problem {
            name: "A02-1",
            model: one_loop(model_of(FOUR_BARS)?),
            end: 10.0,
            outputs: 101,
            columns: vec!["rocker0.B.x[m]", "rocker0.B.y[m]"],
            reference: columns(&closed, &["A02-1.x[m]", "A02-1.y[m]"])?,
            measure: Measure::Largest,
        },
        Problem {
            name: "andrews",
            model: model_of(SQUEEZER)?,
            end: 0.03,
            outputs: 11,
            columns: vec!["OF.angle[rad]"],
            reference: columns(&squeezer, &["OF.angle[rad]"])?,
            measure: Measure::Largest,
        },
        Problem {
            name: "cart-pole",
            model: model_of(CART)?,
            end: 10.0,
            outputs: 201,
            columns: vec!["cart.x[m]", "pole.angle[rad]"],
            reference: columns(&cart, &["cart.x[m]", "pole.angle[rad]"])?,
            measure: Measure::Rms,
        },
    ])
}

/// The model in the words of a reference case.
pub fn model_of(case: &str) -> Result<Value, CaseError> {
    let mut words: Value =
        serde_json::from_str(case).map_err(|error| CaseError::Broken(error.to_string()))?;
    Ok(words["model"].take())
}

/// A02 with two loops without its second one.
fn one_loop(mut model: Value) -> Value {
    for (group, name) in [
        ("bodies", "rocker2"),
        ("bodies", "coupler1"),
        ("joints", "a2"),
        ("joints", "l1"),
        ("joints", "r1"),
    ] {
        model[group]
            .as_object_mut()
            .and_then(|group| group.shift_remove(name));
    }
    model
}

/// Loads a model.
pub fn load(model: &Value) -> Result<Checked, CaseError> {
    let loaded = linkdyn_model::load(model.to_string().as_bytes(), &[])
        .map_err(|said| CaseError::Broken(format!("{said:?}")))?;
    Ok(loaded.model)
}

/// Runs a model to its end.
pub fn simulate(
    model: &Value,
    end: f64,
    outputs: usize,
    solver: &Value,
    setting: &Setting,
) -> Result<Outcome, CaseError> {
    let mut model = model.clone();
    model["analysis"] =
        json!({ "type": "dynamics", "end": end, "outputs": outputs, "solver": solver });
    let outcome = analysis::run(&load(&model)?, &setting.control)
        .map_err(|said| CaseError::Broken(format!("{said:?}")))?;
    match outcome.report.status {
        Status::Completed => Ok(outcome),
        Status::Interrupted => Err(CaseError::Interrupted),
        status => Err(CaseError::Broken(format!(
            "{}: {:?}",
            status.word(),
            outcome.report.message
        ))),
    }
}

/// A table of a text.
pub fn table(text: &str) -> Result<Table, CaseError> {
    Table::parse(text).map_err(CaseError::Broken)
}

/// A column of a table.
pub fn column(table: &Table, name: &str) -> Result<Vec<f64>, CaseError> {
    let index = table.columns.iter().position(|column| column == name);
    let index = index.ok_or_else(|| CaseError::Broken(format!("no column {name}")))?;
    Ok(table.rows.iter().map(|row| row[index]).collect())
}

/// Some columns of a table.
pub fn columns(table: &Table, names: &[&str]) -> Result<Vec<Vec<f64>>, CaseError> {
    names.iter().map(|name| column(table, name)).collect()
}

/// Values of a column of the results, by `name[unit]`.
pub fn values(outcome: &Outcome, name: &str) -> Result<Vec<f64>, CaseError> {
    outcome
        .trajectory
        .values(name)
        .ok_or_else(|| CaseError::Broken(format!("the results have no column {name}")))
}

/// The error of some columns of the results.
pub fn error(
    outcome: &Outcome,
    names: &[&str],
    exact: &[Vec<f64>],
    measure: Measure,
) -> Result<f64, CaseError> {
    let mut squares = vec![0.0; outcome.trajectory.len()];
    for (name, exact) in names.iter().zip(exact) {
        let ours = values(outcome, name)?;
        if exact.len() != ours.len() {
            return Err(CaseError::Broken(format!(
                "{name}: {} rows for {}",
                ours.len(),
                exact.len()
            )));
        }
        for (square, (a, b)) in squares.iter_mut().zip(ours.iter().zip(exact)) {
            *square += (a - b) * (a - b);
        }
    }
    Ok(match measure {
        Measure::Largest => squares.iter().copied().fold(0.0, f64::max).sqrt(),
        Measure::Rms => (squares.iter().sum::<f64>() / (squares.len() * names.len()) as f64).sqrt(),
    })
}
