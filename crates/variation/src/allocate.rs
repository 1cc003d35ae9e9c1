//! The cheapest tolerances that keep limits: a cone program.
//!
//! ```text
//! minimise   Σ a_k / t_k                    a_k cost, t_k half width of tolerance k
//! worst case Σ s_ik t_k ≤ r_i               s_ik = |dy_i/dp_k|, r_i the room that limit i leaves beside all that is fixed
//! statistic  √(Σ (s_ik t_k)²) ≤ r_i                     s_ik = 3 σ of output i by t_k = 1
//! ```
//!
//! 1/t_k ≤ z_k is the rotated cone |(2, z_k − t_k)| ≤ z_k + t_k. With one limit the solution is known (Chase 1988):
//! t = r √(a/s)/Σ√(a s) in the worst case, t = r (a/s²)^⅓/√Σ(a s)^⅔ by squares.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT,
    SolverStatus, SupportedConeT,
};

/// How deviations add up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sum {
    /// All at their worst together.
    Worst,
    /// By their variances, three standard deviations within the limits.
    Squares,
}

/// A limit of an output at a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Room {
    /// What the tolerances may use of it [rad or m], above 0.
    pub room: f64,
    /// By tolerance, what a unit of its half width uses of it: |dy/dp|, of variances three standard deviations.
    pub weights: Vec<f64>,
}

/// Why no tolerances can be allocated.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Unallocated {
    /// A limit leaves no room: its number.
    NoRoom(usize),
    /// No limit depends on a tolerance: its number.
    Free(usize),
    /// The solver gave up.
    Unsolved(String),
}

/// Accuracy of the cone program, relative.
const ACCURACY: f64 = 1e-11;

/// Half widths of tolerances with these costs that keep all limits.
///
/// # Errors
/// [`Unallocated`].
///
/// # Examples
/// ```
/// use linkdyn_variation::{Room, Sum, allocate};
///
/// let limit = Room { room: 0.3, weights: vec![1.0, 1.0, 1.0] };
/// let t = allocate(&[1.0, 1.0, 1.0], &[limit], Sum::Worst).unwrap();
/// assert!(t.iter().all(|t| (t - 0.1).abs() < 1e-9));
/// ```
pub fn allocate(costs: &[f64], limits: &[Room], sum: Sum) -> Result<Vec<f64>, Unallocated> {
    let count = costs.len();
    if let Some(none) = limits
        .iter()
        .position(|limit| limit.room <= 0.0 || !limit.room.is_finite())
    {
        return Err(Unallocated::NoRoom(none));
    }
    // A tolerance alone may be this wide; by it all are measured, so that the unknowns are of order 1.
    let alone: Vec<f64> = (0..count)
        .map(|k| {
            limits
                .iter()
                .map(|limit| limit.room / limit.weights[k])
                .fold(f64::INFINITY, f64::min)
        })
        .collect();
    if let Some(free) = alone.iter().position(|alone| !alone.is_finite()) {
        return Err(Unallocated::Free(free));
    }
    let program = Program::new(costs, &alone, limits, sum);
    let widths = program.solve(count)?;
    Ok(widths
        .iter()
        .zip(&alone)
        .map(|(u, alone)| u * alone)
        .collect())
}

/// A x + s = b, s in cones; x = (u, z), t = u·alone.
struct Program {
    /// (row, column, value).
    entries: Vec<(usize, usize, f64)>,
    right: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
    cost: Vec<f64>,
}

impl Program {
    fn new(costs: &[f64], alone: &[f64], limits: &[Room], sum: Sum) -> Self {
        let count = costs.len();
        let shares: Vec<f64> = costs
            .iter()
            .zip(alone)
            .map(|(cost, alone)| cost / alone)
            .collect();
        let largest = shares.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let mut program = Program {
            entries: Vec::new(),
            right: Vec::new(),
            cones: Vec::new(),
            cost: vec![0.0; count],
        };
        program
            .cost
            .extend(shares.iter().map(|share| share / largest));
        if sum == Sum::Worst && !limits.is_empty() {
            program.cones.push(NonnegativeConeT(limits.len()));
        }
        for limit in limits {
            let weights = limit
                .weights
                .iter()
                .zip(alone)
                .map(|(w, alone)| w * alone / limit.room);
            let row = program.right.len();
            program.right.push(1.0);
            match sum {
                Sum::Worst => {
                    let entries = weights.enumerate().map(|(k, w)| (row, k, w));
                    program.entries.extend(entries);
                }
                Sum::Squares => {
                    let entries = weights.enumerate().map(|(k, w)| (row + 1 + k, k, -w));
                    program.entries.extend(entries);
                    program.right.extend(vec![0.0; count]);
                    program.cones.push(SecondOrderConeT(count + 1));
                }
            }
        }
        for k in 0..count {
            // (z + u, z − u, 2) in the cone: 1 ≤ z u
            let row = program.right.len();
            let (u, z) = (k, count + k);
            program.entries.extend([
                (row, z, -1.0),
                (row, u, -1.0),
                (row + 1, z, -1.0),
                (row + 1, u, 1.0),
            ]);
            program.right.extend([0.0, 0.0, 2.0]);
            program.cones.push(SecondOrderConeT(3));
        }
        program
    }

    /// u.
    fn solve(&self, count: usize) -> Result<Vec<f64>, Unallocated> {
        let (rows, columns) = (self.right.len(), 2 * count);
        let triplets = self.entries.iter().filter(|(_, _, value)| *value != 0.0);
        let (mut at, mut to, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for &(row, column, value) in triplets {
            at.push(row);
            to.push(column);
            values.push(value);
        }
        let matrix = CscMatrix::new_from_triplets(rows, columns, at, to, values);
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .tol_gap_abs(ACCURACY)
            .tol_gap_rel(ACCURACY)
            .tol_feas(ACCURACY)
            .build()
            .map_err(|fault| Unallocated::Unsolved(fault.to_string()))?;
        let solver = DefaultSolver::new(
            &CscMatrix::zeros((columns, columns)),
            &self.cost,
            &matrix,
            &self.right,
            &self.cones,
            settings,
        );
        let mut solver = solver.map_err(|fault| Unallocated::Unsolved(fault.to_string()))?;
        solver.solve();
        match solver.solution.status {
            SolverStatus::Solved | SolverStatus::AlmostSolved => {
                Ok(solver.solution.x[..count].to_vec())
            }
            other => Err(Unallocated::Unsolved(format!("{other:?}"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cost is flat at its minimum: a relative gap of 1e-11 leaves tolerances open by the root of that.
    const FLAT: f64 = 3e-6;

    /// V1 of `validation/accuracy-four-bar`: ±0.05°, all costs 1.
    #[test]
    fn one_limit_has_a_closed_form() {
        let weights = [
            0.004730382752,
            0.004410178112,
            0.005287010607,
            0.001718278408,
        ];
        let room = 0.05_f64.to_radians();
        let limit = Room {
            room,
            weights: weights.to_vec(),
        };
        for sum in [Sum::Worst, Sum::Squares] {
            let found = allocate(&[1.0; 4], std::slice::from_ref(&limit), sum).expect("solved");
            let exact = weights.map(|s: f64| match sum {
                Sum::Worst => room * (1.0 / s).sqrt() / weights.map(f64::sqrt).iter().sum::<f64>(),
                Sum::Squares => {
                    let total: f64 = weights.iter().map(|s| s.powf(2.0 / 3.0)).sum();
                    room * s.powf(-2.0 / 3.0) / total.sqrt()
                }
            });
            for (found, exact) in found.iter().zip(exact) {
                assert!(
                    (found / exact - 1.0).abs() < FLAT,
                    "{sum:?}: {found} {exact}"
                );
            }
        }
    }

    #[test]
    fn several_limits_share_their_room() {
        // The first limit binds the first tolerance alone, the second both.
        let limits = [
            Room {
                room: 1.0,
                weights: vec![10.0, 0.0],
            },
            Room {
                room: 1.0,
                weights: vec![1.0, 1.0],
            },
        ];
        let found = allocate(&[1.0, 1.0], &limits, Sum::Worst).expect("solved");
        assert!(
            (found[0] - 0.1).abs() < 1e-8 && (found[1] - 0.9).abs() < 1e-8,
            "{found:?}"
        );
    }

    #[test]
    fn what_can_not_be_is_told() {
        let none = Room {
            room: 0.0,
            weights: vec![1.0],
        };
        assert_eq!(
            allocate(&[1.0], &[none], Sum::Worst),
            Err(Unallocated::NoRoom(0))
        );
        let idle = Room {
            room: 1.0,
            weights: vec![1.0, 0.0],
        };
        assert_eq!(
            allocate(&[1.0, 1.0], &[idle], Sum::Worst),
            Err(Unallocated::Free(1))
        );
    }
}
