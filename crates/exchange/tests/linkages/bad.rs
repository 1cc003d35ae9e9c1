//! What is refused, and how that is told.

use super::*;

fn told(text: &str, format: Format) -> String {
    match read(text, format) {
        Err(refused) => refused.to_string(),
        Ok(imported) => panic!("{text:?} is read:\n{}", imported.draft.text()),
    }
}

/// Each pair is a text and what is told of it.
fn all(format: Format, pairs: &[(&str, &str)]) {
    let differ = |(text, expected): &(&str, &str)| {
        let told = told(text, format);
        (told != *expected).then(|| format!("{text}\n  {told}\n  {expected}"))
    };
    let differ: Vec<String> = pairs.iter().filter_map(differ).collect();
    assert!(differ.is_empty(), "{}", differ.join("\n"));
}

#[test]
fn links() {
    let four_bar = super::link("four-bar");
    let hatch = super::link("offset-mount-hatch");
    let changed = |from: &str, to: &str| {
        let body = &four_bar[..four_bar.len() - 1];
        assert!(body.contains(from), "{from}");
        checked(&body.replacen(from, to, 1))
    };
    let plain = super::link("plain-six-bar");
    all(
        Format::Pmks,
        &[
            (
                "",
                "the link is empty (in PMKS+ choose Share, and copy the whole link)",
            ),
            (
                "https://app.pmksplus.com/",
                "nothing stands behind a ? of the link (in PMKS+ choose Share, and copy the whole link)",
            ),
            (
                "hello",
                "this is no link of PMKS+ that is known: no sections that end with a point (in PMKS+ choose Share, and copy the whole link)",
            ),
            (
                "?pmks2:00000000.e30",
                "this is a document of PMKS+'s native editor (pmks2), which is not read (share the mechanism from https://app.pmksplus.com)",
            ),
            (
                "%ff%fe",
                "character 1: the escapes of the link make no text (copy the link again)",
            ),
            (
                &four_bar[..four_bar.len() - 9],
                "the link is damaged: its length is 48 modulo 62, and it says no length (a character was lost or changed on the way: copy the link again)",
            ),
            (
                &hatch.replace("2Ce", "2Cf"),
                "the link is damaged: its digest is 3ZZMMu, and it makes 4HuUIn (a character was lost or changed on the way: copy the link again)",
            ),
            (
                &checked("2P."),
                "this is no link of PMKS+ that is known: its decimals are missing (in PMKS+ choose Share, and copy the whole link)",
            ),
            (
                &checked("2P.Fe.K,0.1011.6A,A,0,0,0"),
                "this is no link of PMKS+ that is known: its joints have no end (in PMKS+ choose Share, and copy the whole link)",
            ),
            (
                &changed(".1011.", ".7011."),
                "choices: \"7011\" names no unit of length (0 is in, 1 is cm, 2 is m)",
            ),
            (
                &changed("0mv", "0m!"),
                "joint 1: \"m!\" is no number: '!' is none of its digits (the link is damaged: copy it again)",
            ),
            (
                &changed("0mv", "0mv3456789"),
                "joint 1: \"mv3456789\" has too many digits for a number (the link is damaged: copy it again)",
            ),
            (
                &changed("6A,A,0mv,0VU,0", "6A,A,0mv"),
                "joint 1: \"6A,A,0mv\" has 3 of at least 5 fields (the link is damaged: copy it again)",
            ),
            (
                &changed("0.4D,", "0,AB,A.4D,"),
                "joint 3: a slot needs a link and two of its joints (the link is damaged: copy it again)",
            ),
            (
                &changed(".0B,", ".0A,"),
                "there are two joints \"A\" (the link is damaged: copy it again)",
            ),
            (
                &changed("YRBC,BC", "YRAB,BC"),
                "there are two links \"AB\" (the link is damaged: copy it again)",
            ),
            (
                &changed("YRBC,", "XRBC,"),
                "link 2: \"XR\" says no kind of link (the link is damaged, or newer than what is known: please report it)",
            ),
            (
                &changed("c5cae9,A,B", "c5cae9,A,Q"),
                "link AB: there is no joint \"Q\" (the link is damaged: copy it again)",
            ),
            (
                &changed("YRBC,BC,Fe", "YRBC,BC,0Fe"),
                "link 2: mass and inertia are 0 or more (the link is damaged: copy it again)",
            ),
            (
                &changed("...N_", "..2F1,XY,F1,0,0,0,1,Fe..N_"),
                "force F1: there is no link \"XY\" (the link is damaged: copy it again)",
            ),
            (
                &changed("YRBC,", "YPBC,"),
                "link BC: a block needs a pin and a sliding joint (the link is damaged: copy it again)",
            ),
            (
                &changed("...N_", "...N_.PJA~0~nan"),
                "mark \"PJA~0~nan\": this is no number (the link is damaged: copy it again)",
            ),
            (
                &plain.replace("false,m", "false,mm"),
                "s: \"mm\" is no unit of length of PMKS+ (in, cm or m)",
            ),
            (
                &plain.replace("A,1.4,", "A,inf,"),
                "joint 1: field 2, \"inf\", is no number (the link is damaged: copy it again)",
            ),
            (
                &plain.replace("AB,R,t,0,0.1,t", "AB,Q,t,0,0.1,t"),
                "joint 1: \"Q\" is no kind of joint (R, a pin, or P, a slide)",
            ),
        ],
    );
}

#[test]
fn linkages() {
    all(
        Format::Pylinkage,
        &[
            (
                "",
                "line 1, column 0: EOF while parsing a value (write the file with json.dump or mechanism_to_json)",
            ),
            (
                "{\"joints\": [NaN]}",
                "line 1, column 13: expected value (write the file with json.dump or mechanism_to_json)",
            ),
            (
                "[]",
                "this is a list, and a linkage is an object (linkage_to_dict and mechanism_to_dict write what is read)",
            ),
            (
                "{}",
                "it has neither joints nor nodes (linkage_to_dict and mechanism_to_dict write what is read)",
            ),
            (
                "{\"format\": \"linkdyn/1\"}",
                "this has the key \"format\": it is a model already (linkdyn check reads it)",
            ),
            (
                "{\"joints\": {}}",
                "joints: this is no list (a list of joints)",
            ),
            (
                "{\"joints\": [1]}",
                "joint 1: this is no object (an object with its keys)",
            ),
            (
                "{\"joints\": [{\"name\": \"A\", \"type\": \"Static\", \"x\": null, \"y\": 0}]}",
                "joint A: its x is missing (run the linkage one step before it is saved)",
            ),
            (
                "{\"joints\": [{\"name\": \"A\", \"type\": \"Gear\", \"x\": 0, \"y\": 0}]}",
                "joint A: \"Gear\" is no kind of joint (Static, Crank, Revolute, Fixed, Prismatic or Linear)",
            ),
            (
                "{\"joints\": [{\"name\": \"A\", \"type\": \"Crank\", \"x\": 0, \"y\": 0}]}",
                "joint A: its joint0 is missing (the name of a joint, {\"ref\": \"A\"})",
            ),
            (
                "{\"joints\": [{\"name\": \"A\", \"type\": \"Crank\", \"x\": 0, \"y\": 0, \"joint0\": {\"ref\": \"Q\"}}]}",
                "joint A: its joint0 is \"Q\", and there is no such joint (the name of a joint, {\"ref\": \"A\"})",
            ),
            (
                "{\"joints\": [{\"name\": \"A\", \"type\": \"Crank\", \"x\": 0, \"y\": 0, \"joint0\": {\"ref\": \"B\"}}, {\"name\": \"B\", \"type\": \"Crank\", \"x\": 0, \"y\": 0, \"joint0\": {\"ref\": \"A\"}}]}",
                "joint A: it hangs on joints that hang on it (joint0 and joint1 are joints that are solved before it)",
            ),
            (
                "{\"nodes\": [{\"id\": \"A\"}], \"edges\": []}",
                "this is a topology without dimensions (write the mechanism with mechanism_to_json, which has the places of the joints)",
            ),
            (
                "{\"joints\": [{\"id\": \"A\", \"position\": [0]}], \"links\": []}",
                "joint A: its position is no pair of numbers ([x, y])",
            ),
            (
                "{\"joints\": [{\"id\": \"A\", \"position\": [0, 0]}], \"links\": [{\"id\": \"l\", \"joints\": [\"Q\"]}]}",
                "link l: there is no joint \"Q\" (the id of a joint of the file)",
            ),
            (
                "{\"joints\": [{\"id\": \"A\", \"position\": [0, 0]}, {\"id\": \"A\", \"position\": [0, 0]}], \"links\": []}",
                "there are two joints \"A\" (give each joint its own name)",
            ),
        ],
    );
}

#[test]
fn tables() {
    all(
        Format::Csv,
        &[
            (
                "",
                "line 1: \"\" is no header of a table of points (body,point,x [mm],y [mm] or joint,x [mm],y [mm],bodies)",
            ),
            (
                "a,b,c\n",
                "line 1: \"a,b,c\" is no header of a table of points (body,point,x [mm],y [mm] or joint,x [mm],y [mm],bodies)",
            ),
            ("body,point,x,y\n", "the table has no rows (crank,A,30,40)"),
            (
                "body,point,x [mm],y [m]\n",
                "line 1: x and y have different units (body,point,x [mm],y [mm])",
            ),
            (
                "body,point,x [kg],y [kg]\n",
                "line 1: \"kg\" is no unit of length (mm, cm, m, in, ft or another that linkdyn docs format lists)",
            ),
            (
                "body,point,x,y\ncrank,A,1\n",
                "line 2: this row has 3 cells, and the header 4 (separate cells by commas, and give each row all of them)",
            ),
            (
                "body,point,x,y\ncrank,A,1,1e999\n",
                "line 2: \"1e999\" is no number (write coordinates as plain numbers, such as 12.5)",
            ),
            (
                "body,point,x,y\n,A,1,1\n",
                "line 2: a row needs the name of a point and of a body (crank,A,30,40)",
            ),
            (
                "body,point,x,y\ncrank,A,1,1\ncrank,A,2,1\n",
                "line 3: crank has two points \"A\" (give each point of a body its own name)",
            ),
        ],
    );
}

#[test]
fn sizes_and_units() {
    let of = |text: &[u8], length: Option<&str>| {
        let options = Options {
            length: length.map(str::to_owned),
        };
        import("t.csv", text, None, &options)
            .expect_err("refused")
            .to_string()
    };
    let bodies = |k: usize| format!("b{k},P,{k},0\n");
    let many = format!(
        "body,point,x,y\n{}",
        (0..2001).map(bodies).collect::<String>()
    );
    assert_eq!(
        of(many.as_bytes(), None),
        "2001 bodies or joints are too many for a planar linkage (2000 at most)"
    );
    let nothing = of(b"{\"joints\": []}", None);
    assert_eq!(nothing, "nothing is drawn in it (draw a body first)");
    let rows = format!(
        "body,point,x,y\n{}",
        (0..10_001)
            .map(|k| format!("b,P{k},{k},0\n"))
            .collect::<String>()
    );
    assert_eq!(
        of(rows.as_bytes(), None),
        "more than 10000 rows are too many for a linkage (points that nothing joins can go)"
    );
    assert_eq!(
        of(b"body,point,x,y\n\xff,P,0,0\n", None),
        "byte 15: this is no UTF-8 text (save it as UTF-8)"
    );
    assert_eq!(
        of(b"body,point,x,y\n", Some("furlong")),
        "--length: \"furlong\" is no unit of length (mm, cm, m, in, ft or another that linkdyn docs format lists)"
    );
}
