//! Text of the files that people write: UTF-8 with or without a byte-order mark; of anything else it is said what it is.

use crate::{Error, Result};
use std::path::Path;

/// Text of a file.
///
/// # Errors
/// [`Error::File`] when it cannot be read, is UTF-16, or is not UTF-8 in some line.
pub fn read_text(path: &Path) -> Result<String> {
    let bytes = std::fs::read(path).map_err(Error::file("read", path))?;
    text(bytes, path)
}

/// Text in `bytes` of the file `path`.
///
/// # Errors
/// [`Error::File`] when they are UTF-16 or are not UTF-8 in some line.
pub fn text(bytes: Vec<u8>, path: &Path) -> Result<String> {
    let is_not = |what: String| {
        let cause = std::io::Error::new(std::io::ErrorKind::InvalidData, what);
        Err(Error::file("read", path)(cause))
    };
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return is_not("it is text in UTF-16; save it as UTF-8".to_owned());
    }
    match String::from_utf8(bytes) {
        Ok(text) => Ok(match text.strip_prefix('\u{feff}') {
            Some(text) => text.to_owned(),
            None => text,
        }),
        Err(error) => {
            let (good, rest) = error.as_bytes().split_at(error.utf8_error().valid_up_to());
            let line = 1 + good.iter().filter(|byte| **byte == b'\n').count();
            let byte = rest.first().copied().unwrap_or_default();
            is_not(format!(
                "line {line} is not UTF-8 (byte 0x{byte:02x}); save the file as UTF-8"
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8]) -> std::result::Result<String, String> {
        text(bytes.to_vec(), Path::new("a.csv")).map_err(|error| error.to_string())
    }

    #[test]
    fn a_mark_is_left_out_and_what_is_not_utf_8_is_told_by_line() {
        assert_eq!(read("\u{feff}a = \"µ\"".as_bytes()).unwrap(), "a = \"µ\"");
        let sixteen: Vec<u8> = "\u{feff}a,b\n"
            .encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect();
        assert_eq!(
            read(&sixteen).unwrap_err(),
            "cannot read a.csv: it is text in UTF-16; save it as UTF-8"
        );
        assert_eq!(
            read(b"a\n1 \xb5m\n").unwrap_err(),
            "cannot read a.csv: line 2 is not UTF-8 (byte 0xb5); save the file as UTF-8"
        );
    }
}
