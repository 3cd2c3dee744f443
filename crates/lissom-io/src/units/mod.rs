//! Quantities written as text: a number and a unit expression, such as `"30e6 psi"` or
//! `"0.005529 lbf*in*s^2"`.
//!
//! A unit expression is a product of unit names with `*`, `·` and `/` (from left to right),
//! powers (`^2`, `^-1`, `²`, `³`) and parentheses; `1` is the unit of a plain number. SI units
//! take SI prefixes (`mA`, `GPa`, `µm`). Angles are plain numbers: `rad` is 1, `deg` π/180,
//! `rev` and `turn` 2π. All rates in this project are angular, so `Hz` is 2π rad/s and
//! `rpm` 2π/60 rad/s. `lb` and `oz` are masses, `lbf` and `ozf` the forces.
//!
//! This parser exists because no crate reads compound units from text and checks their dimension.

mod dimension;
mod parse_quantity;
mod unit_error;
mod unit_expression;
mod unit_table;
#[cfg(test)]
mod units_tests;

pub use dimension::Dimension;
pub use parse_quantity::{parse_any_unit, parse_quantity, parse_unit};
pub use unit_error::UnitError;
