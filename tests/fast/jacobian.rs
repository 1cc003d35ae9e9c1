//! The constraint Jacobian as a sparse matrix, against the engine's own products and finite differences of φ.

use linkdyn_engine::analysis::assembly::assemble;
use linkdyn_engine::system::{Evaluation, Inputs, compile::compile};
use linkdyn_model::bundled;
use linkdyn_model::{AnalysisKind, load};

#[test]
fn the_sparse_jacobian_is_the_derivative_of_the_constraints() {
    for bundled in bundled::MODELS {
        let loaded = load(bundled.text.as_bytes(), &[]).expect("a bundled model");
        let system = compile(&loaded.model, AnalysisKind::Kinematics).expect("complete");
        let inputs = Inputs::at_time(&system, 0.0);
        let Ok(assembled) = assemble(&system, &inputs) else {
            panic!("{} does not assemble", bundled.name)
        };
        let mut evaluation = Evaluation::new(&system);
        evaluation.set_position(&assembled.q);
        evaluation.eval_jacobian(&system, &inputs);
        let jacobian = system.jacobian(&evaluation);
        assert_eq!(
            jacobian.shape(),
            (system.m(), system.n()),
            "{}",
            bundled.name
        );

        let direction: Vec<f64> = (0..system.n())
            .map(|k| ((k * k + 1) as f64).sin())
            .collect();
        let mut product = vec![0.0; system.m()];
        evaluation.product(&system, &direction, &mut product);
        let h = 1e-6;
        let mut phi = |by: f64| {
            let q: Vec<f64> = assembled
                .q
                .iter()
                .zip(&direction)
                .map(|(q, d)| q + by * d)
                .collect();
            evaluation.set_position(&q);
            evaluation.eval_phi(&system, &inputs);
            evaluation.phi.clone()
        };
        let (low, high) = (phi(-h), phi(h));
        for (row, vector) in jacobian.outer_iterator().enumerate() {
            let sparse: f64 = vector
                .iter()
                .map(|(column, value)| value * direction[column])
                .sum();
            let difference = (high[row] - low[row]) / (2.0 * h);
            assert!(
                (sparse - product[row]).abs() < 1e-14,
                "{}: row {row}: {sparse} {}",
                bundled.name,
                product[row]
            );
            assert!(
                (sparse - difference).abs() < 1e-8,
                "{}: row {row}: {sparse} {difference}",
                bundled.name
            );
        }
    }
}
