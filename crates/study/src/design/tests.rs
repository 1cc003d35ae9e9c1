use super::*;
use crate::distribution::Shape;

const METHODS: [Method; 4] = [
    Method::MonteCarlo,
    Method::LatinHypercube,
    Method::Sobol { scrambled: false },
    Method::Sobol { scrambled: true },
];

fn samples(method: Method, layout: Layout, points: u64, columns: usize, seed: u64) -> Samples {
    Samples::new(method, layout, points, columns, seed).expect("legal")
}

fn row(samples: &Samples, number: u64) -> Vec<f64> {
    let mut values = vec![0.0; samples.columns()];
    samples.row(number, &mut values);
    values
}

#[test]
fn the_last_axis_varies_fastest() {
    let axes = vec![
        Axis::Linear {
            from: 40.0,
            to: 60.0,
            count: 3,
        },
        Axis::Listed(vec![5.0, -1.0]),
    ];
    let design = Design::of_grid(Grid::new(axes).expect("legal"));
    assert_eq!((design.rows(), design.columns()), (6, 2));
    let mut values = [0.0; 2];
    let rows = (0..6).map(|number| {
        design.row(number, &mut values);
        values
    });
    let expected = [
        [40.0, 5.0],
        [40.0, -1.0],
        [50.0, 5.0],
        [50.0, -1.0],
        [60.0, 5.0],
        [60.0, -1.0],
    ];
    assert_eq!(rows.collect::<Vec<_>>(), expected);
}

#[test]
fn linear_values_are_round_and_end_exactly() {
    let axis = Axis::Linear {
        from: 0.0,
        to: 1.0,
        count: 11,
    };
    let values: Vec<f64> = (0..11).map(|number| axis.value(number)).collect();
    assert_eq!(
        values,
        [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
    );
}

/// numpy 2.4: `Generator(Philox(key=[20, 0])).random((2, 3))`.
#[test]
fn monte_carlo_is_that_of_numpy() {
    let all = samples(Method::MonteCarlo, Layout::Plain, 2, 3, 20);
    assert_eq!(
        [row(&all, 0), row(&all, 1)],
        [
            [0.8699038499389392, 0.7832635432292622, 0.48428457570197847],
            [0.1765727621827632, 0.7377215250727241, 0.14594781667779222]
        ]
    );
}

/// scipy 1.17: `qmc.Sobol(d, scramble=False, bits=30).random(n)`, the last row of each n.
#[test]
fn sobol_points_are_those_of_scipy() {
    let plain = Method::Sobol { scrambled: false };
    let all = samples(plain, Layout::Plain, 16, 4, 0);
    assert_eq!(row(&all, 0), [0.0; 4]);
    assert_eq!(row(&all, 5), [0.875, 0.875, 0.125, 0.375]);
    assert_eq!(row(&all, 15), [0.0625, 0.9375, 0.5625, 0.3125]);
    // Beyond 2^16, in the last dimension too.
    let all = row(&samples(plain, Layout::Plain, 100_000, 256, 0), 70_001);
    let found = [0, 1, 2, 63, 64, 127, 255].map(|column| all[column]);
    let expected = [
        0.5765609741210938,
        0.6329269409179688,
        0.6198348999023438,
        0.5178298950195312,
        0.07811737060546875,
        0.19281768798828125,
        0.29140472412109375,
    ];
    assert_eq!(found, expected);
}

/// Each box of a (t, m, s)-net keeps its count: scrambling changes digits, not the balance.
#[test]
fn scrambled_points_are_balanced() {
    for scrambled in [false, true] {
        let all = samples(Method::Sobol { scrambled }, Layout::Plain, 1024, 2, 77);
        let mut lines = [[0; 1024]; 2];
        let mut boxes = [0; 1024];
        for number in 0..1024 {
            let point = row(&all, number);
            for (line, u) in lines.iter_mut().zip(&point) {
                line[(u * 1024.0) as usize] += 1;
            }
            boxes[(point[0] * 32.0) as usize * 32 + (point[1] * 32.0) as usize] += 1;
        }
        assert_eq!(lines, [[1; 1024]; 2], "{scrambled}");
        assert_eq!(boxes, [1; 1024], "{scrambled}");
    }
}

/// Π (1 + (e^u − e + 1)/2), whose mean is 1: the error of a mean falls as N^−1.5 scrambled, by theory, and as N^−1 plain.
#[test]
fn errors_of_sobol_means_fall_fast() {
    let mean = |all: &Samples| {
        let sum = (0..all.rows()).map(|number| {
            let factor = |u: &f64| 1.0 + 0.5 * (u.exp() - std::f64::consts::E + 1.0);
            row(all, number).iter().map(factor).product::<f64>()
        });
        sum.sum::<f64>() / all.rows() as f64
    };
    // Root mean square over seeds of the scrambling.
    let error = |scrambled, points| {
        let seeds = if scrambled { 16 } else { 1 };
        let squares = (0..seeds).map(|seed| {
            let all = samples(Method::Sobol { scrambled }, Layout::Plain, points, 4, seed);
            (mean(&all) - 1.0).powi(2)
        });
        (squares.sum::<f64>() / seeds as f64).sqrt()
    };
    for (scrambled, least) in [(false, 0.9), (true, 1.3)] {
        let (few, many) = (error(scrambled, 1 << 7), error(scrambled, 1 << 14));
        let order = (few / many).log2() / 7.0;
        println!("scrambled {scrambled}: {few:.3e} {many:.3e}, order {order:.3}");
        assert!(order > least, "{scrambled}: {few:e} {many:e} {order}");
    }
}

/// Digits that are fixed forever: who changes them changes every study that was ever made.
#[test]
fn digits_are_remembered() {
    let expected = [
        [0.6309765920355875, 0.2709150060341976, 0.8394702225639069],
        [0.34819916433515347, 0.019288972248186383, 0.708410596946604],
        [0.1572265625, 0.9091796875, 0.0810546875],
        [0.0687788324863372, 0.06476628587185118, 0.5919937537994326],
    ];
    for (method, expected) in METHODS.into_iter().zip(expected) {
        let found = row(&samples(method, Layout::Plain, 1000, 3, 42), 999);
        assert_eq!(found, expected, "{method:?} {found:?}");
    }
}

#[test]
fn rows_of_saltelli_change_one_column_each() {
    for method in METHODS {
        let all = samples(method, Layout::Saltelli, 5, 3, 9);
        assert_eq!((all.rows(), all.rows_per_point()), (25, 5));
        for point in 0..5 {
            let rows: Vec<Vec<f64>> = (0..5).map(|part| row(&all, 5 * point + part)).collect();
            let (a, b) = (&rows[0], &rows[4]);
            for changed in 0..3 {
                for column in 0..3 {
                    let from = if column == changed { b } else { a };
                    assert_eq!(rows[changed + 1][column], from[column], "{method:?}");
                }
            }
        }
    }
}

#[test]
fn samples_go_through_distributions_at_each_point_of_a_grid() {
    let grid = Grid::new(vec![Axis::Listed(vec![1.0, 2.0])]).expect("legal");
    let sampled = samples(Method::LatinHypercube, Layout::Plain, 4, 2, 3);
    let all = [(10.0, 12.0), (-1.0, 1.0)]
        .map(|(lower, upper)| Distribution::new(Shape::Uniform, lower, upper).expect("legal"));
    let design = Design::of_samples(grid, sampled.clone(), all.to_vec()).expect("legal");
    assert_eq!((design.rows(), design.columns()), (8, 3));
    let mut values = [0.0; 3];
    design.row(6, &mut values);
    let u = row(&sampled, 2);
    assert_eq!(values[0], 2.0);
    assert!(
        (values[1] - (10.0 + 2.0 * u[0])).abs() < 4e-15,
        "{values:?}"
    );
    assert!((values[2] - (2.0 * u[1] - 1.0)).abs() < 4e-16, "{values:?}");
}

#[test]
fn faults_say_what_is_legal() {
    let linear = |from, to, count| Grid::new(vec![Axis::Linear { from, to, count }]);
    let huge = Axis::Linear {
        from: 0.0,
        to: 1.0,
        count: 1 << 30,
    };
    let sobol = Method::Sobol { scrambled: true };
    let new = |method, layout, points, columns| Samples::new(method, layout, points, columns, 0);
    let faults = [
        (linear(0.0, 1.0, 0).err(), "0 values: give at least 1"),
        (
            linear(0.0, 1.0, 1).err(),
            "1 value from 0.0 to 1.0: give at least 2 values, or the same ends",
        ),
        (linear(f64::NAN, 1.0, 2).err(), "NaN: values must be finite"),
        (
            Grid::new(vec![huge.clone(), huge]).err(),
            "more than 4503599627370496 variants (2^52): give fewer values or samples",
        ),
        (
            new(sobol, Layout::Plain, 0, 2).err(),
            "0 samples: give at least 1",
        ),
        (
            new(sobol, Layout::Plain, 1, 0).err(),
            "samples of nothing: no value has a tolerance or a range",
        ),
        (
            new(sobol, Layout::Saltelli, 1, 129).err(),
            "Sobol points for 258 values: there are at most 256, and indices need two for each value",
        ),
    ];
    for (fault, text) in faults {
        assert_eq!(fault.map(|fault| fault.to_string()), Some(text.to_string()));
    }
}

proptest::proptest! {
    #[test]
    fn each_stratum_has_one_sample(points in 1..700_u64, seed: u64) {
        let all = samples(Method::LatinHypercube, Layout::Plain, points, 2, seed);
        let mut seen = vec![[false; 2]; points as usize];
        for number in 0..points {
            for (column, u) in row(&all, number).into_iter().enumerate() {
                let stratum = &mut seen[(u * points as f64) as usize][column];
                proptest::prop_assert!(!*stratum, "{number} {column} {u}");
                *stratum = true;
            }
        }
    }

    /// Means of 4096 samples: standard error of Monte Carlo 1/√(12·4096) = 0.0045, the others are far better.
    #[test]
    fn samples_fill_the_unit_interval(seed: u64, method in 0..4_usize) {
        let all = samples(METHODS[method], Layout::Plain, 4096, 2, seed);
        let mut sums = [0.0; 2];
        for number in 0..4096 {
            for (sum, u) in sums.iter_mut().zip(row(&all, number)) {
                proptest::prop_assert!((0.0..1.0).contains(&u));
                *sum += u / 4096.0;
            }
        }
        for sum in sums {
            proptest::prop_assert!((sum - 0.5).abs() < 6.0 * 0.0045, "{sum}");
        }
    }
}
