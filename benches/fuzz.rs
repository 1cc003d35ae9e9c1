//! The fuzzer: `cargo bench --bench fuzz -- --mutants 100000 --seed 1 --output DIR`; see `tests/common/fuzz/mod.rs`.
//!
//! | option          | means                                                                        |
//! | --------------- | ---------------------------------------------------------------------------- |
//! | `--mutants N`   | how many [1000]                                                              |
//! | `--seed N`      | of all random numbers [1]                                                    |
//! | `--first N`     | number of the first mutant [0]; with `--mutants 1` it repeats a find         |
//! | `--limit S`     | `max_wall_time` of runs [0.3 s]                                              |
//! | `--only CLASS`  | structure, extremes, tokens, bytes, set or results                                 |
//! | `--process`     | runs the binary instead of calling it: signals, exit statuses, real streams  |
//! | `--output DIR`  | where inputs of finds are written                                            |
//!
//! Exit status 1 where something was found. `cargo bench --profile fuzz --bench fuzz` checks every integer operation besides.

#[path = "../tests/common/fuzz/mod.rs"]
mod fuzz;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use fuzz::{Class, Find, Fuzzer, Mutant, Runner};

/// Inputs that are kept of finds that look alike.
const KEPT: usize = 3;
/// A command that takes longer hangs.
const HANG: Duration = Duration::from_secs(30);

struct Options {
    mutants: u64,
    seed: u64,
    first: u64,
    limit: f64,
    only: Option<String>,
    process: bool,
    output: Option<PathBuf>,
}

fn options() -> Result<Options, String> {
    let mut options = Options {
        mutants: 1000,
        seed: 1,
        first: 0,
        limit: 0.3,
        only: None,
        process: false,
        output: None,
    };
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or(format!("{word} wants a value"));
        let number = |text: String| {
            text.parse::<u64>()
                .map_err(|error| format!("{text}: {error}"))
        };
        match word.as_str() {
            // Cargo says that this is a benchmark.
            "--bench" => {}
            "--mutants" => options.mutants = number(value()?)?,
            "--seed" => options.seed = number(value()?)?,
            "--first" => options.first = number(value()?)?,
            "--limit" => {
                options.limit = value()?
                    .parse()
                    .map_err(|error| format!("--limit: {error}"))?
            }
            "--only" => options.only = Some(value()?),
            "--process" => options.process = true,
            "--output" => options.output = Some(value()?.into()),
            other => return Err(format!("there is no option {other}")),
        }
    }
    Ok(options)
}

fn main() -> ExitCode {
    let options = match options() {
        Ok(options) => options,
        Err(fault) => {
            eprintln!("error: {fault}");
            return ExitCode::from(2);
        }
    };
    let scratch = std::env::temp_dir().join(format!("linkdyn-fuzz-{}", std::process::id()));
    let runner = if options.process {
        Runner::Process(env!("CARGO_BIN_EXE_linkdyn").into())
    } else {
        Runner::Inside
    };
    let fuzzer = Fuzzer::new(options.seed, options.limit, &scratch, runner);
    fuzz::watch(HANG);
    let start = Instant::now();
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    let mut tried = [0_usize; Class::ALL.len()];
    for number in options.first..options.first + options.mutants {
        let mutant = fuzzer.mutant(number);
        if options
            .only
            .as_ref()
            .is_some_and(|only| only != mutant.class.word())
        {
            continue;
        }
        tried[mutant.class as usize] += 1;
        fuzz::at(number);
        for find in fuzzer.try_mutant(number, &mutant) {
            let count = seen.entry(find.signature()).or_default();
            *count += 1;
            if *count <= KEPT {
                tell(&options, number, &mutant, &find);
            }
        }
    }
    let counts: Vec<String> = Class::ALL
        .iter()
        .zip(tried)
        .map(|(class, count)| format!("{} {count}", class.word()))
        .collect();
    println!(
        "{} mutants ({}) in {:.1} s",
        tried.iter().sum::<usize>(),
        counts.join(", "),
        start.elapsed().as_secs_f64()
    );
    let ends = [0, 1, 2, 3]
        .map(|status| format!("{} × {status}", fuzz::ENDS[status].load(Ordering::Relaxed)));
    println!("commands by exit status: {}", ends.join(", "));
    for (signature, count) in &seen {
        println!("{count:6} × {signature}");
    }
    let _ = fs::remove_dir_all(scratch);
    if seen.is_empty() {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

/// A line that repeats the find, and its input.
fn tell(options: &Options, number: u64, mutant: &Mutant, find: &Find) {
    let Find {
        kind,
        command,
        what,
    } = find;
    let (seed, class, of) = (options.seed, mutant.class.word(), &mutant.of);
    println!(
        "FIND {kind}: {what}\n     --seed {seed} --first {number} --mutants 1 ({class} of {of}): {command}"
    );
    let Some(output) = &options.output else {
        return;
    };
    let write = |name: String, content: &[u8]| {
        let written = fs::create_dir_all(output)
            .and_then(|()| fs::write(Path::new(output).join(name), content));
        if let Err(error) = written {
            eprintln!("{}: {error}", output.display());
        }
    };
    match mutant.class {
        Class::Results => {
            write(format!("{number}-results.csv"), &mutant.bytes);
            write(format!("{number}-summary.json"), &mutant.summary);
        }
        Class::Structure | Class::Extremes | Class::Tokens | Class::Bytes | Class::Sets => {
            write(format!("{number}.json"), &mutant.bytes)
        }
    }
    write(
        format!("{number}.txt"),
        format!("{kind}: {what}\n{command}\nsets: {:?}\n", mutant.sets).as_bytes(),
    );
}
