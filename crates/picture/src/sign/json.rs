//! Signs for pages.

use serde_json::{Map, Value, json};

use super::{Colour, Corner, Edge, Outline, Paint, Stroke};

impl Stroke {
    /// The stroke as a page takes it: corners in three lists, of which those that are all zero are left out.
    pub fn to_json(&self) -> Value {
        let mut json = Map::new();
        let corners = self.outline.put(&mut json);
        let mut put = |key: &str, value: Value| json.insert(key.into(), value);
        let pairs = |of: fn(&Corner) -> [f64; 2]| -> Vec<f64> {
            corners.iter().flat_map(of).map(short).collect()
        };
        let lists = [
            (
                "along",
                corners.iter().map(|corner| short(corner.along)).collect(),
            ),
            ("metres", pairs(|corner| corner.metres)),
            ("bars", pairs(|corner| corner.bars)),
        ];
        for (key, list) in lists {
            if list.iter().any(|value| *value != 0.0) {
                put(key, json!(list));
            }
        }
        // A page may enlarge clearances.
        if self.class == "clearance" {
            put("gap", 1.into());
        }
        if let Some(Paint { colour, alpha }) = self.fill {
            put("fill", colour.name().into());
            if alpha < 1.0 {
                put("cover", json!(short(alpha)));
            }
        }
        if let Some(Edge { paint, width, dash }) = self.edge {
            put("edge", paint.colour.name().into());
            put("width", json!(short(width)));
            if paint.alpha < 1.0 {
                put("pale", json!(short(paint.alpha)));
            }
            if !dash.is_empty() {
                put("dash", json!(dash));
            }
        }
        Value::Object(json)
    }
}

impl Outline {
    /// Puts what kind of outline it is; its corners.
    fn put(&self, json: &mut Map<String, Value>) -> &[Corner] {
        let (key, value, corners): (_, _, &[Corner]) = match self {
            Outline::Line(corners) => return corners,
            Outline::Area(corners) => ("closed", json!(1), corners),
            Outline::Circle(centre, radius) => (
                "radius",
                json!(radius.map(short)),
                std::slice::from_ref(centre),
            ),
            Outline::Ground(ends, strokes) => ("ground", json!(strokes), ends),
            Outline::Hull(corners, radius) => ("hull", json!(radius), corners),
            Outline::Body(radius) => ("body", json!(radius), &[]),
            Outline::Coil(radii, bodies) => ("coil", json!([radii, bodies]), &[]),
        };
        json.insert(key.into(), value);
        corners
    }
}

impl Colour {
    /// The name by which a page knows the colour.
    fn name(self) -> &'static str {
        match self {
            Colour::Of(tone) => tone.name,
            Colour::Fill => "body-fill",
            Colour::Edge => "body-edge",
        }
    }
}

/// A number of six digits: drawings need no more.
pub fn short(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::super::{line, metres};
    use super::*;

    #[test]
    fn a_page_gets_what_is_not_zero() {
        let stroke = line(
            "rod",
            [metres(0.1, 0.0), metres(1.0 / 3.0, 0.0)],
            Edge::BODY,
        );
        let expected =
            json!({ "metres": [0.1, 0.0, 0.333333, 0.0], "edge": "body-edge", "width": 0.2 });
        assert_eq!(stroke.to_json(), expected);
    }
}
