//! The nearest known word to a misspelt one.

use strsim::damerau_levenshtein;

/// Words longer than this are nobody's slip of the pen.
const LONGEST: usize = 64;

/// The candidate that differs least from `word`, where it differs by a slip or two at most.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if word.len() > LONGEST {
        return None;
    }
    let lower = word.to_lowercase();
    let allowed = match lower.chars().count() {
        0..=2 => 1,
        3..=5 => 2,
        count => 1 + count / 3,
    };
    candidates
        .into_iter()
        .map(|candidate| {
            (
                damerau_levenshtein(&lower, &candidate.to_lowercase()),
                candidate,
            )
        })
        // at least one letter must be right
        .filter(|&(distance, candidate)| {
            distance <= allowed && distance < candidate.chars().count().min(lower.chars().count())
        })
        .min_by_key(|&(distance, candidate)| (distance, !candidate.starts_with(word)))
        .map(|(_, candidate)| candidate)
}

/// Words of other programs, and those that stand for them here.
const SYNONYMS: [(&str, &str); 17] = [
    ("revolute", "rotation"),
    ("prismatic", "translation"),
    ("rotational", "rotation"),
    ("angle", "rotation"),
    ("translational", "translation"),
    ("linear", "translation"),
    ("slider", "prismatic"),
    ("sliding", "prismatic"),
    ("pin", "revolute"),
    ("hinge", "revolute"),
    ("weld", "fixed"),
    ("rigid", "fixed"),
    ("sine", "harmonic"),
    ("spline", "table"),
    ("constant", "constant_velocity"),
    ("damper", "spring"),
    ("moment", "torque"),
];

/// The choice that was probably meant: the same in other words, or nearly the same word.
pub fn meant<'a>(word: &str, choices: &[&'a str]) -> Option<&'a str> {
    let synonyms = SYNONYMS
        .iter()
        .filter(|(other, _)| other.eq_ignore_ascii_case(word));
    let known = synonyms
        .filter_map(|(_, here)| choices.iter().find(|choice| *choice == here))
        .next();
    known
        .copied()
        .or_else(|| nearest(word, choices.iter().copied()))
}

/// `"a", "b" or "c"`.
pub fn any_of<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let words: Vec<String> = words.into_iter().map(|word| format!("{word:?}")).collect();
    match words.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, before)) => format!("{} or {last}", before.join(", ")),
        None => String::new(),
    }
}

/// `"a", "b" and "c"`.
pub fn all_of(words: &[&str]) -> String {
    let words: Vec<String> = words.iter().map(|word| format!("{word:?}")).collect();
    match words.split_last() {
        Some((last, before)) if before.len() > 1 => format!("{} and {last}", before.join(", ")),
        _ => words.join(" and "),
    }
}

/// `A, B, C`, as many as anybody reads.
pub fn list<'a>(names: impl Iterator<Item = &'a String>) -> String {
    const MOST: usize = 12;
    let names: Vec<&str> = names.map(String::as_str).collect();
    match names.len() {
        0 => "none".into(),
        count if count > MOST => format!("{} and {} more", names[..MOST].join(", "), count - MOST),
        _ => names.join(", "),
    }
}
