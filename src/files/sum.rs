//! Sums: JSON files that carry a digest of themselves and of the files beside them, so that damage is told from data.

use serde::Serialize;
use sha2::{Digest, Sha256};

/// Key of the sum, the last one of its file.
const KEY: &str = "\"sha256\": \"";
/// Digits of a sum.
const DIGITS: usize = 64;

/// What a file says of itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sum {
    /// It is as it was written.
    Fits,
    /// It carries no sum.
    Absent,
    /// It, or a file beside it, has changed since.
    Differs,
}

/// `value`, a JSON object, with the sum of its text and of what stands in the files `beside`.
///
/// # Errors
/// Those of turning the value into JSON.
pub fn with_sum<T: Serialize>(value: &T, beside: &[u8]) -> serde_json::Result<String> {
    let object = serde_json::to_string_pretty(value)?;
    let open = object.strip_suffix("\n}").unwrap_or("{");
    let [before, after] = [format!("{open},\n  {KEY}"), "\"\n}\n".to_owned()];
    let sum = digest(&before, &after, beside);
    Ok(before + &sum + &after)
}

/// Whether the sum in `text` is that of the text and of `beside`.
#[must_use]
pub fn sum_of(text: &str, beside: &[u8]) -> Sum {
    let Some((before, rest)) = text.rsplit_once(KEY) else {
        return Sum::Absent;
    };
    let before = format!("{before}{KEY}");
    match rest.split_at_checked(DIGITS) {
        Some((sum, after)) if digest(&before, after, beside) == sum => Sum::Fits,
        _ => Sum::Differs,
    }
}

fn digest(before: &str, after: &str, beside: &[u8]) -> String {
    let parts = [before.as_bytes(), after.as_bytes(), beside];
    // with its length, so that nothing moves from one part to the next
    let lengths = parts.map(|part| (part.len() as u64).to_le_bytes());
    sha256((0..3).flat_map(|k| [&lengths[k][..], parts[k]]))
}

/// SHA-256 of what stands in the parts, one after the other, hexadecimal.
#[must_use]
pub fn sha256<P: AsRef<[u8]>>(parts: impl IntoIterator<Item = P>) -> String {
    let mut sum = Sha256::new();
    for part in parts {
        sum.update(part);
    }
    let bytes = sum.finalize();
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn no_flipped_bit_fits() {
        let value = BTreeMap::from([("a", 1.5), ("b", -2e-7)]);
        let text = with_sum(&value, b"beside").unwrap();
        assert_eq!(sum_of(&text, b"beside"), Sum::Fits);
        assert_eq!(sum_of(&text, b"besides"), Sum::Differs);
        assert_eq!(sum_of("{\n  \"a\": 1.5\n}", b""), Sum::Absent);
        let back: BTreeMap<String, serde_json::Value> = serde_json::from_str(&text).unwrap();
        assert_eq!(back["b"].as_f64(), Some(-2e-7));
        let key = text.rfind(KEY).unwrap();
        for bit in 0..8 * text.len() {
            let mut bytes = text.clone().into_bytes();
            bytes[bit / 8] ^= 1 << (bit % 8);
            let Ok(flipped) = String::from_utf8(bytes) else {
                continue;
            };
            // a flip in the key takes the sum away, and leaves every figure as it was
            let in_key = (key..key + KEY.len()).contains(&(bit / 8));
            let expected = if in_key { Sum::Absent } else { Sum::Differs };
            assert_eq!(sum_of(&flipped, b"beside"), expected, "bit {bit}");
        }
    }
}
