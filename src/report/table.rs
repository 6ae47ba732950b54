//! Table: columns of text and numbers, as HTML.

use super::markup::escape;
use std::fmt::Write;

/// Cells with more characters than this wrap, so that a formula does not push the columns after it off the page.
const LONG: usize = 36;

/// A table; cells are text as it is to be read.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// What the table shows.
    pub caption: String,
    /// Column names with units.
    pub head: Vec<String>,
    /// Rows of as many cells.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// Table from a caption and column names.
    #[must_use]
    pub fn new(caption: &str, head: &[&str]) -> Self {
        Table {
            caption: caption.to_owned(),
            head: head.iter().map(|&name| name.to_owned()).collect(),
            rows: Vec::new(),
        }
    }

    /// Tables of a Markdown text; the heading above each becomes its caption.
    #[must_use]
    pub fn in_markdown(text: &str) -> Vec<Self> {
        let mut tables: Vec<Table> = Vec::new();
        let (mut heading, mut inside) = (String::new(), false);
        for line in text.lines() {
            if let Some(title) = line.strip_prefix('#') {
                heading = title.trim_start_matches('#').trim().to_owned();
            }
            let Some(row) = line.strip_prefix('|') else {
                inside = false;
                continue;
            };
            let row = row.strip_suffix('|').unwrap_or(row);
            let cells: Vec<String> = row.split('|').map(|cell| cell.trim().to_owned()).collect();
            match tables.last_mut().filter(|_| inside) {
                None => tables.push(Table {
                    caption: heading.clone(),
                    head: cells,
                    rows: Vec::new(),
                }),
                Some(_) if row.chars().all(|c| "-:| ".contains(c)) => {}
                Some(table) => table.rows.push(cells),
            }
            inside = true;
        }
        tables
    }

    /// HTML; numbers stand to the right, text to the left, by what the column holds.
    #[must_use]
    pub fn html(&self) -> String {
        let mut html = String::new();
        if !self.caption.is_empty() {
            // Beside the table, not in it: it must wrap where the table is scrolled.
            let _ = writeln!(html, "<p class=\"caption\">{}</p>", escape(&self.caption));
        }
        html.push_str("<div class=\"wide\"><table>\n");
        let classes: Vec<&str> = (0..self.head.len())
            .map(|column| {
                if self.is_numeric(column) {
                    " class=\"n\""
                } else {
                    ""
                }
            })
            .collect();
        html.push_str("<thead><tr>");
        for (name, class) in self.head.iter().zip(&classes) {
            let _ = write!(html, "<th scope=\"col\"{class}>{}</th>", escape(name));
        }
        html.push_str("</tr></thead>\n<tbody>\n");
        for row in &self.rows {
            html.push_str("<tr>");
            for (cell, class) in row.iter().zip(&classes) {
                let class = match cell.chars().count() > LONG {
                    true => " class=\"long\"",
                    false => class,
                };
                let _ = write!(html, "<td{class}>{}</td>", escape(cell));
            }
            html.push_str("</tr>\n");
        }
        html.push_str("</tbody></table></div>\n");
        html
    }

    /// Whether every cell of a column starts like a number, or is empty or a dash.
    fn is_numeric(&self, column: usize) -> bool {
        self.rows
            .iter()
            .filter_map(|row| row.get(column))
            .all(|cell| {
                let digits = cell.trim_start_matches(['-', '\u{2212}', '+', '<', '≤', '±']);
                cell.is_empty() || cell == "–" || digits.starts_with(|c: char| c.is_ascii_digit())
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_found_in_markdown() {
        let text =
            "# A\n\n## B\n\n| x | y |\n|---|--:|\n| 1 | 2 |\n\ntext\n\n| z |\n|---|\n| 3 |\n";
        let tables = Table::in_markdown(text);
        assert_eq!(tables.len(), 2);
        assert_eq!(tables[0].caption, "B");
        assert_eq!(tables[0].head, ["x", "y"]);
        assert_eq!(tables[0].rows, [["1", "2"]]);
        assert_eq!(tables[1].rows, [["3"]]);
    }

    #[test]
    fn numbers_stand_right_and_text_left() {
        let mut table = Table::new("", &["law", "e"]);
        table.rows.push(vec!["Hertz".to_owned(), "1".to_owned()]);
        table.rows.push(vec!["a<b".to_owned(), "–".to_owned()]);
        let html = table.html();
        assert!(
            html.contains("<td>Hertz</td><td class=\"n\">1</td>"),
            "{html}"
        );
        assert!(html.contains("<td>a&lt;b</td>"), "{html}");
    }
}
