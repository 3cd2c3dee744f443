//! The smallest standard errors that any unbiased estimator can have on a campaign.

use lissom::information::{Inverse, inverted, propagated, without_own};
use lissom::replay::{
    ArmModes, ModalArm, Parameter, Sampling, SensorNoise, Window, WindowSums, sums,
};
use nalgebra::DMatrix;

use crate::campaign::Campaign;
use crate::law::Law;
use crate::scored_parameter::ScoredParameter;

/// Step of the finite differences of a derived parameter, relative to the bound of a parameter.
const DIFFERENCE: f64 = 1e-3;

/// Cramér-Rao bounds of the parameters of a campaign.
///
/// The logged command is replayed through the true arm over whole runs, with exact derivatives of all
/// readings by the unknowns: J, V, CF, offset; frequency, stiffness and damping of each mode; the
/// shares of the tips in the modes; the initial state of each run and the zero of each tip. The
/// inverse of `Σ gᵀ·g/σ²` over all readings is the bound of their covariance.
///
/// A sensor with noise of standard deviation s and steps q has σ² = s² + q²/12, as if the steps were
/// independent Gaussian noise. Readings in steps with little noise contain more information.
///
/// # Source
/// `[Kay1993, Sections 3.7, 3.8]`
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    /// The bounds of the parameters.
    estimates: Vec<(ScoredParameter, f64)>,
    /// Residual of each channel divided by σ: 1 if the replay is the true motion.
    pub left: Vec<f64>,
}

impl Bound {
    /// The bound of a campaign; `None` if the joint has another friction law than the replay, or if
    /// the readings do not determine all unknowns.
    pub fn of(campaign: &Campaign) -> Option<Self> {
        let rig = &campaign.definition.rig;
        if !matches!(campaign.law, Law::None | Law::Direction | Law::BeamDamping) {
            return None;
        }
        let arm = ModalArm::of_arm(&rig.arm)?;
        let modes = ArmModes::of(&rig.arm)?;
        let all: Vec<usize> = (0..arm.modes.len()).collect();
        let tips = campaign.logs.channels.tips.len();
        let noise: Vec<SensorNoise> = std::iter::once(rig.instruments.motor)
            .chain((0..tips).map(|tip| rig.instruments.tip(tip)))
            .map(|sensor| SensorNoise::gaussian(sensor.deviation()))
            .collect();
        let windows = campaign.facts.iter().enumerate().map(|(run, facts)| Window {
            run,
            samples: 0..=campaign.logs.runs[run].len() - 1,
            start: modes.state(&all, &facts.start),
            zeros: vec![0.0; tips],
        });
        let windows: Vec<Window> = windows.collect();
        let masks = vec![vec![None; 1 + tips]; windows.len()];
        let sampling = Sampling { noise: &noise, blocks: &[], masks: &masks, command_noise: 0.0 };
        let parameters = unknowns(&arm, campaign.law);
        let sums = sums(&arm, &parameters, &campaign.logs, &windows, sampling);
        let shared = parameters.len();
        let of_window = |(sums, window): (&WindowSums, &Window)| {
            let size = sums.gram.ncols() - 1;
            without_own(&sums.gram.view((0, 0), (size, size)).into_owned(), shared, window)
        };
        let information: DMatrix<f64> = sums.iter().zip(&windows).map(of_window).sum();
        let Inverse { matrix: covariance, lost } = inverted(&information);
        if lost.contains(&true) {
            return None;
        }
        let left = (0..=tips).map(|c| left(&sums, c) / noise[c].sigma).collect();
        Some(Self { estimates: estimates(&arm, &parameters, &covariance), left })
    }

    /// The smallest standard error of a parameter, in its unit.
    pub fn std(&self, parameter: ScoredParameter) -> Option<f64> {
        self.estimates.iter().find(|(f, _)| *f == parameter).map(|(_, std)| *std)
    }
}

/// The unknowns of an estimator that knows the kind of damping.
fn unknowns(arm: &ModalArm, law: Law) -> Vec<Parameter> {
    let modes = arm.modes.len();
    let mut all =
        vec![Parameter::Inertia, Parameter::Viscous, Parameter::Coulomb, Parameter::Offset];
    for j in 0..modes {
        all.extend([Parameter::Frequency(j), Parameter::Stiffness(j)]);
        all.push(match law {
            Law::BeamDamping => Parameter::DampingWithin(j),
            _ => Parameter::DampingAtPoint(j),
        });
    }
    let shares = |i| (0..modes).map(move |j| Parameter::Shape(i, j));
    all.extend((0..arm.shapes.len()).flat_map(shares));
    all
}

/// Root mean square of the residual of a channel \[rad\].
fn left(sums: &[WindowSums], channel: usize) -> f64 {
    let squares: f64 = sums.iter().map(|s| s.squares[channel]).sum();
    let readings: usize = sums.iter().map(|s| s.readings[channel]).sum();
    (squares / readings as f64).sqrt()
}

fn estimates(
    arm: &ModalArm,
    parameters: &[Parameter],
    covariance: &DMatrix<f64>,
) -> Vec<(ScoredParameter, f64)> {
    let std =
        |of: &dyn Fn(&ModalArm) -> f64| propagated(arm, parameters, covariance, DIFFERENCE, of);
    let mut all = vec![
        (ScoredParameter::Coulomb, std(&|a| a.coulomb_nm)),
        (ScoredParameter::Forward, std(&|a| a.coulomb_nm + Parameter::Offset.of(a))),
        (ScoredParameter::Backward, std(&|a| a.coulomb_nm - Parameter::Offset.of(a))),
        (ScoredParameter::Inertia, std(&|a| a.inertia_kg_m2)),
        (ScoredParameter::Coupling, std(&ModalArm::coupling_nm_per_rad)),
        (ScoredParameter::Viscous, std(&|a| Parameter::Viscous.of(a))),
    ];
    for j in 0..arm.modes.len() {
        all.push((ScoredParameter::Frequency(j), std(&|a| a.clamped_modes()[j].0)));
        all.push((ScoredParameter::Damping(j), std(&|a| a.clamped_modes()[j].1)));
    }
    all
}

#[cfg(test)]
mod tests {
    use lissom::information::inverse;
    use lissom::replay::predict;
    use nalgebra::DVector;

    use super::*;
    use crate::campaign::draw_campaign;

    /// Campaigns of seed 1 with one, two and three masses and noise of 0.3 steps or more.
    const NOISY: [usize; 3] = [6, 5, 20];

    fn campaign(masses: usize) -> Campaign {
        let campaign = draw_campaign(1, NOISY[masses - 1], Law::None).unwrap();
        assert_eq!(campaign.stratum.masses, masses);
        assert!(campaign.stratum.noise_steps.unwrap() >= 0.3);
        campaign
    }

    /// The residual of the true arm is only noise and steps of the sensors. 2 % are five standard
    /// deviations of the root mean square of 30 000 independent readings. Without noise the readings of
    /// a sine are not independent: the errors of the steps repeat in each period.
    #[test]
    fn the_true_arm_leaves_the_noise() {
        for masses in 1..=3 {
            let bound = Bound::of(&campaign(masses)).unwrap();
            assert!(
                bound.left.iter().all(|r| (r - 1.0).abs() < 0.02),
                "{masses}: {:?}",
                bound.left
            );
        }
    }

    /// The information of one run from finite differences of predictions, for all unknowns together.
    #[test]
    fn the_bound_is_that_of_differences() {
        let mut one = campaign(1);
        one.logs.runs.truncate(1);
        one.facts.truncate(1);
        let arm = ModalArm::of_arm(&one.definition.rig.arm).unwrap();
        let parameters = unknowns(&arm, Law::None);
        let window = Window {
            run: 0,
            samples: 0..=one.logs.runs[0].len() - 1,
            start: ArmModes::of(&one.definition.rig.arm).unwrap().state(&[0], &one.facts[0].start),
            zeros: vec![0.0],
        };
        assert!(window.start[1] != 0.0, "the joint slips at the start");
        let rig = &one.definition.rig;
        let sigma = [rig.instruments.motor.deviation(), rig.instruments.tip(0).deviation()];
        let shown = |arm: &ModalArm, window: &Window| {
            let channels = predict(arm, &one.logs, window).unwrap().channels;
            let weighed = channels.iter().zip(sigma);
            weighed.flat_map(|(c, s)| c.iter().map(move |v| v / s)).collect::<Vec<f64>>()
        };
        let mut columns = Vec::new();
        let mut column = |change: &dyn Fn(f64) -> Vec<f64>, step: f64| {
            let pairs = change(step).into_iter().zip(change(-step));
            columns.push(DVector::from_vec(pairs.map(|(a, b)| (a - b) / (2.0 * step)).collect()));
        };
        for p in &parameters {
            let with = |change: f64| {
                let mut moved = arm.clone();
                p.set(&mut moved, p.of(&arm) + change);
                shown(&moved, &window)
            };
            let size = if *p == Parameter::Offset { arm.coulomb_nm } else { p.of(&arm) };
            column(&with, 1e-6 * size);
        }
        for i in 0..window.start.len() {
            let with = |change: f64| {
                let mut window = window.clone();
                window.start[i] += change;
                shown(&arm, &window)
            };
            column(&with, 1e-7);
        }
        let zero = |change: f64| {
            let window = Window { zeros: vec![change], ..window.clone() };
            shown(&arm, &window)
        };
        column(&zero, 1e-3);
        let jacobian = DMatrix::from_columns(&columns);
        let covariance = inverse(&(jacobian.transpose() * &jacobian));
        let bound = Bound::of(&one).unwrap();
        for (at, parameter) in [
            (0, ScoredParameter::Inertia),
            (1, ScoredParameter::Viscous),
            (2, ScoredParameter::Coulomb),
            (4, ScoredParameter::Frequency(0)),
            (5, ScoredParameter::Coupling),
        ] {
            let ratio = bound.std(parameter).unwrap() / covariance[(at, at)].sqrt();
            assert!((ratio - 1.0).abs() < 0.01, "{parameter}: {ratio}");
        }
    }
}
