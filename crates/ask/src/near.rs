//! The name that was probably meant by one that is not known.

/// The known name that was probably meant, in words; else `otherwise`.
pub fn did_you_mean<'a>(
    name: &str,
    known: impl Iterator<Item = &'a str> + Clone,
    otherwise: &str,
) -> String {
    match nearest(name, known) {
        Some(near) => format!("did you mean {near:?}?"),
        None => otherwise.to_string(),
    }
}

/// The known name nearest to `name`, where one is near: misspelt, or a part of it.
pub fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str> + Clone) -> Option<&'a str> {
    let name = name.to_lowercase();
    let similarity = |other: &str| strsim::jaro_winkler(&name, &other.to_lowercase());
    let near = known
        .clone()
        .map(|other| (similarity(other), other))
        .filter(|(similarity, _)| *similarity >= 0.75);
    let near = near
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, other)| other);
    near.or_else(|| {
        known
            .into_iter()
            .find(|other| name.len() > 3 && other.to_lowercase().contains(&name))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_names_are_found_and_far_ones_not() {
        let known = ["four-bar", "slider-crank", "watt-i-lock"];
        assert_eq!(nearest("fourbar", known.into_iter()), Some("four-bar"));
        assert_eq!(
            nearest("Slider-Cranck", known.into_iter()),
            Some("slider-crank")
        );
        assert_eq!(nearest("crank", known.into_iter()), Some("slider-crank"));
        assert_eq!(nearest("zzz", known.into_iter()), None);
    }
}
