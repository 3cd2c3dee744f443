//! Where on a beam a sensor point separates the modes best.

use nalgebra::DMatrix;

use super::{BeamError, DistributedBeam};

/// Places looked at along the beam.
const PLACES: usize = 400;

/// The best place for one sensor point while the others stay.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BestPoint {
    /// Distance from the axis \[m\].
    pub position_m: f64,
    /// Least singular value of the matrix of shares r_ik with the point there \[1\].
    pub least: f64,
    /// The same with the point at its present place \[1\].
    pub least_now: f64,
}

impl DistributedBeam {
    /// Finds the best place for the point `moved` (counted from 0) of `points_m` while the other points stay: the place
    /// at which the least singular value of the matrix of shares r_ik ([`Mode::share`](super::Mode::share)) is largest.
    /// As many modes as points are counted, and 400 places along the beam are tried.
    ///
    /// The method of Section 4 of the 1989 report inverts this matrix, so errors of measured responses grow in
    /// proportion to the reciprocal of its least singular value.
    ///
    /// # Errors
    /// [`BeamError::Points`] if a point is not on the beam, or there is no point `moved`.
    ///
    /// # Source
    /// The condition after step 6 in `[Feliu1989, Section 4]`: "very close points cannot be used".
    pub fn best_point(&self, points_m: &[f64], moved: usize) -> Result<BestPoint, BeamError> {
        let (base, tip) = (self.hub_radius_m(), self.length_m());
        let on_beam = |x: &f64| *x > base && *x <= tip;
        if moved >= points_m.len() || !points_m.iter().all(on_beam) {
            return Err(BeamError::Points { base_m: base, tip_m: tip });
        }
        let count = points_m.len();
        let mut shares = DMatrix::zeros(count, count);
        // One at a time: points that lie together are no joints of one beam.
        for (i, at) in points_m.iter().enumerate() {
            for (k, mode) in self.modes(count, &[*at]).iter().enumerate() {
                shares[(i, k)] = mode.share[0];
            }
        }
        let least = |shares: &DMatrix<f64>| shares.singular_values().min();
        let least_now = least(&shares);
        let places: Vec<f64> =
            (1..=PLACES).map(|i| base + (tip - base) * i as f64 / PLACES as f64).collect();
        let modes = self.modes(count, &places);
        let mut best = BestPoint { position_m: points_m[moved], least: least_now, least_now };
        for (i, position_m) in places.into_iter().enumerate() {
            for (k, mode) in modes.iter().enumerate() {
                shares[(moved, k)] = mode.share[i];
            }
            let found = least(&shares);
            if found > best.least {
                best = BestPoint { position_m, least: found, least_now };
            }
        }
        Ok(best)
    }
}
