//! Derivative of a sampled error, with or without a filter.

/// `gain·(e_k − e_{k−1})/T`, through a first-order filter where there is one; zero at the first
/// sample.
///
/// The filter `1/(τs + 1)` is taken backwards in time (`s → (1 − z⁻¹)/T`),
/// `d_k = (τ·d_{k−1} + gain·(e_k − e_{k−1}))/(τ + T)`: stable for any τ ≥ 0, and the plain
/// difference at τ = 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Derivative {
    pub(super) filter_s: Option<f64>,
    before: Option<f64>,
    value: f64,
}

impl Derivative {
    pub(super) fn filtered(filter_s: f64) -> Self {
        Self { filter_s: Some(filter_s), ..Self::default() }
    }

    pub(super) fn of(&mut self, gain: f64, error: f64, period_s: f64) -> f64 {
        let change = gain * (error - self.before.unwrap_or(error));
        self.before = Some(error);
        self.value = match self.filter_s {
            None => change / period_s,
            Some(tau) => (tau * self.value + change) / (tau + period_s),
        };
        self.value
    }

    pub(super) fn reset(&mut self) {
        self.before = None;
        self.value = 0.0;
    }

    pub(super) fn memory_s(&self) -> f64 {
        self.filter_s.unwrap_or(0.0)
    }
}
