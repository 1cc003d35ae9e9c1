//! What is conserved, and what is lost where.

use super::*;

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
