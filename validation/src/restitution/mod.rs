//! What the laws of the normal force deliver: a mass that meets a contact freely, against closed forms and quadrature.
//!
//! Formulas and sources stand in `validation/restitution/SOURCE.md`.

mod flight;

use std::fmt::Write as _;

use super::table::Table;
use super::{CaseError, CaseReport, Claim, Setting, Verdict};
use flight::fly;
use linkdyn_engine::contact::normal::Law;
use linkdyn_engine::contact::normal::cylinder::{Logarithmic, Pair};
use linkdyn_engine::contact::normal::hysteresis::Rule;

/// A line about the case.
pub const ABOUT: &str = "restitution, penetration, duration and peak force of a free impact, by every law of the normal force";

const POWER: &str = include_str!("../../restitution/power.csv");
const LINEAR: &str = include_str!("../../restitution/linear.csv");
const CYLINDER: &str = include_str!("../../restitution/cylinder.csv");

/// Laws of `power.csv`, by the rule of their factor.
const RULES: [(Option<Rule>, &str); 9] = [
    (Some(Rule::HuntCrossley), "hunt_crossley"),
    (Some(Rule::HerbertMcwhannell), "herbert_mcwhannell"),
    (Some(Rule::LeeWang), "lee_wang"),
    (Some(Rule::LankaraniNikravesh), "lankarani_nikravesh"),
    (Some(Rule::Flores), "flores"),
    (Some(Rule::Gonthier), "gonthier"),
    (Some(Rule::ZhiyingQishao), "zhiying_qishao"),
    (Some(Rule::HuGuo), "hu_guo"),
    (None, "hertz"),
];
/// Laws of `cylinder.csv`.
type Cylinder = fn(&Pair) -> Logarithmic;
const CYLINDERS: [(Cylinder, &str); 3] = [
    (Pair::johnson, "johnson"),
    (Pair::radzimovsky, "radzimovsky"),
    (Pair::dubowsky_freudenstein, "dubowsky_freudenstein"),
];

/// Relative differences that count as agreement [–].
const CLOSE: f64 = 1e-8;
/// The exponent for which the delivered restitution is tabulated.
const HERTZ: f64 = 1.5;

/// What an impact is measured by, in the order of the tables.
const MEASURED: [&str; 4] = ["restitution", "penetration", "duration", "peak force"];

/// Runs the case.
///
/// # Errors
/// When it can't be run.
pub fn run(_: &Setting) -> Result<CaseReport, CaseError> {
    let mut report = CaseReport::default();
    let power = table(POWER)?;
    for (index, (rule, name)) in RULES.iter().enumerate() {
        let rows = power.rows.iter().filter(|row| row[0] == index as f64);
        let mut impacts = Vec::new();
        for row in rows {
            let &[
                _,
                asked,
                stiffness,
                exponent,
                mass,
                speed,
                factor,
                ref found @ ..,
            ] = row.as_slice()
            else {
                return Err(CaseError::Broken(format!("a row of {} cells", row.len())));
            };
            let law = match rule {
                Some(rule) => Law::Dissipative {
                    stiffness,
                    exponent,
                    hysteresis: rule.factor(asked),
                },
                None => Law::Hertz {
                    stiffness,
                    exponent,
                },
            };
            let ours = rule.map_or(0.0, |rule| rule.factor(asked));
            if (ours - factor).abs() > CLOSE * factor {
                return Err(CaseError::Broken(format!(
                    "{name}: a factor of {ours}, not {factor}"
                )));
            }
            impacts.push(Impact {
                asked,
                exponent,
                reference: four(found)?,
                ours: fly(&law, mass, speed)?,
            });
        }
        report.claims.push(differences(name, &impacts));
        if rule.is_some() {
            delivered(&mut report, name, &impacts);
        }
    }
    report.claims.push(linear()?);
    for (index, (law, name)) in CYLINDERS.iter().enumerate() {
        report.claims.push(cylinders(index, *law, name)?);
    }
    report.claims.extend(worked()?);
    Ok(report)
}

/// An impact of a table: restitution, penetration \[m\], duration \[s\] and peak force \[N\].
struct Impact {
    asked: f64,
    exponent: f64,
    reference: [f64; 4],
    ours: [f64; 4],
}

fn table(text: &str) -> Result<Table, CaseError> {
    Table::parse(text).map_err(CaseError::Broken)
}

fn four(found: &[f64]) -> Result<[f64; 4], CaseError> {
    found
        .try_into()
        .map_err(|_| CaseError::Broken(format!("{} measured values", found.len())))
}

/// Kelvin's and Voigt's body, under and over critical damping.
fn linear() -> Result<Claim, CaseError> {
    let mut impacts = Vec::new();
    for row in table(LINEAR)?.rows {
        let &[stiffness, damping, mass, speed, ref found @ ..] = row.as_slice() else {
            return Err(CaseError::Broken(format!("a row of {} cells", row.len())));
        };
        let ours = fly(&Law::KelvinVoigt { stiffness, damping }, mass, speed)?;
        impacts.push(Impact {
            asked: f64::NAN,
            exponent: 1.0,
            reference: four(found)?,
            ours,
        });
    }
    Ok(differences("kelvin_voigt", &impacts))
}

fn cylinders(index: usize, law: Cylinder, name: &str) -> Result<Claim, CaseError> {
    let mut impacts = Vec::new();
    for row in table(CYLINDER)?
        .rows
        .iter()
        .filter(|row| row[0] == index as f64)
    {
        let &[
            _,
            bearing_radius,
            clearance,
            length,
            flexibility,
            mass,
            speed,
            asked,
            ref found @ ..,
        ] = row.as_slice()
        else {
            return Err(CaseError::Broken(format!("a row of {} cells", row.len())));
        };
        let elastic = law(&Pair {
            bearing_radius,
            clearance,
            length,
            flexibility,
        });
        let law = Law::Cylindrical {
            elastic,
            hysteresis: Rule::LankaraniNikravesh.factor(asked),
        };
        impacts.push(Impact {
            asked,
            exponent: f64::NAN,
            reference: four(found)?,
            ours: fly(&law, mass, speed)?,
        });
    }
    Ok(differences(name, &impacts))
}

/// The largest relative difference of a law's impacts, over all that is measured.
fn differences(name: &str, impacts: &[Impact]) -> Claim {
    let worst = |k: usize| {
        let off =
            |impact: &Impact| ((impact.ours[k] - impact.reference[k]) / impact.reference[k]).abs();
        impacts.iter().map(off).fold(0.0, f64::max)
    };
    let worst = [0, 1, 2, 3].map(worst);
    let agrees = !impacts.is_empty() && worst.iter().all(|worst| *worst <= CLOSE);
    let each: Vec<String> = MEASURED
        .iter()
        .zip(worst)
        .map(|(name, worst)| format!("{name} {worst:.1e}"))
        .collect();
    Claim {
        what: format!(
            "{name}: {} free impacts, largest relative differences [–]",
            impacts.len()
        ),
        reference: format!("closed forms and quadrature, within {CLOSE:e}"),
        ours: each.join(", "),
        difference: format!("{:.1e}", worst.iter().copied().fold(0.0, f64::max)),
        verdict: if agrees {
            Verdict::Agrees
        } else {
            Verdict::Fault
        },
    }
}

/// The restitution that comes back for the one that was requested: a row of the table, and a claim of the law's authors.
fn delivered(report: &mut CaseReport, name: &str, impacts: &[Impact]) {
    let impacts: Vec<&Impact> = impacts
        .iter()
        .filter(|impact| impact.exponent == HERTZ)
        .collect();
    if report.text.is_empty() {
        let _ = write!(report.text, "Restitution delivered for\n{:22}", "");
        for impact in &impacts {
            let _ = write!(report.text, "{:>9}", impact.asked);
        }
        report.text.push('\n');
    }
    let _ = write!(report.text, "  {name:20}");
    for impact in &impacts {
        let _ = write!(report.text, "{:9.5}", impact.ours[0]);
    }
    report.text.push('\n');
    let off = |impact: &&Impact| (impact.ours[0] - impact.asked).abs();
    let Some(worst) = impacts.into_iter().max_by(|a, b| off(a).total_cmp(&off(b))) else {
        return;
    };
    report.claims.push(Claim {
        what: format!("{name}: returns the restitution asked for, worst of 0.1 to 0.95 [–]"),
        reference: worst.asked.to_string(),
        ours: format!("{:.7}", worst.ours[0]),
        difference: format!("{:+.1e}", worst.ours[0] - worst.asked),
        verdict: if off(&worst) <= CLOSE {
            Verdict::Agrees
        } else {
            Verdict::Finding(
                "Restitution follows from the hysteresis factor by an equation that the rule only approximates; gonthier solves it.",
            )
        },
    });
}

/// One impact in full: Lankarani and Nikravesh, e = 0.9, K = 1e9 N/m^1.5, 1 kg, 1 m/s.
fn worked() -> Result<Vec<Claim>, CaseError> {
    let rows = table(POWER)?.rows;
    let row = rows
        .iter()
        .find(|row| row[..6] == [3.0, 0.9, 1e9, HERTZ, 1.0, 1.0]);
    let row =
        row.ok_or_else(|| CaseError::Broken("the worked impact is not in its table".into()))?;
    let hysteresis = Rule::LankaraniNikravesh.factor(0.9);
    let ours = fly(
        &Law::Dissipative {
            stiffness: 1e9,
            exponent: HERTZ,
            hysteresis,
        },
        1.0,
        1.0,
    )?;
    let claim = |k: usize| {
        let (reference, difference) = (row[7 + k], (ours[k] - row[7 + k]) / row[7 + k]);
        Claim {
            what: format!(
                "lankarani_nikravesh, e = 0.9, 1e9 N/m^1.5, 1 kg, 1 m/s: {} [SI]",
                MEASURED[k]
            ),
            reference: reference.to_string(),
            ours: ours[k].to_string(),
            difference: format!("{difference:.1e} (relative)"),
            verdict: if difference.abs() <= CLOSE {
                Verdict::Agrees
            } else {
                Verdict::Fault
            },
        }
    };
    Ok((0..4).map(claim).collect())
}
