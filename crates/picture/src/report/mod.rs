//! `report.html`: the mechanism in motion, plots, tables; one file that needs nothing else and asks the network for nothing.
//!
//! The page is `page.html` in the frame of all pages (`html`), with styles, scripts and data put in. Names of the model reach it only
//! inside JSON in which `<`, `>` and `&` are escaped, and get into the page as text alone (`textContent`). A content security policy
//! lets only these scripts and styles act, named by their SHA-256. Plots are drawn by uPlot (`page/vendor/`).
//!
//! | file       | does                                                       |
//! | ---------- | ---------------------------------------------------------- |
//! | `page`     | what a page is made of; the page                           |
//! | `facts`    | the summary, without what is too long for a page           |
//! | `columns`  | columns and what they are worth                            |
//! | `encode`   | columns as compact text, thinned where room is short       |

mod columns;
mod encode;
mod facts;
mod page;

pub use page::{LIMIT, Report, around};

#[cfg(test)]
pub(crate) use page::SCRIPTS;
