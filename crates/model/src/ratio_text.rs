//! The text of an output.
//!
//! ```text
//! ratio  = "d(" name ")" "/" "d(" name ")"     name as formulas have it, or in single quotes
//! centre = "centre(" body "," body ")." ("x" | "y")
//! ```

use crate::GROUND;
use crate::dimension::Dimension;
use crate::error::Complaint;
use crate::formula::{Argument, Coordinate, Order};
use crate::node::excerpt;
use crate::ratio::{Centre, OutputText, Ratio};
use crate::response::Catalogue;
use crate::suggest;

/// What an output looks like.
const EXAMPLE: &str = "as in d(axle.y)/d(force.shock.length)";

impl OutputText {
    /// Reads the text of an output.
    ///
    /// # Errors
    /// What is wrong with it, at no path.
    pub fn read(text: &str, catalogue: &Catalogue) -> Result<Self, Complaint> {
        match text.trim_start().strip_prefix("centre") {
            Some(rest) => centre(rest, catalogue).map(OutputText::Centre),
            None => Ratio::read(text, catalogue).map(OutputText::Ratio),
        }
    }
}

/// What stands behind `centre`.
fn centre(text: &str, catalogue: &Catalogue) -> Result<Centre, Complaint> {
    let malformed = || {
        let said = Complaint::new("", "this is no coordinate of an instant centre");
        said.hint("as in centre(coupler, ground).x")
    };
    let inside = text.trim_start().strip_prefix('(').ok_or_else(malformed)?;
    let (inside, word) = inside.rsplit_once(')').ok_or_else(malformed)?;
    let (first, second) = inside.split_once(',').ok_or_else(malformed)?;
    let coordinate = match word.trim().strip_prefix('.').map(str::trim_start) {
        Some("x") => Coordinate::X,
        Some("y") => Coordinate::Y,
        _ => return Err(malformed()),
    };
    let bodies = [first, second].map(|name| name.trim().trim_matches('\'').to_owned());
    for name in &bodies {
        if name != GROUND && !catalogue.bodies.contains(name) {
            let said = Complaint::new("", format!("there is no body {:?}", excerpt(name)));
            let known = catalogue.bodies.iter().map(String::as_str).chain([GROUND]);
            return Err(match suggest::nearest(name, known) {
                Some(near) => said.hint(format!("did you mean {near:?}?")),
                None => said,
            });
        }
    }
    if bodies[0] == bodies[1] {
        let said = Complaint::new("", format!("both are {:?}", bodies[0]));
        return Err(said.hint("a body turns about another one, as in centre(coupler, ground).x"));
    }
    Ok(Centre { bodies, coordinate })
}

impl Ratio {
    /// Reads a ratio.
    ///
    /// # Errors
    /// What is wrong with it, at no path.
    fn read(text: &str, catalogue: &Catalogue) -> Result<Ratio, Complaint> {
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
        Some(Argument::Input(_) | Argument::State(_)) => {
            let kind = if name.starts_with("input.") {
                "an input"
            } else {
                "a state"
            };
            let message = format!("{name} is {kind}, which the mechanism does not move");
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
                    Argument::Time | Argument::Input(_) | Argument::State(_) => false,
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
