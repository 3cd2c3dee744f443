//! The same beam with other loads: its poles move, its zeros do not.

use std::path::Path;

use indicatif::ProgressBar;
use lissom::beam::{Base, BeamError, RootClass, Zeros, class, zero_shift};
use lissom_io::model::PayloadCase;
use num_complex::Complex64;

use super::any_beam::{Beam, beam_failure};

use crate::args::model_args::Load;
use crate::shared::failure::Failure;

/// Computes poles and zeros for the load in the file and then for each load in `loads`.
pub(crate) fn study(
    path: &Path,
    beam: &Beam,
    loads: &[Load],
    count: usize,
    bar: &ProgressBar,
) -> Result<Vec<PayloadCase>, Failure> {
    if let Beam::Modal(_) = beam {
        return Err(beam_failure(path, BeamError::NoTip));
    }
    let own = beam.load_kg();
    if own == 0.0 && loads.iter().any(|load| matches!(load, Load::Times(_))) {
        return Err(Failure::Model {
            arm: path.to_owned(),
            reason: "there is no mass at the tip that a factor could multiply".to_owned(),
            hint: "give masses, as in --payload \"0.3 kg\", or add a `payload` to [beam]",
        });
    }
    bar.set_message("payloads");
    let mut cases: Vec<PayloadCase> = Vec::with_capacity(loads.len() + 1);
    // Zeros of a distributed beam are searched for up to the highest frequency with its own load.
    let mut highest = 0.0;
    for load in std::iter::once(None).chain(loads.iter().map(Some)) {
        let other = match load {
            None => beam.clone(),
            Some(load) => beam.with_load(*load).map_err(|source| beam_failure(path, source))?,
        };
        let natural_frequencies_rad_s = other.frequencies_rad_s(Base::Clamped, count);
        if load.is_none() {
            highest = natural_frequencies_rad_s.last().copied().unwrap_or(0.0);
        }
        let found = other.tip_zeros(highest, count);
        let known = found.is_some();
        let zeros = found.unwrap_or(Zeros { z: Vec::new(), missing: 0 });
        let shift = cases.first().map_or(0.0, |first| zero_shift(&first.zeros, &zeros));
        let tip_mass_kg = other.load_kg();
        cases.push(PayloadCase {
            tip_mass_kg,
            inertia_kg_m2: other.payload().inertia_kg_m2,
            factor: Some(tip_mass_kg / own).filter(|f| f.is_finite()),
            natural_frequencies_rad_s,
            zeros,
            zero_shift: Some(shift).filter(|s| known && s.is_finite()),
        });
        bar.inc(1);
    }
    Ok(cases)
}

/// The zero with another load that corresponds to zero `index` with the load in the file: the one with the same number
/// in its class.
pub(crate) fn counterpart(own: &Zeros, index: usize, other: &Zeros) -> Option<Complex64> {
    let kind = class(*own.z.get(index)?);
    let place = own.z[..index].iter().filter(|z| class(**z) == kind).count();
    of_class(other, kind).nth(place)
}

/// The zeros of one class.
pub(crate) fn of_class(zeros: &Zeros, kind: RootClass) -> impl Iterator<Item = Complex64> + '_ {
    zeros.z.iter().copied().filter(move |z| class(*z) == kind)
}
