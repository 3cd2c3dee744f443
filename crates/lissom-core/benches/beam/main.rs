//! Speed and accuracy of the lumped beam, each beside a baseline of the same run.
//!
//! `cargo bench -p lissom-core --bench beam`. Errors go to standard error before each group; their
//! reference is `lissom_testmodels::exact`, or a file of `tests/beam_reference` where said.
#![expect(clippy::unwrap_used, reason = "the models are fixed and valid")]
#![expect(clippy::print_stderr, reason = "accuracy beside speed")]

mod baselines;

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{BenchmarkGroup, BenchmarkId, Criterion, SamplingMode, Throughput};
use criterion::{criterion_group, criterion_main, measurement::WallTime};
use lissom::beam::{Base, LumpedBeam};
use lissom_testmodels::{exact, random_beam, uniform_beam};
use num_complex::Complex64;
use serde_json::Value;

/// Frequencies of a sweep, from a tenth of the first to ten times the twentieth natural one.
const FREQUENCIES: usize = 1000;
/// A point closer to a pole than this, relatively, is judged by no error.
const NEAR_POLE: f64 = 1e-6;

/// One beam, the frequencies of its sweep and the exact responses.
struct Sweep {
    beam: LumpedBeam,
    omega: Vec<f64>,
    exact: Vec<f64>,
    judged: Vec<bool>,
}

impl Sweep {
    fn new(beam: LumpedBeam, count: usize) -> Self {
        let lowest = beam.frequencies_rad_s(Base::Clamped, 20);
        let (low, high) = (0.1 * lowest[0], 10.0 * lowest[lowest.len() - 1]);
        let step = (high / low).ln() / (count - 1) as f64;
        let omega: Vec<f64> = (0..count).map(|i| low * (step * i as f64).exp()).collect();
        let poles =
            beam.frequencies_rad_s(Base::Clamped, beam.frequencies_below(Base::Clamped, high) + 1);
        let apart = |w: &f64| poles.iter().all(|p| (w / p - 1.0).abs() > NEAR_POLE);
        let judged = omega.iter().map(apart).collect();
        let exact = omega.iter().map(|w| exact::tip_response(&beam, *w)).collect();
        Self { beam, omega, exact, judged }
    }

    /// Largest `|G − G_exact|/max(|G_exact|, 1)`.
    fn error(&self, found: impl IntoIterator<Item = f64>) -> f64 {
        let points = found.into_iter().zip(&self.exact).zip(&self.judged);
        largest(points.filter(|(_, judged)| **judged).map(|((g, e), _)| (g - e) / e.abs().max(1.0)))
    }

    fn lissom(&self) -> impl Iterator<Item = f64> {
        self.beam.tip_response(&self.omega).into_iter().map(|g| g.re)
    }

    fn by(&self, mut tip: impl FnMut(f64) -> f64) -> Vec<f64> {
        self.omega.iter().map(|w| tip(*w)).collect()
    }
}

/// The largest size; infinite where one is not a number.
fn largest(errors: impl Iterator<Item = f64>) -> f64 {
    errors.map(|e| if e.is_nan() { f64::INFINITY } else { e.abs() }).fold(0.0, f64::max)
}

/// Largest relative error of frequencies.
fn relative(found: &[f64], exact: &[f64]) -> f64 {
    assert_eq!(found.len(), exact.len());
    largest(found.iter().zip(exact).map(|(f, e)| f / e - 1.0))
}

fn say(group: &str, name: &str, error: f64) {
    eprintln!("{group}: error {error:.1e}  {name}");
}

/// A group of ten samples, `seconds` in all for each of its benches.
fn group<'a>(c: &'a mut Criterion, name: &str, seconds: u64) -> BenchmarkGroup<'a, WallTime> {
    let mut group = c.benchmark_group(name);
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.warm_up_time(Duration::from_millis(300));
    group.measurement_time(Duration::from_secs(seconds));
    group
}

/// The reference itself against the 200-bit estimates of the tests.
fn check_reference() {
    let file = format!("{}/tests/beam_reference/lumped.json", env!("CARGO_MANIFEST_DIR"));
    let file: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    let mut worst = 0.0_f64;
    for case in file["cases"].as_array().unwrap() {
        let n = case["n"].as_u64().unwrap();
        let last = case["response_index"].as_array().unwrap().iter().position(|i| *i == n);
        // The reference has neither hub nor dampers.
        let bare = case["hub_radius_m"] == 0.0 && case.get("damping_n_s_per_m").is_none();
        let (Some(last), true) = (last, bare) else { continue };
        let beam = given(case);
        for (w, at) in
            numbers(&case["omega_rad_s"]).iter().zip(case["response"].as_array().unwrap())
        {
            let expected = at[last][0].as_f64().unwrap();
            let found = exact::tip_response(&beam, *w);
            worst = worst.max((found - expected).abs() / expected.abs().max(1.0));
        }
    }
    say("reference", "double-double against lumped.json", worst);
    // The file's numbers are read to within a last place, and a pole multiplies that.
    assert!(worst < 1e-14, "{worst:e}");
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

fn given(case: &Value) -> LumpedBeam {
    let [l, m, ei] = ["lengths_m", "masses_kg", "ei_n_m2"].map(|key| numbers(&case[key]));
    let span = |i: usize| lissom::beam::Span {
        length_m: l[i],
        flexural_rigidity_n_m2: ei[i],
        mass_kg: m[i],
        damping_n_s_per_m: 0.0,
    };
    LumpedBeam::new(&(0..l.len()).map(span).collect::<Vec<_>>()).unwrap()
}

/// The sweep that a plot or a fit asks for.
fn tip_sweep(c: &mut Criterion) {
    check_reference();
    for (name, beam) in [("uniform", uniform_beam(1000)), ("random", random_beam(1000, 1))] {
        let title = format!("tip sweep, {name} n=1000");
        let sweep = Sweep::new(beam, FREQUENCIES);
        let mut banded = baselines::Banded::new(&sweep.beam);
        let last = sweep.beam.len() - 1;
        let one = |w: f64| sweep.beam.response(Complex64::new(0.0, w)).angles[last].re;
        let recursion = |w: f64| baselines::recursion(&sweep.beam, w);
        say(&title, "lissom", sweep.error(sweep.lissom()));
        say(&title, "lissom, one response after another", sweep.error(sweep.by(one)));
        say(&title, "recursion", sweep.error(sweep.by(recursion)));
        say(&title, "banded LDLᵀ", sweep.error(sweep.by(|w| banded.tip(w))));
        let mut group = group(c, &title, 2);
        group.bench_function("lissom", |b| b.iter(|| sweep.beam.tip_response(&sweep.omega)));
        group.bench_function("lissom, one response after another", |b| {
            b.iter(|| sweep.by(one));
        });
        group.bench_function("recursion", |b| b.iter(|| sweep.by(recursion)));
        group.bench_function("banded LDLᵀ", |b| b.iter(|| sweep.by(|w| banded.tip(w))));
    }
}

/// Against dense matrices, at the size and number of frequencies where these still end.
fn tip_sweep_dense(c: &mut Criterion) {
    let title = "tip sweep of 100, uniform n=200";
    let sweep = Sweep::new(uniform_beam(200), FREQUENCIES / 10);
    let matrices = sweep.beam.matrices().unwrap();
    let dense = |w: f64| baselines::dense(&sweep.beam, &matrices, w);
    say(title, "lissom", sweep.error(sweep.lissom()));
    say(title, "dense LU", sweep.error(sweep.by(dense)));
    let mut group = group(c, title, 2);
    group.bench_function("lissom", |b| b.iter(|| sweep.beam.tip_response(&sweep.omega)));
    group.bench_function("dense LU", |b| b.iter(|| sweep.by(dense)));
}

/// How building a beam and one frequency of it grow with n: constant per span if all is well.
fn growth(c: &mut Criterion) {
    let sizes: Vec<usize> = (1..=6).map(|k| 10_usize.pow(k)).collect();
    let beams: Vec<LumpedBeam> = sizes.iter().map(|n| random_beam(*n, 1)).collect();
    eprintln!("growth: ns per span{:>14}{:>10}{:>12}{:>11}", "build", "tip", "8 tips", "recursion");
    for beam in &beams {
        let omega = 5.0 * beam.frequencies_rad_s(Base::Clamped, 1)[0];
        let eight: Vec<f64> = (1..=8).map(|k| omega * f64::from(k)).collect();
        let per_span = |f: &mut dyn FnMut()| 1e9 * median_s(f) / beam.len() as f64;
        let build = per_span(&mut || drop(LumpedBeam::new(black_box(beam.spans()))));
        let one = per_span(&mut || drop(black_box(beam.tip_response(black_box(&eight[..1])))));
        let all = per_span(&mut || drop(black_box(beam.tip_response(black_box(&eight)))));
        let plain = per_span(&mut || {
            black_box(baselines::recursion(beam, black_box(omega)));
        });
        let n = beam.len();
        eprintln!("growth: n = {n:>9}{build:>17.1}{one:>10.1}{all:>12.1}{plain:>11.1}");
    }
    let mut group = group(c, "growth", 1);
    for beam in beams.iter().step_by(2) {
        let n = beam.len();
        let omega = [5.0 * beam.frequencies_rad_s(Base::Clamped, 1)[0]];
        group.throughput(Throughput::Elements(n as u64));
        group.bench_function(BenchmarkId::new("build", n), |b| {
            b.iter(|| LumpedBeam::new(black_box(beam.spans())));
        });
        group.bench_function(BenchmarkId::new("tip", n), |b| b.iter(|| beam.tip_response(&omega)));
        group.bench_function(BenchmarkId::new("recursion", n), |b| {
            b.iter(|| baselines::recursion(beam, omega[0]));
        });
    }
}

/// Median time of a call \[s\], over at least 7 of them and 30 ms.
fn median_s(f: &mut dyn FnMut()) -> f64 {
    let start = Instant::now();
    let mut times = Vec::new();
    while times.len() < 7 || (start.elapsed() < Duration::from_millis(30) && times.len() < 2000) {
        let begin = Instant::now();
        f();
        times.push(begin.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// The lowest modes of a beam far beyond dense matrices, frequencies alone and with shapes.
fn lowest_modes(c: &mut Criterion) {
    const N: usize = 100_000;
    const MODES: usize = 20;
    let title = format!("lowest {MODES} modes, random n={N}");
    let beam = random_beam(N, 1);
    let plain = || -> Vec<(f64, Vec<f64>)> {
        let frequencies = baselines::bisection(&beam, MODES);
        frequencies.into_iter().map(|w| (w, baselines::shape(&beam, w))).collect()
    };
    let found: Vec<(f64, Vec<f64>)> = beam
        .modes(MODES)
        .into_iter()
        .map(|mode| (mode.natural_frequency_rad_s, mode.shape))
        .collect();
    let exact: Vec<_> = found.iter().map(|(w, _)| exact::mode(&beam, *w)).collect();
    for (name, modes) in [("lissom", found), ("bisection and recursion", plain())] {
        let pairs = || modes.iter().zip(&exact);
        let frequencies = largest(pairs().map(|((w, _), e)| w / e.frequency_rad_s - 1.0));
        let moved = |shape: &[f64], e: &[f64]| largest(shape.iter().zip(e).map(|(f, e)| f - e));
        let shapes = largest(pairs().map(|((_, shape), e)| moved(shape, &e.shape)));
        say(&title, &format!("{name}, frequencies"), frequencies);
        say(&title, &format!("{name}, shapes"), shapes);
    }
    let mut group = group(c, &title, 6);
    group.bench_function("lissom, frequencies", |b| {
        b.iter(|| beam.frequencies_rad_s(Base::Clamped, MODES));
    });
    group.bench_function("bisection", |b| b.iter(|| baselines::bisection(&beam, MODES)));
    group.bench_function("lissom, with shapes", |b| b.iter(|| beam.modes(MODES)));
    group.bench_function("bisection and recursion, with shapes", |b| b.iter(plain));
}

/// Every frequency of a beam of the size that dense matrices are used for.
fn all_frequencies(c: &mut Criterion) {
    let title = "all frequencies, uniform n=200";
    let file = format!("{}/tests/beam_reference/lumped.json", env!("CARGO_MANIFEST_DIR"));
    let file: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    let cases = file["cases"].as_array().unwrap();
    let case = cases.iter().find(|case| case["name"] == "e_uniform_200").unwrap();
    let exact = numbers(&case["natural_frequencies_rad_s"]);
    let beam = given(case);
    let matrix = baselines::symmetric(&beam, &beam.matrices().unwrap());
    say(title, "lissom", relative(&beam.natural_frequencies_rad_s(), &exact));
    say(title, "nalgebra", relative(&baselines::eigenvalues(&matrix), &exact));
    let mut group = group(c, title, 2);
    group.bench_function("lissom", |b| b.iter(|| beam.natural_frequencies_rad_s()));
    group.bench_function("nalgebra", |b| b.iter(|| baselines::eigenvalues(&matrix)));
}

criterion_group!(beam, tip_sweep, tip_sweep_dense, growth, lowest_modes, all_frequencies);
criterion_main!(beam);
