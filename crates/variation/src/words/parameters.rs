//! What parameters do to the dimensions of a mechanism.

use super::super::geometry::{Dimension, Dimensions};
use linkdyn_model::error::Complaint;
use linkdyn_model::{Checked, Derivatives, Interval, Leaf, Parameter};
use std::collections::BTreeMap;

/// What steps leave out may be this part of them and is round-off.
const ROUND_OFF: f64 = 1e-13;

/// The model with parameters that deviate (index, SI); `None` if that is no legal model.
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

    fn leaves(&self) -> impl Iterator<Item = &Leaf> {
        self.derivatives.leaves.iter()
    }
}

/// What is followed of the parameters.
pub(super) struct Followed<'a> {
    pub of: &'a Parameters<'a>,
    dimensions: &'a Dimensions,
    /// Masses, springs, loads and laws are, too.
    forces: bool,
    /// Parameters that something follows from, each with what a unit of it changes in the dimensions.
    pub parameters: Vec<(usize, Vec<(usize, f64)>)>,
}

impl<'a> Followed<'a> {
    /// What positions follow from, or also what forces do.
    pub fn new(dimensions: &'a Dimensions, of: &'a Parameters, forces: bool) -> Self {
        let mut followed = Followed {
            of,
            dimensions,
            forces,
            parameters: Vec::new(),
        };
        let mut all: BTreeMap<usize, Vec<(usize, f64)>> = BTreeMap::new();
        for leaf in of.leaves().filter(|leaf| followed.bears(&leaf.path)) {
            for (index, by) in leaf.gradient.iter().filter(|(_, by)| *by != 0.0) {
                let steps = all.entry(*index).or_default();
                for &(dimension, factor) in followed.dimensions_of(&leaf.path) {
                    match steps.iter_mut().find(|(own, _)| *own == dimension) {
                        Some((_, step)) => *step += by * factor,
                        None => steps.push((dimension, by * factor)),
                    }
                }
            }
        }
        let all = all.into_iter().map(|(index, mut steps)| {
            steps.retain(|(_, by)| *by != 0.0);
            (index, steps)
        });
        followed.parameters = all
            .filter(|(_, steps)| forces || !steps.is_empty())
            .collect();
        followed
    }

    /// The dimensions that follow from a quantity of the file, with their factors.
    fn dimensions_of(&self, path: &str) -> &'a [(usize, f64)] {
        self.dimensions.by_path.get(path).map_or(&[], Vec::as_slice)
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

/// What is known of how far steps of dimensions are off the derivatives, within the tolerances of the parameters.
pub(super) struct Straightness {
    /// Bounds of what the steps leave out, by dimension: the mean of a derivative along the way is within its enclosure. `None` if
    /// there is no enclosure, or a dimension is no multiple of what the file says.
    pub slack: Option<Vec<f64>>,
    /// By parameter, whether it has a part in a quantity whose derivatives change by more than round-off, or in a dimension that is no
    /// multiple of its quantity.
    pub is_curved: Vec<bool>,
}

impl Straightness {
    pub fn new(followed: &Followed) -> Self {
        let (all, parameters) = (followed.dimensions, followed.of);
        let mut slack = Some(vec![0.0; all.all.len()]);
        let mut is_curved = vec![false; parameters.all.len()];
        let enclosed = (parameters.enclosed)();
        for (leaf, enclosed) in parameters.leaves().zip(&enclosed.leaves) {
            let of = followed.dimensions_of(&leaf.path);
            let (mut steps, mut left) = (0.0, 0.0);
            for ((index, slope), (_, within)) in leaf.gradient.iter().zip(&enclosed.gradient) {
                let most = parameters.most(*index);
                if most > 0.0 {
                    steps += slope.abs() * most;
                    left += (within.most - slope).max(slope - within.least) * most * (1.0 + 1e-12);
                }
            }
            let mut own = leaf.gradient.iter();
            let is_off = own.any(|(index, _)| parameters.most(*index) > 0.0);
            let are_linear = of
                .iter()
                .all(|&(dimension, _)| all.all[dimension].is_linear());
            // A bound that is not finite is none.
            if !of.is_empty()
                && (enclosed.fault.is_some() || !(left <= ROUND_OFF * steps && are_linear))
            {
                leaf.gradient
                    .iter()
                    .for_each(|(index, _)| is_curved[*index] = true);
            }
            let bears_wheel = of.iter().any(|&(dimension, _)| match all.all[dimension] {
                Dimension::Point(id, _) => all.points[id.0].bears_wheel,
                _ => false,
            });
            let is_bounded = enclosed.fault.is_none() && are_linear && !bears_wheel;
            if is_off && !of.is_empty() && !(is_bounded && left.is_finite()) {
                slack = None;
            }
            if let Some(slack) = &mut slack {
                of.iter()
                    .for_each(|&(k, factor)| slack[k] += left * factor.abs());
            }
        }
        Straightness { slack, is_curved }
    }
}

/// Complaints about tolerances of parameters that no dimension follows from.
pub(super) fn idle(followed: &Followed) -> Vec<Complaint> {
    // A direction that lies along x follows from its x, too, though to first order not at all.
    let leaves = followed
        .of
        .leaves()
        .filter(|leaf| followed.bears(&leaf.path));
    let used: Vec<usize> = leaves
        .flat_map(|leaf| leaf.gradient.iter().map(|(index, _)| *index))
        .collect();
    let all = followed.of.all.iter().enumerate();
    let idle =
        all.filter(|(index, parameter)| parameter.tolerance.is_some() && !used.contains(index));
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
    let path = |name: &str| format!("parameters.{name}.tolerance");
    let idle = idle.map(|(_, own)| Complaint::new(path(&own.name), message).hint(hint));
    idle.collect()
}

/// Complaints about dimensions that have no derivative.
pub(super) fn kinks(followed: &Followed) -> Vec<Complaint> {
    let leaves = followed
        .of
        .leaves()
        .filter(|leaf| followed.bears(&leaf.path));
    let faults = leaves.filter_map(|leaf| {
        let fault = leaf.fault.as_ref()?;
        let what = match followed.dimensions.by_path.contains_key(&leaf.path) {
            true => "dimension",
            false => "quantity",
        };
        let message = format!("this {what} has no derivative here: {fault}");
        Some(Complaint::new(leaf.path.clone(), message))
    });
    faults.collect()
}

/// Complaints about times of tables that follow from parameters with a tolerance: what a time does is not differentiated.
pub(super) fn times(parameters: &Parameters) -> Vec<Complaint> {
    let is_time = |path: &str| {
        path.starts_with("drivers.") && path.contains(".motion.points[") && path.ends_with("][0]")
    };
    let is_off = |leaf: &&Leaf| {
        let mut gradient = leaf.gradient.iter();
        gradient.any(|(index, by)| *by != 0.0 && parameters.all[*index].tolerance.is_some())
    };
    let leaves = parameters
        .leaves()
        .filter(|leaf| is_time(&leaf.path))
        .filter(is_off);
    let faults = leaves.map(|leaf| {
        let message = "a tolerance of the times of a table is not followed";
        Complaint::new(leaf.path.clone(), message)
            .hint("give the values of the table the tolerance, or take another law of motion")
    });
    faults.collect()
}
