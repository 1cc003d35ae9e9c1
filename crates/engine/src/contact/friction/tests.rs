use super::*;

const DECAY: Decay = Decay {
    kinetic: 0.1,
    r#static: 0.15,
    velocity: 0.03,
    exponent: 2.0,
};

fn laws() -> [Law; 8] {
    let slow = Decay {
        exponent: 0.5,
        ..DECAY
    };
    [
        Law::None,
        Law::Coulomb {
            coefficient: 0.3,
            threshold: 0.01,
        },
        Law::Ambrosio {
            coefficient: 0.3,
            lower: 0.002,
            upper: 0.012,
        },
        Law::Threlfall {
            coefficient: 0.3,
            threshold: 0.01,
        },
        Law::Stribeck {
            decay: DECAY,
            threshold: 0.01,
            viscous: 0.4,
        },
        Law::Stribeck {
            decay: slow,
            threshold: 0.01,
            viscous: 0.0,
        },
        Law::Lugre {
            decay: DECAY,
            stiffness: 1e5,
            damping: 300.0,
            viscous: 0.4,
        },
        Law::Lugre {
            decay: slow,
            stiffness: 1e4,
            damping: 0.0,
            viscous: 0.0,
        },
    ]
}

#[test]
fn derivatives_are_those_of_the_force() {
    let mut compared = 0;
    for law in laws() {
        for speed in [1e-4, 1e-3, 3e-3, 8e-3, 0.02, 0.2] {
            for sliding in [speed, -speed] {
                for (normal, bristle) in [(0.0, 0.0), (250.0, 4e-7), (250.0, -9e-7)] {
                    let value = law.force(sliding, normal, bristle);
                    let (dv, dn, dz) = (1e-5 * speed, 1e-3, 1e-9);
                    let force = |v: f64, n: f64, z: f64| {
                        law.force(sliding + v, normal + n, bristle + z).force
                    };
                    let of = |plus: f64, minus: f64, by: f64| (plus - minus) / (2.0 * by);
                    let numeric = [
                        of(force(dv, 0.0, 0.0), force(-dv, 0.0, 0.0), dv),
                        of(force(0.0, dn, 0.0), force(0.0, -dn, 0.0), dn),
                        of(force(0.0, 0.0, dz), force(0.0, 0.0, -dz), dz),
                    ];
                    let ours = [value.d_sliding, value.d_normal, value.d_bristle];
                    let scales = [normal / speed, 1.0, normal / 1e-6];
                    for k in 0..3 {
                        let off = (numeric[k] - ours[k]).abs();
                        assert!(
                            off <= 1e-8 * scales[k] + 1e-12,
                            "{law:?} v {sliding} z {bristle} {k}: {off:e}"
                        );
                        compared += 1;
                    }
                }
            }
        }
    }
    assert_eq!(compared, 8 * 12 * 9);
}

#[test]
fn pieces_agree_with_the_law_within_their_bounds() {
    for law in laws() {
        for sliding in [-0.3, -0.011, -0.005, -1e-3, 1e-9, 1e-3, 5e-3, 0.011, 0.3] {
            let piece = law.piece(sliding);
            let (low, up) = law.bounds(piece);
            assert!(
                low <= sliding && sliding <= up,
                "{law:?} {sliding}: {low} {up}"
            );
            let (whole, part) = (
                law.force(sliding, 7.0, 1e-7),
                law.on_piece(piece, sliding, 7.0, 1e-7),
            );
            assert!(
                (whole.force - part.force).abs() < 1e-14,
                "{law:?} {sliding}: {whole:?} {part:?}"
            );
            assert_eq!(whole.bristle_rate, part.bristle_rate, "{law:?} {sliding}");
        }
    }
}

#[test]
fn friction_is_odd_and_against_the_motion() {
    for law in laws() {
        for speed in [1e-5, 5e-3, 0.015, 1.0] {
            let (forth, back) = (law.force(speed, 10.0, 1e-7), law.force(-speed, 10.0, -1e-7));
            assert_eq!(forth.force, -back.force, "{law:?}");
            assert_eq!(
                (forth.d_sliding, forth.d_bristle),
                (back.d_sliding, back.d_bristle),
                "{law:?}"
            );
            assert!(forth.force <= 0.0, "{law:?}");
        }
        let rest = law.force(0.0, 10.0, 0.0);
        assert_eq!((rest.force, rest.bristle_rate), (0.0, 0.0), "{law:?}");
        let fast = law.force(1e300, 1.0, 0.0);
        assert!(
            !fast.force.is_nan() && !fast.d_sliding.is_nan(),
            "{law:?} {fast:?}"
        );
    }
}

/// Coulomb's force beyond its threshold, half of it halfway; Ambrósio's ramp; Threlfall's plateau; Stribeck's at v_s.
#[test]
fn forces_by_hand() {
    let force = |law: Law, sliding: f64| -law.force(sliding, 100.0, 0.0).force;
    let [_, coulomb, ambrosio, threlfall, stribeck, ..] = laws();
    let close = |found: f64, wanted: f64| {
        assert!((found - wanted).abs() < 1e-12 * wanted, "{found} {wanted}")
    };
    close(force(coulomb, 0.02), 30.0);
    close(force(coulomb, 0.005), 15.0);
    close(force(ambrosio, 0.007), 15.0);
    assert_eq!(force(ambrosio, 0.0019), 0.0);
    close(force(threlfall, 1.0), 30.0 * (1.0 - (-3.0_f64).exp()));
    close(force(threlfall, 0.01), force(threlfall, 1.0));
    close(
        force(stribeck, 0.03),
        100.0 * (0.1 + 0.05 / std::f64::consts::E + 0.4 * 0.03),
    );
    close(
        force(stribeck, 0.006),
        60.0 * (0.1 + 0.05 * (-0.04_f64).exp() + 0.4 * 0.006),
    );
}

#[test]
fn the_slope_jumps_at_the_kinks_and_nowhere_else() {
    for law in laws() {
        let kinks: Vec<f64> = law.kinks().collect();
        let rate = |speed: f64| law.force(speed, 1.0, 1e-7).bristle_rate;
        let slope = |speed: f64| match law.has_bristle() {
            true => (rate(speed + 1e-10) - rate(speed)) / 1e-10,
            false => law.force(speed, 1.0, 1e-7).d_sliding,
        };
        for kink in &kinks {
            let (below, above) = (slope(kink - 1e-9), slope(kink + 1e-9));
            assert!(
                (below - above).abs() > 1e-3 * below.abs().max(above.abs()),
                "{law:?} {kink}: {below} {above}"
            );
        }
        // Beyond 1e-3, where slow decays are steep.
        for step in 10..400 {
            let speed = f64::from(step) * 1e-4;
            let (below, above) = (slope(speed - 3e-9), slope(speed + 3e-9));
            if kinks.iter().all(|kink| (kink - speed).abs() > 1e-6) {
                assert!(
                    (below - above).abs() < 1e-3 * (1.0 + below.abs()),
                    "{law:?} {speed}"
                );
            }
        }
    }
}

/// At a constant velocity the bristles' deflection tends to g/σ₀ and the force to that of steady sliding.
#[test]
fn bristles_settle_at_the_force_of_steady_sliding() {
    let law = Law::Lugre {
        decay: DECAY,
        stiffness: 1e5,
        damping: 300.0,
        viscous: 0.4,
    };
    let (sliding, normal, step) = (-0.03, 100.0, 2e-6);
    let mut bristle = 0.0;
    for _ in 0..1000 {
        bristle += step * law.force(sliding, normal, bristle).bristle_rate;
    }
    let most = 0.1 + 0.05 / std::f64::consts::E;
    let value = law.force(sliding, normal, bristle);
    assert!((bristle / (-most / 1e5) - 1.0).abs() < 1e-12, "{bristle:e}");
    assert!(
        (value.force / (normal * (most + 0.4 * 0.03)) - 1.0).abs() < 1e-12,
        "{value:?}"
    );
}
