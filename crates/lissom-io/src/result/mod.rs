//! `result.json`: the result of an identification, with stable keys; and the files of
//! `lissom compare`, `equivalent`, `payload` and `validate`.
//!
//! Each file is a type that is written and read ([`ResultFile`], [`EquivalentFile`], [`PayloadFile`],
//! [`ValidationFile`], [`ComparedFile`]); the schemas in `docs/` are generated from these types. An estimate is
//! `{value, std, ci95, unit}`, or `null` if it is refused; a finding then gives the reason.

mod arm_entry;
mod channel_names;
mod compare_results;
mod compared_file;
mod constant_velocity_entry;
mod equivalent_file;
mod estimate_entry;
mod finding_entry;
pub mod finding_keys;
mod friction_entry;
mod friction_law_entry;
mod friction_term_entries;
mod geometry_entry;
mod gravity_entry;
mod linear_model_entries;
mod method_entries;
mod output_error_entry;
mod parameter_list;
mod payload_file;
mod read_arm;
pub(crate) mod result_error;
mod result_file;
mod separability_entry;
pub mod thresholds_file;
mod unit_names;
mod validation_file;

pub use arm_entry::{ArmEntry, ArmTipEntry};
pub use channel_names::{CommandUnitName, DirectionName};
pub use compare_results::{CLEAR_STANDARD_ERRORS, ComparisonError};
pub use compared_file::{
    ComparedFile, ComparedParameterEntry, ComparedResultEntry, ParameterDifferenceEntry,
};
pub use constant_velocity_entry::{
    ConstantVelocityEntry, FrictionLineEntry, LineShapeName, SteadyPointEntry,
};
pub use equivalent_file::{
    EquivalentBeamEntry, EquivalentEntry, EquivalentFile, EquivalentModeEntry,
    EquivalentTorqueEntry, PointZerosEntry, ResponseZeroEntry, SpuriousPoleEntry, StrainlessEntry,
};
pub(crate) use estimate_entry::finite;
pub use estimate_entry::{BeamModeEntry, EstimateEntry, NumberEntry};
pub use finding_entry::FindingEntry;
pub use friction_entry::{CoulombEntry, CurvePointEntry, FrictionEntry, LawEntry};
pub use friction_law_entry::{
    ChosenLawEntry, ChosenTermEntry, FrictionLawEntry, LawCandidateEntry, LawResidualEntry,
};
pub use friction_term_entries::{
    FrictionTermsEntry, LawTermEntry, LawTermName, NearRestEntry, RippleEntry,
};
pub use geometry_entry::{ArmQuantityName, ExplanationEntry, GeometryEntry};
pub use gravity_entry::GravityEntry;
pub use linear_model_entries::{
    FrequencyResponseEntry, LinearModelEntries, SeriesEntry, TipModelEntry, TipResponseEntry,
};
pub use method_entries::{
    BeamRegressionEntry, HiddenModeEntry, LeastSquaresEntry, MethodEntries, MotorFitEntry,
    RegressionEntry, SinePairEntry, ThirdHarmonicEntry, WindowEntry,
};
pub use output_error_entry::{ExtensionEntry, OutputErrorEntry, StageEntry};
pub use parameter_list::{ListedParameter, PHASE_KEY, ParameterList};
pub use payload_file::{
    PayloadEntry, PayloadFile, PayloadPrediction, PredictedPayload, ResponseEntry,
};
pub use read_arm::{arm_of_text, read_arm};
pub use result_error::ResultError;
pub use result_file::{
    BeamEntry, DriveEntry, HarmonicsEntry, ResultFile, RunEntry, RunKindName, SinusoidEntry,
};
pub use separability_entry::{
    CorrelationEntry, DirectionPartEntry, MotionKindName, ParameterCertaintyEntry,
    PrincipalDirectionEntry, RunEffectEntry, RunShareEntry, RunToAddEntry, SeparabilityEntry,
};
pub use thresholds_file::ThresholdsFile;
pub use unit_names::UnitNames;
pub use validation_file::{
    ChannelFitEntry, ChannelResidualEntry, ChannelUnitName, HorizonEntry, MotionEntry,
    MovedModeEntry, StretchEntry, TorqueEntry, TorqueRunEntry, ValidationFile, channel_name_unit,
};
