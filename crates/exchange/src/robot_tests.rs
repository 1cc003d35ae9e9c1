//! MJCF, URDF and SDF: what is refused, what MuJoCo says of the same files, and that export and import give the same model again.

use linkdyn_model::{Model, load};

use crate::{Format, Imported, Options, Refused, export, import};

const FOUR_BAR: &str = include_str!("../../../tests/cases/robots/four-bar.xml");
const SHAPES: &str = include_str!("../../../tests/cases/robots/shapes.xml");
const MANY_JOINTS: &str = include_str!("../../../tests/cases/robots/many-joints.xml");
const DOUBLE: &str = include_str!("../../../tests/cases/robots/double-pendulum.xml");
const FIVE_BAR: &str = include_str!("../../../tests/cases/robots/five-bar.urdf");
const SIX_BAR: &str = include_str!("../../../tests/cases/robots/six-bar.sdf");
const ALL: [(Format, &str); 6] = [
    (Format::Mjcf, FOUR_BAR),
    (Format::Mjcf, SHAPES),
    (Format::Mjcf, MANY_JOINTS),
    (Format::Mjcf, DOUBLE),
    (Format::Urdf, FIVE_BAR),
    (Format::Sdf, SIX_BAR),
];

fn read(format: Format, text: &str) -> Result<Imported, Refused> {
    import("", text.as_bytes(), Some(format), &Options::default())
}

#[track_caller]
fn imported(format: Format, text: &str) -> Imported {
    read(format, text).unwrap_or_else(|refused| panic!("{refused}\n{text}"))
}

#[track_caller]
fn model(imported: &Imported) -> Model {
    let text = imported.draft.text();
    let loaded = load(text.as_bytes(), &[]).unwrap_or_else(|said| panic!("{said:?}\n{text}"));
    loaded.model.into_model()
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    let off = (found - expected).abs();
    assert!(off <= tolerance, "{found} for {expected}: {off:e}");
}

#[test]
fn bad_files_are_refused_with_their_reason() {
    let mut lines = include_str!("refused_robots.txt").lines().skip(2);
    let mut count = 0;
    while let (Some(file), Some(message)) = (lines.next(), lines.next()) {
        let (format, text) = file.split_once(' ').expect("a format and a file");
        let format = Format::ALL.into_iter().find(|known| known.word() == format);
        let refused = read(format.expect("a format"), text).expect_err(file);
        assert_eq!(format!("  {refused}"), message, "{file}");
        count += 1;
    }
    assert!(count >= 70, "{count}");
}

#[test]
fn hostile_files_are_refused() {
    let bomb = "<!DOCTYPE m [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;\">]>";
    let outside = "<!DOCTYPE m [<!ENTITY a SYSTEM \"file:///etc/hostname\">]>";
    let many = |part: &str, count: usize| part.repeat(count);
    for (format, root) in [
        (Format::Mjcf, "mujoco"),
        (Format::Urdf, "robot"),
        (Format::Sdf, "sdf"),
    ] {
        let around = |inside: String| format!("<{root}>{inside}</{root}>");
        let nest = |tag: &str, count: usize| {
            many(&format!("<{tag}>"), count) + &many(&format!("</{tag}>"), count)
        };
        let deep = |tag: &str| around(nest(tag, 100_000));
        let files = [
            format!("{bomb}<{root}>&b;</{root}>"),
            format!("{outside}<{root}>&a;</{root}>"),
            deep("model"),
            deep("link"),
            around(format!("<worldbody>{}</worldbody>", nest("body", 100_000))),
            around(
                nest("default class=\"a\"", 1).replace("</default class=\"a\">", &deep("default")),
            ),
            around(many("<a/>", 4_000_000)),
            around(many("<link name=\"a\"/>", 900_000)),
            around(format!("<a {}/>", many("b=\">\" ", 2_000_000))),
            around(
                (0..500_000)
                    .map(|k| format!("<a{k} xmlns:a{k}='b'>"))
                    .collect(),
            ),
            many("<", 16_000_000),
            many("x", 17_000_000),
        ];
        for file in files {
            let refused = read(format, &file).expect_err("hostile");
            assert!(refused.to_string().len() < 300, "{refused}");
        }
    }
}

/// Numbers from 0 to a bound, by Marsaglia's xorshift.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % bound.max(1) as u64) as usize
    }
}

/// A file with some of its numbers changed, or of its pieces, which end at quotes, spaces and brackets.
fn mutant(text: &str, dice: &mut Dice) -> String {
    let pieces = text.split_inclusive(['"', ' ', '<', '>', '=']);
    let mut pieces: Vec<String> = pieces.map(str::to_owned).collect();
    let numbers = [
        "0", "-1", "1e15", "1e-300", "-0.0", "3.1", "90", "1e9", "nan", "inf", "1e999", "",
    ];
    let odd = [
        "",
        "\"",
        "<",
        ">",
        "/>",
        "body ",
        "world ",
        "ball\"",
        "slide\"",
        "free\"",
        "fixed\"",
        "prismatic\"",
        "true\"",
        "&amp;",
        "é ",
        "<a>",
    ];
    let only_numbers = dice.roll(3) > 0;
    for _ in 0..=dice.roll(4) {
        let (at, other) = (dice.roll(pieces.len()), dice.roll(pieces.len()));
        if only_numbers {
            let is_number = |piece: &String| {
                let bare = piece.trim_end_matches(['"', ' ', '<']);
                bare.parse::<f64>().is_ok()
            };
            let places = pieces
                .iter()
                .enumerate()
                .filter(|(_, piece)| is_number(piece));
            let places: Vec<usize> = places.map(|(place, _)| place).collect();
            let piece = &mut pieces[places[dice.roll(places.len())]];
            let end = piece.pop().unwrap_or(' ');
            *piece = format!("{}{end}", numbers[dice.roll(numbers.len())]);
            continue;
        }
        match dice.roll(5) {
            0 => pieces[at] = odd[dice.roll(odd.len())].to_owned(),
            1 => pieces[at] = pieces[other].clone(),
            2 => pieces.swap(at, other),
            3 => drop(pieces.remove(at)),
            _ => {
                let end = (at + dice.roll(40)).min(pieces.len());
                let copy = pieces[at..end].to_vec();
                pieces.splice(other..other, copy);
            }
        }
    }
    pieces.concat()
}

/// As many of each format as the variable says; by default few, which take a second.
#[test]
fn mutants_are_refused_or_are_models() {
    let count = std::env::var("LINKDYN_MUTANTS")
        .ok()
        .and_then(|count| count.parse().ok());
    let mut dice = Dice(0x2545_F491_4F6C_DD1D);
    let (mut read_count, mut written) = (0, 0);
    for (format, text) in ALL {
        for _ in 0..count.unwrap_or(300) {
            let file = mutant(text, &mut dice);
            let Ok(imported) = read(format, &file) else {
                continue;
            };
            read_count += 1;
            let text = imported.draft.text();
            let loaded = load(text.as_bytes(), &[]);
            let loaded = loaded.unwrap_or_else(|said| panic!("{said:?}\n{text}\n{file}"));
            // Whatever is a model, or refused, is written without a panic.
            written += usize::from(export::mjcf(&loaded.model, &[]).is_ok());
        }
    }
    assert!(read_count > 300 && written > 300, "{read_count} {written}");
}

/// By MuJoCo 4.0.0: mass, nᵀ J n of its inertia, centre of mass; `d` is welded to `c`.
#[test]
fn masses_are_those_of_mujoco() {
    let known = [
        (
            "a",
            54.544984694978744,
            2.5766438541490277,
            [0.4601856490501258, 0.28701511024369425],
        ),
        (
            "b",
            7.434882648869667,
            0.20548356437335047,
            [0.6553923108816885, 0.24570485023980054],
        ),
        (
            "c",
            2.0,
            0.04546295215707746,
            [0.9633313280583402, 0.04510988265647372],
        ),
        ("e", 8.377580409572783, 0.08377580409572785, [1.2, 0.0]),
    ];
    let model = model(&imported(Format::Mjcf, SHAPES));
    for (name, mass, inertia, com) in known {
        let body = &model.bodies[name];
        near(body.mass.expect("mass"), mass, 1e-13 * mass);
        near(body.inertia.expect("inertia"), inertia, 1e-13 * inertia);
        let found = body.com.expect("com");
        (0..2).for_each(|k| near(found[k], com[k], 1e-13));
    }
    // settotalmass scales all of them.
    let scaled = SHAPES.replace("angle=\"radian\"", "angle=\"radian\" settotalmass=\"10\"");
    let scaled = self::model(&imported(Format::Mjcf, &scaled));
    let total: f64 = scaled.bodies.values().filter_map(|body| body.mass).sum();
    near(total, 10.0, 1e-12);
}

/// Everything of two models that is numbers.
fn same(a: &Model, b: &Model, tolerance: f64) {
    let value = |model: &Model| {
        let mut value = serde_json::to_value(model).expect("it serialises");
        value["about"] = serde_json::Value::Null;
        value
    };
    compare("", &value(a), &value(b), tolerance);
}

fn compare(path: &str, a: &serde_json::Value, b: &serde_json::Value, tolerance: f64) {
    use serde_json::Value;
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let [a, b] = [a, b].map(|n| n.as_f64().unwrap_or(f64::NAN));
            let off = (a - b).abs();
            assert!(off <= tolerance * a.abs().max(1.0), "{path}: {a} and {b}");
        }
        (Value::Object(a), Value::Object(b)) => {
            let keys = |map: &serde_json::Map<String, Value>| {
                let mut keys: Vec<String> = map.keys().cloned().collect();
                keys.sort();
                keys
            };
            assert_eq!(keys(a), keys(b), "{path}");
            a.iter().for_each(|(key, value)| {
                compare(&format!("{path}.{key}"), value, &b[key], tolerance)
            });
        }
        (Value::Array(a), Value::Array(b)) => {
            assert_eq!(a.len(), b.len(), "{path}");
            a.iter()
                .zip(b)
                .for_each(|(a, b)| compare(path, a, b, tolerance));
        }
        (a, b) => assert_eq!(a, b, "{path}"),
    }
}

#[test]
fn what_is_exported_is_imported_again() {
    for (format, text) in ALL {
        // A body without mass would get one.
        let text = text
            .replace(
                "<joint name=\"second\" pos=\"0.3 0 0\" axis=\"0 -1 0\"/>",
                "",
            )
            .replace(" 0.3 -0.4\"", " 0.3\"");
        let first = model(&imported(format, &text));
        let checked = first.clone().check().expect("it is legal");
        let exported = export::mjcf(&checked, &[]).expect("it is written");
        assert_eq!(exported.left_out, [], "{}", exported.text);
        let second = imported(Format::Mjcf, &exported.text);
        assert_eq!(second.left_out, [], "{}", exported.text);
        same(&first, &model(&second), 1e-12);
    }
}

#[test]
fn what_is_left_out_is_listed() {
    let listed = |format: Format, text: &str| {
        let left_out = imported(format, text).left_out;
        left_out.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    let expected = [
        "line 12: <light>",
        "lines 15 … 25, 4 times: <geom>: shape and contacts, not its mass",
        "line 32, motor drive: <motor> on joint A: a program sets it; add a driver, a torque or a force",
    ];
    assert_eq!(listed(Format::Mjcf, FOUR_BAR), expected);
    let expected = [
        "line 7: <visual>",
        "line 26: effort and velocity of limits",
        "line 39, transmission t: <transmission>",
        "line 40: <material> in <gazebo>",
        "gravity: URDF has none: 9.81 m/s² along −z",
        "gravity: its part across the plane, to which no joint yields",
    ];
    assert_eq!(listed(Format::Urdf, FIVE_BAR), expected);
    let expected = [
        "gravity: none is given: 9.8 m/s² along −z, the default of SDF",
        "line 9, collision c: <collision>",
    ];
    assert_eq!(listed(Format::Sdf, SIX_BAR), expected);
}

/// All elements that close loops in URDF say the same.
#[test]
fn loops_of_urdf_close_alike() {
    let (start, end) = FIVE_BAR
        .split_once("  <gazebo>\n")
        .expect("a closing joint");
    let end = end.split_once("</gazebo>").expect("its end").1;
    let start = start.replace(
        "name=\"Five-bar\"",
        "name=\"Five-bar\" xmlns:drake=\"http://drake.mit.edu\"",
    );
    let points = "-0.0102 0.1897 0";
    // Where the tip is in both rods.
    let known = model(&imported(Format::Urdf, FIVE_BAR));
    let tip = known.bodies["right_rod"].points["tip"];
    let elbow = known.bodies["left_rod"].points["left_elbow"];
    let turned = |[x, y]: [f64; 2], angle: f64| {
        let (sin, cos) = f64::sin_cos(-angle);
        format!("{} {} 0", cos * x - sin * y, sin * x + cos * y)
    };
    let left = turned([tip[0] - elbow[0], tip[1] - elbow[1]], 0.8);
    assert_ne!(left, points);
    let right = "0.2 0.01 0.02";
    let forms = [
        format!(
            "<loop_joint name=\"tip\" type=\"revolute\"><link1 link=\"left_rod\" xyz=\"{left}\"/><link2 link=\"right_rod\" xyz=\"{right}\"/><axis xyz=\"0 0 1\"/></loop_joint>"
        ),
        format!(
            "<loop_joint name=\"tip\" type=\"spherical\"><link1 link=\"left_rod\" xyz=\"{left}\"/><link1 link=\"right_rod\" xyz=\"{right}\"/></loop_joint>"
        ),
        format!(
            "<loop name=\"tip\" type=\"continuous\"><predecessor link=\"left_rod\"><origin xyz=\"{left}\"/></predecessor><successor link=\"right_rod\"><origin xyz=\"{right}\"/></successor></loop>"
        ),
        format!(
            "<constraint name=\"tip\" type=\"revolute\"><parent link=\"left_rod\"/><parent_origin xyz=\"{left}\"/><parent_axis xyz=\"0 0 1\"/><child link=\"right_rod\"/><child_origin xyz=\"{right}\"/></constraint>"
        ),
        format!(
            "<constraint_joint name=\"tip\" type=\"position\"><parent link=\"left_rod\"/><child link=\"right_rod\"/><parent_origin xyz=\"{left}\"/><child_origin xyz=\"{right}\"/></constraint_joint>"
        ),
    ];
    for form in forms {
        same(
            &known,
            &model(&imported(Format::Urdf, &format!("{start}{form}{end}"))),
            1e-12,
        );
    }
    let ball = format!(
        "<drake:ball_constraint><drake:ball_constraint_body_A name=\"left_rod\"/><drake:ball_constraint_p_AP value=\"{left}\"/><drake:ball_constraint_body_B name=\"right_rod\"/><drake:ball_constraint_p_BQ value=\"{right}\"/></drake:ball_constraint>"
    );
    let ball = model(&imported(Format::Urdf, &format!("{start}{ball}{end}")));
    assert!(
        ball.joints.contains_key("ball_constraint"),
        "{:?}",
        ball.joints.keys()
    );
}

/// Two wheels on one carrier and the planet on an arm: ratios and signs.
#[test]
fn joints_that_follow_others_are_gears() {
    let wheels = "<mujoco><compiler angle=\"radian\"/><worldbody>
        <body name=\"a\"><joint name=\"a\" axis=\"0 -1 0\"/><geom size=\"0.1\"/></body>
        <body name=\"b\" pos=\"0.3 0 0\"><joint name=\"b\" axis=\"0 1 0\" ref=\"0.1\"/><geom size=\"0.1\"/>
          <body name=\"c\" pos=\"0.2 0 0\"><joint name=\"c\" axis=\"0 1 0\"/><geom size=\"0.1\"/></body></body>
        <body name=\"r\" pos=\"0 0 -0.1\"><joint name=\"r\" type=\"slide\" axis=\"1 0 0\"/><geom size=\"0.1\"/></body>
        </worldbody><equality>
        <joint name=\"ab\" joint1=\"b\" joint2=\"a\" polycoef=\"0 2 0 0 0\"/>
        <joint name=\"bc\" joint1=\"c\" joint2=\"b\" polycoef=\"0.5 -3 0 0 0\"/>
        <joint name=\"ar\" joint1=\"r\" joint2=\"a\" polycoef=\"0 0.1 0 0 0\"/>
        <joint name=\"cb\" joint1=\"b\" joint2=\"c\" polycoef=\"0 2 0 0 0\"/>
        <joint name=\"curve\" joint1=\"r\" joint2=\"a\" polycoef=\"0 0 1 0 0\"/>
        </equality></mujoco>";
    let found = imported(Format::Mjcf, wheels);
    let joint = |name: &str| found.draft.joints[name].to_string();
    // b turns against its axis, which is that of the plane's normal turned over.
    assert_eq!(
        joint("ab"),
        r#"{"type":"gear","between":["a.a","b.b"],"ratio":-2,"carrier":"ground"}"#
    );
    // On b the ground turns by the opposite of the angle of b.
    assert_eq!(
        joint("bc"),
        r#"{"type":"gear","between":["ground.b","c.c"],"ratio":3,"carrier":"b","angle":-0.5}"#
    );
    // On b the ground, which follows, turns as the coordinate of b, and c against its own.
    assert_eq!(
        joint("cb"),
        r#"{"type":"gear","between":["c.c","ground.b"],"ratio":-2,"carrier":"b"}"#
    );
    assert_eq!(
        joint("ar"),
        r#"{"type":"rack","between":["a.a","r.r"],"axis":[1,0],"radius":0.1}"#
    );
    let left_out = found.left_out.last().map(ToString::to_string);
    let expected = "line 11, joint curve: an equality of joints: only a linear one of two joints, each alone in its body, is a gear";
    assert_eq!(left_out.as_deref(), Some(expected));
    let urdf = FIVE_BAR.replace(
        "<origin xyz=\"0.2 0 0.05\" rpy=\"0 0 0.9\"/>",
        "<origin xyz=\"0.2 0 0.05\" rpy=\"0 0 0.9\"/><mimic joint=\"left_motor\" multiplier=\"-1.5\"/>",
    );
    let found = imported(Format::Urdf, &urdf);
    let gear = r#"{"type":"gear","between":["left_crank.left_motor","right_crank.right_motor"],"ratio":-1.5,"carrier":"ground"}"#;
    assert_eq!(found.draft.joints["right_motor_mimic"].to_string(), gear);
    let sdf = SIX_BAR.replace(
        "<parent>world</parent><child>output</child><axis><xyz>0 -1 0</xyz>",
        "<parent>world</parent><child>output</child><axis><xyz>0 -1 0</xyz><mimic joint=\"A\"><multiplier>2</multiplier></mimic>",
    );
    let found = imported(Format::Sdf, &sdf);
    let gear = r#"{"type":"gear","between":["crank.A","output.G"],"ratio":2,"carrier":"ground"}"#;
    assert_eq!(found.draft.joints["G_mimic"].to_string(), gear);
}
