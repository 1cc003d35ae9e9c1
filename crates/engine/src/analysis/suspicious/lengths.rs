//! Slips that show beside the rest of the mechanism: a length or a centre of mass a hundred times off.

use super::bodies::{DIGITS, extent, moving, points};
use linkdyn_linear::math::Vec2;
use linkdyn_model::error::Complaint;
use linkdyn_model::{Body, GROUND, Model};

/// Longer links are few, and millimetres taken for metres are longer \[m\].
const LONGEST: f64 = 30.0;
/// Shorter links are few, too \[m\].
const SHORTEST: f64 = 1e-6;
/// A length this many times longer or shorter than the middle one is rarely meant; a slip of the unit is a thousand [–].
const LENGTH_SPREAD: f64 = 100.0;
/// Fewer lengths have no middle one that tells which of them is wrong.
const LEAST_LENGTHS: usize = 3;
/// A centre of mass this much nearer to a point than the body is long is mostly on it or far from it [–].
const COM_BESIDE: f64 = 1.0 / 500.0;
/// Millimetres in a metre: how much too small metres are among millimetres [–].
const THOUSAND: f64 = 1000.0;

/// The middle one of the mechanism's lengths: of bodies, from their centres of mass to their points, between their drawn
/// places.
fn middle(model: &Model) -> Option<f64> {
    let mut lengths = Vec::new();
    let mut first = None;
    for (name, body) in &model.bodies {
        lengths.push(extent(body));
        if name == GROUND {
            continue;
        }
        let com = body.com.map(Vec2::from);
        lengths.extend(com.map(|com| {
            points(body)
                .map(|point| (point - com).norm())
                .fold(0.0, f64::max)
        }));
        let place = Vec2::from(body.pose.position);
        lengths.push((place - *first.get_or_insert(place)).norm());
    }
    lengths.retain(|length| *length > 0.0);
    lengths.sort_by(f64::total_cmp);
    if lengths.len() < LEAST_LENGTHS {
        None
    } else {
        lengths.get((lengths.len() - 1) / 2).copied()
    }
}

/// Lengths and centres of mass that look like a slip.
pub(super) fn lengths(model: &Model) -> Vec<Complaint> {
    let mut found = Vec::new();
    let Some(middle) = middle(model) else {
        return found;
    };
    let text = |length: f64| model.display.length_to(length, DIGITS);
    for (name, body) in &model.bodies {
        let extent = extent(body);
        let long = extent > LENGTH_SPREAD * middle;
        // Points of ground are often close together, by an offset that is meant.
        if long || (extent > 0.0 && extent * LENGTH_SPREAD < middle && name != GROUND) {
            let message = format!(
                "the points are {} apart, {} than most lengths of the mechanism, near {}",
                text(extent),
                if long { "much longer" } else { "much shorter" },
                text(middle)
            );
            let hint = "check its points and their unit";
            found.push(Complaint::new(format!("bodies.{name}.points"), message).hint(hint));
        } else if let Some(message) = body
            .com
            .and_then(|com| stray_com(body, Vec2::from(com), extent, middle, text))
        {
            let hint = "check its numbers and their unit; \"com\" is in the body's frame";
            found.push(Complaint::new(format!("bodies.{name}.com"), message).hint(hint));
        }
    }
    found
}

/// What is odd about a centre of mass.
fn stray_com(
    body: &Body,
    com: Vec2,
    extent: f64,
    middle: f64,
    text: impl Fn(f64) -> String,
) -> Option<String> {
    let (point, nearest) = body
        .points
        .iter()
        .map(|(name, &point)| (name, (Vec2::from(point) - com).norm()))
        .min_by(|a, b| a.1.total_cmp(&b.1))?;
    let reach = extent.max(middle);
    if nearest > LENGTH_SPREAD * reach {
        let (far, reach) = (text(nearest), text(reach));
        return Some(format!(
            "the centre of mass is {far} from the nearest point, {point}, in a mechanism of {reach}"
        ));
    }
    // A balanced crank has its centre of mass near its pin, but hardly at a thousandth of a place amid its points.
    let amid = points(body).sum::<Vec2>() / body.points.len() as f64;
    let within = (com * THOUSAND - amid).norm() <= 0.25 * extent;
    if nearest > 0.0 && nearest < COM_BESIDE * extent && within {
        let (near, extent) = (text(nearest), text(extent));
        return Some(format!(
            "the centre of mass is beside point {point}, {near} off it, in a body of {extent}"
        ));
    }
    None
}

/// A mechanism that is large or small as a whole.
pub(super) fn whole(model: &Model) -> Option<Complaint> {
    let mut extents: Vec<(&String, f64)> = moving(model)
        .map(|(name, body)| (name, extent(body)))
        .filter(|(_, extent)| *extent > 0.0)
        .collect();
    extents.sort_by(|a, b| a.1.total_cmp(&b.1));
    let (_, middle) = extents.get(extents.len().checked_sub(1)? / 2)?;
    let (name, extent) = extents.last()?;
    let size = if *middle > LONGEST { "long" } else { "small" };
    (!(SHORTEST..=LONGEST).contains(middle)).then(|| {
        Complaint::new(
            format!("bodies.{name}.points"),
            format!("the bodies are very {size}, this one {}", model.display.length_to(*extent, DIGITS)),
        )
        .hint("check the unit of length: \"units\": { \"length\": \"mm\" } reads plain numbers as millimetres")
    })
}
