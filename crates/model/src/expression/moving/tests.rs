//! Sides and derivatives against the functions themselves.

use super::super::Tangent;
use super::*;
use crate::error::Complaint;
use crate::expression::Fixed;
use crate::expression::Known;

/// `a` and `b` move, as plain numbers.
struct Two;

impl Results for Two {
    fn find(&self, name: &str) -> Option<Known> {
        let index = ["a", "b"].iter().position(|one| *one == name)?;
        Some(Known {
            place: Place::Row(index),
            powers: Powers::default(),
        })
    }

    fn missing(&self, name: &str, _: &[String]) -> Complaint {
        Complaint::new("", name)
    }
}

fn read(text: &str) -> Moving {
    Moving::read(text, &[], &Two, false).unwrap_or_else(|misfit| panic!("{text}: {misfit:?}"))
}

/// What Rust makes of the same numbers.
type Known2 = fn(f64, f64) -> f64;

const KINKED: [(&str, Known2); 10] = [
    ("abs(a) + b", |a, b| a.abs() + b),
    ("min(a, b, 0.3)", |a, b| a.min(b).min(0.3)),
    ("max(a, 2*b)", |a, b| a.max(2.0 * b)),
    ("clamp(a, -0.5, 0.5)*b", |a, b| a.clamp(-0.5, 0.5) * b),
    ("floor(a) + ceil(b)", |a, b| a.floor() + b.ceil()),
    ("round(2*a)", |a, _| (2.0 * a).round()),
    ("mod(a, 0.7)", |a, _| a.rem_euclid(0.7)),
    ("step(a)*b", |a, b| if a >= 0.0 { b } else { 0.0 }),
    ("sign(a - b)", |a, b| if a > b { 1.0 } else { -1.0 }),
    ("table(a; -1, 2; 0, 3; 1, -1)", |a, _| match a {
        a if a < -1.0 => 2.0,
        a if a < 0.0 => 3.0 + a,
        a if a < 1.0 => 3.0 - 4.0 * a,
        _ => -1.0,
    }),
];

/// Numbers from −2 to 2 that meet no kink.
fn numbers() -> impl Iterator<Item = [f64; 2]> {
    let part = |k: usize, by: f64| 4.0 * (by * k as f64).fract() - 2.0;
    (1..60).map(move |k| [part(k, 0.618_033_988), part(k, 0.414_213_562)])
}

#[test]
fn each_kink_is_on_the_side_of_its_values() {
    for (text, known) in KINKED {
        let moving = read(text);
        assert_eq!(moving.kinks.len(), moving.program.kinks(), "{text}");
        let scales = vec![1.0; moving.kinks.len()];
        let mut before: Vec<(Vec<i32>, f64)> = Vec::new();
        for inputs in numbers() {
            let free = moving.program.value_on(&inputs, Fixed::default(), None);
            let expected = known(inputs[0], inputs[1]);
            assert!(
                (free - expected).abs() < 1e-14,
                "{text} {inputs:?}: {free} {expected}"
            );
            let mut sides = vec![0; moving.kinks.len()];
            moving
                .program
                .take_sides(&inputs, Fixed::default(), &mut sides);
            let held = moving
                .program
                .value_on(&inputs, Fixed::default(), Some(&sides));
            assert_eq!(held.to_bits(), free.to_bits(), "{text}");
            let beyond = |sides: &[i32]| {
                moving
                    .program
                    .beyond(&inputs, Fixed::default(), (sides, &scales))
            };
            assert!(beyond(&sides) <= 0.0, "{text} {inputs:?} {sides:?}");
            for (others, _) in before.iter().filter(|(others, _)| *others != sides) {
                assert!(beyond(others) > 0.0, "{text} {inputs:?} {others:?}");
            }
            before.push((sides, free));
        }
        assert!(
            before.iter().any(|(sides, _)| *sides != before[0].0),
            "{text}"
        );
    }
}

#[test]
fn tangents_are_derivatives() {
    let smooth = [
        "sin(a)*cos(b)/(2 + tan(0.2*a))",
        "asin(0.4*a)/(1 rad) + acos(0.3*b)/(1 rad) + atan(a*b)/(1 rad)",
        "sqrt(5 + a)*exp(0.3*b) - ln(3 + b)",
        "hypot(a, 1 + b)^3 - (a^2 - b)^2 + (4 + a)^(0.5*b)",
        "atan2(a, 3 + b)/(1 rad)",
    ];
    let texts = smooth.into_iter().chain(KINKED.map(|(text, _)| text));
    for text in texts {
        let program = read(text).program;
        for inputs in numbers() {
            for index in 0..2 {
                let tangents = std::array::from_fn::<_, 2, _>(|k| Tangent {
                    value: inputs[k],
                    slope: f64::from(u8::from(k == index)),
                });
                let found = program.value_on(&tangents, Fixed::default(), None);
                assert_eq!(
                    found.value,
                    program.value_on(&inputs, Fixed::default(), None),
                    "{text}"
                );
                let h = 1e-6;
                let at = |by: f64| {
                    let mut moved = inputs;
                    moved[index] += by;
                    program.value_on(&moved, Fixed::default(), None)
                };
                let difference = (at(h) - at(-h)) / (2.0 * h);
                assert!(
                    (found.slope - difference).abs() < 1e-8 * difference.abs().max(1.0),
                    "{text} {inputs:?}: {} {difference}",
                    found.slope
                );
            }
        }
    }
}
