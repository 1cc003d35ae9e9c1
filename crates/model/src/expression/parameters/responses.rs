//! Texts of responses, in which parameters are named.

use super::Parameters;
use crate::expression::{Compiled, Expression, Misfit, Moving, Quantity, Results};

/// What a response measures, and its parameters.
type Measured = Option<(Quantity, Vec<(String, Quantity)>)>;

/// An expression of what moves, and its parameters.
pub type Moved = Option<(Moving, Vec<(String, Quantity)>)>;

/// Parameters of a text, with their values.
type Named<'a> = Option<(Vec<usize>, Vec<(&'a str, Quantity)>)>;

impl Parameters {
    /// What a response measures, and the parameters that it names; `None` if one of these has no value.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn response(&mut self, text: &str, results: &dyn Results) -> Result<Measured, Misfit> {
        let Some((named, constants)) = self.named(text, results)? else {
            return Ok(None);
        };
        let compiled = Compiled::read(text, &constants, results, self.degrees)?;
        let constants = constants.into_iter();
        let constants = constants
            .map(|(name, value)| (name.to_owned(), value))
            .collect();
        named.iter().for_each(|&index| self.used[index] = true);
        Ok(Some((compiled.quantity, constants)))
    }

    /// An expression of what moves, and the parameters that it names; `None` if one of these has no value.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn moving(&mut self, text: &str, results: &dyn Results) -> Result<Moved, Misfit> {
        let (named, constants) = match self.named(text, results)? {
            Some(found) => found,
            None => return Ok(None),
        };
        let moving = Moving::read(text, &constants, results, self.degrees)?;
        let constants = constants.into_iter();
        let constants = constants
            .map(|(name, value)| (name.to_owned(), value))
            .collect();
        if moving.has_arguments() {
            named.iter().for_each(|&index| self.used[index] = true);
        }
        Ok(Some((moving, constants)))
    }

    /// The parameters that a text names, with their values; `None` if one has none.
    fn named(&self, text: &str, results: &dyn Results) -> Result<Named<'_>, Misfit> {
        let find = |name: &str| self.places.get(name).copied();
        let expression = Expression::response(text, &find, &self.names, results)?;
        let mut named: Vec<usize> = expression.parameters().collect();
        named.sort_unstable();
        named.dedup();
        let value = |&index: &usize| Some((self.names[index].as_str(), self.values[index]?));
        let constants = named.iter().map(value).collect::<Option<Vec<_>>>();
        Ok(constants.map(|constants| (named, constants)))
    }

    /// A text with what responses say in the place of their names; those of parameters stay.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn with_responses(
        &self,
        text: &str,
        responses: &[(String, String)],
        results: &dyn Results,
    ) -> Result<String, Misfit> {
        let own = self.names.len();
        let all = responses.iter().map(|(name, _)| name.clone());
        let names: Vec<String> = self.names.iter().cloned().chain(all).collect();
        let find = |name: &str| {
            let response = || responses.iter().position(|one| one.0 == name);
            let parameter = self.places.get(name).copied();
            parameter.or_else(|| Some(own + response()?))
        };
        // In quotes the parser takes a name for that of a result.
        let mut whole = text.to_owned();
        for (name, value) in responses {
            whole = whole.replace(&format!("'{name}'"), &format!("({value})"));
        }
        if whole != text {
            return self.with_responses(&whole, responses, results);
        }
        let expression = Expression::response(text, &find, &names, results)?;
        for (at, index) in expression.places().into_iter().rev() {
            if let Some((name, value)) = index.checked_sub(own).and_then(|k| responses.get(k)) {
                whole.replace_range(at..at + name.len(), &format!("({value})"));
            }
        }
        Ok(whole)
    }
}
