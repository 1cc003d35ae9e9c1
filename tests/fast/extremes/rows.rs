//! Rows at events.

use super::*;
use linkdyn_output::EventKind;

fn times(outcome: &Outcome) -> Vec<f64> {
    outcome.trajectory.values("time").expect("a time")
}

/// Events at which a contact goes on in another way.
const SWITCHES: [EventKind; 3] = [
    EventKind::Stick,
    EventKind::Slip,
    EventKind::SustainedContact,
];

/// The outputs stay what they are, and every contact's beginning, peak and end are rows, each once.
#[test]
fn outputs_at_events_are_added() {
    for model in ["contact", "three_state"] {
        let word = format!("joints.wristpin.clearance.model={model}");
        let sets = [word.as_str(), "analysis.end=0.006", "analysis.outputs=121"];
        let plain = slider_crank(&sets);
        let outcome = slider_crank(&[&sets[..], &["analysis.outputs_at=events"]].concat());
        let (few, many) = (times(&plain), times(&outcome));
        assert!(
            many.windows(2).all(|pair| pair[0] < pair[1]),
            "{model}: times do not ascend"
        );
        let mut rows = outcome.trajectory.rows();
        for (row, time) in plain.trajectory.rows().zip(&few) {
            let same = rows.find(|other| other[0] == *time).expect("still there");
            assert!(
                row.iter()
                    .zip(same)
                    .all(|(a, b)| a.to_bits() == b.to_bits()),
                "{model}: another row at {time}"
            );
        }
        assert_eq!(outcome.settings["outputs_at"], "events");
        assert!(plain.settings.get("outputs_at").is_none());
        let force = outcome
            .trajectory
            .values("joint.wristpin.normal_force")
            .expect("there");
        for event in contacts(&outcome) {
            let episode = event.episode.expect("of a contact");
            assert!(
                many.contains(&episode.start),
                "{model}: no row at {}",
                episode.start
            );
            let Some(end) = episode.end else { continue };
            assert!(many.contains(&end), "{model}: no row at {end}");
            let within = many
                .iter()
                .zip(&force)
                .filter(|(time, _)| (episode.start..=end).contains(*time));
            let most = within.map(|(_, force)| *force).fold(0.0, f64::max);
            assert!(
                most >= episode.peak_force * (1.0 - 1e-9),
                "{model}: {most} for {}",
                episode.peak_force
            );
        }
        for event in outcome
            .report
            .events
            .iter()
            .filter(|event| SWITCHES.contains(&event.kind))
        {
            assert!(many.contains(&event.time), "{model}: no row at {event:?}");
        }
        assert!(many.len() > few.len() + 10, "{model}: {} rows", many.len());
    }
}

#[test]
fn outputs_at_events_of_a_driven_run_are_its_change_points() {
    // Two turns of a parallelogram, which is flat at 0 and at π.
    let motion = json!({ "type": "constant_velocity", "start": 0.5, "velocity": 2.0 * PI });
    let mut words = parallelogram(1, false, 0.5, &motion);
    words["analysis"] = json!({ "type": "kinematics", "end": 2.0, "outputs": 8 });
    let plain = solve(&loaded(&words).model);
    words["analysis"]["outputs_at"] = json!("events");
    let outcome = solve(&loaded(&words).model);
    let change: Vec<f64> = outcome
        .report
        .events
        .iter()
        .map(|event| event.time)
        .collect();
    assert_eq!(change.len(), 4, "{:?}", outcome.report.events);
    let many = times(&outcome);
    for time in &change {
        assert!(
            many.iter().any(|row| (row - time).abs() < 1e-9),
            "no row at {time}"
        );
    }
    assert!(many.windows(2).all(|pair| pair[0] < pair[1]));
    assert!(
        many.len() > plain.trajectory.len() && many.len() <= plain.trajectory.len() + change.len()
    );
    for row in plain.trajectory.rows() {
        let same = outcome
            .trajectory
            .rows()
            .find(|other| other[0] == row[0])
            .expect("still there");
        assert!(
            row.iter()
                .zip(same)
                .all(|(a, b)| a.to_bits() == b.to_bits()),
            "another row at {}",
            row[0]
        );
    }
}

#[test]
fn outputs_at_events_are_refused_where_they_mean_nothing() {
    let said = |name: &str, sets: &[&str]| {
        let text = linkdyn_model::bundled::find(name).expect("bundled").text;
        let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
        match linkdyn_model::load(text.as_bytes(), &sets) {
            Err(said) => format!("{said:?}"),
            Ok(loaded) => {
                let control = linkdyn_engine::analysis::Control::default();
                format!(
                    "{:?}",
                    linkdyn_engine::analysis::run(&loaded.model, &control).expect_err("refused")
                )
            }
        }
    };
    let word = "analysis.outputs_at=events";
    let statics = said("four-bar-spring", &["analysis.type=statics", word]);
    assert!(
        statics.contains("statics has one instant and no events"),
        "{statics}"
    );
    let wrong = said("four-bar", &["analysis.outputs_at=peaks"]);
    assert!(
        wrong.contains("outputs_at") && wrong.contains("events"),
        "{wrong}"
    );
    let sets = [
        "analysis.type=inverse_dynamics",
        "joints.wristpin.clearance.model=massless_link",
        word,
    ];
    let massless = said("slider-crank-clearance", &sets);
    assert!(massless.contains("massless clearance link"), "{massless}");
}

/// A motion without contacts has rows alone.
#[test]
fn smooth_motions_have_no_rows_of_peaks() {
    for name in ["double-pendulum", "four-bar"] {
        let outcome = solve(&load_bundled(name, &["analysis.outputs=11"]));
        assert!(
            outcome.peaks.is_empty() && outcome.curves().len() == outcome.trajectory.len(),
            "{name}"
        );
    }
}
