//! Contacts, events, wear and numbers of a run, as its report has them.

use super::reason::Reason;
use linkdyn_model::response::{ClearanceSum, EVENTS, Fact, Item, List, Program, Reduction};
use linkdyn_output::{ClearanceSums, Event, Report, Status};

/// What is reduced over a list.
#[derive(Debug, Clone)]
pub struct Listed {
    pub list: List,
    /// What is reported about each entry, in the order in which the program takes it.
    pub items: Vec<Item>,
    pub program: Program,
}

/// Most things told of one entry.
const MOST: usize = 9;

impl Listed {
    /// The reduction over all entries, each worked out by `value`.
    pub fn reduce(
        &self,
        reduction: Reduction,
        report: &Report,
        joints: &[String],
        mut value: impl FnMut(&[f64]) -> f64,
    ) -> Result<f64, Reason> {
        let (mut sum, mut count) = (0.0, 0_u32);
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut first, mut last) = (f64::NAN, f64::NAN);
        let mut fault = None;
        let mut take = |time: f64, of: &dyn Fn(Item) -> f64| {
            let mut inputs = [f64::NAN; MOST];
            for (input, item) in inputs.iter_mut().zip(&self.items) {
                *input = of(*item);
            }
            count += 1;
            let inputs = &inputs[..self.items.len().min(MOST)];
            let value = value(inputs);
            if !value.is_finite() {
                let is_there = inputs.iter().all(|input| input.is_finite());
                let reason = if is_there {
                    Reason::NotFinite(Some(time))
                } else {
                    Reason::NoItem(time)
                };
                fault = fault.or(Some(reason));
                return;
            }
            sum += value;
            (least, most) = (f64::min(least, value), f64::max(most, value));
            first = if count == 1 { value } else { first };
            last = value;
        };
        match self.list {
            List::Wear(joint) => {
                let bins = sums(report, joints, joint).map_or(&[][..], |sums| &sums.wear);
                bins.iter().for_each(|bin| take(0.0, &|_| *bin));
            }
            List::Contacts(_) | List::Events(_) => {
                let events = report.events.iter();
                for event in events.filter(|event| self.holds(event, joints)) {
                    take(event.time, &|item| of_event(event, item));
                }
            }
        }
        match reduction {
            Reduction::Count => return Ok(f64::from(count)),
            _ => fault.map_or(Ok(()), Err)?,
        }
        match reduction {
            Reduction::Sum => Ok(sum),
            _ if count == 0 => Err(Reason::Nothing(0)),
            Reduction::Max => Ok(most),
            Reduction::Min => Ok(least),
            Reduction::Range => Ok(most - least),
            Reduction::First => Ok(first),
            Reduction::Last => Ok(last),
            // the model lets no other reduction through
            Reduction::Mean
            | Reduction::Rms
            | Reduction::Integral
            | Reduction::At
            | Reduction::ArgMax
            | Reduction::ArgMin
            | Reduction::Count => Ok(sum / f64::from(count)),
        }
    }

    /// Whether the list has an entry for an event.
    fn holds(&self, event: &Event, joints: &[String]) -> bool {
        match self.list {
            List::Contacts(None) => event.episode.is_some(),
            List::Contacts(Some(joint)) => {
                event.episode.is_some() && event.joint.as_ref() == joints.get(joint)
            }
            List::Events(kind) => event.kind.name() == EVENTS[kind],
            List::Wear(_) => false,
        }
    }
}

/// What is reported about an event.
fn of_event(event: &Event, item: Item) -> f64 {
    let Some(episode) = &event.episode else {
        return match item {
            Item::Time => event.time,
            Item::Duration
            | Item::ApproachSpeed
            | Item::SeparationSpeed
            | Item::PeakPenetration
            | Item::PeakForce
            | Item::Impulse
            | Item::EnergyLost
            | Item::Wear => f64::NAN,
        };
    };
    let duration = episode.end.map(|end| end - episode.start);
    match item {
        Item::Time => event.time,
        Item::Duration => duration.unwrap_or(f64::NAN),
        Item::ApproachSpeed => episode.approach_speed,
        Item::SeparationSpeed => episode.separation_speed.unwrap_or(f64::NAN),
        Item::PeakPenetration => episode.peak_penetration,
        Item::PeakForce => episode.peak_force,
        Item::Impulse => episode.impulse,
        Item::EnergyLost => episode.energy_lost,
        Item::Wear => f64::NAN,
    }
}

/// The sums of a joint.
fn sums<'r>(report: &'r Report, joints: &[String], joint: usize) -> Option<&'r ClearanceSums> {
    let name = joints.get(joint)?;
    report.clearances.iter().find(|sums| sums.joint == *name)
}

/// A number of a whole run, where it has it.
pub fn fact(fact: Fact, report: &Report, joints: &[String]) -> Option<f64> {
    let quality = &report.quality;
    let found = match fact {
        Fact::Status => match report.status {
            Status::Completed => 1.0,
            Status::CompletedWithGaps
            | Status::DeadCentre
            | Status::AssemblyFailed
            | Status::StepTooSmall
            | Status::Singular
            | Status::TimeLimit
            | Status::Interrupted => 0.0,
        },
        // counts are far below 2⁵³
        Fact::Grubler => report.mobility.grubler as f64,
        Fact::Rank => report.mobility.rank as f64,
        Fact::Steps => report.statistics.steps as f64,
        Fact::NewtonIterations => report.statistics.newton_iterations as f64,
        Fact::ConstraintResidual => quality.constraint_residual,
        Fact::PowerImbalance => quality.power_imbalance?,
        Fact::EnergyDrift => quality.energy_drift?,
        Fact::EnergyImbalance => quality.energy_imbalance?,
        Fact::EquilibriumResidual => report.equilibrium.as_ref()?.residual,
        Fact::Clearance(joint, sum) => {
            let sums = sums(report, joints, joint)?;
            match sum {
                ClearanceSum::Contacts => sums.episodes as f64,
                ClearanceSum::StickSlipChanges => sums.switches as f64,
                ClearanceSum::TimeInContact => sums.time_in_contact,
                ClearanceSum::EnergyLost => sums.energy_lost,
                ClearanceSum::Impulse => sums.impulse,
            }
        }
    };
    Some(found)
}
