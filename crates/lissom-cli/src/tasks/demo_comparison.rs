//! The result of the demo, compared with the true parameters of its virtual rig.

use lissom::arm::Arm;
use lissom::identify::{Estimate, Identified, OutputError};
use lissom::replay::{ModalArm, Parameter};
use lissom_io::comparison::{ComparedEstimateEntry, ComparisonEntry};
use lissom_io::{DemoFile, ResultFile};

/// A parameter: name, unit, true value, and estimates by third harmonic, regression and output-error method.
pub(crate) struct DemoRow {
    pub(crate) name: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) truth: f64,
    pub(crate) third: Option<Estimate>,
    pub(crate) regression: Option<Estimate>,
    pub(crate) output_error: Option<Estimate>,
}

pub(crate) fn comparison(arm: &Arm, id: &Identified) -> Vec<DemoRow> {
    let third = id.third_harmonic.as_ref();
    let fit = id.third_harmonic_model.as_ref();
    let r = id.regression.as_ref();
    let oe = id.output_error.as_ref();
    let k = arm.motor.torque_constant_nm_per_a();
    let frequency = |m: &lissom::identify::ModeEstimate| m.natural_frequency_rad_s;
    vec![
        DemoRow {
            name: "Coulomb friction",
            unit: "A",
            truth: arm.coulomb.forward() / k,
            third: third.map(|t| t.coulomb_command),
            regression: r.and_then(|r| r.coulomb).map(|e| e.scaled(1.0 / k)),
            output_error: oe
                .and_then(|o| o.estimate(Parameter::Coulomb))
                .map(|e| e.scaled(1.0 / k)),
        },
        DemoRow {
            name: "viscous friction",
            unit: "N·m·s/rad",
            truth: arm.motor.viscous_nm_s_per_rad(),
            third: fit.map(|f| f.viscous),
            regression: r.and_then(|r| r.viscous),
            output_error: oe.and_then(|o| o.estimate(Parameter::Viscous)),
        },
        DemoRow {
            name: "inertia",
            unit: "kg·m²",
            truth: arm.motor.inertia_kg_m2(),
            third: fit.map(|f| f.inertia),
            regression: r.and_then(|r| r.inertia),
            output_error: oe.and_then(OutputError::inertia),
        },
        DemoRow {
            name: "coupling",
            unit: "N·m/rad",
            truth: arm.dynamics().coupling_motor,
            third: fit.and_then(|f| f.coupling.first().copied()),
            regression: r.and_then(|r| r.coupling.first().copied().flatten()),
            output_error: oe.map(|o| o.estimate_of(ModalArm::coupling_nm_per_rad)),
        },
        DemoRow {
            name: "beam frequency",
            unit: "rad/s",
            truth: arm.beam().natural_frequencies_rad_s()[0],
            third: id.beam_model.as_ref().and_then(|b| b.modes.first()).map(frequency),
            regression: id.beam_regression.as_ref().and_then(|b| b.modes.first()).map(frequency),
            output_error: oe.and_then(|o| o.estimate(Parameter::Frequency(0))),
        },
    ]
}

pub(crate) fn compared(rows: &[DemoRow], result: ResultFile) -> DemoFile {
    let estimate = |e: Option<Estimate>| e.map(ComparedEstimateEntry::of);
    let entry = |r: &DemoRow| ComparisonEntry {
        parameter: r.name.to_owned(),
        unit: r.unit.to_owned(),
        truth: r.truth,
        third_harmonic: estimate(r.third),
        regression: estimate(r.regression),
        output_error: estimate(r.output_error),
    };
    DemoFile { comparison: rows.iter().map(entry).collect(), result }
}
