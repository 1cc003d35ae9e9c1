//! The text of an output.
//!
//! ```text
//! ratio = "d(" name ")" "/" "d(" name ")"      name as formulas have it, or in single quotes
//! ```

use crate::dimension::Dimension;
use crate::error::Complaint;
use crate::formula::{Argument, Order};
use crate::node::excerpt;
use crate::ratio::Ratio;
use crate::response::Catalogue;
use crate::suggest;

/// What an output looks like.
const EXAMPLE: &str = "as in d(axle.y)/d(force.shock.length)";

impl Ratio {
    /// Reads the text of an output.
    ///
    /// # Errors
    /// What is wrong with it, at no path.
    pub fn read(text: &str, catalogue: &Catalogue) -> Result<Ratio, Complaint> {
        let malformed = || Complaint::new("", "this is no ratio of two velocities").hint(EXAMPLE);
        let (first, rest) = differential(text).ok_or_else(malformed)?;
        let rest = rest.trim_start().strip_prefix('/').ok_or_else(malformed)?;
        let (second, rest) = differential(rest).ok_or_else(malformed)?;
        if !rest.trim().is_empty() {
            return Err(malformed());
        }
        let (first, second) = (quantity(first, catalogue)?, quantity(second, catalogue)?);
        let is_angle = |one: &Argument| one.powers(catalogue) == Dimension::Angle.powers();
        Ok(Ratio {
            angles: [is_angle(&first), is_angle(&second)],
            quantities: [first, second],
        })
    }
}

/// The name in `d(name)`, and what stands behind.
fn differential(text: &str) -> Option<(&str, &str)> {
    let inner = text.trim_start().strip_prefix('d')?.trim_start();
    let inner = inner.strip_prefix('(')?.trim_start();
    let (name, rest) = match inner.strip_prefix('\'') {
        Some(quoted) => {
            let (name, rest) = quoted.split_once('\'')?;
            (name, rest.trim_start().strip_prefix(')')?)
        }
        None => inner.split_once(')')?,
    };
    Some((name.trim(), rest))
}

/// What moves and is called so.
fn quantity(name: &str, catalogue: &Catalogue) -> Result<Argument, Complaint> {
    let said = |message: String| Complaint::new("", message);
    match catalogue.argument(name) {
        Some(Argument::Time) => {
            let message = "time is nothing that the mechanism moves".to_owned();
            Err(said(message).hint("what changes by time has a column of its rate, as slider.vx"))
        }
        Some(Argument::State(_)) => {
            let message = format!("{name} is a state, which the mechanism does not move");
            Err(said(message).hint("as in d(slider.x) or d(force.shock.length)"))
        }
        Some(found) if found.order() == Order::Rate => {
            let message = format!("{name} is a rate, and d( ) wants what changes");
            Err(said(message).hint("as in d(slider.x) or d(force.shock.length)"))
        }
        Some(found) => Ok(found),
        None => {
            let message = format!("nothing that moves is called {:?}", excerpt(name));
            let names = catalogue.arguments();
            let is_value = |name: &&String| {
                let found = catalogue.argument(name);
                found.is_some_and(|one| match one {
                    Argument::Time | Argument::State(_) => false,
                    one => one.order() == Order::Value,
                })
            };
            let values = names.iter().filter(is_value).map(String::as_str);
            Err(match suggest::nearest(name, values) {
                Some(near) => said(message).hint(format!("did you mean {near:?}?")),
                None => said(message).hint(
                    "as in crank.angle, rod.B.y, joint.guide.slide, force.shock.length or driver.motor",
                ),
            })
        }
    }
}
