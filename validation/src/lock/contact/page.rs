//! What the case prints, in tables of at most 120 columns.

use std::fmt::Write;

use super::super::format::short;
use super::super::models::{Quantity, RADII, STEPS, Stroke};
use super::super::page::Page;
use super::super::table::{DISTURBED, Deviation, Paper, Runs, SETTLED, settles};
use super::branch::{Branch, OTHER_END};
use super::convergence::{CLEAR, Convergence, Pair, STATISTICS, Statistic, by_tolerance};
use super::early::{BOUNDS, Early, SAME_BEGIN};
use super::strokes::{Contact, TOLERANCES, USUAL, is_whole};

/// Index of the finest output step.
const FINEST: usize = STEPS.len() - 1;

fn cells(values: &[f64]) -> String {
    values
        .iter()
        .map(|&value| format!(" {:>9}", short(value)))
        .collect()
}

fn star(settled: bool) -> &'static str {
    if settled { " " } else { "*" }
}

fn tolerances() -> String {
    TOLERANCES
        .map(|rtol| format!(" {:>9}", format!("{rtol:e}")))
        .concat()
}

/// In lines of at most 120 columns.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let Some(line) = lines.last_mut() else { break };
        if line.is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() <= 120 {
            let _ = write!(line, " {word}");
        } else {
            lines.push(word.to_string());
        }
    }
    lines.join("\n")
}

impl Page {
    /// What the case is about.
    pub fn contact_opening(&mut self) {
        self.line(
            "The lock of Zhi, Wang, Sun 2014 with contact in its clearances: journals fly, hit and press, and the motion that\n\
             theta6 leaves free is integrated. The paper has no data for it; ours: bearing radius 10 mm, steel (207 GPa, 0.3),\n\
             Lankarani and Nikravesh's law with restitution 0.9, no friction (models/watt-i-lock.json). At the start the\n\
             journals are in the middle, at the ideal velocities.",
        );
    }

    /// The paper's table beside contact at its finest tolerance.
    pub fn contact_table(&mut self, convergence: &Convergence, paper: &Paper) {
        self.heading(&format!(
            "|deviation from e = 0| over the stroke, contact, rtol {:e}",
            TOLERANCES[TOLERANCES.len() - 1]
        ));
        let steps: String = STEPS
            .iter()
            .map(|step| format!(" {:>9} ", format!("{step}°")))
            .collect();
        let half = |name: &str| format!("{name:>8}{steps} ");
        self.line(format!(
            "{:14}{}{}",
            "paper, ours",
            half("max"),
            half("mean")
        ));
        for quantity in Quantity::ALL {
            for (radius, e) in RADII.iter().enumerate() {
                let mut text = format!("{:14}", format!("{} {e} um", quantity.symbol()));
                for ((_, statistic), printed) in STATISTICS
                    .into_iter()
                    .zip(paper.deviation(radius, quantity))
                {
                    let _ = write!(text, "{printed:>8}");
                    for step in 0..STEPS.len() {
                        let values =
                            by_tolerance(&convergence.whole, [radius, step], quantity, statistic);
                        let finest = values.last().copied().unwrap_or(f64::NAN);
                        let _ = write!(text, " {:>9}{}", short(finest), star(settles(&values)));
                    }
                    text.push(' ');
                }
                self.line(text);
            }
        }
        self.line(format!(
            "* does not settle: the values at the two finest tolerances differ by more than {:.0} %. The largest F12 at outputs\n\
             that hit 117.5° is that of the ideal lock, which has no bound at its change point 0.0122° beside it.",
            100.0 * SETTLED
        ));
    }

    /// The massless link by output step beside contact by tolerance.
    pub fn settling(&mut self, base: &Runs, convergence: &Convergence) {
        self.heading("What settles: the massless link as the output step goes down, contact as the tolerance does");
        let massless: String = STEPS
            .iter()
            .map(|step| format!(" {:>9}", format!("{step}°")))
            .collect();
        self.line(format!(
            "{:22}{massless}    {} at outputs {}° apart",
            "massless, contact",
            tolerances(),
            STEPS[FINEST]
        ));
        let rows = |name: &str, statistic: Statistic, contact: &[_], page: &mut Page| {
            for quantity in Quantity::ALL {
                for (radius, e) in RADII.iter().enumerate() {
                    let without: Vec<f64> = base
                        .row(radius, quantity)
                        .into_iter()
                        .map(statistic)
                        .collect();
                    let with = by_tolerance(contact, [radius, FINEST], quantity, statistic);
                    let name = format!("{} e={e} um {name}", quantity.symbol());
                    let [a, b] = [&without, &with].map(|values| star(settles(values)));
                    page.line(format!(
                        "{name:22}{}{a}   {}{b}",
                        cells(&without),
                        cells(&with)
                    ));
                }
            }
        };
        for (name, statistic) in STATISTICS {
            rows(name, statistic, &convergence.whole, self);
        }
        self.line(format!("\nMean up to {CLEAR}°, contact"));
        for quantity in Quantity::ALL {
            for (radius, e) in RADII.iter().enumerate() {
                let with = by_tolerance(&convergence.clear, [radius, FINEST], quantity, |d| d.mean);
                let name = format!("{} e={e} um mean", quantity.symbol());
                self.line(format!(
                    "{name:65} {}{}",
                    cells(&with),
                    star(settles(&with))
                ));
            }
        }
    }

    /// Contacts before runs part.
    pub fn early(&mut self, early: &[Early]) {
        self.heading("Before runs at different tolerances part: instants at which contacts begin");
        let bounds = BOUNDS
            .map(|bound| format!("{:>9}", format!("{bound:e} s")))
            .concat();
        self.line(format!(
            "{:24}contacts together to within{:17}the first contacts",
            "", ""
        ));
        self.line(format!(
            "{:24}{bounds}{:>16}{:>11}{:>12}{:>12}",
            "", "contacts", "until [s]", "mean [s]", "largest"
        ));
        for (early, e) in early.iter().zip(RADII) {
            let pairs = TOLERANCES
                .windows(2)
                .zip(&early.together)
                .zip(&early.differences);
            for ((rtol, together), [mean, largest]) in pairs {
                let name = format!("{e} um, {:e} and {:e}", rtol[0], rtol[1]);
                let together = together.map(|count| format!("{count:>9}")).concat();
                let first = format!(
                    "{:>16}{:>11.4}{mean:>12.1e}{largest:>12.1e}",
                    early.contacts, early.until
                );
                self.line(format!("{name:24}{together}{first}"));
            }
        }
        self.line(format!(
            "Contacts are the same that begin within {SAME_BEGIN:e} s of each other, hinge by hinge. The first contacts are those\n\
             before one that only one run has; told is how far apart they begin. Impacts amplify every difference: after some\n\
             tens of them no tolerance gives the same ones."
        ));
    }

    /// How far two runs stay together.
    pub fn pairs(&mut self, massless: &[Vec<Pair>], contact: &[Vec<Pair>]) {
        self.heading("How far runs at neighbouring output steps, or tolerances, agree pointwise");
        let names: String = Quantity::ALL
            .map(|q| format!("{:>17}", q.symbol()))
            .concat();
        self.line(format!("{:35}{names}", ""));
        let steps: Vec<String> = STEPS
            .windows(2)
            .map(|two| format!("{}° and {}°", two[0], two[1]))
            .collect();
        let rtols: Vec<String> = TOLERANCES
            .windows(2)
            .map(|two| format!("{:e} and {:e}", two[0], two[1]))
            .collect();
        for (model, all, settings) in [("massless", massless, steps), ("contact", contact, rtols)] {
            for (pairs, e) in all.iter().zip(RADII) {
                for (pair, setting) in pairs.iter().zip(&settings) {
                    let shares = pair.agree[0].iter().zip(pair.agree[1]);
                    let shares: String = shares
                        .map(|(a, b)| {
                            format!("{:>17}", format!("{:.1} / {:.1} %", 100.0 * a, 100.0 * b))
                        })
                        .collect();
                    self.line(format!(
                        "{model} {e} um, {setting:16}{:1$}{shares}",
                        "",
                        13 - model.len() - e.to_string().len()
                    ));
                    let means = pair
                        .mean
                        .map(|mean| format!("{:>17}", short(mean)))
                        .concat();
                    self.line(format!("{:35}{means}", ""));
                }
            }
        }
        self.line(format!(
            "Above: outputs that agree to {} % of the ideal curve's range, up to / beyond {CLEAR}°. Below: mean difference by mean\n\
             deviation from e = 0. Where journals rest on their bearings, runs that had parted come together again; their vibration\n\
             there, which alpha2 shows, keeps its own phase, and no finer tolerance brings it together.",
            100.0 * DISTURBED
        ));
    }

    /// Which hinge does what.
    pub fn hinges(&mut self, strokes: &[(Contact, [Deviation; 5])]) {
        self.heading(&format!(
            "One hinge at a time: |deviation from e = 0| up to {CLEAR}°, outputs {}° apart, max and mean",
            STEPS[FINEST]
        ));
        let names: String = Quantity::ALL
            .map(|q| format!("{:>20}", format!("{} [{}]", q.symbol(), q.unit())))
            .concat();
        self.line(format!("{:16}{names}", ""));
        for (contact, deviations) in strokes
            .iter()
            .filter(|(contact, _)| contact.rtol == TOLERANCES[USUAL])
        {
            let cells = deviations
                .map(|d| format!(" {:>9} {:>9}", short(d.max), short(d.mean)))
                .concat();
            self.line(format!("{:16}{cells}", contact.bearings()));
        }
        self.line(format!("rtol {:e}.", TOLERANCES[USUAL]));
    }

    /// Where the motions go beyond the change point.
    pub fn branches(
        &mut self,
        strokes: &[(Contact, &Stroke)],
        branches: &[Branch],
        other_end: f64,
    ) {
        self.heading("Beyond the change point");
        self.line(format!(
            "Two branches of the ideal first loop cross there. The other one ends in a dead centre at {other_end:.9}°\n\
             (independent calculation: {OTHER_END}°): from there on the smooth branch is the only one near.\n"
        ));
        self.line(format!(
            "{:24}{:>14}{:>11}{:>14}{:>14}{:>17}{:>26}",
            "",
            "branch",
            "until",
            "theta2 there",
            "ideal",
            "theta4 - theta3",
            "farthest beyond 117.5°"
        ));
        for ((contact, _), branch) in strokes.iter().zip(branches) {
            let Branch {
                last,
                theta2: [with, without],
                between,
                farthest,
                ..
            } = branch;
            let far = farthest.map_or("-".into(), |[far, at]| format!("{far:.4}° at {at:.1}°"));
            self.line(format!(
                "{:24}{:>14}{last:>10.1}°{with:>13.4}°{without:>13.4}°{between:>16.4}°{far:>26}",
                contact.name(),
                branch.word()
            ));
        }
        for (contact, stroke) in strokes.iter().filter(|(_, stroke)| !is_whole(stroke)) {
            let message = stroke
                .report
                .message
                .as_deref()
                .unwrap_or("no reason given");
            let text = format!(
                "{} ({}): {message}",
                contact.name(),
                stroke.report.status.word()
            );
            self.line(format!("\n{}", wrapped(&text)));
        }
    }

    /// What a stroke costs, and what limits it.
    pub fn work(&mut self, strokes: &[(Contact, &Stroke)]) {
        self.heading("What a stroke costs");
        self.line(format!(
            "{:24}{:>9}{:>9}{:>12}{:>10}{:>11}{:>10}{:>10}{:>12}{:>11}",
            "",
            "steps",
            "rejected",
            "evaluations",
            "contacts",
            "steps each",
            "mean step",
            "touching",
            "largest F",
            "energy off"
        ));
        for (contact, stroke) in strokes {
            let work = Work::of(stroke);
            self.line(format!(
                "{:24}{:>9}{:>9}{:>12}{:>10}{:>11.0}{:>7.0} us{:>8.1} %{:>10.0} N{:>11.1e}",
                contact.name(),
                work.steps,
                work.rejected,
                work.evaluations,
                work.contacts,
                work.steps as f64 / work.contacts.max(1) as f64,
                1e6 * work.duration / work.steps.max(1) as f64,
                100.0 * work.touching,
                work.peak_force,
                work.imbalance
            ));
        }
        self.line(
            "Touching: part of the time, mean of the bearings. Journals touch nearly all of the time, so that what limits the steps\n\
             is their vibration on the elastic bearings, with periods of 0.2 to 1.3 ms under the weight of the links (at 20°,\n\
             100 um) and shorter ones as forces grow, whether it still rings or not. Impacts, each of which starts the\n\
             integration anew, come second.",
        );
    }
}

/// Figures of the integration of a stroke.
#[derive(Debug, Clone, Copy)]
pub struct Work {
    pub steps: u64,
    pub rejected: u64,
    pub evaluations: u64,
    pub contacts: u64,
    /// Time of the stroke \[s\].
    pub duration: f64,
    /// Part of it in which a bearing is touched, mean of the bearings [–].
    pub touching: f64,
    /// Largest normal force \[N\].
    pub peak_force: f64,
    /// Energy imbalance, relative [–].
    pub imbalance: f64,
}

impl Work {
    /// From the report of the run.
    pub fn of(stroke: &Stroke) -> Self {
        let report = &stroke.report;
        let duration = stroke
            .trajectory
            .values("time")
            .and_then(|time| time.last().copied())
            .unwrap_or(f64::NAN);
        let touching: f64 = report
            .clearances
            .iter()
            .map(|sums| sums.time_in_contact)
            .sum();
        let episodes = report.events.iter().filter_map(|event| event.episode);
        Work {
            steps: report.statistics.steps,
            rejected: report.statistics.rejected,
            evaluations: report.statistics.evaluations,
            contacts: report.clearances.iter().map(|sums| sums.episodes).sum(),
            duration,
            touching: touching / duration / report.clearances.len().max(1) as f64,
            peak_force: episodes.fold(0.0, |peak, episode| peak.max(episode.peak_force)),
            imbalance: report.quality.energy_imbalance.unwrap_or(f64::NAN),
        }
    }
}
