//! A mechanism with its sources off by given amounts: the gaps of its rows, and where its output is then.

use super::Question;
use super::chosen::Chosen;
use super::corners::Corners;
use super::dimensions::{Dimension, Dimensions, Here, PointId};
use super::enclosure::Enclosure;
use super::held::{Held, Off};
use super::output::{Load, Output};
use super::sorted::Sorted;
use super::source::{Influence, Play};
use super::transposed::Transposed;
use crate::element::BodyId;
use crate::mechanism::driven::Driven;
use crate::system::Inputs;
use linkdyn_linear::math::Vec2;

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

/// A driven mechanism with all that may be off.
pub(super) struct Mechanism<'m> {
    pub driven: Driven<'m>,
    pub dimensions: &'m Dimensions,
    pub plays: &'m [Play],
    pub corners: &'m Corners<'m>,
    /// What encloses it.
    pub enclosure: Enclosure,
    /// Whether nothing is off farther than that.
    pub is_bounded: bool,
    transposed: Transposed,
    /// The plays by what they do.
    pub sorted: Sorted,
    /// Points that are moved, what pulls on each, and how far it is off.
    held: Held,
    pulls: Vec<Vec2>,
    offs: Vec<Off>,
    /// Dimensions that parameters step, but for those of points.
    stepped: Vec<usize>,
    /// ∂y/∂(dimension), as last asked for.
    of_dimensions: Vec<f64>,
    /// The deviations that are tried.
    pub chosen: Chosen,
    /// Gaps of the rows (m).
    pub rows: Vec<f64>,
    /// Shifts of the points in the frames of their bodies \[m\].
    pub shifts: Vec<Vec2>,
    /// Space for corrections.
    pub space: Space,
}

/// Space for corrections of positions (n), and of multipliers (m).
pub(super) struct Space {
    pub step: Vec<f64>,
    pub pull: Vec<f64>,
    pub right: Vec<f64>,
    pub correction: Vec<f64>,
    /// g of the plays.
    pub influences: Vec<Influence>,
}

impl<'m> Mechanism<'m> {
    /// Of plays that make the sources of a question.
    pub fn new(driven: Driven<'m>, question: &'m Question<'m>, plays: &'m [Play]) -> Self {
        let (dimensions, corners) = (question.dimensions, question.corners);
        let slack = question.slack.as_deref();
        let sorted = Sorted::new(plays);
        let mut stepped = sorted.stepped();
        let held = Held::new(driven.system, dimensions, &stepped, &sorted.zones);
        stepped.retain(|&k| !matches!(dimensions.all[k], Dimension::Point(..)));
        let (n, m) = (driven.system.n(), driven.system.m());
        let space = Space {
            step: vec![0.0; n],
            pull: vec![0.0; n],
            right: vec![0.0; m],
            correction: vec![0.0; m],
            influences: vec![[0.0; 2]; plays.len()],
        };
        let outputs = question.outputs.iter();
        let ends: Vec<BodyId> = outputs.flat_map(|own| own.output.ends()).collect();
        let enclosure = Enclosure::new(driven.system, (plays, dimensions), slack, &ends);
        Mechanism {
            is_bounded: slack.is_some(),
            enclosure,
            pulls: vec![Vec2::zeros(); held.count()],
            offs: vec![Off::default(); held.count()],
            held,
            sorted,
            transposed: Transposed::new(driven.system),
            stepped,
            of_dimensions: vec![0.0; dimensions.all.len()],
            chosen: Chosen::new(plays.len(), dimensions.all.len()),
            rows: vec![0.0; m],
            space,
            shifts: vec![Vec2::zeros(); dimensions.points.len()],
            driven,
            dimensions,
            plays,
            corners,
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
        let mut pulls = std::mem::take(&mut self.pulls);
        let here = self.here(stand);
        let own = output.pulls(&here.at, here.shifts);
        self.held.pulls(&here, &own, load, &mut pulls);
        let poses = here.at.poses;
        self.held
            .influences(poses, &pulls, &mut of_dimensions, influences);
        for &k in &self.stepped {
            of_dimensions[k] = self.dimensions.influence(&here, load, k);
        }
        self.sorted
            .influences(&load.lambda, &of_dimensions, influences);
        self.of_dimensions = of_dimensions;
        self.pulls = pulls;
    }

    /// Puts the points where steps and zones put them, at the position last taken.
    pub fn place(&mut self, stand: &Stand) {
        let poses = self.driven.evaluation.kinematics(&stand.inputs).poses;
        let off = (
            self.chosen.steps.as_slice(),
            self.chosen.extremes.as_slice(),
        );
        self.held
            .place(poses, off, &mut self.offs, &mut self.shifts);
    }

    /// Sets the gaps of the rows, at the position last taken, for points where they were put, steps and e.
    pub fn gap(&mut self, stand: &Stand) {
        let mut rows = std::mem::take(&mut self.rows);
        rows.fill(0.0);
        let here = self.here(stand);
        self.held
            .push(&here.evaluation.jacobian, &self.offs, &mut rows);
        for &k in &self.stepped {
            if self.chosen.steps[k] != 0.0 {
                self.dimensions
                    .push_one(&here, k, self.chosen.steps[k], &mut rows);
            }
        }
        self.sorted.gap(&self.chosen.extremes, &mut rows);
        self.rows = rows;
    }

    /// Sets the steps of the dimensions for the parameters' deviations: what those that bend do together, and of the others the
    /// sum of what each does. Whether the model can be had with them.
    pub fn step_parameters(&mut self) -> bool {
        let Chosen {
            extremes,
            stepped,
            steps,
            ..
        } = &mut self.chosen;
        if self.sorted.set_steps(extremes, steps) {
            return true;
        }
        if self.sorted.parameters(extremes).eq(stepped.iter().copied()) {
            return true;
        }
        stepped.clear();
        if !self.step_bent() {
            return false;
        }
        let Chosen {
            extremes,
            steps,
            stepped,
            ..
        } = &mut self.chosen;
        self.sorted.step(extremes, steps);
        stepped.extend(self.sorted.parameters(extremes));
        true
    }

    /// Sets the steps of the dimensions for the parameters that bend, the others at their values: the model is read with them.
    fn step_bent(&mut self) -> bool {
        let mut asked = self.sorted.bent(&self.chosen.extremes);
        if asked.all(|by| by == 0.0) {
            self.chosen.steps.fill(0.0);
            return true;
        }
        let asked: Vec<f64> = self.sorted.bent(&self.chosen.extremes).collect();
        let steps = self.corners.steps(&asked);
        let Some(steps) = steps else {
            return false;
        };
        self.chosen.steps.copy_from_slice(&steps);
        true
    }

    /// The output at the position last taken, with the shifts of its points times `part`.
    pub fn value(&self, stand: &Stand, output: &Output, part: f64) -> f64 {
        let at = self.driven.evaluation.kinematics(&stand.inputs);
        output.value(&at, &|PointId(point)| self.shifts[point] * part)
    }

    /// Sets `space.pull` to ∂y − Jᵀ λ (n) at the position last taken, with the points where the steps of the parameters put
    /// them.
    pub fn unbalance(&mut self, stand: &Stand, output: &Output, load: &Load) {
        let mut out = std::mem::take(&mut self.space.pull);
        let mut pulls = std::mem::take(&mut self.pulls);
        let here = self.here(stand);
        let system = self.driven.system;
        let own = output.pulls(&here.at, here.shifts);
        output.gradient(&here.at, &own, &system.layout, &mut out);
        let jacobian = &here.evaluation.jacobian;
        self.transposed.subtract(jacobian, &load.lambda, &mut out);
        self.held.pulls(&here, &own, load, &mut pulls);
        let off = (pulls.as_slice(), self.offs.as_slice());
        self.held.turn(&here, &load.lambda, off, &mut out);
        self.pulls = pulls;
        self.space.pull = out;
    }

    /// ∂y/∂q (n) at the position last taken.
    pub fn gradient(&self, stand: &Stand, output: &Output, gradient: &mut [f64]) {
        let at = self.driven.evaluation.kinematics(&stand.inputs);
        let own = output.pulls(&at, &self.shifts);
        output.gradient(&at, &own, &self.driven.system.layout, gradient);
    }
}
