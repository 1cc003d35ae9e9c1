//! Links whose text is plain, of <https://pmksplus.mech.website>: `j=A,1.4,0.485,AB,R,t,0,0.1,t,%0A…&l=AB,1,1,1.535,0.7375,A%7CB,,l,…%0A…&f=…&s=10,false,false,m`
//!
//! Records are lines of fields. A joint has its name, x, y, its links, R or P, whether it is ground, the angle of its guide, friction, and
//! whether it is the input; a link its name, mass, inertia, centre of mass, joints, forces and outline; a force its name, link, start,
//! end, whether it is fixed to the ground, whether it points outward, and its magnitude. `s` is the speed, whether it is clockwise,
//! whether there is gravity, and the unit of length.

use super::drawing::{Bar, Drawing, Load, Pin, Slot, USUAL_LINEAR_SPEED, Units};
use crate::source::{LeftOut, Refused};

const MEND: &str = "the link is damaged: copy it again";

/// Reads a link.
pub(super) fn read(link: &str) -> Result<Drawing, Refused> {
    let of = |key: &str| {
        let found = link
            .split('&')
            .find_map(|part| part.strip_prefix(key)?.strip_prefix('='));
        found.unwrap_or_default()
    };
    let records = |key: &str| -> Vec<Vec<&str>> {
        let lines = of(key).lines().filter(|line| !line.is_empty());
        lines.map(|line| line.split(',').collect()).collect()
    };
    let settings: Vec<&str> = of("s").trim().split(',').collect();
    let setting = |at: usize| settings.get(at).copied().unwrap_or_default();
    let units = match setting(3) {
        "in" => Units::Inch,
        "cm" => Units::Centimetre,
        "m" => Units::Metre,
        other => {
            let cause = format!("{other:?} is no unit of length of PMKS+");
            return Err(Refused::new("s", cause, "in, cm or m"));
        }
    };
    let mut drawing = Drawing {
        units,
        has_gravity: setting(2) == "true",
        is_clockwise: setting(1) == "true",
        speed: number(&settings, 0, "s")?.abs(),
        linear_speed: USUAL_LINEAR_SPEED,
        joints: Vec::new(),
        links: Vec::new(),
        loads: Vec::new(),
        left_out: vec![LeftOut {
            place: "page".into(),
            what: "outlines of links, labels and traces".into(),
        }],
    };
    let mut friction = false;
    for (k, record) in records("j").iter().enumerate() {
        let place = format!("joint {}", k + 1);
        let slide = match at(record, 4) {
            "R" => None,
            "P" => Some(Slot {
                angle: number(record, 6, &place)?,
                turns: true,
                mass: 0.0,
                on: None,
            }),
            other => {
                let cause = format!("{other:?} is no kind of joint");
                return Err(Refused::new(place, cause, "R, a pin, or P, a slide"));
            }
        };
        friction |= slide.is_some();
        drawing.joints.push(Pin {
            id: at(record, 0).to_owned(),
            name: at(record, 0).to_owned(),
            at: [number(record, 1, &place)?, number(record, 2, &place)?],
            is_ground: at(record, 5) == "t",
            is_input: at(record, 8) == "t",
            is_welded: false,
            is_traced: false,
            speed: None,
            slide,
        });
    }
    for (k, record) in records("l").iter().enumerate() {
        let place = format!("link {}", k + 1);
        let positive = |k: usize| {
            number(record, k, &place).and_then(|value| match value >= 0.0 {
                true => Ok(value),
                false => Err(Refused::new(&place, "mass and inertia are 0 or more", MEND)),
            })
        };
        let joints = at(record, 5).split('|').filter(|name| !name.is_empty());
        drawing.links.push(Bar {
            id: at(record, 0).to_owned(),
            name: at(record, 0).to_owned(),
            mass: positive(1)?,
            inertia: positive(2)?,
            com: [number(record, 3, &place)?, number(record, 4, &place)?],
            joints: joints.map(str::to_owned).collect(),
            parts: Vec::new(),
            is_root: true,
        });
    }
    for (k, record) in records("f").iter().enumerate() {
        let place = format!("force {}", k + 1);
        let number = |k: usize| number(record, k, &place);
        drawing.loads.push(Load {
            name: at(record, 0).to_owned(),
            link: at(record, 1).to_owned(),
            from: [number(2)?, number(3)?],
            to: [number(4)?, number(5)?],
            magnitude: number(9)?,
            is_local: at(record, 6) != "t",
            is_outward: at(record, 7) == "true",
        });
    }
    if friction {
        drawing.left_out.push(LeftOut {
            place: "slides".into(),
            what: "their friction".into(),
        });
    }
    Ok(drawing)
}

fn at<'t>(record: &[&'t str], field: usize) -> &'t str {
    record.get(field).copied().unwrap_or_default()
}

fn number(record: &[&str], field: usize, place: &str) -> Result<f64, Refused> {
    let text = at(record, field);
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => {
            let cause = format!("field {}, {text:?}, is no number", field + 1);
            Err(Refused::new(place, cause, MEND))
        }
    }
}
