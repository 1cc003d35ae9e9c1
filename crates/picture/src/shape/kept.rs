//! The shape in `summary.json`: all of it under `mechanism`, and under `drawing` what version 0.1 knew, for its readers.
//!
//! `drawing` names points by their places, knows slots and prismatic joints as guides, and has no dampers, loads or drivers.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::joint::{Joint, JointKind, PitchLine, Pulleys};
use super::numbers::PointId;
use super::parts::{Body, Shape, Spring};
use crate::fault::Fault;

/// Keys of `summary.json`.
const SHAPE: &str = "mechanism";
const DRAWING: &str = "drawing";

/// A point of a body: which body, and where in its frame \[m\].
type BodyPoint = (usize, [f64; 2]);

/// The shape as 0.1 kept it.
#[derive(Debug, Serialize, Deserialize)]
struct Drawing {
    bodies: Vec<DrawnBody>,
    joints: Vec<DrawnJoint>,
    springs: Vec<[BodyPoint; 2]>,
    traces: Vec<BodyPoint>,
}

#[derive(Debug, Serialize, Deserialize)]
struct DrawnBody {
    name: String,
    points: Vec<[f64; 2]>,
}

#[derive(Debug, Serialize, Deserialize)]
struct DrawnJoint {
    between: [BodyPoint; 2],
    #[serde(flatten)]
    kind: DrawnKind,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
enum DrawnKind {
    Revolute,
    Guide { axis: [f64; 2] },
    Gear { ratio: f64 },
    Rack { rack: PitchLine },
    Belt { belt: Pulleys },
    Fixed,
}

impl Shape {
    /// The whole shape, as `summary.json` keeps it under `mechanism`.
    pub fn to_json(&self) -> Value {
        serde_json::to_value(self).unwrap_or_default()
    }

    /// The shape for a page that also has a drawing, which alone has the corners; `rims` marks joints whose points have their
    /// names and tips from other joints.
    pub(crate) fn for_page(&self) -> Value {
        let mut shape = self.clone();
        for joint in &mut shape.joints {
            if let JointKind::Cam(profile) = &mut joint.kind {
                profile.outline.clear();
            }
            if let JointKind::Contact { outlines, .. } = &mut joint.kind {
                outlines.clear();
            }
        }
        let mut json = shape.to_json();
        for (k, joint) in shape.joints.iter().enumerate() {
            if joint.kind.joins_rims() {
                json["joints"][k]["rims"] = true.into();
            }
        }
        json
    }

    /// What 0.1 knew of it, as `summary.json` keeps it under `drawing`.
    pub fn to_drawing(&self) -> Value {
        let at = |point: PointId| (point.0, self.point(point).unwrap_or_default());
        let body = |body: &Body| DrawnBody {
            name: body.name.clone(),
            points: body.points.iter().map(|(_, x, y)| [*x, *y]).collect(),
        };
        let joint = |joint: &Joint| {
            let kind = match joint.kind {
                JointKind::Revolute { .. } => DrawnKind::Revolute,
                JointKind::Prismatic { axis } | JointKind::Slot { axis } => {
                    DrawnKind::Guide { axis }
                }
                JointKind::Gear { ratio, .. } => DrawnKind::Gear { ratio },
                JointKind::Rack { rack } => DrawnKind::Rack { rack },
                JointKind::Belt { belt } => DrawnKind::Belt { belt },
                JointKind::Fixed => DrawnKind::Fixed,
                // 0.1 knew no contacts, no cams and no bushings.
                _ => return None,
            };
            let between = joint.between.map(at);
            Some(DrawnJoint { between, kind })
        };
        let drawing = Drawing {
            bodies: self.bodies.iter().map(body).collect(),
            joints: self.joints.iter().filter_map(joint).collect(),
            springs: self
                .springs
                .iter()
                .map(|spring| spring.between.map(at))
                .collect(),
            traces: self.points.iter().map(|point| at(*point)).collect(),
        };
        serde_json::to_value(drawing).unwrap_or_default()
    }

    /// The shape of a summary, of any version; `None` if the summary has no shape.
    ///
    /// # Errors
    /// When what it keeps is no shape, or one that is larger than a picture can show.
    pub fn of_summary(summary: &Value) -> Option<Result<Shape, Fault>> {
        let shape =
            |json: &Value| read::<Shape>(json, SHAPE).and_then(|shape| checked(shape, SHAPE));
        let drawing = |json: &Value| {
            read::<Drawing>(json, DRAWING)
                .and_then(|drawing| checked(of_drawing(drawing)?, DRAWING))
        };
        let kept = summary.get(SHAPE).map(shape);
        kept.or_else(|| summary.get(DRAWING).map(drawing))
    }
}

fn read<T: for<'j> Deserialize<'j>>(json: &Value, key: &str) -> Result<T, Fault> {
    T::deserialize(json).map_err(|error| {
        Fault::Drawing(format!(
            "the key {key:?} is not what `run -o` writes: {error}"
        ))
    })
}

fn checked(shape: Shape, key: &str) -> Result<Shape, Fault> {
    shape.check(key).map(|()| shape)
}

/// A drawing of 0.1 as a shape; names that it did not keep are empty.
fn of_drawing(drawing: Drawing) -> Result<Shape, Fault> {
    let point = |(body, at): BodyPoint| -> Result<PointId, Fault> {
        let known: Option<&DrawnBody> = drawing.bodies.get(body);
        let number = known.and_then(|body| body.points.iter().position(|point| *point == at));
        let missing = if known.is_some() { "point" } else { "body" };
        let fault = || {
            Fault::Drawing(format!(
                "the key {DRAWING:?} names a {missing} that it does not have"
            ))
        };
        Ok((body, number.ok_or_else(fault)?))
    };
    let pair = |[first, second]: [BodyPoint; 2]| Ok([point(first)?, point(second)?]);
    let joint = |joint: &DrawnJoint| {
        Ok(Joint {
            name: String::new(),
            between: pair(joint.between)?,
            limits: None,
            one_way: None,
            kind: match joint.kind {
                DrawnKind::Revolute => JointKind::Revolute { clearance: None },
                DrawnKind::Guide { axis } => JointKind::Prismatic { axis },
                DrawnKind::Gear { ratio } => JointKind::Gear { ratio, gear: None },
                DrawnKind::Rack { rack } => JointKind::Rack { rack },
                DrawnKind::Belt { belt } => JointKind::Belt { belt },
                DrawnKind::Fixed => JointKind::Fixed,
            },
        })
    };
    let spring = |between: &[BodyPoint; 2]| {
        Ok(Spring {
            between: pair(*between)?,
            ..Spring::default()
        })
    };
    let body = |body: &DrawnBody| Body {
        name: body.name.clone(),
        points: body
            .points
            .iter()
            .map(|[x, y]| (String::new(), *x, *y))
            .collect(),
        ..Body::default()
    };
    Ok(Shape {
        joints: drawing
            .joints
            .iter()
            .map(joint)
            .collect::<Result<_, Fault>>()?,
        springs: drawing
            .springs
            .iter()
            .map(spring)
            .collect::<Result<_, Fault>>()?,
        points: drawing
            .traces
            .iter()
            .map(|at| point(*at))
            .collect::<Result<_, Fault>>()?,
        bodies: drawing.bodies.iter().map(body).collect(),
        ..Shape::default()
    })
}

#[cfg(test)]
mod tests {
    use super::super::check::MOST;
    use super::super::parts::Bending;
    use super::*;
    use serde_json::json;

    const MODEL: &str = r#"{ "format": "linkdyn/1", "units": "SI",
        "bodies": { "a": { "mass": 1, "inertia": 1, "com": [0, 0], "points": { "O": [0, 0], "A": [1, 0.1] } },
            "ground": { "points": { "O": [0, 2] } } },
        "joints": { "p": { "type": "prismatic", "between": ["ground.O", "a.O"], "axis": [2, 0] } },
        "forces": { "k": { "type": "spring", "between": ["ground.O", "a.A"], "damping": 2 },
            "f": { "type": "force", "at": "a.A", "vector": [1, 2] } },
        "drivers": { "d": { "type": "translation", "joint": "p", "motion": { "type": "constant_velocity", "velocity": 1 } } },
        "points": ["a.A"], "analysis": { "type": "kinematics", "end": 1, "outputs": 2 } }"#;

    fn shape() -> Shape {
        let loaded = linkdyn_model::load(MODEL.as_bytes(), &[]).expect("sound");
        Shape::of_model(&loaded.model)
    }

    #[test]
    fn a_shape_survives_the_summary() {
        let mut shape = shape();
        shape.loads[0].times = vec![0.0, 0.1];
        shape.loads[0].values = vec![[1.0 / 3.0, 2.0], [1.0, 2.0]];
        assert_eq!(shape.bodies[0].name, "ground");
        assert_eq!(shape.joints[0].between, [(0, 0), (1, 0)]);
        assert_eq!(shape.points, [(1, 1)]);
        assert!(shape.springs[0].damper);
        let summary = json!({ "mechanism": shape.to_json(), "drawing": "not read" });
        assert_eq!(Shape::of_summary(&summary), Some(Ok(shape)));
    }

    #[test]
    fn a_drawing_of_0_1_is_read() {
        let shape = shape();
        let drawing = json!({
            "bodies": [{ "name": "ground", "points": [[0.0, 2.0]] }, { "name": "a", "points": [[0.0, 0.0], [1.0, 0.1]] }],
            "joints": [{ "between": [[0, [0.0, 2.0]], [1, [0.0, 0.0]]], "type": "guide", "axis": [2.0, 0.0] }],
            "springs": [[[0, [0.0, 2.0]], [1, [1.0, 0.1]]]],
            "traces": [[1, [1.0, 0.1]]],
        });
        assert_eq!(shape.to_drawing(), drawing);
        let read = Shape::of_summary(&json!({ "drawing": drawing }))
            .expect("kept")
            .expect("sound");
        assert_eq!(
            read.joints[0].kind,
            JointKind::Prismatic { axis: [2.0, 0.0] }
        );
        assert_eq!(
            (&read.points, read.springs[0].between),
            (&shape.points, shape.springs[0].between)
        );
        assert_eq!(Shape::of_summary(&json!({})), None);
    }

    #[test]
    fn a_foreign_shape_is_refused() {
        let refused = |json: Value| {
            let read = Shape::of_summary(&json).expect("a key");
            read.expect_err("refused").to_string()
        };
        assert!(refused(json!({ "drawing": "x" })).contains("is not what `run -o` writes"));
        assert!(refused(json!({ "mechanism": 3 })).contains("the key \"mechanism\" is not what"));
        let unknown = json!({ "bodies": [], "joints": [], "springs": [], "traces": [[7, [0, 0]]] });
        assert!(
            refused(json!({ "drawing": unknown })).contains("names a body that it does not have")
        );
        let many = vec![json!([0, [0, 0]]); MOST + 1];
        let many = json!({ "bodies": [{ "name": "ground", "points": [[0, 0]] }], "joints": [], "springs": [], "traces": many });
        assert!(refused(json!({ "drawing": many })).contains("too many for a picture"));
    }

    #[test]
    fn what_a_shape_names_is_there() {
        let refused = |change: &dyn Fn(&mut Shape)| {
            let mut shape = shape();
            change(&mut shape);
            let read = Shape::of_summary(&json!({ "mechanism": shape.to_json() })).expect("a key");
            read.expect_err("refused").to_string()
        };
        assert!(refused(&|shape| shape.loads[0].body = 9).contains("a body that"));
        assert!(refused(&|shape| shape.points.push((0, 1))).contains("a point that"));
        let bending = Bending {
            places: vec![[0.0, 0.0], [1.0, 0.1]],
            moves: vec![vec![[0.0, 0.0]]],
            ..Bending::default()
        };
        let said = refused(&|shape| shape.bodies[1].bending = Some(bending.clone()));
        assert!(said.contains("places and deflections"), "{said}");
        assert!(
            refused(&|shape| shape.drivers[0].kind =
                super::super::parts::DriverKind::Translation { joint: 1 })
            .contains("a joint that")
        );
        assert!(
            refused(&|shape| shape.loads[0].times.push(1.0)).contains("do not belong together")
        );
    }
}
