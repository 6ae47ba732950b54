//! Mutations that know what files are made of: bits, words, numbers, lines and blocks.

use rand::RngExt;
use rand_pcg::Pcg64;

/// What a file is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Lines of words and numbers.
    Text,
    /// Bytes.
    Binary,
}

/// Numbers that readers stumble over.
const EXTREMES: [&str; 26] = [
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "0.5",
    "1e-30",
    "1e-300",
    "5e-324",
    "1e30",
    "1e300",
    "1e308",
    "-1e308",
    "1e999",
    "inf",
    "-inf",
    "nan",
    "1000000000000",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551616",
    "0.1e",
    "1_000",
    "0x10",
];

/// Bytes of numbers that readers of binary files stumble over.
const BLOCKS: [[u8; 8]; 8] = [
    [0; 8],
    [0xff; 8],
    1f64.to_le_bytes(),
    f64::NAN.to_le_bytes(),
    f64::INFINITY.to_le_bytes(),
    f64::MAX.to_le_bytes(),
    u64::MAX.to_le_bytes(),
    (1u64 << 40).to_le_bytes(),
];

/// Longest input, bytes, unless the seed itself is longer.
const LONGEST: usize = 1 << 16;

/// One of `seeds`, changed once to eight times, most often once or twice.
pub fn mutated(seeds: &[Vec<u8>], kind: Kind, random: &mut Pcg64) -> Vec<u8> {
    let mut bytes = seeds[random.random_range(0..seeds.len())].clone();
    let longest = LONGEST.max(bytes.len());
    let mut times = 1;
    while times < 8 && random.random_bool(0.5) {
        times += 1;
    }
    for _ in 0..times {
        if kind == Kind::Text && random.random_bool(0.8) {
            change_text(&mut bytes, seeds, random);
        } else {
            change_bytes(&mut bytes, seeds, random);
        }
        bytes.truncate(longest);
    }
    bytes
}

/// A place in `bytes`, its end included.
fn place(bytes: &[u8], random: &mut Pcg64) -> usize {
    random.random_range(0..=bytes.len())
}

/// A short stretch of `bytes`.
fn stretch(bytes: &[u8], random: &mut Pcg64) -> std::ops::Range<usize> {
    let start = place(bytes, random);
    let length = 1usize << random.random_range(0..8);
    start..(start + length).min(bytes.len())
}

fn change_bytes(bytes: &mut Vec<u8>, seeds: &[Vec<u8>], random: &mut Pcg64) {
    let at = place(bytes, random);
    match random.random_range(0..8) {
        0 | 1 if !bytes.is_empty() => {
            let at = at.min(bytes.len() - 1);
            bytes[at] ^= 1 << random.random_range(0..8);
        }
        2 if !bytes.is_empty() => {
            let at = at.min(bytes.len() - 1);
            bytes[at] = random.random();
        }
        3 => bytes.truncate(at),
        4 => {
            let range = stretch(bytes, random);
            bytes.drain(range);
        }
        5 => {
            let range = stretch(bytes, random);
            let copy = bytes[range].to_vec();
            bytes.splice(at..at, copy);
        }
        6 => {
            let other = &seeds[random.random_range(0..seeds.len())];
            let piece = other[stretch(other, random)].to_vec();
            bytes.splice(at..at, piece);
        }
        _ => {
            let block = BLOCKS[random.random_range(0..BLOCKS.len())];
            let width = [1, 2, 4, 8][random.random_range(0..4)];
            for (to, from) in bytes.iter_mut().skip(at).zip(&block[8 - width..]) {
                *to = *from;
            }
        }
    }
}

/// Whether a byte goes on with the word or number before it: `1e-3` is one.
fn goes_on(before: &[u8], byte: u8) -> bool {
    let word = |b: u8| b.is_ascii_alphanumeric() || b"_.".contains(&b);
    let sign = |b: u8| b"+-".contains(&b);
    match before {
        [.., last] if word(*last) && word(byte) => true,
        [first, .., b'e' | b'E'] => first.is_ascii_digit() && sign(byte),
        [first, .., b'e' | b'E', last] => first.is_ascii_digit() && sign(*last) && word(byte),
        [.., last] => *last >= 0x80 && byte >= 0x80,
        [] => false,
    }
}

/// Words, numbers and single signs, as places in the text.
fn tokens(text: &[u8]) -> Vec<std::ops::Range<usize>> {
    let mut all: Vec<std::ops::Range<usize>> = Vec::new();
    for at in 0..text.len() {
        match all.last_mut() {
            Some(last) if goes_on(&text[last.clone()], text[at]) => last.end = at + 1,
            _ => all.push(at..at + 1),
        }
    }
    all.retain(|token| text[token.start] != b' ');
    all
}

fn lines(text: &[u8]) -> Vec<std::ops::Range<usize>> {
    let mut start = 0;
    let line = |line: &[u8]| {
        let range = start..start + line.len();
        start = range.end;
        range
    };
    text.split_inclusive(|byte| *byte == b'\n')
        .map(line)
        .collect()
}

/// A number `text` made larger or smaller, or an extreme one.
fn other_number(text: &[u8], random: &mut Pcg64) -> Vec<u8> {
    let value: Option<f64> = std::str::from_utf8(text).ok().and_then(|t| t.parse().ok());
    match (value, random.random_range(0..3)) {
        (Some(value), 0) => {
            let factor = 10f64.powi(random.random_range(-12..=12));
            format!("{:e}", value * factor).into_bytes()
        }
        (Some(value), 1) => format!("{}", -value).into_bytes(),
        _ => EXTREMES[random.random_range(0..EXTREMES.len())].into(),
    }
}

fn change_text(text: &mut Vec<u8>, seeds: &[Vec<u8>], random: &mut Pcg64) {
    let all = match random.random_range(0..10) {
        0..8 => tokens(text),
        _ => lines(text),
    };
    if all.is_empty() {
        return;
    }
    let one = all[random.random_range(0..all.len())].clone();
    let two = all[random.random_range(0..all.len())].clone();
    let numbers: Vec<_> = all
        .iter()
        .filter(|token| text[token.start].is_ascii_digit())
        .collect();
    match random.random_range(0..8) {
        // as often as all others together: most keys hold numbers
        0..4 if !numbers.is_empty() => {
            let number = numbers[random.random_range(0..numbers.len())].clone();
            let other = other_number(&text[number.clone()], random);
            text.splice(number, other);
        }
        4 => {
            let copy = text[one].to_vec();
            text.splice(two, copy);
        }
        5 => {
            let copy = text[one].to_vec();
            text.splice(two.start..two.start, copy);
        }
        6 => {
            text.drain(one);
        }
        _ => {
            let other = &seeds[random.random_range(0..seeds.len())];
            let words = tokens(other);
            if !words.is_empty() {
                let word = words[random.random_range(0..words.len())].clone();
                text.splice(one, other[word].to_vec());
            }
        }
    }
}

#[test]
fn mutations_are_many_short_and_always_the_same() {
    use rand::SeedableRng;
    let seeds = [b"a = 1\nlist = [\"250 um\", 2e-3]\n".to_vec()];
    let made = |seed| mutated(&seeds, Kind::Text, &mut Pcg64::seed_from_u64(seed));
    let all: std::collections::BTreeSet<Vec<u8>> = (0..1000).map(made).collect();
    assert!(all.len() > 700, "{}", all.len());
    assert!(all.iter().all(|bytes| bytes.len() <= LONGEST));
    assert_eq!(made(5), made(5));
}

#[test]
fn tokens_are_words_numbers_and_signs() {
    let text = b"ab = [1.5e-3, \"2 um\"]";
    let words: Vec<&str> = tokens(text)
        .into_iter()
        .map(|t| std::str::from_utf8(&text[t]).unwrap())
        .collect();
    assert_eq!(
        words,
        ["ab", "=", "[", "1.5e-3", ",", "\"", "2", "um", "\"", "]"]
    );
}
