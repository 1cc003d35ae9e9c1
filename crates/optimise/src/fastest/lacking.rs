//! Whether some law keeps all limits: a program of cones, which has a solution in any case.
//!
//! ```text
//! minimise w,   u ≤ w,   |(u, v)| ≤ 1 + w,   β ≥ 0
//! ```

use super::{Scaled, Term, Terms};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT,
    SolverStatus, SupportedConeT,
};

/// Rows of A x + s = b.
#[derive(Default)]
struct Cones {
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
    right: Vec<f64>,
}

impl Cones {
    /// A row s = constant + Σ value·x.
    fn push(&mut self, constant: f64, terms: &[(usize, f64)]) {
        let row = self.right.len();
        self.right.push(constant);
        for (column, value) in terms {
            self.rows.push(row);
            self.columns.push(*column);
            self.values.push(-value);
        }
    }
}

/// w, and how much each row counts.
pub(super) fn least(scaled: &Scaled) -> Option<(f64, Vec<f64>)> {
    let inner = scaled.spans.len() - 1;
    let term = |k: usize, u: &Term, sign: f64| {
        let mut constant = sign * u[0];
        let mut terms = Vec::with_capacity(3);
        for (node, value) in [(k, u[1]), (k + 1, u[2])] {
            match node {
                0 => constant += sign * value * scaled.ends[0],
                _ if node > inner => constant += sign * value * scaled.ends[1],
                _ => terms.push((node - 1, sign * value)),
            }
        }
        (constant, terms)
    };
    let mut cones = Cones::default();
    let mut place = vec![0; scaled.rows.len()];
    for node in 0..inner {
        cones.push(0.0, &[(node, 1.0)]);
    }
    for (number, row) in scaled.rows.iter().enumerate() {
        if let Terms::Below(u) = &row.of {
            place[number] = cones.right.len();
            let (constant, mut terms) = term(row.interval, u, -1.0);
            terms.push((inner, 1.0));
            cones.push(constant, &terms);
        }
    }
    let mut kinds: Vec<SupportedConeT<f64>> = vec![NonnegativeConeT(cones.right.len())];
    for (number, row) in scaled.rows.iter().enumerate() {
        if let Terms::Within(all) = &row.of {
            place[number] = cones.right.len();
            cones.push(1.0, &[(inner, 1.0)]);
            for u in all {
                let (constant, terms) = term(row.interval, u, 1.0);
                cones.push(constant, &terms);
            }
            kinds.push(SecondOrderConeT(3));
        }
    }
    let mut costs = vec![0.0; inner];
    costs.push(1.0);
    let (height, width) = (cones.right.len(), costs.len());
    let matrix =
        CscMatrix::new_from_triplets(height, width, cones.rows, cones.columns, cones.values);
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .build()
        .ok()?;
    let flat = CscMatrix::zeros((width, width));
    let mut solver =
        DefaultSolver::new(&flat, &costs, &matrix, &cones.right, &kinds, settings).ok()?;
    solver.solve();
    let found = &solver.solution;
    if !matches!(
        found.status,
        SolverStatus::Solved | SolverStatus::AlmostSolved
    ) {
        return None;
    }
    let weights = place.iter().map(|row| found.z[*row]).collect();
    Some((found.x[inner], weights))
}
