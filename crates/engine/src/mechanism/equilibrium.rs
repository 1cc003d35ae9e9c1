//! Equilibrium: minimal coordinates at which the forces at rest vanish.
//!
//! ```text
//! g(u) = SᵀQ = 0            K d = g      Newton, K = −∂g/∂u, where K is positive definite
//!                           d = Σ xᵢ (xᵢᵀg)/|κᵢ|   else, with κᵢ, xᵢ of the symmetric part of K
//! ```
//!
//! Both go where the forces do work, so a mechanism that starts beside an unstable equilibrium leaves it, as it would if
//! it were let go in thick oil; one that starts in it stays. A step is shortened until the work over it is not negative,
//! ½ (g₀ + g₁)·d ≥ 0 or |g₁| < |g₀|: that is a descent of energy where there is one, and asks for none.

use super::driven::Failure;
use super::linearised_system::LinearisedSystem;
use linkdyn_linear::eigen::{solve, symmetric};
use linkdyn_linear::math::{dot, max_abs};

/// Longest step, in rad or mechanism sizes, of any coordinate.
const LONGEST_STEP: f64 = 0.25;
/// Forces [J, lengths by the size] that are this small beside the largest force and stiffness are balanced; what then can
/// be gained is gained by polishing.
const BALANCED: f64 = 1e-12;
/// A stiffness this small beside the largest force and stiffness is none.
const INDIFFERENT: f64 = 1e-10;
/// The same beside stops and outlines, which are not to be jumped over.
const BESIDE_STOPS: f64 = 0.02;
/// Halvings of a step that goes beyond a stop: to where it does so by its 10⁻⁶.
const HALVINGS: usize = 20;
/// Part of a step below which it is given up.
const SHORTEST: f64 = 1e-9;
const MAX_ITERATIONS: u64 = 500;
const POLISHING: usize = 3;

/// What a small push does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stability {
    /// The mechanism comes back.
    Stable,
    /// It stays where it is pushed to, in some direction.
    Indifferent,
    /// It leaves.
    Unstable,
}

/// An equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct Balance {
    /// What a small push does.
    pub stability: Stability,
    /// Eigenvalues of the reduced stiffness's symmetric part, ascending [N/m or N·m].
    pub stiffness: Vec<f64>,
    /// Largest force left, relative to the largest force and stiffness [–].
    pub residual: f64,
    /// Steps tried.
    pub iterations: u64,
}

/// Why there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lost {
    /// The search ended without; the pull left, relative to the largest force [–].
    Unbalanced {
        /// The pull left, relative to the largest force [–].
        residual: f64,
    },
    /// The forces pull against a position that can't be passed.
    Blocked,
    /// The way there leads beyond a stop, or into an outline.
    Met,
    /// The position can't be solved any more.
    Failed(Failure),
    /// Told to stop.
    Stopped,
}

/// Pull and stiffness in comparable coordinates (lengths by the size), all in J.
struct Local {
    g: Vec<f64>,
    k: Vec<f64>,
    /// Largest force and stiffness so far.
    scale: f64,
}

impl Local {
    fn of(held: &mut LinearisedSystem, known: f64) -> Self {
        let f = held.freedom();
        let scales: Vec<f64> = (0..f).map(|k| held.scale(k)).collect();
        let g: Vec<f64> = held
            .pull()
            .iter()
            .zip(&scales)
            .map(|(g, s)| g * s)
            .collect();
        let k: Vec<f64> = held
            .stiffness()
            .iter()
            .enumerate()
            .map(|(i, k)| k * scales[i / f] * scales[i % f])
            .collect();
        let system = held.driven.system;
        let largest = held.force.iter().enumerate().fold(0.0, |m: f64, (c, q)| {
            m.max((q * system.column_scale(c)).abs())
        });
        let scale = known.max(largest + max_abs(&k));
        Local { g, k, scale }
    }

    /// Largest pull beside the largest force and stiffness.
    fn residual(&self) -> f64 {
        if self.scale > 0.0 {
            max_abs(&self.g) / self.scale
        } else {
            0.0
        }
    }

    /// A direction in which the forces do work.
    fn direction(&self) -> Vec<f64> {
        let (values, vectors) = symmetric(&self.k, self.g.len());
        let floor = INDIFFERENT * self.scale;
        if values[0] > floor
            && let Some(d) = solve(&self.k, &self.g)
        {
            return d;
        }
        self.spectral(&values, &vectors, |kappa| 1.0 / kappa.abs().max(floor))
    }

    /// Newton's step to the root itself, stable or not, without the directions that nothing holds.
    fn root(&self) -> Vec<f64> {
        let (values, vectors) = symmetric(&self.k, self.g.len());
        let floor = INDIFFERENT * self.scale;
        if values.iter().all(|kappa| kappa.abs() > floor)
            && let Some(d) = solve(&self.k, &self.g)
        {
            return d;
        }
        self.spectral(&values, &vectors, |kappa| {
            if kappa.abs() > floor {
                1.0 / kappa
            } else {
                0.0
            }
        })
    }

    fn spectral(
        &self,
        values: &[f64],
        vectors: &[Vec<f64>],
        weight: impl Fn(f64) -> f64,
    ) -> Vec<f64> {
        let mut d = vec![0.0; self.g.len()];
        for (&kappa, x) in values.iter().zip(vectors) {
            let part = weight(kappa) * dot(x, &self.g);
            d.iter_mut().zip(x).for_each(|(d, x)| *d += part * x);
        }
        d
    }
}

/// Moves the mechanism into equilibrium.
///
/// `depth` says how far it is beyond a stop or inside an outline, where it may meet one; there it does not move, or not farther than it
/// begins.
///
/// # Errors
/// See [`Lost`]; the mechanism is then where the search ended.
pub fn find(
    held: &mut LinearisedSystem,
    stopped: &dyn Fn() -> bool,
    depth: Option<&dyn Fn(&LinearisedSystem) -> f64>,
) -> Result<Balance, Lost> {
    let longest = depth.map_or(LONGEST_STEP, |_| BESIDE_STOPS);
    let allowed = depth.map_or(0.0, |depth| depth(held).max(0.0));
    let mut local = Local::of(held, 0.0);
    let mut iterations = 0;
    while local.residual() > BALANCED {
        if stopped() {
            return Err(Lost::Stopped);
        }
        if iterations == MAX_ITERATIONS {
            return Err(Lost::Unbalanced {
                residual: local.residual(),
            });
        }
        iterations += 1;
        let before = depth.map(|_| held.q.clone());
        step(held, &local, longest)?;
        if let (Some(depth), Some(before)) = (depth, before)
            && depth(held) > allowed
        {
            go_back(held, before, |held| depth(held) > allowed).map_err(Lost::Failed)?;
            return Err(Lost::Met);
        }
        held.exchange().map_err(Lost::Failed)?;
        local = Local::of(held, local.scale);
    }
    for _ in 0..POLISHING {
        let Some(better) = polish(held, &local) else {
            break;
        };
        local = better;
        iterations += 1;
    }
    Ok(balance(held, &local, iterations))
}

/// The mechanism where it is, as if that were an equilibrium.
pub fn judge(held: &mut LinearisedSystem) -> Balance {
    let local = Local::of(held, 0.0);
    balance(held, &local, 0)
}

fn balance(held: &mut LinearisedSystem, local: &Local, iterations: u64) -> Balance {
    let f = held.freedom();
    let lowest = symmetric(&local.k, f).0.first().copied();
    let floor = INDIFFERENT * local.scale;
    let stability = match lowest {
        Some(kappa) if kappa < -floor => Stability::Unstable,
        Some(kappa) if kappa <= floor => Stability::Indifferent,
        Some(_) | None => Stability::Stable,
    };
    let stiffness = symmetric(&held.stiffness(), f).0;
    Balance {
        stability,
        stiffness,
        residual: local.residual(),
        iterations,
    }
}

/// Moves by `part` of the scaled step `d`.
fn advance(held: &mut LinearisedSystem, d: &[f64], part: f64) -> Result<(), Failure> {
    let d: Vec<f64> = d
        .iter()
        .enumerate()
        .map(|(k, d)| part * d * held.scale(k))
        .collect();
    held.advance(&d)
}

fn pull(held: &LinearisedSystem) -> Vec<f64> {
    held.pull()
        .iter()
        .enumerate()
        .map(|(k, g)| g * held.scale(k))
        .collect()
}

/// The largest motion of a coordinate in a scaled step [rad or sizes].
fn extent(held: &LinearisedSystem, d: &[f64]) -> f64 {
    let d: Vec<f64> = d
        .iter()
        .enumerate()
        .map(|(k, d)| d * held.scale(k))
        .collect();
    held.driven.system.scaled_norm(&held.along(&d))
}

/// Goes back from where a step ended to where it was just `inside`, towards where it began.
fn go_back(
    held: &mut LinearisedSystem,
    mut outside: Vec<f64>,
    inside: impl Fn(&LinearisedSystem) -> bool,
) -> Result<(), Failure> {
    let mut end = held.q.clone();
    for _ in 0..HALVINGS {
        let both = outside.iter().zip(&end);
        let middle: Vec<f64> = both.map(|(a, b)| 0.5 * (a + b)).collect();
        held.return_to(&middle)?;
        match inside(held) {
            true => end = middle,
            false => outside = middle,
        }
    }
    held.return_to(&end)
}

/// One step with work that is not negative.
fn step(held: &mut LinearisedSystem, local: &Local, longest: f64) -> Result<(), Lost> {
    let mut d = local.direction();
    let shorten = (longest / extent(held, &d)).min(1.0);
    d.iter_mut().for_each(|d| *d *= shorten);
    let mut part = 1.0;
    let norm = max_abs(&local.g);
    let before = held.q.clone();
    while part > SHORTEST {
        if advance(held, &d, part).is_ok() {
            let g = pull(held);
            if dot(&local.g, &d) + dot(&g, &d) >= 0.0 || max_abs(&g) < norm {
                return Ok(());
            }
            // By a step back or, where that can't be solved from there, to what is known.
            if advance(held, &d, -part).is_err() {
                held.return_to(&before).map_err(Lost::Failed)?;
            }
        }
        part *= 0.5;
    }
    Err(Lost::Blocked)
}

/// One more Newton step, where it brings something.
fn polish(held: &mut LinearisedSystem, local: &Local) -> Option<Local> {
    let d = local.root();
    if extent(held, &d) > LONGEST_STEP || max_abs(&d) == 0.0 {
        return None;
    }
    advance(held, &d, 1.0).ok()?;
    let better = Local::of(held, local.scale);
    if max_abs(&better.g) < 0.5 * max_abs(&local.g) {
        return Some(better);
    }
    // Both are round-off; the one with the smaller pull stays.
    if max_abs(&better.g) > max_abs(&local.g) {
        let _ = advance(held, &d, -1.0);
    }
    None
}
