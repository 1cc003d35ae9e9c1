//! README.md: its models run, its commands run as written, its tables name what there is.

use linkdyn_engine::analysis::{Control, run};
use linkdyn_output::Status;
use linkdyn_validation::{CASES, CaseKind};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

fn readme() -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).expect("README.md")
}

/// Contents of the fenced blocks of a language.
fn blocks(text: &str, language: &str) -> Vec<String> {
    let open = format!("```{language}\n");
    let blocks = text.split(open.as_str()).skip(1);
    blocks
        .map(|rest| rest.split("```").next().unwrap_or_default().to_string())
        .collect()
}

#[test]
fn its_models_run() {
    let models = blocks(&readme(), "json");
    assert_eq!(models.len(), 2);
    for model in &models {
        let loaded = linkdyn_model::load(model.as_bytes(), &[]).expect("a sound model");
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
        let outcome = run(&loaded.model, &Control::default()).expect("runs");
        assert_eq!(
            (outcome.report.status, outcome.report.warnings.len()),
            (Status::Completed, 0)
        );
    }
}

/// The slider-crank of parameters: r = 50 mm and l = 4 r, one turn in 1 s, and the stroke 2 r in closed form.
#[test]
fn its_parameters_size_the_mechanism() {
    for (sets, r) in [
        (vec![], 0.05),
        (vec!["parameters.r=60 mm".to_string()], 0.06),
    ] {
        let loaded = linkdyn_model::load(blocks(&readme(), "json")[1].as_bytes(), &sets)
            .expect("a sound model");
        let trajectory = run(&loaded.model, &Control::default())
            .expect("runs")
            .trajectory;
        let times = trajectory.values("time").expect("always there");
        let slide = trajectory.values("piston.x").expect("a body");
        assert_eq!((times.len(), times[360]), (361, 1.0));
        for (time, x) in times.iter().zip(slide) {
            let angle = std::f64::consts::TAU * time;
            let exact = r * angle.cos() + (16.0 * r * r - (r * angle.sin()).powi(2)).sqrt();
            assert!(
                (x - exact).abs() < 1e-12,
                "{x} instead of {exact} at {time} s"
            );
        }
        assert_eq!(loaded.model.bodies["rod"].mass, Some(8.0 * (4.0 * r)));
    }
}

/// The words of a command line, as a shell splits it.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            _ => words.last_mut().expect("one").push(c),
        }
    }
    words
}

#[test]
fn its_commands_run_as_written() {
    let scratch =
        Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("readme-{}", std::process::id()));
    fs::create_dir_all(&scratch).expect("a scratch directory");
    let text = readme();
    let blocks = blocks(&text, "sh");
    // The two commands for a fresh machine, one block each, first of all.
    assert_eq!(blocks[0], "cargo run --release -- run lock -o out\n");
    assert_eq!(blocks[1], "cargo test --release\n");
    let mut ran = 0;
    for line in blocks.iter().flat_map(|block| block.lines()) {
        let Some(arguments) = line.strip_prefix("cargo run --release -- ") else {
            let benches = ["six_bar", "dynamics", "contact"]
                .map(|name| format!("cargo bench --bench {name}"));
            let others = [&["cargo test --release".to_string()][..], &benches].concat();
            assert!(others.iter().any(|other| other == line), "{line}");
            continue;
        };
        let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
        command
            .args(words(arguments))
            // Every case is run by `tests/evidence`, once; here some of them, of both kinds.
            .args(match arguments {
                "validate" => &["four-bar", "four-bar-spring"][..],
                _ => &[],
            })
            .current_dir(&scratch)
            .stdin(Stdio::null());
        let output = command.output().expect("the binary runs");
        assert!(
            output.status.success(),
            "{line}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
        if arguments.ends_with("-o out") {
            let files: &[&str] = if arguments.starts_with("run") {
                &["results.csv", "summary.json", "report.html"]
            } else {
                &["lock/report.md"]
            };
            for file in files {
                assert!(
                    scratch.join("out").join(file).exists(),
                    "{line} leaves no {file}"
                );
            }
            fs::remove_dir_all(scratch.join("out")).expect("removed");
        }
        ran += 1;
    }
    fs::remove_dir_all(&scratch).expect("removed");
    assert!(ran >= 6, "only {ran} commands were found");
}

#[test]
fn its_validation_table_names_every_reference_case() {
    let text = readme();
    let references = CASES
        .iter()
        .filter(|case| matches!(case.kind, CaseKind::Reference(_)));
    for case in references.filter(|case| !case.name.starts_with("random-")) {
        assert!(
            text.contains(&format!("`{}`", case.name)),
            "{} is missing",
            case.name
        );
    }
}

#[test]
fn its_status_and_event_words_are_ours() {
    let text = readme();
    for status in [
        Status::Completed,
        Status::CompletedWithGaps,
        Status::DeadCentre,
        Status::AssemblyFailed,
        Status::StepTooSmall,
        Status::Singular,
        Status::TimeLimit,
        Status::Interrupted,
    ] {
        assert!(
            text.contains(&format!("| `{}` |", status.word())),
            "{status:?} is missing"
        );
    }
}
