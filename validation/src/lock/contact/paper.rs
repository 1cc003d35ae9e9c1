//! The paper's claims C2 to C6 with contact in the clearances, tried at every tolerance.

use std::fmt::Write;

use super::super::bounds::{ABRUPT, CLEAR, NEAR};
use super::super::claims::{OPEN_STEP, of_deviations};
use super::super::document::broken;
use super::super::forces::ForceNear;
use super::super::judged::{Judged, Reproduced};
use super::super::models::RADII;
use super::convergence::{self, Convergence};
use super::strokes::{Strokes, TOLERANCES};
use crate::{CaseError, Claim};

/// Reasons why numbers and claims of the paper are not reproduced.
pub const NO_CONTACT: &str = "The paper's numbers are those of massless links; for contact in the clearances it has no data.";
const IMPACTS: &str = "The paper's claim is one about massless links; with contact impacts decide, and after the first ones no \
     tolerance gives the same contacts.";

/// C2 to C6 with contact, at every tolerance; C4 to C6 also on the part of the stroke that is clear of the change point.
///
/// # Errors
/// When a stroke has no forces.
pub fn claims(strokes: &Strokes, convergence: &Convergence) -> Result<Vec<Claim>, CaseError> {
    let mut by_claim: Vec<Vec<Judged>> = vec![Vec::new(); 5];
    for (index, deviations) in convergence.whole.iter().enumerate() {
        let forces = strokes
            .at(index)
            .into_iter()
            .map(ForceNear::of)
            .collect::<Result<Vec<_>, _>>()?;
        let judged = [abrupt(&forces)]
            .into_iter()
            .chain(of_deviations(deviations));
        for (all, judged) in by_claim.iter_mut().zip(judged) {
            all.push(judged);
        }
    }
    let mut claims = by_claim
        .into_iter()
        .map(joined)
        .collect::<Result<Vec<_>, _>>()?;
    let clear = of_deviations(
        convergence
            .clear
            .last()
            .ok_or_else(|| broken("no tolerance"))?,
    );
    for (claim, clear) in claims.iter_mut().skip(2).zip(&clear[1..]) {
        let _ = write!(
            claim.ours,
            "; up to {}° alone: {}",
            convergence::CLEAR,
            clear.reproduced.word()
        );
    }
    Ok(claims)
}

/// C2: whether F12 changes abruptly near −40° where clearances let it.
fn abrupt(forces: &[ForceNear]) -> Judged {
    let held = forces.iter().filter(|near| near.abrupt()).count();
    let figures: Vec<String> = forces
        .iter()
        .zip(RADII)
        .map(|(near, e)| {
            format!(
                "e = {e} um: change {:.1}, turn {:.1} of the median",
                near.change, near.turn_near
            )
        })
        .collect();
    Judged {
        reproduced: Reproduced::of(held, forces.len()),
        what: "C2: F12 changes abruptly near theta6 = -40 deg".into(),
        reference: "abrupt change".into(),
        rule: format!(
            "change of F12 per degree, or turn of its direction, within {NEAR}° of -40° is at least {ABRUPT} times the median \
             over -50…{CLEAR}°, at both clearances and every tolerance"
        ),
        figures: figures.join("; "),
        reason: IMPACTS,
    }
}

/// The verdict that holds at every tolerance: reproduced at all of them, not at all of them, else partly; figures of the
/// finest.
fn joined(all: Vec<Judged>) -> Result<Claim, CaseError> {
    let words: Vec<&str> = all.iter().map(|judged| judged.reproduced.word()).collect();
    let is = |wanted: Reproduced| all.iter().all(|judged| judged.reproduced == wanted);
    let reproduced = if is(Reproduced::Yes) {
        Reproduced::Yes
    } else if is(Reproduced::No) {
        Reproduced::No
    } else {
        Reproduced::Partly
    };
    let told = if words.iter().all(|word| *word == words[0]) {
        "the same verdict at all tolerances".to_string()
    } else {
        TOLERANCES
            .iter()
            .zip(&words)
            .map(|(rtol, word)| format!("{word} at {rtol:e}"))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let finest = all
        .into_iter()
        .next_back()
        .ok_or_else(|| broken("no tolerance"))?;
    let (figures, what) = (
        format!("{}; {told}", finest.figures),
        format!("{}, contact", finest.what),
    );
    Ok(Judged {
        reproduced,
        figures,
        what,
        reason: match finest.reason {
            OPEN_STEP => IMPACTS,
            reason => reason,
        },
        ..finest
    }
    .claim())
}
