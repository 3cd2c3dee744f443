//! Samples of a sine.

/// Samples from one angle that is computed anew to the next.
const STRIDE: usize = 64;

/// Samples of a sine and a cosine, `sin(φ·k)` and `cos(φ·k)` for integer k, each exact to a few roundings of the phase.
///
/// They are computed with `sin(a + b) = sin a·cos b + cos a·sin b` from every 64th sample. This is several times as
/// fast as one sine after another, and does not drift as a recursion does.
///
/// ```
/// let sines = lissom::rig::Sines::new(0.009);
/// let [mut sin, mut cos] = [[0.0; 200]; 2];
/// sines.fill(1000, &mut sin, &mut cos);
/// assert!((sin[150] - (0.009 * 1150.0_f64).sin()).abs() < 2e-15);
/// assert!((cos[150] - (0.009 * 1150.0_f64).cos()).abs() < 2e-15);
/// ```
#[derive(Debug, Clone)]
pub struct Sines {
    phase_step_rad: f64,
    near: [(f64, f64); STRIDE],
}

impl Sines {
    /// Prepares samples with the phase step φ = `phase_step_rad` \[rad\].
    pub fn new(phase_step_rad: f64) -> Self {
        let near = std::array::from_fn(|k| (phase_step_rad * k as f64).sin_cos());
        Self { phase_step_rad, near }
    }

    /// Computes samples `from`, `from + 1`, … until one of the slices is full.
    pub fn fill(&self, from: usize, sines: &mut [f64], cosines: &mut [f64]) {
        let blocks = sines.chunks_mut(STRIDE).zip(cosines.chunks_mut(STRIDE));
        for (block, (sines, cosines)) in blocks.enumerate() {
            let (s, c) = (self.phase_step_rad * (from + block * STRIDE) as f64).sin_cos();
            for ((sine, cosine), (sin, cos)) in sines.iter_mut().zip(cosines).zip(self.near) {
                *sine = s * cos + c * sin;
                *cosine = c * cos - s * sin;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two roundings of the sum's terms.
    const ROUNDING: f64 = 4e-16;

    #[test]
    fn as_exact_as_one_by_one() {
        for (step, from) in [(0.009, 0), (2.5, 12_345)] {
            let [mut sines, mut cosines] = [[0.0; 1000]; 2];
            Sines::new(step).fill(from, &mut sines, &mut cosines);
            for k in 0..1000 {
                // The phase itself is rounded once either way.
                let phase = step * (from + k) as f64;
                let slack = ROUNDING + f64::EPSILON * phase;
                assert!((sines[k] - phase.sin()).abs() < slack);
                assert!((cosines[k] - phase.cos()).abs() < slack);
            }
        }
    }
}
