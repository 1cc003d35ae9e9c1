//! `summary.json`: how a run went, and the extremes of every column.

use serde_json::{Map, Value, json};

use super::{ClearanceSums, Equilibrium, Event, Report, Stage, StopSums, Trajectory};

/// What a summary is made of.
#[derive(Debug)]
pub struct Summary<'a> {
    /// Name of the model.
    pub model_name: &'a str,
    /// Digest of the model file's bytes, hexadecimal.
    pub model_sha256: &'a str,
    /// Settings as resolved.
    pub settings: &'a Value,
    /// How the run went.
    pub report: &'a Report,
    /// Named numbers by their names, as JSON; null where there are none.
    pub responses: Value,
    /// The table whose extremes are listed.
    pub trajectory: &'a Trajectory,
    /// The shape of the mechanism, for pictures.
    pub mechanism: Value,
    /// The shape as version 0.1 knew it.
    pub drawing: Value,
    /// Reading and checking of the model.
    pub load: Stage,
    /// Writing of all files but the summary itself.
    pub write: Stage,
}

/// The summary as JSON; a number that is not finite becomes null.
pub fn to_json(summary: &Summary) -> Value {
    let mut json = facts(summary);
    json.insert(
        "extremes".into(),
        extremes(summary.trajectory, summary.report),
    );
    json.insert("drawing".into(), summary.drawing.clone());
    json.insert("mechanism".into(), summary.mechanism.clone());
    Value::Object(json)
}

/// All of the summary but the extremes and the shape.
pub fn facts(summary: &Summary) -> Map<String, Value> {
    let report = summary.report;
    let mut json = Map::new();
    json.insert("status".into(), report.status.word().into());
    if let Some(message) = &report.message {
        json.insert("message".into(), message.as_str().into());
    }
    if let Some(reason) = &report.reason {
        json.insert(
            "reason".into(),
            json!({
                "time": reason.time,
                "cause": reason.cause,
                "residual": reason.residual,
                "constraints": reason.owners,
            }),
        );
    }
    json.insert("engine".into(), env!("CARGO_PKG_VERSION").into());
    json.insert(
        "model".into(),
        json!({ "name": summary.model_name, "sha256": summary.model_sha256 }),
    );
    json.insert("settings".into(), summary.settings.clone());
    json.insert(
        "mobility".into(),
        json!({
            "grubler": report.mobility.grubler,
            "rank": report.mobility.rank,
            "drivers": report.mobility.drivers,
            "redundant": report.mobility.redundant,
            "reactions_not_unique": report.mobility.reactions_not_unique,
        }),
    );
    json.insert(
        "statistics".into(),
        json!({
            "steps": report.statistics.steps,
            "rejected": report.statistics.rejected,
            "newton_iterations": report.statistics.newton_iterations,
            "evaluations": report.statistics.evaluations,
            "factorisations": report.statistics.factorisations,
        }),
    );
    json.insert(
        "timing".into(),
        json!({
            "load": stage(summary.load),
            "assemble": stage(report.assemble),
            "solve": stage(report.solve),
            "write": stage(summary.write),
        }),
    );
    json.insert(
        "quality".into(),
        json!({
            "constraint_residual": report.quality.constraint_residual,
            "power_imbalance": report.quality.power_imbalance,
            "energy_drift": report.quality.energy_drift,
            "energy_imbalance": report.quality.energy_imbalance,
        }),
    );
    if let Some(imbalance) = report.quality.section_imbalance {
        json["quality"]["section_imbalance"] = imbalance.into();
    }
    if !summary.responses.is_null() {
        json.insert("responses".into(), summary.responses.clone());
    }
    if let Some(found) = &report.equilibrium {
        json.insert("equilibrium".into(), equilibrium(found));
    }
    json.extend(contacts(report));
    json.insert("warnings".into(), report.warnings.as_slice().into());
    json.insert(
        "events".into(),
        report.events.iter().map(Event::to_json).collect(),
    );
    if !report.unbounded.is_empty() {
        let unbounded = report.unbounded.iter();
        let told = unbounded.map(|one| json!({ "times": one.times, "columns": one.columns }));
        json.insert("unbounded".into(), told.collect());
    }
    json
}

/// What journals and stops do over the whole run, where there are some.
fn contacts(report: &Report) -> Map<String, Value> {
    let mut json = Map::new();
    if !report.clearances.is_empty() {
        let sums = report
            .clearances
            .iter()
            .map(|sums| (sums.joint.clone(), clearance(sums)))
            .collect();
        json.insert("clearances".into(), Value::Object(sums));
    }
    if !report.stops.is_empty() {
        json.insert("stops".into(), stops(&report.stops));
    }
    json
}

/// The summary as the text of the file.
pub fn to_text(summary: &Summary) -> String {
    format!("{:#}\n", to_json(summary))
}

/// An equilibrium.
pub fn equilibrium(found: &Equilibrium) -> Value {
    json!({
        "stable": found.stability == "stable",
        "stability": found.stability,
        "coordinates": found.coordinates,
        "stiffness": found.stiffness,
        "residual": found.residual,
    })
}

/// A joint's contacts over the whole run.
fn clearance(sums: &ClearanceSums) -> Value {
    json!({
        "contacts": sums.episodes,
        "stick_slip_changes": sums.switches,
        "time_in_contact": sums.time_in_contact,
        "energy_lost": sums.energy_lost,
        "impulse": sums.impulse,
        "wear": sums.wear,
    })
}

/// What joints do at their stops over the whole run: by joint and stop.
fn stops(all: &[StopSums]) -> Value {
    let mut joints = Map::new();
    for sums in all {
        let joint = joints.entry(sums.joint.as_str());
        joint.or_insert_with(|| json!({}))[sums.stop] = json!({
            "contacts": sums.episodes,
            "time_in_contact": sums.time_in_contact,
            "energy_lost": sums.energy_lost,
            "impulse": sums.impulse,
        });
    }
    Value::Object(joints)
}

fn stage(stage: Stage) -> Value {
    json!({ "wall": stage.wall, "cpu": stage.cpu })
}

/// Extremes by column; nulls where a column has no value at all. Of a column without bound they are those of the rows.
fn extremes(trajectory: &Trajectory, report: &Report) -> Value {
    let unbounded = report.first_unbounded();
    let found = trajectory.extremes().into_iter().zip(&*trajectory.columns);
    let of_column = found.map(|(extremes, column)| {
        let mut json = match extremes {
            Some(e) => json!({ "min": e.min, "min_time": e.min_time, "max": e.max, "max_time": e.max_time }),
            None => json!({ "min": null, "min_time": null, "max": null, "max_time": null }),
        };
        if unbounded.contains_key(column.name.as_str()) {
            json["unbounded"] = true.into();
        }
        json
    });
    Value::Object(
        trajectory
            .columns
            .iter()
            .map(|column| column.label())
            .zip(of_column)
            .collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::super::{Column, EventKind, Quality, Reason};
    use super::*;

    fn example() -> (Report, Trajectory) {
        let change_point = Event {
            driver: Some("motor \"M\" 🔒".into()),
            value: Some(2.05),
            ..Event::at(EventKind::ChangePoint, 1.7)
        };
        let gap = Event {
            end_time: Some(2.0),
            ..Event::at(EventKind::NoSolution, 1.7)
        };
        let report = Report {
            events: vec![change_point, gap],
            quality: Quality {
                constraint_residual: f64::NAN,
                ..Quality::default()
            },
            ..Report::default()
        };
        let mut trajectory = Trajectory::new(vec![
            Column::new("time", "s"),
            Column::new("crank.omega", "rad/s"),
        ]);
        trajectory.push_row(&[0.0, 10.0]);
        trajectory.push_row(&[0.1, f64::NAN]);
        (report, trajectory)
    }

    fn summary_text() -> String {
        let (report, trajectory) = example();
        let settings = json!({ "rtol": 1e-6 });
        let stage = Stage::default();
        to_text(&Summary {
            model_name: "m",
            model_sha256: "00",
            settings: &settings,
            report: &report,
            trajectory: &trajectory,
            mechanism: json!({}),
            drawing: json!({}),
            responses: Value::Null,
            load: stage,
            write: stage,
        })
    }

    #[test]
    fn keys_stand_in_the_order_of_the_contract() {
        let json: Value = serde_json::from_str(&summary_text()).expect("valid JSON");
        let keys: Vec<&String> = json.as_object().expect("an object").keys().collect();
        assert_eq!(
            keys,
            [
                "status",
                "engine",
                "model",
                "settings",
                "mobility",
                "statistics",
                "timing",
                "quality",
                "warnings",
                "events",
                "extremes",
                "drawing",
                "mechanism"
            ]
        );
        assert_eq!(
            json["extremes"]["crank.omega[rad/s]"],
            json!({"min":10.0,"min_time":0.0,"max":10.0,"max_time":0.0})
        );
        assert_eq!(
            json["events"][0],
            json!({"type":"change_point","time":1.7,"driver":"motor \"M\" 🔒","value":2.05})
        );
        assert_eq!(
            json["events"][1],
            json!({"type":"no_solution","time":1.7,"end_time":2.0})
        );
    }

    #[test]
    fn the_reason_of_an_end_stands_behind_its_message() {
        let (mut report, trajectory) = example();
        report.message = Some("the motion can't be followed".into());
        report.reason = Some(Reason {
            time: 0.25,
            cause: "the Jacobian is singular".into(),
            residual: Some(f64::NAN),
            rows: vec![3],
            owners: vec!["joint \"b\"".into()],
        });
        let stage = Stage::default();
        let json = to_json(&Summary {
            report: &report,
            trajectory: &trajectory,
            model_name: "",
            model_sha256: "",
            settings: &json!({}),
            mechanism: json!({}),
            drawing: json!({}),
            responses: Value::Null,
            load: stage,
            write: stage,
        });
        let keys = json.as_object().expect("an object").keys();
        let first: Vec<&str> = keys.take(3).map(String::as_str).collect();
        assert_eq!(first, ["status", "message", "reason"]);
        assert_eq!(
            json["reason"],
            json!({
                "time": 0.25,
                "cause": "the Jacobian is singular",
                "residual": null,
                "constraints": ["joint \"b\""],
            })
        );
    }

    #[test]
    fn numbers_that_do_not_exist_are_null() {
        let text = summary_text();
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        let json: Value = serde_json::from_str(&text).expect("valid JSON");
        assert!(json["quality"]["constraint_residual"].is_null(), "{text}");
    }
}
