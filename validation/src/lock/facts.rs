//! Singular positions of the ideal lock, and its motion there, beside an independent calculation with 50 digits
//! (`validation/lock/independent.csv`).

use serde_json::json;

use super::document::broken;
use super::models::{Quantity, Request, Stroke, run};
use super::table::NEAR_CHANGE_POINT;
use crate::table::Table;
use crate::{CaseError, Claim, Verdict};
use linkdyn_engine::analysis::Control;
use linkdyn_output::{Event, EventKind, Status};

/// One number beside its reference.
#[derive(Debug, Clone, PartialEq)]
pub struct Fact {
    /// `name[unit]`
    pub what: String,
    pub reference: f64,
    /// Largest difference allowed.
    pub tolerance: f64,
    /// NaN where the engine has none.
    pub ours: f64,
}

impl Fact {
    /// What it says.
    pub fn claim(&self) -> Claim {
        let difference = self.ours - self.reference;
        Claim {
            what: format!("{}, against the calculation with 50 digits", self.what),
            reference: format!("{}", self.reference),
            ours: if self.ours.is_finite() {
                format!("{}", self.ours)
            } else {
                "no value".into()
            },
            difference: format!("{difference:.1e} (allowed {:.0e})", self.tolerance),
            verdict: if difference.abs() <= self.tolerance {
                Verdict::Agrees
            } else {
                Verdict::Fault
            },
        }
    }
}

/// Finds the facts; `stroke` is an ideal run with an output at 117.5°.
///
/// # Errors
/// When the engine can't run the lock at all.
pub fn facts(stroke: &Stroke, control: &Control) -> Result<Vec<Fact>, CaseError> {
    let table = include_str!("../../lock/independent.csv");
    let table = Table::parse(table).map_err(broken)?;
    let change = value_of(&stroke.report.events, EventKind::ChangePoint);
    // Beyond the stroke, to the driver's dead centre.
    let mut document = Request::ideal(1.0).document()?;
    document["analysis"]["sample"]["to"] = json!("135 deg");
    let (_, beyond) = run(&document, control)?;
    let dead = match beyond.report.status {
        Status::DeadCentre => value_of(&beyond.report.events, EventKind::DeadCentre),
        Status::Completed
        | Status::CompletedWithGaps
        | Status::AssemblyFailed
        | Status::StepTooSmall
        | Status::Singular
        | Status::TimeLimit
        | Status::Interrupted => f64::NAN,
    };
    // With an output right at the change point.
    let at_change = at_value(change, control)?;
    let row = stroke
        .theta6
        .iter()
        .position(|theta6| (theta6 - NEAR_CHANGE_POINT).abs() < 1e-9);
    let beside = Quantity::ALL.map(|q| row.map_or(f64::NAN, |row| stroke.curve(q)[row]));
    let ours = |name: &str| match name {
        "change_point[deg]" => Ok(change.to_degrees()),
        "dead_centre[deg]" => Ok(dead.to_degrees()),
        "omega2.at_change_point[rad/s]" => Ok(at_change[Quantity::Omega2.index()]),
        "alpha2.at_change_point[rad/s^2]" => Ok(at_change[Quantity::Alpha2.index()]),
        "M_d.at_change_point[N*m]" => Ok(at_change[Quantity::Torque.index()]),
        "omega2.at_117.5_deg[rad/s]" => Ok(beside[Quantity::Omega2.index()]),
        "alpha2.at_117.5_deg[rad/s^2]" => Ok(beside[Quantity::Alpha2.index()]),
        "M_d.at_117.5_deg[N*m]" => Ok(beside[Quantity::Torque.index()]),
        "F12.at_117.5_deg[N]" => Ok(beside[Quantity::Force.index()]),
        other => Err(broken(format!(
            "independent.csv: nobody computes {other:?}"
        ))),
    };
    let [references, tolerances] = &table.rows[..] else {
        return Err(broken("independent.csv: two rows are expected"));
    };
    let rows = table.columns.iter().zip(references).zip(tolerances);
    rows.map(|((what, &reference), &tolerance)| {
        Ok(Fact {
            what: what.clone(),
            reference,
            tolerance,
            ours: ours(what)?,
        })
    })
    .collect()
}

/// Driver value of the first event of a kind \[rad\].
fn value_of(events: &[Event], kind: EventKind) -> f64 {
    events
        .iter()
        .find(|event| event.kind == kind)
        .and_then(|event| event.value)
        .unwrap_or(f64::NAN)
}

/// The five quantities with the driver at `value` \[rad\].
fn at_value(value: f64, control: &Control) -> Result<[f64; 5], CaseError> {
    if value.is_nan() {
        return Ok([f64::NAN; 5]);
    }
    let mut document = Request::ideal(1.0).document()?;
    document["analysis"]["sample"]["from"] = json!(format!("{value} rad"));
    document["analysis"]["sample"]["to"] = json!("118 deg");
    let (_, outcome) = run(&document, control)?;
    let first = |name: &str| {
        let values = outcome.trajectory.values(name);
        values
            .and_then(|values| values.first().copied())
            .ok_or_else(|| broken(format!("no {name} at {value} rad")))
    };
    Ok([
        first("link2.angle")?,
        first("link2.omega")?,
        first("link2.alpha")?,
        first("driver.motor.effort")?,
        first("joint.a.fx")?.hypot(first("joint.a.fy")?),
    ])
}
