//! The pages that `linkdyn validate -o` leaves, in a browser.

use std::fs;
use std::process::{Command, Stdio};

use crate::browser::{Scratch, ask_in, find};
use serde_json::{Value, json};

/// Tells what a page says and whether it fits into the window.
const LOOK: &str = "const texts = (what) => [...document.querySelectorAll(what)].map((node) => node.textContent); \
    answer({ width: innerWidth, scroll_width: document.documentElement.scrollWidth, sentence: texts('.sentence')[0], \
    headings: texts('summary h2'), open: [...document.querySelectorAll('details')].map((node) => node.open), \
    verdicts: texts('.verdict'), links: [...document.querySelectorAll('a')].map((node) => node.getAttribute('href')), \
    cells: texts('#cases tbody tr').length, first: document.querySelector('td').getBoundingClientRect().top, \
    requests: performance.getEntriesByType('resource').length });";

/// Looks at a page in a window; a page without scripts has to allow the one that looks.
fn look(page: &str, size: [u32; 2]) -> Option<Value> {
    let browser = find()?;
    assert!(!page.contains("<script"), "the page needs no script");
    let page = page.replacen("script-src 'none'", "script-src ", 1);
    let (told, visit) = ask_in(&browser, &page, LOOK, Some(1000), size);
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    Some(told)
}

#[test]
fn pages_tell_verdicts_in_words() {
    let scratch = Scratch::new("validate");
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.args(["validate", "restitution", "four-bar", "-o"]);
    let output = command
        .arg(&scratch.0)
        .stdin(Stdio::null())
        .output()
        .expect("the binary runs");
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{told}");
    assert!(
        told.contains("A finding is a difference to the reference that is explained"),
        "{told}"
    );
    let read = |name: &str| fs::read_to_string(scratch.0.join(name)).expect(name);
    let claims: Value = serde_json::from_str(&read("restitution/claims.json")).expect("JSON");
    let verdicts = |of: &str| {
        let claims = claims.as_array().expect("claims").iter();
        claims.filter(|claim| claim["verdict"] == of).count()
    };
    let (agreed, findings) = (verdicts("agrees"), verdicts("finding"));
    assert!(agreed > 0 && findings > 1, "{claims:#}");
    for size in [[1280, 720], [390, 844]] {
        let Some(found) = look(&read("restitution/report.html"), size) else {
            return;
        };
        let all = agreed + findings;
        let sentence = format!(
            "{agreed} of {all} comparisons agree, {findings} differ for reasons that are explained. No error of linkdyn was found."
        );
        assert_eq!(found["sentence"], sentence);
        assert_eq!(
            found["headings"],
            json!(["What differs, and why", "What agrees"])
        );
        assert_eq!(found["open"], json!([true, false]));
        assert_eq!(found["verdicts"].as_array().map(Vec::len), Some(all));
        let index = look(&read("index.html"), size).expect("a browser");
        assert_eq!(
            index["links"],
            json!(["restitution/report.html", "four-bar/report.html"])
        );
        assert_eq!(index["cells"], 2);
        for found in [&found, &index] {
            let number = |key: &str| found[key].as_f64().expect("a number");
            assert!(
                number("scroll_width") <= number("width"),
                "{size:?}: {found:#}"
            );
            assert!(number("first") < f64::from(size[1]), "{size:?}: {found:#}");
            assert_eq!(found["requests"], 0);
        }
    }
    // A reference case says who computed its reference.
    assert!(read("four-bar/report.html").contains("Reference: "));
}
