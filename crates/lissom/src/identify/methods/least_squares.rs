//! Ordinary least squares of the motor's equation: the baseline that other methods must beat.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::methods::regression::{
    Cluster, Fitted, Term, coupled_tips, slip_phases, smoothing, solve,
};
use crate::identify::methods::thresholds::{ACCELERATION_NOISE, SLOWEST_SAMPLE};
use crate::identify::prepare::channel_noise::channel_noise;
use crate::identify::prepare::prepared::Prepared;
use crate::record::{Campaign, Hold, Run, TipQuantity};

/// Shortest and longest half width of the smoothing \[samples\].
///
/// Convention.
const HALF_WIDTHS: [usize; 2] = [4, 512];
/// Column of each term; those of the tips follow.
const INERTIA: usize = 0;
const VISCOUS: usize = 1;
const DRY: usize = 2;
const TIPS: usize = 3;

/// Estimates of the motor's equation by ordinary least squares.
#[derive(Debug, Clone)]
pub struct LeastSquares {
    /// Inertia, Coulomb and viscous friction, offset, and couplings where tips show angles.
    pub estimates: DriveEstimates,
    /// Least and largest speed of the samples used \[rad/s or m/s\].
    pub speed_range: [f64; 2],
    /// Samples used.
    pub samples: usize,
    /// ‖y − X·q‖/‖y‖: part of the smoothed torque that is left.
    pub relative_residual: f64,
    /// Products of all rows, forward and backward.
    products: [Cluster; 2],
    /// Tips whose coupling is in the equation.
    tips: Vec<usize>,
    back_emf_viscous: f64,
}

/// Fits `τ = J·θ̈ + V·θ̇ + C·sgn θ̇ + O + Σκ_i(θ_m − θ_i)` to smoothed samples, all with the same weight.
///
/// Parabolas over neighbouring samples give angle, velocity and acceleration, and the torque is smoothed in the same
/// way; they are as short as the sensor's noise lets the acceleration be. Used are samples in slip phases faster than
/// 5 % of the largest speed. Standard errors take slip phases as independent.
///
/// τ is the command times its torque constant \[N·m, N, or the command's unit where the constant is unknown\].
/// `None` where too few samples slip.
///
/// ```
/// # use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
/// # let (t, w) = (0.002, 3.0);
/// # let wave = |f: &dyn Fn(f64) -> f64| (0..10_000).map(|k| f(t * f64::from(k))).collect::<Vec<f64>>();
/// # let motor = wave(&|s| (w * s).sin());
/// # let torque = wave(&|s| -0.02 * w * w * (w * s).sin() + 0.05 * w * (w * s).cos() + 0.3 * (w * s).cos().signum());
/// # let command = Command { quantity: CommandQuantity::Current, hold: Hold::Measured, torque_per_command: Some(1.0), back_emf_viscous: 0.0, limit: None };
/// # let run = Run::new("sine", TimeBase::uniform(0.0, t), torque, motor, vec![]).unwrap();
/// # let campaign = Campaign::new(Channels { axis: Axis::Rotary, command, tips: vec![] }, vec![run]).unwrap();
/// use lissom::identify::{Prepared, least_squares}; // of a sine with J = 0.02, V = 0.05, C = 0.3
/// let prepared = Prepared::of(&campaign);
/// let fit = least_squares(&prepared).unwrap();
/// assert!((fit.estimates.friction.coulomb.unwrap().value - 0.3).abs() < 1e-3);
/// ```
///
/// # Source
/// `[Feliu1989, eqs. (14), (15)]` is the equation.
pub fn least_squares(prepared: &Prepared<'_>) -> Option<LeastSquares> {
    let campaign = prepared.used();
    let tips = coupled_tips(campaign);
    let runs: Vec<Smoothed<'_>> = campaign.runs.iter().map(Smoothed::new).collect();
    let fastest = runs.iter().map(Smoothed::fastest).fold(0.0, f64::max);
    let least = SLOWEST_SAMPLE * fastest;
    let mut clusters = Vec::new();
    let mut slowest = f64::INFINITY;
    for (index, smoothed) in runs.iter().enumerate() {
        for phase in slip_phases(smoothed.run.motor(), smoothed.smooth, smoothed.sample_s) {
            let mut cluster = Cluster::new(index, phase.sign, TIPS + tips.len() + 1);
            let mut k = phase.from + smoothed.half;
            while k + smoothed.half < phase.to {
                let speed = smoothed.velocity(k) * phase.sign;
                if speed > least {
                    cluster.add(&smoothed.row(campaign, &tips, k));
                    slowest = slowest.min(speed);
                }
                k += smoothed.stride();
            }
            if cluster.rows > 0 {
                clusters.push(cluster);
            }
        }
    }
    let mut terms =
        vec![Term::Plain(INERTIA), Term::Plain(VISCOUS), Term::Signed(DRY), Term::Plain(DRY)];
    terms.extend((0..tips.len()).map(|i| Term::Plain(TIPS + i)));
    let samples: usize = clusters.iter().map(|c| c.rows).sum();
    if clusters.len() < 2 || samples < 3 * terms.len() {
        return None;
    }
    let solution = solve(&clusters, &terms)?;
    // One width of smoothing: no change with it is known.
    let unchanged = vec![0.0; terms.len()];
    let fitted = Fitted { solution: &solution, change: &unchanged, tips: &tips };
    let mut products = [1.0, -1.0].map(|sign| Cluster::new(0, sign, TIPS + tips.len() + 1));
    for cluster in &clusters {
        products[usize::from(cluster.sign < 0.0)].merge(cluster);
    }
    Some(LeastSquares {
        estimates: fitted.estimates(&campaign.channels),
        speed_range: [slowest, fastest],
        samples,
        relative_residual: solution.relative_residual,
        products,
        back_emf_viscous: campaign.channels.command.back_emf_viscous,
        tips,
    })
}

impl LeastSquares {
    /// Part of the smoothed torque that other estimates of the same equation leave in these samples, viscous friction
    /// by direction where they have it. `None` where one of them is missing.
    pub fn left_by(&self, other: &DriveEstimates) -> Option<f64> {
        let friction = &other.friction;
        let (coulomb, offset) = (friction.coulomb?.value, friction.offset?.value);
        let inertia = other.inertia?.value;
        let coupling = |tip: &usize| Some(other.coupling_by_tip.get(*tip).copied()??.value);
        let couplings = self.tips.iter().map(coupling).collect::<Option<Vec<f64>>>()?;
        let (mut left, mut power) = (0.0, 0.0);
        for cluster in &self.products {
            let viscous = match friction.viscous_by_direction {
                Some((forward, _)) if cluster.sign > 0.0 => forward,
                Some((_, backward)) => backward,
                None => friction.viscous?,
            };
            let mut q = vec![inertia, viscous.value + self.back_emf_viscous];
            q.push(cluster.sign * coulomb + offset);
            q.extend(&couplings);
            q.push(-1.0);
            let last = q.len() - 1;
            for (i, a) in q.iter().enumerate() {
                for (j, b) in q.iter().enumerate() {
                    left += a * b * cluster.products[(i, j)];
                }
            }
            power += cluster.products[(last, last)];
        }
        (power > 0.0).then(|| (left.max(0.0) / power).sqrt())
    }
}

/// A run with the parabolas that smooth it.
struct Smoothed<'a> {
    run: &'a Run,
    sample_s: f64,
    /// Samples over which the velocity is smoothed for its sign.
    smooth: usize,
    /// Samples to either side in a parabola.
    half: usize,
}

impl<'a> Smoothed<'a> {
    /// With parabolas as short as the motor sensor's noise allows.
    fn new(run: &'a Run) -> Self {
        let smooth = smoothing(run.motor());
        let [shortest, longest] = HALF_WIDTHS;
        let half = shortest.max(smooth / 2);
        let mut found = Self { run, sample_s: run.sample_time_s(), smooth, half };
        let noise = channel_noise(run.motor()).std;
        while found.half < longest.min(run.len() / 8) && found.is_noisy(noise) {
            found.half = found.half * 3 / 2;
        }
        found
    }

    /// Whether noise of this standard deviation makes more than [`ACCELERATION_NOISE`] of the acceleration's power:
    /// `720·σ²/(n·(n² − 1)·(n² − 4)·T⁴)` of a parabola through n samples.
    fn is_noisy(&self, noise: f64) -> bool {
        let n = (2 * self.half + 1) as f64;
        let of_noise =
            720.0 * noise * noise / (n * (n * n - 1.0) * (n * n - 4.0) * self.sample_s.powi(4));
        let places = (self.half..self.run.len() - self.half).step_by(self.stride());
        let (mut power, mut count) = (0.0, 0.0);
        for k in places {
            power += self.acceleration(k).powi(2);
            count += 1.0;
        }
        of_noise > ACCELERATION_NOISE * power / f64::max(count, 1.0)
    }

    /// Samples from one row to the next: parabolas nearer to each other say the same.
    fn stride(&self) -> usize {
        (self.half / 2).max(1)
    }

    fn fastest(&self) -> f64 {
        let places = (self.half..self.run.len().saturating_sub(self.half)).step_by(self.stride());
        places.map(|k| self.velocity(k).abs()).fold(0.0, f64::max)
    }

    /// Σ i²  and Σ i⁴ over the parabola's places i.
    fn moments(&self) -> (f64, f64, f64) {
        let h = self.half as f64;
        let n = 2.0 * h + 1.0;
        let second = h * (h + 1.0) * n / 3.0;
        (n, second, second * (3.0 * h * h + 3.0 * h - 1.0) / 5.0)
    }

    fn sum(&self, x: &[f64], k: usize, weight: impl Fn(f64) -> f64) -> f64 {
        let h = self.half as f64;
        let places = x[k - self.half..=k + self.half].iter().enumerate();
        places.map(|(i, x)| weight(i as f64 - h) * x).sum()
    }

    fn velocity(&self, k: usize) -> f64 {
        let (_, second, _) = self.moments();
        let x = self.run.motor();
        self.sum(x, k, |i| i) / (second * self.sample_s)
    }

    fn acceleration(&self, k: usize) -> f64 {
        let (n, second, fourth) = self.moments();
        let curve = self.sum(self.run.motor(), k, |i| n * i * i - second);
        2.0 * curve / ((n * fourth - second * second) * self.sample_s * self.sample_s)
    }

    /// The parabola's own value in its middle.
    fn value(&self, x: &[f64], k: usize) -> f64 {
        let (n, second, fourth) = self.moments();
        self.sum(x, k, |i| fourth - i * i * second) / (n * fourth - second * second)
    }

    /// Acceleration, velocity, one, θ_m − θ_i of the tips, torque.
    fn row(&self, campaign: &Campaign, tips: &[usize], k: usize) -> Vec<f64> {
        let (channels, run) = (&campaign.channels, self.run);
        let mut row = vec![self.acceleration(k), self.velocity(k), 1.0];
        row.extend(tips.iter().map(|&i| {
            let tip = self.value(&run.tips()[i], k);
            match channels.tips[i].quantity {
                TipQuantity::Deflection => -tip,
                _ => self.value(run.motor(), k) - tip,
            }
        }));
        let command = self.value(run.command(), k);
        // Held from each sample to the next: half of it is the sample before.
        let held = channels.command.hold == Hold::Sampled && k > self.half;
        let command =
            if held { 0.5 * (command + self.value(run.command(), k - 1)) } else { command };
        row.push(command * channels.command.torque_per_unit());
        row
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Axis, Channels, Command, CommandQuantity, TimeBase};

    const INERTIA_KG_M2: f64 = 0.02;

    fn campaign(hold: Hold, noise: f64) -> Campaign {
        let sample_s = 1e-3;
        let wave = |of: &dyn Fn(f64) -> f64, shift: f64| -> Vec<f64> {
            (0..20_000).map(|k| of(sample_s * (f64::from(k) + shift))).collect()
        };
        let (slow, fast) = (2.0_f64, 7.0_f64);
        let angle = |t: f64| (slow * t).sin() + 0.2 * (fast * t).sin();
        let torque = |t: f64| {
            let v = slow * (slow * t).cos() + 0.2 * fast * (fast * t).cos();
            let a = -slow * slow * (slow * t).sin() - 0.2 * fast * fast * (fast * t).sin();
            INERTIA_KG_M2 * a + 0.05 * v + 0.3 * v.signum() + 0.04
        };
        // A held command is the mean over its sample.
        let shift = if hold == Hold::Sampled { 0.5 } else { 0.0 };
        let mut seed = 1_u32;
        let motor = wave(&angle, 0.0).into_iter().map(|x| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            x + noise * (f64::from(seed >> 8) / f64::from(1 << 24) - 0.5)
        });
        let motor = motor.collect();
        let run = Run::new(
            "sines",
            TimeBase::uniform(0.0, sample_s),
            wave(&torque, shift),
            motor,
            vec![],
        );
        let command = Command {
            quantity: CommandQuantity::Current,
            hold,
            torque_per_command: Some(1.0),
            back_emf_viscous: 0.01,
            limit: None,
        };
        let channels = Channels { axis: Axis::Rotary, command, tips: vec![] };
        Campaign::new(channels, vec![run.unwrap()]).unwrap()
    }

    /// Of a motion whose torque is known, with either hold and with a noisy encoder.
    #[test]
    fn the_equation_of_a_known_motion_is_found() {
        for (hold, noise, within) in
            [(Hold::Measured, 0.0, 2e-3), (Hold::Sampled, 0.0, 2e-3), (Hold::Measured, 1e-3, 0.03)]
        {
            let campaign = campaign(hold, noise);
            let found = least_squares(&Prepared::of(&campaign)).unwrap();
            let (friction, inertia) = (&found.estimates.friction, found.estimates.inertia.unwrap());
            for (name, value, truth) in [
                ("inertia", inertia.value, INERTIA_KG_M2),
                ("viscous", friction.viscous.unwrap().value, 0.04),
                ("Coulomb", friction.coulomb.unwrap().value, 0.3),
                ("offset", friction.offset.unwrap().value, 0.04),
            ] {
                assert!((value / truth - 1.0).abs() < within, "{hold:?} {noise}: {name} {value}");
            }
        }
    }

    /// Nothing of the same equation leaves less, and a wrong inertia leaves more.
    #[test]
    fn no_other_estimates_leave_less() {
        let campaign = campaign(Hold::Measured, 1e-3);
        let found = least_squares(&Prepared::of(&campaign)).unwrap();
        let own = found.left_by(&found.estimates).unwrap();
        assert!((own - found.relative_residual).abs() < 1e-6, "{own}");
        let mut other = found.estimates.clone();
        other.inertia = other.inertia.map(|e| e.scaled(1.2));
        assert!(found.left_by(&other).unwrap() > 2.0 * own);
    }
}
