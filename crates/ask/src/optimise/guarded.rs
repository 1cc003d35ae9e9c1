//! Variants among which one with a fault of linkdyn has no value, so that the search goes on.

use super::variants::{Call, Detail, Found, Variant, Variants};
use crate::broken::caught;
use linkdyn_optimise::curve::Node;

/// Variants that may panic.
pub struct Guarded<'v>(pub &'v dyn Variants);

/// One start's share of them.
struct Share<'v> {
    all: &'v dyn Variants,
    own: Box<dyn Variant + 'v>,
    /// How many numbers a variant gave last.
    numbers: usize,
}

impl Variants for Guarded<'_> {
    fn begin(&self) -> Box<dyn Variant + '_> {
        Box::new(Share {
            all: self.0,
            own: self.0.begin(),
            numbers: 0,
        })
    }
}

impl Share<'_> {
    /// What the variant gives, or what its panic said; then it begins anew.
    fn ask<T>(&mut self, ask: impl FnOnce(&mut dyn Variant) -> T) -> Result<T, String> {
        let given = caught(|| ask(self.own.as_mut()));
        if given.is_err() {
            self.own = self.all.begin();
        }
        given
    }

    fn find<T>(&mut self, ask: impl FnOnce(&mut dyn Variant) -> Found<T>) -> Found<T> {
        let given = self.ask(ask);
        given.unwrap_or_else(|said| Found::None(format!("failed: {said}")))
    }
}

impl Variant for Share<'_> {
    fn numbers(&mut self, x: &[f64], call: Call) -> Found<Vec<f64>> {
        let found = self.find(|own| own.numbers(x, call));
        if let Found::Some(numbers) = &found {
            self.numbers = numbers.len();
        }
        found
    }

    fn deviating(&mut self, x: &[f64], deviation: (usize, f64), call: Call) -> Found<Vec<f64>> {
        self.find(|own| own.deviating(x, deviation, call))
    }

    fn deviating_slopes(
        &mut self,
        x: &[f64],
        deviation: (usize, f64),
        lengths: &[f64],
    ) -> Option<(f64, Vec<f64>)> {
        let slopes = self.ask(|own| own.deviating_slopes(x, deviation, lengths));
        slopes.ok().flatten()
    }

    fn path(&mut self, x: &[f64], detail: Detail, call: Call) -> Found<Vec<Node>> {
        self.find(|own| own.path(x, detail, call))
    }

    fn slopes(&mut self, x: &[f64], lengths: &[f64]) -> Vec<f64> {
        let slopes = self.ask(|own| own.slopes(x, lengths));
        slopes.unwrap_or_else(|_| vec![f64::NAN; self.numbers * x.len()])
    }

    fn path_slopes(&mut self, x: &[f64], lengths: &[f64], times: &[f64]) -> Option<Vec<f64>> {
        let slopes = self.ask(|own| own.path_slopes(x, lengths, times));
        slopes.ok().flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives x², and panics where it is negative, and whenever it is asked again after that.
    struct Brittle;
    struct Broken(bool);

    impl Variants for Brittle {
        fn begin(&self) -> Box<dyn Variant + '_> {
            Box::new(Broken(false))
        }
    }

    impl Variant for Broken {
        fn numbers(&mut self, x: &[f64], _: Call) -> Found<Vec<f64>> {
            self.0 |= x[0] < 0.0;
            assert!(!self.0, "it is {}", x[0]);
            Found::Some(vec![x[0] * x[0]])
        }
        fn deviating(&mut self, x: &[f64], _: (usize, f64), call: Call) -> Found<Vec<f64>> {
            self.numbers(x, call)
        }
        fn deviating_slopes(
            &mut self,
            _: &[f64],
            _: (usize, f64),
            _: &[f64],
        ) -> Option<(f64, Vec<f64>)> {
            panic!("no slopes")
        }
        fn path(&mut self, _: &[f64], _: Detail, _: Call) -> Found<Vec<Node>> {
            panic!("no path")
        }
        fn slopes(&mut self, _: &[f64], _: &[f64]) -> Vec<f64> {
            panic!("no slopes")
        }
        fn path_slopes(&mut self, _: &[f64], _: &[f64], _: &[f64]) -> Option<Vec<f64>> {
            panic!("no slopes")
        }
    }

    #[test]
    fn a_panic_is_a_variant_without_value() {
        let guarded = Guarded(&Brittle);
        let mut share = guarded.begin();
        assert_eq!(
            share.numbers(&[3.0], Call::OfSearch),
            Found::Some(vec![9.0])
        );
        let Found::None(said) = share.numbers(&[-1.0], Call::OfSearch) else {
            panic!("it has a value");
        };
        assert!(
            said.starts_with("failed: it is -1 (crates/ask/src/optimise/guarded.rs:"),
            "{said}"
        );
        assert_eq!(
            share.numbers(&[2.0], Call::OfSearch),
            Found::Some(vec![4.0])
        );
        assert!(
            share
                .slopes(&[2.0, 1.0], &[1.0; 2])
                .iter()
                .all(|x| x.is_nan())
        );
        assert!(share.path_slopes(&[2.0], &[1.0], &[0.0]).is_none());
        assert!(matches!(
            share.path(&[2.0], Detail::Coarse, Call::Last),
            Found::None(_)
        ));
    }
}
