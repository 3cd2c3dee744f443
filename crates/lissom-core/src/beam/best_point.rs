//! Where along a beam a point tells its modes apart best.

use nalgebra::DMatrix;

use super::{BeamError, DistributedBeam};

/// Places looked at along the beam.
const PLACES: usize = 400;

/// A place for a point, among others that stay.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BestPoint {
    /// Distance from the axis \[m\].
    pub position_m: f64,
    /// Least singular value of the shares with the point there…
    pub least: f64,
    /// …and with the point where it is.
    pub least_now: f64,
}

impl DistributedBeam {
    /// Where the point `moved` (from 0) of `points_m` would tell as many modes as there are points apart best,
    /// the other points staying where they are: the place at which the least singular value of their shares
    /// r_ik is largest, of 400 along the beam.
    ///
    /// Section 4 inverts these shares: an error of the responses grows by one over that value.
    ///
    /// # Errors
    /// [`BeamError::Points`] where a point is not on the beam, or there is no point `moved`.
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
