//! What angles do by themselves, as powers of each.
//!
//! Rows that turn with one angle alone change by a multiple of it (gaps), of its square and of its cube (pins: slope and size of the
//! entries ∓ρ⊥, see `changes`). With |C| before them these are worked out once per pose:
//!
//! ```text
//! |C| rows = still + G greatest + Σ (L θ + S θ² + T θ³)         S/2 and T/6 in the mean along the way, S and T/2 anywhere
//! ```

use super::changes::Changes;
use super::gaps::Gaps;
use super::inverse::{Four, Inverse};
use super::slots::Slots;

/// |C| times what goes with the powers of angles.
pub(super) struct Powers {
    /// Number of angles.
    angles: usize,
    /// Of four coordinates L, S and T of each angle, then of the next four.
    by: Vec<[Four; 3]>,
    /// G of each four coordinates.
    greatest: Vec<Four>,
    /// |C e| to first order, and behind it what is left out of steps besides.
    pub straight: Vec<Four>,
    pub still: Vec<Four>,
    /// Factors of L, S and T for each angle, in the mean and anywhere.
    factors: Vec<[[f64; 3]; 2]>,
    /// The greatest angle.
    angle: f64,
}

impl Powers {
    /// With room for these coordinates.
    pub fn new(slots: &Slots) -> Powers {
        let (fours, angles) = (slots.len() / 4, slots.angles().len());
        Powers {
            angles,
            by: vec![[[0.0; 4]; 3]; fours * angles],
            greatest: vec![[0.0; 4]; fours],
            straight: vec![[0.0; 4]; fours],
            still: vec![[0.0; 4]; fours],
            factors: vec![[[0.0; 3]; 2]; angles],
            angle: 0.0,
        }
    }

    /// Takes what was taken of a pose.
    pub fn take(&mut self, inverse: &Inverse, changes: &Changes, gaps: &Gaps) {
        self.by.fill([[0.0; 4]; 3]);
        let by = self.by.chunks_exact_mut(self.angles.max(1));
        let ends = self.greatest.iter_mut().zip(&mut self.still);
        for (((c, by), (greatest, still)), straight) in
            inverse.fours().zip(by).zip(ends).zip(&self.straight)
        {
            for pin in &changes.pins {
                let (row, [x, y], [first, second]) = (pin.row as usize, pin.arm, pin.gaps);
                let (a, b) = (&c[row], &c[row + 1]);
                let [linear, slope, size] = &mut by[pin.angle as usize];
                *linear = with(with(*linear, a, first), b, second);
                *slope = with(with(*slope, a, x), b, y);
                *size = with(with(*size, a, y), b, x);
            }
            for &(row, angle, factor) in &gaps.angles {
                let [linear, ..] = &mut by[angle as usize];
                *linear = with(*linear, &c[row as usize], factor);
            }
            let own = gaps.greatest.iter();
            *greatest = own.fold([0.0; 4], |sum, &(row, by)| with(sum, &c[row as usize], by));
            let slack = c.iter().zip(&gaps.slack);
            *still = slack.fold(*straight, |sum, (c, slack)| with(sum, c, *slack));
        }
    }

    /// Takes the angles of an X.
    pub fn turn(&mut self, slots: &Slots, x: &[f64]) {
        self.angle = 0.0;
        for (factors, slot) in self.factors.iter_mut().zip(slots.angles()) {
            let angle = x[slot as usize];
            let (square, cube) = (angle * angle, angle * angle * angle);
            *factors = [
                [angle, 0.5 * square, cube / 6.0],
                [angle, square, 0.5 * cube],
            ];
            self.angle = self.angle.max(angle);
        }
    }

    /// Sets images of these angles: in the mean, and anywhere where that is asked for.
    pub fn images<const K: usize>(&self, images: &mut [&mut [f64]; K]) {
        let by = self.by.chunks_exact(self.angles.max(1));
        for (g, (by, still)) in by.zip(&self.still).enumerate() {
            let sum = with(*still, &self.greatest[g], self.angle);
            let mut sums = [sum; K];
            for ([linear, slope, size], factors) in by.iter().zip(&self.factors) {
                for (sum, [first, second, third]) in sums.iter_mut().zip(factors) {
                    for k in 0..4 {
                        sum[k] += linear[k] * first + slope[k] * second + size[k] * third;
                    }
                }
            }
            for (image, sum) in images.iter_mut().zip(sums) {
                image[4 * g..][..4].copy_from_slice(&sum);
            }
        }
    }
}

/// The sum with |c| times a factor.
fn with(sum: Four, c: &Four, by: f64) -> Four {
    std::array::from_fn(|k| sum[k] + c[k].abs() * by)
}
