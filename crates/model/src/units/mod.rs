//! Units: a small reader of unit texts such as `kg*mm^2` or `N*m/(rad/s)`.
//!
//! A unit is kept as num/den · 10^ten · π^pi, with num and den whole where the definition is exact, so that
//! `"410 mm"` is the double nearest to 0.41 and not two roundings away from it.
//! Definitions: SI brochure (2019); inch, pound, standard gravity: NIST SP 811 (2008), all exact.

mod reader;
mod table;
mod text;
mod unit;

pub use text::{split_quantity, with_decimal_point};
pub use unit::{Unit, UnitFault};

#[cfg(test)]
mod tests;
