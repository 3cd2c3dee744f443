//! A threshold, and the macro that declares a method's thresholds in one place.
//!
//! A threshold is a number that decides an outcome that the user sees: what is accepted, refused, warned of, chosen or
//! left out, and how far a search for the estimates goes. Three kinds of numbers are not thresholds and are declared
//! where they are used: limits of the input (guards); tolerances, step counts and seeds of numerical algorithms; and
//! small numbers that guard against rounding. The root finders, event searches and series of `beam`, `lti`, `rig` and
//! `replay` have only numbers of these kinds.

use strum::IntoStaticStr;

/// Origin of a threshold's value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Basis {
    /// Follows from theory or from another number; the reason says how.
    Derived,
    /// Chosen from measured logs or from simulated campaigns; the reason says which.
    Measured,
    /// A usual level, such as 5 % or three standard errors, or a round number.
    Convention,
}

impl Basis {
    /// Name in tables and files: `"derived"`, `"measured"` or `"convention"`.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// The value of a threshold.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(untagged))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum ThresholdValue {
    /// A real number.
    Number(f64),
    /// A count.
    Count(u64),
    /// Real numbers that are tried or applied one after the other.
    Numbers(&'static [f64]),
}

/// A number that decides an outcome that the user sees.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Threshold {
    /// Method or step to which the threshold belongs.
    pub method: &'static str,
    /// Name of the constant in the source.
    pub name: &'static str,
    /// Value, in `unit`.
    pub value: ThresholdValue,
    /// Unit; "1" for shares and ratios.
    pub unit: &'static str,
    /// Origin of the value.
    pub basis: Basis,
    /// What the threshold decides, and why it has this value.
    pub reason: &'static str,
}

/// Declares the thresholds of one or more methods: a constant for each, and the list `LIST` of them all.
///
/// The doc comment of a constant is its reason in the list.
///
/// ```ignore
/// thresholds! {
///     "regression" {
///         /// A regression is poor if it leaves more than this share of the torque.
///         POOR_RESIDUAL: f64 = 0.15, "1", Convention;
///     }
/// }
/// ```
macro_rules! thresholds {
    (
        $($method:literal {
            $($(#[doc = $reason:literal])+ $name:ident: $kind:tt = $value:expr, $unit:literal, $basis:ident;)+
        })+
    ) => {
        $($($(#[doc = $reason])+ pub(crate) const $name: $kind = $value;)+)+

        /// All of them.
        pub(crate) const LIST: &[$crate::threshold::Threshold] = &[$($($crate::threshold::Threshold {
            method: $method,
            name: stringify!($name),
            value: thresholds!(@value $kind, $name),
            unit: $unit,
            basis: $crate::threshold::Basis::$basis,
            reason: concat!($($reason),+).trim_ascii(),
        },)+)+];
    };
    (@value f64, $name:ident) => { $crate::threshold::ThresholdValue::Number($name) };
    (@value usize, $name:ident) => { $crate::threshold::ThresholdValue::Count($name as u64) };
    (@value u64, $name:ident) => { $crate::threshold::ThresholdValue::Count($name) };
    (@value [f64; $count:literal], $name:ident) => { $crate::threshold::ThresholdValue::Numbers(&$name) };
}
