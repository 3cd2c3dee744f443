//! Known zeros and poles at the origin.

use num_complex::Complex64;

use crate::identify::responses::correct::Response;

/// Removes known zeros or poles at the origin from responses at `omega_rad_s`: `H/(jω)^zeros`, with their standard
/// errors. A negative number stands for poles.
///
/// [`fit_shared_poles`](super::fit_shared_poles) expects the response of an angle to an angle. A velocity in place of
/// the output angle has one zero at the origin, an acceleration two. An output angle per input velocity has one pole.
///
/// ```
/// # use {lissom::identify::Response, num_complex::Complex64};
/// use lissom::identify::without_origin;
/// let acceleration = Response { value: Complex64::new(-9.0, 0.0), std: 0.9 }; // at 3 rad/s
/// let angle = without_origin(&[3.0], &[acceleration], 2)[0];
/// assert!((angle.value - 1.0).norm() < 1e-15 && (angle.std - 0.1).abs() < 1e-15);
/// ```
pub fn without_origin(omega_rad_s: &[f64], responses: &[Response], zeros: i32) -> Vec<Response> {
    let angle = |(omega, r): (&f64, &Response)| Response {
        value: r.value * Complex64::new(0.0, *omega).powi(-zeros),
        std: r.std * omega.powi(-zeros),
    };
    omega_rad_s.iter().zip(responses).map(angle).collect()
}
