//! Accuracy as files: a table of poses, a table of contributions, and everything for programs.

use std::path::PathBuf;

use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::super::open::Opened;
use linkdyn_engine::analysis::accuracy::{Accuracy, Levels, OutputAccuracy, PoseAccuracy};
use linkdyn_output::csv::{push_field, push_number};
use linkdyn_output::{Directory, WriteError};

const TABLE: &str = "accuracy.csv";
const CONTRIBUTIONS: &str = "contributions.csv";
const SUMMARY: &str = "accuracy.json";

/// Writes all files.
///
/// # Errors
/// When a file can't be written.
pub fn write(
    directory: &Directory,
    found: &Accuracy,
    json: &str,
) -> Result<Vec<PathBuf>, WriteError> {
    Ok(vec![
        directory.write(TABLE, &table(found))?,
        directory.write(CONTRIBUTIONS, &contributions(found))?,
        directory.write(SUMMARY, json.as_bytes())?,
    ])
}

/// A row that is being written.
struct Row<'t>(&'t mut Vec<u8>);

impl Row<'_> {
    fn text(self, text: &str) -> Self {
        push_field(self.0, text);
        self.0.push(b',');
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

/// A row per output, pose and source.
fn contributions(found: &Accuracy) -> Vec<u8> {
    let mut text =
        b"output,time[s],driver,source,sensitivity,carries.minus,carries.plus,worst_share,variance_share\n"
            .to_vec();
    for output in &found.outputs {
        for pose in &output.poses {
            let by = found.sources.iter().zip(&pose.contributions);
            for ((source, by), share) in by.zip(pose.shares()) {
                Row(&mut text)
                    .text(&output.name)
                    .number(Some(pose.time))
                    .number(pose.drivers.first().copied())
                    .text(source)
                    .number(Some(by.sensitivity))
                    .pair(Some(by.reach))
                    .pair(Some(share))
                    .end();
            }
        }
    }
    text
}

/// Everything, for programs.
pub fn json(opened: &Opened, found: &Accuracy) -> String {
    let outputs = found.outputs.iter();
    let document = Document {
        engine: env!("CARGO_PKG_VERSION"),
        model: json!({ "name": opened.name, "sha256": opened.sha256 }),
        levels: match found.levels {
            Levels::First => "first",
            Levels::Worst => "worst",
            Levels::Certified => "certified",
        },
        outputs: Named(outputs.map(|output| (output.name.as_str(), of_output(found, output)))),
        warnings: &opened.loaded.warnings,
    };
    let text = serde_json::to_string_pretty(&document).expect("numbers and texts");
    text + "\n"
}

#[derive(Serialize)]
struct Document<'a, O: Serialize> {
    engine: &'a str,
    model: Value,
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

fn of_output<'a>(found: &'a Accuracy, output: &'a OutputAccuracy) -> impl Serialize + 'a {
    Asked {
        of: &output.of,
        unit: output.unit,
        limits: output.limits,
        poses: Listed(output.poses.iter().map(|pose| of_pose(found, pose))),
    }
}

fn of_pose<'a>(found: &'a Accuracy, pose: &'a PoseAccuracy) -> impl Serialize + 'a {
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
