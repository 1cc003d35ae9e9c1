//! Responses in words.

use indexmap::IndexMap;
use linkdyn_engine::analysis::responses::{Answer, to_json};
use linkdyn_model::Model;
use linkdyn_model::display::{DIGITS, DisplayUnits};
use linkdyn_model::response::Catalogue;
use serde::Serialize;
use serde_json::{Value, json};

use super::words::unit_words;
use super::{Page, number};

/// A value with its SI unit, in the units of the file.
pub fn value(value: f64, unit: &str, display: &DisplayUnits) -> String {
    match unit {
        "m" => display.length(value),
        "rad" => display.angle(value),
        "kg" => display.mass_to(value, DIGITS),
        "s" => display.time(value),
        "" => number(value, DIGITS),
        unit => format!("{} {}", number(value, DIGITS), unit_words(unit)),
    }
}

/// Whether it has limits, and no value within them.
pub fn is_missed(answer: &Answer) -> bool {
    let is_within = |[lower, upper]: [f64; 2]| {
        let value = answer.value;
        value.is_some_and(|value| (lower..=upper).contains(&value))
    };
    answer.limits.is_some_and(|limits| !is_within(limits))
}

/// A value in the unit that the model declares for it, else in the units of the file.
pub fn value_in(
    shown: Option<&(String, f64)>,
    value: f64,
    unit: &str,
    display: &DisplayUnits,
) -> String {
    match shown {
        Some((unit, size)) => format!("{} {}", number(value / size, DIGITS), unit_words(unit)),
        None => self::value(value, unit, display),
    }
}

fn shown(answer: &Answer, value: f64, display: &DisplayUnits) -> String {
    value_in(answer.shown.as_ref(), value, &answer.unit, display)
}

/// `stroke = 100 mm`, with its limits, or why there is none; `MISSED` where it has limits and does not keep them.
fn told(answer: &Answer, display: &DisplayUnits) -> String {
    let shown = |value: f64| shown(answer, value, display);
    let Answer { name, reason, .. } = answer;
    let missed = match is_missed(answer) {
        true => ", MISSED",
        false => "",
    };
    let Some(value) = answer.value else {
        let reason = reason.as_deref().unwrap_or("it has no value");
        return format!("{name}: none{missed}, {reason}");
    };
    let limits = answer.limits.map(|[lower, upper]| {
        let where_it_is = match is_missed(answer) {
            true => "outside of",
            false => "within",
        };
        format!(" ({where_it_is} {} … {})", shown(lower), shown(upper))
    });
    format!(
        "{name} = {}{missed}{}",
        shown(value),
        limits.unwrap_or_default()
    )
}

/// A row for each response; one that misses its limits is not to be overlooked.
pub fn answers(page: &mut Page, answers: &[Answer], display: &DisplayUnits) {
    for (index, answer) in answers.iter().enumerate() {
        page.row(
            if index == 0 { "responses" } else { "" },
            told(answer, display),
        );
        if is_missed(answer) {
            page.alarm();
        }
    }
}

/// The responses of a run as its page has them: as `summary.json`, with the words for their numbers.
pub fn for_page(answers: &[Answer], display: &DisplayUnits) -> Value {
    let mut json = to_json(answers);
    for answer in answers {
        let shown = |value: f64| shown(answer, value, display);
        json[&answer.name]["words"] = json!({
            "value": answer.value.map(shown),
            "limits": answer.limits.map(|ends| ends.map(shown)),
            "declared": answer.shown.is_some(),
            "missed": is_missed(answer),
        });
    }
    json
}

/// A response that a model asks for.
#[derive(Debug, Serialize)]
pub struct Expression<'a> {
    value: &'a str,
    /// SI.
    unit: String,
    /// The unit that the model declares.
    #[serde(skip_serializing_if = "Option::is_none")]
    declared: Option<&'a str>,
}

/// The responses that a model asks for, by name.
pub fn expressions(model: &Model) -> IndexMap<&str, Expression<'_>> {
    let catalogue = Catalogue::of(model);
    let all = model.responses.iter().map(|(name, response)| {
        let unit = response.compile(&catalogue).map(|compiled| compiled.unit);
        let expression = Expression {
            value: &response.value,
            unit: unit.unwrap_or_default(),
            declared: response.unit.as_deref(),
        };
        (name.as_str(), expression)
    });
    all.collect()
}

/// The outputs and the responses that a model asks for, a row each.
pub fn rows(page: &mut Page, model: &Model) {
    let outputs = model.outputs.iter();
    page.rows(
        "outputs",
        outputs.map(|(name, text)| format!("{name} = {text}")),
    );
    let all = expressions(model).into_iter();
    let texts = all.map(|(name, own)| {
        let text = format!("{name} = {}", own.value);
        match own.declared.unwrap_or(&own.unit) {
            "" => text,
            unit => format!("{text}  [{}]", unit_words(unit)),
        }
    });
    page.rows("responses", texts);
}
