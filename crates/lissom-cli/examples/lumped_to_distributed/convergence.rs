//! Errors of lumped arms over the number of masses.

use lissom::beam::{BeamError, DistributedBeam};
use lissom_testmodels::limit::{LumpedArm, Masses, Properties, order};

/// Numbers of masses.
pub(crate) const COUNTS: [usize; 9] = [4, 8, 16, 32, 64, 128, 256, 512, 1024];
/// Orders are fitted from this entry of [`COUNTS`] on: 64 masses.
const FITTED: usize = 4;

/// What the rows of a table and the lines of a figure are.
pub(crate) const NAMES: [&str; 10] = [
    "ω₁",
    "ω₂",
    "ω₃",
    "zero 1",
    "zero 2",
    "zero 3",
    "C_t/θ_m at ω₁/2",
    "C_t/θ_m at √(ω₁ω₂)",
    "C_t/θ_m at √(ω₂ω₃)",
    "inertia (ω → 0)",
];

/// One beam, lumped in one way.
pub(crate) struct Study {
    /// The distributed beam's figures, in the order of [`NAMES`].
    pub(crate) exact: Vec<f64>,
    /// Relative errors with their sign: one list for each figure, over [`COUNTS`].
    pub(crate) errors: Vec<Vec<f64>>,
}

impl Study {
    pub(crate) fn new(beam: &DistributedBeam, masses: Masses) -> Result<Self, BeamError> {
        let exact = Properties::of_distributed(beam);
        let mut errors = vec![Vec::new(); NAMES.len()];
        for count in COUNTS {
            let found = Properties::of_lumped(&LumpedArm::new(beam, count, masses)?, &exact);
            for (list, error) in errors.iter_mut().zip(found.errors(&exact)) {
                list.push(error);
            }
        }
        Ok(Self { exact: exact.all(), errors })
    }

    /// The measured order of figure `row`.
    pub(crate) fn order(&self, row: usize) -> f64 {
        order(&COUNTS[FITTED..], &self.errors[row][FITTED..])
    }

    /// The error at the largest count times that count to the power `power`.
    pub(crate) fn constant(&self, row: usize, power: i32) -> f64 {
        let last = COUNTS.len() - 1;
        self.errors[row][last] * (COUNTS[last] as f64).powi(power)
    }
}
