//! Positions of the poses that are asked about, on the branch that the drawing is on.

use linkdyn_engine::analysis::assembly::{assemble, check_driven};
use linkdyn_engine::analysis::driven::{passages, path, range};
use linkdyn_engine::analysis::instants::OutputInstant;
use linkdyn_engine::analysis::{Control, Stop};
use linkdyn_engine::mechanism::continuation::{End, Parameter, Path, Source};
use linkdyn_engine::mechanism::driven::{Driven, Failure};
use linkdyn_engine::system::{Inputs, System};
use linkdyn_model::error::Complaint;
use linkdyn_output::Status;

/// A pose that is asked about.
#[derive(Debug, Clone)]
pub(super) struct NominalPose {
    /// Nominal coordinates (n).
    pub q: Vec<f64>,
    /// Values of the drivers.
    pub inputs: Inputs,
    /// The driver whose value says which pose is meant.
    pub held: Option<usize>,
    /// The self-stress of the equations (m) where J has no inverse that means something.
    pub self_stress: Option<Vec<f64>>,
}

/// A correction beside a change point may move a coordinate by this much, in radians or sizes, and is round-off.
const NEAR: f64 = 1e-6;

/// Within this part of a window's width a pose is at the change point.
const AT_ONE: f64 = 1e-8;
/// A joint belongs to a self-stress when its part is above this.
const STRESSED: f64 = 1e-9;

/// A value that a driver does not have anywhere on the way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unreached {
    /// Number of the driver.
    pub driver: usize,
    /// Least and greatest value that it has [rad or m].
    pub range: [f64; 2],
    /// Whether the mechanism goes less far than the driver would take it.
    pub is_stopped: bool,
}

/// An output with a pose that the motion does not have.
pub(super) struct Unmet {
    /// Its name.
    pub output: String,
    /// The value requested [rad or m].
    pub value: f64,
    pub by: Unreached,
}

/// Why a question has no answer.
pub(super) enum Halt {
    /// As any analysis.
    Stop(Stop),
    /// Outputs with a pose that the motion does not have.
    Unreached(Vec<Unmet>),
}

impl From<Stop> for Halt {
    fn from(stop: Stop) -> Self {
        Halt::Stop(stop)
    }
}

/// The way of a driven mechanism.
pub(super) struct Way<'s> {
    pub system: &'s System,
    /// As the end of the path left it.
    driven: Driven<'s>,
    path: Path,
    /// Coordinates at t = 0 (n).
    start: Vec<f64>,
    /// The last instant \[s\].
    end: f64,
}

/// Poses on a way, one after the other.
pub(super) struct Poses<'w> {
    way: &'w Way<'w>,
    driven: Driven<'w>,
}

impl<'s> Way<'s> {
    /// Follows the drivers over all instants.
    ///
    /// # Errors
    /// No assembly, freedom that nothing drives, a start that is singular.
    pub fn new(
        system: &'s System,
        instants: &[OutputInstant],
        control: &Control,
    ) -> Result<Self, Stop> {
        let start = Inputs::at_time(system, 0.0);
        let assembled = assemble(system, &start)?;
        check_driven(system, &assembled, &start)?;
        let singular = |_: Failure| {
            Stop::failed(
                Status::Singular,
                "the start is a singular position of the mechanism; start a little beside it"
                    .into(),
            )
        };
        let mut driven = Driven::new(system, &assembled.q, &start).map_err(singular)?;
        let mut q = assembled.q;
        driven.correct(&mut q, &start).map_err(singular)?;
        let first = match Parameter::of(system) {
            Parameter::DriverValue => start.drive[0][0],
            Parameter::Time | Parameter::Coordinate => 0.0,
        };
        let range = range(system, instants);
        let path = path(&mut driven, (first, &q), range, control).map_err(singular)?;
        Ok(Way {
            system,
            driven,
            path,
            start: q,
            end: instants.last().map_or(0.0, |last| last.time),
        })
    }

    /// A solver of its own at the start.
    ///
    /// # Errors
    /// Joints that hold the same freedom: their influences are not unique.
    pub fn another(&self) -> Result<Driven<'s>, Stop> {
        let system = self.system;
        let start = Inputs::at_time(system, 0.0);
        let mut driven = Driven::new(system, &self.start, &start).map_err(|_| {
            Stop::failed(Status::Singular, "the start is a singular position".into())
        })?;
        if !driven.is_redundant() {
            return Ok(driven);
        }
        driven.factor(&start).map_err(|_| {
            Stop::failed(Status::Singular, "the start is a singular position".into())
        })?;
        let mut names: Vec<&str> = Vec::new();
        for stress in driven.self_stress() {
            for (row, _) in stress
                .iter()
                .enumerate()
                .filter(|(_, z)| z.abs() > STRESSED)
            {
                if let linkdyn_engine::system::Origin::Joint(id) = &system.block_of_row(row).origin
                    && !names.contains(&system.joints[id.0].name.as_str())
                {
                    names.push(&system.joints[id.0].name);
                }
            }
        }
        let message = format!(
            "joints {} hold the same freedom more than once, so what each clearance does is not unique",
            names.join(", ")
        );
        let hint = "take a joint or body out that only repeats what others do";
        Err(Stop::Input(vec![
            Complaint::new("joints", message).hint(hint),
        ]))
    }

    /// Poses on the way, wherever others are requested.
    pub fn poses(&self) -> Poses<'_> {
        Poses {
            way: self,
            driven: self.driven.clone(),
        }
    }

    /// How far a driver goes.
    fn unreached(&self, driver: usize) -> Unreached {
        let law = &self.system.drivers[driver].law;
        let values = |end: f64| {
            let ends = law.stretches(end);
            let values = ends.flat_map(|(left, right)| [law.jet(left)[0], law.jet(right)[0]]);
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
                [low.min(value), high.max(value)]
            })
        };
        let wanted = values(self.end);
        let (low, high) = self.path.covered();
        let range = match self.path.parameter {
            _ if self.path.is_closed() => wanted,
            Parameter::DriverValue => [wanted[0].max(low), wanted[1].min(high)],
            Parameter::Time | Parameter::Coordinate => values(self.end.min(high)),
        };
        let is_stopped = [&self.path.low, &self.path.high]
            .iter()
            .any(|end| !matches!(end, End::Reached));
        Unreached {
            driver,
            range,
            is_stopped,
        }
    }
}

impl Poses<'_> {
    /// The pose where a driver has a value, first of all.
    ///
    /// # Errors
    /// How far the driver goes, where it has the value nowhere.
    pub fn stand_at(&mut self, driver: usize, value: f64) -> Result<NominalPose, Unreached> {
        let law = &self.way.system.drivers[driver].law;
        let time = passages(law, value, self.way.end).first().copied();
        let instant = time.map(|time| OutputInstant {
            time,
            exact: Some((driver, value)),
        });
        instant
            .and_then(|instant| self.stand(&instant, Some(driver)))
            .ok_or_else(|| self.way.unreached(driver))
    }

    /// The pose at an instant; `held` where the value of a driver says which is meant. `None` if the mechanism has none.
    pub fn stand(&mut self, instant: &OutputInstant, held: Option<usize>) -> Option<NominalPose> {
        let system = self.way.system;
        let n = system.n();
        let mut inputs = Inputs::at_time(system, instant.time);
        instant.drive(system, &mut inputs.drive);
        let s = match self.way.path.parameter {
            Parameter::DriverValue => inputs.drive[0][0],
            Parameter::Time | Parameter::Coordinate => instant.time,
        };
        if !self.way.path.holds(s) {
            return None;
        }
        let (mut q, mut d, mut dd) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let source = self.way.path.guess(s, &mut q, &mut d, &mut dd)?;
        let smooth = q.clone();
        let corrected = self.driven.prepare(&q, &inputs).is_ok()
            && self.driven.correct(&mut q, &inputs).is_ok();
        let self_stress = match source {
            Source::Regular | Source::Known if corrected => None,
            Source::Regular | Source::Known => return None,
            Source::Bridged { index, distance } => {
                let far = distance.abs() > AT_ONE * self.way.path.windows()[index].width;
                let moved: Vec<f64> = q.iter().zip(&smooth).map(|(a, b)| a - b).collect();
                let near = far && corrected && system.scaled_norm(&moved) <= NEAR;
                if !near {
                    q = smooth;
                }
                (!near).then(|| self.way.path.self_stress(index).to_vec())
            }
        };
        Some(NominalPose {
            q,
            inputs,
            held,
            self_stress,
        })
    }
}
