//! Files that commands leave.

use std::fs;
use std::path::Path;

use linkdyn::cli::Said;
use serde_json::Value;

use super::{Trial, odd_words, odd_words_of_page};

impl Trial<'_> {
    /// A table of results: each cell empty or a finite number.
    pub fn table(&mut self, command: &str, path: &Path, is_complete: bool) -> usize {
        let Ok(text) = fs::read_to_string(path) else {
            self.find("file", command, format!("{}: not there", path.display()));
            return 0;
        };
        let mut reader = csv::ReaderBuilder::new().from_reader(text.as_bytes());
        let header: Vec<String> = reader
            .headers()
            .map(|row| row.iter().map(String::from).collect())
            .unwrap_or_default();
        let is_place = |name: &str| {
            name == "time[s]"
                || !name.starts_with("joint.")
                    && !name.starts_with("driver.")
                    && !name.starts_with("transmission.")
                    && [".x[m]", ".y[m]", ".angle[rad]"]
                        .iter()
                        .any(|end| name.ends_with(end))
        };
        let mut before = f64::NEG_INFINITY;
        let mut rows = 0;
        for row in reader.records() {
            let Ok(row) = row else {
                self.find(
                    "file",
                    command,
                    format!("row {rows} has not the cells of the header"),
                );
                break;
            };
            rows += 1;
            for (cell, name) in row.iter().zip(&header) {
                let is_number = cell.parse::<f64>().is_ok_and(f64::is_finite);
                if !is_number && (!cell.is_empty() || is_complete && is_place(name)) {
                    self.find(
                        "nan",
                        command,
                        format!(
                            "{name} is {cell:?} in row {rows} of {}",
                            if is_complete {
                                "a complete run"
                            } else {
                                "a run"
                            }
                        ),
                    );
                    return rows;
                }
            }
            let time = row
                .get(0)
                .and_then(|cell| cell.parse::<f64>().ok())
                .unwrap_or(f64::NAN);
            if time < before {
                self.find("file", command, format!("time goes back in row {rows}"));
                return rows;
            }
            before = time;
        }
        rows
    }

    pub fn json(&mut self, command: &str, text: &str) -> Option<Value> {
        let read = serde_json::from_str(text);
        if let Err(error) = &read {
            self.find("file", command, format!("no JSON: {error}"));
        }
        read.ok()
    }

    /// All that `run -o` leaves; the number of rows.
    pub fn files(&mut self, command: &str, said: &Said, folder: &Path) -> usize {
        let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap_or_default();
        let Some(summary) = self.json(command, &read("summary.json")) else {
            return 0;
        };
        let status = summary["status"].as_str().unwrap_or_default().to_string();
        if status.starts_with("completed") != (said.status == 0) {
            self.find(
                "status",
                command,
                format!("exit status {} of a run that is {status}", said.status),
            );
        }
        let rows = self.table(command, &folder.join("results.csv"), status == "completed");
        if status == "completed" && rows == 0 {
            self.find("file", command, "a completed run without rows");
        }
        let report = read("report.html");
        let odd = odd_words_of_page(&report);
        if !self.odd && odd > self.fuzzer.odd_in_report {
            self.find(
                "nan",
                command,
                format!("{odd} words like NaN in report.html"),
            );
        }
        if !self.odd && odd_words(&read("summary.json")).next().is_some() {
            self.find("nan", command, "in summary.json");
        }
        if !report.ends_with("</html>\n") && !report.trim_end().ends_with("</html>") {
            self.find("file", command, "report.html has no end");
        }
        rows
    }
}
