//! Standard errors of responses that came without any: whether errors are a share of each
//! response, a constant, or both.

use crate::identify::equivalent::data::EquivalentData;
use crate::identify::equivalent::sound::median;
use crate::identify::equivalent::thresholds::OUTPUT_ERROR_LEAST;
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::{
    MotorData, Pole, SharedPoles, fit_coupling, fit_shared_poles_with_delays,
};

/// Shares of the error's square that are of one size at the median response, the rest a share of each.
const MIXES: [f64; 9] = [0.0, 1e-4, 1e-3, 0.01, 0.1, 0.5, 0.9, 0.99, 1.0];
/// What is left is rounding below this share of the responses.
const ROUNDING: f64 = 1e-9;

/// The points' responses with the standard errors that are most likely, but for one factor, and their fit: from errors
/// that are a share of each response (as `data` come, and their `fit`), of one size, and as what those leave says.
pub(super) fn of_points(
    data: &EquivalentData,
    fit: SharedPoles,
    most: usize,
) -> (Vec<Vec<Response>>, SharedPoles) {
    let readings = 2 * data.omega_rad_s.len() * data.outputs.len();
    let judged = |fit: SharedPoles, outputs: Vec<Vec<Response>>| {
        let criterion = fit.criterion() + spread(outputs.iter().flatten());
        FittedPoles { fit, outputs, readings, criterion }
    };
    let fitted = |outputs: Vec<Vec<Response>>| {
        let fit = fit_shared_poles_with_delays(&data.omega_rad_s, &outputs, most).ok()?;
        Some(judged(fit, outputs))
    };
    let shares = judged(fit, data.outputs.clone());
    let size = share(&data.outputs[0]);
    if shares.left() < ROUNDING {
        return (shares.outputs, shares.fit);
    }
    let better = |a: FittedPoles, b: FittedPoles| if b.criterion < a.criterion { b } else { a };
    let one_size = fitted(data.outputs.iter().map(|output| of_one_size(output, size)).collect());
    let best = one_size.into_iter().fold(shares, better);
    let mixed = fitted(best.mixed(&data.omega_rad_s, size));
    // A mix and a size of each output.
    let cost = (2 * data.outputs.len()) as f64 * (readings as f64).ln();
    let mixed = mixed.map(|m| FittedPoles { criterion: m.criterion + cost, ..m });
    let best = mixed.into_iter().fold(best, better);
    (best.outputs, best.fit)
}

/// The same of the motor's response.
pub(super) fn of_motor(motor: &MotorData, fit: &SharedPoles, beyond: &[Pole]) -> MotorData {
    let fitted = |response: Vec<Response>| {
        let data = MotorData { response, ..motor.clone() };
        let criterion = fit_coupling(&data, fit, beyond)?.criterion;
        Some((criterion + spread(data.response.iter()), data))
    };
    let size = share(&motor.response);
    let each = [motor.response.clone(), of_one_size(&motor.response, size)];
    let each = each.into_iter().filter_map(fitted);
    each.min_by(|a, b| a.0.total_cmp(&b.0)).map_or_else(|| motor.clone(), |best| best.1)
}

struct FittedPoles {
    fit: SharedPoles,
    outputs: Vec<Vec<Response>>,
    readings: usize,
    /// Bayesian information criterion, the standard errors' sizes counted.
    criterion: f64,
}

/// 2·Σ ln σ: what the likelihood has of the standard errors beside the residuals.
fn spread<'a>(responses: impl Iterator<Item = &'a Response>) -> f64 {
    2.0 * responses.map(|r| r.std.ln()).sum::<f64>()
}

/// StdSource as a share of their responses, as they come.
fn share(output: &[Response]) -> f64 {
    median(output.iter().map(|r| r.std / r.value.norm())).unwrap_or(1.0)
}

fn median_size(output: &[Response]) -> f64 {
    median(output.iter().map(|r| r.value.norm())).unwrap_or(1.0)
}

fn of_one_size(output: &[Response], share: f64) -> Vec<Response> {
    let std = share * median_size(output);
    output.iter().map(|r| Response { std, ..*r }).collect()
}

impl FittedPoles {
    /// Root mean square of what is left, as a share of each response.
    fn left(&self) -> f64 {
        let all = self.outputs.iter().flatten();
        let share: f64 = all.map(|r| (r.std / r.value.norm()).powi(2)).sum();
        self.fit.weighted_rms * (2.0 * share / self.readings as f64).sqrt()
    }

    /// Standard errors of each output from its residual: the most likely mix of a share and of one size.
    fn mixed(&self, omega_rad_s: &[f64], size: f64) -> Vec<Vec<Response>> {
        let found: Vec<(f64, Vec<f64>)> = (0..self.outputs.len())
            .map(|i| {
                let median = median_size(&self.outputs[i]);
                let each = omega_rad_s.iter().zip(&self.outputs[i]);
                let each: Vec<(f64, f64)> = each
                    .map(|(w, r)| {
                        let model = self.fit.response(i, *w);
                        (model.norm() / median, (r.value - model).norm_sqr())
                    })
                    .collect();
                let tried = MIXES.map(|mix| {
                    let shape: Vec<f64> =
                        each.iter().map(|e| ((1.0 - mix) * e.0 * e.0 + mix).max(1e-12)).collect();
                    let squares = each.iter().zip(&shape).map(|(e, s)| e.1 / s).sum::<f64>();
                    let scale = (squares / each.len() as f64).max(f64::MIN_POSITIVE);
                    let logs = shape.iter().map(|s| (scale * s).ln()).sum::<f64>();
                    (logs, scale, shape)
                });
                let best = tried.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
                best.map_or((1.0, vec![1.0; each.len()]), |(_, scale, shape)| {
                    (scale.sqrt() / median, shape.iter().map(|s| s.sqrt() * median).collect())
                })
            })
            .collect();
        let worst = found.iter().map(|f| f.0).fold(0.0, f64::max);
        let each = self.outputs.iter().zip(found);
        each.map(|(output, (scale, shape))| {
            let scale = size * (scale / worst).max(OUTPUT_ERROR_LEAST);
            let with = |(r, s): (&Response, &f64)| Response { std: scale * s, ..*r };
            output.iter().zip(&shape).map(with).collect()
        })
        .collect()
    }
}
