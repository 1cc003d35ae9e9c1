//! Variants among which one with a fault of linkdyn has no value, so that the search goes on.

use super::variants::Found;
use crate::broken::caught;

/// What may panic; it is made anew then.
pub struct Guarded<'b, S> {
    begin: Box<dyn Fn() -> S + 'b>,
    own: S,
}

impl<'b, S> Guarded<'b, S> {
    /// Begins.
    pub fn new(begin: impl Fn() -> S + 'b) -> Self {
        Guarded {
            own: begin(),
            begin: Box::new(begin),
        }
    }

    /// What it gives, or what its panic said.
    pub fn ask<T>(&mut self, ask: impl FnOnce(&mut S) -> T) -> Result<T, String> {
        let given = caught(|| ask(&mut self.own));
        if given.is_err() {
            self.own = (self.begin)();
        }
        given
    }

    /// What it finds; nothing where it panics.
    pub fn find<T>(&mut self, find: impl FnOnce(&mut S) -> Found<T>) -> Found<T> {
        let given = self.ask(find);
        given.unwrap_or_else(|said| Found::None(format!("failed: {said}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_a_variant_without_value() {
        // Gives x², and panics where it is negative, and whenever it is asked again after that.
        let square = |broken: &mut bool, x: f64| {
            *broken |= x < 0.0;
            assert!(!*broken, "it is {x}");
            Found::Some(x * x)
        };
        let mut guarded = Guarded::new(|| false);
        assert_eq!(guarded.find(|own| square(own, 3.0)), Found::Some(9.0));
        let Found::None(said) = guarded.find(|own| square(own, -1.0)) else {
            panic!("it has a value");
        };
        let expected = "failed: it is -1 (crates/ask/src/optimise/guarded.rs:";
        assert!(said.starts_with(expected), "{said}");
        assert_eq!(guarded.find(|own| square(own, 2.0)), Found::Some(4.0));
        assert!(guarded.ask(|_| -> u8 { panic!("none") }).is_err());
    }
}
