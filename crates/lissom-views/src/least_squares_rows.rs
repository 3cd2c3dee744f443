//! Ordinary least squares with Coulomb friction and one viscous coefficient, for a result with another friction law.

use lissom_io::result::finding_keys::{COULOMB, GRAVITY, INERTIA, OFFSET, VISCOUS};
use lissom_io::result::{EstimateEntry, LeastSquaresEntry, MethodName};
use lissom_io::{ResultFile, UnitNames};
use lissom_report::significant;

use crate::parameter_rows::{ParameterRow, given};

/// Its parameters, one row for each, and how they were found.
#[derive(Debug, Clone)]
pub struct LeastSquaresRows {
    /// One row for each parameter that it gives.
    pub rows: Vec<ParameterRow>,
    /// Speeds and residual, in a sentence.
    pub words: String,
}

/// `None` if the result's own friction is Coulomb friction with one viscous coefficient, or without least squares.
pub fn least_squares_rows(names: UnitNames, result: &ResultFile) -> Option<LeastSquaresRows> {
    let f = &result.friction;
    let by_law = result.from == Some(MethodName::FrictionLaw);
    if f.law.is_none() && !by_law {
        return None;
    }
    let fit = result.methods.least_squares.as_ref()?;
    let [slowest, fastest] = fit.speed_range.value;
    let words = format!(
        "least squares of all motion with Coulomb friction and one viscous coefficient, at speeds from {} to {} {}/s; \
         residual torque {:.2} %",
        significant(slowest, 3),
        significant(fastest, 3),
        names.angle(),
        100.0 * fit.relative_residual
    );
    Some(LeastSquaresRows { rows: rows(names, fit), words })
}

fn rows(names: UnitNames, fit: &LeastSquaresEntry) -> Vec<ParameterRow> {
    let torque = || names.torque_unit().to_owned();
    let gravity = fit.gravity.as_ref().map(|g| &g.amplitude);
    let all = [
        ("Coulomb friction", COULOMB, given(fit.coulomb.coulomb.as_ref()), torque()),
        ("offset", OFFSET, given(fit.coulomb.offset.as_ref()), torque()),
        ("viscous friction", VISCOUS, given(fit.viscous.as_ref()), names.viscous_unit()),
        (names.inertia_name(), INERTIA, given(fit.inertia.as_ref()), names.inertia_unit()),
        ("gravity, m·g·l", GRAVITY, gravity.map(EstimateEntry::estimate), torque()),
    ];
    let all = all.into_iter().filter(|(_, _, estimate, _)| estimate.is_some());
    all.map(|(name, key, estimate, unit)| ParameterRow {
        name: name.to_owned(),
        key,
        estimate,
        unit,
        known: None,
    })
    .collect()
}
