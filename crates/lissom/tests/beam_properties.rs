//! Section 3 as property tests over random arms.

#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::beam::{LumpedBeam, Payload, RootClass, Span, class, properties, zero_shift};
use proptest::prelude::*;

fn span() -> impl Strategy<Value = Span> {
    // Each over a decade and a half, damped or not.
    let decade = || (-0.75..0.75_f64).prop_map(|e| 10f64.powf(e));
    (decade(), decade(), decade(), prop_oneof![Just(0.0), decade()]).prop_map(|(l, ei, m, c)| {
        Span { length_m: l, flexural_rigidity_n_m2: ei, mass_kg: m, damping_n_s_per_m: c }
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
}
