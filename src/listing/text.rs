//! Text of a file of grains, and its numbers.

/// The text with lines that end in a line feed, whatever ended them; no byte-order mark.
///
/// # Errors
/// That it is no text.
pub(super) fn text(bytes: &[u8]) -> Result<String, String> {
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err("is text in UTF-16; save it as UTF-8".to_owned());
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.contains(&0) {
        return Err("is binary, and a text was expected; look at `format`".to_owned());
    }
    let text = String::from_utf8_lossy(bytes);
    Ok(text.replace("\r\n", "\n").replace('\r', "\n"))
}

/// A finite number in line `line` under the heading `what`.
///
/// # Errors
/// What was found there, and what is allowed.
pub(super) fn number(word: &str, what: &str, line: usize) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(format!(
            "line {line}: found `{word}` for `{what}`; must be a finite number"
        )),
        Err(_) if word.replacen(',', ".", 1).parse::<f64>().is_ok() => Err(format!(
            "line {line}: found `{word}` for `{what}`; must have a decimal point, no comma"
        )),
        Err(_) => Err(format!(
            "line {line}: found `{}` for `{what}`; must be a number",
            short(word)
        )),
    }
}

/// A whole number in line `line`.
///
/// # Errors
/// As [`number`].
pub(super) fn count(word: &str, what: &str, line: usize) -> Result<usize, String> {
    word.parse().map_err(|_| {
        format!(
            "line {line}: found `{}` for {what}; must be a whole number that is not negative",
            short(word)
        )
    })
}

/// The beginning of a word that may be long.
pub(super) fn short(word: &str) -> String {
    match word.char_indices().nth(40) {
        Some((end, _)) => format!("{}...", &word[..end]),
        None => word.to_owned(),
    }
}
