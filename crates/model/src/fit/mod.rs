//! Fits of a hole and a shaft by the ISO code system: `20 H7/g6`.
//!
//! ```text
//! hole    D … H      EI = −es of the shaft's letter, ES = EI + IT
//!         JS         ±IT/2
//!         K M N P    ES = −ei of the shaft's letter (+ Δ), EI = ES − IT,   Δ = IT(n) − IT(n − 1)
//! shaft   a … h      es from the table, ei = es − IT
//!         js         ±IT/2
//!         k m n p    ei from the table, es = ei + IT
//! ```
//!
//! Source: ISO 286-1:2010, tables 1 to 5; deviations in µm, nominal sizes up to 500 mm.

mod table;

use crate::error::Complaint;
use table::{DELTAS_TO, Deviation, Sizes};

/// Largest nominal size \[mm\].
const LARGEST: f64 = 500.0;
/// Size up to which fields far from nominal, and coarse grades, are not to be used \[mm\].
const SMALL: f64 = 1.0;
/// Grades that are not to be used for small sizes.
const COARSE: u32 = 14;
/// The coarsest grade.
const COARSEST: u32 = 18;
/// Micrometres of a diameter per metre of a radius.
const DIAMETER: f64 = 2e6;

/// A fit: the limits of a hole and of a shaft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Nominal diameter \[mm\].
    pub nominal: f64,
    /// Lower and upper deviation of the hole's diameter \[µm\].
    pub hole: [f64; 2],
    /// Lower and upper deviation of the shaft's diameter \[µm\].
    pub shaft: [f64; 2],
}

/// A class as written, `H7`.
struct Class<'t> {
    text: &'t str,
    letters: &'t str,
    grade: u32,
}

impl Fit {
    /// Reads a fit such as `20 H7/g6`.
    ///
    /// # Errors
    /// It is no fit, or one that the tables do not have; without a path.
    ///
    /// # Examples
    /// ```
    /// let fit = linkdyn_model::Fit::parse("20 H7/g6").unwrap();
    /// assert_eq!((fit.hole, fit.shaft), ([0.0, 21.0], [-20.0, -7.0]));
    /// ```
    pub fn parse(text: &str) -> Result<Fit, Complaint> {
        let form = || {
            refused(
                "this is no fit",
                "as in \"20 H7/g6\": nominal diameter in mm, hole, shaft",
            )
        };
        let text = text.trim().trim_start_matches(['⌀', 'Ø', 'ø']).trim_start();
        let end = text
            .find(|c: char| !c.is_ascii_digit() && c != '.')
            .unwrap_or(0);
        let nominal: f64 = text[..end].parse().map_err(|_| form())?;
        let rest = text[end..].trim_start();
        let rest = rest.strip_prefix("mm").unwrap_or(rest);
        let (hole, shaft) = rest.split_once('/').ok_or_else(form)?;
        let (hole, shaft) = (
            class(hole).ok_or_else(form)?,
            class(shaft).ok_or_else(form)?,
        );
        if !(nominal > 0.0 && nominal <= LARGEST) {
            let message = format!(
                "the tables of fits have diameters up to {LARGEST} mm, this is {nominal} mm"
            );
            return Err(refused(&message, "give the clearance as \"radius\""));
        }
        let is_hole = |class: &Class| class.letters.chars().all(|c| c.is_ascii_uppercase());
        let is_shaft = |class: &Class| class.letters.chars().all(|c| c.is_ascii_lowercase());
        if is_shaft(&hole) && is_hole(&shaft) {
            let hint = format!("write \"{nominal} {}/{}\"", shaft.text, hole.text);
            return Err(refused(
                "the hole comes first, with a capital letter",
                &hint,
            ));
        }
        if !is_hole(&hole) || !is_shaft(&shaft) {
            return Err(refused(
                "a hole has a capital letter, a shaft a small one",
                "as in \"20 H7/g6\"",
            ));
        }
        let sizes = Sizes::of(nominal);
        Ok(Fit {
            nominal,
            hole: limits(sizes, nominal, &hole, true)?,
            shaft: limits(sizes, nominal, &shaft, false)?,
        })
    }

    /// Least and greatest clearance of the diameters \[µm\]; below zero where the shaft is too large.
    pub fn clearance(&self) -> [f64; 2] {
        [self.hole[0] - self.shaft[1], self.hole[1] - self.shaft[0]]
    }

    /// Least and greatest radial clearance \[m\].
    ///
    /// # Errors
    /// A fit that can be tight, with its numbers.
    pub fn radial(&self) -> Result<[f64; 2], Complaint> {
        let [least, most] = self.clearance();
        if least < 0.0 {
            let span =
                |[lower, upper]: [f64; 2]| format!("{} to {} µm", signed(lower), signed(upper));
            let message = format!(
                "this fit can be tight: hole {}, shaft {}, clearance {}",
                span(self.hole),
                span(self.shaft),
                span([least, most])
            );
            return Err(refused(
                &message,
                "a pin that turns needs a clearance, as in \"20 H7/g6\"",
            ));
        }
        Ok([least / DIAMETER, most / DIAMETER])
    }
}

fn refused(message: &str, hint: &str) -> Complaint {
    Complaint::new("", message).hint(hint)
}

/// A deviation with its sign.
fn signed(deviation: f64) -> String {
    if deviation > 0.0 {
        format!("+{deviation}")
    } else {
        format!("{}", deviation + 0.0)
    }
}

/// Letters and grade.
fn class(text: &str) -> Option<Class<'_>> {
    let text = text.trim();
    let end = text.find(|c: char| !c.is_ascii_alphabetic())?;
    let (letters, grade) = text.split_at(end);
    let digits = !letters.is_empty() && grade.chars().all(|c| c.is_ascii_digit());
    let grade = grade.parse().ok().filter(|_| digits && grade.len() <= 3)?;
    Some(Class {
        text,
        letters,
        grade,
    })
}

/// Lower and upper deviation of a class.
fn limits(sizes: Sizes, nominal: f64, class: &Class, is_hole: bool) -> Result<[f64; 2], Complaint> {
    let Class {
        text,
        letters,
        grade,
    } = class;
    let grade = *grade;
    let Some(width) = sizes
        .grade(grade)
        .filter(|_| nominal > SMALL || grade < COARSE)
    else {
        let most = if nominal > SMALL {
            COARSEST
        } else {
            COARSE - 1
        };
        let message = format!("there is no grade {grade} of {text:?} at {nominal} mm");
        return Err(refused(&message, &format!("grades go from 1 to {most}")));
    };
    let unknown = || {
        let message = format!("no table here has {text:?}");
        let known = Deviation::ALL.map(|(name, _)| {
            if is_hole {
                name.to_uppercase()
            } else {
                name.to_owned()
            }
        });
        refused(&message, &format!("the letters: {}", known.join(", ")))
    };
    let name = letters.to_lowercase();
    let known = Deviation::ALL.iter().find(|(known, _)| *known == name);
    let deviation = known.ok_or_else(unknown)?.1;
    let [lower, upper] = match deviation {
        Deviation::Middle => [-width / 2.0, width / 2.0],
        Deviation::Below if nominal <= SMALL && matches!(name.as_str(), "a" | "b") => {
            let message = format!("{text:?} is not to be used up to {SMALL} mm");
            return Err(refused(&message, "take a letter from c on"));
        }
        Deviation::Below => {
            let gap = sizes.distance(&name);
            if is_hole {
                [gap, gap + width]
            } else {
                [-gap - width, -gap]
            }
        }
        Deviation::Above if is_hole => {
            let upper = tight_hole(sizes, &name, sizes.distance(&name), grade);
            let upper = upper.ok_or_else(|| {
                refused(
                    &format!("there is no {text:?} at {nominal} mm"),
                    &format!("{letters} goes up to grade {DELTAS_TO}"),
                )
            })?;
            [upper - width, upper]
        }
        Deviation::Above => {
            // k has its deviation in fine grades alone
            let lower = if name == "k" && !(4..=7).contains(&grade) {
                0.0
            } else {
                sizes.distance(&name)
            };
            [lower, lower + width]
        }
    };
    // no zero with a sign
    Ok([lower + 0.0, upper + 0.0])
}

/// Upper deviation of a hole from K on: the shaft's with the other sign, and Δ in the finer grades.
fn tight_hole(sizes: Sizes, name: &str, column: f64, grade: u32) -> Option<f64> {
    let finer = if name == "p" {
        grade < DELTAS_TO
    } else {
        grade <= DELTAS_TO
    };
    let delta = || {
        sizes
            .grade(grade)
            .zip(sizes.grade(grade.checked_sub(1)?))
            .map(|(own, finer)| own - finer)
    };
    let delta = if sizes.is_smallest() || grade < 3 {
        Some(0.0)
    } else {
        delta()
    };
    match (name, finer) {
        // an exception of the standard
        ("m", true) if sizes.is_m6_exception(grade) => Some(-9.0),
        (_, true) => Some(-column + delta?),
        ("k", false) => sizes.is_smallest().then_some(0.0),
        ("n", false) => Some(if sizes.is_smallest() { -column } else { 0.0 }),
        (_, false) => Some(-column),
    }
}

#[cfg(test)]
mod tests;
