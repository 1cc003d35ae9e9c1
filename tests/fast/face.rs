//! The face of the library: what a program can do with a mechanism, and what it is told where it can't.

use linkdyn::prelude::*;

fn four_bar() -> Mechanism {
    Mechanism::bundled("four-bar").expect("bundled")
}

#[test]
fn mechanisms_and_runs_go_to_any_thread() {
    fn shared<T: Send + Sync + 'static>() {}
    shared::<Mechanism>();
    shared::<Run>();
    shared::<Family>();
    shared::<Model>();
    shared::<Parameter>();
    shared::<Column>();
    shared::<Error>();
    let mechanism = four_bar();
    let effort = mechanism.column("driver.motor.effort").expect("there");
    let peaks: Vec<f64> = std::thread::scope(|scope| {
        let runs =
            (0..2).map(|_| scope.spawn(|| mechanism.run().expect("runs").column(effort).max_abs()));
        let runs: Vec<_> = runs.collect();
        runs.into_iter()
            .map(|run| run.join().expect("no panic"))
            .collect()
    });
    assert_eq!(peaks[0].to_bits(), peaks[1].to_bits());
}

#[test]
fn a_family_goes_on_from_the_values_that_its_mechanism_was_given() {
    let mechanism = four_bar()
        .set("responses.top", "max(coupler.y)")
        .expect("a response");
    let [crank, coupler] =
        ["crank", "coupler"].map(|name| mechanism.parameter(name).expect("there"));
    let longer = mechanism.with([(coupler, mm(270.0))]).expect("sound");
    let family = longer.family(&[crank]).expect("it runs");
    let mut top = [0.0];
    let status = family.member().run(&[0.09], &mut top).expect("sound");
    assert_eq!(status, Status::Completed);
    let run = longer
        .with([(crank, mm(90.0))])
        .expect("sound")
        .run()
        .expect("runs");
    let y = run.mechanism().column("coupler.y").expect("there");
    // the coupler stands at the crank's end, and rows beside its top
    assert!((top[0] - 0.09).abs() < 1e-13, "{top:?}");
    assert!((run.column(y).max() - top[0]).abs() < 1e-5);
    let refused = family
        .member()
        .run(&[f64::NAN], &mut top)
        .expect_err("no length");
    assert_eq!(
        refused.to_string(),
        "line 7, column 46: parameters.crank: NaN: a finite number is expected"
    );
}

#[test]
fn a_parameter_at_its_nominal_value_changes_no_bit() {
    let mechanism = four_bar();
    let nominal = mechanism
        .parameters()
        .map(|(_, parameter)| (parameter, parameter.nominal()));
    let same = mechanism.with(nominal.collect::<Vec<_>>()).expect("sound");
    assert_eq!(same.model(), mechanism.model());
    let (a, b) = (mechanism.run().expect("runs"), same.run().expect("runs"));
    let bits = |run: &Run, column: Column| -> Vec<u64> {
        run.column(column).iter().map(f64::to_bits).collect()
    };
    for ((name, first), (_, second)) in mechanism.columns().zip(same.columns()) {
        assert_eq!(bits(&a, first), bits(&b, second), "{name}");
    }
}

#[test]
fn a_crank_of_another_length_moves_on_another_circle() {
    let mechanism = four_bar();
    let crank = mechanism.parameter("crank").expect("a parameter");
    assert_eq!((crank.nominal().si(), crank.unit()), (0.1, "m".to_owned()));
    for radius in [80.0, 95.5] {
        let longer = mechanism.with([(crank, mm(radius))]).expect("sound");
        // Handles of the first mechanism serve its variants.
        let (x, y) = ("joint.b.fx", "crank.x");
        assert_eq!(
            longer.column(x).expect("there"),
            mechanism.column(x).expect("there")
        );
        let points = longer.set("points", r#"["crank.A"]"#).expect("sound");
        let run = points.run().expect("runs").complete().expect("completes");
        let [px, py] = ["crank.A.x", "crank.A.y"].map(|name| points.column(name).expect("there"));
        for (x, y) in run.column(px).iter().zip(run.column(py).iter()) {
            assert!((x.hypot(y) - radius / 1e3).abs() < 1e-12, "{x} {y}");
        }
        assert!(points.column(y).is_ok());
    }
}

#[test]
fn what_can_t_be_done_is_said() {
    let mechanism = four_bar();
    let said = |error: Error| error.to_string();
    let unknown = mechanism.parameter("cranc").expect_err("none");
    assert_eq!(
        said(unknown),
        r#"no parameter is called "cranc"; did you mean "crank"?"#
    );
    let unknown = mechanism.column("driver.motor.efort").expect_err("none");
    assert_eq!(
        said(unknown),
        r#"no column is called "driver.motor.efort"; did you mean "driver.motor.effort"?"#
    );
    let crank = mechanism.parameter("crank").expect("there");
    let wrong = mechanism.with([(crank, deg(3.0))]).expect_err("an angle");
    assert_eq!(said(wrong), r#"the parameter "crank" is in m, not in rad"#);
    let wrong = mechanism.with([(crank, 3.0.into())]).expect_err("a number");
    assert_eq!(
        said(wrong),
        r#"the parameter "crank" is in m, not in plain numbers"#
    );
    for value in [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300] {
        // Whatever it is, it is told or runs; nothing panics.
        if let Ok(odd) = mechanism.with([(crank, m(value))]) {
            let _ = odd.run().map(|run| run.status());
        }
    }
    let missing = Mechanism::open("no/such/file.json").expect_err("no file");
    assert!(said(missing).starts_with("no/such/file.json: can't be read"));
    let faulty = r#"{ "format": "linkdyn/1", "units": "SI", "bodies": { "a": {}, "b": { "mass": "5 mm" } } }"#;
    let faulty = faulty.parse::<Mechanism>().expect_err("a mass in mm");
    assert_eq!(faulty.complaints().len(), 1, "{faulty}");
    assert!(faulty.complaints()[0].place.is_some());
    let error: Box<dyn std::error::Error + Send + Sync> = Box::new(faulty);
    assert!(error.to_string().contains("bodies.b.mass"), "{error}");
}

#[test]
fn units_are_named_once_and_read_back() {
    for (given, named) in [
        ("kN/mm", "N/m"),
        ("1/min", "Hz"),
        ("g*mm^2/ms^4", "kg*m^2/s^4"),
        ("1/(mm*deg)", "1/m/rad"),
    ] {
        let quantity = Quantity::new(2.0, given).expect("a unit");
        assert_eq!(quantity.unit(), named);
        let again = Quantity::new(quantity.si(), named).expect("a unit");
        assert_eq!(again, quantity);
    }
    assert_eq!(Quantity::from(2.0).unit(), "");
}

#[test]
fn a_run_that_ends_early_keeps_what_it_has() {
    // A crank too long to go round.
    let mechanism = four_bar();
    let crank = mechanism.parameter("crank").expect("there");
    let stuck = mechanism.with([(crank, mm(240.0))]).expect("sound");
    let run = stuck.run().expect("runs");
    assert_eq!(run.status(), Status::DeadCentre);
    assert!(!run.time().is_empty());
    let early = run.complete().expect_err("ends early");
    assert!(
        matches!(
            early,
            Error::Early {
                status: Status::DeadCentre,
                ..
            }
        ),
        "{early}"
    );
}

#[test]
#[should_panic(expected = "the column is one of a mechanism with other columns")]
fn columns_of_another_mechanism_are_refused() {
    let other = Mechanism::bundled("slider-crank").expect("bundled");
    let column = other.columns().last().expect("some").1;
    let run = four_bar().run().expect("runs");
    run.column(column);
}

/// A file of results is read with the names that were written: each is that of its channel, of every model.
#[test]
fn names_of_columns_read_back_as_their_channels() {
    let mut seen = 0;
    for bundled in linkdyn_model::bundled::MODELS {
        let loaded = linkdyn_model::load(bundled.text.as_bytes(), &[]).expect(bundled.name);
        let prepared = linkdyn_engine::analysis::Prepared::new(&loaded.model).expect(bundled.name);
        for column in prepared.columns().iter() {
            let channel = column.channel.expect("a result");
            let read = linkdyn_output::Channel::read(&column.name);
            let (found, owner) = read.unwrap_or_else(|| panic!("{}", column.name));
            assert_eq!(
                (found, owner),
                (channel.with_owner(0), column.owner.as_str()),
                "{}",
                column.name
            );
            seen += 1;
        }
    }
    assert!(seen > 500, "only {seen} columns were found");
}
