//! Natural frequencies, damping and shapes of small motions about rest.

mod page;
mod text;

use std::f64::consts::TAU;

use indexmap::IndexMap;
use linkdyn_engine::analysis::{self, Control, Linearised, Mode};
use linkdyn_output::{Column, Trajectory, summary};
use linkdyn_picture::Fault;
use serde::{Serialize, Serializer};
use serde_json::Value;

use crate::{ENGINE, ModelFile, Question, Subject, Unanswered};

/// Asks for the modes of a model.
#[derive(Debug, Clone, Copy, Default)]
pub struct Modes {
    /// Whether they are those about the assembled position, instead of the equilibrium.
    pub pose: bool,
}

/// The modes of a model.
#[derive(Debug, Clone)]
pub struct SmallMotions {
    /// The model.
    pub file: ModelFile,
    /// Whether the model is linearised about the assembled position.
    pub pose: bool,
    /// The linearised equations and their modes.
    pub found: Linearised,
}

impl Question for Modes {
    type Answer = SmallMotions;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<SmallMotions, Unanswered> {
        let found = analysis::modes(file.model(), self.pose, control);
        let mut found = found.map_err(|complaints| file.refused(complaints))?;
        let warnings = file.loaded.warnings.iter().cloned();
        found.warnings.splice(0..0, warnings);
        Ok(SmallMotions {
            file: file.clone(),
            pose: self.pose,
            found,
        })
    }
}

/// The place of a body, or the parts of a shape that are its own.
#[derive(Serialize)]
struct Place<T> {
    x: T,
    y: T,
    angle: T,
}

impl<T> From<[T; 3]> for Place<T> {
    fn from([x, y, angle]: [T; 3]) -> Self {
        Place { x, y, angle }
    }
}

#[derive(Serialize)]
struct ModeJson<'a> {
    frequency: f64,
    omega: f64,
    damping_ratio: Option<f64>,
    eigenvalue: [f64; 2],
    shape: IndexMap<&'a str, Place<[f64; 2]>>,
}

#[derive(Serialize)]
struct Document<'a> {
    status: &'a str,
    message: Option<&'a str>,
    engine: &'a str,
    model: Subject<'a>,
    about: &'a str,
    equilibrium: Option<Value>,
    bodies: IndexMap<&'a str, Place<f64>>,
    mass: &'a [Vec<f64>],
    damping: &'a [Vec<f64>],
    stiffness: &'a [Vec<f64>],
    modes: Vec<ModeJson<'a>>,
    warnings: &'a [String],
}

/// `modes.json`.
impl Serialize for SmallMotions {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let found = &self.found;
        let names = || found.bodies.iter().map(|(name, _)| name.as_str());
        let mode = |mode: &Mode| ModeJson {
            frequency: mode.frequency() / TAU,
            omega: mode.frequency(),
            damping_ratio: mode.damping_ratio(),
            eigenvalue: mode.eigenvalue,
            shape: names()
                .zip(mode.shape.iter().map(|own| (*own).into()))
                .collect(),
        };
        let places = found.bodies.iter().map(|(_, place)| (*place).into());
        let document = Document {
            status: found.status.word(),
            message: found.message.as_deref(),
            engine: ENGINE,
            model: self.file.subject(),
            about: if self.pose { "pose" } else { "equilibrium" },
            equilibrium: found.equilibrium.as_ref().map(summary::equilibrium),
            bodies: names().zip(places).collect(),
            mass: &found.mass,
            damping: &found.damping,
            stiffness: &found.stiffness,
            modes: found.modes.iter().map(mode).collect(),
            warnings: &found.warnings,
        };
        document.serialize(serializer)
    }
}

impl SmallMotions {
    /// A row for each mode, as in `modes.csv`.
    pub fn table(&self) -> Trajectory {
        let head = [
            ("mode", "-"),
            ("frequency", "Hz"),
            ("omega", "rad/s"),
            ("damping_ratio", "-"),
            ("eigenvalue.re", "1/s"),
            ("eigenvalue.im", "rad/s"),
        ];
        let mut columns: Vec<Column> = head.map(|(name, unit)| Column::new(name, unit)).into();
        for (name, _) in &self.found.bodies {
            for (quantity, unit) in [("x", "m"), ("y", "m"), ("angle", "rad")] {
                let parts = ["re", "im"].map(|part| format!("{name}.{quantity}.{part}"));
                columns.extend(parts.map(|name| Column::new(name, unit)));
            }
        }
        let mut table = Trajectory::new(columns);
        for (k, mode) in self.found.modes.iter().enumerate() {
            let omega = mode.frequency();
            let zeta = mode.damping_ratio().unwrap_or(f64::NAN);
            let [re, im] = mode.eigenvalue;
            let mut row = vec![(k + 1) as f64, omega / TAU, omega, zeta, re, im];
            row.extend(mode.shape.iter().flatten().flatten());
            table.push_row(&row);
        }
        table
    }

    /// The page in which the shapes move; `None` if there are no modes.
    ///
    /// # Errors
    /// Why nothing can be drawn.
    pub fn html(&self) -> Option<Result<String, Fault>> {
        page::html(self)
    }

    /// The position about which the model is linearised, in words.
    fn about(&self) -> &'static str {
        if self.pose {
            "assembled position"
        } else {
            "equilibrium"
        }
    }
}
