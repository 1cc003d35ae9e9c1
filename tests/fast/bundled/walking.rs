//! The Strandbeest on ground: what walking by friction has to obey, by the path of its feet and by momentum.

use super::lines::jansens_foot;
use super::*;

/// Legs: name, 1 of a front leg and −1 of its mirror image, and the angle of its pin on the crank.
const LEGS: [(&str, f64, f64); 4] = [
    ("front_1", 1.0, 0.0),
    ("rear_1", -1.0, 0.0),
    ("front_2", 1.0, PI),
    ("rear_2", -1.0, PI),
];
const GROUND: f64 = -0.0939;
const RADIUS: f64 = 0.002;
const GRIP: f64 = 0.4;
const ROWS: usize = 401;
/// Rows of a turn of 2 s.
const TURN: usize = 200;

/// A foot in the frame, at an angle of the crank in it.
fn foot((_, side, pin): (&str, f64, f64), theta: f64) -> [f64; 2] {
    let own = theta + pin;
    let [x, y] = jansens_foot(if side > 0.0 { own } else { PI - own });
    [side * x, y]
}

#[test]
fn the_strandbeest_walks_by_friction() {
    let outcome = solve(&load_bundled("walking-strandbeest", &[]));
    let of = |name: &str| values(&outcome, name);
    let [x, y, lean, crank] = ["frame.x", "frame.y", "frame.angle", "crank.angle"].map(&of);
    let mut advance = [0.0; ROWS];
    for leg in LEGS {
        let name = leg.0;
        let [tip_x, tip_y, turn, spin, speed] = ["tip.x", "tip.y", "angle", "omega", "tip.vx"]
            .map(|quantity| of(&format!("{name}_foot.{quantity}")));
        let [state, normal, along] = ["state", "normal_force", "fx"]
            .map(|quantity| of(&format!("joint.step_{name}.{quantity}")));
        for row in 0..ROWS {
            // by Jansen's numbers, in a frame that is there
            let [u, v] = foot(leg, crank[row] - lean[row]);
            let (sin, cos) = lean[row].sin_cos();
            close(tip_x[row], x[row] + cos * u - sin * v, 1e-11);
            close(tip_y[row], y[row] + sin * u + cos * v, 1e-11);
            // never in the ground; and above it nothing holds the foot
            let height = tip_y[row] - RADIUS - GROUND;
            assert!(height > -1e-11, "{name} {height:e} in row {row}");
            if height > 1e-9 {
                assert_eq!((state[row], normal[row]), (0.0, 0.0));
            }
            // Coulomb: the foot, which is round, rolls within the cone, or slides on it against its way
            let slides = speed[row] + spin[row] * RADIUS;
            let most = GRIP * normal[row];
            match state[row] {
                2.0 => {
                    close(slides, 0.0, 1e-9);
                    assert!(
                        along[row].abs() <= most * (1.0 + 1e-6),
                        "{name} in row {row}"
                    );
                }
                1.0 => close(along[row], -most * slides.signum(), 1e-9),
                _ => {}
            }
        }
        let lift = tip_y.iter().copied().fold(f64::MIN, f64::max) - RADIUS - GROUND;
        assert!(lift > 0.02, "{name} lifts {lift}");
        // in each turn it is on the ground for a half, and sticks for half of that
        let rows = (ROWS - TURN) as f64;
        let share = |wanted: f64| {
            state[TURN..]
                .iter()
                .filter(|state| **state == wanted)
                .count() as f64
                / rows
        };
        close(share(0.0), 0.5, 0.06);
        close(share(2.0), 0.25, 0.04);
        let slid: f64 = (TURN..ROWS - 1)
            .filter(|&row| state[row] == 1.0)
            .map(|row| 0.01 * (speed[row] + spin[row] * RADIUS).abs())
            .sum();
        assert!(slid < 0.01, "{name} slides {slid} m in a turn");
        // what the frame goes on by while this foot rolls on the ground
        for row in 0..ROWS - 1 {
            if state[row] == 2.0 && state[row + 1] == 2.0 {
                let carried = |row: usize| tip_x[row] - x[row] + RADIUS * turn[row];
                advance[row] = carried(row) - carried(row + 1);
            }
        }
    }
    stride(&x, &advance);
    momentum(&outcome);
    let quality = &outcome.report.quality;
    assert!(
        quality.energy_imbalance.expect("known") < 1e-5,
        "{quality:?}"
    );
}

/// The frame goes on with the foot that carries more, turn by turn alike: by what a level frame would by its feet, of which the one
/// ahead takes over where both carry the same, to a twentieth; for where both pairs change over, it leans and falls a little.
fn stride(x: &[f64], advance: &[f64]) {
    let turn = x[ROWS - 1] - x[ROWS - 1 - TURN];
    close(
        turn,
        x[ROWS - 1 - TURN / 2] - x[ROWS - 1 - 3 * TURN / 2],
        1e-6,
    );
    let (mut sum, mut known) = (0.0, 0.0);
    for (row, step) in advance.iter().enumerate().skip(TURN) {
        if *step != 0.0 {
            close(x[row + 1] - x[row], *step, 1e-9);
            sum += step;
            known += 1.0;
        }
    }
    assert!(
        known > 0.9 * TURN as f64 && (sum / turn - 1.0).abs() < 0.1,
        "{sum} of {turn}"
    );
    let [front, rear] = [LEGS[0], LEGS[3]];
    let at = |leg, theta: f64| foot(leg, theta)[0];
    // by symmetry both carry the same with the crank along
    close(at(front, 0.0), -at(rear, 0.0), 1e-15);
    let half = at(rear, -0.5 * PI) - at(rear, 0.0) + at(front, 0.0) - at(front, 0.5 * PI);
    close(turn, 2.0 * half, 0.05 * turn.abs());
}

/// The ground's impulses, impacts among them, are the weight's over the time and what the parts have of momentum.
fn momentum(outcome: &Outcome) {
    let parts = [
        ("upper_rod", 0.05, [25.0, 0.0]),
        ("lower_rod", 0.0619, [30.95, 0.0]),
        ("plate", 0.1374, [14.7033, 13.3383]),
        ("link", 0.0393, [19.65, 0.0]),
        ("rear_link", 0.0394, [19.7, 0.0]),
        ("foot", 0.1514, [9.65114, 16.1279]),
    ];
    let legs = LEGS.iter().flat_map(|(leg, side, _)| {
        parts.map(|(part, mass, [u, v])| {
            (format!("{leg}_{part}"), mass, [1e-3 * u, 1e-3 * v * side])
        })
    });
    let frame = [
        ("frame".to_owned(), 2.0, [0.0; 2]),
        ("crank".to_owned(), 0.045, [0.0; 2]),
    ];
    let bodies: Vec<(String, f64, [f64; 2])> = legs.chain(frame).collect();
    let mass: f64 = bodies.iter().map(|(_, mass, _)| mass).sum();
    let upward = |row: usize| -> f64 {
        let each = bodies.iter().map(|(name, mass, [u, v])| {
            let of = |quantity: &str| values(outcome, &format!("{name}.{quantity}"))[row];
            let (sin, cos) = of("angle").sin_cos();
            mass * (of("vy") + of("omega") * (cos * u - sin * v))
        });
        each.sum()
    };
    let pressed: f64 = outcome.report.stops.iter().map(|sums| sums.impulse).sum();
    let known = mass * 9.81 * 4.0 + upward(ROWS - 1) - upward(0);
    // What a foot that stays passes on while another one strikes is not among its impulses.
    close(pressed, known, 1e-3 * known);
}
