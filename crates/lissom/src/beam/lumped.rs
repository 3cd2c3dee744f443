//! Lumped-mass beam: geometry and masses to the matrices of (13) and (15).

use nalgebra::{DMatrix, DVector};
use thiserror::Error;

/// Most masses that the dense matrices here are meant for.
const MOST_MASSES: usize = 200;

/// One span and the mass at its outer end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Length \[m\].
    pub length_m: f64,
    /// Flexural rigidity EI, constant along the span \[N·m²\].
    pub flexural_rigidity_n_m2: f64,
    /// Mass at the outer end \[kg\].
    pub mass_kg: f64,
    /// Viscous damping of that mass against the fixed frame \[N·s/m\].
    pub damping_n_s_per_m: f64,
}

/// Why spans cannot make a beam.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum BeamError {
    /// A beam without spans.
    #[error("the beam has no spans")]
    NoSpans,
    /// More masses than dense matrices are meant for.
    #[error("{found} masses; at most {most} are supported")]
    TooManyMasses {
        /// Masses given.
        found: usize,
        /// Masses supported.
        most: usize,
    },
    /// A dimension is not positive and finite.
    #[error("span {span}: {quantity} = {found} is not positive and finite")]
    NotPositive {
        /// Number of the span, from 1 at the base.
        span: usize,
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// Damping is negative or not finite.
    #[error("span {span}: damping_n_s_per_m = {found} is negative or not finite")]
    Damping {
        /// Number of the span, from 1 at the base.
        span: usize,
        /// The number found.
        found: f64,
    },
    /// Spans differ so much that the stiffness cannot be computed.
    #[error("the spans' stiffnesses differ too much to be solved together")]
    Singular,
}

/// A massless beam clamped to the motor with point masses along it.
///
/// In angles θ_i of the radius to mass i, equation (13) without tip loads:
/// `m_i·θ̈_i = Σ_j EI·a_ij·θ_j + EI·b_i·θ_m − c_i·θ̇_i`, and (15) `C_t = Σ h_i·θ_i + h_m·θ_m`.
///
/// # Source
/// `[Feliu1989, eqs. (1)-(13), (15)]`. The stiffness is the inverse of the cantilever's
/// flexibility, `f_ij = ∫ (L_i − x)(L_j − x)/EI dx`, which solves (2)-(5) for any spans.
///
/// # Differences from the source
/// EI may differ between spans; each mass may be damped.
#[derive(Debug, Clone)]
pub struct LumpedBeam {
    spans: Vec<Span>,
    position_m: Vec<f64>,
    ei_a: DMatrix<f64>,
    ei_b: DVector<f64>,
    h: DVector<f64>,
    h_motor: f64,
}

impl LumpedBeam {
    /// Builds the matrices from spans, base to tip.
    ///
    /// With f_ij the deflection at L_i for a unit force at L_j, K = f⁻¹ the stiffness \[N/m\] and
    /// angles in place of deflections: `EI·a_ij = −K_ij·L_j/L_i`, `EI·b_i = −Σ_j EI·a_ij`,
    /// `h_j = −Σ_i L_i·K_ij·L_j`, `h_{n+1} = −Σ_j h_j`.
    ///
    /// ```
    /// use lissom::beam::{LumpedBeam, Span};
    /// let (l, ei) = (0.2, 0.004);
    /// let span = Span { length_m: l, flexural_rigidity_n_m2: ei, mass_kg: 0.05, damping_n_s_per_m: 0.0 };
    /// let beam = LumpedBeam::new(&[span])?;
    /// assert!((beam.h_motor() - 3.0 * ei / l).abs() < 1e-12); // (32)
    /// # Ok::<(), lissom::beam::BeamError>(())
    /// ```
    ///
    /// # Source
    /// `[Feliu1989, eqs. (2)-(13), (15)]`; the two identities A·1 + B = 0 and ΣH + h_{n+1} = 0
    /// (a rigid rotation strains nothing) are used to form B and h_{n+1}.
    ///
    /// # Errors
    /// [`BeamError`]: no spans, more than 200 masses, a dimension that is not positive, damping
    /// that is negative, spans too unlike to be solved together.
    pub fn new(spans: &[Span]) -> Result<Self, BeamError> {
        check(spans)?;
        let n = spans.len();
        let position_m: Vec<f64> = spans
            .iter()
            .scan(0.0, |at, span| {
                *at += span.length_m;
                Some(*at)
            })
            .collect();
        let flexibility = flexibility(spans, &position_m);
        let stiffness = flexibility.cholesky().ok_or(BeamError::Singular)?.inverse();
        let l = DVector::from_column_slice(&position_m);
        let ei_a = DMatrix::from_fn(n, n, |i, j| -stiffness[(i, j)] * l[j] / l[i]);
        let ei_b = -ei_a.column_sum();
        let h = DVector::from_fn(n, |j, _| -l.dot(&stiffness.column(j)) * l[j]);
        let h_motor = -h.sum();
        if !(h_motor.is_finite() && ei_a.iter().all(|v| v.is_finite())) {
            return Err(BeamError::Singular);
        }
        Ok(Self { spans: spans.to_vec(), position_m, ei_a, ei_b, h, h_motor })
    }

    /// Number of masses n.
    pub fn len(&self) -> usize {
        self.spans.len()
    }
    /// Never true: a beam has at least one span.
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }
    /// Spans, base to tip.
    pub fn spans(&self) -> &[Span] {
        &self.spans
    }
    /// Distance L_i of each mass from the motor's axis \[m\].
    pub fn position_m(&self) -> &[f64] {
        &self.position_m
    }
    /// `EI·A` of (13), n × n, row i being the right side of `m_i·θ̈_i` \[N/m\].
    pub fn ei_a(&self) -> &DMatrix<f64> {
        &self.ei_a
    }
    /// `EI·B` of (13), length n \[N/m\]; `A·1 + B = 0`.
    pub fn ei_b(&self) -> &DVector<f64> {
        &self.ei_b
    }
    /// `H` of (15), length n \[N·m/rad\].
    pub fn h(&self) -> &DVector<f64> {
        &self.h
    }
    /// `h_{n+1}` of (15), on the motor's angle \[N·m/rad\]; `ΣH + h_{n+1} = 0`.
    pub fn h_motor(&self) -> f64 {
        self.h_motor
    }

    /// Natural frequencies with the motor clamped, ascending \[rad/s\], damping left out.
    ///
    /// Square roots of the eigenvalues of `M^{-1/2} K M^{-1/2}`.
    pub fn natural_frequencies_rad_s(&self) -> Vec<f64> {
        let n = self.len();
        let root = |i: usize| self.spans[i].mass_kg.sqrt() * self.position_m[i];
        // Similarity to a symmetric matrix: −EI·a_ij·L_i/L_j is the stiffness k_ij.
        let symmetric = DMatrix::from_fn(n, n, |i, j| {
            -self.ei_a[(i, j)] * self.position_m[i] * self.position_m[i] / (root(i) * root(j))
        });
        let symmetric = (&symmetric + symmetric.transpose()) * 0.5;
        let mut omega: Vec<f64> =
            symmetric.symmetric_eigenvalues().iter().map(|v| v.max(0.0).sqrt()).collect();
        omega.sort_by(f64::total_cmp);
        omega
    }
}

fn check(spans: &[Span]) -> Result<(), BeamError> {
    if spans.is_empty() {
        return Err(BeamError::NoSpans);
    }
    if spans.len() > MOST_MASSES {
        return Err(BeamError::TooManyMasses { found: spans.len(), most: MOST_MASSES });
    }
    for (index, span) in spans.iter().enumerate() {
        let positive = [
            ("length_m", span.length_m),
            ("flexural_rigidity_n_m2", span.flexural_rigidity_n_m2),
            ("mass_kg", span.mass_kg),
        ];
        for (quantity, found) in positive {
            if !(found > 0.0 && found.is_finite()) {
                return Err(BeamError::NotPositive { span: index + 1, quantity, found });
            }
        }
        if !(span.damping_n_s_per_m >= 0.0 && span.damping_n_s_per_m.is_finite()) {
            return Err(BeamError::Damping { span: index + 1, found: span.damping_n_s_per_m });
        }
    }
    Ok(())
}

/// Deflection at `L_i` for a unit force at `L_j`: Euler-Bernoulli cantilever, span by span.
fn flexibility(spans: &[Span], position: &[f64]) -> DMatrix<f64> {
    let n = spans.len();
    DMatrix::from_fn(n, n, |i, j| {
        let (a, b) = (position[i], position[j]);
        let mut start = 0.0;
        let mut sum = 0.0;
        for (span, &end) in spans.iter().zip(position).take(i.min(j) + 1) {
            // ∫ (a−x)(b−x) dx over the span, about its middle: exact for a quadratic.
            let (half, middle) = (0.5 * (end - start), 0.5 * (end + start));
            let integral = 2.0 * half * ((a - middle) * (b - middle) + half * half / 3.0);
            sum += integral / span.flexural_rigidity_n_m2;
            start = end;
        }
        sum
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative rounding allowed where a closed form is compared.
    const CLOSED_FORM: f64 = 1e-12;

    fn span(length_m: f64, ei: f64, mass_kg: f64) -> Span {
        Span { length_m, flexural_rigidity_n_m2: ei, mass_kg, damping_n_s_per_m: 0.0 }
    }

    fn close(found: f64, expected: f64, tolerance: f64) {
        assert!(
            (found - expected).abs() <= tolerance * expected.abs().max(1e-300),
            "{found} is not {expected}"
        );
    }

    #[test]
    fn one_mass_is_equations_31_and_32() {
        let beam = LumpedBeam::new(&[span(0.3, 2.0, 0.5)]).unwrap();
        close(beam.ei_b()[0], 3.0 * 2.0 / 0.3_f64.powi(3), CLOSED_FORM);
        close(beam.h_motor(), 3.0 * 2.0 / 0.3, CLOSED_FORM);
        close(
            beam.natural_frequencies_rad_s()[0],
            (3.0 * 2.0 / 0.3_f64.powi(3) / 0.5).sqrt(),
            CLOSED_FORM,
        );
    }

    #[test]
    fn two_unequal_spans_are_the_verified_formulas() {
        let (l1, l2, ei) = (5.0, 8.0, 1.7);
        let beam = LumpedBeam::new(&[span(l1, ei, 1.0), span(l2, ei, 2.0)]).unwrap();
        let d = 3.0 * l1 + 4.0 * l2;
        let f = ei * 6.0 / (l1 * l1 * l2 * d);
        let a = beam.ei_a();
        close(
            a[(0, 0)],
            -f * (6.0 * l1 + 6.0 * l2 + 2.0 * l2 * l2 / l1 + 2.0 * l1 * l1 / l2),
            CLOSED_FORM,
        );
        close(a[(0, 1)], f * (l1 + l2) * (3.0 + 2.0 * l1 / l2), CLOSED_FORM);
        close(a[(1, 0)], f * (2.0 * l1 + 3.0 * l2) * l1 * l1 / (l2 * (l1 + l2)), CLOSED_FORM);
        close(a[(1, 1)], -f * 2.0 * l1 * l1 / l2, CLOSED_FORM);
        close(beam.h_motor(), 12.0 * ei * (l1 + l2) / (l1 * d), CLOSED_FORM);
    }

    #[test]
    fn two_mass_arm_of_the_report_has_its_printed_frequencies() {
        let inch = 0.0254;
        let (lb, lbf) = (0.453_592_37, 4.448_221_615_260_5);
        let ei =
            30e6 * lbf / (inch * inch) * std::f64::consts::PI * (0.047_f64 * inch).powi(4) / 64.0;
        let s = span(6.0 * inch, ei, 0.121 * lb);
        let omega = LumpedBeam::new(&[s, s]).unwrap().natural_frequencies_rad_s();
        // Section 6.3 prints 6.014 and 40.0116; errata: its unit conversion is good to 0.05 %.
        close(omega[0], 6.014, 5e-4);
        close(omega[1], 40.0116, 5e-4);
    }

    #[test]
    fn bad_spans_are_refused() {
        assert_eq!(LumpedBeam::new(&[]).unwrap_err(), BeamError::NoSpans);
        let text = |s: Span| LumpedBeam::new(&[s]).unwrap_err().to_string();
        assert_eq!(text(span(-1.0, 1.0, 1.0)), "span 1: length_m = -1 is not positive and finite");
        assert_eq!(
            text(span(1.0, 1.0, f64::NAN)),
            "span 1: mass_kg = NaN is not positive and finite"
        );
        let damped = Span { damping_n_s_per_m: -0.1, ..span(1.0, 1.0, 1.0) };
        assert_eq!(text(damped), "span 1: damping_n_s_per_m = -0.1 is negative or not finite");
        assert!(matches!(
            LumpedBeam::new(&vec![span(1.0, 1.0, 1.0); 201]).unwrap_err(),
            BeamError::TooManyMasses { found: 201, most: 200 }
        ));
    }
}
