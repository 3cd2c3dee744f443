//! Coulomb friction as printed in Section 6.2.2 of the 1989 report, compared with the estimates here.

use lissom::drive::DryFriction;
use lissom::identify::{Estimate, Identified};
use lissom::rig::{JointFriction, Rig};
use lissom_io::FiguresFile;
use lissom_io::comparison::ComparedCoulombEntry;

/// Values printed in 6.2.2 \[A\]: classical forward and backward, spectral.
const PRINTED_A: [f64; 3] = [0.161, 0.152, 0.132];

/// The friction law of the rig's joint.
pub(crate) fn law(rig: &Rig) -> DryFriction {
    match &rig.scene.friction {
        JointFriction::Dry(law) => law.clone(),
        _ => rig.arm.coulomb.into(),
    }
}

/// Coulomb friction by one method \[A\].
pub(crate) struct CoulombRow {
    pub(crate) name: &'static str,
    pub(crate) printed_a: Option<f64>,
    pub(crate) here: Option<Estimate>,
}

pub(crate) fn rows(rig: &Rig, id: &Identified) -> Vec<CoulombRow> {
    let constant = rig.arm.motor.torque_constant_nm_per_a();
    let classical = id.constant_velocity.as_ref();
    let side = |line: Option<Estimate>| line.map(|e| e.scaled(1.0 / constant));
    let [forward, backward, spectral] = PRINTED_A;
    vec![
        CoulombRow {
            name: "classical, forward",
            printed_a: Some(forward),
            here: side(classical.and_then(|c| c.forward.as_ref().ok()).map(|l| l.coulomb)),
        },
        CoulombRow {
            name: "classical, backward",
            printed_a: Some(backward),
            here: side(classical.and_then(|c| c.backward.as_ref().ok()).map(|l| l.coulomb)),
        },
        CoulombRow {
            name: "spectral, (26)-(29)",
            printed_a: Some(spectral),
            here: id.third_harmonic.as_ref().map(|t| t.coulomb_command),
        },
        CoulombRow {
            name: "regression on slip phases",
            printed_a: None,
            here: side(id.regression.as_ref().and_then(|r| r.coulomb)),
        },
        CoulombRow {
            name: "truth at rest",
            printed_a: None,
            here: Some(Estimate { value: law(rig).at(0.0, 0.0).forward() / constant, std: 0.0 }),
        },
    ]
}

pub(crate) fn compared(rows: &[CoulombRow]) -> FiguresFile {
    let entry = |r: &CoulombRow| ComparedCoulombEntry {
        method: r.name.to_owned(),
        printed_a: r.printed_a,
        value_a: r.here.map(|e| e.value),
        std_a: r.here.map(|e| e.std),
    };
    FiguresFile { coulomb: rows.iter().map(entry).collect() }
}
