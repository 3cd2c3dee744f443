//! Costs of many errors of one sensor, read from a table if computing them would take long.

use super::noise::{Loss, SensorNoise, log_probability};

/// Nodes of the table per standard error. Between them the logarithm and its slope go by cubics, off by
/// less than 1e-8, and the curvature by a line, off by less than 1e-3.
const NODES: f64 = 32.0;
/// StdSource beyond a step's edge at which the table ends.
const BEYOND: f64 = 10.0;

/// What a sensor's errors cost, see [`SensorNoise::loss`].
pub(super) struct Losses {
    noise: SensorNoise,
    /// `ln P`, `−d ln P/de` and `−d² ln P/de²` at multiples of σ/[`NODES`]; empty without steps.
    nodes: Vec<[f64; 3]>,
}

impl Losses {
    pub(super) fn new(noise: SensorNoise) -> Self {
        let half = 0.5 * noise.step / noise.sigma;
        let stepped = noise.step > 0.0 && half.is_finite();
        let count = if stepped { (NODES * (half + BEYOND)) as usize + 2 } else { 0 };
        let node = |k: usize| <[f64; 3]>::from(log_probability(k as f64 / NODES, half));
        Self { noise, nodes: (0..count).map(node).collect() }
    }

    /// Its cost, slope and curvature.
    pub(super) fn loss(&self, error: f64) -> Loss {
        let Some((t, [a, b])) = self.around(error) else { return self.noise.loss(error) };
        let found = (
            -cubic(t, [-a[0], -b[0]], [a[1], b[1]]),
            cubic(t, [a[1], b[1]], [a[2], b[2]]),
            a[2] + t * (b[2] - a[2]),
        );
        self.noise.stepped_loss(error, found, self.nodes[0][0])
    }

    /// Its cost alone.
    pub(super) fn cost(&self, error: f64) -> f64 {
        match self.around(error) {
            Some((t, [a, b])) => 2.0 * (self.nodes[0][0] + cubic(t, [-a[0], -b[0]], [a[1], b[1]])),
            None => self.noise.loss(error).cost,
        }
    }

    /// The nodes on either side, and the share of the way between them; `None` outside the table.
    fn around(&self, error: f64) -> Option<(f64, [[f64; 3]; 2])> {
        let at = NODES * error.abs() / self.noise.sigma;
        let pair = self.nodes.get(at as usize..)?.first_chunk::<2>()?;
        Some((at - at.floor(), *pair))
    }
}

/// Between two nodes, from values and slopes there.
fn cubic(t: f64, [a, b]: [f64; 2], slopes: [f64; 2]) -> f64 {
    let [m, n] = slopes.map(|s| s / NODES);
    let rise = b - a;
    a + t * (m + t * (3.0 * rise - 2.0 * m - n + t * (m + n - 2.0 * rise)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_loss_itself() {
        for step in [0.0, 0.6, 2.0, 10.0] {
            let noise = SensorNoise { sigma: 0.01, step: 0.01 * step };
            let losses = Losses::new(noise);
            for k in -400..400 {
                let error = 0.000_513 * f64::from(k);
                let (a, b) = (losses.loss(error), noise.loss(error));
                assert!((a.cost - b.cost).abs() < 2e-8 * (1.0 + b.cost), "{step} {k}");
                assert_eq!(a.cost.to_bits(), losses.cost(error).to_bits());
                assert!((a.slope - b.slope).abs() < 1e-8 * (100.0 + b.slope.abs()), "{step} {k}");
                assert!((a.curvature - b.curvature).abs() < 1e-3 * b.curvature, "{step} {k}");
            }
        }
    }
}
