//! Diagnostic: an error as it is shown to the user, with the line of the input file it points at.

use crate::{Error, Place};
use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteDiagnostic, NamedSource, Report,
};
use std::io::IsTerminal;
use std::path::Path;

/// Text for stderr: the message, and the place in the file when the error knows it.
#[must_use]
pub fn text(error: &Error) -> String {
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let theme = if colour {
        GraphicalTheme::unicode()
    } else {
        GraphicalTheme::unicode_nocolor()
    };
    drawn(error, theme)
}

/// The same without colours, whoever reads it.
#[must_use]
pub fn plain(error: &Error) -> String {
    drawn(error, GraphicalTheme::unicode_nocolor())
}

fn drawn(error: &Error, theme: GraphicalTheme) -> String {
    let handler = GraphicalReportHandler::new_themed(theme).with_wrap_lines(false);
    let mut text = String::new();
    match handler.render_report(&mut text, report(error).as_ref()) {
        Ok(()) => text,
        Err(_) => format!("{error}\n"),
    }
}

/// Longest line that is shown: no terminal shows more, and the renderer counts columns in 16 bits.
const LONGEST_LINE: usize = 1000;

fn report(error: &Error) -> Report {
    let Some((
        path,
        Place {
            text,
            span: Some(span),
            explanation,
            ..
        },
    )) = place(error)
    else {
        return Report::new(MietteDiagnostic::new(error.to_string()));
    };
    let start = span.start.min(text.len());
    let (line, column) = line_and_column(text, start);
    if text.lines().any(|line| line.len() > LONGEST_LINE) {
        let message = format!("{error} (line {line}, column {column})");
        return Report::new(MietteDiagnostic::new(message));
    }
    let label = LabeledSpan::new(Some("here".to_owned()), start, span.len());
    let mut diagnostic = MietteDiagnostic::new(error.to_string()).with_label(label);
    if let Some(explanation) = explanation {
        diagnostic = diagnostic.with_help(explanation);
    }
    Report::new(diagnostic)
        .with_source_code(NamedSource::new(path.display().to_string(), text.clone()))
}

/// Line and column, from 1, of a byte of `text`.
fn line_and_column(text: &str, byte: usize) -> (usize, usize) {
    let before = &text.as_bytes()[..byte];
    let newline = before.iter().rposition(|b| *b == b'\n');
    let line = before.iter().filter(|b| **b == b'\n').count() + 1;
    (line, byte - newline.map_or(0, |at| at + 1) + 1)
}

fn place(error: &Error) -> Option<(&Path, &Place)> {
    match error {
        Error::Value { path, place, .. } | Error::Syntax { path, place, .. } => {
            place.as_deref().map(|place| (path.as_path(), place))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::case::Case;
    use crate::document::Document;

    #[test]
    fn the_line_of_the_file_is_shown() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("case.toml");
        std::fs::write(&path, "[particle]\nradius = \"0 um\"\n").unwrap();
        let error = Document::read(&path)
            .unwrap()
            .reject("particle.radius", "must be positive");
        let text = super::text(&error);
        assert!(text.contains("case.toml:2:10"), "{text}");
        assert!(text.contains("radius = \"0 um\""), "{text}");
    }

    #[test]
    fn a_text_that_was_read_once_is_shown_and_never_read_again() {
        let document = Document::new("/dev/stdin".as_ref(), "radius = \"0 um\"\n");
        let text = super::text(&document.reject("radius", "must be positive"));
        assert!(text.contains("/dev/stdin:1:10"), "{text}");
    }

    #[test]
    fn a_place_beyond_column_65000_is_an_ordinary_error() {
        let long = format!("blank = \"{}\"\nradius = \"0 um\"", "x".repeat(70_000));
        let document = Document::new("c.toml".as_ref(), long);
        let text = super::text(&document.reject("radius", "must be positive"));
        assert!(text.contains("(line 2, column 10)"), "{text}");
        let wide = format!("[p]{}\n", " ".repeat(70_000) + "]");
        let error = Case::parse(&wide, "c.toml".as_ref());
        let text = super::text(&error.unwrap_err());
        assert!(text.contains("line 1, column 70004"), "{text}");
    }
}
