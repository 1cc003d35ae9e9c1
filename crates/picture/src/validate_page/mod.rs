//! Pages of a validation: one per case, with reference and result side by side, and one over all cases.
//!
//! The pages have no scripts: text, tables that fold, figures that stand in the file. Verdicts are in words, since
//! "finding" alone reads like a fault.
//!
//! | file    | does                                             |
//! | ------- | ------------------------------------------------ |
//! | `words` | verdicts in plain words                          |
//! | `case`  | the page of a case                               |
//! | `index` | the page over all cases                          |
//! | `frame` | what both have around their content              |

mod case;
mod frame;
mod index;
mod words;

pub use case::{CasePage, Compared, Figure};
pub use index::{IndexPage, IndexRow};
pub use words::{Counts, Judged, MEANINGS};
