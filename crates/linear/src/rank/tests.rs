use proptest::prelude::*;

use super::super::dense::{Dense, svd_rank};
use super::super::linkage::{self, Matrix, Random};
use super::*;
use crate::pattern::Pattern;

#[test]
fn what_is_free_is_orthogonal_to_all_rows() {
    let entries = [
        (0, 0, 1.0),
        (1, 1, 2.0),
        (2, 2, 1.0),
        (2, 3, 1.0),
        (3, 2, 2.0),
        (3, 3, 2.0),
    ];
    let rows = SparseRows::from_triplets(4, 4, &entries).expect("finite");
    let z = free_direction(&rows, DEPENDENCE_TOLERANCE).expect("one is free");
    assert_eq!(z[..2], [0.0, 0.0]);
    assert!((z[2] + z[3]).abs() < 1e-15 && z[2].abs() == 1.0, "{z:?}");
    let rows =
        SparseRows::from_triplets(2, 2, &[(0, 0, 1.0), (1, 0, 1.0), (1, 1, 1.0)]).expect("finite");
    assert_eq!(free_direction(&rows, DEPENDENCE_TOLERANCE), None);
}

#[test]
fn one_direction_is_told_where_there_is_one_alone() {
    let of = |rows, entries: &[_]| {
        let rows = SparseRows::from_triplets(rows, 3, entries).expect("finite");
        only_direction(&rows, DEPENDENCE_TOLERANCE)
    };
    let entries = [
        (0, 0, 2.0),
        (0, 1, -1.0),
        (1, 1, 1.0),
        (1, 2, 4.0),
        (2, 2, 1.0),
    ];
    let found = of(2, &entries[..4]).expect("one");
    let sign = found[1].signum();
    assert!(
        (found[0] * sign - 0.5).abs() < 1e-15 && found[1] * sign == 1.0,
        "{found:?}"
    );
    assert!((found[2] * sign + 0.25).abs() < 1e-15, "{found:?}");
    assert_eq!(of(3, &entries), Err(0));
    assert_eq!(of(1, &entries[..2]), Err(2));
}

fn report(matrix: &Matrix) -> RankReport {
    let rows = SparseRows::from_triplets(matrix.rows, matrix.columns, &matrix.entries).unwrap();
    independent_rows(&rows, DEPENDENCE_TOLERANCE)
}

/// Each dependent row equals its combination of rows kept before it.
fn check_combinations(dense: &[f64], columns: usize, report: &RankReport) {
    for dependent in &report.dependent {
        let mut row = dense[dependent.row * columns..][..columns].to_vec();
        for &(other, factor) in &dependent.combination {
            assert!(other < dependent.row && report.independent.contains(&other));
            for (value, entry) in row.iter_mut().zip(&dense[other * columns..][..columns]) {
                *value -= factor * entry;
            }
        }
        let left = row.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        assert!(
            left < 1e-6,
            "row {} is off by {left} from {:?}",
            dependent.row,
            dependent.combination
        );
    }
}

proptest! {
    #[test]
    fn linkages_agree_with_singular_values(bodies in 1usize..10, loops in 0usize..9, seed in any::<u64>()) {
        let mut random = Random(seed);
        let (bodies, pins) = linkage::random_linkage(bodies, loops, &mut random);
        let matrix = linkage::jacobian(bodies, &pins, &[0]);
        let svd = svd_rank(&Dense::new(matrix.rows, matrix.columns, matrix.dense()), 1e-9).unwrap();
        // Leave out what is doubtful by itself.
        prop_assume!(svd.singular_values[svd.rank - 1] > 1e-5);
        let report = report(&matrix);
        prop_assert_eq!(report.rank, svd.rank);
        prop_assert_eq!(report.independent.len() + report.dependent.len(), matrix.rows);
        prop_assert!(report.largest_dropped < 1e-11, "{}", report.largest_dropped);
        check_combinations(&matrix.dense(), matrix.columns, &report);

        // Rows kept are the greedy choice: each raises the rank of those before it.
        for &row in &report.independent {
            let rank = |rows: usize| {
                let head = Dense::new(rows, matrix.columns, matrix.dense()[..rows * matrix.columns].to_vec());
                svd_rank(&head, 1e-9).unwrap().rank
            };
            prop_assert_eq!(rank(row + 1), rank(row) + 1);
        }
    }

    #[test]
    fn nearly_dependent_rows_fall_on_the_right_side(seed in any::<u64>(), exponent in prop_oneof![3..8i32, 11..16i32]) {
        // Row 2 is the sum of rows 0 and 1 but for 10^-exponent; near 10^-9 either verdict would do.
        let mut random = Random(seed);
        let mut dense: Vec<f64> = (0..15).map(|_| 1.5 + random.signed()).collect();
        dense[1] += 3.0;
        for column in 0..5 {
            let bend = if column == 4 { 10f64.powi(-exponent) } else { 0.0 };
            dense[10 + column] = (dense[column] + dense[5 + column]) * (1.0 + bend);
        }
        let rows = SparseRows::from_dense(3, 5, &dense).unwrap();
        let report = independent_rows(&rows, DEPENDENCE_TOLERANCE);
        prop_assert_eq!(report.rank, if exponent < 9 { 3 } else { 2 }, "{:?}", report);
    }
}

#[test]
fn second_of_two_pins_is_named_with_the_first() {
    let (bodies, mut pins) = linkage::four_bar_chain(2, 0.9);
    let again = pins[3];
    pins.push(again);
    let report = report(&linkage::jacobian(bodies, &pins, &[]));
    let twice = 2 * (pins.len() - 1);
    let named: Vec<_> = report
        .dependent
        .iter()
        .map(|d| (d.row, d.combination.clone()))
        .collect();
    assert_eq!(named.len(), 2);
    for (number, (row, combination)) in named.iter().enumerate() {
        assert_eq!(*row, twice + number);
        assert!(
            combination.len() == 1 && combination[0].0 == 6 + number,
            "{combination:?}"
        );
        assert!((combination[0].1 - 1.0).abs() < 1e-12);
    }
}

#[test]
fn aligned_links_and_a_second_driver_are_found() {
    let (bodies, pins) = linkage::four_bar_chain(3, 0.0);
    let aligned = linkage::jacobian(bodies, &pins, &[]);
    let flat = report(&aligned);
    assert!(flat.rank < aligned.rows);
    check_combinations(&aligned.dense(), aligned.columns, &flat);

    // One degree of freedom, two drivers: the second is the culprit, the first has a share.
    let (bodies, pins) = linkage::four_bar_chain(1, 0.9);
    let driven = linkage::jacobian(bodies, &pins, &[0, 2]);
    let report = report(&driven);
    assert_eq!(
        report.dependent.iter().map(|d| d.row).collect::<Vec<_>>(),
        [driven.rows - 1]
    );
    assert!(
        report.dependent[0]
            .combination
            .iter()
            .any(|&(row, _)| row == driven.rows - 2)
    );
}

#[test]
fn zero_rows_and_bad_entries() {
    let report = independent_rows(
        &SparseRows::from_dense(2, 2, &[0.0, 0.0, 0.0, 3.0]).unwrap(),
        1e-9,
    );
    assert_eq!(
        report.dependent,
        [Dependent {
            row: 0,
            ratio: 0.0,
            combination: vec![]
        }]
    );
    assert_eq!((report.rank, report.smallest_kept), (1, 1.0));
    assert_eq!(
        independent_rows(&SparseRows::from_dense(0, 2, &[]).unwrap(), 1e-9).rank,
        0
    );
    assert_eq!(
        SparseRows::from_dense(1, 2, &[0.0, f64::NAN]).unwrap_err(),
        BadEntry { row: 0, column: 1 }
    );
    assert!(SparseRows::from_triplets(1, 1, &[(0, 1, 1.0)]).is_err());
    let pattern = Pattern::new(2, vec![0, 2], vec![0, 1]).unwrap();
    assert_eq!(
        SparseRows::from_pattern(&pattern, &[1.0, f64::NAN]).unwrap_err(),
        BadEntry { row: 1, column: 0 }
    );
}

#[test]
fn long_chain_and_grid_stay_sparse() {
    for (name, (bodies, pins)) in [
        ("chain", linkage::four_bar_chain(1000, 0.8)),
        ("grid", linkage::grid(16)),
    ] {
        let matrix = linkage::jacobian(bodies, &pins, &[]);
        let rows = SparseRows::from_triplets(matrix.rows, matrix.columns, &matrix.entries).unwrap();
        let mut elimination = Elimination::new(&rows);
        let begin = std::time::Instant::now();
        let mut smallest = f64::INFINITY;
        for row in 0..rows.rows() {
            smallest = smallest.min(elimination.eliminate(row));
            elimination.keep();
        }
        let fill = elimination.lower.entries.len() + elimination.upper.entries.len();
        println!(
            "{name}: {} rows, {fill} entries, smallest {smallest:e}, {:?}",
            matrix.rows,
            begin.elapsed()
        );
        assert!(
            smallest > 1e-6 && fill < 40 * matrix.entries.len(),
            "{smallest} {fill}"
        );
    }
}

#[test]
fn an_open_chain_fills_nothing() {
    let bodies = LARGE / 3 + 1;
    let end = |body: Option<usize>, side: f64| {
        let angle = 0.1 * body.unwrap_or(0) as f64;
        (body, [side * angle.cos(), side * angle.sin()])
    };
    let pin = |k: usize| (end(k.checked_sub(1), 0.4), end(Some(k), -0.4));
    let mut pins: Vec<_> = (0..bodies).map(pin).collect();
    let of = |pins: &[_]| {
        let matrix = linkage::jacobian(bodies, pins, &[]);
        SparseRows::from_triplets(matrix.rows, matrix.columns, &matrix.entries).unwrap()
    };
    let rows = of(&pins);
    let (elimination, report) = decide(&rows, DEPENDENCE_TOLERANCE);
    let fill = elimination.lower.entries.len() + elimination.upper.entries.len();
    assert!(fill < rows.values.len(), "{fill}");
    assert!(report.dependent.is_empty() && report.free_columns.len() == bodies);

    // What says something again is still found, and the earlier one stays.
    pins.push(pins[3]);
    let report = decide(&of(&pins), DEPENDENCE_TOLERANCE).1;
    let named = report.dependent.iter().map(|dependent| {
        let combination = dependent.combination.iter();
        (
            dependent.row,
            combination.map(|one| one.0).collect::<Vec<_>>(),
        )
    });
    let named: Vec<_> = named.collect();
    assert_eq!(named, [(2 * bodies, vec![6]), (2 * bodies + 1, vec![7])]);
}

#[test]
fn what_is_left_of_a_weak_row_makes_no_dependent_row_independent() {
    // Row 1 is row 0 and a ten-thousandth of row 2 less row 3, but for rounding in the last column.
    let dense = [
        1.0, 0.0, 0.0, 0.0, 1.0, 1e-4, 0.0, 1e-12, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0,
    ];
    let report = independent_rows(
        &SparseRows::from_dense(4, 4, &dense).unwrap(),
        DEPENDENCE_TOLERANCE,
    );
    assert_eq!((report.rank, report.free_columns), (3, vec![3]));
    assert_eq!(report.dependent[0].row, 1);
    let shares = &report.dependent[0].combination;
    assert!(
        shares.len() == 3
            && shares.iter().map(|s| s.0).eq([0, 2, 3])
            && (shares[1].1 - 1e-4).abs() < 1e-15,
        "{shares:?}"
    );

    // Where nothing but the order is in question, the earliest rows stay.
    let dense = [1.0, 0.0, 0.0, 1.0, 1e-4, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let report = independent_rows(
        &SparseRows::from_dense(4, 3, &dense).unwrap(),
        DEPENDENCE_TOLERANCE,
    );
    assert_eq!(
        (report.independent, report.dependent[0].row),
        (vec![0, 1, 3], 2)
    );
}
