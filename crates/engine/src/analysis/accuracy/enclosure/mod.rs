//! A bound that no deviation exceeds: an interval Newton step about the nominal position.
//!
//! With J̄ the mean of J along the way from the nominal position by Δq, any matrix C near J⁻¹ and any λ near J⁻ᵀ∂yᵀ:
//!
//! ```text
//! Δq = −C (φ₀ + e) + (I − C J̄) Δq
//! Δy = −λᵀ(φ₀ + e) + (∂ȳ − λᵀ J̄) Δq
//! X  ≥ |C e| + (|I − C J₀| + |C| |J̄ − J₀|) X      then no |Δq| that goes out from 0 exceeds X
//! |Δy + λᵀ e| ≤ |λ||φ₀| + (|∂y₀ − λᵀJ₀| + |∂ȳ − ∂y₀| + |λ| |J̄ − J₀|) X
//! ```
//!
//! |J̄ − J₀| is bounded entry by entry: an entry that turns with an angle changes by its derivative times the angle, and in
//! the mean along the way by half of that. The matrix J is regular for all |Δq| ≤ X where the same bound without the mean
//! contracts; so the way from the nominal position never branches within X. Sums are widened by their rounding.
//!
//! Angles are enclosed so, and the places that anything asks for; the others follow them (`slots`).
//! (Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations, 1990, ch. 5.)

mod bound;
mod changes;
mod deviations;
mod extents;
mod gaps;
mod inverse;
mod slots;

use super::dimensions::{Dimensions, Here};
use super::displaced::{Mechanism, Stand};
use super::source::Play;
use crate::element::BodyId;
use crate::system::System;
use changes::Changes;
use deviations::Deviations;
use extents::Extents;
use gaps::Gaps;
use inverse::{Four, Inverse};
use slots::Slots;

/// Widenings of X that are tried.
const WIDENINGS: [f64; 5] = [1.001, 1.02, 1.2, 1.6, 2.5];
/// Passes before a wider X is tried, that let each coordinate find its own width.
const PASSES: usize = 4;
/// Refinements of a wide X that holds.
const REFINEMENTS: usize = 3;
/// Widened by less than this X needs no refinement: what it leaves is of second order in it.
const NARROW: f64 = 1.01;

/// What encloses a mechanism at its poses, and the room for it.
pub(super) struct Enclosure {
    extents: Extents,
    slots: Slots,
    inverse: Inverse,
    deviations: Deviations,
    changes: Changes,
    gaps: Gaps,
    /// |φ| and its rounding at the pose (m).
    off: Vec<f64>,
    /// |C e| to first order.
    straight: Vec<Four>,
    /// What rows are off and change within an X (m): in the mean along the way, and anywhere on it.
    rows: Vec<[f64; 2]>,
    /// By slots: X, the one that is tried, and what follows from it in the mean and anywhere.
    x: Vec<f64>,
    wide: Vec<f64>,
    next: Vec<f64>,
    most: Vec<f64>,
    /// Room (n).
    gradient: Vec<f64>,
    change: Vec<f64>,
}

/// Where the mechanism stays under all deviations: |Δq| ≤ X.
pub(super) struct Region {
    /// X (n).
    x: Vec<f64>,
    /// Bounds (m) of what φ, gaps and J Δq are off at the pose, and change on the way.
    rows: Vec<f64>,
}

impl Enclosure {
    /// Of a mechanism whose steps leave out `slack` (dimensions), with bodies at the `ends` of distances that are asked for.
    pub fn new(
        system: &System,
        (plays, dimensions): (&[Play], &Dimensions),
        slack: Option<&[f64]>,
        ends: &[BodyId],
    ) -> Enclosure {
        let unknown = vec![0.0; dimensions.all.len()];
        let extents = Extents::new(plays, dimensions, slack.unwrap_or(&unknown));
        let slots = Slots::new(system, (plays, dimensions), &extents, ends);
        let (n, m) = (system.n(), system.m());
        let room = vec![0.0; slots.room()];
        Enclosure {
            inverse: Inverse::new(system, &slots),
            deviations: Deviations::new(system, plays, dimensions),
            changes: Changes::new(system, &slots),
            gaps: Gaps::new(system, (plays, dimensions), &extents, &slots),
            off: vec![0.0; m],
            straight: vec![[0.0; 4]; slots.len() / 4],
            rows: vec![[0.0; 2]; m],
            x: room.clone(),
            wide: room.clone(),
            next: room.clone(),
            most: room,
            gradient: vec![0.0; n],
            change: vec![0.0; n],
            extents,
            slots,
        }
    }

    /// Takes a pose whose rows of C are at hand.
    fn take(&mut self, here: Here<'_>, dimensions: &Dimensions) {
        let evaluation = here.evaluation;
        for (row, (off, phi)) in self.off.iter_mut().zip(&evaluation.phi).enumerate() {
            *off = phi.abs() + 8.0 * f64::EPSILON * here.system.row_scale(row);
        }
        self.inverse.take(&evaluation.jacobian);
        self.changes.take(&here.at, &evaluation.jacobian);
        self.gaps.take(here, dimensions, &self.extents);
        self.deviations.take(here, dimensions);
        self.deviations
            .straight(&self.inverse, &self.off, &mut self.straight);
    }

    /// Whether an X is found; and what rows change within it, times it.
    fn contract(&mut self) -> bool {
        let straight = self.straight.as_flattened();
        self.x[..straight.len()].copy_from_slice(straight);
        for (attempt, widening) in WIDENINGS.into_iter().enumerate() {
            for _ in 0..if attempt == 0 { 1 } else { PASSES } {
                self.pass();
            }
            for (wide, x) in self.wide.iter_mut().zip(&self.x) {
                *wide = x * widening;
            }
            if !self.holds() {
                continue;
            }
            std::mem::swap(&mut self.x, &mut self.next);
            let is_narrow = widening < NARROW;
            if !is_narrow {
                (0..REFINEMENTS).for_each(|_| self.pass());
            }
            self.slots.set_far(self.off.iter().sum(), &mut self.x);
            let by = if is_narrow { &self.wide } else { &self.x };
            self.gaps.put(&self.slots, by, &mut self.rows);
            self.changes.add_to(by, &self.x, &mut self.rows);
            return true;
        }
        false
    }

    /// Puts for X what follows from it in the mean.
    fn pass(&mut self) {
        self.gaps.put(&self.slots, &self.x, &mut self.rows);
        self.changes.add_to(&self.x, &self.x, &mut self.rows);
        self.inverse
            .images(&self.straight, &self.rows, [&mut self.x]);
    }

    /// Whether no way leaves the X that is tried, nor branches within it.
    fn holds(&mut self) -> bool {
        let wide = &mut self.wide;
        self.gaps.put(&self.slots, wide, &mut self.rows);
        self.changes.add_to(wide, wide, &mut self.rows);
        let images = [&mut self.next[..], &mut self.most[..]];
        self.inverse.images(&self.straight, &self.rows, images);
        let len = self.slots.len();
        // What C leaves is looked at where all else is well.
        if !is_inside(&self.next[..len], &wide[..len]) {
            return false;
        }
        self.slots.set_far(self.off.iter().sum(), wide);
        let images = [&mut self.next[..], &mut self.most[..]];
        self.inverse.add_residual(&self.slots, wide, images);
        let straight = self.straight.as_flattened();
        let mut ends = self.most.iter().zip(straight).zip(&*wide);
        is_inside(&self.next[..len], &wide[..len])
            && ends.all(|((most, straight), x)| most - straight < *x || *x == 0.0)
    }
}

impl Mechanism<'_> {
    /// Where the mechanism stays, or would stay with what is known of how far dimensions are off, about a pose that was taken, and
    /// whose factors are at hand; none where no bound contracts.
    pub fn region(&mut self, stand: &Stand) -> Option<Region> {
        let Mechanism {
            driven,
            enclosure,
            shifts,
            ..
        } = self;
        if enclosure.changes.are_unbounded {
            return None;
        }
        driven.inverse_rows(&enclosure.slots.wanted, &mut enclosure.inverse.rows);
        let here = Here {
            system: driven.system,
            evaluation: &driven.evaluation,
            at: driven.evaluation.kinematics(&stand.inputs),
            shifts,
            time: stand.inputs.time,
            held: stand.held,
        };
        enclosure.take(here, self.dimensions);
        enclosure.contract().then(|| enclosure.region())
    }
}

/// Whether a bound lies within another one.
fn is_inside(inner: &[f64], outer: &[f64]) -> bool {
    inner
        .iter()
        .zip(outer)
        .all(|(inner, outer)| inner < outer || (*inner == 0.0 && *outer == 0.0))
}
