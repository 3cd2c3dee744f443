//! One HTML page that loads nothing else.

use std::fmt::Write as _;

use crate::Figure;
use crate::html::escape;
use crate::page_parts::{Cells, Finding, KeyFigure, Table};
use lissom_text::{interval, with_uncertainty};

const STYLE: &str = include_str!("page.css");

/// Builds the page; its parts appear in the order they are added.
///
/// The page loads nothing: style and figures are inline, there is no script, and a content security policy forbids
/// requests. All text is escaped.
#[derive(Clone, Debug)]
pub struct Page {
    title: String,
    body: String,
}

impl Page {
    /// A page with its title.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), body: String::new() }
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

    /// A heading.
    #[must_use]
    pub fn heading(self, text: &str) -> Self {
        self.put(&format!("<h2>{}</h2>", escape(text)))
    }

    /// A paragraph.
    #[must_use]
    pub fn paragraph(self, text: &str) -> Self {
        self.put(&format!("<p>{}</p>", escape(text)))
    }

    /// A table of estimates, each rounded to two digits of its standard error.
    #[must_use]
    pub fn key_figures(self, caption: &str, figures: &[KeyFigure]) -> Self {
        let noted = figures.iter().any(|f| !f.note.is_empty());
        let mut columns = vec![
            ("quantity", Cells::Text),
            ("value ± standard error", Cells::Numbers),
            ("95 % interval", Cells::Numbers),
            ("unit", Cells::Text),
        ];
        columns.extend(noted.then_some(("note", Cells::Text)));
        let rows = figures.iter().map(|f| {
            let value = f.value.filter(|v| v.is_finite());
            let std = f.std.unwrap_or(f64::NAN);
            let ci95 = Option::zip(value, f.ci95).map(|(v, ci95)| interval(ci95, v, std));
            vec![
                f.name.clone(),
                value.map_or_else(|| "refused".to_owned(), |v| with_uncertainty(v, std)),
                ci95.unwrap_or_else(|| "—".to_owned()),
                f.unit.clone(),
                f.note.clone(),
            ]
        });
        let rows = rows.collect();
        let table = Table { rows, ..Table::new(caption, &columns) };
        self.put(&table_html(&table, " class=\"stack\""))
    }

    /// A table.
    #[must_use]
    pub fn table(self, table: &Table) -> Self {
        self.put(&table_html(table, ""))
    }

    /// A figure with its caption; if it cannot be drawn, the page shows the reason instead.
    #[must_use]
    pub fn figure<F: Figure + ?Sized>(self, figure: &F, caption: &str) -> Self {
        let picture = figure.to_svg().unwrap_or_else(|error| {
            format!("<p class=\"missing\">Not drawn: {}.</p>", escape(&error.to_string()))
        });
        self.put(&format!(
            "<figure><div class=\"wide plot\">{picture}</div><figcaption>{}</figcaption></figure>",
            escape(caption)
        ))
    }

    /// The findings, the most serious first.
    #[must_use]
    pub fn findings(self, findings: &[Finding]) -> Self {
        if findings.is_empty() {
            return self.put("<p>No findings.</p>");
        }
        let mut sorted: Vec<&Finding> = findings.iter().collect();
        sorted.sort_by_key(|f| std::cmp::Reverse(f.severity));
        let mut html = "<ul class=\"findings\">\n".to_owned();
        for finding in sorted {
            let word = finding.severity.word();
            let _ = write!(
                html,
                "<li class=\"{word}\"><span class=\"badge\">{word}</span> <code>{}</code>",
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
        let (title, body) = (escape(&self.title), &self.body);
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\"/>\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>{title}</title>\n\
             <style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n{body}</main>\n</body>\n</html>\n"
        )
    }
}

/// A table; `attributes` go to its element.
fn table_html(table: &Table, attributes: &str) -> String {
    let class = |cells: &Cells| {
        if *cells == Cells::Numbers { " class=\"n\"" } else { "" }
    };
    let mut html = format!("<div class=\"wide\"><table{attributes}>");
    if !table.caption.is_empty() {
        let _ = write!(html, "<caption>{}</caption>", escape(&table.caption));
    }
    html.push_str("<thead><tr>");
    for (heading, cells) in &table.columns {
        let _ = write!(html, "<th scope=\"col\"{}>{}</th>", class(cells), escape(heading));
    }
    html.push_str("</tr></thead>\n<tbody>");
    for row in &table.rows {
        html.push_str("<tr>");
        for (k, (heading, cells)) in table.columns.iter().enumerate() {
            let text = escape(row.get(k).map_or("", String::as_str));
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
