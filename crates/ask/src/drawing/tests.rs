//! What is drawn is the model: read again, it has its pins, and what is drawn of one pose lies where the solver says.

use linkdyn_engine::analysis::Control;
use linkdyn_exchange::export::{Sheet, dxf, svg};
use linkdyn_exchange::{Form, Imported, Options, import};
use linkdyn_model::bundled;
use linkdyn_picture::poses::global;
use linkdyn_picture::shape::Shape;
use serde_json::Value;

use super::*;
use crate::Text;

/// Of the largest length of the mechanism: coordinates are written with thirteen digits.
const SAME: f64 = 1e-11;

fn file(bytes: Vec<u8>) -> ModelFile {
    let access = linkdyn_model::FileAccess::of(std::path::Path::new("a.json"));
    let text = Text::new("a".into(), "a".into(), bytes, access);
    ModelFile::read(text, Vec::new()).unwrap_or_else(|complaints| panic!("{complaints:?}"))
}

fn bundled_file(name: &str) -> ModelFile {
    file(
        bundled::text(name)
            .expect("bundled")
            .into_owned()
            .into_bytes(),
    )
}

fn drawn(file: &ModelFile, question: Drawing) -> Plates {
    let answer = question.answer(file, &Control::default());
    answer.unwrap_or_else(|why| panic!("{why}"))
}

fn again(text: &str, kind: &str) -> Imported {
    let name = format!("again.{kind}");
    let read = import(&name, text.as_bytes(), None, &Options::default());
    read.unwrap_or_else(|refused| panic!("{refused}"))
}

fn written(sheet: &Sheet, kind: &str) -> String {
    match kind {
        "dxf" => dxf(sheet),
        _ => svg(sheet),
    }
}

#[test]
fn linkages_that_are_drawn_and_read_have_the_same_pins() {
    for name in [
        "four-bar",
        "jansen-leg",
        "klann-leg",
        "watt-i-lock",
        "stephenson-iii",
    ] {
        let file = bundled_file(name);
        let plates = drawn(&file, Drawing::default());
        let shape = Shape::of_model(file.model());
        for kind in ["dxf", "svg"] {
            let read = again(&written(&plates.pose(), kind), kind);
            let joints = read.draft.joints.len();
            assert_eq!(joints, shape.joints.len(), "{name}.{kind}");
            for joint in &shape.joints {
                for (body, point) in joint.between {
                    let at = shape.point((body, point)).expect("a point");
                    let at = global(plates.pose[body], at).map(|x| 1e3 * x);
                    let own = &read.draft.bodies[&shape.bodies[body].name]["points"];
                    let places = own.as_object().expect("points").values();
                    let far = |place: &Value| {
                        let [x, y] = [0, 1].map(|k| place[k].as_f64().expect("a number"));
                        (x - at[0]).hypot(y - at[1])
                    };
                    let off = places.map(far).fold(f64::INFINITY, f64::min);
                    let [wide, tall] = plates.pose().size();
                    assert!(off <= SAME * 1e3 * wide.max(tall), "{name}.{kind}: {off}");
                }
            }
            // A second time nothing changes.
            let model = self::file(read.draft.text().into_bytes());
            let second = drawn(&model, Drawing::default());
            let second = again(&written(&second.pose(), kind), kind);
            let [first, second] =
                [&read, &second].map(|read| (&read.draft.bodies, &read.draft.joints));
            assert_eq!(first, second, "{name}.{kind}");
        }
    }
}

/// The crank of the four-bar turns by 10 rad/s from 60°.
#[test]
fn a_pose_is_that_of_its_time() {
    let file = bundled_file("four-bar");
    let at = Drawing {
        at: Some(0.25),
        ..Drawing::default()
    };
    let plates = drawn(&file, at);
    let angle = 60f64.to_radians() + 10.0 * 0.25;
    let sheet = plates.pose();
    let crank = sheet.layers.iter().find(|layer| layer.name == "crank");
    let off = |form: &Form| match form {
        Form::Circle { centre: [x, y], .. } => (x - 0.1 * angle.cos()).hypot(y - 0.1 * angle.sin()),
        Form::Line { .. } | Form::Point(_) | Form::Text { .. } => f64::INFINITY,
    };
    let forms = crank.expect("a layer").forms.iter();
    let nearest = forms.map(off).fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-12, "{nearest}");
}

/// A plate of 20 mm with holes of 6 mm, in its own frame.
#[test]
fn a_link_is_drawn_in_its_own_frame() {
    let file = bundled_file("four-bar");
    let question = Drawing {
        at: None,
        width: Some(0.02),
        hole: Some(0.006),
    };
    let plates = drawn(&file, question);
    let sheet = plates.link("crank").expect("a link");
    let wide = sheet.layers[0].forms.iter().flat_map(Form::places);
    let right = wide.map(|[x, _]| x).fold(f64::NEG_INFINITY, f64::max);
    assert!((right - 0.11).abs() < 1e-12, "{right}");
    let holes = sheet.layers[0]
        .forms
        .iter()
        .filter(|form| matches!(form, Form::Circle { radius, .. } if *radius == 0.003));
    assert_eq!(holes.count(), 2);
    assert!(plates.link("lever").is_none());
    let question = Drawing {
        hole: Some(0.03),
        ..question
    };
    let refused = question.answer(&file, &Control::default());
    assert_eq!(
        refused.expect_err("too large").to_string(),
        "a hole of 30 mm does not fit into a link 20 mm wide (--width wider, or --hole smaller)"
    );
}

/// A slot is as long as its pin moves: the crank of the yoke twice its radius, and a hole more.
#[test]
fn slots_are_as_long_as_their_way() {
    let file = bundled_file("scotch-yoke");
    let plates = drawn(&file, Drawing::default());
    let sheet = plates.link("yoke").expect("a link");
    let crank = &file.model().bodies["crank"].points;
    let [[x, y], [u, v]] = [crank[0], crank[1]];
    let wanted = 2.0 * (u - x).hypot(v - y) + plates.hole;
    let long = |form: &Form| {
        let places = form.places();
        let ends =
            |pick: fn(f64, f64) -> f64, start| places.iter().map(|[_, y]| *y).fold(start, pick);
        ends(f64::max, f64::NEG_INFINITY) - ends(f64::min, f64::INFINITY)
    };
    let off = |form: &Form| (long(form) - wanted).abs();
    let nearest = sheet.layers[0]
        .forms
        .iter()
        .map(off)
        .fold(f64::INFINITY, f64::min);
    // Outputs need not hit the ends of the way.
    assert!(nearest < 1e-3 * wanted, "{nearest} of {wanted}");
}
