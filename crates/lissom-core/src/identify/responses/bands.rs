//! Frequency responses of runs that are not sinusoidal, in bands.

use num_complex::Complex64;

use crate::identify::estimate::Estimate;
use crate::identify::findings::{Finding, rows};
use crate::identify::prepare::channel_noise::channel_noise;
use crate::identify::prepare::phases::slip_sign;
use crate::identify::prepare::run_analysis::{RunAnalysis, RunKind};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::MotorFit;
use crate::identify::responses::response_point::{ResponsePoint, sticking_error};
use crate::identify::responses::thresholds::{
    BAND_COHERENCE, BAND_CONTRADICTED, BAND_POWER, BAND_UNCERTAIN, LONG_RUNS, NEAREST_BAND,
    SHORT_RUN, STUCK_LEAST,
};
use crate::record::{Campaign, Hold, Run};
use crate::spectrum::{Band, broadband, hold_factor, noise_power};

/// Runs that go into bands: usable, and neither sines nor constant velocities.
pub(crate) fn general(runs: &[RunAnalysis]) -> Vec<usize> {
    let general = |&i: &usize| runs[i].usable && matches!(runs[i].kind, RunKind::General);
    (0..runs.len()).filter(general).collect()
}

/// Without the runs that are much shorter than the longest: every band would be as wide as these resolve, and
/// sharp modes were lost. They stay where most of the time is theirs.
fn long_enough(campaign: &Campaign, runs: Vec<usize>) -> Vec<usize> {
    let duration_s = |&i: &usize| campaign.runs[i].len() as f64 * campaign.runs[i].sample_time_s();
    let longest_s = runs.iter().map(duration_s).fold(0.0, f64::max);
    let long: Vec<usize> =
        runs.iter().copied().filter(|i| duration_s(i) >= SHORT_RUN * longest_s).collect();
    let total_s = |runs: &[usize]| runs.iter().map(duration_s).sum::<f64>();
    if total_s(&long) >= LONG_RUNS * total_s(&runs) { long } else { runs }
}

/// Responses in bands without friction, which a method above gives.
pub(crate) trait WithoutFriction: Sync {
    /// The motor's response to the command at ω; `None` where no band is.
    fn motor(&self, omega_rad_s: f64) -> Option<Response>;
    /// A tip's response to the motor at ω.
    fn tip(&self, tip: usize, omega_rad_s: f64) -> Option<Response>;
}

/// Bands of all such runs. Friction is taken out by the replay where it describes the runs, else in
/// time, as `coulomb_command` against the smoothed velocity.
pub(crate) fn bands(
    campaign: &Campaign,
    runs: &[RunAnalysis],
    coulomb_command: Option<Estimate>,
    replayed: Option<&dyn WithoutFriction>,
) -> Vec<ResponsePoint> {
    let records = Records { campaign, runs: long_enough(campaign, general(runs)) };
    if records.runs.is_empty() {
        return Vec::new();
    }
    let motor = |i: usize| campaign.runs[i].motor().to_vec();
    let raw = records.spectrum(&|i| campaign.runs[i].command().to_vec(), &motor);
    let square = match (replayed, coulomb_command) {
        (None, Some(c)) => square_wave(&records, sure(c, runs, &records.runs)),
        _ => Vec::new(),
    };
    let tips: Vec<Vec<Band>> = (0..campaign.channels.tips.len())
        .map(|k| records.spectrum(&motor, &|i| campaign.runs[i].tips()[k].clone()))
        .collect();
    raw.iter()
        .filter(|b| b.coherence > BAND_COHERENCE && b.input_power > BAND_POWER)
        .map(|b| {
            let square = nearest(&square, b.omega_rad_s);
            let w = square.map_or(b.omega_rad_s, |c| c.omega_rad_s);
            let motor_corrected = match replayed {
                Some(replayed) => replayed.motor(w),
                None => square.map(|c| records.per_held(c, w)),
            };
            ResponsePoint {
                omega_rad_s: w,
                run: None,
                motor_raw: records.per_held(*b, w),
                motor_corrected,
                tips: tips
                    .iter()
                    .enumerate()
                    .map(|(k, bands)| {
                        let measured = nearest(bands, w)?;
                        let measured = Response { value: measured.response, std: measured.std };
                        Some(replayed.and_then(|r| r.tip(k, w)).unwrap_or(measured))
                    })
                    .collect(),
                flagged: motor_corrected.is_none(),
                square_wave: replayed.is_none(),
            }
        })
        .collect()
}

/// Friction with what takes it for a square wave adds to its standard error where the joint sticks.
fn sure(coulomb_command: Estimate, runs: &[RunAnalysis], general: &[usize]) -> Estimate {
    let stuck = general.iter().filter_map(|&i| runs[i].stuck_share).fold(STUCK_LEAST, f64::max);
    let std = coulomb_command.std.hypot(sticking_error(stuck) * coulomb_command.value);
    Estimate { std, ..coulomb_command }
}

/// Bands of the command without a square wave. The standard error counts that of friction, and the share that the
/// sensor's noise has in what the motor shows: the loop brings it back as a command, as coherent as motion is,
/// and draws the response to what the controller makes of it.
fn square_wave(records: &Records<'_>, coulomb_command: Estimate) -> Vec<Band> {
    let motor = |i: usize| records.campaign.runs[i].motor().to_vec();
    let with = |c: f64| records.spectrum(&|i| records.without_friction(i, c), &motor);
    let more = with(coulomb_command.value + coulomb_command.std);
    let mut bands = with(coulomb_command.value);
    let noise = records.motor_noise();
    for band in &mut bands {
        let moved = nearest(&more, band.omega_rad_s).map(|m| (m.response - band.response).norm());
        let of_noise = band.response.norm() * (noise / band.output_power).sqrt();
        band.std = band.std.hypot(moved.unwrap_or(f64::INFINITY)).hypot(of_noise);
    }
    bands
}

/// Runs whose spectra are averaged.
struct Records<'a> {
    campaign: &'a Campaign,
    runs: Vec<usize>,
}

impl Records<'_> {
    fn spectrum(
        &self,
        input: &dyn Fn(usize) -> Vec<f64>,
        output: &dyn Fn(usize) -> Vec<f64>,
    ) -> Vec<Band> {
        let time = |i: usize| self.campaign.runs[i].sample_time_s();
        let series: Vec<(Vec<f64>, Vec<f64>, f64)> =
            self.runs.iter().map(|&i| (input(i), output(i), time(i))).collect();
        broadband(&series.iter().map(|(u, y, t)| (&u[..], &y[..], *t)).collect::<Vec<_>>())
    }

    /// Mean power per bin of the noise in the motor's angle.
    fn motor_noise(&self) -> f64 {
        let runs: Vec<&Run> = self.runs.iter().map(|&i| &self.campaign.runs[i]).collect();
        let samples: Vec<usize> = runs.iter().map(|run| run.len()).collect();
        let times: Vec<f64> = runs.iter().map(|run| run.sample_time_s()).collect();
        let stds: Vec<f64> = runs.iter().map(|run| channel_noise(run.motor()).std).collect();
        noise_power(&samples, &times, &stds)
    }

    fn without_friction(&self, run: usize, coulomb_command: f64) -> Vec<f64> {
        let run = &self.campaign.runs[run];
        let sign = slip_sign(run.motor(), run.sample_time_s());
        run.command().iter().zip(sign).map(|(u, s)| u - coulomb_command * s).collect()
    }

    /// Per command as it was held. A hold delays by half a sample: runs of different sampling get the
    /// mean of theirs.
    fn per_held(&self, band: Band, omega_rad_s: f64) -> Response {
        let times = self.runs.iter().map(|&i| self.campaign.runs[i].sample_time_s());
        let mean = times.sum::<f64>() / self.runs.len() as f64;
        let factor = match self.campaign.channels.command.hold {
            Hold::Sampled => hold_factor(omega_rad_s, mean),
            Hold::Measured => Complex64::ONE,
        };
        Response { value: band.response / factor, std: band.std / factor.norm() }
    }
}

fn nearest(bands: &[Band], w: f64) -> Option<Band> {
    let near =
        |b: &&Band| (b.omega_rad_s / w - 1.0).abs() < NEAREST_BAND && b.coherence > BAND_COHERENCE;
    bands.iter().find(near).copied()
}

/// Flags the bands that are hardly known, and reports how many.
pub(crate) fn uncertain(responses: &mut [ResponsePoint]) -> Option<Finding> {
    let (mut number, mut all) = (0, 0);
    for point in responses.iter_mut().filter(|p| p.run.is_none()) {
        all += 1;
        let Some(corrected) = point.motor_corrected else { continue };
        let relative = corrected.std / corrected.value.norm();
        if relative.is_nan() || relative > BAND_UNCERTAIN {
            point.flagged = true;
            number += 1;
        }
    }
    let found = rows::BandsUncertain { bands: number, of: all, limit: BAND_UNCERTAIN };
    (number > 0).then(|| Finding::new(found))
}

/// Flags the bands whose corrected response the regression's model contradicts, and reports how many.
pub(crate) fn against(responses: &mut [ResponsePoint], model: &MotorFit) -> Option<Finding> {
    let mut number = 0;
    let bands = responses.iter_mut().filter(|p| p.run.is_none());
    let mut all = 0;
    for point in bands {
        all += 1;
        let Some(corrected) = point.motor_corrected else { continue };
        let expected = model.response(point.omega_rad_s);
        let distance = (corrected.value - expected).norm();
        if distance > BAND_CONTRADICTED * expected.norm() {
            point.flagged = true;
            number += 1;
        }
    }
    let found = rows::BandsContradicted { bands: number, of: all, limit: BAND_CONTRADICTED };
    (number > 0).then(|| Finding::new(found))
}
