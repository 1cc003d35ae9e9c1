//! What parameters do to the dimensions of a mechanism.

use super::super::dimensions::{Dimension, Dimensions};
use linkdyn_model::error::Complaint;
use linkdyn_model::{Checked, Derivatives, Interval, Leaf, Parameter};
use std::collections::HashMap;

/// The model with parameters that deviate (index, SI); none where that is no legal model.
pub type Deviating<'p> = dyn Fn(&[(usize, f64)]) -> Option<Checked> + 'p;

/// The parameters of a model: what follows from them, and the model with other values of theirs.
pub struct Parameters<'p> {
    /// As resolved, in the order of the file.
    pub all: &'p [Parameter],
    /// What every quantity of the file takes from them.
    pub derivatives: &'p Derivatives,
    /// Works out the same, enclosed for all parameters within their tolerances; asked only for worst cases.
    pub enclosed: &'p dyn Fn() -> Derivatives<Interval>,
    /// The model with deviations of theirs.
    pub with: &'p Deviating<'p>,
}

/// What is followed of the parameters.
pub(super) struct Followed<'a> {
    dimensions: &'a Dimensions,
    /// Masses, springs, loads and laws are, too.
    forces: bool,
    /// Parameters that something follows from, each with what a unit of it changes in the dimensions.
    pub parameters: Vec<(usize, Vec<(usize, f64)>)>,
}

impl<'a> Followed<'a> {
    /// What positions follow from, or also what forces do.
    pub fn new(dimensions: &'a Dimensions, parameters: &Parameters, forces: bool) -> Self {
        let mut followed = Followed {
            dimensions,
            forces,
            parameters: Vec::new(),
        };
        let mut with_steps = with_influence(dimensions, parameters);
        for index in 0..parameters.all.len() {
            let steps = with_steps.remove(&index);
            let bears = |leaf: &Leaf| {
                let mut own = leaf.gradient.iter();
                followed.bears(&leaf.path) && own.any(|(of, by)| *of == index && *by != 0.0)
            };
            if steps.is_some() || (forces && parameters.derivatives.leaves.iter().any(bears)) {
                followed.parameters.push((index, steps.unwrap_or_default()));
            }
        }
        followed
    }

    /// Whether an output may follow from a quantity of the file.
    fn bears(&self, path: &str) -> bool {
        let (section, rest) = path.split_once('.').unwrap_or((path, ""));
        let of_forces = match section {
            "forces" => true,
            "bodies" => !rest.contains(".pose.") && !rest.ends_with(".tolerance"),
            "joints" => {
                rest.contains(".friction.")
                    || rest.ends_with(".pin_radius")
                    || rest.ends_with(".guide_length")
            }
            other => other.starts_with("gravity"),
        };
        self.dimensions.by_path.contains_key(path) || (self.forces && of_forces)
    }
}

/// Parameters that dimensions follow from, each with what a unit of it changes in them.
fn with_influence(all: &Dimensions, parameters: &Parameters) -> HashMap<usize, Vec<(usize, f64)>> {
    let followed = (0..parameters.all.len()).filter_map(|index| {
        let mut steps: Vec<(usize, f64)> = Vec::new();
        for leaf in &parameters.derivatives.leaves {
            let Some(of) = all.by_path.get(&leaf.path) else {
                continue;
            };
            let Some((_, by)) = leaf.gradient.iter().find(|(own, _)| *own == index) else {
                continue;
            };
            for &(dimension, factor) in of {
                match steps.iter_mut().find(|(own, _)| *own == dimension) {
                    Some((_, step)) => *step += by * factor,
                    None => steps.push((dimension, by * factor)),
                }
            }
        }
        steps.retain(|(_, by)| *by != 0.0);
        (!steps.is_empty()).then_some((index, steps))
    });
    followed.collect()
}

/// Bounds of what the steps of the parameters leave out, by dimension: the mean of a derivative along the way is within its
/// enclosure. None where there is no enclosure, or a dimension is no multiple of what the file says.
pub(super) fn slack(all: &Dimensions, parameters: &Parameters) -> Option<Vec<f64>> {
    let mut by_dimension = vec![0.0; all.all.len()];
    let enclosed = (parameters.enclosed)();
    let leaves = parameters.derivatives.leaves.iter();
    let leaves = leaves.zip(&enclosed.leaves);
    for (leaf, enclosed) in leaves {
        let Some(of) = all.by_path.get(&leaf.path) else {
            continue;
        };
        let mut slack = 0.0;
        let mut is_off = false;
        for ((index, slope), (_, within)) in leaf.gradient.iter().zip(&enclosed.gradient) {
            let Some(tolerance) = &parameters.all[*index].tolerance else {
                continue;
            };
            let most = tolerance.lower.abs().max(tolerance.upper.abs());
            let beyond = (within.most - slope).max(slope - within.least);
            slack += beyond * most * (1.0 + 1e-12);
            is_off |= most > 0.0;
        }
        if is_off && enclosed.fault.is_some() {
            return None;
        }
        for &(dimension, factor) in of {
            if is_off && !(all.all[dimension].is_linear() && is_straight(all, dimension)) {
                return None;
            }
            by_dimension[dimension] += slack * factor.abs();
        }
    }
    by_dimension
        .iter()
        .all(|slack| slack.is_finite())
        .then_some(by_dimension)
}

/// Whether φ of a point's coordinate is a straight line.
fn is_straight(all: &Dimensions, dimension: usize) -> bool {
    match &all.all[dimension] {
        Dimension::Point(id, _) => !all.points[id.0].bears_wheel,
        Dimension::Direction { .. }
        | Dimension::Angle { .. }
        | Dimension::Mesh { .. }
        | Dimension::Ratio { .. }
        | Dimension::Motion { .. } => true,
    }
}

/// Complaints about tolerances of parameters that no dimension follows from.
pub(super) fn idle(followed: &Followed, parameters: &Parameters) -> Vec<Complaint> {
    // A direction that lies along x follows from its x, too, though to first order not at all.
    let leaves = parameters.derivatives.leaves.iter();
    let leaves = leaves.filter(|leaf| followed.bears(&leaf.path));
    let used: Vec<usize> = leaves
        .flat_map(|leaf| leaf.gradient.iter().map(|(index, _)| *index))
        .collect();
    let idle = parameters
        .all
        .iter()
        .enumerate()
        .filter(|(index, parameter)| parameter.tolerance.is_some() && !used.contains(index));
    idle.map(|(_, parameter)| {
        let path = format!("parameters.{}.tolerance", parameter.name);
        let (message, hint) = if followed.forces {
            (
                "no dimension, mass, spring, load or law of the mechanism follows from this parameter",
                "take the tolerance away, or use the parameter",
            )
        } else {
            (
                "no point, axis, angle or ratio of the mechanism follows from this parameter",
                "take the tolerance away, or use the parameter in a dimension",
            )
        };
        Complaint::new(path, message).hint(hint)
    })
    .collect()
}

/// Complaints about dimensions that have no derivative.
pub(super) fn kinks(followed: &Followed, parameters: &Parameters) -> Vec<Complaint> {
    let leaves = parameters.derivatives.leaves.iter();
    let faults = leaves.filter(|leaf| followed.bears(&leaf.path));
    faults
        .filter_map(|leaf| {
            let fault = leaf.fault.as_ref()?;
            let what = if followed.dimensions.by_path.contains_key(&leaf.path) {
                "dimension"
            } else {
                "quantity"
            };
            Some(Complaint::new(
                leaf.path.clone(),
                format!("this {what} has no derivative here: {fault}"),
            ))
        })
        .collect()
}

/// Complaints about times of tables that follow from parameters with a tolerance: what a time does is not differentiated.
pub(super) fn times(parameters: &Parameters) -> Vec<Complaint> {
    let leaves = parameters.derivatives.leaves.iter();
    let is_time = |path: &str| path.contains(".motion.points[") && path.ends_with("][0]");
    let off = |leaf: &&linkdyn_model::Leaf| {
        let mut gradient = leaf.gradient.iter();
        gradient.any(|(index, by)| *by != 0.0 && parameters.all[*index].tolerance.is_some())
    };
    leaves
        .filter(|leaf| leaf.path.starts_with("drivers.") && is_time(&leaf.path))
        .filter(off)
        .map(|leaf| {
            let message = "a tolerance of the times of a table is not followed";
            Complaint::new(leaf.path.clone(), message)
                .hint("give the values of the table the tolerance, or take another law of motion")
        })
        .collect()
}
