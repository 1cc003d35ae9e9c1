//! `report.html` of `linkdyn optimise`: the mechanism before and after over each other, the path with its points, how the search went,
//! and what was found, with the limits that are reached; one file.
//!
//! Names reach the page only inside JSON in which `<`, `>` and `&` are escaped, and get into it as text.
//!
//! | file    | does                      |
//! | ------- | ------------------------- |
//! | `parts` | what the page is made of  |
//! | `page`  | the page                  |

mod page;
mod parts;

pub use parts::{Cell, Facts, History, OptimisePage, Wanted};

#[cfg(test)]
pub(crate) use page::SCRIPTS;
