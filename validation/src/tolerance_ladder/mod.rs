//! Errors of forward dynamics over the tolerance requested, beside SciPy's DOP853 on minimal coordinates; and the steps at
//! flat positions, where linkages of parallel cranks could fold over.
//!
//! References and what is measured stand in `validation/tolerance-ladder/SOURCE.md`.

mod flat;
mod problems;

use std::fmt::Write as _;

use serde_json::json;

use super::{CaseError, CaseReport, Claim, Setting, Verdict};
use flat::{FLAT, flat_steps, long_run};
use problems::{FOUR_BARS, column, error, problems, simulate, table};

/// A line about the case.
pub const ABOUT: &str = "errors of forward dynamics at rtol of 1e-5 to 1e-10 beside SciPy's DOP853; steps at flat positions";

const SCIPY: &str = include_str!("../../tolerance-ladder/scipy.csv");
const LONG_SCIPY: &str = include_str!("../../tolerance-ladder/long-scipy.csv");
const LONG: &str = include_str!("../../tolerance-ladder/long.csv");
const FORTY: &str = include_str!("../../a02-four-bars-40/case.json");

/// Slope of log error over log rtol [-].
const SLOPES: [f64; 2] = [0.8, 1.2];
/// Our error over SciPy's at the same tolerance [-].
const WORSE: f64 = 3.0;
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
            (false, false) => Verdict::Finding(
                "After passages near unstable or abrupt points errors are not proportional to a loose tolerance; SciPy's slope lies outside as well.",
            ),
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
        (true, false) => Verdict::Finding(
            "At a single tolerance either program may be lucky; over all tolerances the mean of the ratios is within the bound.",
        ),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rung_is_a_finding_and_their_mean_a_fault() {
        let rungs = ["1e-5", "1e-6"].map(String::from);
        let verdict = |ours: [f64; 2]| ratio_claim("a", &rungs, &ours, &[1.0, 1.0]).verdict;
        assert_eq!(verdict([2.9, 1.0]), Verdict::Agrees);
        assert!(verdict([3.1, 1.0]).reason().is_some());
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
        let both = slope_claim("a", &tolerances, &steep, &steep);
        assert!(both.verdict.reason().is_some());
    }
}
