//! A beam as a chain of pieces and masses, and the 2×2 recursions that run along it.
//!
//! From the base: under a force F and a torque T, the outer end of the part that has been passed moves by
//! `u = C·(F, T) + d·θ_m`, u = (deflection, slope) in the fixed frame. From the tip: to move by u, the inner end of the
//! part that has been passed needs `(F, T) = Y·u`. Each piece changes C, d and Y in a fixed number of operations at any
//! frequency. At the point where the two sides meet, all motions and torques follow.
//!
//! With z = s², a mass m is a stiffness m·z. The pivots `1 + m·z·C₁₁` are those of the LDLᵀ factorisation of
//! `I + z·M^½·F·M^½` (F: flexibility). By Sylvester's law the number of negative pivots at z = −ω² is the number of
//! natural frequencies below ω. None can be missed.
//!
//! # Source
//! The count is that of `[WittrickWilliams1971]`. Flexibility in place of stiffness keeps the results exact to rounding
//! where many short spans make the stiffness matrix ill-conditioned.

use super::element::{At, Element};
use super::piece::{Piece, Sym, bend, heavy, kept_from_zero, parts, piece};
use crate::number::{Number, Scaled};

/// What has been passed coming from the base.
///
/// Beside C and d their minors are carried: det C and `e = C·(d₂, −d₁)`, as
/// `e_k = C_1k·d₂ − C_2k·d₁`. Every step is then a ratio of sums that do not cancel in structure,
/// whether a part of the beam is close to a resonance of its own or its spans are unlike by orders.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BaseSide<N> {
    /// Compliance of the outer end.
    pub(crate) compliance: Sym<N>,
    /// Motion (deflection, slope) of the free outer end per motor angle.
    pub(crate) motion: (N, N),
    /// Minors of C with d.
    minors: (N, N),
    /// Torque per motor angle with the outer end free \[N·m/rad\].
    pub(crate) torque: N,
    /// Product of the pivots: the characteristic function of the part, one at z = 0.
    pub(crate) det: Scaled<N>,
    /// Negative pivots: for real z = −ω², the part's natural frequencies below ω.
    pub(crate) below: usize,
}

impl<N: Number> BaseSide<N> {
    /// The motor's axis.
    pub(crate) fn clamped() -> Self {
        let o = N::real(0.0);
        Self {
            compliance: Sym::zero(),
            motion: (o, N::real(1.0)),
            minors: (o, o),
            torque: o,
            det: Scaled::one(),
            below: 0,
        }
    }

    /// Passes an element.
    pub(crate) fn pass(&mut self, at: At<N>, element: &Element) {
        match *element {
            Element::Span { length, rigidity } => self.span(length, bend(length, rigidity)),
            Element::Rigid { length } => self.span(length, 0.0),
            Element::Mass { mass, damping } => {
                self.mass(at.z.times(mass) + at.s.times(damping));
            }
            Element::Inertia { inertia } => self.inertia(at.z.times(inertia)),
            Element::Heavy { length, rigidity, mass_per_length } => {
                let count = parts(at, length, rigidity, mass_per_length);
                let part = heavy(at, length / count as f64, rigidity, mass_per_length);
                for _ in 0..count {
                    self.part(&part);
                }
            }
        }
    }

    /// A massless span, `f` = l/EI: transport and compliance in one, so that nothing cancels.
    fn span(&mut self, l: f64, f: f64) {
        let (c, (d1, d2), (e1, e2)) = (self.compliance, self.motion, self.minors);
        let (b, cc) = (c.b + c.c.times(l), c.c);
        self.compliance = Sym {
            a: c.a + (c.b + b).times(l) + N::real(l * l * f / 3.0),
            b: b + N::real(l * f / 2.0),
            c: cc + N::real(f),
            det: c.det
                + (c.a + c.b.times(l) + cc.times(l * l / 3.0)).times(f)
                + N::real(l * l * f * f / 12.0),
        };
        self.motion = (d1 + d2.times(l), d2);
        self.minors = (
            e1 + e2.times(l) - (d2.times(l / 6.0) + d1.times(0.5)).times(l * f),
            e2 - (d2.times(l / 2.0) + d1).times(f),
        );
    }

    fn part(&mut self, piece: &Piece<N>) {
        let w = piece.inertia;
        let det = self.compliance.meeting(w);
        let inverse = N::real(1.0) / det;
        // (I + C·W)⁻¹·d = (d + adj(C·W)·d)/det, with the minors: d + (W₁₂e₁ + …).
        let ((d1, d2), (e1, e2)) = (self.motion, self.minors);
        let moved = ((d1 - w.b * e1 - w.c * e2) * inverse, (d2 + w.a * e1 + w.b * e2) * inverse);
        // f = −W·u at the joint; the base carries it.
        self.torque = self.torque
            + d1 * (w.a * moved.0 + w.b * moved.1)
            + d2 * (w.b * moved.0 + w.c * moved.1);
        self.below += negative(det, self.compliance.trace(w) + N::real(2.0));
        self.compliance = self.compliance.loaded(w, det).congruent(&piece.transport);
        self.motion = piece.transport.apply(moved);
        let (e1, e2) = piece.transport.apply((e1 * inverse, e2 * inverse));
        let (c, (d1, d2)) = (piece.compliance, self.motion);
        self.minors = (
            e1 * piece.transport.det + c.a * d2 - c.b * d1,
            e2 * piece.transport.det + c.b * d2 - c.c * d1,
        );
        self.compliance = self.compliance.plus(piece.compliance);
        self.det = self.det.times(det).times(piece.own);
    }

    fn mass(&mut self, stiffness: N) {
        let (c, (d1, d2), (e1, e2)) = (self.compliance, self.motion, self.minors);
        let pivot = kept_from_zero(N::real(1.0) + stiffness * c.a);
        let g = N::real(1.0) / pivot;
        self.torque = self.torque + stiffness * g * d1 * d1;
        self.motion = (d1 * g, (d2 + stiffness * e1) * g);
        self.compliance =
            Sym { a: c.a * g, b: c.b * g, c: (c.c + stiffness * c.det) * g, det: c.det * g };
        self.minors = (e1 * g, e2 * g);
        self.det = self.det.times(pivot);
        self.below += usize::from(pivot.sign_part() < 0.0);
    }

    fn inertia(&mut self, stiffness: N) {
        let (c, (d1, d2), (e1, e2)) = (self.compliance, self.motion, self.minors);
        let pivot = kept_from_zero(N::real(1.0) + stiffness * c.c);
        let g = N::real(1.0) / pivot;
        self.torque = self.torque + stiffness * g * d2 * d2;
        self.motion = ((d1 - stiffness * e2) * g, d2 * g);
        self.compliance =
            Sym { a: (c.a + stiffness * c.det) * g, b: c.b * g, c: c.c * g, det: c.det * g };
        self.minors = (e1 * g, e2 * g);
        self.det = self.det.times(pivot);
        self.below += usize::from(pivot.sign_part() < 0.0);
    }
}

impl BaseSide<f64> {
    /// Takes a power of two out of the motion and its minors where they get small, and gives its
    /// exponent: along thousands of spans at s² > 0 they would leave a double's range. The torque
    /// is then no longer that of this motor angle.
    pub(crate) fn taken_out(&mut self) -> i64 {
        let ((d1, d2), (e1, e2)) = (self.motion, self.minors);
        let size = d1.abs().max(d2.abs()).max(e1.abs()).max(e2.abs());
        if size >= SMALL || size == 0.0 {
            return 0;
        }
        let exponent = size.log2() as i32;
        let half = 2f64.powi(-exponent / 2);
        let back = |v: f64| v * half * 2f64.powi(-exponent + exponent / 2);
        self.motion = (back(d1), back(d2));
        self.minors = (back(e1), back(e2));
        i64::from(exponent)
    }
}

/// Motions below this are brought back to one.
const SMALL: f64 = 1e-100;

/// Negative ones among two real eigenvalues with this product and sum.
fn negative<N: Number>(product: N, sum: N) -> usize {
    if product.sign_part() < 0.0 {
        1
    } else if sum.sign_part() < 0.0 {
        2
    } else {
        0
    }
}

/// What has been passed coming from the tip.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TipSide<N> {
    /// Dynamic stiffness at the inner end.
    pub(crate) stiffness: Sym<N>,
    /// Characteristic function of the part with its inner end clamped, one at z = 0.
    pub(crate) det: Scaled<N>,
    /// For real z = −ω², the part's natural frequencies below ω with its inner end clamped.
    pub(crate) below: usize,
}

impl<N: Number> TipSide<N> {
    /// The free tip.
    pub(crate) fn free() -> Self {
        Self { stiffness: Sym::zero(), det: Scaled::one(), below: 0 }
    }

    /// Passes an element.
    pub(crate) fn pass(&mut self, at: At<N>, element: &Element) {
        let y = self.stiffness;
        match *element {
            Element::Span { length, rigidity } => self.span(length, bend(length, rigidity)),
            Element::Rigid { length } => self.span(length, 0.0),
            Element::Mass { mass, damping } => {
                let m = at.z.times(mass) + at.s.times(damping);
                self.stiffness = Sym { a: y.a + m, det: y.det + m * y.c, ..y };
            }
            Element::Inertia { inertia } => {
                let i = at.z.times(inertia);
                self.stiffness = Sym { c: y.c + i, det: y.det + i * y.a, ..y };
            }
            Element::Heavy { length, rigidity, mass_per_length } => {
                let count = parts(at, length, rigidity, mass_per_length);
                let part = heavy(at, length / count as f64, rigidity, mass_per_length);
                let inward = part.transport.transposed();
                for _ in 0..count {
                    let y = self.stiffness;
                    let det = y.meeting(part.compliance);
                    self.below += negative(det, y.trace(part.compliance) + N::real(2.0));
                    self.stiffness =
                        y.loaded(part.compliance, det).congruent(&inward).plus(part.inertia);
                    self.det = self.det.times(det).times(part.own);
                }
            }
        }
    }

    /// A massless span, `f` = l/EI: compliance and transport in one, so that nothing cancels.
    fn span(&mut self, l: f64, f: f64) {
        let y = self.stiffness;
        let trace = (y.a.times(l * l / 3.0) + y.b.times(l) + y.c).times(f);
        let det = kept_from_zero(N::real(1.0) + trace + y.det.times(l * l * f * f / 12.0));
        self.below += negative(det, trace + N::real(2.0));
        let g = N::real(1.0) / det;
        self.stiffness = Sym {
            a: y.a + y.det.times(f),
            b: y.b + y.a.times(l) + y.det.times(l * f / 2.0),
            c: y.c + (y.b.times(2.0) + y.a.times(l)).times(l) + y.det.times(l * l * f / 3.0),
            det: y.det,
        };
        // Divided by det, the determinant of the whole once and not twice.
        let whole = self.stiffness.times_all(g);
        self.stiffness = Sym { det: y.det * g, ..whole };
        self.det = self.det.times(det);
    }
}

impl TipSide<f64> {
    /// Motion at the outer end of `element`, not longer than a part, from that at its inner end;
    /// `self` is what lies beyond it.
    pub(crate) fn carried(&self, at: At<f64>, element: &Element, inner: (f64, f64)) -> (f64, f64) {
        let Some(Piece { transport, compliance: c, .. }) = piece(at, element) else {
            return inner;
        };
        // (I + C·Y)·u = T·u_inner
        let y = self.stiffness;
        let det = c.meeting(y);
        let (x1, x2) = transport.apply(inner);
        let (m11, m12) = (1.0 + c.a * y.a + c.b * y.b, c.a * y.b + c.b * y.c);
        let (m21, m22) = (c.b * y.a + c.c * y.b, 1.0 + c.b * y.b + c.c * y.c);
        ((m22 * x1 - m12 * x2) / det, (m11 * x2 - m21 * x1) / det)
    }
}

impl BaseSide<f64> {
    /// Load on `self` and its motion, both at the inner end of `element`, from those at its outer
    /// end; the motor is clamped.
    pub(crate) fn carried(
        &self,
        at: At<f64>,
        element: &Element,
        (force, torque): (f64, f64),
        outer: (f64, f64),
    ) -> ((f64, f64), (f64, f64)) {
        match *element {
            Element::Mass { mass, .. } => ((force - mass * at.z * outer.0, torque), outer),
            Element::Inertia { inertia } => ((force, torque - inertia * at.z * outer.1), outer),
            _ => {
                let Some(piece) = piece(at, element) else { return ((force, torque), outer) };
                let (f, t) = piece.transport.transposed().apply((force, torque));
                let w = piece.inertia;
                let c = self.compliance.loaded(w, self.compliance.meeting(w));
                let (u1, u2) = (c.a * f + c.b * t, c.b * f + c.c * t);
                ((f - w.a * u1 - w.b * u2, t - w.b * u1 - w.c * u2), (u1, u2))
            }
        }
    }
}

/// What follows at a point where both sides meet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Joined<N> {
    base: BaseSide<N>,
    tip: TipSide<N>,
    /// `det(I + C·Y)`.
    det: N,
}

impl<N: Number> Joined<N> {
    pub(crate) fn new(base: BaseSide<N>, tip: TipSide<N>) -> Self {
        Self { base, tip, det: base.compliance.meeting(tip.stiffness) }
    }

    /// Deflection and slope here in the fixed frame, per motor angle.
    pub(crate) fn motion(&self) -> (N, N) {
        let (u1, u2) = self.free_motion();
        (u1 / self.det, u2 / self.det)
    }

    /// Torque that the motor gives to the beam, per motor angle: C_t/θ_m \[N·m/rad\].
    pub(crate) fn coupling(&self) -> N {
        self.base.torque + self.free_coupling() / self.det
    }

    /// The whole beam's characteristic function with the motor clamped, one at z = 0.
    #[cfg(test)]
    pub(crate) fn characteristic(&self) -> Scaled<N> {
        self.base.det.product(self.tip.det).times(self.det)
    }

    /// Deflection per motor angle times the characteristic function: its zeros are those of the
    /// response. A mass at this very point does not enter it.
    pub(crate) fn numerator(&self) -> Scaled<N> {
        self.base.det.product(self.tip.det).times(self.free_motion().0)
    }

    /// Deflection and slope times the determinant: `(I + C·Y)⁻¹·d` by the minors.
    fn free_motion(&self) -> (N, N) {
        let ((d1, d2), (e1, e2)) = (self.base.motion, self.base.minors);
        let y = self.tip.stiffness;
        (d1 - y.b * e1 - y.c * e2, d2 + y.a * e1 + y.b * e2)
    }

    /// Coupling times the determinant, but for what is no pole.
    fn free_coupling(&self) -> N {
        let (d1, d2) = self.base.motion;
        let (u1, u2) = self.free_motion();
        let y = self.tip.stiffness;
        d1 * (y.a * u1 + y.b * u2) + d2 * (y.b * u1 + y.c * u2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heavy_piece_may_be_cut_anywhere() {
        let at = At::undamped(-4000.0_f64);
        let whole = [Element::Heavy { length: 1.0, rigidity: 2.0, mass_per_length: 3.0 }];
        let cut: Vec<Element> = [0.3, 0.5, 0.2]
            .iter()
            .map(|&length| Element::Heavy { length, rigidity: 2.0, mass_per_length: 3.0 })
            .collect();
        let run = |elements: &[Element]| {
            let mut side = BaseSide::clamped();
            for element in elements {
                side.pass(at, element);
            }
            side
        };
        let (a, b) = (run(&whole), run(&cut));
        assert!((a.motion.0 / b.motion.0 - 1.0).abs() < 1e-12);
        assert!((a.torque / b.torque - 1.0).abs() < 1e-12);
        assert!((a.det.at(0) / b.det.at(0) - 1.0).abs() < 1e-12);
        assert_eq!(a.below, b.below);
        assert!(a.below > 0);
    }

    #[test]
    fn both_sides_tell_the_same_wherever_they_meet() {
        let at = At::undamped(-700.0_f64);
        let chain = [
            Element::Rigid { length: 0.1 },
            Element::Span { length: 0.3, rigidity: 2.0 },
            Element::Mass { mass: 0.5, damping: 0.0 },
            Element::Heavy { length: 0.4, rigidity: 1.0, mass_per_length: 0.7 },
            Element::Mass { mass: 0.2, damping: 0.0 },
            Element::Inertia { inertia: 0.01 },
        ];
        let mut seen = Vec::new();
        for cut in 0..=chain.len() {
            let mut base = BaseSide::clamped();
            chain[..cut].iter().for_each(|e| base.pass(at, e));
            let mut tip = TipSide::free();
            chain[cut..].iter().rev().for_each(|e| tip.pass(at, e));
            let joined = Joined::new(base, tip);
            seen.push((joined.coupling(), joined.characteristic().at(0)));
        }
        for (coupling, det) in &seen {
            assert!((coupling / seen[0].0 - 1.0).abs() < 1e-11, "{seen:?}");
            assert!((det / seen[0].1 - 1.0).abs() < 1e-11, "{seen:?}");
        }
    }
}
