//! How to write each key whose value is more than a number: what complaints show where it is missing or of another kind.

const TABLE: &str = include_str!("examples.txt");

/// What is to be said before the example at a path, and the example; nothing where somebody gave the name.
fn row(path: &str) -> Option<(&'static str, &'static str)> {
    let path: Vec<&str> = path.split('.').collect();
    let rows = TABLE.lines().filter(|row| !row.starts_with('#'));
    let mut rows = rows.map(|row| row.split('|').map(str::trim));
    let mut row = rows.find(|row| {
        let pattern = row.clone().next().unwrap_or_default();
        fits(&pattern.split('.').collect::<Vec<_>>(), &path)
    })?;
    row.next();
    row.next().zip(row.next())
}

/// Whether the steps of a path are those of a pattern: `*` is any step, `**` any number of steps, `a|b` one of both.
pub(super) fn fits(pattern: &[&str], path: &[&str]) -> bool {
    match (pattern, path) {
        (["**", rest @ ..], _) => {
            fits(rest, path)
                || path
                    .split_first()
                    .is_some_and(|(_, path)| fits(pattern, path))
        }
        ([wanted, pattern @ ..], [step, path @ ..]) => {
            let mut words = wanted.split('|');
            let is_it = words.any(|word| match word.strip_suffix('*') {
                Some(beginning) => step.starts_with(beginning),
                None => word == *step,
            });
            is_it && fits(pattern, path)
        }
        (rest, steps) => rest.is_empty() && steps.is_empty(),
    }
}

/// How to write the value at a path, with its key.
pub(super) fn example(path: &str) -> Option<&'static str> {
    row(path).map(|(_, example)| example)
}

/// How to write a key of the object at a path where it is missing.
pub(super) fn of_missing(path: &str, key: &str) -> Option<String> {
    let (before, example) = row(&super::node::join(path, key))?;
    Some(match (key, before) {
        ("format" | "units", _) => format!("write {example}"),
        (_, "") => format!("as in {example}"),
        (_, before) => format!("{before}, as in {example}"),
    })
}
