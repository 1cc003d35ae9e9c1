//! Contacts before runs at different tolerances part: there the answer converges as that of a differential equation without impacts.
//!
//! Contacts are matched hinge by hinge in their order. Two runs part at the first contact that begins more than [`SAME_BEGIN`]
//! apart, or that only one of them has. Before that, begins converge when the mean of their differences falls at least
//! [`FALLS`] times where the tolerance falls ten times.

use super::super::models::{JOINTS, Stroke};

/// Contacts that begin this close together are the same \[s\].
pub const SAME_BEGIN: f64 = 1e-6;
/// Bounds of the differences of begins for which contacts are counted \[s\].
pub const BOUNDS: [f64; 4] = [1e-9, 1e-8, 1e-7, SAME_BEGIN];
/// Least factor between mean differences [–]: 10 for an error in proportion to rtol, half of that in powers of ten.
pub const FALLS: f64 = 3.0;

/// Contacts of runs at neighbouring tolerances, while none has parted from the next.
#[derive(Debug, Clone, PartialEq)]
pub struct Early {
    /// When the first of the pairs part \[s\].
    pub until: f64,
    /// Pair by pair, contacts before the first that begins farther apart than each of [`BOUNDS`], or that only one of both has.
    pub together: Vec<[usize; 4]>,
    /// Contacts before.
    pub contacts: usize,
    /// Mean and largest difference of begins, pair by pair \[s\].
    pub differences: Vec<[f64; 2]>,
}

impl Early {
    /// Of runs in the order of their tolerances.
    pub fn of(strokes: &[Stroke]) -> Self {
        let begins: Vec<_> = strokes.iter().map(begins).collect();
        let pairs = || begins.windows(2).map(|pair| (&pair[0], &pair[1]));
        let together = pairs()
            .map(|(a, b)| BOUNDS.map(|bound| early(a, b, parted(a, b, bound)).len()))
            .collect();
        let until = pairs()
            .map(|(a, b)| parted(a, b, SAME_BEGIN))
            .fold(f64::INFINITY, f64::min);
        let (mut contacts, mut differences) = (usize::MAX, Vec::new());
        for all in pairs().map(|(a, b)| early(a, b, until)) {
            contacts = contacts.min(all.len());
            let largest = all.iter().copied().fold(0.0, f64::max);
            differences.push([all.iter().sum::<f64>() / all.len().max(1) as f64, largest]);
        }
        Early {
            until,
            together,
            contacts: if differences.is_empty() { 0 } else { contacts },
            differences,
        }
    }

    /// Least factor by which the mean difference falls from pair to pair.
    pub fn falls(&self) -> f64 {
        self.differences
            .windows(2)
            .map(|two| two[0][0] / two[1][0])
            .fold(f64::INFINITY, f64::min)
    }

    /// Whether they converge.
    pub fn converges(&self) -> bool {
        self.contacts > 0 && self.falls() >= FALLS
    }
}

/// When contacts begin, hinge by hinge \[s\].
fn begins(stroke: &Stroke) -> [Vec<f64>; 7] {
    JOINTS.map(|joint| {
        let contacts = stroke
            .report
            .events
            .iter()
            .filter(|event| event.kind == linkdyn_output::EventKind::Contact);
        contacts
            .filter(|event| event.joint.as_deref() == Some(joint))
            .map(|event| event.time)
            .collect()
    })
}

/// The first begin of a contact that only one of both has, when those within `bound` are the same \[s\].
fn parted(a: &[Vec<f64>; 7], b: &[Vec<f64>; 7], bound: f64) -> f64 {
    let of = |(a, b): (&Vec<f64>, &Vec<f64>)| {
        let same = a
            .iter()
            .zip(b)
            .take_while(|(a, b)| (*a - *b).abs() <= bound)
            .count();
        let next = [a, b].map(|begins| begins.get(same).copied().unwrap_or(f64::INFINITY));
        next[0].min(next[1])
    };
    a.iter().zip(b).map(of).fold(f64::INFINITY, f64::min)
}

/// Differences of the begins before `until`.
fn early(a: &[Vec<f64>; 7], b: &[Vec<f64>; 7], until: f64) -> Vec<f64> {
    let pairs = a.iter().zip(b).flat_map(|(a, b)| a.iter().zip(b));
    pairs
        .filter(|(a, b)| a.max(**b) < until)
        .map(|(a, b)| (a - b).abs())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first_hinge(begins: &[f64]) -> [Vec<f64>; 7] {
        let mut all: [Vec<f64>; 7] = Default::default();
        all[0] = begins.to_vec();
        all
    }

    #[test]
    fn runs_part_where_one_has_a_contact_alone() {
        let a = first_hinge(&[0.1, 0.2, 0.3]);
        let parted = |a, b: &[Vec<f64>; 7]| parted(a, b, SAME_BEGIN);
        assert_eq!(
            parted(&a, &first_hinge(&[0.1, 0.2 + 5e-7, 0.3])),
            f64::INFINITY
        );
        assert_eq!(parted(&a, &first_hinge(&[0.1, 0.21, 0.3])), 0.2);
        assert_eq!(parted(&a, &first_hinge(&[0.1, 0.15, 0.2, 0.3])), 0.15);
        assert_eq!(parted(&a, &first_hinge(&[0.1, 0.2])), 0.3);
        assert_eq!(early(&a, &first_hinge(&[0.1, 0.25, 0.3]), 0.25), [0.0]);
    }

    #[test]
    fn begins_converge_by_their_means() {
        let early = |means: [f64; 2]| Early {
            until: 1.0,
            together: vec![[5; 4]; 2],
            contacts: 5,
            differences: means.map(|mean| [mean, mean]).to_vec(),
        };
        assert!(early([1e-7, 1e-8]).converges());
        assert!(!early([1e-7, 5e-8]).converges());
        assert!(
            !Early {
                contacts: 0,
                ..early([1e-7, 1e-8])
            }
            .converges()
        );
    }
}
