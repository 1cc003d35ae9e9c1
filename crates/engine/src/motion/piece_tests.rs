use super::rise::{Segment, Shape, sequence};
use super::rise_tests::{SHAPES, ramps, segment};
use super::*;

fn laws() -> Vec<Pieces> {
    let points = [[0.0, 0.0], [0.2, 0.1], [0.5, 1.0], [1.1, 1.0], [1.5, 0.0]];
    let round = [
        segment(Shape::ModifiedSine, 2.0, 0.4),
        Segment {
            shape: None,
            height: 0.0,
            duration: 0.1,
        },
        segment(ramps(0.3, 0.0), -1.5, 0.5),
        segment(ramps(0.4, 0.5), 1.0, 0.3),
    ];
    let mut laws: Vec<Pieces> = SHAPES
        .into_iter()
        .map(|shape| sequence(0.3, 0.1, &[segment(shape, -1.7, 0.9)], 1))
        .collect();
    laws.push(sequence(-1.0, 0.05, &round, 3));
    laws.push(Pieces::linear(&points));
    laws.push(Pieces::monotone(&points));
    laws.push(Pieces::periodic(&points));
    laws
}

#[test]
fn derivatives_are_those_of_the_value_away_from_breaks() {
    let mut seen = 0;
    for law in laws() {
        for k in 0..200 {
            let t = -0.3 + 0.0213 * f64::from(k);
            let h = 1e-5;
            if law.next_break(t - h).is_some_and(|next| next <= t + h) {
                continue;
            }
            let (low, [_, v, a], high) = (law.jet(t - h), law.jet(t), law.jet(t + h));
            let by_difference = [
                (high[0] - low[0]) / (2.0 * h),
                (high[1] - low[1]) / (2.0 * h),
            ];
            // h² f⁗/6, and round-off of f/h
            assert!((by_difference[0] - v).abs() < 3e-7, "{law:?} at {t}");
            assert!((by_difference[1] - a).abs() < 2e-5, "{law:?} at {t}");
            seen += 1;
        }
    }
    assert!(seen > 2000, "{seen}");
}

/// f″ integrated over the pieces between breaks is how much f′ grows, and f′ integrated how far f goes.
#[test]
fn integrals_of_derivatives_give_the_value() {
    // four points of Gauss on each of so many parts
    let gauss = [
        (0.069_431_844_202_973_7, 0.173_927_422_568_727),
        (0.330_009_478_207_572, 0.326_072_577_431_273),
    ];
    for law in laws() {
        let (mut left, mut sums) = (0.02_f64, [0.0; 2]);
        let start = law.jet(left);
        while left < 1.4 {
            // the third derivative of a spline jumps at its points, which are at tenths
            let tenth = ((left * 10.0 + 1e-9).floor() + 1.0) / 10.0;
            let right = law.next_break(left).unwrap_or(1.4).min(tenth).min(1.4);
            const PARTS: usize = 24;
            let h = (right - left) / PARTS as f64;
            for k in 0..PARTS {
                for (x, weight) in gauss {
                    for x in [x, 1.0 - x] {
                        let [_, v, a] = law.jet(left + h * (k as f64 + x));
                        sums[0] += h * weight * v;
                        sums[1] += h * weight * a;
                    }
                }
            }
            left = right;
        }
        let end = law.jet(1.4);
        assert!((start[0] + sums[0] - end[0]).abs() < 1e-10, "{law:?}");
        // of straight lines f′ jumps
        if law != laws()[10] {
            assert!((start[1] + sums[1] - end[1]).abs() < 1e-8, "{law:?}");
        }
    }
}

#[test]
fn a_periodic_table_may_advance() {
    let law = Pieces::periodic(&[[0.0, 0.0], [0.25, 0.3], [1.0, 1.0]]);
    for (t, k) in [(0.1, 3.0), (0.6, -2.0), (0.0, 5.0)] {
        let (here, there) = (law.jet(t), law.jet(t + k));
        assert!((there[0] - here[0] - k).abs() < 1e-14, "{here:?} {there:?}");
        assert!((there[1] - here[1]).abs() < 1e-13 && (there[2] - here[2]).abs() < 1e-12);
    }
    let line = Pieces::periodic(&[[0.0, 2.0], [0.5, 3.0]]);
    assert_eq!(line.jet(1.75), [5.5, 2.0, 0.0]);
    let law = Law::Pieces(law);
    assert!(law.turning_times(100.0).next().is_none());
    assert!(
        (law.invert(7.3, 20.0)
            .map(|t| law.jet(t)[0])
            .expect("passed")
            - 7.3)
            .abs()
            < 1e-12
    );
}

#[test]
fn breaks_and_turns_of_rounds() {
    let dwell = Segment {
        shape: None,
        height: 0.0,
        duration: 0.25,
    };
    let there = segment(Shape::Cycloidal, 1.0, 0.5);
    let back = segment(ramps(0.5, 0.0), -1.0, 0.25);
    let law = Law::Pieces(sequence(0.0, 1.0, &[there, dwell, back], 3));
    let mut breaks = vec![0.0];
    while let Some(next) = law.next_break(breaks[breaks.len() - 1]) {
        breaks.push(next);
    }
    let rounds = [
        1.0, 1.5, 1.75, 1.875, 2.0, 2.5, 2.75, 2.875, 3.0, 3.5, 3.75, 3.875, 4.0,
    ];
    assert_eq!(breaks[1..], rounds);
    let turns: Vec<f64> = law.turning_times(10.0).collect();
    assert_eq!(turns.len(), 5, "{turns:?}");
    for (turn, wanted) in turns.into_iter().zip([1.75, 2.0, 2.75, 3.0, 3.75]) {
        assert!((turn - wanted).abs() < 1e-9, "{turn} {wanted}");
    }
    let first: Vec<f64> = law.turning_times(2.0).collect();
    assert_eq!(first.len(), 1, "{first:?}");
    assert!((law.invert(0.5, 10.0).expect("on the way") - 1.25).abs() < 1e-14);
    assert_eq!(law.rate(0.5), 2.0 * 4.0 * 2.0);
    // one corner after the other, and what a corner is
    let law = Law::Pieces(Pieces::linear(&[[0.0, 0.0], [1.0, 2.0], [2.0, -2.0]]));
    assert_eq!(law.turning_times(9.0).collect::<Vec<_>>(), [1.0]);
    assert_eq!((law.jet(1.0), law.jet(5.0)[0]), ([2.0, -4.0, 0.0], -14.0));
    assert_eq!(
        (law.next_break(0.0), law.next_break(1.0)),
        (Some(1.0), Some(2.0))
    );
}

/// A law at a time is this, to round-off.
fn assert_close(law: &Pieces, t: f64, wanted: [f64; 3]) {
    for (found, wanted) in law.jet(t).into_iter().zip(wanted) {
        let scale = wanted.abs().max(1.0);
        assert!(
            (found - wanted).abs() < 1e-12 * scale,
            "{t}: {found} {wanted}"
        );
    }
}

/// Against CubicSpline of SciPy 1.17 with periodic ends.
#[test]
fn periodic_tables_are_those_of_another_program() {
    let points = [[0.0, 1.0], [0.2, 2.0], [0.5, -0.5], [1.1, 0.25], [1.5, 1.0]];
    let periodic = Pieces::periodic(&points);
    for (t, wanted) in [
        (0.1, [1.660_937_5, 6.220_486_111_111_111, -32.187_5]),
        (
            0.3,
            [
                1.497_376_543_209_876_7,
                -8.488_425_925_925_926,
                -51.157_407_407_407_41,
            ],
        ),
        (
            0.8,
            [-0.885_937_5, 3.272_569_444_444_441, 16.909_722_222_222_214],
        ),
        (
            1.4,
            [
                0.600_520_833_333_333_3,
                2.480_902_777_777_776,
                24.895_833_333_333_32,
            ],
        ),
    ] {
        for period in [-1.5, 0.0, 1.5, 15.0] {
            assert_close(&periodic, t + period, wanted);
        }
    }
    let three = Pieces::periodic(&[[0.0, 0.0], [0.3, 1.0], [1.0, 0.0]]);
    assert_close(
        &three,
        0.1,
        [
            0.301_587_301_587_301_6,
            3.809_523_809_523_81,
            9.523_809_523_809_518,
        ],
    );
    assert_close(
        &three,
        0.7,
        [
            0.346_938_775_510_204_13,
            -2.993_197_278_911_564_4,
            4.081_632_653_061_227,
        ],
    );
}

/// Against PchipInterpolator of SciPy 1.17.
#[test]
fn monotone_tables_are_those_of_another_program() {
    let points = [
        [0.0, 0.0],
        [0.2, 0.1],
        [0.5, 1.0],
        [1.1, 1.0],
        [1.5, 1.6],
        [2.0, 1.2],
    ];
    let monotone = Pieces::monotone(&points);
    for (t, wanted) in [
        (
            0.1,
            [
                0.029_545_454_545_454_55,
                0.545_454_545_454_545_4,
                4.090_909_090_909_09,
            ],
        ),
        (0.3, [0.369_696_969_696_969_6, 4.0, 14.545_454_545_454_554]),
        (0.8, [1.0, 0.0, 0.0]),
        (1.3, [1.3, 2.25, 0.0]),
        (
            1.8,
            [1.490_4, -0.902_666_666_666_667_2, -4.728_888_888_888_891],
        ),
    ] {
        assert_close(&monotone, t, wanted);
    }
}

#[test]
fn a_table_with_velocities_has_the_constant_accelerations_that_it_was_made_of() {
    let accelerations = [3.0, -1.0, 0.0, -2.5];
    let (mut points, mut slopes) = (vec![[0.5, 2.0]], vec![0.25]);
    for (k, a) in accelerations.iter().enumerate() {
        let ([t, f], slope, h) = (points[k], slopes[k], 0.1 + 0.05 * k as f64);
        points.push([t + h, f + slope * h + 0.5 * a * h * h]);
        slopes.push(slope + a * h);
    }
    let law = Pieces::sloped(&points, &slopes);
    for (k, a) in accelerations.iter().enumerate() {
        let h = points[k + 1][0] - points[k][0];
        for part in [0.0, 0.3, 0.9] {
            let [value, slope, bend] = law.jet(points[k][0] + part * h);
            let [t, own] = [part * h, slopes[k]];
            assert!((value - points[k][1] - own * t - 0.5 * a * t * t).abs() < 1e-14);
            assert!((slope - own - a * t).abs() < 1e-13);
            assert!((bend - a).abs() < 1e-11, "{k} {part}: {bend}");
        }
        assert_eq!(law.next_break(points[k][0]), Some(points[k + 1][0]));
    }
}
