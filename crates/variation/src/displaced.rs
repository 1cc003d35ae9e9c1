//! A mechanism with its sources off by given amounts: the gaps of its rows, and where its output is then.
//!
//! ```text
//! φ(q) + B e = 0                           B e the gaps that all deviations e make in the rows
//! pull     p = ∂y/∂P − λᵀ ∂φ/∂P            of a point P alone, in global axes
//! steps    g = Aᵀ p                        of its coordinates in the frame of its body, A the rotation of the body
//! off      P + A s + d                     s steps of the coordinates, d the place in a zone, which keeps its direction
//! y ≈ y(q) − λᵀ(φ + B e)                   off by the square of what q and λ lack
//! ```

use super::geometry::{Dimension, Dimensions, Here, PointId};
use super::output::{Load, Output, Pulls};
use super::poses::NominalPose;
use super::question::Question;
use super::source::{Acts, Pair, Room, Source};
use linkdyn_engine::element::Pose;
use linkdyn_engine::mechanism::driven::Driven;
use linkdyn_linear::math::{Vec2, perp};

/// An output at a pose.
#[derive(Clone, Copy)]
pub(super) struct Asked<'a> {
    pub stand: &'a NominalPose,
    pub output: &'a Output,
}

impl Question<'_> {
    /// An output at a pose.
    pub fn asked<'a>(&'a self, output: usize, stand: &'a NominalPose) -> Asked<'a> {
        let output = &self.outputs[output].output;
        Asked { stand, output }
    }
}

/// A point that sources move.
#[derive(Debug, Clone)]
struct Moved {
    id: PointId,
    body: usize,
    /// The column of the body's angle.
    theta: Option<usize>,
    /// The first of its dimensions, where parameters step it.
    stepped: Option<usize>,
    /// The source that is its zone.
    zone: Option<usize>,
    /// How far it is off by what turns with its body, and in all, in global axes \[m\].
    turning: Vec2,
    off: Vec2,
}

/// A driven mechanism with all that may be off.
pub(super) struct Mechanism<'m> {
    pub driven: Driven<'m>,
    pub question: &'m Question<'m>,
    pub dimensions: &'m Dimensions,
    pub sources: &'m [Source],
    moved: Vec<Moved>,
    /// Dimensions that parameters step, but for those of points; and ∂y by all, as last requested.
    stepped: Vec<usize>,
    slopes: Vec<f64>,
    /// Deviations of the sources, and the steps of the dimensions that they make.
    pub e: Vec<Pair>,
    steps: Vec<f64>,
    /// Gaps of the rows (m).
    pub rows: Vec<f64>,
    /// Shifts of the points in the frames of their bodies \[m\].
    pub shifts: Vec<Vec2>,
    /// Space: corrections of positions (n) and of multipliers (m).
    pub step: Vec<f64>,
    pub gradient: Vec<f64>,
    right: Vec<f64>,
    correction: Vec<f64>,
}

impl<'m> Mechanism<'m> {
    pub fn new(driven: Driven<'m>, question: &'m Question<'m>) -> Self {
        let (dimensions, sources) = (question.dimensions, &*question.sources);
        let (n, m) = (driven.system.n(), driven.system.m());
        let mut mechanism = Mechanism {
            question,
            dimensions,
            sources,
            moved: Vec::new(),
            stepped: Vec::new(),
            slopes: vec![0.0; dimensions.all.len()],
            e: vec![[0.0; 2]; sources.len()],
            steps: vec![0.0; dimensions.all.len()],
            rows: vec![0.0; m],
            shifts: vec![Vec2::zeros(); dimensions.points.len()],
            step: vec![0.0; n],
            gradient: vec![0.0; n],
            right: vec![0.0; m],
            correction: vec![0.0; m],
            driven,
        };
        for (number, source) in sources.iter().enumerate() {
            match &source.acts {
                Acts::Row(_) => {}
                Acts::Point(id) => mechanism.moved(*id).zone = Some(number),
                Acts::Dimensions { steps, .. } => {
                    steps.iter().for_each(|&(k, _)| mechanism.add_stepped(k));
                }
            }
        }
        mechanism
    }

    fn add_stepped(&mut self, k: usize) {
        match self.dimensions.all[k] {
            Dimension::Point(id, axis) => self.moved(id).stepped = Some(k - axis),
            Dimension::Direction { .. }
            | Dimension::Angle { .. }
            | Dimension::Mesh { .. }
            | Dimension::Ratio { .. }
            | Dimension::Motion { .. } => {
                if !self.stepped.contains(&k) {
                    self.stepped.push(k);
                }
            }
        }
    }

    /// A point among those that are moved.
    fn moved(&mut self, id: PointId) -> &mut Moved {
        let known = self.moved.iter().position(|moved| moved.id == id);
        let number = known.unwrap_or(self.moved.len());
        if known.is_none() {
            let body = self.dimensions.points[id.0].body;
            let columns = self.driven.system.layout.columns(body);
            self.moved.push(Moved {
                id,
                body: body.0,
                theta: columns.map(|columns| columns.theta()),
                stepped: None,
                zone: None,
                turning: Vec2::zeros(),
                off: Vec2::zeros(),
            });
        }
        &mut self.moved[number]
    }

    /// The position last taken.
    pub fn here<'a>(&'a self, stand: &'a NominalPose) -> Here<'a> {
        Here {
            system: self.driven.system,
            evaluation: &self.driven.evaluation,
            at: self.driven.evaluation.kinematics(&stand.inputs),
            time: stand.inputs.time,
            held: stand.held,
        }
    }

    /// Takes a position: φ without gaps, and J.
    pub fn take(&mut self, q: &[f64], stand: &NominalPose) {
        let system = self.driven.system;
        self.driven.evaluation.set_position(q);
        self.driven.evaluation.eval_phi(system, &stand.inputs);
        self.driven.evaluation.eval_jacobian(system, &stand.inputs);
    }

    /// Takes the nominal position of a pose: φ, and J with its factors. Whether J has an inverse.
    pub fn stand(&mut self, stand: &NominalPose) -> bool {
        self.driven.evaluation.set_position(&stand.q);
        let system = self.driven.system;
        self.driven.evaluation.eval_phi(system, &stand.inputs);
        self.shifts.fill(Vec2::zeros());
        self.driven.factor(&stand.inputs).is_ok()
    }

    /// Takes a position, and factors J there.
    pub fn factor(&mut self, q: &[f64], stand: &NominalPose) -> Option<()> {
        self.take(q, stand);
        self.driven.factor(&stand.inputs).ok()
    }

    /// λ = J⁻ᵀ ∂y at a pose that was taken, and whose factors are at hand; `None` if they say nothing.
    pub fn load(&mut self, of: Asked) -> Option<Load> {
        self.gradient(of);
        let mut lambda = vec![0.0; self.driven.system.m()];
        self.driven.multipliers(&self.gradient, &mut lambda);
        let is_finite = lambda.iter().all(|l| l.is_finite());
        is_finite.then_some(Load { lambda, size: 1.0 })
    }

    /// Sets `gradient` to ∂y/∂q (n) at the position last taken.
    pub fn gradient(&mut self, of: Asked) {
        let mut gradient = std::mem::take(&mut self.gradient);
        let at = self.driven.evaluation.kinematics(&of.stand.inputs);
        let own = of.output.pulls(&at, &self.shifts);
        let layout = &self.driven.system.layout;
        of.output.gradient(&at, &own, layout, &mut gradient);
        self.gradient = gradient;
    }

    /// p of a point under a load on the output, which itself pulls with `own`.
    fn pull(&self, moved: &Moved, own: &Pulls, load: &Load) -> Vec2 {
        let jacobian = &self.driven.evaluation.jacobian;
        let holds = self.dimensions.points[moved.id.0].holds.iter();
        let mut pull = Vec2::zeros();
        holds.for_each(|hold| pull -= hold.pull(jacobian, &load.lambda));
        for (place, own) in own.iter().flatten() {
            if place.point == Some(moved.id) {
                pull += own * load.size;
            }
        }
        pull
    }

    /// g of all sources at the position last taken, under a load on the output.
    pub fn influences(&mut self, of: Asked, load: &Load, g: &mut [Pair]) {
        let at = self.driven.evaluation.kinematics(&of.stand.inputs);
        let own = of.output.pulls(&at, &self.shifts);
        self.influences_of(of.stand, &own, load, g);
    }

    /// The same of an output whose own points pull with `own`.
    pub fn influences_of(&mut self, stand: &NominalPose, own: &Pulls, load: &Load, g: &mut [Pair]) {
        let mut slopes = std::mem::take(&mut self.slopes);
        let here = self.here(stand);
        for moved in &self.moved {
            let pull = self.pull(moved, own, load);
            if let Some(k) = moved.stepped {
                let Pose { cos, sin, .. } = here.at.poses[moved.body];
                slopes[k] = cos * pull.x + sin * pull.y;
                slopes[k + 1] = cos * pull.y - sin * pull.x;
            }
            if let Some(zone) = moved.zone {
                g[zone] = [pull.x, pull.y];
            }
        }
        for &k in &self.stepped {
            let gains = self.dimensions.gains(&here, k).into_iter().flatten();
            slopes[k] = -gains
                .map(|gain| load.lambda[gain.row] * gain.rate)
                .sum::<f64>();
        }
        for (g, source) in g.iter_mut().zip(self.sources) {
            match (&source.acts, source.room) {
                (Acts::Point(_), _) => {}
                (Acts::Row(row), Room::Line(_)) => *g = [-load.lambda[*row], 0.0],
                (Acts::Row(row), Room::Disc(_) | Room::Guide { .. }) => {
                    *g = [-load.lambda[*row], -load.lambda[row + 1]];
                }
                (Acts::Dimensions { steps, .. }, _) => {
                    *g = [steps.iter().map(|&(k, by)| by * slopes[k]).sum(), 0.0];
                }
            }
        }
        self.slopes = slopes;
    }

    /// Sets the steps of the dimensions for the deviations `e`: what curved parameters do together, and of the others the sum of
    /// what each does. Whether the model can be had with them.
    pub fn step_parameters(&mut self) -> bool {
        self.steps.fill(0.0);
        let all = self.sources.iter().zip(&self.e);
        let curved = all.clone().filter_map(|(source, e)| match source.acts {
            Acts::Dimensions { is_curved, .. } => Some(if is_curved { e[0] } else { 0.0 }),
            Acts::Row(_) | Acts::Point(_) => None,
        });
        if curved.clone().any(|by| by != 0.0) {
            let curved: Vec<f64> = curved.collect();
            let Some(steps) = self.question.corners.steps(&curved) else {
                return false;
            };
            self.steps.copy_from_slice(&steps);
        }
        for (source, e) in all {
            if let Acts::Dimensions {
                steps,
                is_curved: false,
            } = &source.acts
            {
                steps.iter().for_each(|&(k, by)| self.steps[k] += by * e[0]);
            }
        }
        true
    }

    /// Puts the points where steps and zones put them, at the position last taken.
    pub fn place(&mut self, stand: &NominalPose) {
        let poses = self.driven.evaluation.kinematics(&stand.inputs).poses;
        for moved in &mut self.moved {
            let pose = &poses[moved.body];
            let step = |k: usize| Vec2::new(self.steps[k], self.steps[k + 1]);
            let mut shift = moved.stepped.map_or(Vec2::zeros(), step);
            moved.turning = pose.turn(shift);
            moved.off = moved.turning;
            if let Some(zone) = moved.zone {
                let [x, y] = self.e[zone];
                moved.off += Vec2::new(x, y);
                shift += Vec2::new(pose.cos * x + pose.sin * y, pose.cos * y - pose.sin * x);
            }
            self.shifts[moved.id.0] = shift;
        }
    }

    /// Sets the gaps of the rows, at the position last taken, for points where they were put, steps and e.
    pub fn gap(&mut self, stand: &NominalPose) {
        let mut rows = std::mem::take(&mut self.rows);
        rows.fill(0.0);
        let here = self.here(stand);
        for moved in &self.moved {
            let holds = self.dimensions.points[moved.id.0].holds.iter();
            holds.for_each(|hold| hold.push(&here.evaluation.jacobian, moved.off, &mut rows));
        }
        for &k in self.stepped.iter().filter(|&&k| self.steps[k] != 0.0) {
            self.dimensions.push(&here, k, self.steps[k], &mut rows);
        }
        for (source, e) in self.sources.iter().zip(&self.e) {
            if let Acts::Row(row) = source.acts {
                let own = rows[row..].iter_mut().zip(e);
                own.take(source.room.numbers())
                    .for_each(|(row, e)| *row += e);
            }
        }
        self.rows = rows;
    }

    /// The output at the position last taken, with the shifts of its points times `part`.
    pub fn value(&self, of: Asked, part: f64) -> f64 {
        let at = self.driven.evaluation.kinematics(&of.stand.inputs);
        of.output
            .value(&at, &|PointId(point)| self.shifts[point] * part)
    }

    /// Sets `right` to what the equations lack, −(φ + B e), and says what that is worth to the output.
    fn lack(&mut self, load: &Load) -> f64 {
        let rows = self.driven.evaluation.phi.iter().zip(&self.rows);
        let mut lacking = 0.0;
        for ((right, (phi, gap)), l) in self.right.iter_mut().zip(rows).zip(&load.lambda) {
            *right = -(phi + gap);
            lacking += *right * l;
        }
        lacking
    }

    /// The output as read at the position last taken, with the points where they were put.
    pub fn reading(&mut self, of: Asked, load: &Load) -> f64 {
        self.gap(of.stand);
        let lacking = self.lack(load);
        self.value(of, 1.0) + lacking
    }

    /// Corrects q and λ for the deviations `e`, by the factors at hand. How far: the position [–], and the multipliers in parts of
    /// the largest, both as moments or forces on the mechanism's size.
    pub fn correct(&mut self, of: Asked, q: &mut [f64], load: &mut Load) -> [f64; 2] {
        self.take(q, of.stand);
        self.place(of.stand);
        self.unbalance(of, load);
        self.driven
            .multipliers(&self.gradient, &mut self.correction);
        let system = self.driven.system;
        let (mut most, mut largest) = (0.0_f64, 0.0_f64);
        let lambda = load.lambda.iter_mut().zip(&self.correction).enumerate();
        for (row, (l, more)) in lambda {
            *l += *more;
            let scale = system.row_scale(row);
            most = most.max((*l * scale).abs());
            largest = largest.max((*more * scale).abs());
        }
        self.gap(of.stand);
        self.lack(load);
        self.driven.answer(&self.right, &mut self.step);
        q.iter_mut().zip(&self.step).for_each(|(q, by)| *q += by);
        let leant = if most > 0.0 { largest / most } else { 0.0 };
        [system.scaled_norm(&self.step), leant]
    }

    /// Sets `gradient` to ∂y − Jᵀ λ (n) at the position last taken, with the points where they were put: the Lagrangian
    /// y − λᵀ(φ + B e) also changes as bodies turn while their points are off.
    fn unbalance(&mut self, of: Asked, load: &Load) {
        self.gradient(of);
        let mut gradient = std::mem::take(&mut self.gradient);
        let here = self.here(of.stand);
        let jacobian = &here.evaluation.jacobian;
        for (entry, value) in here.system.entries.iter().zip(jacobian) {
            if let Some(column) = entry.column() {
                gradient[column as usize] -= value * load.lambda[entry.row as usize];
            }
        }
        let own = of.output.pulls(&here.at, &self.shifts);
        for moved in &self.moved {
            if let Some(column) = moved.theta {
                gradient[column] += self.pull(moved, &own, load).dot(&perp(moved.turning));
            }
            for hold in &self.dimensions.points[moved.id.0].holds {
                let columns = hold.guide.and_then(|body| here.system.layout.columns(body));
                if let Some(columns) = columns {
                    let pull = hold.pull(jacobian, &load.lambda);
                    gradient[columns.theta()] -= perp(pull).dot(&moved.off);
                }
            }
        }
        self.gradient = gradient;
    }
}
