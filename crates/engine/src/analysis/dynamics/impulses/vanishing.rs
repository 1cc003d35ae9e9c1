//! Impulses of a time step that goes to zero: they are there where forces are not.
//!
//! ```text
//! z = (p_n, β₊, β₋, λ) of each contact, p_t = β₊ − β₋, v⁺ = v + h a + W p                     (h → 0)
//! −δ̇⁺ ≥ 0            ⟂  p_n ≥ 0
//! λ ± v_t⁺ ≥ 0        ⟂  β± ≥ 0                λ = |v_t⁺| where it slides
//! μ p_n − β₊ − β₋ ≥ 0  ⟂  λ ≥ 0
//! ```
//!
//! Its matrix is copositive, and there is a solution, whatever the friction. Where forces answer the motion p is theirs times h; where they do
//! not, sliding ends or turns round at once by impulses that do not vanish with h. They take energy, p·(v + v⁺)/2 = −Σ μ p_n |v_t⁺| − p·W p/2 with δ̇⁺ = 0.
//!
//! J. J. Moreau, *Unilateral contact and dry friction in finite freedom dynamics*, 1988; D. E. Stewart, J. C. Trinkle, *An implicit time-stepping
//! scheme for rigid body dynamics with inelastic collisions and Coulomb friction*, 1996.

use super::grips::{ContactMode, Grips};
use super::point::at_rest;
use super::touching::{Along, Touching};
use crate::analysis::dynamics::flow::Flow;
use linkdyn_linear::lemke::lemke;
use nalgebra::DMatrix;

/// What h makes of the velocities, in parts of the largest of them: far above their round-off.
const PART: f64 = 1e-7;
/// Unknowns of a contact.
const OWN: usize = 4;
/// Impulses that change velocities by this part of the largest of them at most are none: they vanish with h.
const VANISHES: f64 = 1e-3;

/// These impulses of all contacts that touch, where the mechanism was evaluated with none of them sustained; `None` if they vanish with h.
pub(super) fn vanishing(flow: &Flow, touching: &Touching) -> Option<Vec<[f64; 2]>> {
    let mut velocities = [touching.approaches(flow), touching.slidings(flow)];
    // Where the determinant is all but zero, round-off would be an impulse.
    let rest = at_rest(flow);
    let approaches = velocities[0].iter_mut();
    approaches
        .filter(|rate| rate.abs() <= rest)
        .for_each(|rate| *rate = 0.0);
    let accelerations = [
        touching.approach_accelerations(flow),
        touching.sliding_accelerations(flow),
    ];
    let along = touching.at_rest(flow);
    let grips = Grips::new(touching, &along, [&velocities[0], &velocities[1]]);
    let pushes = left(&grips, &velocities, &accelerations)?;
    (touching.work(flow, &pushes) < 0.0).then_some(pushes)
}

/// The same of contacts with these velocities and accelerations without forces, δ̇ and v_t.
fn left(
    grips: &Grips,
    velocities: &[Vec<f64>; 2],
    accelerations: &[Vec<f64>; 2],
) -> Option<Vec<[f64; 2]>> {
    let fastest = most(velocities);
    let h = PART * fastest / most(accelerations);
    if !h.is_finite() {
        return None;
    }
    let frictions: Vec<f64> = grips.along().iter().map(friction).collect();
    let (matrix, unit) = problem(grips.mass(), &frictions);
    let after = |way: usize, k: usize| velocities[way][k] + h * accelerations[way][k];
    let right: Vec<f64> = (0..frictions.len())
        .flat_map(|k| [-after(0, k), after(1, k), -after(1, k), 0.0])
        .collect();
    let found = lemke(&matrix, &right)?;
    let modes = found.chunks_exact(OWN).zip(&frictions);
    let modes: Vec<ContactMode> = modes.map(|(z, friction)| mode(z, *friction)).collect();
    let pushes = grips.forces(&modes)?;
    let strongest = pushes.iter().flatten();
    let strongest = strongest.fold(0.0, |most: f64, push| most.max(push.abs()));
    (strongest > VANISHES * fastest * unit).then_some(pushes)
}

/// μ.
fn friction(along: &Along) -> f64 {
    match along {
        Along::Slides(ratio) => ratio.abs(),
        Along::Rests(most) => *most,
    }
}

/// M of z, with impulses by the mass that makes velocities of them, and that mass [kg].
fn problem(mass: &DMatrix<f64>, frictions: &[f64]) -> (DMatrix<f64>, f64) {
    let unit = 1.0 / mass.diagonal().amax();
    let size = OWN * frictions.len();
    let matrix = DMatrix::from_fn(size, size, |i, j| {
        let (to, by) = (i / OWN, j / OWN);
        let inverse = |row: usize, column: usize| unit * mass[(2 * to + row, 2 * by + column)];
        match (i % OWN, j % OWN) {
            (0, 0) => inverse(0, 0),
            (0, 1) => inverse(0, 1),
            (0, 2) => -inverse(0, 1),
            (1, 0) => inverse(1, 0),
            (1, 1) | (2, 2) => inverse(1, 1),
            (1, 2) | (2, 1) => -inverse(1, 1),
            (2, 0) => -inverse(1, 0),
            (1 | 2, 3) if to == by => 1.0,
            (3, 0) if to == by => frictions[to],
            (3, 1 | 2) if to == by => -1.0,
            _ => 0.0,
        }
    });
    (matrix, unit)
}

/// What a contact does with this z.
fn mode(found: &[f64], friction: f64) -> ContactMode {
    let (normal, tangential) = (found[0], found[1] - found[2]);
    if normal <= 0.0 {
        ContactMode::Leaves
    } else if friction == 0.0 {
        ContactMode::Slips(0.0)
    } else if found[3] <= 0.0 || (found[1] > 0.0 && found[2] > 0.0) {
        // λ = 0, be its friction at the end of the cone; where there are both β, λ is 0 but for round-off.
        ContactMode::Sticks
    } else {
        ContactMode::Slips(friction * tangential.signum())
    }
}

fn most(values: &[Vec<f64>; 2]) -> f64 {
    values
        .iter()
        .flatten()
        .fold(0.0, |most: f64, value| most.max(value.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Impulses of contacts with these μ, δ̇ = 0, v_t, and accelerations without forces.
    fn impulses(
        mass: &DMatrix<f64>,
        frictions: &[f64],
        slidings: &[f64],
        accelerations: &[Vec<f64>; 2],
    ) -> Option<Vec<[f64; 2]>> {
        let along: Vec<Along> = frictions.iter().map(|most| Along::Rests(*most)).collect();
        let velocities = [vec![0.0; slidings.len()], slidings.to_vec()];
        let grips = Grips::with_mass(mass.clone(), &along, [&velocities[0], &velocities[1]]);
        left(&grips, &velocities, accelerations)
    }

    /// A rod that slides with its tip ahead, W_nn − μ W_nt < 0: its tip stops at once. With less friction forces answer, and nothing is left.
    #[test]
    fn painleves_rod_stops_at_once() {
        let mass = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 5.0]);
        let accelerations = [vec![3.0], vec![0.0]];
        let answer = |friction: f64| impulses(&mass, &[friction], &[1.0], &accelerations);
        let pushes = answer(0.6).expect("impulses where there are no forces");
        // W p = (0, −1)
        assert!((pushes[0][0] - 2.0).abs() < 1e-12 && (pushes[0][1] + 1.0).abs() < 1e-12);
        assert_eq!(answer(0.25), None);
    }

    /// What is left obeys Coulomb's law and takes energy, and is there wherever no forces answer the motion.
    #[test]
    fn what_is_left_is_coulombs_law() {
        let mut seed = 11_u64;
        let mut number = || {
            seed = seed
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (seed >> 33) as f64 / f64::from(1_u32 << 31) * 2.0 - 1.0
        };
        let mut jams = 0;
        for round in 0..4000 {
            let parts = DMatrix::from_fn(6, 6, |_, _| number());
            let mass = &parts * parts.transpose();
            let mut numbers = || [number(), number(), number()];
            let frictions = numbers().map(|x| 2.0 * x.abs());
            let (slidings, accelerations) = (numbers(), [numbers().to_vec(), numbers().to_vec()]);
            let along = [0, 1, 2].map(|k| Along::Slides(-frictions[k] * f64::signum(slidings[k])));
            let forces = [&accelerations[0][..], &accelerations[1]];
            let is_answered = Grips::with_mass(mass.clone(), &along, forces)
                .solve()
                .is_some();
            let left = impulses(&mass, &frictions, &slidings, &accelerations);
            let Some(pushes) = left else {
                assert!(is_answered, "round {round}: nothing answers");
                continue;
            };
            jams += usize::from(!is_answered);
            let pushed = nalgebra::DVector::from_iterator(6, pushes.iter().flatten().copied());
            let changed = &mass * &pushed;
            let even = 1e-5 * (1.0 + mass.amax() * pushed.amax());
            let mut work = 0.0;
            for k in 0..3 {
                let [normal, tangential] = pushes[k];
                let (departs, slides) = (changed[2 * k], slidings[k] + changed[2 * k + 1]);
                let most = frictions[k] * normal;
                assert!(
                    normal >= -even && departs >= -even,
                    "round {round}: {pushes:?}"
                );
                assert!(normal * departs <= even * normal.max(1.0), "round {round}");
                assert!(tangential.abs() <= most + even, "round {round}: {pushes:?}");
                let against = tangential * slides + most * slides.abs();
                assert!(
                    against.abs() <= even * (1.0 + most),
                    "round {round}: {against:e}"
                );
                work += 0.5 * (normal * departs + tangential * (slidings[k] + slides));
            }
            assert!(work < 0.0, "round {round}: {work:e} J");
        }
        assert!(jams > 100, "{jams}");
    }
}
