//! Accuracy as tables: a row for each pose, a row for each contribution.

use std::io::{self, Write};

use linkdyn_output::csv::{push_field, push_number};

use super::Deviations;

/// Size of the pieces that are handed on \[bytes\].
const PIECE: usize = 1 << 16;

/// A row that is being written.
struct Row<'t>(&'t mut Vec<u8>);

impl Row<'_> {
    fn text(self, text: &str) -> Self {
        push_field(self.0, text);
        self.0.push(b',');
        self
    }

    /// Cells that many rows have.
    fn cells(self, cells: &[u8]) -> Self {
        self.0.extend_from_slice(cells);
        self
    }

    fn number(self, value: Option<f64>) -> Self {
        push_number(self.0, value);
        self.0.push(b',');
        self
    }

    fn pair(self, pair: Option<[f64; 2]>) -> Self {
        let [first, second] = [0, 1].map(|k| pair.map(|pair| pair[k]));
        self.number(first).number(second)
    }

    /// Ends the row.
    fn end(self) {
        self.0.pop();
        self.0.push(b'\n');
    }
}

/// Cells, to be put into rows.
fn cells(put: impl Fn(Row) -> Row) -> Vec<u8> {
    let mut text = Vec::new();
    put(Row(&mut text));
    text
}

impl Deviations {
    /// `accuracy.csv`: a row per output and pose.
    pub fn table(&self) -> Vec<u8> {
        let found = &self.found;
        let mut text = b"output,unit,time[s],driver,nominal,first.minus,first.plus,found.minus,found.plus,certified.minus,certified.plus,mean,sigma,pressed,lower,upper,within,cp,cpk\n".to_vec();
        for output in &found.outputs {
            for pose in &output.poses {
                let capability = pose.capability.as_ref();
                Row(&mut text)
                    .text(&output.name)
                    .text(output.unit)
                    .number(Some(pose.time))
                    .number(pose.drivers.first().copied())
                    .number(Some(pose.nominal))
                    .pair(pose.first)
                    .number(pose.found[0])
                    .number(pose.found[1])
                    .pair(pose.certified)
                    .pair(pose.moments)
                    .number(pose.pressed)
                    .pair(output.limits)
                    .number(capability.map(|c| c.within))
                    .number(capability.map(|c| c.cp))
                    .number(capability.map(|c| c.cpk))
                    .end();
            }
        }
        text
    }

    /// Writes `contributions.csv`: a row per output, pose and source; they are many.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn contributions(&self, out: &mut impl Write) -> io::Result<()> {
        let found = &self.found;
        let mut text =
        b"output,time[s],driver,source,sensitivity,carries.minus,carries.plus,worst_share,variance_share\n"
            .to_vec();
        let sources: Vec<Vec<u8>> = found
            .sources
            .iter()
            .map(|own| cells(|row| row.text(own)))
            .collect();
        for output in &found.outputs {
            for pose in &output.poses {
                let (time, driver) = (pose.time, pose.drivers.first().copied());
                let pose_cells =
                    cells(|row| row.text(&output.name).number(Some(time)).number(driver));
                let by = sources.iter().zip(&pose.contributions);
                for ((source, by), share) in by.zip(pose.shares()) {
                    Row(&mut text)
                        .cells(&pose_cells)
                        .cells(source)
                        .number(Some(by.sensitivity))
                        .pair(Some(by.reach))
                        .pair(Some(share))
                        .end();
                }
                if text.len() >= PIECE {
                    out.write_all(&text)?;
                    text.clear();
                }
            }
        }
        out.write_all(&text)
    }
}
