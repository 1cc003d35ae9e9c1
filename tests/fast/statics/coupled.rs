//! Small motions whose coordinates are coupled by geometry or by damping, and their shapes.

use super::*;

/// A second derivative at zero by five points, extrapolated once from h and 2 h (error h⁶).
fn second_derivative(of: impl Fn(f64) -> f64) -> f64 {
    let five = |h: f64| {
        let sides = [h, 2.0 * h].map(|h| of(h) + of(-h));
        (16.0 * sides[0] - sides[1] - 30.0 * of(0.0)) / (12.0 * h * h)
    };
    let h = 4e-3;
    (16.0 * five(h) - five(2.0 * h)) / 15.0
}

/// A first derivative at zero, likewise.
fn first_derivative(of: impl Fn(f64) -> f64) -> f64 {
    let five = |h: f64| (8.0 * (of(h) - of(-h)) - (of(2.0 * h) - of(-2.0 * h))) / (12.0 * h);
    let h = 4e-3;
    (16.0 * five(h) - five(2.0 * h)) / 15.0
}

/// Half the distance of the hinges, cranks and couplers of a symmetric five-bar [m].
const HALF: f64 = 0.25;
const CRANK: f64 = 0.4;
const COUPLER: f64 = 0.5;

/// Centres and angles (x, y, angle) of both cranks and both couplers, hanging, by the angles of the cranks.
fn five_bar([left, right]: [f64; 2]) -> [[f64; 3]; 4] {
    let tip = |x: f64, angle: f64| [x + CRANK * angle.cos(), CRANK * angle.sin()];
    let (a, b) = (tip(-HALF, left), tip(HALF, right));
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let chord = x.hypot(y);
    let height = (COUPLER * COUPLER - 0.25 * chord * chord).sqrt() / chord;
    let pin = [
        0.5 * (a[0] + b[0]) + height * y,
        0.5 * (a[1] + b[1]) - height * x,
    ];
    let rod = |from: [f64; 2], to: [f64; 2]| {
        let angle = (to[1] - from[1]).atan2(to[0] - from[0]);
        [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]), angle]
    };
    [
        rod([-HALF, 0.0], a),
        rod([HALF, 0.0], b),
        rod(a, pin),
        rod(b, pin),
    ]
}

/// A five-bar hangs under its weight. Symmetry parts its two modes, cranks mirrored or cranks alike: along each the frequency is
/// V″/Σ m|x′|², with the energy of circles that meet.
#[test]
fn a_hanging_five_bar_swings_as_its_energy_bends() {
    let energy = |angles: [f64; 2]| -> f64 { five_bar(angles).iter().map(|[_, y, _]| G * y).sum() };
    let mirrored = |angle: f64| [angle, PI - angle];
    // V falls while the cranks turn down, and rises again.
    let (mut low, mut high) = (-1.9, -0.9);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if first_derivative(|d| energy(mirrored(middle + d))) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    let rest = 0.5 * (low + high);
    let frequency = |along: [f64; 2]| {
        let moved = |d: f64| {
            let [left, right] = mirrored(rest);
            [left + d * along[0], right + d * along[1]]
        };
        let rate = |body: usize, axis: usize| first_derivative(|d| five_bar(moved(d))[body][axis]);
        let mass: f64 = (0..4)
            .map(|body| {
                let length: f64 = if body < 2 { CRANK } else { COUPLER };
                let [x, y, turn] = [0, 1, 2].map(|axis| rate(body, axis));
                x * x + y * y + length * length / 12.0 * turn * turn
            })
            .sum();
        (second_derivative(|d| energy(moved(d))) / mass).sqrt()
    };
    let mut known = [frequency([1.0, -1.0]), frequency([1.0, 1.0])];
    known.sort_by(f64::total_cmp);

    let places = five_bar(mirrored(rest + 0.1));
    let drawn = |body: usize, length: f64| {
        let [x, y, angle] = places[body];
        let half = 0.5 * length;
        rod(
            length,
            [x - half * angle.cos(), y - half * angle.sin()],
            angle,
        )
    };
    let bodies = json!({ "ground": { "points": { "L": [-HALF, 0.0], "R": [HALF, 0.0] } },
        "left": drawn(0, CRANK), "right": drawn(1, CRANK), "first": drawn(2, COUPLER), "second": drawn(3, COUPLER) });
    let joints = json!({ "l": pin("ground.L", "left.A"), "r": pin("ground.R", "right.A"),
        "a": pin("left.B", "first.A"), "b": pin("right.B", "second.A"), "c": pin("first.B", "second.B") });
    let found = linearised(&statics(bodies, joints, json!({})), false);
    assert_eq!(found.modes.len(), 2, "{:?}", found.message);
    close(found.bodies[0].1[2], rest, 1e-9);
    for (mode, known) in found.modes.iter().zip(known) {
        close(mode.frequency(), known, 1e-7 * known);
    }
}

/// The frame of a body that swings about a hinge beside it moves across the line from there.
#[test]
fn a_shape_is_that_of_the_frame_and_not_of_the_centre() {
    let hinge = [0.3, -0.2_f64];
    let bodies = json!({ "ground": { "points": { "O": [0.1, 0.5] } },
        "plate": { "mass": 2.0, "inertia": 0.1, "com": [0.1, 0.25], "points": { "P": hinge }, "pose": { "angle": 0.4 } } });
    let model = statics(
        bodies,
        json!({ "o": pin("ground.O", "plate.P") }),
        json!({}),
    );
    let found = linearised(&model, false);
    let [x, y, _] = found.bodies[0].1;
    let arm = [x - 0.1, y - 0.5];
    // The centre hangs below the hinge: the frame's origin is where both say.
    let hangs = (0.25 - hinge[1]).atan2(0.1 - hinge[0]);
    let turned = -FRAC_PI_2 - hangs;
    close(
        arm[0],
        -hinge[0] * turned.cos() + hinge[1] * turned.sin(),
        1e-12,
    );
    close(
        arm[1],
        -hinge[0] * turned.sin() - hinge[1] * turned.cos(),
        1e-12,
    );
    let shape = found.modes[0].shape[0];
    assert_eq!(shape[2], [1.0, 0.0]);
    close(shape[0][0], -arm[1], 1e-12);
    close(shape[1][0], arm[0], 1e-12);
    assert_eq!([shape[0][1], shape[1][1]], [0.0, 0.0]);
}

/// Two wheels, the first held by a spring with a damper, the second by a spring on the first: with (s² J₂ + k₂) θ₂ = k₂ θ₁ the
/// second lags by the argument of a complex number, and so does its frame, which is beside its axis.
#[test]
fn a_damped_shape_has_its_phases() {
    let (j1, j2, k1, k2, c) = (0.5, 0.2, 8.0, 6.0, 0.9);
    let beside = [0.2, 0.3];
    let wheel = |inertia: f64, x: f64| {
        json!({ "mass": 1.0, "inertia": inertia, "com": beside, "points": { "C": beside },
                "pose": { "position": [x - beside[0], -beside[1]] } })
    };
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0], "Q": [1.0, 0.0] } },
        "first": wheel(j1, 0.0), "second": wheel(j2, 1.0) });
    let joints = json!({ "o": pin("ground.O", "first.C"), "q": pin("ground.Q", "second.C") });
    let spring = |between: [&str; 2], stiffness: f64, damping: f64| json!({ "type": "torsion_spring", "between": between, "stiffness": stiffness, "damping": damping });
    let forces = json!({ "held": spring(["ground", "first"], k1, c), "between": spring(["first", "second"], k2, 0.0) });
    let found = linearised(&statics(bodies, joints, forces), false);
    assert_eq!(found.modes.len(), 2, "{:?}", found.modes);
    for mode in &found.modes {
        let [re, im] = mode.eigenvalue;
        assert!(re < -0.01 && im > 1.0, "{re} {im}");
        let square = [re * re - im * im, 2.0 * re * im];
        // (s² J₁ + s c + k₁ + k₂)(s² J₂ + k₂) = k₂²
        let second = [square[0] * j2 + k2, square[1] * j2];
        let first = [square[0] * j1 + re * c + k1 + k2, square[1] * j1 + im * c];
        let product = [
            first[0] * second[0] - first[1] * second[1] - k2 * k2,
            first[0] * second[1] + first[1] * second[0],
        ];
        assert!(product[0].hypot(product[1]) < 1e-11, "{product:?}");
        let [theta1, theta2] = [0, 1].map(|body| mode.shape[body][2]);
        close(
            k2 * theta1[0],
            second[0] * theta2[0] - second[1] * theta2[1],
            1e-12,
        );
        close(
            k2 * theta1[1],
            second[0] * theta2[1] + second[1] * theta2[0],
            1e-12,
        );
        // The larger is 1.
        let sizes = [theta1, theta2].map(|[re, im]| re.hypot(im));
        let largest = if sizes[0] > sizes[1] { theta1 } else { theta2 };
        close(largest[0], 1.0, 1e-13);
        close(largest[1], 0.0, 1e-13);
        for (body, theta) in [theta1, theta2].into_iter().enumerate() {
            let place = mode.shape[body];
            for part in 0..2 {
                close(place[0][part], beside[1] * theta[part], 1e-12);
                close(place[1][part], -beside[0] * theta[part], 1e-12);
            }
        }
    }
}
