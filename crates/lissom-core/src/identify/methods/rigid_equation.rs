//! The motor's equation without a beam, for logs in which the coupling to the tips is hardly known and makes the other
//! estimates worse.

use crate::identify::findings::{EstimateUnits, Finding, rows};
use crate::identify::methods::friction_law::{
    CurveSums, FrictionLaw, friction_law, predicts_better,
};
use crate::identify::methods::least_squares::{LeastSquares, least_squares};
use crate::identify::methods::regression::{MotorRegression, motor_regression};
use crate::identify::options::Options;
use crate::identify::prepare::prepared::Prepared;
use crate::identify::thresholds::SIGN_SHOWN;

/// What slip phases give without a beam.
pub(crate) struct RigidEquation {
    pub(crate) regression: MotorRegression,
    pub(crate) law: Option<(FrictionLaw, CurveSums)>,
    pub(crate) line: Option<LeastSquares>,
    /// Why it is taken.
    pub(crate) finding: Finding,
}

/// The equation without the coupling. `None` where the coupling is known or surely negative, or the equation with it predicts
/// better.
pub(crate) fn rigid_equation(
    prepared: &Prepared<'_>,
    options: &Options,
    regression: &MotorRegression,
    law: Option<&FrictionLaw>,
) -> Option<RigidEquation> {
    // One that is surely negative is of a tip whose sign is reversed.
    let coupling = regression.total_coupling.filter(|c| !c.is_negative())?;
    if coupling.value > SIGN_SHOWN * coupling.std {
        return None;
    }
    let mut used = prepared.used().clone();
    used.channels.tips.iter_mut().for_each(|tip| tip.calibrated = false);
    let rigid = prepared.using(used);
    let found = motor_regression(&rigid, options)?;
    let residual_shares = [regression.relative_residual, found.relative_residual];
    let rigid_law = friction_law(&rigid, &found);
    let without = (&rigid, &found, rigid_law.as_ref().map(|(law, _)| law));
    if predicts_better((regression, law), without) {
        return None;
    }
    let units = EstimateUnits::new(&prepared.campaign().channels);
    let finding = rows::RigidEquation { coupling, units, residual_shares };
    let law = rigid_law;
    let line = least_squares(&rigid, Some(found.window_s));
    let possible = law.as_ref().map_or_else(Vec::new, |(law, _)| law.possible.clone());
    let regression = MotorRegression { possible, ..found };
    Some(RigidEquation { regression, law, line, finding: Finding::new(finding) })
}
