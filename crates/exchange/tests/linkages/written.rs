//! Models that are written, letter by letter.

use super::*;

#[test]
fn a_link_becomes_a_model() {
    let text = "https://app.pmksplus.com/?".to_owned() + link("punch-press");
    let imported = done(&text, Format::Pmks);
    assert_eq!(
        imported.draft.text(),
        r#"{
  "format": "linkdyn/1",
  "name": "Mechanism from PMKS+",
  "source": "PMKS+, a share link",
  "units": { "length": "cm", "mass": "g", "inertia": "kg*cm^2" },
  "gravity": [0, -9.81],
  "bodies": {
    "ground": { "points": { "A": [0, 0], "C": [0, -3.4] } },
    "Crank": { "mass": 2, "inertia": 0.05, "com": [0, 0.6], "points": { "A": [0, 0], "B": [0, 1.2] } },
    "Connecting_rod": { "mass": 3, "inertia": 0.4, "com": [0, -1.1], "points": { "B": [0, 1.2], "C": [0, -3.4], "F1": [0, -3.4] } },
    "C_block": { "mass": 6, "inertia": 0, "com": [0, -3.4], "points": { "C": [0, -3.4] } }
  },
  "joints": {
    "A": { "type": "revolute", "between": ["ground.A", "Crank.A"] },
    "B": { "type": "revolute", "between": ["Crank.B", "Connecting_rod.B"] },
    "C": { "type": "prismatic", "between": ["ground.C", "C_block.C"], "axis": ["=cos(1.571 rad)", "=sin(1.571 rad)"] },
    "C_2": { "type": "revolute", "between": ["C_block.C", "Connecting_rod.C"] }
  },
  "drivers": {
    "motor": { "type": "rotation", "body": "Crank", "motion": { "type": "constant_velocity", "velocity": "-5 rpm" } }
  },
  "forces": {
    "F1": { "type": "force", "at": "Connecting_rod.F1", "vector": [0, 400] }
  },
  "analysis": { "type": "inverse_dynamics", "end": 12, "outputs": 361 }
}
"#
    );
    assert_eq!(
        lacks(&imported),
        ["page: colours, grid, labels, scale and what is selected"]
    );
    // A link with escapes, from a shortcut's file, of another host, or what stands behind its ? alone.
    let escaped = text.replace(',', "%2C").replace(' ', "%20");
    let shortcut = format!("[InternetShortcut]\r\nURL={text}\r\nIconIndex=0\r\n");
    for same in [
        &escaped,
        &shortcut,
        link("punch-press"),
        &text.replace("app.pmksplus.com", "localhost:4200"),
    ] {
        assert_eq!(done(same, Format::Pmks), imported, "{same}");
    }
}

#[test]
fn the_slides_of_old_and_new_links_are_the_same() {
    // docs/fixture-urls.md at 04972b64 and at 009c45c0: one drawing in both spellings.
    let old = done(link("inverted-slider-crank"), Format::Pmks);
    let new = checked(
        "2P.Fe.K,0.1011.MA,A,0,0,0.HB,B,0,Fe,0,CD,C,D.KC,C,ku,0,0.GD,D,0RF,Oj,0..YRAB,AB,Fe,Fe,0,7q,c5cae9,A,B,,.YRCD,CD,Fe,Fe,9q,CN,303e9f,C,D,,...N_",
    );
    let mut new = done(&new, Format::Pmks);
    // The new spelling has no mass of the block, 1 g in the old one.
    new.draft
        .bodies
        .insert("B_block".into(), old.draft.bodies["B_block"].clone());
    assert_eq!(new.draft.bodies, old.draft.bodies);
    assert_eq!(old.draft.joints["B"]["type"], "prismatic");
    assert_eq!(new.draft.joints["B"]["type"], "slot");
    assert_eq!(new.draft.joints["B"]["axis"], old.draft.joints["B"]["axis"]);
}

#[test]
fn what_a_link_has_and_a_model_lacks_is_listed() {
    let lacks_of = |name: &str| lacks(&done(link(name), Format::Pmks))[1..].to_vec();
    assert_eq!(
        lacks_of("frame-as-a-bar"),
        ["link AD: its mass: it is pinned to the ground twice, and so part of it"]
    );
    assert_eq!(
        lacks_of("locked-four-bar"),
        ["marks: locks, holds, syntheses and others, of kind 'J'"]
    );
    assert_eq!(lacks_of("two-four-bars"), [""; 0]);
    // A second input of one linkage, and an input of three bodies.
    let two = link("frame-as-a-bar").replace(".4D,", ".6D,");
    let (body, _) = two.split_once('*').expect("a digest");
    let second = done(body, Format::Pmks);
    assert_eq!(
        lacks(&second)[2],
        "joint D: a second input of one linkage: the first drives it"
    );
    assert_eq!(second.draft.drivers.len(), 1);
}

#[test]
fn digits_beyond_thousandths_are_read() {
    let body = link("four-bar");
    let body = &body[..body.len() - 1];
    let more = format!("{body}.PJB~0~-2.5990123,PLAB~0~1.25,PI~0~21.5,G1~e30");
    let imported = done(&checked(&more), Format::Pmks);
    assert_eq!(imported.draft.bodies["AB"]["points"]["B"][0], -2.599_012_3);
    assert_eq!(imported.draft.bodies["AB"]["mass"], 1.25);
    assert_eq!(
        imported.draft.drivers["motor"]["motion"]["velocity"],
        "-21.5 rpm"
    );
    assert_eq!(
        lacks(&imported)[1],
        "gears: all wheels and their meshes: the links that they drive are free"
    );
}

#[test]
fn every_link_makes_a_model_that_loads_and_the_same_each_time() {
    assert!(links().len() >= 35);
    for (name, link) in links() {
        let imported = done(link, Format::Pmks);
        let text = imported.draft.text();
        let loaded = linkdyn_model::load(text.as_bytes(), &[]);
        assert!(loaded.is_ok(), "{name}: {loaded:?}\n{text}");
        assert_eq!(text, done(link, Format::Pmks).draft.text(), "{name}");
    }
}

#[test]
fn a_linkage_becomes_a_model() {
    let imported = done(
        include_str!("pylinkage-stroke-engine.json"),
        Format::Pylinkage,
    );
    assert_eq!(
        imported.draft.text(),
        r#"{
  "format": "linkdyn/1",
  "name": "Simple four-stroke engine",
  "source": "pylinkage",
  "units": "SI",
  "bodies": {
    "ground": { "points": { "O": [0, 0], "O_2": [1, 0], "Slider_guide": [0, 0] } },
    "O-Crank": { "points": { "O": [0, 0], "Crank": [1, 0] } },
    "Crank-Slider": { "points": { "Crank": [0, 0], "Slider": [1.5, 0] } }
  },
  "joints": {
    "Crank": { "type": "revolute", "between": ["O-Crank.Crank", "Crank-Slider.Crank"] },
    "O": { "type": "revolute", "between": ["ground.O", "O-Crank.O"] },
    "Slider": { "type": "slot", "between": ["ground.Slider_guide", "Crank-Slider.Slider"], "axis": [1, 0] }
  },
  "drivers": {
    "motor": { "type": "rotation", "body": "O-Crank", "motion": { "type": "constant_velocity", "velocity": "0.1 rad/s" } }
  },
  "analysis": { "type": "kinematics", "end": 62.83185307179586, "outputs": 361 }
}
"#
    );
    assert_eq!(
        lacks(&imported),
        [
            "file: a unit of length: m is taken; --length mm says another",
            "joints Crank, Slider: where they are drawn: their distances differ by 1 at most, and hold",
        ]
    );
    let inches = Options {
        length: Some("in".into()),
    };
    let inches = import("", include_bytes!("mechanism-plate.json"), None, &inches).expect("read");
    assert_eq!(inches.draft.units["length"], "in");
    assert_eq!(lacks(&inches), [""; 0]);
}

#[test]
fn a_graph_and_an_arc_are_read() {
    let graph = r#"{ "name": "Graph", "nodes": [
        { "id": "A", "position": [0, 0], "role": "GROUND", "joint_type": "REVOLUTE" },
        { "id": "B", "position": [1, 0], "role": "DRIVER", "joint_type": "REVOLUTE", "angle": 0.25 },
        { "id": "C", "position": [3, 2], "role": "DRIVEN" }, { "id": "D", "position": [4, 0], "role": "GROUND" },
        { "id": "P", "position": [2, 3], "role": "DRIVEN" }],
      "edges": [ { "id": "AB", "source": "A", "target": "B", "distance": 1 }, { "id": "BC", "source": "B", "target": "C", "distance": null },
                 { "id": "CD", "source": "C", "target": "D", "distance": 2.23606797749979 } ],
      "hyperedges": [ { "id": "h", "nodes": ["B", "C", "P"], "name": "coupler" } ] }"#;
    let imported = done(graph, Format::Pylinkage);
    let bodies: Vec<&String> = imported.draft.bodies.keys().collect();
    assert_eq!(bodies, ["ground", "coupler", "AB", "CD"]);
    assert_eq!(
        imported.draft.drivers["motor"]["motion"]["velocity"],
        "0.25 rad/s"
    );
    let arc = r#"{ "name": "", "joints": [ { "id": "O", "type": "ground", "position": [0, 0] }, { "id": "A", "type": "revolute", "position": [1, 0] } ],
      "links": [ { "id": "arm", "type": "arc_driver", "joints": ["O", "A"], "angular_velocity": 0.5, "arc_start": 0, "arc_end": 2, "initial_angle": 0, "motor_joint": "O" } ] }"#;
    let imported = done(arc, Format::Pylinkage);
    assert_eq!(imported.draft.analysis["end"], 4);
    assert_eq!(
        lacks(&imported)[0],
        "link arm: that it swings back at the ends of its arc: the analysis stops at the first"
    );
}

#[test]
fn a_point_that_rides_on_two_moving_ones_has_a_link_of_its_own() {
    let file = r#"{ "joints": [
        { "type": "Static", "name": "A", "x": 0, "y": 0 }, { "type": "Static", "name": "D", "x": 4, "y": 0 },
        { "type": "Fixed", "name": "P", "x": 2, "y": 1, "joint0": { "ref": "B" }, "joint1": { "ref": "D" }, "distance": 1.4142135623730951, "angle": 0.7853981633974483 },
        { "type": "Crank", "name": "B", "x": 1, "y": 0, "joint0": { "ref": "A" }, "distance": 1, "angle": 0.1 } ] }"#;
    let imported = done(file, Format::Pylinkage);
    assert_eq!(imported.draft.joints["D"]["type"], "slot");
    assert_eq!(
        imported.draft.joints["D"]["between"].to_string(),
        r#"["BP.B","ground.D"]"#
    );
    assert_eq!(
        imported.draft.bodies["BP"].to_string(),
        r#"{"points":{"B":[1,0],"P":[2,1]}}"#
    );
}

#[test]
fn a_table_becomes_a_model() {
    let table = "body, point, x [mm], y [mm]\n# as drawn\nground,A,0,0\nground,D,120,20\nhandle,A,0,0\nhandle,B,40,30.5\nlink,B,40,30.5\nlink,C,100,55\narm,C,100,55\narm,D,120,20\narm,pad,180,20\n";
    let imported = done(table, Format::Csv);
    assert_eq!(
        imported.draft.text(),
        r#"{
  "format": "linkdyn/1",
  "name": "Points of a table",
  "source": "a table of points",
  "units": { "length": "mm" },
  "bodies": {
    "ground": { "points": { "A": [0, 0], "D": [120, 20] } },
    "handle": { "points": { "A": [0, 0], "B": [40, 30.5] } },
    "link": { "points": { "B": [40, 30.5], "C": [100, 55] } },
    "arm": { "points": { "C": [100, 55], "D": [120, 20], "pad": [180, 20] } }
  },
  "joints": {
    "A": { "type": "revolute", "between": ["ground.A", "handle.A"] },
    "D": { "type": "revolute", "between": ["ground.D", "arm.D"] },
    "B": { "type": "revolute", "between": ["handle.B", "link.B"] },
    "C": { "type": "revolute", "between": ["link.C", "arm.C"] }
  },
  "analysis": { "type": "assembly" }
}
"#
    );
    assert_eq!(lacks(&imported), [""; 0]);
    let short = "joint,x [mm],y [mm],bodies\nA,0,0,ground handle\nD,120,20,ground;arm\nB,40,30.5,handle|link\nC,100,55,link arm\npad,180,20,arm\n";
    let mut short = done(short, Format::Csv).draft;
    // The same bodies and pins, in the order of this table.
    short.bodies.sort_keys();
    let mut long = imported.draft.clone();
    long.bodies.sort_keys();
    assert_eq!(short.bodies, long.bodies);
    assert_eq!(short.joints.len(), 4);
    let apart = done(
        "body,point,x,y\nground,A,0,0\narm,A,1,0\nlink,A,1,0\n",
        Format::Csv,
    );
    assert_eq!(
        apart.draft.joints["A"]["between"].to_string(),
        r#"["arm.A","link.A"]"#
    );
    assert_eq!(
        lacks(&apart),
        [
            "line 1: a unit of length: m is taken; x [mm] in the header or --length mm says another",
            "point A: a pin between bodies where it stands at different places",
        ]
    );
}
