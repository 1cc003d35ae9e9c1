//! Models of one file with other parameters, and how they depend on them.

use crate::error::{Complaint, Complaints};
use crate::expression::{Derivatives, Interval, Parameters, Real, Recorded};
use crate::gate::Checked;
use crate::load::{sorted, typed};
use crate::source::Source;
use crate::walk::{Findings, recorded, walk_deviating, walk_given};

impl Source {
    /// The model with other values of parameters \[SI\], each in the dimension that it has; no number is printed or read
    /// on the way.
    ///
    /// # Errors
    /// A name that no parameter has, and all faults of the model with these values.
    ///
    /// # Examples
    /// ```
    /// let text = br#"{ "format": "linkdyn/1", "units": "SI", "parameters": { "l": "5 mm" },
    ///     "bodies": { "bar": { "points": { "A": ["=2*l", 0] } } } }"#;
    /// let loaded = linkdyn_model::load(text, &[]).unwrap();
    /// let longer = loaded.source.with_parameters(&[("l", 0.006)]).unwrap();
    /// assert_eq!(longer.bodies["bar"].points["A"], [0.012, 0.0]);
    /// ```
    pub fn with_parameters(&self, values: &[(&str, f64)]) -> Result<Checked, Complaints> {
        self.pass_again(walk_given(self, values))
    }

    /// The model with parameters that deviate \[SI\], each on top of the value that it has or follows from.
    ///
    /// # Errors
    /// As [`Source::with_parameters`].
    ///
    /// # Examples
    /// ```
    /// let text = br#"{ "format": "linkdyn/1", "units": "SI", "parameters": { "r": "5 mm", "l": "=2*r" },
    ///     "bodies": { "bar": { "points": { "A": ["=l", 0] } } } }"#;
    /// let loaded = linkdyn_model::load(text, &[]).unwrap();
    /// let off = loaded.source.with_deviations(&[("r", 0.5), ("l", 0.25)]).unwrap();
    /// assert_eq!(off.bodies["bar"].points["A"], [1.26, 0.0]);
    /// ```
    pub fn with_deviations(&self, deviations: &[(&str, f64)]) -> Result<Checked, Complaints> {
        self.pass_again(walk_deviating(self, deviations))
    }

    /// How the quantities of the file depend on its parameters, at their values.
    ///
    /// # Examples
    /// ```
    /// let text = br#"{ "format": "linkdyn/1", "units": "SI", "parameters": { "r": "5 mm", "l": "=2*r" },
    ///     "bodies": { "bar": { "points": { "A": ["=3*l", 0] } } } }"#;
    /// let loaded = linkdyn_model::load(text, &[]).unwrap();
    /// let leaf = &loaded.source.derivatives().leaves[0];
    /// assert_eq!(leaf.path, "bodies.bar.points.A[0]");
    /// assert_eq!(leaf.gradient, [(0, 6.0), (1, 3.0)]);
    /// ```
    pub fn derivatives(&self) -> Derivatives {
        self.dependence().at(&[])
    }

    /// How the quantities depend on the parameters, to be asked more than once.
    pub fn dependence(&self) -> Dependence {
        let (parameters, recorded) = recorded(self);
        Dependence {
            parameters,
            recorded,
        }
    }

    /// The model that was read once more.
    fn pass_again(
        &self,
        findings: Result<Findings, Vec<Complaint>>,
    ) -> Result<Checked, Complaints> {
        let place = |complaint| self.place(complaint);
        let findings =
            findings.map_err(|said| Complaints(said.into_iter().map(place).collect()))?;
        let (passed, _) = typed(self, findings.value, findings.holes, &findings.undotted);
        match passed {
            Ok(model) if findings.complaints.is_empty() => Ok(model),
            Ok(_) => Err(Complaints(sorted(findings.complaints, findings.more))),
            Err(said) => {
                let said = findings.complaints.into_iter().chain(said).collect();
                Err(Complaints(sorted(said, findings.more)))
            }
        }
    }
}

/// How the quantities of a file depend on its parameters: the expressions that were met in it.
pub struct Dependence {
    parameters: Parameters,
    recorded: Vec<Recorded>,
}

impl Dependence {
    /// Derivatives where parameters deviate \[SI\], one number for each in the order of the file; others are zero.
    pub fn at(&self, deviations: &[f64]) -> Derivatives {
        self.with(|index| deviations.get(index).copied().unwrap_or(0.0))
    }

    /// Enclosures of the quantities and of their derivatives while each parameter deviates within limits \[SI\], lower and
    /// upper for each in the order of the file; others stay.
    pub fn within(&self, limits: &[[f64; 2]]) -> Derivatives<Interval> {
        self.with(|index| {
            let [least, most] = limits.get(index).copied().unwrap_or_default();
            Interval::new(least, most)
        })
    }

    fn with<T: Real>(&self, deviation: impl Fn(usize) -> T) -> Derivatives<T> {
        let deviations: Vec<T> = (0..self.parameters.count()).map(deviation).collect();
        self.parameters.derivatives(&deviations, &self.recorded)
    }
}

#[cfg(test)]
mod tests;
