//! Every quantity of every bundled model.

use super::*;
use crate::bundled::MODELS;

/// The place of a path in a model's JSON, `/bodies/crank/points/A/0`.
fn pointer(path: &str) -> String {
    format!("/{}", path.replace(['.', '['], "/").replace(']', ""))
}

#[test]
fn leaves_are_the_values_of_the_model_and_their_slopes_those_of_differences() {
    let mut count = 0;
    for bundled in MODELS {
        let loaded = load(bundled.text.as_bytes(), &[]).unwrap_or_else(|said| panic!("{said}"));
        let Derivatives { parameters, leaves } = loaded.source.derivatives();
        let printed = loaded.model.to_json();
        let values = |index: usize, by: f64| {
            let mut deviations = vec![0.0; parameters.len()];
            deviations[index] = by;
            loaded.source.dependence().at(&deviations).leaves
        };
        for (index, parameter) in loaded.parameters.iter().enumerate() {
            let step = 1e-5 * parameter.value.abs().max(1e-3);
            let (up, down) = (values(index, step), values(index, -step));
            for (leaf, (up, down)) in leaves.iter().zip(up.iter().zip(&down)) {
                // a model that is printed has the values of formulas' parameters within their texts
                if leaf.path.contains(".parameters.") {
                    continue;
                }
                let place = format!("{}: {} by {}", bundled.name, leaf.path, parameter.name);
                let value = leaf.value.unwrap_or(f64::NAN);
                let own = printed
                    .pointer(&pointer(&leaf.path))
                    .and_then(|own| own.as_f64());
                let own = own.unwrap_or_else(|| panic!("{place}: not in the model"));
                assert!(
                    (own - value).abs() <= 4e-16 * own.abs(),
                    "{place}: {own}, not {value}"
                );
                assert_eq!(leaf.fault, None, "{place}");
                let by = leaf.gradient.iter().find(|(known, _)| *known == index);
                let by = by.map_or(0.0, |(_, by)| *by);
                let found = (up.value.unwrap() - down.value.unwrap()) / (2.0 * step);
                // as above: h²f‴/6 and the rounding of values over the step
                let scale = by.abs() + value.abs() * 1e-5 / step;
                assert!(
                    (found - by).abs() <= 2e-9 * scale,
                    "{place}: {by}, differences say {found}"
                );
                count += 1;
            }
        }
    }
    assert!(count > 300, "{count} pairs");
}
