//! Newton's iteration from random starts, with equations written here: it finds no assembly that is missing.

use super::*;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// A linkage of pins and guides; coordinates are x, y, θ of each moving body's frame.
struct Linkage {
    moving: usize,
    joints: Vec<SearchedJoint>,
}

/// Bodies, points in their frames, and the direction of a guide in the first.
type SearchedJoint = ([usize; 2], [[f64; 2]; 2], Option<[f64; 2]>);

impl Linkage {
    /// Drawn at random, all frames in the ground's.
    fn random(edges: &[[usize; 2]], random: &mut Random) -> Self {
        let joints = edges.iter().map(|bodies| {
            let place = [random.next(), random.next()];
            let angle = random.next() * TAU;
            let is_guide = random.next() > 0.7;
            (
                *bodies,
                [place; 2],
                is_guide.then(|| [angle.cos(), angle.sin()]),
            )
        });
        Linkage {
            moving: edges.iter().flatten().copied().max().unwrap_or(0),
            joints: joints.collect(),
        }
    }

    fn model(&self) -> Value {
        let name = |body: usize| match body {
            0 => "ground".to_owned(),
            body => format!("b{body}"),
        };
        let (mut bodies, mut joints) = (json!({}), json!({}));
        for (number, (between, points, guide)) in self.joints.iter().enumerate() {
            let joint = format!("j{number}");
            for (body, point) in between.iter().zip(points) {
                bodies[name(*body)]["points"][&joint] = json!(point);
            }
            let ends = between.map(|body| format!("{}.{joint}", name(body)));
            joints[&joint] = match guide {
                None => json!({ "type": "revolute", "between": ends }),
                Some(axis) => json!({ "type": "prismatic", "between": ends, "axis": axis }),
            };
        }
        json!({ "format": "linkdyn/1", "units": "SI", "bodies": bodies, "joints": joints })
    }

    /// Two equations a joint.
    fn residual(&self, q: &DVector<f64>) -> DVector<f64> {
        let frame = |body: usize| match body {
            0 => [0.0, 0.0, 0.0],
            body => [q[3 * body - 3], q[3 * body - 2], q[3 * body - 1]],
        };
        let turned = |[x, y]: [f64; 2], theta: f64| {
            [
                theta.cos() * x - theta.sin() * y,
                theta.sin() * x + theta.cos() * y,
            ]
        };
        let all = self.joints.iter().flat_map(|([a, b], [p, r], guide)| {
            let ([xa, ya, ta], [xb, yb, tb]) = (frame(*a), frame(*b));
            let ([pa, qa], [pb, qb]) = (turned(*p, ta), turned(*r, tb));
            let [dx, dy] = [xb + pb - xa - pa, yb + qb - ya - qa];
            match guide {
                None => [dx, dy],
                Some(axis) => {
                    let [ux, uy] = turned(*axis, ta);
                    [ux * dy - uy * dx, tb - ta - TAU * ((tb - ta) / TAU).round()]
                }
            }
        });
        DVector::from_iterator(2 * self.joints.len(), all)
    }

    fn jacobian(&self, q: &DVector<f64>) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(2 * self.joints.len(), q.len());
        for k in 0..q.len() {
            let mut moved = [q.clone(), q.clone()];
            moved[0][k] += 1e-6;
            moved[1][k] -= 1e-6;
            let column = (self.residual(&moved[0]) - self.residual(&moved[1])) / 2e-6;
            matrix.set_column(k, &column);
        }
        matrix
    }

    /// A regular solution from a start.
    fn solved(&self, mut q: DVector<f64>) -> Option<DVector<f64>> {
        for _ in 0..40 {
            let step = self.jacobian(&q).lu().solve(&self.residual(&q))?;
            // Far away a step means nothing.
            let shorter = f64::min(2.0 / step.amax(), 1.0);
            q -= shorter * step;
        }
        let is_regular = self.jacobian(&q).singular_values().min() > 1e-6;
        (self.residual(&q).amax() < 1e-10 && is_regular).then_some(q)
    }
}

const GROUPS: [&[[usize; 2]]; 5] = [
    &[[0, 1], [1, 2], [0, 2]],
    &[[0, 1], [0, 2], [0, 3], [1, 4], [2, 4], [3, 4]],
    // a dyad on a dyad
    &[[0, 1], [1, 2], [0, 2], [1, 3], [3, 4], [2, 4]],
    &[
        [0, 1],
        [0, 5],
        [0, 6],
        [1, 2],
        [2, 3],
        [2, 6],
        [3, 4],
        [4, 5],
        [4, 6],
    ],
    &[
        [0, 1],
        [0, 2],
        [0, 5],
        [0, 6],
        [1, 4],
        [2, 3],
        [3, 4],
        [3, 6],
        [4, 5],
    ],
];

/// Compares: assemblies that a search from so many starts found, and that are missing.
fn missing(linkage: &Linkage, starts: usize, random: &mut Random) -> Option<(usize, usize)> {
    let n = 3 * linkage.moving;
    if linkage.jacobian(&DVector::zeros(n)).singular_values().min() < 1e-4 {
        // Guides that hold each other.
        return None;
    }
    let found = all(&linkage.model());
    // Bodies are told in the order of the file.
    let place = |body: usize| {
        let name = format!("b{body}");
        found
            .bodies
            .iter()
            .position(|own| *own == name)
            .expect("there")
    };
    let mut count = 0;
    let mut absent = 0;
    for _ in 0..starts {
        let start = (0..n).map(|k| random.next() * if k % 3 == 2 { TAU / 2.0 } else { 2.0 });
        let Some(q) = linkage.solved(DVector::from_iterator(n, start)) else {
            continue;
        };
        if q.amax() > 1e3 {
            continue;
        }
        count += 1;
        let is_known = found.found.iter().any(|one| {
            (1..=linkage.moving).all(|body| {
                let pose = one.poses[place(body)];
                (0..3).all(|axis| {
                    let off = pose[axis] - q[3 * body - 3 + axis];
                    let off = if axis == 2 {
                        off - TAU * (off / TAU).round()
                    } else {
                        off
                    };
                    off.abs() < 1e-5 * (1.0 + q.amax())
                })
            })
        });
        absent += usize::from(!is_known);
    }
    Some((count, absent))
}

/// LINKDYN_LINKAGES and LINKDYN_STARTS ask for more.
#[test]
fn no_assembly_that_a_search_finds_is_missing() {
    let number = |name: &str, default: usize| {
        std::env::var(name).map_or(default, |text| text.parse().expect("a number"))
    };
    let (linkages, starts) = (number("LINKDYN_LINKAGES", 40), number("LINKDYN_STARTS", 40));
    let mut random = Random(7);
    let (mut compared, mut reached) = (0, 0);
    for number in 0..linkages {
        let linkage = Linkage::random(GROUPS[number % GROUPS.len()], &mut random);
        let Some((count, absent)) = missing(&linkage, starts, &mut random) else {
            continue;
        };
        assert_eq!(
            absent,
            0,
            "linkage {number} of {count}: {}",
            linkage.model()
        );
        compared += 1;
        reached += count;
    }
    eprintln!("{compared} linkages, {reached} times an assembly was reached");
    assert!(
        compared > linkages / 2 && reached > 4 * compared,
        "{compared} {reached}"
    );
}
