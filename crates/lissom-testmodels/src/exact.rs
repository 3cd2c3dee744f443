//! Undamped beams of any number of spans in 106 bits, by the recursion of compliance and motion
//! from base to tip with a division a mass: not the form that lissom runs.
//!
//! In doubles that recursion loses a factor of some 1e5 at 1000 spans, and 1e9 where EI differs by
//! as much; 106 bits can spare it. `evidence/peers/run.py` holds the same against 200 bits at
//! 100 000 spans. Hub, payload and dampers are left out.

use lissom::beam::LumpedBeam;

use crate::double_double::DoubleDouble;

type D = DoubleDouble;

/// What is known beyond a mass.
struct Beyond {
    /// C₁₁, C₁₂: deflection per force and per torque.
    c11: D,
    c12: D,
    /// Deflection per motor angle \[m\].
    d1: D,
    /// The mass's pivot.
    pivot: D,
}

/// Passes every span and mass at z = s² \[1/s²\], base to tip; gives what is beyond the last.
fn pass(beam: &LumpedBeam, z: D, mut each: impl FnMut(&Beyond)) -> Beyond {
    let [one, two, three] = [1.0, 2.0, 3.0].map(D::from);
    let [mut c11, mut c12, mut c22, mut d1, mut pivot] = [D::from(0.0); 5];
    let mut d2 = one;
    for span in beam.spans() {
        let (l, m) = (D::from(span.length_m), D::from(span.mass_kg));
        let bend = l / span.flexural_rigidity_n_m2.into();
        c11 = c11 + l * (two * c12 + l * (c22 + bend / three));
        c12 = c12 + l * (c22 + bend / two);
        c22 = c22 + bend;
        d1 = d1 + l * d2;
        pivot = one + z * m * c11;
        let g = one / pivot;
        let q = z * m * g;
        c22 = c22 - q * c12 * c12;
        d2 = d2 - q * c12 * d1;
        (c11, c12, d1) = (c11 * g, c12 * g, d1 * g);
        each(&Beyond { c11, c12, d1, pivot });
    }
    Beyond { c11, c12, d1, pivot }
}

/// Distance of the tip from the motor's axis \[m\].
fn length(beam: &LumpedBeam) -> D {
    beam.spans().iter().fold(D::from(0.0), |sum, span| sum + span.length_m.into())
}

/// θ_n/θ_m at `omega_rad_s`.
pub fn tip_response(beam: &LumpedBeam, omega_rad_s: f64) -> f64 {
    let omega = D::from(omega_rad_s);
    (pass(beam, -(omega * omega), |_| {}).d1 / length(beam)).value()
}

/// The zero of `f` beside `near`, by chords. Others are to be farther than some 1e-11 of it.
fn zero(f: impl Fn(D) -> D, near: f64) -> D {
    let (mut a, mut b) = (D::from(near * (1.0 - 1e-11)), D::from(near * (1.0 + 1e-11)));
    let (mut fa, mut fb) = (f(a), f(b));
    for _ in 0..3 {
        let c = b - fb * ((b - a) / (fb - fa));
        (a, fa) = (b, fb);
        (b, fb) = (c, f(c));
        if fb.value().total_cmp(&fa.value()).is_eq() {
            break;
        }
    }
    b
}

/// ω beside `near_rad_s` at which the last pivot is zero.
fn natural(beam: &LumpedBeam, near_rad_s: f64) -> D {
    zero(|w| pass(beam, -(w * w), |_| {}).pivot, near_rad_s)
}

/// The natural frequency beside `near_rad_s`, motor clamped \[rad/s\].
pub fn frequency(beam: &LumpedBeam, near_rad_s: f64) -> f64 {
    natural(beam, near_rad_s).value()
}

/// The zero of the tip's response on the real axis of s beside `near_per_s` \[1/s\].
pub fn tip_zero(beam: &LumpedBeam, near_per_s: f64) -> f64 {
    zero(|s| pass(beam, s * s, |_| {}).d1, near_per_s).value()
}

/// A mode with the motor clamped.
pub struct ExactMode {
    /// ω_k \[rad/s\].
    pub frequency_rad_s: f64,
    /// Deflection at each mass, the largest being 1 \[1\].
    pub shape: Vec<f64>,
    /// The mode's share in the tip's response \[1\].
    pub tip_share: f64,
    /// The mode's part of the inertia about the axis \[kg·m²\].
    pub inertia_kg_m2: f64,
}

/// The mode beside `near_rad_s`: the load of a unit tip deflection, carried inwards.
pub fn mode(beam: &LumpedBeam, near_rad_s: f64) -> ExactMode {
    let omega = natural(beam, near_rad_s);
    let z = -(omega * omega);
    let mut passed = Vec::with_capacity(beam.len());
    pass(beam, z, |beyond| passed.push((beyond.c11, beyond.c12)));
    let zero = D::from(0.0);
    let mut moves = vec![zero; beam.len()];
    // At the tip the inertia force is all the load there is.
    let last = &beam.spans()[beam.len() - 1];
    let mut load = (-(z * last.mass_kg.into()), zero);
    for (i, span) in beam.spans().iter().enumerate().rev() {
        if i + 1 == beam.len() {
            moves[i] = D::from(1.0);
        } else {
            let (c11, c12) = passed[i];
            moves[i] = c11 * load.0 + c12 * load.1;
            load.0 = load.0 - z * D::from(span.mass_kg) * moves[i];
        }
        load.1 = load.1 + D::from(span.length_m) * load.0;
    }
    let (mut mass, mut lever, mut at) = (zero, zero, zero);
    for (span, w) in beam.spans().iter().zip(&moves) {
        at = at + span.length_m.into();
        let driven = D::from(span.mass_kg) * *w;
        (mass, lever) = (mass + driven * *w, lever + driven * at);
    }
    let larger = |m: D, w: &D| if w.value().abs() > m.value().abs() { *w } else { m };
    let largest = moves.iter().fold(zero, larger);
    ExactMode {
        frequency_rad_s: omega.value(),
        shape: moves.iter().map(|w| (*w / largest).value()).collect(),
        tip_share: (lever / (mass * at)).value(),
        inertia_kg_m2: (lever * lever / mass).value(),
    }
}
