//! Ready parts: their numbers fit together.

use super::Rules;
use super::timed::not_free;
use crate::ForceKind;

/// What words alone don't say of gas springs, cylinders and motors.
pub(super) fn part(rules: &mut Rules<'_>, kind: &ForceKind, path: &str) {
    let known = |key: &str| !rules.holes.has(&format!("{path}.{key}"));
    let said = |length: f64| rules.model.display.length(length);
    let fault = match kind {
        ForceKind::GasSpring {
            extended, stroke, ..
        } if stroke >= extended && known("stroke") && known("extended") => Some((
            "stroke",
            format!(
                "a stroke of {} leaves no length of {} at full extension",
                said(*stroke),
                said(*extended)
            ),
            "\"extended\" is the distance of its points, with the tube: more than two strokes as a rule",
        )),
        ForceKind::Cylinder { bore, rod, .. } if rod >= bore && known("rod") && known("bore") => {
            Some((
                "rod",
                format!(
                    "a rod of {} is no thinner than the bore of {}",
                    said(*rod),
                    said(*bore)
                ),
                "both are diameters",
            ))
        }
        ForceKind::DcMotor { inductance, .. } if *inductance > 0.0 => {
            let analysis = rules.model.analysis.as_ref();
            let why = analysis.and_then(|analysis| not_free(analysis.kind));
            why.map(|why| {
                (
                    "inductance",
                    format!("the current is integrated in a free motion, and {why}"),
                    "leave it out: the current is then the steady one, or take \"dynamics\"",
                )
            })
        }
        _ => None,
    };
    if let Some((key, message, hint)) = fault {
        rules.complain(format!("{path}.{key}"), message, hint);
    }
}
