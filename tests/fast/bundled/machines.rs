//! Machines: what their closed forms say of motions and forces.

use super::*;

/// Place of a point of a body in a row.
fn at(outcome: &Outcome, body: &str, [x, y]: [f64; 2], row: usize) -> [f64; 2] {
    let of = |name: &str| values(outcome, &format!("{body}.{name}"))[row];
    let (sin, cos) = of("angle").sin_cos();
    [of("x") + cos * x - sin * y, of("y") + sin * x + cos * y]
}

/// Force that pushes the end of a cylinder from its foot, about a hinge, by the moment that it must have.
fn push(hinge: [f64; 2], foot: [f64; 2], end: [f64; 2], moment: f64) -> f64 {
    let [dx, dy] = [end[0] - foot[0], end[1] - foot[1]];
    let length = dx.hypot(dy);
    let arm = ((end[0] - hinge[0]) * dy - (end[1] - hinge[1]) * dx) / length;
    moment / arm
}

/// Each cylinder has its length, so that the boom stands where the triangle of hinge, foot and eye has it. Where the motion begins
/// and ends, nothing accelerates: boom and stick cylinder carry the moments of the weights beyond their hinges.
#[test]
fn the_excavators_cylinders_carry_the_weights() {
    let outcome = solve(&load_bundled("excavator", &[]));
    let column = |name: &str| values(&outcome, name);
    let masses = [
        ("boom", 1200.0, [2.3, 0.4]),
        ("stick", 600.0, [0.8, 0.1]),
        ("rocker", 40.0, [0.225, 0.0]),
        ("link", 40.0, [0.24, 0.0]),
        ("bucket", 500.0, [0.45, 0.2]),
    ];
    let (foot, eye) = ([0.5, -0.4], [2.2, 0.5]);
    let (a, b) = (f64::hypot(foot[0], foot[1]), f64::hypot(eye[0], eye[1]));
    let last = column("time").len() - 1;
    for row in 0..=last {
        let length = column("driver.lift.value")[row];
        let cos = (a * a + b * b - length * length) / (2.0 * a * b);
        let angle = cos.acos() + f64::atan2(foot[1], foot[0]) - f64::atan2(eye[1], eye[0]);
        close(column("boom.angle")[row], angle, ROUND_OFF);
    }
    for row in [0, last] {
        let beyond = |hinge: [f64; 2], first: usize| -> f64 {
            let masses = masses[first..].iter();
            let moments = masses.map(|(body, mass, com)| {
                9.81 * mass * (at(&outcome, body, *com, row)[0] - hinge[0])
            });
            moments.sum()
        };
        let hinge = [0.0, 0.0];
        let lift = push(
            hinge,
            foot,
            at(&outcome, "boom", eye, row),
            beyond(hinge, 0),
        );
        close(column("driver.lift.effort")[row], lift, 1e-11 * lift.abs());
        let elbow = at(&outcome, "boom", [4.6, 0.0], row);
        let foot = at(&outcome, "boom", [2.6, 0.9], row);
        let end = at(&outcome, "stick", [-0.7, 0.25], row);
        let crowd = push(elbow, foot, end, beyond(elbow, 1));
        close(
            column("driver.crowd.effort")[row],
            crowd,
            1e-11 * lift.abs(),
        );
    }
}

/// The velocity of each point by those of a four-bar: ω of coupler and rocker from its closure, by Cramer's rule.
#[test]
fn the_bicycles_leverage_is_that_of_its_four_bar() {
    let outcome = solve(&load_bundled("bicycle-suspension", &[]));
    let leverage = values(&outcome, "output.leverage");
    for (row, ours) in leverage.iter().enumerate() {
        let place = |body: &str, point: [f64; 2]| at(&outcome, body, point, row);
        let (main, pivot, mount) = ([-0.02, 0.06], [-0.04, 0.4], [0.03, 0.19]);
        let (horst, top) = (place("seatstay", [0.0, 0.0]), place("rocker", [0.13, 0.0]));
        let (axle, eye) = (
            place("seatstay", [-0.035, 0.03]),
            place("rocker", [-0.065, -0.025]),
        );
        let arm = |from: [f64; 2], to: [f64; 2]| [from[1] - to[1], to[0] - from[0]];
        // The lower stay turns with 1 rad/s: v_H + ω₂ (U − H)⊥ = ω₃ (U − N)⊥.
        let (horst_v, u, w) = (arm(main, horst), arm(horst, top), arm(pivot, top));
        let determinant = w[0] * u[1] - u[0] * w[1];
        let coupler = (horst_v[0] * w[1] - horst_v[1] * w[0]) / determinant;
        let rocker = (u[1] * horst_v[0] - u[0] * horst_v[1]) / determinant;
        let rise = horst_v[1] + coupler * arm(horst, axle)[1];
        let [dx, dy] = [eye[0] - mount[0], eye[1] - mount[1]];
        let [vx, vy] = arm(pivot, eye).map(|part| part * rocker);
        let known = rise / ((dx * vx + dy * vy) / dx.hypot(dy));
        close(*ours, known, 1e-11);
        assert!((-2.3..-2.1).contains(ours), "{ours}");
    }
}

/// The crank turns a third of the motor. The arm is where the triangles have it, and the strands differ by the torque that the crank
/// takes, 36 mm from its axis; by power that of drag and of what accelerates.
#[test]
fn the_wiper_swings_behind_its_belt() {
    let outcome = solve(&load_bundled("wiper", &[]));
    let column = |name: &str| values(&outcome, name);
    let (motor, crank, arm) = (
        column("motor.angle"),
        column("wheel.angle"),
        column("arm.angle"),
    );
    let energy = column("energy.kinetic");
    for row in 0..motor.len() {
        close(crank[row], motor[row] / 3.0, 1e-12);
        // From the arm's pivot to the crank pin: a triangle with the lever and the rod.
        let (sin, cos) = crank[row].sin_cos();
        let [x, y] = [0.028 * cos, -0.15 + 0.028 * sin];
        let far = x.hypot(y);
        let corner = (0.045 * 0.045 + far * far - 0.15 * 0.15) / (2.0 * 0.045 * far);
        close(arm[row], y.atan2(x) + corner.acos(), 1e-12);
        let (tight, slack) = (
            column("joint.belt.tight")[row],
            column("joint.belt.slack")[row],
        );
        close(tight + slack, 240.0, 1e-10);
        assert!(slack > 0.0);
        let torque = column("joint.belt.torque")[row];
        close((tight - slack) * 0.036, torque.abs(), 1e-11);
        // The motor's own inertia is not accelerated.
        close(column("driver.motor.effort")[row], torque / 3.0, 1e-11);
        // Power of the belt: drag, and the change of the kinetic energy, by central differences of 1e-4 s.
        if row > 0 && row + 1 < motor.len() {
            let step = column("time")[row + 1] - column("time")[row - 1];
            let change = (energy[row + 1] - energy[row - 1]) / step;
            let omega = column("arm.omega")[row];
            let power = torque * column("wheel.omega")[row];
            close(power, 0.4 * omega * omega + change, 0.05);
        }
    }
}
