//! A figure per compared column: the curves of all models over time.

use linkdyn_output::TIME;
use linkdyn_output::{Column, Trajectory};
use linkdyn_picture::{Axis, Chart, Curve, Panel, svg};

/// Letters of a file's name, without its ending, at most.
const LONGEST: usize = 100;
/// Width and height \[mm\]: a page's full width, since curves with impacts are dense.
const SIZE: [f64; 2] = [180.0, 80.0];

/// A file's name and content.
pub type Figure = (String, String);

/// The figures of columns, each with a curve per model; a column that no model has a value of has none.
pub fn figures(columns: &[Column], models: &[(&str, Trajectory)]) -> Vec<Figure> {
    let mut figures: Vec<Figure> = Vec::new();
    for column in columns {
        let curve = |(model, table): &(&str, Trajectory)| {
            let values = |name: &str| {
                table
                    .values(name)
                    .unwrap_or_else(|| vec![f64::NAN; table.len()])
            };
            Curve::new(*model, values(TIME), values(&column.label()))
        };
        let unit = if column.unit == "1" { "" } else { column.unit };
        let curves: Vec<Curve> = models.iter().map(curve).collect();
        let axis = Axis::new(column.name.as_str(), unit);
        let chart = Chart {
            x: Axis::new(TIME, "s"),
            panels: vec![Panel { axis, curves }],
            size_mm: SIZE.map(Some),
            line_width: 0.8,
            ..Chart::default()
        };
        if let Ok(scene) = chart.draw() {
            let name = file_name(&column.name, &figures);
            figures.push((name, svg::write(&scene)));
        }
    }
    figures
}

/// `joint.b.force.svg`: what no file system minds, and no other figure has.
fn file_name(column: &str, others: &[Figure]) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || ['.', '-', '_'].contains(&letter);
    let plain = column.trim_start_matches('.').chars().take(LONGEST);
    let plain: String = plain
        .map(|letter| if is_plain(letter) { letter } else { '_' })
        .collect();
    let is_new = |name: &String| {
        others
            .iter()
            .all(|(other, _)| other.to_lowercase() != name.to_lowercase())
    };
    let numbered = (2..).map(|number| format!("{plain}-{number}.svg"));
    std::iter::once(format!("{plain}.svg"))
        .chain(numbered)
        .find(is_new)
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_plain_and_different() {
        let mut others: Vec<Figure> = Vec::new();
        for (column, name) in [
            ("joint.b.force", "joint.b.force.svg"),
            ("joint.../b.force", "joint..._b.force.svg"),
            ("joint.B.force", "joint.B.force-2.svg"),
            ("../x y", "_x_y.svg"),
            ("Kolben größer.x", "Kolben_größer.x.svg"),
        ] {
            let found = file_name(column, &others);
            assert_eq!(found, name);
            others.push((found, String::new()));
        }
    }
}
