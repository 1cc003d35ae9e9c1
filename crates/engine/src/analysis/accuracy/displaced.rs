//! A mechanism with its sources off by given amounts: the gaps of its rows, and where its output is then.

use super::dimensions::{Dimensions, Here, PointId};
use super::output::{Load, Output};
use super::source::{Influence, Play};
use crate::mechanism::driven::Driven;
use crate::system::Inputs;
use linkdyn_linear::math::Vec2;
use std::collections::HashMap;

/// A pose that is asked about.
#[derive(Debug, Clone)]
pub(super) struct Stand {
    /// Nominal coordinates (n).
    pub q: Vec<f64>,
    /// Values of the drivers.
    pub inputs: Inputs,
    /// The driver whose value says which pose is meant.
    pub held: Option<usize>,
    /// The self-stress of the equations (m) where J has no inverse that means something.
    pub self_stress: Option<Vec<f64>>,
}

/// Steps of all dimensions for deviations of the parameters, in the order of their plays; none where the model can't be had
/// with them.
pub(super) type Corners<'c> = dyn Fn(&[f64]) -> Option<Vec<f64>> + 'c;

/// A driven mechanism with all that may be off.
pub(super) struct Mechanism<'m> {
    pub driven: Driven<'m>,
    pub dimensions: &'m Dimensions,
    pub plays: &'m [Play],
    pub corners: &'m Corners<'m>,
    /// What corners gave, by the bits of the deviations.
    known: HashMap<Vec<u64>, Option<Vec<f64>>>,
    /// Gaps of the rows (m).
    pub rows: Vec<f64>,
    /// Steps of the dimensions.
    pub steps: Vec<f64>,
    /// Shifts of the points in the frames of their bodies \[m\].
    pub shifts: Vec<Vec2>,
}

impl<'m> Mechanism<'m> {
    pub fn new(
        driven: Driven<'m>,
        dimensions: &'m Dimensions,
        plays: &'m [Play],
        corners: &'m Corners<'m>,
    ) -> Self {
        Mechanism {
            rows: vec![0.0; driven.system.m()],
            steps: vec![0.0; dimensions.all.len()],
            shifts: vec![Vec2::zeros(); dimensions.points.len()],
            driven,
            dimensions,
            plays,
            corners,
            known: HashMap::new(),
        }
    }

    /// The position last taken.
    pub fn here<'a>(&'a self, stand: &'a Stand) -> Here<'a> {
        Here {
            system: self.driven.system,
            evaluation: &self.driven.evaluation,
            at: self.driven.evaluation.kinematics(&stand.inputs),
            time: stand.inputs.time,
            held: stand.held,
        }
    }

    /// Takes a position: φ without gaps, and J.
    pub fn take(&mut self, q: &[f64], stand: &Stand) {
        let system = self.driven.system;
        self.driven.evaluation.set_position(q);
        self.driven.evaluation.eval_phi(system, &stand.inputs);
        self.driven.evaluation.eval_jacobian(system, &stand.inputs);
    }

    /// g of all plays at the position last taken.
    pub fn influences(&self, stand: &Stand, output: &Output, load: &Load) -> Vec<Influence> {
        let here = self.here(stand);
        let of_dimensions = self.dimensions.influences(here, output, load);
        let of = |play: &Play| play.influence(here, output, self.dimensions, load, &of_dimensions);
        self.plays.iter().map(of).collect()
    }

    /// Sets gaps, steps and shifts for the deviations that carry the output farthest to a side. Whether the model can be had
    /// with them.
    pub fn deviate(&mut self, stand: &Stand, influences: &[Influence], side: f64) -> bool {
        let extremes: Vec<Influence> = self
            .plays
            .iter()
            .zip(influences)
            .map(|(play, g)| play.extreme(*g, side))
            .collect();
        self.rows.fill(0.0);
        self.shifts.fill(Vec2::zeros());
        if !self.step_parameters(&extremes) {
            return false;
        }
        let mut rows = std::mem::take(&mut self.rows);
        let mut shifts = std::mem::take(&mut self.shifts);
        let here = self.here(stand);
        self.dimensions.push(here, &self.steps, &mut rows);
        for (k, dimension) in self.dimensions.all.iter().enumerate() {
            if let super::dimensions::Dimension::Point(PointId(point), axis) = dimension {
                shifts[*point][*axis] += self.steps[k];
            }
        }
        for (play, e) in self.plays.iter().zip(&extremes) {
            match play {
                Play::Pin { row, .. } | Play::Guided { row, .. } => {
                    rows[*row] += e[0];
                    rows[row + 1] += e[1];
                }
                Play::Sides { row, .. } | Play::Driver { row, .. } => rows[*row] += e[0],
                Play::Zone { point, .. } => {
                    let point_data = &self.dimensions.points[point.0];
                    let off = Vec2::new(e[0], e[1]);
                    for grip in &point_data.grips {
                        grip.push(&here.evaluation.jacobian, off, &mut rows);
                    }
                    let pose = &here.at.poses[point_data.body.0];
                    shifts[point.0] += Vec2::new(
                        pose.cos * off.x + pose.sin * off.y,
                        pose.cos * off.y - pose.sin * off.x,
                    );
                }
                Play::Parameter { .. } => {}
            }
        }
        self.rows = rows;
        self.shifts = shifts;
        true
    }

    /// Sets the steps of the dimensions for the parameters' deviations.
    fn step_parameters(&mut self, extremes: &[Influence]) -> bool {
        let deviations: Vec<f64> = self
            .plays
            .iter()
            .zip(extremes)
            .filter(|(play, _)| matches!(play, Play::Parameter { .. }))
            .map(|(_, e)| e[0])
            .collect();
        if deviations.is_empty() {
            return true;
        }
        let key = deviations.iter().map(|d| d.to_bits()).collect();
        let corners = self.corners;
        let steps = self
            .known
            .entry(key)
            .or_insert_with(|| corners(&deviations));
        match steps {
            Some(steps) => {
                self.steps.copy_from_slice(steps);
                true
            }
            None => false,
        }
    }

    /// The output at the position last taken, with the shifts of its points times `part`.
    pub fn value(&self, stand: &Stand, output: &Output, part: f64) -> f64 {
        let at = self.driven.evaluation.kinematics(&stand.inputs);
        output.value(&at, &|PointId(point)| self.shifts[point] * part)
    }

    /// ∂y/∂q (n) at the position last taken.
    pub fn gradient(&self, stand: &Stand, output: &Output, gradient: &mut [f64]) {
        let at = self.driven.evaluation.kinematics(&stand.inputs);
        output.gradient(&at, &self.driven.system.layout, gradient);
    }
}
