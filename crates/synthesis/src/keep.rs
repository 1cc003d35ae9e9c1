//! What a linkage has to keep beside the wanted positions, each as a residual that is 0 where it is kept: directions, lengths of links, the
//! angle of transmission.
//!
//! Lengths and angles are limited from one side, so that least squares stops a little outside a limit that is in its way. Therefore it
//! aims a little inside, with a large weight.

use crate::linkage::{Linkage, Places};
use linkdyn_linear::bilinear::Number;
use std::f64::consts::FRAC_PI_2;

/// How far inside the limits, in parts of them.
const MARGIN: f64 = 0.02;
const WEIGHT: f64 = 10.0;

/// What is to be kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kept {
    /// Least and greatest distance of two pins of a moving body.
    pub lengths: [f64; 2],
    /// Least angle of transmission \[rad\].
    pub transmission: Option<f64>,
}

/// A residual, and its derivatives by x and y of pins, as complex numbers, and by the angles of bodies.
#[derive(Debug, Clone, Default)]
pub struct Residual {
    /// Its value.
    pub value: f64,
    /// Numbers of joints, and derivatives.
    pub by_pins: Vec<(usize, Number)>,
    /// Numbers of bodies, and derivatives.
    pub by_bodies: Vec<(usize, f64)>,
}

/// Numbers and places of the pins of a body.
fn pins(linkage: &Linkage, body: usize) -> Vec<(usize, Number)> {
    let joints = linkage.joints.iter().enumerate();
    let own = joints.filter(|(_, joint)| joint.bodies.contains(&body));
    own.filter_map(|(k, joint)| Some((k, joint.pin()?)))
        .collect()
}

impl Residual {
    /// That of the direction from the ground pin of a body to its next pin; 0 if it has none.
    pub fn of_direction(linkage: &Linkage, body: usize, direction: f64) -> Residual {
        let own = pins(linkage, body);
        let is_ground = |(k, _): &&(usize, Number)| linkage.joints[*k].bodies.contains(&0);
        let from = own.iter().find(is_ground);
        let to = from.and_then(|from| own.iter().find(|to| to.0 != from.0));
        let Some(((from, a), (to, b))) = from.zip(to) else {
            return Residual::default();
        };
        let back = Number::from_polar(1.0, -direction);
        let by = Number::new(back.im, back.re);
        Residual {
            value: (back * (b - a)).im,
            by_pins: vec![(*from, -by), (*to, by)],
            by_bodies: Vec::new(),
        }
    }

    /// Those of the lengths of all moving bodies.
    pub fn of_lengths(linkage: &Linkage, [low, high]: [f64; 2]) -> Vec<Residual> {
        let (low, high) = (low * (1.0 + MARGIN), high * (1.0 - MARGIN));
        // Where the limits are next to each other, their middle is aimed at.
        let middle = 0.5 * (low + high);
        let (low, high) = (low.min(middle), high.max(middle));
        let of = |(from, a): (usize, Number), (to, b): (usize, Number)| {
            let length = (b - a).norm();
            let over = length - length.clamp(low, high);
            if over == 0.0 || length == 0.0 {
                return Residual::default();
            }
            let by = (b - a) / length * WEIGHT;
            Residual {
                value: WEIGHT * over,
                by_pins: vec![(from, -by), (to, by)],
                by_bodies: Vec::new(),
            }
        };
        let mut all = Vec::new();
        for body in 1..linkage.bodies {
            let own = pins(linkage, body);
            for (k, to) in own.iter().enumerate() {
                all.extend(own[..k].iter().map(|from| of(*from, *to)));
            }
        }
        all
    }

    /// Those of the angles of transmission at a place: between the last link, from its pin to its pivot, and a link with two pins that
    /// pushes it.
    pub fn of_transmission(linkage: &Linkage, places: &Places, least: f64) -> Vec<Residual> {
        let Some((last, driven)) = linkage.transmitted() else {
            return Vec::new();
        };
        let least = (least * (1.0 + MARGIN)).min(FRAC_PI_2).sin();
        let of = |pin: usize| {
            let bodies = linkage.joints[pin].bodies;
            let link = bodies[usize::from(bodies[0] == last)];
            let own = pins(linkage, last);
            let (pivot, g) = own
                .iter()
                .find(|(k, _)| linkage.joints[*k].bodies.contains(&0))?;
            let [(one, p), (two, q)] = pins(linkage, link)[..] else {
                return None;
            };
            let ((_, at), (other, far)) = match one == pin {
                true => ((one, p), (two, q)),
                false => ((two, q), (one, p)),
            };
            let turn = |body| linkage.position(places, body).turn;
            let (u, v) = (far - at, *g - at);
            let angle = (turn(last) * v / (turn(link) * u)).arg();
            let under = least - angle.sin().abs();
            if under <= 0.0 || !angle.is_finite() {
                return Some(Residual::default());
            }
            // Of the angle: of a direction w by its end i w/|w|².
            let by = -WEIGHT * angle.cos() * angle.sin().signum();
            let [by_u, by_v] = [u, v].map(|w| Number::i() * w / w.norm_sqr() * by);
            Some(Residual {
                value: WEIGHT * under,
                by_pins: vec![(other, -by_u), (*pivot, by_v), (pin, by_u - by_v)],
                by_bodies: vec![(last, by), (link, -by)],
            })
        };
        driven.into_iter().filter_map(of).collect()
    }
}
