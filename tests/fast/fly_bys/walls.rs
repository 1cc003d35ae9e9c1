//! A disc within closed walls: a billiard.

use super::{body, last, run, touches, tries, with};
use crate::linkage::Random;
use crate::mechanisms::column;
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// Impacts that are followed: what a rounding error becomes grows with each.
const FOLLOWED: usize = 6;

/// A convex polygon, clockwise: its corners on an ellipse.
fn polygon(random: &mut Random) -> Vec<[f64; 2]> {
    let count = 3 + random.below(38);
    let (wide, high) = (random.within(0.6, 1.5), random.within(0.6, 1.5));
    let shift = random.within(0.0, TAU);
    let corner = |k: usize| {
        let angle = shift - TAU * (k as f64 + 0.3 * random.signed()) / count as f64;
        [wide * angle.cos(), high * angle.sin()]
    };
    (0..count).map(corner).collect()
}

/// A disc's centre that moves freely until it is as near to a wall as its radius.
struct Disc<'a> {
    walls: &'a [[f64; 2]],
    radius: f64,
    gravity: f64,
    place: [f64; 2],
    speed: [f64; 2],
}

impl Disc<'_> {
    /// Each wall's normal outwards, and how far the centre may go along it.
    fn sides(&self) -> impl Iterator<Item = ([f64; 2], f64)> {
        (0..self.walls.len()).map(|k| {
            let (a, b) = (self.walls[k], self.walls[(k + 1) % self.walls.len()]);
            let (x, y) = (b[0] - a[0], b[1] - a[1]);
            let length = x.hypot(y);
            let normal = [-y / length, x / length];
            (normal, normal[0] * a[0] + normal[1] * a[1] - self.radius)
        })
    }

    /// The time to the next wall, and its normal.
    fn next(&self) -> Option<(f64, [f64; 2])> {
        let times = self.sides().filter_map(|(n, far)| {
            // a t² + 2 b t + c = 0, from below: c ≤ 0
            let a = -0.5 * self.gravity * n[1];
            let b = 0.5 * (n[0] * self.speed[0] + n[1] * self.speed[1]);
            let c = n[0] * self.place[0] + n[1] * self.place[1] - far;
            let root = (b * b - a * c).sqrt();
            let time = if b > 0.0 {
                -c / (b + root)
            } else {
                (root - b) / a
            };
            let arrives = 2.0 * (b + a * time) > 0.0;
            (time.is_finite() && time > 1e-12 && arrives).then_some((time, n))
        });
        times.min_by(|one, other| one.0.total_cmp(&other.0))
    }

    fn fly(&mut self, time: f64) {
        self.place[0] += time * self.speed[0];
        self.place[1] += time * (self.speed[1] - 0.5 * self.gravity * time);
        self.speed[1] -= self.gravity * time;
    }
}

fn model(disc: &Disc, touch: Value) -> Value {
    let mut outline = disc.walls.to_vec();
    outline.push(disc.walls[0]);
    let mut contact = json!({ "type": "contact", "between": ["ground.O", "b.P"], "outline": outline, "radius": disc.radius });
    let more = touch.as_object().expect("an object").clone();
    contact.as_object_mut().expect("an object").extend(more);
    let model = with(
        body(disc.place, disc.speed, 0.0),
        "joints",
        json!({ "c": contact }),
    );
    with(model, "gravity", json!([0.0, -disc.gravity]))
}

/// No wall is passed: the first impacts are those of a billiard, and at the end the disc is within.
#[test]
fn a_disc_stays_within_its_walls() {
    let mut random = Random(15);
    for _ in 0..tries() {
        let walls = polygon(&mut random);
        let radius = [0.0, 0.02, 0.05][random.below(3)];
        let gravity = [0.0, 9.81][random.below(2)];
        let e = random.within(0.4, 1.0);
        let mut disc = Disc {
            walls: &walls,
            radius,
            gravity,
            place: [0.1 * random.signed(), 0.1 * random.signed()],
            speed: [2.0 * random.signed(), 2.0 * random.signed()],
        };
        let (model, rtol) = (
            model(&disc, json!({ "restitution": e })),
            random.tolerance(),
        );
        let mut expected = Vec::new();
        let mut time = 0.0;
        while let Some((flies, n)) = disc.next() {
            time += flies;
            disc.fly(flies);
            expected.push(time);
            if expected.len() == FOLLOWED {
                break;
            }
            let approach = n[0] * disc.speed[0] + n[1] * disc.speed[1];
            disc.speed = [0, 1].map(|k| disc.speed[k] - (1.0 + e) * approach * n[k]);
        }
        let run = run(model.clone(), 1.01 * time, json!({ "rtol": rtol }));
        let found = touches(&run);
        assert!(
            found.len() >= expected.len(),
            "{found:?} for {expected:?}, rtol {rtol:e}: {model}"
        );
        for (found, expected) in found.iter().zip(&expected) {
            assert!(
                (found - expected).abs() < 1e-6 * (1.0 + time),
                "{found} for {expected}, rtol {rtol:e}: {model}"
            );
        }
        disc.place = ["b.x", "b.y"].map(|name| last(&run, name));
        let mut sides = disc.sides();
        assert!(
            sides.all(|(n, far)| n[0] * disc.place[0] + n[1] * disc.place[1] <= far + 1e-7),
            "{:?}: {model}",
            disc.place
        );
    }
}

/// With friction, too, and whatever the walls are, the disc stays within and gains no energy.
#[test]
fn a_disc_with_friction_gains_no_energy() {
    let mut random = Random(17);
    for _ in 0..tries() / 2 {
        let walls = polygon(&mut random);
        let disc = Disc {
            walls: &walls,
            radius: [0.0, 0.05][random.below(2)],
            gravity: [0.0, 9.81][random.below(2)],
            place: [0.1 * random.signed(), 0.1 * random.signed()],
            speed: [2.0 * random.signed(), 2.0 * random.signed()],
        };
        let friction = json!({ "law": "coulomb", "coefficient": random.within(0.05, 0.8), "threshold_velocity": 1e-3 });
        let rigid = json!({ "restitution": random.within(0.2, 0.9), "sense": "energetic", "friction": friction });
        let yields = json!({ "stiffness": 2e4, "damping": 20.0 });
        let touch = if random.below(3) == 0 { yields } else { rigid };
        let mut model = model(&disc, touch);
        model["bodies"]["b"]["inertia"] = json!(0.002);
        let run = run(model.clone(), 1.5, json!({ "rtol": random.tolerance() }));
        let of = |name: &str| column(&run, name);
        let (vx, vy, omega, y) = (of("b.vx"), of("b.vy"), of("b.omega"), of("b.y"));
        let energy = |row: usize| {
            let moving = vx[row].powi(2) + vy[row].powi(2) + 0.002 * omega[row].powi(2);
            0.5 * moving + disc.gravity * y[row]
        };
        let rows = vx.len();
        assert!(
            energy(rows - 1) <= energy(0) + 1e-3 * (1.0 + energy(0).abs()),
            "{model}"
        );
        let place = ["b.x", "b.y"].map(|name| last(&run, name));
        let mut sides = disc.sides();
        assert!(
            sides.all(|(n, far)| n[0] * place[0] + n[1] * place[1] <= far + 0.02),
            "{place:?}: {model}"
        );
    }
}

/// In a round room, of some arcs, each flight between two impacts is as long as the one before.
#[test]
fn a_point_goes_round_in_a_circle_of_arcs() {
    let mut random = Random(16);
    for _ in 0..tries() {
        let count = 3 + random.below(38);
        let corner = |k: usize| {
            let angle = -TAU * (k % count) as f64 / count as f64;
            [angle.cos(), angle.sin()]
        };
        let outline: Vec<Value> = (0..=count)
            .map(|k| match k {
                0 => json!(corner(0)),
                _ => json!([corner(k)[0], corner(k)[1], -1.0]),
            })
            .collect();
        let (radius, aside) = ([0.0, 0.05][random.below(2)], random.within(0.0, 0.9));
        let contact = json!({ "type": "contact", "between": ["ground.O", "b.P"], "outline": outline, "radius": radius, "restitution": 1.0 });
        let (turn, speed) = (TAU * random.signed(), random.within(0.5, 4.0));
        let (sin, cos) = turn.sin_cos();
        let model = with(
            body([-aside * sin, aside * cos], [speed * cos, speed * sin], 0.0),
            "joints",
            json!({ "c": contact }),
        );
        let far = 1.0 - radius;
        let half = (far * far - aside * aside).sqrt() / speed;
        let rtol = random.tolerance();
        let run = run(model.clone(), 12.5 * half, json!({ "rtol": rtol }));
        let found = touches(&run);
        assert_eq!(found.len(), 6, "{found:?}, rtol {rtol:e}: {model}");
        for (k, found) in found.iter().enumerate() {
            let expected = half * (2 * k + 1) as f64;
            assert!(
                (found - expected).abs() < 1e-6 * (1.0 + expected),
                "{found} for {expected}"
            );
        }
    }
}

/// A room about the origin with corners that stand in and others that are hollow, clockwise.
fn room(random: &mut Random) -> Vec<[f64; 2]> {
    let count = 3 + random.below(38);
    let mut corner = |k: usize| {
        let angle = -TAU * k as f64 / count as f64;
        let far = random.within(0.5, 1.5);
        [far * angle.cos(), far * angle.sin()]
    };
    (0..count).map(&mut corner).collect()
}

/// How far a place in a room is from its walls; less than 0 outside.
fn clear(walls: &[[f64; 2]], [x, y]: [f64; 2]) -> f64 {
    let (mut nearest, mut is_inside) = (f64::INFINITY, false);
    for (k, &[ax, ay]) in walls.iter().enumerate() {
        let [bx, by] = walls[(k + 1) % walls.len()];
        let (dx, dy) = (bx - ax, by - ay);
        let along = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy);
        let along = along.clamp(0.0, 1.0);
        nearest = nearest.min((ax + along * dx - x).hypot(ay + along * dy - y));
        if (ay > y) != (by > y) && x < ax + dx * (y - ay) / dy {
            is_inside = !is_inside;
        }
    }
    if is_inside { nearest } else { -nearest }
}

/// Discs and points among corners that stand in touch what they touch in short steps, and never leave.
#[test]
fn nothing_leaves_a_room_with_corners_that_stand_in() {
    let mut random = Random(18);
    for _ in 0..tries() {
        let walls = room(&mut random);
        let disc = Disc {
            walls: &walls,
            radius: [0.0, 0.05][random.below(2)],
            gravity: [0.0, 9.81][random.below(2)],
            place: [0.1 * random.signed(), 0.1 * random.signed()],
            speed: [2.0 * random.signed(), 2.0 * random.signed()],
        };
        let yields = random.below(3) == 0;
        let touch = match yields {
            true => json!({ "stiffness": 2e6, "damping": 20.0 }),
            false => json!({ "restitution": random.within(0.2, 1.0) }),
        };
        let (model, end) = (model(&disc, touch), 1.5);
        let found = run(model.clone(), end, json!({ "rtol": random.tolerance() }));
        let fine = json!({ "rtol": 1e-10, "max_step": 1e-3 * end });
        let fine = touches(&run(model.clone(), end, fine));
        for (found, fine) in touches(&found).iter().zip(&fine).take(3) {
            assert!((found - fine).abs() < 1e-5, "{found} for {fine}: {model}");
        }
        let places = column(&found, "b.x").into_iter().zip(column(&found, "b.y"));
        // v/ω₀ of the fastest: 6 m/s after a fall through the room
        let deep = if yields { 6.0 / 2e6_f64.sqrt() } else { 1e-7 };
        for (x, y) in places {
            let clear = clear(&walls, [x, y]) - disc.radius;
            assert!(clear > -deep, "{clear:e} at {x}, {y}: {model}");
        }
    }
}
