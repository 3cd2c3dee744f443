//! Pieces of a chain: an inertia, a transport and a compliance, and the 2×2 algebra of these.

use super::element::{At, Element};
use crate::number::Number;

/// Terms of the series of a piece with mass: for |x| ≤ 1 the seventh is below 1e-19.
const TERMS: usize = 7;

/// Symmetric 2×2, its determinant carried beside it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sym<N> {
    pub(crate) a: N,
    pub(crate) b: N,
    pub(crate) c: N,
    /// `a·c − b²`, formed without that subtraction.
    pub(crate) det: N,
}

impl<N: Number> Sym<N> {
    pub(super) fn zero() -> Self {
        let o = N::real(0.0);
        Self { a: o, b: o, c: o, det: o }
    }
    /// With the determinant from the entries, where it does not cancel.
    fn new(a: N, b: N, c: N) -> Self {
        Self { a, b, c, det: a * c - b * b }
    }
    pub(super) fn times_all(self, factor: N) -> Self {
        Self {
            a: self.a * factor,
            b: self.b * factor,
            c: self.c * factor,
            det: self.det * factor * factor,
        }
    }
    /// The sum; its determinant is `det A + det B + tr(A·adj B)`.
    pub(super) fn plus(self, o: Self) -> Self {
        let mixed = self.a * o.c + self.c * o.a - (self.b * o.b).times(2.0);
        Self { a: self.a + o.a, b: self.b + o.b, c: self.c + o.c, det: self.det + o.det + mixed }
    }
    /// `T·S·Tᵀ`.
    pub(super) fn congruent(self, t: &Transport<N>) -> Self {
        let [[p, q], [r, u]] = t.matrix;
        // S·Tᵀ, by columns.
        let (x1, y1) = (self.a * p + self.b * q, self.b * p + self.c * q);
        let (x2, y2) = (self.a * r + self.b * u, self.b * r + self.c * u);
        Self {
            a: p * x1 + q * y1,
            b: r * x1 + u * y1,
            c: r * x2 + u * y2,
            det: self.det * t.det * t.det,
        }
    }
    /// `det(I + A·B) = 1 + tr(A·B) + det A·det B`.
    pub(crate) fn meeting(self, o: Self) -> N {
        kept_from_zero(N::real(1.0) + self.trace(o) + self.det * o.det)
    }
    /// `tr(A·B)`.
    pub(super) fn trace(self, o: Self) -> N {
        self.a * o.a + (self.b * o.b).times(2.0) + self.c * o.c
    }
    /// `A·(I + B·A)⁻¹ = (A + det A·adj B)/det(I + B·A)`.
    pub(crate) fn loaded(self, o: Self, det: N) -> Self {
        let inverse = N::real(1.0) / det;
        Self {
            a: (self.a + self.det * o.c) * inverse,
            b: (self.b - self.det * o.b) * inverse,
            c: (self.c + self.det * o.a) * inverse,
            det: self.det * inverse,
        }
    }
}

/// How one end moves with the other while nothing pulls at it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Transport<N> {
    matrix: [[N; 2]; 2],
    pub(super) det: N,
}

impl<N: Number> Transport<N> {
    pub(super) fn apply(&self, (x, y): (N, N)) -> (N, N) {
        let [[a, b], [c, d]] = self.matrix;
        (a * x + b * y, c * x + d * y)
    }
    pub(super) fn transposed(&self) -> Self {
        let [[a, b], [c, d]] = self.matrix;
        Self { matrix: [[a, c], [b, d]], det: self.det }
    }
}

/// A piece with mass as: an inertia at its inner end, then a transport, then a compliance.
///
/// `u_b = T·u_a + C·f_b` and `f_a = W·u_a − Tᵀ·f_b`, f the loads on its ends.
pub(super) struct Piece<N> {
    pub(super) inertia: Sym<N>,
    pub(super) transport: Transport<N>,
    pub(super) compliance: Sym<N>,
    /// Its own characteristic, one at rest: (1 + cos λ·cosh λ)/2.
    pub(super) own: N,
}

/// Largest |λ|, λ⁴ = x, of a piece with mass: well below the 1.8751 of its first clamped-free
/// frequency.
const LAMBDA_MOST: f64 = 1.0;

/// How many equal parts a heavy piece is cut into.
pub(super) fn parts<N: Number>(at: At<N>, length: f64, rigidity: f64, mass: f64) -> usize {
    let x = at.z.size() * mass * length.powi(4) / rigidity;
    // A complex number's size here is its larger part: √2 covers the modulus.
    ((2f64.sqrt() * x).powf(0.25) / LAMBDA_MOST).ceil().max(1.0) as usize
}

/// One part of a heavy piece, by the power series of its clamped-free functions in
/// x = λ⁴ = −z·μ·l⁴/EI, entire in x: no hyperbolic functions to overflow or cancel.
pub(super) fn heavy<N: Number>(
    at: At<N>,
    length: f64,
    rigidity: f64,
    mass_per_length: f64,
) -> Piece<N> {
    let load = at.z.times(mass_per_length); // z·μ [kg/(m·s²)]
    let x = -load.times(length.powi(4) / rigidity);
    // Σ base^m·k!/(4m+k)!·x^m, each term from the one before.
    let series = |base: f64, k: usize| {
        let mut term = N::real(1.0);
        let mut sum = term;
        for m in 1..TERMS {
            let top = 4 * m + k;
            let down: f64 = (top - 3..=top).map(|j| j as f64).product();
            term = term * x.times(base / down);
            sum = sum + term;
        }
        sum
    };
    // cos·cosh, (sin·cosh + cos·sinh)/2λ, sin·sinh/λ², 3(sin·cosh − cos·sinh)/2λ³ …
    let own = (series(-4.0, 0) + N::real(1.0)).times(0.5);
    let (p, q, r) = (series(-4.0, 1) / own, series(-4.0, 2) / own, series(-4.0, 3) / own);
    // … (cos + cosh)/2, (sin + sinh)/2λ, 3(sinh − sin)/λ³.
    let (a, b, g) = (series(1.0, 0) / own, series(1.0, 1) / own, series(1.0, 3) / own);
    let l = length;
    let lower = (x * g).times(1.0 / (6.0 * l));
    Piece {
        inertia: Sym::new(
            (load * p).times(l),
            (load * q).times(l * l / 2.0),
            (load * r).times(l * l * l / 3.0),
        ),
        transport: Transport {
            matrix: [[a, b.times(l)], [lower, a]],
            det: a * a - b.times(l) * lower,
        },
        compliance: Sym::new(
            r.times(l * l * l / (3.0 * rigidity)),
            q.times(l * l / (2.0 * rigidity)),
            p.times(l / rigidity),
        ),
        own,
    }
}

/// A pivot of exactly zero is within rounding of this one.
pub(super) fn kept_from_zero<N: Number>(pivot: N) -> N {
    if pivot.size() == 0.0 { N::real(f64::EPSILON) } else { pivot }
}

/// Bend of a massless span per moment, l/EI \[1/(N·m)\]; zero where it is rigid.
pub(super) fn bend(length: f64, rigidity: f64) -> f64 {
    if rigidity.is_finite() { length / rigidity } else { 0.0 }
}

/// A piece at one z, for carrying a motion across it.
pub(super) fn piece(at: At<f64>, element: &Element) -> Option<Piece<f64>> {
    let (length, rigidity) = match *element {
        Element::Heavy { length, rigidity, mass_per_length } => {
            return Some(heavy(at, length, rigidity, mass_per_length));
        }
        Element::Span { length, rigidity } => (length, rigidity),
        Element::Rigid { length } => (length, f64::INFINITY),
        Element::Mass { .. } | Element::Inertia { .. } => return None,
    };
    let f = bend(length, rigidity);
    Some(Piece {
        inertia: Sym::zero(),
        transport: Transport { matrix: [[1.0, length], [0.0, 1.0]], det: 1.0 },
        compliance: Sym {
            a: length * length * f / 3.0,
            b: length * f / 2.0,
            c: f,
            det: length * length * f * f / 12.0,
        },
        own: 1.0,
    })
}

/// The elements with heavy ones cut into parts short enough for `at`, and where each old one
/// begins among the new ones (and their end).
pub(crate) fn cut_up(elements: &[Element], at: At<f64>) -> (Vec<Element>, Vec<usize>) {
    let mut cut = Vec::with_capacity(elements.len());
    let mut place = Vec::with_capacity(elements.len() + 1);
    for element in elements {
        place.push(cut.len());
        match *element {
            Element::Heavy { length, rigidity, mass_per_length } => {
                let count = parts(at, length, rigidity, mass_per_length);
                let length = length / count as f64;
                let part = Element::Heavy { length, rigidity, mass_per_length };
                cut.extend(std::iter::repeat_n(part, count));
            }
            other => cut.push(other),
        }
    }
    place.push(cut.len());
    (cut, place)
}
