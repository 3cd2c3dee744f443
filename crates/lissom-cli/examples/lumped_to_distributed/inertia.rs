//! Zeros of a uniform beam whose tip carries a body with rotary inertia.

use std::error::Error;

use lissom::beam::{Payload, RootClass, class};
use lissom_testmodels::limit::cantilever;
use num_complex::Complex64;

/// |s| up to which zeros are looked for \[1/s\].
const FARTHEST_ZERO: f64 = 500.0;

/// The zeros of θ/θ_m at `point_m` of the uniform beam with this payload, one s of each pair or
/// quadruple.
pub(crate) fn zeros(payload: Payload, point_m: f64) -> Result<Vec<Complex64>, Box<dyn Error>> {
    let zeros = cantilever().with_payload(payload)?.zeros_below(point_m, FARTHEST_ZERO);
    let zeros = zeros.ok_or_else(|| format!("zeros cannot be counted with {payload:?}"))?;
    if zeros.missing > 0 {
        return Err(format!("{} zeros are not found with {payload:?}", zeros.missing).into());
    }
    let upper = zeros.z.into_iter().filter(|z| z.im >= 0.0 || class(*z) != RootClass::Quadruple);
    Ok(upper.map(Complex64::sqrt).collect())
}

/// The tip's zeros over a payload's rotary inertia: the pair on the imaginary axis, where it is
/// within reach, and the first three on the real axis.
pub(crate) fn tip(inertia_kg_m2: f64) -> Result<(Option<f64>, Vec<f64>), Box<dyn Error>> {
    let s = zeros(Payload { inertia_kg_m2, ..Payload::default() }, 1.0)?;
    let imaginary = |s: &&Complex64| s.re.abs() < 1e-9 * s.norm();
    let real = s.iter().filter(|s| !imaginary(s)).map(|s| s.re).take(3);
    Ok((s.iter().find(imaginary).map(|s| s.im.abs()), real.collect()))
}
