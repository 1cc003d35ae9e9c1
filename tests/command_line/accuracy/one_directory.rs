//! `run -o` and `accuracy -o` into one directory: each says when it takes the other's page.

use super::FOUR_BAR;
use crate::browser::Scratch;
use std::process::{Command, Stdio};

#[test]
fn a_page_of_another_kind_is_not_replaced_without_a_word() {
    let scratch = Scratch::new("accuracy-one-directory");
    let page = scratch.0.join("report.html");
    let say = |command: &str, more: &[&str]| {
        let mut line = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
        line.arg(command).args(FOUR_BAR).arg("-o").arg(&scratch.0);
        let output = line.args(more).stdin(Stdio::null()).output();
        let output = output.expect("the binary runs");
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stderr).expect("UTF-8")
    };
    let note = |of: &str, does: &str| {
        let page = page.display();
        format!(
            "note: {page} is the page of `linkdyn {of}`, and is {does}; another directory keeps both\n"
        )
    };
    assert_eq!(say("accuracy", &[]), "");
    assert_eq!(say("accuracy", &[]), "");
    assert_eq!(say("run", &[]), note("accuracy", "replaced"));
    assert_eq!(say("run", &[]), "");
    assert_eq!(say("accuracy", &[]), note("run", "replaced"));
    assert_eq!(say("run", &["--no-report"]), note("accuracy", "removed"));
    assert!(!page.exists());
}
