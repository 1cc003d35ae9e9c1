//! What parameters do to the dimensions of a mechanism.

use super::super::dimensions::{Dimension, Dimensions};
use linkdyn_model::error::Complaint;
use linkdyn_model::{Checked, Derivatives, Interval, Leaf, Parameter};
use std::collections::HashMap;

/// What steps leave out may be this part of them and is round-off.
const ROUND_OFF: f64 = 1e-13;

/// The model with parameters that deviate (index, SI); none where that is no legal model.
pub type Deviating<'p> = dyn Fn(&[(usize, f64)]) -> Option<Checked> + Sync + 'p;

/// The parameters of a model: what follows from them, and the model with other values of theirs.
pub struct Parameters<'p> {
    /// As resolved, in the order of the file.
    pub all: &'p [Parameter],
    /// What every quantity of the file takes from them.
    pub derivatives: &'p Derivatives,
    /// Works out the same, enclosed for all parameters within their tolerances; asked only for worst cases.
    pub enclosed: &'p (dyn Fn() -> Derivatives<Interval> + Sync),
    /// The model with deviations of theirs.
    pub with: &'p Deviating<'p>,
}

impl Parameters<'_> {
    /// How far one may be off \[SI\].
    fn most(&self, index: usize) -> f64 {
        let tolerance = self.all[index].tolerance.as_ref();
        tolerance.map_or(0.0, |own| own.lower.abs().max(own.upper.abs()))
    }
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

/// What is known of how far steps of dimensions are off the derivatives.
pub(super) struct Straightness {
    /// Bounds of what the steps leave out, by dimension; none where there is no enclosure, or a dimension is no multiple of what
    /// the file says.
    pub slack: Option<Vec<f64>>,
    /// By parameter, whether a dimension follows from it in a way that its derivatives don't tell all of.
    pub bends: Vec<bool>,
}

impl Straightness {
    /// Within the tolerances of the parameters.
    pub fn new(all: &Dimensions, parameters: &Parameters) -> Self {
        let enclosed = (parameters.enclosed)();
        Straightness {
            slack: slack(all, parameters, &enclosed),
            bends: bends(all, parameters, &enclosed),
        }
    }
}

/// By parameter, whether it has a part in a quantity whose derivatives change within the tolerances by more than round-off, or in a
/// dimension that is no multiple of its quantity.
fn bends(all: &Dimensions, parameters: &Parameters, enclosed: &Derivatives<Interval>) -> Vec<bool> {
    let mut bends = vec![false; parameters.all.len()];
    let leaves = parameters.derivatives.leaves.iter();
    for (leaf, enclosed) in leaves.zip(&enclosed.leaves) {
        let Some(of) = all.by_path.get(&leaf.path) else {
            continue;
        };
        let (mut steps, mut slack) = (0.0, 0.0);
        for ((index, slope), (_, within)) in leaf.gradient.iter().zip(&enclosed.gradient) {
            let most = parameters.most(*index);
            if most > 0.0 {
                steps += slope.abs() * most;
                slack += beyond(*slope, within) * most;
            }
        }
        let is_multiple = |&(dimension, _): &(usize, f64)| all.all[dimension].is_linear();
        // A bound that is not finite is none.
        let is_straight = enclosed.fault.is_none() && slack <= ROUND_OFF * steps;
        if !(is_straight && of.iter().all(is_multiple)) {
            let own = leaf.gradient.iter();
            own.for_each(|(index, _)| bends[*index] = true);
        }
    }
    bends
}

/// How far a derivative may be off its value here.
fn beyond(slope: f64, within: &Interval) -> f64 {
    (within.most - slope).max(slope - within.least)
}

/// Bounds of what the steps of the parameters leave out, by dimension: the mean of a derivative along the way is within its
/// enclosure.
fn slack(
    all: &Dimensions,
    parameters: &Parameters,
    enclosed: &Derivatives<Interval>,
) -> Option<Vec<f64>> {
    let mut by_dimension = vec![0.0; all.all.len()];
    let leaves = parameters.derivatives.leaves.iter();
    let leaves = leaves.zip(&enclosed.leaves);
    for (leaf, enclosed) in leaves {
        let Some(of) = all.by_path.get(&leaf.path) else {
            continue;
        };
        let mut slack = 0.0;
        let mut is_off = false;
        for ((index, slope), (_, within)) in leaf.gradient.iter().zip(&enclosed.gradient) {
            let most = parameters.most(*index);
            if most > 0.0 {
                slack += beyond(*slope, within) * most * (1.0 + 1e-12);
                is_off = true;
            }
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
