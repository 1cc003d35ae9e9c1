//! Bodies: points, mass, pose guess, and initial values.

use crate::elastic::ElasticLink;
use crate::section::LinkSection;
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

/// A rigid body. `ground` has only points.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(from = "BodyWords", into = "BodyWords")]
pub struct Body {
    /// Mass \[kg\].
    pub mass: Option<f64>,
    /// Moment of inertia about the centre of mass [kg·m²].
    pub inertia: Option<f64>,
    /// Centre of mass in the body's frame \[m\]; has no default where there is mass.
    pub com: Option<[f64; 2]>,
    /// Named points in the body's frame \[m\].
    pub points: IndexMap<String, [f64; 2]>,
    /// Diameters of the position tolerance zones of those points that have one \[m\].
    pub point_tolerances: IndexMap<String, f64>,
    /// Where the body's frame is guessed to be.
    pub pose: Pose,
    /// Its cross-section, of a straight link of which internal forces are requested.
    pub section: Option<Box<LinkSection>>,
    /// That it bends.
    pub elastic: Option<Box<ElasticLink>>,
}

/// Guess of a body frame's place for the assembly.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Pose {
    /// Origin \[m\].
    pub position: [f64; 2],
    /// Angle \[rad\].
    pub angle: f64,
}

/// Exact values at t = 0 of a body's coordinates (frame origin) and velocities.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Initial {
    /// Frame origin \[m\].
    pub x: Option<f64>,
    /// Frame origin \[m\].
    pub y: Option<f64>,
    /// Angle \[rad\].
    pub angle: Option<f64>,
    /// Velocity of the frame origin [m/s].
    pub vx: Option<f64>,
    /// Velocity of the frame origin [m/s].
    pub vy: Option<f64>,
    /// Angular velocity [rad/s].
    pub angular_velocity: Option<f64>,
    /// How it turns, by the others, on the branch of motion on which a singular start is left.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub branch: Option<f64>,
}

/// A body as a file has it: its points with their tolerances.
#[derive(Deserialize, Serialize)]
struct BodyWords {
    mass: Option<f64>,
    inertia: Option<f64>,
    com: Option<[f64; 2]>,
    #[serde(default)]
    points: IndexMap<String, PointWords>,
    #[serde(default)]
    pose: Pose,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    section: Option<Box<LinkSection>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    elastic: Option<Box<ElasticLink>>,
}

/// Two coordinates, or these with a tolerance.
#[derive(Deserialize, Serialize)]
#[serde(untagged)]
enum PointWords {
    Exact([f64; 2]),
    Tolerated {
        position: [f64; 2],
        tolerance: Option<f64>,
    },
}

impl From<BodyWords> for Body {
    fn from(words: BodyWords) -> Self {
        let mut body = Body {
            mass: words.mass,
            inertia: words.inertia,
            com: words.com,
            points: IndexMap::with_capacity(words.points.len()),
            point_tolerances: IndexMap::new(),
            pose: words.pose,
            section: words.section,
            elastic: words.elastic,
        };
        for (name, place) in words.points {
            let (position, tolerance) = match place {
                PointWords::Exact(position) => (position, None),
                PointWords::Tolerated {
                    position,
                    tolerance,
                } => (position, tolerance),
            };
            let tolerance = tolerance.map(|tolerance| (name.clone(), tolerance));
            body.point_tolerances.extend(tolerance);
            body.points.insert(name, position);
        }
        body.fill_from_elastic();
        body
    }
}

impl From<Body> for BodyWords {
    fn from(body: Body) -> Self {
        let place = |(name, position): (String, [f64; 2])| {
            let place = match body.point_tolerances.get(&name) {
                None => PointWords::Exact(position),
                Some(&tolerance) => PointWords::Tolerated {
                    position,
                    tolerance: Some(tolerance),
                },
            };
            (name, place)
        };
        BodyWords {
            mass: body.mass,
            inertia: body.inertia,
            com: body.com,
            points: body.points.into_iter().map(place).collect(),
            pose: body.pose,
            section: body.section,
            elastic: body.elastic,
        }
    }
}

impl ElasticLink {
    /// Its ends in the frame of the body \[m\], where they are points of it.
    pub fn ends(&self, body: &Body) -> Option<[[f64; 2]; 2]> {
        let end = |name: &String| body.points.get(name).copied();
        Some([end(&self.from)?, end(&self.to)?])
    }
}

impl Body {
    /// Mass, inertia about the centre of mass and centre of mass of the bar that an elastic body is [kg, kg·m², m].
    pub fn of_bar(&self) -> Option<(f64, f64, [f64; 2])> {
        let elastic = self.elastic.as_deref()?;
        let (bar, [from, to]) = (elastic.bar()?, elastic.ends(self)?);
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let mass = bar.mass * length;
        let inertia = mass * length * length / 12.0 + bar.rotary * length;
        let middle = [0, 1].map(|k: usize| (from[k] + to[k]) / 2.0);
        Some((mass, inertia, middle))
    }

    /// What a file leaves out of an elastic bar.
    fn fill_from_elastic(&mut self) {
        // The gate complains of numbers too large.
        let whole = self
            .of_bar()
            .filter(|(mass, inertia, _)| mass.is_finite() && inertia.is_finite());
        if let Some((mass, inertia, com)) = whole {
            self.mass.get_or_insert(mass);
            self.inertia.get_or_insert(inertia);
            self.com.get_or_insert(com);
        }
    }
}
