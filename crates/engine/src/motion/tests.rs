use super::*;

#[test]
fn laws_tell_how_fast_they_move() {
    let polynomial = Law::Polynomial(vec![7.0, -3.0, 8.0]);
    assert_eq!(polynomial.rate(1.0), 4.0);
    assert!((polynomial.rate(0.01) - 300.0).abs() < 1e-12);
    let wave = |amplitude| Law::Harmonic {
        offset: 1.0,
        amplitude,
        frequency: 2.0,
        phase: 0.3,
    };
    assert_eq!((wave(0.5).rate(0.1), wave(0.0).rate(0.1)), (2.0 * TAU, 0.0));
    let table = Law::Spline(Spline::natural(&[[0.0, 1.0], [1.0, 1.5], [3.0, -2.5]]));
    assert_eq!((table.rate(1.0), table.rate(0.5)), (2.0, 4.0));
    assert_eq!(Law::Polynomial(vec![4.0]).rate(1.0), 0.0);
}

fn laws() -> Vec<Law> {
    vec![
        Law::Polynomial(vec![1.0, -2.0, 0.5, 0.25]),
        Law::Harmonic {
            offset: 0.3,
            amplitude: 1.2,
            frequency: 0.7,
            phase: 0.4,
        },
        Law::Spline(Spline::natural(&[
            [0.0, 1.0],
            [0.5, 2.0],
            [1.25, -1.0],
            [2.0, 0.0],
        ])),
    ]
}

#[test]
fn derivatives_are_those_of_the_value() {
    for law in laws() {
        for t in [-0.3, 0.1, 0.49, 0.9, 1.6, 2.5] {
            let h = 1e-4;
            let (lo, mid, hi) = (law.jet(t - h), law.jet(t), law.jet(t + h));
            assert!(
                ((hi[0] - lo[0]) / (2.0 * h) - mid[1]).abs() < 1e-5,
                "{law:?} at {t}"
            );
            assert!(
                ((hi[1] - lo[1]) / (2.0 * h) - mid[2]).abs() < 1e-4,
                "{law:?} at {t}"
            );
        }
    }
}

#[test]
fn spline_passes_its_points_and_repeats_a_straight_line() {
    let points = [[0.0, 1.0], [0.5, 2.0], [1.25, -1.0], [2.0, 0.0]];
    let spline = Spline::natural(&points);
    for [t, f] in points {
        assert!((spline.jet(t)[0] - f).abs() < 1e-14);
    }
    assert!(spline.jet(0.0)[2].abs() < 1e-14 && spline.jet(2.0)[2].abs() < 1e-14);
    let line = Spline::natural(&[[0.0, 1.0], [1.0, 3.0], [4.0, 9.0]]);
    assert!((line.jet(2.2)[0] - 5.4).abs() < 1e-14);
    assert!((line.jet(6.0)[0] - 13.0).abs() < 1e-13);
}

#[test]
fn inverse_finds_the_first_time() {
    let law = Law::Polynomial(vec![-0.5, 0.0, 1.0]);
    for u in [-0.5, -0.499, 0.0, 1.25] {
        let t = law.invert(u, 10.0).expect("reached");
        assert!((t - (u + 0.5_f64).sqrt()).abs() < 1e-12, "{u}: {t}");
    }
    assert!(law.invert(-0.6, 10.0).is_none());
    let wave = Law::Harmonic {
        offset: 0.0,
        amplitude: 2.0,
        frequency: 1.0,
        phase: 0.0,
    };
    assert!((wave.invert(2.0, 5.0).expect("reached") - 0.25).abs() < 1e-7);
    assert!(wave.invert(2.1, 5.0).is_none());
    assert!((wave.invert(1.0, 5.0).expect("reached") - 1.0 / 12.0).abs() < 1e-14);
}

#[test]
fn turning_times_of_a_wave() {
    let wave = Law::Harmonic {
        offset: 0.0,
        amplitude: 2.0,
        frequency: 1.0,
        phase: 0.0,
    };
    let turns: Vec<f64> = wave.turning_times(2.0).collect();
    assert_eq!(turns.len(), 4, "{turns:?}");
    for (turn, want) in turns.iter().zip([0.25, 0.75, 1.25, 1.75]) {
        assert!((turn - want).abs() < 1e-12);
    }
}

/// Ten million periods: only those that are requested are looked for.
#[test]
fn turning_times_of_a_fast_wave_are_those_of_every_period() {
    let wave = Law::Harmonic {
        offset: 0.0,
        amplitude: 2.0,
        frequency: 1e7,
        phase: 0.0,
    };
    for (k, turn) in wave.turning_times(1.0).take(5000).enumerate() {
        let exact = (k as f64 + 0.5) / 2e7;
        assert!(
            (turn - exact).abs() < 1e-9 * exact,
            "turn {k}: {turn} instead of {exact}"
        );
    }
    assert!((wave.invert(1.0, 1.0).expect("reached") * 1e7 - 1.0 / 12.0).abs() < 1e-12);
}

/// Waves of any frequency over any time: the work is bounded, and a wave that does not move has no turning points.
#[test]
fn turning_times_of_every_wave_end() {
    let numbers = [0.0, 5e-324, 1e-320, 1e-308, 1e-9, 0.7, 1e16, 1e300, 1.7e308];
    for amplitude in numbers {
        for frequency in numbers.map(|number| -number).iter().chain(&numbers) {
            for end in numbers {
                for phase in [0.0, -1.0, 1e20, 1.7e308] {
                    let wave = Law::Harmonic {
                        offset: 0.0,
                        amplitude,
                        frequency: *frequency,
                        phase,
                    };
                    let count = wave.turning_times(end).count();
                    assert!(count <= MOST_TURNS, "{wave:?} until {end}: {count}");
                    let is_still = amplitude == 0.0 || *frequency == 0.0 || end == 0.0;
                    assert!(!is_still || count == 0, "{wave:?} until {end}: {count}");
                    assert!(wave.stretches(end).count() <= REPEATS);
                    wave.invert(0.3, end);
                }
            }
        }
    }
}

/// A phase of many turns and a frequency below zero turn back where the value is largest or smallest.
#[test]
fn turning_times_of_waves_are_where_they_are_extreme() {
    for (frequency, phase) in [
        (1.3, 2.9),
        (-1.3, 2.9),
        (0.2, -3.1),
        (-0.2, 41.0),
        (5.0, PI / 2.0),
    ] {
        let wave = Law::Harmonic {
            offset: 1.0,
            amplitude: 2.0,
            frequency,
            phase,
        };
        let turns: Vec<f64> = wave.turning_times(20.0).filter(|&t| t > 1e-9).collect();
        let expected = 40.0 * f64::abs(frequency);
        assert!(
            (turns.len() as f64 - expected).abs() <= 1.0,
            "{wave:?}: {}",
            turns.len()
        );
        for pair in turns.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|t| wave.jet(t)[0] - 1.0);
            assert!(
                a * b < 0.0 && (a.abs() - 2.0).abs() < 1e-12,
                "{wave:?}: {pair:?}"
            );
            assert!((b.abs() - 2.0).abs() < 1e-12, "{wave:?}: {pair:?}");
            assert!(
                (pair[1] - pair[0] - 0.5 / frequency.abs()).abs() < 1e-12,
                "{pair:?}"
            );
        }
    }
}
