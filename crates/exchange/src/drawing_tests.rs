//! Sketches as people draw them, files that are none, and files that were damaged.

use std::collections::BTreeMap;

use crate::export::{Layer, Sheet, around, dxf, svg};
use crate::{Form, Format, Imported, Options, Refused, import};

/// A DXF of entities, each as `KIND code value code value`; `unit` is that of `$INSUNITS`.
fn drawing(unit: &str, entities: &[&str]) -> String {
    let mut text = format!("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n");
    text.push_str("0\nSECTION\n2\nENTITIES\n");
    for entity in entities {
        text.push_str("0\n");
        entity.split(' ').for_each(|word| {
            text.push_str(word);
            text.push('\n');
        });
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

fn read(text: &str, format: Format) -> Result<Imported, Refused> {
    let imported = import("a.dxf", text.as_bytes(), Some(format), &Options::default())?;
    let text = imported.draft.text();
    if let Err(complaints) = linkdyn_model::load(text.as_bytes(), &[]) {
        panic!("{complaints:?}\n{text}");
    }
    Ok(imported)
}

fn of_dxf(entities: &[&str]) -> Imported {
    read(&drawing("4", entities), Format::Dxf).unwrap_or_else(|refused| panic!("{refused}"))
}

fn of_svg(inside: &str) -> Imported {
    let text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
         width=\"100mm\" height=\"100mm\" viewBox=\"0 0 100 100\">\n{inside}\n</svg>"
    );
    read(&text, Format::Svg).unwrap_or_else(|refused| panic!("{refused}"))
}

/// Bodies and joints, short.
fn told(imported: &Imported) -> String {
    let mut told = String::new();
    for (name, body) in &imported.draft.bodies {
        told.push_str(&format!("{name} {}\n", body["points"]));
    }
    for (name, joint) in &imported.draft.joints {
        told.push_str(&format!("{name} {}\n", joint["between"]));
    }
    told
}

fn left(imported: &Imported) -> Vec<String> {
    imported.left_out.iter().map(ToString::to_string).collect()
}

const FOUR_BAR: [&str; 7] = [
    "LINE 8 crank 10 0 20 0 11 0 21 50",
    "LINE 8 coupler 10 0 20 50 11 200 21 90",
    "LINE 8 rocker 10 200 20 90 11 200 21 0",
    "CIRCLE 8 Ground 10 0 20 0 40 3",
    "CIRCLE 8 pins 10 0 20 50 40 3",
    "CIRCLE 8 pins 10 200 20 90 40 3",
    "POINT 8 ground 10 200 20 0",
];

const FOUR_BAR_TOLD: &str = "ground {\"A\":[0,0],\"D\":[200,0]}
crank {\"A\":[0,0],\"B\":[0,50]}
coupler {\"B\":[0,50],\"C\":[200,90]}
rocker {\"C\":[200,90],\"D\":[200,0]}
A [\"ground.A\",\"crank.A\"]
B [\"crank.B\",\"coupler.B\"]
C [\"coupler.C\",\"rocker.C\"]
D [\"ground.D\",\"rocker.D\"]
";

/// The four-bar with other names of its pins.
fn renamed(names: [(&str, &str); 3]) -> String {
    let mut told = String::new();
    for line in FOUR_BAR_TOLD.lines() {
        let mut line = line.to_owned();
        // Through signs that no name has, so that no name is changed twice.
        for (k, (from, _)) in names.iter().enumerate() {
            line = line.replace(&format!("\"{from}\""), &format!("\"{k}\u{1}\""));
            line = line.replace(&format!(".{from}\""), &format!(".{k}\u{1}\""));
            if let Some(rest) = line.strip_prefix(&format!("{from} [")) {
                line = format!("{k}\u{1} [{rest}");
            }
        }
        for (k, (_, to)) in names.iter().enumerate() {
            line = line.replace(&format!("{k}\u{1}"), to);
        }
        told.push_str(&line);
        told.push('\n');
    }
    told
}

/// Lines, and the points of each body, by their names.
fn sorted(text: &str) -> Vec<String> {
    let by_name = |line: &str| match line.split_once(" {") {
        None => line.to_owned(),
        Some((body, points)) => {
            let points = serde_json::from_str(&format!("{{{points}"));
            let points: BTreeMap<String, [f64; 2]> = points.expect("points");
            format!("{body} {points:?}")
        }
    };
    let mut lines: Vec<String> = text.lines().map(by_name).collect();
    lines.sort();
    lines
}

#[test]
fn layers_are_links() {
    let read = of_dxf(&FOUR_BAR);
    assert_eq!(told(&read), FOUR_BAR_TOLD);
    assert_eq!(left(&read), Vec::<String>::new());
    assert!(read.draft.drivers.contains_key("motor"));
}

/// On one layer each line is a link, a polyline is parted at its pins, and a filled triangle is the ground.
#[test]
fn a_single_layer_has_a_link_a_line() {
    let read = of_dxf(&[
        "LWPOLYLINE 8 0 90 4 70 0 10 0 20 0 10 0 20 50 10 200 20 90 10 200 20 0",
        "CIRCLE 8 0 10 0 20 0 40 3",
        "CIRCLE 8 0 10 0 20 50 40 3",
        "CIRCLE 8 0 10 200 20 90 40 3",
        "CIRCLE 8 0 10 200 20 0 40 3",
        "SOLID 8 0 10 0 20 0 11 -5 21 -8 12 5 22 -8 13 5 23 -8",
        "SOLID 8 0 10 200 20 0 11 195 21 -8 12 205 22 -8 13 205 23 -8",
        "TEXT 8 0 10 4 20 4 40 5 1 driver",
        "TEXT 8 0 10 204 20 94 40 5 1 knee",
    ]);
    let wanted = "ground {\"A\":[0,0],\"C\":[200,0]}
link {\"A\":[0,0],\"B\":[0,50]}
link_2 {\"B\":[0,50],\"knee\":[200,90]}
link_3 {\"knee\":[200,90],\"C\":[200,0]}
A [\"ground.A\",\"link.A\"]
B [\"link.B\",\"link_2.B\"]
knee [\"link_2.knee\",\"link_3.knee\"]
C [\"ground.C\",\"link_3.C\"]
";
    assert_eq!(told(&read), wanted);
    assert_eq!(read.draft.drivers["motor"]["body"], "link");
}

/// A circle on two straights that cross joins them; one where two ends meet already leaves a third straight alone, as at a dead centre.
#[test]
fn pins_may_be_in_the_middle_of_bars() {
    let read = of_dxf(&[
        "LINE 8 0 10 0 20 0 11 100 21 100",
        "LINE 8 0 10 0 20 100 11 100 21 0",
        "CIRCLE 8 0 10 50 20 50 40 3",
        "CIRCLE 8 ground 10 0 20 0 40 3",
        "LINE 8 0 10 0 20 100 11 -50 21 100",
        "LINE 8 0 10 -60 20 100 11 20 21 100",
        "CIRCLE 8 0 10 0 20 100 40 3",
        "CIRCLE 8 0 10 -50 20 100 40 3",
    ]);
    let wanted = "ground {\"B\":[0,0]}
link {\"A\":[50,50],\"B\":[0,0],\"E\":[100,100]}
link_2 {\"A\":[50,50],\"C\":[0,100],\"F\":[100,0]}
link_3 {\"C\":[0,100],\"D\":[-50,100]}
link_4 {\"D\":[-50,100],\"G\":[-60,100],\"H\":[20,100]}
A [\"link.A\",\"link_2.A\"]
B [\"ground.B\",\"link.B\"]
C [\"link_2.C\",\"link_3.C\"]
D [\"link_3.D\",\"link_4.D\"]
";
    assert_eq!(told(&read), wanted);
}

#[test]
fn what_was_moved_or_is_missing_is_said() {
    let read = of_dxf(&[
        "LINE 8 arm 10 0.5 20 0 11 100 21 0",
        "LINE 8 rod 10 100 20 0 11 200 21 50",
        "LINE 8 other 10 200 20 50 11 300 21 50",
        "LINE 8 frame 10 0 20 -90 11 300 21 -90",
        "CIRCLE 8 pins 10 0 20 0 40 3",
        "CIRCLE 8 pins 10 100 20 0 40 3",
        "CIRCLE 8 pins 10 150 20 -50 40 3",
        "POINT 8 fixed 10 0 20 0",
        "HATCH 8 arm",
        "HATCH 8 arm",
        "TEXT 8 arm 10 250 20 -60 40 5 1 title",
    ]);
    let wanted = [
        "line 15: its end is 0.5 mm from the centre of a circle: moved there",
        "line 109: the text \"title\" is next to no pin",
        "line 39: what is drawn on \"other\" is joined to nothing",
        "line 51: what is drawn on \"frame\" is joined to nothing",
        "line 83: a circle at no end, line or outline of a link",
        "drivers: none: no layer and no text is called crank, driver or input; the mobility by counting is 2 (so many \"drivers\" make it move)",
        "line 101: not read: \"HATCH\" (and 1 more)",
    ];
    assert_eq!(left(&read), wanted);
    assert_eq!(read.draft.points, ["rod.C"]);
}

/// Blocks in blocks, turned, scaled, mirrored; the plane from behind.
#[test]
fn blocks_are_put_in() {
    let mut text = drawing("5", &FOUR_BAR[..3]);
    let blocks = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nPIN\n10\n1\n20\n1\n0\nCIRCLE\n8\n0\n10\n1\n20\n1\n40\n2\n0\nENDBLK\n\
                  0\nBLOCK\n2\nTWO\n10\n0\n20\n0\n0\nINSERT\n2\nPIN\n8\n0\n10\n0\n20\n0\n0\nINSERT\n2\nPIN\n8\n0\n10\n100\n20\n0\n0\nENDBLK\n0\nENDSEC\n";
    text = text.replace(
        "0\nSECTION\n2\nENTITIES\n",
        &format!("{blocks}0\nSECTION\n2\nENTITIES\n"),
    );
    // (0, 0) and (100, 0) by 2, mirrored in x, by -90°: (0, 0) and (0, 200), then moved.
    let inserts = "0\nINSERT\n8\nground\n2\nTWO\n10\n0\n20\n0\n41\n2\n42\n2\n0\nINSERT\n8\npins\n2\nPIN\n10\n0\n20\n50\n\
                   0\nINSERT\n8\npins\n2\nTWO\n10\n-200\n20\n90\n41\n4\n42\n4\n230\n-1\n";
    text = text.replace("0\nENDSEC\n0\nEOF", &format!("{inserts}0\nENDSEC\n0\nEOF"));
    let read = read(&text, Format::Dxf).unwrap_or_else(|refused| panic!("{refused}"));
    let wanted = renamed([("B", "C"), ("C", "D"), ("D", "B")]);
    assert_eq!(sorted(&told(&read)), sorted(&wanted), "{:?}", left(&read));
    assert_eq!(read.draft.units["length"], "cm");
}

/// As Inkscape writes it: layers with labels, transforms of groups, circles as paths, `use`, styles.
#[test]
fn an_svg_of_inkscape_is_read() {
    let read = of_svg(
        "<defs><circle id=\"hole\" r=\"2\"/></defs>
<g inkscape:label=\"ground\" inkscape:groupmode=\"layer\" id=\"layer1\"><use href=\"#hole\"/><use href=\"#hole\" x=\"200\"/></g>
<g transform=\"translate(10 0) scale(2)\">
<g inkscape:label=\"crank\" transform=\"translate(-5)\"><path d=\"m 0,0 v -25\" style=\"stroke:#ff0000;fill:none\"/></g>
<g inkscape:label=\"coupler\" transform=\"matrix(0.5 0 0 0.5 -5 0)\"><line y1=\"-50\" x2=\"200\" y2=\"-90\"/></g>
<g inkscape:label=\"rocker\"><polyline points=\"95,-45 95,0\"/></g></g>
<g inkscape:label=\"Pins\"><path d=\"M 2,-50 A 2 2 0 0 1 -2,-50 A 2 2 0 0 1 2,-50 Z\"/>
<circle cx=\"-90\" cy=\"-200\" r=\"2\" transform=\"rotate(90)\"/></g>
<g style=\"display:none\"><path d=\"M0 0L9 9\"/></g><text x=\"3\" y=\"-52\" font-size=\"6px\"><tspan>knee</tspan></text>",
    );
    assert_eq!(
        sorted(&told(&read)),
        sorted(&renamed([("B", "knee"), ("D", "B"), ("C", "C")]))
    );
    assert_eq!(left(&read), ["line 10: not read: hidden"]);
}

/// Without groups the colours are links; without a size a unit is a pixel.
#[test]
fn colours_are_links_too() {
    let text = "<svg xmlns=\"http://www.w3.org/2000/svg\">
<path d=\"M0 0L96 0\" stroke=\"#F00\"/><path d=\"M96 0L192 0\" style=\"stroke: blue\"/>
<circle cx=\"0\" cy=\"0\" r=\"3\" id=\"ground\"/><circle cx=\"96\" cy=\"0\" r=\"3\"/></svg>";
    let read = read(text, Format::Svg).unwrap_or_else(|refused| panic!("{refused}"));
    let wanted = "ground {\"A\":[0,0]}
ff0000 {\"A\":[0,0],\"B\":[25.4,0]}
blue {\"B\":[25.4,0],\"C\":[50.8,0]}
A [\"ground.A\",\"ff0000.A\"]
B [\"ff0000.B\",\"blue.B\"]
";
    assert_eq!(told(&read), wanted);
    let said = left(&read);
    assert_eq!(
        said[0],
        "line 1: the drawing has no size: its unit is taken as 1/96 in (--length says another)"
    );
}

/// What is refused, and how.
#[test]
fn bad_files_are_refused_with_a_mend() {
    let dxf = |entities: &[&str]| drawing("4", entities);
    let svg = |inside: &str| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9mm\" viewBox=\"0 0 9 9\">{inside}</svg>"
        )
    };
    let far = "a finite number within 1e12";
    let deep = |open: &str, close: &str| svg(&format!("{}{}", open.repeat(300), close.repeat(300)));
    let cases: Vec<(String, Format, String)> = vec![
        ("".into(), Format::Dxf, "there are no entities, and no EOF at its end (save it as DXF in ASCII, as R2000 or R12)".into()),
        ("AC1015\0\0".into(), Format::Dxf, "this is a DWG (save it as DXF in ASCII, as R2000 or R12)".into()),
        ("AutoCAD Binary DXF\r\n".into(), Format::Dxf, "this is a binary DXF (save it as DXF in ASCII, as R2000 or R12)".into()),
        ("0\nSECTION\nhello\nENTITIES".into(), Format::Dxf, "line 3: \"hello\" is no group code (a DXF has a whole number and its value on lines of their own, by turns)".into()),
        (dxf(&["LINE 8 a 10 0 20 0 11 nan 21 0"]), Format::Dxf, format!("line 24: \"nan\" is no number of a drawing ({far})")),
        (dxf(&["LINE 8 a 10 0 20 0 11 1e400 21 0"]), Format::Dxf, format!("line 24: \"1e400\" is no number of a drawing ({far})")),
        (dxf(&["LINE 8 a 10 0 20 0 11 zero 21 0"]), Format::Dxf, format!("line 24: \"zero\" is no number of a drawing ({far})")),
        (dxf(&["LINE 8 a 10 0 20 0"]), Format::Dxf, "line 15: this \"LINE\" has no place (groups 11 and 21) (open and save it with a CAD program)".into()),
        (dxf(&["CIRCLE 8 a 10 0 20 0 40 -1"]), Format::Dxf, "line 15: this \"CIRCLE\" has no radius above 0 (group 40) (open and save it with a CAD program)".into()),
        (dxf(&[]), Format::Dxf, "there are no lines and no circles in it (lines are bars, circles their pins: linkdyn docs exchange)".into()),
        (dxf(&["POINT 8 a 10 0 20 0"]), Format::Dxf, "all of it lies at one place (lines are bars, circles their pins: linkdyn docs exchange)".into()),
        (dxf(&["LINE 8 a 10 0 20 0 11 9 21 0"]), Format::Dxf, "no circle and no common end joins two links (draw bars as lines, a circle where they turn on each other, and what stands still on a layer \"ground\")".into()),
        (dxf(&vec!["LINE 8 a 10 0 20 0 11 9 21 0"; 4001]), Format::Dxf, "4001 lines, circles and points are too many for a linkage (4000 at most)".into()),
        (dxf(&[&format!("LWPOLYLINE 8 a{}", " 10 1 20 2 10 3 20 4".repeat(2001))]), Format::Dxf, "4002 ends and corners of bars are too many for a linkage (4000 at most)".into()),
        (dxf(&[&format!("LWPOLYLINE 8 a{}", " 10 1 20 2".repeat(50001))]), Format::Dxf, "there are too many entities for a linkage (50000 lines, corners and circles at most)".into()),
        ("hello".into(), Format::Svg, "line 1: this is no XML: unknown token (mend it there)".into()),
        ("<html/>".into(), Format::Svg, "line 1: the first element is <html>, not <svg> (--from says what a file is: mjcf, urdf, sdf)".into()),
        ("<!DOCTYPE svg [<!ENTITY a \"b\">]><svg/>".into(), Format::Svg, "it declares a document type or entities, which are not read (remove <!DOCTYPE …>, and write entities out)".into()),
        ("<!DOCTYPE svg SYSTEM \"file:///etc/passwd\"><svg/>".into(), Format::Svg, "it declares a document type or entities, which are not read (remove <!DOCTYPE …>, and write entities out)".into()),
        (svg("<line x2=\"two\"/>"), Format::Svg, "line 1: x2 \"two\" is no length (a number, with mm, cm, in, px, pt, pc or nothing behind it)".into()),
        (svg("<path d=\"M 0 0 L 5\"/>"), Format::Svg, "line 1: path \"M 0 0 L 5\" can't be read to its end (draw it anew)".into()),
        (svg("<path d=\"M 0 0 a 9e99 9e99 0 0 0 1 1\"/>"), Format::Svg, "line 1: path \"M 0 0 a 9e99 9e99 0 0 0 1 1\" has too large numbers (1e9 at most)".into()),
        (svg("<g transform=\"turn(3)\"/>"), Format::Svg, "line 1: transform \"turn(3)\" can't be read (translate, rotate, scale, skewX, skewY and matrix, with numbers)".into()),
        (svg("<line x2=\"1e300\"/>"), Format::Svg, "line 1: this lies farther away than a drawing reaches (coordinates within 1e12)".into()),
        ("<svg viewBox=\"0 0 9\" width=\"9\"/>".into(), Format::Svg, "line 1: viewBox \"0 0 9\" can't be read (four numbers: left, top, width and height above 0)".into()),
        (deep("<g>", "</g>"), Format::Svg, "line 1: elements lie deeper than 200 in each other (ungroup some, and look for a use of itself)".into()),
        (svg("<g id=\"a\"><use href=\"#a\"/></g>"), Format::Svg, "line 1: elements lie deeper than 200 in each other (ungroup some, and look for a use of itself)".into()),
        (svg("<g id=\"a\"><use href=\"#b\"/><use href=\"#b\"/></g><g id=\"b\"><use href=\"#a\"/><use href=\"#a\"/></g>"), Format::Svg, "line 1: elements lie deeper than 200 in each other (ungroup some, and look for a use of itself)".into()),
        (svg(&"<g/>".repeat(50_001)), Format::Svg, "line 1: this is too much for a linkage (50000 elements and corners at most, with all that is used again)".into()),
    ];
    for (text, format, wanted) in cases {
        let start: String = text.chars().take(200).collect();
        match read(&text, format) {
            Err(refused) => assert_eq!(refused.to_string(), wanted, "{start}"),
            Ok(read) => panic!("{start}: {}", told(&read)),
        }
    }
    let large = vec![b' '; crate::LONGEST + 1];
    let refused = import("a.svg", &large, Some(Format::Svg), &Options::default());
    let wanted = "16777217 bytes are too many for a mechanism (16777216 at most)";
    assert_eq!(refused.expect_err("too long").to_string(), wanted);
    let options = Options {
        length: Some("kg".into()),
    };
    let refused = import("a.dxf", dxf(&FOUR_BAR).as_bytes(), None, &options);
    let wanted = "--length: \"kg\" is no unit of length (mm, cm, m, in, ft or another that linkdyn docs format lists)";
    assert_eq!(refused.expect_err("no length").to_string(), wanted);
}

/// Blocks that are fifty times in each other end soon, be they deep or not.
#[test]
fn bombs_of_blocks_are_refused() {
    let cases = [
        (
            12,
            "line 2883: the block \"B8\" lies deeper than 8 blocks (explode the blocks)",
        ),
        (
            6,
            "there are too many entities for a linkage (50000 lines, corners and circles at most)",
        ),
    ];
    for (levels, wanted) in cases {
        let mut text = String::from("0\nSECTION\n2\nBLOCKS\n");
        for level in 0..levels {
            text.push_str(&format!("0\nBLOCK\n2\nB{level}\n10\n0\n20\n0\n"));
            let insert = format!("0\nINSERT\n2\nB{}\n10\n0\n20\n0\n", level + 1);
            text.push_str(&insert.repeat(50));
            text.push_str("0\nENDBLK\n");
        }
        let insert = "0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nB0\n10\n0\n20\n0\n0\nENDSEC\n0\nEOF\n";
        text.push_str(&format!(
            "0\nBLOCK\n2\nB{levels}\n0\nENDBLK\n0\nENDSEC\n{insert}"
        ));
        let refused = read(&text, Format::Dxf).expect_err("a bomb").to_string();
        assert_eq!(refused, wanted);
    }
}

fn sheet() -> Sheet {
    let bar = |name: &str, from: [f64; 2], to: [f64; 2]| Layer {
        name: name.into(),
        colour: [0, 90, 180],
        forms: vec![
            around(&[from, to], 0.01),
            Form::Circle {
                centre: from,
                radius: 0.003,
            },
            Form::Circle {
                centre: to,
                radius: 0.003,
            },
        ],
    };
    let ground = Layer {
        name: "ground".into(),
        colour: [0; 3],
        forms: [[0.0, 0.0], [0.2, 0.0]]
            .map(|centre| Form::Circle {
                centre,
                radius: 0.003,
            })
            .into(),
    };
    Sheet {
        title: "four <bars> & «more»".into(),
        layers: vec![
            ground,
            bar("crank", [0.0, 0.0], [0.0, 0.05]),
            bar("coupler", [0.0, 0.05], [0.2, 0.09]),
            bar("rocker", [0.2, 0.09], [0.2, 0.0]),
        ],
    }
}

/// What is written is read as what it was.
#[test]
fn written_drawings_are_read_again() {
    for (text, format) in [(dxf(&sheet()), Format::Dxf), (svg(&sheet()), Format::Svg)] {
        let read = read(&text, format).unwrap_or_else(|refused| panic!("{refused}"));
        let wanted = renamed([("B", "C"), ("C", "D"), ("D", "B")]);
        assert_eq!(sorted(&told(&read)), sorted(&wanted));
        assert_eq!(
            left(&read),
            [
                "outlines: 3: a link has points and no shape of its own; mass and inertia are not computed"
            ]
        );
    }
}

/// Ten thousand damaged files of each format are read or refused, and what is read is a model.
#[test]
fn damaged_files_are_read_or_refused() {
    let files = [
        (drawing("4", &FOUR_BAR), Format::Dxf, 5_000),
        (dxf(&sheet()), Format::Dxf, 5_000),
        (svg(&sheet()), Format::Svg, 10_000),
    ];
    let mut state = 1_u64;
    let mut random = move |below: usize| {
        // Knuth's linear congruential generator of 64 bits.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let pieces = [
        "0", "\n", "9e99", "-", "nan", "<", "\"", " ", "</g>", "1e-300", "LINE", "10", "\u{e9}",
        ".",
    ];
    let (mut sound, mut bad) = (0, 0);
    for (text, format, count) in files {
        for _ in 0..count {
            let mut mutant = text.clone();
            for _ in 0..=random(4) {
                let floor = |text: &str, at: usize| {
                    (0..=at)
                        .rev()
                        .find(|at| text.is_char_boundary(*at))
                        .unwrap_or(0)
                };
                let from = floor(&mutant, random(mutant.len().max(1)));
                let to = floor(&mutant, (from + random(12)).min(mutant.len()));
                let piece = pieces[random(pieces.len())];
                match random(8) {
                    0 => mutant.truncate(from),
                    1 => {
                        let copied = mutant[from.min(to)..to].repeat(3);
                        mutant.insert_str(from, &copied);
                    }
                    _ => mutant.replace_range(from.min(to)..to, piece),
                }
            }
            match read(&mutant, format) {
                Ok(_) => sound += 1,
                Err(_) => bad += 1,
            }
        }
    }
    assert!(sound > 500 && bad > 500, "{sound} sound, {bad} refused");
}
