//! One step of constrained optimisation: a convex quadratic program whose constraints may be paid for.
//!
//! ```text
//! minimise  max(gᵀd, v_j + h_jᵀd, …) + ½ dᵀB d + ρ Σ(violations)      lower ≤ d ≤ upper
//!           c + A d = 0 or ≤ 0, each with a violation ≥ 0
//! ```
//!
//! It always has a solution. Solved by Clarabel's interior point method (Goulart and Chen 2024), which linkdyn uses elsewhere, too.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus,
    SupportedConeT, ZeroConeT,
};

/// Accuracy asked of the solver.
const ACCURACY: f64 = 1e-12;

/// What a constraint wants of its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// To be zero.
    Equal,
    /// To be zero or below.
    AtMost,
}

impl Kind {
    /// How far a value is from what is wanted.
    pub fn violation(self, value: f64) -> f64 {
        match self {
            Kind::Equal => value.abs(),
            Kind::AtMost => value.max(0.0),
        }
    }
}

/// The program.
#[derive(Debug)]
pub struct Quadratic {
    /// Gradient (n).
    pub gradient: Vec<f64>,
    /// Other linear models of the objective, each by its value less that of the first one at d = 0, at most 0, and its gradient: the
    /// greatest of all counts.
    pub planes: Vec<(f64, Vec<f64>)>,
    /// Hessian (n, n) by rows, positive semidefinite.
    pub hessian: Vec<f64>,
    /// Kind, value and derivatives (n) of each constraint.
    pub constraints: Vec<(Kind, f64, Vec<f64>)>,
    /// Least and largest d.
    pub room: Vec<[f64; 2]>,
    /// What a violation costs.
    pub price: f64,
}

/// Its solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// The step (n).
    pub d: Vec<f64>,
    /// Multipliers of the constraints: ∇f + Aᵀ multipliers is what the bounds hold.
    pub multipliers: Vec<f64>,
    /// Sum of the violations of c + A d.
    pub violation: f64,
    /// How much each model of the objective counts, the first one first; together 1.
    pub weights: Vec<f64>,
}

/// Entries of a matrix under construction.
#[derive(Default)]
struct Entries {
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
}

impl Entries {
    fn push(&mut self, row: usize, column: usize, value: f64) {
        if value != 0.0 {
            self.rows.push(row);
            self.columns.push(column);
            self.values.push(value);
        }
    }

    fn matrix(self, rows: usize, columns: usize) -> CscMatrix<f64> {
        CscMatrix::new_from_triplets(rows, columns, self.rows, self.columns, self.values)
    }
}

/// The constraints of all unknowns.
struct Rows {
    matrix: Entries,
    right: Vec<f64>,
    /// So many of them are equations.
    equal: usize,
}

impl Rows {
    /// The unknowns and the multipliers of the rows.
    fn solve(self, costs: Vec<f64>, curvature: Entries) -> Option<(Vec<f64>, Vec<f64>)> {
        let (rows, unknowns) = (self.right.len(), costs.len());
        let cones: [SupportedConeT<f64>; 2] =
            [ZeroConeT(self.equal), NonnegativeConeT(rows - self.equal)];
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .tol_gap_abs(ACCURACY)
            .tol_gap_rel(ACCURACY)
            .tol_feas(ACCURACY)
            .build()
            .ok()?;
        let hessian = curvature.matrix(unknowns, unknowns);
        let matrix = self.matrix.matrix(rows, unknowns);
        let mut solver =
            DefaultSolver::new(&hessian, &costs, &matrix, &self.right, &cones, settings).ok()?;
        solver.solve();
        let solution = &solver.solution;
        let is_usable = matches!(
            solution.status,
            // Close to round-off the last step may fail; what is there is good enough to be tried.
            SolverStatus::Solved
                | SolverStatus::AlmostSolved
                | SolverStatus::InsufficientProgress
                | SolverStatus::MaxIterations
        );
        let mut all = solution.x.iter().chain(&solution.z);
        let is_finite = all.all(|value| value.is_finite());
        (is_usable && is_finite).then(|| (solution.x.clone(), solution.z.clone()))
    }
}

impl Quadratic {
    /// Solves it; `None` if the solver fails.
    pub fn solve(&self) -> Option<Step> {
        let n = self.gradient.len();
        let (rows, place, first) = self.rows();
        let (x, z) = rows.solve(self.costs(), self.curvature())?;
        let weights = match self.planes.len() {
            0 => vec![1.0],
            count => z[first..=first + count].to_vec(),
        };
        let mut d = x[..n].to_vec();
        for (d, [lower, upper]) in d.iter_mut().zip(&self.room) {
            *d = d.clamp(*lower, *upper);
        }
        Some(Step {
            violation: self.violation(&d),
            multipliers: place.iter().map(|row| z[*row]).collect(),
            weights,
            d,
        })
    }

    /// How many equations there are, and unknowns: d, then violations, two of an equation, one of an inequality.
    fn counts(&self) -> (usize, usize) {
        let all = self.constraints.iter();
        let equal = all.filter(|one| one.0 == Kind::Equal).count();
        let top = usize::from(!self.planes.is_empty());
        let violations = self.constraints.len() + equal;
        (equal, self.gradient.len() + violations + top)
    }

    fn costs(&self) -> Vec<f64> {
        let mut costs = self.gradient.clone();
        costs.resize(self.counts().1, self.price);
        // With several models the last unknown is the greatest of them.
        if !self.planes.is_empty() {
            costs[..self.gradient.len()].fill(0.0);
            costs.pop();
            costs.push(1.0);
        }
        costs
    }

    /// The upper half of the Hessian of all unknowns.
    fn curvature(&self) -> Entries {
        let mut entries = Entries::default();
        let rows = self.hessian.chunks_exact(self.gradient.len());
        for (row, all) in rows.enumerate() {
            let upper = all.iter().enumerate().skip(row);
            upper.for_each(|(column, entry)| entries.push(row, column, *entry));
        }
        entries
    }

    /// A x + s = b, s zero in the rows of equations, which come first, and positive in the others; where each constraint stands, and
    /// the first model of the objective.
    fn rows(&self) -> (Rows, Vec<usize>, usize) {
        let n = self.gradient.len();
        let (equal, unknowns) = self.counts();
        let mut matrix = Entries::default();
        let mut right = Vec::new();
        let mut slack = n;
        let mut place = vec![0; self.constraints.len()];
        for wanted in [Kind::Equal, Kind::AtMost] {
            let all = self.constraints.iter().enumerate();
            for (number, (_, value, slopes)) in all.filter(|(_, one)| one.0 == wanted) {
                let row = right.len();
                place[number] = row;
                for (k, slope) in slopes.iter().enumerate() {
                    matrix.push(row, k, *slope);
                }
                matrix.push(row, slack, -1.0);
                slack += 1;
                if wanted == Kind::Equal {
                    matrix.push(row, slack, 1.0);
                    slack += 1;
                }
                right.push(-value);
            }
        }
        for (k, [lower, upper]) in self.room.iter().enumerate() {
            for (sign, end) in [(-1.0, lower), (1.0, upper)] {
                matrix.push(right.len(), k, sign);
                right.push(sign * end);
            }
        }
        let top = usize::from(!self.planes.is_empty());
        for k in n..unknowns - top {
            matrix.push(right.len(), k, -1.0);
            right.push(0.0);
        }
        let models = right.len();
        if top == 1 {
            let own = (0.0, &self.gradient);
            let others = self.planes.iter().map(|(value, slopes)| (*value, slopes));
            for (value, slopes) in std::iter::once(own).chain(others) {
                let row = right.len();
                let entries = slopes.iter().enumerate();
                entries.for_each(|(k, slope)| matrix.push(row, k, *slope));
                matrix.push(row, unknowns - 1, -1.0);
                right.push(-value);
            }
        }
        let rows = Rows {
            matrix,
            right,
            equal,
        };
        (rows, place, models)
    }

    /// Sum of the violations of c + A d.
    pub fn violation(&self, d: &[f64]) -> f64 {
        let all = self.constraints.iter();
        all.map(|(kind, value, slopes)| {
            let moved: f64 = slopes.iter().zip(d).map(|(slope, d)| slope * d).sum();
            kind.violation(value + moved)
        })
        .sum()
    }

    /// The model without its violations.
    pub fn model(&self, d: &[f64]) -> f64 {
        let n = d.len();
        let rows = self.hessian.chunks_exact(n).zip(d);
        let square: f64 = rows
            .map(|(row, own)| own * row.iter().zip(d).map(|(entry, d)| entry * d).sum::<f64>())
            .sum();
        let linear = |slopes: &[f64]| slopes.iter().zip(d).map(|(g, d)| g * d).sum::<f64>();
        let others = self.planes.iter();
        let others = others.map(|(value, slopes)| value + linear(slopes));
        others.fold(linear(&self.gradient), f64::max) + 0.5 * square
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// min ½|d|² − d₁ − d₂, d₁ + d₂ = 1, d₁ ≤ 0.2: (0.2, 0.8), multiplier of the equation 0.2.
    #[test]
    fn equations_inequalities_and_the_box_hold() {
        let program = Quadratic {
            gradient: vec![-1.0, -1.0],
            planes: Vec::new(),
            hessian: vec![1.0, 0.0, 0.0, 1.0],
            constraints: vec![
                (Kind::AtMost, -0.2, vec![1.0, 0.0]),
                (Kind::Equal, -1.0, vec![1.0, 1.0]),
            ],
            room: vec![[-2.0, 2.0]; 2],
            price: 100.0,
        };
        let step = program.solve().expect("a solution");
        for (found, exact) in step
            .d
            .iter()
            .chain(&step.multipliers)
            .zip([0.2, 0.8, 0.6, 0.2])
        {
            assert!((found - exact).abs() < 1e-9, "{step:?}");
        }
        assert!(step.violation < 1e-10, "{step:?}");
        // With a box that does not reach it, the least violation is taken.
        let program = Quadratic {
            room: vec![[-0.1, 0.1]; 2],
            ..program
        };
        let step = program.solve().expect("a solution");
        assert!((step.violation - 0.8).abs() < 1e-9, "{step:?}");
    }

    /// The greatest of x and −0.3 − x/2 is least at x = −0.2, where they count ⅓ and ⅔.
    #[test]
    fn the_greatest_of_several_models_counts() {
        let program = Quadratic {
            gradient: vec![1.0, 0.0],
            planes: vec![(-0.3, vec![-0.5, 0.0])],
            hessian: vec![0.0, 0.0, 0.0, 1.0],
            constraints: Vec::new(),
            room: vec![[-1.0, 1.0]; 2],
            price: 1.0,
        };
        let step = program.solve().expect("a solution");
        assert!(
            (step.d[0] + 0.2).abs() < 1e-9 && step.d[1].abs() < 1e-9,
            "{step:?}"
        );
        assert!((step.weights[0] - 1.0 / 3.0).abs() < 1e-9, "{step:?}");
        assert!((program.model(&step.d) + 0.2).abs() < 1e-9, "{step:?}");
    }
}
