//! The bundled lock with the choices that the paper leaves open, and what a run of it gives.

use serde_json::{Value, json};

use super::centres::Centres;
use super::document::{broken, bundled, point};
use crate::CaseError;
use linkdyn_engine::analysis::{self, Control};
use linkdyn_model::error::Complaints;
use linkdyn_model::{self, Checked};
use linkdyn_output::{Event, EventKind, Report, Status, Trajectory};

/// Names of the hinges.
pub const JOINTS: [&str; 7] = ["a", "b", "c", "d", "e", "f", "g"];
/// Names of the moving links.
pub const LINKS: [&str; 5] = ["link2", "link3", "link4", "link5", "link6"];
/// Radii e of the paper \[µm\].
pub const RADII: [f64; 2] = [10.0, 100.0];
/// Output steps \[deg\].
pub const STEPS: [f64; 4] = [2.5, 1.0, 0.5, 0.1];

/// Which of links 5 and 6 hangs on link 3.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// Link 6 on link 3 at f, link 5 on link 4 at d: the bundled model's reading.
    SixOnThree,
    /// Link 5 on link 3 at f, link 6 on link 4 at d.
    FiveOnThree,
}

/// One run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    pub centres: Centres,
    pub order: Order,
    /// Clearance e \[µm\]; 0 for ideal joints.
    pub radius: f64,
    /// Output step \[deg\].
    pub step: f64,
}

impl Request {
    /// The bundled model as it is.
    pub fn ideal(step: f64) -> Self {
        Request {
            centres: Centres::MODEL,
            order: Order::SixOnThree,
            radius: 0.0,
            step,
        }
    }

    /// The bundled model with clearance links of `radius` \[µm\].
    pub fn clearance(radius: f64, step: f64) -> Self {
        Request {
            radius,
            ..Request::ideal(step)
        }
    }

    /// The model file of this run.
    ///
    /// # Errors
    /// When the bundled model is not what this case edits.
    pub fn document(&self) -> Result<Value, CaseError> {
        let mut document = bundled()?;
        self.centres.place(&mut document)?;
        match self.order {
            Order::SixOnThree => {}
            Order::FiveOnThree => exchange_links(&mut document)?,
        }
        if self.radius > 0.0 {
            for joint in JOINTS {
                document["joints"][joint]["clearance"] =
                    json!({ "model": "massless_link", "radius": format!("{} um", self.radius) });
            }
        }
        document["analysis"]["sample"]["step"] = json!(format!("{} deg", self.step));
        Ok(document)
    }

    /// Runs it over the paper's stroke.
    ///
    /// # Errors
    /// When the model can't be loaded, or the run did not come to the end of the stroke.
    pub fn run(&self, control: &Control) -> Result<Stroke, CaseError> {
        self.stroke(&self.document()?, control)
    }

    /// Runs it from the start of the stroke to `theta6` \[deg\].
    ///
    /// # Errors
    /// As [`Request::run`].
    pub fn run_to(&self, theta6: f64, control: &Control) -> Result<Stroke, CaseError> {
        let mut document = self.document()?;
        document["analysis"]["sample"]["to"] = json!(format!("{theta6} deg"));
        self.stroke(&document, control)
    }

    fn stroke(&self, document: &Value, control: &Control) -> Result<Stroke, CaseError> {
        let (model, outcome) = run(document, control)?;
        match outcome.report.status {
            Status::Completed | Status::CompletedWithGaps => {}
            Status::DeadCentre
            | Status::AssemblyFailed
            | Status::StepTooSmall
            | Status::Singular
            | Status::TimeLimit
            | Status::Interrupted => {
                let message = outcome.report.message.unwrap_or_default();
                return Err(CaseError::Broken(format!("{self:?} stopped: {message}")));
            }
        }
        Stroke::new(*self, model, outcome.trajectory, outcome.report)
    }
}

/// Loads and runs a model file.
///
/// # Errors
/// When it is refused, or the user interrupts.
pub fn run(document: &Value, control: &Control) -> Result<(Checked, analysis::Outcome), CaseError> {
    let refused = |complaints: Complaints| {
        let complaints: Vec<String> = complaints.iter().map(ToString::to_string).collect();
        broken(complaints.join("; "))
    };
    let loaded = linkdyn_model::load(document.to_string().as_bytes(), &[]).map_err(refused)?;
    let outcome = analysis::run(&loaded.model, control).map_err(refused)?;
    match outcome.report.status {
        Status::Interrupted => Err(CaseError::Interrupted),
        Status::Completed
        | Status::CompletedWithGaps
        | Status::DeadCentre
        | Status::AssemblyFailed
        | Status::StepTooSmall
        | Status::Singular
        | Status::TimeLimit => Ok((loaded.model, outcome)),
    }
}

/// Links 5 and 6 change places between S (hinge f, on link 3) and T (hinge d, on link 4); both keep their direction.
fn exchange_links(document: &mut Value) -> Result<(), CaseError> {
    let corner = document["bodies"]["link6"]["pose"]["position"].clone();
    let at: [f64; 2] = serde_json::from_value(corner.clone()).map_err(broken)?;
    let length = point(document, "link5", "d")?[0];
    let angle = document["bodies"]["link5"]["pose"]["angle"]
        .as_f64()
        .ok_or_else(|| broken("link5 has no angle"))?;
    let (sin, cos) = angle.to_radians().sin_cos();
    document["bodies"]["link5"]["pose"]["position"] = corner;
    document["bodies"]["link6"]["pose"]["position"] =
        json!([at[0] + length * cos, at[1] + length * sin]);
    let end = point(document, "link6", "e")?;
    document["bodies"]["link5"]["points"] = json!({ "f": [0, 0], "e": [length, 0] });
    document["bodies"]["link6"]["points"] = json!({ "e": [0, 0], "d": end });
    document["joints"]["d"]["between"] = json!(["link4.d", "link6.d"]);
    document["joints"]["f"]["between"] = json!(["link3.f", "link5.f"]);
    for body in ["link5", "link6"] {
        document["bodies"][body]["note"] =
            json!("the other order of the hinges: a variant of ours");
    }
    Ok(())
}

/// The five quantities of figures 4 to 8.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    Theta2,
    Omega2,
    Alpha2,
    Torque,
    Force,
}

impl Quantity {
    pub const ALL: [Quantity; 5] = [
        Quantity::Theta2,
        Quantity::Omega2,
        Quantity::Alpha2,
        Quantity::Torque,
        Quantity::Force,
    ];

    /// Its symbol.
    pub fn symbol(self) -> &'static str {
        match self {
            Quantity::Theta2 => "theta2",
            Quantity::Omega2 => "omega2",
            Quantity::Alpha2 => "alpha2",
            Quantity::Torque => "M_d",
            Quantity::Force => "F12",
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Quantity::Theta2 => "rad",
            Quantity::Omega2 => "rad/s",
            Quantity::Alpha2 => "rad/s^2",
            Quantity::Torque => "N*m",
            Quantity::Force => "N",
        }
    }

    /// Place in [`Quantity::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }
}

/// What an instant of a clearance run is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Found {
    /// A solution (of the fixed point, with clearance).
    Solution,
    /// The last pass of a fixed point that was not met.
    LastPass,
    /// No assembly.
    Nothing,
}

/// A run over the stroke.
#[derive(Debug, Clone)]
pub struct Stroke {
    pub request: Request,
    pub model: Checked,
    pub trajectory: Trajectory,
    pub report: Report,
    /// \[deg\]
    pub theta6: Vec<f64>,
    /// By [`Quantity`]; NaN where there is no value.
    pub curves: [Vec<f64>; 5],
    pub found: Vec<Found>,
}

impl Stroke {
    /// From a run's results.
    ///
    /// # Errors
    /// When columns are missing.
    pub fn new(
        request: Request,
        model: Checked,
        trajectory: Trajectory,
        report: Report,
    ) -> Result<Self, CaseError> {
        let column = |name: &str| {
            trajectory
                .values(name)
                .ok_or_else(|| broken(format!("no column {name}")))
        };
        let forces = column("joint.a.fx")?
            .into_iter()
            .zip(column("joint.a.fy")?)
            .map(|(x, y)| x.hypot(y));
        let curves = [
            column("link2.angle")?,
            column("link2.omega")?,
            column("link2.alpha")?,
            column("driver.motor.effort")?,
            forces.collect(),
        ];
        // Outputs are multiples of a hundredth of a degree: without the round-off of the conversion.
        let degrees = |value: f64| (value.to_degrees() * 1e9).round() / 1e9;
        let theta6 = column("driver.motor.value")?
            .into_iter()
            .map(degrees)
            .collect();
        let found = column("time")?
            .into_iter()
            .map(|time| found(&report.events, time))
            .collect();
        Ok(Stroke {
            request,
            model,
            trajectory,
            report,
            theta6,
            curves,
            found,
        })
    }

    /// One of the curves.
    pub fn curve(&self, quantity: Quantity) -> &[f64] {
        &self.curves[quantity.index()]
    }

    /// Number of instants that are `what`.
    pub fn count(&self, what: Found) -> usize {
        self.found.iter().filter(|&&found| found == what).count()
    }

    /// Neighbouring instants that are `what`, as intervals \[deg\].
    pub fn intervals(&self, what: Found) -> Vec<[f64; 2]> {
        intervals(&self.theta6, |row| self.found[row] == what)
    }
}

/// Neighbouring rows that are told by `is`, as intervals of `x`.
pub fn intervals(x: &[f64], is: impl Fn(usize) -> bool) -> Vec<[f64; 2]> {
    let mut intervals: Vec<[f64; 2]> = Vec::new();
    let mut inside = false;
    for (row, &x) in x.iter().enumerate() {
        match (is(row), intervals.last_mut()) {
            (true, Some(last)) if inside => last[1] = x,
            (true, Some(_) | None) => intervals.push([x, x]),
            (false, _) => {}
        }
        inside = is(row);
    }
    intervals
}

/// What the events say about an instant.
fn found(events: &[Event], time: f64) -> Found {
    let within =
        |event: &&Event| event.time <= time && time <= event.end_time.unwrap_or(event.time);
    let of_kind = |kind: EventKind| events.iter().filter(within).any(|event| event.kind == kind);
    if of_kind(EventKind::NoSolution) {
        Found::Nothing
    } else if of_kind(EventKind::NotConverged) {
        Found::LastPass
    } else {
        Found::Solution
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_one_interval() {
        let x = [0.0, 1.0, 2.0, 3.0, 4.0];
        assert_eq!(intervals(&x, |row| row != 2), [[0.0, 1.0], [3.0, 4.0]]);
        assert_eq!(intervals(&x, |row| row == 4), [[4.0, 4.0]]);
        assert!(intervals(&x, |_| false).is_empty());
    }

    #[test]
    fn the_other_hinge_order_has_the_same_angles() {
        let base = Request::ideal(5.0).run(&Control::default()).expect("runs");
        let variant = Request {
            order: Order::FiveOnThree,
            ..base.request
        };
        let variant = variant.run(&Control::default()).expect("runs");
        for link in LINKS {
            let name = format!("{link}.angle");
            let angles = base
                .trajectory
                .values(&name)
                .into_iter()
                .zip(variant.trajectory.values(&name))
                .next();
            let (ours, theirs) = angles.expect("there");
            let worst = ours
                .iter()
                .zip(&theirs)
                .fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()));
            assert!(worst < 1e-12, "{name}: {worst:e}");
        }
    }
}
