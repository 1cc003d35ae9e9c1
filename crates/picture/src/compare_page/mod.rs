//! `compare.html`: the runs of a comparison over each other, how far they are from the first, tables; one file.
//!
//! The first run is the reference, and grey. Below each plot stand the differences to it. Names reach the page only inside JSON
//! in which `<`, `>` and `&` are escaped, and get into it as text. Plots are drawn by uPlot, as in the report.
//!
//! | file     | does                                                          |
//! | -------- | ------------------------------------------------------------- |
//! | `parts`  | what the page is made of                                      |
//! | `page`   | the page                                                      |
//! | `values` | rows as compact text, thinned where room is short             |
//! | `facts`  | contacts, tables and cut axes of a run                        |

mod facts;
mod page;
mod parts;
mod values;

pub use parts::{ComparePage, ComparedRun};

#[cfg(test)]
pub(crate) use page::SCRIPTS;
