//! A page `report.html` that another command left in the same directory.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::streams::remark;

/// The title stands within so many bytes.
const HEAD: u64 = 4096;
/// What each command's page is called, and the command.
const PAGES: [(&str, &str); 5] = [
    ("<title>linkdyn report</title>", "run"),
    ("<title>linkdyn accuracy</title>", "accuracy"),
    ("<title>linkdyn study</title>", "study"),
    ("<title>linkdyn optimum</title>", "optimise"),
    ("<title>linkdyn path-time: ", "path-time"),
];

/// Says on standard error that `command` replaces or removes (`does`) the page of another one.
pub fn tell(directory: &Path, command: &str, does: &str) {
    let page = directory.join("report.html");
    let mut head = Vec::new();
    let Ok(file) = File::open(&page) else { return };
    if file.take(HEAD).read_to_end(&mut head).is_err() {
        return;
    }
    let head = String::from_utf8_lossy(&head);
    let other = PAGES.iter().find(|(title, _)| head.contains(title));
    if let Some((_, other)) = other.filter(|(_, other)| *other != command) {
        remark(&format!(
            "note: {} is the page of `linkdyn {other}`, and is {does}; another directory keeps both",
            page.display()
        ));
    }
}
