use proptest::prelude::*;

use super::*;
use crate::linkage::Random;

/// A product of random factors, so that the rank is known.
fn of_rank(rows: usize, columns: usize, rank: usize, seed: u64) -> Dense {
    let mut random = Random(seed);
    let left: Vec<f64> = (0..rows * rank).map(|_| random.signed()).collect();
    let right: Vec<f64> = (0..rank * columns).map(|_| random.signed()).collect();
    let mut a = Dense::zeros(rows, columns);
    for row in 0..rows {
        for column in 0..columns {
            a.set(
                row,
                column,
                (0..rank)
                    .map(|k| left[row * rank + k] * right[k * columns + column])
                    .sum(),
            );
        }
    }
    a
}

proptest! {
    #[test]
    fn spaces_of_known_rank(rows in 1usize..14, columns in 1usize..14, rank in 0usize..8, seed in any::<u64>()) {
        let rank = rank.min(rows).min(columns);
        let a = of_rank(rows, columns, rank, seed);
        let report = svd_rank(&a, RANK_TOLERANCE).unwrap();
        prop_assume!(rank == 0 || report.singular_values[rank - 1] > 1e-6 * report.singular_values[0]);
        prop_assert_eq!(report.rank, rank);
        prop_assert_eq!(qr_rank(&a, RANK_TOLERANCE).unwrap(), rank);
        prop_assert_eq!((report.right_null.columns(), report.left_null.columns()), (columns - rank, rows - rank));
        // A null vector found is one of a matrix that differs by rounding of the largest singular value.
        let rounding = 1e-14 * ((rows * columns) as f64).sqrt() * report.singular_values[0];
        for index in 0..columns - rank {
            let v = report.right_null.column(index);
            let product = (0..rows).map(|r| a.row(r).iter().zip(&v).map(|(x, y)| x * y).sum::<f64>().abs());
            let largest = product.fold(0.0, f64::max);
            prop_assert!(largest <= rounding, "{largest} {rounding}");
        }
        for index in 0..rows - rank {
            let u = report.left_null.column(index);
            let product = (0..columns).map(|c| a.column(c).iter().zip(&u).map(|(x, y)| x * y).sum::<f64>().abs());
            let largest = product.fold(0.0, f64::max);
            prop_assert!(largest <= rounding, "{largest} {rounding}");
        }

        // A consistent right-hand side is met, and the solution has no part in the null space.
        let x: Vec<f64> = (0..columns).map(|i| 1.0 + i as f64).collect();
        let b: Vec<f64> = (0..rows).map(|r| a.row(r).iter().zip(&x).map(|(p, q)| p * q).sum()).collect();
        let solution = least_norm_solve(&a, &b, RANK_TOLERANCE).unwrap();
        prop_assert!(solution.rank == rank && solution.residual < 1e-9, "{solution:?}");
        for index in 0..columns - rank {
            let part: f64 = report.right_null.column(index).iter().zip(&solution.x).map(|(p, q)| p * q).sum();
            prop_assert!(part.abs() < 1e-8, "{part}");
        }
    }
}

#[test]
fn two_equal_rows_share_the_load() {
    let a = Dense::new(2, 1, vec![1.0, 1.0]);
    let solution = least_norm_solve(&a, &[1.0, 3.0], RANK_TOLERANCE).unwrap();
    assert!((solution.x[0] - 2.0).abs() < 1e-15 && (solution.residual - 2f64.sqrt()).abs() < 1e-15);
    let load = least_norm_solve(&Dense::new(1, 2, vec![1.0, 1.0]), &[4.0], RANK_TOLERANCE).unwrap();
    assert!(load.x.iter().all(|x| (x - 2.0).abs() < 1e-15), "{load:?}");
}

#[test]
fn no_rows_no_columns_no_sense() {
    let report = svd_rank(&Dense::zeros(0, 3), RANK_TOLERANCE).unwrap();
    assert_eq!((report.rank, report.right_null), (0, identity(3)));
    assert_eq!(
        svd_rank(&Dense::zeros(2, 0), RANK_TOLERANCE)
            .unwrap()
            .left_null,
        identity(2)
    );
    assert_eq!(
        svd_rank(&Dense::zeros(2, 2), RANK_TOLERANCE).unwrap().rank,
        0
    );
    assert_eq!(
        least_norm_solve(&Dense::zeros(0, 2), &[], RANK_TOLERANCE)
            .unwrap()
            .x,
        [0.0, 0.0]
    );
    let bad = Dense::new(2, 2, vec![1.0, 0.0, 0.0, f64::NAN]);
    assert_eq!(
        svd_rank(&bad, RANK_TOLERANCE).unwrap_err(),
        DenseFault::NotFinite { row: 1, column: 1 }
    );
    assert_eq!(
        qr_rank(&bad, RANK_TOLERANCE),
        Err(DenseFault::NotFinite { row: 1, column: 1 })
    );
    assert!(least_norm_solve(&identity(1), &[f64::INFINITY], RANK_TOLERANCE).is_err());
}
