//! Deflected shape of the beam between the masses.

use super::three_moment::ThreeMoment;
use super::{BeamError, LumpedBeam};

/// Deflected shape of a lumped beam: the deflection from the motor's line \[m\] is a cubic on each span,
/// `y_i(x) = u_{i,0} + u_{i,1}·ξ + u_{i,2}·ξ² + u_{i,3}·ξ³`, with ξ = x − L_{i−1} \[m\].
///
/// # Source
/// `[Feliu1989, eq. (1)]`
#[derive(Debug, Clone, PartialEq)]
pub struct DeflectedShape {
    /// Inner end of each span, distance from the axis, and the tip \[m\]; n + 1.
    ends_m: Vec<f64>,
    /// `u_{i,0} … u_{i,3}` of each span \[m, 1, 1/m, 1/m²\].
    pub coefficients: Vec<[f64; 4]>,
}

impl DeflectedShape {
    /// Deflection at the distance `x_m` from the axis \[m\]; zero within the hub; beyond the
    /// tip the last cubic is continued.
    pub fn deflection_m(&self, x_m: f64) -> f64 {
        self.at(x_m, |[a, b, c, d], xi| a + xi * (b + xi * (c + xi * d)))
    }

    /// Slope relative to the motor's line at the distance `x_m` from the axis \[1\].
    pub fn slope(&self, x_m: f64) -> f64 {
        self.at(x_m, |[_, b, c, d], xi| b + xi * (2.0 * c + xi * 3.0 * d))
    }

    fn at(&self, x_m: f64, value: impl Fn([f64; 4], f64) -> f64) -> f64 {
        if x_m <= self.ends_m[0] {
            return 0.0;
        }
        let span = self.ends_m[1..self.ends_m.len() - 1].partition_point(|end| *end < x_m);
        value(self.coefficients[span], x_m - self.ends_m[span])
    }
}

impl LumpedBeam {
    /// The shape under forces at the masses \[N\] and a torque at the tip \[N·m\], with the motor held.
    ///
    /// A positive force or torque bends the beam towards positive deflections. Missing forces count as zero. For the
    /// shape in motion, use the inertia and damping forces of the masses as forces.
    ///
    /// # Source
    /// `[Feliu1989, eqs. (1), (6)-(8)]`, with the signs of (7) and (8).
    pub fn shape_under(&self, forces_n: &[f64], tip_torque_nm: f64) -> DeflectedShape {
        let n = self.len();
        // From the tip inwards: force and torque that what lies beyond puts on span i's outer end.
        let (mut force, mut torque) = (0.0, tip_torque_nm);
        let mut loads = vec![(0.0, 0.0); n];
        for i in (0..n).rev() {
            force += forces_n.get(i).copied().unwrap_or(0.0);
            loads[i] = (force, torque);
            torque += force * self.spans()[i].length_m;
        }
        let (mut y, mut slope) = (0.0, 0.0);
        let mut coefficients = Vec::with_capacity(n);
        for (span, (force, torque)) in self.spans().iter().zip(loads) {
            let (l, ei) = (span.length_m, span.flexural_rigidity_n_m2);
            // EI·y″ = T(L_{i−1}) − F·ξ, (8).
            let (second, third) = ((torque + force * l) / (2.0 * ei), -force / (6.0 * ei));
            coefficients.push([y, slope, second, third]);
            y += l * (slope + l * (second + l * third));
            slope += l * (2.0 * second + l * 3.0 * third);
        }
        DeflectedShape { ends_m: self.ends(), coefficients }
    }

    /// The shape with given deflections of the masses from the motor's line \[m\], for example those of a mode, and a
    /// torque at the tip \[N·m\].
    ///
    /// # Source
    /// `[Feliu1989, eqs. (1)-(5), (10)]`
    ///
    /// # Errors
    /// [`BeamError::TooManyMasses`] above [`MOST_MASSES`](super::MOST_MASSES).
    pub fn shape_through(
        &self,
        deflections_m: &[f64],
        tip_torque_nm: f64,
    ) -> Result<DeflectedShape, BeamError> {
        let n = self.len();
        if n > super::MOST_MASSES {
            return Err(BeamError::TooManyMasses { found: n, most: super::MOST_MASSES });
        }
        let statics = ThreeMoment::new(self.spans(), self.hub_radius_m(), false);
        let y = |i: usize| deflections_m.get(i).copied().unwrap_or(0.0);
        let (by_deflection, by_torque) = (statics.moments(), statics.tip_torque());
        let moment = |j: usize| {
            if j == n {
                return tip_torque_nm;
            }
            let sum: f64 = (0..n).map(|i| by_deflection[(j, i)] * y(i)).sum();
            sum + by_torque[j] * tip_torque_nm
        };
        let moments: Vec<f64> = (0..=n).map(moment).collect();
        let coefficients = self
            .spans()
            .iter()
            .enumerate()
            .map(|(i, span)| {
                let (l, ei) = (span.length_m, span.flexural_rigidity_n_m2);
                let start = if i == 0 { 0.0 } else { y(i - 1) };
                let (inner, outer) = (moments[i], moments[i + 1]);
                let chord = (y(i) - start) / l;
                [
                    start,
                    chord - l * (2.0 * inner + outer) / (6.0 * ei),
                    inner / (2.0 * ei),
                    (outer - inner) / (6.0 * ei * l),
                ]
            })
            .collect();
        Ok(DeflectedShape { ends_m: self.ends(), coefficients })
    }

    fn ends(&self) -> Vec<f64> {
        let mut ends = vec![self.hub_radius_m()];
        ends.extend_from_slice(self.position_m());
        ends
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::Span;

    fn beam() -> LumpedBeam {
        let span = |length_m, flexural_rigidity_n_m2| Span {
            length_m,
            flexural_rigidity_n_m2,
            mass_kg: 1.0,
            damping_n_s_per_m: 0.0,
        };
        let beam = LumpedBeam::new(&[span(0.4, 3.0), span(0.7, 1.0), span(0.2, 8.0)]).unwrap();
        beam.with_hub_radius(0.1).unwrap()
    }

    #[test]
    fn a_load_and_the_deflections_it_makes_give_one_shape() {
        let beam = beam();
        let under = beam.shape_under(&[2.0, -1.0, 0.5], 0.3);
        let y: Vec<f64> = beam.position_m().iter().map(|x| under.deflection_m(*x)).collect();
        let through = beam.shape_through(&y, 0.3).unwrap();
        for k in 0..=60 {
            let x = 0.025 * f64::from(k);
            assert!((under.deflection_m(x) - through.deflection_m(x)).abs() < 1e-13);
            assert!((under.slope(x) - through.slope(x)).abs() < 1e-12);
        }
        // Continuous with its slope at the joints.
        for x in beam.position_m() {
            assert!((under.slope(x - 1e-9) - under.slope(x + 1e-9)).abs() < 1e-6);
        }
    }

    #[test]
    fn a_tip_force_bends_a_uniform_cantilever_by_fl3_over_3ei() {
        let span = Span {
            length_m: 0.5,
            flexural_rigidity_n_m2: 2.0,
            mass_kg: 1.0,
            damping_n_s_per_m: 0.0,
        };
        let shape = LumpedBeam::new(&[span, span]).unwrap().shape_under(&[0.0, 3.0], 0.0);
        assert!((shape.deflection_m(1.0) - 3.0 / (3.0 * 2.0)).abs() < 1e-15);
        assert!((shape.deflection_m(0.5) - 3.0 * 0.25 * 2.5 / (6.0 * 2.0)).abs() < 1e-15);
    }
}
