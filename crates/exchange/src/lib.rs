//! Mechanisms in the files of other programs, read into model files ([`import()`]).
//!
//! A source is read as it was drawn: all bodies have the frame of the ground at the position of the drawing, so no pose is needed, a pin has
//! the same coordinates in all its bodies, and every angle is the rotation since then. What has no counterpart is listed, never dropped
//! without a word ([`Imported::left_out`]).

mod draft;
#[cfg(test)]
mod drawing_tests;
pub mod export;
mod form;
pub mod import;
#[cfg(test)]
mod robot_tests;
mod source;

pub use draft::{Draft, Entry, number, numbers};
pub use export::Exported;
pub use form::{Affine, Corner, Form};
pub use import::{Imported, import};
pub use source::{Format, LONGEST, LeftOut, Options, Refused};
