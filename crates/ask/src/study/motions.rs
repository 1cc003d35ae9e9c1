//! Variants that are run again, to be seen in motion.

use std::collections::BTreeSet;
use std::sync::Arc;

use linkdyn_engine::analysis::{self, Control};
use linkdyn_model::Checked;
use linkdyn_picture::Shape;
use linkdyn_picture::study_page::{Motion, Played, Variant, most_motions};
use rayon::prelude::*;

use super::Variants;
use crate::broken::caught;
use crate::shape::moving;

impl Variants {
    /// The motions of the nominal mechanism and of some of these variants: all where there are few, else those with the smallest
    /// and largest responses and others, evenly chosen.
    pub(super) fn motions(&self, rows: &[Variant], control: &Control) -> Played {
        let model = self.file.model();
        let bodies = Shape::of_model(model).bodies.len().saturating_sub(1);
        let most = most_motions(bodies);
        if most < 2 {
            return Played::None("The model is too large for its motions to be in this page.");
        }
        let chosen = chosen(rows, self.inputs.inputs.len(), most - 1);
        let mut motions: Vec<Motion> = motion(None, model, control).into_iter().collect();
        let others: Vec<Option<Motion>> = chosen
            .into_par_iter()
            .map(|row| self.again(rows[row].number, control))
            .collect();
        motions.extend(others.into_iter().flatten());
        Played::Motions(motions)
    }

    fn again(&self, number: u64, control: &Control) -> Option<Motion> {
        let mut told = vec![0.0; self.inputs.inputs.len()];
        let mut given = told.clone();
        self.inputs.values(number, &mut told, &mut given);
        let of = || motion(Some(number), &self.family.model(&given).ok()?, control);
        caught(of).ok().flatten()
    }
}

/// What a run of the model has of a motion; `None` if it has no position.
fn motion(variant: Option<u64>, model: &Checked, control: &Control) -> Option<Motion> {
    let control = Control {
        interrupted: Arc::clone(&control.interrupted),
        ..Control::default()
    };
    let outcome = analysis::run(model, &control).ok()?;
    moving(variant, model, &outcome)
}

/// Which rows, in their order.
fn chosen(rows: &[Variant], inputs: usize, most: usize) -> Vec<usize> {
    if rows.len() <= most {
        return (0..rows.len()).collect();
    }
    let mut chosen = BTreeSet::new();
    let columns = rows.first().map_or(0, |row| row.values.len());
    for column in inputs..columns {
        let known = (0..rows.len()).filter(|&row| rows[row].values[column].is_finite());
        let by = |a: &usize, b: &usize| rows[*a].values[column].total_cmp(&rows[*b].values[column]);
        chosen.extend(known.clone().min_by(by));
        chosen.extend(known.max_by(by));
    }
    let even = most.saturating_sub(chosen.len()).max(1);
    chosen.extend((0..even).map(|k| k * (rows.len() - 1) / (even - 1).max(1)));
    chosen.into_iter().take(most).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_each_response_are_played() {
        let row = |number: u64| Variant {
            number,
            reason: None,
            values: vec![
                0.0,
                if number == 777 {
                    -1.0
                } else {
                    (number % 501) as f64
                },
            ],
        };
        let rows: Vec<Variant> = (0..2000).map(row).collect();
        let found = chosen(&rows, 1, 199);
        assert!(found.len() <= 199 && found.len() >= 195, "{}", found.len());
        assert!(found.contains(&777) && found.contains(&0) && found.contains(&1999));
        let largest = found
            .iter()
            .map(|&row| rows[row].values[1])
            .fold(0.0, f64::max);
        assert_eq!(largest, 500.0);
        assert_eq!(chosen(&rows[..5], 1, 199), [0, 1, 2, 3, 4]);
    }
}
