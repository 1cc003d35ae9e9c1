use super::Pieces;
use super::rise::{Limits, Segment, Shape, sequence};
use crate::motion::Law;
use std::f64::consts::{PI, TAU};

pub const SHAPES: [Shape; 9] = [
    Shape::Cycloidal,
    Shape::Polynomial345,
    Shape::Polynomial4567,
    Shape::ModifiedSine,
    Shape::ModifiedTrapezoid,
    ramps(0.3, 0.0),
    ramps(0.5, 0.0),
    ramps(0.4, 0.6),
    ramps(0.5, 1.0),
];

pub const fn ramps(ramp: f64, rounding: f64) -> Shape {
    Shape::Ramps { ramp, rounding }
}

pub fn segment(shape: Shape, height: f64, duration: f64) -> Segment {
    Segment {
        shape: Some(shape),
        height,
        duration,
    }
}

fn unit(shape: Shape) -> Pieces {
    sequence(0.0, 0.0, &[segment(shape, 1.0, 1.0)], 1)
}

/// Peaks of velocity, acceleration and jerk; the jerk from differences of the acceleration, away from its jumps.
fn peaks(law: &Pieces, duration: f64) -> [f64; 3] {
    // 345: the jerk falls by 360 a unit of time from its peak at the beginning, half a step away
    let mut peaks = [0.0_f64; 3];
    const STEPS: usize = 10_000;
    for k in 0..STEPS {
        let t = duration * (k as f64 + 0.5) / STEPS as f64;
        let h = 1e-5 * duration;
        let [_, v, a] = law.jet(t);
        let jerk = match law.next_break(t - h) {
            Some(next) if next < t + h => 0.0,
            _ => (law.jet(t + h)[2] - law.jet(t - h)[2]) / (2.0 * h),
        };
        for (peak, now) in peaks.iter_mut().zip([v, a, jerk]) {
            *peak = peak.max(now.abs());
        }
    }
    peaks
}

/// VDI 2143, sheet 1 (1980), and Norton (2009), table 3-2: half a unit of the last published digit, and what a peak between two
/// of the points that are looked at is higher than both.
#[test]
fn peaks_are_the_published_factors() {
    let published = [
        (SHAPES[0], [2.0, TAU, 39.5], [5e-4, 5e-4, 5e-2]),
        (SHAPES[1], [1.875, 5.773, 60.0], [5e-4, 1e-3, 2e-2]),
        (SHAPES[2], [2.1875, 7.513, 52.5], [5e-5, 5e-4, 1e-2]),
        (SHAPES[3], [1.760, 5.528, 69.47], [5e-4, 5e-4, 5e-3]),
        (SHAPES[4], [2.0, 4.888, 61.43], [5e-4, 5e-4, 5e-3]),
    ];
    for (shape, factors, within) in published {
        let found = peaks(&unit(shape), 1.0);
        for k in 0..3 {
            assert!(
                (found[k] - factors[k]).abs() <= within[k],
                "{shape:?}: {found:?} against {factors:?}"
            );
        }
    }
    // in closed form: Cv = 1/(1 − r), Ca = Cv/(r(1 − ϱ/2)), Cj = 2 Ca/(ϱ r)
    for (r, rounding) in [(0.3, 0.0), (0.5, 0.0), (0.4, 0.6), (0.25, 1.0)] {
        let [v, a, j] = peaks(&unit(ramps(r, rounding)), 1.0);
        let speed = 1.0 / (1.0 - r);
        let acceleration = speed / (r * (1.0 - 0.5 * rounding));
        // half a step beside the tip of a triangle
        let within = 1e-6 * speed + 5e-5 * acceleration;
        assert!((v - speed).abs() < within, "{r} {rounding}: {v}");
        assert!(
            (a - acceleration).abs() < 1e-3 * acceleration,
            "{r} {rounding}: {a}"
        );
        if rounding > 0.0 {
            let jerk = 2.0 * acceleration / (rounding * r);
            assert!((j - jerk).abs() < 1e-6 * jerk, "{r} {rounding}: {j}");
        }
    }
}

/// The modified trapezoid and the modified sine once more, from what defines them: two integrals of the acceleration.
#[test]
fn modified_laws_are_integrals_of_their_accelerations() {
    let trapezoid = |z: f64| match z {
        z if z < 0.125 => (4.0 * PI * z).sin(),
        z if z < 0.375 => 1.0,
        z => -(4.0 * PI * z).sin(),
    };
    let sine = |z: f64| match z {
        z if z < 0.125 => (4.0 * PI * z).sin(),
        z => ((PI + 4.0 * PI * z) / 3.0).sin(),
    };
    let cases: [(Shape, &dyn Fn(f64) -> f64); 2] = [
        (Shape::ModifiedTrapezoid, &trapezoid),
        (Shape::ModifiedSine, &sine),
    ];
    for (shape, acceleration) in cases {
        // Simpson's rule; its parts end where the acceleration has corners
        const PARTS: usize = 800;
        let h = 0.5 / PARTS as f64;
        let (mut v, mut s) = (0.0, 0.0);
        let mut rows = vec![(0.0, 0.0, 0.0)];
        for k in 0..PARTS {
            let z = k as f64 * h;
            let a = [0.0, 0.25, 0.5, 0.75, 1.0].map(|part| acceleration(z + part * h));
            let half = v + h / 12.0 * (a[0] + 4.0 * a[1] + a[2]);
            let end = v + h / 6.0 * (a[0] + 4.0 * a[2] + a[4]);
            s += h / 6.0 * (v + 4.0 * half + end);
            v = end;
            rows.push((z + h, v, s));
        }
        let factor = 0.5 / s;
        let law = unit(shape);
        for (z, v, s) in rows {
            let [f, speed, _] = law.jet(z);
            assert!((f - factor * s).abs() < 1e-11, "{shape:?} at {z}: {f}");
            assert!(
                (speed - factor * v).abs() < 1e-9,
                "{shape:?} at {z}: {speed}"
            );
            // the acceleration is that of the limit from above
            if z < 0.4999 && (z * 8.0).fract() != 0.0 {
                let a = law.jet(z)[2];
                assert!(
                    (a - factor * acceleration(z)).abs() < 1e-9,
                    "{shape:?} at {z}: {a}"
                );
            }
        }
    }
}

#[test]
fn rises_dwell_exactly_before_and_after() {
    for shape in SHAPES {
        let law = sequence(0.3, 0.1, &[segment(shape, -1.7, 0.9)], 1);
        for t in [-5.0, 0.0, 0.099] {
            assert_eq!(law.jet(t), [0.3, 0.0, 0.0], "{shape:?} at {t}");
        }
        for t in [1.0, 1.1, 7.0] {
            assert_eq!(law.jet(t), [0.3 - 1.7, 0.0, 0.0], "{shape:?} at {t}");
        }
        // both halves are alike
        for z in [0.01, 0.2, 0.44] {
            let (first, second) = (law.jet(0.1 + 0.9 * z), law.jet(0.1 + 0.9 * (1.0 - z)));
            assert!(
                (first[0] + second[0] - (0.6 - 1.7)).abs() < 1e-14,
                "{shape:?}"
            );
            assert!((first[1] - second[1]).abs() < 1e-12, "{shape:?}");
        }
    }
}

/// Biagiotti and Melchiorri (2008), ch. 3: the four cases of an s-curve, and both of a trapezoid.
#[test]
fn limits_are_reached_and_kept() {
    let cases = [
        // (h, v, a, j), the duration, which limits are reached
        (
            (10.0, 5.0, 10.0, 30.0),
            2.0 + 0.5 + 1.0 / 3.0,
            [true, true, true],
        ),
        (
            (10.0, 1.0, 10.0, 30.0),
            10.0 + 2.0 * (1.0_f64 / 30.0).sqrt(),
            [true, false, true],
        ),
        (
            (4.0, 5.0, 3.0, 30.0),
            2.0 * (0.05 + (0.0025_f64 + 4.0 / 3.0).sqrt()),
            [false, true, true],
        ),
        (
            (0.4, 5.0, 10.0, 30.0),
            4.0 * (0.2_f64 / 30.0).cbrt(),
            [false, false, true],
        ),
        ((10.0, 2.0, 1.0, f64::NAN), 7.0, [true, true, false]),
        ((1.0, 2.0, 1.0, f64::NAN), 2.0, [false, true, false]),
    ];
    for ((height, velocity, acceleration, jerk), duration, reached) in cases {
        for sign in [1.0, -1.0] {
            let limits = Limits {
                velocity,
                acceleration,
                jerk: Some(jerk).filter(|jerk| !jerk.is_nan()),
            };
            let fastest = limits.fastest(sign * height);
            assert!(
                (fastest.duration - duration).abs() < 1e-12 * duration,
                "{limits:?}: {} against {duration}",
                fastest.duration
            );
            let law = sequence(0.0, 0.0, &[fastest], 1);
            assert_eq!(law.jet(duration + 1.0), [sign * height, 0.0, 0.0]);
            let found = peaks(&law, duration);
            for (k, most) in [velocity, acceleration, jerk].into_iter().enumerate() {
                let part = found[k] / most;
                assert!(part.is_nan() || part < 1.0 + 1e-6, "{limits:?}: {found:?}");
                // the peak of an acceleration that is reached in a point is between two that are looked at
                assert_eq!(part > 1.0 - 2e-3, reached[k], "{limits:?}: {found:?}");
            }
        }
    }
    let still = Limits {
        velocity: 1.0,
        acceleration: 1.0,
        jerk: Some(1.0),
    };
    let law = sequence(0.5, 0.0, &[still.fastest(0.0)], 1);
    assert_eq!(law.jet(0.3), [0.5, 0.0, 0.0]);
    assert!(Law::Pieces(law).is_constant());
}
