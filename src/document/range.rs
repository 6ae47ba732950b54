//! Range: the interval that a key's line states in words, as bounds, as a check, and as what an error says.

/// Bounds that a range says: of `[0, 0.5)`, `> 0`, `≥ 1`, `8 to 1000`; nothing of words.
#[must_use]
pub fn bounds(range: &str) -> Vec<(&'static str, f64)> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    // "> 0, each once"
    let range = match range.starts_with(['>', '≥']) {
        true => range.split(", ").next().unwrap_or(range),
        false => range,
    };
    if let Some(value) = range.strip_prefix('>').and_then(number) {
        return vec![("exclusiveMinimum", value)];
    }
    if let Some(value) = range.strip_prefix('≥').and_then(number) {
        return vec![("minimum", value)];
    }
    let closed = |low: &str, high: &str, open: [bool; 2]| {
        let names = [
            ["minimum", "exclusiveMinimum"],
            ["maximum", "exclusiveMaximum"],
        ];
        let values = [number(low)?, number(high)?];
        Some(
            [0, 1]
                .map(|end| (names[end][usize::from(open[end])], values[end]))
                .to_vec(),
        )
    };
    if let Some((low, high)) = range.split_once(" to ") {
        return closed(low, high, [false; 2]).unwrap_or_default();
    }
    let inner = range
        .trim_start_matches(['[', '('])
        .trim_end_matches([']', ')']);
    match inner.split_once(',') {
        Some((low, high)) if inner.len() + 2 == range.len() => {
            closed(low, high, [range.starts_with('('), range.ends_with(')')]).unwrap_or_default()
        }
        _ => Vec::new(),
    }
}

/// Whether `value` is finite and lies within the interval that a range says; `None` where it says none.
#[must_use]
pub fn holds(range: &str, value: f64) -> Option<bool> {
    let bounds = bounds(range);
    let within = |(name, bound): &(&str, f64)| match *name {
        "minimum" => value >= *bound,
        "exclusiveMinimum" => value > *bound,
        "maximum" => value <= *bound,
        _ => value < *bound,
    };
    (!bounds.is_empty()).then(|| value.is_finite() && bounds.iter().all(within))
}

/// What an error says of a value outside a range: "must be positive", "must lie in [0, 0.5)".
#[must_use]
pub fn must(range: &str) -> String {
    match (&bounds(range)[..], range.split_once(" to ")) {
        ([("exclusiveMinimum", 0.0)], _) => "must be positive".to_owned(),
        ([("minimum", 0.0)], _) => "must not be negative".to_owned(),
        ([("exclusiveMinimum", bound)], _) => format!("must be above {bound}"),
        ([("minimum", bound)], _) => format!("must be at least {bound}"),
        ([_, _], Some((low, high))) => format!("must lie in [{low}, {high}]"),
        ([_, _], None) => format!("must lie in {range}"),
        _ => format!("must be {range}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_become_bounds_and_words_none() {
        assert_eq!(
            bounds("[0, 0.5)"),
            [("minimum", 0.0), ("exclusiveMaximum", 0.5)]
        );
        assert_eq!(
            bounds("(0, 0.2]"),
            [("exclusiveMinimum", 0.0), ("maximum", 0.2)]
        );
        assert_eq!(bounds("> 0, < E"), [("exclusiveMinimum", 0.0)]);
        assert_eq!(bounds("> 0, each once"), [("exclusiveMinimum", 0.0)]);
        assert_eq!(bounds("≥ 1"), [("minimum", 1.0)]);
        assert_eq!(bounds("8 to 1000"), [("minimum", 8.0), ("maximum", 1000.0)]);
        for words in [
            "",
            "an existing file",
            "≥ the slowest",
            "of `materials`",
            "[0, 4/3)",
        ] {
            assert_eq!(bounds(words), [], "{words}");
        }
    }

    #[test]
    fn a_range_checks_what_it_says() {
        for (range, inside, outside, said) in [
            ("> 0", 1e-9, 0.0, "must be positive"),
            ("> 0, each once", 1.0, f64::INFINITY, "must be positive"),
            ("≥ 0", 0.0, -1e-9, "must not be negative"),
            ("> 1", 1.5, 1.0, "must be above 1"),
            ("≥ 2", 2.0, 1.0, "must be at least 2"),
            ("[0, 0.5)", 0.0, 0.5, "must lie in [0, 0.5)"),
            ("(0, 0.2]", 0.2, 0.0, "must lie in (0, 0.2]"),
            ("0 to 2", 2.0, f64::NAN, "must lie in [0, 2]"),
        ] {
            assert_eq!(holds(range, inside), Some(true), "{range}");
            assert_eq!(holds(range, outside), Some(false), "{range}");
            assert_eq!(must(range), said);
        }
        assert_eq!(holds("an existing file", 1.0), None);
        assert_eq!(must("an existing file"), "must be an existing file");
    }
}
