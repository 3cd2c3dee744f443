//! Responses in the form that a fit uses: real and imaginary part, each divided by its standard error, which is 1/√2 of
//! that of the response, `√E|Ĝ − G|²`.

use std::f64::consts::SQRT_2;

use num_complex::Complex64;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::shared_poles_error::SharedPolesError;

/// Points times columns from which on an output is worth a thread (`evidence/rational`).
const WORTH_A_THREAD: usize = 16_000;

/// Responses of outputs to one input, on one grid of frequencies.
#[derive(Clone)]
pub(super) struct Weighted {
    pub(super) omega: Vec<f64>,
    pub(super) outputs: Vec<Output>,
}

/// What the model of an output consists of.
#[derive(Clone)]
pub(super) enum Basis {
    /// A residue of each pole.
    Residues,
    /// Torque per angle of the motor, `J·s² + V·s + Σ c_k(1 − ω_k²/D_k)`, coupled through the poles of these indices.
    Torque(Vec<usize>),
}

/// One output.
#[derive(Clone)]
pub(super) struct Output {
    pub(super) basis: Basis,
    /// By which it was turned back, where a delay of it is looked for.
    pub(super) delay_s: Option<f64>,
    /// The last model of it, weighted: what a delay turns. The data themselves at first.
    pub(super) model: Vec<Complex64>,
    /// √2/σ.
    pub(super) weights: Vec<f64>,
    /// Response times that.
    pub(super) weighted: Vec<Complex64>,
}

impl Output {
    /// Of values and weights; a weight of zero leaves a frequency out.
    pub(super) fn new(basis: Basis, values: &[Complex64], weights: Vec<f64>) -> Self {
        let weighted = values.iter().zip(&weights).map(|(value, weight)| value * weight).collect();
        Self { basis, delay_s: None, model: Vec::new(), weights, weighted }
    }

    /// Looks for a delay.
    pub(super) fn may_be_late(&mut self) {
        self.delay_s = Some(0.0);
        self.model.clone_from(&self.weighted);
    }

    /// How many real numbers it has.
    pub(super) fn readings(&self) -> usize {
        2 * self.weights.iter().filter(|weight| **weight > 0.0).count()
    }

    /// Σ|H·√2/σ|².
    pub(super) fn squares(&self) -> f64 {
        self.weighted.iter().map(Complex64::norm_sqr).sum()
    }
}

impl Weighted {
    pub(super) fn new(omega: &[f64], outputs: &[Vec<Response>]) -> Result<Self, SharedPolesError> {
        if outputs.is_empty() {
            return Err(SharedPolesError::NoOutput);
        }
        if let Some(index) = omega.iter().position(|w| !(w.is_finite() && *w > 0.0)) {
            return Err(SharedPolesError::Frequency { index, found_rad_s: omega[index] });
        }
        let output = |(output, responses): (usize, &Vec<Response>)| {
            let (found, expected) = (responses.len(), omega.len());
            if found != expected {
                return Err(SharedPolesError::Grid { output, found, expected });
            }
            let sound = |r: &Response| r.value.is_finite() && r.std.is_finite() && r.std > 0.0;
            if let Some(index) = responses.iter().position(|r| !sound(r)) {
                return Err(SharedPolesError::Response { output, index });
            }
            let weights: Vec<f64> = responses.iter().map(|r| SQRT_2 / r.std).collect();
            let values: Vec<Complex64> = responses.iter().map(|r| r.value).collect();
            Ok(Output::new(Basis::Residues, &values, weights))
        };
        let outputs = outputs.iter().enumerate().map(output).collect::<Result<_, _>>()?;
        Ok(Self { omega: omega.to_vec(), outputs })
    }

    /// The same with a delay to be looked for in each output.
    pub(super) fn with_delays(&self) -> Self {
        let mut data = self.clone();
        data.outputs.iter_mut().for_each(Output::may_be_late);
        data
    }

    /// Turns an output back by `late_s` more.
    pub(super) fn turn_back(&mut self, output: usize, late_s: f64) {
        let output = &mut self.outputs[output];
        if let Some(delay_s) = &mut output.delay_s {
            *delay_s += late_s;
            for (value, omega) in output.weighted.iter_mut().zip(&self.omega) {
                *value *= Complex64::from_polar(1.0, omega * late_s);
            }
        }
    }

    /// Estimates that an output has beside the poles' gains.
    pub(super) fn delays(&self) -> usize {
        self.outputs.iter().filter(|o| o.delay_s.is_some()).count()
    }

    /// The lowest and the highest frequency.
    pub(super) fn range(&self) -> (f64, f64) {
        let low = self.omega.iter().copied().fold(f64::INFINITY, f64::min);
        (low, self.omega.iter().copied().fold(0.0, f64::max))
    }

    /// What `of` makes of each output, a matrix of so many `columns`. Small ones are not worth waking a thread for.
    pub(super) fn each<T: Send>(
        &self,
        columns: usize,
        of: impl Fn(&Output) -> Option<T> + Send + Sync,
    ) -> Option<Vec<T>> {
        if self.omega.len() * columns < WORTH_A_THREAD {
            self.outputs.iter().map(of).collect()
        } else {
            self.outputs.par_iter().map(of).collect()
        }
    }

    /// Real numbers in all responses.
    pub(super) fn readings(&self) -> usize {
        self.outputs.iter().map(Output::readings).sum()
    }
}
