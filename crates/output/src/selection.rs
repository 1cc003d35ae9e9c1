//! Which columns of a table are wanted, by patterns like the shell's.

use super::{Column, ColumnId, TIME};

/// Which columns some patterns keep, and what to tell about patterns that keep none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Selection {
    /// The columns, in their order.
    pub columns: Vec<ColumnId>,
    /// What to say about patterns that match nothing.
    pub warnings: Vec<String>,
}

impl Selection {
    /// Columns whose name, without `[unit]`, matches one of the patterns (`*`: any text, `?`: one character); no
    /// pattern at all keeps every column, `time` is always kept.
    pub fn new(columns: &[Column], patterns: &[String]) -> Self {
        Selection::beside(columns, &[], patterns)
    }

    /// The same; warnings know the names of the `others`, too, which could be there.
    pub fn beside(columns: &[Column], others: &[Column], patterns: &[String]) -> Self {
        if patterns.is_empty() {
            return Selection {
                columns: (0..columns.len()).map(ColumnId::at).collect(),
                warnings: Vec::new(),
            };
        }
        let matches_one = |name: &str| patterns.iter().any(|pattern| matches(pattern, name));
        let kept = |column: &Column| column.name == TIME || matches_one(&column.name);
        let kept = (0..columns.len())
            .filter(|&index| kept(&columns[index]))
            .map(ColumnId::at)
            .collect();
        let unmatched = patterns
            .iter()
            .filter(|pattern| !columns.iter().any(|column| matches(pattern, &column.name)));
        Selection {
            columns: kept,
            warnings: unmatched
                .map(|pattern| no_match(pattern, columns.iter().chain(others)))
                .collect(),
        }
    }
}

/// The warning about a pattern that matches no column, with a hint where there is one.
fn no_match<'c>(pattern: &str, columns: impl Iterator<Item = &'c Column>) -> String {
    if pattern.contains('[') {
        return format!(
            "analysis.columns: {pattern:?} matches no column: patterns match names without their [unit]"
        );
    }
    let near = columns
        .map(|column| {
            (
                strsim::normalized_damerau_levenshtein(pattern, &column.name),
                &column.name,
            )
        })
        .filter(|(similarity, _)| *similarity >= 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    match near {
        Some((_, name)) => {
            format!("analysis.columns: {pattern:?} matches no column; the nearest is {name:?}")
        }
        None => format!("analysis.columns: {pattern:?} matches no column"),
    }
}

/// Does `name` match `pattern`, where `*` stands for any text and `?` for one character?
pub fn matches(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) =
        (pattern.chars().collect(), name.chars().collect());
    let (mut p, mut n) = (0, 0);
    // Where to go on when a later character fails: behind the last star, one character further in the name.
    let mut retry: Option<(usize, usize)> = None;
    while n < name.len() {
        match pattern.get(p) {
            Some('*') => {
                p += 1;
                retry = Some((p, n));
            }
            Some(&c) if c == '?' || c == name[n] => {
                p += 1;
                n += 1;
            }
            Some(_) | None => match retry {
                Some((after_star, from)) => {
                    p = after_star;
                    n = from + 1;
                    retry = Some((after_star, n));
                }
                None => return false,
            },
        }
    }
    pattern[p..].iter().all(|&c| c == '*')
}

#[cfg(test)]
mod tests {
    use super::super::Trajectory;
    use super::*;

    fn columns(names: &[&str]) -> Vec<Column> {
        names.iter().map(|&name| Column::new(name, "m")).collect()
    }

    fn patterns(texts: &[&str]) -> Vec<String> {
        texts.iter().map(|&text| text.to_string()).collect()
    }

    #[test]
    fn patterns_match_like_the_shell() {
        for (pattern, name, expected) in [
            ("crank.*", "crank.x", true),
            ("crank.*", "crank2.x", false),
            ("*", "", true),
            ("joint.b.f?", "joint.b.fx", true),
            ("joint.b.f?", "joint.b.f", false),
            ("joint.?.f?", "joint.🔒.fy", true),
            ("*.x", "a.x.x", true),
            ("*a*b", "xaxbxab", true),
            ("*a*b", "xaxbxa", false),
            ("**", "anything", true),
            ("x", "xx", false),
        ] {
            assert_eq!(matches(pattern, name), expected, "{pattern} on {name}");
        }
    }

    #[test]
    fn select_keeps_time_and_order_and_warns() {
        let mut table = Trajectory::new(columns(&["time", "a.x", "a.y", "b.x"]));
        table.push_row(&[0.0, 1.0, 2.0, 3.0]);
        table.push_row(&[0.5, 4.0, 5.0, 6.0]);
        let (selected, warnings) = table.select(&patterns(&["b.*", "*.x", "a.z", "c[m]"]));
        let table = selected.expect("fewer columns");
        assert_eq!(table.columns[..], columns(&["time", "a.x", "b.x"]));
        assert_eq!(table.data, [0.0, 1.0, 3.0, 0.5, 4.0, 6.0]);
        assert_eq!(warnings.len(), 2, "{warnings:?}");
        assert!(
            warnings[0].contains("a.z") && warnings[0].contains("nearest"),
            "{warnings:?}"
        );
        assert!(warnings[1].contains("without their [unit]"), "{warnings:?}");
    }

    #[test]
    fn no_pattern_keeps_all() {
        let mut table = Trajectory::new(columns(&["time", "a.x"]));
        table.push_row(&[0.0, 1.0]);
        let (selected, warnings) = table.select(&[]);
        assert!(selected.is_none() && warnings.is_empty());
    }
}
