//! The shape of a mechanism: points of its bodies, joints, springs, traced points; of the model what a picture needs.
//!
//! `run -o` keeps it in `summary.json` under `drawing`, so that results can be drawn without the model. Lengths in metres,
//! points in the frames of their bodies; bodies are told by their place in `bodies`, of which the first is the ground.

use serde::{Deserialize, Serialize};
use std::collections::HashMap;

use super::Fault;
use linkdyn_model::{ForceKind, GROUND, JointKind, Model, PointRef};

/// Most bodies, joints, springs or traces, and points of a body, that are drawn.
const MOST: usize = 2000;

/// A point of a body: which body, and where in its frame \[m\].
pub type BodyPoint = (usize, [f64; 2]);

/// A body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Shape {
    pub name: String,
    pub points: Vec<[f64; 2]>,
}

/// A joint from the first point to the second.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    pub between: [BodyPoint; 2],
    #[serde(flatten)]
    pub kind: Kind,
}

/// What it looks like.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Kind {
    Revolute,
    /// A block on a straight guide along `axis` in the first body's frame.
    Guide {
        axis: [f64; 2],
    },
    /// Wheels that touch.
    Gear {
        ratio: f64,
    },
    Fixed,
}

/// The shape of a mechanism.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Drawing {
    pub bodies: Vec<Shape>,
    pub joints: Vec<Joint>,
    pub springs: Vec<[BodyPoint; 2]>,
    pub traces: Vec<BodyPoint>,
}

impl Drawing {
    /// The shape of a model.
    pub fn of_model(model: &Model) -> Drawing {
        let moving = model.bodies.iter().filter(|(name, _)| *name != GROUND);
        let ground = model
            .bodies
            .get(GROUND)
            .map(|body| body.points.values().copied().collect())
            .unwrap_or_default();
        let mut bodies = vec![Shape {
            name: GROUND.into(),
            points: ground,
        }];
        bodies.extend(moving.map(|(name, body)| Shape {
            name: name.clone(),
            points: body.points.values().copied().collect(),
        }));
        let places: HashMap<&str, usize> = bodies
            .iter()
            .enumerate()
            .map(|(place, body)| (body.name.as_str(), place))
            .collect();
        // The loader has seen to it that points exist.
        let point = |at: &PointRef| -> Option<BodyPoint> {
            Some((
                *places.get(at.body.as_str())?,
                *model.bodies.get(&at.body)?.points.get(&at.point)?,
            ))
        };
        let pair = |between: &[PointRef; 2]| Some([point(&between[0])?, point(&between[1])?]);
        let joints = model.joints.values().filter_map(|joint| {
            let kind = match joint.kind {
                JointKind::Revolute { .. } => Kind::Revolute,
                JointKind::Prismatic { axis, .. } | JointKind::Slot { axis } => {
                    Kind::Guide { axis }
                }
                JointKind::Gear { ratio, .. } => Kind::Gear { ratio },
                JointKind::Fixed { .. } => Kind::Fixed,
            };
            Some(Joint {
                between: pair(&joint.between)?,
                kind,
            })
        });
        let springs = model.forces.values().filter_map(|force| match &force.kind {
            ForceKind::Spring { between, .. } => pair(between),
            ForceKind::TorsionSpring { .. } | ForceKind::Load { .. } | ForceKind::Torque { .. } => {
                None
            }
        });
        let traces = model.points.iter().filter_map(point).collect();
        Drawing {
            joints: joints.collect(),
            springs: springs.collect(),
            traces,
            bodies,
        }
    }

    /// As `summary.json` keeps it.
    pub fn to_json(&self) -> serde_json::Value {
        serde_json::to_value(self).unwrap_or_default()
    }

    /// From `summary.json`, whoever has written it.
    ///
    /// # Errors
    /// When it is no drawing, or one that is larger than a picture can show.
    pub fn from_json(json: &serde_json::Value) -> Result<Drawing, Fault> {
        let drawing: Drawing = serde_json::from_value(json.clone()).map_err(|error| {
            Fault::Drawing(format!(
                "the key \"drawing\" is not what `run -o` writes: {error}"
            ))
        })?;
        drawing.check()?;
        Ok(drawing)
    }

    /// Refuses what can't be drawn.
    ///
    /// # Errors
    /// When a body is named that is not there, or there is too much.
    pub fn check(&self) -> Result<(), Fault> {
        let counts = [
            self.bodies.len(),
            self.joints.len(),
            self.springs.len(),
            self.traces.len(),
        ];
        let most_points = self
            .bodies
            .iter()
            .map(|body| body.points.len())
            .max()
            .unwrap_or(0);
        if counts
            .into_iter()
            .chain([most_points])
            .any(|count| count > MOST)
        {
            return Err(Fault::Drawing(format!(
                "the mechanism has more than {MOST} parts of a kind: too many for a picture"
            )));
        }
        let joints = self.joints.iter().flat_map(|joint| joint.between);
        let mut named = joints
            .chain(self.springs.iter().flatten().copied())
            .chain(self.traces.iter().copied());
        if named.any(|(body, _)| body >= self.bodies.len()) {
            return Err(Fault::Drawing(
                "the key \"drawing\" names a body that it does not have".into(),
            ));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawing_survives_the_summary() {
        let text = r#"{ "format": "linkdyn/1", "units": "SI",
            "bodies": { "a": { "points": { "O": [0, 0], "A": [1, 0.1] } }, "ground": { "points": { "O": [0, 2] } } },
            "joints": { "p": { "type": "prismatic", "between": ["ground.O", "a.O"], "axis": [1, 0] } },
            "points": ["a.A"], "analysis": { "type": "kinematics", "end": 1, "outputs": 2 } }"#;
        let loaded = linkdyn_model::load(text.as_bytes(), &[]).expect("sound");
        let drawing = Drawing::of_model(&loaded.model);
        assert_eq!(
            drawing.bodies[0],
            Shape {
                name: "ground".into(),
                points: vec![[0.0, 2.0]]
            }
        );
        assert_eq!(
            drawing.joints[0].between,
            [(0, [0.0, 2.0]), (1, [0.0, 0.0])]
        );
        assert_eq!(drawing.joints[0].kind, Kind::Guide { axis: [1.0, 0.0] });
        assert_eq!(drawing.traces, [(1, [1.0, 0.1])]);
        assert_eq!(Drawing::from_json(&drawing.to_json()), Ok(drawing));
    }

    #[test]
    fn a_foreign_drawing_is_refused() {
        let refused =
            |json: serde_json::Value| Drawing::from_json(&json).expect_err("refused").to_string();
        assert!(refused(serde_json::json!("x")).contains("is not what `run -o` writes"));
        let unknown = serde_json::json!({ "bodies": [], "joints": [], "springs": [], "traces": [[7, [0, 0]]] });
        assert!(refused(unknown).contains("names a body that it does not have"));
        let many = vec![serde_json::json!([0, [0, 0]]); MOST + 1];
        let many = serde_json::json!({ "bodies": [{ "name": "ground", "points": [] }], "joints": [], "springs": [], "traces": many });
        assert!(refused(many).contains("too many for a picture"));
    }
}
