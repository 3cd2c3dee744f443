//! A figure with its name.

use std::fmt;

use lissom_report::Figure;

/// A figure with the name that its file gets, without an ending.
pub struct NamedFigure {
    /// The name, such as `bode-motor`.
    pub name: String,
    /// The figure.
    pub figure: Box<dyn Figure>,
}

impl NamedFigure {
    pub(crate) fn new(name: impl Into<String>, figure: impl Figure + 'static) -> Self {
        Self { name: name.into(), figure: Box::new(figure) }
    }
}

impl fmt::Debug for NamedFigure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NamedFigure").field("name", &self.name).finish_non_exhaustive()
    }
}
