//! The cargo-door lock of the founding paper: Zhi Changjian, Wang Sanmin, Sun Yuantao, "Effect of kinematic pairs clearance
//! on dynamic characteristics of multi-linkage lock mechanisms", J. Harbin Inst. Technol. 46(8), 2014, 102–106.
//!
//! Three kinds of statements: what must hold whatever the paper says (singular positions against an independent calculation,
//! the paper's own equations on our results) is a fault where it fails; the paper's numbers and claims are findings where
//! they are not reproduced. What the paper leaves out, and what we chose, stands in `validation/lock/SOURCE.md`.

pub mod accuracy;
pub mod bounds;
pub mod centres;
pub mod checks;
pub mod claims;
pub mod contact;
pub mod document;
pub mod equations;
pub mod facts;
pub mod figures;
pub mod files;
pub mod first_pass;
pub mod forces;
pub mod format;
pub mod instant;
pub mod judged;
pub mod models;
pub mod page;
pub mod reversals;
pub mod table;

use super::{CaseError, CaseReport, Claim, Setting, Verdict};
use centres::Centres;
use checks::{TOLERANCE, Violations};
use document::broken;
use first_pass::{FirstPass, Sign};
use format::short;
use linkdyn_output::Directory;
use models::{LINKS, Order, Quantity, RADII, Request, STEPS, Stroke};
use page::Page;
use table::{Deviations, NEAR_CHANGE_POINT, Paper, Runs};

/// A line about the case.
pub const ABOUT: &str = "the founding paper's cargo-door lock, its figures and claims beside ours";

/// Factor between the paper's figure and ours up to which they count as the same.
const SAME: f64 = 1.2;
/// Largest difference of angles between the hinge orders \[rad\].
const SAME_ANGLE: f64 = 1e-12;

/// Runs the case.
///
/// # Errors
/// When it can't be run or written.
pub fn run(setting: &Setting) -> Result<CaseReport, CaseError> {
    let control = &setting.control;
    let paper = Paper::read()?;
    let mut all = Vec::new();
    for centres in Centres::TABLES {
        all.push(Runs::new(
            Request {
                centres,
                ..Request::ideal(STEPS[0])
            },
            control,
        )?);
    }
    let other_order = Runs::new(
        Request {
            order: Order::FiveOnThree,
            ..Request::ideal(STEPS[0])
        },
        control,
    )?;
    let base = &all[0];
    let [finest, variant] = [&base.ideal[3], &other_order.ideal[3]];
    let facts = facts::facts(finest, control)?;
    let map = forces::map(control)?;
    let mut passes = Vec::new();
    for sign in [Sign::Pressing, Sign::Opposite] {
        for radius in RADII {
            passes.push(first_pass::first_pass(radius, sign, control)?);
        }
    }
    let angles = angle_difference(finest, variant)?;

    let tables: Vec<&Runs> = all.iter().chain([&other_order]).collect();

    let mut page = Page::default();
    page.opening();
    page.facts(&facts);
    page.table(base, &paper);
    page.turns(&reversals::turns(finest)?);
    page.places(base);
    page.leftovers(base);
    page.first_passes(&passes, &paper);
    page.forces(&map);
    for runs in &all[1..] {
        page.table(runs, &paper);
    }
    page.variant(finest, variant, angles);
    page.table(&other_order, &paper);

    let mut claims: Vec<Claim> = facts.iter().map(facts::Fact::claim).collect();
    claims.extend(equations(&tables)?);
    claims.push(same_angles(angles));
    claims.extend(figures(&base.deviations, &paper, claims::OPEN_STEP));
    claims.push(first_pass_claim(&passes, &paper));
    claims.extend(accuracy::claims(&paper, control)?);
    claims.extend(claims::claims(base, &map));

    if let Some(output) = &setting.output {
        let directory = Directory::open(output)?;
        page.figures(&figures::write(&directory, base, &facts)?);
        files::curves(&directory, base)?;
        files::table(&directory, &tables, &paper)?;
        files::singular(&directory, &facts)?;
        files::centres(&directory, &map)?;
        files::intervals(&directory, base)?;
    }
    Ok(CaseReport {
        text: page.text(),
        claims,
    })
}

/// The paper's equations on all runs: the worst figure of each.
fn equations(all: &[&Runs]) -> Result<Vec<Claim>, CaseError> {
    let mut worst = Violations::default();
    for stroke in all
        .iter()
        .flat_map(|runs| runs.ideal.iter().chain(runs.clearance.iter().flatten()))
    {
        worst = worst.join(checks::check(stroke)?);
    }
    let claim = |(what, value, instants): (&str, f64, usize)| Claim {
        what: format!("{what}, worst of {instants} instants"),
        reference: "0".into(),
        ours: format!("{value:.1e}"),
        difference: format!("relative, allowed {TOLERANCE:.0e}"),
        verdict: if value <= TOLERANCE && instants > 0 {
            Verdict::Agrees
        } else {
            Verdict::Fault
        },
    };
    Ok(worst.named().into_iter().map(claim).collect())
}

/// Largest difference of any link's angle between two runs \[rad\].
fn angle_difference(a: &Stroke, b: &Stroke) -> Result<f64, CaseError> {
    let mut worst = 0.0_f64;
    for link in LINKS {
        let name = format!("{link}.angle");
        let pair = a.trajectory.values(&name).zip(b.trajectory.values(&name));
        let (a, b) = pair.ok_or_else(|| broken(format!("no column {name}")))?;
        worst = a
            .iter()
            .zip(&b)
            .fold(worst, |worst, (a, b)| worst.max((a - b).abs()));
    }
    Ok(worst)
}

fn same_angles(difference: f64) -> Claim {
    Claim {
        what: "link angles of the other hinge order (5 on 3, 6 on 4) [rad]".into(),
        reference: "the same".into(),
        ours: "largest difference over the stroke".into(),
        difference: format!("{difference:.1e} (allowed {SAME_ANGLE:.0e})"),
        verdict: if difference <= SAME_ANGLE {
            Verdict::Agrees
        } else {
            Verdict::Fault
        },
    }
}

/// The paper's table, a claim per quantity, at the coarsest step, on whose outputs both its singular configurations lie.
fn figures(deviations: &Deviations, paper: &Paper, reason: &'static str) -> Vec<Claim> {
    let claim = |quantity: Quantity| {
        let (mut printed, mut ours, mut factors) = (Vec::new(), Vec::new(), Vec::new());
        for radius in 0..RADII.len() {
            let found = deviations.at(radius, 0, quantity);
            for (theirs, value) in paper
                .deviation(radius, quantity)
                .into_iter()
                .zip([found.max, found.mean])
            {
                printed.push(format!("{theirs}"));
                ours.push(short(value));
                factors.push(value / theirs);
            }
        }
        let same = factors
            .iter()
            .all(|factor| (1.0 / SAME..=SAME).contains(factor));
        let factors: Vec<String> = factors.into_iter().map(short).collect();
        Claim {
            what: format!(
                "|deviation| of {} [{}], max and mean at 10 um, max and mean at 100 um, step {}°",
                quantity.symbol(),
                quantity.unit(),
                STEPS[0]
            ),
            reference: printed.join(" / "),
            ours: ours.join(" / "),
            difference: format!("factors {} (same up to {SAME})", factors.join(" / ")),
            verdict: if same {
                Verdict::Agrees
            } else {
                Verdict::Finding(reason)
            },
        }
    };
    Quantity::ALL.into_iter().map(claim).collect()
}

/// θ2 at 117.5° in the first pass against the paper's largest.
fn first_pass_claim(passes: &[FirstPass], paper: &Paper) -> Claim {
    let pressing: Vec<f64> = passes
        .iter()
        .filter(|pass| pass.sign == Sign::Pressing)
        .map(|pass| pass.at(NEAR_CHANGE_POINT))
        .collect();
    let printed: Vec<f64> = (0..RADII.len())
        .map(|radius| paper.deviation(radius, Quantity::Theta2)[0])
        .collect();
    let same = |(ours, theirs): (&f64, &f64)| (1.0 / SAME..=SAME).contains(&(ours / theirs));
    let factors: Vec<String> = pressing
        .iter()
        .zip(&printed)
        .map(|(ours, theirs)| short(ours / theirs))
        .collect();
    Claim {
        what:
            "largest |deviation| of theta2 [rad] at 10 and 100 um, against our first pass at 117.5°"
                .into(),
        reference: printed
            .iter()
            .map(f64::to_string)
            .collect::<Vec<_>>()
            .join(" / "),
        ours: pressing
            .iter()
            .map(|&value| short(value))
            .collect::<Vec<_>>()
            .join(" / "),
        difference: format!("factors {} (same up to {SAME})", factors.join(" / ")),
        verdict: if pressing.iter().zip(&printed).all(same) {
            Verdict::Agrees
        } else {
            Verdict::Finding(
                "The paper does not say how its repetition ends; why our first pass has its number at 10 um only is not known.",
            )
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkdyn_engine::analysis::Control;

    #[test]
    fn the_case_has_no_fault_and_all_six_claims() {
        let report = run(&Setting {
            output: None,
            control: Control::default(),
        })
        .expect("runs");
        for claim in &report.claims {
            assert_ne!(claim.verdict, Verdict::Fault, "{claim:?}");
        }
        for name in ["C1:", "C2:", "C3:", "C4:", "C5:", "C6:"] {
            let claim = report
                .claims
                .iter()
                .find(|claim| claim.what.starts_with(name))
                .expect(name);
            let words = ["reproduced:", "partly:", "possible for some", "not:"];
            assert!(
                words.iter().any(|word| claim.ours.starts_with(word)),
                "{claim:?}"
            );
        }
        // The 50-digit value of validation/generate/lock.py, to 1e-8°.
        let change = report
            .claims
            .iter()
            .find(|claim| claim.what.starts_with("change_point"))
            .expect("located");
        let ours: f64 = change.ours.parse().expect("a number");
        assert!((ours - 117.512_206_516_641).abs() < 1e-8, "{ours}");
        let widest = report.text.lines().map(|line| line.chars().count()).max();
        assert!(widest <= Some(120), "{widest:?}");
    }
}
