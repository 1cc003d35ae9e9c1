//! Shapes in which an elastic bar bends and stretches, by Craig and Bampton (Coupling of substructures for dynamic analyses, 1968).
//!
//! ```text
//! static shapes    unit displacement or rotation where something is joined, nothing at all other such places
//! normal modes     of the bar held at all of these, so many as are requested
//! ```
//!
//! Both are found in polynomials of high degree between the places (cubic of Hermite and integrated Legendre polynomials: Szabó and
//! Babuška, Finite Element Analysis, 1991, ch. 3), whose error falls faster than any power of the degree: they are exact to
//! round-off. Bending shapes are then combined so that M and K are diagonal, and measured by their largest deflection.
//! Axial shapes are linear between joined places, and one parabola: what uniform inertia stretches.

use super::{CarriedPoint, Modal, SecondOrder, generalised};
use linkdyn_linear::math::Vec2;
use nalgebra::DMatrix;

/// Polynomials between two places beside the cubics and three for each mode.
const MORE: usize = 12;
/// Places at which the largest deflection is sought.
const SAMPLES: usize = 1200;

/// Where something is joined to a bar, or where it is cracked.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Place {
    /// From its beginning \[m\].
    pub x: f64,
    /// Something pushes there.
    pub is_pushed: bool,
    /// Something turns it there.
    pub is_turned: bool,
    /// Stiffness of a hinge there [N·m/rad], of a crack.
    pub hinge: Option<f64>,
}

/// A straight elastic bar from x = 0 on.
#[derive(Debug, Clone)]
pub struct Bar {
    /// L \[m\].
    pub length: f64,
    /// EI [N·m²].
    pub bending: f64,
    /// EA \[N\], of one that stretches.
    pub axial: Option<f64>,
    /// ρA [kg/m].
    pub mass: f64,
    /// ρI \[kg·m\], for turning as a whole.
    pub rotary: f64,
    /// Whether the frame goes through both ends, and is not tangent at the beginning.
    pub is_chord: bool,
    /// Number of normal modes.
    pub modes: usize,
    /// Ascending; the first is at 0 and the last at L.
    pub places: Vec<Place>,
}

/// Polynomials on the spans between the places.
struct Mesh<'b> {
    bar: &'b Bar,
    /// Polynomials of a span beside the four cubics.
    inner: usize,
    /// Gauss points and weights on [−1, 1].
    rule: Vec<[f64; 2]>,
}

/// w, w′ and w″, of each degree of freedom.
type Jets = Vec<(usize, [f64; 3])>;

impl Mesh<'_> {
    fn new(bar: &Bar) -> Mesh<'_> {
        let inner = 3 * bar.modes + MORE;
        Mesh {
            bar,
            inner,
            rule: gauss(inner + 5),
        }
    }

    fn spans(&self) -> usize {
        self.bar.places.len() - 1
    }

    /// Degrees of freedom: w and w′ of each place, polynomials of each span, w′ behind each hinge.
    fn count(&self) -> usize {
        let hinges = self.bar.places.iter().filter(|place| place.hinge.is_some());
        2 * self.bar.places.len() + self.spans() * self.inner + hinges.count()
    }

    /// w′ of a place as the span behind it has it.
    fn slope_behind(&self, place: usize) -> usize {
        if self.bar.places[place].hinge.is_none() {
            return 2 * place + 1;
        }
        let before = self.bar.places[..place].iter();
        let before = before.filter(|place| place.hinge.is_some()).count();
        2 * self.bar.places.len() + self.spans() * self.inner + before
    }

    /// Beginning and length of a span.
    fn span(&self, span: usize) -> [f64; 2] {
        let [from, to] = [span, span + 1].map(|k| self.bar.places[k].x);
        [from, to - from]
    }

    /// All that does not vanish in a span, at ξ in [−1, 1].
    fn jets(&self, span: usize, xi: f64) -> Jets {
        let [_, h] = self.span(span);
        let (a, b) = (1.0 - xi, 1.0 + xi);
        let cubics = [
            [a * a * (2.0 + xi) / 4.0, -0.75 * a * b, 1.5 * xi],
            [
                h / 8.0 * a * a * b,
                h / 8.0 * a * (a - 2.0 * b),
                h / 4.0 * (3.0 * xi - 1.0),
            ],
            [b * b * (2.0 - xi) / 4.0, 0.75 * a * b, -1.5 * xi],
            [
                -h / 8.0 * b * b * a,
                h / 8.0 * b * (b - 2.0 * a),
                h / 4.0 * (3.0 * xi + 1.0),
            ],
        ];
        let own = [
            2 * span,
            self.slope_behind(span),
            2 * span + 2,
            2 * span + 3,
        ];
        let legendre = legendre(self.inner + 3, xi);
        let inner = (2..self.inner + 2).map(|j| {
            let p = |k: usize| legendre[k];
            let n = j as f64;
            let once = (p(j + 1) - p(j - 1)) / (2.0 * n + 1.0);
            let outer = (p(j + 2) - p(j)) / (2.0 * n + 3.0);
            let twice = (outer - (p(j) - p(j - 2)) / (2.0 * n - 1.0)) / (2.0 * n + 1.0);
            [twice, once, p(j)]
        });
        let first = 2 * self.bar.places.len() + span * self.inner;
        let numbers = own.into_iter().chain(first..first + self.inner);
        let by = 2.0 / h;
        numbers
            .zip(cubics.into_iter().chain(inner))
            .map(|(dof, [w, d, dd])| (dof, [w, d * by, dd * by * by]))
            .collect()
    }

    /// The span of a place on the axis, and ξ there.
    fn find(&self, x: f64) -> (usize, f64) {
        let inner = &self.bar.places[1..self.spans()];
        let span = inner.iter().filter(|place| place.x <= x).count();
        let [from, h] = self.span(span);
        (span, 2.0 * (x - from) / h - 1.0)
    }

    /// Gauss points of a span: span, ξ, x, weight.
    fn samples(&self, span: usize) -> impl Iterator<Item = (usize, f64, f64, f64)> + '_ {
        let [from, h] = self.span(span);
        let rule = self.rule.iter();
        rule.map(move |[xi, weight]| (span, *xi, from + h * (1.0 + xi) / 2.0, weight * h / 2.0))
    }

    /// ∫ρA w² and ∫EI w″² with the hinges, of all degrees of freedom.
    fn matrices(&self) -> [DMatrix<f64>; 2] {
        let n = self.count();
        let [mut mass, mut stiffness] = [DMatrix::zeros(n, n), DMatrix::zeros(n, n)];
        for (span, xi, _, weight) in (0..self.spans()).flat_map(|span| self.samples(span)) {
            let jets = self.jets(span, xi);
            for (i, a) in &jets {
                for (j, b) in &jets {
                    mass[(*i, *j)] += self.bar.mass * weight * a[0] * b[0];
                    stiffness[(*i, *j)] += self.bar.bending * weight * a[2] * b[2];
                }
            }
        }
        for (k, place) in self.bar.places.iter().enumerate() {
            if let Some(hinge) = place.hinge {
                let (i, j) = (2 * k + 1, self.slope_behind(k));
                for (row, column, sign) in [(i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)] {
                    stiffness[(row, column)] += sign * hinge;
                }
            }
        }
        [mass, stiffness]
    }
}

/// w, w′, w″ of bending shapes and u, u′ of axial ones.
type BarJets = (Vec<[f64; 3]>, Vec<[f64; 2]>);

/// The shapes of a bar.
pub struct Shapes {
    bar: Bar,
    inner: usize,
    rule: Vec<[f64; 2]>,
    /// Bending shapes by the degrees of freedom (columns).
    bending: DMatrix<f64>,
}

impl Bar {
    /// The shapes of the bar; `None` where it can't be held (a hinge leaves it loose).
    pub fn shapes(&self) -> Option<Shapes> {
        let mesh = Mesh::new(self);
        let [mass, stiffness] = mesh.matrices();
        let last = self.places.len() - 1;
        let by_frame = if self.is_chord { [0, 2 * last] } else { [0, 1] };
        let joined = self.places.iter().enumerate().flat_map(|(k, place)| {
            let both = [(2 * k, place.is_pushed), (2 * k + 1, place.is_turned)];
            both.into_iter().filter(|(_, is_joined)| *is_joined)
        });
        let joined: Vec<usize> = joined
            .map(|(dof, _)| dof)
            .filter(|dof| !by_frame.contains(dof))
            .collect();
        let free: Vec<usize> = (0..mesh.count())
            .filter(|dof| !by_frame.contains(dof) && !joined.contains(dof))
            .collect();
        let part = |a: &DMatrix<f64>, rows: &[usize], columns: &[usize]| {
            a.select_rows(rows).select_columns(columns)
        };
        let inner = part(&stiffness, &free, &free);
        let root = inner.clone().cholesky()?;
        let mut basis = DMatrix::zeros(mesh.count(), joined.len() + self.modes);
        for (column, dof) in joined.iter().enumerate() {
            let follow = root.solve(&part(&stiffness, &free, &[*dof]));
            basis[(*dof, column)] = 1.0;
            for (k, row) in free.iter().enumerate() {
                basis[(*row, column)] = -follow[(k, 0)];
            }
        }
        let (_, normal) = generalised(&inner, &part(&mass, &free, &free))?;
        for mode in 0..self.modes.min(normal.ncols()) {
            for (k, row) in free.iter().enumerate() {
                basis[(*row, joined.len() + mode)] = normal[(k, mode)];
            }
        }
        let reduced = |a: &DMatrix<f64>| {
            let own = basis.transpose() * a * &basis;
            (&own + own.transpose()) * 0.5
        };
        let (_, combined) = generalised(&reduced(&stiffness), &reduced(&mass))?;
        let mut shapes = Shapes {
            bar: self.clone(),
            inner: mesh.inner,
            rule: mesh.rule.clone(),
            bending: basis * combined,
        };
        shapes.scale();
        Some(shapes)
    }

    /// Axial shapes and their slopes at a place: linear between joined places, and a parabola.
    fn stretches(&self, x: f64) -> Vec<[f64; 2]> {
        if self.axial.is_none() {
            return Vec::new();
        }
        let last = self.places.len() - 1;
        let joined: Vec<f64> = (0..=last)
            .filter(|&k| k == 0 || k == last || self.places[k].is_pushed)
            .map(|k| self.places[k].x)
            .collect();
        let hats = (1..joined.len()).map(|k| {
            let (from, own) = (joined[k - 1], joined[k]);
            match joined.get(k + 1) {
                Some(to) if x > own => [(to - x) / (to - own), -1.0 / (to - own)],
                _ if x >= from => [(x - from) / (own - from), 1.0 / (own - from)],
                _ => [0.0; 2],
            }
        });
        let hats = hats.map(|[u, d]| match u >= 0.0 {
            true => [u, d],
            false => [0.0; 2],
        });
        let s = x / self.length;
        let parabola = [4.0 * s * (1.0 - s), 4.0 * (1.0 - 2.0 * s) / self.length];
        hats.chain([parabola]).collect()
    }
}

impl Shapes {
    fn mesh(&self) -> Mesh<'_> {
        Mesh {
            bar: &self.bar,
            inner: self.inner,
            rule: self.rule.clone(),
        }
    }

    /// Number of bending shapes; the others are axial.
    pub fn bending(&self) -> usize {
        self.bending.ncols()
    }

    /// w, w′ and w″ of the bending shapes.
    fn bent(&self, jets: &Jets) -> Vec<[f64; 3]> {
        let shape = |k: usize| {
            jets.iter().fold([0.0; 3], |sum, (dof, jet)| {
                let by = self.bending[(*dof, k)];
                [0, 1, 2].map(|order: usize| sum[order] + by * jet[order])
            })
        };
        (0..self.bending()).map(shape).collect()
    }

    /// w, w′ and w″ of the bending shapes at a place of the axis.
    pub fn bent_at(&self, x: f64) -> Vec<[f64; 3]> {
        let mesh = self.mesh();
        let (span, xi) = mesh.find(x);
        self.bent(&mesh.jets(span, xi))
    }

    /// Measures shapes by their largest deflection, which is positive where it comes first.
    fn scale(&mut self) {
        let samples: Vec<Vec<f64>> = (0..=SAMPLES)
            .map(|k| self.bar.length * k as f64 / SAMPLES as f64)
            .map(|x| self.bent_at(x).iter().map(|jet| jet[0]).collect())
            .collect();
        for k in 0..self.bending() {
            let of = || samples.iter().map(|sample| sample[k]);
            let most = of().fold(0.0, |most: f64, w| most.max(w.abs()));
            let first = of().find(|w| w.abs() > 0.5 * most).unwrap_or(1.0);
            self.bending
                .column_mut(k)
                .unscale_mut(most * first.signum());
        }
    }

    /// ∫ from 0 to x of w′_i w′_j.
    fn shortened(&self, x: f64) -> DMatrix<f64> {
        let (mesh, n) = (self.mesh(), self.bending());
        let mut sum = DMatrix::zeros(n, n);
        let (last, xi) = mesh.find(x);
        let mut add = |span: usize, xi: f64, weight: f64| {
            let jets = self.bent(&mesh.jets(span, xi));
            for i in 0..n {
                for j in 0..n {
                    sum[(i, j)] += weight * jets[i][1] * jets[j][1];
                }
            }
        };
        for (span, xi, _, weight) in (0..last).flat_map(|span| mesh.samples(span)) {
            add(span, xi, weight);
        }
        let part = (1.0 + xi) / 2.0;
        for (span, own, _, weight) in mesh.samples(last) {
            add(span, part * (1.0 + own) - 1.0, part * weight);
        }
        sum
    }

    /// How the section at a place of the axis moves.
    pub fn moved(&self, x: f64) -> CarriedPoint {
        let (bent, stretched) = (self.bent_at(x), self.bar.stretches(x));
        let n = bent.len() + stretched.len();
        let across = bent.iter().map(|jet| Vec2::new(0.0, jet[0]));
        let along = stretched.iter().map(|jet| Vec2::new(jet[0], 0.0));
        let short = self.shortened(x);
        let second = |i: usize, j: usize| match i.max(j) < bent.len() {
            true => Vec2::new(-short[(i, j)], 0.0),
            false => Vec2::zeros(),
        };
        CarriedPoint {
            place: Vec2::new(x, 0.0),
            moves: across.chain(along).collect(),
            turns: bent
                .iter()
                .map(|jet| jet[1])
                .chain(stretched.iter().map(|_| 0.0))
                .collect(),
            shortens: (0..n)
                .map(|i| (0..n).map(|j| second(i, j)).collect())
                .collect(),
        }
    }

    /// Matrices and integrals of the bar by these shapes.
    pub fn modal(&self) -> Modal {
        let (bar, mesh, n) = (&self.bar, self.mesh(), self.bending());
        let (l, mass) = (bar.length, bar.mass);
        let samples: Vec<(usize, f64, f64, f64)> = (0..mesh.spans())
            .flat_map(|span| mesh.samples(span))
            .collect();
        let jets: Vec<BarJets> = samples
            .iter()
            .map(|(span, xi, x, _)| (self.bent(&mesh.jets(*span, *xi)), bar.stretches(*x)))
            .collect();
        let all = n + bar.stretches(0.0).len();
        // Displacements of a shape at a sample: along and across.
        let shape = |(bent, stretched): &BarJets, k: usize| match k < n {
            true => Vec2::new(0.0, bent[k][0]),
            false => Vec2::new(stretched[k - n][0], 0.0),
        };
        let integral = |f: &dyn Fn(usize) -> f64| -> f64 {
            let terms = samples.iter().enumerate();
            terms.map(|(s, (_, _, _, weight))| weight * f(s)).sum()
        };
        let [matrix, mut stiffness] = [0, 1].map(|_| DMatrix::<f64>::zeros(all, all));
        let (mut matrix, mut gyroscopic) = (matrix, DMatrix::zeros(all, all));
        let ea = bar.axial.unwrap_or(0.0);
        for i in 0..all {
            for j in 0..all {
                let pair = |s: usize| (shape(&jets[s], i), shape(&jets[s], j));
                matrix[(i, j)] = mass * integral(&|s| pair(s).0.dot(&pair(s).1));
                gyroscopic[(i, j)] = mass * integral(&|s| pair(s).0.perp(&pair(s).1));
                stiffness[(i, j)] = match (i < n, j < n) {
                    (true, true) => {
                        let bend = integral(&|s| jets[s].0[i][2] * jets[s].0[j][2]);
                        let hinges = bar.places.iter().enumerate();
                        let kink = hinges.filter_map(|(k, place)| {
                            let turned = |shape: usize| {
                                self.bending[(mesh.slope_behind(k), shape)]
                                    - self.bending[(2 * k + 1, shape)]
                            };
                            Some(place.hinge? * turned(i) * turned(j))
                        });
                        bar.bending * bend + kink.sum::<f64>()
                    }
                    (false, false) => ea * integral(&|s| jets[s].1[i - n][1] * jets[s].1[j - n][1]),
                    _ => 0.0,
                };
            }
        }
        // ∫ from a sample to the end of each shape.
        let tails: Vec<Vec<f64>> = samples
            .iter()
            .map(|sample| self.tails(&mesh, sample))
            .collect();
        let second = |tail: &dyn Fn(usize) -> f64| {
            DMatrix::from_fn(all, all, |i, j| match i.max(j) < n {
                true => -mass * integral(&|s| jets[s].0[i][1] * jets[s].0[j][1] * tail(s)),
                false => 0.0,
            })
        };
        let x = |s: usize| samples[s].2;
        let vector = |k: usize| {
            let part = |axis: usize| mass * integral(&|s| shape(&jets[s], k)[axis]);
            Vec2::new(part(0), part(1))
        };
        let moment = |k: usize, axis: usize| mass * integral(&|s| x(s) * shape(&jets[s], k)[axis]);
        Modal {
            rigid: (
                mass * l,
                Vec2::new(mass * l * l / 2.0, 0.0),
                mass * l.powi(3) / 3.0 + bar.rotary * l,
            ),
            matrices: [matrix, stiffness, DMatrix::zeros(all, all)],
            momentum: (0..all).map(vector).collect(),
            moments: [0, 1].map(|axis| (0..all).map(|k| moment(k, axis)).collect()),
            gyroscopic,
            second: Some(SecondOrder {
                rigid: [
                    second(&|s| l - x(s)),
                    second(&|s| (l * l - x(s) * x(s)) / 2.0),
                ],
                bent: (0..all)
                    .map(|k| {
                        let own = second(&|s| tails[s][k]);
                        match k < n {
                            true => [DMatrix::zeros(all, all), -own],
                            false => [own, DMatrix::zeros(all, all)],
                        }
                    })
                    .collect(),
            }),
        }
    }

    /// ∫ from a sample to the end of each shape, bending ones first.
    fn tails(&self, mesh: &Mesh, (span, xi, _, _): &(usize, f64, f64, f64)) -> Vec<f64> {
        let mut sums = vec![0.0; self.bending() + self.bar.stretches(0.0).len()];
        let mut add = |span: usize, xi: f64, weight: f64| {
            let [from, h] = mesh.span(span);
            let bent = self.bent(&mesh.jets(span, xi));
            let stretched = self.bar.stretches(from + h * (1.0 + xi) / 2.0);
            let bent = bent.iter().map(|jet| jet[0]);
            let values = bent.chain(stretched.iter().map(|jet| jet[0]));
            sums.iter_mut()
                .zip(values)
                .for_each(|(sum, value)| *sum += weight * value);
        };
        let part = (1.0 - xi) / 2.0;
        for (span, own, _, weight) in mesh.samples(*span) {
            add(span, 1.0 - part * (1.0 - own), part * weight);
        }
        for (span, own, _, weight) in (span + 1..mesh.spans()).flat_map(|span| mesh.samples(span)) {
            add(span, own, weight);
        }
        sums
    }
}

/// Legendre polynomials P_0 … P_n.
fn legendre(n: usize, x: f64) -> Vec<f64> {
    let mut p = vec![1.0, x];
    for k in 1..n {
        let m = k as f64;
        p.push(((2.0 * m + 1.0) * x * p[k] - m * p[k - 1]) / (m + 1.0));
    }
    p
}

/// Points and weights of Gauss and Legendre on [−1, 1].
fn gauss(n: usize) -> Vec<[f64; 2]> {
    let point = |k: usize| {
        let count = n as f64;
        let mut x = (std::f64::consts::PI * (k as f64 + 0.75) / (count + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..60 {
            let p = legendre(n, x);
            slope = count * (x * p[n] - p[n - 1]) / (x * x - 1.0);
            let step = p[n] / slope;
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        [x, 2.0 / ((1.0 - x * x) * slope * slope)]
    };
    (0..n).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DVector;
    use std::f64::consts::PI;

    fn bar(is_chord: bool, modes: usize, places: Vec<Place>) -> Bar {
        Bar {
            length: 2.0,
            bending: 3.0,
            axial: None,
            mass: 0.5,
            rotary: 0.0,
            is_chord,
            modes,
            places,
        }
    }

    fn at(x: f64) -> Place {
        Place {
            x,
            ..Place::default()
        }
    }

    fn frequencies(bar: &Bar) -> Vec<f64> {
        let modal = bar.shapes().expect("shapes").modal();
        let [mass, stiffness, _] = &modal.matrices;
        let scale = (bar.bending / bar.mass).sqrt() / bar.length.powi(2);
        let (squares, _) = generalised(stiffness, mass).expect("modes");
        squares.iter().map(|square| square.sqrt() / scale).collect()
    }

    #[test]
    fn modes_of_a_pinned_bar_are_sines() {
        let pinned = bar(true, 5, vec![at(0.0), at(2.0)]);
        let shapes = pinned.shapes().expect("shapes");
        for x in [0.1, 0.77, 1.5] {
            for (k, jet) in shapes.bent_at(x).iter().enumerate() {
                let wave = (k + 1) as f64 * PI / 2.0;
                assert!((jet[0] - (wave * x).sin()).abs() < 1e-10, "{k}: {jet:?}");
                assert!((jet[1] - wave * (wave * x).cos()).abs() < 1e-8);
            }
        }
        for (k, own) in frequencies(&pinned).iter().enumerate() {
            let known = ((k + 1) as f64 * PI).powi(2);
            assert!((own / known - 1.0).abs() < 1e-11, "{own} {known}");
        }
        let modal = shapes.modal();
        // ∫sin, ∫x sin, and ½ of the mass.
        assert!((modal.momentum[0].y - 2.0 / PI).abs() < 1e-12);
        assert!((modal.moments[1][1] + 0.5 * 4.0 / (2.0 * PI)).abs() < 1e-12);
        assert!((modal.matrices[0][(0, 0)] - 0.5).abs() < 1e-12);
        // −½ ∫w′² of the first mode: −(π/L)² x/2 …; Γ = −∫w′².
        let short = shapes.moved(2.0).shortens[0][0];
        assert!((short.x + PI * PI / 4.0).abs() < 1e-10, "{short}");
    }

    /// Roots of cos βL cosh βL = −1, squared (Blevins, Formulas for Natural Frequency and Mode Shape, 1979, table 8-1).
    #[test]
    fn modes_of_a_cantilever_are_known() {
        let known = [3.516_015_268_5, 22.034_491_564, 61.697_214_4, 120.901_916];
        let free = bar(false, 4, vec![at(0.0), at(2.0)]);
        for (own, known) in frequencies(&free).iter().zip(known) {
            assert!((own / known - 1.0).abs() < 1e-8, "{own} {known}");
        }
        // With what is pushed at its end: static shape and modes of the propped bar.
        let pushed = Place {
            is_pushed: true,
            ..at(2.0)
        };
        let own = frequencies(&bar(false, 3, vec![at(0.0), pushed]));
        for (own, (known, within)) in own.iter().zip(known.iter().zip([2e-5, 1e-3, 1e-2])) {
            assert!((own / known - 1.0).abs() < within, "{own} {known}");
        }
        // Places where nothing happens change nothing.
        let divided = frequencies(&bar(false, 2, vec![at(0.0), at(0.3), at(2.0)]));
        assert!((divided[1] / known[1] - 1.0).abs() < 1e-8, "{divided:?}");
    }

    /// Symmetric modes of a pinned bar with a hinge in the middle: tan βl − tanh βl = 4 k/(EI β), l = L/2, by bisection.
    #[test]
    fn a_hinge_lowers_frequencies_as_is_known() {
        let hinged = Place {
            hinge: Some(4.0),
            ..at(1.0)
        };
        let own = frequencies(&bar(true, 2, vec![at(0.0), hinged, at(2.0)]))[0].sqrt() / 2.0;
        let off = |beta: f64| beta.tan() - beta.tanh() - 4.0 * 4.0 / (3.0 * beta);
        let (mut low, mut high) = (0.1, PI / 2.0 - 1e-9);
        for _ in 0..100 {
            let middle = (low + high) / 2.0;
            if off(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        assert!((own / low - 1.0).abs() < 1e-9, "{own} {low}");
    }

    #[test]
    fn static_shapes_carry_loads_exactly() {
        // A pinned bar with a load at a: w = P a² b²/(3 EI L).
        let (a, b) = (0.5, 1.5);
        let pushed = Place {
            is_pushed: true,
            ..at(a)
        };
        let deflection = |place: Place| -> f64 {
            let shapes = bar(true, 1, vec![at(0.0), place, at(2.0)])
                .shapes()
                .expect("shapes");
            let here: Vec<f64> = shapes.moved(a).moves.iter().map(|own| own.y).collect();
            let load = DVector::from_vec(here.clone());
            let stiffness = shapes.modal().matrices[1].clone();
            let q = stiffness.lu().solve(&load).expect("stiff");
            q.iter().zip(&here).map(|(q, here)| q * here).sum()
        };
        let w = deflection(pushed);
        let known = a * a * b * b / (3.0 * 3.0 * 2.0);
        assert!((w / known - 1.0).abs() < 1e-10, "{w} {known}");
        // A hinge adds M(a)²/k.
        let hinged = Place {
            hinge: Some(4.0),
            ..pushed
        };
        let w = deflection(hinged);
        let known = known + (a * b / 2.0).powi(2) / 4.0;
        assert!((w / known - 1.0).abs() < 1e-9, "{w} {known}");
    }
}
