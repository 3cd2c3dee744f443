#![expect(clippy::float_cmp, reason = "hand-computed values that are exact in binary")]

use std::f64::consts::TAU;

use super::*;

#[test]
fn a_converter_rounds_and_saturates_at_its_codes() {
    // 4 bits over 16 V: codes −8 to 7.
    let adc = Quantiser::new(4, 16.0).unwrap();
    assert_eq!(adc.step(), 1.0);
    assert_eq!(adc.ends(), (-8.0, 7.0));
    for (value, read) in
        [(0.49, 0.0), (0.5, 1.0), (-0.5, -1.0), (6.6, 7.0), (7.4, 7.0), (99.0, 7.0), (-8.6, -8.0)]
    {
        assert_eq!(adc.read(value), read, "{value}");
        assert_eq!(adc.count(value) as f64, read, "{value}");
    }
    assert_eq!([7.4, 7.6, -8.4, -8.6].map(|v| adc.exceeded(v)), [false, true, false, true]);
    assert_eq!([3, 9, -20].map(|c| adc.value(c)), [3.0, 7.0, -8.0]);
    let one_bit = Quantiser::new(1, 2.0).unwrap();
    assert_eq!([0.7, -0.7].map(|v| one_bit.read(v)), [0.0, -1.0]);
}

#[test]
fn an_encoder_counts_on_for_ever() {
    let encoder = Quantiser::encoder(1000).unwrap();
    assert_eq!(encoder.count(TAU * 12_345.0), 12_345_000);
    assert!(!encoder.exceeded(1e6) && encoder.ends().1.is_infinite());
}

#[test]
fn numbers_that_make_no_instrument() {
    assert_eq!(Quantiser::new(33, 1.0), Err(RigError::Bits { found: 33 }));
    assert_eq!(Quantiser::new(0, 1.0), Err(RigError::Bits { found: 0 }));
    let not_positive = |e: Result<Quantiser, RigError>| {
        assert!(matches!(e, Err(RigError::NotPositive { .. })), "{e:?}");
    };
    for range in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        not_positive(Quantiser::new(12, range));
    }
    not_positive(Quantiser::new(32, f64::MIN_POSITIVE / 1e14));
    not_positive(Quantiser::encoder(0));
    for bad in [-1e-9, f64::NAN, f64::INFINITY] {
        assert!(matches!(Delay::new(bad), Err(RigError::Negative { .. })));
        assert!(matches!(Amplifier::ideal().with_dead_band(bad), Err(RigError::Negative { .. })));
        assert!(matches!(Amplifier::ideal().with_limit(bad), Err(RigError::NotPositive { .. })));
        assert!(matches!(Noise::new(bad), Err(RigError::NotPositive { .. })));
        assert!(matches!(Instruments::ideal(bad), Err(RigError::NotPositive { .. })));
    }
    assert!(matches!(Instruments::ideal(0.0), Err(RigError::NotPositive { found: 0.0, .. })));
}

#[test]
fn an_amplifier_converts_limits_and_has_a_dead_zone() {
    let dac = Quantiser::new(3, 8.0).unwrap();
    let amplifier = Amplifier::ideal()
        .with_converter(dac)
        .with_limit(2.5)
        .unwrap()
        .with_dead_band(1.0)
        .unwrap();
    // Demand, command as logged, current.
    for (demand, command, current) in
        [(0.4, 0.0, 0.0), (1.2, 1.0, 0.0), (1.6, 2.0, 1.0), (2.9, 2.5, 1.5), (-9.0, -2.5, -1.5)]
    {
        assert_eq!(amplifier.command_a(demand), command, "{demand}");
        assert_eq!(amplifier.current_a(command), current, "{demand}");
    }
    assert_eq!([2.4, 2.6].map(|d| amplifier.limits(d)), [false, true]);
    assert_eq!(amplifier.most_a(), 2.5);
    // The converter's own end: code 3.
    let converter = Amplifier::ideal().with_converter(dac);
    assert_eq!((converter.most_a(), converter.command_a(7.0)), (3.0, 3.0));
    assert!(converter.limits(3.6) && !converter.limits(3.4));
    assert_eq!(Amplifier::ideal().command_a(1e9), 1e9);
}

/// What acts when, for commands 1, 2, 3 … at 0, 1, 2 … s.
fn acting(delay_s: f64, samples: usize) -> Vec<[(f64, f64); 2]> {
    let mut line = DelayLine::new(Some(Delay::new(delay_s).unwrap()), 1.0).unwrap();
    (1..=samples).map(|k| line.push(k as f64)).collect()
}

#[test]
fn a_delay_shifts_by_samples_and_parts() {
    assert_eq!(acting(0.0, 2), [[(1.0, 1.0), (1.0, 0.0)], [(2.0, 1.0), (2.0, 0.0)]]);
    let whole: Vec<f64> = acting(2.0, 4).iter().map(|p| p[0].0).collect();
    assert_eq!(whole, [0.0, 0.0, 1.0, 2.0]);
    // 0.25 s late: the first quarter still has the command before.
    assert_eq!(acting(0.25, 2), [[(0.0, 0.25), (1.0, 0.75)], [(1.0, 0.25), (2.0, 0.75)]]);
    assert_eq!(
        acting(1.5, 3),
        [[(0.0, 0.5), (0.0, 0.5)], [(0.0, 0.5), (1.0, 0.5)], [(1.0, 0.5), (2.0, 0.5)]]
    );
    // 3 times 0.1 is not 0.3 in binary, and still three samples.
    let three = DelayLine::new(Some(Delay::new(0.1 * 3.0).unwrap()), 0.1).unwrap();
    assert_eq!(three.durations_s(), [0.1, 0.0]);
    let long = DelayLine::new(Some(Delay::new(2e6).unwrap()), 1.0);
    assert!(matches!(long, Err(RigError::TooLong { samples: 2e6, .. })));
}

/// Draws of the statistics below.
const DRAWS: usize = 100_000;
/// Standard deviations that a statistic may be off by: one in 15 000 draws of a correct one.
const SIGMAS: f64 = 4.0;

#[test]
fn noise_is_white_gaussian_and_independent_between_sensors() {
    let noise = Noise::new(0.5).unwrap();
    let mut streams = Streams::new(42, 2);
    let mut draw = |place| -> Vec<f64> {
        (0..DRAWS).map(|_| noise.draw(streams.at(place).unwrap())).collect()
    };
    let (a, b) = (draw(0), draw(1));
    let mean = |f: &dyn Fn(usize) -> f64| (0..DRAWS - 1).map(f).sum::<f64>() / (DRAWS - 1) as f64;
    let root = SIGMAS / (DRAWS as f64).sqrt();
    let (variance, fourth) = (0.25, 3.0 * 0.0625);
    for x in [&a, &b] {
        assert!(mean(&|k| x[k]).abs() < 0.5 * root);
        assert!((mean(&|k| x[k].powi(2)) - variance).abs() < variance * 2f64.sqrt() * root);
        // The fourth moment of a normal variable has the variance 96 σ⁸.
        let spread = 96f64.sqrt() * variance * variance * root;
        assert!((mean(&|k| x[k].powi(4)) - fourth).abs() < spread);
        assert!(mean(&|k| x[k] * x[k + 1]).abs() < variance * root);
    }
    assert!(mean(&|k| a[k] * b[k]).abs() < variance * root);
    assert!(mean(&|k| a[k + 1] * b[k]).abs() < variance * root);
}

#[test]
fn a_stream_depends_on_seed_and_place_alone() {
    let noise = Noise::new(1.0).unwrap();
    let take = |seed, sensors, place| -> Vec<f64> {
        let mut streams = Streams::new(seed, sensors);
        (0..5).map(|_| noise.draw(streams.at(place).unwrap())).collect()
    };
    assert_eq!(take(7, 1, 0), take(7, 3, 0));
    assert_eq!(take(7, 2, 1), take(7, 3, 1));
    assert_ne!(take(7, 2, 0), take(7, 2, 1));
    assert_ne!(take(7, 2, 0), take(8, 2, 0));
}

#[test]
fn a_sensor_adds_noise_before_it_rounds() {
    let sensor = Sensor {
        noise: Some(Noise::new(1e-3).unwrap()),
        quantiser: Some(Quantiser::new(12, TAU).unwrap()),
    };
    let step = TAU / 4096.0;
    let mut streams = Streams::new(1, 1);
    let mut mean = 0.0;
    for _ in 0..DRAWS {
        let (read, cut) = sensor.read(0.3 * step, streams.at(0));
        assert!(!cut && (read / step - (read / step).round()).abs() < 1e-9);
        mean += read / DRAWS as f64;
    }
    // Noise of 0.65 steps dithers: the mean is the value, but for the rounding's own 2·e^{−2π²σ²}/2π.
    let bias = step / std::f64::consts::PI * (-0.5 * (TAU * 1e-3 / step).powi(2)).exp();
    let scatter = SIGMAS * (1e-3_f64.hypot(step / 12f64.sqrt())) / (DRAWS as f64).sqrt();
    assert!((mean - 0.3 * step).abs() < bias + scatter, "{mean}");
    assert_eq!(sensor.resolution(), step);
    assert_eq!(Sensor::from(Noise::new(0.1).unwrap()).resolution(), 0.1);
    assert_eq!(Sensor::IDEAL.read(0.123, None), (0.123, false));
}

#[test]
fn tip_sensors_are_none_one_for_all_or_one_each() {
    let mut instruments = Instruments::ideal(0.01).unwrap();
    let sensor = |std| Sensor::from(Noise::new(std).unwrap());
    assert_eq!(instruments.tip(3), Sensor::IDEAL);
    instruments.tips = vec![sensor(0.1)];
    assert_eq!(instruments.tip(3), sensor(0.1));
    assert_eq!(instruments.check(5), Ok(()));
    instruments.tips = vec![sensor(0.1), sensor(0.2)];
    assert_eq!(instruments.tip(1), sensor(0.2));
    assert_eq!(instruments.resolution_rad(), 0.2);
    assert_eq!(instruments.check(3), Err(RigError::SensorCount { found: 2, masses: 3 }));
    for wrong in [0.0, -0.003, f64::NAN] {
        instruments.sample_time_s = wrong;
        assert!(matches!(instruments.check(2), Err(RigError::NotPositive { .. })), "{wrong}");
    }
    instruments.sample_time_s = 0.01;
    instruments.control_every = 0;
    let none = Err(RigError::NotPositive { quantity: "control_every", found: 0.0 });
    assert_eq!(instruments.check(2), none);
    (instruments.control_every, instruments.log_every) = (1, 0);
    let none = Err(RigError::NotPositive { quantity: "log_every", found: 0.0 });
    assert_eq!(instruments.check(2), none);
}
