//! Which variants the page draws: some spread evenly over all, each by chance within its stretch, and those with the smallest and
//! largest responses. The same ones whenever they are requested.

use super::head::Head;
use linkdyn_picture::study_page::{Variant, most_rows};
use linkdyn_study::chunks::{Row, Rows};

/// Rows as they come.
pub struct Sample {
    all: u64,
    most: u64,
    inputs: usize,
    taken: u64,
    rows: Vec<Variant>,
    /// Of each response the variants with the smallest and the largest value.
    ends: Vec<[Option<Variant>; 2]>,
}

impl Sample {
    /// Of a study.
    pub fn new(head: &Head) -> Self {
        let (inputs, responses) = (head.inputs.len(), head.responses.len());
        Sample::of(
            head.variants,
            most_rows(inputs + responses) as u64,
            [inputs, responses],
        )
    }

    /// At most so many of all.
    fn of(all: u64, most: u64, [inputs, responses]: [usize; 2]) -> Self {
        Sample {
            all,
            most: most.min(all),
            inputs,
            taken: 0,
            rows: Vec::new(),
            ends: vec![[None, None]; responses],
        }
    }

    /// Takes the rows after these.
    pub fn take(&mut self, rows: &Rows) {
        for row in rows.iter() {
            if self.taken < self.most && row.variant == self.place(self.taken) {
                self.taken += 1;
                self.rows.push(variant(&row));
            }
            for (index, ends) in self.ends.iter_mut().enumerate() {
                take_ends(ends, &row, self.inputs + index);
            }
        }
    }

    /// The variants, in their order.
    pub fn rows(mut self) -> Vec<Variant> {
        for end in self.ends.into_iter().flatten().flatten() {
            if let Err(place) = self
                .rows
                .binary_search_by_key(&end.number, |row| row.number)
            {
                self.rows.insert(place, end);
            }
        }
        self.rows
    }

    /// The number of the k-th that is drawn.
    fn place(&self, k: u64) -> u64 {
        let start = |k: u64| (u128::from(k) * u128::from(self.all) / u128::from(self.most)) as u64;
        let (from, to) = (start(k), start(k + 1));
        // a steady step would fall in with the steps of a grid
        let chance = k.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 33;
        from + chance % (to - from).max(1)
    }
}

fn variant(row: &Row) -> Variant {
    Variant {
        number: row.variant,
        reason: row.reason.map(str::to_owned),
        values: [row.inputs, row.responses].concat(),
    }
}

/// Keeps a row where its value in a column is the smallest or the largest so far.
fn take_ends(ends: &mut [Option<Variant>; 2], row: &Row, column: usize) {
    let value = row.responses[column - row.inputs.len()];
    if !value.is_finite() {
        return;
    }
    let [low, high] = ends;
    if low
        .as_ref()
        .is_none_or(|known| value < known.values[column])
    {
        *low = Some(variant(row));
    }
    if high
        .as_ref()
        .is_none_or(|known| value > known.values[column])
    {
        *high = Some(variant(row));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(all: u64, most: u64) -> Vec<Variant> {
        let mut sample = Sample::of(all, most, [1, 1]);
        for from in (0..all).step_by(100) {
            let mut rows = Rows::new(from, 1, 1);
            for variant in from..all.min(from + 100) {
                let x = variant as f64;
                let reason = (variant % 10 == 9).then_some("locked");
                let y = if reason.is_some() {
                    f64::NAN
                } else {
                    (x - 777.5).abs()
                };
                rows.push(reason, &[x], &[y]);
            }
            sample.take(&rows);
        }
        sample.rows()
    }

    #[test]
    fn few_are_drawn_all_and_many_evenly_with_the_ends() {
        let all: Vec<u64> = drawn(250, 1000).iter().map(|row| row.number).collect();
        assert_eq!(all, (0..250).collect::<Vec<_>>());
        let some = drawn(10_000, 400);
        assert!(some.len() >= 400 && some.len() <= 402, "{}", some.len());
        let numbers: Vec<u64> = some.iter().map(|row| row.number).collect();
        assert!(
            numbers
                .windows(2)
                .all(|pair| pair[0] < pair[1] && pair[1] - pair[0] < 50)
        );
        assert!(
            numbers.contains(&777) && numbers.contains(&9_998),
            "the ends"
        );
        let steps: std::collections::BTreeSet<u64> =
            numbers.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(steps.len() > 10, "no steady step: {steps:?}");
        let locked = some.iter().filter(|row| row.reason.is_some()).count();
        assert!((20..=60).contains(&locked), "a tenth of 400: {locked}");
    }
}
