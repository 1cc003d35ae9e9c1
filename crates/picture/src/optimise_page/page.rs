//! The page.

use serde_json::{Value, json};

use super::parts::OptimisePage;
use crate::html::{self, Live, escaped};
use crate::mechanism::Drawing;
use crate::palette;
use crate::shape::Shape;
use crate::study_page::{Motion, Values};

const BODY: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// In the order in which they build on each other.
pub const SCRIPTS: &[&str] = &[
    include_str!("js/data.js"),
    html::PLAYER,
    html::PLACES,
    html::DRAWING,
    include_str!("js/overlay.js"),
    include_str!("js/history.js"),
    include_str!("js/head.js"),
];
/// Shapes and drawings of more text than this are left out.
const LARGEST_SHAPE: usize = 600_000;

impl OptimisePage<'_> {
    /// The page as the text of a file, which needs nothing else.
    pub fn html(mut self) -> String {
        let (names, motions): (Vec<&str>, Vec<Motion>) = self.motions.drain(..).unzip();
        let drawn = motions.first().map(Motion::drawn);
        let is_small = |parts: &[Value; 2]| {
            parts
                .iter()
                .map(|part| part.to_string().len())
                .sum::<usize>()
                <= LARGEST_SHAPE
        };
        let drawn = drawn.filter(is_small);
        let mut values = Values::default();
        let played = drawn.as_ref().map(|_| values.motions(&motions));
        let [mechanism, drawing] =
            drawn.unwrap_or_else(|| [Shape::default().to_json(), Drawing::empty().0]);
        let history = &self.history;
        let data = json!({
            "engine": env!("CARGO_PKG_VERSION"),
            "model": self.model,
            "about": self.about,
            "verdict": self.verdict,
            "status": self.status,
            "warnings": self.notes,
            "tables": self.tables,
            "names": names,
            "mechanism": mechanism,
            "drawing": drawing,
            "played": played,
            "wanted": self.wanted,
            "history": {
                "label": history.label,
                "unit": [history.unit.symbol, history.unit.size],
                "is_rest": history.is_rest,
                "starts": history.starts,
            },
            "bytes": 4,
            "palette": palette::to_json(),
        });
        Live {
            title: "linkdyn optimum",
            style: STYLE,
            body: BODY,
            scripts: SCRIPTS,
            data: &escaped(&data.to_string()),
            values: &values.text(),
        }
        .html()
    }
}
