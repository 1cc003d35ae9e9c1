//! What was found, in words.

use linkdyn_model::display::DisplayUnits;
use linkdyn_model::optimise::Relation;

use super::optimised::Optimised;
use super::problem::Measured;
use super::search::Ended;
use super::target::{Aim, Told};
use crate::text::responses::{value, value_in};
use crate::text::{Page, count, number};

/// Digits of shares and slopes.
const FEW: usize = 2;

impl Optimised {
    /// What was found, in words.
    pub fn text(&self) -> Page {
        let target = &self.target;
        let display = &self.file.model().display;
        let mut page = Page::default();
        let runs = count(self.runs as usize, "evaluation");
        page.line(format!("{}: {}, {runs}", self.file.name(), verdict(self)));
        if let Some((best, measured)) = self.best() {
            let all = target.variables.iter().zip(&best.x).enumerate();
            let design = all.map(|(k, (own, x))| {
                let (name, unit) = (&own.parameter.name, &own.parameter.unit);
                let before = value(own.parameter.value, unit, display);
                let at = self.bound(k, *x);
                let at = at.map_or(String::new(), |at| format!(", at its {at} bound"));
                let value = value(*x, unit, display);
                format!("parameters.{name} = {value} (was {before}){at}")
            });
            page.rows("design", design);
            aims(&mut page, self, best, measured, display);
            let responses = target.responses.iter().zip(&measured.responses);
            let told_of = |(Told { name, unit, shown }, own): (&Told, &f64)| match own.is_finite() {
                true => format!("{name} = {}", value_in(shown.as_ref(), *own, unit, display)),
                false => format!("{name}: none"),
            };
            page.rows("responses", responses.map(told_of));
        }
        if target.aim != Aim::Goal {
            page.row("starts", starts(self));
            if let Some(from) = derivatives(self) {
                page.row("derivatives", from);
            }
            others(&mut page, self, display);
        }
        page
    }
}

/// How it ended.
pub(super) fn verdict(told: &Optimised) -> String {
    let target = &told.target;
    let what = match (&target.objective, &target.curve) {
        (Some(aimed), _) if aimed.sign > 0.0 => format!("least {}", aimed.text),
        (Some(aimed), _) => format!("greatest {}", aimed.text),
        (None, Some(curve)) => format!("path of {}", curve.point),
        (None, None) => {
            let all = target.constraints.iter().map(|one| one.text.as_str());
            all.collect::<Vec<_>>().join(", ")
        }
    };
    let how = match told.status() {
        "interrupted" => "interrupted",
        "found" => "found",
        "not_reached" => "not reached",
        _ => "no variant has a result",
    };
    format!("{what}: {how}")
}

fn aims(
    page: &mut Page,
    told: &Optimised,
    best: &Ended,
    measured: &Measured,
    display: &DisplayUnits,
) {
    let target = &told.target;
    if let Some(aimed) = &target.objective {
        let mut text = format!(
            "{} = {}",
            aimed.text,
            value(measured.objective, &aimed.unit, display)
        );
        if let (Some(robust), Some(deviation)) = (&target.robust, measured.deviation) {
            let sign = if aimed.sign > 0.0 { '+' } else { '−' };
            text += &format!(
                "; {sign} {} σ of {} = {}",
                number(robust.sigmas, FEW),
                value(deviation, &aimed.unit, display),
                value(aimed.sign * best.value, &aimed.unit, display)
            );
        }
        page.row("objective", text);
    }
    let constraints = target.constraints.iter().zip(&measured.sides).enumerate();
    page.rows(
        "constraints",
        constraints.map(|(k, (one, sides))| {
            let left = value(sides[0], &one.unit, display);
            let off = || value((sides[0] - sides[1]).abs(), &one.unit, display);
            let state = match (told.state(k, *sides), one.relation) {
                ((false, _), _) => format!("not kept, off by {}", off()),
                ((true, _), Relation::Equal) => format!("kept, off by {}", off()),
                ((true, true), _) => "kept, at its limit".to_owned(),
                ((true, false), _) => "kept".to_owned(),
            };
            format!("{}: {left}, {state}", one.text)
        }),
    );
    if let (Some(curve), Some([most, mean])) = (&target.curve, told.distances(measured)) {
        let (most, mean) = (display.length(most), display.length(mean));
        let points = curve.through.len();
        page.row(
            "curve",
            format!("{points} points, {most} off at most, {mean} root mean square"),
        );
    }
}

/// How many starts reached the best, and how sure it is.
fn starts(told: &Optimised) -> String {
    let all = count(told.starts.len(), "start");
    let Some((best, _)) = told.best() else {
        return all;
    };
    if told.found().is_none() {
        return format!(
            "{all}, none of them keeps all constraints; the nearest ended as {}",
            best.how
        );
    }
    let designs = count(told.designs().len(), "design");
    let slope = best
        .slope
        .map(|own| format!("; slope that is left {}", number(own, FEW)));
    format!(
        "{all}, {} of them with this value, in {designs}{}; the best ended as {}",
        told.reached,
        slope.unwrap_or_default(),
        best.how
    )
}

/// Where derivatives came from; `None` if none were needed.
fn derivatives(told: &Optimised) -> Option<String> {
    match told.derivatives().sum() {
        [0, 0] => None,
        [_, 0] => Some("exact".to_owned()),
        [0, _] => Some("by differences".to_owned()),
        [_, _] => {
            let all = told.gradients().into_iter();
            let of = all.filter(|(_, [_, differences])| *differences > 0);
            let each = of.map(|(text, [exact, differences])| match exact {
                0 => text,
                _ => format!("{text} ({differences} of {})", exact + differences),
            });
            let each: Vec<String> = each.collect();
            Some(format!("exact, but by differences: {}", each.join("; ")))
        }
    }
}

/// Other designs that are as good.
fn others(page: &mut Page, told: &Optimised, display: &DisplayUnits) {
    const MOST: usize = 4;
    let others = told.designs().skip(1);
    let more = others.len().saturating_sub(MOST);
    let mut rows: Vec<String> = others
        .take(MOST)
        .map(|own| {
            let all = told.target.variables.iter().zip(&own.x);
            let all = all.map(|(own, x)| {
                format!(
                    "{} = {}",
                    own.parameter.name,
                    value(*x, &own.parameter.unit, display)
                )
            });
            all.collect::<Vec<_>>().join(", ")
        })
        .collect();
    if more > 0 {
        rows.push(format!("… and {more} more"));
    }
    page.rows("as good", rows);
}
