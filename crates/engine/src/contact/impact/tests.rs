//! Impacts against closed forms, small steps of the impulse, and what must hold at every point.

use super::*;

const SENSES: [Sense; 3] = [Sense::Energetic, Sense::Kinetic, Sense::Kinematic];

fn near(found: f64, wanted: f64, scale: f64) {
    assert!((found - wanted).abs() <= 1e-13 * scale, "{found} {wanted}");
}

/// W, v, e, μ.
type Start = ([[f64; 2]; 2], [f64; 2], f64, f64);

/// Points of many kinds: W from eigenvalues and a turn, velocities, e and μ.
fn points() -> Vec<Start> {
    let mut points = Vec::new();
    for (small, turn) in [
        (0.05, 0.3),
        (0.05, 0.9),
        (0.3, 1.2),
        (1.0, 0.0),
        (0.02, -0.6),
        (0.5, 2.5),
    ] {
        let (sin, cos) = f64::sin_cos(turn);
        let coupling = (1.0 - small) * sin * cos;
        let mass = [
            [cos * cos + small * sin * sin, coupling],
            [coupling, sin * sin + small * cos * cos],
        ];
        for v_t in [0.0, 0.2, -0.2, 1.0, -1.0, 6.0, -6.0] {
            for (restitution, friction) in
                [(0.0, 0.3), (0.5, 0.1), (0.5, 0.9), (0.8, 3.0), (1.0, 0.5)]
            {
                points.push((mass, [-1.0, v_t], restitution, friction));
            }
        }
    }
    points
}

#[test]
fn without_friction_the_closed_form() {
    for (mass, velocity, restitution, _) in points() {
        for sense in SENSES {
            let found = resolve(mass, velocity, restitution, 0.0, sense);
            let impulse = (1.0 + restitution) / mass[0][0];
            near(found.impulse[0], impulse, impulse);
            assert_eq!(found.impulse[1], 0.0);
            near(found.velocity[0], restitution, 1.0);
            near(
                found.velocity[1],
                velocity[1] + mass[1][0] * impulse,
                10.0 * impulse,
            );
            near(
                found.loss,
                0.5 * (1.0 - restitution * restitution) / mass[0][0],
                impulse,
            );
        }
    }
}

/// A disc on a plane: m_nt = 0, m_tt = 3 m_nn. It rolls off if |v_t| < 3μ(1 + e)|v_n|, with two thirds of v_t kept
/// by the centre: p_t = −v_t/m_tt; it slides on with p_t = −μ p_n if not.
#[test]
fn a_disc_rolls_off_or_slides_on() {
    let mass = [[0.5, 0.0], [0.0, 1.5]];
    for (v_t, slip, tangential) in [
        (2.0, Slip::Stops, -2.0 / 1.5),
        (-2.0, Slip::Stops, 2.0 / 1.5),
        (3.0, Slip::Continues, -0.4 * 3.6),
    ] {
        for sense in SENSES {
            let found = resolve(mass, [-1.0, v_t], 0.8, 0.4, sense);
            assert_eq!((found.slip, found.wedged), (slip, false));
            near(found.impulse[0], 3.6, 4.0);
            near(found.impulse[1], tangential, 4.0);
            near(found.velocity[0], 0.8, 1.0);
            near(found.velocity[1], v_t + 1.5 * tangential, 4.0);
        }
    }
}

/// A uniform rod of mass m falls on its end, θ from the horizontal: m_nn = (1 + 3c²)/m, m_tt = (1 + 3s²)/m,
/// m_nt = 3sc/m, det W = 4/m². Without slip p_n = (1 + e) m v (1 + 3s²)/4 and the loss is (1 − e²) of ½ m v²(1 + 3s²)/4.
#[test]
fn a_falling_rod_sticks() {
    let (mass, speed, restitution) = (2.0, 1.5, 0.6);
    let (sin, cos) = f64::sin_cos(1.1);
    let lever = 1.0 + 3.0 * sin * sin;
    let coupling = 3.0 * sin * cos / mass;
    let inverse = [
        [(1.0 + 3.0 * cos * cos) / mass, coupling],
        [coupling, lever / mass],
    ];
    for sense in SENSES {
        let found = resolve(inverse, [-speed, 0.0], restitution, 0.5, sense);
        let impulse = (1.0 + restitution) * mass * speed * lever / 4.0;
        assert_eq!((found.slip, found.velocity[1]), (Slip::Sticks, 0.0));
        near(found.impulse[0], impulse, impulse);
        near(
            found.impulse[1],
            -impulse * 3.0 * sin * cos / lever,
            impulse,
        );
        near(found.velocity[0], restitution * speed, speed);
        near(
            found.loss,
            (1.0 - restitution * restitution) * 0.125 * mass * speed * speed * lever,
            10.0,
        );
        // with too little friction the end slides off at once
        assert_eq!(
            resolve(inverse, [-speed, 0.0], restitution, 0.2, sense).slip,
            Slip::Starts
        );
    }
}

#[test]
fn velocities_and_loss_belong_to_the_impulses() {
    for (mass, velocity, restitution, friction) in points() {
        for sense in SENSES {
            let Impulse {
                impulse,
                velocity: after,
                loss,
                wedged,
                ..
            } = resolve(mass, velocity, restitution, friction, sense);
            assert!(!wedged);
            let scale = impulse[0] + impulse[1].abs() + 10.0;
            let mut gain = 0.0;
            for k in 0..2 {
                let change = mass[k][0] * impulse[0] + mass[k][1] * impulse[1];
                near(after[k], velocity[k] + change, scale);
                // change of ½ vᵀ W⁻¹ v = mean velocity times impulse
                gain += 0.5 * (velocity[k] + after[k]) * impulse[k];
            }
            near(loss, -gain, 10.0 * scale);
            assert!(impulse[1].abs() <= friction * impulse[0] * (1.0 + 1e-13));
        }
    }
}

#[test]
fn the_energetic_sense_never_gains_and_the_kinematic_one_does() {
    let mut least = [f64::INFINITY; 3];
    for (mass, velocity, restitution, friction) in points() {
        for (least, sense) in least.iter_mut().zip(SENSES) {
            let found = resolve(mass, velocity, restitution, friction, sense);
            *least = least.min(found.loss);
            if sense == Sense::Energetic {
                assert!(
                    found.loss >= -1e-13 && found.velocity[0] >= 0.0,
                    "{found:?}"
                );
            }
        }
    }
    assert!(least[2] < -1e-3, "{least:?}");
}

/// The same by small steps of the normal impulse, with nothing but the law of friction in them.
fn by_steps(
    mass: [[f64; 2]; 2],
    start: [f64; 2],
    restitution: f64,
    friction: f64,
    step: f64,
) -> [f64; 2] {
    let [mut v_n, mut v_t] = start;
    let mut impulse = [0.0, 0.0];
    let (mut gone_in, mut come_back) = (0.0, 0.0);
    loop {
        // what would stop the point within the step, as far as friction goes
        let bound = friction * step;
        let tangential = (-(v_t + mass[0][1] * step) / mass[1][1]).clamp(-bound, bound);
        let next = v_n + mass[0][0] * step + mass[0][1] * tangential;
        let work = 0.5 * (v_n + next) * step;
        if work < 0.0 {
            gone_in -= work
        } else {
            come_back += work
        }
        if come_back > restitution * restitution * gone_in && v_n >= 0.0 {
            return impulse;
        }
        v_t += mass[0][1] * step + mass[1][1] * tangential;
        v_n = next;
        impulse = [impulse[0] + step, impulse[1] + tangential];
    }
}

#[test]
fn small_steps_of_the_impulse_give_the_same() {
    let mut slips = Vec::new();
    for (mass, velocity, restitution, friction) in points() {
        let found = resolve(mass, velocity, restitution, friction, Sense::Energetic);
        let step = found.impulse[0] / 20_000.0;
        let impulse = by_steps(mass, velocity, restitution, friction, step);
        for (ours, theirs) in found.impulse.into_iter().zip(impulse) {
            // one step of the end, one of the stop, one of the end of compression; each times the larger μ
            let off = (ours - theirs).abs();
            assert!(
                off < 4.0 * step * (1.0 + friction),
                "{mass:?} {velocity:?} {restitution} {friction}: {off:e}"
            );
        }
        if !slips.contains(&found.slip) {
            slips.push(found.slip);
        }
    }
    assert_eq!(slips.len(), 5, "{slips:?}");
}

/// Without approach a jam is an impact all the same, the limit of one with a vanishing approach; without a jam there is none.
#[test]
fn a_jam_needs_no_approach() {
    let mass = [[0.2, 0.5], [0.5, 1.5]];
    let found = resolve(mass, [0.0, 2.0], 0.5, 1.0, Sense::Energetic);
    assert_eq!((found.slip, found.wedged), (Slip::Stops, false));
    // Sliding stops at p = 2 with v_n = −0.3·2; the rate of v_n is 1/30 from there, and the work until p_c = 2 + 0.6·30
    // is 0.5·0.6·2 + 0.5·0.6·18, of which a quarter comes back.
    near(
        found.velocity[0],
        (2.0 / 30.0 * 0.25 * (0.6 + 5.4_f64)).sqrt(),
        1.0,
    );
    assert_eq!(found.velocity[1], 0.0);
    let limit = resolve(mass, [-1e-9, 2.0], 0.5, 1.0, Sense::Energetic);
    assert!(
        (limit.impulse[0] - found.impulse[0]).abs() < 1e-7,
        "{limit:?} {found:?}"
    );
    for velocity in [[0.0, -2.0], [1e-9, 2.0], [0.0, 0.0]] {
        assert_eq!(
            resolve(mass, velocity, 0.5, 1.0, Sense::Energetic).impulse,
            [0.0; 2],
            "{velocity:?}"
        );
    }
}

#[test]
fn a_jam_ends_by_sticking() {
    // μ m_nt > m_nn: the rod's end digs in.
    let mass = [[0.2, 0.5], [0.5, 1.5]];
    let found = resolve(mass, [-1.0, 2.0], 0.5, 1.0, Sense::Energetic);
    assert_eq!((found.slip, found.wedged), (Slip::Stops, false));
    let impulse = by_steps(mass, [-1.0, 2.0], 0.5, 1.0, found.impulse[0] / 1e5);
    assert!(
        (impulse[0] / found.impulse[0] - 1.0).abs() < 1e-4,
        "{impulse:?} {found:?}"
    );
    // sliding stops at p = 2/1 with v_n = −1 − 0.3·2, p_c = 2 + 1.6/(0.2 − 0.25/1.5)
    near(
        found.impulse[1],
        -2.0 - (found.impulse[0] - 2.0) / 3.0,
        100.0,
    );
    let kinetic = resolve(mass, [-1.0, 2.0], 0.5, 1.0, Sense::Kinetic);
    near(kinetic.impulse[0], 1.5 * (2.0 + 1.6 * 30.0), 1e3);
}

/// Points at random, W down to determinants of 1e-12 of its trace squared, μ up to 100.
#[test]
fn no_point_gains_energy_or_goes_on_approaching() {
    let mut seed = 7_u64;
    let mut random = || {
        // an LCG by Knuth; its upper bits
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut slips = [0; 5];
    for _ in 0..20_000 {
        let small = 10_f64.powf(-12.0 * random());
        let (sin, cos) = f64::sin_cos(std::f64::consts::PI * random());
        let coupling = (1.0 - small) * sin * cos;
        let mass = [
            [cos * cos + small * sin * sin, coupling],
            [coupling, sin * sin + small * cos * cos],
        ];
        let velocity = [-1.0, 4.0 * random() - 2.0];
        let (restitution, friction) = (random(), 10_f64.powf(6.0 * random() - 4.0));
        let found = resolve(mass, velocity, restitution, friction, Sense::Energetic);
        let said = format!("{mass:?} {velocity:?} {restitution} {friction}: {found:?}");
        assert!(
            found
                .impulse
                .iter()
                .chain(&found.velocity)
                .all(|value| value.is_finite()),
            "{said}"
        );
        let size = 1.0 + found.impulse[0] + found.impulse[1].abs();
        assert!(
            found.loss >= -1e-12 * size && found.impulse[0] >= 0.0,
            "{said}"
        );
        assert!(found.wedged || found.velocity[0] >= 0.0, "{said}");
        assert!(!found.wedged || small < 1e-11, "{said}");
        assert!(
            found.impulse[1].abs() <= friction * found.impulse[0] * (1.0 + 1e-12),
            "{said}"
        );
        for (k, after) in found.velocity.into_iter().enumerate() {
            let change = mass[k][0] * found.impulse[0] + mass[k][1] * found.impulse[1];
            assert!(
                (after - velocity[k] - change).abs() <= 1e-13 * size,
                "{said}"
            );
        }
        slips[found.slip as usize] += 1;
    }
    assert!(
        slips[Slip::Continues as usize] > 1000 && slips[Slip::Stops as usize] > 1000,
        "{slips:?}"
    );
    assert!(slips[Slip::Reverses as usize] > 1000, "{slips:?}");
}

#[test]
fn special_cases_have_an_end() {
    for sense in SENSES {
        // parting already
        let found = resolve([[1.0, 0.2], [0.2, 1.0]], [0.1, 3.0], 0.5, 0.3, sense);
        assert_eq!(
            (found.impulse, found.velocity, found.loss),
            ([0.0; 2], [0.1, 3.0], 0.0)
        );
        // nothing can part them
        assert!(resolve([[0.0; 2]; 2], [-1.0, 1.0], 0.5, 0.3, sense).wedged);
        assert!(resolve([[1.0, 1.0], [1.0, 1.0]], [-1.0, 0.0], 0.5, 1.5, sense).wedged);
        assert!(resolve([[1.0, 1.0], [1.0, 1.0]], [-1.0, 0.5], 0.5, 1.5, sense).wedged);
        // the tangential velocity is prescribed: friction acts and changes nothing
        for v_t in [0.0, 2.0] {
            let found = resolve([[2.0, 0.0], [0.0, 0.0]], [-1.0, v_t], 0.5, 0.3, sense);
            near(found.impulse[0], 0.75, 1.0);
            near(
                found.impulse[1],
                -0.3 * 0.75 * if v_t > 0.0 { 1.0 } else { 0.0 },
                1.0,
            );
            assert_eq!((found.velocity[1], found.wedged), (v_t, false));
        }
        // tiny and huge
        for speed in [1e-200, 1e-8, 1e100] {
            let found = resolve(
                [[0.3, 0.5], [0.5, 1.5]],
                [-speed, 0.4 * speed],
                0.5,
                0.3,
                sense,
            );
            assert!(
                !found.wedged && found.velocity.iter().all(|v| v.is_finite()),
                "{speed} {found:?}"
            );
            assert!(found.velocity[0] >= 0.0, "{speed} {found:?}");
        }
    }
}
