//! A mechanism ready to run, and handles of its parameters and columns.

use std::path::Path;
use std::str::FromStr;
use std::sync::{Arc, OnceLock};

use linkdyn_ask::run::Origin;
use linkdyn_ask::{ModelFile, Text};
use linkdyn_engine::analysis::Prepared;
use linkdyn_model::error::Complaints;
use linkdyn_model::{Checked, FileAccess, Loaded, Model, bundled};
use linkdyn_output::{Column as Heading, ColumnId};

use crate::error::Error;
use crate::handles::{Column, Columns, Parameter};
use crate::quantity::Quantity;

/// A model that was read and checked: ready to run as often as wanted, from any thread.
///
/// It never changes. What sets values gives another mechanism, and handles of one serve the other.
///
/// # Examples
/// ```
/// use linkdyn::prelude::*;
///
/// let mechanism: Mechanism = r#"{
///     "format": "linkdyn/1", "units": "SI", "parameters": { "r": "50 mm" },
///     "bodies": { "ground": { "points": { "O": [0, 0] } }, "crank": { "points": { "O": [0, 0], "P": ["=r", 0] } } },
///     "joints": { "pin": { "type": "revolute", "between": ["ground.O", "crank.O"] } },
///     "drivers": { "motor": { "type": "rotation", "body": "crank",
///                             "motion": { "type": "polynomial", "coefficients": [0, 1] } } },
///     "points": ["crank.P"],
///     "analysis": { "type": "kinematics", "end": 1, "outputs": 11 }
/// }"#.parse()?;
/// let radius = mechanism.parameter("r")?;
/// let height = mechanism.column("crank.P.y")?;
/// for size in [40.0, 60.0] {
///     let run = mechanism.with([(radius, mm(size))])?.run()?;
///     let top = run.column(height).max();
///     assert!((top - size / 1e3 * 1f64.sin()).abs() < 1e-12);
/// }
/// # Ok::<(), linkdyn::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Mechanism {
    file: ModelFile,
    /// Parameters that have other values than in the file, by index, in SI.
    given: Vec<(usize, f64)>,
    model: Arc<Checked>,
    /// The model compiled for its analysis, when that was first needed.
    prepared: Arc<OnceLock<Prepared>>,
    columns: Arc<Columns>,
}

/// Reads the text of a model file (`linkdyn/1`).
impl FromStr for Mechanism {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        Mechanism::read("model", text.as_bytes().to_vec())
    }
}

/// Where mechanisms come from.
impl Mechanism {
    /// Reads a model file.
    ///
    /// # Errors
    /// [`Error::Read`] where there is no such file, [`Error::Model`] with all faults of the model.
    ///
    /// # Examples
    /// ```no_run
    /// use linkdyn::prelude::*;
    ///
    /// let mechanism = Mechanism::open("four-bar.json")?;
    /// let rod = mechanism.parameter("l_rod")?;
    /// let torque = mechanism.column("driver.motor.effort")?;
    /// let run = mechanism.with([(rod, mm(120.3))])?.run()?;
    /// println!("{}", run.column(torque).max_abs());
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let text = linkdyn_model::read_file(path).map_err(|cause| Error::Read {
            path: path.to_owned(),
            cause,
        })?;
        let stem = path.file_stem().unwrap_or_default();
        Mechanism::read_with_access(&stem.to_string_lossy(), text, FileAccess::of(path))
    }

    /// A bundled model, such as `four-bar`, `lock` or `nfourbar:40`.
    ///
    /// # Errors
    /// [`Error::Bundled`] where there is none of that name.
    pub fn bundled(name: &str) -> Result<Self, Error> {
        let text = bundled::text(name).map_err(|cause| Error::Bundled {
            name: name.to_owned(),
            cause,
        })?;
        Mechanism::read(name, text.into_owned().into_bytes())
    }

    /// A model that was made or changed by the program, through the same gate as a file.
    ///
    /// # Errors
    /// [`Error::Model`] with all faults of the model.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::prelude::*;
    ///
    /// let mut model: Model = (**Mechanism::bundled("four-bar")?.model()).clone();
    /// model.bodies.shift_remove("rocker");
    /// let refused = Mechanism::of_model(model).expect_err("joints name the rocker");
    /// assert_eq!(refused.complaints()[0].path, "joints.c.between[1]");
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn of_model(model: Model) -> Result<Self, Error> {
        let model = model.check()?;
        Mechanism::read("model", model.to_json().to_string().into_bytes())
    }

    pub(crate) fn read(stem: &str, text: Vec<u8>) -> Result<Self, Error> {
        Mechanism::read_with_access(stem, text, FileAccess::default())
    }

    /// The text of a file that is there.
    pub(crate) fn read_with_access(
        stem: &str,
        text: Vec<u8>,
        access: FileAccess,
    ) -> Result<Self, Error> {
        let text = Text::new(stem.to_owned(), stem.to_owned(), text, access);
        Mechanism::load(ModelFile::read(text, Vec::new())?, &[])
    }

    /// What was read, compiled.
    pub(crate) fn of_file(file: ModelFile) -> Result<Self, Error> {
        Mechanism::load(file, &[])
    }

    /// Compiles what was read, and gives parameters other values.
    fn load(file: ModelFile, given: &[(&str, f64)]) -> Result<Self, Error> {
        let prepared = match file.model().analysis {
            Some(_) => {
                let prepared = Prepared::new(file.model());
                Some(prepared.map_err(|found| file.loaded.source.place_all(found))?)
            }
            None => None,
        };
        let columns = prepared.as_ref().map(Prepared::columns);
        let columns = Columns::new(columns.unwrap_or_default());
        let read = Mechanism {
            given: Vec::new(),
            model: Arc::new(file.model().clone()),
            file,
            prepared: Arc::new(prepared.map_or_else(OnceLock::new, OnceLock::from)),
            columns: Arc::new(columns),
        };
        let known = |name: &str| read.parameter(name).map(|parameter| parameter.index);
        let kept = given
            .iter()
            .filter_map(|(name, si)| Some((known(name).ok()?, *si)));
        let kept: Vec<_> = kept.collect();
        if kept.is_empty() {
            return Ok(read);
        }
        read.given(kept)
    }
}

/// What a mechanism is.
impl Mechanism {
    /// The model, all numbers in SI units.
    pub fn model(&self) -> &Checked {
        &self.model
    }

    /// The model's own name, or the file's.
    pub fn name(&self) -> &str {
        let own = self.model.name.as_deref().filter(|name| !name.is_empty());
        own.unwrap_or(&self.file.text.stem)
    }

    /// The model as a file: the words that were read, parameters and expressions included, with what was set since.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::prelude::*;
    ///
    /// let mechanism = Mechanism::bundled("four-bar")?;
    /// let crank = mechanism.parameter("crank")?;
    /// let text = mechanism.with([(crank, mm(90.0))])?.to_json();
    /// assert!(text.contains(r#""crank": "0.09 m""#));
    /// assert_eq!(text.parse::<Mechanism>()?.parameter("crank")?.nominal(), mm(90.0));
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn to_json(&self) -> String {
        let mut document = self.file.loaded.source.print(&self.file.loaded.model);
        for &(index, si) in &self.given {
            let parameter = &self.file.loaded.parameters[index];
            document["parameters"][&parameter.name] = match parameter.unit.as_str() {
                "" => si.into(),
                // The shortest text that is read as the same double.
                unit => format!("{si:?} {unit}").into(),
            };
        }
        format!("{document:#}")
    }

    /// What is allowed in the model and yet probably a slip.
    pub fn warnings(&self) -> &[String] {
        &self.file.loaded.warnings
    }

    /// Names and handles of the parameters, in the order of the model.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, Parameter)> {
        let parameters = self.file.loaded.parameters.iter().enumerate();
        parameters.filter_map(|(index, parameter)| {
            let nominal = Quantity::in_si(parameter.value, &parameter.unit)?;
            Some((parameter.name.as_str(), Parameter { index, nominal }))
        })
    }

    /// The handle of a parameter.
    ///
    /// # Errors
    /// [`Error::Unknown`] where the model has none of that name.
    pub fn parameter(&self, name: &str) -> Result<Parameter, Error> {
        let found = self.parameters().find(|(known, _)| *known == name);
        found
            .map(|(_, parameter)| parameter)
            .ok_or_else(|| unknown("parameter", name, self.parameters().map(|(known, _)| known)))
    }

    /// Names and handles of the result columns, in the order of `results.csv`; `time` is the first. Empty where the model says
    /// no analysis.
    pub fn columns(&self) -> impl Iterator<Item = (&str, Column)> {
        let headings = self.headings();
        headings.map(|(heading, column)| (heading.name.as_str(), column))
    }

    /// Headings and handles of the result columns.
    pub(crate) fn headings(&self) -> impl Iterator<Item = (&Heading, Column)> {
        let columns = self.columns.table.iter().enumerate();
        columns.map(|(index, heading)| {
            let handle = Column {
                id: ColumnId::at(index),
                table: self.columns.mark,
                unit: heading.unit,
            };
            (heading, handle)
        })
    }

    /// The handle of a result column, such as `driver.motor.effort` or `joint.b.fx`.
    ///
    /// # Errors
    /// [`Error::Unknown`] where the analysis has none of that name.
    pub fn column(&self, name: &str) -> Result<Column, Error> {
        let found = self.columns().find(|(known, _)| *known == name);
        found
            .map(|(_, column)| column)
            .ok_or_else(|| unknown("column", name, self.columns().map(|(known, _)| known)))
    }

    pub(crate) fn table(&self) -> u64 {
        self.columns.mark
    }

    /// The model compiled for its analysis, once for all runs.
    pub(crate) fn prepared(&self) -> Result<&Prepared, Error> {
        if let Some(prepared) = self.prepared.get() {
            return Ok(prepared);
        }
        let prepared = Prepared::new(&self.model).map_err(|found| self.place(found))?;
        Ok(self.prepared.get_or_init(|| prepared))
    }

    /// The model as it would be read with the values that parameters were given.
    pub(crate) fn as_file(&self) -> Result<ModelFile, Error> {
        if self.given.is_empty() {
            return Ok(self.file.clone());
        }
        let sets = self.given.iter().map(|one| {
            let (name, si) = self.named(one);
            match self.file.loaded.parameters[one.0].unit.as_str() {
                "" => format!("parameters.{name}={si:?}"),
                unit => format!("parameters.{name}=\"{si:?} {unit}\""),
            }
        });
        Ok(self.file.set(sets.collect())?)
    }

    /// What was read, and the values that parameters were given since, by index.
    pub(crate) fn read_with(&self) -> (&Loaded, &[(usize, f64)]) {
        (&self.file.loaded, &self.given)
    }

    /// Complaints that came up after the model was read, with their places.
    pub(crate) fn place(&self, complaints: Complaints) -> Error {
        self.file.loaded.source.place_all(complaints).into()
    }

    pub(crate) fn origin(&self) -> Origin<'_> {
        Origin {
            model: self.model(),
            name: self.name(),
            load: self.file.time,
            sha256: &self.file.text.sha256,
        }
    }
}

/// Variants.
impl Mechanism {
    /// The mechanism with other values of parameters; whatever follows from them by expressions follows. No number is
    /// printed or read on the way.
    ///
    /// # Errors
    /// [`Error::Dimension`] where a value has another dimension than its parameter, [`Error::Model`] where the model has faults
    /// with these values.
    pub fn with(
        &self,
        values: impl IntoIterator<Item = (Parameter, Quantity)>,
    ) -> Result<Self, Error> {
        let mut given = self.given.clone();
        for (parameter, value) in values {
            let Some(known) = self.file.loaded.parameters.get(parameter.index) else {
                let name = format!("number {}", parameter.index);
                return Err(unknown("parameter", &name, std::iter::empty()));
            };
            if !parameter.nominal.same_dimension(value) {
                return Err(Error::Dimension {
                    parameter: known.name.clone(),
                    expected: word(parameter.nominal),
                    given: word(value),
                });
            }
            given.retain(|(index, _)| *index != parameter.index);
            given.push((parameter.index, value.si()));
        }
        self.given(given)
    }

    fn given(&self, given: Vec<(usize, f64)>) -> Result<Self, Error> {
        let named: Vec<(&str, f64)> = given.iter().map(|one| self.named(one)).collect();
        let model = self.file.loaded.source.with_parameters(&named)?;
        Ok(Mechanism {
            given,
            model: Arc::new(model),
            prepared: Arc::default(),
            ..self.clone()
        })
    }

    fn named(&self, (index, si): &(usize, f64)) -> (&str, f64) {
        (&self.file.loaded.parameters[*index].name, *si)
    }

    /// The mechanism with a value of its model set, as by `--set PATH=VALUE` of the command.
    ///
    /// # Errors
    /// [`Error::Model`] where the path leads nowhere, or the model has faults with that value.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::prelude::*;
    ///
    /// let coarse = Mechanism::bundled("four-bar")?.set("analysis.outputs", "5")?;
    /// assert_eq!(coarse.run()?.time().len(), 5);
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn set(&self, path: &str, value: &str) -> Result<Self, Error> {
        self.set_all([format!("{path}={value}")])
    }

    /// The mechanism with values of its model set at once, each as `PATH=VALUE`.
    pub(crate) fn set_all(&self, more: impl IntoIterator<Item = String>) -> Result<Self, Error> {
        let more: Vec<String> = more.into_iter().collect();
        let given: Vec<(&str, f64)> = self.given.iter().map(|one| self.named(one)).collect();
        Mechanism::load(self.file.set(more)?, &given)
    }
}

/// A unit as messages name it.
fn word(quantity: Quantity) -> String {
    match quantity.unit() {
        unit if unit.is_empty() => "plain numbers".to_owned(),
        unit => unit,
    }
}

pub(crate) fn unknown<'a>(
    what: &'static str,
    name: &str,
    known: impl Iterator<Item = &'a str>,
) -> Error {
    Error::Unknown {
        what,
        name: name.to_owned(),
        nearest: linkdyn_model::nearest(name, known).map(str::to_owned),
    }
}
