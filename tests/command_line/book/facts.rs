//! Facts of the pages that are no block: the two commands, tables that name what there is.

use linkdyn_engine::analysis::{Control, run};
use linkdyn_model::bundled;
use linkdyn_output::Status;
use linkdyn_validation::{CASES, CaseKind};

use super::blocks::blocks;
use super::page;

/// The two commands for a fresh machine, one block each, first of all.
#[test]
fn two_commands_stand_first() {
    let blocks = blocks(&page("README.md"));
    let mut shell = blocks.iter().filter(|block| block.words[0] == "sh");
    for wanted in [
        "cargo run --release -- run lock -o out\n",
        "cargo test --release\n",
    ] {
        assert_eq!(shell.next().map(|block| block.body.as_str()), Some(wanted));
    }
}

/// The slider-crank of parameters: r = 50 mm and l = 4 r, one turn in 1 s, and the stroke 2 r in closed form.
#[test]
fn parameters_size_the_mechanism() {
    let blocks = blocks(&page("docs/format.md"));
    let block = blocks.iter().find(|block| block.is("apart"));
    let text = &block.expect("a model with parameters").body;
    for (sets, r) in [
        (vec![], 0.05),
        (vec!["parameters.r=60 mm".to_string()], 0.06),
    ] {
        let loaded = linkdyn_model::load(text.as_bytes(), &sets).expect("a sound model");
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

#[test]
fn the_validation_page_names_every_case() {
    let text = page("docs/validation.md");
    for case in CASES
        .iter()
        .filter(|case| !case.name.starts_with("random-"))
    {
        let named = match case.kind {
            CaseKind::Reference(_) => format!("`{}`", case.name),
            CaseKind::Coded { .. } => format!("validate {}`", case.name),
        };
        assert!(text.contains(&named), "{} is missing", case.name);
    }
}

#[test]
fn the_results_page_names_every_status() {
    let text = page("docs/results.md");
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

#[test]
fn the_models_page_names_every_model() {
    let text = page("docs/models.md");
    for model in bundled::MODELS {
        let names = std::iter::once(&model.name).chain(model.aliases);
        for name in names {
            assert!(text.contains(&format!("`{name}`")), "{name} is missing");
        }
        assert!(text.contains(&format!("models/{}.png", model.name)));
    }
    let introduction = page("README.md");
    let count = format!("{} models come with linkdyn", bundled::MODELS.len());
    assert!(introduction.contains(&count), "not {count}");
}
