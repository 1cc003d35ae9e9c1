//! Five points of a straight line on the path of a coupler: a published design of a published problem.
//!
//! Problem, design and source stand in `validation/path-synthesis/SOURCE.md`. That `linkdyn optimise` finds the design is held in
//! `tests/evidence/paths.rs`.

use super::{CaseError, CaseReport, Claim, Setting, Verdict};
use linkdyn_engine::analysis;
use linkdyn_output::Status;

/// A line about the case.
pub const ABOUT: &str =
    "Morgan and Wampler's five points of a line: the published four-bar passes them";

const MODEL: &str = include_str!("../path-synthesis/model.json");
/// Pins of both cranks seen from the coupler point, as printed \[m\].
const DESIGN: [(&str, f64); 4] = [
    ("x1", -0.0877960434509),
    ("x2", -0.851386907516),
    ("y1", 0.235837391307),
    ("y2", -1.41899202704),
];
/// The points, and the angles of the coupler there as printed [m, m, rad].
const POINTS: [[f64; 3]; 5] = [
    [0.5, 1.06, 0.0],
    [-0.83, -0.27, 1.44734213756],
    [-0.34, 0.22, 0.928413708131],
    [-0.13, 0.43, 0.751699211109],
    [0.22, 0.78, 0.387116282208],
];
/// What half the last printed digit, of an angle 5e-12, makes of the point at such distances \[m\].
const PRINTED: f64 = 2e-11;

/// Runs the case.
///
/// # Errors
/// When it can't be run.
pub fn run(setting: &Setting) -> Result<CaseReport, CaseError> {
    let broken = |said: &dyn std::fmt::Debug| CaseError::Broken(format!("{said:?}"));
    let mut sets: Vec<String> = DESIGN
        .iter()
        .map(|(name, value)| format!("parameters.{name}={value} m"))
        .collect();
    for (index, [.., angle]) in POINTS.iter().enumerate() {
        for axis in ["x", "y"] {
            let place = format!("at(coupler.{axis}, coupler.angle = {angle} rad)");
            sets.push(format!("responses.{axis} of {index}={place}"));
        }
    }
    let loaded = linkdyn_model::load(MODEL.as_bytes(), &sets).map_err(|said| broken(&said))?;
    let outcome = analysis::run(&loaded.model, &setting.control).map_err(|said| broken(&said))?;
    if outcome.report.status == Status::Interrupted {
        return Err(CaseError::Interrupted);
    }
    let mut claims = Vec::new();
    for (answers, [x, y, _]) in outcome.responses.chunks(2).zip(POINTS) {
        let places = answers.iter().map(|answer| answer.value.ok_or(answer));
        let places: Vec<f64> = places
            .collect::<Result<_, _>>()
            .map_err(|said| broken(&said))?;
        let off = (places[0] - x).hypot(places[1] - y);
        claims.push(Claim {
            what: format!("the path passes ({x}, {y}) m"),
            reference: format!("({x}, {y})"),
            ours: format!("({}, {})", places[0], places[1]),
            difference: format!("{off:.1e}"),
            verdict: match off <= PRINTED {
                true => Verdict::Agrees,
                false => Verdict::Fault,
            },
        });
    }
    Ok(CaseReport {
        text: String::new(),
        claims,
    })
}
