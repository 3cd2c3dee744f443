//! Speed of the estimators on the demo's campaign (30 stepped sines, 238 000 samples every 3 ms), and of
//! the replay with three masses.
//!
//! `cargo bench -p lissom-core --bench identify`. One evaluation of the cost is a replay of all runs from
//! end to end: the baseline of both estimators. With its derivatives it stands beside the same by
//! central differences of the cost, over a hundredth of each parameter's standard error. How far these
//! would take each parameter elsewhere, in its standard errors (as a share of the gradient where that is
//! steeper), goes to standard error, as do the estimates of both estimators and the work that the
//! search did. `RAYON_NUM_THREADS=1` measures one core.
#![expect(clippy::unwrap_used, reason = "the models are fixed and valid")]
#![expect(clippy::print_stderr, reason = "accuracy beside speed")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::identify::{
    Effort, Interrupt, Options, OutputErrorStart, Prepared, beam_regression, motor_regression,
    output_error, starts,
};
use lissom::record::{Campaign, Run};
use lissom::replay::{
    ArmModes, ModalArm, Parameter, Sampling, SensorNoise, Window, costs, free_parameters, sums,
};
use lissom::rig::{Experiment, Settle};
use lissom_testmodels::{report_arm, report_rig};

const OMEGA_RAD_S: [f64; 15] =
    [1.0, 1.3, 1.7, 3.0, 3.1, 3.9, 5.1, 7.8, 9.3, 10.0, 11.7, 15.3, 23.4, 27.9, 30.0];
const PERIODS: f64 = 12.0;
const LEAST_S: f64 = 12.0;

/// The demo's campaign, and the frequency of each run.
fn campaign() -> (Campaign, Vec<Option<f64>>) {
    let rig = report_rig(Some(12));
    let run = |amplitude_rad: f64, omega: f64| {
        let record_s = (PERIODS * std::f64::consts::TAU / omega).max(LEAST_S);
        let sine = Experiment::sine(omega, amplitude_rad, record_s).unwrap();
        let settled = sine.settling(Settle::Wait { wait_s: 300.0 });
        rig.run(&format!("{omega} rad/s, {amplitude_rad} rad"), &settled, 0).unwrap().run
    };
    let of_amplitude = |a: f64| OMEGA_RAD_S.iter().map(move |w| (a, *w));
    let runs: Vec<Run> =
        [0.5, 1.0].into_iter().flat_map(of_amplitude).map(|(a, w)| run(a, w)).collect();
    let channels = rig.channels(0..1).unwrap();
    let omega = OMEGA_RAD_S.iter().chain(&OMEGA_RAD_S).map(|w| Some(*w)).collect();
    (Campaign::new(channels, runs).unwrap(), omega)
}

fn start(campaign: &Campaign, omega_rad_s: &[Option<f64>]) -> OutputErrorStart {
    let motor = motor_regression(&Prepared::of(campaign), &Options::default()).unwrap();
    let beam = beam_regression(&Prepared::of(campaign));
    let arms = starts(campaign, &motor.estimates(), beam.as_ref(), None);
    OutputErrorStart {
        shown_rad_s: Vec::new(),
        further_terms: Vec::new(),
        most_evaluations: Effort::Thorough.most_evaluations(),
        interrupt: Interrupt::default(),
        arms,
        omega_rad_s: omega_rad_s.to_vec(),
        first_window_s: None,
    }
}

/// An arm, what is free of it, and how well that is known.
struct Case<'a> {
    campaign: &'a Campaign,
    arm: &'a ModalArm,
    parameters: &'a [Parameter],
    std: Vec<f64>,
    windows: &'a [Window],
    noise: &'a [SensorNoise],
}

impl Case<'_> {
    /// Gradient of half the cost by the parameters that a replay carries along.
    fn gradient(&self) -> Vec<f64> {
        let masks = self.masks();
        let sampling = self.sampling(&masks);
        let of_windows = sums(self.arm, self.parameters, self.campaign, self.windows, sampling);
        let last = of_windows[0].gram.ncols() - 1;
        let by = |p: usize| -of_windows.iter().map(|s| s.gram[(p, last)]).sum::<f64>();
        (0..self.parameters.len()).map(by).collect()
    }

    fn cost(&self, arm: &ModalArm) -> f64 {
        let masks = self.masks();
        costs(arm, self.campaign, self.windows, self.sampling(&masks)).iter().map(|w| w.cost).sum()
    }

    /// The gradient by central differences.
    fn differences(&self) -> Vec<f64> {
        let by = |(p, std): (&Parameter, &f64)| {
            let step = 0.01 * std;
            let at = |change: f64| {
                let mut arm = self.arm.clone();
                p.set(&mut arm, p.of(self.arm) + change);
                self.cost(&arm)
            };
            0.5 * (at(step) - at(-step)) / (2.0 * step)
        };
        self.parameters.iter().zip(&self.std).map(by).collect()
    }

    fn masks(&self) -> Vec<Vec<Option<Vec<bool>>>> {
        vec![vec![None; self.noise.len()]; self.campaign.runs.len()]
    }

    fn sampling<'b>(&'b self, masks: &'b [Vec<Option<Vec<bool>>>]) -> Sampling<'b> {
        Sampling { noise: self.noise, blocks: &[], masks, command_noise: 0.0 }
    }

    fn bench(&self, c: &mut Criterion, name: &str) {
        let (exact, differences) = (self.gradient(), self.differences());
        let apart = exact.iter().zip(&differences).zip(&self.std);
        let apart = apart.map(|((a, b), s)| (a - b).abs() * s / (a * s).abs().max(1.0));
        let samples: usize = self.windows.iter().map(Window::len).sum();
        eprintln!(
            "{name}: {samples} samples, {} parameters, differences apart by {:.1e}",
            self.parameters.len(),
            apart.fold(0.0, f64::max)
        );
        let mut group = c.benchmark_group(name);
        group.sample_size(10).measurement_time(Duration::from_secs(2));
        group.bench_function("cost", |b| b.iter(|| black_box(self.cost(self.arm))));
        group.bench_function("cost and derivatives", |b| b.iter(|| black_box(self.gradient())));
        group.bench_function("by central differences (baseline)", |b| {
            b.iter(|| black_box(self.differences()));
        });
        group.finish();
    }
}

fn demo(c: &mut Criterion) {
    let (campaign, omega) = campaign();
    let start = start(&campaign, &omega);
    let found = output_error(&Prepared::of(&campaign), &start).unwrap();
    let estimates = found.parameters.iter().map(|p| found.estimate(*p).unwrap());
    for (p, e) in found.parameters.iter().zip(estimates.clone()) {
        eprintln!("  {} {:.8e} ± {:.1e}", p.name(), e.value, e.std);
    }
    let steps: usize = found.stages.iter().map(|s| s.iterations.len()).sum();
    eprintln!("{} stages, {steps} steps", found.stages.len());
    let mut case = Case {
        campaign: &campaign,
        arm: &found.arm,
        parameters: &found.parameters,
        std: estimates.map(|e| e.std).collect(),
        windows: &found.windows,
        noise: &found.stages.last().unwrap().noise,
    };
    case.bench(c, "demo's campaign, steps as steps");
    let plain: Vec<SensorNoise> =
        case.noise.iter().map(|n| SensorNoise::gaussian(n.deviation())).collect();
    case.noise = &plain;
    case.bench(c, "demo's campaign, plain noise");

    let mut group = c.benchmark_group("demo's campaign");
    group.sample_size(10).measurement_time(Duration::from_secs(2));
    group.bench_function("regression of the motor", |b| {
        b.iter(|| motor_regression(&Prepared::of(&campaign), &Options::default()));
    });
    group.bench_function("regression of the beam", |b| {
        b.iter(|| beam_regression(&Prepared::of(&campaign)));
    });
    group.bench_function("output error", |b| {
        b.iter(|| output_error(&Prepared::of(&campaign), &start));
    });
    group.finish();
}

/// Three masses under a multisine, seen by tips without noise.
fn three_masses(c: &mut Criterion) {
    let report = report_arm();
    let third = |s: Span| Span { length_m: s.length_m / 3.0, mass_kg: s.mass_kg / 3.0, ..s };
    let beam = LumpedBeam::new(&[third(report.beam().spans()[0]); 3]).unwrap();
    let mut rig = report_rig(Some(14));
    rig.arm = Arm::new(beam, report.motor, report.coulomb).unwrap();
    let logged = rig.run("sine", &Experiment::sine(3.0, 0.7, 60.0).unwrap(), 0).unwrap();
    let modes = ArmModes::of(&rig.arm).unwrap();
    let windows = [Window {
        run: 0,
        samples: 0..=logged.run.len() - 1,
        start: modes.state(&[0, 1, 2], &logged.start),
        zeros: vec![0.0; 3],
    }];
    let arm = ModalArm::of_arm(&rig.arm).unwrap();
    let campaign = Campaign::new(rig.channels(0..3).unwrap(), vec![logged.run]).unwrap();
    let parameters = free_parameters(&campaign.channels, &arm);
    let case = Case {
        campaign: &campaign,
        arm: &arm,
        std: parameters.iter().map(|p| 1e-4 * p.of(&arm).abs().max(1e-3)).collect(),
        parameters: &parameters,
        windows: &windows,
        noise: &[SensorNoise::gaussian(1e-4); 4],
    };
    case.bench(c, "three masses, 60 s");
}

criterion_group!(benches, demo, three_masses);
criterion_main!(benches);
