//! All assemblies of a mechanism, and its circuits.

mod circuits;
mod grashof;
mod json;
mod page;
mod text;
mod workspace;

pub use circuits::{Circuits, CircuitsFound};
pub use grashof::{FourBarClass, GrashofClass};
pub use workspace::{Workspace, WorkspaceFound};

use crate::put::{Put, read};
use crate::{ModelFile, Question, Unanswered};
use linkdyn_engine::analysis::{AllAssemblies, Control, all_assemblies};
use serde_json::json;

/// The most assemblies that are looked for where nobody says.
pub const MOST: usize = 1000;

/// Asks for all assemblies at an instant.
#[derive(Debug, Clone)]
pub struct Assemblies {
    /// The instant at which drivers have their values \[s\].
    pub at: f64,
    /// The most that are looked for.
    pub most: usize,
}

impl Default for Assemblies {
    fn default() -> Self {
        Assemblies {
            at: 0.0,
            most: MOST,
        }
    }
}

/// All assemblies.
#[derive(Debug, Clone)]
pub struct AssembliesFound {
    /// The model.
    pub file: ModelFile,
    /// What was asked.
    pub asked: Assemblies,
    /// What was found.
    pub found: AllAssemblies,
}

impl Question for Assemblies {
    type Answer = AssembliesFound;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<AssembliesFound, Unanswered> {
        if self.most == 0 {
            return Err(Unanswered::question("--most 0: look for one at least"));
        }
        if !self.at.is_finite() {
            return Err(Unanswered::question("--at: the time must be finite"));
        }
        let found = all_assemblies(file.model(), self.at, self.most, control);
        Ok(AssembliesFound {
            file: file.clone(),
            asked: self.clone(),
            found: found.map_err(|complaints| file.refused(complaints))?,
        })
    }
}

impl AssembliesFound {
    /// The model in which one of the assemblies, counted from 1, is drawn.
    ///
    /// # Errors
    /// Where there is none of that number, and where it can't be drawn.
    pub fn drawn(&self, number: usize) -> Result<ModelFile, Unanswered> {
        let count = self.found.found.len();
        let found = number.checked_sub(1).and_then(|k| self.found.found.get(k));
        let Some(found) = found else {
            return Err(Unanswered::question(format!(
                "--take {number}: there are {count} assemblies"
            )));
        };
        let bodies = &self.file.model().bodies;
        let own = self.found.bodies.iter().zip(&found.poses);
        let own = own.filter(|(name, _)| bodies.contains_key(*name));
        let puts = own.map(|(name, [x, y, angle])| {
            let [x, y] = [x, y].map(|value| format!("{value:?} m"));
            let pose = json!({ "position": [x, y], "angle": format!("{angle:?} rad") });
            Put::new(format!("bodies.{name}.pose"), pose, "the assembly".into())
        });
        Ok(read(
            &self.file.text,
            &self.file.sets,
            &puts.collect::<Vec<_>>(),
        )?)
    }
}
