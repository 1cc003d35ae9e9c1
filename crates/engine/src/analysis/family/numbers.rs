//! The numbers of a mechanism as its file's numbers give them, without compiling it anew.
//!
//! Of plain linkages they are those of the file, and their sums and differences (a point from the centre of mass). That is not
//! believed but tried: each number of the file is moved, and what follows is compared with what the compiler makes of it.

use crate::system::System;

/// Part by which a number is moved, and of the mechanism's size where it is zero.
const STEP: f64 = 1.0 / 1024.0;
/// A factor is whole up to this.
const WHOLE: f64 = 1e-9;
/// Round-off of sums, by the size of what is added.
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

/// A family's numbers.
pub struct Numbers {
    /// Those of the nominal mechanism, in the order of [`System::renumber`].
    nominal: Vec<f64>,
    /// Those of its file.
    leaves: Vec<f64>,
    moves: Vec<Move>,
}

/// A number that follows one of the file.
struct Move {
    place: u32,
    leaf: u32,
    factor: f64,
}

/// All numbers of a system.
fn all(mut system: System) -> Vec<f64> {
    let mut numbers = Vec::new();
    system.renumber(&mut |number| {
        numbers.push(number);
        number
    });
    numbers
}

impl Numbers {
    /// Of a mechanism and the numbers of its file, from which `compile` makes others; `None` where only that knows what follows.
    pub fn new(
        nominal: &System,
        leaves: Vec<f64>,
        mut compile: impl FnMut(&[f64]) -> Option<System>,
    ) -> Option<Self> {
        let mut compiled = |leaves: &[f64]| Some(all(compile(leaves)?));
        let mut moved = leaves.clone();
        let mut numbers = Numbers {
            nominal: all(nominal.clone()),
            leaves,
            moves: Vec::new(),
        };
        for leaf in 0..moved.len() {
            let own = moved[leaf];
            let step = STEP * if own == 0.0 { nominal.size } else { own };
            moved[leaf] = own + step;
            let found = compiled(&moved)?;
            moved[leaf] = own;
            let pairs = found.iter().zip(&numbers.nominal).enumerate();
            for (place, (found, nominal)) in pairs.filter(|(_, (found, nominal))| found != nominal)
            {
                let factor = (found - nominal) / step;
                if (factor - factor.round()).abs() > WHOLE {
                    return None;
                }
                numbers.moves.push(Move {
                    place: place as u32,
                    leaf: leaf as u32,
                    factor: factor.round(),
                });
            }
        }
        let largest = linkdyn_linear::math::max_abs(&numbers.leaves);
        let mut is_met = |sign: f64| {
            // each by another part, so that an exchange would be seen
            let part = |k: usize| 1.0 + sign * STEP * (1.0 + k as f64 / 16.0);
            let leaves = numbers.leaves.iter().enumerate();
            let leaves: Vec<f64> = leaves.map(|(k, own)| own * part(k)).collect();
            let mut expected = Vec::new();
            numbers.write(&leaves, &mut expected);
            compiled(&leaves).is_some_and(|found| {
                let mut pairs = found.iter().zip(&expected);
                pairs.all(|(found, expected)| {
                    (found - expected).abs() <= ROUND_OFF * found.abs().max(largest)
                })
            })
        };
        (is_met(1.0) && is_met(-1.3)).then_some(numbers)
    }

    /// The numbers that follow from those of the file.
    pub fn write(&self, leaves: &[f64], numbers: &mut Vec<f64>) {
        numbers.clone_from(&self.nominal);
        for Move {
            place,
            leaf,
            factor,
        } in &self.moves
        {
            let leaf = *leaf as usize;
            numbers[*place as usize] += factor * (leaves[leaf] - self.leaves[leaf]);
        }
    }
}
