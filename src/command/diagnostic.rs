//! Diagnostic: an error as it is shown to the user, with the line of the input file it points at.

use crate::Error;
use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteDiagnostic, NamedSource, Report,
};
use std::io::IsTerminal;
use std::ops::Range;
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
    let handler = GraphicalReportHandler::new_themed(theme).with_wrap_lines(false);
    let mut text = String::new();
    match handler.render_report(&mut text, report(error).as_ref()) {
        Ok(()) => text,
        Err(_) => format!("{error}\n"),
    }
}

fn report(error: &Error) -> Report {
    let message = MietteDiagnostic::new(error.to_string());
    let Some((path, span)) = place(error) else {
        return Report::new(message);
    };
    let Ok(source) = std::fs::read_to_string(path) else {
        return Report::new(message);
    };
    let label = LabeledSpan::new(Some("here".to_owned()), span.start, span.len());
    Report::new(message.with_label(label))
        .with_source_code(NamedSource::new(path.display().to_string(), source))
}

fn place(error: &Error) -> Option<(&Path, &Range<usize>)> {
    match error {
        Error::Value { path, span, .. } | Error::Syntax { path, span, .. } => {
            span.as_ref().map(|span| (path.as_path(), span))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
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
}
