//! A mechanism for a page: its parts, which the page puts where their points are.
//!
//! | key      | holds                                                                                    |
//! | -------- | ---------------------------------------------------------------------------------------- |
//! | `box`    | least and greatest x, least and greatest y of what is drawn \[m\]                          |
//! | `hulls`  | per body the numbers of the points that are corners of its hull                          |
//! | `signs`  | strokes ([`crate::sign`]); parts that look alike share a sign                            |
//! | `parts`  | sign, where it stands (`[body]`, `[body, point]`, `[body, x, y]`), body it turns with, rest |
//! | `arrows` | signs of a force, of one that is larger than it is drawn, of torques to the left and right |

use std::collections::HashMap;

use serde_json::{Map, Value, json};

use super::loads::TORQUE;
use super::moving::Mechanism;
use super::parts::{At, Layer, Part, Parts, Turn};
use super::view::Extent;
use crate::palette::FORCE;
use crate::poses::{Pose, Poses};
use crate::shape::{Body, Shape};
use crate::sign::{Edge, Sign, short};
use crate::symbols;

/// Size of a picture in which signs are counted out over their length, and of a bar in it \[px\].
const PAGE: [f64; 2] = [440.0, 300.0];
const BAR: f64 = 7.0;
/// Least width and height of what is shown, as a part of the other.
const LEAST: f64 = 0.15;
/// Half the size of what is shown where nothing has a place \[m\].
const NOTHING: f64 = 0.1;

/// What a page draws of a mechanism.
pub struct Drawing(pub Value);

impl Drawing {
    /// Nothing.
    pub fn empty() -> Self {
        Drawing(
            json!({ "box": [-NOTHING, NOTHING, -NOTHING, NOTHING], "hulls": [], "signs": [], "parts": [], "arrows": [] }),
        )
    }

    /// The parts of a mechanism, and how far it reaches in these poses of all bodies, the ground first.
    pub fn of(shape: &Shape, rows: &[Vec<Pose>]) -> Self {
        let Some(first) = rows.first().filter(|_| shape.bodies.len() > 1) else {
            return Drawing::empty();
        };
        let mechanism = Mechanism::measured(shape.clone(), Poses::of(rows));
        let mut extent = mechanism.frame.extent;
        for (body, pose) in shape.bodies.iter().zip(first).skip(1) {
            if body.points.is_empty() {
                extent.add([pose[0], pose[1]], 0.0);
            }
        }
        let [left, right, bottom, top] = shown(&extent);
        let scale = (PAGE[0] / (right - left)).min(PAGE[1] / (top - bottom));
        let mut signs = Signs::default();
        let parts = Parts::of(&mechanism, first, BAR / scale, true);
        let parts: Value = parts.iter().map(|part| signs.part(shape, part)).collect();
        let edge = Edge::of(FORCE);
        let round = [true, false].map(|left| symbols::round_arrow("", TORQUE, left, edge));
        let arrows = symbols::force_arrows("", edge).into_iter().chain(round);
        let arrows: Value = arrows.map(|sign| signs.number(&sign)).collect();
        let ends = [left, right, bottom, top].map(short);
        Drawing(json!({
            "box": ends,
            "hulls": shape.bodies.iter().map(hull).collect::<Value>(),
            "signs": signs.list,
            "parts": parts,
            "arrows": arrows,
        }))
    }
}

/// Left, right, bottom and top of what is shown, of some size either way.
fn shown(Extent { low, high }: &Extent) -> [f64; 4] {
    if !(0..2).all(|k| low[k].is_finite() && high[k].is_finite()) {
        return [-NOTHING, NOTHING, -NOTHING, NOTHING];
    }
    let sizes = [high[0] - low[0], high[1] - low[1]];
    let least = 1e-6 + LEAST * sizes[0].max(sizes[1]);
    let [[left, right], [bottom, top]] = [0, 1].map(|k| match sizes[k] < least {
        true => [-0.5, 0.5].map(|side| (low[k] + high[k]) / 2.0 + side * least),
        false => [low[k], high[k]],
    });
    [left, right, bottom, top]
}

/// Numbers of the points that are corners of the hull of a body.
fn hull(body: &Body) -> Value {
    let places: Vec<[f64; 2]> = body.points.iter().map(|(_, x, y)| [*x, *y]).collect();
    let corners = symbols::hull(&places);
    let number = |corner: &[f64; 2]| places.iter().position(|place| place == corner);
    corners.iter().filter_map(number).collect()
}

/// Signs, each once.
#[derive(Default)]
struct Signs {
    list: Vec<Value>,
    numbers: HashMap<String, usize>,
}

impl Signs {
    fn number(&mut self, sign: &Sign) -> usize {
        let json: Value = sign.iter().map(|stroke| stroke.to_json()).collect();
        let list = &mut self.list;
        *self.numbers.entry(json.to_string()).or_insert_with(|| {
            list.push(json);
            list.len() - 1
        })
    }

    fn part(&mut self, shape: &Shape, part: &Part) -> Value {
        let at = match part.at {
            At::Point((body, point)) => json!([body, point]),
            At::Origin(body) => json!([body]),
            At::Mass(body) => {
                let [x, y] = shape.bodies[body].com.unwrap_or_default();
                json!([body, x, y])
            }
        };
        let mut rest = Map::new();
        let turn = match part.turn {
            Turn::With(body, axis) => {
                if axis != [1.0, 0.0] {
                    rest.insert("axis".into(), json!(axis));
                }
                body
            }
            Turn::Towards(to) => {
                rest.insert("to".into(), json!(to));
                0
            }
        };
        if part.body != turn {
            rest.insert("of".into(), part.body.into());
        }
        let shown = [(Layer::Drivers, "drivers"), (Layer::Centres, "centres")];
        if let Some((_, name)) = shown.iter().find(|(layer, _)| *layer == part.layer) {
            rest.insert("show".into(), json!(name));
        }
        let mut json = vec![self.number(&part.sign).into(), at, turn.into()];
        if !rest.is_empty() {
            json.push(rest.into());
        }
        json.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Joint, JointKind};

    /// A disc that moves about in a box: the walls are in view, a floor that goes on far beyond is not.
    #[test]
    fn walls_that_are_near_are_in_view() {
        let walls = vec![
            [-0.4, -0.3],
            [0.4, -0.3],
            [0.4, 0.3],
            [-0.4, 0.3],
            [-0.4, -0.3],
        ];
        let joint = |outlines| Joint {
            name: "wall".into(),
            between: [(0, 0), (1, 0)],
            kind: JointKind::Contact {
                outlines,
                radius: 0.1,
                arc: None,
            },
            limits: None,
            one_way: None,
        };
        let body = |name: &str| Body {
            name: name.into(),
            points: vec![("P".into(), 0.0, 0.0)],
            ..Body::default()
        };
        let mut shape = Shape {
            bodies: vec![body("ground"), body("disc")],
            joints: vec![joint(vec![walls])],
            ..Shape::default()
        };
        let rows = [[-0.3, -0.1], [0.2, 0.1]].map(|[x, y]| vec![[0.0; 3], [x, y, 0.0]]);
        assert_eq!(
            Drawing::of(&shape, &rows).0["box"],
            json!([-0.4, 0.4, -0.3, 0.3])
        );
        shape.joints = vec![joint(vec![vec![[100.0, -0.3], [-100.0, -0.3]]])];
        assert_eq!(
            Drawing::of(&shape, &rows).0["box"],
            json!([-0.4, 0.3, -0.3, 0.2])
        );
    }

    /// Two links of one length: bodies share a sign, pins as well.
    #[test]
    fn parts_that_look_alike_share_a_sign() {
        let text = r#"{ "format": "linkdyn/1", "units": "SI",
            "bodies": { "ground": { "points": { "O": [0, 0] } },
                "a": { "points": { "O": [0, 0], "A": [1, 0], "M": [0.5, 0] } }, "b": { "points": { "A": [0, 0], "B": [1, 0] } } },
            "joints": { "o": { "type": "revolute", "between": ["ground.O", "a.O"] }, "p": { "type": "revolute", "between": ["a.A", "b.A"] } },
            "analysis": { "type": "dynamics", "end": 1, "outputs": 2 } }"#;
        let loaded = linkdyn_model::load(text.as_bytes(), &[]).expect("sound");
        let rows = [vec![[0.0; 3], [0.0; 3], [1.0, 0.0, 1.0]]];
        let Drawing(drawing) = Drawing::of(&Shape::of_model(&loaded.model), &rows);
        // A point between others is no corner.
        assert_eq!(drawing["hulls"], json!([[0], [0, 1], [0, 1]]));
        let of = |stands: &[Value]| -> Vec<u64> {
            let parts = drawing["parts"].as_array().expect("parts").iter();
            let found = parts.filter(|part| stands.contains(&part[1]));
            found.filter_map(|part| part[0].as_u64()).collect()
        };
        let bodies = of(&[json!([1]), json!([2])]);
        assert_eq!(bodies.len(), 2);
        assert_eq!(bodies[0], bodies[1]);
        let pins = of(&[json!([1, 0]), json!([1, 1]), json!([2, 0])]);
        assert!(
            pins.len() == 3 && pins.iter().all(|sign| *sign == pins[0]),
            "{pins:?}"
        );
        assert!(drawing["box"][1].as_f64() >= Some(1.5), "{drawing}");
    }
}
