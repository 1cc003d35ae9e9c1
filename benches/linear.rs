//! One refactorisation and one solve: KKT matrices of four-bar chains and grids, and the Jacobian of a six-bar.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use linkdyn_linear::{ColumnOrder, Pattern, SparseLu};

#[path = "../tests/common/linkage.rs"]
mod linkage;

/// Factors for the matrix, and two sets of values to alternate between.
fn prepare(matrices: [linkage::Matrix; 2]) -> (SparseLu, [Vec<f64>; 2]) {
    let [first, _] = &matrices;
    let (pattern, slots) = Pattern::from_entries(first.rows, first.columns, &first.positions())
        .expect("sound pattern");
    let values = matrices.map(|matrix| {
        let mut values = vec![0.0; pattern.entries()];
        for (&slot, &(_, _, value)) in slots.iter().zip(&matrix.entries) {
            values[slot as usize] += value;
        }
        values
    });
    let order = ColumnOrder::paired(&pattern, &values[0]).expect("structurally regular");
    let mut lu = SparseLu::new(pattern, order);
    lu.factor(&values[0]).expect("regular");
    (lu, values)
}

fn measure(criterion: &mut Criterion, name: &str, matrices: [linkage::Matrix; 2]) {
    let (mut lu, values) = prepare(matrices);
    let n = lu.pattern().columns();
    let rhs: Vec<f64> = (0..n).map(|i| 1.0 + (i % 7) as f64).collect();
    let mut x = rhs.clone();
    let mut turn = 0;
    println!(
        "{name}: n = {n}, {} entries, {} in L and U",
        lu.pattern().entries(),
        lu.fill()
    );
    criterion.bench_function(&format!("{name}/{n}"), |bencher| {
        bencher.iter(|| {
            turn ^= 1;
            x.copy_from_slice(&rhs);
            lu.refactor(black_box(&values[turn])).expect("regular");
            lu.solve(&mut x);
            black_box(&x);
        });
    });
    criterion.bench_function(&format!("{name}, factor/{n}"), |bencher| {
        bencher.iter(|| lu.factor(black_box(&values[0])).expect("regular"));
    });
    criterion.bench_function(&format!("{name}, solve/{n}"), |bencher| {
        bencher.iter(|| {
            x.copy_from_slice(&rhs);
            lu.solve(&mut x);
            black_box(&x);
        });
    });
}

fn linear(criterion: &mut Criterion) {
    measure(criterion, "six-bar", [0.7, 0.8].map(linkage::six_bar));
    let kkt = |(bodies, pins): (usize, Vec<_>)| {
        linkage::kkt(
            &linkage::jacobian(bodies, &pins, &[]),
            &mut linkage::Random(1),
        )
    };
    for cells in [1, 10, 100, 1000] {
        measure(
            criterion,
            "four-bar chain",
            [0.7, 0.8].map(|angle| kkt(linkage::four_bar_chain(cells, angle))),
        );
    }
    for cells in [4, 16] {
        measure(
            criterion,
            "grid",
            [(); 2].map(|()| kkt(linkage::grid(cells))),
        );
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(std::time::Duration::from_millis(200))
        .measurement_time(std::time::Duration::from_millis(600));
    targets = linear
}
criterion_main!(benches);
