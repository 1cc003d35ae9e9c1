//! The page of `run --watch` in a browser: a save is seen at once, faults stand on the page, what was chosen stays.

use crate::browser::{Scratch, find};
use crate::tab::Tab;
use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A command that watches a file, and its page in a browser.
struct Live {
    tab: Tab,
    model: Value,
    path: PathBuf,
    child: Child,
    _scratch: Scratch,
}

/// Ready to show a report.
const SHOWN: &str = "shown && !coming";
const REPORT: &str =
    "typeof linkdyn === 'object' && document.documentElement.dataset.ready === 'true'";

impl Live {
    /// Begins with the text that is made of a bundled model.
    fn begin(first: impl Fn(&str) -> String) -> Option<Self> {
        let browser = find()?;
        let scratch = Scratch::new("live");
        let linkdyn = || Command::new(env!("CARGO_BIN_EXE_linkdyn"));
        let text = linkdyn().args(["models", "slider-crank"]).output();
        let text = String::from_utf8(text.expect("it runs").stdout).expect("UTF-8");
        let path = scratch.0.join("mine.json");
        fs::write(&path, first(&text)).expect("written");
        let out = scratch.0.join("out");
        let child = linkdyn()
            .arg("run")
            .arg(&path)
            .args(["--watch", "-o"])
            .arg(&out)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("it runs");
        let begun = Instant::now();
        while !out.join("live.js").exists() {
            assert!(begun.elapsed() < Duration::from_secs(60), "no page");
            std::thread::sleep(Duration::from_millis(10));
        }
        Some(Live {
            tab: Tab::open(&browser, &out.join("live.html")),
            model: serde_json::from_str(&text).expect("JSON"),
            path,
            child,
            _scratch: scratch,
        })
    }

    /// Saves the model by another name, and waits for its report; how long the page took to know, and to show it.
    fn save(&mut self, name: &str, number: usize) -> [Duration; 2] {
        self.model["name"] = name.into();
        let begun = Instant::now();
        fs::write(&self.path, self.model.to_string()).expect("written");
        self.tab.wait(&format!("last === {number}"));
        let known = begun.elapsed();
        let report = format!("shown.src.split('#')[0].endsWith('?{number}')");
        self.tab.wait(&format!("{SHOWN} && {report}"));
        [known, begun.elapsed()]
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// What a reader chooses, and what the report says of it.
const CHOOSE: &str = "linkdyn.player.seek(100); linkdyn.plots.remove(linkdyn.plots.list[0]); \
    linkdyn.plots.open([linkdyn.byName.get('joint.main.f')]); linkdyn.plots.setZoom([20, 200]); linkdyn.stage.zoom(1.5); \
    document.getElementById('arrows').click(); document.getElementById('theme').click()";
const CHOSEN: &str = "JSON.stringify([linkdyn.player.row, linkdyn.plots.list.map((plot) => plot.columns.map(({ name }) => name)), \
    linkdyn.plots.zoom, linkdyn.stage.view, linkdyn.stage.options.arrows, linkdyn.theme.dark])";

#[test]
fn what_is_chosen_stays_and_faults_stand_on_the_page() {
    let Some(mut live) = Live::begin(str::to_owned) else {
        return;
    };
    live.tab.wait(SHOWN);
    live.tab.value_in_frame(REPORT, CHOOSE);
    let before = live.tab.value_in_frame(REPORT, CHOSEN);
    let said = before.as_str().expect("a text");
    assert!(
        said.starts_with("[100,") && said.contains("[20,200]") && said.ends_with("true,true]"),
        "{said}"
    );
    live.save("Again", 2);
    assert_eq!(live.tab.value_in_frame(REPORT, CHOSEN), before);
    let title = live.tab.value_in_frame(REPORT, "document.title");
    assert!(title.as_str().is_some_and(|own| own.starts_with("Again")));

    let typo = live
        .model
        .to_string()
        .replacen("\"revolute\"", "\"revolut\"", 1);
    fs::write(&live.path, typo).expect("written");
    live.tab
        .wait("faults.textContent.includes('did you mean \"revolute\"?')");
    assert_eq!(live.tab.value("faults.offsetHeight > 20 && last"), 2);
    let below = live.tab.value_in_frame(REPORT, "document.title");
    assert_eq!(below, title, "the run before is still there");
    live.save("Right", 3);
    assert_eq!(live.tab.value("faults.textContent"), "");
    assert_eq!(live.tab.value_in_frame(REPORT, CHOSEN), before);
}

/// At most 100 ms from a save until the page knows of the run, twice that where other tests share the processors; a page that asks
/// from time to time needs longer. Of several the quickest.
#[test]
fn a_save_is_seen_at_once() {
    let Some(mut live) = Live::begin(str::to_owned) else {
        return;
    };
    live.tab.wait(SHOWN);
    let times = (2..8).map(|number| live.save(&format!("Save {number}"), number));
    let times: Vec<[Duration; 2]> = times.collect();
    println!("known and shown after {times:?}");
    let known = times.iter().map(|own| own[0]).min().expect("some");
    assert!(known < Duration::from_millis(200), "{times:?}");
}

#[test]
fn a_page_that_begins_with_a_fault_shows_it_and_then_the_report() {
    let Some(mut live) = Live::begin(|text| format!("{text} }}")) else {
        return;
    };
    live.tab
        .wait("faults.textContent.includes('mine.json: line')");
    assert_eq!(live.tab.value("[shown, last].join()"), ",0");
    live.save("Right", 1);
    let title = live.tab.value_in_frame(REPORT, "document.title");
    assert!(title.as_str().is_some_and(|own| own.starts_with("Right")));
}
