//! The page: the phase plane with its limit curve, and each limited number with its limits.

use linkdyn_picture::charts_page::charts_page;
use linkdyn_picture::{Axis, Chart, Curve, Fault, Panel};

use super::FastestMotion;
use super::bounds::{Bound, Of};
use super::text::range;

/// Width and height of a figure \[mm\].
const SIZE: [f64; 2] = [150.0, 80.0];
/// Figures of limits at most, those that are reached most first.
const MOST: usize = 12;

impl FastestMotion {
    /// The page.
    ///
    /// # Errors
    /// When a figure can't be drawn.
    pub fn html(&self) -> Result<String, Fault> {
        let words = self.text().to_string();
        let mut lines = words.lines().map(|line| line.trim().to_owned());
        let heading = format!("linkdyn path-time: {}", self.file.name());
        let facts: Vec<String> = lines.by_ref().collect();
        let mut order: Vec<(usize, usize)> = self.shares().into_iter().enumerate().collect();
        order.sort_by_key(|(_, share)| std::cmp::Reverse(*share));
        let own = order
            .iter()
            .filter_map(|(k, _)| self.limited(&self.bounds[*k]));
        let charts: Vec<(String, Chart)> = [self.phase_plane()]
            .into_iter()
            .chain(own.take(MOST))
            .collect();
        charts_page(&heading, &facts, &charts)
    }

    /// Values of the driver, and the unit in which angles are shown.
    fn places(&self, values: impl Iterator<Item = f64>) -> (Axis, Vec<f64>) {
        let name = self.stroke.driver.as_str();
        match self.unit {
            "rad" => (
                Axis::new(name, "deg"),
                values.map(f64::to_degrees).collect(),
            ),
            unit => (Axis::new(name, unit), values.collect()),
        }
    }

    fn phase_plane(&self) -> (String, Chart) {
        let (stroke, law) = (&self.stroke, &self.law);
        let direction = (stroke.to - stroke.from).signum();
        let (x, places) = self.places(law.nodes.iter().map(|x| stroke.from + direction * x));
        let speeds = law.found.squares.iter().map(|b| b.sqrt()).collect();
        let nodes = 0..law.nodes.len();
        let top = nodes.map(|node| law.top(&self.bounds, &self.coefficients, node));
        let top: Vec<f64> = top.map(|top| top.unwrap_or(f64::NAN)).collect();
        let mut curves = vec![Curve::new("speed", places.clone(), speeds)];
        if top.iter().any(|top| top.is_finite()) {
            curves.push(Curve::new("limit curve", places, top));
        }
        let axis = Axis::new("speed", format!("{}/s", self.unit));
        let words = "Phase plane: the speed along the stroke. Above the limit curve no acceleration keeps all limits.";
        (words.into(), chart(x, Panel { axis, curves }))
    }

    /// A limited number in the run of the law.
    fn limited(&self, bound: &Bound) -> Option<(String, Chart)> {
        let size = |row: &[f64]| match bound.of {
            Of::Column(k) => Some(row[k]),
            Of::Size([x, y]) => Some(row[x].hypot(row[y])),
            Of::Speed | Of::Acceleration => None,
        };
        let values: Vec<f64> = self.run.rows().map(size).collect::<Option<_>>()?;
        let of_driver = format!("driver.{}.", self.stroke.driver);
        let driver = self
            .run
            .columns
            .iter()
            .position(|own| own.name.starts_with(&of_driver))?;
        let (x, places) = self.places(self.run.rows().map(|row| row[driver]));
        let mut curves = vec![Curve::new(bound.name.as_str(), places.clone(), values)];
        let [lower, upper] = bound.range;
        let ends = [("limit", upper), ("limit", lower)].into_iter();
        for (label, end) in ends.take(if bound.has_lower() { 2 } else { 1 }) {
            curves.push(Curve::new(label, places.clone(), vec![end; places.len()]));
        }
        let axis = Axis::new(bound.name.as_str(), bound.unit);
        Some((
            format!("{} {}", bound.name, range(bound)),
            chart(x, Panel { axis, curves }),
        ))
    }
}

fn chart(x: Axis, panel: Panel) -> Chart {
    Chart {
        x,
        panels: vec![panel],
        size_mm: SIZE.map(Some),
        grid: true,
        whole: true,
        ..Chart::default()
    }
}
