//! The list of all thresholds.

use crate::identify::{
    equivalent, judge, methods, output_error, prepare, responses, separability,
    thresholds as all_methods, validation,
};
use crate::threshold::Threshold;
use crate::{information, plan, record, spectrum};

/// The lists of all methods, in the order of the data flow.
const GROUPS: [&[Threshold]; 18] = [
    record::clock::thresholds::LIST,
    record::other_clock::thresholds::LIST,
    record::spikes::thresholds::LIST,
    all_methods::LIST,
    spectrum::thresholds::LIST,
    prepare::thresholds::LIST,
    methods::thresholds::LIST,
    methods::regression::thresholds::LIST,
    methods::friction_law::thresholds::LIST,
    prepare::steady_thresholds::LIST,
    output_error::thresholds::LIST,
    responses::thresholds::LIST,
    judge::thresholds::LIST,
    information::thresholds::LIST,
    separability::thresholds::LIST,
    validation::thresholds::LIST,
    equivalent::thresholds::LIST,
    plan::thresholds::LIST,
];

/// All thresholds of the library: every number that decides what is accepted, refused, reported or chosen.
///
/// Each has a unit, a reason, and a [`Basis`](crate::Basis) that says where its value comes from. Limits of the input, and
/// tolerances of algorithms, are not thresholds and are not in the list.
///
/// ```
/// let refused = lissom::thresholds().find(|t| t.name == "REFUSED_TORQUE").unwrap();
/// assert_eq!(refused.unit, "1");
/// assert!(refused.reason.contains("torque"));
/// ```
pub fn thresholds() -> impl Iterator<Item = &'static Threshold> {
    GROUPS.into_iter().flatten()
}
