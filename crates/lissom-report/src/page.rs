//! One HTML page that needs nothing from outside.

use std::fmt::Write as _;

use crate::Figure;
use crate::html::escape;
use crate::number::{plain, with_uncertainty};

const STYLE: &str = include_str!("page.css");

/// How serious a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing.
    Info,
    /// A figure is less certain than it looks.
    Warning,
    /// A figure asked for is not given.
    Refusal,
}

impl Severity {
    fn word(self) -> &'static str {
        match self {
            Self::Info => "info",
            Self::Warning => "warning",
            Self::Refusal => "refusal",
        }
    }
}

/// Something the reader must know about the data or a figure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// How serious it is.
    pub severity: Severity,
    /// A stable key.
    pub code: String,
    /// What was found.
    pub message: String,
    /// What to do about it.
    pub hint: Option<String>,
    /// The run concerned.
    pub run: Option<String>,
    /// The results concerned.
    pub affects: Vec<String>,
}

impl Finding {
    /// A finding without hint, run or results concerned.
    pub fn new(severity: Severity, code: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            severity,
            code: code.into(),
            message: message.into(),
            hint: None,
            run: None,
            affects: Vec::new(),
        }
    }

    /// Adds what to do about it.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

/// An estimated figure for [`Page::key_figures`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KeyFigure {
    /// What it is.
    pub name: String,
    /// The estimate; `None` where it is refused.
    pub value: Option<f64>,
    /// Its standard deviation.
    pub std: Option<f64>,
    /// Its 95 % interval.
    pub ci95: Option<[f64; 2]>,
    /// Its unit.
    pub unit: String,
    /// A remark, for example why it is refused.
    pub note: String,
}

/// The alignment of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cells {
    /// Words: left.
    Text,
    /// Numbers: right, with digits of equal width.
    Numbers,
}

/// A table for [`Page::table`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// The line above it.
    pub caption: String,
    /// Heading and alignment of each column.
    pub columns: Vec<(String, Cells)>,
    /// The rows; cells missing at the end stay empty, cells without a column are not shown.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without rows.
    pub fn new(caption: impl Into<String>, columns: &[(&str, Cells)]) -> Self {
        let columns =
            columns.iter().map(|(heading, cells)| ((*heading).to_owned(), *cells)).collect();
        Self { caption: caption.into(), columns, rows: Vec::new() }
    }

    /// Adds a row.
    #[must_use]
    pub fn row<T: Into<String>>(mut self, cells: impl IntoIterator<Item = T>) -> Self {
        self.rows.push(cells.into_iter().map(Into::into).collect());
        self
    }
}

/// Builds the page; its parts appear in the order they are added.
///
/// The page loads nothing: style and figures are inline, there is no script, and a content security policy forbids requests.
/// All text is escaped.
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

    /// The paragraph that says what was found.
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

    /// The table of estimated figures, each rounded to what its standard deviation supports.
    #[must_use]
    pub fn key_figures(self, caption: &str, figures: &[KeyFigure]) -> Self {
        let noted = figures.iter().any(|f| !f.note.is_empty());
        let mut columns = vec![
            ("quantity", Cells::Text),
            ("value ± std", Cells::Numbers),
            ("95 % interval", Cells::Numbers),
            ("unit", Cells::Text),
        ];
        columns.extend(noted.then_some(("note", Cells::Text)));
        let rows = figures.iter().map(|f| {
            let value = f.value.filter(|v| v.is_finite());
            let interval = f.ci95.filter(|_| value.is_some());
            vec![
                f.name.clone(),
                value.map_or_else(
                    || "refused".to_owned(),
                    |v| with_uncertainty(v, f.std.unwrap_or(f64::NAN)),
                ),
                interval.map_or_else(
                    || "—".to_owned(),
                    |[low, high]| format!("{} … {}", plain(low), plain(high)),
                ),
                f.unit.clone(),
                f.note.clone(),
            ]
        });
        let rows = rows.collect();
        self.table(&Table { rows, ..Table::new(caption, &columns) })
    }

    /// A table.
    #[must_use]
    pub fn table(self, table: &Table) -> Self {
        let class = |cells: &Cells| {
            if *cells == Cells::Numbers { " class=\"n\"" } else { "" }
        };
        let mut html = "<div class=\"wide\"><table>".to_owned();
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
            for (k, (_, cells)) in table.columns.iter().enumerate() {
                let _ = write!(
                    html,
                    "<td{}>{}</td>",
                    class(cells),
                    escape(row.get(k).map_or("", String::as_str))
                );
            }
            html.push_str("</tr>\n");
        }
        html.push_str("</tbody></table></div>");
        self.put(&html)
    }

    /// A figure with its caption; where it cannot be drawn, the reason stands in its place.
    #[must_use]
    pub fn figure(self, figure: &impl Figure, caption: &str) -> Self {
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

    /// Text in a fixed-width font behind a line that opens it.
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

#[cfg(test)]
#[path = "page_tests.rs"]
mod tests;
