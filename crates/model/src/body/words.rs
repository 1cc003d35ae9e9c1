//! A body as a file has it: its points with their tolerances.

use std::fmt;

use indexmap::IndexMap;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::ser::{Serialize, SerializeMap, SerializeStruct, Serializer};

use super::{Body, Pose};

/// A body as a file has it.
#[derive(serde::Deserialize)]
pub struct BodyWords {
    #[serde(default)]
    mass: Option<f64>,
    #[serde(default)]
    inertia: Option<f64>,
    #[serde(default)]
    com: Option<[f64; 2]>,
    #[serde(default)]
    points: IndexMap<String, Place>,
    #[serde(default)]
    pose: Pose,
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
        };
        for (name, place) in words.points {
            if let Some(tolerance) = place.tolerance {
                body.point_tolerances.insert(name.clone(), tolerance);
            }
            body.points.insert(name, place.position);
        }
        body
    }
}

impl Serialize for Body {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut body = serializer.serialize_struct("Body", 5)?;
        body.serialize_field("mass", &self.mass)?;
        body.serialize_field("inertia", &self.inertia)?;
        body.serialize_field("com", &self.com)?;
        body.serialize_field("points", &Places(self))?;
        body.serialize_field("pose", &self.pose)?;
        body.end()
    }
}

/// The points of a body.
struct Places<'b>(&'b Body);

impl Serialize for Places<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Places(body) = self;
        let mut points = serializer.serialize_map(Some(body.points.len()))?;
        for (name, position) in &body.points {
            match body.point_tolerances.get(name) {
                None => points.serialize_entry(name, position)?,
                Some(tolerance) => {
                    let (position, tolerance) = (*position, Some(*tolerance));
                    points.serialize_entry(
                        name,
                        &Place {
                            position,
                            tolerance,
                        },
                    )?;
                }
            }
        }
        points.end()
    }
}

/// Two coordinates, or these with a tolerance.
#[derive(serde::Serialize)]
struct Place {
    position: [f64; 2],
    tolerance: Option<f64>,
}

/// A place with its keys.
#[derive(serde::Deserialize)]
struct Keyed {
    position: [f64; 2],
    #[serde(default)]
    tolerance: Option<f64>,
}

impl<'de> Deserialize<'de> for Place {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(PlaceVisitor)
    }
}

struct PlaceVisitor;

impl<'de> Visitor<'de> for PlaceVisitor {
    type Value = Place;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("two coordinates, or an object with \"position\"")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<Place, A::Error> {
        let position = <[f64; 2]>::deserialize(SeqAccessDeserializer::new(items))?;
        Ok(Place {
            position,
            tolerance: None,
        })
    }

    fn visit_map<A: MapAccess<'de>>(self, members: A) -> Result<Place, A::Error> {
        let Keyed {
            position,
            tolerance,
        } = Keyed::deserialize(MapAccessDeserializer::new(members))?;
        Ok(Place {
            position,
            tolerance,
        })
    }
}
