//! A mechanism with its sources off by given amounts: the gaps of its rows, and where its output is then.

use super::dimensions::{Dimension, Dimensions, Here, Off, PointId};
use super::enclosure::Extents;
use super::output::{Load, Output};
use super::search::Chosen;
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
    /// Points that parameters step, each with the number of its first dimension.
    stepped_points: Vec<(PointId, usize)>,
    /// Other dimensions that parameters step.
    stepped_others: Vec<usize>,
    /// Plays by what they are: parameters, zones with their points, and those that make gaps.
    parameters: Vec<usize>,
    zones: Vec<(usize, PointId)>,
    gapped: Vec<usize>,
    /// ∂y/∂(dimension), and ∂y/∂P of the points, as last asked for.
    of_dimensions: Vec<f64>,
    of_points: Vec<Vec2>,
    /// The deviations that are tried.
    pub chosen: Chosen,
    /// What corners gave, by the bits of the deviations of parameters that bend.
    known: HashMap<Vec<u64>, Option<Vec<f64>>>,
    /// Gaps of the rows (m).
    pub rows: Vec<f64>,
    /// Points that are off.
    offs: Vec<Off>,
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
        let mut stepped_points = Vec::new();
        let mut stepped_others = Vec::new();
        for &k in &used {
            match dimensions.all[k] {
                Dimension::Point(point, axis) => stepped_points.push((point, k - axis)),
                Dimension::Direction { .. }
                | Dimension::Angle { .. }
                | Dimension::Mesh { .. }
                | Dimension::Ratio { .. }
                | Dimension::Motion { .. } => stepped_others.push(k),
            }
        }
        // The dimensions of a point stand beside each other.
        stepped_points.dedup();
        let (mut parameters, mut zones, mut gapped) = (Vec::new(), Vec::new(), Vec::new());
        for (index, play) in plays.iter().enumerate() {
            match play {
                Play::Parameter { .. } => parameters.push(index),
                Play::Zone { point, .. } => zones.push((index, *point)),
                Play::Pin { .. }
                | Play::Sides { .. }
                | Play::Guided { .. }
                | Play::Driver { .. } => gapped.push(index),
            }
        }
        let (n, m) = (driven.system.n(), driven.system.m());
        let space = Space {
            step: vec![0.0; n],
            pull: vec![0.0; n],
            right: vec![0.0; m],
            correction: vec![0.0; m],
            influences: vec![[0.0; 2]; plays.len()],
        };
        let unknown = vec![0.0; dimensions.all.len()];
        let extents = Extents::new(plays, dimensions, slack.unwrap_or(&unknown));
        Mechanism {
            is_bounded: slack.is_some(),
            extents,
            stepped_points,
            stepped_others,
            parameters,
            zones,
            gapped,
            offs: Vec::new(),
            of_dimensions: vec![0.0; dimensions.all.len()],
            of_points: vec![Vec2::zeros(); dimensions.points.len()],
            chosen: Chosen::new(plays.len(), dimensions.all.len()),
            rows: vec![0.0; m],
            space,
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
        let mut of_points = std::mem::take(&mut self.of_points);
        let here = self.here(stand);
        let own = output.pulls(&here.at, here.shifts);
        for &(point, k) in &self.stepped_points {
            let pull = self.dimensions.of_point(here, &own, load, point);
            let pose = &here.at.poses[self.dimensions.points[point.0].body.0];
            of_dimensions[k] = pose.cos * pull.x + pose.sin * pull.y;
            of_dimensions[k + 1] = pose.cos * pull.y - pose.sin * pull.x;
        }
        for &(_, point) in &self.zones {
            of_points[point.0] = self.dimensions.of_point(here, &own, load, point);
        }
        for &k in &self.stepped_others {
            of_dimensions[k] = self.dimensions.influence(here, load, k);
        }
        for (g, play) in influences.iter_mut().zip(self.plays) {
            *g = play.influence(&load.lambda, &of_dimensions, &of_points);
        }
        self.of_dimensions = of_dimensions;
        self.of_points = of_points;
    }

    /// Sets gaps, steps and shifts for the deviations that carry the output farthest up; those that gain no more than this part of
    /// what all reach stay as they are. Whether the model can be had with them.
    pub fn deviate(&mut self, stand: &Stand, influences: &[Influence], still: f64) -> bool {
        let each = self.plays.iter().zip(influences);
        let reaches = each.map(|(play, g)| play.reach(*g));
        let still = still * reaches.map(|[down, up]| up - down).sum::<f64>();
        let extremes = self
            .chosen
            .extremes
            .iter_mut()
            .zip(self.plays)
            .zip(influences);
        for ((e, play), g) in extremes {
            let end = play.extreme(*g, 1.0);
            if g[0] * (end[0] - e[0]) + g[1] * (end[1] - e[1]) > still {
                *e = end;
            }
        }
        self.step_parameters() && {
            self.place(stand);
            self.gap(stand);
            true
        }
    }

    /// Puts the points where steps and zones put them, at the position last taken.
    pub fn place(&mut self, stand: &Stand) {
        let mut shifts = std::mem::take(&mut self.shifts);
        let mut offs = std::mem::take(&mut self.offs);
        offs.clear();
        for &(_, point) in &self.zones {
            shifts[point.0] = Vec2::zeros();
        }
        let poses = self.driven.evaluation.kinematics(&stand.inputs).poses;
        let pose = |PointId(point): PointId| &poses[self.dimensions.points[point].body.0];
        for &(point, k) in &self.stepped_points {
            let shift = Vec2::new(self.chosen.steps[k], self.chosen.steps[k + 1]);
            shifts[point.0] = shift;
            if shift.x != 0.0 || shift.y != 0.0 {
                offs.push(Off {
                    point,
                    by: pose(point).turn(shift),
                    turns: true,
                });
            }
        }
        for &(index, point) in &self.zones {
            let e = self.chosen.extremes[index];
            let by = Vec2::new(e[0], e[1]);
            offs.push(Off {
                point,
                by,
                turns: false,
            });
            let pose = pose(point);
            shifts[point.0] += Vec2::new(
                pose.cos * by.x + pose.sin * by.y,
                pose.cos * by.y - pose.sin * by.x,
            );
        }
        self.shifts = shifts;
        self.offs = offs;
    }

    /// Sets the gaps of the rows, at the position last taken, for points where they were put, steps and e.
    pub fn gap(&mut self, stand: &Stand) {
        let mut rows = std::mem::take(&mut self.rows);
        rows.fill(0.0);
        let here = self.here(stand);
        for off in &self.offs {
            let hold = &self.dimensions.points[off.point.0].hold;
            hold.push(&here.evaluation.jacobian, off.by, &mut rows);
        }
        for &k in &self.stepped_others {
            if self.chosen.steps[k] != 0.0 {
                self.dimensions
                    .push_one(here, k, self.chosen.steps[k], &mut rows);
            }
        }
        for &index in &self.gapped {
            let e = &self.chosen.extremes[index];
            match &self.plays[index] {
                Play::Pin { row, .. } | Play::Guided { row, .. } => {
                    rows[*row] += e[0];
                    rows[row + 1] += e[1];
                }
                Play::Sides { row, .. } | Play::Driver { row, .. } => rows[*row] += e[0],
                Play::Zone { .. } | Play::Parameter { .. } => {}
            }
        }
        self.rows = rows;
    }

    /// Sets the steps of the dimensions for the parameters' deviations: what those that bend do together, and of the others the
    /// sum of what each does. Whether the model can be had with them.
    pub fn step_parameters(&mut self) -> bool {
        let each = self
            .parameters
            .iter()
            .map(|&index| self.chosen.extremes[index][0]);
        if each.eq(self.chosen.stepped.iter().copied()) {
            return true;
        }
        self.chosen.stepped.clear();
        if !self.step_bent() {
            return false;
        }
        for &index in &self.parameters {
            let e = self.chosen.extremes[index][0];
            if let Play::Parameter {
                steps,
                bends: false,
                ..
            } = &self.plays[index]
            {
                for &(k, by) in steps {
                    self.chosen.steps[k] += by * e;
                }
            }
            self.chosen.stepped.push(e);
        }
        true
    }

    /// Sets the steps of the dimensions for the parameters that bend, the others at their values: the model is read with them.
    fn step_bent(&mut self) -> bool {
        let bent = |&index: &usize| match self.plays[index] {
            Play::Parameter { bends: true, .. } => self.chosen.extremes[index][0],
            _ => 0.0,
        };
        let mut asked = self.parameters.iter().map(bent);
        if asked.all(|by| by == 0.0) {
            self.chosen.steps.fill(0.0);
            return true;
        }
        let asked: Vec<f64> = self.parameters.iter().map(bent).collect();
        let key = asked.iter().map(|by| by.to_bits()).collect();
        let corners = self.corners;
        let steps = self.known.entry(key).or_insert_with(|| corners(&asked));
        let Some(steps) = steps else {
            return false;
        };
        self.chosen.steps.copy_from_slice(steps);
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
        let here = self.here(stand);
        let system = self.driven.system;
        let own = output.pulls(&here.at, here.shifts);
        output.gradient(&here.at, &own, &system.layout, &mut out);
        for (entry, value) in system.entries.iter().zip(&here.evaluation.jacobian) {
            if let Some(column) = entry.column() {
                out[column as usize] -= value * load.lambda[entry.row as usize];
            }
        }
        self.dimensions.turn(here, &own, load, &self.offs, &mut out);
        self.space.pull = out;
    }

    /// ∂y/∂q (n) at the position last taken.
    pub fn gradient(&self, stand: &Stand, output: &Output, gradient: &mut [f64]) {
        let at = self.driven.evaluation.kinematics(&stand.inputs);
        let own = output.pulls(&at, &self.shifts);
        output.gradient(&at, &own, &self.driven.system.layout, gradient);
    }
}
