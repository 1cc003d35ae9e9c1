//! How the stored curves were found: one random four-bar, whose points are led along random loops, comes back as another one. This goes
//! on until there are as many as are known to be (Duff et al., Solving polynomial systems via homotopy continuation and monodromy, 2019).

use super::follow::{End, follow, polished};
use super::table::Table;
use super::unknowns::{Displacements, Unknowns, random_points};
use super::{CURVES, cognates, start};
use linkdyn_linear::bilinear::{Number, Random};
use rayon::prelude::*;

/// Loops after which there is nothing new.
const MOST_LOOPS: usize = 200;

/// A random four-bar, and points of its curve.
fn first(random: &mut Random) -> (Unknowns, Displacements) {
    let z: Unknowns = std::array::from_fn(|_| random.turn() + random.turn() * 0.5);
    let [x, xx, a, aa, y, yy, b, bb] = z;
    let points = std::array::from_fn(|_| {
        let turn = random.turn() * 1.3 + random.turn() * 0.4;
        let back = 1.0 / turn;
        // δδ̄ + l δ + m δ̄ + c of both dyads; their difference is linear.
        let of = |x: Number, xx: Number, a: Number, aa: Number| {
            let l = back * xx - aa;
            let m = turn * x - a;
            let c = x * aa + xx * a - turn * x * aa - back * xx * a;
            [l, m, c]
        };
        let ([l, m, c], [l2, m2, c2]) = (of(x, xx, a, aa), of(y, yy, b, bb));
        // δ̄ = −(L δ + C) / M
        let (ll, mm, cc) = (l - l2, m - m2, c - c2);
        let quadratic = [-ll / mm, l - (cc + ll * m) / mm, c - m * cc / mm];
        let root = (quadratic[1] * quadratic[1] - quadratic[0] * quadratic[2] * 4.0).sqrt();
        let d = (root - quadratic[1]) / (quadratic[0] * 2.0);
        [d, -(ll * d + cc) / mm]
    });
    (z, points)
}

/// The curves through [`start`], one four-bar of each, as far as random loops find them; `told` hears after each loop how many there are.
pub fn all_of_random_points(told: &mut dyn FnMut(usize)) -> Vec<Unknowns> {
    let mut random = Random::new(3);
    let base = start();
    let (mut one, mut points) = first(&mut random);
    // To the points that are stored, through others, so that the first path meets no other.
    for to in [random_points(&mut random), base] {
        let End::Root(next) = follow(one, &points, &to) else {
            return Vec::new();
        };
        (one, points) = (next, to);
    }
    let mut table = Table::default();
    table.add(one);
    for _ in 0..MOST_LOOPS {
        let (away, other) = (random_points(&mut random), random_points(&mut random));
        let known: Vec<Unknowns> = table.all();
        // Cognates of one come back as different curves as well.
        let ends: Vec<Unknowns> = known
            .par_iter()
            .flat_map_iter(|one| {
                cognates(one)
                    .into_iter()
                    .take(if known.len() > CURVES / 2 { 1 } else { 3 })
            })
            .filter_map(|one| {
                let mut at = polished(one, &base)?;
                for (from, to) in [(&base, &away), (&away, &other), (&other, &base)] {
                    let End::Root(next) = follow(at, from, to) else {
                        return None;
                    };
                    at = next;
                }
                Some(at)
            })
            .collect();
        for end in ends {
            table.add(end);
        }
        told(table.len());
        if table.len() >= CURVES {
            break;
        }
    }
    table.all()
}
