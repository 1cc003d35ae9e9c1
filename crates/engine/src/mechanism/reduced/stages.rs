//! The stages of an implicit method's step.
//!
//! A stage is a point as any other, whose position begins at that of the iteration before. Where no constraint bends with what
//! moves, as on guides that do not turn, nothing is factored at a stage (`straight`).
//!
//! Corrections of q, v and a by the factors of the accepted point, which are off by some h ω, were tried for all mechanisms, one for
//! each of Newton's iterations: they save a quarter of the time, but what they leave is not seen by the iteration, and at orders 9 and
//! 13 errors were a hundred times as large.

use super::inertia::Inertia;
use super::saddle::{By, Saddle};
use super::sequence::Sequence;
use super::sparse::Sparse;
use super::straight::ConstantMatrices;
use crate::mechanism::driven::Driven;
use crate::system::System;

/// Most stages of a method.
const STAGES: usize = 7;

/// A stage's position (n).
#[derive(Debug, Clone)]
pub(super) struct Stage {
    pub time: f64,
    pub q: Vec<f64>,
}

/// What an implicit method needs of a mechanism.
#[derive(Clone)]
pub(super) struct Stages {
    pub matrices: Option<Matrices>,
    pub stages: Vec<Stage>,
    /// Multipliers at the accepted point (m).
    pub lambda: Vec<f64>,
}

/// The matrices of a choice of rows and independent coordinates.
#[derive(Clone)]
pub(super) struct Matrices {
    /// Which choice they are of.
    pub revision: u64,
    pub saddle: Saddle,
    /// Where no constraint bends.
    pub straight: Option<ConstantMatrices>,
}

impl Matrices {
    /// Of a mechanism with J at a position that satisfies its constraints.
    pub fn of(driven: &Driven) -> Self {
        let standing = driven.standing();
        Matrices {
            revision: driven.revision(),
            saddle: Saddle::of(driven, &standing),
            straight: ConstantMatrices::of(driven, &standing),
        }
    }

    /// The saddle point systems, and how coordinates follow the independent ones, where it is known.
    pub fn parts<'a>(
        &'a mut self,
        driven: &Driven,
        (inertia, sequence): (&'a mut Inertia, Option<&'a Sequence>),
    ) -> Option<(&'a mut Saddle, By<'a>)> {
        let sequence = sequence.filter(|own| own.is_of(driven));
        let by = match (&mut self.straight, sequence, inertia) {
            (Some(straight), ..) => By::Straight(straight),
            (None, Some(sequence), _) => By::Sequence(sequence),
            (None, None, Inertia::Sparse(sparse)) => By::Factors(sparse.kept(driven)?),
            (None, None, Inertia::Tangents(_)) => return None,
        };
        Some((&mut self.saddle, by))
    }
}

impl Stages {
    pub fn of(system: &System) -> Self {
        let (n, m) = (system.n(), system.m());
        let stage = Stage {
            time: f64::NAN,
            q: vec![0.0; n],
        };
        Stages {
            matrices: None,
            stages: vec![stage; STAGES],
            lambda: vec![0.0; m],
        }
    }

    /// Keeps what belongs to the accepted point at hand.
    pub fn keep(&mut self, sparse: &Sparse) {
        self.lambda.copy_from_slice(sparse.multipliers());
        self.stages.iter_mut().for_each(|s| s.time = f64::NAN);
    }

    /// The position of the last step's stage at this time, where there is one.
    pub fn position_at(&self, time: f64) -> Option<&[f64]> {
        let stage = self.stages.iter().find(|stage| stage.time == time)?;
        Some(&stage.q)
    }
}
