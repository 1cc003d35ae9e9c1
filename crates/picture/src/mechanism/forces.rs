//! How springs, dampers, cables, actuators and drivers are drawn.

use super::cylinder::Lengths;
use super::parts::{At, Layer, Parts};
use crate::palette::{ACCENT, CARD, GROUND, INK, STEEL};
use crate::shape::{DriverKind, PointId, Spring, TorsionSpring};
use crate::sign::{Corner, Edge, Paint, along, bars, circle, line, metres};
use crate::symbols;

/// Radius of the round arrow of a driver, in bars: a coil has room in it.
const DRIVER: f64 = 2.7;
/// Distance of the arrow of a driven slide from its block, and half its length, in bars.
const BESIDE: [f64; 2] = [2.9, 3.0];
/// Half the length of a bar at the end of a stroke, and its width, in bars.
const STOP: f64 = 2.4;
const BAR: f64 = 0.6;
/// Width of the line of what is left of a stroke, in bars.
const LEFT: f64 = 0.15;
/// Ends of a stroke that are further than this, in lengths of the moment, are not drawn.
const NEAR: f64 = 1.6;
/// Radius of the end of a spring, in bars.
const END: f64 = 0.4;
/// Radius of the eye of an actuator, in bars.
const EYE: f64 = 0.95;
/// Half the length of the ground at the end of a spring, in bars.
const FOOT: f64 = 1.5;

impl Parts<'_> {
    /// Springs and dampers, straight ones and those around pins.
    pub fn add_forces(&mut self) {
        let mechanism = self.mechanism;
        for (spring, stretch) in mechanism.shape.springs.iter().zip(&mechanism.stretches) {
            self.add_spring(spring, *stretch);
        }
        for spring in &mechanism.shape.torsion_springs {
            self.add_torsion_spring(spring);
        }
    }

    fn add_spring(&mut self, spring: &Spring, stretch: [f64; 2]) {
        let ink = Paint::of(INK);
        if spring.actuator {
            self.add_actuator(spring, stretch);
        }
        for point in spring.between {
            if !spring.actuator {
                let end = circle("spring-end", Corner::default(), [0.0, END], ink, None);
                self.on(Layer::Springs, point, point.0, vec![end]);
            }
            self.add_foot(point);
        }
        let length = if self.for_all {
            stretch[1]
        } else {
            self.distance(spring.between)
        };
        let limits = spring.limits.unwrap_or_default();
        let limits = limits.map(|end| end.filter(|far| *far <= NEAR * length));
        // What is left of the stroke: without it a bar far off belongs to nothing.
        let left = limits[1].map(|far| {
            let ends = [along(1.0), metres(far, 0.0)];
            line("stop", ends, Edge::of(STEEL).wide(LEFT))
        });
        // Where the second point comes to the ends of its stroke.
        let bars = limits.into_iter().flatten().map(|far| {
            let bar = [STOP, -STOP].map(|across| metres(far, 0.0).beside(0.0, across));
            line("stop", bar, Edge::of(STEEL).wide(BAR))
        });
        self.between(
            Layer::Springs,
            spring.between,
            left.into_iter().chain(bars).collect(),
        );
        let sign = match (spring.cable, spring.actuator, spring.damper, spring.damped) {
            (true, ..) => vec![line("cable", [along(0.0), along(1.0)], Edge::of(INK))],
            (false, true, ..) => return,
            (false, false, true, _) => symbols::dashpot(),
            (false, false, false, true) => symbols::damped_spring(),
            (false, false, false, false) => symbols::spring(),
        };
        self.between(Layer::Springs, spring.between, sign);
    }

    /// Ground at the end of a spring that nothing else holds.
    fn add_foot(&mut self, point: PointId) {
        let mut joints = self.mechanism.shape.joints.iter();
        if point.0 == 0 && !joints.any(|joint| joint.between.contains(&point)) {
            let ends = [bars(-FOOT, 0.0), bars(FOOT, 0.0)];
            let sign = symbols::hatched_line(ends, self.bar, Edge::of(GROUND));
            self.upright(Layer::Springs, At::Point(point), vec![sign]);
        }
    }

    /// Barrel, piston and rod, with an eye at either end.
    fn add_actuator(&mut self, spring: &Spring, stretch: [f64; 2]) {
        let (lengths, edge) = (Lengths::of_actuator(stretch), Edge::of(INK));
        let barrel = lengths.barrel.map(|end| metres(end, 0.0));
        let rod = lengths.rod.map(|end| along(1.0).beyond(end, 0.0));
        let mut sign = symbols::rod(rod, (Paint::of(GROUND), edge));
        sign.extend(symbols::barrel(barrel, (Paint::of(CARD), edge)));
        sign.extend(symbols::piston(rod[0], edge));
        self.between(Layer::Springs, spring.between, sign);
        for point in spring.between {
            let (hole, ink) = (Paint::of(CARD), Paint::of(INK));
            let eye = circle("eye", Corner::default(), [0.0, EYE], hole, edge);
            let end = circle("spring-end", Corner::default(), [0.0, END], ink, None);
            self.on(Layer::Springs, point, point.0, vec![eye, end]);
        }
    }

    fn add_torsion_spring(&mut self, spring: &TorsionSpring) {
        let moving = spring.bodies.into_iter().find(|body| *body > 0);
        let at = self.around(spring.pin, moving.unwrap_or(0));
        if spring.damper {
            self.at(Layer::Coils, at, spring.bodies[1], symbols::round_dashpot());
            return;
        }
        self.upright(Layer::Coils, at, symbols::coil(spring.bodies));
        for (body, leg) in spring.bodies.into_iter().zip(symbols::legs()) {
            self.at(Layer::Coils, at, body, leg);
        }
    }

    /// An arrow around the pin to the left, or parallel to the guide: the positive direction of the driver's value.
    pub fn add_drivers(&mut self) {
        let (shape, edge) = (&self.mechanism.shape, Edge::of(ACCENT));
        let [away, half] = BESIDE;
        let along = || symbols::arrow("driver", [bars(-half, away), bars(half, away)], edge);
        for driver in &shape.drivers {
            match driver.kind {
                DriverKind::Rotation { body, pin, .. } => {
                    let sign = symbols::round_arrow("driver", DRIVER, true, edge);
                    self.upright(Layer::Drivers, self.around(pin, body), sign);
                }
                // It is drawn as the cylinder that it is.
                DriverKind::Length { .. } => {}
                DriverKind::Translation { joint } => {
                    let joint = &shape.joints[joint];
                    let Some(axis) = joint.axis() else { continue };
                    let [first, second] = joint.between;
                    self.with(Layer::Drivers, second, (first.0, axis), second.0, along());
                }
                DriverKind::Point { point, axis } => {
                    self.with(Layer::Drivers, point, (0, axis), point.0, along());
                }
            }
        }
    }
}
