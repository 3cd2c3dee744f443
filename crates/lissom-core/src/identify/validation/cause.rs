//! What a residual of torque looks like: how much of it each term would take away by itself.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one")]
use strum::IntoStaticStr;

use crate::identify::validation::kernel::Kernel;
use crate::record::Run;

/// What may be wrong or missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum CauseKind {
    /// The command acts later than in the result.
    Delay,
    /// Inertia.
    Inertia,
    /// Viscous friction.
    Viscous,
    /// Viscous friction's difference by direction.
    ViscousByDirection,
    /// Coulomb friction.
    Coulomb,
    /// A constant torque.
    Offset,
    /// A torque that grows with position.
    Position,
    /// Friction that changes towards rest.
    NearRest,
    /// The torque between motor and beam, in proportion.
    Coupling,
}

/// All, in the order of a row's terms.
const KINDS: [CauseKind; 9] = [
    CauseKind::Delay,
    CauseKind::Inertia,
    CauseKind::Viscous,
    CauseKind::ViscousByDirection,
    CauseKind::Coulomb,
    CauseKind::Offset,
    CauseKind::Position,
    CauseKind::NearRest,
    CauseKind::Coupling,
];

/// One term beside the residual.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Cause {
    /// Which.
    #[cfg_attr(feature = "serde", serde(rename = "term"))]
    pub kind: CauseKind,
    /// Its coefficient: delay \[s\], inertia \[kg·m²\], viscous friction \[N·m·s/rad\], torque \[N·m\],
    /// torque per angle \[N·m/rad\], to be added to the estimate; of coupling the share of it to be added.
    pub value: f64,
    /// Share of the squared residual that it takes away by itself.
    pub share: f64,
    /// What the same recipe makes of the arm's own motion: reversals and noise look like it, too. Zero where
    /// that motion could not be followed.
    pub expected_value: f64,
}

impl Cause {
    /// Share of the squared residual that the value beyond `expected_value` takes away.
    pub fn share_beyond(&self) -> f64 {
        if self.value == 0.0 {
            return 0.0;
        }
        (self.share * (1.0 - self.expected_value / self.value).powi(2)).min(1.0)
    }
}

impl CauseKind {
    /// Its stable name.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Delay => "a delay of the command",
            Self::Inertia => "another inertia",
            Self::Viscous => "other viscous friction",
            Self::ViscousByDirection => "viscous friction that differs by direction",
            Self::Coulomb => "other Coulomb friction",
            Self::Offset => "a constant torque",
            Self::Position => "a torque that grows with position",
            Self::NearRest => "friction that changes near standstill",
            Self::Coupling => "another stiffness of the beam",
        }
    }
}

/// Products of the residual with each term, summed over rows.
#[derive(Debug, Clone)]
pub(super) struct Causes {
    speed: Vec<f64>,
    position: Vec<f64>,
    /// Direction at every sample; 0 at rest.
    sign: Vec<f64>,
    /// The direction times e^{−|v|/v̄}, v̄ the run's mean speed.
    near_rest: Vec<f64>,
    with_residual: [f64; KINDS.len()],
    squares: [f64; KINDS.len()],
    residual: f64,
}

impl Causes {
    /// Of a run whose velocity and direction are known at every sample.
    pub(super) fn new(run: &Run, velocity: &[f64], sign: Vec<f64>) -> Self {
        let speed: Vec<f64> = velocity.iter().map(|v| v.abs()).collect();
        let mean = speed.iter().sum::<f64>() / speed.len() as f64;
        let middle = run.motor().iter().sum::<f64>() / run.len() as f64;
        let slowness = speed.iter().map(|v| (-v / mean.max(f64::MIN_POSITIVE)).exp());
        Self {
            near_rest: slowness.zip(&sign).map(|(slow, sign)| sign * slow).collect(),
            sign,
            speed,
            position: run.motor().iter().map(|x| x - middle).collect(),
            with_residual: [0.0; KINDS.len()],
            squares: [0.0; KINDS.len()],
            residual: 0.0,
        }
    }

    /// Adds a row: its residual, the rate of the logged torque, acceleration, velocity and the torque between motor and beam.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        residual: f64,
        kernel: &Kernel,
        k: usize,
        [by_delay, acceleration, velocity, coupling]: [f64; 4],
    ) {
        let terms = [
            by_delay,
            acceleration,
            velocity,
            kernel.mean_of(&self.speed[k..]),
            kernel.mean_of(&self.sign[k..]),
            1.0,
            kernel.mean_of(&self.position[k..]),
            kernel.mean_of(&self.near_rest[k..]),
            coupling,
        ];
        for (i, term) in terms.into_iter().enumerate() {
            self.with_residual[i] += residual * term;
            self.squares[i] += term * term;
        }
        self.residual += residual * residual;
    }

    /// Over several runs, the largest share first.
    pub(super) fn of(runs: &[&Self]) -> Vec<Cause> {
        let residual: f64 = runs.iter().map(|r| r.residual).sum();
        let mut causes: Vec<Cause> = KINDS
            .into_iter()
            .enumerate()
            .map(|(i, kind)| {
                let product: f64 = runs.iter().map(|r| r.with_residual[i]).sum();
                let square: f64 = runs.iter().map(|r| r.squares[i]).sum();
                let known = square > 0.0 && residual > 0.0;
                let value = if known { product / square } else { 0.0 };
                let share = if known { value * product / residual } else { 0.0 };
                Cause { kind, value, share, expected_value: 0.0 }
            })
            .collect();
        causes.sort_by(|a, b| b.share.total_cmp(&a.share));
        causes
    }
}
