//! What is calculated with numbers inside is inside of what is calculated with the intervals.

use super::*;

/// Numbers between −1 and 1, the same ones each time (xorshift).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A size between 1e-3 and 1e3, of either sign.
    fn number(&mut self) -> f64 {
        let exponent = 3.0 * self.next();
        self.next().signum() * 10f64.powf(exponent)
    }

    fn interval(&mut self) -> Interval {
        let middle = self.number();
        let width = middle.abs() * 10f64.powf(4.0 * self.next() - 3.5);
        match self.next() > 0.8 {
            true => Interval::of(middle),
            false => Interval::new(middle - width, middle + width),
        }
    }

    /// Ends, and numbers between.
    fn inside(&mut self, interval: Interval) -> f64 {
        let share = 0.5 + 0.7 * self.next();
        let number = interval.least + share * (interval.most - interval.least);
        number.clamp(interval.least, interval.most)
    }
}

type One = (Unary, fn(f64) -> f64);
type Two = (Binary, fn(f64, f64) -> f64);

const ONE: [One; 14] = [
    (Unary::Negate, |x| -x),
    (Unary::Sqrt, f64::sqrt),
    (Unary::Abs, f64::abs),
    (Unary::Sin, f64::sin),
    (Unary::Cos, f64::cos),
    (Unary::Tan, f64::tan),
    (Unary::Asin, f64::asin),
    (Unary::Acos, f64::acos),
    (Unary::Atan, f64::atan),
    (Unary::Exp, f64::exp),
    (Unary::Ln, f64::ln),
    (Unary::Floor, f64::floor),
    (Unary::Ceil, f64::ceil),
    (Unary::Round, f64::round),
];

const TWO: [Two; 9] = [
    (Binary::Add, |x, y| x + y),
    (Binary::Subtract, |x, y| x - y),
    (Binary::Multiply, |x, y| x * y),
    (Binary::Divide, |x, y| x / y),
    (Binary::Power, f64::powf),
    (Binary::Min, f64::min),
    (Binary::Max, f64::max),
    (Binary::Hypot, f64::hypot),
    (Binary::Atan2, f64::atan2),
];

#[test]
fn functions_of_one_enclose_those_of_all_points() {
    let mut random = Random(0x1234_5678_9abc_def1);
    let mut finite = [0; ONE.len()];
    for _ in 0..20_000 {
        let x = random.interval();
        let cube = x.two(&Interval::of(3.0), Binary::Power);
        let at = random.inside(x);
        assert!(cube.contains(at.powf(3.0)), "{at:e} in {x:?}: {cube:?}");
        for (count, (function, of_number)) in finite.iter_mut().zip(ONE) {
            let all = x.one(function);
            *count += usize::from(Number::is_finite(&all));
            for _ in 0..3 {
                let at = random.inside(x);
                let value = of_number(at);
                assert!(
                    value.is_nan() || all.contains(value),
                    "{function:?} of {at:e} in {x:?}: {value:e}, not in {all:?}"
                );
            }
        }
    }
    // what is nothing but everything would prove nothing
    let least = finite.iter().min().unwrap();
    assert!(*least > 3000, "{finite:?}");
}

#[test]
fn functions_of_two_enclose_those_of_all_points() {
    let mut random = Random(0xfeed_beef_1234_0001);
    let mut finite = [0; TWO.len()];
    for _ in 0..20_000 {
        let (x, y) = (random.interval(), random.interval());
        for (count, (function, of_numbers)) in finite.iter_mut().zip(TWO) {
            let all = x.two(&y, function);
            *count += usize::from(Number::is_finite(&all));
            for _ in 0..3 {
                let (a, b) = (random.inside(x), random.inside(y));
                let value = of_numbers(a, b);
                assert!(
                    value.is_nan() || all.contains(value),
                    "{function:?} of {a:e}, {b:e} in {x:?}, {y:?}: {value:e}, not in {all:?}"
                );
            }
        }
    }
    let least = finite.iter().min().unwrap();
    assert!(*least > 3000, "{finite:?}");
}

#[test]
fn turning_points_and_signs_are_those_of_the_hand() {
    let of = Interval::new;
    let sine = of(1.0, 2.0).one(Unary::Sin);
    assert_eq!((sine.most, sine.contains(1f64.sin())), (1.0, true));
    assert!(sine.least > 0.84 && sine.least <= 1f64.sin(), "{sine:?}");
    assert_eq!(of(-0.1, 7.0).one(Unary::Cos), of(-1.0, 1.0));
    let cosine = of(3.0, 3.3).one(Unary::Cos);
    assert!(cosine.least == -1.0 && cosine.most < -0.98, "{cosine:?}");
    assert!(!Number::is_finite(&of(1.5, 1.6).one(Unary::Tan)));
    assert!(Number::is_finite(&of(-1.5, 1.5).one(Unary::Tan)));
    assert_eq!(of(-2.0, 1.0).one(Unary::Abs), of(0.0, 2.0));
    assert_eq!(
        of(-2.0, 1.0).two(&of(2.0, 2.0), Binary::Power),
        of(0.0, 4.0)
    );
    assert!(!Number::is_finite(&of(1.0, 2.0).divide(&of(-1.0, 1.0))));
    // the angle jumps on the left
    let behind = of(-0.1, 0.1).two(&of(-2.0, -1.0), Binary::Atan2);
    assert!(behind.least <= -PI && behind.most >= PI, "{behind:?}");
    let ahead = of(-0.1, 0.1).two(&of(1.0, 2.0), Binary::Atan2);
    assert!(ahead.most < 0.0997 && ahead.least > -0.0997, "{ahead:?}");
}

#[test]
fn what_is_exact_stays_exact_and_what_is_not_is_rounded_outward() {
    let of = Interval::of;
    assert_eq!(of(0.5).add(&of(0.25)), of(0.75));
    assert_eq!(of(0.5).multiply(&of(3.0)), of(1.5));
    assert_eq!(of(3.0).divide(&of(8.0)), of(0.375));
    assert_eq!(of(2.25).one(Unary::Sqrt), of(1.5));
    let third = of(1.0).divide(&of(3.0));
    assert_eq!(
        (third.least.next_up(), third.most.next_down()),
        (1.0 / 3.0, 1.0 / 3.0)
    );
    // 0.1 + 0.2 lies between two doubles
    let sum = of(0.1).add(&of(0.2));
    assert!(sum.least < 0.1 + 0.2 && sum.most > 0.1 + 0.2, "{sum:?}");
    // a product that is lost is not taken for zero
    let lost = of(1e-200).multiply(&of(1e-200));
    assert!(lost.least <= 0.0 && lost.most > 0.0, "{lost:?}");
}
