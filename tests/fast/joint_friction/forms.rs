//! Blocks and pendulums against closed forms.

use super::*;

/// v′ = g sin α − μ g cos α min(v/v_t, 1), by its closed form: beyond the ramp the acceleration is g(sin α − μ cos α).
#[test]
fn a_block_slides_down_an_incline() {
    let (slope, mu, threshold) = (0.6_f64, 0.3, 0.02);
    let mut model = incline(slope, &coulomb(mu, threshold));
    model["analysis"] = dynamics(1.0, 11, 1e-10);
    let run = completed(&model);
    let (pull, brake) = (G * slope.sin(), mu * G * slope.cos());
    let ramp = brake / threshold;
    let until = -(1.0 - threshold * ramp / pull).ln() / ramp;
    let within = pull / ramp * (until - threshold / pull);
    let after = 1.0 - until;
    let distance = within + threshold * after + 0.5 * (pull - brake) * after * after;
    let (x, y) = (last(&run, "block.x"), last(&run, "block.y"));
    close(x.hypot(y), distance, 1e-9);
    close(
        last(&run, "block.ax").hypot(last(&run, "block.ay")),
        G * (slope.sin() - mu * slope.cos()),
        1e-12,
    );
    close(
        last(&run, "joint.g.friction"),
        -mu * 2.0 * G * slope.cos(),
        1e-12,
    );
    // Across the plane and along it, as the plane presses and brakes.
    let (across, along) = ([slope.sin(), slope.cos()], [slope.cos(), -slope.sin()]);
    let (normal, brake) = (2.0 * G * slope.cos(), -mu * 2.0 * G * slope.cos());
    close(
        last(&run, "joint.g.fx"),
        normal * across[0] + brake * along[0],
        1e-11,
    );
    close(
        last(&run, "joint.g.fy"),
        normal * across[1] + brake * along[1],
        1e-11,
    );

    // Driven with this very acceleration it needs no effort.
    model["drivers"] = json!({ "hand": { "type": "translation", "joint": "g", "motion": {
        "type": "constant_acceleration", "start": 0.0, "velocity": 1.0, "acceleration": pull - mu * G * slope.cos() } } });
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 1.0, "outputs": 11 });
    let run = completed(&model);
    assert!(
        column(&run, "driver.hand.effort")
            .iter()
            .all(|effort| effort.abs() < 1e-12)
    );
    close(last(&run, "joint.g.friction"), brake, 1e-12);
}

/// A block whose weight hangs beside a guide of length L presses with both ends: N = 2 m g e/L, e the lever.
#[test]
fn a_guide_takes_the_torque_with_its_ends() {
    let (lever, length, mu) = (0.3, 0.2, 0.1);
    let mut model = incline(0.0, &coulomb(mu, 0.01));
    model["bodies"]["block"]["com"] = json!([lever, 0.0]);
    model["drivers"] = json!({ "hand": { "type": "translation", "joint": "g",
        "motion": { "type": "constant_velocity", "start": 0.0, "velocity": 1.0 } } });
    let effort = |model: &Value| last(&completed(model), "driver.hand.effort");
    close(effort(&model), mu * 2.0 * G, 1e-12);
    model["joints"]["g"]["guide_length"] = json!(length);
    close(effort(&model), mu * 2.0 * (2.0 * G) * lever / length, 1e-12);
    model["joints"]["g"]["guide_length"] = json!(2.5 * lever);
    close(effort(&model), mu * 2.0 * G, 1e-12);
}

/// θ″ of that pendulum, from the bar cut free: its pin force holds θ″, so that is found by repetition.
fn pendulum_acceleration(angle: f64, omega: f64, (radius, mu, threshold): (f64, f64, f64)) -> f64 {
    let (mass, lever, inertia) = (1.0, 0.5, 1.0 / 12.0 + 0.25);
    let (sin, cos) = angle.sin_cos();
    let part = (radius * omega / threshold).clamp(-1.0, 1.0);
    let mut alpha = 0.0;
    for _ in 0..40 {
        let x = mass * lever * (-alpha * sin - omega * omega * cos);
        let y = mass * (lever * (alpha * cos - omega * omega * sin) + G);
        alpha = (-mass * G * lever * cos - mu * radius * x.hypot(y) * part) / inertia;
    }
    alpha
}

#[test]
fn a_pendulum_loses_its_swing_as_its_equation_by_hand_says() {
    let (radius, mu, threshold) = (0.05, 0.3, 0.02);
    let mut model = pendulum(-0.2, radius, &coulomb(mu, threshold));
    model["analysis"] = dynamics(3.0, 7, 1e-10);
    let run = completed(&model);
    let f = |[angle, omega]: [f64; 2]| {
        [
            omega,
            pendulum_acceleration(angle, omega, (radius, mu, threshold)),
        ]
    };
    let go = |y: [f64; 2], k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
    let (mut y, h) = ([-0.2, 0.0], 1e-4);
    let (mut angles, mut omegas) = (
        column(&run, "bar.angle").into_iter(),
        column(&run, "bar.omega").into_iter(),
    );
    let mut compare = |y: [f64; 2]| {
        close(angles.next().expect("rows"), y[0], 2e-8);
        close(omegas.next().expect("rows"), y[1], 2e-7);
    };
    compare(y);
    for step in 1..=30_000 {
        let k1 = f(y);
        let k2 = f(go(y, k1, 0.5 * h));
        let k3 = f(go(y, k2, 0.5 * h));
        let k4 = f(go(y, k3, h));
        let mean = [0, 1].map(|i| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0);
        y = go(y, mean, h);
        if step % 5000 == 0 {
            compare(y);
        }
    }
}

/// Small swings lose 2 μ r/l of amplitude per half swing, l the centre of mass from the pin.
#[test]
fn small_swings_shrink_by_the_same_amount_each() {
    let (radius, mu) = (0.01, 0.1);
    let down = -std::f64::consts::FRAC_PI_2;
    let mut model = pendulum(down + 0.05, radius, &coulomb(mu, 1e-6));
    model["analysis"] = dynamics(4.0, 4001, 1e-8);
    let run = completed(&model);
    let (angles, omegas) = (column(&run, "bar.angle"), column(&run, "bar.omega"));
    let turns: Vec<f64> = (1..angles.len() - 1)
        .filter(|&k| omegas[k] * omegas[k + 1] < 0.0)
        .map(|k| (angles[k] - down).abs().max((angles[k + 1] - down).abs()))
        .collect();
    assert!(turns.len() >= 4, "{turns:?}");
    let mut before = 0.05;
    for turn in &turns[..4] {
        close(before - turn, 2.0 * mu * radius / 0.5, 2e-5);
        before = *turn;
    }
}
