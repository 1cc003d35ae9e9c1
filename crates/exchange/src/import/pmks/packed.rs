//! Links whose numbers are thousandths in digits of base 64: `2P.Ay,1E8.K,0.1011.6A,A,0mv,0VU,0. … ..YRAB,AB,Fe,Fe,0ix,08i,c5cae9,A,B,, … ...N_v`
//!
//! Sections end with a point, lists with an empty one: flags, decimals, integers and choices of the page; joints; links; forces; what
//! is selected; marks. The last character is the length modulo 62. Newer links end with `*` and a digest (FNV-1a, 32 bits).
//!
//! A slide was three things first: a pin, a sliding joint at the same place and a block of no size between both. It is one joint
//! since, with the mass of its block at the end; here the three become the one.

use std::collections::HashMap;

use super::super::pins::At;
use super::drawing::{Bar, Drawing, Load, Pin, Slot, USUAL_LINEAR_SPEED, Units};
use crate::source::{LeftOut, MOST_PARTS, Refused};

const DIGITS: &str = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-";
/// The digits of lengths and digests.
const CHECKS: usize = 62;
/// Thousandths of more digits are no numbers that a drawing has, and would be rounded.
const LONGEST_NUMBER: usize = 8;

const DAMAGED: &str = "the link is damaged: copy it again";

/// Reads a link.
pub(super) fn read(link: &str) -> Result<Drawing, Refused> {
    let body = intact(link)?;
    let mut sections = body.split('.');
    let mut next = |what: &str| {
        let section = sections.next().filter(|section| !section.is_empty());
        section.ok_or_else(|| not_ours(&format!("its {what} are missing")))
    };
    let flags = digits(next("flags")?, "flags")? as u64;
    let decimals = numbers(next("decimals")?, "decimals")?;
    let integers = next("integers")?;
    let choices = next("choices")?;
    let mut drawing = Drawing {
        units: units(choices)?,
        has_gravity: flags & 1 << 8 == 0,
        is_clockwise: flags & 1 != 0,
        speed: number(integers.split(',').next().unwrap_or_default(), "integers")?.abs(),
        linear_speed: decimals
            .get(1)
            .copied()
            .filter(|speed| *speed > 0.0)
            .unwrap_or(USUAL_LINEAR_SPEED),
        joints: Vec::new(),
        links: Vec::new(),
        loads: Vec::new(),
        left_out: vec![LeftOut {
            place: "page".into(),
            what: "colours, grid, labels, scale and what is selected".into(),
        }],
    };
    let mut blocks = Vec::new();
    for (k, record) in list(&mut sections, "joints")?.into_iter().enumerate() {
        drawing
            .joints
            .push(joint(record, &format!("joint {}", k + 1))?);
    }
    for (k, record) in list(&mut sections, "links")?.into_iter().enumerate() {
        let (link, is_block) = self::link(record, &format!("link {}", k + 1))?;
        if is_block {
            blocks.push(link);
        } else {
            drawing.links.push(link);
        }
    }
    for (k, record) in list(&mut sections, "forces")?.into_iter().enumerate() {
        drawing
            .loads
            .push(load(record, &format!("force {}", k + 1))?);
    }
    // What is selected is of the page.
    sections.next();
    let marks: Vec<&str> = sections.collect();
    let marks = marks.join(".");
    read_marks(
        &mut drawing,
        marks.split(',').filter(|mark| !mark.is_empty()),
    )?;
    fold(&mut drawing, &blocks)?;
    Ok(drawing)
}

/// The link without its checks, which must fit.
fn intact(link: &str) -> Result<&str, Refused> {
    let damaged = |cause: String| {
        let mend = "a character was lost or changed on the way: copy the link again";
        Refused::new("", cause, mend)
    };
    let checked = match link.rsplit_once('*') {
        Some((checked, digest)) => {
            let found = self::digest(checked);
            if digest != found {
                let cause =
                    format!("the link is damaged: its digest is {digest}, and it makes {found}");
                return Err(damaged(cause));
            }
            checked
        }
        None => link,
    };
    let Some((at, last)) = checked
        .char_indices()
        .next_back()
        .filter(|_| checked.contains('.'))
    else {
        return Err(not_ours("no sections that end with a point"));
    };
    let body = &checked[..at];
    let length = body.encode_utf16().count() % CHECKS;
    if DIGITS.chars().nth(length) != Some(last) {
        let said = DIGITS.find(last).filter(|place| *place < CHECKS);
        let said = said.map_or_else(
            || "no length".to_owned(),
            |place| format!("{place} modulo {CHECKS}"),
        );
        let cause = format!(
            "the link is damaged: its length is {length} modulo {CHECKS}, and it says {said}"
        );
        return Err(damaged(cause));
    }
    Ok(body)
}

/// FNV-1a of UTF-16 units, in six digits.
fn digest(body: &str) -> String {
    let mut hash = body.encode_utf16().fold(0x811c_9dc5_u32, |hash, unit| {
        (hash ^ u32::from(unit)).wrapping_mul(0x0100_0193)
    });
    let mut written = [b'0'; 6];
    for digit in written.iter_mut().rev() {
        *digit = DIGITS.as_bytes()[hash as usize % CHECKS];
        hash /= CHECKS as u32;
    }
    written.iter().map(|digit| char::from(*digit)).collect()
}

fn not_ours(cause: &str) -> Refused {
    Refused::new(
        "",
        format!("this is no link of PMKS+ that is known: {cause}"),
        "in PMKS+ choose Share, and copy the whole link",
    )
}

/// The records of a list, which ends with an empty one.
fn list<'t>(
    sections: &mut impl Iterator<Item = &'t str>,
    what: &str,
) -> Result<Vec<&'t str>, Refused> {
    let mut records = Vec::new();
    for section in sections {
        if section.is_empty() {
            return Ok(records);
        }
        records.push(section);
        if records.len() > MOST_PARTS {
            let cause = format!("more than {MOST_PARTS} {what} are too many for a planar linkage");
            return Err(Refused::new("", cause, format!("{MOST_PARTS} at most")));
        }
    }
    Err(not_ours(&format!("its {what} have no end")))
}

/// Digits of base 64.
fn digits(text: &str, place: &str) -> Result<f64, Refused> {
    let refused = |cause: String| Refused::new(place, cause, DAMAGED);
    if text.len() > LONGEST_NUMBER {
        return Err(refused(format!(
            "{:?} has too many digits for a number",
            shortened(text)
        )));
    }
    text.chars().try_fold(0.0, |sum, c| match DIGITS.find(c) {
        Some(digit) => Ok(sum * 64.0 + digit as f64),
        None => Err(refused(format!(
            "{text:?} is no number: {c:?} is none of its digits"
        ))),
    })
}

/// A whole number: one that begins with 0 is negative.
fn number(text: &str, place: &str) -> Result<f64, Refused> {
    match text.strip_prefix('0') {
        Some(rest) => Ok(0.0 - digits(rest, place)?),
        None if text.is_empty() => Err(Refused::new(place, "a number is missing", DAMAGED)),
        None => digits(text, place),
    }
}

fn decimal(text: &str, place: &str) -> Result<f64, Refused> {
    Ok(number(text, place)? / 1000.0)
}

fn numbers(text: &str, place: &str) -> Result<Vec<f64>, Refused> {
    text.split(',').map(|text| decimal(text, place)).collect()
}

fn shortened(text: &str) -> String {
    let start: String = text.chars().take(20).collect();
    if start.len() < text.len() {
        format!("{start}…")
    } else {
        start
    }
}

/// The units, of which the choice of lengths decides.
fn units(choices: &str) -> Result<Units, Refused> {
    match choices.as_bytes()[0] {
        b'0' => Ok(Units::Inch),
        b'1' => Ok(Units::Centimetre),
        b'2' => Ok(Units::Metre),
        _ => Err(Refused::new(
            "choices",
            format!("{:?} names no unit of length", shortened(choices)),
            "0 is in, 1 is cm, 2 is m",
        )),
    }
}

/// The fields of a record, without its first characters, which are flags.
fn fields<'t>(
    record: &'t str,
    flags: usize,
    least: usize,
    place: &str,
) -> Result<(&'t str, Vec<&'t str>), Refused> {
    let (flags, rest) = record.split_at_checked(flags).unwrap_or(("", ""));
    let fields: Vec<&str> = rest.split(',').collect();
    if fields.len() < least || fields[0].is_empty() {
        return Err(Refused::new(
            place,
            format!(
                "{:?} has {} of at least {least} fields",
                shortened(record),
                fields.len()
            ),
            DAMAGED,
        ));
    }
    Ok((flags, fields))
}

fn joint(record: &str, place: &str) -> Result<Pin, Refused> {
    let (flags, fields) = fields(record, 1, 5, place)?;
    let flags = digits(flags, place)? as u32;
    let has = |bit: u32| flags & 1 << bit != 0;
    let more = |at: usize| fields.get(at).copied().unwrap_or_default();
    let decimal_or = |at: usize| match more(at) {
        "" => Ok(0.0),
        text => decimal(text, place),
    };
    let on = [more(5), more(6), more(7)];
    let named = on.iter().filter(|name| !name.is_empty()).count();
    if named != 0 && named != 3 || named == 3 && !has(0) {
        return Err(Refused::new(
            place,
            "a slot needs a link and two of its joints",
            DAMAGED,
        ));
    }
    let speed = decimal_or(8)?;
    Ok(Pin {
        id: fields[0].to_owned(),
        name: fields[1].to_owned(),
        at: [decimal(fields[2], place)?, decimal(fields[3], place)?],
        is_ground: has(2),
        is_input: has(1),
        is_welded: has(3),
        is_traced: has(4),
        speed: Some(speed).filter(|speed| *speed != 0.0),
        slide: has(0)
            .then(|| -> Result<Slot, Refused> {
                Ok(Slot {
                    angle: decimal(fields[4], place)?,
                    turns: !has(3),
                    mass: decimal_or(9)?,
                    on: (named == 3).then(|| on.map(str::to_owned)),
                })
            })
            .transpose()?,
    })
}

/// A link, and whether it is the block of a slide.
fn link(record: &str, place: &str) -> Result<(Bar, bool), Refused> {
    let (flags, fields) = fields(record, 2, 8, place)?;
    // Who is whole, part of another, has its own inertia or that of its outline, is drawn as a disc.
    let is_root = match flags.as_bytes() {
        [b'Y' | b'A' | b'M' | b'G' | b'0'..=b'3', b'R' | b'P'] => true,
        [b'N' | b'a' | b'm' | b'g' | b'4'..=b'7', b'R' | b'P'] => false,
        _ => {
            return Err(Refused::new(
                place,
                format!("{flags:?} says no kind of link"),
                "the link is damaged, or newer than what is known: please report it",
            ));
        }
    };
    let names: Vec<&str> = fields[7..].to_vec();
    let mut lists = names.split(|name| name.is_empty());
    let mut list = || -> Vec<String> {
        let names = lists.next().unwrap_or_default();
        names.iter().map(|name| (*name).to_owned()).collect()
    };
    let link = Bar {
        id: fields[0].to_owned(),
        name: fields[1].to_owned(),
        mass: decimal(fields[2], place)?,
        inertia: decimal(fields[3], place)?,
        com: [decimal(fields[4], place)?, decimal(fields[5], place)?],
        joints: list(),
        parts: list(),
        is_root,
    };
    if link.mass < 0.0 || link.inertia < 0.0 {
        return Err(Refused::new(
            place,
            "mass and inertia are 0 or more",
            DAMAGED,
        ));
    }
    Ok((link, flags.ends_with('P')))
}

fn load(record: &str, place: &str) -> Result<Load, Refused> {
    let (flags, fields) = fields(record, 1, 8, place)?;
    let flags = digits(flags, place)? as u32;
    let at = |k: usize| -> Result<At, Refused> {
        Ok([decimal(fields[k], place)?, decimal(fields[k + 1], place)?])
    };
    Ok(Load {
        name: fields[2].to_owned(),
        link: fields[1].to_owned(),
        from: at(3)?,
        to: at(5)?,
        magnitude: decimal(fields[7], place)?,
        is_local: flags & 1 != 0,
        is_outward: flags & 2 != 0,
    })
}

/// Marks behind the drawing: numbers with all their digits are read, the rest is told.
fn read_marks<'t>(
    drawing: &mut Drawing,
    marks: impl Iterator<Item = &'t str>,
) -> Result<(), Refused> {
    let joints = by_name(drawing.joints.iter().map(|joint| &joint.id));
    let links = by_name(drawing.links.iter().map(|link| &link.id));
    let (mut gears, mut others) = (false, Vec::new());
    for mark in marks {
        let parts: Vec<&str> = mark.split('~').collect();
        let (kind, id) = match parts[0].as_bytes() {
            [b'P', b'J' | b'L' | b'D' | b'I', ..] => (&mark[1..2], &parts[0][2..]),
            [b'P', ..] => continue,
            [b'G', b'1'] => {
                gears = true;
                continue;
            }
            _ => {
                others.extend(mark.chars().next().filter(|kind| !others.contains(kind)));
                continue;
            }
        };
        let [_, field, value] = parts[..] else {
            continue;
        };
        let value: f64 = value.parse().unwrap_or(f64::NAN);
        if !value.is_finite() {
            let place = format!("mark {:?}", shortened(mark));
            return Err(Refused::new(place, "this is no number", DAMAGED));
        }
        let target = match (kind, field) {
            ("J", _) => joints.get(id).and_then(|&at| {
                let joint = &mut drawing.joints[at];
                match (field, joint.slide.as_mut()) {
                    ("0", _) => Some(&mut joint.at[0]),
                    ("1", _) => Some(&mut joint.at[1]),
                    ("2", slide) => slide.map(|slide| &mut slide.angle),
                    ("3", _) => Some(joint.speed.get_or_insert_default()),
                    ("4", slide) => slide.map(|slide| &mut slide.mass),
                    _ => None,
                }
            }),
            ("L", _) => links.get(id).and_then(|&at| {
                let link = &mut drawing.links[at];
                match field {
                    "0" => Some(&mut link.mass),
                    "1" => Some(&mut link.inertia),
                    "2" => Some(&mut link.com[0]),
                    "3" => Some(&mut link.com[1]),
                    _ => None,
                }
            }),
            ("D", "1") => Some(&mut drawing.linear_speed),
            ("I", "0") => Some(&mut drawing.speed),
            _ => None,
        };
        if let Some(target) = target {
            *target = value;
        }
    }
    if gears {
        drawing.left_out.push(LeftOut {
            place: "gears".into(),
            what: "all wheels and their meshes: the links that they drive are free".into(),
        });
    }
    if !others.is_empty() {
        let kinds: Vec<String> = others.iter().map(|kind| format!("{kind:?}")).collect();
        drawing.left_out.push(LeftOut {
            place: "marks".into(),
            what: format!(
                "locks, holds, syntheses and others, of kind {}",
                kinds.join(", ")
            ),
        });
    }
    Ok(())
}

fn by_name<'t>(names: impl Iterator<Item = &'t String>) -> HashMap<String, usize> {
    names
        .enumerate()
        .map(|(at, name)| (name.clone(), at))
        .collect()
}

/// Makes one joint of each pin, the sliding joint at its place and the block between both; it has the name of the pin.
fn fold(drawing: &mut Drawing, blocks: &[Bar]) -> Result<(), Refused> {
    let joints = by_name(drawing.joints.iter().map(|joint| &joint.id));
    let mut folded = HashMap::new();
    for block in blocks {
        let both: Vec<usize> = block
            .joints
            .iter()
            .filter_map(|id| joints.get(id).copied())
            .collect();
        let slides = |at: usize| drawing.joints[at].slide.is_some();
        let (pin, slider) = match both[..] {
            [pin, slider] if !slides(pin) && slides(slider) => (pin, slider),
            [slider, pin] if !slides(pin) && slides(slider) => (pin, slider),
            _ => {
                let cause = "a block needs a pin and a sliding joint";
                return Err(Refused::new(format!("link {}", block.id), cause, DAMAGED));
            }
        };
        let slider = drawing.joints[slider].clone();
        let pin = &mut drawing.joints[pin];
        if slider.at != pin.at {
            return Err(Refused::new(
                format!("link {}", block.id),
                format!(
                    "its joints {} and {} are not at one place",
                    pin.id, slider.id
                ),
                "move the block onto its pin in PMKS+",
            ));
        }
        pin.slide = slider.slide.map(|slide| Slot {
            turns: !pin.is_welded,
            mass: block.mass,
            ..slide
        });
        pin.is_ground = slider.is_ground;
        pin.is_input |= slider.is_input;
        pin.speed = pin.speed.or(slider.speed);
        folded.insert(slider.id, pin.id.clone());
    }
    drawing
        .joints
        .retain(|joint| !folded.contains_key(&joint.id));
    let slots = drawing
        .joints
        .iter_mut()
        .filter_map(|joint| joint.slide.as_mut()?.on.as_mut());
    for name in slots.flat_map(|on| on.iter_mut().skip(1)) {
        if let Some(pin) = folded.get(name) {
            name.clone_from(pin);
        }
    }
    Ok(())
}
