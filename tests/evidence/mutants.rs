//! A share of the fuzzer's mutants (`cargo bench --bench fuzz` has more): nothing panics, hangs or leaves a number that does not exist.

use std::path::Path;

use crate::fuzz::{Fuzzer, Runner};

/// Tries mutants; what was found, a line each.
fn finds(runner: Runner, name: &str, seed: u64, mutants: u64) -> Vec<String> {
    let scratch =
        Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{}-{name}", std::process::id()));
    let fuzzer = Fuzzer::new(seed, 0.1, &scratch, runner);
    let mut told = Vec::new();
    for number in 0..mutants {
        let mutant = fuzzer.mutant(number);
        for find in fuzzer.try_mutant(number, &mutant) {
            told.push(format!(
                "{number} ({} of {}): {find:?}",
                mutant.class.word(),
                mutant.of
            ));
        }
    }
    std::fs::remove_dir_all(scratch).expect("removed");
    told
}

#[test]
fn no_mutant_breaks_a_command() {
    let told = finds(Runner::Inside, "inside", 1, 1200);
    assert!(told.is_empty(), "{}", told.join("\n"));
}

/// The binary ends by an exit status of the contract, not by a signal.
#[test]
fn no_mutant_kills_the_binary() {
    let told = finds(
        Runner::Process(env!("CARGO_BIN_EXE_linkdyn").into()),
        "process",
        4,
        100,
    );
    assert!(told.is_empty(), "{}", told.join("\n"));
}

/// The checks see what they should: a mutant is the same each time, and there are all kinds.
#[test]
fn mutants_repeat() {
    let scratch =
        Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{}-repeat", std::process::id()));
    let [one, two] = [3, 3].map(|seed| Fuzzer::new(seed, 0.1, &scratch, Runner::Inside));
    let differs = (0..200).filter(|&number| {
        let (a, b) = (one.mutant(number), two.mutant(number));
        assert!(
            (&a.bytes, &a.summary, &a.sets) == (&b.bytes, &b.summary, &b.sets),
            "mutant {number}"
        );
        let next = one.mutant(number + 10);
        (a.bytes, a.sets, a.summary) != (next.bytes, next.sets, next.summary)
    });
    assert!(differs.count() > 190);
    std::fs::remove_dir_all(scratch).expect("removed");
}
