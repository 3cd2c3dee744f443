//! The distributed beam: Euler-Bernoulli pieces with mass along them, solved exactly.

use num_complex::Complex64;

use super::chain::{BaseSide, Joined, TipSide};
use super::counted::counted_roots;
use super::element::{At, Element};
use super::frequencies::{below, below_first, lowest};
use super::lumped::{attach, positions};
use super::modes::mode;
use super::response::{BeamResponse, at_damped, joined};
use super::roots::further;
use super::span::check_rest;
use super::winding::zeros_within;
use super::zeros::{log_slope, real_zeros, tip_numerator};
use super::{Base, BeamError, Damping, LumpedBeam, Mode, Payload, Span, Zeros};
use crate::number::{Dual, Number, Scaled};

/// A piece of beam with constant rigidity and mass per length, and the mass and damper at its outer end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Length \[m\].
    pub length_m: f64,
    /// Flexural rigidity EI \[N·m²\].
    pub flexural_rigidity_n_m2: f64,
    /// Mass per length \[kg/m\].
    pub mass_per_length_kg_per_m: f64,
    /// Point mass at the outer end \[kg\].
    pub end_mass_kg: f64,
    /// Viscous damping of the outer end against the fixed frame \[N·s/m\].
    pub end_damping_n_s_per_m: f64,
}

/// An Euler-Bernoulli beam with mass along it, clamped to the motor.
///
/// On each piece `EI·∂⁴y/∂x⁴ + μ·∂²ŷ/∂t² = 0`, with the deflection y from the motor's line \[m\], ŷ = y + x·θ_m and the
/// mass per length μ \[kg/m\]. The equation is solved exactly at any s: each piece is cut into parts that are short
/// compared with the bending wave, and their clamped-free functions are power series in `λ⁴ = −s²·μ·l⁴/EI`. Frequencies
/// and zeros are counted, so that none is missed.
///
/// # Source
/// `[Feliu1989, Section 4]` for the beam; `[WittrickWilliams1971]` for the count.
#[derive(Debug, Clone, PartialEq)]
pub struct DistributedBeam {
    pieces: Vec<Piece>,
    hub_radius_m: f64,
    payload: Payload,
    damping: Damping,
    position_m: Vec<f64>,
    elements: Vec<Element>,
}

impl DistributedBeam {
    /// Builds a beam from its pieces, from base to tip.
    ///
    /// ```
    /// use lissom::beam::{Base, DistributedBeam, Piece};
    /// let (l, ei, mu) = (0.5, 2.0, 0.1_f64);
    /// let piece = Piece { length_m: l, flexural_rigidity_n_m2: ei, mass_per_length_kg_per_m: mu, end_mass_kg: 0.0, end_damping_n_s_per_m: 0.0 };
    /// let beam = DistributedBeam::new(&[piece])?;
    /// let first = beam.frequencies_rad_s(Base::Clamped, 1)[0];
    /// assert!((first * l * l * (mu / ei).sqrt() / 1.875_104_068_711_961_f64.powi(2) - 1.0).abs() < 1e-12);
    /// # Ok::<(), lissom::beam::BeamError>(())
    /// ```
    ///
    /// # Errors
    /// [`BeamError`] without pieces; if a dimension is not positive and finite; if a point mass or damping is negative;
    /// if dimensions differ so much that numbers leave the range of a double.
    pub fn new(pieces: &[Piece]) -> Result<Self, BeamError> {
        Self::build(pieces.to_vec(), 0.0, Payload::default(), Damping::None)
    }

    /// Returns this beam with its base at the distance `hub_radius_m` from the motor's axis.
    ///
    /// # Errors
    /// [`BeamError::HubRadius`] if it is negative or not finite.
    pub fn with_hub_radius(self, hub_radius_m: f64) -> Result<Self, BeamError> {
        Self::build(self.pieces, hub_radius_m, self.payload, self.damping)
    }

    /// Returns this beam with a payload at its tip.
    ///
    /// # Errors
    /// [`BeamError::Payload`] if its mass or inertia is negative, or one of its quantities is not finite.
    pub fn with_payload(self, payload: Payload) -> Result<Self, BeamError> {
        Self::build(self.pieces, self.hub_radius_m, payload, self.damping)
    }

    /// Returns this beam with proportional damping.
    ///
    /// # Errors
    /// [`BeamError::ModalDistributed`] for damping ratios by mode, because a distributed beam has no last mode: set
    /// them on its truncated model. [`BeamError::DampingModel`] if a quantity is negative or not finite.
    pub fn with_damping(self, damping: Damping) -> Result<Self, BeamError> {
        Self::build(self.pieces, self.hub_radius_m, self.payload, damping)
    }

    fn build(
        pieces: Vec<Piece>,
        hub_radius_m: f64,
        payload: Payload,
        damping: Damping,
    ) -> Result<Self, BeamError> {
        check(&pieces)?;
        check_rest(hub_radius_m, &payload, &damping)?;
        if let Damping::Modal { .. } = damping {
            return Err(BeamError::ModalDistributed);
        }
        let position_m = positions(pieces.iter().map(|p| p.length_m), hub_radius_m);
        // Points on the beam are told by their distance from the axis.
        if pieces.iter().zip(&position_m).any(|(p, end)| p.length_m < RESOLVED * end) {
            return Err(BeamError::OutOfRange { quantity: "a point's distance from the axis" });
        }
        let elements = elements(&pieces, hub_radius_m, &payload, &[]).0;
        let beam = Self { pieces, hub_radius_m, payload, damping, position_m, elements };
        let whole = super::frequencies::whole(&beam.elements, At::undamped(0.0));
        let all = [whole.compliance.a, whole.compliance.c, beam.inertia_kg_m2()];
        if !all.iter().all(|v| v.is_finite() && *v > 0.0) {
            return Err(BeamError::OutOfRange { quantity: "the compliance or the inertia" });
        }
        let first = below_first(&beam.elements);
        if (REACH.recip()..=REACH).contains(&first) {
            Ok(beam)
        } else {
            Err(BeamError::OutOfRange { quantity: "the first natural frequency's fourth power" })
        }
    }

    /// Pieces, from base to tip.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }
    /// Distance of the clamp from the motor's axis \[m\].
    pub fn hub_radius_m(&self) -> f64 {
        self.hub_radius_m
    }
    /// Payload at the tip.
    pub fn payload(&self) -> &Payload {
        &self.payload
    }
    /// Damping in addition to that at the ends of the pieces.
    pub fn damping(&self) -> &Damping {
        &self.damping
    }
    /// Distance of each piece's outer end from the motor's axis \[m\].
    pub fn position_m(&self) -> &[f64] {
        &self.position_m
    }
    /// Distance of the tip from the motor's axis \[m\].
    pub fn length_m(&self) -> f64 {
        self.position_m[self.pieces.len() - 1]
    }

    /// Inertia of the beam about the motor's axis when it turns as one rigid body \[kg·m²\].
    pub fn inertia_kg_m2(&self) -> f64 {
        let mut start = self.hub_radius_m;
        let mut sum = 0.0;
        for (piece, &end) in self.pieces.iter().zip(&self.position_m) {
            let l = piece.length_m;
            let middle = start + 0.5 * l;
            sum += piece.mass_per_length_kg_per_m * l * (middle * middle + l * l / 12.0);
            sum += piece.end_mass_kg * end * end;
            start = end;
        }
        let tip = start + self.payload.offset_m;
        sum + self.payload.mass_kg * tip * tip + self.payload.inertia_kg_m2
    }

    /// The lowest `count` natural frequencies, ascending \[rad/s\], without damping; found by counting.
    ///
    /// # Source
    /// `[WittrickWilliams1971]`
    pub fn frequencies_rad_s(&self, base: Base, count: usize) -> Vec<f64> {
        lowest(&self.elements, base, count)
    }

    /// Number of natural frequencies below `omega_rad_s`.
    pub fn frequencies_below(&self, base: Base, omega_rad_s: f64) -> usize {
        below(&self.elements, base, omega_rad_s)
    }

    /// Phase of bending waves along the beam at `omega_rad_s` \[rad\], Σ l·(μ·ω²/EI)^¼. The cost of computing a
    /// response grows in proportion to it, and so with √ω.
    pub fn wave_radians(&self, omega_rad_s: f64) -> f64 {
        let each = |p: &Piece| {
            let ratio = p.mass_per_length_kg_per_m / p.flexural_rigidity_n_m2;
            if ratio > 0.0 { p.length_m * ratio.powf(0.25) } else { 0.0 }
        };
        omega_rad_s.sqrt() * self.pieces.iter().map(each).sum::<f64>()
    }

    /// Computes θ/θ_m at the outer end of each piece, and C_t/θ_m \[N·m/rad\], at the complex frequency `s` \[1/s\].
    pub fn response(&self, s: Complex64) -> BeamResponse {
        self.response_at(s, &self.position_m)
    }

    /// Computes θ/θ_m at `points`, distances from the axis in ascending order \[m\], and C_t/θ_m \[N·m/rad\], at the
    /// complex frequency `s` \[1/s\].
    ///
    /// A point outside the beam is moved to the nearer end.
    ///
    /// # Source
    /// `[Feliu1989, Section 4]`; exact, not truncated.
    pub fn response_at(&self, s: Complex64, points: &[f64]) -> BeamResponse {
        let (elements, joints) = self.split(points);
        let z = s * s;
        let damped = self.damping != Damping::None
            || self.pieces.iter().any(|p| p.end_damping_n_s_per_m > 0.0);
        if !damped && z.im == 0.0 {
            let meetings = joined(&elements, At::undamped(z.re), joints.into_iter());
            return BeamResponse {
                angles: self.angles(&meetings, points).map(Complex64::from).collect(),
                coupling_nm_per_rad: meetings[0].coupling().into(),
            };
        }
        let (at, elastic) = at_damped(s, &self.damping);
        let meetings = joined(&elements, at, joints.into_iter());
        BeamResponse {
            angles: self.angles(&meetings, points).collect(),
            coupling_nm_per_rad: meetings[0].coupling() * elastic,
        }
    }

    fn angles<N: Number>(&self, meetings: &[Joined<N>], points: &[f64]) -> impl Iterator<Item = N> {
        let (low, high) = (self.hub_radius_m, self.length_m());
        let at = points.iter().map(move |p| p.clamp(low, high));
        meetings.iter().zip(at).map(|(m, x)| m.motion().0.times(1.0 / x))
    }

    /// The elements cut at `points`, and the index of the element that begins at each.
    fn split(&self, points: &[f64]) -> (Vec<Element>, Vec<usize>) {
        elements(&self.pieces, self.hub_radius_m, &self.payload, points)
    }

    /// The lowest `count` modes with the motor clamped, their shapes at `points` (distances from the axis in ascending
    /// order, \[m\]).
    pub fn modes(&self, count: usize, points: &[f64]) -> Vec<Mode> {
        let (elements, joints) = self.split(points);
        let frequencies = self.frequencies_rad_s(Base::Clamped, count);
        frequencies.into_iter().map(|omega| mode(&elements, &joints, points, omega)).collect()
    }

    /// The zeros of θ/θ_m at the distance `point_m` from the axis with |s| below `omega_rad_s`, without damping; all of
    /// them, also complex ones.
    ///
    /// The argument principle on the circle |s| = ω gives their number. Real zeros are then found as changes of
    /// sign, the others by Newton's method. If a zero lies on the circle itself, the circle is made a little
    /// wider. `None` if the number cannot be determined: the parts of the beam differ by so many orders of
    /// magnitude that rounding hides the function.
    ///
    /// # Source
    /// `[Feliu1989, Section 3, properties 1 and 4]`
    pub fn zeros_below(&self, point_m: f64, omega_rad_s: f64) -> Option<Zeros> {
        if point_m >= self.length_m() && !self.payload.turns() {
            return Some(self.tip_zeros_below(omega_rad_s));
        }
        let (elements, joints) = self.split(&[point_m]);
        let joint = joints[0];
        let mut radius = omega_rad_s * omega_rad_s;
        let dual = |z: Complex64| numerator(&elements, joint, Dual::variable(z));
        // About as many zeros as natural frequencies.
        let steps_most = 2000 + 200 * self.frequencies_below(Base::Clamped, omega_rad_s);
        let wanted = (0..WIDER_MOST).find_map(|wider| {
            if wider > 0 {
                radius *= 1.01;
            }
            zeros_within(dual, radius, steps_most)
        })?;
        if wanted == 0 {
            return Some(Zeros { z: Vec::new(), missing: 0 });
        }
        let first = below_first(&self.elements);
        let range = ((first * first * NEAREST).min(radius * NEAREST), radius);
        let real = real_zeros(|z| numerator(&elements, joint, z), wanted, range);
        let mut z: Vec<Complex64> = real.into_iter().map(Complex64::from).collect();
        if z.len() < wanted {
            let more = further(|z| log_slope(dual(z)), &z, wanted - z.len(), range);
            z.extend(more);
        }
        z.sort_by(|a, b| a.norm().total_cmp(&b.norm()).then(a.im.total_cmp(&b.im)));
        let missing = wanted.saturating_sub(z.len());
        Some(Zeros { z, missing })
    }

    /// Those of the tip, where nothing resists it in turning: all real, s² > 0, and counted by the
    /// changes of sign along the beam (`docs/src/theory/lumped-and-distributed.md`).
    fn tip_zeros_below(&self, omega_rad_s: f64) -> Zeros {
        let at = |s: f64| tip_numerator(&self.elements, s);
        let wanted = at(omega_rad_s).1;
        let found = counted_roots(at, wanted, below_first(&self.elements));
        let missing = wanted - found.len();
        Zeros { z: found.into_iter().map(|s| (s * s).into()).collect(), missing }
    }

    /// Converts to a lumped beam of `count` masses or a few more: each piece is cut into equal spans, and half of a
    /// span's mass goes to each of its ends.
    ///
    /// The half at the clamp does not bend the beam and is left out. With a hub of radius r it turns with the motor:
    /// add `μ·l·r²/2` to the motor's inertia, l the length of the first span. The lumped beam converges to this beam
    /// with order 2 (`docs/src/theory/lumped-and-distributed.md`).
    ///
    /// # Errors
    /// [`BeamError`] if the masses do not make a beam.
    pub fn lumped(&self, count: usize) -> Result<LumpedBeam, BeamError> {
        let total: f64 = self.pieces.iter().map(|p| p.length_m).sum();
        let mut spans: Vec<Span> = Vec::new();
        for piece in &self.pieces {
            let cells = (count as f64 * piece.length_m / total).round().max(1.0) as usize;
            let length_m = piece.length_m / cells as f64;
            let half = 0.5 * piece.mass_per_length_kg_per_m * length_m;
            if let Some(last) = spans.last_mut() {
                last.mass_kg += half;
            }
            for cell in 1..=cells {
                let last = cell == cells;
                spans.push(Span {
                    length_m,
                    flexural_rigidity_n_m2: piece.flexural_rigidity_n_m2,
                    mass_kg: if last { half + piece.end_mass_kg } else { 2.0 * half },
                    damping_n_s_per_m: if last { piece.end_damping_n_s_per_m } else { 0.0 },
                });
            }
        }
        LumpedBeam::new(&spans)?
            .with_hub_radius(self.hub_radius_m)?
            .with_payload(self.payload)?
            .with_damping(self.damping.clone())
    }
}

/// Shortest span of a distributed beam, relative to the distance of its end from the axis: points
/// on it are known to four digits.
const RESOLVED: f64 = 1e-12;
/// Largest first natural frequency, and the reciprocal of the smallest \[rad/s\].
const REACH: f64 = 1e60;
/// Times that a circle is made wider to keep off a zero.
const WIDER_MOST: usize = 5;
/// The search for real zeros begins at this part of the first frequency's square in |z|.
const NEAREST: f64 = 1e-6;

fn numerator<N: Number>(elements: &[Element], joint: usize, z: N) -> Scaled<N> {
    let at = At::undamped(z);
    let mut base = BaseSide::clamped();
    elements[..joint].iter().for_each(|e| base.pass(at, e));
    let mut tip = TipSide::free();
    elements[joint..].iter().rev().for_each(|e| tip.pass(at, e));
    Joined::new(base, tip).numerator()
}

fn check(pieces: &[Piece]) -> Result<(), BeamError> {
    if pieces.is_empty() {
        return Err(BeamError::NoSpans);
    }
    for (index, piece) in pieces.iter().enumerate() {
        let span = index + 1;
        let positive = [
            ("length_m", piece.length_m),
            ("flexural_rigidity_n_m2", piece.flexural_rigidity_n_m2),
            ("mass_per_length_kg_per_m", piece.mass_per_length_kg_per_m),
        ];
        for (quantity, found) in positive {
            if !(found > 0.0 && found.is_finite()) {
                return Err(BeamError::NotPositive { span, quantity, found });
            }
        }
        let rest = [
            ("end_mass_kg", piece.end_mass_kg),
            ("end_damping_n_s_per_m", piece.end_damping_n_s_per_m),
        ];
        for (quantity, found) in rest {
            if !(found >= 0.0 && found.is_finite()) {
                return Err(BeamError::Negative { span, quantity, found });
            }
        }
    }
    Ok(())
}

/// The chain, cut at ascending `points`, and the index of the element that begins at each.
fn elements(
    pieces: &[Piece],
    hub_radius: f64,
    payload: &Payload,
    points: &[f64],
) -> (Vec<Element>, Vec<usize>) {
    let mut elements = Vec::with_capacity(2 * pieces.len() + points.len() + 4);
    let mut joints = Vec::with_capacity(points.len());
    if hub_radius > 0.0 {
        elements.push(Element::Rigid { length: hub_radius });
    }
    let mut points = points.iter().peekable();
    let mut start = hub_radius;
    let ends = positions(pieces.iter().map(|p| p.length_m), hub_radius);
    for (index, (piece, end)) in pieces.iter().zip(ends).enumerate() {
        let heavy = |length: f64| Element::Heavy {
            length,
            rigidity: piece.flexural_rigidity_n_m2,
            mass_per_length: piece.mass_per_length_kg_per_m,
        };
        let last = index + 1 == pieces.len();
        // What is left of the piece; a point within rounding of its end is its end.
        let mut left = piece.length_m;
        while let Some(&&point) = points.peek() {
            let into = point - start;
            if into > left * (1.0 - 1e-12) {
                break;
            }
            if into > 0.0 {
                elements.push(heavy(into));
                left -= into;
                start += into;
            }
            joints.push(elements.len());
            points.next();
        }
        elements.push(heavy(left));
        start = end;
        while points.next_if(|p| **p <= end * (1.0 + 1e-12) || last).is_some() {
            joints.push(elements.len());
        }
        let (mass, damping) = (piece.end_mass_kg, piece.end_damping_n_s_per_m);
        if mass > 0.0 || damping > 0.0 || last {
            elements.push(Element::Mass { mass, damping });
        }
    }
    attach(&mut elements, payload);
    (elements, joints)
}
