//! What helps to use the command: pages of the book, completions, manual pages.

use super::*;

const COMMANDS: [&str; 24] = [
    "accuracy",
    "allocate",
    "new",
    "run",
    "check",
    "edit",
    "export",
    "import",
    "compare",
    "modes",
    "study",
    "optimise",
    "assemblies",
    "synthesise",
    "chains",
    "path-time",
    "plot",
    "animate",
    "validate",
    "models",
    "schema",
    "docs",
    "completions",
    "man",
];

#[test]
fn every_page_of_the_book_is_listed_and_printed() {
    let told = done(&["docs"]);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let mut pages = 0;
    for entry in fs::read_dir(folder).expect("docs") {
        let path = entry.expect("readable").path();
        let name = path.file_stem().expect("a name").to_string_lossy();
        // README.md is the list itself.
        if path.extension().is_none_or(|extension| extension != "md") || name == "README" {
            continue;
        }
        let listed = told
            .lines()
            .any(|line| line.starts_with(&format!("{name} ")));
        assert!(listed, "{name} is not in {told}");
        assert_eq!(
            done(&["docs", &name]),
            fs::read_to_string(&path).expect("readable")
        );
        pages += 1;
    }
    assert_eq!(told.lines().count(), pages + 1, "{told}");
    refused(&["docs", "tutorail"], 2, "did you mean \"tutorial\"?");
}

#[test]
fn each_shell_gets_a_script_that_knows_every_command() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = done(&["completions", shell]);
        for name in COMMANDS {
            assert!(script.contains(name), "{shell}: {name}");
        }
        assert!(script.contains("no-report"), "{shell}");
    }
    refused(&["completions", "tcsh"], 2, "bash");
}

/// What the script of bash proposes for a line, as far as typed.
#[cfg(unix)]
fn proposed(script: &str, line: &[&str]) -> Option<String> {
    let words = line.join(" ");
    let last = line.len() - 1;
    let asked = format!(
        "source {script}; COMP_WORDS=({words}); COMP_CWORD={last}; _linkdyn linkdyn \"{}\" \"{}\"; echo \"${{COMPREPLY[@]}}\"",
        line[last],
        line[last - 1]
    );
    let output = Command::new("bash").args(["-c", &asked]).output().ok()?;
    assert!(output.status.success(), "{output:?}");
    Some(String::from_utf8(output.stdout).expect("UTF-8"))
}

#[test]
#[cfg(unix)]
fn bash_completes_with_it() {
    let scratch = Scratch::new("bash");
    let script = scratch.write("linkdyn.bash", &done(&["completions", "bash"]));
    // Without bash there is nobody to complete.
    let Some(commands) = proposed(&script, &["linkdyn", "comp"]) else {
        return;
    };
    assert_eq!(commands.trim(), "compare completions");
    let options = proposed(&script, &["linkdyn", "run", "--no"]);
    assert_eq!(options.as_deref().map(str::trim), Some("--no-report"));
}

#[test]
fn manual_pages_tell_every_command_and_its_options() {
    let whole = done(&["man"]);
    assert!(whole.contains(".TH linkdyn 1"), "{whole}");
    for name in COMMANDS {
        let name = name.replace('-', "\\-");
        assert!(
            whole.contains(&format!("linkdyn\\-{name}(1)")),
            "{name}: {whole}"
        );
    }
    let page = done(&["man", "run"]);
    assert!(page.contains("\\-\\-no\\-report") && page.contains("linkdyn\\-run"));
    refused(&["man", "anmiate"], 2, "did you mean \"animate\"?");

    let scratch = Scratch::new("man");
    let told = done(&["man", "-o", &scratch.path("man1")]);
    let mut names = vec!["linkdyn.1".to_string()];
    names.extend(COMMANDS.map(|name| format!("linkdyn-{name}.1")));
    assert_eq!(told.lines().count(), names.len(), "{told}");
    for name in names {
        let text = fs::read_to_string(scratch.0.join("man1").join(&name)).expect("written");
        assert!(text.contains(".SH NAME"), "{name}: {text}");
    }
}
