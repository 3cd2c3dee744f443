//! A figure with its name.

use std::fmt;

use lissom_report::Figure;

/// A figure with the name that its file gets, without an ending.
pub struct NamedFigure {
    /// The name, such as `bode-motor`.
    pub name: String,
    /// The run that it shows, if there is one such figure for each run.
    pub run: Option<String>,
    /// The figure.
    pub figure: Box<dyn Figure>,
}

impl NamedFigure {
    pub(crate) fn new(name: impl Into<String>, figure: impl Figure + 'static) -> Self {
        Self { name: name.into(), run: None, figure: Box::new(figure) }
    }

    pub(crate) fn of_run(name: &str, run: String, figure: impl Figure + 'static) -> Self {
        Self { name: name.to_owned(), run: Some(run), figure: Box::new(figure) }
    }
}

impl fmt::Debug for NamedFigure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, run) = (&self.name, &self.run);
        f.debug_struct("NamedFigure").field("name", name).field("run", run).finish_non_exhaustive()
    }
}
