//! A page beside `report.html` that shows it, and shows it again after every run of `--watch`.
//!
//! The report itself can't: it allows no script but its own, and a page from a disk may not read files.

use linkdyn_output::{Directory, WriteError};

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
    pub fn new(directory: Directory) -> Self {
        Live { directory, runs: 0 }
    }

    /// Lets the page show the report that was written just now; the page's path.
    ///
    /// # Errors
    /// When a file can't be written.
    pub fn show(&mut self) -> Result<String, WriteError> {
        self.runs += 1;
        let number = format!("run({})\n", self.runs);
        self.directory.write(NUMBER, number.as_bytes())?;
        let page = self.directory.path().join(NAME);
        if self.runs == 1 {
            self.directory.write(NAME, PAGE.as_bytes())?;
        }
        Ok(page.display().to_string())
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
