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
//! Angles are enclosed so, and places that anything asks for; the others follow them (`slots`). So C has rows of these alone
//! (`inverse`). What goes with X is worked out once per pose, but for X itself: most of it as powers of angles (`powers`).
//!
//! (Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations, 1990, ch. 5.)

mod bound;
mod changes;
mod deviations;
mod extents;
mod gaps;
mod inverse;
mod powers;
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
use inverse::{Columns, Inverse, WIDENED};
use powers::Powers;
use slots::Slots;

/// Widenings of X that are tried.
const WIDENINGS: [f64; 5] = [1.001, 1.02, 1.2, 1.6, 2.5];
/// Passes before a wider X is tried, that let each coordinate find its own width.
const PASSES: usize = 4;
/// Refinements of a wide X that holds.
const REFINEMENTS: usize = 3;
/// Widened by less than this X needs no refinement: what it leaves is of second order in it,
const NARROW: f64 = 1.01;
/// where that is no more than this part of it.
const SECOND: f64 = 0.01;

/// What encloses a mechanism at its poses, and the room for it.
pub(super) struct Enclosure {
    extents: Extents,
    slots: Slots,
    columns: Columns,
    inverse: Inverse,
    /// Of places at the ends of distances that have no slots of their own.
    ends: Inverse,
    deviations: Deviations,
    changes: Changes,
    gaps: Gaps,
    /// |φ| and its rounding at the pose (m).
    off: Vec<f64>,
    powers: Powers,
    /// Whether rows change by more than powers of angles, and what they change by within an X (m): in the mean along the way, and
    /// anywhere on it.
    has_others: bool,
    others: Vec<[f64; 2]>,
    /// By slots: X, the one that is tried, and what follows from it in the mean and anywhere.
    x: Vec<f64>,
    wide: Vec<f64>,
    next: Vec<f64>,
    most: Vec<f64>,
    /// Room (n).
    gradient: Vec<f64>,
    change: Vec<f64>,
    near: Vec<f64>,
}

/// Where the mechanism stays under all deviations: |Δq| ≤ X.
pub(super) struct Region {
    /// X (n).
    x: Vec<f64>,
    /// Bounds of places at the ends of distances, by column, where D stands in X.
    ends: Vec<(usize, f64)>,
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
        let (slots, wanted) = Slots::new(system, (plays, dimensions), &extents);
        let ends = ends.iter().filter_map(|body| system.layout.columns(*body));
        let ends = ends.flat_map(|columns| [columns.x(), columns.y()]);
        let mut ends: Vec<usize> = ends.filter(|column| slots.is_far(*column)).collect();
        ends.sort_unstable();
        ends.dedup();
        let (n, m) = (system.n(), system.m());
        let room = vec![0.0; slots.room()];
        let mut changes = Changes::new(system, &slots);
        let own = (&slots, &mut changes);
        let gaps = Gaps::new(system, (plays, dimensions), &extents, own);
        Enclosure {
            columns: Columns::new(system),
            inverse: Inverse::new(system, wanted),
            ends: Inverse::new(system, ends),
            deviations: Deviations::new(system, plays, dimensions),
            powers: Powers::new(&slots),
            has_others: changes.has_others() || gaps.has_others(),
            changes,
            gaps,
            off: vec![0.0; m],
            others: vec![[0.0; 2]; m],
            x: room.clone(),
            wide: room.clone(),
            next: room.clone(),
            most: room,
            gradient: vec![0.0; n],
            change: vec![0.0; n],
            near: vec![0.0; n],
            extents,
            slots,
        }
    }

    /// Takes a pose whose rows of C are at hand.
    fn take(&mut self, here: &Here<'_>, dimensions: &Dimensions) {
        let evaluation = here.evaluation;
        for (row, (off, phi)) in self.off.iter_mut().zip(&evaluation.phi).enumerate() {
            *off = phi.abs() + 8.0 * f64::EPSILON * here.system.row_scale(row);
        }
        self.columns.take(&evaluation.jacobian);
        self.changes.take(&here.at, &evaluation.jacobian);
        self.gaps.take(here, dimensions, &self.extents);
        self.deviations.take(here, dimensions);
        let straight = &mut self.powers.straight;
        self.deviations.straight(&self.inverse, &self.off, straight);
        self.powers.take(&self.inverse, &self.changes, &self.gaps);
    }

    /// The region that is found, if any is.
    fn contract(&mut self) -> Option<Region> {
        let straight = self.powers.straight.as_flattened();
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
            if widening > NARROW || self.bends() {
                (0..REFINEMENTS).for_each(|_| self.pass());
                self.wide.copy_from_slice(&self.x);
            }
            return Some(self.region());
        }
        None
    }

    /// Puts for X what follows from it in the mean.
    fn pass(&mut self) {
        let mut x = std::mem::take(&mut self.x);
        self.spread(&x);
        self.images([&mut x]);
        self.x = x;
    }

    /// Takes what rows change where the coordinates are off by `x`.
    fn spread(&mut self, x: &[f64]) {
        self.powers.turn(&self.slots, x);
        if self.has_others {
            self.others.fill([0.0; 2]);
            self.gaps.add_swung(x, &mut self.others);
            self.changes.add_others(x, x, &mut self.others);
        }
    }

    /// Sets images of it: in the mean, and anywhere where that is asked for.
    fn images<const K: usize>(&self, mut images: [&mut [f64]; K]) {
        self.powers.images(&mut images);
        if self.has_others {
            self.inverse.add_images(&self.others, &mut images);
        }
        for x in images.into_iter().flatten() {
            *x *= WIDENED;
        }
    }

    /// Whether no way leaves the X that is tried, nor branches within it.
    fn holds(&mut self) -> bool {
        let [mut wide, mut next, mut most] =
            [&mut self.wide, &mut self.next, &mut self.most].map(std::mem::take);
        self.spread(&wide);
        self.images([&mut next, &mut most]);
        let len = self.slots.len();
        // What C leaves is looked at where all else is well.
        let mut holds = is_inside(&next[..len], &wide[..len]);
        if holds {
            self.slots.set_far(self.off.iter().sum(), &mut wide);
            let images = &mut [&mut next[..], &mut most[..]];
            let own = (&self.slots.of[..], &wide[..]);
            self.inverse.add_residual(&mut self.columns, own, images);
            let straight = self.powers.straight.as_flattened();
            let mut ends = most.iter().zip(straight).zip(&wide);
            holds = is_inside(&next[..len], &wide[..len])
                && ends.all(|((most, straight), x)| most - straight < *x || *x == 0.0);
        }
        [self.wide, self.next, self.most] = [wide, next, most];
        holds
    }

    /// Whether more than a little of X is of second order.
    fn bends(&self) -> bool {
        let mut each = self.x.iter().zip(self.powers.straight.as_flattened());
        each.any(|(x, straight)| x - straight > SECOND * x)
    }

    /// The region X: rows change by what they do within the X that was tried.
    fn region(&mut self) -> Region {
        let mut rows = vec![0.0; self.off.len()];
        self.gaps.add_turned(&self.slots, &self.wide, &mut rows);
        self.changes
            .add_pins(&self.slots, &self.wide, &self.x, &mut rows);
        if self.has_others {
            self.others.fill([0.0; 2]);
            self.gaps.add_swung(&self.wide, &mut self.others);
            self.changes
                .add_others(&self.wide, &self.x, &mut self.others);
            let others = rows.iter_mut().zip(&self.others);
            others.for_each(|(row, [mean, _])| *row += mean);
        }
        self.slots.set_far(self.off.iter().sum(), &mut self.x);
        let ends = self.ends(&rows);
        let off = rows.iter_mut().zip(&self.off);
        off.for_each(|(row, off)| *row += off);
        let x = self.slots.of.iter().map(|&slot| self.x[slot as usize]);
        Region {
            x: x.collect(),
            ends,
            rows,
        }
    }

    /// Places at the ends of distances, from what rows change.
    fn ends(&mut self, rows: &[f64]) -> Vec<(usize, f64)> {
        if self.ends.wanted.is_empty() {
            return Vec::new();
        }
        let mut image = vec![[0.0; 4]; self.ends.fours().len()];
        self.deviations.straight(&self.ends, &self.off, &mut image);
        let mut images = [image.as_flattened_mut()];
        self.ends.add_images(rows.as_chunks::<1>().0, &mut images);
        let own = (&self.slots.of[..], &self.x[..]);
        self.ends.add_residual(&mut self.columns, own, &mut images);
        let places = self.ends.wanted.iter().zip(image.as_flattened());
        places.map(|(column, x)| (*column, x * WIDENED)).collect()
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
        for Inverse { wanted, rows, .. } in [&mut enclosure.inverse, &mut enclosure.ends] {
            if !wanted.is_empty() {
                driven.inverse_rows(wanted, rows);
            }
        }
        let here = Here {
            system: driven.system,
            evaluation: &driven.evaluation,
            at: driven.evaluation.kinematics(&stand.inputs),
            shifts,
            time: stand.inputs.time,
            held: stand.held,
        };
        enclosure.take(&here, self.dimensions);
        enclosure.contract()
    }
}

/// Whether a bound lies within another one.
fn is_inside(inner: &[f64], outer: &[f64]) -> bool {
    inner
        .iter()
        .zip(outer)
        .all(|(inner, outer)| inner < outer || (*inner == 0.0 && *outer == 0.0))
}
