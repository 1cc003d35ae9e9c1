//! Mutants of results.

use super::*;

/// A summary with parts removed, exchanged or changed.
pub fn summary(rng: &mut Rng, text: &str) -> Vec<u8> {
    match rng.below(3) {
        0 => bytes(rng, text.as_bytes(), text.as_bytes()),
        _ => {
            // drawing and events are what pictures read
            let mut root: Value = serde_json::from_str(text).unwrap_or_default();
            let mut part = Map::new();
            for key in ["drawing", "events", "model"] {
                part.insert(
                    key.into(),
                    root.get_mut(key).map(Value::take).unwrap_or_default(),
                );
            }
            let mut part = Value::Object(part);
            for _ in 0..=rng.below(3) {
                change(rng, &mut part, &[]);
            }
            if let (Value::Object(root), Value::Object(part)) = (&mut root, part) {
                root.extend(part);
            }
            root.to_string().into_bytes()
        }
    }
}

/// A table of results with cells, rows, names or bytes changed.
pub fn table(rng: &mut Rng, text: &str) -> Vec<u8> {
    if rng.once_in(3) {
        return bytes(rng, text.as_bytes(), text.as_bytes());
    }
    let mut rows: Vec<Vec<String>> = text
        .lines()
        .map(|line| line.split(',').map(String::from).collect())
        .collect();
    for _ in 0..=rng.below(6) {
        if rows.len() < 2 {
            break;
        }
        let (here, there) = (rng.below(rows.len()), rng.below(rows.len()));
        let cell = rng.below(rows[here].len().max(1));
        match rng.below(9) {
            0 => drop(rows.remove(here)),
            1 => rows.swap(here, there),
            2 => rows[here] = rows[there].clone(),
            3 => rows.truncate(here.max(1)),
            4..=6 => {
                let odd = [
                    "", "nan", "NaN", "inf", "-inf", "1e308", "-1e308", "5e-324", "-0.0", "0.0",
                    "1e400", "x", "1e-300", " 1 ", "1e17",
                ];
                let text = if rng.once_in(2) {
                    odd[rng.below(odd.len())].to_string()
                } else {
                    words::number(rng, Some(1.0)).to_string()
                };
                // now and then a whole column
                let all = rng.once_in(3);
                for row in rows
                    .iter_mut()
                    .skip(if all { 1 } else { here })
                    .take(if all { usize::MAX } else { 1 })
                {
                    if let Some(cell) = row.get_mut(cell) {
                        cell.clone_from(&text);
                    }
                }
            }
            7 => {
                let names = [
                    "time[s]",
                    "time[ms]",
                    "x[m]",
                    "crank.angle[rad]",
                    "crank.angle[deg]",
                    "a[",
                    "a]",
                    "[]",
                    "",
                    "\"a,b\"[m]",
                    "a[m][s]",
                ];
                if let Some(cell) = rows[0].get_mut(cell) {
                    *cell = names[rng.below(names.len())].to_string();
                }
            }
            _ => {
                for row in &mut rows {
                    if cell < row.len() {
                        row.remove(cell);
                    }
                }
            }
        }
    }
    rows.iter()
        .map(|row| row.join(",") + "\n")
        .collect::<String>()
        .into_bytes()
}
