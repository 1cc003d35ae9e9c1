//! The cheapest tolerances that keep the limits of all outputs.

mod text;
mod written;

use linkdyn_engine::analysis::Control;
use linkdyn_model::Parameter;
use linkdyn_model::error::Complaint;
use linkdyn_variation::{Accuracy as Found, Free, Levels, Limited, Sum, Unallocated, allocate};

use crate::accuracy::{Accuracy, Deviations};
use crate::{ModelFile, Question, Unanswered};
use written::set;

/// Most rounds in which limits are narrowed until the worst case keeps them.
const MOST_ROUNDS: usize = 12;
/// A limit counts as kept when it is exceeded by less than this part: round-off.
const KEPT: f64 = 1e-9;

/// Asks for the cheapest tolerances that keep the limits of outputs.
#[derive(Debug, Clone, Default)]
pub struct Allocate {
    /// Outputs of the model's `accuracy`; none: all.
    pub outputs: Vec<String>,
    /// Whether variances add up, and three standard deviations stay within the limits, instead of all at their worst.
    pub squares: bool,
}

/// The cheapest tolerances that keep the limits of outputs.
#[derive(Debug)]
pub struct Allocation {
    /// The model.
    pub file: ModelFile,
    squares: bool,
    chosen: Vec<Chosen>,
    /// Parameters with a cost that no limit depends on.
    idle: Vec<String>,
    /// Accuracy with the chosen tolerances.
    accuracy: Deviations,
    rounds: usize,
}

/// A tolerance that was chosen.
#[derive(Debug, Clone)]
struct Chosen {
    parameter: Parameter,
    cost: f64,
    /// Half width to first order.
    first: f64,
    /// Half width that keeps the limits.
    half: f64,
}

impl Question for Allocate {
    type Answer = Allocation;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<Allocation, Unanswered> {
        let first = self.accuracy(Levels::First).answer(file, control)?;
        self.choose(file, first, control)
    }
}

impl Allocate {
    /// The outputs, whatever levels the model asks for.
    fn accuracy(&self, levels: Levels) -> Accuracy {
        Accuracy {
            outputs: self.outputs.clone(),
            levels: Some(levels),
            threads: None,
        }
    }

    /// Tolerances that keep all limits.
    fn choose(
        &self,
        file: &ModelFile,
        first: Deviations,
        control: &Control,
    ) -> Result<Allocation, Unanswered> {
        let all = costly(file, &first.found).map_err(|said| file.refused(said.into()))?;
        let sum = if self.squares {
            Sum::Squares
        } else {
            Sum::Worst
        };
        let free: Vec<Free> = all.iter().map(|one| one.free).collect();
        let rooms = first.found.rooms(&free, sum, &|_| 1.0);
        let matters = |one: &usize| rooms.iter().any(|limited| limited.room.weights[*one] > 0.0);
        let (used, idle): (Vec<usize>, Vec<usize>) = (0..all.len()).partition(matters);
        let used: Vec<Costly> = used.iter().map(|&k| all[k]).collect();
        let idle = idle.iter().map(|&k| all[k].parameter.name.clone());
        let idle: Vec<String> = idle.collect();
        let free: Vec<Free> = used.iter().map(|one| one.free).collect();
        let costs: Vec<f64> = used.iter().map(|one| one.cost).collect();
        let mut parts = vec![1.0; first.found.outputs.len()];
        let mut linear: Option<Vec<f64>> = None;
        let mut last = first;
        for rounds in 1..=MOST_ROUNDS {
            let limited = last.found.rooms(&free, sum, &|output| parts[output]);
            let rooms: Vec<_> = limited.iter().map(|limited| limited.room.clone()).collect();
            let halves = allocate(&costs, &rooms, sum);
            let halves = halves.map_err(|why| no_room(&last, &limited, why))?;
            let linear = linear.get_or_insert_with(|| halves.clone());
            let numbers = halves.iter().zip(&*linear);
            let chosen = used.iter().zip(numbers).map(|(one, (half, first))| Chosen {
                parameter: one.parameter.clone(),
                cost: one.cost,
                first: *first,
                half: *half,
            });
            let chosen: Vec<Chosen> = chosen.collect();
            let parameters = with_tolerances(&file.loaded.parameters, &chosen);
            let certified = self.accuracy(Levels::Certified);
            let accuracy = certified.answer_with(file, &parameters, control);
            let accuracy = accuracy.map_err(|_| {
                Unanswered::Failed("the mechanism can't be had with these tolerances".into())
            })?;
            let exceeded = narrow(&accuracy.found, &mut parts);
            if self.squares || !exceeded {
                return Ok(Allocation {
                    file: file.clone(),
                    squares: self.squares,
                    chosen,
                    idle,
                    accuracy,
                    rounds,
                });
            }
            last = accuracy;
        }
        Err(Unanswered::Failed("no tolerances were found whose worst case keeps all limits: near singular positions it is not proportional to them".into()))
    }
}

impl Allocation {
    /// The parameters with a cost, and the half widths of their tolerances \[SI\].
    pub fn tolerances(&self) -> impl Iterator<Item = (&str, f64)> {
        let chosen = self.chosen.iter();
        chosen.map(|own| (own.parameter.name.as_str(), own.half))
    }

    /// The model with these tolerances.
    ///
    /// # Errors
    /// A model that has faults with them.
    pub fn model(&self) -> Result<ModelFile, Unanswered> {
        let chosen = self.chosen.iter();
        let sets = chosen.map(|own| set(&self.file, &own.parameter, own.half));
        let with = self.file.with(&sets.collect::<Vec<_>>());
        with.map_err(|said| self.file.refused(said))
    }
}

/// A parameter with a cost.
#[derive(Clone, Copy)]
struct Costly<'a> {
    parameter: &'a Parameter,
    cost: f64,
    /// As a source of deviations.
    free: Free,
}

/// The parameters with a cost.
fn costly<'a>(file: &'a ModelFile, first: &Found) -> Result<Vec<Costly<'a>>, Complaint> {
    if first.outputs.iter().all(|output| output.limits.is_none()) {
        let message = "no output has limits, so any tolerance will do";
        let hint = "as in \"limits\": [\"-0.1 deg\", \"0.1 deg\"]";
        return Err(Complaint::new("accuracy.outputs", message).hint(hint));
    }
    let costly = |parameter: &'a Parameter| {
        let name = format!("parameters.{}", parameter.name);
        let tolerance = parameter.tolerance.as_ref()?;
        Some(Costly {
            parameter,
            cost: tolerance.cost?,
            free: Free {
                source: first.sources.iter().position(|own| *own == name)?,
                scatter: tolerance.distribution.into(),
            },
        })
    };
    let all: Vec<_> = file.loaded.parameters.iter().filter_map(costly).collect();
    if all.is_empty() {
        let message = "no parameter of the mechanism has a cost, so there is nothing to choose";
        let hint = "as in \"rod\": { \"value\": \"200 mm\", \"cost\": \"1 mm\" }: ±t costs cost/t";
        return Err(Complaint::new("parameters", message).hint(hint));
    }
    Ok(all)
}

/// Narrows the parts of the limits that may be used where a worst case exceeds them; whether one does.
fn narrow(accuracy: &Found, parts: &mut [f64]) -> bool {
    let mut exceeded = false;
    for (part, output) in parts.iter_mut().zip(&accuracy.outputs) {
        if let Some(used) = output.used().filter(|used| *used > 1.0) {
            *part /= used;
            exceeded |= used > 1.0 + KEPT;
        }
    }
    exceeded
}

/// Why nothing could be chosen.
fn no_room(last: &Deviations, limited: &[Limited], why: Unallocated) -> Unanswered {
    let display = &last.file.model().display;
    Unanswered::Failed(match why {
        Unallocated::NoRoom(number) => {
            let output = &last.found.outputs[limited[number].output];
            let pose = &output.poses[limited[number].pose];
            let at =
                pose.drivers
                    .iter()
                    .zip(&*pose.driver_units)
                    .map(|(value, unit)| match *unit {
                        "rad" => display.angle(*value),
                        _ => display.length(*value),
                    });
            format!(
                "the limits of {} leave no room for tolerances where the drivers stand at {}: what has no cost uses them up (widen the limits, or narrow the clearances)",
                output.name,
                at.collect::<Vec<_>>().join(", ")
            )
        }
        Unallocated::Free(_) => "a parameter has no influence on any limit".into(),
        Unallocated::Unsolved(why) => format!("the cone program was not solved: {why}"),
    })
}

/// The parameters, with the tolerances that were chosen.
fn with_tolerances(all: &[Parameter], chosen: &[Chosen]) -> Vec<Parameter> {
    let mut all = all.to_vec();
    for parameter in &mut all {
        let own = chosen
            .iter()
            .find(|own| own.parameter.name == parameter.name);
        if let (Some(own), Some(tolerance)) = (own, &mut parameter.tolerance) {
            let middle = tolerance.middle();
            (tolerance.lower, tolerance.upper) = (middle - own.half, middle + own.half);
        }
    }
    all
}
