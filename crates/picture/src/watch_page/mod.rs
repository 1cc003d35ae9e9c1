//! The page of `run --watch`: the report of each run in a frame, what is wrong with the file, and a slider for each parameter. It talks
//! with the command that serves it; a report asks the network for nothing, so this page hands it the data of the next run.

use crate::html::{STYLE, talking};

const BODY: &str = include_str!("page.html");
const OWN_STYLE: &str = include_str!("page.css");
/// In the order in which they build on each other.
pub(crate) const SCRIPTS: &[&str] = &[include_str!("js/watch.js"), include_str!("js/knobs.js")];
/// What stands where the address of a served page is to be.
const ADDRESS: &str = "ADDRESS";
const ENTRY: &str = include_str!("entry.html");

/// The page, which asks for everything else relative to its own address.
pub fn page() -> String {
    let style = [STYLE, OWN_STYLE].concat();
    talking("linkdyn --watch", &style, BODY, &SCRIPTS.concat())
}

/// A file that leads to the page at an address while that is served, and says so when it is not.
pub fn entry(address: &str) -> String {
    ENTRY.replace(ADDRESS, address)
}
