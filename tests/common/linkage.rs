//! Linkages as matrices, for tests and benches: bodies with three coordinates (x, y, θ), pins with two rows.

#![allow(dead_code)]

/// Entries (row, column, value) of a matrix, each position once.
#[derive(Debug, Clone)]
pub struct Matrix {
    pub rows: usize,
    pub columns: usize,
    pub entries: Vec<(usize, usize, f64)>,
}

impl Matrix {
    /// Row-major.
    pub fn dense(&self) -> Vec<f64> {
        let mut dense = vec![0.0; self.rows * self.columns];
        for &(row, column, value) in &self.entries {
            dense[row * self.columns + column] += value;
        }
        dense
    }

    pub fn positions(&self) -> Vec<(usize, usize)> {
        self.entries
            .iter()
            .map(|&(row, column, _)| (row, column))
            .collect()
    }
}

/// Small repeatable random numbers (splitmix64).
#[derive(Debug, Clone)]
pub struct Random(pub u64);

impl Random {
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.word() % n as u64) as usize
    }

    /// In [−1, 1).
    pub fn signed(&mut self) -> f64 {
        (self.word() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// A body by number and an arm from its centre of mass [m], in world directions; no body means the ground.
pub type End = (Option<usize>, [f64; 2]);

/// Rows of J for pins, then one row per driven angle.
pub fn jacobian(bodies: usize, pins: &[(End, End)], driven: &[usize]) -> Matrix {
    let mut entries = Vec::new();
    for (pin, &(first, second)) in pins.iter().enumerate() {
        for ((body, arm), sign) in [(first, 1.0), (second, -1.0)] {
            if let Some(body) = body {
                entries.push((2 * pin, 3 * body, sign));
                entries.push((2 * pin, 3 * body + 2, -sign * arm[1]));
                entries.push((2 * pin + 1, 3 * body + 1, sign));
                entries.push((2 * pin + 1, 3 * body + 2, sign * arm[0]));
            }
        }
    }
    for (number, &body) in driven.iter().enumerate() {
        entries.push((2 * pins.len() + number, 3 * body + 2, 1.0));
    }
    Matrix {
        rows: 2 * pins.len() + driven.len(),
        columns: 3 * bodies,
        entries,
    }
}

/// [M Jᵀ; J 0], with mass 1 kg, inertia 0.1 kg·m², varied by up to a half.
pub fn kkt(jac: &Matrix, random: &mut Random) -> Matrix {
    let q = jac.columns;
    let mut entries: Vec<(usize, usize, f64)> = (0..q)
        .map(|i| {
            (
                i,
                i,
                (if i % 3 == 2 { 0.1 } else { 1.0 }) * (1.0 + 0.5 * random.signed()),
            )
        })
        .collect();
    for &(row, column, value) in &jac.entries {
        entries.push((q + row, column, value));
        entries.push((column, q + row, value));
    }
    Matrix {
        rows: q + jac.rows,
        columns: q + jac.rows,
        entries,
    }
}

/// `cells` parallel cranks in a row, joined by couplers: 2 cells + 1 bodies, one degree of freedom. Crank angle [rad].
pub fn four_bar_chain(cells: usize, angle: f64) -> (usize, Vec<(End, End)>) {
    let crank = |i: usize| 0.3 + 0.02 * (i % 3) as f64;
    let up = [angle.cos(), angle.sin()];
    let along = [(0.2 * angle).cos(), (0.2 * angle).sin()];
    let scaled = |direction: [f64; 2], length: f64| [direction[0] * length, direction[1] * length];
    let mut pins = Vec::new();
    for i in 0..=cells {
        pins.push(((None, [0.0; 2]), (Some(2 * i), scaled(up, -0.5 * crank(i)))));
        if i < cells {
            pins.push((
                (Some(2 * i), scaled(up, 0.5 * crank(i))),
                (Some(2 * i + 1), scaled(along, -0.4)),
            ));
            pins.push((
                (Some(2 * i + 1), scaled(along, 0.4)),
                (Some(2 * i + 2), scaled(up, 0.5 * crank(i + 1))),
            ));
        }
    }
    (2 * cells + 1, pins)
}

/// Square cells of struts pinned together at the nodes: 2k(k+1) bodies, many loops, more freedoms than constraints.
pub fn grid(cells: usize) -> (usize, Vec<(End, End)>) {
    let k = cells;
    let mut at_node: Vec<Vec<(usize, [f64; 2])>> = vec![Vec::new(); (k + 1) * (k + 1)];
    let mut bodies = 0;
    let mut random = Random(7);
    for row in 0..=k {
        for column in 0..=k {
            for (step, reach) in [((0, 1), [0.5, 0.0]), ((1, 0), [0.0, 0.5])] {
                let (r, c) = (row + step.0, column + step.1);
                // The lowest struts stand for the ground and are left out.
                if r > k || c > k || row == 0 && step.0 == 0 {
                    continue;
                }
                let tilt = [
                    reach[0] + 0.1 * random.signed(),
                    reach[1] + 0.1 * random.signed(),
                ];
                at_node[row * (k + 1) + column].push((bodies, [-tilt[0], -tilt[1]]));
                at_node[r * (k + 1) + c].push((bodies, tilt));
                bodies += 1;
            }
        }
    }
    let mut pins = Vec::new();
    for (node, ends) in at_node.iter().enumerate() {
        let (mut first, mut rest) = ((None, [0.0; 2]), &ends[..]);
        if node > k {
            let Some((&(body, arm), others)) = ends.split_first() else {
                continue;
            };
            (first, rest) = ((Some(body), arm), others);
        }
        pins.extend(rest.iter().map(|&(body, arm)| (first, (Some(body), arm))));
    }
    (bodies, pins)
}

/// A Watt six-bar: crank, coupler, rocker and a dyad; seven pins and a driven crank make J 15 × 15.
pub fn six_bar(angle: f64) -> Matrix {
    let (c, s) = (angle.cos(), angle.sin());
    let pins = [
        ((None, [0.0; 2]), (Some(0), [-0.05 * c, -0.05 * s])),
        ((Some(0), [0.05 * c, 0.05 * s]), (Some(1), [-0.2, -0.03])),
        ((Some(1), [0.2, 0.03]), (Some(2), [0.04, 0.15])),
        ((None, [0.0; 2]), (Some(2), [-0.04, -0.15])),
        ((Some(1), [0.1, 0.2]), (Some(3), [-0.25, 0.07])),
        ((Some(3), [0.25, -0.07]), (Some(4), [0.02, 0.12])),
        ((None, [0.0; 2]), (Some(4), [-0.02, -0.12])),
    ];
    jacobian(5, &pins, &[0])
}

/// Bodies pinned one to an earlier one or the ground, `loops` more pins between any two; arms up to 1 m.
pub fn random_linkage(
    bodies: usize,
    loops: usize,
    random: &mut Random,
) -> (usize, Vec<(End, End)>) {
    let mut pins = Vec::new();
    for number in 0..bodies + loops {
        let body = if number < bodies {
            number
        } else {
            random.below(bodies)
        };
        let other = if number < bodies {
            random.below(number + 1)
        } else {
            random.below(bodies + 1)
        };
        // The last number stands for the ground, and a body is not pinned to itself.
        let ground = if number < bodies { number } else { bodies };
        let other = (other != ground && other != body).then_some(other);
        let mut arm = || [random.signed(), random.signed()];
        pins.push(((other, arm()), (Some(body), arm())));
    }
    (bodies, pins)
}
