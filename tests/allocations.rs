//! The step loop allocates nothing: refactoring, solving, watching for singular configurations, and integrating.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use linkdyn::integrate::{Limits, Method};
use linkdyn::solve::{ColumnOrder, Pattern, SparseLu};

#[path = "common/linkage.rs"]
mod linkage;
#[path = "common/ode.rs"]
mod ode;

struct Counting;

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

// The trait is unsafe to implement; this is a test, and only counts.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations of this thread while `work` runs.
fn allocations(work: impl FnOnce()) -> usize {
    let before = COUNT.with(Cell::get);
    work();
    COUNT.with(Cell::get) - before
}

#[test]
fn refactor_and_solves_allocate_nothing() {
    let values_at = |angle: f64| {
        let (bodies, pins) = linkage::four_bar_chain(20, angle);
        let matrix = linkage::kkt(&linkage::jacobian(bodies, &pins, &[]), &mut linkage::Random(2));
        let (pattern, slots) = Pattern::from_entries(matrix.rows, matrix.columns, &matrix.positions()).unwrap();
        let mut values = vec![0.0; pattern.entries()];
        for (&slot, &(_, _, value)) in slots.iter().zip(&matrix.entries) {
            values[slot as usize] += value;
        }
        (pattern, values)
    };
    let (pattern, first) = values_at(0.8);
    let (_, second) = values_at(0.9);
    let n = pattern.columns();
    let order = ColumnOrder::paired(&pattern, &first).unwrap();
    let mut lu = SparseLu::new(pattern, order);
    lu.factor(&first).unwrap();
    let (mut b, mut right, mut left) = (vec![1.0; n], vec![0.0; n], vec![0.0; n]);
    let count = allocations(|| {
        lu.refactor(&second).unwrap();
        lu.solve(&mut b);
        lu.solve_transposed(&mut b);
        lu.solve_refined(&second, &mut b);
        lu.solve_transposed_refined(&second, &mut b);
        lu.smallest_singular(3, &mut right, &mut left);
        lu.determinant();
        lu.smallest_pivot_ratio();
        lu.pivot_spread();
    });
    assert_eq!((count, lu.fallbacks()), (0, 0));

    // Choosing the same pivots again finds its space, too.
    let count = allocations(|| lu.factor(&second).unwrap());
    assert_eq!(count, 0);
    assert!(allocations(|| drop(std::hint::black_box(vec![1]))) > 0, "the counter counts");
}

#[test]
fn steps_and_dense_output_allocate_nothing() {
    for (method, f) in [
        (Method::Dop853, ode::pendulum as fn(f64, &[f64], &mut [f64])),
        (Method::Radau5, ode::van_der_pol),
        (Method::Auto, ode::van_der_pol),
    ] {
        let mut stepper = method.stepper(ode::tolerance(2, 1e-6), Limits::default());
        let mut problem = ode::Problem::new(2, f);
        let mut y = [2.0, 0.0];
        stepper.start(&mut problem, 0.0, &[2.0, 0.0], 1000.0).unwrap();
        let count = allocations(|| {
            while stepper.t() != 1000.0 {
                stepper.step(&mut problem, 1000.0).unwrap();
                stepper.interpolate(&mut problem, 0.5 * (stepper.previous() + stepper.t()), &mut y).unwrap();
            }
        });
        assert_eq!(count, 0, "{method:?}");
        assert_eq!(stepper.stiff(), method == Method::Auto);
    }
}
