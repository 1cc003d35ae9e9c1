//! Linkages for a wanted motion, path or function: numbers only.
//!
//! | file       | does                                                                     |
//! | ---------- | ------------------------------------------------------------------------ |
//! | `dyad`     | all links and guides through four or five positions of a plane           |
//! | `path`     | all four-bars whose point passes nine points, and their cognates         |
//! | `linkage`  | a linkage of pins and guides, how it closes, and its derivatives         |
//! | `four_bar` | four-bars and slider-cranks from links: cranks, cognates, functions      |
//! | `fit`      | least squares over all dimensions                                        |
//! | `keep`     | lengths, directions and the angle of transmission that a search keeps    |
//! | `chains`   | which bodies can be pinned to which                                      |

pub mod chains;
pub mod dyad;
pub mod fit;
pub mod four_bar;
pub mod keep;
pub mod linkage;
pub mod path;
