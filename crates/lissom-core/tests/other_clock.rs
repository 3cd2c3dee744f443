//! The clock of another log, found from motions whose response is known in closed form.

use lissom_core::record::other_clock::{
    Follows, OtherClock, OtherClockError, StampedSignal, other_clock,
};

/// Amplitudes [rad], angular frequencies [rad/s] and phases of a motion that does not repeat.
const SINES: [(f64, f64, f64); 5] =
    [(0.6, 2.1, 0.3), (0.3, 5.37, 1.1), (0.2, 8.9, 2.0), (0.1, 14.13, 0.7), (0.05, 20.71, 2.9)];
/// Frequency of the undamped arm [rad/s].
const ARM: f64 = 27.0;

fn sum(sines: &[(f64, f64, f64)], at: impl Fn(f64, f64, f64) -> f64) -> f64 {
    sines.iter().map(|(a, omega, phase)| at(*a, *omega, *phase)).sum()
}

fn angle(t: f64) -> f64 {
    sum(&SINES, |a, omega, phase| a * (omega * t + phase).sin())
}

/// The angle of the end of an undamped arm.
fn tip(t: f64) -> f64 {
    sum(&SINES, |a, w, phase| a / (1.0 - (w / ARM).powi(2)) * (w * t + phase).sin())
}

/// Its deflection, in an unknown unit with another sign.
fn deflection(t: f64) -> f64 {
    -3.0 * (tip(t) - angle(t)) + 0.4
}

/// The torque of a joint with friction.
fn torque(t: f64) -> f64 {
    let speed = sum(&SINES, |a, w, phase| a * w * (w * t + phase).cos());
    let acceleration = sum(&SINES, |a, w, phase| -a * w * w * (w * t + phase).sin());
    0.02 * acceleration + 0.1 * speed + 0.5 * speed.signum()
}

/// Stamps at this rate, each with the value at its time on the clock of the other log.
fn log(rate_hz: f64, times_s: (f64, f64), value: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<f64>) {
    let count = ((times_s.1 - times_s.0) * rate_hz) as usize;
    let time = |k: usize| times_s.0 + k as f64 / rate_hz;
    // Noise that does not repeat.
    let noise = |k: usize| 1e-4 * ((k as f64 * 12.9898).sin() * 43_758.545).fract();
    ((0..count).map(time).collect(), (0..count).map(|k| value(time(k)) + noise(k)).collect())
}

fn found(
    motor: &(Vec<f64>, Vec<f64>),
    other: &(Vec<f64>, Vec<f64>),
    follows: Follows,
) -> Result<OtherClock, OtherClockError> {
    other_clock(
        StampedSignal { stamps_s: &motor.0, values: &motor.1 },
        StampedSignal { stamps_s: &other.0, values: &other.1 },
        follows,
    )
}

/// A signal over the time of the motor's log.
type Signal = fn(f64) -> f64;

#[test]
fn offset_and_drift_are_found_from_each_kind_of_signal() {
    let motor = log(500.0, (2.0, 62.0), angle);
    let (offset, drift) = (-7.25, 150e-6);
    // A stamp of the other log is offset + (1 + drift)·t.
    let time = |stamp: f64| (stamp - offset) / (1.0 + drift);
    let kinds: [(Follows, f64, Signal); 3] = [
        (Follows::Angle, 60.0, tip),
        (Follows::Acceleration, 200.0, deflection),
        (Follows::Torque, 1000.0, torque),
    ];
    for (follows, rate_hz, value) in kinds {
        let other = log(rate_hz, (-1.0, 50.0), |stamp| value(time(stamp)));
        let clock = found(&motor, &other, follows).unwrap();
        let exact = offset + drift * clock.middle_s;
        assert!((clock.offset_s - exact).abs() < 3.0 * clock.offset_std_s, "{follows:?} {clock:?}");
        assert!(clock.offset_std_s < 1e-3 && clock.explained > 0.9, "{follows:?} {clock:?}");
        assert!((clock.drift - drift).abs() < 3.0 * clock.drift_std, "{follows:?} {clock:?}");
        assert_eq!(clock.repeats_s, None, "{follows:?}");
        for stamp in [-1.0, 20.0, 50.0] {
            assert!((clock.reference_s(stamp) - time(stamp)).abs() < 2e-3, "{follows:?}");
            assert!((clock.other_s(clock.reference_s(stamp)) - stamp).abs() < 1e-9);
        }
    }
}

#[test]
fn a_motion_that_repeats_is_said_so() {
    let sine = |t: f64| 0.5 * (4.0 * t).sin();
    let clock =
        found(&log(500.0, (0.0, 30.0), sine), &log(60.0, (3.0, 25.0), sine), Follows::Angle)
            .unwrap();
    let period = std::f64::consts::TAU / 4.0;
    let periods = clock.repeats_s.unwrap() / period;
    assert!((periods - periods.round()).abs() < 0.01, "{clock:?}");
    let apart = clock.offset_s / period;
    assert!((apart - apart.round()).abs() < 0.01, "{clock:?}");
}

#[test]
fn logs_without_a_shared_motion_are_refused() {
    let motor = log(500.0, (0.0, 40.0), angle);
    let other_motion = |t: f64| 0.4 * (3.3 * t).sin() + 0.3 * (7.7 * t + 1.0).sin();
    let refused = |other: &(Vec<f64>, Vec<f64>), follows| {
        assert!(
            matches!(found(&motor, other, follows), Err(OtherClockError::NoSharedMotion { .. })),
            "{follows:?}"
        );
    };
    for follows in [Follows::Angle, Follows::Acceleration, Follows::Torque] {
        refused(&log(60.0, (0.0, 40.0), |_| 0.0), follows);
        refused(&(motor.0.clone(), vec![1.0; motor.0.len()]), follows);
        refused(&log(60.0, (0.0, 40.0), other_motion), follows);
    }
    let few = log(60.0, (0.0, 0.5), tip);
    assert!(matches!(
        found(&motor, &few, Follows::Angle),
        Err(OtherClockError::FewSamples { found: 30, .. })
    ));
}
