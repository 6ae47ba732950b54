//! Tables: a header and rows, their values apart by commas, semicolons, tabs or blanks.

use super::columns::Columns;
use super::text::text;
use super::{Listing, Meaning};

pub(super) fn read(bytes: &[u8], meaning: &Meaning) -> Result<Listing, String> {
    let text = text(bytes)?;
    let mut listing = Listing::default();
    let mut columns: Option<(Columns, Option<u8>)> = None;
    for (index, line) in text.lines().enumerate() {
        if line.trim().is_empty() || line.trim_start().starts_with('#') {
            continue;
        }
        let at = index + 1;
        match &columns {
            None => {
                let between = [b',', b';', b'\t'];
                let between = between
                    .into_iter()
                    .find(|&byte| line.as_bytes().contains(&byte));
                let names = values(line, between, at)?;
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                if names.iter().any(|name| name.parse::<f64>().is_ok()) {
                    return Err(format!(
                        "line {at}: found numbers where the names of the columns should be; must begin with a header, e.g. `x,y,z,radius`"
                    ));
                }
                let columns_here = Columns::new(&names, meaning, None, &mut listing)?;
                columns = Some((columns_here, between));
            }
            Some((columns, between)) => {
                let words = values(line, *between, at)?;
                let words: Vec<&str> = words.iter().map(String::as_str).collect();
                let grain = columns.grain(&words, at, &mut listing)?;
                listing.grains.push(grain);
            }
        }
    }
    Ok(listing)
}

/// Values of a line, quotes taken off.
fn values(line: &str, between: Option<u8>, at: usize) -> Result<Vec<String>, String> {
    let Some(between) = between else {
        return Ok(line.split_whitespace().map(str::to_owned).collect());
    };
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(between)
        .trim(csv::Trim::All)
        .from_reader(line.as_bytes());
    let mut record = csv::StringRecord::new();
    match reader.read_record(&mut record) {
        Ok(_) => Ok(record.iter().map(str::to_owned).collect()),
        Err(error) => Err(format!("line {at}: is no row of values: {error}")),
    }
}
