//! The command that watches a file.

use std::fs;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::browser::Scratch;

/// `run mine.json -o out --watch`, until it is dropped.
pub struct Watching {
    /// The model's file.
    pub model: PathBuf,
    /// The page that leads to the one that is served.
    pub page: PathBuf,
    child: Child,
    _scratch: Scratch,
}

/// The text of a bundled model.
pub fn bundled(name: &str) -> String {
    let mut linkdyn = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    let text = linkdyn.args(["models", name]).output().expect("it runs");
    String::from_utf8(text.stdout).expect("UTF-8")
}

impl Watching {
    /// Begins with a text.
    pub fn begin(text: &str) -> Self {
        let scratch = Scratch::new("live");
        let model = scratch.0.join("mine.json");
        fs::write(&model, text).expect("written");
        let out = scratch.0.join("out");
        let child = Command::new(env!("CARGO_BIN_EXE_linkdyn"))
            .arg("run")
            .arg(&model)
            .args(["--watch", "-o"])
            .arg(&out)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("it runs");
        let page = out.join("live.html");
        let begun = Instant::now();
        while !page.exists() {
            assert!(begun.elapsed() < Duration::from_secs(60), "no page");
            std::thread::sleep(Duration::from_millis(10));
        }
        Watching {
            model,
            page,
            child,
            _scratch: scratch,
        }
    }

    /// Host and token of the page that is served.
    pub fn address(&self) -> (String, String) {
        let page = fs::read_to_string(&self.page).expect("there");
        let (_, rest) = page.split_once("http://").expect("an address");
        let (address, _) = rest.split_once("/\"").expect("its end");
        let (host, token) = address.split_once('/').expect("a token");
        (host.to_owned(), token.to_owned())
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
