//! The page of `run --watch` in a browser: a save is seen at once, faults stand on the page, what was chosen stays, sliders move the
//! mechanism.

mod door;
mod latency;
mod sliders;
mod watching;

use serde_json::Value;
use std::fs;
use std::time::{Duration, Instant};

use crate::browser::find;
use crate::tab::Tab;
use watching::{Watching, bundled};

/// A command that watches a file, and its page in a browser.
struct Live {
    tab: Tab,
    model: Value,
    watching: Watching,
}

/// Ready to show a report.
const SHOWN: &str = "shown && !coming";
const REPORT: &str =
    "typeof linkdyn === 'object' && document.documentElement.dataset.ready === 'true'";

impl Live {
    /// Begins with a text that is made of a bundled model, or with that itself.
    fn begin(first: impl Fn(&str) -> String) -> Option<Self> {
        let text = bundled("slider-crank");
        let mut live = Live::of(&first(&text))?;
        live.model = serde_json::from_str(&text).expect("JSON");
        Some(live)
    }

    /// Begins with a text.
    fn of(text: &str) -> Option<Self> {
        let browser = find()?;
        let watching = Watching::begin(text);
        Some(Live {
            tab: Tab::open(&browser, &watching.page),
            model: Value::Null,
            watching,
        })
    }

    /// Saves the model by another name, and waits for its report; how long the page took to know, and to show it.
    fn save(&mut self, name: &str, number: usize) -> [Duration; 2] {
        self.model["name"] = name.into();
        let begun = Instant::now();
        fs::write(&self.watching.model, self.model.to_string()).expect("written");
        self.tab.wait(&format!("last === {number}"));
        let known = begun.elapsed();
        self.tab.wait(&format!("pictured === {number} && !coming"));
        [known, begun.elapsed()]
    }

    /// The value of a script in the report.
    fn report(&mut self, script: &str) -> Value {
        self.tab.value_in_frame(REPORT, script)
    }

    /// Waits until a script is true in the report.
    fn wait_in_report(&mut self, script: &str) {
        let begun = Instant::now();
        while self.report(script) != true {
            assert!(begun.elapsed() < Duration::from_secs(60), "{script}");
            std::thread::sleep(Duration::from_millis(5));
        }
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
    live.report(CHOOSE);
    let before = live.report(CHOSEN);
    let said = before.as_str().expect("a text");
    assert!(
        said.starts_with("[100,") && said.contains("[20,200]") && said.ends_with("true,true]"),
        "{said}"
    );
    live.save("Again", 2);
    assert_eq!(live.report(CHOSEN), before);
    let title = live.report("document.title");
    assert!(title.as_str().is_some_and(|own| own.starts_with("Again")));

    // Another mechanism is another page, with the same choice.
    live.model["bodies"]["ground"]["points"]["new"] = serde_json::json!([0, 0]);
    live.save("Larger", 3);
    assert_eq!(live.report(CHOSEN), before);
    let title = live.report("document.title");
    assert!(title.as_str().is_some_and(|own| own.starts_with("Larger")));

    let typo = live
        .model
        .to_string()
        .replacen("\"revolute\"", "\"revolut\"", 1);
    fs::write(&live.watching.model, typo).expect("written");
    live.tab
        .wait("faults.textContent.includes('did you mean \"revolute\"?')");
    assert_eq!(live.tab.value("faults.offsetHeight > 20 && last"), 3);
    let below = live.report("document.title");
    assert_eq!(below, title, "the run before is still there");
    live.save("Right", 4);
    assert_eq!(live.tab.value("faults.textContent"), "");
    assert_eq!(live.report(CHOSEN), before);
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
    let title = live.report("document.title");
    assert!(title.as_str().is_some_and(|own| own.starts_with("Right")));
}
