//! Document: a TOML input file with its text, and errors that point into it.

pub mod keys;
pub(crate) mod misfit;
pub(crate) mod range;
pub mod reference;
pub(crate) mod schema;
mod words;

use self::words::in_plain_words;
use crate::files::sha256;
use crate::unit::Quantity;
use crate::{Error, Place, Result};
use serde::de::DeserializeOwned;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use toml::de::{DeTable, DeValue};

/// TOML input file: path for messages, text for spans and the hash.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Document {
    path: PathBuf,
    text: String,
    reader: Reader,
}

/// What reads a document, once something did: it knows what the keys mean. Not part of what a document is.
#[derive(Debug, Clone, Default)]
struct Reader(OnceLock<fn() -> keys::Kind>);

impl PartialEq for Reader {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Reader {}

impl Document {
    /// Read a file.
    ///
    /// # Errors
    /// [`Error::File`] when it cannot be read or is not UTF-8.
    pub fn read(path: &Path) -> Result<Self> {
        let text = crate::files::read_text(path)?;
        Ok(Self::new(path, text))
    }

    /// A text that was, or could have been, read from `path`.
    #[must_use]
    pub fn new(path: &Path, text: impl Into<String>) -> Self {
        Document {
            path: path.to_owned(),
            text: text.into(),
            reader: Reader::default(),
        }
    }

    /// File name for messages and for resolving what the file names.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The text as it stands in the file.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The file's name without extension; what outputs are named after.
    #[must_use]
    pub fn name(&self) -> String {
        self.path
            .file_stem()
            .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
    }

    /// SHA-256 of the text, hexadecimal: provenance of everything made from the file.
    #[must_use]
    pub fn hash(&self) -> String {
        sha256([&self.text])
    }

    /// A file named in this one: relative names are meant from this file's folder.
    #[must_use]
    pub fn resolve(&self, name: &str) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(name)
    }

    /// Notes what the text is read as, for errors that come before [`Document::parse`].
    pub fn read_as<T: keys::Value>(&self) {
        self.reader.0.get_or_init(|| T::kind);
    }

    /// Deserialise into a struct that mirrors the file.
    ///
    /// # Errors
    /// [`Error::Syntax`] with the key and its span: not TOML, unknown or missing key, wrong type, bad quantity.
    pub fn parse<T: DeserializeOwned + keys::Value>(&self) -> Result<T> {
        self.read_as::<T>();
        toml::from_str(&self.text).map_err(|error| {
            let span = error.span();
            let message = in_plain_words(&error.message().trim_end().replace('\n', "; "));
            let missing = message.starts_with("missing field");
            // what the whole file lacks belongs at its end, not to the table it begins with
            let whole = |span: &Range<usize>| span.start == 0 || span.end >= self.text.len();
            let (span, key) = match span {
                Some(span) if missing && !self.is_table(&span) && whole(&span) => {
                    (Some(self.text.len()..self.text.len()), None)
                }
                span => {
                    let key = span.as_ref().and_then(|span| self.key_at(span));
                    (span, key)
                }
            };
            // what is missing is explained, not the table that lacks it
            let lacking = message.split('`').nth(1).filter(|_| missing);
            let about = match (&key, lacking) {
                (Some(table), Some(lacking)) => Some(format!("{table}.{lacking}")),
                (None, Some(lacking)) => Some(lacking.to_owned()),
                (key, None) => key.clone(),
            };
            Error::Syntax {
                path: self.path.clone(),
                place: Some(self.place(span, about.as_deref())),
                message: match key {
                    Some(key) => format!("`{key}`: {message}"),
                    None => message,
                },
            }
        })
    }

    /// Error about the value of `key` (dotted, `impact.velocities[2]` for an array item); what the file says is
    /// looked up.
    ///
    /// ```
    /// use impactlaw::document::Document;
    /// let document = Document::new("a.toml".as_ref(), "[particle]\nradius = \"0 um\"");
    /// let error = document.reject("particle.radius", "must be positive");
    /// assert_eq!(error.to_string(), "a.toml: `particle.radius`: found \"0 um\"; must be positive");
    /// ```
    #[must_use]
    pub fn reject(&self, key: &str, allowed: impl Into<String>) -> Error {
        let span = self.span_of(key);
        let found = span
            .clone()
            .and_then(|span| self.text.get(span))
            .map_or_else(|| "nothing".to_owned(), |text| text.trim().to_owned());
        Error::Value {
            path: self.path.clone(),
            key: key.to_owned(),
            found,
            allowed: allowed.into(),
            place: Some(self.place(span, Some(key))),
        }
    }

    /// A place in the text, with what the reference says of the key that stands there.
    fn place(&self, span: Option<Range<usize>>, key: Option<&str>) -> Box<Place> {
        let explained = || {
            let root = self.reader.0.get()?();
            let key = root.at(key?)?;
            Some(format!("{}: {}", key.name, reference::sentence(key)))
        };
        let reader = match self.reader.0.get().map(|kind| kind()) {
            Some(keys::Kind::Table(table)) => table.names(),
            _ => Vec::new(),
        };
        Box::new(Place {
            text: self.text.clone(),
            span,
            explanation: explained(),
            reader,
        })
    }

    /// `value` if `holds`.
    ///
    /// # Errors
    /// [`Error::Value`] saying that `key` `must` ("must lie in [0, 0.5)").
    pub fn check(
        &self,
        key: &str,
        value: f64,
        holds: impl Fn(f64) -> bool,
        must: &str,
    ) -> Result<f64> {
        if value.is_finite() && holds(value) {
            Ok(value)
        } else {
            Err(self.reject(key, must))
        }
    }

    /// `value`, if it lies in the interval that the line of `key` states.
    ///
    /// # Errors
    /// [`Error::Value`] saying what that interval is, or that the line states none.
    pub fn within(&self, key: &str, value: f64) -> Result<f64> {
        let range = self.range(key);
        match range::holds(range, value) {
            Some(true) => Ok(value),
            Some(false) => Err(self.reject(key, range::must(range))),
            None => Err(self.reject(key, "has no interval in its line")),
        }
    }

    /// What an error says of a value of `key` that its line does not allow.
    #[must_use]
    pub fn must(&self, key: &str) -> String {
        range::must(self.range(key))
    }

    /// Range in the line of `key`; empty where nothing has read the document yet.
    fn range(&self, key: &str) -> &'static str {
        let root = self.reader.0.get().map(|kind| kind());
        root.and_then(|root| root.at(key).map(|key| key.line.range))
            .unwrap_or_default()
    }

    /// SI value of a quantity that has to be positive.
    ///
    /// # Errors
    /// [`Error::Value`] when it is not.
    pub fn positive<D>(&self, key: &str, quantity: Quantity<D>) -> Result<f64> {
        self.check(key, quantity.si(), |v| v > 0.0, "must be positive")
    }

    /// SI value of a quantity that may be zero but not negative.
    ///
    /// # Errors
    /// [`Error::Value`] when it is negative.
    pub fn non_negative<D>(&self, key: &str, quantity: Quantity<D>) -> Result<f64> {
        self.check(key, quantity.si(), |v| v >= 0.0, "must not be negative")
    }

    /// Whether a table, not the file as a whole, stands at exactly this place.
    fn is_table(&self, place: &Range<usize>) -> bool {
        let mut found = false;
        if let Ok(table) = DeTable::parse(&self.text) {
            visit_table(table.get_ref(), "", &mut |_, span, key_span| {
                found |= span == *place || key_span == *place;
            });
        }
        found
    }

    /// Byte range of the value of a dotted key.
    fn span_of(&self, key: &str) -> Option<Range<usize>> {
        let table = DeTable::parse(&self.text).ok()?;
        let mut found = None;
        visit_table(table.get_ref(), "", &mut |path, span, _| {
            if path == key {
                found = Some(span);
            }
        });
        found
    }

    /// Dotted key of the smallest value, or of the key, that holds `place`.
    fn key_at(&self, place: &Range<usize>) -> Option<String> {
        let table = DeTable::parse(&self.text).ok()?;
        let mut best: Option<(usize, String)> = None;
        visit_table(table.get_ref(), "", &mut |path, span, key_span| {
            for range in [span, key_span] {
                let inside = range.start <= place.start && place.end <= range.end;
                if inside && best.as_ref().is_none_or(|(size, _)| range.len() < *size) {
                    best = Some((range.len(), path.to_owned()));
                }
            }
        });
        best.map(|(_, path)| path)
    }
}

/// Called with the dotted key, the span of its value and the span of the key itself.
type Visit<'a> = &'a mut dyn FnMut(&str, Range<usize>, Range<usize>);

fn visit_table(table: &DeTable, prefix: &str, visit: Visit) {
    for (key, value) in table {
        let path = match prefix {
            "" => key.get_ref().to_string(),
            _ => format!("{prefix}.{}", key.get_ref()),
        };
        visit(&path, value.span(), key.span());
        visit_value(value.get_ref(), &path, visit);
    }
}

fn visit_value(value: &DeValue, path: &str, visit: Visit) {
    match value {
        DeValue::Table(table) => visit_table(table, path, visit),
        DeValue::Array(items) => {
            for (i, item) in items.iter().enumerate() {
                let path = format!("{path}[{i}]");
                visit(&path, item.span(), item.span());
                visit_value(item.get_ref(), &path, visit);
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::keys::{key, keys, table};
    use super::*;
    use crate::unit::{Length, Velocity};
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code)] // fields are only parsed, to see where errors are found
    struct File {
        particle: Particle,
        #[serde(default)]
        speeds: Vec<Quantity<Velocity>>,
        shape: Option<Shape>,
    }

    keys! {
        File {
            particle: table("the particle"),
            speeds: key("speeds", "> 0", "['1 m/s']").or("none"),
            shape: table("its shape").or("none"),
        }
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code)] // as above
    struct Particle {
        radius: Quantity<Length>,
    }

    keys! {
        Particle {
            radius: key("radius of the sphere", "> 0", "'250 um'"),
        }
    }

    #[derive(Debug, Deserialize)]
    #[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
    #[allow(dead_code)] // as above
    enum Shape {
        Ball { radius: Quantity<Length> },
        Cube { edge: Quantity<Length> },
    }

    keys! {
        enum Shape by "kind" {
            Ball as "ball" "A ball." {
                radius: key("radius", "> 0", "'1 m'"),
            }
            Cube as "cube" "A cube." {
                edge: key("edge", "> 0", "'1 m'"),
            }
        } and {
        }
    }

    #[test]
    fn an_error_explains_its_key_and_one_about_no_key_does_not() {
        let explanation = |text: &str| {
            let document = Document::new(Path::new("f.toml"), text);
            let error = match document.parse::<File>() {
                Ok(_) => document.reject("particle.radius", "must be positive"),
                Err(error) => error,
            };
            let (Error::Syntax { place, .. } | Error::Value { place, .. }) = error else {
                panic!("{error:?}")
            };
            place.and_then(|place| place.explanation)
        };
        let radius = "radius: radius of the sphere; length, > 0, required, e.g. \"250 um\"";
        for text in ["[particle]\nradius = 3\n", "[particle]\nradius = \"0 m\"\n"] {
            assert_eq!(explanation(text).as_deref(), Some(radius), "{text}");
        }
        let ball =
            explanation("[particle]\nradius = \"1 m\"\n[shape]\nkind = \"ball\"\nradius = 1\n");
        assert!(ball.is_none() || ball.unwrap().contains("shape"));
        assert_eq!(explanation("[particle]\nradus = 3\n"), None);
        assert_eq!(explanation("[particle]\n").as_deref(), Some(radius));
    }

    fn message(text: &str) -> (String, Option<Range<usize>>) {
        let error = Document::new(Path::new("f.toml"), text)
            .parse::<File>()
            .unwrap_err();
        let Error::Syntax { message, place, .. } = error else {
            panic!("{error:?}")
        };
        (message, place.and_then(|place| place.span))
    }

    #[test]
    fn a_bad_quantity_names_key_found_and_allowed() {
        let (text, span) = message("[particle]\nradius = \"3 kg\"\n");
        let said = "`particle.radius`: found \"3 kg\"; must be a length with its unit, e.g. \"250 um\" (units: nm,";
        assert!(text.starts_with(said), "{text}");
        assert_eq!(span, Some(20..26));
        let (text, _) = message("[particle]\nradius = 3\n");
        assert!(
            text.starts_with("`particle.radius`: invalid type: integer `3`"),
            "{text}"
        );
        let (text, _) = message("speeds = [\"1 m/s\", \"2\"]\n[particle]\nradius = \"1 m\"");
        assert!(text.starts_with("`speeds[1]`: found \"2\""), "{text}");
    }

    #[test]
    fn unknown_and_missing_keys_are_named() {
        let (text, _) = message("[particle]\nradus = \"3 m\"\n");
        assert!(
            text.starts_with("`particle.radus`: unknown field `radus`, expected `radius`"),
            "{text}"
        );
        let (text, _) = message("[particle]\n");
        assert!(text.contains("missing field `radius`"), "{text}");
        let (text, _) = message("[particle\n");
        assert!(!text.is_empty());
    }

    #[test]
    fn a_missing_table_is_missed_at_the_end_and_not_blamed_on_the_first_one() {
        let text = "speeds = [\"1 m/s\"]\n";
        let (message, place) = message(text);
        assert_eq!(message, "missing field `particle`");
        assert_eq!(place, Some(text.len()..text.len()));
        let text = "[shape]\nkind = \"ball\"\nradius = \"1 m\"\n";
        let (message, place) = super::tests::message(text);
        assert_eq!(message, "missing field `particle`");
        assert_eq!(place, Some(text.len()..text.len()));
    }

    #[test]
    fn messages_hold_no_names_of_types() {
        for (text, said) in [
            (
                "particle = 3\n",
                "`particle`: invalid type: integer `3`, expected a table",
            ),
            (
                "speeds = 3\n",
                "`speeds`: invalid type: integer `3`, expected a list, [...]",
            ),
            (
                "[particle]\nradius = \"1 m\"\n[shape]\nkind = 3\nradius = \"1 m\"\n",
                "`shape",
            ),
        ] {
            let (message, _) = message(text);
            assert!(message.starts_with(said), "{message}");
            for name in ["struct", "enum", "File", "Particle", "Shape", "f64"] {
                assert!(!message.contains(name), "{message}");
            }
        }
    }

    #[test]
    fn quantities_work_inside_tagged_enums() {
        let good = "[particle]\nradius = \"1 m\"\n[shape]\nkind = \"ball\"\nradius = ";
        assert!(
            Document::new(Path::new("f"), format!("{good}\"2 m\""))
                .parse::<File>()
                .is_ok()
        );
        let (text, _) = message(&format!("{good}\"2 s\""));
        assert!(text.contains("found \"2 s\"; must be a length"), "{text}");
    }

    #[test]
    fn array_items_are_found_by_index() {
        let document = Document::new(Path::new("f.toml"), "speeds = [\"1 m/s\", \"0 m/s\"]");
        let text = document.reject("speeds[1]", "must be positive").to_string();
        assert_eq!(
            text,
            "f.toml: `speeds[1]`: found \"0 m/s\"; must be positive"
        );
    }
}
