//! The page.

use serde_json::{Value, json};

use super::chosen::{Chosen, chosen};
use super::facts::of_output;
use super::parts::{AccuracyPage, Output, Pose, Unit};
use crate::html::{self, Live, escaped};
use crate::mechanism::Drawing;
use crate::numbers::Numbers;
use crate::palette;
use crate::poses::Pose as Frame;
use crate::shape::Shape;

const BODY: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// In the order in which they build on each other.
pub const SCRIPTS: &[&str] = &[
    include_str!("js/data.js"),
    include_str!("js/file_units.js"),
    html::PLACES,
    html::DRAWING,
    include_str!("js/choice.js"),
    include_str!("js/headline.js"),
    include_str!("js/band_marks.js"),
    include_str!("js/band.js"),
    include_str!("js/tornado.js"),
    include_str!("js/needed.js"),
    include_str!("js/worst.js"),
    include_str!("js/sliders.js"),
    include_str!("js/head.js"),
];
/// Shapes and drawings of more text than this are left out.
const LARGEST_SHAPE: usize = 600_000;

impl AccuracyPage<'_> {
    /// The page as the text of a file, which needs nothing else.
    pub fn html(mut self) -> String {
        let absent = self.outputs.iter().filter(|output| output.poses.is_empty());
        let absent = absent.map(|output| format!("{}: the motion has no such pose.", output.name));
        let warnings: Vec<String> = absent.chain(self.notes.iter().cloned()).collect();
        self.outputs.retain(|output| !output.poses.is_empty());
        self.written(&warnings)
    }

    /// The page of outputs that have poses.
    fn written(&self, warnings: &[String]) -> String {
        let chosen = chosen(self);
        let both = || self.outputs.iter().zip(&chosen);
        let mut notes = self.left_out(&chosen);
        let rows: Vec<Vec<Frame>> = both()
            .flat_map(|(output, chosen)| {
                chosen
                    .details
                    .iter()
                    .map(|&row| &output.poses[chosen.rows[row]])
            })
            .filter(|pose| pose.position.len() + 1 == self.shape.bodies.len())
            .map(|pose| {
                [[0.0; 3]]
                    .into_iter()
                    .chain(pose.position.iter().copied())
                    .collect()
            })
            .collect();
        let (mut shape, Drawing(mut drawing)) =
            (self.shape.for_page(), Drawing::of(&self.shape, &rows));
        if shape.to_string().len() + drawing.to_string().len() > LARGEST_SHAPE {
            notes.push("The model is too large to be drawn here.".into());
            shape = Shape::default().to_json();
            drawing = Drawing::empty().0;
        }
        let data = json!({
            "engine": env!("CARGO_PKG_VERSION"),
            "model": self.model,
            "about": self.about,
            "assumed": self.assumed,
            "level": self.level,
            "units": { "m": unit(&self.length), "rad": unit(&self.angle) },
            "drivers": self.drivers,
            "bodies": self.shape.bodies.len().saturating_sub(1),
            "mechanism": shape,
            "drawing": drawing,
            "sources": self.sources.iter().map(|source| json!({
                "name": source.name,
                "slider": source.slider.as_ref().map(|slider| json!({
                    "value": slider.value, "unit": slider.unit, "range": slider.range, "is_tolerance": slider.is_tolerance,
                })),
            })).collect::<Value>(),
            "outputs": both().map(|(output, chosen)| of_output(self, output, chosen)).collect::<Value>(),
            "warnings": warnings,
            "notes": notes,
            "bytes": 8,
            "palette": palette::to_json(),
        });
        let mut values = Numbers::new(true);
        for (output, chosen) in both() {
            self.put(output, chosen, &mut values);
        }
        Live {
            title: "linkdyn accuracy",
            style: STYLE,
            body: BODY,
            scripts: SCRIPTS,
            data: &escaped(&data.to_string()),
            values: &values.text(),
        }
        .html()
    }

    /// Numbers of an output: its band column by column, then pose by pose contributions and frames. What is not there is a NaN.
    fn put(&self, output: &Output, chosen: &Chosen, values: &mut Numbers) {
        let band: Vec<Vec<f64>> = chosen
            .rows
            .iter()
            .map(|&pose| self.row(&output.poses[pose]))
            .collect();
        let width = band.first().map_or(0, Vec::len);
        for column in 0..width {
            values.extend(band.iter().map(|row| row[column]));
        }
        let bodies = self.shape.bodies.len().saturating_sub(1);
        for &row in &chosen.details {
            let pose = &output.poses[chosen.rows[row]];
            for source in 0..self.sources.len() {
                let by = pose.contributions.get(source).copied();
                values.extend(by.unwrap_or([f64::NAN; 4]));
            }
            for frames in [Some(pose.position), pose.displaced[0], pose.displaced[1]] {
                let frame =
                    |body: usize| frames.and_then(|frames: &[Frame]| frames.get(body).copied());
                values.extend((0..bodies).flat_map(|body| frame(body).unwrap_or([f64::NAN; 3])));
            }
        }
    }

    /// A row of the band; `chosen::WIDTH` numbers and one per driver.
    fn row(&self, pose: &Pose) -> Vec<f64> {
        let or_none = |value: Option<f64>| value.unwrap_or(f64::NAN);
        let pair = |pair: Option<[f64; 2]>| pair.unwrap_or([f64::NAN; 2]);
        let [first, certified, moments] = [pose.first, pose.certified, pose.moments].map(pair);
        let mut row = vec![pose.time];
        let drivers = 0..self.drivers.len();
        row.extend(drivers.map(|k| or_none(pose.drivers.get(k).copied())));
        row.push(pose.nominal);
        row.extend(first);
        row.extend(pose.found.map(or_none));
        row.extend(certified);
        row.extend(moments);
        row.push(or_none(pose.pressed));
        row.extend(pose.capability.unwrap_or([f64::NAN; 3]));
        row
    }

    /// What is not in the page.
    fn left_out(&self, chosen: &[Chosen]) -> Vec<String> {
        let mut notes = Vec::new();
        for (output, chosen) in self.outputs.iter().zip(chosen) {
            let (poses, rows, details) =
                (output.poses.len(), chosen.rows.len(), chosen.details.len());
            let name = output.name;
            if rows < poses {
                notes.push(format!(
                    "{name}: {rows} of {poses} poses are in this page, those with the largest deviations among them, so that it stays below 5 MB; accuracy.csv has all."
                ));
            }
            if details < rows {
                notes.push(format!(
                    "{name}: contributions and configurations are in this page at {details} of {poses} poses; contributions.csv has the contributions of all."
                ));
            }
        }
        notes
    }
}

fn unit(unit: &Unit) -> Value {
    json!([unit.symbol, unit.size])
}

#[cfg(test)]
mod tests {
    use super::super::chosen::WIDTH;
    use super::*;

    #[test]
    fn a_row_is_as_wide_as_it_is_planned() {
        let page = AccuracyPage {
            model: "",
            about: None,
            assumed: String::new(),
            level: 2,
            length: Unit {
                symbol: "m".into(),
                size: 1.0,
            },
            angle: Unit {
                symbol: "rad".into(),
                size: 1.0,
            },
            drivers: vec![("a".into(), "rad"), ("b".into(), "m")],
            shape: Shape::default(),
            sources: Vec::new(),
            outputs: Vec::new(),
            notes: &[],
        };
        let pose = Pose {
            time: 0.0,
            drivers: &[1.0, 2.0],
            nominal: 0.0,
            first: None,
            found: [None; 2],
            certified: None,
            needed: [&[], &[]],
            moments: None,
            capability: None,
            pressed: None,
            position: &[],
            displaced: [None; 2],
            contributions: Vec::new(),
        };
        assert_eq!(page.row(&pose).len(), WIDTH + 2);
    }
}
