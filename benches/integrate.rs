//! What a step costs beyond its evaluations: trivial equations of two and ten components.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use linkdyn_engine::integrate::{Limits, Method, Ode, Refused, Tolerance};

/// Independent oscillators y″ = −y, of n components altogether.
struct Oscillators(usize);

impl Ode for Oscillators {
    fn dimension(&self) -> usize {
        self.0
    }

    #[inline(never)]
    fn eval(&mut self, _: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Refused> {
        for (dy, y) in dy.chunks_exact_mut(2).zip(y.chunks_exact(2)) {
            (dy[0], dy[1]) = (y[1], -y[0]);
        }
        Ok(())
    }

    fn accept(&mut self, _: f64, _: &[f64]) {}
}

fn integrate(criterion: &mut Criterion) {
    for method in [Method::Dop853, Method::Radau] {
        for n in [2, 10] {
            let mut ode = Oscillators(n);
            let tolerance = Tolerance {
                rtol: 1e-6,
                atol: vec![1e-9; n],
                cap: Vec::new(),
            };
            let mut stepper = method.stepper(tolerance, Limits::default());
            stepper
                .start(&mut ode, 0.0, &vec![1.0; n], f64::MAX)
                .expect("starts");
            criterion.bench_function(&format!("{}, step/{n}", method.name()), |bencher| {
                bencher.iter(|| {
                    stepper.step(&mut ode, f64::MAX).expect("steps");
                    black_box(stepper.y());
                });
            });
            let mut y = vec![0.0; n];
            criterion.bench_function(
                &format!("{}, step with output/{n}", method.name()),
                |bencher| {
                    bencher.iter(|| {
                        stepper.step(&mut ode, f64::MAX).expect("steps");
                        stepper
                            .interpolate(&mut ode, stepper.previous(), &mut y)
                            .expect("interpolates");
                        black_box(&y);
                    });
                },
            );
        }
    }
}

criterion_group!(benches, integrate);
criterion_main!(benches);
