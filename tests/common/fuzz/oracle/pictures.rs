//! Figures and films.

use std::fs;

use super::super::rng::Rng;
use super::{Trial, odd_words};

/// Time that a picture may take [s].
const PICTURE: f64 = 4.0;

impl Trial<'_> {
    /// Figures and films of results.
    pub fn pictures(&mut self, rng: &mut Rng, results: &str) {
        let file = self.path(["figure.svg", "figure.png"][rng.below(2)]);
        let columns = rng.word(&[
            "*",
            "*.x",
            "*.angle",
            "joint.*.fx",
            "time",
            "*.omega",
            "*.effort",
            "d*",
        ]);
        let mut arguments: Vec<String> = ["plot", results, "--y", columns, "-o", &file]
            .map(String::from)
            .into();
        for (times, more) in [
            (3, &["--log-y"][..]),
            (4, &["--grid", "--events"]),
            (4, &["--units", "deg,mm,kN"]),
            (5, &["--log-x"]),
            (5, &["--x", "*.angle"]),
        ] {
            if rng.once_in(times) {
                arguments.extend(more.iter().map(|word| word.to_string()));
            }
        }
        self.picture(&arguments, &file);
        let file = self.path(["motion.svg", "motion.png", "motion.gif"][rng.below(3)]);
        let mut arguments: Vec<String> = ["animate", results, "-o", &file].map(String::from).into();
        if file.ends_with("gif") {
            arguments
                .extend(["--fps", "10", "--duration", "0.4", "--width", "160"].map(String::from));
        } else if rng.once_in(2) {
            arguments.extend(["--strip", "--poses", "3"].map(String::from));
        }
        self.picture(&arguments, &file);
    }

    pub fn picture(&mut self, arguments: &[String], file: &str) {
        let _ = fs::remove_file(file);
        let Some(said) = self.run(arguments, &[2], PICTURE) else {
            return;
        };
        let command = arguments.join(" ");
        match fs::read(file) {
            Ok(content) if said.status == 0 => {
                let text = if file.ends_with("svg") {
                    String::from_utf8_lossy(&content)
                } else {
                    "".into()
                };
                if content.is_empty() || !self.odd && odd_words(&text).next().is_some() {
                    self.find("nan", &command, "in a figure");
                }
            }
            Ok(_) => self.find("file", &command, "a figure, and a fault"),
            Err(_) if said.status == 0 => self.find("file", &command, "no figure, and no fault"),
            Err(_) => {}
        }
    }
}
