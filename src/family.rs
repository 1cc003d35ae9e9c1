//! Many variants of one mechanism.

use linkdyn_engine::analysis::{self, Control};
use linkdyn_model::Given;
use linkdyn_output::Status;

use crate::error::Error;
use crate::handles::Parameter;
use crate::mechanism::Mechanism;

/// A mechanism whose parameters take many values: compiled and followed once, shared by threads.
///
/// What a variant gives are the responses of the model, in SI and in the order of the model. It is the one that a run of
/// [`Mechanism::with`] gives, to round-off. Where drivers prescribe the motion, variants are found beside the nominal
/// mechanism, in a fraction of the time.
///
/// # Examples
/// ```
/// use linkdyn::prelude::*;
///
/// let press = Mechanism::bundled("slider-crank")?.set("responses.stroke", "max(piston.x) - min(piston.x)")?;
/// let family = press.family(&[press.parameter("crank")?])?;
/// let mut member = family.member();
/// let mut stroke = [0.0];
/// for crank in [0.04, 0.05, 0.06] {
///     let status = member.run(&[crank], &mut stroke)?;
///     assert_eq!(status, Status::Completed);
///     assert!((stroke[0] - 2.0 * crank).abs() < 1e-12);
/// }
/// # Ok::<(), linkdyn::Error>(())
/// ```
pub struct Family {
    mechanism: Mechanism,
    family: analysis::Family,
    /// Values of parameters that the mechanism was given before, behind those that vary.
    fixed: Vec<f64>,
    /// Over what change of each parameter the mechanism changes much, where its value is zero.
    lengths: Vec<f64>,
}

/// The variants that one thread computes; see [`Family`].
pub struct Member<'f> {
    family: &'f Family,
    member: analysis::Member<'f>,
    values: Vec<f64>,
    control: Control,
}

impl Mechanism {
    /// The family of mechanisms in which these parameters take other values.
    ///
    /// # Errors
    /// [`Error::Unknown`] where a parameter is none of this mechanism, [`Error::Model`] where the model has no analysis, or
    /// lacks what it needs.
    pub fn family(&self, parameters: &[Parameter]) -> Result<Family, Error> {
        let (loaded, given) = self.read_with();
        let varied = parameters.iter().map(|parameter| parameter.index);
        let varied: Vec<usize> = varied.collect();
        let others = given.iter().filter(|(index, _)| !varied.contains(index));
        let others: Vec<(usize, f64)> = others.copied().collect();
        let indexes = varied.iter().chain(others.iter().map(|(index, _)| index));
        let mut names = Vec::new();
        for &index in indexes {
            let Some(parameter) = loaded.parameters.get(index) else {
                return Err(Error::Unknown {
                    what: "parameter",
                    name: format!("number {index}"),
                    nearest: None,
                });
            };
            names.push(parameter.name.as_str());
        }
        let lengths = names.iter().map(|name| length(&loaded.parameters, name));
        let lengths = lengths.collect();
        let family = analysis::Family::new(loaded, &names, Given::Values);
        Ok(Family {
            lengths,
            family: family.map_err(|found| self.place(found))?,
            mechanism: self.clone(),
            fixed: others.iter().map(|(_, value)| *value).collect(),
        })
    }
}

impl Family {
    /// How many variants are worked out side by side, see [`Member::expect`].
    pub const ABREAST: usize = analysis::ABREAST;

    /// Begins; each thread has its own.
    pub fn member(&self) -> Member<'_> {
        self.member_under(Control::default())
    }

    /// The same under outside control.
    pub fn member_under(&self, control: Control) -> Member<'_> {
        Member {
            family: self,
            member: self.family.begin(),
            values: Vec::new(),
            control,
        }
    }

    /// Names and units of the responses.
    pub(crate) fn responses(&self) -> impl Iterator<Item = (&str, &str)> {
        let responses = self.family.responses().list().iter();
        responses.map(|response| (response.name.as_str(), response.unit.as_str()))
    }
}

impl Member<'_> {
    /// Says whose responses [`Member::run`] is asked for next. Where drivers prescribe the motion the first [`Family::ABREAST`] of
    /// them are worked out side by side, which takes little longer than one; responses are the same with and without it.
    ///
    /// # Panics
    /// Where there are not as many values as parameters.
    pub fn expect(&mut self, variants: &[&[f64]]) {
        let fixed = &self.family.fixed;
        let wanted = self.family.family.parameters() - fixed.len();
        let whole = |values: &&[f64]| {
            assert_eq!(values.len(), wanted, "one value for each parameter");
            [*values, fixed].concat()
        };
        let all: Vec<Vec<f64>> = variants.iter().take(Family::ABREAST).map(whole).collect();
        let all: Vec<&[f64]> = all.iter().map(Vec::as_slice).collect();
        self.member.expect(&all);
    }

    /// Works out the responses for values of the parameters \[SI\], in their order; NaN where one has none. How the run ended
    /// is no error: then all responses are NaN that need the whole of it.
    ///
    /// # Errors
    /// [`Error::Model`] where the model has faults with these values.
    ///
    /// # Panics
    /// Where there are not as many values as parameters, or more or less room than responses.
    pub fn run(&mut self, values: &[f64], responses: &mut [f64]) -> Result<Status, Error> {
        let family = self.family;
        self.take(values, responses);
        let ended = self.member.run(&self.values, &self.control, responses);
        let ended = ended.map_err(|found| family.mechanism.place(found))?;
        Ok(ended.status)
    }

    /// Works out the responses and their exact derivatives by the parameters \[SI\]: a row of `gradient` for each response, NaN
    /// where a derivative is not known exactly. Known are those of motions that drivers prescribe, and of equilibria that are
    /// stable: of smooth extremes, of values at an instant, and of sums over the rows.
    ///
    /// # Errors
    /// [`Error::Model`] where the model has faults with these values.
    ///
    /// # Panics
    /// Where there are not as many values as parameters, or more or less room than responses, and responses by parameters.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::prelude::*;
    ///
    /// let press = Mechanism::bundled("slider-crank")?.set("responses.stroke", "max(piston.x) - min(piston.x)")?;
    /// let family = press.family(&[press.parameter("crank")?])?;
    /// let (mut stroke, mut slope) = ([0.0], [0.0]);
    /// family.member().gradient(&[0.05], &mut stroke, &mut slope)?;
    /// assert!((slope[0] - 2.0).abs() < 1e-12);
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn gradient(
        &mut self,
        values: &[f64],
        responses: &mut [f64],
        gradient: &mut [f64],
    ) -> Result<Status, Error> {
        let family = self.family;
        self.take(values, responses);
        let columns = values.len();
        assert_eq!(
            gradient.len(),
            columns * responses.len(),
            "room for each derivative"
        );
        let lengths = self.values.iter().zip(&family.lengths);
        let lengths =
            lengths.map(|(value, length)| if *value == 0.0 { *length } else { value.abs() });
        let lengths: Vec<f64> = lengths.collect();
        let mut all = vec![f64::NAN; lengths.len() * responses.len()];
        let (member, control) = (&mut self.member, &self.control);
        let ended = member.gradient(&self.values, &lengths, control, responses, &mut all);
        let ended = ended.map_err(|found| family.mechanism.place(found))?;
        let rows = gradient.chunks_exact_mut(columns.max(1));
        for (row, all) in rows.zip(all.chunks_exact(lengths.len().max(1))) {
            row.copy_from_slice(&all[..columns]);
        }
        Ok(ended.status)
    }

    /// Takes values of the parameters that vary, with those of the others behind them.
    fn take(&mut self, values: &[f64], responses: &[f64]) {
        let family = self.family;
        let wanted = family.family.parameters() - family.fixed.len();
        assert_eq!(values.len(), wanted, "one value for each parameter");
        let count = family.family.responses().len();
        assert_eq!(responses.len(), count, "room for each response");
        self.values.clear();
        self.values.extend(values.iter().chain(&family.fixed));
    }
}

/// Over what change of a parameter that is zero the mechanism changes much: the largest that has its unit, or one unit.
fn length(parameters: &[linkdyn_model::Parameter], name: &str) -> f64 {
    let own = parameters.iter().find(|own| own.name == name);
    let alike = |other: &&linkdyn_model::Parameter| own.is_some_and(|own| own.unit == other.unit);
    let sizes = parameters.iter().filter(alike).map(|one| one.value.abs());
    match sizes.fold(0.0, f64::max) {
        0.0 => 1.0,
        largest => largest,
    }
}
