//! All assemblies of a mechanism at one instant.
//!
//! ```text
//! groups       in which order bodies can be placed: Assur groups
//! polynomial   all places of a group where those before it are known
//! circuits     which assemblies are connected by motion
//! ```
//!
//! Each place of a group is gone on from, so that assemblies are the leaves of a tree. Newton's iteration with all rows, redundant ones
//! included, brings a leaf to round-off, or shows that it is none. What is polynomial in no group (cams, racks, belts) is searched for
//! from many starts instead, and then nobody knows whether all were found.

pub mod circuits;
mod groups;
mod polynomial;

use super::closing::{Closed, close_certified};
use crate::element::{Axis, BodyId};
use crate::system::{Block, Inputs, System};
use groups::Groups;
pub use groups::KnownPosition;
use linkdyn_linear::bilinear::Number;
use polynomial::{BodyPlace, placed};
use std::f64::consts::TAU;

/// Distance, in rad or mechanism sizes, that Newton's iteration may lead from a root to its assembly.
const NEAR: f64 = 1e-3;
/// Distance below which two assemblies are the same.
const SAME: f64 = 1e-8;
/// Starts for each body where there are no polynomials, and the most of them.
const STARTS: usize = 200;
const MOST_STARTS: usize = 4_000;

/// A position that closes.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembly {
    /// Its coordinates (n).
    pub q: Vec<f64>,
    /// Whether the theorem of Newton and Kantorovich proves that there is an assembly at this place, and one only.
    pub is_proven: bool,
}

/// A group of bodies that are placed together.
#[derive(Debug, Clone, PartialEq)]
pub struct AssurGroup {
    /// Its bodies.
    pub bodies: Vec<BodyId>,
    /// Its independent loops; `None` where its rows are no polynomials.
    pub loops: Option<usize>,
    /// The largest number of isolated places in complex numbers that it had, and that of the paths that were followed to find them.
    pub complex: usize,
    /// Paths.
    pub paths: usize,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Assemblies {
    /// In the order of the groups' places.
    pub found: Vec<Assembly>,
    /// In the order in which they are placed.
    pub groups: Vec<AssurGroup>,
    /// Coordinates that nothing determines, and that stayed.
    pub held: Vec<(BodyId, Axis)>,
    /// Whether all isolated assemblies were found.
    pub is_complete: bool,
    /// Whether there was a multiple root or a curve of them.
    pub is_singular: bool,
    /// Whether there are more than were asked for.
    pub is_cut: bool,
    /// Whether places were searched for from many starts.
    pub is_searched: bool,
    /// Whether the search was given up.
    pub is_stopped: bool,
}

/// All assemblies by `blocks` at `inputs`, at most so many; `stop` is asked whether to give up.
pub fn assemblies(
    system: &System,
    blocks: &[&Block],
    inputs: &Inputs,
    known: &KnownPosition,
    most: usize,
    stop: &dyn Fn() -> bool,
) -> Assemblies {
    let groups = Groups::new(system, blocks, &inputs.drive, known);
    let found = groups.groups.iter().map(|group| AssurGroup {
        bodies: group.bodies.clone(),
        loops: None,
        complex: 0,
        paths: 0,
    });
    let mut tree = Tree {
        system,
        blocks,
        inputs,
        held: known.q,
        most,
        stop,
        known: vec![None; system.layout.bodies().len() + 1],
        expected: vec![None; groups.groups.len()],
        is_unsolved: false,
        found: Assemblies {
            found: Vec::new(),
            groups: found.collect(),
            held: groups.free.clone(),
            is_complete: true,
            is_singular: false,
            is_cut: false,
            is_stopped: false,
            is_searched: false,
        },
    };
    tree.descend(&groups, 0);
    if tree.is_unsolved {
        tree.search(&groups);
    }
    let mut found = tree.found;
    found.is_complete &= !found.is_cut && !found.is_stopped;
    found
}

/// Whether two positions are the same assembly.
pub fn same(system: &System, a: &[f64], b: &[f64]) -> bool {
    apart(system, a, b) <= SAME
}

/// The largest difference of two positions, in rad or mechanism sizes; whole turns are none.
fn apart(system: &System, a: &[f64], b: &[f64]) -> f64 {
    let differences = a.iter().zip(b).enumerate().map(|(column, (a, b))| {
        let off = a - b;
        match system.layout.is_angle(column) {
            true => (off - TAU * (off / TAU).round()).abs(),
            false => (off / system.column_scale(column)).abs(),
        }
    });
    differences.fold(0.0, f64::max)
}

/// The way through the places of all groups.
struct Tree<'a> {
    system: &'a System,
    blocks: &'a [&'a Block],
    inputs: &'a Inputs,
    held: &'a [f64],
    most: usize,
    stop: &'a dyn Fn() -> bool,
    known: Vec<Option<BodyPlace>>,
    /// By group the number of isolated places that random dimensions have, once it was asked for.
    expected: Vec<Option<Option<usize>>>,
    is_unsolved: bool,
    found: Assemblies,
}

impl Tree<'_> {
    fn descend(&mut self, groups: &Groups, level: usize) {
        self.found.is_stopped = self.found.is_stopped || (self.stop)();
        if self.found.is_cut || self.found.is_stopped || self.is_unsolved {
            return;
        }
        let Some(group) = groups.groups.get(level) else {
            let q = self.position();
            self.take(groups, &q);
            return;
        };
        let (system, held) = (self.system, self.held);
        let near = |body: BodyId| {
            system
                .layout
                .column(body, Axis::Theta)
                .map_or(0.0, |at| held[at])
        };
        let expected = &mut self.expected[level];
        let answer = placed(
            group,
            &groups.rows,
            &self.known,
            system.size,
            &near,
            expected,
        );
        let Some(answer) = answer else {
            self.is_unsolved = true;
            return;
        };
        let own = &mut self.found.groups[level];
        own.loops = Some(answer.loops);
        own.complex = own.complex.max(answer.complex);
        own.paths = own.paths.max(answer.paths);
        self.found.is_complete &= answer.is_complete;
        self.found.is_singular |= answer.is_singular;
        for places in answer.places {
            for (body, place) in group.bodies.iter().zip(places) {
                self.known[body.0] = Some(place);
            }
            self.descend(groups, level + 1);
        }
        for body in &group.bodies {
            self.known[body.0] = None;
        }
    }

    /// The coordinates of what is known.
    fn position(&self) -> Vec<f64> {
        let mut q = vec![0.0; self.system.n()];
        for (columns, place) in self.system.layout.bodies().zip(&self.known[1..]) {
            if let Some(BodyPlace { r, theta }) = place {
                let r: Number = r * self.system.size;
                columns.write(&mut q, [r.re, r.im, *theta]);
            }
        }
        q
    }

    /// Takes the assembly at q, if there is one and it is new; how far it is from there.
    fn take(&mut self, groups: &Groups, q: &[f64]) -> Option<f64> {
        let closed: Closed = close_certified(self.system, self.blocks, q, self.inputs);
        if !closed.converged {
            return None;
        }
        let moved = apart(self.system, &closed.q, q);
        let is_held = groups.free.iter().all(|(body, axis)| {
            let column = self.system.layout.column(*body, *axis);
            column.is_none_or(|at| {
                (closed.q[at] - self.held[at]).abs() <= NEAR * self.system.column_scale(at)
            })
        });
        if !is_held {
            return None;
        }
        if moved <= NEAR || self.is_unsolved {
            let is_new = |known: &Assembly| apart(self.system, &known.q, &closed.q) > SAME;
            if self.found.found.iter().all(is_new) {
                if self.found.found.len() == self.most {
                    self.found.is_cut = true;
                } else {
                    self.found.found.push(Assembly {
                        q: closed.q,
                        is_proven: closed.proven,
                    });
                }
            }
        }
        Some(moved)
    }

    /// Newton's iteration from many places.
    fn search(&mut self, groups: &Groups) {
        self.found.found.clear();
        self.found.is_complete = false;
        self.found.is_searched = true;
        let bodies = self.system.layout.bodies().len();
        let mut next: u64 = 1;
        let mut random = move || {
            // Multiples of the golden ratio fill an interval evenly (Weyl).
            next = next
                .wrapping_add(0x9e37_79b9_7f4a_7c15)
                .rotate_left(17)
                .wrapping_mul(0xbf58_476d_1ce4_e5b9);
            (next >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let held = self.held.to_vec();
        self.take(groups, &held);
        for _ in 0..(STARTS * bodies).min(MOST_STARTS) {
            let mut q = held.clone();
            for columns in self.system.layout.bodies() {
                let [x, y, theta] = columns.read(&q);
                let off = self.system.size;
                columns.write(
                    &mut q,
                    [
                        x + off * random(),
                        y + off * random(),
                        theta + TAU * random(),
                    ],
                );
            }
            for (body, axis) in &groups.free {
                if let Some(column) = self.system.layout.column(*body, *axis) {
                    q[column] = held[column];
                }
            }
            self.take(groups, &q);
            self.found.is_stopped = (self.stop)();
            if self.found.is_cut || self.found.is_stopped {
                break;
            }
        }
    }
}
