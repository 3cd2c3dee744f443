//! Comparison of results with the first of them.

use std::f64::consts::{PI, TAU};

use thiserror::Error;

use super::compared_file::{
    ComparedFile, ComparedParameterEntry, ComparedResultEntry, ParameterDifferenceEntry,
};
use super::estimate_entry::EstimateEntry;
use super::parameter_list::{ListedParameter, PHASE_KEY, ParameterList};

/// Number of standard errors above which a difference is called clear. A convention: chance alone gives more than three
/// for 0.3 % of the parameters that have not changed.
pub const CLEAR_STANDARD_ERRORS: f64 = 3.0;

/// Why results cannot be compared.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ComparisonError {
    /// Fewer than two results.
    #[error("{}", match only { Some(file) => format!("{file}: is the only result given"), None => "no result is given".to_owned() })]
    TooFew {
        /// The only one.
        only: Option<String>,
    },
    /// Two results are the same.
    #[error("{file}: has the same estimates as {other}")]
    Copy {
        /// The result.
        file: String,
        /// An earlier one.
        other: String,
    },
    /// Results in different units, or of different kinds of axes.
    #[error("results in different units cannot be compared: {}", results.join(", "))]
    OtherUnits {
        /// The results with their units.
        results: Vec<String>,
        /// What to do about it.
        hint: &'static str,
    },
}

impl ComparisonError {
    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            Self::TooFew { .. } => "give two or more results",
            Self::Copy { .. } => DIFFERENT_LOGS,
            Self::OtherUnits { hint, .. } => hint,
        };
        Some(hint.to_owned())
    }
}

impl ComparedFile {
    /// Compares results, each with its name, with the first of them.
    ///
    /// # Errors
    /// [`ComparisonError`] if these are less than two, if two are the same, or if their units differ.
    pub fn of(lists: &[(String, ParameterList)]) -> Result<Self, ComparisonError> {
        let [(_, first), _, ..] = lists else {
            return Err(ComparisonError::TooFew {
                only: lists.first().map(|(file, _)| file.clone()),
            });
        };
        refuse_copies(lists)?;
        refuse_other_units(lists)?;
        Ok(Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            axis: first.names.axis,
            clear_standard_errors: CLEAR_STANDARD_ERRORS,
            results: lists.iter().map(|(file, list)| result_entry(file, list)).collect(),
            parameters: parameters(lists),
        })
    }
}

/// Hint for results from the same logs, whose errors are not independent.
const DIFFERENT_LOGS: &str = "give results from different logs: only their errors are independent";

/// Refuses copies of a result: no two logs give the same estimates to the last digit.
fn refuse_copies(lists: &[(String, ParameterList)]) -> Result<(), ComparisonError> {
    for (i, (file, list)) in lists.iter().enumerate() {
        let known = list.parameters.iter().any(|p| p.estimate.is_some());
        let copied = lists[..i].iter().find(|(_, other)| known && other == list);
        if let Some((other, _)) = copied {
            let (file, other) = (file.clone(), other.clone());
            return Err(ComparisonError::Copy { file, other });
        }
    }
    Ok(())
}

/// Refuses results in different units or of different kinds of axes.
fn refuse_other_units(lists: &[(String, ParameterList)]) -> Result<(), ComparisonError> {
    let names = |list: &ParameterList| (list.names.axis, list.names.torque_unit());
    let Some((_, first)) = lists.first() else { return Ok(()) };
    let others = || lists.iter().map(|(_, list)| list);
    if others().all(|list| names(list) == names(first)) {
        return Ok(());
    }
    let results: Vec<String> = lists
        .iter()
        .map(|(file, list)| {
            let known = list.torque_per_command.map_or(" (no torque constant)", |_| "");
            let axis = list.names.axis.name();
            format!("{file} has a {axis} axis and friction in {}{known}", list.names.torque_unit())
        })
        .collect();
    let hint = if others().any(|list| list.names.axis != first.names.axis) {
        "compare results of the same axis"
    } else if others().any(|list| list.names.torque_known) {
        "give `torque_constant` in [drive] of every campaign or of none, and identify again"
    } else {
        "log the same command in every campaign, or give `torque_constant` in [drive] of each, and identify again"
    };
    Err(ComparisonError::OtherUnits { results, hint })
}

fn result_entry(file: &str, list: &ParameterList) -> ComparedResultEntry {
    ComparedResultEntry {
        file: file.to_owned(),
        from: list.from,
        friction_terms: list.friction_terms.clone(),
        torque_per_command: list.torque_per_command,
        modes: list.modes,
    }
}

fn same(a: &ListedParameter, b: &ListedParameter) -> bool {
    (&a.key, &a.name) == (&b.key, &b.name)
}

/// All parameters of the results, in the order of the tables.
fn parameters(lists: &[(String, ParameterList)]) -> Vec<ComparedParameterEntry> {
    let mut all: Vec<&ListedParameter> = Vec::new();
    for (_, list) in lists {
        let mut next = 0;
        for parameter in list.parameters.iter().filter(|p| p.estimate.is_some()) {
            let place = all.iter().position(|known| same(known, parameter));
            if place.is_none() {
                all.insert(next, parameter);
            }
            next = place.unwrap_or(next) + 1;
        }
    }
    all.iter().map(|parameter| compared_parameter(parameter, lists)).collect()
}

fn compared_parameter(
    parameter: &ListedParameter,
    lists: &[(String, ParameterList)],
) -> ComparedParameterEntry {
    let of_result = |(_, list): &(String, ParameterList)| {
        list.parameters.iter().find(|p| same(p, parameter)).cloned()
    };
    let found: Vec<Option<ListedParameter>> = lists.iter().map(of_result).collect();
    let values: Vec<Option<EstimateEntry>> =
        found.iter().map(|p| p.as_ref().and_then(|p| p.estimate.clone())).collect();
    let warnings = found.into_iter().map(|p| p.map_or_else(Vec::new, |p| p.warnings)).collect();
    let is_phase = parameter.key == PHASE_KEY;
    let first = values.first().and_then(Option::as_ref);
    let to_first = |value: &Option<EstimateEntry>| {
        first.zip(value.as_ref()).map(|(first, value)| difference(first, value, is_phase))
    };
    ComparedParameterEntry {
        key: parameter.key.clone(),
        name: parameter.name.clone(),
        unit: parameter.unit.clone(),
        differences: values.iter().skip(1).map(to_first).collect(),
        warnings,
        values,
    }
}

fn difference(
    first: &EstimateEntry,
    value: &EstimateEntry,
    is_phase: bool,
) -> ParameterDifferenceEntry {
    let plain = value.value - first.value;
    let difference = if is_phase { (plain + PI).rem_euclid(TAU) - PI } else { plain };
    let std = first.std.hypot(value.std);
    let [low, high] = first.ci95;
    let from_zero = low > 0.0 || high < 0.0;
    let ratio = |of: f64| Some(difference / of).filter(|ratio| ratio.is_finite());
    ParameterDifferenceEntry {
        value: difference,
        std,
        relative: ratio(first.value.abs()).filter(|_| from_zero && !is_phase),
        standard_errors: ratio(std),
        clear: difference.abs() > CLEAR_STANDARD_ERRORS * std,
    }
}

#[cfg(test)]
mod tests {
    use lissom_core::identify::Estimate;

    use super::*;

    fn estimate(value: f64, std: f64) -> EstimateEntry {
        EstimateEntry::of(Estimate { value, std }, "N·m")
    }

    #[test]
    fn a_difference_has_the_errors_of_both_values() {
        let d = difference(&estimate(-2.0, 0.3), &estimate(-1.0, 0.4), false);
        assert_eq!((d.value, d.std, d.relative, d.clear), (1.0, 0.5, Some(0.5), false));
        assert_eq!(d.standard_errors, Some(2.0));
        assert!(difference(&estimate(-2.0, 0.3), &estimate(-0.4, 0.4), false).clear);
        let from_about_zero = difference(&estimate(0.1, 0.1), &estimate(1.0, 0.1), false);
        assert_eq!((from_about_zero.relative, from_about_zero.clear), (None, true));
    }

    #[test]
    fn phases_on_both_sides_of_half_a_turn_are_close() {
        let d = difference(&estimate(PI - 0.01, 0.1), &estimate(0.01 - PI, 0.1), true);
        assert!((d.value - 0.02).abs() < 1e-12 && d.relative.is_none(), "{d:?}");
    }
}
