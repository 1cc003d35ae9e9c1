//! Models as files for other programs and people.

pub mod equations;
