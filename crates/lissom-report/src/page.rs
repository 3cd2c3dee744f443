//! One HTML page that loads nothing else.

use std::collections::HashSet;
use std::fmt::Write as _;

use serde::Serialize;

use crate::Figure;
use crate::figure_data::{FigureData, POINTS_MOST};
use crate::forest::ForestAxis;
use crate::html::escape;
use crate::page_parts::{Cells, Finding, KeyFigure, Table};
use lissom_text::{interval, with_uncertainty};

/// The style of pages.
pub const PAGE_STYLE: &str = concat!(include_str!("page/uplot.css"), include_str!("page/page.css"));
/// Makes figures interactive. Built from `web/src/page.ts`.
const SCRIPT: &str = include_str!("page/page.js");
/// Points of all lines of a gallery together.
const GALLERY_POINTS: usize = 130_000;
/// Points of one of them, at least and at most.
const GALLERY_LEAST: usize = 300;
const GALLERY_MOST: usize = 2000;
/// SHA-256 of the script, Base64: the only one that the page may run.
const SCRIPT_HASH: &str = include_str!("page/page.js.sha256");

/// Builds the page; its parts appear in the order they are added.
///
/// The page loads nothing: style, figures and script are inline, and a content security policy forbids requests and all other
/// scripts. All text is escaped. Without scripts, and in print, figures are pictures; with them, a reader can zoom, read values,
/// choose units, and save the samples.
#[derive(Clone, Debug)]
pub struct Page {
    title: String,
    body: String,
    /// Anchor and text of each heading.
    headings: Vec<(String, String)>,
    /// Where in the body the list of contents belongs.
    contents_at: Option<usize>,
    has_data: bool,
}

impl Page {
    /// A page with its title.
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            body: String::new(),
            headings: Vec::new(),
            contents_at: None,
            has_data: false,
        }
    }

    fn put(mut self, html: &str) -> Self {
        self.body.push_str(html);
        self.body.push('\n');
        self
    }

    /// A paragraph in slightly larger type, for the main results.
    #[must_use]
    pub fn summary(self, text: &str) -> Self {
        self.put(&format!("<p class=\"summary\">{}</p>", escape(text)))
    }

    /// A heading, to which the list of contents refers.
    #[must_use]
    pub fn heading(mut self, text: &str) -> Self {
        let anchor = self.anchor(text);
        self.headings.push((anchor.clone(), text.to_owned()));
        self.put(&format!("<h2 id=\"{anchor}\">{}</h2>", escape(text)))
    }

    /// A list of the headings that follow.
    #[must_use]
    pub fn contents(mut self) -> Self {
        self.contents_at = Some(self.body.len());
        self.headings.clear();
        self
    }

    /// A name for a heading, of letters, digits and hyphens, that no other one has.
    fn anchor(&self, text: &str) -> String {
        let plain = text.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { ' ' });
        let plain = plain.collect::<String>().to_ascii_lowercase();
        let words: Vec<&str> = plain.split_whitespace().collect();
        let name = if words.is_empty() { "section".to_owned() } else { words.join("-") };
        let taken: HashSet<&str> = self.headings.iter().map(|(name, _)| name.as_str()).collect();
        let numbered = (2..).map(|k| format!("{name}-{k}"));
        std::iter::once(name.clone())
            .chain(numbered)
            .find(|name| !taken.contains(name.as_str()))
            .unwrap_or_default()
    }

    /// A paragraph.
    #[must_use]
    pub fn paragraph(self, text: &str) -> Self {
        self.put(&format!("<p>{}</p>", escape(text)))
    }

    /// A table of estimates, each rounded to two digits of its standard error.
    #[must_use]
    pub fn key_figures(self, caption: &str, figures: &[KeyFigure]) -> Self {
        let axis = ForestAxis::of(figures);
        let noted = figures.iter().any(|f| !f.note.is_empty());
        let doubted = figures.iter().any(|f| !f.doubted_by.is_empty());
        let mut columns = vec![
            ("quantity", Cells::Text),
            ("value ± standard error", Cells::Numbers),
            ("95 % interval", Cells::Numbers),
            ("unit", Cells::Text),
        ];
        let scale = axis.map(|axis| format!("± {} %", axis.percent()));
        columns.extend(scale.as_deref().map(|scale| (scale, Cells::Text)));
        columns.extend(noted.then_some(("note", Cells::Text)));
        columns.extend(doubted.then_some(("doubtful", Cells::Text)));
        let rows = figures.iter().map(|f| {
            let value = f.value.filter(|v| v.is_finite());
            let std = f.std.unwrap_or(f64::NAN);
            let ci95 = Option::zip(value, f.ci95).map(|(v, ci95)| interval(ci95, v, std));
            let mut cells = vec![
                escape(&f.name),
                value.map_or_else(|| "refused".to_owned(), |v| escape(&with_uncertainty(v, std))),
                ci95.map_or_else(|| "—".to_owned(), |text| escape(&text)),
                escape(&f.unit),
            ];
            cells.extend(axis.map(|axis| axis.row(f).unwrap_or_default()));
            cells.extend(noted.then(|| escape(&f.note)));
            cells.extend(doubted.then(|| links(&f.doubted_by)));
            cells
        });
        let rows: Vec<Vec<String>> = rows.collect();
        let table = Table::new(caption, &columns);
        self.put(&table_html(&table, &rows, " class=\"stack\""))
    }

    /// A table.
    #[must_use]
    pub fn table(self, table: &Table) -> Self {
        let escaped = |row: &Vec<String>| row.iter().map(|cell| escape(cell)).collect();
        let rows: Vec<Vec<String>> = table.rows.iter().map(escaped).collect();
        self.put(&table_html(table, &rows, ""))
    }

    /// A table of results side by side with a picture of their 95 % intervals, relative to the first one, in a last column.
    /// `intervals` has a row for each row of the table: for each result low end, value and high end.
    #[must_use]
    pub fn interval_table(
        self,
        table: &Table,
        names: &[String],
        intervals: &[Vec<Option<[f64; 3]>>],
    ) -> Self {
        let mut table = table.clone();
        let first = names.first().map_or("", String::as_str);
        table.columns.push((format!("95 % intervals relative to {first}"), Cells::Text));
        let nothing = Vec::new();
        let rows = table.rows.iter().enumerate().map(|(k, row)| {
            let mut cells: Vec<String> = row.iter().map(|cell| escape(cell)).collect();
            cells.resize(table.columns.len() - 1, String::new());
            let picture = ForestAxis::side_by_side(names, intervals.get(k).unwrap_or(&nothing));
            cells.push(picture.unwrap_or_default());
            cells
        });
        let rows: Vec<Vec<String>> = rows.collect();
        self.put(&table_html(&table, &rows, ""))
    }

    /// A figure with its caption; if it cannot be drawn, the page shows the reason instead.
    #[must_use]
    pub fn figure<F: Figure + ?Sized>(mut self, figure: &F, caption: &str) -> Self {
        let picture = picture(figure);
        let data = figure.data(POINTS_MOST).map_or_else(|_| String::new(), |data| data_html(&data));
        self.has_data |= !data.is_empty();
        self.put(&format!(
            "<figure><div class=\"wide plot\" tabindex=\"0\" role=\"group\" aria-label=\"Plot\">{picture}</div>{data}<figcaption>{}</figcaption></figure>",
            escape(caption)
        ))
    }

    /// Figures of one kind, each with a name, of which the reader chooses one; the first is shown. Long lines are thinned so
    /// that the page stays small.
    #[must_use]
    pub fn gallery<F: Figure>(
        mut self,
        choose: &str,
        figures: &[(String, F)],
        caption: &str,
    ) -> Self {
        let Some((_, first)) = figures.first() else { return self };
        let few = figures.iter().filter_map(|(_, figure)| figure.data(2).ok());
        let traces: usize = few.flat_map(|data| data.panels).map(|panel| panel.traces.len()).sum();
        let points = (GALLERY_POINTS / traces.max(1)).clamp(GALLERY_LEAST, GALLERY_MOST);
        let all: Vec<Choice<'_>> = figures
            .iter()
            .filter_map(|(name, figure)| Some(Choice { name, figure: figure.data(points).ok()? }))
            .collect();
        let data = if all.is_empty() { String::new() } else { data_html(&Choices { choose, all }) };
        self.has_data |= !data.is_empty();
        let picture = picture(first);
        self.put(&format!(
            "<figure><div class=\"wide plot\" tabindex=\"0\" role=\"group\" aria-label=\"Plot\">{picture}</div>{data}<figcaption>{}</figcaption></figure>",
            escape(caption)
        ))
    }

    /// The findings, in their order.
    #[must_use]
    pub fn findings(self, findings: &[Finding]) -> Self {
        if findings.is_empty() {
            return self.put("<p>No findings.</p>");
        }
        let mut html = "<ul class=\"findings\">\n".to_owned();
        let mut placed = HashSet::new();
        for finding in findings {
            let word = finding.severity.word();
            let anchor = finding_anchor(&finding.code);
            let place = if placed.insert(anchor.clone()) {
                format!(" id=\"{anchor}\"")
            } else {
                String::new()
            };
            let _ = write!(
                html,
                "<li{place} class=\"{word}\"><span class=\"badge\">{word}</span> <code>{}</code>",
                escape(&finding.code)
            );
            if let Some(run) = &finding.run {
                let _ = write!(html, " <span class=\"run\">{}</span>", escape(run));
            }
            let _ = write!(html, "<p>{}</p>", escape(&finding.message));
            if let Some(hint) = &finding.hint {
                let _ = write!(html, "<p class=\"hint\"><b>Hint:</b> {}</p>", escape(hint));
            }
            if !finding.affects.is_empty() {
                let keys: Vec<String> = finding
                    .affects
                    .iter()
                    .map(|key| format!("<code>{}</code>", escape(key)))
                    .collect();
                let _ = write!(html, "<p class=\"affects\">Affects {}</p>", keys.join(", "));
            }
            html.push_str("</li>\n");
        }
        html.push_str("</ul>");
        self.put(&html)
    }

    /// The findings that matter most, each in a line with what to do, with links to all of them.
    #[must_use]
    pub fn main_findings(self, findings: &[Finding]) -> Self {
        let mut html = "<ul class=\"main-findings\">\n".to_owned();
        for finding in findings {
            let (word, anchor) = (finding.severity.word(), finding_anchor(&finding.code));
            let _ = write!(
                html,
                "<li class=\"{word}\"><span class=\"badge\">{word}</span> {}{} <a href=\"#{anchor}\">{}</a>",
                finding.run.as_ref().map_or_else(String::new, |run| format!("{}: ", escape(run))),
                escape(&finding.message),
                escape(&finding.code)
            );
            if let Some(hint) = &finding.hint {
                let _ = write!(html, "<p class=\"hint\"><b>What to do:</b> {}</p>", escape(hint));
            }
            html.push_str("</li>\n");
        }
        html.push_str("</ul>");
        self.put(&html)
    }

    /// Text in a fixed-width font that a click on its heading shows.
    #[must_use]
    pub fn details(self, summary: &str, text: &str) -> Self {
        self.put(&format!(
            "<details><summary>{}</summary><pre>{}</pre></details>",
            escape(summary),
            escape(text)
        ))
    }

    /// A line at the foot of the page, for example who made it.
    #[must_use]
    pub fn footer(self, text: &str) -> Self {
        self.put(&format!("<footer>{}</footer>", escape(text)))
    }

    /// The page as a complete HTML document.
    pub fn to_html(&self) -> String {
        let title = escape(&self.title);
        let content = self.to_fragment();
        let (allowed, script) = if self.has_data {
            (format!(" script-src 'sha256-{SCRIPT_HASH}';"), format!("<script>{SCRIPT}</script>\n"))
        } else {
            (String::new(), String::new())
        };
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none';{allowed} style-src 'unsafe-inline'\"/>\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>{title}</title>\n\
             <style>\n{PAGE_STYLE}</style>\n</head>\n<body>\n<main>\n{content}</main>\n\
             {script}</body>\n</html>\n"
        )
    }

    /// The content of the page, from its title on, for a program that shows it in a page of its own with [`PAGE_STYLE`].
    pub fn to_fragment(&self) -> String {
        let title = escape(&self.title);
        let (before, after) = self.body.split_at(self.contents_at.unwrap_or(0));
        let contents = self.contents_html();
        let bar = if self.has_data { "<div id=\"units\" hidden=\"hidden\"></div>\n" } else { "" };
        format!("<h1>{title}</h1>\n{before}{contents}{bar}{after}")
    }

    fn contents_html(&self) -> String {
        if self.contents_at.is_none() || self.headings.is_empty() {
            return String::new();
        }
        let mut html = "<nav aria-label=\"Contents\"><ul>\n".to_owned();
        for (anchor, text) in &self.headings {
            let _ = writeln!(html, "<li><a href=\"#{anchor}\">{}</a></li>", escape(text));
        }
        html.push_str("</ul></nav>\n");
        html
    }
}

/// Figures of which the reader chooses one.
#[derive(Serialize)]
struct Choices<'a> {
    choose: &'a str,
    all: Vec<Choice<'a>>,
}

/// One of them.
#[derive(Serialize)]
struct Choice<'a> {
    name: &'a str,
    figure: FigureData,
}

/// A figure as SVG, or why it cannot be drawn.
fn picture<F: Figure + ?Sized>(figure: &F) -> String {
    figure.to_svg().unwrap_or_else(|error| {
        format!("<p class=\"missing\">Not drawn: {}.</p>", escape(&error.to_string()))
    })
}

/// Data for the script of the page: JSON in which no tag, reference or end of CDATA can stand.
fn data_html(data: &impl Serialize) -> String {
    let Ok(json) = serde_json::to_string(data) else { return String::new() };
    let json = json.replace('&', "\\u0026").replace('<', "\\u003c").replace('>', "\\u003e");
    format!("<script type=\"application/json\" class=\"figure-data\">{json}</script>")
}

/// The place of a finding on the page.
fn finding_anchor(code: &str) -> String {
    let plain = code.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' });
    format!("finding-{}", plain.collect::<String>())
}

/// Findings with links to their places.
fn links(codes: &[String]) -> String {
    let link =
        |code: &String| format!("<a href=\"#{}\">{}</a>", finding_anchor(code), escape(code));
    codes.iter().map(link).collect::<Vec<_>>().join(", ")
}

/// A table with rows of cells that are HTML; `attributes` go to its element.
fn table_html(table: &Table, rows: &[Vec<String>], attributes: &str) -> String {
    let class = |cells: &Cells| {
        if *cells == Cells::Numbers { " class=\"n\"" } else { "" }
    };
    // A wide table can be scrolled with the keyboard.
    let label = if table.caption.is_empty() { "Table".to_owned() } else { escape(&table.caption) };
    let mut html = format!(
        "<div class=\"wide\" tabindex=\"0\" role=\"group\" aria-label=\"{label}\"><table{attributes}>"
    );
    if !table.caption.is_empty() {
        let _ = write!(html, "<caption>{}</caption>", escape(&table.caption));
    }
    html.push_str("<thead><tr>");
    for (heading, cells) in &table.columns {
        let _ = if heading.is_empty() {
            write!(html, "<td></td>")
        } else {
            write!(html, "<th scope=\"col\"{}>{}</th>", class(cells), escape(heading))
        };
    }
    html.push_str("</tr></thead>\n<tbody>");
    for row in rows {
        html.push_str("<tr>");
        for (k, (heading, cells)) in table.columns.iter().enumerate() {
            let text = row.get(k).map_or("", String::as_str);
            let (class, label) = (class(cells), escape(heading));
            let _ = write!(html, "<td{class} data-label=\"{label}\">{text}</td>");
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody></table></div>");
    html
}

#[cfg(test)]
#[path = "page_tests.rs"]
mod tests;
