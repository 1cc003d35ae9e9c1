//! A page beside `report.html` that shows it, and shows it again after every run of `--watch`.
//!
//! The report itself can't: it allows no script but its own, and a page from a disk may not read files.

use linkdyn_ask::text::plain;
use linkdyn_output::{Directory, WriteError};
use serde_json::json;

const PAGE: &str = include_str!("page.html");
const NAME: &str = "live.html";
/// What the page loads again and again.
const NUMBER: &str = "live.js";

/// The page, as long as this lives.
#[derive(Debug)]
pub struct Live {
    directory: Directory,
    runs: usize,
}

impl Live {
    /// Begins with no run.
    ///
    /// # Errors
    /// When the page can't be written.
    pub fn new(directory: Directory) -> Result<Self, WriteError> {
        directory.write(NAME, PAGE.as_bytes())?;
        Ok(Live { directory, runs: 0 })
    }

    /// Lets the page show the report that was written just now; the page's path.
    ///
    /// # Errors
    /// When a file can't be written.
    pub fn show(&mut self) -> Result<String, WriteError> {
        self.runs += 1;
        let number = format!("run({})\n", self.runs);
        self.directory.write(NUMBER, number.as_bytes())?;
        Ok(self.directory.path().join(NAME).display().to_string())
    }

    /// Lets the page say what is wrong, above the report of the run before.
    ///
    /// # Errors
    /// When a file can't be written.
    pub fn tell(&self, faults: &[String]) -> Result<(), WriteError> {
        let said: Vec<_> = faults.iter().map(|line| plain(line)).collect();
        let number = format!("run({}, {})\n", self.runs, json!(said));
        self.directory.write(NUMBER, number.as_bytes())?;
        Ok(())
    }
}

impl Drop for Live {
    /// Leaves nothing that does not work any more.
    fn drop(&mut self) {
        for name in [NAME, NUMBER] {
            // What can't be removed is a small file that says so itself.
            let _ = self.directory.remove(name);
        }
    }
}
