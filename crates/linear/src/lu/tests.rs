use nalgebra::DMatrix;
use proptest::prelude::*;

use super::super::linkage::{self, Matrix, Random};
use super::*;

/// Pattern and values of a matrix.
fn sparse(matrix: &Matrix) -> (Pattern, Vec<f64>) {
    let (pattern, slots) =
        Pattern::from_entries(matrix.rows, matrix.columns, &matrix.positions()).unwrap();
    let mut values = vec![0.0; pattern.entries()];
    for (&slot, &(_, _, value)) in slots.iter().zip(&matrix.entries) {
        values[slot as usize] += value;
    }
    (pattern, values)
}

fn paired(matrix: &Matrix) -> (SparseLu, Vec<f64>) {
    let (pattern, values) = sparse(matrix);
    let order = ColumnOrder::paired(&pattern, &values).unwrap();
    (SparseLu::new(pattern, order), values)
}

fn dense(pattern: &Pattern, values: &[f64]) -> DMatrix<f64> {
    let mut a = DMatrix::zeros(pattern.rows(), pattern.columns());
    for column in 0..pattern.columns() {
        for (&row, &value) in pattern
            .column(column)
            .iter()
            .zip(&values[pattern.span(column)])
        {
            a[(row as usize, column)] = value;
        }
    }
    a
}

/// |b − A x| / (|A| |x| + |b|) in the maximum norm.
fn backward_error(a: &DMatrix<f64>, x: &[f64], b: &[f64]) -> f64 {
    let (x, b) = (
        nalgebra::DVector::from_column_slice(x),
        nalgebra::DVector::from_column_slice(b),
    );
    let norm = a
        .row_iter()
        .map(|row| row.iter().map(|v| v.abs()).sum::<f64>())
        .fold(0.0, f64::max);
    (&b - a * &x).amax() / (norm * x.amax() + b.amax())
}

/// Both solves have small backward errors, refined ones rounding level.
fn check_solves(lu: &mut SparseLu, values: &[f64], tolerance: f64) {
    let a = dense(lu.pattern(), values);
    let mut random = Random(5);
    let b: Vec<f64> = (0..a.nrows()).map(|_| random.signed()).collect();
    for (refined, tolerance) in [(false, tolerance), (true, 1e-15 * (a.nrows() as f64 + 4.0))] {
        let (mut x, mut y) = (b.clone(), b.clone());
        if refined {
            lu.solve_refined(values, &mut x);
            lu.solve_transposed_refined(values, &mut y);
        } else {
            lu.solve(&mut x);
            lu.solve_transposed(&mut y);
        }
        let errors = (
            backward_error(&a, &x, &b),
            backward_error(&a.transpose(), &y, &b),
        );
        assert!(
            errors.0 < tolerance && errors.1 < tolerance,
            "backward errors {errors:?}, refined {refined}"
        );
    }
}

/// Sign and logarithm agree with the dense determinant.
fn check_determinant(lu: &SparseLu, values: &[f64]) {
    let dense = dense(lu.pattern(), values).lu();
    let u = dense.u();
    let mut sign: f64 = dense.p().determinant();
    let mut ln_abs = 0.0;
    for i in 0..u.nrows() {
        sign *= u[(i, i)].signum();
        ln_abs += u[(i, i)].abs().ln();
    }
    let ours = lu.determinant();
    assert!(
        ours.0 == sign && (ours.1 - ln_abs).abs() < 1e-7,
        "{ours:?} against ({sign}, {ln_abs})"
    );
}

/// A random matrix with a full transversal, so that it is structurally nonsingular.
fn random_matrix(n: usize, seed: u64) -> Matrix {
    let mut random = Random(seed);
    let mut rows: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        rows.swap(i, random.below(i + 1));
    }
    let mut positions: Vec<(usize, usize)> = rows
        .into_iter()
        .enumerate()
        .map(|(column, row)| (row, column))
        .collect();
    positions.extend((0..2 * n).map(|_| (random.below(n), random.below(n))));
    positions.sort_unstable();
    positions.dedup();
    let entries = positions
        .into_iter()
        .map(|(row, column)| (row, column, random.signed()))
        .collect();
    Matrix {
        rows: n,
        columns: n,
        entries,
    }
}

proptest! {
    #[test]
    fn random_matrices_agree_with_dense(n in 1usize..40, seed in any::<u64>(), kind in 0..3) {
        let (pattern, values) = sparse(&random_matrix(n, seed));
        let a = dense(&pattern, &values);
        let condition = a.singular_values();
        prop_assume!(condition.min() > 1e-9 * condition.max());
        let order = match kind {
            0 => ColumnOrder::natural(n),
            1 => ColumnOrder::amd(&pattern),
            _ => ColumnOrder::paired(&pattern, &values).unwrap(),
        };
        let mut lu = SparseLu::new(pattern, order);
        lu.factor(&values).unwrap();
        prop_assert!(lu.growth() <= 1.0 / PIVOT_THRESHOLD * 1.0000001);
        check_solves(&mut lu, &values, 1e-11);
        check_determinant(&lu, &values);
    }

    #[test]
    fn refactored_equals_factored(n in 1usize..40, seed in any::<u64>()) {
        let (mut lu, mut values) = paired(&random_matrix(n, seed));
        prop_assume!(lu.factor(&values).is_ok());
        let mut random = Random(!seed);
        for value in &mut values {
            *value += 0.3 * random.signed();
        }
        let a = dense(lu.pattern(), &values).singular_values();
        prop_assume!(a.min() > 1e-6 * a.max());
        lu.refactor(&values).unwrap();
        check_solves(&mut lu, &values, 1e-7);
        check_determinant(&lu, &values);
    }

    #[test]
    fn linkages_agree_with_dense(bodies in 1usize..12, loops in 0usize..4, seed in any::<u64>()) {
        let mut random = Random(seed);
        let (bodies, pins) = linkage::random_linkage(bodies, loops.min(bodies / 3), &mut random);
        let jac = linkage::jacobian(bodies, &pins, &[]);
        let a = DMatrix::from_row_slice(jac.rows, jac.columns, &jac.dense());
        // The determinant loses the digits of the inverse square of the smallest one, in both factorisations.
        prop_assume!(jac.rows <= jac.columns && a.singular_values().min() > 1e-4);
        let (mut lu, values) = paired(&linkage::kkt(&jac, &mut random));
        lu.refactor(&values).unwrap();
        check_solves(&mut lu, &values, 1e-12);
        check_determinant(&lu, &values);
    }
}

#[test]
fn chain_and_six_bar_turn_with_few_new_pivots() {
    let (bodies, pins) = linkage::four_bar_chain(10, 1.1);
    let (mut lu, values) = paired(&linkage::kkt(
        &linkage::jacobian(bodies, &pins, &[]),
        &mut Random(1),
    ));
    lu.refactor(&values).unwrap();
    check_solves(&mut lu, &values, 1e-13);

    let (mut lu, _) = paired(&linkage::six_bar(0.3));
    for step in 0..360 {
        let (_, values) = sparse(&linkage::six_bar(f64::from(step).to_radians()));
        lu.refactor(&values).unwrap();
        check_solves(&mut lu, &values, 1e-10);
        check_determinant(&lu, &values);
    }
    assert!(lu.fallbacks() <= 8, "{} fallbacks", lu.fallbacks());
}

#[test]
fn bad_pivot_is_replaced() {
    let pattern = Pattern::new(2, vec![0, 2, 4], vec![0, 1, 0, 1]).unwrap();
    let mut lu = SparseLu::new(pattern, ColumnOrder::natural(2));
    lu.refactor(&[1.0, 1.0, 2.0, 1.0]).unwrap();
    for small in [0.0, 1e-9, f64::MIN_POSITIVE] {
        let before = lu.fallbacks();
        lu.factor(&[1.0, 1.0, 2.0, 1.0]).unwrap();
        lu.refactor(&[small, 1.0, 1.0, 1.0]).unwrap();
        assert_eq!(lu.fallbacks(), before + 1);
        check_solves(&mut lu, &[small, 1.0, 1.0, 1.0], 1e-15);
    }
}

#[test]
fn singular_matrices_are_refused() {
    let pattern = || Pattern::new(3, vec![0, 3, 6, 9], vec![0, 1, 2, 0, 1, 2, 0, 1, 2]).unwrap();
    let sound = [2.0, 1.0, 0.0, 1.0, 3.0, 1.0, 0.0, 1.0, 4.0];
    let duplicate_row = [2.0, 1.0, 1.0, 1.0, 3.0, 3.0, 0.0, 1.0, 1.0];
    let zero_column = [2.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 4.0];
    let zero_row = [2.0, 0.0, 1.0, 1.0, 0.0, 5.0, 3.0, 0.0, 1.0];
    let nearly = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 5.0, 7.0 + 1e-15, 9.0];
    for values in [duplicate_row, zero_column, zero_row, nearly] {
        let mut lu = SparseLu::new(pattern(), ColumnOrder::natural(3));
        let fault = lu.factor(&values).unwrap_err();
        assert!(fault.ratio < SINGULAR_RATIO && !lu.is_factored(), "{fault}");
        lu.refactor(&sound).unwrap();
        assert!(lu.refactor(&values).is_err() && !lu.is_factored());
        // And it comes back.
        lu.refactor(&sound).unwrap();
        check_solves(&mut lu, &sound, 1e-15);
    }
    let mut lu = SparseLu::new(pattern(), ColumnOrder::natural(3));
    assert_eq!(
        lu.factor(&zero_column),
        Err(Singular {
            column: 1,
            row: Some(1),
            ratio: 0.0
        })
    );
    assert_eq!(lu.factor(&zero_row).unwrap_err().row, Some(1));
}

#[test]
fn scaling_rows_or_columns_is_not_singular() {
    let sound = [2.0, 1.0, 0.5, 1.0, 3.0, 1.0, 0.5, 1.0, 4.0];
    let scale = [1e-20, 1.0, 1e15];
    for by_row in [false, true] {
        let mut values = sound;
        for (slot, value) in values.iter_mut().enumerate() {
            *value *= scale[if by_row { slot % 3 } else { slot / 3 }];
        }
        let pattern = Pattern::new(3, vec![0, 3, 6, 9], vec![0, 1, 2, 0, 1, 2, 0, 1, 2]).unwrap();
        let mut lu = SparseLu::new(pattern, ColumnOrder::natural(3));
        lu.factor(&values).unwrap();
        assert!(
            lu.smallest_pivot_ratio(&values) > 1e-3,
            "{}",
            lu.smallest_pivot_ratio(&values)
        );
        lu.refactor(&values).unwrap();
        assert_eq!(lu.fallbacks(), 0);
    }
}

#[test]
fn values_that_are_not_finite_are_refused_wherever_they_stand() {
    let (mut lu, sound) = paired(&linkage::six_bar(0.3));
    for slot in 0..sound.len() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut values = sound.clone();
            values[slot] = bad;
            lu.refactor(&sound).unwrap();
            let fault = lu.refactor(&values).unwrap_err();
            assert!(fault.ratio.is_nan());
            assert_eq!(
                lu.pattern().slot(fault.row.unwrap(), fault.column),
                Some(slot)
            );
        }
    }
    // Finite entries whose elimination overflows.
    let pattern = Pattern::new(2, vec![0, 2, 4], vec![0, 1, 0, 1]).unwrap();
    let mut lu = SparseLu::new(pattern, ColumnOrder::natural(2));
    assert!(lu.factor(&[1.0, 1.0, 1e308, -1.5e308]).is_err());
    assert!(lu.factor(&[1e-310, 0.0, 0.0, 1e-310]).is_err());
}

#[test]
fn aligned_and_redundant_linkages_are_singular() {
    // All links on one line.
    let (bodies, pins) = linkage::four_bar_chain(10, 0.0);
    let (mut lu, values) = paired(&linkage::kkt(
        &linkage::jacobian(bodies, &pins, &[]),
        &mut Random(3),
    ));
    let fault = lu.refactor(&values).unwrap_err();
    assert!(fault.ratio < 1e-15, "{fault}");

    // The same pin twice, on links with freedom enough that the pattern does not tell.
    let (bodies, mut pins) = linkage::random_linkage(20, 0, &mut Random(4));
    pins.push(pins[12]);
    let (mut lu, values) = paired(&linkage::kkt(
        &linkage::jacobian(bodies, &pins, &[]),
        &mut Random(3),
    ));
    let fault = lu.refactor(&values).unwrap_err();
    assert!(fault.ratio < 1e-14, "{fault}");

    // And in a linkage where it does.
    let (bodies, mut pins) = linkage::four_bar_chain(10, 1.0);
    pins.push(pins[12]);
    let jac = linkage::jacobian(bodies, &pins, &[]);
    let (pattern, values) = sparse(&linkage::kkt(&jac, &mut Random(3)));
    let lonely = ColumnOrder::paired(&pattern, &values).unwrap_err();
    assert!(
        lonely.rows.len() == 1 && lonely.rows[0] >= jac.columns,
        "{lonely}"
    );

    // With a regularised corner it is fine.
    let mut matrix = linkage::kkt(&jac, &mut Random(3));
    matrix
        .entries
        .extend((jac.columns..matrix.rows).map(|i| (i, i, -1e-8)));
    let (mut lu, values) = paired(&matrix);
    lu.refactor(&values).unwrap();
    check_solves(&mut lu, &values, 1e-12);
}

#[test]
fn smallest_singular_value_and_vectors() {
    for step in 0..12 {
        let (mut lu, values) = paired(&linkage::six_bar(f64::from(step) * 0.5));
        lu.factor(&values).unwrap();
        let a = dense(lu.pattern(), &values);
        let expected = a.singular_values().min();
        let (mut right, mut left) = (vec![0.0; 15], vec![0.0; 15]);
        let sigma = lu.smallest_singular(8, &mut right, &mut left);
        assert!(
            sigma >= expected * (1.0 - 1e-9) && sigma < 1.05 * expected,
            "{sigma} against {expected}"
        );
        let (right, left) = (
            nalgebra::DVector::from_vec(right),
            nalgebra::DVector::from_vec(left),
        );
        assert!((a.transpose() * &left - &right * sigma).norm() < 1e-12);
        assert!((a * right - left * sigma).norm() < 0.3 * sigma);
    }
}

#[test]
fn determinant_turns_with_permutations_and_signs() {
    // The cyclic permutation is even, the exchange odd.
    let cyclic = Pattern::new(3, vec![0, 1, 2, 3], vec![1, 2, 0]).unwrap();
    let exchange = Pattern::new(2, vec![0, 1, 2], vec![1, 0]).unwrap();
    for (pattern, values, expected) in [
        (cyclic.clone(), vec![1.0, 2.0, 3.0], 6.0),
        (cyclic, vec![1.0, -2.0, 3.0], -6.0),
        (exchange, vec![1.0, 1.0], -1.0f64),
    ] {
        let order = ColumnOrder::paired(&pattern, &values).unwrap();
        let mut lu = SparseLu::new(pattern, order);
        lu.factor(&values).unwrap();
        let (sign, ln_abs) = lu.determinant();
        assert!((sign * ln_abs.exp() - expected).abs() < 1e-14);
    }
}

#[test]
fn empty_and_single() {
    let mut lu = SparseLu::new(
        Pattern::new(0, vec![0], vec![]).unwrap(),
        ColumnOrder::natural(0),
    );
    lu.refactor(&[]).unwrap();
    lu.refactor(&[]).unwrap();
    lu.solve(&mut []);
    assert_eq!(lu.determinant(), (1.0, 0.0));
    let mut lu = SparseLu::new(
        Pattern::new(1, vec![0, 1], vec![0]).unwrap(),
        ColumnOrder::natural(1),
    );
    lu.refactor(&[-4.0]).unwrap();
    let mut b = [2.0];
    lu.solve_transposed(&mut b);
    assert_eq!((b, lu.determinant().0), ([-0.5], -1.0));
    assert!(lu.refactor(&[0.0]).is_err());
}
