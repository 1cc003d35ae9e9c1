//! Rows of what contacts do: where each begins, presses most and ends, and at all other located events.

use linkdyn_output::Trajectory;

/// Contacts whose rows are kept for curves, those with the largest forces.
const MOST_DRAWN: usize = 200;

/// Rows of a contact.
#[derive(Debug, Clone, Default)]
struct Episode {
    force: f64,
    peak: Vec<f64>,
    /// The mechanism was evaluated exactly at its peak.
    is_exact: bool,
    /// Its beginning and end.
    ends: Vec<Vec<f64>>,
}

/// Rows at events.
#[derive(Clone)]
pub struct Episodes {
    /// All events are wanted as outputs.
    all: bool,
    /// Contacts that go on, by joint.
    open: Vec<Option<Episode>>,
    done: Vec<Episode>,
    others: Vec<Vec<f64>>,
}

impl Episodes {
    pub fn new(contacts: usize, all: bool) -> Self {
        Episodes {
            all,
            open: vec![None; contacts],
            done: Vec::new(),
            others: Vec::new(),
        }
    }

    /// Whether the contact goes on.
    pub fn is_open(&self, contact: usize) -> bool {
        self.open[contact].is_some()
    }

    /// A contact begins with this row.
    pub fn begin(&mut self, contact: usize, force: f64, row: &[f64]) {
        self.open[contact] = Some(Episode {
            force,
            peak: row.to_vec(),
            is_exact: true,
            ends: vec![row.to_vec()],
        });
    }

    /// A contact goes on as another.
    pub fn hand_over(&mut self, [from, to]: [usize; 2]) {
        if let Some(episode) = self.open[from].take() {
            self.open[to] = Some(episode);
        }
    }

    /// Whether the force is larger than all before in this contact.
    pub fn rises(&self, contact: usize, force: f64) -> bool {
        self.open[contact]
            .as_ref()
            .is_some_and(|episode| force > episode.force)
    }

    /// The contact presses most in this row, so far.
    pub fn rise(&mut self, contact: usize, force: f64, row: &[f64], is_exact: bool) {
        if let Some(episode) = &mut self.open[contact] {
            (episode.force, episode.is_exact) = (force, is_exact);
            episode.peak.clear();
            episode.peak.extend_from_slice(row);
        }
    }

    /// Whether a contact has its peak at this time, by a row that is not exact.
    pub fn is_inexact_at(&self, time: f64) -> bool {
        self.open
            .iter()
            .flatten()
            .any(|episode| !episode.is_exact && episode.peak.first() == Some(&time))
    }

    /// Exchanges rows of peaks at the same time that are not exact.
    pub fn make_exact(&mut self, row: &[f64]) {
        for episode in self.open.iter_mut().flatten() {
            if !episode.is_exact && episode.peak.first() == row.first() {
                episode.is_exact = true;
                episode.peak.copy_from_slice(row);
            }
        }
    }

    /// It ends with this row.
    pub fn end(&mut self, contact: usize, row: &[f64]) {
        if let Some(mut episode) = self.open[contact].take() {
            episode.ends.push(row.to_vec());
            self.close(episode);
        }
    }

    fn close(&mut self, episode: Episode) {
        self.done.push(episode);
        if !self.all && self.done.len() >= 2 * MOST_DRAWN {
            self.thin();
        }
    }

    fn thin(&mut self) {
        self.done.sort_by(|a, b| b.force.total_cmp(&a.force));
        self.done.truncate(MOST_DRAWN);
    }

    /// Another event is in this row.
    pub fn note(&mut self, row: &[f64]) {
        if self.all {
            self.others.push(row.to_vec());
        }
    }

    /// All rows, and whether they are outputs; not by time yet.
    pub fn rows(mut self) -> (Vec<Vec<f64>>, bool) {
        for contact in 0..self.open.len() {
            if let Some(episode) = self.open[contact].take() {
                self.close(episode);
            }
        }
        if !self.all {
            self.thin();
        }
        let rows = self
            .done
            .into_iter()
            .flat_map(|episode| episode.ends.into_iter().chain([episode.peak]));
        (rows.chain(self.others).collect(), self.all)
    }
}

/// Rows by time, without those that are there twice or were never filled.
pub fn by_time(mut rows: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    rows.retain(|row| !row.is_empty());
    rows.sort_by(|a, b| a[0].total_cmp(&b[0]));
    rows.dedup_by(|a, b| {
        a.iter()
            .zip(b.iter())
            .all(|(a, b)| a.to_bits() == b.to_bits())
    });
    rows
}

/// Puts rows into a table whose rows stand by time; of one instant there is one row, the table's own where it has one.
pub fn insert(table: &mut Trajectory, rows: &[Vec<f64>]) {
    let mut data = Vec::with_capacity(table.data.len() + rows.len() * table.width());
    let mut rows = rows.iter().peekable();
    let mut last = f64::NAN;
    let mut put = |data: &mut Vec<f64>, row: &[f64]| {
        data.extend_from_slice(row);
        last = row[0];
        last
    };
    let mut at = f64::NAN;
    for own in table.rows() {
        while let Some(row) = rows.next_if(|row| row[0] < own[0]) {
            if row[0] != at {
                at = put(&mut data, row);
            }
        }
        while rows.next_if(|row| row[0] == own[0]).is_some() {}
        at = put(&mut data, own);
    }
    for row in rows {
        if row[0] != at {
            at = put(&mut data, row);
        }
    }
    table.data = data;
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkdyn_output::Column;

    #[test]
    fn rows_go_between_without_duplicates() {
        let mut table = Trajectory::new(vec![Column::new("time", "s"), Column::new("a.x", "m")]);
        for time in [0.0, 1.0, 2.0] {
            table.push_row(&[time, 0.0]);
        }
        let rows =
            [[0.5, 1.0], [0.5, 2.0], [1.0, 3.0], [1.5, 4.0], [2.5, 5.0]].map(|row| row.to_vec());
        insert(
            &mut table,
            &by_time(rows.into_iter().rev().chain([Vec::new()]).collect()),
        );
        let times: Vec<f64> = table.rows().map(|row| row[0]).collect();
        assert_eq!(times, [0.0, 0.5, 1.0, 1.5, 2.0, 2.5]);
        assert_eq!(table.row(2)[1], 0.0, "an output stays what it is");
    }

    #[test]
    fn the_contacts_with_the_largest_forces_are_kept() {
        let mut episodes = Episodes::new(1, false);
        for k in 0..1000 {
            let (time, force) = (f64::from(k), f64::from((k * 37) % 1000));
            episodes.begin(0, 0.0, &[time]);
            assert!(episodes.rises(0, force) || force == 0.0);
            episodes.rise(0, force, &[time + 0.1], false);
            assert!(force == 0.0 || episodes.is_inexact_at(time + 0.1));
            episodes.make_exact(&[time + 0.1]);
            assert!(!episodes.is_inexact_at(time + 0.1));
            episodes.end(0, &[time + 0.2]);
        }
        let (rows, _) = episodes.rows();
        assert_eq!(rows.len(), 3 * MOST_DRAWN);
        let peaks = rows
            .iter()
            .filter(|row| (row[0].fract() - 0.1).abs() < 1e-9);
        assert!(
            peaks.clone().count() == MOST_DRAWN
                && peaks
                    .into_iter()
                    .all(|row| (row[0] as u32 * 37) % 1000 >= 800)
        );
    }
}
