//! Identification: from logs to friction, inertia, coupling and modes, each with a standard error.
//!
//! [`identify`] does all steps and returns [`Identified`]. The methods can also be called alone on a [`Prepared`]
//! campaign: [`motor_regression`], [`beam_regression`], [`constant_velocity`], [`least_squares`], [`output_error`],
//! [`pair_estimate`]. [`validate`] compares a result with other logs; [`equivalent`](fn@equivalent) computes the
//! equivalent arm of Section 4 of the 1989 report. What the logs do not support is refused with a [`Finding`].

mod drive_estimates;
pub(crate) mod equivalent;
mod estimate;
pub mod findings;
mod found_arm;
mod friction_estimates;
mod geometry;
mod gravity_estimate;
mod identified;
mod interrupt;
pub(crate) mod judge;
mod linear_models;
pub(crate) mod methods;
mod options;
pub(crate) mod output_error;
mod payload;
mod pipeline;
pub(crate) mod prepare;
mod replayed_responses;
pub(crate) mod responses;
pub(crate) mod separability;
pub(crate) mod thresholds;
pub(crate) mod validation;

pub use drive_estimates::{BeamEstimates, DriveEstimates, Method};
pub use equivalent::{
    Equivalent, EquivalentArm, EquivalentBeam, EquivalentData, EquivalentError, EquivalentRefusal,
    PartOutside, ResponseZero, StdSource, StrainlessForm, equivalent, equivalent_arm,
    equivalent_beam, response_zeros,
};
pub use estimate::{Estimate, ModeEstimate, NORMAL_95};
pub use findings::{Finding, Severity};
pub use found_arm::{ArmSource, FoundArm, TorqueUsed};
pub use friction_estimates::{Friction, LawEstimates, NearRestEstimate, RippleEstimate};
pub use geometry::{ArmQuantity, Explanation, GeometryCheck, geometry_check};
pub use gravity_estimate::Gravity;
pub use identified::Identified;
pub use interrupt::Interrupt;
pub use linear_models::{LinearModels, ModelSource, TipModel};
pub use methods::constant_velocity::{
    ConstantVelocity, FrictionLine, LineError, LineShape, constant_velocity,
};
pub use methods::friction_law::{
    AngleLag, CurvePoint, FrictionLaw, LagShape, LawCandidate, LawFit, LawTerm, MissingKind,
    MissingTerm, ModelTerm, Moved, MovingTerm, ScaleUnit, UnusedTorque,
};
pub use methods::least_squares::{LeastSquares, least_squares};
pub use methods::regression::{
    BeamRegression, Candidate, GravityPartner, HiddenMode, HoldEvidence, HoldShown, LeftTorque,
    MotorRegression, OtherHold, RunDifference, beam_regression, hold_shown, motor_regression,
};
pub use methods::third_harmonic::{PairEstimate, ThirdHarmonic, mean_estimate, pair_estimate};
pub use options::{Effort, Options};
pub use output_error::{
    ByRun, Extension, Iteration, OutputError, OutputErrorStart, SearchEnd, StageReport, Stop,
    output_error, starts, starts_by_motor, starts_by_responses,
};
pub use payload::LoadedArm;
pub use pipeline::{IdentifyError, Stage, identify};
pub use prepare::prepared::Prepared;
pub use prepare::run_analysis::{RunAnalysis, RunKind, Sinusoidal, is_possible_sample_time};
pub use prepare::run_phasors::RunPhasors;
pub use prepare::steady_points::SteadyPoint;
pub use responses::correct::{Response, corrected, ratio};
pub use responses::rational::{
    BeamFit, Damping, MotorData, MotorFit, Pole, SharedPoles, SharedPolesError, Spurious, TipData,
    TipForm, fit_beam, fit_motor, fit_shared_poles, fit_shared_poles_by_evidence, without_origin,
};
pub use responses::response_point::ResponsePoint;
pub use separability::{
    Carried, Direction, DirectionPart, ParameterCertainty, RunShare, RunToAdd, Separability,
};
pub use validation::{
    Cause, CauseKind, ChannelFit, ChannelResidual, Horizon, LogPrediction, MovedBy, MovedMode,
    PredictedStretch, TorquePrediction, TorqueRun, TorqueStretch, TorqueTerms, Validation,
    ValidationError, ValidationOptions, predict_logs, validate,
};
