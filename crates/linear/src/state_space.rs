//! Linear systems ẋ = A x + B w, y = C x + D w, given by rows: eigenvalues, gains, frequency responses.
//!
//! ```text
//! G(s) = C (s − A)⁻¹ B + D
//! ```
//!
//! A is balanced before its eigenvalues are computed: by powers of two, so that rows and columns become equally large, which rounds
//! nothing (Parlett and Reinsch 1969).

use faer::Mat;
use nalgebra::{Complex, DMatrix};

/// Parts of eigenvalues below this part of the matrix are round-off \[–\]; of a double zero, the root of it.
const ROUND_OFF: f64 = 1e-13;
const ROUND_OFF_ROOT: f64 = 1e-7;
/// Balancing goes on while it makes rows and columns this much smaller.
const WORTH: f64 = 0.95;

/// Eigenvalues of A (n × n), slowest first; of a pair that with im > 0 alone. `None` if they do not converge.
pub fn eigenvalues(a: &[f64], n: usize) -> Option<Vec<[f64; 2]>> {
    let mut a = DMatrix::from_row_slice(n, n, a);
    balance(&mut a);
    let matrix = Mat::from_fn(n, n, |i, j| a[(i, j)]);
    let found = matrix.eigenvalues().ok()?;
    let largest = found
        .iter()
        .fold(0.0, |most: f64, s| most.max(s.re.hypot(s.im)));
    let rounded = |s: &faer::c64| {
        let size = s.re.hypot(s.im);
        if size <= ROUND_OFF_ROOT * largest {
            return [0.0; 2];
        }
        let part = |x: f64| {
            if x.abs() <= ROUND_OFF * largest {
                0.0
            } else {
                x
            }
        };
        [part(s.re), part(s.im)]
    };
    let mut values: Vec<[f64; 2]> = found.iter().map(rounded).filter(|s| s[1] >= 0.0).collect();
    let size = |s: &[f64; 2]| s[0].hypot(s[1]);
    values.sort_by(|s, t| size(s).total_cmp(&size(t)).then(t[0].total_cmp(&s[0])));
    Some(values)
}

/// Makes rows and columns about equally large by a similarity of powers of two.
fn balance(a: &mut DMatrix<f64>) {
    let n = a.nrows();
    let mut goes_on = true;
    while goes_on {
        goes_on = false;
        for i in 0..n {
            let others = (0..n).filter(|j| *j != i);
            let (column, row) = others.fold((0.0, 0.0), |(column, row): (f64, f64), j| {
                (column + a[(j, i)].abs(), row + a[(i, j)].abs())
            });
            if column == 0.0 || row == 0.0 {
                continue;
            }
            let by = 2.0_f64.powi((0.5 * (row / column).log2()).round() as i32);
            if column * by + row / by < WORTH * (column + row) {
                goes_on = true;
                (0..n).for_each(|j| a[(j, i)] *= by);
                (0..n).for_each(|j| a[(i, j)] /= by);
            }
        }
    }
}

/// G(0) (outputs × inputs) of A, B, C, D with so many states, inputs and outputs; `None` if A is singular.
pub fn static_gain([a, b, c, d]: [&[f64]; 4], size: [usize; 3]) -> Option<Vec<f64>> {
    let gain = response([a, b, c, d], size, [0.0; 2])?;
    Some(gain.into_iter().map(|[re, _]| re).collect())
}

/// G(s) (outputs × inputs) at a complex s; `None` at a pole.
pub fn response(
    [a, b, c, d]: [&[f64]; 4],
    [states, inputs, outputs]: [usize; 3],
    s: [f64; 2],
) -> Option<Vec<[f64; 2]>> {
    let complex = |rows: usize, columns: usize, values: &[f64]| {
        DMatrix::from_row_iterator(rows, columns, values.iter().map(|x| Complex::new(*x, 0.0)))
    };
    let mut matrix = -complex(states, states, a);
    for k in 0..states {
        matrix[(k, k)] += Complex::new(s[0], s[1]);
    }
    let x = matrix.lu().solve(&complex(states, inputs, b))?;
    let g = complex(outputs, states, c) * x + complex(outputs, inputs, d);
    let all = (0..outputs * inputs).map(|k| g[(k / inputs, k % inputs)]);
    let all: Vec<[f64; 2]> = all.map(|g| [g.re, g.im]).collect();
    all.iter().flatten().all(|x| x.is_finite()).then_some(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_oscillator_has_its_poles_and_its_response() {
        // Units in which entries lie far apart: 1e8/s² and 20/s.
        let (a, b) = ([0.0, 1.0, -1e8, -20.0], [0.0, 3.0]);
        let poles = eigenvalues(&a, 2).expect("there");
        let omega = (1e8_f64 - 100.0).sqrt();
        assert_eq!(poles.len(), 1);
        assert!((poles[0][0] + 10.0).abs() < 1e-9, "{poles:?}");
        assert!((poles[0][1] - omega).abs() < 1e-8, "{poles:?}");
        let (c, d) = ([1.0, 0.0], [0.5]);
        let gain = static_gain([&a, &b, &c, &d], [2, 1, 1]).expect("regular");
        assert!((gain[0] - (0.5 + 3e-8)).abs() < 1e-16);
        let at = response([&a, &b, &c, &d], [2, 1, 1], [0.0, 1e4]).expect("no pole");
        // 3/(20 i 1e4) + 0.5
        assert!(
            (at[0][0] - 0.5).abs() < 1e-12 && (at[0][1] + 1.5e-5).abs() < 1e-15,
            "{at:?}"
        );
    }

    #[test]
    fn integrators_have_poles_at_zero_and_no_gain() {
        let a = [0.0, 1.0, 0.0, 0.0];
        assert_eq!(eigenvalues(&a, 2), Some(vec![[0.0; 2]; 2]));
        assert_eq!(
            static_gain([&a, &[0.0, 1.0], &[1.0, 0.0], &[0.0]], [2, 1, 1]),
            None
        );
        assert_eq!(eigenvalues(&[], 0), Some(Vec::new()));
    }
}
