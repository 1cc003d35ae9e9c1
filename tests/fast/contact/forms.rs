//! Closed forms of impacts and of rest.

use super::*;

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
