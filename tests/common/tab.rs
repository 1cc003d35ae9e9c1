//! A tab of a headless browser that stays open while real time passes, driven by the pipe of its debugging protocol.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::browser::{Scratch, command};

/// How long a tab may take to come to something.
const LONGEST: Duration = Duration::from_secs(60);

/// The tab; its browser ends with it.
pub struct Tab {
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
    session: Option<String>,
    number: u64,
    /// Of the page and of the frames in it, the youngest last.
    contexts: Vec<u64>,
    _profile: Scratch,
}

impl Tab {
    /// Opens a file.
    pub fn open(browser: &Path, file: &Path) -> Self {
        let profile = Scratch::new("tab");
        let asked = command(browser, &profile.0);
        // The protocol's pipes are 3 and 4.
        let mut child = Command::new("sh")
            .args(["-c", "exec \"$0\" \"$@\" 3<&0 4>&1 0</dev/null 1>&2"])
            .arg(asked.get_program())
            .args(asked.get_args())
            .args(["--remote-debugging-pipe", "about:blank"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("it starts");
        let mut tab = Tab {
            to: child.stdin.take().expect("piped"),
            from: BufReader::new(child.stdout.take().expect("piped")),
            child,
            session: None,
            number: 0,
            contexts: Vec::new(),
            _profile: profile,
        };
        let all = tab.ask("Target.getTargets", json!({}));
        let all = all["targetInfos"].as_array().expect("a list");
        let page = all.iter().find(|target| target["type"] == "page");
        let page = &page.expect("a page")["targetId"];
        let given = json!({ "targetId": page, "flatten": true });
        let session = tab.ask("Target.attachToTarget", given);
        tab.session = session["sessionId"].as_str().map(Into::into);
        tab.ask("Page.enable", json!({}));
        tab.ask("Runtime.enable", json!({}));
        let url = format!("file://{}", file.display());
        tab.ask("Page.navigate", json!({ "url": url }));
        tab
    }

    /// The result of a method of the protocol; null where it fails.
    fn ask(&mut self, method: &str, given: Value) -> Value {
        self.number += 1;
        let mut asked = json!({ "id": self.number, "method": method, "params": given });
        if let Some(session) = &self.session {
            asked["sessionId"] = session.as_str().into();
        }
        self.to
            .write_all(format!("{asked}\0").as_bytes())
            .expect("it listens");
        loop {
            let mut text = Vec::new();
            self.from.read_until(0, &mut text).expect("it speaks");
            text.pop();
            let mut said: Value = serde_json::from_slice(&text).expect("JSON");
            if said["id"] == self.number {
                return said["result"].take();
            }
            let told = &said["params"];
            match said["method"].as_str() {
                Some("Runtime.executionContextCreated") => {
                    self.contexts.extend(told["context"]["id"].as_u64());
                }
                Some("Runtime.executionContextDestroyed") => {
                    let gone = told["executionContextId"].as_u64();
                    self.contexts.retain(|own| Some(*own) != gone);
                }
                Some("Runtime.executionContextsCleared") => self.contexts.clear(),
                _ => {}
            }
        }
    }

    /// The value of a script in the page.
    pub fn value(&mut self, script: &str) -> Value {
        let given = json!({ "expression": script, "returnByValue": true });
        self.ask("Runtime.evaluate", given)["result"]["value"].take()
    }

    /// The value of a script in the youngest frame in which `there` is true.
    pub fn value_in_frame(&mut self, there: &str, script: &str) -> Value {
        self.value("0");
        for context in self.contexts.clone().into_iter().rev() {
            let mut ask = |script: &str| {
                let given =
                    json!({ "expression": script, "returnByValue": true, "contextId": context });
                self.ask("Runtime.evaluate", given)["result"]["value"].take()
            };
            if ask(there) == true {
                return ask(script);
            }
        }
        panic!("{there}: true in no frame");
    }

    /// Waits until a script is true in the page.
    pub fn wait(&mut self, script: &str) {
        let begun = Instant::now();
        while self.value(script) != true {
            assert!(begun.elapsed() < LONGEST, "{script}: never true");
            sleep(Duration::from_millis(2));
        }
    }
}

impl Drop for Tab {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
