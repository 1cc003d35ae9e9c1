//! Many mechanisms of one structure: the same file with other values of its parameters.
//!
//! A [`Family`] is read, checked and compiled once. Each thread has a [`Member`] of its own, which takes values and works
//! out the responses of the model. Where drivers prescribe the motion, the nominal mechanism is followed once, and the
//! others are found beside it: at each station Newton's iteration begins where the difference from the nominal mechanism
//! is predicted to be, and its contraction says that the solution found is that one (`track`). Of `statics` each variant is
//! brought to rest by itself, with its numbers put in. Whatever is not as simple as that is run as any model is: dynamics,
//! clearance, change points and dead centres, redundant constraints, values that are not legal.
//!
//! What comes out depends on the values alone, not on what was computed before.
//!
//! # Examples
//! ```
//! use linkdyn_engine::analysis::{Control, Family};
//! use linkdyn_model::{Given, bundled, load};
//!
//! let text = bundled::find("slider-crank").unwrap().text.as_bytes();
//! let loaded = load(text, &["responses.stroke=max(piston.x)-min(piston.x)".to_owned()]).unwrap();
//! let family = Family::new(&loaded, &["crank"], Given::Values).unwrap();
//! let mut member = family.begin();
//! let mut stroke = [0.0];
//! for crank in [0.04, 0.05, 0.06] {
//!     member.run(&[crank], &Control::default(), &mut stroke).unwrap();
//!     assert!((stroke[0] - 2.0 * crank).abs() < 1e-12);
//! }
//! // and how they change: the derivative of each response by each parameter
//! let mut slope = [0.0];
//! member.gradient(&[0.05], &[0.05], &Control::default(), &mut stroke, &mut slope).unwrap();
//! assert!((slope[0] - 2.0).abs() < 1e-12);
//! ```

mod along;
mod around;
mod ended;
mod guess;
mod march;
mod mechanisms;
mod needs;
mod numbers;
mod perturbed;
mod resting;
mod slopes;
mod stencil;
mod track;

use super::control::Control;
use super::question::Kind;
use super::responses::Responses;
use super::run::Prepared;
pub use ended::Ended;
/// How many variants are worked out side by side.
pub use linkdyn_linear::math::WIDTH as ABREAST;
use linkdyn_model::error::Complaints;
use linkdyn_model::{Checked, Given, Loaded, Source, Substitution};
use mechanisms::Mechanisms;
use needs::{Depth, Needs};
use numbers::Numbers;
use perturbed::PerturbedSolver;
use resting::Resting;
use track::{Changes, Track};

/// A model with parameters that take other values.
pub struct Family {
    source: Source,
    names: Vec<String>,
    given: Given,
    /// The values of the file, or no deviation.
    nominal: Vec<f64>,
    /// How large the parameters are.
    lengths: Vec<f64>,
    substitution: Option<Substitution>,
    prepared: Prepared,
    ways: Ways,
    /// How numbers follow without the compiler, of variants that are found beside the nominal mechanism.
    numbers: Option<Numbers>,
}

/// How variants are worked out.
enum Ways {
    /// Beside the nominal mechanism, whose motion drivers prescribe.
    Perturbed(Box<Track>),
    /// At rest, by putting in numbers.
    AtRest(Needs),
    /// As any model is run.
    Alone,
}

/// One thread's share of a family.
pub struct Member<'f> {
    family: &'f Family,
    mechanisms: Option<Mechanisms<'f>>,
    way: MemberSolver<'f>,
}

/// One thread's share of a way.
enum MemberSolver<'f> {
    Perturbed(Box<PerturbedSolver<'f>>),
    AtRest(Box<Resting<'f>>),
    Alone,
}

impl Ways {
    fn new(prepared: &Prepared, substitution: &Substitution) -> Self {
        let (nominal, question) = prepared.parts();
        let rests = question.kind == Kind::Rest && nominal.contacts.is_empty();
        let changes = Changes {
            analysis: substitution.changes("analysis"),
            drivers: substitution.changes("drivers"),
        };
        let mut responses = prepared.responses().list().iter();
        let way = match (responses.any(|one| one.needs_report), rests) {
            (true, _) => None,
            (false, true) => Needs::new(prepared).map(Ways::AtRest),
            (false, false) => {
                Track::new(prepared, changes).map(|track| Ways::Perturbed(Box::new(track)))
            }
        };
        way.unwrap_or(Ways::Alone)
    }
}

impl Family {
    /// Of a model that was read, and the names of the parameters that are given.
    ///
    /// # Errors
    /// As [`Prepared::new`]; a name that no parameter has.
    pub fn new(loaded: &Loaded, names: &[&str], given: Given) -> Result<Self, Complaints> {
        let prepared = Prepared::new(&loaded.model)?;
        let find = |name: &&str| {
            let mut known = loaded.parameters.iter();
            known.find(|one| one.name == **name).map(|one| one.value)
        };
        let values: Option<Vec<f64>> = names.iter().map(find).collect();
        let Some(values) = values else {
            // says which name there is not
            let none: Vec<(&str, f64)> = names.iter().map(|name| (*name, 0.0)).collect();
            loaded.source.with_deviations(&none)?;
            return Err(Complaints(Vec::new()));
        };
        let substitution = Substitution::new(
            &loaded.source,
            &loaded.model,
            &loaded.parameters,
            names,
            given,
        );
        let own = substitution.as_ref();
        let ways = own.map_or(Ways::Alone, |own| Ways::new(&prepared, own));
        let numbers = match (&ways, own) {
            (Ways::Perturbed(track), Some(own)) if !track.needs.follow() => {
                let with_forces = track.needs.depth(track.reactions) == Depth::Forces;
                mechanisms::numbers(own, prepared.parts().0, with_forces)
            }
            _ => None,
        };
        Ok(Family {
            source: loaded.source.clone(),
            names: names.iter().map(|name| (*name).to_owned()).collect(),
            lengths: values.iter().map(|value| value.abs()).collect(),
            nominal: match given {
                Given::Values => values,
                Given::Deviations => vec![0.0; names.len()],
            },
            given,
            substitution,
            prepared,
            ways,
            numbers,
        })
    }

    /// The named numbers that come out.
    pub fn responses(&self) -> &Responses {
        self.prepared.responses()
    }

    /// How many parameters are given.
    pub fn parameters(&self) -> usize {
        self.names.len()
    }

    /// Whether variants are found beside the nominal mechanism.
    pub fn is_tracked(&self) -> bool {
        matches!(self.ways, Ways::Perturbed(_))
    }

    /// Begins, for one thread.
    pub fn begin(&self) -> Member<'_> {
        let mechanisms = self.substitution.as_ref();
        let (system, _) = self.prepared.parts();
        let responses = self.responses();
        Member {
            family: self,
            mechanisms: mechanisms.map(|substitution| {
                let numbers = self.numbers.as_ref();
                let numbers = numbers.map(|numbers| (numbers, system.clone()));
                Mechanisms::new(substitution, [&self.nominal, &self.lengths], numbers)
            }),
            way: match &self.ways {
                Ways::Perturbed(track) => PerturbedSolver::new(track, system, responses)
                    .map_or(MemberSolver::Alone, |own| {
                        MemberSolver::Perturbed(Box::new(own))
                    }),
                Ways::AtRest(needs) => {
                    MemberSolver::AtRest(Box::new(Resting::new(needs, responses)))
                }
                Ways::Alone => MemberSolver::Alone,
            },
        }
    }

    /// The model with values.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn model(&self, values: &[f64]) -> Result<Checked, Complaints> {
        let pairs = self.names.iter().map(String::as_str);
        let pairs: Vec<(&str, f64)> = pairs.zip(values.iter().copied()).collect();
        match self.given {
            Given::Values => self.source.with_parameters(&pairs),
            Given::Deviations => self.source.with_deviations(&pairs),
        }
    }
}

impl Member<'_> {
    /// Works out the responses and their derivatives by the parameters: a row of `gradient` for each response, NaN where a
    /// derivative is not known exactly. `lengths` say over what change of each parameter the mechanism changes much, as its
    /// value or its range.
    ///
    /// Known are those of motions that are found beside the nominal mechanism, without friction that depends on joint forces:
    /// extremes at smooth tops and at the ends, `at`, `first`, `last`, and sums over the rows; and those of equilibria that are
    /// stable. They are exact to round-off, some 1e-13 of what they are made of: the equations of the instants that count are
    /// differentiated, not runs.
    ///
    /// # Errors
    /// What is wrong with a model of these values.
    pub fn gradient(
        &mut self,
        values: &[f64],
        lengths: &[f64],
        control: &Control,
        responses: &mut [f64],
        gradient: &mut [f64],
    ) -> Result<Ended, Complaints> {
        self.keep_motion();
        let ended = self.run(values, control, responses)?;
        self.slopes(values, lengths, gradient);
        let rows = gradient.chunks_exact_mut(self.family.parameters().max(1));
        let missing = rows.zip(responses).filter(|(_, value)| value.is_nan());
        missing.for_each(|(row, _)| row.fill(f64::NAN));
        Ok(ended)
    }

    /// The same derivatives where these values were run last, and motions are kept ([`Member::keep_motion`]): without running
    /// them again. NaN, all of them, where that is not so, or the variant was run as any model is.
    pub fn slopes(&mut self, values: &[f64], lengths: &[f64], gradient: &mut [f64]) {
        gradient.fill(f64::NAN);
        let Some(mechanisms) = &mut self.mechanisms else {
            return;
        };
        let what = (values, lengths);
        match &mut self.way {
            MemberSolver::Perturbed(perturbed) if perturbed.has(values) => {
                perturbed.differentiate(what, mechanisms, gradient);
            }
            MemberSolver::AtRest(resting) if resting.has(values) => {
                resting.differentiate(what, mechanisms, gradient);
            }
            MemberSolver::Perturbed(_) | MemberSolver::AtRest(_) | MemberSolver::Alone => {}
        }
    }

    /// Keeps the motion of each run from now on, for [`Member::slopes`].
    pub fn keep_motion(&mut self) {
        match &mut self.way {
            MemberSolver::Perturbed(perturbed) => {
                perturbed.keep_motion(self.family.prepared.parts().0);
            }
            MemberSolver::AtRest(resting) => resting.keep_motion(),
            MemberSolver::Alone => {}
        }
    }

    /// Says which variants are run next. Where they are found beside the nominal mechanism, as many of them as [`ABREAST`] are
    /// worked out side by side; what comes out of each is the same.
    pub fn expect(&mut self, variants: &[&[f64]]) {
        let Member {
            mechanisms, way, ..
        } = self;
        if let (Some(mechanisms), MemberSolver::Perturbed(perturbed)) = (mechanisms, way) {
            perturbed.follow(&variants[..variants.len().min(ABREAST)], mechanisms);
        }
    }

    /// Works out the responses for values, in the order of the names; NaN where one has none.
    ///
    /// # Errors
    /// What is wrong with a model of these values.
    pub fn run(
        &mut self,
        values: &[f64],
        control: &Control,
        responses: &mut [f64],
    ) -> Result<Ended, Complaints> {
        let Member {
            family,
            mechanisms,
            way,
        } = self;
        if let Some(mechanisms) = mechanisms {
            let ended = match way {
                MemberSolver::Perturbed(perturbed) => {
                    let is_found = perturbed.run(values, mechanisms, responses);
                    is_found.then(|| Ended::whole(responses))
                }
                MemberSolver::AtRest(resting) => {
                    resting.run(values, mechanisms, control, responses)
                }
                MemberSolver::Alone => None,
            };
            if let Some(ended) = ended {
                return Ok(ended);
            }
        }
        let made = mechanisms.as_mut();
        let prepared = match made.and_then(|mechanisms| mechanisms.model(values)) {
            Some(model) => Prepared::new(model)?,
            None => Prepared::new(&family.model(values)?)?,
        };
        let outcome = prepared.for_responses().run(control)?;
        for (response, answer) in responses.iter_mut().zip(&outcome.responses) {
            *response = answer.value.unwrap_or(f64::NAN);
        }
        Ok(Ended {
            status: outcome.report.status,
            missing: responses.iter().position(|value| value.is_nan()),
        })
    }
}
