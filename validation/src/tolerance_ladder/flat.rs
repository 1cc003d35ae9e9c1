//! A02 at its flat positions, where linkages of parallel cranks could fold over: its steps there, and 200 s past them.

use serde_json::json;

use super::problems::{Measure, columns, error, load, model_of, simulate, values};
use crate::table::Table;
use crate::{CaseError, Claim, Setting, Verdict};
use linkdyn_engine::analysis::assembly;
use linkdyn_engine::integrate::{Limits, Method, Stepper, Tolerance};
use linkdyn_engine::mechanism::reduced::Reduced;
use linkdyn_engine::system::compile::compile;
use linkdyn_engine::system::{Inputs, System};
use linkdyn_model::AnalysisKind;

/// Steps over flat positions over the median step [-].
const SHORTEST: f64 = 0.1;
/// Tolerance of the runs of A02 with N = 2 and 40 [-]; the drift that 200 s may bring at it [-]; the angle that a coupler may
/// have \[rad\].
pub const FLAT: f64 = 1e-8;
const FLAT_DRIFT: f64 = 1e-6;
const TURNED: f64 = 1e-9;
/// Newton's step, by rtol, below which equations are kept, as in `analysis::dynamics`.
const LAG: f64 = 1e-2;

/// (c): the shortest step over a flat position of A02, over the median of all steps, in 20 s.
pub fn flat_steps(loops: usize, case: &str) -> Result<Claim, CaseError> {
    let broken = |what: &dyn std::fmt::Debug| {
        CaseError::Broken(format!("steps of A02, N = {loops}: {what:?}"))
    };
    let model = load(&model_of(case)?)?;
    let system = compile(&model, AnalysisKind::Dynamics).map_err(|said| broken(&said))?;
    let inputs = Inputs::at_time(&system, 0.0);
    let start = assembly::assemble(&system, &inputs).map_err(|stop| broken(&stop))?;
    let v = assembly::velocities(&system, &start.q, &inputs).map_err(|stop| broken(&stop))?;
    let mut reduced = Reduced::new(&system, &start.all.free_columns, (&start.q, &v, 0.0), None)
        .map_err(|failure| broken(&failure))?;
    reduced.set_lag(LAG * FLAT);
    let angle = angle_column(&system, "rocker0").ok_or_else(|| broken(&"no rocker0"))?;
    let height = |reduced: &Reduced| reduced.position()[angle].sin();
    let begin =
        |reduced: &mut Reduced, t: f64, step: Option<f64>| -> Result<Box<dyn Stepper>, CaseError> {
            let limits = Limits {
                initial_step: step,
                ..Limits::default()
            };
            let mut y = vec![0.0; 2 * reduced.freedom()];
            let mut stepper = Method::Dop853.stepper(
                Tolerance {
                    rtol: FLAT,
                    atol: vec![FLAT; y.len()],
                    cap: Vec::new(),
                },
                limits,
            );
            reduced.state(&mut y);
            stepper
                .start(reduced, t, &y, 20.0)
                .map_err(|failure| broken(&failure))?;
            Ok(stepper)
        };
    let mut stepper = begin(&mut reduced, 0.0, None)?;
    let (mut steps, mut flat, mut before) = (Vec::new(), Vec::new(), height(&reduced));
    while stepper.t() < 20.0 {
        if reduced
            .choose_better()
            .map_err(|failure| broken(&failure))?
        {
            let step = stepper.t() - stepper.previous();
            stepper = begin(&mut reduced, stepper.t(), (step > 0.0).then_some(step))?;
        }
        stepper
            .step(&mut reduced, 20.0)
            .map_err(|failure| broken(&failure))?;
        let (step, now) = (stepper.t() - stepper.previous(), height(&reduced));
        steps.push(step);
        if (now > 0.0) != (before > 0.0) {
            flat.push(step);
        }
        before = now;
    }
    steps.sort_by(f64::total_cmp);
    let median = steps.get(steps.len() / 2).copied().unwrap_or(f64::NAN);
    let shortest = flat.iter().copied().fold(f64::INFINITY, f64::min);
    let ratio = shortest / median;
    Ok(Claim {
        what: format!(
            "A02, N = {loops}: shortest step over a flat position by the median step, 20 s at {FLAT:e} [-]"
        ),
        reference: format!("at least {SHORTEST}"),
        ours: format!(
            "{ratio:.2}: {shortest:.4} s of {} such steps, median {median:.4} s of {} steps",
            flat.len(),
            steps.len()
        ),
        difference: format!("{:.2}", ratio - SHORTEST),
        verdict: if !flat.is_empty() && ratio >= SHORTEST {
            Verdict::Agrees
        } else {
            Verdict::Fault
        },
    })
}

/// Column of a body's angle.
fn angle_column(system: &System, name: &str) -> Option<usize> {
    let body = system.bodies.iter().position(|body| body.name == name)?;
    Some(system.layout.moving(body).theta())
}

/// (c): 200 s of A02, past some two hundred flat positions.
///
/// The distance from the closed form \[m\], and claims.
pub fn long_run(
    loops: usize,
    case: &str,
    long: &Table,
    setting: &Setting,
) -> Result<(f64, [Claim; 2]), CaseError> {
    let solver = json!({ "method": "dop853", "rtol": FLAT, "atol": FLAT });
    let outcome = simulate(&model_of(case)?, 200.0, 101, &solver, setting)?;
    let exact = columns(
        long,
        &[&format!("A02-{loops}.x[m]"), &format!("A02-{loops}.y[m]")],
    )?;
    let far = error(
        &outcome,
        &["rocker0.B.x[m]", "rocker0.B.y[m]"],
        &exact,
        Measure::Largest,
    )?;
    let drift = outcome.report.quality.energy_drift.unwrap_or(f64::INFINITY);
    let mut turned = 0.0;
    for coupler in 0..loops {
        turned = values(&outcome, &format!("coupler{coupler}.angle"))?
            .into_iter()
            .fold(turned, |most: f64, angle| {
                if angle.is_nan() {
                    f64::INFINITY
                } else {
                    most.max(angle.abs())
                }
            });
    }
    let claim = |what: &str, value: f64, most: f64| Claim {
        what: format!("A02, N = {loops}, 200 s at {FLAT:e}: {what}"),
        reference: format!("at most {most:e}"),
        ours: format!("{value:.1e}"),
        difference: format!("{:.1e}", value - most),
        verdict: if value <= most {
            Verdict::Agrees
        } else {
            Verdict::Fault
        },
    };
    let claims = [
        claim("energy drift [-]", drift, FLAT_DRIFT),
        claim("largest angle of a coupler [rad]", turned, TURNED),
    ];
    Ok((far, claims))
}
