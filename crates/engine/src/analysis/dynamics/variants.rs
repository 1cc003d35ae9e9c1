//! Systems of one model that differ in what some of its joints are.

use crate::element::Constraint;
use crate::mechanism::parts::Rewrite;
use crate::system::System;
use crate::system::compile::{Lowering, recompile};
use linkdyn_model::Model;
use typed_arena::Arena;

/// The systems of a model that differ in the rigid journals that follow their bearings, and in parts that follow their
/// smooth branches.
pub struct Variants<'m> {
    pub model: &'m Model,
    systems: Arena<System>,
}

impl<'m> Variants<'m> {
    pub fn new(model: &'m Model) -> Self {
        Variants {
            model,
            systems: Arena::new(),
        }
    }

    /// The system in which the contacts of `following` are constraints, and with other constraints in the place of those of
    /// some blocks; none where the model can't be compiled, which it has been before.
    pub fn get(
        &self,
        following: &[bool],
        exchanged: Vec<(usize, Box<dyn Constraint>)>,
    ) -> Option<&System> {
        let mut system = recompile(self.model, Lowering::Open { following }).ok()?;
        if !exchanged.is_empty() {
            system.exchange(exchanged);
        }
        Some(self.systems.alloc(system))
    }

    /// The system of a model that is a part of this one.
    pub fn part(&self, model: &Model) -> Option<&System> {
        Some(self.systems.alloc(recompile(model, Lowering::Closed).ok()?))
    }

    /// Exchanges constraints where the contacts of `following` are constraints.
    pub fn rewrite<'s>(&'s self, following: &[bool]) -> Box<dyn Rewrite<'s> + 's> {
        Box::new(Following {
            variants: self,
            following: following.to_vec(),
        })
    }
}

struct Following<'s, 'm> {
    variants: &'s Variants<'m>,
    following: Vec<bool>,
}

impl<'s> Rewrite<'s> for Following<'s, '_> {
    fn rewritten(&self, constraints: Vec<(usize, Box<dyn Constraint>)>) -> Option<&'s System> {
        self.variants.get(&self.following, constraints)
    }
}
