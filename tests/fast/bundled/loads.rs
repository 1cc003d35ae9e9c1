//! Loads that follow the motion: energies by quadrature and by hand.

use super::*;

/// At each row the flywheel has the work of the gas on the piston, ∮ p dV by Gauss's rule from point to point of the table, less
/// that of the load. So over one cycle of two turns the mean torque is ∮ p dV/4π.
#[test]
fn the_engine_turns_its_gas_into_work() {
    let model = load_bundled("engine", &[]);
    let (area, r, l) = (50e-4, 0.04, 0.14);
    let points = &model.tables["gas"].points;
    assert_eq!(points[points.len() - 1][0], 2.0 * TAU);
    let dx = |t: f64| {
        let (sin, cos) = t.sin_cos();
        -r * sin - r * r * sin * cos / (l * l - r * r * sin * sin).sqrt()
    };
    // of five points, on [−1, 1]
    let near = (5.0 - 2.0 * (10.0_f64 / 7.0).sqrt()).sqrt() / 3.0;
    let far = (5.0 + 2.0 * (10.0_f64 / 7.0).sqrt()).sqrt() / 3.0;
    let weight = |sign: f64| (322.0 + sign * 13.0 * 70.0_f64.sqrt()) / 900.0;
    let nodes = [
        (0.0, 128.0 / 225.0),
        (near, weight(1.0)),
        (-near, weight(1.0)),
        (far, weight(-1.0)),
        (-far, weight(-1.0)),
    ];
    let piece = |from: [f64; 2], to: [f64; 2], until: f64| {
        let half = 0.25 * (until - from[0]);
        let slope = (to[1] - from[1]) / (to[0] - from[0]);
        let part = |begin: f64| {
            nodes.iter().map(move |(node, weight)| {
                let t = begin + half * (1.0 + node);
                -area * (from[1] + slope * (t - from[0]) - 1e5) * dx(t) * weight * half
            })
        };
        part(from[0]).chain(part(from[0] + 2.0 * half)).sum::<f64>()
    };
    let within = |angle: f64| {
        let pairs = points.windows(2).take_while(|pair| pair[0][0] < angle);
        pairs
            .map(|pair| piece(pair[0], pair[1], angle.min(pair[1][0])))
            .sum::<f64>()
    };
    let cycle = within(2.0 * TAU);
    let work = |angle: f64| {
        let cycles = (angle / (2.0 * TAU)).floor();
        cycles * cycle + within(angle - 2.0 * TAU * cycles)
    };
    let outcome = solve(&model);
    assert_eq!(outcome.report.status, Status::Completed);
    let (angle, energy) = (
        values(&outcome, "crank.angle"),
        values(&outcome, "energy.kinetic"),
    );
    let load = 33.841;
    for (angle, now) in angle.iter().zip(&energy) {
        close(
            now - energy[0],
            work(*angle) - load * angle,
            1e-6 * energy[0],
        );
    }
    // the load is the mean torque to its digits
    close(cycle / (2.0 * TAU), load, 0.5e-3);
    assert!(angle[angle.len() - 1] > 2.0 * TAU, "a cycle is over");
}

/// Until the first latch nothing is lost: what the torsion springs give up is in the motion and in the loops. Then the array is
/// straight, and the latches have taken all of it.
#[test]
fn the_array_unfolds_by_its_springs() {
    let outcome = solve(&load_bundled("solar-array", &[]));
    assert_eq!(
        outcome.report.status,
        Status::Completed,
        "{:?}",
        outcome.report.message
    );
    let of = |name: &str| values(&outcome, name);
    let [yoke, inner, outer] = ["yoke.angle", "inner.angle", "outer.angle"].map(of);
    let (kinetic, potential, lost) = (
        of("energy.kinetic"),
        of("energy.potential"),
        of("energy.dissipated"),
    );
    let whole = kinetic[0] + potential[0];
    let stored = |root: f64, middle: f64, tip: f64| {
        let free = TAU / 4.0;
        0.125 * (2.0 * (root + free).powi(2) + (middle - free).powi(2) + (tip + free).powi(2))
    };
    close(whole, stored(TAU / 4.0, -TAU / 2.0, TAU / 2.0), 1e-9);
    let mut latched = 0;
    for row in 0..kinetic.len() {
        let loops = [
            2.0 * yoke[row] + inner[row] - yoke[row],
            outer[row] - yoke[row],
        ];
        let elastic = 20.0 * (loops[0].powi(2) + loops[1].powi(2));
        if lost[row] > 0.0 {
            latched += 1;
        }
        close(
            kinetic[row] + potential[row] + elastic + lost[row],
            whole,
            1e-6 * whole,
        );
    }
    assert!(latched > 0 && lost[0] == 0.0, "it latches on the way");
    // straight, with all that the springs gave up in the latches
    let last = kinetic.len() - 1;
    for angle in [yoke[last], inner[last], outer[last]] {
        close(angle, 0.0, 1e-9);
    }
    let left = stored(0.0, 0.0, 0.0);
    close(potential[last], left, 1e-9);
    close(lost[last], whole - left, 1e-6 * whole);
}
