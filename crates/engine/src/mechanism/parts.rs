//! Parts with one degree of freedom of a mechanism with more, across their change points.
//!
//! Where joints alone hold some bodies in loops and leave them one degree of freedom, their positions are a curve q(s) of
//! one of their coordinates, whatever else moves: drivers, contacts, bodies hung on them. Where the loops hold no ground, the
//! coordinates are those in the frame of one of the bodies, which moves as it likes. At a change point of that curve the
//! part's equations lose rank, and the whole mechanism's with them; near it round-off of accelerations grows as 1/δ³. There
//! the part's rows are exchanged for as many that say the same without losing rank,
//!
//! ```text
//! q_i − Q_i(s) = 0      i: the part's coordinates but s;  Q: the smooth branch, see [`super::continuation`]
//! ```
//!
//! Reactions of the part's joints are still those of their own equations.

mod on_branch;

use super::continuation::{HALF_TURN, Parameter, Path, follow};
use super::driven::{Driven, Failure};
use super::independent::better_coordinate;
use super::phases::{Exchanged, Phases, Windows};
use crate::element::pair::Hold;
use crate::element::{BodyColumns, BodyId};
use crate::system::{Inputs, System};
use linkdyn_linear::hermite::Node;
use on_branch::OnBranch;
pub use on_branch::Seen;
use std::sync::Arc;

/// Exchanges of the independent coordinate at a start of the curve; the first nearly always serves.
const EXCHANGES: usize = 4;
/// Stretches of a curve, each by a coordinate of its own, on which change points are looked for.
const SEGMENTS: usize = 3;
/// Largest distance of a point from a curve that it is on: that of the curve's interpolation [rad or sizes].
const SAME: f64 = 1e-5;

/// A part by itself, and where it stands in the whole.
pub struct Part {
    /// The part by itself, the body that it is seen from as its ground.
    pub system: System,
    /// That body in the whole, and its columns where it moves.
    pub from: BodyId,
    pub frame: Option<BodyColumns>,
    /// By coordinate of the part: columns of its body in the whole.
    pub columns: Vec<BodyColumns>,
    /// The same as coordinates of the whole's bodies.
    pub coordinates: Vec<Seen>,
    /// Blocks of its joints in the whole, and their numbers of rows; one less than columns in all.
    pub blocks: Vec<(usize, usize)>,
    /// A column of the part that determines the rest.
    pub independent: usize,
}

impl Part {
    /// The part's coordinate `k` where the whole is at `q`.
    fn value(&self, k: usize, q: &[f64]) -> f64 {
        let own = self.columns[k].read(q);
        self.coordinates[k].of(own, self.frame.map(|columns| columns.read(q)))
    }

    /// All of them.
    pub fn values(&self, q: &[f64]) -> Vec<f64> {
        (0..self.columns.len()).map(|k| self.value(k, q)).collect()
    }

    /// Whether the curve through `q` of the whole has change points, as far as two of its coordinates tell it.
    pub fn has_change_points(&self, q: &[f64]) -> bool {
        let mut followed = FollowedPart::new(self);
        let mut starts = vec![self.values(q)];
        let mut turns = false;
        for _ in 0..SEGMENTS {
            let Some(start) = starts.pop() else { break };
            let Some(index) = followed.follow(&start) else {
                continue;
            };
            let path = &followed.curves[index].path;
            if !path.windows().is_empty() {
                return true;
            }
            if index == 0 {
                turns = path.turn.is_some();
                starts.extend(path.ends().map(<[f64]>::to_vec));
            }
            if turns {
                break;
            }
        }
        false
    }
}

/// Parts of a mechanism, and the solvers of what takes its place near their change points.
#[derive(Clone)]
pub struct Parts<'s> {
    parts: Vec<FollowedPart<'s>>,
    phases: &'s Phases<'s>,
    /// How contacts are held.
    holds: Vec<Hold>,
    now: Windows,
    next: Windows,
    /// Solvers not in use.
    others: Vec<(Windows, Driven<'s>)>,
}

impl<'s> Parts<'s> {
    /// Of a mechanism whose contacts are all in flight.
    pub fn new(parts: &'s [Part], phases: &'s Phases<'s>) -> Self {
        let none = vec![None; parts.len()];
        Parts {
            parts: parts.iter().map(FollowedPart::new).collect(),
            phases,
            holds: Vec::new(),
            now: none.clone(),
            next: none,
            others: Vec::new(),
        }
    }

    /// The same parts with contacts that are held otherwise.
    pub fn with_holds(self, holds: &[Hold]) -> Self {
        let none = vec![None; self.parts.len()];
        Parts {
            holds: holds.to_vec(),
            now: none.clone(),
            next: none,
            others: Vec::new(),
            ..self
        }
    }

    /// Gives `driven` the solver for the surroundings of `q`, near the accepted point `here`.
    ///
    /// # Errors
    /// Where it can't be made.
    pub fn enter(
        &mut self,
        driven: &mut Driven<'s>,
        q: &[f64],
        here: &Node,
        inputs: &Inputs,
    ) -> Result<(), Failure> {
        for (next, part) in self.next.iter_mut().zip(&mut self.parts) {
            *next = part.window_at(q, here);
        }
        if self.next == self.now {
            return Ok(());
        }
        let columns: Vec<usize> = driven
            .independent
            .iter()
            .map(|coordinate| coordinate.column)
            .collect();
        let mut other = match self
            .others
            .iter()
            .position(|(windows, _)| *windows == self.next)
        {
            Some(index) => self.others.swap_remove(index).1,
            None => Driven::with_independent(self.system(), &columns, q, inputs)?,
        };
        if other
            .independent
            .iter()
            .zip(&columns)
            .any(|(coordinate, column)| coordinate.column != *column)
        {
            other.evaluation.set_position(q);
            if let Err(failure) = other.choose(&columns, inputs) {
                self.others.push((self.next.clone(), other));
                return Err(failure);
            }
        }
        other.independent.copy_from_slice(&driven.independent);
        (other.last_step, other.done) = (driven.last_step, driven.done);
        std::mem::swap(&mut other.dependent_forces, &mut driven.dependent_forces);
        std::mem::swap(driven, &mut other);
        self.others
            .push((std::mem::replace(&mut self.now, self.next.clone()), other));
        Ok(())
    }

    /// The system with the smooth branches of the next windows.
    fn system(&self) -> &'s System {
        self.phases.get(&self.holds, &self.next, || {
            let mut exchanged = Exchanged::new();
            for (part, window) in self.parts.iter().zip(&self.next) {
                if let Some(window) = window {
                    part.exchange(*window, &mut exchanged);
                }
            }
            exchanged
        })
    }

    /// Number of the parts.
    pub(super) fn count(&self) -> usize {
        self.parts.len()
    }

    /// The curve that a part is on, where it was followed.
    pub(super) fn path(&self, part: usize) -> Option<&Path> {
        Some(&self.parts[part].on()?.path)
    }

    /// The coordinate that a part's curve is by, with the whole at `q`.
    pub(super) fn coordinate(&self, part: usize, q: &[f64]) -> Option<f64> {
        let followed = &self.parts[part];
        Some(followed.part.value(followed.on()?.independent, q))
    }

    /// The solver of the mechanism's own equations, where another one is in use.
    pub fn own(&mut self) -> Option<&mut Driven<'s>> {
        let own = |windows: &Windows| windows.iter().all(Option::is_none);
        self.others
            .iter_mut()
            .find(|(windows, _)| own(windows))
            .map(|(_, driven)| driven)
            .filter(|_| !own(&self.now))
    }
}

/// A part and its curves.
#[derive(Clone)]
struct FollowedPart<'s> {
    part: &'s Part,
    inputs: Inputs,
    driven: Option<Driven<'s>>,
    /// By one independent coordinate or another, none beyond its dead centres.
    curves: Vec<KnownCurve>,
    /// The one that holds the point at hand.
    now: Option<usize>,
    /// Where a new one was last followed from.
    started: f64,
}

#[derive(Clone)]
struct KnownCurve {
    path: Path,
    /// Column of the part.
    independent: usize,
    /// Number of windows of the curves before.
    windows_before: usize,
}

impl<'s> FollowedPart<'s> {
    fn new(part: &'s Part) -> Self {
        let inputs = Inputs::at_time(&part.system, 0.0);
        FollowedPart {
            part,
            inputs,
            driven: None,
            curves: Vec::new(),
            now: None,
            started: f64::NEG_INFINITY,
        }
    }

    /// The curve that holds the point at hand.
    fn on(&self) -> Option<&KnownCurve> {
        Some(&self.curves[self.now?])
    }

    /// The window, counted over all curves, that `q` is in.
    fn window_at(&mut self, q: &[f64], here: &Node) -> Option<usize> {
        let holds =
            |part: &Part, curve: &KnownCurve| curve.path.holds(part.value(curve.independent, q));
        if !self
            .now
            .is_some_and(|now| holds(self.part, &self.curves[now]))
            && self.started != here.s
        {
            self.started = here.s;
            let there = self.part.values(&here.q);
            self.now = self.find(&there).or_else(|| self.follow(&there));
        }
        let curve = &self.curves[self.now?];
        let window = curve
            .path
            .window_at(self.part.value(curve.independent, q))?;
        Some(curve.windows_before + window)
    }

    /// A curve that the accepted point is on.
    fn find(&self, q: &[f64]) -> Option<usize> {
        let (mut found, mut d, mut dd) = (q.to_vec(), q.to_vec(), q.to_vec());
        self.curves.iter().position(|curve| {
            curve
                .path
                .guess(q[curve.independent], &mut found, &mut d, &mut dd)
                .is_some()
                && {
                    found.iter_mut().zip(q).for_each(|(found, q)| *found -= q);
                    self.part.system.scaled_norm(&found) < SAME
                }
        })
    }

    /// The curve through an accepted point, by the coordinate that moves most there.
    fn follow(&mut self, q: &[f64]) -> Option<usize> {
        let system = &self.part.system;
        let mut driven = match self.driven.take() {
            Some(driven) => driven,
            None => {
                Driven::with_independent(system, &[self.part.independent], q, &self.inputs).ok()?
            }
        };
        let mut motion = vec![0.0; system.n()];
        for _ in 0..EXCHANGES {
            driven.evaluation.set_position(q);
            driven.factor(&self.inputs).ok()?;
            driven.tangents(&mut motion);
            let Some((_, column)) = better_coordinate(&driven, &motion) else {
                break;
            };
            driven.choose(&[column], &self.inputs).ok()?;
        }
        let independent = driven.independent[0].column;
        let angle = system.layout.is_angle(independent);
        let (centre, reach) = (q[independent], if angle { HALF_TURN } else { system.size });
        let inputs = self.inputs.clone();
        let range = (centre - reach, centre + reach);
        let found = follow(
            &mut driven,
            (Parameter::Coordinate, inputs),
            (centre, q),
            range,
            &|_| false,
        );
        self.driven = Some(driven);
        let mut path = found.ok()?;
        if angle {
            path.close_turn(system, centre);
        }
        let windows_before = self
            .curves
            .iter()
            .map(|curve| curve.path.windows().len())
            .sum();
        self.curves.push(KnownCurve {
            path,
            independent,
            windows_before,
        });
        Some(self.curves.len() - 1)
    }

    /// Rows of the smooth branch in a window, for the blocks of the part's joints.
    fn exchange(&self, window: usize, exchanged: &mut Exchanged) {
        let Some(curve) = self
            .curves
            .iter()
            .rfind(|curve| curve.windows_before <= window)
        else {
            return;
        };
        let branch = Arc::new(curve.path.branch(window - curve.windows_before));
        let part = self.part;
        let mut others = (0..part.columns.len()).filter(|column| *column != curve.independent);
        for &(block, rows) in &part.blocks {
            let columns: Vec<usize> = others.by_ref().take(rows).collect();
            let coordinates = columns.iter().map(|&column| part.coordinates[column]);
            let independent = part.coordinates[curve.independent];
            let rows = OnBranch::new(
                (branch.clone(), columns.clone()),
                coordinates.collect(),
                independent,
            );
            exchanged.push((block, Arc::new(rows)));
        }
    }
}
