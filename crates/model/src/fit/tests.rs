//! Against limits as published in ISO 286-2:2010.

use super::*;

/// Lower and upper deviation of the hole, then of the shaft, and the fit.
const PUBLISHED: [(&str, [f64; 4]); 30] = [
    ("20 H7/g6", [0.0, 21.0, -20.0, -7.0]),
    ("20 H7/h6", [0.0, 21.0, -13.0, 0.0]),
    ("20 H8/f7", [0.0, 33.0, -41.0, -20.0]),
    ("20 H7/k6", [0.0, 21.0, 2.0, 15.0]),
    ("20 H7/n6", [0.0, 21.0, 15.0, 28.0]),
    ("20 H7/p6", [0.0, 21.0, 22.0, 35.0]),
    ("20 H11/c11", [0.0, 130.0, -240.0, -110.0]),
    ("20 H9/d9", [0.0, 52.0, -117.0, -65.0]),
    ("20 H8/e8", [0.0, 33.0, -73.0, -40.0]),
    ("20 JS7/js6", [-10.5, 10.5, -6.5, 6.5]),
    ("20 K7/h6", [-15.0, 6.0, -13.0, 0.0]),
    ("20 M7/h6", [-21.0, 0.0, -13.0, 0.0]),
    ("20 N7/h6", [-28.0, -7.0, -13.0, 0.0]),
    ("20 P7/h6", [-35.0, -14.0, -13.0, 0.0]),
    ("20 N9/h9", [-52.0, 0.0, -52.0, 0.0]),
    ("20 F8/h7", [20.0, 53.0, -21.0, 0.0]),
    ("20 D10/h9", [65.0, 149.0, -52.0, 0.0]),
    ("20 C11/h11", [110.0, 240.0, -130.0, 0.0]),
    ("2 H7/g6", [0.0, 10.0, -8.0, -2.0]),
    ("2 K7/m6", [-10.0, 0.0, 2.0, 8.0]),
    ("2 P7/h6", [-16.0, -6.0, -6.0, 0.0]),
    ("8 K6/m5", [-7.0, 2.0, 6.0, 12.0]),
    ("50 G7/h6", [9.0, 34.0, -16.0, 0.0]),
    ("50 H6/m6", [0.0, 16.0, 9.0, 25.0]),
    ("50 A11/h11", [320.0, 480.0, -160.0, 0.0]),
    ("100 H7/f6", [0.0, 35.0, -58.0, -36.0]),
    ("100 K8/k8", [-38.0, 16.0, 0.0, 54.0]),
    ("300 M6/g5", [-41.0, -9.0, -40.0, -17.0]),
    ("315 B11/b11", [540.0, 860.0, -860.0, -540.0]),
    ("500 H13/a11", [0.0, 970.0, -2050.0, -1650.0]),
];

#[test]
fn limits_are_those_that_are_published() {
    for (text, [a, b, c, d]) in PUBLISHED {
        let fit = Fit::parse(text).unwrap_or_else(|fault| panic!("{text}: {fault}"));
        assert_eq!((fit.hole, fit.shaft), ([a, b], [c, d]), "{text}");
    }
}

#[test]
fn radial_clearance_is_half_of_the_diameters() {
    let fit = Fit::parse("⌀20H7/g6").unwrap();
    assert_eq!(fit.clearance(), [7.0, 41.0]);
    assert_eq!(fit.radial().unwrap(), [3.5e-6, 20.5e-6]);
    let fit = Fit::parse("20 mm H7/h6").unwrap();
    assert_eq!(fit.radial().unwrap(), [0.0, 17e-6]);
}

#[test]
fn ranges_of_sizes_end_with_their_greatest_size() {
    let hole = |text: &str| Fit::parse(text).unwrap().hole[1];
    assert_eq!(
        [hole("18 H7/h6"), hole("18.1 H7/h6"), hole("30 H7/h6")],
        [18.0, 21.0, 21.0]
    );
    let shaft = |text: &str| Fit::parse(text).unwrap().shaft[1];
    assert_eq!(
        [shaft("65 H11/c11"), shaft("65.5 H11/c11")],
        [-140.0, -150.0]
    );
}

#[test]
fn what_is_no_fit_is_refused_by_its_reason() {
    for (text, said) in [
        (
            "H7/g6",
            "this is no fit (as in \"20 H7/g6\": nominal diameter in mm, hole, shaft)",
        ),
        (
            "20 H7",
            "this is no fit (as in \"20 H7/g6\": nominal diameter in mm, hole, shaft)",
        ),
        (
            "20 H/g6",
            "this is no fit (as in \"20 H7/g6\": nominal diameter in mm, hole, shaft)",
        ),
        (
            "20 g6/H7",
            "the hole comes first, with a capital letter (write \"20 H7/g6\")",
        ),
        (
            "20 H7/G6",
            "a hole has a capital letter, a shaft a small one (as in \"20 H7/g6\")",
        ),
        (
            "630 H7/g6",
            "the tables of fits have diameters up to 500 mm, this is 630 mm (give the clearance as \"radius\")",
        ),
        (
            "0 H7/g6",
            "the tables of fits have diameters up to 500 mm, this is 0 mm (give the clearance as \"radius\")",
        ),
        (
            "20 H7/x6",
            "no table here has \"x6\" (the letters: a, b, c, d, e, f, g, h, js, k, m, n, p)",
        ),
        (
            "20 Z7/g6",
            "no table here has \"Z7\" (the letters: A, B, C, D, E, F, G, H, JS, K, M, N, P)",
        ),
        (
            "20 H19/g6",
            "there is no grade 19 of \"H19\" at 20 mm (grades go from 1 to 18)",
        ),
        (
            "1 H14/g6",
            "there is no grade 14 of \"H14\" at 1 mm (grades go from 1 to 13)",
        ),
        (
            "20 K9/h6",
            "there is no \"K9\" at 20 mm (K goes up to grade 8)",
        ),
        (
            "1 A11/h11",
            "\"A11\" is not to be used up to 1 mm (take a letter from c on)",
        ),
    ] {
        assert_eq!(Fit::parse(text).unwrap_err().to_string(), said, "{text}");
    }
    let tight = Fit::parse("20 H7/p6")
        .unwrap()
        .radial()
        .unwrap_err()
        .to_string();
    assert_eq!(
        tight,
        "this fit can be tight: hole 0 to +21 µm, shaft +22 to +35 µm, clearance -35 to -1 µm (a pin that turns needs a clearance, as in \"20 H7/g6\")"
    );
}
