//! Sixty turns at two tolerances: from when on they part, what holds at all times, and whether statistics agree.
//!
//! Statistics are means over the turns after the first ten. Their standard error follows from blocks of five turns: means of
//! two runs agree where they differ by less than four standard errors of their difference.

use std::fmt::Write as _;

use super::solution::{TURN, episodes, millimetres, solve, values};
use crate::{CaseError, CaseReport, Claim, Setting, Verdict, at_most, broken, verdict};
use linkdyn_engine::analysis::Outcome;

const TURNS: u32 = 60;
/// Energy that may be missing, by rtol [–].
const LEDGER: f64 = 1.0;
/// Outputs in a turn.
pub const OUTPUTS: u32 = 360;
/// Turns that are left out at the start, and turns of a block.
const SETTLING: usize = 10;
const BLOCK: usize = 5;
/// Standard errors by which means may differ.
const SIGMAS: f64 = 4.0;
/// Two motions have parted where their eccentricities differ by this part of the clearance.
const PARTED: f64 = 0.1;
/// Acceleration of the slider at the top dead centre with ideal joints, −ω² r (1 + r/L) [m/s²].
const IDEAL: f64 = 19_419.36;

/// A run and its rows.
pub struct LongRun {
    pub clearance: f64,
    rtol: f64,
    pub outcome: Outcome,
    pub time: Vec<f64>,
    pub ex: Vec<f64>,
    pub ey: Vec<f64>,
    pub velocity: Vec<f64>,
    pub acceleration: Vec<f64>,
    statistics: Vec<Statistic>,
}

/// A quantity by turns.
struct Statistic {
    name: &'static str,
    turns: Vec<f64>,
}

impl Statistic {
    /// Mean after settling, and its standard error.
    fn mean(&self) -> [f64; 2] {
        let blocks: Vec<f64> = self.turns[SETTLING..]
            .chunks(BLOCK)
            .map(|block| block.iter().sum::<f64>() / block.len() as f64)
            .collect();
        let n = blocks.len() as f64;
        let mean = blocks.iter().sum::<f64>() / n;
        let variance = blocks
            .iter()
            .map(|block| (block - mean).powi(2))
            .sum::<f64>()
            / (n - 1.0);
        [mean, (variance / n).sqrt()]
    }
}

impl LongRun {
    pub fn new(setting: &Setting, clearance: f64, rtol: f64) -> Result<Self, CaseError> {
        let outcome = solve(setting, clearance, rtol, TURNS, OUTPUTS)?;
        let of = |name: &str| values(&outcome, name);
        let (time, ex, ey) = (of("time")?, of("joint.b.ex")?, of("joint.b.ey")?);
        let (velocity, acceleration) = (of("slider.vx")?, of("slider.ax")?);
        let (normal, dissipated) = (of("joint.b.normal_force")?, of("energy.dissipated")?);
        let by_turn = |name: &'static str, of: &dyn Fn(&[usize]) -> f64| {
            let rows: Vec<usize> = (0..(TURNS * OUTPUTS) as usize).collect();
            Statistic {
                name,
                turns: rows.chunks(OUTPUTS as usize).map(of).collect(),
            }
        };
        let mean = |rows: &[usize], of: &dyn Fn(usize) -> f64| {
            rows.iter().map(|k| of(*k)).sum::<f64>() / rows.len() as f64
        };
        let contacts = episodes(&outcome);
        let statistics = vec![
            by_turn("contacts in a turn", &|rows| {
                let (from, to) = (time[rows[0]], time[rows[0]] + TURN);
                contacts
                    .iter()
                    .filter(|contact| (from..to).contains(&contact.start))
                    .count() as f64
            }),
            by_turn("part of the time in contact", &|rows| {
                mean(rows, &|k| f64::from(u8::from(normal[k] > 0.0)))
            }),
            by_turn(
                "root mean square of the slider's acceleration [m/s^2]",
                &|rows| mean(rows, &|k| acceleration[k] * acceleration[k]).sqrt(),
            ),
            by_turn(
                "largest acceleration of the slider in a turn [m/s^2]",
                &|rows| {
                    rows.iter()
                        .map(|k| acceleration[*k].abs())
                        .fold(0.0, f64::max)
                },
            ),
            by_turn("energy lost in a turn [J]", &|rows| {
                dissipated[rows[rows.len() - 1] + 1] - dissipated[rows[0]]
            }),
        ];
        Ok(LongRun {
            clearance,
            rtol,
            time,
            ex,
            ey,
            velocity,
            acceleration,
            statistics,
            outcome,
        })
    }

    /// Rows at the beginning of a turn, after settling.
    pub fn sections(&self) -> impl Iterator<Item = usize> {
        (SETTLING..=TURNS as usize).map(|turn| turn * OUTPUTS as usize)
    }

    /// Largest |e| − c over the rows, and largest penetration of any contact \[m\].
    fn depth(&self) -> [f64; 2] {
        let rows = self
            .ex
            .iter()
            .zip(&self.ey)
            .map(|(x, y)| x.hypot(*y) - self.clearance)
            .fold(0.0, f64::max);
        [
            rows,
            episodes(&self.outcome)
                .iter()
                .map(|contact| contact.peak_penetration)
                .fold(0.0, f64::max),
        ]
    }

    /// When two motions part.
    fn parts_from(&self, other: &LongRun) -> Option<f64> {
        let apart = |k: &usize| (self.ex[*k] - other.ex[*k]).hypot(self.ey[*k] - other.ey[*k]);
        (0..self.time.len())
            .find(|k| apart(k) > PARTED * self.clearance)
            .map(|k| self.time[k])
    }
}

/// The table of statistics.
pub fn tell(runs: &[[LongRun; 2]], text: &mut String) {
    let _ = writeln!(
        text,
        "Means over turns {} to {TURNS}, with standard errors:",
        SETTLING + 1
    );
    for pair in runs {
        for run in pair {
            let _ = writeln!(
                text,
                "  {}, rtol {:.0e}",
                millimetres(run.clearance),
                run.rtol
            );
            for statistic in &run.statistics {
                let [mean, error] = statistic.mean();
                let _ = writeln!(text, "    {:55} {mean:12.5} ± {error:.5}", statistic.name);
            }
        }
    }
}

/// Claims of one clearance.
pub fn compare([loose, tight]: &[LongRun; 2], report: &mut CaseReport) -> Result<(), CaseError> {
    let name = millimetres(tight.clearance);
    for run in [loose, tight] {
        let imbalance = run
            .outcome
            .report
            .quality
            .energy_imbalance
            .ok_or_else(|| broken("no energy ledger"))?;
        let what = format!(
            "{name}, {TURNS} turns at rtol {:.0e}: energy that is missing, by rtol [–]",
            run.rtol
        );
        report
            .claims
            .push(at_most(what, imbalance / run.rtol, LEDGER));
    }
    let [rows, deepest] = tight.depth();
    report.claims.push(Claim {
        what: format!("{name}: orbit within clearance and largest penetration, |e| − c [µm]"),
        reference: format!("at most {:.3}", 1e6 * deepest),
        ours: format!("{:.3}", 1e6 * rows),
        difference: format!("{:.3}", 1e6 * (rows - deepest)),
        // A row may lie on the peak, which is found to some digits.
        verdict: verdict(rows > 0.0 && rows <= deepest * (1.0 + 1e-6)),
    });
    report.claims.push(parting(loose, tight, &name));
    for (a, b) in loose.statistics.iter().zip(&tight.statistics) {
        let ([loose_mean, loose_error], [tight_mean, tight_error]) = (a.mean(), b.mean());
        let error = loose_error.hypot(tight_error);
        let sigmas = (loose_mean - tight_mean).abs() / error;
        report.claims.push(Claim {
            what: format!("{name}, {}: mean at two tolerances", a.name),
            reference: format!(
                "{tight_mean:.5} ± {tight_error:.5} (rtol {:.0e})",
                tight.rtol
            ),
            ours: format!(
                "{loose_mean:.5} ± {loose_error:.5} (rtol {:.0e})",
                loose.rtol
            ),
            difference: format!("{sigmas:.1} standard errors"),
            verdict: if sigmas <= SIGMAS {
                Verdict::Agrees
            } else {
                Verdict::Finding("Fifty turns do not determine this mean.")
            },
        });
    }
    Ok(())
}

/// Whether the motion itself is known to the end.
fn parting(loose: &LongRun, tight: &LongRun, name: &str) -> Claim {
    let time = loose.parts_from(tight);
    let turns = time.map(|time| time / TURN);
    Claim {
        what: format!(
            "{name}: the motion does not depend on rtol (eccentricities within {PARTED} of the clearance)"
        ),
        reference: format!("for {TURNS} turns"),
        ours: turns.map_or(format!("for {TURNS} turns"), |turns| {
            format!("for {turns:.1} turns, then the motions part")
        }),
        difference: time.map_or("none".into(), |time| format!("from {time:.4} s on")),
        verdict: if time.is_none() {
            Verdict::Agrees
        } else {
            Verdict::Finding(
                "Nearby motions of this mechanism part exponentially, so that no method can tell a single one for long.",
            )
        },
    }
}

/// What is reported about this mechanism: a larger clearance makes larger peaks of the acceleration.
pub fn peaks_grow(runs: &[[LongRun; 2]]) -> Claim {
    let peaks: Vec<f64> = runs
        .iter()
        .map(|[_, tight]| tight.statistics[3].mean()[0])
        .collect();
    let grow = peaks.windows(2).all(|pair| pair[1] > pair[0])
        && peaks.first().is_some_and(|peak| *peak > IDEAL);
    let factors: Vec<String> = peaks
        .iter()
        .map(|peak| format!("{:.2}", peak / IDEAL))
        .collect();
    Claim {
        what: "largest acceleration of the slider in a turn, by that of ideal joints, at 0.1, 0.2, 0.5 mm [–]".into(),
        reference: "above 1, growing with the clearance (as recalled)".into(),
        ours: factors.join(", "),
        difference: String::new(),
        verdict: if grow {
            Verdict::Agrees
        } else {
            Verdict::Finding("What the authors found is recalled, not read; why it differs is not known.")
        },
    }
}
