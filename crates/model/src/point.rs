//! Points of bodies by name.

use std::fmt;

use serde::{Deserialize, Serialize};

/// `body.point`, split.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(try_from = "String", into = "String")]
pub struct PointRef {
    /// The body.
    pub body: String,
    /// Its point.
    pub point: String,
}

impl TryFrom<String> for PointRef {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        match text.split_once('.') {
            Some((body, point)) => Ok(PointRef {
                body: body.into(),
                point: point.into(),
            }),
            None => Err(format!("{text:?} is not body.point")),
        }
    }
}

impl From<PointRef> for String {
    fn from(point: PointRef) -> String {
        point.to_string()
    }
}

impl fmt::Display for PointRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.body, self.point)
    }
}
