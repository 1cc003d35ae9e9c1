//! Cams: a profile on the first body moves a follower on the second.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::motion::RiseLaw;

/// A cam and its follower.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Cam {
    /// What touches the profile.
    pub follower: Follower,
    /// Direction of a flat face in the follower's frame; the cam lies to its right.
    pub face: Option<[f64; 2]>,
    /// Radius of a roller \[m\].
    pub roller_radius: Option<f64>,
    /// The shape of the cam, or the motion that it gives.
    pub profile: Profile,
}

/// What touches the profile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Follower {
    /// A straight face through the follower's point.
    Flat,
    /// A roller about the follower's point.
    Roller,
    /// The follower's point itself.
    Knife,
}

/// The shape of a cam about its point, or the motion that it gives.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Profile {
    /// A circle: an eccentric.
    Circle {
        /// From the cam's point, in its frame \[m\].
        #[serde(default)]
        centre: [f64; 2],
        /// \[m\]
        radius: f64,
    },
    /// A closed curve through points, a periodic spline of the radius over the angle.
    Points {
        /// From the cam's point, in its frame, once around it \[m\].
        points: Vec<[f64; 2]>,
    },
    /// The motion of a follower that slides.
    Law {
        /// Radius of the base circle \[m\].
        base_radius: f64,
        /// Direction away from the cam in which the follower slides, in its frame.
        axis: Option<[f64; 2]>,
        /// How far to the right of the cam's point the line lies on which the follower slides \[m\].
        #[serde(default)]
        offset: f64,
        /// Angle of the cam against the follower at which the segments begin \[rad\].
        #[serde(default)]
        begin: f64,
        /// Rises and dwells in their order.
        segments: Vec<CamSegment>,
    },
    /// The motion of a follower on an arm.
    Swing {
        /// Distance of the follower's point from the pivot of its arm \[m\].
        arm: f64,
        /// Distance of the pivot from the cam's point \[m\].
        distance: f64,
        /// Direction from the cam's point to the pivot, in the frame of the body that bears both.
        axis: [f64; 2],
        /// Angle at the pivot from the cam's point to the follower's, before the first rise \[rad\].
        angle: f64,
        /// Angle of the cam against that body at which the segments begin \[rad\].
        #[serde(default)]
        begin: f64,
        /// Rises and dwells in their order.
        segments: Vec<CamSegment>,
    },
}

/// A part of a turn: a rise by a law, or a dwell.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
pub struct CamSegment {
    /// How it rises.
    pub law: Option<RiseLaw>,
    /// How far it goes [m or rad].
    pub rise: Option<f64>,
    /// Value after, instead [m or rad].
    pub end: Option<f64>,
    /// Angle of the cam over which it goes \[rad\].
    pub angle: Option<f64>,
    /// As of [`crate::Paced`].
    pub ramp: Option<f64>,
    /// As of [`crate::Paced`].
    pub rounding: Option<f64>,
    /// Angle of the cam over which it stays where it is \[rad\].
    pub dwell: Option<f64>,
}

/// Part of a turn by which angles of segments may be more than one: round-off of degrees \[rad\].
pub(crate) const ROUND_OFF: f64 = 1e-9;

impl CamSegment {
    /// How far it goes from a value [m or rad].
    pub fn height(&self, from: f64) -> f64 {
        match (self.law, self.rise, self.end) {
            (None, ..) => 0.0,
            (_, Some(rise), _) => rise,
            (_, None, Some(end)) => end - from,
            (_, None, None) => 0.0,
        }
    }

    /// Angle of the cam over which it goes \[rad\].
    pub fn span(&self) -> f64 {
        self.angle.or(self.dwell).unwrap_or(0.0)
    }
}

/// What segments come to: the angle over which they go \[rad\], and the values after each, from 0 on.
pub(crate) fn course(segments: &[CamSegment]) -> (f64, Vec<f64>) {
    let span = segments.iter().map(CamSegment::span).sum();
    let values = segments.iter().scan(0.0, |value, segment| {
        *value += segment.height(*value);
        Some(*value)
    });
    (span, values.collect())
}

/// Angles of points about the origin \[rad\], increasing, in their order or the other way round; `None` if they do not go
/// once around it.
pub(crate) fn around(points: &[[f64; 2]]) -> Option<Vec<f64>> {
    let direction = |point: &[f64; 2]| point[1].atan2(point[0]);
    let turn = |from: &[f64; 2], to: &[f64; 2]| {
        let step = direction(to) - direction(from);
        step - TAU * (step / TAU).round()
    };
    let first = points.first()?;
    let next = points.iter().skip(1).chain([first]);
    let turns: Vec<f64> = points.iter().zip(next).map(|(a, b)| turn(a, b)).collect();
    let sense = turns.first()?.signum();
    let whole: f64 = turns.iter().sum();
    let is_around = points.iter().all(|point| *point != [0.0, 0.0])
        && turns.iter().all(|turn| turn * sense > 0.0)
        && (whole.abs() - TAU).abs() < 1e-6;
    if !is_around {
        return None;
    }
    let angles = turns.iter().scan(direction(first), |angle, turn| {
        Some(std::mem::replace(angle, *angle + turn))
    });
    Some(angles.collect())
}

impl Profile {
    /// Points of a curve by angle and radius [rad, m], angles increasing over less than a turn; none of other profiles, or where
    /// the curve does not go once around the cam's point.
    pub fn polar(&self) -> Option<Vec<[f64; 2]>> {
        let Profile::Points { points } = self else {
            return None;
        };
        let angles = around(points)?;
        let polar = angles.iter().zip(points);
        let mut polar: Vec<[f64; 2]> = polar
            .map(|(&angle, point)| [angle, point[0].hypot(point[1])])
            .collect();
        if polar.last()?[0] < polar.first()?[0] {
            polar.reverse();
        }
        Some(polar)
    }

    /// The segments of a motion.
    pub fn segments(&self) -> &[CamSegment] {
        match self {
            Profile::Circle { .. } | Profile::Points { .. } => &[],
            Profile::Law { segments, .. } | Profile::Swing { segments, .. } => segments,
        }
    }
}

impl Profile {
    /// How far the profile, or the follower on it, gets from the cam's point \[m\].
    pub fn reach(&self) -> f64 {
        match self {
            Profile::Circle { centre, radius } => centre[0].hypot(centre[1]) + radius,
            Profile::Points { points } => {
                let far = points.iter().map(|point| point[0].hypot(point[1]));
                far.fold(0.0, f64::max)
            }
            Profile::Law {
                base_radius,
                segments,
                ..
            } => base_radius + course(segments).1.into_iter().fold(0.0, f64::max),
            Profile::Swing { distance, .. } => *distance,
        }
    }
}
