//! Laws and limits of joints with clearance in contact dynamics: closed forms of an impact, what is conserved, the energy
//! ledger, the ideal joint as the clearance vanishes, the same mechanism told otherwise, and what is refused.

mod balances;
mod bearings;
mod forms;
mod limits;
mod otherwise;

use crate::mechanisms::{column, loaded};
use crate::models;
use crate::transform::{mirror, rename_and_reverse, renamed, rotate, swap, turned};
use linkdyn_engine::analysis::{Control, Outcome, run};
use linkdyn_model::{Model, load};
use linkdyn_output::{Episode, Status};
use serde_json::{Value, json};

const SLIDER_CRANK: &str = include_str!("../../../validation/slider-crank-clearance/model.json");

#[track_caller]
fn solve(model: &Model) -> Outcome {
    let outcome =
        run(&models::checked(model), &Control::default()).unwrap_or_else(|said| panic!("{said:?}"));
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    outcome
}

#[track_caller]
fn completed(model: &Value) -> Outcome {
    solve(&loaded(model).model)
}

/// The slider-crank of the validation case with some values set.
#[track_caller]
fn slider_crank(sets: &[&str]) -> Model {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_string()).collect();
    load(SLIDER_CRANK.as_bytes(), &sets)
        .unwrap_or_else(|said| panic!("{said:?}"))
        .model
        .into_model()
}

fn episodes(outcome: &Outcome) -> Vec<Episode> {
    outcome
        .report
        .events
        .iter()
        .filter_map(|event| event.episode)
        .collect()
}

/// A disc of 1 kg in a bearing of the ground: radial clearance 10 mm, bearing radius 50 mm, no gravity.
fn journal(
    normal: Value,
    friction: Value,
    initial: Value,
    end: f64,
    outputs: usize,
    rtol: f64,
) -> Value {
    json!({ "format": "linkdyn/1", "units": "SI",
        "bodies": { "ground": { "points": { "O": [0.0, 0.0] } },
            "disc": { "mass": 1.0, "inertia": 1e-3, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] } } },
        "joints": { "pin": { "type": "revolute", "between": ["ground.O", "disc.P"],
            "clearance": { "model": "contact", "radius": 0.01, "bearing_radius": 0.05,
                           "normal": normal, "friction": friction } } },
        "initial": { "disc": initial },
        "analysis": { "type": "dynamics", "end": end, "outputs": outputs, "solver": { "rtol": rtol } } })
}

fn lankarani(restitution: f64) -> Value {
    json!({ "law": "lankarani_nikravesh", "stiffness": 1e9, "restitution": restitution })
}

fn none() -> Value {
    json!({ "law": "none" })
}

/// A pair of steel cylinders and a disc, with the penetration under a force as its authors print it.
mod cylinders {
    use std::f64::consts::PI;

    pub const LAWS: [&str; 4] = ["johnson", "radzimovsky", "dubowsky_freudenstein", "pereira"];
    pub const BEARING: f64 = 0.01;
    pub const CLEARANCE: f64 = 2e-4;
    pub const LENGTH: f64 = 0.02;
    /// h_b + h_j [1/Pa].
    const FLEXIBILITY: f64 = 2.0 * (1.0 - 0.09) / 207e9;

    /// δ(F) [m].
    pub fn penetration(law: &str, force: f64) -> f64 {
        let (modulus, journal) = (1.0 / FLEXIBILITY, BEARING - CLEARANCE);
        let f = force / LENGTH;
        match law {
            "johnson" => f / (PI * modulus) * ((4.0 * PI * modulus * CLEARANCE / f).ln() - 1.0),
            "radzimovsky" => {
                let b = 1.6 * (f * BEARING * journal / (CLEARANCE * modulus)).sqrt();
                f / (PI * modulus)
                    * (2.0 / 3.0 + (4.0 * BEARING / b).ln() + (4.0 * journal / b).ln())
            }
            "dubowsky_freudenstein" => {
                let h = FLEXIBILITY / PI;
                f * h * ((LENGTH.powi(3) * CLEARANCE / (force * BEARING * journal * h)).ln() + 1.0)
            }
            // In millimetres and newtons; 0.2 mm is below 0.34954 mm.
            _ => {
                let (gap, length, modulus) = (0.2_f64, 20.0, 1e-6 * modulus);
                let exponent = 1.51 * (1000.0 * gap).ln().powf(-0.151) * gap.powf(-0.005);
                let stiffness = (0.965 * gap + 0.0965) * length * modulus / gap;
                1e-3 * (force / stiffness).powf(1.0 / exponent)
            }
        }
    }

    /// ∫F dδ = F δ − ∫δ dF up to a force [J], by Simpson's rule in s, f = F s³.
    pub fn energy(law: &str, force: f64) -> f64 {
        const STEPS: usize = 1000;
        let integrand = |k: usize| {
            let s = k as f64 / STEPS as f64;
            let slope = 3.0 * force * s * s;
            if k == 0 {
                0.0
            } else {
                penetration(law, force * s.powi(3)) * slope
            }
        };
        let weight = |k: usize| {
            if k == 0 || k == STEPS {
                1.0
            } else {
                2.0 + 2.0 * (k % 2) as f64
            }
        };
        let area =
            (0..=STEPS).map(|k| weight(k) * integrand(k)).sum::<f64>() / (3.0 * STEPS as f64);
        force * penetration(law, force) - area
    }

    /// The force at which that much energy is stored [N], by bisection.
    pub fn force_of(law: &str, energy: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        while self::energy(law, high) < energy {
            high *= 2.0;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self::energy(law, middle) < energy {
                low = middle
            } else {
                high = middle
            }
        }
        low
    }
}

/// A disc of 1 kg in such a bearing.
fn cylinder(
    law: &str,
    restitution: f64,
    gravity: f64,
    initial: Value,
    end: f64,
    rtol: f64,
) -> Value {
    let steel = json!({ "young_modulus": 207e9, "poisson_ratio": 0.3 });
    let normal = json!({ "law": law, "restitution": restitution, "elastic": steel });
    let mut model = journal(normal, none(), initial, end, 21, rtol);
    let clearance = &mut model["joints"]["pin"]["clearance"];
    clearance["radius"] = json!(cylinders::CLEARANCE);
    clearance["bearing_radius"] = json!(cylinders::BEARING);
    clearance["axial_length"] = json!(cylinders::LENGTH);
    model["gravity"] = json!([0.0, -gravity]);
    model
}
