//! Accuracy for programs.

use std::io::{self, Write};

use linkdyn_variation::{Levels, OutputAccuracy, PoseAccuracy};
use serde::{Serialize, Serializer};
use serde_json::ser::{Formatter, PrettyFormatter};

use super::{Deviations, Found};
use crate::{ENGINE, Subject};

impl Deviations {
    /// Writes `accuracy.json`: a line for each thing of which there are many.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write<W: Write + ?Sized>(&self, out: &mut W) -> io::Result<()> {
        let mut serializer = serde_json::Serializer::with_formatter(&mut *out, Lines::default());
        self.serialize(&mut serializer)?;
        out.write_all(b"\n")
    }
}

/// `accuracy.json`.
impl Serialize for Deviations {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let found = &self.found;
        let outputs = found.outputs.iter();
        let document = Document {
            engine: ENGINE,
            model: self.file.subject(),
            levels: match found.levels {
                Levels::First => "first",
                Levels::Worst => "worst",
                Levels::Certified => "certified",
            },
            outputs: Named(outputs.map(|output| (output.name.as_str(), of_output(found, output)))),
            warnings: &self.file.loaded.warnings,
        };
        document.serialize(serializer)
    }
}

/// Arrays of an output's numbers at a pose, and what its sources contribute, stand on one line each: there are many.
const ARRAY: usize = 5;
const OBJECT: usize = 6;

/// Indented, but for what is deep inside.
#[derive(Default)]
struct Lines {
    pretty: PrettyFormatter<'static>,
    /// Objects and arrays that are open, and of those how many stand on one line.
    open: usize,
    flat: usize,
}

impl Lines {
    /// Whether what begins stands on one line, after `lines` others that are open.
    fn begins_flat(&mut self, lines: usize) -> bool {
        self.open += 1;
        let is_flat = self.flat > 0 || self.open > lines;
        self.flat += usize::from(is_flat);
        is_flat
    }

    /// Whether what ends stood on one line.
    fn ends_flat(&mut self) -> bool {
        self.open -= 1;
        let was_flat = self.flat > 0;
        self.flat -= usize::from(was_flat);
        was_flat
    }
}

impl Formatter for Lines {
    fn begin_array<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        match self.begins_flat(ARRAY) {
            true => out.write_all(b"["),
            false => self.pretty.begin_array(out),
        }
    }

    fn end_array<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        match self.ends_flat() {
            true => out.write_all(b"]"),
            false => self.pretty.end_array(out),
        }
    }

    fn begin_object<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        match self.begins_flat(OBJECT) {
            true => out.write_all(b"{"),
            false => self.pretty.begin_object(out),
        }
    }

    fn end_object<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        match self.ends_flat() {
            true => out.write_all(b"}"),
            false => self.pretty.end_object(out),
        }
    }

    fn begin_array_value<W: ?Sized + Write>(
        &mut self,
        out: &mut W,
        is_first: bool,
    ) -> io::Result<()> {
        match self.flat > 0 {
            true if is_first => Ok(()),
            true => out.write_all(b", "),
            false => self.pretty.begin_array_value(out, is_first),
        }
    }

    fn end_array_value<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        match self.flat > 0 {
            true => Ok(()),
            false => self.pretty.end_array_value(out),
        }
    }

    fn begin_object_key<W: ?Sized + Write>(
        &mut self,
        out: &mut W,
        is_first: bool,
    ) -> io::Result<()> {
        match self.flat > 0 {
            true if is_first => Ok(()),
            true => out.write_all(b", "),
            false => self.pretty.begin_object_key(out, is_first),
        }
    }

    fn end_object_value<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        match self.flat > 0 {
            true => Ok(()),
            false => self.pretty.end_object_value(out),
        }
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        out.write_all(b": ")
    }
}

#[derive(Serialize)]
struct Document<'a, O: Serialize> {
    engine: &'a str,
    model: Subject<'a>,
    levels: &'a str,
    outputs: O,
    warnings: &'a [String],
}

#[derive(Serialize)]
struct Asked<'a, P: Serialize> {
    of: &'a str,
    unit: &'a str,
    limits: Option<[f64; 2]>,
    poses: P,
}

#[derive(Serialize)]
struct Pose<'a, C: Serialize> {
    time: f64,
    drivers: &'a [f64],
    nominal: f64,
    first: Option<[f64; 2]>,
    found: [Option<f64>; 2],
    lacks: [Option<f64>; 2],
    certified: Option<[f64; 2]>,
    needed: &'a [Vec<[f64; 2]>; 2],
    mean: Option<f64>,
    sigma: Option<f64>,
    pressed: Option<f64>,
    missing: Option<&'a str>,
    within: Option<f64>,
    cp: Option<f64>,
    cpk: Option<f64>,
    contributions: C,
}

#[derive(Serialize)]
struct Share {
    sensitivity: f64,
    carries: [f64; 2],
    worst_share: f64,
    variance_share: f64,
}

/// An object of pairs that are made as they are written.
struct Named<I>(I);

impl<'a, T: Serialize, I: Iterator<Item = (&'a str, T)> + Clone> Serialize for Named<I> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.clone())
    }
}

/// An array of what is made as it is written.
struct Listed<I>(I);

impl<T: Serialize, I: Iterator<Item = T> + Clone> Serialize for Listed<I> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.clone())
    }
}

fn of_output<'a>(found: &'a Found, output: &'a OutputAccuracy) -> impl Serialize + 'a {
    Asked {
        of: &output.of,
        unit: output.unit,
        limits: output.limits,
        poses: Listed(output.poses.iter().map(|pose| of_pose(found, pose))),
    }
}

fn of_pose<'a>(found: &'a Found, pose: &'a PoseAccuracy) -> impl Serialize + 'a {
    let by = found.sources.iter().zip(&pose.contributions);
    let contributions = by.zip(pose.shares()).map(|((source, by), share)| {
        let share = Share {
            sensitivity: by.sensitivity,
            carries: by.reach,
            worst_share: share[0],
            variance_share: share[1],
        };
        (source.as_str(), share)
    });
    Pose {
        time: pose.time,
        drivers: &pose.drivers,
        nominal: pose.nominal,
        first: pose.first,
        found: pose.found,
        lacks: pose.lacks,
        certified: pose.certified,
        needed: &pose.needed,
        mean: pose.moments.map(|moments| moments[0]),
        sigma: pose.moments.map(|moments| moments[1]),
        pressed: pose.pressed,
        missing: pose.missing.as_deref(),
        within: pose.capability.map(|capability| capability.within),
        cp: pose.capability.map(|capability| capability.cp),
        cpk: pose.capability.map(|capability| capability.cpk),
        contributions: Named(contributions),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    /// Numbers of a pose and what a source contributes take a line each; what is read back is what was written.
    #[test]
    fn what_is_deep_inside_stands_on_one_line() {
        let by = json!({ "sensitivity": 2.5, "carries": [-1, 1] });
        let pose =
            json!({ "first": [-1e-3, null], "needed": [[], [[0, 1]]], "by": { "a": by, "b": {} } });
        let document =
            json!({ "outputs": { "o": { "limits": [1, 2], "poses": [pose] } }, "warnings": [] });
        let mut text = Vec::new();
        let mut serializer = serde_json::Serializer::with_formatter(&mut text, Lines::default());
        document
            .serialize(&mut serializer)
            .expect("memory takes it");
        let text = String::from_utf8(text).expect("text");
        assert_eq!(
            text,
            r#"{
  "outputs": {
    "o": {
      "limits": [
        1,
        2
      ],
      "poses": [
        {
          "first": [-0.001, null],
          "needed": [[], [[0, 1]]],
          "by": {
            "a": {"sensitivity": 2.5, "carries": [-1, 1]},
            "b": {}
          }
        }
      ]
    }
  },
  "warnings": []
}"#
        );
        assert_eq!(
            serde_json::from_str::<Value>(&text).expect("JSON"),
            document
        );
    }
}
