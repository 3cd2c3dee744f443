//! A drive whose command acts some samples after it is logged, simulated by short steps of its own equation.
//! Slip phases take the lateness for friction that changes with speed: what they ask for must go again once
//! the lag is in the arm.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::TAU;

use lissom::identify::{Finding, Identified, Options, Severity, identify};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
use lissom::replay::Parameter;
use rand_distr::{Distribution as _, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng as _;

const CONSTANT: f64 = 0.2;
/// Short steps of a sample.
const SHORT: usize = 100;

/// A rigid joint with a PD loop.
struct Drive {
    inertia: f64,
    viscous: f64,
    coulomb: f64,
    load_nm: f64,
    proportional: f64,
    derivative: f64,
    sample_s: f64,
    /// Samples after which a command acts.
    late: usize,
}

const SLOW: Drive = Drive {
    inertia: 2e-3,
    viscous: 4e-3,
    coulomb: 0.08,
    load_nm: 0.0,
    proportional: 6.0,
    derivative: 0.25,
    sample_s: 2e-3,
    late: 0,
};

impl Drive {
    /// One run after a goal, angle and rate over time, with a sensor.
    fn run(
        &self,
        name: &str,
        samples: i32,
        goal: impl Fn(f64) -> [f64; 2],
        mut sensor: impl FnMut(f64) -> f64,
    ) -> Run {
        let (mut angle, mut speed, mut before) = (0.0_f64, 0.0_f64, None);
        let (mut command, mut motor) = (Vec::new(), Vec::new());
        for k in 0..samples {
            let read = sensor(angle);
            let rate = before.map_or(0.0, |b| (read - b) / self.sample_s);
            let [position, speed_wanted] = goal(f64::from(k) * self.sample_s);
            let error = position - read;
            command.push(self.proportional * error + self.derivative * (speed_wanted - rate));
            motor.push(read);
            before = Some(read);
            let acts = command.len().checked_sub(1 + self.late).map_or(0.0, |i| command[i]);
            let torque = CONSTANT * acts + self.load_nm;
            for _ in 0..SHORT {
                let mut left_s = self.sample_s / SHORT as f64;
                while left_s > 0.0 {
                    let against = if speed == 0.0 {
                        self.coulomb.min(torque.abs()) * torque.signum()
                    } else {
                        self.coulomb * speed.signum()
                    };
                    let net = torque - against;
                    let halfway =
                        speed + 0.5 * left_s * (net - self.viscous * speed) / self.inertia;
                    let next = speed + left_s * (net - self.viscous * halfway) / self.inertia;
                    // Up to where it stops, if it does.
                    let share = if next * speed < 0.0 { speed / (speed - next) } else { 1.0 };
                    let reached = if share < 1.0 { 0.0 } else { next };
                    angle += 0.5 * share * left_s * (speed + reached);
                    speed = reached;
                    left_s *= 1.0 - share;
                }
            }
        }
        let time = TimeBase::uniform(0.0, self.sample_s);
        Run::new(name, time, command, motor, Vec::new()).unwrap()
    }

    /// Whether the estimates of friction, inertia and lag are the drive's, to a few standard errors and to `share`.
    #[track_caller]
    fn assert_found(&self, found: &Identified, share: f64, of: &str) {
        let lag = found.output_error.as_ref().unwrap().estimate(Parameter::CommandLag);
        for (name, estimate, truth) in [
            ("Coulomb friction", found.friction.coulomb, self.coulomb),
            ("viscous friction", found.friction.viscous, self.viscous),
            ("inertia", found.inertia, self.inertia),
            ("lag", lag, self.late as f64 * self.sample_s),
        ] {
            let estimate = estimate.unwrap();
            let error = estimate.value - truth;
            assert!(
                error.abs() < 4.0 * estimate.std && estimate.std < share * truth,
                "{of} {name} {estimate:?}"
            );
        }
    }
}

fn campaign(runs: Vec<Run>) -> Campaign {
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Sampled,
        torque_per_command: Some(CONSTANT),
        back_emf_viscous: 0.0,
        limit: None,
    };
    let channels = Channels { axis: Axis::Rotary, command, tips: Vec::new() };
    Campaign::new(channels, runs).unwrap()
}

#[test]
fn a_lag_of_samples_is_no_law_of_friction() {
    // An encoder of 12 bits.
    let step = TAU / 4096.0;
    let encoder = |angle: f64| step * (angle / step).round();
    for (late, load_nm) in [(2, 0.02), (3, 0.0)] {
        let drive = Drive { load_nm, late, ..SLOW };
        let sine = |(w, a): (f64, f64)| {
            let goal = move |t: f64| [a * (w * t).sin(), a * w * (w * t).cos()];
            drive.run(&format!("{w}"), 10_000, goal, encoder)
        };
        let runs = [(2.0, 0.8), (4.0, 0.6), (6.0, 0.5), (12.0, 0.3)].map(sine);
        let found = identify(&campaign(runs.into()), &Options::default(), |_| ()).unwrap();
        drive.assert_found(&found, 2e-3, &format!("{late}"));
        let warned = found.findings.iter().filter(|f| f.severity() != Severity::Info);
        let codes: Vec<&str> = warned.map(Finding::code).collect();
        assert!(!codes.contains(&"friction-law"), "{late} {codes:?}");
        // The replay has found the axis rigid: so is the model, whatever noise in responses looks like.
        assert!(!codes.contains(&"hidden-mode"), "{late} {codes:?}");
        assert!(found.motor_model.unwrap().poles.is_empty());
    }
}

/// A search that starts without a lag misses it with some of these seeds.
#[test]
fn a_lag_of_samples_under_noise_is_no_mode() {
    let drive = Drive {
        viscous: 1e-3,
        coulomb: 0.02,
        proportional: 4.0,
        derivative: 0.12,
        sample_s: 4e-3,
        late: 2,
        ..SLOW
    };
    let sines = [
        (0.5, 1.3, 0.0),
        (0.3, 4.1, 1.0),
        (0.15, 11.3, 2.0),
        (0.05, 29.0, 3.0),
        (0.02, 61.0, 1.0),
        (0.008, 110.0, 0.3),
    ];
    let goal = |t: f64| {
        let add = |[x, v]: [f64; 2], (a, w, phase): &(f64, f64, f64)| {
            let (sine, cosine) = (w * t + phase).sin_cos();
            [x + a * sine, v + a * w * cosine]
        };
        sines.iter().fold([0.0, 0.0], add)
    };
    for seed in 0..6 {
        let mut source = Xoshiro256PlusPlus::seed_from_u64(seed);
        let noise = |angle: f64| {
            let error: f64 = StandardNormal.sample(&mut source);
            angle + 2e-4 * error
        };
        let run = drive.run("multisine", 7500, goal, noise);
        let found = identify(&campaign(vec![run]), &Options::default(), |_| ()).unwrap();
        drive.assert_found(&found, 1e-3, &format!("seed {seed}"));
        assert!(found.findings.iter().all(|f| f.code() != "hidden-mode"), "seed {seed}");
    }
}
