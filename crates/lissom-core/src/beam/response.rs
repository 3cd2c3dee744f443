//! Responses to the motor's angle at any s; their cost grows in proportion to the number of masses.

use num_complex::Complex64;

use super::LumpedBeam;
use super::chain::{BaseSide, Joined, TipSide};
use super::element::{At, Element};
use super::span::Damping;
use crate::number::Number;

/// Response of the beam to the motor's angle at one complex frequency s.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamResponse {
    /// θ_i/θ_m of each mass or point \[1\].
    pub angles: Vec<Complex64>,
    /// C_t/θ_m \[N·m/rad\], with the torque C_t that the motor exerts on the beam.
    pub coupling_nm_per_rad: Complex64,
}

/// The meeting of base and tip side just before each joint of `joints` (ascending indices).
pub(crate) fn joined<N: Number>(
    elements: &[Element],
    at: At<N>,
    joints: impl DoubleEndedIterator<Item = usize> + ExactSizeIterator,
) -> Vec<Joined<N>> {
    let joints: Vec<usize> = joints.collect();
    let mut base = BaseSide::clamped();
    let mut sides = Vec::with_capacity(joints.len());
    let mut next = 0;
    for &joint in &joints {
        elements[next..joint].iter().for_each(|e| base.pass(at, e));
        next = joint;
        sides.push(base);
    }
    let mut tip = TipSide::free();
    let mut end = elements.len();
    let mut meetings = Vec::with_capacity(joints.len());
    for (&joint, side) in joints.iter().zip(sides).rev() {
        elements[joint..end].iter().rev().for_each(|e| tip.pass(at, e));
        end = joint;
        meetings.push(Joined::new(side, tip));
    }
    meetings.reverse();
    meetings
}

/// Where proportional damping puts s: `z = (s² + α·s)/(1 + β·s)` takes the place of s², and every
/// torque is multiplied by `1 + β·s`.
pub(crate) fn at_damped<N: Number>(s: N, damping: &Damping) -> (At<N>, N) {
    let (alpha, beta) = damping.proportional();
    let elastic = N::real(1.0) + s.times(beta);
    (At { z: s * (s + N::real(alpha)) / elastic, s: s / elastic }, elastic)
}

impl LumpedBeam {
    /// Whether there is no damping.
    pub fn is_undamped(&self) -> bool {
        *self.damping() == Damping::None && self.spans().iter().all(|s| s.damping_n_s_per_m == 0.0)
    }

    /// Computes θ_i/θ_m of every mass, and C_t/θ_m \[N·m/rad\], at the complex frequency `s` \[1/s\]; `s = jω` gives
    /// the frequency response.
    ///
    /// Without damping the values grow without bound towards a pole; exactly on a pole they are about the reciprocal of
    /// the rounding error.
    ///
    /// ```
    /// # use lissom::beam::{LumpedBeam, Span};
    /// # use num_complex::Complex64;
    /// # let span = Span { length_m: 0.2, flexural_rigidity_n_m2: 0.004, mass_kg: 0.05, damping_n_s_per_m: 0.0 };
    /// let beam = LumpedBeam::new(&[span])?;
    /// let omega = beam.natural_frequencies_rad_s()[0];
    /// let r = beam.response(Complex64::new(0.0, 0.5 * omega));
    /// assert!((r.angles[0].re - 4.0 / 3.0).abs() < 1e-12); // 1/(1 − 1/4)
    /// # Ok::<(), lissom::beam::BeamError>(())
    /// ```
    ///
    /// # Source
    /// `[Feliu1989, eqs. (15), (16)]`, with damping added.
    pub fn response(&self, s: Complex64) -> BeamResponse {
        if let Damping::Modal { .. } = self.damping() {
            return modal_response(self, s);
        }
        let z = s * s;
        if self.is_undamped() && z.im == 0.0 {
            let at = At::undamped(z.re);
            let meetings = joined(self.elements(), at, self.joints());
            return BeamResponse {
                angles: self.angles(&meetings).map(Complex64::from).collect(),
                coupling_nm_per_rad: meetings[0].coupling().into(),
            };
        }
        let (at, elastic) = at_damped(s, self.damping());
        let meetings = joined(self.elements(), at, self.joints());
        BeamResponse {
            angles: self.angles(&meetings).collect(),
            coupling_nm_per_rad: meetings[0].coupling() * elastic,
        }
    }

    fn angles<N: Number>(&self, meetings: &[Joined<N>]) -> impl Iterator<Item = N> {
        meetings.iter().zip(self.position_m()).map(|(m, l)| m.motion().0.times(1.0 / l))
    }
}

/// Response with a damping ratio for each mode: every mode is summed.
fn modal_response(beam: &LumpedBeam, s: Complex64) -> BeamResponse {
    let modes = beam.modes(usize::MAX);
    let mut angles = vec![Complex64::new(1.0, 0.0); beam.len()];
    let mut inertia = Complex64::from(beam.inertia_kg_m2());
    for (k, mode) in modes.iter().enumerate() {
        let omega = mode.natural_frequency_rad_s;
        let zeta = beam.damping().ratio(k).unwrap_or(0.0);
        // θ_i = θ_m + deflection: the deflection's denominator is damped, its drive is −θ̈_m.
        let driven = s * s / (s * s + s * (2.0 * zeta * omega) + omega * omega);
        angles.iter_mut().zip(&mode.share).for_each(|(a, r)| *a -= driven * r);
        inertia -= driven * mode.inertia_kg_m2;
    }
    BeamResponse { angles, coupling_nm_per_rad: s * s * inertia }
}
