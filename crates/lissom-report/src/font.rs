//! The compiled-in font: DejaVu Sans, regular and bold.

use std::sync::LazyLock;

use crate::truetype::TrueType;

/// The font family of every figure.
pub(crate) const FAMILY: &str = "DejaVu Sans";

static REGULAR: LazyLock<Option<TrueType>> =
    LazyLock::new(|| TrueType::new(dejavu::sans::regular()));
static BOLD: LazyLock<Option<TrueType>> = LazyLock::new(|| TrueType::new(dejavu::sans::bold()));

/// The weight of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Weight {
    Regular,
    Bold,
}

/// The font of a weight; `None` if the compiled-in file cannot be read, which a test excludes.
pub(crate) fn font(weight: Weight) -> Option<&'static TrueType> {
    match weight {
        Weight::Regular => REGULAR.as_ref(),
        Weight::Bold => BOLD.as_ref(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_compiled_in_fonts_are_readable() {
        assert!(font(Weight::Regular).is_some() && font(Weight::Bold).is_some());
    }
}
