//! The map of a mechanism with two drivers.

use super::MOST;
use crate::text::{Page, count, number};
use crate::{ENGINE, ModelFile, Question, Subject, Unanswered};
use linkdyn_engine::analysis::{Control, Workspace as Found, WorkspaceQuestion, workspace};
use linkdyn_engine::element::Measure;
use linkdyn_model::PointRef;
use linkdyn_picture::charts_page::charts_page;
use linkdyn_picture::{Axis, Chart, Curve, Fault, Panel};
use serde::{Serialize, Serializer};

/// Values of each driver where nobody says, and at most.
const VALUES: usize = 49;
const MOST_VALUES: usize = 400;
/// Width of a figure, and least and greatest height \[mm\].
const WIDTH: f64 = 120.0;
const HEIGHTS: [f64; 2] = [60.0, 160.0];

/// Asks for the map.
#[derive(Debug, Clone)]
pub struct Workspace {
    /// The point, `coupler.P`.
    pub point: String,
    /// Both drivers; the only two where none are named.
    pub drivers: Option<[String; 2]>,
    /// Values of each at which all assemblies are looked for.
    pub values: Option<usize>,
    /// The most assemblies at each pair.
    pub most: Option<usize>,
}

/// The map.
#[derive(Debug, Clone)]
pub struct WorkspaceFound {
    /// The model.
    pub file: ModelFile,
    /// The point.
    pub point: PointRef,
    /// What was found.
    pub found: Found,
}

impl Question for Workspace {
    type Answer = WorkspaceFound;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<WorkspaceFound, Unanswered> {
        let values = self.values.unwrap_or(VALUES);
        if !(2..=MOST_VALUES).contains(&values) {
            return Err(Unanswered::question(format!(
                "--values {values}: 2 to {MOST_VALUES} values of each driver"
            )));
        }
        if self.most == Some(0) {
            return Err(Unanswered::question("--most 0: look for one at least"));
        }
        let point = PointRef::try_from(self.point.clone());
        let point = point.map_err(|why| Unanswered::question(format!("--workspace: {why}")))?;
        let question = WorkspaceQuestion {
            point: point.clone(),
            drivers: self.drivers.clone(),
            count: values,
            most: self.most.unwrap_or(MOST),
        };
        let found = workspace(file.model(), &question, control);
        let found = found.map_err(|complaints| file.refused(complaints))?;
        Ok(WorkspaceFound {
            file: file.clone(),
            point,
            found: found.ok_or(Unanswered::Interrupted)?,
        })
    }
}

impl WorkspaceFound {
    /// Least and greatest x and y that the point reaches at values of the grid \[m\].
    fn reach(&self) -> [[f64; 2]; 2] {
        let ends = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        let singular = self.found.singular.iter().flatten().map(|own| own.place);
        let places = self.found.places.iter().copied().chain(singular);
        places
            .filter(|place| place[0].is_finite())
            .fold(ends, |mut ends, place| {
                for (own, value) in ends.iter_mut().zip(place) {
                    *own = [own[0].min(value), own[1].max(value)];
                }
                ends
            })
    }

    /// The map in words.
    pub fn text(&self) -> Page {
        let found = &self.found;
        let mut page = Page::default();
        let [a, b] = &found.drivers;
        page.line(format!(
            "{}: drivers {} and {}, point {}",
            self.file.name(),
            a.0,
            b.0,
            self.point
        ));
        let counts = found.counts.iter().flatten();
        let most = counts.clone().max().copied().unwrap_or_default();
        let least = counts.clone().min().copied().unwrap_or_default();
        let closed = counts.clone().filter(|own| **own > 0).count();
        page.row(
            "assemblies",
            format!(
                "{least} to {most} at {0} × {0} values, some at {closed} of them",
                found.values[0].len()
            ),
        );
        if closed > 0 {
            let [x, y] = self.reach().map(|own| own.map(|value| number(value, 6)));
            page.row(
                "reach",
                format!(
                    "x from {} to {} m, y from {} to {} m",
                    x[0], x[1], y[0], y[1]
                ),
            );
        }
        page.row(
            "singular",
            match found.singular.len() {
                0 => "nowhere: assemblies do not meet".to_owned(),
                several => format!("{}, on which assemblies meet", count(several, "curve")),
            },
        );
        page.rows("doubts", &found.doubts);
        page
    }

    /// The page: both maps.
    ///
    /// # Errors
    /// When a figure can't be drawn.
    pub fn html(&self) -> Result<String, Fault> {
        let found = &self.found;
        let scale = |k: usize| match found.drivers[k].1 {
            Measure::Angle => ("deg", 180.0 / std::f64::consts::PI),
            Measure::Length => ("m", 1.0),
        };
        let [(unit, by), (other_unit, other_by)] = [scale(0), scale(1)];
        let joined = |of: &dyn Fn(&linkdyn_engine::analysis::SingularPlace) -> [f64; 2],
                      label: &str| {
            let (mut x, mut y) = (Vec::new(), Vec::new());
            for curve in &found.singular {
                for place in curve {
                    let [a, b] = of(place);
                    x.push(a);
                    y.push(b);
                }
                x.push(x.last().copied().unwrap_or_default());
                y.push(f64::NAN);
            }
            Curve::new(label, x, y)
        };
        let drivers = Chart {
            x: Axis::new(found.drivers[0].0.clone(), unit),
            panels: vec![Panel {
                axis: Axis::new(found.drivers[1].0.clone(), other_unit),
                curves: vec![joined(
                    &|own| [own.values[0] * by, own.values[1] * other_by],
                    "assemblies meet",
                )],
            }],
            size_mm: [Some(WIDTH), Some(WIDTH)],
            ..Chart::default()
        };
        let [x, y] = self.reach();
        let (wide, high) = (x[1] - x[0], y[1] - y[0]);
        let dash = 0.002 * wide.max(high);
        let dots = found.places.iter().filter(|place| place[0].is_finite());
        let dots = dots.flat_map(|[x, y]| [[x - dash, *y], [x + dash, *y], [x + dash, f64::NAN]]);
        let (dots_x, dots_y) = dots.map(|[x, y]| (x, y)).unzip();
        let height = (WIDTH * high / wide).clamp(HEIGHTS[0], HEIGHTS[1]);
        let places = Chart {
            x: Axis::new(format!("{}.x", self.point), "m"),
            panels: vec![Panel {
                axis: Axis::new(format!("{}.y", self.point), "m"),
                curves: vec![
                    joined(&|own| own.place, "assemblies meet"),
                    Curve::new("reached", dots_x, dots_y),
                ],
            }],
            size_mm: [Some(WIDTH), Some(height)],
            ..Chart::default()
        };
        let words = self.text().to_string();
        let facts: Vec<String> = words.lines().map(|line| line.trim().to_owned()).collect();
        let mut charts = Vec::new();
        if !found.singular.is_empty() {
            charts.push((
                "where assemblies meet, over the drivers".to_owned(),
                drivers,
            ));
        }
        if wide.is_finite() && wide > 0.0 {
            charts.push((format!("where {} gets", self.point), places));
        }
        charts_page(&format!("{}: workspace", self.file.name()), &facts, &charts)
    }
}

#[derive(Serialize)]
struct WorkspaceJson<'a> {
    engine: &'a str,
    model: Subject<'a>,
    point: String,
    drivers: [&'a str; 2],
    values: &'a [Vec<f64>; 2],
    assemblies: &'a [Vec<usize>],
    complete: bool,
    doubts: &'a [String],
    places: &'a [[f64; 2]],
    singular: Vec<SingularJson>,
}

/// Columns along a curve.
#[derive(Serialize)]
struct SingularJson {
    values: Vec<[f64; 2]>,
    places: Vec<[f64; 2]>,
}

/// `workspace.json`.
impl Serialize for WorkspaceFound {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let found = &self.found;
        let singular = found.singular.iter().map(|curve| SingularJson {
            values: curve.iter().map(|own| own.values).collect(),
            places: curve.iter().map(|own| own.place).collect(),
        });
        WorkspaceJson {
            engine: ENGINE,
            model: self.file.subject(),
            point: self.point.to_string(),
            drivers: [&found.drivers[0].0, &found.drivers[1].0],
            values: &found.values,
            assemblies: &found.counts,
            complete: found.doubts.is_empty(),
            doubts: &found.doubts,
            places: &found.places,
            singular: singular.collect(),
        }
        .serialize(serializer)
    }
}
