//! A mechanism with its sources off by given amounts: the gaps of its rows, and where its output is then.

use super::dimensions::{Dimension, Dimensions, Here, Off, PointId, unit};
use super::enclosure::Extents;
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
    /// How far dimensions and points can be off.
    pub extents: Extents,
    /// Whether nothing is off farther than that.
    pub is_bounded: bool,
    /// Whether steps of dimensions are sums of what each parameter does.
    is_straight: bool,
    /// Dimensions that parameters step.
    used: Vec<usize>,
    /// ∂y/∂(dimension), and the e that carry farthest, as last asked for.
    of_dimensions: Vec<f64>,
    extremes: Vec<Influence>,
    /// What corners gave, by the bits of the deviations.
    known: HashMap<Vec<u64>, Option<Vec<f64>>>,
    /// The deviations whose steps are in `steps`.
    stepped: Vec<f64>,
    /// Gaps of the rows (m).
    pub rows: Vec<f64>,
    /// Steps of the dimensions.
    pub steps: Vec<f64>,
    /// Points that are off.
    offs: Vec<Off>,
    /// Shifts of the points in the frames of their bodies \[m\].
    pub shifts: Vec<Vec2>,
}

impl<'m> Mechanism<'m> {
    pub fn new(
        driven: Driven<'m>,
        dimensions: &'m Dimensions,
        plays: &'m [Play],
        corners: &'m Corners<'m>,
        slack: Option<&[f64]>,
    ) -> Self {
        let steps = plays.iter().flat_map(|play| match play {
            Play::Parameter { steps, .. } => steps.as_slice(),
            Play::Pin { .. }
            | Play::Sides { .. }
            | Play::Guided { .. }
            | Play::Driver { .. }
            | Play::Zone { .. } => &[],
        });
        let mut used: Vec<usize> = steps.map(|&(k, _)| k).collect();
        used.sort_unstable();
        used.dedup();
        let unknown = vec![0.0; dimensions.all.len()];
        let extents = Extents::new(plays, dimensions, slack.unwrap_or(&unknown));
        Mechanism {
            is_straight: slack.is_some() && extents.is_straight(),
            is_bounded: slack.is_some(),
            extents,
            used,
            offs: Vec::new(),
            of_dimensions: vec![0.0; dimensions.all.len()],
            extremes: vec![[0.0; 2]; plays.len()],
            stepped: Vec::new(),
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
            shifts: &self.shifts,
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

    /// Takes the nominal position of a pose: φ, and J with its factors. Whether J has an inverse.
    pub fn stand(&mut self, stand: &Stand) -> bool {
        self.driven.evaluation.set_position(&stand.q);
        let system = self.driven.system;
        self.driven.evaluation.eval_phi(system, &stand.inputs);
        self.shifts.fill(Vec2::zeros());
        self.driven.factor(&stand.inputs).is_ok()
    }

    /// g of all plays at the position last taken.
    pub fn influences(
        &mut self,
        stand: &Stand,
        output: &Output,
        load: &Load,
        influences: &mut [Influence],
    ) {
        let mut of_dimensions = std::mem::take(&mut self.of_dimensions);
        let here = self.here(stand);
        self.dimensions
            .influences(here, output, load, &self.used, &mut of_dimensions);
        for (g, play) in influences.iter_mut().zip(self.plays) {
            *g = play.influence(here, output, self.dimensions, load, &of_dimensions);
        }
        self.of_dimensions = of_dimensions;
    }

    /// Sets gaps, steps and shifts for the deviations that carry the output farthest to a side. Whether the model can be had
    /// with them.
    pub fn deviate(&mut self, stand: &Stand, influences: &[Influence], side: f64) -> bool {
        let mut extremes = std::mem::take(&mut self.extremes);
        for ((extreme, play), g) in extremes.iter_mut().zip(self.plays).zip(influences) {
            *extreme = play.extreme(*g, side);
        }
        let is_had = self.set(stand, &extremes);
        self.extremes = extremes;
        is_had
    }

    /// Sets gaps, steps and shifts for deviations of the plays. Whether the model can be had with them.
    fn set(&mut self, stand: &Stand, extremes: &[Influence]) -> bool {
        self.rows.fill(0.0);
        self.shifts.fill(Vec2::zeros());
        if !self.step_parameters(extremes) {
            return false;
        }
        let mut rows = std::mem::take(&mut self.rows);
        let mut shifts = std::mem::take(&mut self.shifts);
        let mut offs = std::mem::take(&mut self.offs);
        offs.clear();
        let here = self.here(stand);
        self.dimensions
            .push(here, &self.used, &self.steps, &mut rows);
        for &k in &self.used {
            if let Dimension::Point(PointId(point), axis) = &self.dimensions.all[k] {
                shifts[*point][*axis] += self.steps[k];
                if self.steps[k] != 0.0 {
                    let pose = &here.at.poses[self.dimensions.points[*point].body.0];
                    offs.push(Off {
                        point: PointId(*point),
                        by: pose.turn(unit(*axis)) * self.steps[k],
                        turns: true,
                    });
                }
            }
        }
        for (play, e) in self.plays.iter().zip(extremes) {
            match play {
                Play::Pin { row, .. } | Play::Guided { row, .. } => {
                    rows[*row] += e[0];
                    rows[row + 1] += e[1];
                }
                Play::Sides { row, .. } | Play::Driver { row, .. } => rows[*row] += e[0],
                Play::Zone { point, .. } => {
                    let point_data = &self.dimensions.points[point.0];
                    let off = Vec2::new(e[0], e[1]);
                    offs.push(Off {
                        point: *point,
                        by: off,
                        turns: false,
                    });
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
        self.offs = offs;
        true
    }

    /// Sets the steps of the dimensions to the sums of what the parameters do.
    fn step_straight(&mut self, extremes: &[Influence]) {
        self.steps.fill(0.0);
        for (play, e) in self.plays.iter().zip(extremes) {
            if let Play::Parameter { steps, .. } = play {
                for &(k, by) in steps {
                    self.steps[k] += by * e[0];
                }
            }
        }
    }

    /// Sets the steps of the dimensions for the parameters' deviations.
    fn step_parameters(&mut self, extremes: &[Influence]) -> bool {
        let asked = self.plays.iter().zip(extremes);
        let asked = asked.filter(|(play, _)| matches!(play, Play::Parameter { .. }));
        let asked = asked.map(|(_, e)| e[0]);
        if asked.clone().eq(self.stepped.iter().copied()) {
            return true;
        }
        let deviations: Vec<f64> = asked.collect();
        if self.is_straight {
            self.step_straight(extremes);
            self.stepped = deviations;
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
                self.stepped = deviations;
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

    /// ∂y − Jᵀ λ (n) at the position last taken, with the points where the steps of the parameters put them.
    pub fn unbalanced(&self, stand: &Stand, output: &Output, load: &Load, out: &mut [f64]) {
        let here = self.here(stand);
        let system = self.driven.system;
        output.gradient(&here.at, here.shifts, &system.layout, out);
        for (entry, value) in system.entries.iter().zip(&here.evaluation.jacobian) {
            if let Some(column) = entry.column {
                out[column as usize] -= value * load.lambda[entry.row as usize];
            }
        }
        self.dimensions.turn(here, output, load, &self.offs, out);
    }

    /// ∂y/∂q (n) at the position last taken.
    pub fn gradient(&self, stand: &Stand, output: &Output, gradient: &mut [f64]) {
        let at = self.driven.evaluation.kinematics(&stand.inputs);
        output.gradient(&at, &self.shifts, &self.driven.system.layout, gradient);
    }
}
