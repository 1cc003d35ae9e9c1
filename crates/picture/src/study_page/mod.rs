//! `report.html` of `linkdyn study`: what was varied, what came of it, responses over parameters, all variables against each other, and
//! the motion of single variants; one file.
//!
//! Names reach the page only inside JSON in which `<`, `>` and `&` are escaped, and get into it as text. Plots are drawn on canvases by
//! scripts of the page's own, the mechanism by those of the report.
//!
//! | file     | does                                            |
//! | -------- | ----------------------------------------------- |
//! | `parts`  | what the page is made of                        |
//! | `room`   | how much it has room for                        |
//! | `values` | rows and motions as compact numbers             |
//! | `page`   | the page                                        |

mod page;
mod parts;
mod room;
mod values;

pub use parts::{Motion, Played, StudyPage, Variable, Variant};
pub use room::{most_motions, most_rows};
pub(crate) use values::Values;

#[cfg(test)]
pub(crate) use page::SCRIPTS;
