//! Page: one HTML file that needs nothing else; sections of text, tables, figures and pictures.

use super::chart::{Entry, Mark};
use super::figure::Figure;
use super::markup::{escape, png_url};
use super::table::Table;
use crate::Result;
use crate::files::write_atomic;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// A page: title, one paragraph that says what came out, sections.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Page {
    /// Title.
    pub title: String,
    /// What came out, in a sentence or two.
    pub summary: String,
    /// Sections in order; empty ones are left out.
    pub sections: Vec<Section>,
    /// Last line: what made the page.
    pub colophon: String,
}

/// Part of a page under one heading.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Heading.
    pub title: String,
    /// Content in order.
    pub blocks: Vec<Block>,
}

/// Piece of a section.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// Names and values side by side.
    Facts(Vec<(String, String)>),
    /// A table.
    Table(Table),
    /// Tables that are shown when the line is clicked.
    Folded(String, Vec<Table>),
    /// Figures, side by side where there is room.
    Figures(Vec<Figure>),
    /// PNG picture with its caption.
    Picture {
        /// The file's bytes.
        png: Vec<u8>,
        /// What it shows.
        caption: String,
    },
    /// Items of a list.
    List(Vec<String>),
    /// Text as it stands in a file or on the command line.
    Code(String),
}

const STYLE: &str = include_str!("style.css");

impl Section {
    /// Empty section.
    #[must_use]
    pub fn new(title: &str) -> Self {
        Section {
            title: title.to_owned(),
            blocks: Vec::new(),
        }
    }

    /// With one block more.
    #[must_use]
    pub fn with(mut self, block: Block) -> Self {
        if !block.is_empty() {
            self.blocks.push(block);
        }
        self
    }

    /// Name of the section in links.
    fn anchor(&self) -> String {
        self.title
            .to_lowercase()
            .replace(|c: char| !c.is_alphanumeric(), "-")
    }
}

impl Block {
    fn is_empty(&self) -> bool {
        match self {
            Block::Text(text) | Block::Code(text) => text.is_empty(),
            Block::Facts(facts) => facts.is_empty(),
            Block::Table(table) => table.rows.is_empty(),
            Block::Folded(_, tables) => tables.is_empty(),
            Block::Figures(figures) => figures.is_empty(),
            Block::Picture { png, .. } => png.is_empty(),
            Block::List(items) => items.is_empty(),
        }
    }

    fn write_html(&self, html: &mut String) -> std::fmt::Result {
        match self {
            Block::Text(text) => writeln!(html, "<p>{}</p>", escape(text)),
            Block::Facts(facts) => {
                html.push_str("<dl>\n");
                for (name, value) in facts {
                    writeln!(html, "<dt>{}</dt><dd>{}</dd>", escape(name), escape(value))?;
                }
                writeln!(html, "</dl>")
            }
            Block::Table(table) => write!(html, "{}", table.html()),
            Block::Folded(line, tables) => {
                writeln!(html, "<details><summary>{}</summary>", escape(line))?;
                for table in tables {
                    html.push_str(&table.html());
                }
                writeln!(html, "</details>")
            }
            Block::Figures(figures) => {
                write_legend(html, figures)?;
                html.push_str("<div class=\"figures\">\n");
                for figure in figures {
                    let caption = escape(&figure.caption);
                    writeln!(
                        html,
                        "<figure>{}<figcaption>{caption}</figcaption></figure>",
                        figure.bare
                    )?;
                }
                writeln!(html, "</div>")
            }
            Block::Picture { png, caption } => {
                let (url, caption) = (png_url(png), escape(caption));
                writeln!(
                    html,
                    "<figure><img src=\"{url}\" alt=\"{caption}\"><figcaption>{caption}</figcaption></figure>"
                )
            }
            Block::List(items) => {
                html.push_str("<ul>\n");
                for item in items {
                    writeln!(html, "<li>{}</li>", escape(item))?;
                }
                writeln!(html, "</ul>")
            }
            Block::Code(text) => writeln!(html, "<pre><code>{}</code></pre>", escape(text)),
        }
    }
}

/// One legend for all figures side by side: every name once.
fn write_legend(html: &mut String, figures: &[Figure]) -> std::fmt::Result {
    let all = || figures.iter().flat_map(|figure| &figure.legend);
    let mut entries: Vec<&Entry> = Vec::new();
    for entry in all() {
        if !entries.iter().any(|other| other.label == entry.label) {
            entries.push(entry);
        }
    }
    if entries.is_empty() {
        return Ok(());
    }
    html.push_str("<ul class=\"legend\">\n");
    for entry in entries {
        let [r, g, b] = entry.ink.colour;
        let shape = match (entry.mark, entry.ink.dash) {
            (Mark::Points, _) => {
                format!("<circle cx=\"17\" cy=\"6\" r=\"4.5\" fill=\"#{r:02x}{g:02x}{b:02x}\"/>")
            }
            (Mark::Line, dash) => {
                let dash = dash.map_or_else(String::new, |(dash, gap)| {
                    format!(" stroke-dasharray=\"{dash} {gap}\"")
                });
                format!(
                    "<path d=\"M1 6h32\" stroke=\"#{r:02x}{g:02x}{b:02x}\" stroke-width=\"{}\"{dash}/>",
                    entry.ink.width
                )
            }
        };
        let label = escape(&entry.label);
        writeln!(
            html,
            "<li><svg width=\"34\" height=\"12\" viewBox=\"0 0 34 12\" aria-hidden=\"true\">{shape}</svg> {label}</li>"
        )?;
    }
    if all().any(|entry| entry.extrapolated) {
        html.push_str("<li class=\"note\">dotted: beyond what the law’s source supports</li>\n");
    }
    writeln!(html, "</ul>")
}

impl Page {
    /// With one section more, unless it is empty.
    #[must_use]
    pub fn with(mut self, section: Section) -> Self {
        if !section.blocks.is_empty() {
            self.sections.push(section);
        }
        self
    }

    /// The page as HTML: no scripts, no network.
    #[must_use]
    pub fn html(&self) -> String {
        let mut html = String::new();
        // Writing to a String cannot fail.
        let _ = self.write_html(&mut html);
        html
    }

    fn write_html(&self, html: &mut String) -> std::fmt::Result {
        let title = escape(&self.title);
        write!(
            html,
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<header>\n<h1>{title}</h1>\n\
             <p class=\"summary\">{}</p>\n<nav>",
            escape(&self.summary)
        )?;
        for section in &self.sections {
            let title = escape(&section.title);
            write!(html, "<a href=\"#{}\">{title}</a> ", section.anchor())?;
        }
        html.push_str("</nav>\n</header>\n");
        for section in &self.sections {
            let title = escape(&section.title);
            writeln!(
                html,
                "<section id=\"{}\">\n<h2>{title}</h2>",
                section.anchor()
            )?;
            for block in &section.blocks {
                block.write_html(html)?;
            }
            html.push_str("</section>\n");
        }
        let colophon = escape(&self.colophon);
        writeln!(
            html,
            "<footer>{colophon}</footer>\n</main>\n</body>\n</html>"
        )
    }

    /// Write `report.html` and each figure as `plots/<name>.svg` into `folder`; the page's path.
    ///
    /// # Errors
    /// [`crate::Error::File`] when a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<PathBuf> {
        let plots = folder.join("plots");
        for block in self.sections.iter().flat_map(|section| &section.blocks) {
            if let Block::Figures(figures) = block {
                for figure in figures {
                    figure.write(&plots)?;
                }
            }
        }
        let path = folder.join("report.html");
        write_atomic(&path, self.html().as_bytes())?;
        Ok(path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_parts_are_left_out_and_text_is_escaped() {
        let page = Page {
            title: "A < B".to_owned(),
            ..Page::default()
        }
        .with(Section::new("Fit").with(Block::Table(Table::new("", &["a"]))))
        .with(Section::new("Case").with(Block::Code("radius = \"1 m\"".to_owned())));
        let html = page.html();
        assert!(html.contains("<title>A &lt; B</title>"));
        assert!(!html.contains("id=\"fit\"") && html.contains("id=\"case\""));
        assert!(html.contains("radius = &quot;1 m&quot;"));
    }

    #[test]
    fn figures_side_by_side_share_one_legend() {
        let series = |label: &str, supported_to| crate::report::chart::Series {
            label: label.to_owned(),
            role: crate::report::palette::Role::Law,
            mark: Mark::Line,
            points: vec![(0.0, 0.0), (1.0, 1.0)],
            supported_to,
        };
        let chart = |names: &[&str], end| crate::report::chart::Chart {
            x: crate::report::scale::Axis::new("x", "m"),
            y: crate::report::scale::Axis::new("y", "N"),
            series: names.iter().map(|name| series(name, end)).collect(),
        };
        let of = |name: &str, names: &[&str], end| {
            Figure::chart(name.to_owned(), String::new(), chart(names, end)).unwrap()
        };
        let figures = vec![
            of("a", &["one", "two"], None),
            of("b", &["two", "three"], Some(0.5)),
        ];
        let html = Page::default()
            .with(Section::new("S").with(Block::Figures(figures)))
            .html();
        assert_eq!(html.matches("class=\"legend\"").count(), 1);
        for name in ["one", "two", "three"] {
            assert_eq!(
                html.matches(&format!("</svg> {name}</li>")).count(),
                1,
                "{name}"
            );
        }
        assert!(html.contains("dotted: beyond"));
        assert_eq!(html.matches("width=\"545\"").count(), 2);
    }

    #[test]
    fn the_page_and_its_plots_are_files() {
        let folder = tempfile::tempdir().unwrap();
        let svg = "<svg></svg>".to_owned();
        let figure = Figure::plain("a".to_owned(), "b".to_owned(), svg);
        let page = Page::default().with(Section::new("S").with(Block::Figures(vec![figure])));
        let path = page.write(folder.path()).unwrap();
        let html = std::fs::read_to_string(path).unwrap();
        assert!(html.contains("<svg></svg>") && !html.contains("http"));
        assert!(folder.path().join("plots/a.svg").is_file());
    }
}
