//! Factors of several matrices of one pattern side by side, with the pivots of one of them.
//!
//! Entries that are the same in all matrices are eliminated once: of a linkage those of places, ±1, are. What remains is a list
//! of operations.

use super::SparseLu;
use super::frozen::Frozen;
use super::pivot::{GROWTH_LIMIT, SINGULAR_RATIO};
use crate::math::Lanes;
use nalgebra::{SimdComplexField, SimdPartialOrd, SimdValue};

/// LU of several matrices side by side.
#[derive(Debug, Clone)]
pub struct LuAbreast {
    /// What is the same in all of them stands there.
    frozen: Frozen<Lanes>,
    operations: Operations,
    /// Pivot position of each row, and columns in pivot order.
    position: Vec<u32>,
    columns: Vec<u32>,
    /// Of what differs, sizes beyond which it is too large: of inverse pivots, and of entries of L.
    most: Vec<(u32, f64)>,
    pivots: usize,
    /// Sign of the permutation and of the pivots that are always the same.
    sign: f64,
    vector: Vec<Lanes>,
}

/// What is done with each pivot in turn.
#[derive(Debug, Clone, Default)]
struct Operations {
    /// Numbers that are not zero before.
    begin: Vec<(u32, f64)>,
    /// For each pivot: whether it is inverted, how many entries are multiplied by it, and how many products follow.
    steps: Vec<(bool, u32, u32)>,
    scaled: Vec<u32>,
    /// x −= l u.
    products: Vec<[u32; 3]>,
}

impl Operations {
    /// Of factors whose numbers are `known` where they are the same in all matrices; what becomes known is added.
    fn new(frozen: &Frozen, known: &mut [Option<f64>]) -> Self {
        let mut operations = Operations::default();
        let (mut lower, mut upper) = (frozen.pivots(), frozen.pivots() + frozen.lower_places.len());
        let mut targets = frozen.targets.iter().map(|target| *target as usize);
        for (k, [below, beside]) in frozen.lengths.iter().enumerate() {
            let before = (operations.scaled.len(), operations.products.len());
            known[k] = known[k].map(|pivot| 1.0 / pivot);
            let column = lower..lower + *below as usize;
            let row = upper..upper + *beside as usize;
            (lower, upper) = (column.end, row.end);
            for l in column.clone() {
                known[l] = match (known[l], known[k]) {
                    (Some(0.0), _) => continue,
                    (Some(own), Some(inverse)) => Some(own * inverse),
                    (own, _) => {
                        operations.begin.extend(own.map(|own| (l as u32, own)));
                        operations.scaled.push(l as u32);
                        None
                    }
                };
            }
            for u in row {
                for (l, target) in column.clone().zip(&mut targets) {
                    match (known[l], known[u], known[target]) {
                        (Some(0.0), _, _) | (_, Some(0.0), _) => continue,
                        (Some(l), Some(u), Some(to)) => {
                            known[target] = Some(to - l * u);
                            continue;
                        }
                        (_, _, Some(to)) => {
                            operations.begin.push((target as u32, to));
                            known[target] = None;
                        }
                        (_, _, None) => {}
                    }
                    operations
                        .products
                        .push([target, l, u].map(|place| place as u32));
                }
            }
            operations.steps.push((
                known[k].is_none(),
                (operations.scaled.len() - before.0) as u32,
                (operations.products.len() - before.1) as u32,
            ));
        }
        operations
    }

    fn run(&self, numbers: &mut [Lanes]) {
        for (place, value) in &self.begin {
            numbers[*place as usize] = Lanes::splat(*value);
        }
        let (mut scaled, mut products) = (&self.scaled[..], &self.products[..]);
        for (k, (is_inverted, count, more)) in self.steps.iter().enumerate() {
            if *is_inverted {
                numbers[k] = Lanes::splat(1.0) / numbers[k];
            }
            let own;
            (own, scaled) = scaled.split_at(*count as usize);
            let inverse = numbers[k];
            for place in own {
                numbers[*place as usize] *= inverse;
            }
            let own;
            (own, products) = products.split_at(*more as usize);
            for [to, l, u] in own {
                let product = numbers[*l as usize] * numbers[*u as usize];
                numbers[*to as usize] -= product;
            }
        }
    }
}

impl LuAbreast {
    /// With the order and the pivots of the last factors of a matrix whose rows and columns were divided by these scales; of the
    /// matrices themselves from now on, in which slots of the pattern may be `fixed`. `None` if they fill in too much, or what is
    /// fixed is singular.
    pub fn new(
        like: &SparseLu,
        [rows, columns]: [&[f64]; 2],
        fixed: &[Option<f64>],
    ) -> Option<Self> {
        let mut frozen: Frozen<Lanes> = like.frozen.of()?;
        let mut known = vec![Some(0.0); frozen.numbers.len()];
        for (place, own) in frozen.slots.iter().zip(fixed) {
            known[*place as usize] = *own;
        }
        let operations = Operations::new(&like.frozen, &mut known);
        for (number, known) in frozen.numbers.iter_mut().zip(&known) {
            *number = Lanes::splat(known.unwrap_or(0.0));
        }
        let (order, n) = (like.order.columns(), rows.len());
        let mut of_pivots = vec![1.0; n];
        for (&at, row) in like.position.iter().zip(rows) {
            of_pivots[at as usize] = *row;
        }
        let of_pivot = |k: usize| {
            let column = columns[order[k] as usize];
            SINGULAR_RATIO * like.row_scale[k] * of_pivots[k] / column
        };
        let of_lower = |place: usize| {
            let [row, column] = frozen.lower_places[place - n].map(|own| own as usize);
            of_pivots[column] / of_pivots[row] / GROWTH_LIMIT
        };
        let measured = (0..n + frozen.lower_places.len()).map(|place| {
            let of = if place < n {
                of_pivot(place)
            } else {
                of_lower(place)
            };
            (place, of)
        });
        let (fixed, free): (Vec<_>, Vec<_>) =
            measured.partition(|(place, _)| known[*place].is_some());
        let signs = fixed.iter().filter(|(place, _)| *place < n);
        let sign = signs.fold(like.permutation_sign, |sign, (place, _)| {
            sign * known[*place].unwrap_or_default().signum()
        });
        let mut sizes = fixed
            .iter()
            .map(|(place, of)| known[*place].unwrap_or_default().abs() * of);
        let is_sound = sizes.all(|size| size <= 1.0);
        is_sound.then(|| LuAbreast {
            pivots: free.iter().filter(|(place, _)| *place < n).count(),
            most: free
                .iter()
                .map(|(place, of)| (*place as u32, *of))
                .collect(),
            position: like.position.clone(),
            columns: order.to_vec(),
            sign,
            vector: vec![Lanes::ZERO; n],
            operations,
            frozen,
        })
    }

    /// Where the value of a slot of the pattern goes.
    pub fn place(&self, slot: u32) -> u32 {
        self.frozen.slots[slot as usize]
    }

    /// Factors what is not fixed, with its places; the sign of each determinant, 0 of a matrix that these pivots do not factor
    /// well.
    #[inline]
    pub fn factor(&mut self, values: impl Iterator<Item = (u32, Lanes)>) -> Lanes {
        let numbers = &mut self.frozen.numbers[..];
        for (place, value) in values {
            numbers[place as usize] = value;
        }
        self.operations.run(numbers);
        let (mut sign, mut large) = (Lanes::splat(self.sign), Lanes::ZERO);
        for (place, _) in &self.most[..self.pivots] {
            let inverse = numbers[*place as usize];
            sign = Lanes(sign.0 ^ (inverse.0 & Lanes::splat(-0.0).0));
        }
        for (place, most) in &self.most {
            let size = numbers[*place as usize].simd_abs() * Lanes::splat(*most);
            // what is no number stays
            large = size.select(!size.simd_le(large), large);
        }
        sign.select(large.simd_le(Lanes::splat(1.0)), Lanes::ZERO)
    }

    /// Solves A x = b, times a sign.
    #[inline]
    pub fn solve(&mut self, b: &[Lanes], sign: f64, x: &mut [Lanes]) {
        let sign = Lanes::splat(sign);
        for (&at, &value) in self.position.iter().zip(b) {
            self.vector[at as usize] = value * sign;
        }
        self.frozen.solve(self.vector.as_chunks_mut::<1>().0);
        for (&column, &value) in self.columns.iter().zip(&self.vector) {
            x[column as usize] = value;
        }
    }

    /// Solves Aᵀ x = b.
    pub fn solve_transposed(&mut self, b: &[Lanes], x: &mut [Lanes]) {
        for (&column, value) in self.columns.iter().zip(&mut self.vector) {
            *value = b[column as usize];
        }
        let vector = self.vector.as_chunks_mut::<1>().0;
        self.frozen.solve_transposed(vector);
        for (&at, x) in self.position.iter().zip(x) {
            *x = self.vector[at as usize];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linkage::Random;
    use crate::math::WIDTH;
    use crate::order::ColumnOrder;
    use crate::pattern::square;

    /// Random sparse matrices of which some entries are ±1 in all, against factors of each alone.
    #[test]
    fn side_by_side_is_as_alone() {
        let mut random = Random(5);
        let mut signs = 0;
        for n in [1, 2, 5, 9, 20] {
            for _ in 0..20 {
                let mut entries: Vec<(usize, usize)> =
                    (0..n).map(|k| (k, (k * 7 + 3) % n)).collect();
                entries.extend((0..n).map(|k| (k, k)));
                let at =
                    |random: &mut Random| ((random.signed() + 1.0) * 0.5 * n as f64) as usize % n;
                entries.extend((0..2 * n).map(|_| (at(&mut random), at(&mut random))));
                entries.sort_unstable();
                entries.dedup();
                let (pattern, _) = square(n, &entries);
                let count = pattern.entries();
                let fixed: Vec<Option<f64>> = (0..count)
                    .map(|_| (random.signed() > 0.0).then(|| random.signed().signum()))
                    .collect();
                let mut values = || -> Vec<f64> {
                    let own = fixed
                        .iter()
                        .map(|fixed| fixed.unwrap_or_else(|| random.signed()));
                    own.collect()
                };
                let lanes: [Vec<f64>; WIDTH] = std::array::from_fn(|_| values());
                let Ok(order) = ColumnOrder::paired(&pattern, &lanes[0]) else {
                    continue;
                };
                let mut alone = SparseLu::new(pattern, order);
                if alone.factor(&lanes[0]).is_err() {
                    continue;
                }
                let scales = vec![1.0; n];
                let Some(mut abreast) = LuAbreast::new(&alone, [&scales, &scales], &fixed) else {
                    continue;
                };
                let free = (0..count).filter(|slot| fixed[*slot].is_none());
                let free: Vec<(u32, Lanes)> = free
                    .map(|slot| {
                        let value = std::array::from_fn(|lane| lanes[lane][slot]);
                        (abreast.place(slot as u32), Lanes::from_arr(value))
                    })
                    .collect();
                let b: Vec<f64> = (0..n).map(|k| 1.0 + k as f64).collect();
                let sides: Vec<Lanes> = b.iter().map(|b| Lanes::splat(*b)).collect();
                let [mut x, mut y] = [(); 2].map(|()| vec![Lanes::ZERO; n]);
                // twice, as nothing may be left of the first time
                abreast.factor(free.iter().copied());
                let sign = abreast.factor(free.into_iter());
                abreast.solve(&sides, -1.0, &mut x);
                abreast.solve_transposed(&sides, &mut y);
                for (lane, values) in lanes.iter().enumerate() {
                    if sign.extract(lane) == 0.0
                        || alone.refactor(values).is_err()
                        || alone.growth() > 1e3
                    {
                        continue;
                    }
                    signs += 1;
                    assert_eq!(sign.extract(lane), alone.determinant_sign());
                    let mut own: Vec<f64> = b.iter().map(|b| -b).collect();
                    alone.solve(&mut own);
                    let mut transposed = b.clone();
                    alone.solve_transposed(&mut transposed);
                    for (found, own) in [(&x, own), (&y, transposed)] {
                        let size = crate::math::max_abs(&own);
                        for (found, own) in found.iter().zip(&own) {
                            let off = (found.extract(lane) - own).abs();
                            assert!(off <= 1e-9 * size, "{n}: {off:e} of {size:e}");
                        }
                    }
                }
            }
        }
        assert!(signs > 100, "{signs}");
    }
}
