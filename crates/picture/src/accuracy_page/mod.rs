//! `report.html` of `linkdyn accuracy`: levels of each output, the band over the stroke, contributions, the worst configuration beside
//! the nominal one, and sliders of the parameters; one file.
//!
//! Names reach the page only inside JSON in which `<`, `>` and `&` are escaped, and get into it as text. The band is drawn by uPlot,
//! the mechanism by the scripts of the report.
//!
//! | file     | does                                                              |
//! | -------- | ----------------------------------------------------------------- |
//! | `parts`  | what the page is made of                                          |
//! | `chosen` | which poses go in, and which with contributions and configurations |
//! | `facts`  | what is said of an output over all its poses                      |
//! | `page`   | the page                                                          |

mod chosen;
mod facts;
mod page;
mod parts;

pub use parts::{AccuracyPage, Output, Pose, Slider, Source, Unit};

#[cfg(test)]
pub(crate) use page::SCRIPTS;
