use super::*;
use std::ops::Range;

/// s_i = μ_i |λ_i|, one row each.
struct Coulomb(Vec<f64>);

impl Laws for Coulomb {
    fn rows(&self, force: usize) -> Range<usize> {
        force..force + 1
    }

    fn size(&self, force: usize, lambda: &[f64], slope: &mut [f64]) -> f64 {
        slope[0] = self.0[force]
            * if lambda[0] == 0.0 {
                0.0
            } else {
                lambda[0].signum()
            };
        self.0[force] * lambda[0].abs()
    }

    fn are_straight(&self) -> bool {
        false
    }
}

/// s_i = μ_i λ_i, with or without saying that it is straight.
struct Straight(Vec<f64>, bool);

impl Laws for Straight {
    fn rows(&self, force: usize) -> Range<usize> {
        force..force + 1
    }

    fn size(&self, force: usize, lambda: &[f64], slope: &mut [f64]) -> f64 {
        slope[0] = self.0[force];
        self.0[force] * lambda[0]
    }

    fn are_straight(&self) -> bool {
        self.1
    }
}

fn find(laws: &[f64], responses: &[f64], free: &[f64]) -> (Result<(), Failure>, Vec<f64>, f64) {
    find_with(&Coulomb(laws.to_vec()), responses, free)
}

fn find_with(
    laws: &impl Laws,
    responses: &[f64],
    free: &[f64],
) -> (Result<(), Failure>, Vec<f64>, f64) {
    let k = free.len();
    let cells = |count: usize| vec![0.0; count];
    let mut forces = DependentForces {
        m: k,
        lu: SmallLu::new(k),
        responses: responses.to_vec(),
        sizes: cells(k),
        kept: cells(k),
        before: cells(k),
        residual: cells(k),
        slopes: cells(k * ROWS),
        matrix: cells(k * k),
        work: cells(k * k),
        ..DependentForces::default()
    };
    let found = forces.find(free, laws);
    (found, forces.sizes.clone(), forces.margin)
}

/// λ = a + b T, T = μ|λ|: T = μ a/(1 − μ b) while μ b < 1, for a > 0.
#[test]
fn one_force_by_hand_up_to_where_it_locks() {
    for (mu, b) in [
        (0.1, 2.0),
        (0.4, 2.0),
        (0.499, 2.0),
        (0.3, -1.0),
        (5.0, -1.0),
        (0.3, 0.0),
        (-0.3, 2.0),
    ] {
        let (found, sizes, margin) = find(&[mu], &[b], &[7.0]);
        assert_eq!(found, Ok(()), "{mu} {b}");
        let wanted = mu * 7.0 / (1.0 - mu * b);
        assert!(
            (sizes[0] - wanted).abs() < 1e-12 * wanted.abs(),
            "{mu} {b}: {sizes:?} {wanted}"
        );
        assert!((margin - (1.0 - mu * b)).abs() < 1e-12, "{margin}");
    }
    for (mu, b) in [(0.5, 2.0), (0.501, 2.0), (3.0, 2.0), (-3.0, -2.0)] {
        assert_eq!(
            find(&[mu], &[b], &[7.0]).0,
            Err(Failure::Locked { force: 0 }),
            "{mu} {b}"
        );
    }
    assert_eq!(find(&[0.3], &[2.0], &[0.0]).1, [0.0]);
}

/// Of two solutions the one that goes on from the mechanism without friction: λ = a + b T with μ b = −3 has T = μ a/4
/// and, with λ < 0, T = −μ a/(1 − 3).
#[test]
fn of_two_solutions_the_one_that_began_without_friction() {
    let (found, sizes, _) = find(&[1.5], &[-2.0], &[8.0]);
    assert_eq!((found, sizes), (Ok(()), vec![3.0]));
}

/// Three forces that press on each other: the plain fixed point, iterated long.
#[test]
fn several_forces_as_the_plain_fixed_point_finds_them() {
    let (laws, free) = ([0.2, -0.3, 0.25], [5.0, -4.0, 0.3]);
    let responses = [0.5, -0.8, 0.9, -0.4, 1.0, 0.3, 0.7, -0.2, -0.9];
    let (found, sizes, margin) = find(&laws, &responses, &free);
    assert_eq!(found, Ok(()));
    let mut t = [0.0_f64; 3];
    for _ in 0..200 {
        let lambda: Vec<f64> = (0..3)
            .map(|i| free[i] + (0..3).map(|j| responses[3 * j + i] * t[j]).sum::<f64>())
            .collect();
        (0..3).for_each(|i| t[i] = laws[i] * lambda[i].abs());
    }
    assert!(
        sizes.iter().zip(t).all(|(a, b)| (a - b).abs() < 1e-13),
        "{sizes:?} {t:?}"
    );
    assert!(margin > 0.5 && margin < 2.0);
}

/// Two that lift each other up: each alone is harmless, together they lock where μ² b² reaches 1.
#[test]
fn two_that_feed_each_other_lock_together() {
    let responses = [0.0, 4.0, 4.0, 0.0];
    let (found, sizes, _) = find(&[0.2, 0.2], &responses, &[1.0, 1.0]);
    assert_eq!(found, Ok(()));
    assert!((sizes[0] - 1.0).abs() < 1e-12, "{sizes:?}");
    for mu in [0.25, 0.26, 0.6, 3.0] {
        let found = find(&[mu, mu], &responses, &[1.0, 1.0]).0;
        assert!(matches!(found, Err(Failure::Locked { .. })), "{mu}");
    }
}

/// Straight laws have their solution at once, and lock where those that are followed from none do.
#[test]
fn straight_laws_need_not_be_followed() {
    let mut seed = 3_u64;
    let mut number = || {
        seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (seed >> 33) as f64 / f64::from(1_u32 << 31) * 2.0 - 1.0
    };
    let mut locked = 0;
    for round in 0..2000 {
        let mut numbers = |count: usize| (0..count).map(|_| number()).collect::<Vec<f64>>();
        let (laws, responses, free) = (numbers(3), numbers(9), numbers(3));
        let responses: Vec<f64> = responses.iter().map(|response| 4.0 * response).collect();
        let [at_once, followed] = [true, false]
            .map(|straight| find_with(&Straight(laws.clone(), straight), &responses, &free));
        assert_eq!(at_once.0, followed.0, "round {round}");
        if at_once.0.is_err() {
            locked += 1;
            continue;
        }
        let most = followed
            .1
            .iter()
            .fold(0.0, |most: f64, size| most.max(size.abs()));
        for (one, other) in at_once.1.iter().zip(&followed.1) {
            assert!(
                (one - other).abs() < 1e-9 * most,
                "round {round}: {one} {other}"
            );
        }
        assert!((at_once.2 - followed.2).abs() < 1e-9, "round {round}");
    }
    assert!(locked > 100 && locked < 1900, "{locked}");
}
