//! A joint that never sticks: friction is the square wave that (30) takes it for, and the response that is given must
//! be no worse.
#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

use lissom::identify::{Options, Response, RunKind, corrected, identify};
use lissom::record::{Campaign, Run};
use lissom::rig::{Experiment, Noise, Rig, Settle};

/// Frequency \[rad/s\] and amplitude of the reference \[rad\]: pairs ω0 and 3ω0, at every reversal faster than
/// friction could hold.
const SINES: [(f64, f64); 4] = [(12.0, 1.6), (36.0, 0.5), (15.0, 1.2), (45.0, 0.4)];
/// Nothing that sticks takes the beam's ringing away: it falls by 0.03 1/s \[s\].
const WAIT_S: f64 = 300.0;
/// Noise of the sensors in steps.
const NOISE_STEPS: f64 = 0.5;
/// Further from the truth than this is no estimate of it.
const DEVIATIONS: f64 = 4.0;
/// Standard errors of a corrected response over its size, at most.
const STD_MOST: f64 = 2e-3;

fn rig() -> Rig {
    let mut rig = lissom_testmodels::report_rig(Some(12));
    let instruments = &mut rig.instruments;
    let step = instruments.motor.quantiser.unwrap().step();
    instruments.motor.noise = Some(Noise::new(NOISE_STEPS * step).unwrap());
    instruments.tips[0].noise = instruments.motor.noise;
    rig
}

fn sine(rig: &Rig, (omega_rad_s, amplitude_rad): (f64, f64)) -> Run {
    let sine = Experiment::sine(omega_rad_s, amplitude_rad, 8.0).unwrap();
    let sine = sine.settling(Settle::Wait { wait_s: WAIT_S });
    let logged = rig.run(&format!("{omega_rad_s} rad/s"), &sine, 5).unwrap();
    assert!(logged.stuck_share == 0.0, "{omega_rad_s} rad/s sticks for {}", logged.stuck_share);
    assert!(logged.findings.is_empty(), "{:?}", logged.findings);
    logged.run
}

#[test]
fn the_response_given_is_as_near_as_that_of_the_third_harmonic() {
    let rig = rig();
    let runs: Vec<Run> = SINES.iter().map(|of| sine(&rig, *of)).collect();
    let campaign = Campaign::new(rig.channels(0..1).unwrap(), runs).unwrap();
    let id = identify(&campaign, &Options::default(), |_| ()).unwrap();
    let coulomb = id.third_harmonic.as_ref().unwrap().coulomb_command;
    assert_eq!(id.responses.len(), SINES.len());
    for point in &id.responses {
        let exact = rig.arm.motor_response(point.omega_rad_s);
        let off = |r: Response| (r.value - exact).norm();
        let RunKind::Sinusoidal(s) = &id.runs[point.run.unwrap()].kind else {
            panic!("{} rad/s is no sine", point.omega_rad_s)
        };
        let thirty = corrected(s.motor.get(1).unwrap(), s.command.get(1).unwrap(), coulomb);
        let given = point.motor_corrected.unwrap();
        println!(
            "{:5.1} rad/s: given off by {:.1e} of it, {:.1} deviations, (30) by {:.1e}, raw by {:.1e}",
            point.omega_rad_s,
            off(given) / exact.norm(),
            off(given) / given.std,
            off(thirty) / exact.norm(),
            off(point.motor_raw) / exact.norm()
        );
        assert!(point.is_vouched_for(), "{:?}", id.findings);
        assert!(given.std < STD_MOST * exact.norm(), "{given:?}");
        assert!(off(given) < DEVIATIONS * given.std, "{point:?}, exact {exact}");
        assert!(off(given) <= off(thirty) + given.std, "{point:?}, exact {exact}, (30) {thirty:?}");
    }
}
