//! Films of all bundled models.

use std::fs;
use std::path::Path;
use std::process::Command;

/// A film fits into a mail and a slide: 2 MB at most for each bundled model, by default.
#[test]
fn films_of_bundled_models_are_small() {
    let name = format!("films-{}", std::process::id());
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&scratch).expect("a scratch directory");
    let linkdyn = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
        let output = command
            .args(arguments)
            .current_dir(&scratch)
            .output()
            .expect("the binary runs");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{arguments:?}: {said}");
    };
    for model in linkdyn_model::bundled::names() {
        linkdyn(&["run", model, "-o", model, "--no-report"]);
        linkdyn(&["animate", model, "-o", "film.gif"]);
        let bytes = fs::read(scratch.join("film.gif")).expect("a film");
        assert!(bytes.starts_with(b"GIF89a"), "{model}");
        assert!(bytes.len() <= 2_000_000, "{model}: {} bytes", bytes.len());
    }
    fs::remove_dir_all(&scratch).expect("removed");
}
