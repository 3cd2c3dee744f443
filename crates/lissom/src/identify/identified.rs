//! What identification gives.

use super::constant_velocity::ConstantVelocity;
use super::equivalent::Equivalent;
use super::finding::Finding;
use super::found_arm::FoundArm;
use super::friction_law::FrictionLaw;
use super::linear_models::LinearModels;
use super::output_error::OutputError;
use super::rational::{BeamFit, MotorFit};
use super::regression::{BeamRegression, MotorRegression};
use super::response_table::ResponsePoint;
use super::run_analysis::RunAnalysis;
use super::separability::Separability;
use super::third_harmonic::PairFigure;
use super::{Estimate, ModeEstimate};
use crate::drive::Falloff;

/// Figures of the report's own method.
#[derive(Debug, Clone)]
pub struct ThirdHarmonic {
    /// Every pair's figure.
    pub pairs: Vec<PairFigure>,
    /// Mean of the pairs that no finding flags (of all, where all are flagged).
    pub coulomb_command: Estimate,
    /// Standard deviation of one pair about that mean.
    pub spread_command: f64,
    /// Pairs in that mean.
    pub used: Vec<bool>,
    /// Rational fit of the response corrected with that mean, as in 6.2.2.
    pub motor: Option<MotorFit>,
}

/// Friction, in torque (or force).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Friction {
    /// Coulomb friction, mean of both directions.
    pub coulomb: Option<Estimate>,
    /// While moving forward.
    pub forward: Option<Estimate>,
    /// While moving backward.
    pub backward: Option<Estimate>,
    /// (forward − backward)/2.
    pub offset: Option<Estimate>,
    /// Viscous friction.
    pub viscous: Option<Estimate>,
    /// Viscous friction forward and backward, where the data reject one constant.
    pub viscous_by_direction: Option<(Estimate, Estimate)>,
    /// What friction has near rest beyond Coulomb's, where the data call for it.
    pub near_rest: Option<NearRestEstimate>,
    /// Waves over the travel, where the data show them.
    pub ripples: Vec<RippleEstimate>,
    /// What yields before the joint slips, where the replay calls for it.
    pub bristles: Option<BristlesEstimate>,
}

impl Friction {
    /// Friction against the motion at a speed in a direction (+1 or −1) \[N·m\], waves over the travel left out: positive
    /// where it brakes. `None` where a figure of it is refused.
    ///
    /// `C_± + V_±·|v| + A·e^{−|v|/v_s}` (or `A·e^{−(v/v_s)²}`).
    pub fn at(&self, speed: f64, direction: f64) -> Option<f64> {
        let forward = direction > 0.0;
        let coulomb = if forward { self.forward } else { self.backward }?;
        let viscous = match self.viscous_by_direction {
            Some((by_forward, by_backward)) => {
                if forward {
                    by_forward
                } else {
                    by_backward
                }
            }
            None => self.viscous?,
        };
        let near =
            self.near_rest.map_or(0.0, |n| n.torque.value * n.falloff.share(speed / n.speed.value));
        Some(coulomb.value + viscous.value * speed + near)
    }
}

/// Bristles that bend before the joint slips: `F = σ0·z + σ1·ż`, all of the law above the level that they slip at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BristlesEstimate {
    /// σ0.
    pub stiffness: Estimate,
    /// σ1.
    pub damping: Estimate,
    /// How far they bend at speed, C/σ0.
    pub travel: Estimate,
}

/// `s·A·e^{−|v|/v_s}` or `s·A·e^{−(v/v_s)²}`, s the direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearRestEstimate {
    /// A: friction at rest is C + A.
    pub torque: Estimate,
    /// v_s.
    pub speed: Estimate,
    /// Which of the two.
    pub falloff: Falloff,
}

/// `s·A·cos(k·θ + φ)`, s the direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RippleEstimate {
    /// A.
    pub torque: Estimate,
    /// k, radians of ripple per radian of angle (1/m on linear axes).
    pub per_angle: Estimate,
}

impl RippleEstimate {
    /// 2π/k: relative deviations of a frequency and its period are the same.
    pub fn period(&self) -> Estimate {
        let value = std::f64::consts::TAU / self.per_angle.value;
        Estimate { value, std: value * self.per_angle.std / self.per_angle.value }
    }
}

/// The beam's figures.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Beam {
    /// Modes with the motor clamped, ascending.
    pub modes: Vec<ModeEstimate>,
    /// Torque per angle between motor and beam, Σκ_i = h_{n+1} of (15).
    pub coupling: Option<Estimate>,
    /// κ_i of each tip of the campaign, `None` where its angle is not known; empty where none is.
    pub coupling_by_tip: Vec<Option<Estimate>>,
}

/// All that a campaign gave.
#[derive(Debug, Clone)]
pub struct Identified {
    /// Friction by the best method that the data carry.
    pub friction: Friction,
    /// Inertia or mass.
    pub inertia: Option<Estimate>,
    /// The beam.
    pub beam: Beam,
    /// The report's method.
    pub third_harmonic: Option<ThirdHarmonic>,
    /// Regression on slip phases.
    pub regression: Option<MotorRegression>,
    /// ‖y − X·q‖/‖y‖ of the regression, also where it is refused; `None` without windows enough.
    pub regression_residual: Option<f64>,
    /// Friction against speed, and its law; `None` without a regression.
    pub friction_law: Option<FrictionLaw>,
    /// Steady velocities extrapolated to rest; `None` where no line goes through any and no run was
    /// made for them.
    pub constant_velocity: Option<ConstantVelocity>,
    /// The beam's regression.
    pub beam_regression: Option<BeamRegression>,
    /// The runs replayed; `None` where it was not asked for or has nothing to start from.
    pub output_error: Option<OutputError>,
    /// What each run is.
    pub runs: Vec<RunAnalysis>,
    /// Responses, ascending in frequency.
    pub responses: Vec<ResponsePoint>,
    /// Rational model of the beam, fitted to its tips' responses.
    pub beam_model: Option<BeamFit>,
    /// Rational model of the motor, fitted to the corrected response.
    pub motor_model: Option<MotorFit>,
    /// Linear models of drive and beam: of the arm where the output error stands, else these fits.
    pub models: LinearModels,
    /// The equivalent arm of Section 4, where more than one tip's angle is known and the data carry it.
    pub equivalent: Option<Equivalent>,
    /// Which of these the logs separate, run by run; `None` without a covariance.
    pub separability: Option<Separability>,
    /// The arm that stands for these figures, to predict other logs with; `None` where they make none.
    pub arm: Option<FoundArm>,
    /// Torque per command used; `None`: figures are per unit of command.
    pub torque_per_command: Option<f64>,
    /// What the data could not carry.
    pub findings: Vec<Finding>,
}
