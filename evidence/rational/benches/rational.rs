//! Responses of two outputs at 1000 frequencies with 1 % of noise, fitted with shared poles: lissom beside
//! the crates `vecfit` (both outputs at once) and `dsmc` (each output by itself), and, where the interpreter that
//! `LISSOM_PYTHON` names (`python3` without it) has what `requirements.txt` asks for, scikit-rf and a vector fit in numpy
//! (`peers.py`). Prints what each fit leaves, in deviations of the noise, before the times.

use std::f64::consts::FRAC_1_SQRT_2;
use std::fmt::Write as _;
use std::hint::black_box;
use std::io::Write as _;
use std::process::{Command, Stdio};

use criterion::Criterion;
use dsmc::FrequencyResponse;
use dsmc::system_identification::frequency_response::vector_fitting;
use lissom::identify::{Damping, Pole, Response, fit_shared_poles};
use num_complex::Complex64;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

const FREQUENCIES: usize = 1000;
const NOISE: f64 = 0.01;

struct Case {
    modes: usize,
    omega: Vec<f64>,
    exact: Vec<Vec<Complex64>>,
    measured: Vec<Vec<Response>>,
}

impl Case {
    /// Modes over two decades, damped by 0.003 or more.
    fn new(modes: usize) -> Self {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(modes as u64);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let omega: Vec<f64> =
            (0..FREQUENCIES).map(|i| 2000f64.powf(i as f64 / (FREQUENCIES - 1) as f64)).collect();
        let poles: Vec<Pole> = (0..modes)
            .map(|k| Pole {
                omega_rad_s: 5.0
                    * 200f64.powf(k as f64 / (modes as f64 - 0.5))
                    * (1.0 + 0.05 * normal().clamp(-2.0, 2.0)),
                damping_ratio: 0.003 * (1.0 + normal().abs()),
            })
            .collect();
        let mut exact = Vec::new();
        let mut measured = Vec::new();
        for _ in 0..2 {
            let gains: Vec<f64> =
                (0..modes).map(|_| (0.3 + normal().abs()).copysign(normal())).collect();
            let at = |w: &f64| -> Complex64 {
                let parts = poles.iter().zip(&gains);
                parts.map(|(p, g)| g * p.omega_rad_s.powi(2) / p.denominator(*w)).sum()
            };
            let truth: Vec<Complex64> = omega.iter().map(at).collect();
            let with_noise = |value: &Complex64| {
                let std = NOISE * value.norm();
                let error = Complex64::new(normal(), normal()) * (std * FRAC_1_SQRT_2);
                Response { value: value + error, std }
            };
            measured.push(truth.iter().map(with_noise).collect());
            exact.push(truth);
        }
        Self { modes, omega, exact, measured }
    }

    fn lissom(&self) -> Vec<Vec<Complex64>> {
        let fit =
            fit_shared_poles(&self.omega, &self.measured, self.modes, Damping::Small).unwrap();
        let of = |o: usize| self.omega.iter().map(|w| fit.response(o, *w)).collect();
        (0..2).map(of).collect()
    }

    /// Weights are the crate's own, one a frequency: of the first output's deviations.
    fn vecfit(&self) -> Vec<Vec<Complex64>> {
        let s: Vec<Complex64> = self.omega.iter().map(|w| Complex64::new(0.0, *w)).collect();
        let flat: Vec<Complex64> = (0..FREQUENCIES)
            .flat_map(|i| [self.measured[0][i].value, self.measured[1][i].value])
            .collect();
        let weights = self.measured[0].iter().map(|r| 1.0 / r.std).collect();
        let options = vecfit::Options::new()
            .poles(2 * self.modes)
            .fit_constant(false)
            .fit_proportional(false)
            .weights(weights);
        let shape = vecfit::Shape::vector(2).unwrap();
        let model = vecfit::Model::fit_samples(vecfit::complex(&s), &flat, shape, options).unwrap();
        let rows = model.eval_vector(vecfit::complex(&s)).unwrap();
        (0..2).map(|o| rows.iter().map(|row| row[o]).collect()).collect()
    }

    /// Relative errors, as the noise is.
    fn dsmc(&self) -> Vec<Vec<Complex64>> {
        let of = |responses: &Vec<Response>| {
            let samples: Vec<FrequencyResponse<f64>> = self
                .omega
                .iter()
                .zip(responses)
                .map(|(w, r)| FrequencyResponse { omega: *w, value: r.value })
                .collect();
            let options = vector_fitting::VectorFittingOptions::default();
            let fit =
                vector_fitting::identify_relative(&samples, 2 * self.modes, &options).unwrap();
            let at = |w: &f64| -> Complex64 {
                let s = Complex64::new(0.0, *w);
                fit.poles.iter().zip(&fit.residues).map(|(p, r)| r / (s - p)).sum()
            };
            self.omega.iter().map(at).collect()
        };
        self.measured.iter().map(of).collect()
    }

    /// Fits in Python, each with its median time in s.
    fn python(&self) -> Option<Vec<(String, f64, Vec<Vec<Complex64>>)>> {
        let program = std::env::var("LISSOM_PYTHON").unwrap_or_else(|_| "python3".to_owned());
        let mut rows = String::new();
        for (i, omega) in self.omega.iter().enumerate() {
            write!(rows, "{omega:?}").unwrap();
            for r in self.measured.iter().map(|m| m[i]) {
                write!(rows, " {:?} {:?} {:?}", r.value.re, r.value.im, r.std).unwrap();
            }
            rows.push('\n');
        }
        let mut command = Command::new(program);
        command.arg(concat!(env!("CARGO_MANIFEST_DIR"), "/peers.py")).arg(self.modes.to_string());
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn().ok()?;
        // A script that ends early says so by its status.
        let _ = child.stdin.take()?.write_all(rows.as_bytes());
        let output = child.wait_with_output().ok().filter(|o| o.status.success())?;
        let text = String::from_utf8(output.stdout).ok()?;
        let of_line = |line: &str| {
            let mut words = line.split(' ');
            let name = words.next()?.to_owned();
            let numbers: Vec<f64> = words.map(|w| w.parse().ok()).collect::<Option<_>>()?;
            let (seconds, values) = numbers.split_first()?;
            let values: Vec<Complex64> =
                values.as_chunks::<2>().0.iter().map(|[re, im]| Complex64::new(*re, *im)).collect();
            Some((name, *seconds, values.chunks(FREQUENCIES).map(<[_]>::to_vec).collect()))
        };
        text.lines().map(of_line).collect()
    }

    /// What a fit leaves of the data, and how far it is from the truth; root mean squares, in deviations.
    fn left(&self, fit: &[Vec<Complex64>]) -> (f64, f64) {
        let (mut data, mut truth) = (0.0, 0.0);
        for o in 0..2 {
            for i in 0..FREQUENCIES {
                let std = self.measured[o][i].std;
                data += ((fit[o][i] - self.measured[o][i].value) / std).norm_sqr();
                truth += ((fit[o][i] - self.exact[o][i]) / std).norm_sqr();
            }
        }
        let points = (2 * FREQUENCIES) as f64;
        ((data / points).sqrt(), (truth / points).sqrt())
    }
}

/// A fit of a case: every output's responses.
type Fit = fn(&Case) -> Vec<Vec<Complex64>>;

fn main() {
    let mut criterion = Criterion::default().configure_from_args().sample_size(20);
    let fits: [(&str, Fit); 3] =
        [("lissom", Case::lissom), ("vecfit", Case::vecfit), ("dsmc", Case::dsmc)];
    println!("{:>5} {:9} {:>12} {:>12}", "modes", "fit", "left of data", "off truth");
    let cases = [2, 5, 10].map(Case::new);
    for case in &cases {
        for (name, fit) in fits {
            let (data, truth) = case.left(&fit(case));
            println!("{:5} {name:9} {data:12.3} {truth:12.3}", case.modes);
        }
        let Some(found) = case.python() else {
            println!("{:5} no Python with requirements.txt: see LISSOM_PYTHON", case.modes);
            continue;
        };
        for (name, seconds, fit) in found {
            let (data, truth) = case.left(&fit);
            let ms = 1e3 * seconds;
            println!("{:5} {name:9} {data:12.3} {truth:12.3} {ms:9.2} ms, median", case.modes);
        }
    }
    for case in &cases {
        let mut group = criterion.benchmark_group(format!("{} modes", case.modes));
        for (name, fit) in fits {
            group.bench_function(name, |b| b.iter(|| black_box(fit(case))));
        }
        group.finish();
    }
    criterion.final_summary();
}
