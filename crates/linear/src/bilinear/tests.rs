use super::*;

/// zᵀCw
fn value(equation: &BilinearEquation, root: &Root) -> f64 {
    let one = Number::new(1.0, 0.0);
    let z = std::iter::once(one).chain(root.z.iter().copied());
    let w: Vec<Number> = std::iter::once(one).chain(root.w.iter().copied()).collect();
    let rows = equation.coefficients.chunks(w.len()).zip(z);
    let terms = rows.flat_map(|(row, z)| row.iter().zip(&w).map(move |(c, w)| z * c * w));
    let sum = terms.clone().sum::<Number>().norm();
    sum / terms.map(|term| term.norm()).fold(1e-300, f64::max)
}

fn unit(p: usize, k: usize) -> Vec<Number> {
    let mut form = vec![Number::new(0.0, 0.0); p + 1];
    form[k] = 1.0.into();
    form
}

/// Equations with random coefficients of all products.
fn dense(p: usize, random: &mut Random) -> Vec<BilinearEquation> {
    let all = || (0..=p).map(|k| unit(p, k)).collect::<Vec<_>>();
    let one = |random: &mut Random| BilinearEquation {
        coefficients: (0..(p + 1) * (p + 1)).map(|_| random.turn()).collect(),
        factors: [all(), all()],
    };
    (0..2 * p).map(|_| one(random)).collect()
}

type Kind = fn(usize, &mut Random) -> Vec<BilinearEquation>;

/// Loops of bars in the plane: `turns` of them are Θₖ = aₖ + Σ bₖⱼ zⱼ with ΘₖΘ̄ₖ = 1, where Θ̄ₖ has conjugate coefficients.
fn bars(p: usize, random: &mut Random) -> Vec<BilinearEquation> {
    let one = |random: &mut Random| {
        let theta: Vec<Number> = (0..=p).map(|_| random.turn() * 1.3).collect();
        let conjugate: Vec<Number> = theta.iter().map(Number::conj).collect();
        let products = theta
            .iter()
            .flat_map(|a| conjugate.iter().map(move |b| a * b));
        let mut coefficients: Vec<Number> = products.collect();
        coefficients[0] -= 1.0;
        BilinearEquation {
            coefficients,
            factors: [vec![theta, unit(p, 0)], vec![conjugate, unit(p, 0)]],
        }
    };
    (0..2 * p).map(|_| one(random)).collect()
}

#[test]
fn there_are_as_many_roots_as_the_bound_says() {
    for (p, bound, systems) in [(1, 2, 50), (2, 6, 50), (3, 20, 20), (4, 70, 2)] {
        for (kind, is_conjugate) in [(dense as Kind, false), (bars, true)] {
            for seed in 0..systems {
                let equations = kind(p, &mut Random(seed));
                let found = roots(&equations, p);
                assert_eq!((found.regular.len(), found.lost), (bound, 0), "{p} {seed}");
                for root in &found.regular {
                    let worst = equations.iter().map(|one| value(one, root));
                    let worst = worst.fold(0.0, f64::max);
                    assert!(worst < 1e-11, "{p} {seed}: {worst:e}");
                }
                // With conjugate coefficients roots are real, w = z̄, or come in pairs, w and z exchanged.
                let is_pair = |root: &&Root| {
                    let conjugate = |x: &[Number]| x.iter().map(Number::conj).collect();
                    let other = Root {
                        z: conjugate(&root.w),
                        w: conjugate(&root.z),
                    };
                    found.regular.iter().any(|known| is_same(known, &other))
                };
                if is_conjugate {
                    assert_eq!(found.regular.iter().filter(is_pair).count(), bound);
                }
            }
        }
    }
}

/// z² + 1 = 0 by z = w, z w = −1; then z w = 0, a double root; then equations of which one follows from the other.
#[test]
fn quadratic_equations_are_solved_in_closed_form() {
    let of = |c: [[f64; 4]; 2]| {
        let one = |c: [f64; 4]| BilinearEquation {
            coefficients: c.map(Number::from).to_vec(),
            factors: [Vec::new(), Vec::new()],
        };
        roots(&c.map(one), 1)
    };
    let line = [0.0, -1.0, 1.0, 0.0];
    let found = of([line, [1.0, 0.0, 0.0, 1.0]]);
    let z: Vec<Number> = found.regular.iter().map(|root| root.z[0]).collect();
    assert_eq!(z.len(), 2);
    assert!(
        (z[0] + z[1]).norm() < 1e-15 && (z[0].im.abs() - 1.0).abs() < 1e-15,
        "{z:?}"
    );
    let found = of([line, [0.0, 0.0, 0.0, 1.0]]);
    assert_eq!((found.regular.len(), found.singular.len()), (0, 2));
    assert!(found.singular.iter().all(|root| root.z[0].norm() < 1e-15));
    // z = w and 1 = z: the other root is at infinity.
    let found = of([line, [1.0, 0.0, -1.0, 0.0]]);
    assert_eq!((found.regular.len(), found.infinite), (1, 1));
    let found = of([line, line.map(|c| 2.0 * c)]);
    assert!(found.regular.is_empty() && found.singular.len() == 3);
}
