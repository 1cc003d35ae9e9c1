//! `linkdyn validate`: the bundled cases, each claim as reference, ours, difference, verdict.

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Instant;

use clap::Args;

use super::exit::{BadInput, Exit, Failure};
use super::interrupt;
use super::progress::Line;
use super::streams::{complain, print};
use linkdyn_ask::near::nearest;
use linkdyn_ask::text::{Page, count, wrapped};
use linkdyn_engine::analysis::Control;
use linkdyn_output::Directory;
use linkdyn_picture::validate_page::{Counts, IndexPage, IndexRow, MEANINGS};
use linkdyn_validation::{CASES, Case, CaseError, Claim};

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    /// Cases to run; all where none is named
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// Write each case's files into a directory of its name below this one, and index.html, a page over the cases
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// The page over the cases.
const INDEX: &str = "index.html";
/// Letters in a line of words.
const WIDTH: usize = 100;

const HELP: &str = "  linkdyn validate lock-ideal
  linkdyn validate lock -o out

What the cases are, and what is not reproduced: linkdyn docs validation.";

/// Runs the cases and tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let started = Instant::now();
    let cases = choose(CASES, &options.cases)?;
    if let Some(output) = &options.output {
        Directory::open(output)?;
    }
    let control = Control {
        interrupted: interrupt::watch(),
        ..Control::default()
    };
    let mut index = IndexPage::default();
    let whole = cases.len();
    for case in cases {
        if control.interrupted.load(Ordering::SeqCst) {
            return interrupted(index.cases.len(), whole);
        }
        let mut page = Page::default();
        page.line(format!("{}: {}", case.name, case.about()));
        let share = index.cases.len() as f64 / whole as f64;
        let line = Line::start(started, case.name, move || Some(share));
        let report = case.run(options.output.as_deref(), &control);
        drop(line);
        let ended = match report {
            Ok(report) => {
                report.text.lines().for_each(|line| page.line(line));
                Ok(tell(&mut page, &report.claims))
            }
            Err(CaseError::Interrupted) => return interrupted(index.cases.len(), whole),
            Err(CaseError::Write(error)) => return Err(error.into()),
            Err(CaseError::Broken(said)) => {
                complain(&format!("{}: the case can't be run: {said}", case.name));
                Err(said)
            }
        };
        print(page.text())?;
        index.cases.push(IndexRow {
            name: case.name.to_string(),
            about: case.about(),
            ended,
        });
        // After each case, so that a long run can be looked at, and an interrupted one too.
        if let Some(output) = &options.output {
            write(output, &index)?;
        }
    }
    let tally = tally(&index);
    print(&text(tally))?;
    Ok(exit(tally))
}

/// Writes the page over the cases.
fn write(output: &Path, index: &IndexPage) -> Result<(), Failure> {
    Directory::open(output)?.write(INDEX, index.html().as_bytes())?;
    Ok(())
}

/// Tells how many cases are done.
fn interrupted(done: usize, whole: usize) -> Result<Exit, Failure> {
    complain(&format!(
        "interrupted after {done} of {}",
        count(whole, "case")
    ));
    Ok(Exit::Interrupted)
}

/// The cases of these names, or all.
fn choose<'a>(cases: &'a [Case], names: &[String]) -> Result<Vec<&'a Case>, Failure> {
    if names.is_empty() {
        return Ok(cases.iter().collect());
    }
    let find = |name: &String| {
        cases
            .iter()
            .find(|case| case.name == name)
            .ok_or_else(|| unknown(cases, name))
    };
    let (found, missing): (Vec<_>, Vec<_>) = names.iter().map(find).partition(Result::is_ok);
    let missing: Vec<String> = missing.into_iter().filter_map(Result::err).collect();
    if missing.is_empty() {
        Ok(found.into_iter().flatten().collect())
    } else {
        Err(BadInput(missing))
    }
}

fn unknown(cases: &[Case], name: &str) -> String {
    let known: Vec<&str> = cases.iter().map(|case| case.name).collect();
    let hint = match nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean {near:?}?"),
        None if known.is_empty() => "none is bundled".into(),
        None => format!("there are: {}", known.join(", ")),
    };
    format!("{name}: no validation case of that name ({hint})")
}

/// How many claims ended how; a case that can't be run is a fault.
fn tally(index: &IndexPage) -> Counts {
    let broken = Counts {
        faults: 1,
        ..Counts::default()
    };
    let counts = index.cases.iter().map(|case| &case.ended);
    Counts::sum(counts.map(|ended| ended.as_ref().map_or(broken, |counts| *counts)))
}

fn text(tally: Counts) -> String {
    let Counts {
        agreed,
        findings,
        faults,
    } = tally;
    let line = format!(
        "{agreed} agreed, {}, {}\n",
        count(findings, "finding"),
        count(faults, "fault")
    );
    // Who reads "33 findings" thinks of errors.
    match findings + faults {
        0 => line,
        _ => format!("{line}{}\n", wrapped(MEANINGS, WIDTH).join("\n")),
    }
}

fn exit(tally: Counts) -> Exit {
    if tally.faults > 0 {
        Exit::Fault
    } else {
        Exit::Done
    }
}

/// The claims, counted.
fn tell(page: &mut Page, claims: &[Claim]) -> Counts {
    let mut counts = Counts::default();
    for claim in claims {
        counts.add(claim.verdict.into());
        claim.lines().iter().for_each(|line| page.line(line));
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkdyn_validation::{CaseKind, CaseReport, Setting, Verdict};

    fn none(_: &Setting) -> Result<CaseReport, CaseError> {
        Ok(CaseReport::default())
    }

    const DUMMIES: [Case; 2] = [
        Case {
            name: "lock",
            kind: CaseKind::Coded {
                about: "",
                run: none,
            },
        },
        Case {
            name: "four-bar",
            kind: CaseKind::Coded {
                about: "",
                run: none,
            },
        },
    ];

    fn names(names: &[&str]) -> Result<Vec<&'static str>, Failure> {
        let names: Vec<String> = names.iter().map(|name| name.to_string()).collect();
        choose(&DUMMIES, &names).map(|cases| cases.iter().map(|case| case.name).collect())
    }

    #[test]
    fn cases_are_chosen_by_name() {
        assert_eq!(names(&[]), Ok(vec!["lock", "four-bar"]));
        assert_eq!(names(&["four-bar"]), Ok(vec!["four-bar"]));
    }

    #[test]
    fn unknown_cases_are_all_named() {
        let Err(BadInput(said)) = names(&["lokc", "lock", "zzz"]) else {
            panic!("must be refused")
        };
        assert_eq!(
            said,
            [
                "lokc: no validation case of that name (did you mean \"lock\"?)",
                "zzz: no validation case of that name (there are: lock, four-bar)"
            ]
        );
    }

    #[test]
    fn a_fault_and_only_a_fault_is_exit_status_1() {
        for (verdict, exit) in [
            (Verdict::Agrees, Exit::Done),
            (Verdict::Finding("It is known why."), Exit::Done),
            (Verdict::Fault, Exit::Fault),
        ] {
            let text = || "x".to_string();
            let claim = Claim {
                what: text(),
                reference: text(),
                ours: text(),
                difference: text(),
                verdict,
            };
            let tally = tell(&mut Page::default(), &[claim]);
            assert_eq!(super::exit(tally), exit, "{verdict:?}");
        }
    }

    #[test]
    fn findings_are_explained_beside_their_number() {
        let counts = |findings| Counts {
            agreed: 2,
            findings,
            faults: 0,
        };
        assert_eq!(text(counts(0)), "2 agreed, 0 findings, 0 faults\n");
        let told = text(counts(1));
        assert!(
            told.starts_with("2 agreed, 1 finding, 0 faults\nA finding is"),
            "{told}"
        );
        assert!(
            told.lines().all(|line| line.chars().count() <= WIDTH),
            "{told}"
        );
    }
}
