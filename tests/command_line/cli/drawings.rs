//! Drawings to scale: what is written, and what is refused.

use super::{Scratch, done, linkdyn, refused};
use std::fs;

#[test]
fn a_pose_a_link_and_all_links_are_drawn() {
    let scratch = Scratch::new("drawings");
    let file = scratch.path("pose.dxf");
    let said = done(&["export", "four-bar", "--dxf", "--at", "0.5 s", "-o", &file]);
    assert!(
        said.contains("pose.dxf: 5 layers, ") && said.ends_with("links 20 mm wide, holes 6 mm\n"),
        "{said}"
    );
    let model = scratch.path("again.json");
    let read = linkdyn(&["import", &scratch.write("a.svg", SKETCH), "-o", &model]);
    let said = "left out: drivers: the mobility by counting is 2, and one link is driven: linkdyn check tells what is missing or too much\n";
    assert_eq!(
        (read.status, read.stderr.as_str()),
        (Some(0), said),
        "{read:?}"
    );
    let folder = scratch.path("plates");
    done(&[
        "export",
        &model,
        "--svg",
        "--each-link",
        "--width",
        "1cm",
        "-o",
        &folder,
    ]);
    let mut names: Vec<String> = fs::read_dir(&folder)
        .expect("a folder")
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    assert_eq!(names, ["arm.svg", "crank.svg", "ground.svg"]);
    let link = fs::read_to_string(scratch.path("plates/crank.svg")).expect("written");
    // Half of the 40 mm, and a radius of 5.
    assert!(link.contains("A5 5 0 0 0 "), "{link}");
    let one = scratch.path("one.svg");
    done(&[
        "export", &model, "--svg", "--link", "crank", "--width", "10", "-o", &one,
    ]);
    assert_eq!(fs::read_to_string(one).expect("written"), link);
}

const SKETCH: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="50mm" viewBox="0 0 90 50">
<g id="ground"><circle r="3"/></g><g id="crank"><path d="M0 0H40"/></g><g id="arm"><path d="M40 0L80 40"/></g>
<circle cx="40" r="3"/></svg>"#;

#[test]
fn drawings_that_can_not_be_are_refused() {
    let scratch = Scratch::new("no-drawings");
    let file = scratch.path("a.dxf");
    let cases: [(&[&str], &str); 7] = [
        (&["--svg"], "a.dxf: the name of the file must end in .svg"),
        (
            &["--dxf", "--link", "crnk"],
            "--link crnk: there is no such body to draw (did you mean \"crank\"?)",
        ),
        (
            &["--dxf", "--width", "5mm", "--hole", "6mm"],
            "a hole of 6 mm does not fit into a link 5 mm wide (--width wider, or --hole smaller)",
        ),
        (
            &["--dxf", "--width", "5 kg"],
            "invalid value '5 kg' for '--width <LENGTH>': such as 20mm, of 1e3 m at most",
        ),
        (
            &["--dxf", "--hole", "0"],
            "invalid value '0' for '--hole <LENGTH>': above 0.001 mm",
        ),
        (
            &["--dxf", "--at", "soon"],
            "invalid value 'soon' for '--at <TIME>': such as 20s, of 1e9 s at most",
        ),
        (
            &["--dxf", "--at", "1", "--link", "crank"],
            "the argument '--at <TIME>' cannot be used with '--link <BODY>'",
        ),
    ];
    for (arguments, said) in cases {
        let all = [&["export", "four-bar", "-o", &file], arguments].concat();
        refused(&all, 2, said);
    }
    let model = scratch.write(
        "bare.json",
        r#"{ "format": "linkdyn/1", "units": "SI", "bodies": { "a": {} }, "joints": {} }"#,
    );
    let said = "there is nothing to draw: no body has points (give them \"points\")";
    refused(&["export", &model, "--dxf", "-o", &file], 2, said);
    let said = "neither its name nor its first characters say what it is";
    refused(&["import", &scratch.write("sketch", "0\nSECTION")], 2, said);
}
