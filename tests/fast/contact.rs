//! Laws and limits of joints with clearance in contact dynamics: closed forms of an impact, what is conserved, the energy
//! ledger, the ideal joint as the clearance vanishes, the same mechanism told otherwise, and what is refused.

use crate::mechanisms::{column, loaded};
use crate::models;
use crate::transform::{mirror, rename_and_reverse, renamed, rotate, swap, turned};
use linkdyn_engine::analysis::{Control, Outcome, run};
use linkdyn_model::{Model, load};
use linkdyn_output::{Episode, Status};
use serde_json::{Value, json};

const SLIDER_CRANK: &str = include_str!("../../validation/slider-crank-clearance/model.json");

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

/// m = 1 kg, K = 1e9 N/m^1.5, v₀ = 1 m/s, e = 0.9: the rebound solves χ(1 + e′) = ln((1 + χ)/(1 − χ e′)), and the deepest
/// point follows from the energy of approach, as in the module documentation of the normal laws. The hardest force is a little before the deepest point.
#[test]
fn an_impact_is_that_of_the_closed_form() {
    let start = json!({ "x": 0.00999, "y": 0.0, "vx": 1.0, "vy": 0.0, "angular_velocity": 0.0 });
    let outcome = completed(&journal(lankarani(0.9), none(), start, 1.5e-3, 16, 1e-10));
    let [episode] = episodes(&outcome)[..] else {
        panic!("{:?}", outcome.report.events)
    };
    let end = episode.end.expect("it leaves");
    let chi: f64 = 0.75 * (1.0 - 0.81);
    let deepest = (2.5 * (chi - chi.ln_1p()) / (1e9 * chi * chi)).powf(0.4);
    // On the way in, K δ^2.5/2.5 = ∫ w/(1 + χ w) dw from v to 1, and F = K δ^1.5 (1 + χ v), over all v.
    let taken = |v: f64| v / chi - (chi * v).ln_1p() / (chi * chi);
    let force = |v: f64| 1e9 * (2.5e-9 * (taken(1.0) - taken(v))).powf(0.6) * (1.0 + chi * v);
    let hardest = (0..100_000)
        .map(|k| force(1e-5 * f64::from(k)))
        .fold(0.0, f64::max);
    for (what, ours, exact, relative) in [
        ("start", episode.start, 1e-5, 1e-9),
        ("approach", episode.approach_speed, 1.0, 1e-12),
        (
            "rebound",
            episode.separation_speed.expect("it leaves"),
            0.9131767,
            1e-7,
        ),
        ("duration", end - episode.start, 8.163338e-4, 2e-7),
        ("deepest", episode.peak_penetration, 2.649506e-4, 2e-7),
        (
            "deepest by its formula",
            episode.peak_penetration,
            deepest,
            1e-9,
        ),
        ("peak force", episode.peak_force, hardest, 1e-9),
        ("impulse", episode.impulse, 1.9131767, 1e-7),
        (
            "loss",
            episode.energy_lost,
            0.5 * (1.0 - 0.9131767f64.powi(2)),
            1e-6,
        ),
    ] {
        println!("{what}: {ours:e}, off by {:e}", ours / exact - 1.0);
        assert!(
            (ours / exact - 1.0).abs() < relative,
            "{what}: {ours:e} for {exact:e}"
        );
    }
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

/// A heavy disc is dropped and comes to rest at δ(m g).
#[test]
fn a_disc_rests_where_its_law_says() {
    let gravity = 1000.0;
    for law in cylinders::LAWS {
        let depth = cylinders::penetration(law, gravity);
        let start = json!({ "x": 0.0, "y": 1e-6 - cylinders::CLEARANCE, "vx": 0.0, "vy": 0.0 });
        let outcome = completed(&cylinder(law, 0.3, gravity, start, 0.5, 1e-10));
        let last = |name: &str| *column(&outcome, name).last().expect("a row");
        let ours = last("joint.pin.penetration");
        println!(
            "{law}: {ours:e} for {depth:e}, still {:e} m/s",
            last("disc.vy")
        );
        // What is left of the oscillation, and 10 rtol of the clearance.
        assert!(
            (ours / depth - 1.0).abs() < 1e-8,
            "{law}: {ours:e} for {depth:e}"
        );
        assert!(
            (last("joint.pin.normal_force") / gravity - 1.0).abs() < 1e-8,
            "{law}"
        );
        // At rest from the start it stays.
        let start = json!({ "x": 0.0, "y": -cylinders::CLEARANCE - depth, "vx": 0.0, "vy": 0.0 });
        let outcome = completed(&cylinder(law, 0.3, gravity, start, 0.01, 1e-10));
        let depths = column(&outcome, "joint.pin.penetration");
        let worst = depths
            .iter()
            .map(|ours| (ours / depth - 1.0).abs())
            .fold(0.0, f64::max);
        assert!(worst < 1e-8, "{law}: moves by {worst:e}");
    }
}

/// An impact: m w dw = −F_e (1 + χ w/v) dδ, so that the rebound follows from χ alone, and the deepest point and the hardest force
/// from the energy that the elastic part then holds, m v² G(w) with G = ∫_w^1 s/(1 + χ s) ds.
#[test]
fn a_cylinder_rebounds_as_by_quadrature() {
    let (speed, asked) = (0.5_f64, 0.7_f64);
    let chi = 0.75 * (1.0 - asked * asked);
    let taken = |w: f64| (1.0 - w) / chi - ((1.0 + chi) / (1.0 + chi * w)).ln() / (chi * chi);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let e = 0.5 * (low + high);
        // Of the way out less is given back than was taken.
        if taken(-e) > 0.0 { low = e } else { high = e }
    }
    let rebound = low;
    for law in cylinders::LAWS {
        let start = json!({ "x": 1e-4, "y": 0.0, "vx": speed, "vy": 0.0, "angular_velocity": 0.0 });
        let outcome = completed(&cylinder(law, asked, 0.0, start, 5e-4, 1e-10));
        let [episode] = episodes(&outcome)[..] else {
            panic!("{law}: {:?}", outcome.report.events)
        };
        let energy = |w: f64| speed * speed * taken(w);
        let deepest = cylinders::penetration(law, cylinders::force_of(law, energy(0.0)));
        let force = |w: f64| cylinders::force_of(law, energy(w)) * (1.0 + chi * w);
        // The hardest force comes before the deepest point: by thirds.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..40 {
            let (left, right) = ((2.0 * low + high) / 3.0, (low + 2.0 * high) / 3.0);
            if force(left) < force(right) {
                low = left
            } else {
                high = right
            }
        }
        let hardest = force(low);
        for (what, ours, exact, relative) in [
            (
                "rebound",
                episode.separation_speed.expect("it leaves"),
                rebound * speed,
                1e-8,
            ),
            (
                "loss",
                episode.energy_lost,
                0.5 * speed * speed * (1.0 - rebound * rebound),
                1e-8,
            ),
            ("impulse", episode.impulse, (1.0 + rebound) * speed, 1e-8),
            ("deepest", episode.peak_penetration, deepest, 1e-8),
            ("hardest", episode.peak_force, hardest, 1e-8),
        ] {
            println!("{law}, {what}: {ours:e}, off by {:e}", ours / exact - 1.0);
            assert!(
                (ours / exact - 1.0).abs() < relative,
                "{law}, {what}: {ours:e} for {exact:e}"
            );
        }
    }
}

/// A hundred and more impacts, elastic, damped, and with every law of friction.
#[test]
fn the_energy_ledger_closes_over_a_hundred_impacts() {
    let rtol = 1e-8;
    let spin = json!({ "x": 0.003, "y": 0.0, "vx": 0.6, "vy": 0.8, "angular_velocity": 20.0 });
    let coulomb = json!({ "law": "coulomb", "coefficient": 0.1, "threshold_velocity": 0.01 });
    let hertz = json!({ "law": "hertz", "stiffness": 1e9 });
    for (name, normal, friction, end) in [
        ("elastic", hertz.clone(), none(), 2.2),
        ("damped", lankarani(0.99), none(), 4.0),
        ("elastic with friction", hertz, coulomb.clone(), 2.2),
        ("damped with friction", lankarani(0.99), coulomb, 4.0),
    ] {
        let outcome = completed(&journal(normal, friction, spin.clone(), end, 101, rtol));
        let impacts = episodes(&outcome).len();
        let imbalance = outcome
            .report
            .quality
            .energy_imbalance
            .expect("of contacts");
        println!(
            "{name}: {impacts} impacts, {:.2} rtol missing",
            imbalance / rtol
        );
        assert!(impacts >= 100, "{name}: {impacts}");
        assert!(imbalance <= 10.0 * rtol, "{name}: {imbalance:e}");
    }
}

/// Each law brakes the spinning disc, and never gives back more than its bristles hold.
#[test]
fn every_law_of_friction_dissipates() {
    let rtol = 1e-8;
    let start = json!({ "x": 0.003, "y": 0.0, "vx": 0.6, "vy": 0.8, "angular_velocity": 20.0 });
    let laws = [
        json!({ "law": "none" }),
        json!({ "law": "coulomb", "coefficient": 0.1, "threshold_velocity": 0.01 }),
        json!({ "law": "threlfall", "coefficient": 0.1, "threshold_velocity": 0.01 }),
        json!({ "law": "ambrosio", "coefficient": 0.1, "lower_velocity": 0.001, "upper_velocity": 0.01 }),
        json!({ "law": "stribeck", "coefficient": 0.1, "static_coefficient": 0.15, "stribeck_velocity": 0.05,
                "threshold_velocity": 0.01, "viscous": 0.01 }),
        json!({ "law": "lugre", "coefficient": 0.1, "static_coefficient": 0.15, "stribeck_velocity": 0.05,
                "bristle_stiffness": 1e5, "bristle_damping": 100.0, "viscous": 0.01 }),
    ];
    let mut spins = Vec::new();
    for law in laws {
        let name = law["law"].to_string();
        let outcome = completed(&journal(lankarani(0.8), law, start.clone(), 0.3, 301, rtol));
        let dissipated = column(&outcome, "energy.dissipated");
        let imbalance = outcome
            .report
            .quality
            .energy_imbalance
            .expect("of contacts");
        let spin = *column(&outcome, "disc.omega").last().expect("a row");
        println!(
            "{name}: spin {spin}, {:.1} rtol missing, {} J lost",
            imbalance / rtol,
            dissipated[300]
        );
        assert!(
            dissipated
                .windows(2)
                .all(|pair| pair[1] >= pair[0] - 10.0 * rtol),
            "{name}: {dissipated:?}"
        );
        assert!(imbalance <= 10.0 * rtol, "{name}: {imbalance:e}");
        spins.push(spin);
    }
    assert!(
        spins[0] == 20.0 && spins[1..].iter().all(|spin| *spin < 15.0),
        "{spins:?}"
    );
}

/// A journal and its bearing, both free: linear and angular momentum stay what they are, with friction too.
#[test]
fn two_free_bodies_keep_their_momentum() {
    let mut model = journal(
        lankarani(0.8),
        json!({ "law": "coulomb", "coefficient": 0.2, "threshold_velocity": 0.01 }),
        json!({ "vx": 1.0, "vy": 0.3, "angular_velocity": 30.0 }),
        0.2,
        101,
        1e-8,
    );
    model["bodies"]["ring"] =
        json!({ "mass": 2.0, "inertia": 6e-3, "com": [0.01, 0.0], "points": { "O": [0.0, 0.0] } });
    model["joints"]["pin"]["between"][0] = "ring.O".into();
    model["initial"]["ring"] = json!({ "vx": -0.2, "vy": 0.5, "angular_velocity": -10.0 });
    let outcome = completed(&model);
    assert!(episodes(&outcome).len() > 5);
    let of = |name: &str| column(&outcome, name);
    let mut momenta = vec![vec![0.0; 3]; 101];
    for (body, mass, inertia, com) in [("disc", 1.0, 1e-3, 0.0), ("ring", 2.0, 6e-3, 0.01)] {
        let [x, y, angle, vx, vy, omega] =
            ["x", "y", "angle", "vx", "vy", "omega"].map(|q| of(&format!("{body}.{q}")));
        for (k, sum) in momenta.iter_mut().enumerate() {
            let rho = turned([com, 0.0], angle[k]);
            let (px, py) = (
                mass * (vx[k] - omega[k] * rho[1]),
                mass * (vy[k] + omega[k] * rho[0]),
            );
            sum[0] += px;
            sum[1] += py;
            sum[2] += inertia * omega[k] + (x[k] + rho[0]) * py - (y[k] + rho[1]) * px;
        }
    }
    for (axis, scale) in [1.0, 1.0, 0.03].into_iter().enumerate() {
        let worst = momenta
            .iter()
            .map(|sum| (sum[axis] - momenta[0][axis]).abs())
            .fold(0.0, f64::max)
            / scale;
        println!("momentum {axis} off by {worst:e}");
        // Sums of round-off; angular momentum also by the tolerance, since it is no linear function of the coordinates.
        assert!(
            worst < if axis < 2 { 1e-12 } else { 1e-7 },
            "{axis}: {worst:e}"
        );
    }
}

#[test]
fn a_body_with_nothing_but_a_contact_flies() {
    let start = json!({ "x": 0.001, "y": -0.002, "vx": 0.3, "vy": 0.1, "angular_velocity": 5.0 });
    let mut model = journal(lankarani(0.9), none(), start, 0.01, 11, 1e-8);
    model["gravity"] = json!([0.0, -10.0]);
    let outcome = completed(&model);
    let (t, x, y) = (
        column(&outcome, "time"),
        column(&outcome, "disc.x"),
        column(&outcome, "disc.y"),
    );
    assert!(episodes(&outcome).is_empty());
    for k in 0..11 {
        assert!((x[k] - (0.001 + 0.3 * t[k])).abs() < 1e-14, "{}", x[k]);
        assert!(
            (y[k] - (-0.002 + 0.1 * t[k] - 5.0 * t[k] * t[k])).abs() < 1e-14,
            "{}",
            y[k]
        );
    }
    assert!(
        column(&outcome, "joint.pin.state")
            .iter()
            .all(|state| *state == 0.0)
    );
}

/// Rows 20 ns apart show a peak to (ω dt)²/8, 2e-7 with the contact's ω of some 6e4 rad/s.
#[test]
fn peaks_are_those_of_dense_rows() {
    let outcome = solve(&slider_crank(&[
        "analysis.end=0.0015",
        "analysis.outputs=75001",
        "analysis.solver.rtol=1e-10",
    ]));
    let impacts = episodes(&outcome);
    assert_eq!(impacts.len(), 6);
    let times = column(&outcome, "time");
    for (name, of) in [
        (
            "penetration",
            (|episode| episode.peak_penetration) as fn(&Episode) -> f64,
        ),
        ("normal_force", |episode| episode.peak_force),
    ] {
        let values = column(&outcome, &format!("joint.b.{name}"));
        for episode in &impacts {
            let within =
                |time: &f64| (episode.start..=episode.end.expect("it leaves")).contains(time);
            let rows = times
                .iter()
                .zip(&values)
                .filter(|(time, _)| within(time))
                .map(|(_, value)| *value);
            let (ours, dense) = (of(episode), rows.fold(0.0, f64::max));
            assert!(
                (ours / dense - 1.0).abs() < 1e-6,
                "{name} at {}: {ours:e} for {dense:e}",
                episode.start
            );
        }
    }
}

/// Wear, impulse and loss against sums over the rows, which know nothing of how they were integrated.
#[test]
fn sums_of_a_joint_are_integrals_of_its_columns() {
    let outcome = solve(&slider_crank(&["analysis.outputs=48001"]));
    let sums = &outcome.report.clearances[0];
    let of = |quantity: &str| column(&outcome, &format!("joint.b.{quantity}"));
    let (normal, sliding) = (of("normal_force"), of("sliding_speed"));
    let step = 0.024 / 48000.0;
    let integral = |f: &dyn Fn(usize) -> f64| {
        (1..48001)
            .map(|k| 0.5 * (f(k - 1) + f(k)) * step)
            .sum::<f64>()
    };
    let wear = integral(&|k| normal[k] * sliding[k].abs());
    let impulse = integral(&|k| normal[k]);
    let touching = integral(&|k| f64::from(u8::from(normal[k] > 0.0)));
    for (what, ours, rows) in [
        ("wear", sums.wear.iter().sum::<f64>(), wear),
        ("impulse", sums.impulse, impulse),
        ("time in contact", sums.time_in_contact, touching),
    ] {
        println!("{what}: {ours}, by rows {rows}");
        // Half a microsecond between rows, some hundred kinks and jumps of slope.
        assert!(
            (ours / rows - 1.0).abs() < 2e-4,
            "{what}: {ours} by rows {rows}"
        );
    }
    let lost: f64 = episodes(&outcome)
        .iter()
        .map(|episode| episode.energy_lost)
        .sum();
    let last = *column(&outcome, "energy.dissipated").last().expect("a row");
    assert!(
        (lost / last - 1.0).abs() < 1e-9 && (sums.energy_lost / last - 1.0).abs() < 1e-9,
        "{lost} {last}"
    );
}

/// Places differ from those of ideal joints by what the journal can move, so the order in c is one. A massless link turns about
/// where the force turns round, but stays within c.
#[test]
fn a_vanishing_clearance_is_an_ideal_joint() {
    const CLEARANCES: [f64; 4] = [1e-3, 3e-4, 1e-4, 3e-5];
    let common = [
        "drivers.motor.motion.velocity=500 rpm",
        "analysis.end=0.03",
        "analysis.outputs=301",
    ];
    let surface = r#"joints.b.clearance.surface={ "stiffness": 1e10, "damping": 1e5 }"#;
    let of = |more: &[String]| {
        let sets: Vec<&str> = common
            .into_iter()
            .chain([surface])
            .chain(more.iter().map(String::as_str))
            .collect();
        column(&solve(&slider_crank(&sets)), "slider.x")
    };
    let ideal = of(&["joints.b.clearance.model=ideal".into()]);
    for (model, analysis) in [
        ("contact", "dynamics"),
        ("two_state", "dynamics"),
        ("three_state", "dynamics"),
        ("massless_link", "dynamics"),
        ("massless_link", "inverse_dynamics"),
        ("massless_link", "kinematics"),
    ] {
        let errors: Vec<f64> = CLEARANCES
            .iter()
            .map(|clearance| {
                let real = of(&[
                    format!("analysis.type={analysis}"),
                    format!("joints.b.clearance.model={model}"),
                    format!("joints.b.clearance.radius={clearance}"),
                    "joints.b.clearance.normal.stiffness=1e11".into(),
                ]);
                real.iter()
                    .zip(&ideal)
                    .map(|(a, b)| (a - b).abs())
                    .fold(0.0, f64::max)
            })
            .collect();
        let (first, last) = (errors[0], errors[errors.len() - 1]);
        let order = (first / last).ln() / (CLEARANCES[0] / CLEARANCES[3]).ln();
        println!("{model} in {analysis}: {errors:?} for {CLEARANCES:?}, order {order:.3}");
        assert!(
            (0.9..1.1).contains(&order),
            "{model} in {analysis}: order {order} of {errors:?}"
        );
        for (error, clearance) in errors.iter().zip(CLEARANCES) {
            // cos of the rod's angle at most: 1/√(1 − (r/L)²) = 1.10, and the penetration.
            let part = error / clearance;
            assert!(
                (0.5..1.3).contains(&part),
                "{model} in {analysis}: {error:e} at {clearance:e}"
            );
        }
    }
}

/// Three impacts at 5000 rpm, which multiply differences by some ten.
#[test]
fn the_same_mechanism_told_otherwise_moves_the_same() {
    let short = [
        "analysis.end=0.0009",
        "analysis.outputs=181",
        "analysis.solver.rtol=1e-10",
    ];
    let names = ["penetration", "energy.contact"];
    told_otherwise(&short, "joints.b.clearance.friction.law=none", &names, 3);
}

/// Impacts, a journal that follows its bearing from 0.65 ms on, leaves it, and more impacts.
#[test]
fn the_same_rigid_journal_told_otherwise_moves_the_same() {
    let short = [
        "joints.b.clearance.model=three_state",
        r#"joints.b.clearance.impact={ "restitution": 0.5, "friction": 0.03 }"#,
        "analysis.end=0.003",
        "analysis.outputs=301",
        "analysis.solver.rtol=1e-10",
    ];
    let model = solve(&slider_crank(&short));
    let state = column(&model, "joint.b.state");
    assert!(
        state.contains(&0.0) && state.iter().any(|state| *state > 0.0),
        "{state:?}"
    );
    told_otherwise(
        &short,
        "joints.b.clearance.impact.friction=0",
        &["state"],
        10,
    );
}

/// Turned, mirrored, renamed, bearing and journal exchanged (this without friction, whose arms differ).
#[track_caller]
fn told_otherwise(short: &[&str], without_friction: &str, more: &[&str], least: usize) {
    let model = slider_crank(short);
    let frictionless = slider_crank(&[short, &[without_friction]].concat());
    let angle = 0.7;
    let same = |name: &str| (name.to_string(), 1.0);
    // What a mirror changes the sign of: x, angles, torques, and the sense of sliding.
    let mirrored = |name: &str| {
        let quantity = name.rsplit('.').next().unwrap_or(name);
        let turns = [
            "ex",
            "fx",
            "angle",
            "effort",
            "sliding_speed",
            "tangential_force",
        ]
        .contains(&quantity);
        (name.to_string(), if turns { -1.0 } else { 1.0 })
    };
    let swapped = |name: &str| {
        let turns = ["ex", "ey", "fx", "fy"]
            .map(|q| format!("joint.b.{q}"))
            .contains(&name.to_string());
        (name.to_string(), if turns { -1.0 } else { 1.0 })
    };
    let again = |name: &str| {
        let words: Vec<&str> = name.split('.').collect();
        let renamed = match words.as_slice() {
            [kind @ ("joint" | "driver"), owner, quantity] => {
                format!("{kind}.{}.{quantity}", renamed(owner))
            }
            [owner, quantity] if *owner != "energy" => format!("{}.{quantity}", renamed(owner)),
            _ => name.to_string(),
        };
        (renamed, 1.0)
    };
    let common = [
        "joint.b.ex",
        "joint.b.ey",
        "joint.b.fx",
        "joint.b.fy",
        "joint.b.normal_force",
    ]
    .map(String::from);
    let bodies = ["rod.angle", "driver.motor.effort", "energy.dissipated"].map(String::from);
    let own = more.iter().map(|name| {
        if name.contains('.') {
            (*name).into()
        } else {
            format!("joint.b.{name}")
        }
    });
    let names: Vec<String> = common.into_iter().chain(bodies).chain(own).collect();
    type Rename<'a> = &'a dyn Fn(&str) -> (String, f64);
    let cases: [(&str, &Model, Model, Rename); 4] = [
        ("rotated", &model, rotate(&model, angle), &same),
        ("mirrored", &model, mirror(&model), &mirrored),
        (
            "renamed and reversed",
            &model,
            rename_and_reverse(&model),
            &again,
        ),
        (
            "bearing and journal exchanged",
            &frictionless,
            swap(&frictionless),
            &swapped,
        ),
    ];
    for (what, original, other, expected) in cases {
        let (one, two) = (solve(original), solve(&other));
        let impacts = episodes(&one).len();
        assert!(
            impacts >= least && episodes(&two).len() == impacts,
            "{what}: {impacts}"
        );
        for name in names.iter().map(String::as_str) {
            let (other_name, sign) = expected(name);
            let mut wanted: Vec<f64> = column(&one, name)
                .iter()
                .map(|value| sign * value)
                .collect();
            if what == "rotated" {
                let pair = |x: &str, y: &str| [column(&one, x), column(&one, y)];
                let (stem, quantity) = name.rsplit_once('.').expect("an owner");
                match quantity {
                    "ex" | "ey" | "fx" | "fy" => {
                        let kind = &quantity[..1];
                        let [x, y] = pair(&format!("{stem}.{kind}x"), &format!("{stem}.{kind}y"));
                        let component = usize::from(quantity.ends_with('y'));
                        wanted = x
                            .iter()
                            .zip(&y)
                            .map(|(x, y)| turned([*x, *y], angle)[component])
                            .collect();
                    }
                    "angle" => wanted.iter_mut().for_each(|value| *value += angle),
                    _ => {}
                }
            }
            let scale = wanted.iter().fold(0.0, |m: f64, value| m.max(value.abs()));
            let ours = column(&two, &other_name);
            let off = ours
                .iter()
                .zip(&wanted)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max)
                / scale;
            println!("{what}: {name} off by {off:.1e}");
            // 10 rtol per impact of local error, multiplied by what impacts multiply.
            assert!(off < 1e-6, "{what}: {name} off by {off:e}");
        }
    }
}

#[test]
fn switching_the_model_changes_no_column() {
    let columns = |model: &str| {
        let surface = r#"joints.b.clearance.surface={ "stiffness": 1e8, "damping": 2e3 }"#;
        let model = format!("joints.b.clearance.model={model}");
        let outcome = solve(&slider_crank(&[
            "analysis.end=0.001",
            "analysis.outputs=11",
            surface,
            &model,
        ]));
        outcome.trajectory.columns
    };
    let ideal = columns("ideal");
    assert!(
        ideal
            .iter()
            .any(|column| column.name == "joint.b.penetration")
    );
    for model in ["massless_link", "two_state", "contact"] {
        assert_eq!(columns(model), ideal, "{model}");
    }
}

#[track_caller]
/// A mass on a guide between stiff stops: steps that land far beyond a stop are taken again shorter. Each rebound has half the
/// speed; the way between the stops is 2c less the depths.
#[test]
fn a_mass_on_a_guide_comes_off_a_stiff_stop() {
    for stiffness in [1e6, 1e9, 1e11] {
        let normal = json!({ "law": "gonthier", "restitution": 0.5, "stiffness": stiffness });
        let outcome = completed(&json!({ "format": "linkdyn/1", "units": "SI",
            "bodies": { "ground": { "points": { "O": [0.0, 0.0] } },
                "block": { "mass": 1.3, "inertia": 0.0, "com": [0.0, 0.0], "points": { "P": [0.0, 0.0] } } },
            "joints": { "guide": { "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [1, 0] },
                "stop": { "type": "revolute", "between": ["ground.O", "block.P"],
                          "clearance": { "model": "contact", "radius": 0.002, "normal": normal } } },
            "initial": { "block": { "vx": 1.0 } },
            "analysis": { "type": "dynamics", "end": 0.1, "outputs": 6 } }));
        let found = episodes(&outcome);
        assert!(found.len() >= 3, "{stiffness:e}: {found:?}");
        let mut speed = 1.0;
        for episode in &found {
            assert!(
                (episode.approach_speed / speed - 1.0).abs() < 1e-6,
                "{stiffness:e}: {episode:?}"
            );
            speed *= 0.5;
            if let Some(separation) = episode.separation_speed {
                assert!(
                    (separation / speed - 1.0).abs() < 1e-6,
                    "{stiffness:e}: {episode:?}"
                );
            }
        }
    }
}

/// A force D δ̇ is there at once: the hardest point of a contact may be its first.
#[test]
fn a_peak_may_be_the_beginning() {
    let start = json!({ "x": 0.0, "y": 0.0, "vx": 0.5, "vy": 0.0 });
    for damping in [2e4, 2e5] {
        let normal = json!({ "law": "kelvin_voigt", "stiffness": 1e6, "damping": damping });
        let outcome = completed(&journal(normal, none(), start.clone(), 0.04, 3, 1e-8));
        let force = episodes(&outcome)[0].peak_force;
        assert!(
            (force / (0.5 * damping) - 1.0).abs() < 1e-9,
            "{force} for {}",
            0.5 * damping
        );
    }
    let start = json!({ "x": 0.01001, "y": 0.0, "vx": -0.1, "vy": 0.0 });
    let outcome = completed(&journal(
        json!({ "law": "hertz", "stiffness": 1e8 }),
        none(),
        start,
        0.01,
        3,
        1e-8,
    ));
    let (force, depth) = (1e8 * 1e-5_f64.powf(1.5), 1e-5);
    let [episode] = episodes(&outcome)[..] else {
        panic!("{:?}", outcome.report.events)
    };
    assert!(
        (episode.peak_force / force - 1.0).abs() < 1e-9
            && (episode.peak_penetration / depth - 1.0).abs() < 1e-9
    );
}

/// What a law leaves in the surface where it would pull is lost with the contact: ½ m (v² − v′²), in all.
#[test]
fn episodes_lose_what_the_joint_loses() {
    let start = json!({ "x": 0.0, "y": 0.0, "vx": 0.5, "vy": 0.0 });
    let normal = json!({ "law": "kelvin_voigt", "stiffness": 1e7, "damping": 200.0 });
    let outcome = completed(&journal(normal, none(), start, 0.2, 3, 1e-9));
    let found = episodes(&outcome);
    assert!(found.len() > 2, "{found:?}");
    for episode in &found {
        let after = episode.separation_speed.expect("it leaves");
        let lost = 0.5 * (episode.approach_speed.powi(2) - after * after);
        assert!(
            (episode.energy_lost / lost - 1.0).abs() < 1e-7,
            "{episode:?} for {lost}"
        );
    }
    let sum: f64 = found.iter().map(|episode| episode.energy_lost).sum();
    assert!((sum / outcome.report.clearances[0].energy_lost - 1.0).abs() < 1e-12);
}

fn complaints(model: &Value) -> String {
    let loaded = match load(model.to_string().as_bytes(), &[]) {
        Ok(loaded) => loaded,
        Err(complaints) => {
            return complaints
                .iter()
                .map(ToString::to_string)
                .collect::<Vec<_>>()
                .join("\n");
        }
    };
    let complaints = run(&loaded.model, &Control::default()).expect_err("bad input");
    complaints
        .iter()
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join("\n")
}

#[test]
fn a_start_in_the_wall_says_how_deep() {
    let start = |x: f64| {
        journal(
            lankarani(0.9),
            none(),
            json!({ "x": x, "y": 0.0 }),
            1e-4,
            2,
            1e-8,
        )
    };
    let said = complaints(&start(0.0125));
    assert!(
        said.contains("joint \"pin\" starts with its journal 0.0025 m deep"),
        "{said}"
    );
    assert!(
        said.contains("eccentricity 0.0125 m") && said.contains("clearance 0.01 m"),
        "{said}"
    );
    // A little is a contact like any other.
    let outcome = completed(&start(0.0101));
    assert!(column(&outcome, "joint.pin.normal_force")[0] > 0.0);
}

/// Beyond its range a law's force is made up: the run says so once, with the number; within it says nothing.
#[test]
fn a_run_says_that_it_left_the_range_of_a_law() {
    // Johnson's formula ends at 8 e⁻³ of the clearance.
    let range = 8.0 * (-3.0_f64).exp() * cylinders::CLEARANCE;
    for (speed, leaves) in [(0.5, false), (20.0, true)] {
        let start = json!({ "x": 0.0, "y": 0.0, "vx": speed, "vy": 0.0 });
        let outcome = completed(&cylinder("johnson", 0.9, 0.0, start, 0.002, 1e-8));
        let impacts = episodes(&outcome);
        let deepest = impacts
            .iter()
            .map(|episode| episode.peak_penetration)
            .fold(0.0, f64::max);
        assert!(
            !impacts.is_empty() && (deepest > range) == leaves,
            "{deepest:e} {range:e}"
        );
        let said: Vec<&String> = outcome
            .report
            .warnings
            .iter()
            .filter(|warning| warning.contains("normal law"))
            .collect();
        assert_eq!(said.len(), usize::from(leaves), "{said:?}");
        if let [said] = said[..] {
            let si = linkdyn_model::display::DisplayUnits::default();
            let numbers = [
                si.length_to(deepest, 4),
                si.length_to(range, 4),
                "\"pin\"".into(),
            ];
            assert!(numbers.iter().all(|number| said.contains(number)), "{said}");
        }
    }
}

#[test]
fn a_run_says_that_a_journal_sank_in() {
    // The journal's radius is 40 mm.
    for (stiffness, sinks) in [(1e8, false), (1e4, true)] {
        let start = json!({ "x": 0.0, "y": 0.0, "vx": 2.0, "vy": 0.0 });
        let outcome = completed(&journal(
            json!({ "law": "hertz", "stiffness": stiffness }),
            none(),
            start,
            0.1,
            3,
            1e-6,
        ));
        let deepest = episodes(&outcome)
            .iter()
            .map(|episode| episode.peak_penetration)
            .fold(0.0, f64::max);
        assert_eq!(deepest > 0.004, sinks, "{deepest:e}");
        let said = outcome
            .report
            .warnings
            .iter()
            .any(|said| said.contains("of the journal's radius"));
        assert_eq!(said, sinks, "{:?}", outcome.report.warnings);
    }
}

#[test]
fn bad_parameters_are_bad_input() {
    let start = || json!({});
    let with = |normal: Value, friction: Value| {
        complaints(&journal(normal, friction, start(), 1e-3, 2, 1e-8))
    };
    for (said, words) in [
        (with(lankarani(1.5), none()), "restitution"),
        (
            with(json!({ "law": "hertz", "stiffness": -1.0 }), none()),
            "stiffness",
        ),
        (
            with(
                json!({ "law": "hertz", "stiffness": 1e9, "exponent": 0.5 }),
                none(),
            ),
            "exponent",
        ),
        (
            with(
                lankarani(0.9),
                json!({ "law": "coulomb", "coefficient": -0.1, "threshold_velocity": 0.01 }),
            ),
            "coefficient",
        ),
        (
            with(
                lankarani(0.9),
                json!({ "law": "coulomb", "coefficient": 0.1, "threshold_velocity": 0.0 }),
            ),
            "threshold_velocity",
        ),
    ] {
        assert!(said.contains(words), "{words} is not in {said}");
    }
    let mut wide = journal(lankarani(0.9), none(), start(), 1e-3, 2, 1e-8);
    wide["joints"]["pin"]["clearance"]["bearing_radius"] = json!(0.01);
    assert!(
        complaints(&wide).contains("bearing_radius"),
        "{}",
        complaints(&wide)
    );
    let mut massless = journal(lankarani(0.9), none(), start(), 1e-3, 2, 1e-8);
    massless["bodies"]["disc"]["mass"] = json!(0.0);
    let said = complaints(&massless);
    assert!(said.contains("disc"), "{said}");
}
