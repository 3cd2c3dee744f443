//! Section 3 as property tests over random arms.

#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::beam::{
    Damping, LumpedBeam, Payload, RootClass, Span, class, motor_function, properties, zero_shift,
};
use lissom::drive::Motor;
use num_complex::Complex64;
use proptest::prelude::*;

fn span() -> impl Strategy<Value = Span> {
    // Each over a decade and a half, damped or not.
    let decade = || (-0.75..0.75_f64).prop_map(|e| 10f64.powf(e));
    (decade(), decade(), decade(), prop_oneof![Just(0.0), decade()]).prop_map(|(l, ei, m, c)| {
        Span { length_m: l, flexural_rigidity_n_m2: ei, mass_kg: m, damping_n_s_per_m: c }
    })
}

/// Each over four decades.
fn wide_span() -> impl Strategy<Value = Span> {
    let decades = || (-2.0..2.0_f64).prop_map(|e| 10f64.powf(e));
    (decades(), decades(), decades()).prop_map(|(l, ei, m)| Span {
        length_m: l,
        flexural_rigidity_n_m2: ei,
        mass_kg: m,
        damping_n_s_per_m: 0.0,
    })
}

fn beam() -> impl Strategy<Value = LumpedBeam> {
    (prop::collection::vec(span(), 1..8), prop_oneof![Just(0.0), 0.01..2.0])
        .prop_map(|(spans, hub)| LumpedBeam::new(&spans).unwrap().with_hub_radius(hub).unwrap())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Even powers, relative degree, separation, zeros and payload, tip loads, rigid turn, classes.
    #[test]
    fn section_3_holds_for_point_masses(beam in beam()) {
        for property in properties(&beam).unwrap() {
            prop_assert!(property.holds, "{property:?}");
        }
    }

    /// A payload with rotary inertia moves the zeros and is found out; everything else holds.
    #[test]
    fn rotary_inertia_moves_the_zeros(beam in beam(), inertia in 0.05..5.0_f64) {
        let loaded = beam
            .with_payload(Payload { mass_kg: 0.5, inertia_kg_m2: inertia, offset_m: 0.0 })
            .unwrap();
        for property in properties(&loaded).unwrap() {
            let moved = property.name == "zeros and payload" || property.name == "classes of zeros";
            prop_assert!(property.holds != moved, "{property:?}");
        }
        // The tip gains one zero, an undamped pair.
        let zeros = loaded.zeros(loaded.len() - 1).unwrap();
        prop_assert_eq!(zeros.missing, 0);
        let pairs = zeros.z.iter().filter(|z| class(**z) == RootClass::Imaginary).count();
        prop_assert_eq!(pairs, 1);
        let heavier = loaded.with_load_times(2.0).unwrap();
        let shift = zero_shift(&zeros, &heavier.zeros(heavier.len() - 1).unwrap());
        prop_assert!(shift > 1e-6, "{shift}");
    }

    /// Zeros, poles and gain of every transfer function give the recursion's response, whatever
    /// brakes the arm: dampers at masses, α, β, the motor's viscous friction, or nothing.
    #[test]
    fn roots_and_responses_agree(
        beam in beam(),
        alpha in prop_oneof![Just(0.0), 0.01..1.0],
        beta in prop_oneof![Just(0.0), 1e-4..1e-2],
        viscous in prop_oneof![Just(0.0), 0.01..1.0],
        inertia in prop_oneof![Just(0.0), 0.01..1.0],
    ) {
        let damping = Damping::Proportional { mass_per_s: alpha, stiffness_s: beta };
        let payload = Payload { inertia_kg_m2: inertia, ..Payload::default() };
        let beam = beam.with_damping(damping).unwrap().with_payload(payload).unwrap();
        let motor = Motor::new(0.5, viscous, 1.0).unwrap();
        let from_current = motor_function(&beam, &motor);
        let coupling = beam.coupling_function();
        let tip = beam.len() - 1;
        let angle = beam.angle_function(tip).unwrap();
        let first = beam.natural_frequencies_rad_s()[0];
        for part in [0.05, 0.4, 1.7, 9.0] {
            let s = Complex64::new(0.0, part * first);
            let exact = beam.response(s);
            let of_motor = 1.0 / (motor.impedance(s) + exact.coupling_nm_per_rad);
            for (g, exact) in [
                (&from_current, of_motor),
                (&coupling, exact.coupling_nm_per_rad),
                (&angle, exact.angles[tip]),
            ] {
                if g.missing > 0 {
                    continue;
                }
                let product = |roots: &[Complex64]| roots.iter().map(|r| s - r).product::<Complex64>();
                let found = product(&g.zeros) / product(&g.poles) * g.gain;
                let off = (found - exact).norm() / exact.norm();
                prop_assert!(off < 1e-7, "{off:e}: {found} {exact} at {s}, {g:?}");
            }
        }
    }

    /// A heavier point mass at the tip lowers every frequency and moves no zero.
    #[test]
    fn a_heavier_tip_lowers_frequencies_and_moves_no_zero(beam in beam(), factor in 1.1..20.0_f64) {
        let heavier = beam.with_load_times(factor).unwrap();
        let (before, after) =
            (beam.natural_frequencies_rad_s(), heavier.natural_frequencies_rad_s());
        for (b, a) in before.iter().zip(&after) {
            prop_assert!(*a <= b * (1.0 + 1e-12), "{b} {a}");
        }
        prop_assert!(after[0] < before[0]);
        let tip = beam.len() - 1;
        let shift = zero_shift(&beam.zeros(tip).unwrap(), &heavier.zeros(tip).unwrap());
        prop_assert!(shift < 1e-12, "{shift}");
    }

    /// Changes of sign along the beam count the tip's zeros: there are n − 1, and the response
    /// changes its sign at each.
    #[test]
    fn the_tips_zeros_are_counted(spans in prop::collection::vec(wide_span(), 2..30)) {
        let beam = LumpedBeam::new(&spans).unwrap();
        let (n, tip) = (beam.len(), beam.len() - 1);
        let zeros = beam.tip_zeros_per_s(n).unwrap();
        prop_assert_eq!(zeros.len(), n - 1);
        prop_assert!(zeros.is_sorted());
        let lowest = beam.tip_zeros_per_s(n / 2).unwrap();
        prop_assert_eq!(lowest.len(), (n / 2).min(n - 1));
        prop_assert!(lowest.iter().zip(&zeros).all(|(a, b)| (a / b - 1.0).abs() < 1e-13));
        let mut ends = vec![zeros[0] / 2.0];
        ends.extend(zeros.windows(2).map(|z| (z[0] * z[1]).sqrt()));
        ends.push(zeros[tip - 1] * 2.0);
        for (k, s) in ends.iter().enumerate() {
            let positive = beam.response(Complex64::from(*s)).angles[tip].re > 0.0;
            prop_assert_eq!(positive, k % 2 == 0, "{} {:?}", s, zeros);
        }
    }
}

/// Spans that differ by 10⁹ in EI, zeros at every kind of mass.
#[test]
fn no_zero_within_a_wild_beam_is_missed() {
    let n = 200;
    let spans: Vec<Span> = (0..n)
        .map(|i| Span {
            length_m: 0.005,
            flexural_rigidity_n_m2: if i % 2 == 0 { 1.0 } else { 1e9 },
            mass_kg: 0.005,
            damping_n_s_per_m: 0.0,
        })
        .collect();
    let beam = LumpedBeam::new(&spans).unwrap();
    for mass in [0, 50, 100, 150, 198, 199] {
        let zeros = beam.zeros(mass).unwrap();
        assert_eq!((zeros.z.len(), zeros.missing), (n - 1, 0), "mass {mass}");
        let real = zeros.z.iter().filter(|z| class(**z) == RootClass::Real).count();
        assert_eq!(real, mass, "mass {mass}");
        // The mass at the point itself does not enter.
        let mut other = spans.clone();
        other[mass].mass_kg *= 7.0;
        let other = LumpedBeam::new(&other).unwrap().zeros(mass).unwrap();
        let shift = zero_shift(&zeros, &other);
        assert!(shift < 1e-11, "mass {mass}: {shift:e}");
    }
}

/// Thousands of spans whose stiffness differs by 10⁹.
#[test]
fn no_zero_of_a_long_wild_beam_is_missed() {
    let n = 2000;
    let spans: Vec<Span> = (0..n)
        .map(|i| Span {
            length_m: 0.01,
            flexural_rigidity_n_m2: if i * 7919 % 13 < 4 { 1e-4 } else { 1e5 },
            mass_kg: 0.1 + f64::from(i * 31 % 7),
            damping_n_s_per_m: 0.0,
        })
        .collect();
    let beam = LumpedBeam::new(&spans).unwrap();
    let zeros = beam.tip_zeros_per_s(usize::MAX).unwrap();
    assert_eq!(zeros.len(), spans.len() - 1);
    let heavier = beam.with_load_times(5.0).unwrap().tip_zeros_per_s(usize::MAX).unwrap();
    assert!(zeros.iter().zip(&heavier).all(|(a, b)| (a / b - 1.0).abs() < 1e-12));
}
