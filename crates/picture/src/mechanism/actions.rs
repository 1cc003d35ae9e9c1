//! Draws what acts in one pose: springs and dampers, drivers, loads.

use super::cylinder::Lengths;
use super::sketch::Sketch;
use super::values::Values;
use crate::palette;
use crate::scene::{Pen, Place, Scene};
use crate::shape::{DriverKind, Spring, TorsionSpring};
use crate::symbols::{self, Cylinder};
use crate::words;

/// Radii of the round arrows of drivers and of torques, in bars: a coil has room in them.
const DRIVER: f64 = 2.7;
const TORQUE: f64 = 3.6;
/// Length of the arrow of the largest force, in bars.
const LARGEST: f64 = 11.0;
/// Width of arrows, in bars.
const ARROW: f64 = 0.32;
/// A force this small beside the largest is none.
const NONE: f64 = 1e-9;
/// Half the length of a bar at the end of a stroke, in bars.
const STOP: f64 = 2.4;
/// Ends of a stroke that are further than this, in lengths of the moment, are not drawn.
const NEAR: f64 = 1.6;
/// Radius of the end of a spring, in bars.
const END: f64 = 0.4;
/// Radius of the eye of an actuator, in bars.
const EYE: f64 = 0.95;

/// Springs and dampers between points.
pub fn draw_springs(scene: &mut Scene, sketch: &Sketch) {
    let stretches = &sketch.mechanism.stretches;
    for (spring, stretch) in sketch.mechanism.shape.springs.iter().zip(stretches) {
        draw_spring(scene, sketch, spring, *stretch);
    }
}

/// Coils, drivers and loads at a time \[s\]: what would cover too much in a picture of many poses.
pub fn draw_actions(scene: &mut Scene, sketch: &Sketch, time: f64) {
    for spring in &sketch.mechanism.shape.torsion_springs {
        draw_torsion_spring(scene, sketch, spring);
    }
    for driver in &sketch.mechanism.shape.drivers {
        draw_driver(scene, sketch, driver.kind);
    }
    draw_loads(scene, sketch, time);
}

fn draw_spring(scene: &mut Scene, sketch: &Sketch, spring: &Spring, stretch: [f64; 2]) {
    let (bar, pen) = (sketch.bar(), sketch.pen(palette::INK));
    let ends = spring.between.map(|end| sketch.at(end));
    if spring.actuator {
        draw_actuator(scene, sketch, ends, stretch);
    }
    for (point, [x, y]) in spring.between.into_iter().zip(ends) {
        if !spring.actuator {
            scene.circle("spring-end", [x, y], END * bar, Some(pen.ink), None);
        }
        let joints = &sketch.mechanism.shape.joints;
        let is_held = joints.iter().any(|joint| joint.between.contains(&point));
        if point.0 == 0 && !is_held {
            let line = [[x - 1.5 * bar, y], [x + 1.5 * bar, y]];
            symbols::hatched_line(scene, line, bar, sketch.pen(palette::GROUND));
        }
    }
    draw_limits(scene, sketch, spring, ends);
    if spring.cable {
        return scene.line("cable", ends.to_vec(), pen);
    }
    match (spring.actuator, spring.damper, spring.damped) {
        (true, ..) => {}
        (false, true, _) => symbols::dashpot(scene, ends, bar, pen),
        (false, false, true) => symbols::damped_spring(scene, ends, bar, pen),
        (false, false, false) => symbols::spring(scene, ends, bar, pen),
    }
}

/// Bars across the line where the second point comes to the ends of its stroke, but for those that are far beyond it.
fn draw_limits(scene: &mut Scene, sketch: &Sketch, spring: &Spring, [[x, y], tip]: [Place; 2]) {
    let [dx, dy] = [tip[0] - x, tip[1] - y];
    let length = dx.hypot(dy);
    if length == 0.0 {
        return;
    }
    let ([u, v], bar) = ([dx / length, dy / length], sketch.bar());
    let limits = spring.limits.unwrap_or_default().into_iter().flatten();
    for far in limits.map(|limit| limit * sketch.view.scale) {
        if far <= NEAR * length {
            let at = |across: f64| [x + far * u - across * v, y + far * v + across * u];
            let width = 0.6 * bar;
            let pen = sketch.pen(palette::STEEL);
            scene.line(
                "stop",
                [at(-STOP * bar), at(STOP * bar)],
                Pen { width, ..pen },
            );
        }
    }
}

/// Barrel, piston and rod, with an eye at either end.
fn draw_actuator(scene: &mut Scene, sketch: &Sketch, ends: [Place; 2], stretch: [f64; 2]) {
    let [[x, y], tip] = ends;
    let length = (tip[0] - x).hypot(tip[1] - y);
    let (bar, pen) = (sketch.bar(), sketch.pen(palette::INK));
    if length > 0.0 {
        let lengths = Lengths::of_actuator(stretch);
        let scale = sketch.view.scale;
        let cylinder = Cylinder {
            origin: [x, y],
            along: [(tip[0] - x) / length, (tip[1] - y) / length],
            barrel: lengths.barrel.map(|far| far * scale),
            rod: lengths.rod.map(|far| (length + far * scale).max(0.0)),
        };
        let [barrel, rod] = [palette::CARD, palette::GROUND].map(|tone| (sketch.ink(tone), pen));
        symbols::cylinder(scene, &cylinder, bar, barrel, rod);
    }
    let hole = Some(sketch.ink(palette::CARD));
    for end in ends {
        scene.circle("eye", end, EYE * bar, hole, Some(pen));
        scene.circle("spring-end", end, END * bar, Some(pen.ink), None);
    }
}

fn draw_torsion_spring(scene: &mut Scene, sketch: &Sketch, spring: &TorsionSpring) {
    let moving = spring.bodies.into_iter().find(|body| *body > 0);
    let centre = around(sketch, spring.pin, moving.unwrap_or(0));
    let angles = spring.bodies.map(|body| sketch.pose[body][2]);
    let (bar, pen) = (sketch.bar(), sketch.pen(palette::INK));
    if spring.damper {
        symbols::round_dashpot(scene, centre, angles[1], bar, pen);
    } else {
        symbols::coil(scene, centre, angles, bar, pen);
    }
}

/// An arrow around the pin to the left, or beside the guide along its axis: the way in which the driver's value counts.
fn draw_driver(scene: &mut Scene, sketch: &Sketch, driver: DriverKind) {
    let (bar, pen) = (sketch.bar(), arrow_pen(sketch, palette::ACCENT));
    match driver {
        DriverKind::Rotation { body, pin, .. } => {
            let centre = around(sketch, pin, body);
            symbols::round_arrow(scene, "driver", (centre, DRIVER), true, bar, pen);
        }
        // It is drawn as the cylinder that it is.
        DriverKind::Length { .. } => {}
        DriverKind::Translation { joint } => {
            let joint = &sketch.mechanism.shape.joints[joint];
            let Some([u, v]) = sketch.direction(joint) else {
                return;
            };
            let [x, y] = sketch.at(joint.between[1]);
            let [away, half] = [2.9 * bar, 3.0 * bar];
            let middle = [x + away * v, y - away * u];
            let ends = [-half, half].map(|far| [middle[0] + far * u, middle[1] + far * v]);
            symbols::arrow(scene, "driver", ends, bar, pen);
        }
    }
}

/// Forces with their head at the point they push on, the largest one over time with a fixed length; torques around the body.
/// Each has its value at its free end.
fn draw_loads(scene: &mut Scene, sketch: &Sketch, time: f64) {
    let (bar, pen) = (sketch.bar(), arrow_pen(sketch, palette::LOAD));
    let mut values = Values::new(sketch.view, pen.ink);
    for load in &sketch.mechanism.shape.loads {
        let Some([x, y]) = load.at_time(time) else {
            continue;
        };
        let Some(point) = load.at else {
            if x != 0.0 {
                let centre = sketch.body_at(load.body);
                symbols::round_arrow(scene, "load", (centre, TORQUE), x > 0.0, bar, pen);
                let above = [centre[0], centre[1] - TORQUE * bar];
                values.write(scene, above, [0.0, -1.0], &words::quantity(x, "N*m"));
            }
            continue;
        };
        let size = x.hypot(y);
        if size <= NONE * sketch.mechanism.largest_load {
            continue;
        }
        let at = sketch.at(point);
        let [dx, dy] = [x, -y].map(|force| LARGEST * bar * (force / sketch.mechanism.largest_load));
        let tail = [at[0] - dx, at[1] - dy];
        // Where there is no room for the tail the arrow begins at the point.
        let (ends, free, sign) = if sketch.view.shows(tail) {
            ([tail, at], tail, -1.0)
        } else {
            let head = [at[0] + dx, at[1] + dy];
            ([at, head], head, 1.0)
        };
        symbols::arrow(scene, "load", ends, bar, pen);
        let away = [sign * x / size, -sign * y / size];
        values.write(scene, free, away, &words::quantity(size, "N"));
    }
}

fn arrow_pen(sketch: &Sketch, tone: palette::Tone) -> Pen {
    Pen {
        width: ARROW * sketch.bar(),
        ..sketch.pen(tone)
    }
}

/// Where something turns: around a pin, else at a body.
fn around(sketch: &Sketch, pin: Option<usize>, body: usize) -> Place {
    match pin {
        Some(joint) => sketch.at(sketch.mechanism.shape.joints[joint].between[1]),
        None => sketch.body_at(body),
    }
}
