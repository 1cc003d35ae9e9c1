//! Derivatives of what a file's expressions give, by the deviations of all parameters.
//!
//! Each parameter may deviate on its own: p_k = f_k(parameters) + d_k, also one that follows from others. The derivatives
//! are those by d_k, at the deviations requested, in SI.

use super::dual::Dual;
use super::number::{Number, Real};
use super::parameters::Parameters;
use super::written::Written;
use super::{Misfit, Quantity};

/// How the quantities of a file depend on its parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Derivatives<T = f64> {
    /// The names of all parameters, in the order of the file.
    pub parameters: Vec<String>,
    /// Each quantity of the file that an expression with parameters gives.
    pub leaves: Vec<Leaf<T>>,
}

/// A quantity that follows from parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Leaf<T = f64> {
    /// Where it stands, as in `bodies.crank.points.A[0]`.
    pub path: String,
    /// Its value in SI, where it has one.
    pub value: Option<T>,
    /// Its derivatives by the deviations of parameters, by their index in rising order \[SI per SI\]; others are zero.
    pub gradient: Vec<(usize, T)>,
    /// Why there are no derivatives.
    pub fault: Option<String>,
}

/// An expression that was met in a file.
#[derive(Debug, Clone)]
pub struct Recorded {
    /// Where it stands.
    pub path: String,
    /// The expression.
    pub text: String,
    /// The SI value of a one there.
    pub factor: f64,
}

/// Values with derivatives, `None` if there is a reason in its place.
struct KnownValues<T> {
    values: Vec<Option<Quantity<Dual<T>>>>,
    reasons: Vec<Option<String>>,
}

impl Parameters {
    /// The derivatives at deviations, one for each parameter.
    pub fn derivatives<T: Real>(&self, deviations: &[T], recorded: &[Recorded]) -> Derivatives<T> {
        let known = self.differentiated(deviations);
        let leaves = recorded.iter().filter_map(|one| self.leaf(one, &known));
        Derivatives {
            leaves: leaves.collect(),
            parameters: self.names.clone(),
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.names.len()
    }

    fn differentiated<T: Real>(&self, deviations: &[T]) -> KnownValues<T> {
        let mut reasons = vec![None; self.names.len()];
        let (values, _) = self.follow(|index, value| {
            let value = match &self.written[index] {
                Written::Faulty => Err("it has no value".to_owned()),
                Written::Value(_) => explained(&reasons, value, [].into_iter()),
                Written::Expression(one) => explained(&reasons, value, one.parameters()),
            };
            let deviating = |one: Dual<T>| one.deviating(index, &deviations[index]);
            value
                .map(|one| one.with_value(deviating(one.value.clone())))
                .map_err(|reason| {
                    reasons[index] = Some(format!("{}: {reason}", self.names[index]));
                })
                .ok()
        });
        KnownValues { values, reasons }
    }

    /// A quantity; `None` if no parameter gives it.
    fn leaf<T: Real>(&self, recorded: &Recorded, known: &KnownValues<T>) -> Option<Leaf<T>> {
        // what can't be read was complained about
        let expression = self.parse(&recorded.text).ok()?;
        expression.parameters().next()?;
        let value = expression.evaluate(&known.values, self.degrees);
        let value = explained(&known.reasons, value, expression.parameters());
        let mut leaf = Leaf {
            path: recorded.path.clone(),
            value: None,
            gradient: Vec::new(),
            fault: None,
        };
        match value {
            Ok(quantity) => {
                let factor = Dual {
                    value: if recorded.factor == 1.0 {
                        T::of(1.0)
                    } else {
                        T::about(recorded.factor)
                    },
                    slope: Ok(Vec::new()),
                };
                let Dual { value, slope } = quantity.value.multiply(&factor);
                leaf.value = Some(value);
                match slope {
                    Ok(gradient) => leaf.gradient = gradient,
                    Err(reason) => leaf.fault = Some(reason.to_owned()),
                }
            }
            Err(reason) => leaf.fault = Some(reason),
        }
        Some(leaf)
    }
}

/// What an evaluation gave, or why it gave nothing: the reason of a parameter that it names.
fn explained<T>(
    reasons: &[Option<String>],
    evaluated: Result<Option<Quantity<Dual<T>>>, Misfit>,
    mut named: impl Iterator<Item = usize>,
) -> Result<Quantity<Dual<T>>, String> {
    match evaluated {
        Ok(Some(value)) => Ok(value),
        Ok(None) => {
            let reason = named.find_map(|index| reasons[index].clone());
            Err(reason.unwrap_or_else(|| "a parameter has no value".to_owned()))
        }
        Err(misfit) => Err(misfit.fault.message),
    }
}
