//! The founding paper's lock with contact forces in its clearances, beside the paper's massless links.
//!
//! The massless link has no limit as the output step goes down (see [`super`]). Contact is a differential equation, whose
//! solution does not depend on where outputs are; what of it converges with the tolerance of the integration, which branch it
//! follows beyond the change point, and what becomes of the paper's claims C2 to C6 is reported here. The rules of the claims
//! are those of [`super::claims`], tried at every tolerance.

pub mod branch;
pub mod convergence;
pub mod early;
pub mod files;
pub mod page;
pub mod paper;
pub mod strokes;

use super::facts;
use super::format::short;
use super::models::{Quantity, Request, STEPS, Stroke};
use super::page::Page;
use super::table::{Paper, Runs};
use crate::{CaseError, CaseReport, Claim, Setting, Verdict};
use branch::{Branch, OTHER_END, OTHER_END_WITHIN};
use convergence::{Convergence, NUMBERS, Pair, by_tolerance, settled};
use early::Early;
use linkdyn_output::Directory;
use page::Work;
use strokes::{Contact, STEP, Strokes, TOLERANCES};

/// A line about the case.
pub const ABOUT: &str = "the same lock with contact in its clearances: what converges, which branch it follows, the claims";

/// Energy imbalance allowed by rtol: with contacts the integration bounds its error a hundred times tighter than rtol, and ten of these
/// may add up.
const IMBALANCE: f64 = 0.1;
/// Part of the mean deviation by which θ2 may differ between tolerances and still be the same [–].
const SAME_ANGLE: f64 = 0.1;

/// Runs the case.
///
/// # Errors
/// When it can't be run or written.
pub fn run(setting: &Setting) -> Result<CaseReport, CaseError> {
    let control = &setting.control;
    let paper = Paper::read()?;
    let base = Runs::new(Request::ideal(STEPS[0]), control)?;
    let ideal = &base.ideal[STEPS.len() - 1];
    let strokes = Strokes::new(control)?;
    let named: Vec<_> = strokes.named().collect();
    let convergence = Convergence::new(&base, &strokes);
    let (contact, massless) = (pairs(&strokes.all, &base), pairs(&base.clearance, &base));
    let early: Vec<Early> = strokes.all.iter().map(|all| Early::of(all)).collect();
    let branches = named
        .iter()
        .map(|(_, stroke)| Branch::of(stroke, ideal))
        .collect::<Result<Vec<_>, _>>()?;
    let other_end = branch::other_end(control)?;
    let clear = named.iter().map(|(contact, stroke)| {
        (
            *contact,
            convergence::deviation(&base, stroke, convergence::CLEAR, STEP),
        )
    });
    let hinges: Vec<_> = clear.collect();

    let mut page = Page::default();
    page.contact_opening();
    page.contact_table(&convergence, &paper);
    page.settling(&base, &convergence);
    page.early(&early);
    page.pairs(&massless, &contact);
    page.hinges(&hinges);
    page.branches(&named, &branches, other_end);
    page.work(&named);

    let mut claims = vec![
        balance(&named),
        other_branch(other_end),
        ends(&named, &branches),
        smooth_branch(&branches),
    ];
    claims.extend([
        instants(&early),
        angle(&contact, &massless),
        numbers(&base, &convergence),
    ]);
    claims.extend(super::figures(
        convergence.finest(),
        &paper,
        paper::NO_CONTACT,
    ));
    claims.extend(paper::claims(&strokes, &convergence)?);

    if let Some(output) = &setting.output {
        let directory = Directory::open(output)?;
        let facts = facts::facts(ideal, control)?;
        let change = facts
            .iter()
            .find(|fact| fact.what.starts_with("change_point"))
            .map(|fact| fact.ours);
        page.figures(&files::figures(
            &directory,
            &base,
            &strokes.at(TOLERANCES.len() - 1),
            change,
        )?);
        files::table(&directory, &convergence, &paper)?;
        files::strokes(&directory, &named, &branches, &hinges)?;
    }
    Ok(CaseReport {
        text: page.text(),
        claims,
    })
}

/// The energy of every stroke is accounted for, as far as it comes.
fn balance(strokes: &[(Contact, &Stroke)]) -> Claim {
    let share = |(contact, stroke): &(Contact, &Stroke)| {
        (
            Work::of(stroke).imbalance / (IMBALANCE * contact.rtol),
            contact.name(),
        )
    };
    let worst = strokes
        .iter()
        .map(share)
        .fold((0.0, String::new()), |a, b| if b.0 <= a.0 { a } else { b });
    Claim {
        what: format!(
            "energy imbalance of {} strokes, by {IMBALANCE} rtol, worst",
            strokes.len()
        ),
        reference: "0".into(),
        ours: format!("{:.2} ({})", worst.0, worst.1),
        difference: "allowed 1".into(),
        verdict: if worst.0 <= 1.0 {
            Verdict::Agrees
        } else {
            Verdict::Fault
        },
    }
}

fn other_branch(ours: f64) -> Claim {
    let difference = (ours - OTHER_END).abs();
    Claim {
        what: "dead centre of the branch that is not followed, ideal hinges [deg]".into(),
        reference: format!("{OTHER_END}"),
        ours: format!("{ours}"),
        difference: format!("{difference:.1e} (allowed {OTHER_END_WITHIN:.0e})"),
        verdict: if difference <= OTHER_END_WITHIN {
            Verdict::Agrees
        } else {
            Verdict::Fault
        },
    }
}

/// Which strokes come to the end, and why the others don't. With d, e or f alone the first loop is ideal and passes its change point
/// with two motions free, which the integration need not bridge: a stop there is a finding, elsewhere a fault.
fn ends(strokes: &[(Contact, &Stroke)], branches: &[Branch]) -> Claim {
    let stopped = strokes
        .iter()
        .zip(branches)
        .filter(|(_, branch)| !branch.is_whole);
    let reasons: Vec<String> = stopped
        .map(|((contact, stroke), branch)| {
            let place = if branch.stops_in_line() {
                "at the change point of the first loop"
            } else {
                "early"
            };
            let (name, status) = (contact.name(), stroke.report.status.word());
            format!(
                "{name} stops {place} ({status}) behind {}°, theta4 - theta3 = {:.2}°",
                branch.last, branch.between
            )
        })
        .collect();
    Claim {
        what: "strokes that come to 125 deg".into(),
        reference: format!("all {}", strokes.len()),
        ours: format!("{}", strokes.len() - reasons.len()),
        difference: if reasons.is_empty() {
            "none stops".into()
        } else {
            reasons.join("; ")
        },
        verdict: if reasons.is_empty() {
            Verdict::Agrees
        } else if branches
            .iter()
            .all(|branch| branch.is_whole || branch.stops_in_line())
        {
            Verdict::Finding(
                "With one hinge open the first loop may be ideal, and free to move when it passes its change point: the run could not be followed there.",
            )
        } else {
            Verdict::Fault
        },
    }
}

/// Of the strokes that come to the end.
fn smooth_branch(branches: &[Branch]) -> Claim {
    let whole: Vec<&Branch> = branches.iter().filter(|branch| branch.is_whole).collect();
    let smooth = whole.iter().filter(|branch| branch.is_smooth()).count();
    let ends = whole.iter().map(|branch| branch.theta2[0]);
    let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), end| {
        (low.min(end), high.max(end))
    });
    let far = whole
        .iter()
        .filter_map(|branch| branch.farthest)
        .fold(0.0, |far: f64, [value, _]| far.max(value));
    Claim {
        what: "theta2 at 125 deg beyond the change point, with contact [deg]".into(),
        reference: format!(
            "{:.4} on the smooth branch",
            whole.first().map_or(f64::NAN, |branch| branch.theta2[1])
        ),
        ours: format!(
            "{smooth} of {} strokes follow it: {low:.4} to {high:.4}",
            whole.len()
        ),
        difference: format!(
            "never farther than {far:.3}° from it beyond 117.5° (smooth: within {}° at the end)",
            branch::NEAR
        ),
        verdict: if smooth == whole.len() && smooth > 0 {
            Verdict::Agrees
        } else {
            Verdict::Finding(
                "Two branches lead on beyond the change point, and the clearances let the lock take either.",
            )
        },
    }
}

/// Pairs of runs of all seven hinges at neighbouring settings, by radius.
fn pairs(all: &[Vec<Stroke>], base: &Runs) -> Vec<Vec<Pair>> {
    let (ideal, ranges) = (&base.ideal[STEPS.len() - 1], &base.deviations.ranges);
    all.iter()
        .map(|all| {
            all.windows(2)
                .map(|two| Pair::of(&two[0], &two[1], ideal, ranges))
                .collect()
        })
        .collect()
}

/// Before runs part, instants of contacts converge.
fn instants(early: &[Early]) -> Claim {
    let told = |early: &Early| {
        let means: Vec<String> = early
            .differences
            .iter()
            .map(|[mean, _]| format!("{mean:.1e}"))
            .collect();
        format!(
            "{} s over {} contacts until {:.4} s",
            means.join(" to "),
            early.contacts,
            early.until
        )
    };
    Claim {
        what: "instants of contacts before runs part: mean difference from tolerance to tolerance, 10 and 100 um"
            .into(),
        reference: format!("falls {} times or more with rtol", early::FALLS),
        ours: early.iter().map(told).collect::<Vec<_>>().join("; "),
        difference: early.iter().map(|early| format!("{:.1} times", early.falls())).collect::<Vec<_>>().join(" / "),
        verdict: if early.iter().all(Early::converges) {
            Verdict::Agrees
        } else {
            Verdict::Finding("An impact amplifies what two runs differ by; why these do not converge before they part is not known.")
        },
    }
}

/// θ2 is the same whatever the tolerance, where it depends on the output step with massless links.
fn angle(contact: &[Vec<Pair>], massless: &[Vec<Pair>]) -> Claim {
    let last = |all: &[Vec<Pair>]| -> Vec<f64> {
        all.iter()
            .filter_map(|pairs| pairs.last().map(|pair| pair.mean[Quantity::Theta2.index()]))
            .collect()
    };
    let text = |values: &[f64]| {
        values
            .iter()
            .map(|&value| short(value))
            .collect::<Vec<_>>()
            .join(" / ")
    };
    let (contact, massless) = (last(contact), last(massless));
    Claim {
        what: "mean difference of theta2 at the two finest settings by its mean deviation from e = 0, 10 and 100 um"
            .into(),
        reference: format!("massless {}", text(&massless)),
        ours: format!("contact {}", text(&contact)),
        difference: format!("agrees when at most {SAME_ANGLE} with contact"),
        verdict: if contact.iter().all(|value| *value <= SAME_ANGLE) {
            Verdict::Agrees
        } else {
            Verdict::Finding("Impacts leave this open: it is no error that a finer tolerance takes away.")
        },
    }
}

/// How many of the paper's numbers settle: with massless links by step, with contact by tolerance.
fn numbers(base: &Runs, convergence: &Convergence) -> Claim {
    let massless =
        settled(|radius, q, statistic| base.row(radius, q).into_iter().map(statistic).collect());
    let contact =
        |all, step| settled(|radius, q, statistic| by_tolerance(all, [radius, step], q, statistic));
    let counts: Vec<[usize; 2]> = (0..STEPS.len())
        .map(|step| contact(&convergence.whole, step))
        .collect();
    let clear = contact(&convergence.clear, STEPS.len() - 1);
    let finest = counts[STEPS.len() - 1];
    let steps = |index: usize| {
        counts
            .iter()
            .map(|count| count[index].to_string())
            .collect::<Vec<_>>()
            .join(" / ")
    };
    Claim {
        what: format!(
            "numbers of the paper's table that settle, of {NUMBERS} (without the largest F12): massless by step, contact by rtol"
        ),
        reference: format!("massless {}; {} over three steps", massless[0], massless[1]),
        ours: format!(
            "contact {}; {} over three tolerances (outputs 2.5 / 1 / 0.5 / 0.1° apart); up to {}° {}; {} over three (0.1°)",
            steps(0),
            steps(1),
            convergence::CLEAR,
            clear[0],
            clear[1]
        ),
        difference: "agrees when more settle with contact than with massless links, by two and by three, 0.1° apart"
            .into(),
        verdict: if finest[0] > massless[0] && finest[1] > massless[1] {
            Verdict::Agrees
        } else {
            Verdict::Finding("Where a peak is a single impact two values may agree, or differ, by chance.")
        },
    }
}
