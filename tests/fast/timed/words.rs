//! Bad words of what closes and opens.

use super::*;
use linkdyn_model::event::Event as Happens;
use linkdyn_model::{JointKind, OneWay, Timed};

fn said(joint: &str, more: &Value) -> String {
    let mut model = shaft([0.5, 0.3], [0.0, 0.0], &json!({}), 1.0);
    join(&mut model["joints"][joint], more);
    said_of(&model)
}

fn said_of(model: &Value) -> String {
    let text = model.to_string();
    let faults = linkdyn_model::load(text.as_bytes(), &[]).expect_err("refused");
    let told = faults.to_string();
    let (_, told) = told.split_once(": ").expect("a place before what is said");
    told.to_owned()
}

/// What is wrong, and what would be right.
#[test]
fn faulty_events_are_told() {
    let lock = |from: &str| json!({ "lock": { "from": from } });
    for (more, expected) in [
        (
            lock("time > 1 s"),
            r#"joints.clutch.lock.from: "time > 1 s": an event compares two expressions (with >=, <= or reaches, as in "door.angle >= 90 deg")"#,
        ),
        (
            lock("1 s <= time <= 2 s"),
            r#"joints.clutch.lock.from: "1 s <= time <= 2 s": an event compares two expressions once (with >=, <= or reaches, as in "door.angle >= 90 deg")"#,
        ),
        (
            lock("load.omega >= 3 rad"),
            r#"joints.clutch.lock.from: "load.omega >= 3 rad": an angular velocity [rad/s] and an angle [rad] can't be compared"#,
        ),
        (
            lock("load.omega >= 3"),
            r#"joints.clutch.lock.from: "load.omega >= 3": an angular velocity [rad/s] and a plain number can't be compared (a number gets a unit as in 2 rad/s)"#,
        ),
        (
            lock("laod.omega >= 3 rad/s"),
            r#"joints.clutch.lock.from: "laod.omega >= 3 rad/s": there is no parameter, and nothing that moves, called "laod.omega" (did you mean "load.omega"?)"#,
        ),
        (
            lock("energy.kinetic >= 3 J"),
            r#"joints.clutch.lock.from: "energy.kinetic >= 3 J": energy.kinetic follows from the forces, and can't be in one (places, angles and their rates can, and t)"#,
        ),
        (
            lock("joint.clutch.fx >= 3 N"),
            r#"joints.clutch.lock.from: "joint.clutch.fx >= 3 N": joint.clutch.fx follows from the forces, and can't be in one (places, angles and their rates can, and t)"#,
        ),
        (
            lock("2 s >= 1 s"),
            r#"joints.clutch.lock.from: "2 s >= 1 s": nothing in this event moves (it names what moves, or time, as in "time >= 1 s")"#,
        ),
        (
            lock(">= 1 s"),
            r#"joints.clutch.lock.from: ">= 1 s": one side of this event is empty (as in "door.angle >= 90 deg")"#,
        ),
        (
            lock("time >= (1 s"),
            r#"joints.clutch.lock.from: "time >= (1 s": this "(" is not closed"#,
        ),
    ] {
        assert_eq!(said("clutch", &more), expected, "{more}");
    }
}

/// The same of what holds, and of what it can't be together with.
#[test]
fn faulty_holds_are_told() {
    for (more, expected) in [
        (
            json!({ "lock": {} }),
            r#"joints.clutch.lock: it neither closes nor opens (say from when or until when it holds, as in "from": "time >= 1 s")"#,
        ),
        (
            json!({ "lock": { "until": 3.0 } }),
            r#"joints.clutch.lock.until: 3.0: text is expected, not a number (as in "from": "door.angle >= 90 deg")"#,
        ),
        (
            json!({ "lock": { "form": "time >= 1 s" } }),
            r#"joints.clutch.lock.form: "form": unknown key (did you mean "from"?)"#,
        ),
        (
            json!({ "lock": "time >= 1 s" }),
            r#"joints.clutch.lock: "time >= 1 s": an object is expected, not text (as in "lock": { "from": "time >= 1 s" })"#,
        ),
        (
            json!({ "lock": { "from": "time >= 1 s", "until": "time >= 1 s" } }),
            r#"joints.clutch.lock.until: "time >= 1 s": it opens at the event at which it closes (let it open at another event)"#,
        ),
        (
            json!({ "lock": { "release": "5 N" } }),
            r#"joints.clutch.lock.release: "5 N": "N" is not a unit of torque (such as "N*m")"#,
        ),
        (
            json!({ "lock": { "release": 0.0 } }),
            r#"joints.clutch.lock.release: 0.0: must be greater than 0"#,
        ),
        (
            json!({ "one_way": "forwards" }),
            r#"joints.clutch.one_way: "forwards": unknown one_way (did you mean "forward"?)"#,
        ),
        (
            json!({ "active": { "release": "5 N*m" } }),
            r#"joints.clutch.active.release: "5 N*m": "N*m" is not a unit of force (such as "N")"#,
        ),
        (
            json!({ "active": { "until": "time >= 1 s" }, "limits": [0.0, 1.0] }),
            r#"joints.clutch.active: a joint that opens is ideal, and this one has "limits" (leave out "limits", or give it to another joint)"#,
        ),
        (
            json!({ "active": { "from": "time >= 1 s" }, "one_way": "forward" }),
            r#"joints.clutch.active: a joint that is open at first is ideal, and this one has "one_way" (leave out "one_way", or give it to another joint)"#,
        ),
        (
            json!({ "active": { "until": "time >= 1 s" }, "friction": { "law": "coulomb", "coefficient": 0.1, "threshold_velocity": 0.01 }, "pin_radius": 0.01 }),
            r#"joints.clutch.active: a joint that opens is ideal, and this one has "friction" (leave out "friction", or give it to another joint)"#,
        ),
    ] {
        assert_eq!(said("clutch", &more), expected, "{more}");
    }
}

/// Joints that can't, and analyses that don't.
#[test]
fn what_cannot_close_is_told() {
    let mut model = shaft(
        [0.5, 0.3],
        [0.0, 0.0],
        &json!({ "lock": { "from": "time >= 1 s" } }),
        1.0,
    );
    model["analysis"] = json!({ "type": "kinematics", "end": 1.0, "outputs": 3 });
    assert_eq!(
        said_of(&model),
        r#"joints.clutch.lock: what closes or opens needs a free motion, and drivers prescribe this one (take "dynamics", where drivers may leave something free, or leave it out)"#
    );
    let weld = json!({ "type": "fixed", "between": ["rotor.O", "load.O"], "lock": { "from": "time >= 1 s" } });
    let mut model = shaft([0.5, 0.3], [0.0, 0.0], &json!({}), 1.0);
    model["joints"]["clutch"] = weld;
    assert_eq!(
        said_of(&model),
        r#"joints.clutch.lock: "lock": unknown key (known keys: type, angle, active, between, note)"#
    );
    model["joints"]["clutch"] = json!({ "type": "slot", "axis": [1, 0], "between": ["rotor.O", "load.O"], "one_way": "forward" });
    assert_eq!(
        said_of(&model),
        r#"joints.clutch.one_way: "one_way": unknown key (known keys: type, axis, play, limits, restitution, sense, stiffness, damping, latch, release, active, lock, between, note)"#
    );
}

/// A model with events prints as it was read, with parameters as names over its file and as numbers alone.
#[test]
fn events_print_as_they_were_read() {
    let more = json!({ "one_way": "backward",
        "lock": { "from": "rotor.omega >= top/2", "until": "time reaches 0.4 s", "release": "=5 N*m" } });
    let mut model = shaft([0.5, 0.3], [1.0, 1.0], &more, 1.0);
    model["parameters"] = json!({ "top": { "value": "9 rad/s" } });
    let read = loaded(&model);
    assert_eq!(read.source.print(&read.model), read.document);
    let printed = read.model.to_json();
    let lock = &printed["joints"]["clutch"]["lock"];
    assert_eq!(lock["from"], "rotor.omega >= (9.0 rad/s)/2");
    assert_eq!(loaded(&printed).model.to_json(), printed);
    assert_eq!(
        column(&outcome(&printed), "load.omega"),
        column(&outcome(&model), "load.omega")
    );
    // Another value of the parameter is put in without reading again.
    let set = |value: &str| {
        let sets = [format!("parameters.top={value}")];
        linkdyn_model::load(model.to_string().as_bytes(), &sets).expect("a sound model")
    };
    let expected = set("4 rad/s").model.to_json();
    assert_eq!(
        expected["joints"]["clutch"]["lock"]["from"],
        "rotor.omega >= (4.0 rad/s)/2"
    );
}

/// Programs can write what files can't.
#[test]
fn what_programs_write_is_checked() {
    let model = loaded(&shaft([0.5, 0.3], [1.0, 1.0], &json!({}), 1.0)).model;
    let lock = Timed {
        from: Some(Happens::new("time >= 1 s")),
        ..Timed::default()
    };
    let said = |kind: JointKind, active: bool| {
        let changed = model.edit(|model| {
            let joint = &mut model.joints["clutch"];
            joint.kind = kind;
            let place = match active {
                true => &mut joint.stops.active,
                false => &mut joint.stops.lock,
            };
            *place = Some(Box::new(lock.clone()));
        });
        changed.expect_err("refused").to_string()
    };
    let fixed = JointKind::Fixed { angle: 0.0 };
    assert_eq!(
        said(fixed, false),
        "joints.clutch.lock: this joint can't be locked (revolute and prismatic joints and slots can)"
    );
    let rack = || JointKind::Rack {
        axis: [1.0, 0.0],
        radius: 0.1,
        offset: None,
    };
    assert_eq!(
        said(rack(), true),
        "joints.clutch.active: this joint can't be open (revolute, prismatic, slot and fixed joints can)"
    );
    let changed = model.edit(|model| {
        let joint = &mut model.joints["clutch"];
        joint.kind = JointKind::Slot {
            axis: [1.0, 0.0],
            play: None,
        };
        joint.stops.one_way = Some(OneWay::Forward);
    });
    assert_eq!(
        changed.expect_err("refused").to_string(),
        "joints.clutch.one_way: only a revolute joint turns (leave it out)"
    );
    let changed = model.edit(|model| {
        let lock = Timed {
            from: Some(Happens::new("rotor.omeg >= 1 rad/s")),
            ..Timed::default()
        };
        model.joints["clutch"].stops.lock = Some(Box::new(lock));
    });
    assert_eq!(
        changed.expect_err("refused").to_string(),
        "joints.clutch.lock.from: there is no parameter, and nothing that moves, called \"rotor.omeg\" (did you mean \
         \"rotor.omega\"?)"
    );
}
