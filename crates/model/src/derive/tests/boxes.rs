//! Enclosures: what is inside, and what may happen inside.

use super::*;

#[test]
fn enclosures_hold_values_and_derivatives_of_all_points_of_the_box() {
    for expression in SMOOTH {
        let loaded = read(expression);
        let half: Vec<f64> = loaded
            .parameters
            .iter()
            .map(|one| 1e-3 * one.value)
            .collect();
        let limits: Vec<[f64; 2]> = half.iter().map(|half| [-half, *half]).collect();
        let all = loaded.source.dependence().within(&limits).leaves.remove(0);
        assert_eq!(all.fault, None, "{expression}");
        let box_value = all.value.unwrap();
        for corner in 0..200_u32 {
            // corners first, then a lattice
            let share = |index: usize| match corner < 64 {
                true => f64::from(corner >> index & 1) * 2.0 - 1.0,
                false => ((corner as usize * (index + 3) * 7919) % 1000) as f64 / 500.0 - 1.0,
            };
            let deviations: Vec<f64> = half
                .iter()
                .enumerate()
                .map(|(index, half)| half * share(index))
                .collect();
            let one = loaded.source.dependence().at(&deviations).leaves.remove(0);
            let value = one.value.unwrap();
            assert!(
                box_value.contains(value),
                "{expression}: {value} not in {box_value:?}"
            );
            for ((index, by), (known, enclosure)) in one.gradient.iter().zip(&all.gradient) {
                assert_eq!(index, known, "{expression}");
                // the derivative of the number is rounded itself, by some units in the last place
                let slack = 4e-15 * by.abs();
                let wide = Interval::new(enclosure.least - slack, enclosure.most + slack);
                assert!(
                    wide.contains(*by),
                    "{expression} by {index}: {by} not in {enclosure:?}"
                );
            }
        }
        // and it is not much wider than the box: every operation adds some hundredths to 2e-3
        let width = box_value.most - box_value.least;
        assert!(
            width < 0.05 * box_value.most.abs().max(box_value.least.abs()),
            "{expression}: {box_value:?}"
        );
    }
}

#[test]
fn what_may_happen_in_the_box_is_a_fault_of_the_box() {
    for (expression, reason) in [
        ("abs(l - 50.01 mm)", "abs has a kink at zero"),
        ("min(l, 50.01 mm)", "min has a kink where two are equal"),
        ("l*floor(n + 0.001)", "floor jumps here"),
        ("l/(x - 0.3001)", "this divides by zero"),
        (
            "sqrt(l - 49.99 mm)*sqrt(k)",
            "a negative number has no square root",
        ),
        (
            "l*asin(x + 0.6999)/1 rad",
            "asin takes numbers from -1 to 1, and these go beyond",
        ),
        (
            "l*tan(phi + 50.01 deg)",
            "the result is too large for a double",
        ),
    ] {
        let loaded = read(expression);
        let limits = [1e-3, 0.0, 1e-3, 0.0, 1e-3, 1e-2].map(|half: f64| [-half, half]);
        let leaf = loaded.source.dependence().within(&limits).leaves.remove(0);
        assert_eq!(leaf.fault.as_deref(), Some(reason), "{expression}");
        assert_eq!(
            loaded.source.derivatives().leaves[0].fault,
            None,
            "{expression}"
        );
    }
}
