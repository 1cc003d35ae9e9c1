//! The same mechanism told otherwise.

use super::*;

#[test]
fn turning_the_world_turns_the_results() {
    let angle = 0.7;
    let found = each_model().into_iter().map(|(name, model)| {
        let (original, turned_run) = (solve(&model), solve(&rotate(&model, angle)));
        let differences = differ(&original, &turned_run, |row, column| {
            let value = match row.vector(&column.name) {
                Some((component, pair, _)) => turned(pair, angle)[component],
                None => {
                    let absolute = driver_of(column, ".value")
                        .is_some_and(|driver| is_absolute(&model.drivers[driver]));
                    row.get(&column.name)
                        + if quantity(column) == "angle" || absolute {
                            angle
                        } else {
                            0.0
                        }
                }
            };
            (column.name.clone(), value)
        });
        (name, original, differences)
    });
    hold("rotate", found.collect());
}

#[test]
fn moving_the_world_changes_nothing_but_places() {
    let by = [0.31, -0.17];
    let found = each_model().into_iter().map(|(name, model)| {
        let (original, moved) = (solve(&model), solve(&translate(&model, by)));
        let weight: f64 = model.bodies.values().filter_map(|body| body.mass).sum();
        let lifted = -weight * (model.gravity[0] * by[0] + model.gravity[1] * by[1]);
        let differences = differ(&original, &moved, |row, column| {
            let value = row.get(&column.name);
            let shift = match row.vector(&column.name) {
                Some((component, _, true)) => by[component],
                Some((_, _, false)) => 0.0,
                None if column.name == "energy.potential" => lifted,
                None => 0.0,
            };
            (column.name.clone(), value + shift)
        });
        (name, original, differences)
    });
    hold("translate", found.collect());
}

#[test]
fn a_mirror_changes_signs_only() {
    let found = each_model().into_iter().map(|(name, model)| {
        let (original, mirrored) = (solve(&model), solve(&mirror(&model)));
        let differences = differ(&original, &mirrored, |row, column| {
            let turns =
                |driver: &str| matches!(model.drivers[driver].kind, DriverKind::Rotation { .. });
            let sign = match (row.vector(&column.name), quantity(column)) {
                (Some((0, _, _)), _) | (None, "angle" | "omega" | "alpha" | "torque") => -1.0,
                (None, "sliding_speed" | "tangential_force" | "pressure_angle") => -1.0,
                (None, "friction") if column.unit == "N*m" => -1.0,
                (None, "value") if driver_of(column, ".value").is_some_and(turns) => -1.0,
                (None, "effort") if driver_of(column, ".effort").is_some_and(turns) => -1.0,
                (Some(_) | None, _) => 1.0,
            };
            (column.name.clone(), sign * row.get(&column.name))
        });
        (name, original, differences)
    });
    hold("mirror", found.collect());
}

#[test]
fn names_and_order_do_not_matter() {
    let found = each_model().into_iter().map(|(name, model)| {
        let (original, other) = (solve(&model), solve(&rename_and_reverse(&model)));
        let differences = differ(&original, &other, |row, column| {
            let parts: Vec<&str> = column.name.split('.').collect();
            let new = match parts[..] {
                ["joint", joint, quantity] => format!("joint.{}.{quantity}", renamed(joint)),
                ["driver", driver, quantity] => format!("driver.{}.{quantity}", renamed(driver)),
                ["energy", _] | [_] => column.name.clone(),
                [body, quantity] => format!("{}.{quantity}", renamed(body)),
                [body, point, quantity] => {
                    format!("{}.{}.{quantity}", renamed(body), renamed(point))
                }
                _ => panic!("{parts:?}"),
            };
            (new, row.get(&column.name))
        });
        (name, original, differences)
    });
    hold("rename", found.collect());
}

#[test]
fn units_are_only_words() {
    let found = each_model().into_iter().map(|(name, model)| {
        let original = solve(&load(&SI.write(&model)));
        let workshop = solve(&load(&WORKSHOP.write(&model)));
        let differences = differ(&original, &workshop, |row, column| {
            (column.name.clone(), row.get(&column.name))
        });
        (name, original, differences)
    });
    hold("units", found.collect());
}

/// The same model with another number of equally spaced outputs.
fn with_outputs(model: &Model, intervals: usize) -> Model {
    let mut model = model.clone();
    let analysis = model.analysis.as_mut().expect("an analysis");
    match &mut analysis.sample {
        Some(sample) => sample.step = (sample.to - sample.from) / intervals as f64,
        None => analysis.outputs = Some(intervals + 1),
    }
    model
}

#[test]
fn outputs_do_not_change_the_motion() {
    let mut found = Vec::new();
    for (name, model) in each_model() {
        let runs: Vec<(usize, Outcome)> = [2, 3, 7, 36, 71, 176, 1751, 2000]
            .map(|outputs: usize| (outputs - 1, solve(&with_outputs(&model, outputs - 1))))
            .into();
        let (finest, reference) = &runs[6];
        let scales = scales(reference);
        let mut differences = Differences::new();
        for (intervals, run) in &runs {
            assert_eq!(
                run.report.status,
                Status::Completed,
                "{name}: {intervals}: {:?}",
                run.report.message
            );
            assert_eq!(run.trajectory.len(), intervals + 1, "{name}");
            for k in 0..=*intervals {
                // Instant k of `intervals` is instant k·finest/intervals of the finest, where that is whole.
                if (k * finest) % intervals != 0 {
                    continue;
                }
                let (ours, theirs) = (
                    run.trajectory.row(k),
                    reference.trajectory.row(k * finest / intervals),
                );
                for ((column, ours), theirs) in run.trajectory.columns.iter().zip(ours).zip(theirs)
                {
                    let difference = if ours == theirs {
                        0.0
                    } else {
                        (ours - theirs).abs() / scales[column.unit]
                    };
                    let largest = differences.entry(column.unit).or_default();
                    *largest = if difference.is_nan() {
                        f64::INFINITY
                    } else {
                        largest.max(difference)
                    };
                }
            }
        }
        let reference = runs.into_iter().nth(6).expect("the finest but one").1;
        found.push((name, reference, differences));
    }
    hold("outputs", found);
}

#[test]
fn kept_columns_are_the_same_to_the_last_bit() {
    for (name, mut model) in each_model() {
        let whole = solve(&model);
        let kept: Vec<Column> = whole
            .trajectory
            .columns
            .iter()
            .step_by(7)
            .cloned()
            .collect();
        model.analysis.as_mut().expect("an analysis").columns =
            kept.iter().map(|column| column.name.clone()).collect();
        let part = solve(&model);
        assert_eq!(part.trajectory.columns[..], kept, "{name}");
        for column in &kept {
            let bits = |outcome: &Outcome| {
                values(outcome, &column.label())
                    .into_iter()
                    .map(f64::to_bits)
                    .collect::<Vec<_>>()
            };
            assert!(bits(&whole) == bits(&part), "{name}: {}", column.name);
        }
        assert_eq!(whole.report.statistics, part.report.statistics, "{name}");
    }
}

#[test]
fn runs_repeat_to_the_last_bit() {
    for (name, model) in each_model() {
        let (first, second) = (solve(&model), solve(&model));
        let bits = |outcome: &Outcome| {
            outcome
                .trajectory
                .data
                .iter()
                .map(|value| value.to_bits())
                .collect::<Vec<_>>()
        };
        assert!(bits(&first) == bits(&second), "{name}");
        assert_eq!(first.report.statistics, second.report.statistics, "{name}");
        assert_eq!(first.report.events, second.report.events, "{name}");
    }
}

#[test]
fn outputs_are_renamed_with_what_they_name() {
    let text = linkdyn_model::bundled::text("four-bar").expect("bundled");
    let sets = [
        r#"accuracy.outputs={ "swing": { "column": "rocker.angle", "at": { "driver": "motor", "value": 1 } },
                              "P": { "column": "coupler.P.x" }, "f": { "column": "joint.b.fx" },
                              "gap": { "distance": ["crank.A", "ground.O4"] } }"#,
        "bodies.crank.points.A.tolerance=10 um",
    ];
    let loaded = linkdyn_model::load(text.as_bytes(), &sets.map(str::to_owned)).expect("legal");
    let renamed = rename_and_reverse(&loaded.model).check();
    let renamed = renamed.unwrap_or_else(|said| panic!("{said}"));
    let printed = renamed.to_json();
    let outputs = &printed["accuracy"]["outputs"];
    assert_eq!(outputs["swing"]["column"], "rocker ♣.angle");
    assert_eq!(outputs["swing"]["at"]["driver"], "motor ♣");
    assert_eq!(outputs["P"]["column"], "coupler ♣.P ♣.x");
    assert_eq!(outputs["f"]["column"], "joint.b ♣.fx");
    assert_eq!(outputs["gap"]["distance"][1], "ground.O4 ♣");
    assert_eq!(
        printed["bodies"]["crank ♣"]["points"]["A ♣"]["tolerance"],
        1e-5
    );
}
