//! Estimates under keys with their unit.

use super::estimate_entry::EstimateEntry;
use super::unit_keys::WithUnit;

/// An estimate that may be refused, under a key with its unit.
pub type Refusable<Q> = WithUnit<Q, Option<EstimateEntry>>;

/// An estimate under a key with its unit.
pub type Estimated<Q> = WithUnit<Q, EstimateEntry>;
