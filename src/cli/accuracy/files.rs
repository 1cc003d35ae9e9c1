//! Accuracy as files: a table of poses, a table of contributions, everything for programs, and the page.

use std::io::{self, BufWriter, Write};
use std::panic::resume_unwind;
use std::path::PathBuf;

use super::super::open::Opened;
use super::{json, page, text};
use linkdyn_engine::analysis::accuracy::Accuracy;
use linkdyn_output::csv::{push_field, push_number};
use linkdyn_output::{Directory, WriteError};

const TABLE: &str = "accuracy.csv";
const CONTRIBUTIONS: &str = "contributions.csv";
const SUMMARY: &str = "accuracy.json";
const PAGE: &str = "report.html";
/// Size of the pieces that are handed on \[bytes\].
const PIECE: usize = 1 << 16;

/// Writes all files, on two threads where more than one is allowed: it takes longer than to work them out.
///
/// # Errors
/// When a file can't be written.
pub fn write(
    directory: &Directory,
    opened: &Opened,
    found: &Accuracy,
    threads: usize,
) -> Result<Vec<PathBuf>, WriteError> {
    let everything = || {
        directory.write_with(SUMMARY, |file| {
            let mut file = BufWriter::with_capacity(PIECE, file);
            json::write(opened, found, &mut file)?;
            file.flush()
        })
    };
    let others = || -> Result<[PathBuf; 3], WriteError> {
        let page = page::html(opened, found, text::assumed(opened));
        Ok([
            directory.write(TABLE, &table(found))?,
            directory.write_with(CONTRIBUTIONS, |file| contributions(found, file))?,
            directory.write(PAGE, page.as_bytes())?,
        ])
    };
    let (everything, others) = if threads > 1 {
        std::thread::scope(|scope| {
            let everything = scope.spawn(everything);
            let others = others();
            let everything = everything.join();
            (
                everything.unwrap_or_else(|panic| resume_unwind(panic)),
                others,
            )
        })
    } else {
        (everything(), others())
    };
    let [table, contributions, page] = others?;
    Ok(vec![table, contributions, everything?, page])
}

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

/// A row per output and pose.
fn table(found: &Accuracy) -> Vec<u8> {
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

/// A row per output, pose and source; they are many.
fn contributions(found: &Accuracy, out: &mut impl Write) -> io::Result<()> {
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
            let pose_cells = cells(|row| row.text(&output.name).number(Some(time)).number(driver));
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
