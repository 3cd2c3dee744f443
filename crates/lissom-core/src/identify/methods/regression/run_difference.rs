//! The difference between one run and the others: the one change of a parameter, or of the run's channels, that
//! describes the run.

use nalgebra::{DMatrix, DVector};

use crate::identify::methods::regression::motor_columns::{
    PLACE_COULOMB, PLACE_INERTIA, PLACE_OFFSET, PLACE_VISCOUS,
};
use crate::identify::methods::regression::normal::{Cluster, Term};
use crate::identify::methods::regression::thresholds::{
    DIFFERENCE_EXPLAINS, GROSS_FACTOR, REVERSED_SCALE, SAME_COLUMN,
};

/// A difference between one run and the others. Factors are relative to the other runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RunDifference {
    /// The sign of the command or of the angle is reversed.
    Sign,
    /// The scale of the command differs.
    CommandScale {
        /// Command of the other runs for the same motion, divided by the command of this run.
        factor: f64,
    },
    /// The scale of the angle differs.
    AngleScale {
        /// Angle of the other runs divided by the angle of this run.
        factor: f64,
    },
    /// The inertia differs.
    Inertia {
        /// Inertia of this run divided by that of the others.
        factor: f64,
    },
    /// Coulomb friction differs.
    Coulomb {
        /// Coulomb friction of this run divided by that of the others.
        factor: f64,
    },
    /// Viscous friction differs.
    Viscous {
        /// Viscous friction of this run divided by that of the others.
        factor: f64,
    },
    /// A constant load acts in this run.
    Load {
        /// Torque of the load \[unit of the regression's torque\].
        torque: f64,
    },
    /// No single change describes the run.
    Other,
}

impl RunDifference {
    /// Whether it is too large for friction's law, by which slow and fast runs differ.
    pub(super) fn is_gross(self) -> bool {
        match self {
            Self::Sign => true,
            Self::CommandScale { factor }
            | Self::AngleScale { factor }
            | Self::Inertia { factor } => factor.ln().abs() > GROSS_FACTOR.ln(),
            Self::Coulomb { .. } | Self::Viscous { .. } | Self::Load { .. } | Self::Other => false,
        }
    }
}

/// Products of the columns of terms and of the torque, summed over a run: a quadratic form of `[q, −1]`.
pub(super) struct RunSums {
    normal: DMatrix<f64>,
    right: DVector<f64>,
    power: f64,
    clusters: f64,
}

impl RunSums {
    pub(super) fn of(clusters: &[Cluster], terms: &[Term], count: usize) -> Self {
        let p = terms.len();
        let (mut normal, mut right, mut power) = (DMatrix::zeros(p, p), DVector::zeros(p), 0.0);
        for cluster in clusters {
            let last = cluster.products.ncols() - 1;
            let factor = |i: usize| terms[i].factor(cluster.sign);
            for j in 0..p {
                let b = terms[j].column();
                right[j] += factor(j) * cluster.products[(b, last)];
                for i in 0..p {
                    normal[(i, j)] +=
                        factor(i) * factor(j) * cluster.products[(terms[i].column(), b)];
                }
            }
            power += cluster.products[(last, last)];
        }
        Self { normal, right, power, clusters: count as f64 }
    }

    /// ‖y − X·q‖².
    fn left(&self, value: &DVector<f64>) -> f64 {
        let left = self.power - 2.0 * value.dot(&self.right) + value.dot(&(&self.normal * value));
        left.max(0.0)
    }

    /// ‖y − X·q‖/‖y‖.
    pub(super) fn share_left(&self, value: &DVector<f64>) -> f64 {
        (self.left(value) / self.power).sqrt()
    }

    /// The share of the torque by which parameters differ from the run's own, after they have moved towards these as far as
    /// their own `covariance` allows: the residual is weighed as noise of the share `noise` of the torque, one independent
    /// value for each slip phase.
    pub(super) fn misfit(
        &self,
        value: &DVector<f64>,
        covariance: &DMatrix<f64>,
        noise: f64,
    ) -> Option<f64> {
        let weight = self.clusters / (noise * noise * self.power);
        let known = covariance.clone().cholesky()?.inverse();
        let gradient = (&self.right - &self.normal * value) * weight;
        let moved = (&self.normal * weight + known).cholesky()?.solve(&gradient);
        let own = self
            .normal
            .clone()
            .svd(true, true)
            .solve(&self.right, SAME_COLUMN * self.normal.norm())
            .ok()?;
        let beyond = self.left(&(value + moved)) - self.left(&own);
        Some((beyond.max(0.0) / self.power).sqrt())
    }

    /// The change that describes the run best, beside parameters of the other runs that leave the share `left` of its torque.
    pub(super) fn difference(&self, value: &DVector<f64>, left: f64, usual: f64) -> RunDifference {
        let gradient = &self.right - &self.normal * value;
        // A change of the parameters along a direction, as a factor of it, and what it leaves.
        let along = |direction: &DVector<f64>| {
            let change = direction.dot(&gradient) / direction.dot(&(&self.normal * direction));
            (change, self.share_left(&(value + direction * change)))
        };
        let only = |place: usize| {
            let mut direction = DVector::zeros(value.len());
            direction[place] = 1.0;
            along(&direction)
        };
        let times = |place: usize, make: fn(f64) -> RunDifference| {
            let (change, left) = only(place);
            (make(1.0 + change / value[place]), left)
        };
        let scale = value.dot(&self.right) / self.power;
        let scaled = (1.0
            - value.dot(&self.right).powi(2) / (self.power * value.dot(&(&self.normal * value))))
        .max(0.0)
        .sqrt();
        let by_scale = if (scale + 1.0).abs() < REVERSED_SCALE {
            RunDifference::Sign
        } else {
            RunDifference::CommandScale { factor: scale }
        };
        let mut moving = DVector::zeros(value.len());
        for place in [PLACE_INERTIA, PLACE_VISCOUS] {
            moving[place] = value[place];
        }
        let (by_angle, angle_left) = along(&moving);
        let (load, load_left) = only(PLACE_OFFSET);
        let tried = [
            (by_scale, scaled),
            times(PLACE_INERTIA, |factor| RunDifference::Inertia { factor }),
            times(PLACE_COULOMB, |factor| RunDifference::Coulomb { factor }),
            times(PLACE_VISCOUS, |factor| RunDifference::Viscous { factor }),
            (RunDifference::AngleScale { factor: 1.0 + by_angle }, angle_left),
            (RunDifference::Load { torque: load }, load_left),
        ];
        // A factor that is not positive describes no machine.
        let possible = |(difference, _): &&(RunDifference, f64)| match difference {
            RunDifference::CommandScale { factor }
            | RunDifference::AngleScale { factor }
            | RunDifference::Inertia { factor }
            | RunDifference::Coulomb { factor }
            | RunDifference::Viscous { factor } => *factor > 0.0 && factor.is_finite(),
            _ => true,
        };
        let best = tried.iter().filter(possible).min_by(|a, b| a.1.total_cmp(&b.1));
        let explains = |rest: f64| rest < DIFFERENCE_EXPLAINS * left || rest < 2.0 * usual;
        match best {
            Some((difference, rest)) if explains(*rest) => *difference,
            _ => RunDifference::Other,
        }
    }
}
