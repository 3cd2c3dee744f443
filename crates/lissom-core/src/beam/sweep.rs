//! The tip's response at many frequencies at a time, without damping.
//!
//! If compliance, motion and their minors are all multiplied by the product p of the pivots, every step of the
//! recursion of `chain` is linear and has no division. Numerator and denominator become nine numbers, with 19
//! multiplications and 24 additions per span. Frequencies run in blocks that fill the vector registers of the processor
//! without explicit vector instructions. Only here is the plain recursion written a second time: it is 20 times as fast
//! as one [`response`](LumpedBeam::response) after another, and no less exact (`docs/src/evidence/benchmarks.md`).
//!
//! # Source
//! The compound form of the recursion, `[Ng1985]`.

#![expect(clippy::needless_range_loop, reason = "lanes side by side are what is vectorised")]

use num_complex::Complex64;

use super::{LumpedBeam, Span};

/// Frequencies side by side: what two or four vectors hold.
const LANES: usize = 8;
/// Spans whose coefficients are kept at hand while all blocks pass over them.
const CHUNK: usize = 128;
/// Spans after which the size is taken out: fewer than it takes to leave a double's range.
const STRIDE: usize = 16;

/// A span's coefficients, f = l/EI.
#[derive(Clone, Copy, Default)]
struct Coefficients {
    /// l
    l: f64,
    /// l²/3
    l2_3: f64,
    /// f
    f: f64,
    /// l·f/2
    lf_2: f64,
    /// l²·f/3
    l2f_3: f64,
    /// l²·f/6
    l2f_6: f64,
    /// l²·f²/12
    l2f2_12: f64,
    /// Mass at the outer end; zero where it is joined with the payload instead.
    m: f64,
}

impl Coefficients {
    fn of(span: &Span, mass_kg: f64) -> Self {
        let l = span.length_m;
        let f = l / span.flexural_rigidity_n_m2;
        let lf_2 = 0.5 * l * f;
        Self {
            l,
            l2_3: l * l / 3.0,
            f,
            lf_2,
            l2f_3: l * lf_2 * (2.0 / 3.0),
            l2f_6: l * lf_2 / 3.0,
            l2f2_12: lf_2 * lf_2 / 3.0,
            m: mass_kg,
        }
    }
}

type Lane = [f64; LANES];

/// A number whose change over a stride is summed apart, so that many small steps cost one rounding
/// of the whole: poles stay where they are to about 1e-16, relatively, for any number of spans.
#[derive(Clone, Copy)]
struct Grown {
    now: Lane,
    /// At the stride's beginning.
    start: Lane,
    change: Lane,
}

impl Grown {
    fn from(start: f64) -> Self {
        Self { now: [start; LANES], start: [start; LANES], change: [0.0; LANES] }
    }
    #[inline]
    fn add(&mut self, j: usize, step: f64) {
        self.change[j] += step;
        self.now[j] = self.start[j] + self.change[j];
    }
    /// Begins a stride with all numbers times `back`; what the sum rounds off is its first change.
    #[inline]
    fn settle(&mut self, j: usize, back: f64) {
        self.change[j] = (self.change[j] - (self.now[j] - self.start[j])) * back;
        self.now[j] *= back;
        self.start[j] = self.now[j];
    }
}

/// p, p·C, p·det C; p·d and the minors −p·e.
#[derive(Clone, Copy)]
struct State {
    p: Grown,
    a: Grown,
    b: Grown,
    c: Grown,
    det: Lane,
    d1: Lane,
    d2: Lane,
    e1: Lane,
    e2: Lane,
}

impl State {
    fn clamped(hub_radius: f64) -> Self {
        let (o, one) = ([0.0; LANES], [1.0; LANES]);
        let zero = Grown::from(0.0);
        let p = Grown::from(1.0);
        let d1 = [hub_radius; LANES];
        Self { p, a: zero, b: zero, c: zero, det: o, d1, d2: one, e1: o, e2: o }
    }

    /// A span and its mass at −ω² = −`square`.
    #[inline]
    fn pass(&mut self, square: &Lane, q: &Coefficients) {
        for j in 0..LANES {
            let load = square[j] * q.m;
            let (p, a, b, c) = (self.p.now[j], self.a.now[j], self.b.now[j], self.c.now[j]);
            let (turn, lb) = (q.l * c, q.l * b);
            self.det[j] += q.f * (q.l2_3 * c + (lb + a)) + q.l2f2_12 * p;
            self.a.add(j, (lb + q.l * (b + turn)) + q.l2f_3 * p);
            self.b.add(j, turn + q.lf_2 * p);
            self.c.add(j, q.f * p - load * self.det[j]);
            self.p.add(j, -(load * self.a.now[j]));

            self.e1[j] += q.l * self.e2[j] + (q.l2f_6 * self.d2[j] + q.lf_2 * self.d1[j]);
            self.e2[j] += q.f * self.d1[j] + q.lf_2 * self.d2[j];
            self.d1[j] += q.l * self.d2[j];
            self.d2[j] += load * self.e1[j];
        }
    }

    /// Takes a power of two out of all numbers: G is a ratio of them.
    #[inline]
    fn settle(&mut self) {
        for j in 0..LANES {
            let back = reciprocal_power(self.p.now[j].abs().max(self.d2[j].abs()));
            for grown in [&mut self.p, &mut self.a, &mut self.b, &mut self.c] {
                grown.settle(j, back);
            }
            for lane in [&mut self.det, &mut self.d1, &mut self.d2, &mut self.e1, &mut self.e2] {
                lane[j] *= back;
            }
        }
    }
}

/// 2^−k for a number of size 2^k, from its exponent's bits.
#[inline]
fn reciprocal_power(size: f64) -> f64 {
    const EXPONENT: u64 = 0x7FF0_0000_0000_0000;
    // Twice the bias of 1023, less the exponent.
    const BOTH: u64 = 0x7FE0_0000_0000_0000;
    f64::from_bits(BOTH.saturating_sub(size.to_bits() & EXPONENT))
}

/// What is joined to the tip: its mass and the payload, as a stiffness per z.
struct Load {
    a: f64,
    b: f64,
    c: f64,
    det: f64,
}

impl Load {
    fn of(beam: &LumpedBeam) -> Self {
        let payload = beam.payload();
        let (m, e) = (payload.mass_kg, payload.offset_m);
        let mass = beam.spans()[beam.len() - 1].mass_kg;
        let turned = payload.inertia_kg_m2 + m * e * e;
        Self { a: mass + m, b: m * e, c: turned, det: mass * turned + m * payload.inertia_kg_m2 }
    }
}

/// θ_n/θ_m at each `omega_rad_s`, damping left out.
fn undamped(beam: &LumpedBeam, omega_rad_s: &[f64]) -> Vec<f64> {
    let squares: Vec<Lane> = omega_rad_s
        .chunks(LANES)
        .map(|block| std::array::from_fn(|j| block.get(j).map_or(0.0, |w| w * w)))
        .collect();
    let mut states = vec![State::clamped(beam.hub_radius_m()); squares.len()];
    let mut coefficients = [Coefficients::default(); CHUNK];
    let last = beam.len() - 1;
    for start in (0..=last).step_by(CHUNK) {
        let spans = &beam.spans()[start..(start + CHUNK).min(beam.len())];
        for (i, span) in spans.iter().enumerate() {
            let mass = if start + i == last { 0.0 } else { span.mass_kg };
            coefficients[i] = Coefficients::of(span, mass);
        }
        for (square, state) in squares.iter().zip(&mut states) {
            let mut here = *state;
            for part in coefficients[..spans.len()].chunks(STRIDE) {
                for q in part {
                    here.pass(square, q);
                }
                here.settle();
            }
            *state = here;
        }
    }
    let load = Load::of(beam);
    let length = beam.position_m()[last];
    let mut found = Vec::with_capacity(omega_rad_s.len());
    for ((square, s), block) in squares.iter().zip(&states).zip(omega_rad_s.chunks(LANES)) {
        for j in 0..block.len() {
            let z = -square[j];
            let (a, b, c) = (s.a.now[j], s.b.now[j], s.c.now[j]);
            let p = s.p.now[j]
                + z * (load.a * a + 2.0 * load.b * b + load.c * c)
                + z * z * load.det * s.det[j];
            let d = s.d1[j] + z * (load.b * s.e1[j] + load.c * s.e2[j]);
            found.push(d / (p * length));
        }
    }
    found
}

impl LumpedBeam {
    /// Frequency response of the tip, θ_n/θ_m \[1\], at each `omega_rad_s`.
    ///
    /// The values are those of [`response`](Self::response) at `s = jω`. Without damping they are real, and many
    /// frequencies are computed at a time. At 1000 spans errors are below 1e-9 of the value, or below 1e-9 if the value
    /// is less than one; this holds up to ten times the twentieth natural frequency, and down to a relative distance of
    /// 1e-6 from a pole (`tests/tip_sweep.rs`; results up to 100 000 spans are in `docs/src/evidence/benchmarks.md`).
    /// Exactly on an undamped pole the value may be infinite.
    ///
    /// # Source
    /// `[Feliu1989, eq. (16)]`
    pub fn tip_response(&self, omega_rad_s: &[f64]) -> Vec<Complex64> {
        let single = |omega: f64| {
            let angles = self.response(Complex64::new(0.0, omega)).angles;
            angles[self.len() - 1]
        };
        if !self.is_undamped() {
            return omega_rad_s.iter().map(|omega| single(*omega)).collect();
        }
        let found = undamped(self, omega_rad_s).into_iter().zip(omega_rad_s);
        found
            // Out of range where a span's load and bend exceed all bounds within a stride.
            .map(|(g, omega)| if g.is_finite() { g.into() } else { single(*omega) })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::Payload;

    /// Against the recursion of `chain`, over beams with everything on them.
    #[test]
    fn the_sweep_is_the_recursion() {
        let spans: Vec<Span> = (0..37_u32)
            .map(|i| Span {
                length_m: 0.02 + 0.01 * f64::from(i * 7 % 5),
                flexural_rigidity_n_m2: 1.0 + f64::from(i * 5 % 7),
                mass_kg: 0.01 + 0.02 * f64::from(i * 3 % 4),
                damping_n_s_per_m: 0.0,
            })
            .collect();
        let plain = LumpedBeam::new(&spans).unwrap();
        let payload = Payload { mass_kg: 0.3, inertia_kg_m2: 0.004, offset_m: 0.05 };
        let loaded = plain.clone().with_hub_radius(0.07).unwrap().with_payload(payload).unwrap();
        for beam in [plain, loaded] {
            let first = beam.natural_frequencies_rad_s()[0];
            let omega: Vec<f64> = (0..203).map(|k| first * 0.1 * 1.05_f64.powi(k)).collect();
            for (w, g) in omega.iter().zip(beam.tip_response(&omega)) {
                let expected = beam.response(Complex64::new(0.0, *w)).angles[beam.len() - 1];
                assert!((g - expected).norm() < 1e-11 * expected.norm().max(1.0), "{w}: {g}");
            }
        }
    }

    #[test]
    fn no_span_is_too_stiff_or_too_heavy() {
        let span = |ei, m| Span {
            length_m: 1.0,
            flexural_rigidity_n_m2: ei,
            mass_kg: m,
            damping_n_s_per_m: 0.0,
        };
        let beam = LumpedBeam::new(&vec![span(1e-30, 1e30); 40]).unwrap();
        for g in beam.tip_response(&[1.0, 1e10]) {
            assert!(!g.is_nan(), "{g}");
        }
    }
}
