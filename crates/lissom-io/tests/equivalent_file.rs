//! `docs/src/reference/schemas/equivalent.schema.json` names every key that an equivalent arm has, and an arm has every key that it
//! names.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use lissom::beam::{DistributedBeam, Piece, TruncatedBeam};
use lissom::identify::{EquivalentData, MotorData, Response, StdSource, equivalent};
use lissom::record::{Axis, CommandQuantity};
use lissom_io::{EquivalentFile, UnitNames};
use lissom_testmodels::SchemaCheck;
use num_complex::Complex64;

fn beam(points_m: &[f64]) -> TruncatedBeam {
    let piece = Piece {
        length_m: 0.45,
        flexural_rigidity_n_m2: 0.17,
        mass_per_length_kg_per_m: 0.13,
        end_mass_kg: 0.02,
        end_damping_n_s_per_m: 0.0,
    };
    DistributedBeam::new(&[piece]).unwrap().truncated(points_m).unwrap()
}

/// Responses at the first two of three points up to a frequency short of the third mode, or so far that all
/// three are seen.
fn data(points: usize, high: f64, motor: bool, std_source: StdSource) -> EquivalentData {
    let beam = beam(&[0.15, 0.3, 0.45]);
    let low = 0.5 * beam.natural_frequencies_rad_s[0];
    let omega: Vec<f64> = (0..300).map(|i| low * (high / low).powf(f64::from(i) / 299.0)).collect();
    let at = |w: f64| beam.response(Complex64::new(0.0, w));
    let known = |value: Complex64| Response { value, std: 1e-3 * value.norm() };
    let torque = |w: f64| {
        let s = Complex64::new(0.0, w);
        known(0.25 / (s * (s * 6e-4 + 1e-3) + at(w).coupling_nm_per_rad))
    };
    EquivalentData {
        names: (1..=points).map(|i| format!("point {i}")).collect(),
        omega_rad_s: omega.clone(),
        outputs: (0..points)
            .map(|i| omega.iter().map(|w| known(at(*w).angles[i])).collect())
            .collect(),
        motor: motor.then(|| MotorData {
            omega_rad_s: omega.clone(),
            response: omega.iter().map(|w| torque(*w)).collect(),
            torque_per_command: 0.25,
        }),
        std_source,
    }
}

#[test]
fn an_equivalent_arm_and_its_schema_name_the_same_keys() {
    let third = beam(&[0.15, 0.3, 0.45]).natural_frequencies_rad_s[2];
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/equivalent.schema.json"),
        "equivalent",
    );
    let campaigns = [
        data(2, 0.8 * third, true, StdSource::Measured),
        data(3, 2.0 * third, true, StdSource::Floored),
        data(3, 2.0 * third, false, StdSource::FromResidual),
    ];
    for (i, data) in campaigns.iter().enumerate() {
        let found = equivalent(data, None).unwrap();
        assert_eq!(found.points.len(), data.names.len(), "{:?}", found.findings);
        if i == 0 {
            assert!(found.findings.iter().any(|f| f.code() == "equivalent-spurious-pole"));
        }
        for axis in [Axis::Rotary, Axis::Linear] {
            for command in
                [CommandQuantity::Current, CommandQuantity::Voltage, CommandQuantity::Arbitrary]
            {
                for torque_known in [false, true] {
                    let names = UnitNames { torque_known, axis, command };
                    let file = EquivalentFile::of(names, &found);
                    let json = serde_json::to_value(&file).unwrap();
                    check.look_at(&json);
                    assert_eq!(serde_json::from_value::<EquivalentFile>(json).unwrap(), file);
                }
            }
        }
    }
    check.holds(&[
        "equivalent.spurious_poles[].why",
        "equivalent.zeros[].zeros[].magnitude_rad_s.ci95",
        "equivalent.strainless.missing",
        "findings[].code",
    ]);
}
