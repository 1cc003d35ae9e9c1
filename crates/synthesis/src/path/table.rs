//! Coupler curves, each once.

use super::unknowns::Unknowns;
use std::collections::BTreeMap;

/// What cognates have in common: the sum of their pivots and of the products of two.
fn key(one: &Unknowns) -> [i64; 4] {
    let [x, _, a, _, y, _, b, _] = *one;
    let c = a + (b - a) * x / (x - y);
    let (sum, products) = (a + b + c, a * b + b * c + c * a);
    [sum.re, sum.im, products.re, products.im].map(|v| {
        let scale = 1.0 + sum.norm() + products.norm();
        (v / scale * 1e6).round() as i64
    })
}

/// A table of curves that finds one of them again, whatever way its key is rounded.
#[derive(Default)]
pub struct Table {
    all: BTreeMap<[i64; 4], Unknowns>,
}

impl Table {
    /// Adds one; whether it was not there.
    pub fn add(&mut self, one: Unknowns) -> bool {
        let key = key(&one);
        let mut near = self.all.range(
            [key[0] - 2, i64::MIN, i64::MIN, i64::MIN]..=[key[0] + 2, i64::MAX, i64::MAX, i64::MAX],
        );
        let is_known = near.any(|(own, _)| own.iter().zip(&key).all(|(a, b)| (a - b).abs() <= 2));
        !is_known && self.all.insert(key, one).is_none()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// All of them.
    pub fn all(&self) -> Vec<Unknowns> {
        self.all.values().copied().collect()
    }
}
