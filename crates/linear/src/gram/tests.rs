use super::*;
use crate::linkage::{self, Matrix, Random};
use nalgebra::{DMatrix, DVector};

fn gram(matrix: &Matrix) -> Gram {
    let mut entries = matrix.entries.clone();
    entries.sort_by_key(|(_, column, _)| *column);
    let places = entries.iter();
    let places: Vec<_> = places
        .map(|&(row, column, _)| [row as u32, column as u32])
        .collect();
    let mut gram = Gram::new([matrix.rows, matrix.columns], &places);
    let values = gram.values_mut().iter_mut().zip(&entries);
    values.for_each(|(to, entry)| *to = entry.2);
    gram
}

/// The nearest z by singular values.
fn nearest(matrix: &Matrix, z: &[f64], c: &[f64]) -> DVector<f64> {
    let b = DMatrix::from_row_slice(matrix.rows, matrix.columns, &matrix.dense());
    let z = DVector::from_column_slice(z);
    let off = &b * &z - DVector::from_column_slice(c);
    let least = b.svd(true, true).solve(&off, 1e-14).expect("vectors");
    z - least
}

#[test]
fn linkages_are_projected_as_by_singular_values() {
    let mut random = Random(7);
    let mut count = 0;
    for loops in (0..40).map(|k| k % 5) {
        let (bodies, pins) = linkage::random_linkage(12, loops, &mut random);
        let matrix = linkage::jacobian(bodies, &pins, &[]);
        let b = DMatrix::from_row_slice(matrix.rows, matrix.columns, &matrix.dense());
        if b.singular_values().min() < 1e-2 {
            continue;
        }
        let mut gram = gram(&matrix);
        gram.factor().expect("independent rows");
        let z: Vec<f64> = (0..matrix.columns).map(|_| random.signed()).collect();
        let c: Vec<f64> = (0..matrix.rows).map(|_| random.signed()).collect();
        let mut found = z.clone();
        gram.project(&mut found, &c);
        let off = (DVector::from_column_slice(&found) - nearest(&matrix, &z, &c)).amax();
        assert!(off <= 1e-11, "{loops} loops: {off:e}");
        count += 1;
    }
    assert!(count >= 25, "{count}");
}

/// Two rows that differ by little: weak from a thousandth on.
#[test]
fn rows_that_are_nearly_dependent_are_weak() {
    for (apart, is_weak) in [(1.0, false), (3e-3, false), (3e-4, true), (0.0, true)] {
        let matrix = Matrix {
            rows: 2,
            columns: 3,
            entries: vec![
                (0, 0, 1.0),
                (0, 1, 2.0),
                (1, 0, 1.0),
                (1, 1, 2.0),
                (1, 2, apart),
            ],
        };
        let mut gram = gram(&matrix);
        assert_eq!(gram.factor().is_err(), is_weak, "{apart}");
        if !is_weak {
            let (z, c) = ([0.3, -0.2, 0.5], [1.0, 1.1]);
            let mut found = z;
            gram.project(&mut found, &c);
            let off = (DVector::from_column_slice(&found) - nearest(&matrix, &z, &c)).amax();
            assert!(off <= 1e-12 / apart, "{apart}: {off:e}");
        }
    }
}

#[test]
fn what_is_not_finite_is_weak_and_nothing_is_projected_to_itself() {
    let entries = vec![(0, 0, 1.0), (0, 1, f64::NAN)];
    let matrix = Matrix {
        rows: 1,
        columns: 2,
        entries,
    };
    assert!(gram(&matrix).factor().is_err());
    let mut none = Gram::new([0, 2], &[]);
    none.factor().expect("no rows");
    let mut z = [1.0, 2.0];
    none.project(&mut z, &[]);
    assert_eq!(z, [1.0, 2.0]);
}

/// The factors of a chain cost the same for each link, however long it is.
#[test]
fn chains_fill_in_little() {
    let sizes = [50, 500].map(|links| {
        let pins: Vec<_> = (0..links)
            .map(|k: usize| {
                let before = (k.checked_sub(1), [0.1, 0.2]);
                (before, (Some(k), [-0.1, 0.3]))
            })
            .collect();
        let gram = gram(&linkage::jacobian(links, &pins, &[]));
        gram.lower.len() as f64 / links as f64
    });
    assert!(sizes[1] <= 1.1 * sizes[0] && sizes[0] <= 6.0, "{sizes:?}");
}
