//! A mechanism that is moved by hand: a point is pulled, drivers let go, and every loop stays assembled as it is.
//!
//! The position q is searched that joints allow, φ(q) = 0, on the branch of the last one, with its point p nearest to a target p*. With
//! the scaled Jacobian J̃ of the joints and a basis N of its null space, from a singular value decomposition, a step is
//!
//! ```text
//! d = N z,   z of least norm among those that minimise |P N z − (p* − p)|,   P = ∂p/∂q̃
//! ```
//!
//! no longer than `LONGEST`, and moved onto the joints by the shortest way (`mechanism::closing`). A step whose correction is not small
//! beside it, or that goes past a stop or into an outline, is tried again with half its length. Where one freedom is left, det \[J̃; tᵀ\]
//! with the tangent t has one sign along a branch: a step over which it changes is halved, too, down to `CROSSED`, so that a branch
//! that only comes near another is followed around, and a singular position that is crossed is reported. Freedom that the point does
//! not need is not used.

use super::control::Stop;
use super::ends::{seen, turns};
use super::in_line::{singular_text, stressed_rows};
use crate::element::pair::ContactId;
use crate::mechanism::closing::close;
use crate::system::{Block, Evaluation, Inputs, Origin, System, compile::compile};
use linkdyn_linear::dense::{Dense, least_norm_solve, svd_rank};
use linkdyn_linear::math::Vec2;
use linkdyn_model::{AnalysisKind, Checked};
use nalgebra::DMatrix;

/// Longest step, in rad or mechanism sizes.
const LONGEST: f64 = 0.06;
/// Steps of one pull, at most; the next pull goes on.
const MOST_STEPS: usize = 60;
/// Shortest part of a longer step that is tried, and what no step is shorter than.
const SHORTEST: f64 = 1e-7;
const ROUND_OFF: f64 = 1e-14;
/// Branches that come nearer than such a step are taken to cross.
const CROSSED: f64 = 1e-4;
/// The correction of a step is smaller than this part of it.
const CORRECTED: f64 = 0.25;
/// A target is reached, in mechanism sizes.
const REACHED: f64 = 1e-12;
/// A pull that gains less than this part of a step's length leads nowhere.
const GAIN: f64 = 1e-4;
/// Singular values below this part of the largest count as zero where the freedom is counted.
const RANK: f64 = 1e-9;
/// The same where a position counts as singular: a hand does not hit one.
const SINGULAR: f64 = 3e-3;
/// Depth of what counts as beyond a stop, in mechanism sizes.
const BEYOND: f64 = 1e-9;

/// A mechanism at a position, its drivers let go.
pub struct Hand {
    system: System,
    inputs: Inputs,
    q: Vec<f64>,
}

/// What came of a pull.
#[derive(Debug, Clone, PartialEq)]
pub struct Pulled {
    /// x, y \[m\] and angle \[rad\] of the frame of each moving body.
    pub poses: Vec<[f64; 3]>,
    /// What is left between the point and its target \[m\].
    pub distance: f64,
    /// What is in line or otherwise singular here, where the point does not follow, or where the mechanism went through.
    pub singular: Option<String>,
    /// The stop or outline that the mechanism meets.
    pub stopped: Option<String>,
}

impl Hand {
    /// Takes a model with all pins ideal, as it is drawn.
    ///
    /// # Errors
    /// Faults of the model.
    pub fn new(model: &Checked) -> Result<Self, Stop> {
        let model = model.with_clearances(|_| false);
        // An assembly has no stops; what else kinematics refuse can be held all the same.
        let system = compile(&model, AnalysisKind::Kinematics);
        let system = system.or_else(|_| compile(&model, AnalysisKind::Assembly));
        let system = system.map_err(|found| Stop::Input(found.0))?;
        let inputs = Inputs::at_time(&system, 0.0);
        let q = system.guess.clone();
        Ok(Hand { system, inputs, q })
    }

    /// Starts from poses of the moving bodies' frames, and closes the joints.
    ///
    /// # Errors
    /// Where the joints do not close there.
    pub fn take(&mut self, poses: &[[f64; 3]]) -> Result<(), String> {
        self.put(poses);
        let Hand { system, inputs, q } = self;
        let closed = close(system, &joints(system), q, inputs);
        if !closed.converged {
            return Err("the joints do not close here".into());
        }
        *q = closed.q;
        Ok(())
    }

    /// The position next to poses at a time, its drivers in force: the assembly that continues what stood there; none where there is none.
    pub fn beside(&mut self, poses: &[[f64; 3]], time: f64) -> Option<Vec<[f64; 3]>> {
        self.put(poses);
        let inputs = Inputs::at_time(&self.system, time);
        let blocks = self.system.blocks.iter();
        let holds = |block: &&Block| matches!(block.origin, Origin::Joint(_) | Origin::Driver(_));
        let closed = close(
            &self.system,
            &blocks.filter(holds).collect::<Vec<_>>(),
            &self.q,
            &inputs,
        );
        self.q = closed.q;
        closed.converged.then(|| self.poses())
    }

    /// Takes poses as they are.
    fn put(&mut self, poses: &[[f64; 3]]) {
        let Hand { system, q, .. } = self;
        let bodies = system.bodies.iter().zip(system.layout.bodies());
        for ((body, columns), &[x, y, theta]) in bodies.zip(poses) {
            let origin = crate::element::Pose::new(x, y, theta).turn(body.origin);
            columns.write(q, [x - origin.x, y - origin.y, theta]);
        }
    }

    /// Pulls a point of a moving body (from 0, in its frame) towards a place.
    pub fn pull(&mut self, body: usize, local: [f64; 2], target: [f64; 2]) -> Pulled {
        let own = &self.system.bodies[body];
        let point = Vec2::new(local[0] + own.origin.x, local[1] + own.origin.y);
        let target = Vec2::new(target[0], target[1]);
        let (mut stopped, mut crossed) = (None, None);
        let allowed = self.depths(&self.q).into_iter().map(|depth| depth.max(0.0));
        let allowed: Vec<f64> = allowed.collect();
        let mut length = LONGEST;
        for _ in 0..MOST_STEPS {
            let off = target - self.place(body, point, &self.q);
            if off.norm() <= REACHED * self.system.size {
                break;
            }
            let Some(step) = self.step(body, point, off) else {
                break;
            };
            let size = norm(&step);
            if size <= ROUND_OFF {
                break;
            }
            stopped = None;
            match self.taken((&step, size), &mut length, &allowed) {
                Ok((q, crosses)) => {
                    if crosses {
                        crossed = crossed.or_else(|| self.stressed(&self.jacobian()));
                    }
                    let now = (target - self.place(body, point, &q)).norm();
                    let gain = off.norm() - now;
                    let moved = size.min(length) * self.system.size;
                    if gain <= 0.0 && now > off.norm() * (1.0 + 1e-12) {
                        // Beyond the nearest place: it lies between.
                        length = 0.5 * size.min(length);
                        if length <= SHORTEST.min(1e-3 * size) {
                            break;
                        }
                        continue;
                    }
                    self.q = q;
                    if gain < GAIN * moved && moved < SHORTEST * self.system.size {
                        break;
                    }
                    length = LONGEST.min(2.0 * length);
                }
                Err(met) => {
                    stopped = met;
                    break;
                }
            }
        }
        let distance = (target - self.place(body, point, &self.q)).norm();
        let is_short = distance > 1e-9 * self.system.size && stopped.is_none();
        Pulled {
            poses: self.poses(),
            distance,
            singular: is_short
                .then(|| self.singular(body, point))
                .flatten()
                .or(crossed),
            stopped,
        }
    }

    /// x, y \[m\] and angle \[rad\] of the moving bodies' frames.
    pub fn poses(&self) -> Vec<[f64; 3]> {
        self.system.frames(&self.q)
    }

    /// Where a point stands that is given from the centre of mass.
    fn place(&self, body: usize, point: Vec2, q: &[f64]) -> Vec2 {
        let [x, y, theta] = self.system.layout.moving(body).read(q);
        Vec2::new(x, y) + crate::element::Pose::new(x, y, theta).turn(point)
    }

    /// det \[J̃; tᵀ\] at a position of a mechanism with one freedom, t the tangent that points along a step; 0 of all others.
    fn side(&self, q: &[f64], step: &[f64]) -> f64 {
        let n = self.system.n();
        if self.system.joint_rows() + 1 != n {
            return 0.0;
        }
        let jacobian = self.jacobian_at(q);
        let Ok(found) = svd_rank(&jacobian, RANK) else {
            return 0.0;
        };
        if found.right_null.columns() != 1 {
            return 0.0;
        }
        let tangent = found.right_null.column(0);
        let along: f64 = tangent.iter().zip(step).map(|(t, d)| t * d).sum();
        let square = DMatrix::from_fn(n, n, |row, column| match row + 1 < n {
            true => jacobian.get(row, column),
            false => tangent[column] * along.signum(),
        });
        square.determinant()
    }

    /// The scaled Jacobian of the joints.
    fn jacobian(&self) -> Dense {
        self.jacobian_at(&self.q)
    }

    fn jacobian_at(&self, q: &[f64]) -> Dense {
        let (system, n) = (&self.system, self.system.n());
        let mut evaluation = Evaluation::new(system);
        evaluation.set_position(q);
        evaluation.eval_jacobian(system, &self.inputs);
        let rows = system.joint_rows();
        let values = system.dense_scaled(&evaluation.jacobian);
        // One row of zeros where there is no joint.
        let mut values = values[..rows * n].to_vec();
        values.resize(rows.max(1) * n, 0.0);
        Dense::new(rows.max(1), n, values)
    }

    /// How the point follows each free direction, by the mechanism's size; and these directions (n, free).
    fn leads(&self, body: usize, point: Vec2) -> Option<(Vec<[f64; 2]>, Dense)> {
        let (system, n) = (&self.system, self.system.n());
        let free = svd_rank(&self.jacobian(), RANK).ok()?.right_null;
        let columns = system.layout.moving(body);
        let lead = |k: usize| {
            let direction: Vec<f64> = (0..n).map(|row| free.get(row, k)).collect();
            let ([dx, dy, turn], [x, y]) = (columns.read(&direction), self.arm(body, point));
            [dx - turn * y, dy + turn * x]
        };
        let leads: Vec<[f64; 2]> = (0..free.columns()).map(lead).collect();
        (!leads.is_empty()).then_some((leads, free))
    }

    /// From a body's coordinates to a point of it, by the mechanism's size.
    fn arm(&self, body: usize, point: Vec2) -> [f64; 2] {
        let [x, y, theta] = self.system.layout.moving(body).read(&self.q);
        let arm = crate::element::Pose::new(x, y, theta).turn(point);
        [arm.x / self.system.size, arm.y / self.system.size]
    }

    /// The step that brings the point nearest (n), scaled; none where nothing is free.
    fn step(&self, body: usize, point: Vec2, off: Vec2) -> Option<Vec<f64>> {
        let (leads, free) = self.leads(body, point)?;
        let axes = [0, 1].iter();
        let flat = axes.flat_map(|&axis| leads.iter().map(move |lead| lead[axis]));
        let matrix = Dense::new(2, leads.len(), flat.collect());
        let off = [off.x, off.y].map(|off| off / self.system.size);
        let z = least_norm_solve(&matrix, &off, SINGULAR).ok()?.x;
        let along = |row: usize| {
            z.iter()
                .enumerate()
                .map(|(k, z)| z * free.get(row, k))
                .sum()
        };
        Some((0..self.system.n()).map(along).collect())
    }

    /// The position after a step, or after as much of it as can be taken; what is met, where that is nothing.
    fn taken(
        &self,
        (step, size): (&[f64], f64),
        length: &mut f64,
        allowed: &[f64],
    ) -> Result<(Vec<f64>, bool), Option<String>> {
        let system = &self.system;
        let side = self.side(&self.q, step);
        let mut met = None;
        *length = length.min(size);
        let least = SHORTEST.min(1e-3 * size);
        while *length > least {
            let share = *length / size;
            let mut scaled: Vec<f64> = step.iter().map(|d| d * share).collect();
            system.scale_columns(&mut scaled);
            let there: Vec<f64> = self.q.iter().zip(&scaled).map(|(q, d)| q + d).collect();
            let closed = close(system, &joints(system), &there, &self.inputs);
            let correction = closed.q.iter().zip(&there).enumerate();
            let correction: Vec<f64> = correction
                .map(|(k, (a, b))| (a - b) / system.column_scale(k))
                .collect();
            if closed.converged && norm(&correction) <= CORRECTED * *length {
                // Beyond a crossing, or on another branch that comes near.
                let crosses = side * self.side(&closed.q, step) < 0.0;
                if crosses && *length > CROSSED {
                    *length *= 0.5;
                    continue;
                }
                let depths = self.depths(&closed.q);
                let beyond = depths.iter().zip(allowed);
                let beyond = beyond.map(|(depth, allowed)| depth - allowed);
                let deepest = beyond.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
                match deepest.filter(|(_, depth)| *depth > BEYOND * system.size) {
                    None => return Ok((closed.q, crosses)),
                    Some((contact, _)) => met = Some(system.owner_words(ContactId(contact))),
                }
            }
            *length *= 0.5;
        }
        Err(met)
    }

    /// How deep each stop and outline is passed.
    fn depths(&self, q: &[f64]) -> Vec<f64> {
        let system = &self.system;
        if system.contacts.is_empty() {
            return Vec::new();
        }
        let turned = seen(system, &self.q, |at| turns(system, at));
        seen(system, q, |at| {
            let contacts = system.contacts.iter().zip(&turned);
            let depth = contacts.map(|(pair, &turned)| match (pair.stop(), pair.edge()) {
                (Some(stop), _) if !pair.is_one_way() => stop.turned(turned).read(at).penetration,
                (_, Some(edge)) => edge.depth(&edge.read(at), system.size),
                (Some(_), _) | (None, None) => f64::NEG_INFINITY,
            });
            depth.collect()
        })
    }

    /// What is singular here, where the mechanism moves and the point does not: with the point held joints carry a load in themselves.
    fn singular(&self, body: usize, point: Vec2) -> Option<String> {
        let (leads, _) = self.leads(body, point)?;
        if leads.iter().flatten().any(|lead| lead.abs() > SINGULAR) {
            return None;
        }
        let (n, jacobian) = (self.system.n(), self.jacobian());
        let columns = self.system.layout.moving(body);
        let [x, y] = self.arm(body, point);
        let mut values: Vec<f64> = (0..jacobian.rows())
            .flat_map(|row| jacobian.row(row).to_vec())
            .collect();
        for (held, turn) in [([1.0, 0.0], -y), ([0.0, 1.0], x)] {
            let mut row = vec![0.0; n];
            columns.write(&mut row, [held[0], held[1], turn]);
            values.extend(row);
        }
        self.stressed(&Dense::new(jacobian.rows() + 2, n, values))
    }

    /// Which joints carry a load in themselves, as rows of a matrix (joints first) that nearly lose rank have it.
    fn stressed(&self, matrix: &Dense) -> Option<String> {
        let stress = svd_rank(matrix, SINGULAR).ok()?.left_null;
        let stress = (stress.columns() > 0).then(|| stress.column(0))?;
        let rows = stressed_rows(&self.system, &stress[..self.system.joint_rows()]);
        singular_text(&self.system, &rows)
    }
}

fn joints(system: &System) -> Vec<&Block> {
    let blocks = system.blocks.iter();
    blocks
        .filter(|block| matches!(block.origin, Origin::Joint(_)))
        .collect()
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests;
