//! How exact the lumped beam's estimates are from 500 to 100 000 masses.
//!
//! `cargo bench -p lissom-core --bench accuracy` prints a row per beam: largest errors against
//! `lissom_testmodels::exact` (106 bits). With `--test`, 500 masses alone.
//!
//! - frequencies: the lowest 20, relative; shapes: those modes' deflections, the largest of each
//!   being 1; shares: of these modes in the tip's response and in the inertia, per largest share
//! - tip: `|G − G_exact|/max(|G_exact|, 1)` at 100 frequencies evenly in log from a tenth of the
//!   first to ten times the twentieth natural one; beside poles: at 1.01e-6 on both sides of every
//!   pole in that range
//! - zeros: the lowest 20 of the tip, relative
#![expect(clippy::print_stderr, reason = "a table for a terminal")]

use lissom::beam::{Base, LumpedBeam};
use lissom_testmodels::{contrast_beam, exact, random_beam, uniform_beam};

const COUNT: usize = 20;
const FREQUENCIES: usize = 100;
/// Distance from a pole, relatively: just outside of what the bar leaves out.
const BESIDE_POLE: f64 = 1.01e-6;

fn main() {
    // `cargo bench` adds `--bench`, `cargo test` does not.
    let given = |flag: &str| std::env::args().any(|a| a == flag);
    let quick = given("--test") || !given("--bench");
    let sizes = if quick { &[500][..] } else { &[500, 1000, 10_000, 100_000] };
    let head = ["frequencies", "shapes", "shares", "tip", "beside poles", "zeros"];
    row("beam", "n", &head.map(String::from));
    row("---", "---", &head.map(|_| "---".into()));
    for n in sizes {
        let beams = [
            ("uniform", uniform_beam(*n)),
            ("random", random_beam(*n, 1)),
            ("EI 1 : 1e9", contrast_beam(*n)),
        ];
        for (name, beam) in beams {
            let errors = errors(&beam).map(|e| e.map_or("-".into(), |e| format!("{e:.1e}")));
            row(name, &n.to_string(), &errors);
        }
    }
}

fn row(name: &str, n: &str, columns: &[String]) {
    let columns: Vec<String> = columns.iter().map(|c| format!("{c:>12}")).collect();
    eprintln!("| {name:<10} | {n:>6} | {} |", columns.join(" | "));
}

/// In the order of the table.
fn errors(beam: &LumpedBeam) -> [Option<f64>; 6] {
    let [frequencies, shapes, shares] = modes(beam);
    let lowest = beam.frequencies_rad_s(Base::Clamped, COUNT);
    let (low, high) = (0.1 * lowest[0], 10.0 * lowest[COUNT - 1]);
    let step = (high / low).ln() / (FREQUENCIES - 1) as f64;
    let spread: Vec<f64> = (0..FREQUENCIES).map(|i| low * (step * i as f64).exp()).collect();
    let poles = beam.frequencies_rad_s(Base::Clamped, beam.frequencies_below(Base::Clamped, high));
    let beside: Vec<f64> =
        poles.iter().flat_map(|p| [p * (1.0 - BESIDE_POLE), p * (1.0 + BESIDE_POLE)]).collect();
    let zeros = beam
        .tip_zeros_per_s(COUNT)
        .map(|zeros| largest(zeros.iter().map(|s| s / exact::tip_zero(beam, *s) - 1.0)));
    [
        Some(frequencies),
        Some(shapes),
        Some(shares),
        Some(tip(beam, &spread)),
        Some(tip(beam, &beside)),
        zeros,
    ]
}

/// Errors of the lowest modes: frequency, shape, shares.
fn modes(beam: &LumpedBeam) -> [f64; 3] {
    let found = beam.modes(COUNT);
    let exact: Vec<_> =
        found.iter().map(|mode| exact::mode(beam, mode.natural_frequency_rad_s)).collect();
    let pairs = || found.iter().zip(&exact);
    let last = beam.len() - 1;
    let most_share = largest(exact.iter().map(|e| e.tip_share));
    let most_inertia = largest(exact.iter().map(|e| e.inertia_kg_m2));
    [
        largest(pairs().map(|(f, e)| f.natural_frequency_rad_s / e.frequency_rad_s - 1.0)),
        largest(pairs().flat_map(|(f, e)| f.shape.iter().zip(&e.shape).map(|(f, e)| f - e))),
        largest(pairs().flat_map(|(f, e)| {
            [
                (f.share[last] - e.tip_share) / most_share,
                (f.inertia_kg_m2 - e.inertia_kg_m2) / most_inertia,
            ]
        })),
    ]
}

/// Largest error of the tip's response.
fn tip(beam: &LumpedBeam, omega: &[f64]) -> f64 {
    largest(beam.tip_response(omega).iter().zip(omega).map(|(g, w)| {
        let exact = exact::tip_response(beam, *w);
        (g.re - exact) / exact.abs().max(1.0)
    }))
}

/// The largest size; infinite where one is not a number.
fn largest(errors: impl Iterator<Item = f64>) -> f64 {
    errors.map(|e| if e.is_nan() { f64::INFINITY } else { e.abs() }).fold(0.0, f64::max)
}
