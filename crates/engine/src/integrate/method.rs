//! The methods by name, as `solver.method` gives them.

use std::str::FromStr;

use thiserror::Error;

use super::{Auto, Dop853, Limits, Radau, Stepper, Tolerance};

/// A method of integration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Explicit until the problem proves stiff, then implicit.
    Auto,
    /// Explicit, of order 8.
    Dop853,
    /// Implicit, of orders 5 to 13. Models call it by its lowest order.
    Radau,
}

/// A name that no method has.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("no method is called {0:?}; there are \"auto\", \"dop853\" and \"radau5\"")]
pub struct UnknownMethod(pub String);

impl Method {
    /// Every method.
    pub const ALL: [Method; 3] = [Method::Auto, Method::Dop853, Method::Radau];

    /// The name in models.
    pub fn name(self) -> &'static str {
        match self {
            Method::Auto => "auto",
            Method::Dop853 => "dop853",
            Method::Radau => "radau5",
        }
    }

    /// A stepper of this method.
    pub fn stepper(self, tolerance: Tolerance, limits: Limits) -> Box<dyn Stepper> {
        match self {
            Method::Auto => Box::new(Auto::new(tolerance, limits)),
            Method::Dop853 => Box::new(Dop853::new(tolerance, limits)),
            Method::Radau => Box::new(Radau::new(tolerance, limits)),
        }
    }
}

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(text: &str) -> Result<Self, UnknownMethod> {
        Method::ALL
            .into_iter()
            .find(|method| method.name() == text)
            .ok_or_else(|| UnknownMethod(text.into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_and_others_listed() {
        for method in Method::ALL {
            assert_eq!(method.name().parse(), Ok(method));
        }
        let unknown = "rk4".parse::<Method>().unwrap_err().to_string();
        assert!(unknown.contains("rk4"));
        assert!(
            Method::ALL
                .iter()
                .all(|method| unknown.contains(method.name())),
            "{unknown}"
        );
    }
}
