//! Drawings to scale: the outlines of links around their points, as the pages draw them, but as true geometry.
//!
//! | file     | does                                                        |
//! | -------- | ----------------------------------------------------------- |
//! | `plates` | each body as a plate in its own frame, from the joints       |
//! | `poses`  | where the bodies are, and how far slides go                  |

mod plates;
mod poses;
#[cfg(test)]
mod tests;

use linkdyn_engine::analysis::Control;
use linkdyn_exchange::export::{Layer, Sheet};
use linkdyn_exchange::{Affine, Form};
use linkdyn_picture::palette;
use linkdyn_picture::poses::{Pose, global};

use crate::{ModelFile, Question, Unanswered};
use plates::Plate;

/// Asks for drawings of a model.
#[derive(Debug, Clone, Copy, Default)]
pub struct Drawing {
    /// When \[s\]; without it as assembled.
    pub at: Option<f64>,
    /// Width of links \[m\].
    pub width: Option<f64>,
    /// Diameter of holes \[m\].
    pub hole: Option<f64>,
}

/// The bodies of a model as plates, and where they are.
#[derive(Debug)]
pub struct Plates {
    name: String,
    plates: Vec<Plate>,
    pose: Vec<Pose>,
    /// Width of links \[m\].
    pub width: f64,
    /// Diameter of holes \[m\].
    pub hole: f64,
}

/// Layer of the names of points.
const NAMES: &str = "names";
/// Height of letters, in widths of a link.
const LETTER: f64 = 0.3;
/// Names of pins nearer than this are one \[widths of a link\].
const ONE: f64 = 1e-3;
/// The support of a pin on the ground: height and half its width, in holes.
const SUPPORT: [f64; 2] = [2.2, 1.5];

impl Question for Drawing {
    type Answer = Plates;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<Plates, Unanswered> {
        let rows = poses::rows(file, self.at, control)?;
        let pose = rows.pose.clone();
        let [width, hole] = self.sizes(file, &pose)?;
        Ok(Plates {
            name: file.name().to_owned(),
            plates: plates::plates(file.model(), &rows, width, hole),
            pose,
            width,
            hole,
        })
    }
}

impl Drawing {
    /// Width of links and diameter of holes, by the size of the mechanism where they are not given.
    fn sizes(&self, file: &ModelFile, pose: &[Pose]) -> Result<[f64; 2], Unanswered> {
        let width = self
            .width
            .unwrap_or_else(|| plates::width(file.model(), pose));
        let hole = self.hole.unwrap_or(plates::HOLE * width);
        if hole >= width {
            let [hole, width] = [hole, width].map(|length| length * 1e3);
            let message = format!("a hole of {hole} mm does not fit into a link {width} mm wide");
            return Err(Unanswered::question(format!(
                "{message} (--width wider, or --hole smaller)"
            )));
        }
        Ok([width, hole])
    }
}

impl Plates {
    /// Names of the bodies that have something to draw, the ground first.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let drawn = self.plates.iter().filter(|plate| !plate.is_empty());
        drawn.map(|plate| plate.name.as_str())
    }

    /// All bodies where they are: a layer of each, and one of the names of points.
    pub fn pose(&self) -> Sheet {
        let mut names: Vec<([f64; 2], &str)> = Vec::new();
        let mut layers = Vec::new();
        for (body, (plate, pose)) in self.plates.iter().zip(&self.pose).enumerate() {
            let by = Affine::turned(*pose);
            // The ground is not one plate there: what stands on it has a support of its own.
            let forms = match body {
                0 => &plate.inner,
                _ => &plate.all(),
            };
            let mut forms: Vec<Form> = forms.iter().filter_map(|form| form.moved(&by)).collect();
            if body == 0 {
                forms.extend(plate.holes.iter().map(|at| self.support(*at)));
            }
            if !forms.is_empty() {
                layers.push(layer(&plate.name, body, forms));
            }
            for (name, at) in &plate.points {
                let at = global(*pose, *at);
                let far = |other: &[f64; 2]| (at[0] - other[0]).hypot(at[1] - other[1]);
                if names.iter().all(|(other, _)| far(other) > ONE * self.width) {
                    names.push((at, name));
                }
            }
        }
        layers.push(self.names_layer(names.into_iter()));
        Sheet {
            title: self.name.clone(),
            layers,
        }
    }

    /// A body in its own frame; nothing where it has nothing to draw.
    pub fn link(&self, name: &str) -> Option<Sheet> {
        let number = self.plates.iter().position(|plate| plate.name == name)?;
        let plate = self.plates.get(number).filter(|plate| !plate.is_empty())?;
        let names = plate.points.iter().map(|(name, at)| (*at, name.as_str()));
        Some(Sheet {
            title: format!("{}: {name}", self.name),
            layers: vec![layer(name, number, plate.all()), self.names_layer(names)],
        })
    }

    fn names_layer<'n>(&self, names: impl Iterator<Item = ([f64; 2], &'n str)>) -> Layer {
        let height = LETTER * self.width;
        let beside = 0.5 * self.hole + 0.2 * height;
        let text = |([x, y], name): ([f64; 2], &str)| Form::Text {
            at: [x + beside, y + beside],
            height,
            text: name.to_owned(),
        };
        Layer {
            name: NAMES.into(),
            colour: palette::MUTED.light,
            forms: names.map(text).collect(),
        }
    }

    /// A triangle below a pin that stands still.
    fn support(&self, [x, y]: [f64; 2]) -> Form {
        let [tall, half] = SUPPORT.map(|part| part * self.hole);
        Form::line([[x, y], [x - half, y - tall], [x + half, y - tall]], true)
    }
}

fn layer(name: &str, body: usize, forms: Vec<Form>) -> Layer {
    Layer {
        name: name.to_owned(),
        colour: palette::body(body).line.light,
        forms,
    }
}
