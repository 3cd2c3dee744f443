//! Estimates of each method in JSON.

use lissom_core::identify::{
    BeamRegression, Candidate, DriveEstimates, Friction, HiddenMode, Identified, LeastSquares,
    MotorFit, MotorRegression, ThirdHarmonic,
};
use lissom_core::lti::TransferFunction;
use lissom_core::record::Channels;
use serde::{Deserialize, Serialize};

use super::constant_velocity_entry::ConstantVelocityEntry;
use super::estimate_entry::{BeamModeEntry, EstimateEntry, NumberEntry, finite};
use super::friction_entry::CoulombEntry;
use super::friction_law_entry::FrictionLawEntry;
use super::gravity_entry::GravityEntry;
use super::output_error_entry::OutputErrorEntry;
use super::unit_names::UnitNames;

/// Estimates of each method; null if the method was not used or the data do not allow it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MethodEntries {
    /// The third harmonic of pairs of sines, (26)-(30).
    pub third_harmonic: Option<ThirdHarmonicEntry>,
    /// The output-error method.
    pub output_error: Option<OutputErrorEntry>,
    /// Regression in slip phases.
    pub regression: Option<RegressionEntry>,
    /// Ordinary least squares of all motion: the method of many publications, and a baseline for the others.
    pub least_squares: Option<LeastSquaresEntry>,
    /// The friction law that the data support.
    pub friction_law: Option<FrictionLawEntry>,
    /// Friction from constant velocities, extrapolated to zero speed.
    pub constant_velocity: Option<ConstantVelocityEntry>,
}

/// Coulomb friction from the third harmonic.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ThirdHarmonicEntry {
    /// Mean of the pairs that are used, in the unit of the command.
    pub coulomb: EstimateEntry,
    /// Standard deviation of one pair around the mean.
    pub spread: NumberEntry,
    /// Every pair of sines.
    pub pairs: Vec<SinePairEntry>,
    /// Model (35) of the response that is corrected with this mean.
    pub fit: Option<MotorFitEntry>,
}

/// A sine and another at three times its frequency.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SinePairEntry {
    /// Lower frequency of the pair.
    pub omega_rad_s: f64,
    /// Run at this frequency.
    pub run: String,
    /// Run at three times this frequency.
    pub triple_run: String,
    /// Coulomb friction from this pair, in the unit of the command.
    pub coulomb: EstimateEntry,
    /// Cost (29) at its minimum.
    pub cost: f64,
    /// Whether the mean includes it.
    pub used: bool,
}

/// Rational model of the motor's response.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MotorFitEntry {
    /// Inertia or mass.
    pub inertia: EstimateEntry,
    /// Viscous friction, including back-EMF.
    pub viscous: EstimateEntry,
    /// Coupling through each mode.
    pub coupling_by_mode: Vec<EstimateEntry>,
    /// Motor angle per command as (35).
    pub motor: TransferFunction,
    /// Root mean square of the residuals relative to the standard errors of the response.
    pub weighted_rms: f64,
}

/// Estimates of the regression in slip phases.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RegressionEntry {
    /// Coulomb friction.
    #[serde(flatten)]
    pub coulomb: CoulombEntry,
    /// Viscous friction.
    pub viscous: Option<EstimateEntry>,
    /// Inertia or mass.
    pub inertia: Option<EstimateEntry>,
    /// Coupling by tip.
    pub coupling_by_tip: Vec<Option<EstimateEntry>>,
    /// Gravity; null unless the campaign asks for it.
    pub gravity: Option<GravityEntry>,
    /// A flexible mode without a tip, which the estimates account for; null if there is none.
    pub hidden_mode: Option<HiddenModeEntry>,
    /// Length of the window used.
    pub window_s: f64,
    /// Whether this length was given and not chosen.
    pub window_given: bool,
    /// Number of rows of the regression.
    pub rows: usize,
    /// Number of slip phases.
    pub phases: usize,
    /// Residual of the equation as a share of the windowed torque.
    pub relative_residual: f64,
    /// Window lengths that were tried.
    pub candidates: Vec<WindowEntry>,
    /// Regression of the beam's equation.
    pub beam: Option<BeamRegressionEntry>,
}

/// A flexible mode without a tip: part of the inertia is behind a spring, as the motor's motion shows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct HiddenModeEntry {
    /// Frequency with the motor clamped.
    pub natural_frequency_rad_s: EstimateEntry,
    /// Damping ratio with the motor clamped.
    pub damping_ratio: EstimateEntry,
    /// Inertia before the spring as a share of the whole inertia.
    pub inertia_share: EstimateEntry,
    /// Residual relative to that of the equation without the mode.
    pub residual_ratio: f64,
    /// Length of the windows with the smallest standard error of its frequency.
    pub window_s: f64,
}

impl HiddenModeEntry {
    fn of(mode: HiddenMode) -> Self {
        Self {
            natural_frequency_rad_s: EstimateEntry::of(mode.omega_rad_s, "rad/s"),
            damping_ratio: EstimateEntry::of(mode.damping_ratio, "1"),
            inertia_share: EstimateEntry::of(mode.inertia_share, "1"),
            residual_ratio: mode.residual_ratio,
            window_s: mode.window_s,
        }
    }
}

/// Ordinary least squares of all motion faster than 5 % of the largest speed: the method of many publications, and a
/// baseline for the others.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LeastSquaresEntry {
    /// Coulomb friction.
    #[serde(flatten)]
    pub coulomb: CoulombEntry,
    /// Viscous friction.
    pub viscous: Option<EstimateEntry>,
    /// Inertia or mass.
    pub inertia: Option<EstimateEntry>,
    /// Coupling by tip.
    pub coupling_by_tip: Vec<Option<EstimateEntry>>,
    /// Gravity; null unless the campaign asks for it.
    pub gravity: Option<GravityEntry>,
    /// Smallest and largest speed in the middle of a window.
    pub speed_range: NumberEntry<[f64; 2]>,
    /// Length of the windows.
    pub window_s: f64,
    /// Number of windows.
    pub rows: usize,
    /// Residual as a share of the windowed torque.
    pub relative_residual: f64,
}

/// A window length that was tried.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WindowEntry {
    /// Its length.
    pub window_s: f64,
    /// Number of rows of the regression.
    pub rows: usize,
    /// Number of slip phases.
    pub phases: usize,
    /// Residual of the equation as a share of the windowed torque.
    pub relative_residual: f64,
    /// Relative change of the estimates from the next shorter to the next longer window, rms; null at the ends.
    pub sensitivity: Option<f64>,
}

/// Regression of the beam's own equation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BeamRegressionEntry {
    /// Modes with the motor clamped.
    pub modes: Vec<BeamModeEntry>,
    /// Length of the window, by tip.
    pub window_s: Vec<f64>,
    /// Residual as a share of the acceleration, by tip.
    pub relative_residual: Vec<f64>,
}

impl MethodEntries {
    /// The entries of all methods.
    pub(crate) fn of(names: UnitNames, channels: &Channels, id: &Identified) -> Self {
        let third = id.third_harmonic.as_ref();
        let output_error = id.output_error.as_ref();
        let beam = id.beam_regression.as_ref();
        let velocity = id.constant_velocity.as_ref();
        Self {
            third_harmonic: third.map(|t| ThirdHarmonicEntry::of(names, t, id)),
            output_error: output_error.map(|o| OutputErrorEntry::of(names, channels, o)),
            regression: id.regression.as_ref().map(|r| RegressionEntry::of(names, r, beam)),
            least_squares: id.least_squares.as_ref().map(|l| LeastSquaresEntry::of(names, l)),
            friction_law: id.friction_law.as_ref().map(|l| FrictionLawEntry::of(names, l)),
            constant_velocity: velocity.map(|c| {
                let back_emf = channels.command.back_emf_viscous;
                ConstantVelocityEntry::of(names, c, back_emf, &id.runs)
            }),
        }
    }
}

impl ThirdHarmonicEntry {
    fn of(names: UnitNames, t: &ThirdHarmonic, id: &Identified) -> Self {
        let runs = &id.runs;
        let pairs = t.pairs.iter().zip(&t.used).map(|(p, used)| SinePairEntry {
            omega_rad_s: p.omega_rad_s,
            run: runs[p.run].name.clone(),
            triple_run: runs[p.triple_run].name.clone(),
            coulomb: EstimateEntry::of(p.coulomb_command, names.command_unit()),
            cost: p.cost,
            used: *used,
        });
        Self {
            coulomb: EstimateEntry::of(t.coulomb_command, names.command_unit()),
            spread: NumberEntry::of(t.spread_command, names.command_unit()),
            pairs: pairs.collect(),
            fit: id.third_harmonic_model.as_ref().map(|m| MotorFitEntry::of(names, m)),
        }
    }
}

impl MotorFitEntry {
    fn of(names: UnitNames, m: &MotorFit) -> Self {
        Self {
            inertia: EstimateEntry::of(m.inertia, names.inertia_unit()),
            viscous: EstimateEntry::of(m.viscous, names.viscous_unit()),
            coupling_by_mode: EstimateEntry::list(&m.coupling, names.coupling_unit()),
            motor: m.transfer_function.clone(),
            weighted_rms: m.weighted_rms,
        }
    }
}

impl RegressionEntry {
    fn of(names: UnitNames, r: &MotorRegression, beam: Option<&BeamRegression>) -> Self {
        let coulomb = Friction {
            coulomb: r.coulomb,
            forward: r.forward,
            backward: r.backward,
            offset: r.offset,
            ..Friction::default()
        };
        let coupling = r.coupling.iter().map(|e| EstimateEntry::or_null(*e, names.coupling_unit()));
        Self {
            coulomb: CoulombEntry::of(names, &coulomb),
            viscous: EstimateEntry::or_null(r.viscous, names.viscous_unit()),
            inertia: EstimateEntry::or_null(r.inertia, names.inertia_unit()),
            coupling_by_tip: coupling.collect(),
            gravity: r.gravity.as_ref().map(|g| GravityEntry::of(names, g, None)),
            hidden_mode: r.mode.map(HiddenModeEntry::of),
            window_s: r.window_s,
            window_given: r.window_given,
            rows: r.rows,
            phases: r.phases,
            relative_residual: r.relative_residual,
            candidates: r.candidates.iter().map(WindowEntry::of).collect(),
            beam: beam.map(|b| BeamRegressionEntry {
                modes: BeamModeEntry::list(&b.modes),
                window_s: b.window_s.clone(),
                relative_residual: b.relative_residual.clone(),
            }),
        }
    }
}

impl LeastSquaresEntry {
    fn of(names: UnitNames, fit: &LeastSquares) -> Self {
        let DriveEstimates { friction, inertia, coupling_by_tip, gravity, .. } = &fit.estimates;
        let coupling =
            coupling_by_tip.iter().map(|e| EstimateEntry::or_null(*e, names.coupling_unit()));
        Self {
            coulomb: CoulombEntry::of(names, friction),
            viscous: EstimateEntry::or_null(friction.viscous, names.viscous_unit()),
            inertia: EstimateEntry::or_null(*inertia, names.inertia_unit()),
            coupling_by_tip: coupling.collect(),
            gravity: gravity.as_ref().map(|g| GravityEntry::of(names, g, None)),
            speed_range: NumberEntry::of(fit.speed_range, names.speed_unit()),
            window_s: fit.window_s,
            rows: fit.rows,
            relative_residual: fit.relative_residual,
        }
    }
}

impl WindowEntry {
    fn of(c: &Candidate) -> Self {
        Self {
            window_s: c.window_s,
            rows: c.rows,
            phases: c.clusters,
            relative_residual: c.relative_residual,
            sensitivity: finite(c.sensitivity),
        }
    }
}
