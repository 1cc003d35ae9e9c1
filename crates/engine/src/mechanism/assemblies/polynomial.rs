//! All places of a group of bodies, where those before it are known.
//!
//! ```text
//! unknown     r of each body, and one turn Ξ of all bodies that turn alike, Θ_b = Ξ e^{iβ_b}
//! linear      pins                                  L (r, Ξ) = c        ⇒  (r, Ξ) = N y,  y = (1, y₁ … y_p)
//! bilinear    ΞΞ̄ = 1, guides, lengths               2p of them in y and ȳ
//! ```
//!
//! y and ȳ are unknowns of their own; a root is real where ȳ is the conjugate of y (isotropic coordinates: Wampler, Proc. R. Soc. A 457,
//! 2001). p is the number of loops.

use super::groups::{Group, PolynomialRow};
use crate::element::BodyId;
use crate::element::algebra::{Algebraic, FormPart, LinearForm};
use linkdyn_linear::bilinear::{BilinearEquation, Number, Random, Root, roots};

/// A place: r by the mechanism's size, θ \[rad\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BodyPlace {
    pub r: Number,
    pub theta: f64,
}

/// The places of a group.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct GroupPlaces {
    /// Real roots: places of the bodies, in the order of the group.
    pub places: Vec<Vec<BodyPlace>>,
    /// p
    pub loops: usize,
    /// Paths, and isolated roots in complex numbers.
    pub paths: usize,
    pub complex: usize,
    /// Whether a real root is multiple, or one of a curve of roots.
    pub is_singular: bool,
    /// Whether all isolated roots were found.
    pub is_complete: bool,
}

/// Pivots below this part of the largest are none.
const DEPENDENT: f64 = 1e-10;
/// Distance of ȳ from the conjugate of y up to which a root is taken for real; Newton's iteration decides afterwards.
const REAL: f64 = 1e-6;
const NEARLY_REAL: f64 = 1e-2;

/// The turn of a body: that of a class, and an angle more; class `None` is known.
#[derive(Debug, Clone, Copy)]
struct BodyTurn {
    class: Option<usize>,
    angle: f64,
}

/// The unknowns of a group.
struct Unknowns<'a> {
    group: &'a Group,
    known: &'a [Option<BodyPlace>],
    size: f64,
    turns: Vec<BodyTurn>,
    classes: usize,
}

impl Unknowns<'_> {
    /// How many there are: the constant in front.
    fn len(&self) -> usize {
        1 + self.group.bodies.len() + self.classes
    }

    fn position(&self, body: BodyId) -> Option<usize> {
        self.group.bodies.iter().position(|own| *own == body)
    }

    /// Coefficients of a form, lengths by the mechanism's size; `is_length` of forms in m.
    fn row(&self, form: &LinearForm, is_length: bool) -> Vec<Number> {
        let size = if is_length { self.size } else { 1.0 };
        let mut row = vec![Number::new(0.0, 0.0); self.len()];
        for (body, part, factor) in &form.0 {
            match (self.position(*body), part) {
                (Some(own), FormPart::Place) => row[1 + own] += factor,
                (Some(own), FormPart::Turn) => {
                    let turn = self.turns[own];
                    let factor = factor * Number::from_polar(1.0 / size, turn.angle);
                    let at = turn
                        .class
                        .map_or(0, |class| 1 + self.group.bodies.len() + class);
                    row[at] += factor;
                }
                (None, part) => {
                    let place = self.known[body.0].unwrap_or(GROUND);
                    row[0] += match part {
                        FormPart::Place => factor * place.r,
                        FormPart::Turn => factor * Number::from_polar(1.0 / size, place.theta),
                    };
                }
            }
        }
        row
    }
}

const GROUND: BodyPlace = BodyPlace {
    r: Number::new(0.0, 0.0),
    theta: 0.0,
};

/// All places of the group where `known` are those before it; `near` are angles whose turn is meant, by body. `expected` keeps the number of
/// isolated roots with random dimensions, once it was asked for. `None` if its rows are no
/// polynomials or determine nothing.
pub(super) fn placed(
    group: &Group,
    rows: &[PolynomialRow],
    known: &[Option<BodyPlace>],
    size: f64,
    near: &dyn Fn(BodyId) -> f64,
    expected: &mut Option<Option<usize>>,
) -> Option<GroupPlaces> {
    let own: Option<Vec<&Algebraic>> = group
        .rows
        .iter()
        .map(|row| rows[*row].algebra.as_ref())
        .collect();
    let own = own?;
    let (turns, classes) = turns(group, &own, known)?;
    let unknowns = Unknowns {
        group,
        known,
        size,
        turns,
        classes,
    };
    let rows = Sided::new(&unknowns, &own);
    let Some(reduced) = BilinearSystem::new(&rows, &rows.conjugate(), unknowns.len()) else {
        // Pins that contradict each other: no place at all.
        return Some(GroupPlaces {
            places: Vec::new(),
            loops: 0,
            paths: 0,
            complex: 0,
            is_singular: false,
            is_complete: true,
        });
    };
    let p = reduced.p();
    if reduced.equations.len() != 2 * p {
        return None;
    }
    let found = roots(&reduced.equations, p);
    let mut is_counted = || {
        let bodies = group.bodies.len();
        let expected = *expected.get_or_insert_with(|| rows.generic_count(bodies, unknowns.len()));
        expected == Some(found.regular.len())
    };
    let mut answer = GroupPlaces {
        places: Vec::new(),
        loops: p,
        paths: found.paths(),
        complex: found.regular.len(),
        is_singular: false,
        is_complete: found.lost == 0 && (found.stuck == 0 || is_counted()),
    };
    let all = found.regular.iter().map(|root| (root, REAL));
    // Of a curve one point will do.
    let most = if found.is_curve { 1 } else { usize::MAX };
    let singular = found.singular.iter().map(|root| (root, NEARLY_REAL));
    for (root, tolerance) in all.chain(singular) {
        if let Some(values) = real(root, &reduced.basis, tolerance)
            && answer.places.len() < most
        {
            answer.is_singular |= tolerance == NEARLY_REAL;
            answer.places.push(places(&unknowns, &values, near));
        }
    }
    Some(answer)
}

/// The rows of a group over its unknowns, on one side: that of (r, Ξ), or that of their conjugates.
#[derive(Clone)]
struct Sided {
    /// Forms that vanish.
    linear: Vec<Vec<Number>>,
    /// P and Q of Re(P Q̄) = 0.
    products: Vec<[Vec<Number>; 2]>,
    /// P and ℓ of |P| = ℓ.
    lengths: Vec<(Vec<Number>, f64)>,
}

impl Sided {
    fn new(unknowns: &Unknowns, rows: &[&Algebraic]) -> Self {
        let mut own = Sided {
            linear: Vec::new(),
            products: Vec::new(),
            lengths: Vec::new(),
        };
        let one = || unit(unknowns.len(), 0);
        let mut rows = rows.iter().peekable();
        while let Some(row) = rows.next() {
            match row {
                Algebraic::Real(form) => {
                    let is_pair = |next: &&&Algebraic| matches!(next, Algebraic::Imaginary(other) if other == form);
                    let row = unknowns.row(form, true);
                    match rows.next_if(is_pair) {
                        Some(_) => own.linear.push(row),
                        None => own.products.push([row, one()]),
                    }
                }
                Algebraic::Imaginary(form) => {
                    let turned = form.clone().times(Number::new(0.0, -1.0));
                    own.products.push([unknowns.row(&turned, true), one()]);
                }
                Algebraic::Across(form, direction) => {
                    let direction = unknowns.row(direction, false);
                    own.products.push([unknowns.row(form, true), direction]);
                }
                Algebraic::Length(form, length) => {
                    let row = unknowns.row(form, true);
                    own.lengths.push((row, length / unknowns.size));
                }
                Algebraic::Angles { .. } => {}
            }
        }
        let first = 1 + unknowns.group.bodies.len();
        let turns = (first..unknowns.len()).map(|at| (unit(unknowns.len(), at), 1.0));
        own.lengths.extend(turns);
        own
    }

    /// The same with other numbers.
    fn map(&self, mut of: impl FnMut(&[Number]) -> Vec<Number>) -> Self {
        Sided {
            linear: self.linear.iter().map(|row| of(row)).collect(),
            products: self
                .products
                .iter()
                .map(|pair| pair.each_ref().map(|row| of(row)))
                .collect(),
            lengths: self
                .lengths
                .iter()
                .map(|(row, length)| (of(row), *length))
                .collect(),
        }
    }

    fn conjugate(&self) -> Self {
        self.map(|row| row.iter().map(Number::conj).collect())
    }

    /// How many isolated roots there are with random dimensions; `None` where two draws differ.
    fn generic_count(&self, bodies: usize, unknowns: usize) -> Option<usize> {
        let mut random = Random::new(1);
        let mut draw = || {
            let mut side = || {
                self.map(|row| {
                    let own = row.iter().enumerate();
                    // Places stand in all pins of a body with the same factor.
                    own.map(|(at, own)| {
                        if (1..=bodies).contains(&at) {
                            *own
                        } else {
                            own * random.turn() * 1.3
                        }
                    })
                    .collect()
                })
            };
            let reduced = BilinearSystem::new(&side(), &side(), unknowns)?;
            let found = roots(&reduced.equations, reduced.p());
            (found.lost == 0).then_some(found.regular.len())
        };
        let (one, other) = (draw()?, draw()?);
        (one == other).then_some(one)
    }
}

/// The equations in y and ȳ.
struct BilinearSystem {
    equations: Vec<BilinearEquation>,
    /// N: the unknowns over (1, y).
    basis: Vec<Vec<Number>>,
}

impl BilinearSystem {
    /// From the rows of both sides; `None` if they contradict each other.
    fn new(rows: &Sided, conjugate: &Sided, n: usize) -> Option<Self> {
        let basis = solved(rows.linear.clone(), n)?;
        let other = solved(conjugate.linear.clone(), n)?;
        let over = |row: &[Number], basis: &[Vec<Number>]| -> Vec<Number> {
            let mut sum = vec![Number::new(0.0, 0.0); basis[0].len()];
            for (factor, basis) in row.iter().zip(basis) {
                let both = sum.iter_mut().zip(basis);
                both.for_each(|(sum, own)| *sum += factor * own);
            }
            sum
        };
        let products = rows.products.iter().zip(&conjugate.products);
        let products = products.map(|(own, bar)| {
            let [a, b] = own.each_ref().map(|row| over(row, &basis));
            let [a_bar, b_bar] = bar.each_ref().map(|row| over(row, &other));
            product([a, b], [a_bar, b_bar])
        });
        let lengths = rows.lengths.iter().zip(&conjugate.lengths);
        let lengths = lengths.map(|((own, length), (bar, _))| {
            square(over(own, &basis), over(bar, &other), length * length)
        });
        Some(BilinearSystem {
            equations: products.chain(lengths).collect(),
            basis,
        })
    }

    fn p(&self) -> usize {
        self.basis.first().map_or(0, |row| row.len() - 1)
    }
}

fn outer(x: &[Number], y: &[Number]) -> Vec<Number> {
    let products = x.iter().flat_map(|x| y.iter().map(move |y| x * y));
    products.collect()
}

/// A B̄ + B Ā = 0.
fn product([a, b]: [Vec<Number>; 2], [a_bar, b_bar]: [Vec<Number>; 2]) -> BilinearEquation {
    let both = outer(&a, &b_bar).into_iter().zip(outer(&b, &a_bar));
    BilinearEquation {
        coefficients: both.map(|(x, y)| 0.5 * (x + y)).collect(),
        factors: [vec![a, b], vec![a_bar, b_bar]],
    }
}

/// A Ā = ℓ².
fn square(a: Vec<Number>, a_bar: Vec<Number>, square: f64) -> BilinearEquation {
    let mut coefficients = outer(&a, &a_bar);
    coefficients[0] -= square;
    let one = unit(a.len(), 0);
    BilinearEquation {
        coefficients,
        factors: [vec![a, one.clone()], vec![a_bar, one]],
    }
}

fn unit(n: usize, at: usize) -> Vec<Number> {
    let mut row = vec![Number::new(0.0, 0.0); n];
    row[at] = 1.0.into();
    row
}

/// Bodies that turn alike; `None` if there are gears of other kinds among them.
fn turns(
    group: &Group,
    rows: &[&Algebraic],
    known: &[Option<BodyPlace>],
) -> Option<(Vec<BodyTurn>, usize)> {
    let mut turns: Vec<BodyTurn> = (0..group.bodies.len())
        .map(|own| BodyTurn {
            class: Some(own),
            angle: 0.0,
        })
        .collect();
    let position = |body: BodyId| group.bodies.iter().position(|own| *own == body);
    let of = |turns: &[BodyTurn], body: BodyId| match position(body) {
        Some(own) => turns[own],
        None => BodyTurn {
            class: None,
            angle: known[body.0].unwrap_or(GROUND).theta,
        },
    };
    let mut waiting: Vec<&Algebraic> = rows
        .iter()
        .copied()
        .filter(|row| matches!(row, Algebraic::Angles { .. }))
        .collect();
    while !waiting.is_empty() {
        let before = waiting.len();
        waiting.retain(|row| {
            let Algebraic::Angles {
                first,
                second,
                carrier,
                ratio,
                angle,
            } = row
            else {
                return false;
            };
            let [one, two, third] = [*first, *second, *carrier].map(|body| of(&turns, body));
            // θ₂ = θ + δ with θ that of the class of one of them.
            let (from, to, offset) = if *ratio == 1.0 {
                (one, two, one.angle + angle)
            } else if one.class == third.class {
                // θ₁ − θ_c is known.
                (
                    third,
                    two,
                    third.angle + ratio * (one.angle - third.angle) + angle,
                )
            } else if two.class == third.class {
                (
                    third,
                    one,
                    third.angle + (two.angle - third.angle - angle) / ratio,
                )
            } else if one.class.is_none() && two.class.is_none() {
                let carried = (two.angle - ratio * one.angle - angle) / (1.0 - ratio);
                (
                    BodyTurn {
                        class: None,
                        angle: 0.0,
                    },
                    third,
                    carried,
                )
            } else {
                return true;
            };
            join(&mut turns, from.class, to, offset);
            false
        });
        if waiting.len() == before {
            return None;
        }
    }
    let mut classes: Vec<usize> = turns.iter().filter_map(|turn| turn.class).collect();
    classes.sort_unstable();
    classes.dedup();
    for turn in &mut turns {
        turn.class = turn
            .class
            .and_then(|own| classes.iter().position(|class| *class == own));
    }
    Some((turns, classes.len()))
}

/// Lets what turns like `to` turn like `from` and so much more.
fn join(turns: &mut [BodyTurn], from: Option<usize>, to: BodyTurn, offset: f64) {
    // θ_from + offset = θ_to + to.angle
    let (moved, kept, more) = match to.class {
        None => (from, None, to.angle - offset),
        Some(class) => (Some(class), from, offset - to.angle),
    };
    if moved == kept || moved.is_none() {
        return;
    }
    for turn in turns.iter_mut().filter(|turn| turn.class == moved) {
        turn.class = kept;
        turn.angle += more;
    }
}

/// N of L x = 0 with x₀ = 1 the constant: rows of all unknowns over (1, y₁ … y_p). `None` if the rows contradict each other.
fn solved(mut rows: Vec<Vec<Number>>, n: usize) -> Option<Vec<Vec<Number>>> {
    let mut pivots: Vec<usize> = Vec::new();
    let mut rank = 0;
    while rank < rows.len() {
        let entries = (rank..rows.len()).flat_map(|row| (1..n).map(move |column| (row, column)));
        let best = entries.max_by(|a, b| {
            rows[a.0][a.1]
                .norm_sqr()
                .total_cmp(&rows[b.0][b.1].norm_sqr())
        });
        let Some((row, column)) =
            best.filter(|(row, column)| rows[*row][*column].norm() > DEPENDENT)
        else {
            break;
        };
        rows.swap(rank, row);
        let pivot = rows[rank][column];
        rows[rank].iter_mut().for_each(|own| *own /= pivot);
        let own = rows[rank].clone();
        for (other, row) in rows.iter_mut().enumerate() {
            let factor = row[column];
            if other != rank && factor != Number::new(0.0, 0.0) {
                let both = row.iter_mut().zip(&own);
                both.for_each(|(entry, own)| *entry -= factor * own);
            }
        }
        pivots.push(column);
        rank += 1;
    }
    // What is left says 0 = c.
    if rows[rank..].iter().any(|row| row[0].norm() > REAL) {
        return None;
    }
    let free: Vec<usize> = (1..n).filter(|column| !pivots.contains(column)).collect();
    let mut basis = vec![vec![Number::new(0.0, 0.0); free.len() + 1]; n];
    basis[0][0] = 1.0.into();
    for (k, column) in free.iter().enumerate() {
        basis[*column][k + 1] = 1.0.into();
    }
    for (row, column) in rows.iter().zip(&pivots) {
        basis[*column][0] = -row[0];
        for (k, other) in free.iter().enumerate() {
            basis[*column][k + 1] = -row[*other];
        }
    }
    Some(basis)
}

/// The unknowns of a root, if they are real: (constant, r, Ξ).
fn real(root: &Root, basis: &[Vec<Number>], tolerance: f64) -> Option<Vec<Number>> {
    let value = |row: &[Number], y: &[Number]| {
        row[0] + row[1..].iter().zip(y).map(|(a, y)| a * y).sum::<Number>()
    };
    let mut values = Vec::with_capacity(basis.len());
    for row in basis {
        let conjugate: Vec<Number> = row.iter().map(Number::conj).collect();
        let (one, two) = (value(row, &root.z), value(&conjugate, &root.w).conj());
        if (one - two).norm() > tolerance * (1.0 + one.norm()) {
            return None;
        }
        values.push(0.5 * (one + two));
    }
    Some(values)
}

fn places(unknowns: &Unknowns, values: &[Number], near: &dyn Fn(BodyId) -> f64) -> Vec<BodyPlace> {
    let bodies = &unknowns.group.bodies;
    let place = |(own, turn): (usize, &BodyTurn)| {
        let theta = match turn.class {
            None => turn.angle,
            Some(class) => {
                // The whole class takes the turn that is meant of its first body.
                let first = unknowns
                    .turns
                    .iter()
                    .position(|other| other.class == turn.class);
                let first = first.unwrap_or(own);
                let raw = values[1 + bodies.len() + class].arg();
                let full = std::f64::consts::TAU;
                let meant = near(bodies[first]) - unknowns.turns[first].angle;
                raw + full * ((meant - raw) / full).round() + turn.angle
            }
        };
        BodyPlace {
            r: values[1 + own],
            theta,
        }
    };
    unknowns.turns.iter().enumerate().map(place).collect()
}
