//! Beams of any number of spans, for benches and for tests of size.

use lissom::beam::{LumpedBeam, Span};

/// Flexural rigidity \[N·m²\]; length \[m\] and mass \[kg\] are one.
const RIGIDITY_N_M2: f64 = 10.0;

/// `n` equal spans and masses: 1 m, 1 kg, EI 10 N·m².
///
/// # Panics
/// For no spans.
pub fn uniform_beam(n: usize) -> LumpedBeam {
    equal_parts(n, |_| RIGIDITY_N_M2)
}

/// As [`uniform_beam`], but every other span, from the second, is 10⁹ times as stiff.
///
/// # Panics
/// For no spans.
pub fn contrast_beam(n: usize) -> LumpedBeam {
    equal_parts(n, |i| if i % 2 == 0 { RIGIDITY_N_M2 } else { 1e9 * RIGIDITY_N_M2 })
}

#[expect(clippy::expect_used, reason = "a test model")]
fn equal_parts(n: usize, rigidity_n_m2: impl Fn(usize) -> f64) -> LumpedBeam {
    let part = 1.0 / n as f64;
    let span = |i| Span {
        length_m: part,
        flexural_rigidity_n_m2: rigidity_n_m2(i),
        mass_kg: part,
        damping_n_s_per_m: 0.0,
    };
    LumpedBeam::new(&(0..n).map(span).collect::<Vec<_>>()).expect("at least one span")
}

/// As [`uniform_beam`], with every length, rigidity and mass multiplied by its own `10^(u − 1/2)`,
/// u uniform in \[0, 1): a decade each. The same `seed` gives the same beam.
///
/// # Panics
/// For no spans.
#[expect(clippy::expect_used, reason = "a test model")]
pub fn random_beam(n: usize, seed: u64) -> LumpedBeam {
    let mut state = seed;
    let mut draw = |mean: f64| mean * 10f64.powf(uniform(&mut state) - 0.5);
    let part = 1.0 / n as f64;
    let spans: Vec<Span> = (0..n)
        .map(|_| Span {
            length_m: draw(part),
            flexural_rigidity_n_m2: draw(RIGIDITY_N_M2),
            mass_kg: draw(part),
            damping_n_s_per_m: 0.0,
        })
        .collect();
    LumpedBeam::new(&spans).expect("at least one span")
}

/// The next number in \[0, 1) of the generator SplitMix64.
fn uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}
