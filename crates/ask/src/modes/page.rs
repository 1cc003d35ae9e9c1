//! The page in which the shapes of modes move.

use std::f64::consts::TAU;

use linkdyn_engine::analysis::Mode;
use linkdyn_picture::Fault;
use linkdyn_picture::poses::Pose;
use linkdyn_picture::shape::Body;
use linkdyn_picture::swing::{Course, SECONDS, Swing, page};

use super::SmallMotions;
use super::text::DIGITS;
use crate::shape::with_profiles;
use crate::text::number;

/// The page; `None` if there are no modes.
pub fn html(motions: &SmallMotions) -> Option<Result<String, Fault>> {
    let found = &motions.found;
    if found.modes.is_empty() {
        return None;
    }
    let ground: Pose = [0.0; 3];
    let bodies = found.bodies.iter().map(|(_, place)| *place);
    let rest: Vec<Pose> = std::iter::once(ground).chain(bodies).collect();
    let modes = found.modes.iter().enumerate();
    let swings: Vec<Swing> = modes.map(|(k, mode)| swing(k, mode)).collect();
    let facts = [
        format!("Small motions about the {}.", motions.about()),
        format!(
            "The amplitudes are fitted to the drawing. Each motion takes {SECONDS} s here, whatever its frequency."
        ),
    ];
    let mut shape = with_profiles(motions.file.model());
    for Body { name, bending, .. } in &mut shape.bodies {
        let Some(bending) = bending else { continue };
        let prefix = format!("{name}.q");
        // Two amplitudes are x and y of what is listed as a body.
        let pairs = found.bodies.iter().zip(1..);
        let pairs = pairs.filter(|((name, _), _)| name.starts_with(&prefix));
        let amplitudes = pairs.flat_map(|(_, pose)| [[pose, 0], [pose, 1]]);
        let count = bending.moves.first().map_or(0, Vec::len);
        bending.amplitudes = amplitudes.take(count).collect();
    }
    let title = format!("{}: modes", motions.file.name());
    Some(page(&title, &facts, (&shape, &rest), &swings).map(|(html, _)| html))
}

/// A mode and what is said of it.
fn swing(k: usize, mode: &Mode) -> Swing {
    let [re, im] = mode.eigenvalue;
    let [hertz, omega] = [mode.frequency() / TAU, mode.frequency()];
    let time = |rate: f64| number(1.0 / rate.abs(), DIGITS.min(4));
    let (course, words) = if im != 0.0 {
        let damping = mode.damping_ratio().unwrap_or(0.0);
        let mut words = vec![
            format!("{} Hz", number(hertz, DIGITS)),
            format!(
                "ω₀ {} rad/s, damping ratio ζ {}",
                number(omega, DIGITS),
                number(damping, DIGITS)
            ),
        ];
        if re > 0.0 {
            words.push(format!("unstable: it grows by e in {} s", time(re)));
        }
        (Course::Swings, words)
    } else if re < 0.0 {
        let words = format!("does not swing: it fades by e in {} s", time(re));
        (Course::Fades, vec![words])
    } else if re > 0.0 {
        let words = format!("unstable: it leaves, and grows by e in {} s", time(re));
        (Course::Leaves, vec![words])
    } else {
        (
            Course::Swings,
            vec!["moves freely: nothing pulls it back (0 Hz)".into()],
        )
    };
    let title = format!("Mode {}: {}", k + 1, words[0]);
    let texts = std::iter::once(title).chain(words.into_iter().skip(1));
    Swing {
        course,
        shape: mode.shape.clone(),
        texts: texts.collect(),
    }
}
