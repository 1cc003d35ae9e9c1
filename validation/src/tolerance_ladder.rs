//! Errors of forward dynamics over the tolerance asked for, beside SciPy's DOP853 on minimal coordinates; and the steps at
//! flat positions, where linkages of parallel cranks could fold over.
//!
//! References and what is measured stand in `validation/tolerance-ladder/SOURCE.md`.

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::table::Table;
use super::{CaseError, CaseReport, Claim, Setting, Verdict};
use linkdyn_engine::analysis::{self, Outcome, assembly};
use linkdyn_engine::integrate::{Limits, Method, Stepper, Tolerance};
use linkdyn_engine::mechanism::reduced::Reduced;
use linkdyn_engine::system::Inputs;
use linkdyn_engine::system::compile::compile;
use linkdyn_model::{self, AnalysisKind, Checked};
use linkdyn_output::Status;

/// A line about the case.
pub const ABOUT: &str = "errors of forward dynamics at rtol of 1e-5 to 1e-10 beside SciPy's DOP853; steps at flat positions";

const SCIPY: &str = include_str!("../tolerance-ladder/scipy.csv");
const REFERENCE: &str = include_str!("../tolerance-ladder/reference.csv");
const LONG_SCIPY: &str = include_str!("../tolerance-ladder/long-scipy.csv");
const LONG: &str = include_str!("../tolerance-ladder/long.csv");
const PENDULUM: &str = include_str!("../a01-pendulum/case.json");
const FOUR_BARS: &str = include_str!("../a02-four-bars-2/case.json");
const FORTY: &str = include_str!("../a02-four-bars-40/case.json");
const SQUEEZER: &str = include_str!("../andrews/case.json");
const SQUEEZER_ROWS: &str = include_str!("../andrews/reference.csv");
const CART: &str = include_str!("../cart-pole/case.json");
const CART_ROWS: &str = include_str!("../cart-pole/reference.csv");

/// Slope of log error over log rtol [-].
const SLOPES: [f64; 2] = [0.8, 1.2];
/// Our error over SciPy's at the same tolerance [-].
const WORSE: f64 = 3.0;
/// Steps over flat positions over the median step [-].
const SHORTEST: f64 = 0.1;
/// Tolerance of the runs of A02 with N = 2 and 40 [-]; the drift that 200 s may bring at it [-]; the angle that a coupler may
/// have \[rad\].
const FLAT: f64 = 1e-8;
const FLAT_DRIFT: f64 = 1e-6;
const TURNED: f64 = 1e-9;
/// Newton's step, by rtol, below which equations are kept, as in `analysis::dynamics`.
const LAG: f64 = 1e-2;

/// How an error is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Measure {
    /// The largest distance (of one column or two) over all instants.
    Largest,
    /// The root of the mean square over all values.
    Rms,
}

/// A rung's problem.
struct Problem {
    name: &'static str,
    model: Value,
    end: f64,
    outputs: usize,
    /// Of the model, then of the reference.
    columns: Vec<&'static str>,
    reference: Vec<Vec<f64>>,
    measure: Measure,
}

/// Runs the case.
///
/// # Errors
/// When it can't be run.
pub fn run(setting: &Setting) -> Result<CaseReport, CaseError> {
    let mut report = CaseReport::default();
    let scipy = table(SCIPY)?;
    let tolerances = column(&scipy, "tolerance[-]")?;
    for problem in problems()? {
        let theirs = column(&scipy, &format!("{}.error[-]", problem.name))?;
        let evaluations = column(&scipy, &format!("{}.evaluations[-]", problem.name))?;
        let mut ours = Vec::new();
        let _ = writeln!(
            report.text,
            "{:10} rtol       ours    SciPy  ratio   evaluations of ours, SciPy",
            problem.name
        );
        for ((tolerance, theirs), evaluations) in tolerances.iter().zip(&theirs).zip(&evaluations) {
            let solver = json!({ "method": "dop853", "rtol": tolerance, "atol": tolerance });
            let outcome = simulate(
                &problem.model,
                problem.end,
                problem.outputs,
                &solver,
                setting,
            )?;
            let error = error(
                &outcome,
                &problem.columns,
                &problem.reference,
                problem.measure,
            )?;
            let _ = writeln!(
                report.text,
                "{:10} {tolerance:.0e} {error:10.1e} {theirs:8.1e} {:6.2} {:10} {evaluations:8}",
                "",
                error / theirs,
                outcome.report.statistics.evaluations
            );
            ours.push(error);
        }
        report
            .claims
            .push(slope_claim(problem.name, &tolerances, &ours, &theirs));
        let rungs: Vec<String> = tolerances
            .iter()
            .map(|tolerance| format!("{tolerance:.0e}"))
            .collect();
        report
            .claims
            .push(ratio_claim(problem.name, &rungs, &ours, &theirs));
    }
    let (long, theirs) = (table(LONG)?, column(&table(LONG_SCIPY)?, "error[m]")?);
    let mut ours = Vec::new();
    let _ = writeln!(report.text, "A02, 200 s    N       ours    SciPy  ratio");
    for ((loops, case), theirs) in [(2, FOUR_BARS), (40, FORTY)].into_iter().zip(&theirs) {
        report.claims.push(flat_steps(loops, case)?);
        let (far, claims) = long_run(loops, case, &long, setting)?;
        let _ = writeln!(
            report.text,
            "{loops:15} {far:10.1e} {theirs:8.1e} {:6.2}",
            far / theirs
        );
        ours.push(far);
        report.claims.extend(claims);
    }
    let names = ["N = 2", "N = 40"].map(String::from);
    report.claims.push(ratio_claim(
        &format!("A02, 200 s at {FLAT:e}"),
        &names,
        &ours,
        &theirs,
    ));
    Ok(report)
}

fn problems() -> Result<Vec<Problem>, CaseError> {
    let closed = table(REFERENCE)?;
    let (squeezer, cart) = (table(SQUEEZER_ROWS)?, table(CART_ROWS)?);
    Ok(vec![
        Problem {
            name: "A01",
            model: model_of(PENDULUM)?,
            end: 10.0,
            outputs: 101,
            columns: vec!["bob.B.x[m]", "bob.B.y[m]"],
            reference: columns(&closed, &["A01.x[m]", "A01.y[m]"])?,
            measure: Measure::Largest,
        },
        Problem {
            name: "A02-1",
            model: one_loop(model_of(FOUR_BARS)?),
            end: 10.0,
            outputs: 101,
            columns: vec!["rocker0.B.x[m]", "rocker0.B.y[m]"],
            reference: columns(&closed, &["A02-1.x[m]", "A02-1.y[m]"])?,
            measure: Measure::Largest,
        },
        Problem {
            name: "andrews",
            model: model_of(SQUEEZER)?,
            end: 0.03,
            outputs: 11,
            columns: vec!["OF.angle[rad]"],
            reference: columns(&squeezer, &["OF.angle[rad]"])?,
            measure: Measure::Largest,
        },
        Problem {
            name: "cart-pole",
            model: model_of(CART)?,
            end: 10.0,
            outputs: 201,
            columns: vec!["cart.x[m]", "pole.angle[rad]"],
            reference: columns(&cart, &["cart.x[m]", "pole.angle[rad]"])?,
            measure: Measure::Rms,
        },
    ])
}

/// The model in the words of a reference case.
fn model_of(case: &str) -> Result<Value, CaseError> {
    let mut words: Value =
        serde_json::from_str(case).map_err(|error| CaseError::Broken(error.to_string()))?;
    Ok(words["model"].take())
}

/// A02 with two loops without its second one.
fn one_loop(mut model: Value) -> Value {
    for (group, name) in [
        ("bodies", "rocker2"),
        ("bodies", "coupler1"),
        ("joints", "a2"),
        ("joints", "l1"),
        ("joints", "r1"),
    ] {
        model[group]
            .as_object_mut()
            .and_then(|group| group.shift_remove(name));
    }
    model
}

fn load(model: &Value) -> Result<Checked, CaseError> {
    let loaded = linkdyn_model::load(model.to_string().as_bytes(), &[])
        .map_err(|said| CaseError::Broken(format!("{said:?}")))?;
    Ok(loaded.model)
}

fn simulate(
    model: &Value,
    end: f64,
    outputs: usize,
    solver: &Value,
    setting: &Setting,
) -> Result<Outcome, CaseError> {
    let mut model = model.clone();
    model["analysis"] =
        json!({ "type": "dynamics", "end": end, "outputs": outputs, "solver": solver });
    let outcome = analysis::run(&load(&model)?, &setting.control)
        .map_err(|said| CaseError::Broken(format!("{said:?}")))?;
    match outcome.report.status {
        Status::Completed => Ok(outcome),
        Status::Interrupted => Err(CaseError::Interrupted),
        status => Err(CaseError::Broken(format!(
            "{}: {:?}",
            status.word(),
            outcome.report.message
        ))),
    }
}

fn table(text: &str) -> Result<Table, CaseError> {
    Table::parse(text).map_err(CaseError::Broken)
}

fn column(table: &Table, name: &str) -> Result<Vec<f64>, CaseError> {
    let index = table.columns.iter().position(|column| column == name);
    let index = index.ok_or_else(|| CaseError::Broken(format!("no column {name}")))?;
    Ok(table.rows.iter().map(|row| row[index]).collect())
}

fn columns(table: &Table, names: &[&str]) -> Result<Vec<Vec<f64>>, CaseError> {
    names.iter().map(|name| column(table, name)).collect()
}

/// Values of a column of the results, by `name[unit]`.
fn values(outcome: &Outcome, name: &str) -> Result<Vec<f64>, CaseError> {
    outcome
        .trajectory
        .values(name)
        .ok_or_else(|| CaseError::Broken(format!("the results have no column {name}")))
}

fn error(
    outcome: &Outcome,
    names: &[&str],
    exact: &[Vec<f64>],
    measure: Measure,
) -> Result<f64, CaseError> {
    let mut squares = vec![0.0; outcome.trajectory.len()];
    for (name, exact) in names.iter().zip(exact) {
        let ours = values(outcome, name)?;
        if exact.len() != ours.len() {
            return Err(CaseError::Broken(format!(
                "{name}: {} rows for {}",
                ours.len(),
                exact.len()
            )));
        }
        for (square, (a, b)) in squares.iter_mut().zip(ours.iter().zip(exact)) {
            *square += (a - b) * (a - b);
        }
    }
    Ok(match measure {
        Measure::Largest => squares.iter().copied().fold(0.0, f64::max).sqrt(),
        Measure::Rms => (squares.iter().sum::<f64>() / (squares.len() * names.len()) as f64).sqrt(),
    })
}

/// (a): errors are proportional to the tolerance; where SciPy's are not either, that is the method's, and a finding.
fn slope_claim(name: &str, tolerances: &[f64], ours: &[f64], theirs: &[f64]) -> Claim {
    let (slope, other) = (slope(tolerances, ours), slope(tolerances, theirs));
    let within = |slope: f64| (SLOPES[0]..=SLOPES[1]).contains(&slope);
    Claim {
        what: format!("{name}: slope of log error over log rtol, least squares [-]"),
        reference: format!("{} to {}", SLOPES[0], SLOPES[1]),
        ours: format!("{slope:.3} (SciPy {other:.3})"),
        difference: format!("{:.3}", slope - 1.0),
        verdict: match (within(slope), within(other)) {
            (true, _) => Verdict::Agrees,
            (false, false) => Verdict::Finding,
            (false, true) => Verdict::Fault,
        },
    }
}

/// Least squares of ln `errors` over ln `tolerances`.
fn slope(tolerances: &[f64], errors: &[f64]) -> f64 {
    let n = tolerances.len() as f64;
    let mean = |values: &[f64]| values.iter().map(|v| v.ln()).sum::<f64>() / n;
    let (x, y) = (mean(tolerances), mean(errors));
    let pairs = || {
        tolerances
            .iter()
            .zip(errors)
            .map(|(t, e)| (t.ln() - x, e.ln() - y))
    };
    pairs().map(|(t, e)| t * e).sum::<f64>() / pairs().map(|(t, _)| t * t).sum::<f64>()
}

/// (b): a rung beyond the bound is a finding as long as the geometric mean over all rungs is within, else a fault.
fn ratio_claim(name: &str, rungs: &[String], ours: &[f64], theirs: &[f64]) -> Claim {
    let ratios: Vec<f64> = ours.iter().zip(theirs).map(|(a, b)| a / b).collect();
    let mean = (ratios.iter().map(|ratio| ratio.ln()).sum::<f64>() / ratios.len() as f64).exp();
    let (mut worst, mut at) = (0.0, "");
    for (ratio, rung) in ratios.iter().zip(rungs) {
        if *ratio > worst {
            (worst, at) = (*ratio, rung);
        }
    }
    let verdict = match (mean <= WORSE, worst <= WORSE) {
        (true, true) => Verdict::Agrees,
        (true, false) => Verdict::Finding,
        (false, _) => Verdict::Fault,
    };
    Claim {
        what: format!(
            "{name}: error over SciPy's, at no rung more than {WORSE}; a fault where the geometric mean is [-]"
        ),
        reference: format!("at most {WORSE}"),
        ours: format!("{worst:.2} at {at}, mean {mean:.2}"),
        difference: format!("{:.2}", worst - WORSE),
        verdict,
    }
}

/// (c): the shortest step over a flat position of A02, over the median of all steps, in 20 s.
fn flat_steps(loops: usize, case: &str) -> Result<Claim, CaseError> {
    let broken = |what: &dyn std::fmt::Debug| {
        CaseError::Broken(format!("steps of A02, N = {loops}: {what:?}"))
    };
    let model = load(&model_of(case)?)?;
    let system = compile(&model, AnalysisKind::Dynamics).map_err(|said| broken(&said))?;
    let inputs = Inputs::at_time(&system, 0.0);
    let start = assembly::assemble(&system, &inputs).map_err(|stop| broken(&stop))?;
    let v = assembly::velocities(&system, &start.q, &inputs).map_err(|stop| broken(&stop))?;
    let mut reduced = Reduced::new(&system, &start.all.free_columns, &start.q, &v, 0.0)
        .map_err(|failure| broken(&failure))?;
    reduced.lag = LAG * FLAT;
    let rocker = system
        .bodies
        .iter()
        .position(|body| body.name == "rocker0")
        .ok_or_else(|| broken(&"no rocker0"))?;
    let height = |reduced: &Reduced| reduced.q[system.layout.moving(rocker).theta()].sin();
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
        if reduced.repin().map_err(|failure| broken(&failure))? {
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

/// (c): 200 s of A02, past some two hundred flat positions.
///
/// The distance from the closed form \[m\], and claims.
fn long_run(
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rung_is_a_finding_and_their_mean_a_fault() {
        let rungs = ["1e-5", "1e-6"].map(String::from);
        let verdict = |ours: [f64; 2]| ratio_claim("a", &rungs, &ours, &[1.0, 1.0]).verdict;
        assert_eq!(verdict([2.9, 1.0]), Verdict::Agrees);
        assert_eq!(verdict([3.1, 1.0]), Verdict::Finding);
        assert_eq!(verdict([3.1, 3.0]), Verdict::Fault);
    }

    #[test]
    fn the_slope_of_a_power_is_its_exponent() {
        let tolerances = [1e-5, 1e-6, 1e-7];
        assert!((slope(&tolerances, &[3e-4, 3e-5, 3e-6]) - 1.0).abs() < 1e-12);
        let steep = [1e-10, 1e-12, 1e-14];
        assert_eq!(
            slope_claim("a", &tolerances, &steep, &tolerances).verdict,
            Verdict::Fault
        );
        assert_eq!(
            slope_claim("a", &tolerances, &steep, &steep).verdict,
            Verdict::Finding
        );
    }
}
