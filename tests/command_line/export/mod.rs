//! `linkdyn export`: files for other programs.

mod fmu;
