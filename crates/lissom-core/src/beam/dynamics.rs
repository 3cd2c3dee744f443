//! The beam's equation of motion as matrices, for simulation and state space.

use nalgebra::{DMatrix, DVector};

use super::three_moment::ThreeMoment;
use super::{BeamError, Damping, LumpedBeam, MOST_MASSES};

/// The beam's equation of motion as matrices,
/// `q̈ = Â·(q − 1·θ_m) + D̂_w·(q̇ − 1·θ̇_m) + D̂_f·q̇ + P̂·T_n + Q̂·F_n`, with the coupling torque
/// `C_t = hᵀ·(q − 1·θ_m) + h'ᵀ·(q̇ − 1·θ̇_m) + h_{n+2}·T_n`.
///
/// q \[rad\] holds the angles θ_1 … θ_n and, if the payload resists turning
/// ([`Payload::turns`](super::Payload::turns)), the slope of the tip. All of them equal θ_m when the arm turns as one
/// body, so B̂ = −Â·1 holds exactly.
///
/// # Source
/// `[Feliu1989, eqs. (13), (15)]` divided by the masses; force and torque on the tip act at the last mass.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamDynamics {
    /// Â, elastic forces \[1/s²\], k × k for k coordinates.
    pub elastic: DMatrix<f64>,
    /// D̂_w, damping within the beam \[1/s\], k × k; `None` if there is none.
    pub relative: Option<DMatrix<f64>>,
    /// D̂_f, damping against the fixed frame \[1/s\], k × k; `None` if there is none.
    pub absolute: Option<DMatrix<f64>>,
    /// h, coupling torque per angle of each coordinate \[N·m/rad\].
    pub coupling: DVector<f64>,
    /// h_{n+1} \[N·m/rad\], `hᵀ·1 + h_{n+1} = 0`: coupling torque per angle of the motor with all coordinates held.
    pub coupling_motor: f64,
    /// h', coupling torque per velocity \[N·m·s/rad\]; `None` without damping within the beam.
    pub coupling_rate: Option<DVector<f64>>,
    /// Q̂, accelerations per tip force \[1/(kg·m)\].
    pub force: DVector<f64>,
    /// P̂, accelerations per tip torque \[1/(kg·m²)\].
    pub torque: DVector<f64>,
    /// h_{n+2}, coupling torque per tip torque \[1\]; zero if the slope of the tip is a coordinate.
    pub coupling_torque: f64,
}

impl BeamDynamics {
    /// Number of coordinates.
    pub fn len(&self) -> usize {
        self.coupling.len()
    }
    /// Whether there is no beam.
    pub fn is_empty(&self) -> bool {
        self.coupling.is_empty()
    }

    /// That of a rigid joint: no coordinates and no torque.
    pub(super) fn none() -> Self {
        let (matrix, vector) = (DMatrix::zeros(0, 0), DVector::zeros(0));
        Self {
            elastic: matrix,
            relative: None,
            absolute: None,
            coupling: vector.clone(),
            coupling_motor: 0.0,
            coupling_rate: None,
            force: vector.clone(),
            torque: vector,
            coupling_torque: 0.0,
        }
    }

    pub(super) fn of(beam: &LumpedBeam) -> Result<Self, BeamError> {
        let n = beam.len();
        if n > MOST_MASSES {
            return Err(BeamError::TooManyMasses { found: n, most: MOST_MASSES });
        }
        let turns = beam.payload().turns();
        let statics = ThreeMoment::new(beam.spans(), beam.hub_radius_m(), turns);
        let stiffness = statics.stiffness();
        let size = n + usize::from(turns);
        // Motion of coordinate i per radian.
        let arm = |i: usize| if i < n { beam.position_m()[i] } else { 1.0 };
        let mass = MassMatrix::of(beam, size);
        // S⁻¹·X·S for a matrix X on motions.
        let angular =
            |x: &DMatrix<f64>| DMatrix::from_fn(size, size, |i, j| x[(i, j)] * arm(j) / arm(i));
        let elastic = angular(&-mass.solve(&stiffness));
        let moments = statics.moments();
        let coupling = DVector::from_fn(size, |j, _| {
            let column: Vec<f64> = moments.column(j).iter().copied().collect();
            -statics.about_axis(&column, 0.0) * arm(j)
        });
        let coupling_motor = statics.about_axis(&statics.turn(), 0.0);
        let (alpha, beta) = beam.damping().proportional();
        let (mut relative, mut coupling_rate) = (None, None);
        if beta > 0.0 {
            relative = Some(&elastic * beta);
            coupling_rate = Some(&coupling * beta);
        }
        if let Damping::Modal { .. } = beam.damping() {
            let damper = mass.modal_damper(&stiffness, |k| beam.damping().ratio(k).unwrap_or(0.0));
            relative = Some(angular(&-mass.solve(&damper)));
            let lever = DVector::from_fn(size, |i, _| arm(i));
            let torque = &damper * &lever;
            coupling_rate = Some(DVector::from_fn(size, |j, _| -torque[j] * arm(j)));
        }
        let damped = alpha > 0.0 || beam.spans().iter().any(|s| s.damping_n_s_per_m > 0.0);
        let absolute = damped.then(|| {
            let own = |i: usize| beam.spans().get(i).map_or(0.0, |s| s.damping_n_s_per_m);
            let point = DMatrix::from_fn(size, size, |i, j| if i == j { own(i) } else { 0.0 });
            angular(&-mass.solve(&point)) - DMatrix::identity(size, size) * alpha
        });
        let load = |i: usize| {
            let unit = DMatrix::from_fn(size, 1, |k, _| if k == i { 1.0 } else { 0.0 });
            let motion = mass.solve(&unit);
            DVector::from_fn(size, |k, _| motion[k] / arm(k))
        };
        let force = load(n - 1);
        let (torque, coupling_torque) = if turns {
            (load(n), 0.0)
        } else {
            let made = beam.matrices()?;
            let mass = |i: usize| {
                beam.spans()[i].mass_kg + if i + 1 == n { beam.payload().mass_kg } else { 0.0 }
            };
            (DVector::from_fn(n, |i, _| made.p[i] / mass(i)), made.h_torque)
        };
        if !elastic.iter().chain(coupling.iter()).all(|v| v.is_finite()) {
            return Err(BeamError::OutOfRange { quantity: "the stiffness" });
        }
        Ok(Self {
            elastic,
            relative,
            absolute,
            coupling,
            coupling_motor,
            coupling_rate,
            force,
            torque,
            coupling_torque,
        })
    }
}

/// Diagonal but for the tip's deflection and slope.
struct MassMatrix {
    diagonal: Vec<f64>,
    /// Between the last mass and the tip's slope: m_p·e.
    beside: f64,
    turns: bool,
}

impl MassMatrix {
    fn of(beam: &LumpedBeam, size: usize) -> Self {
        let p = beam.payload();
        let mut diagonal: Vec<f64> = beam.spans().iter().map(|s| s.mass_kg).collect();
        let n = diagonal.len();
        diagonal[n - 1] += p.mass_kg;
        let turns = size > n;
        if turns {
            diagonal.push(p.inertia_kg_m2 + p.mass_kg * p.offset_m * p.offset_m);
        }
        Self { diagonal, beside: p.mass_kg * p.offset_m, turns }
    }

    /// Lower Cholesky factor: diagonal, and the one entry beside it.
    fn factor(&self) -> (Vec<f64>, f64) {
        let mut root: Vec<f64> = self.diagonal.iter().map(|m| m.sqrt()).collect();
        let n = root.len();
        if !self.turns {
            return (root, 0.0);
        }
        let beside = self.beside / root[n - 2];
        root[n - 1] = (self.diagonal[n - 1] - beside * beside).sqrt();
        (root, beside)
    }

    /// `L⁻¹·X`.
    fn forward(&self, x: &DMatrix<f64>) -> DMatrix<f64> {
        let (root, beside) = self.factor();
        let n = root.len();
        let mut y = x.clone();
        for j in 0..x.ncols() {
            for i in 0..n {
                if self.turns && i == n - 1 {
                    y[(i, j)] -= beside * y[(n - 2, j)];
                }
                y[(i, j)] /= root[i];
            }
        }
        y
    }

    /// `M⁻¹·X`.
    fn solve(&self, x: &DMatrix<f64>) -> DMatrix<f64> {
        let (root, beside) = self.factor();
        let n = root.len();
        let mut y = self.forward(x);
        for j in 0..y.ncols() {
            for i in (0..n).rev() {
                if self.turns && i + 2 == n {
                    y[(i, j)] -= beside * y[(n - 1, j)];
                }
                y[(i, j)] /= root[i];
            }
        }
        y
    }

    /// `C = L·Q·diag(2·ζ_k·ω_k)·Qᵀ·Lᵀ`, Q the eigenvectors of `L⁻¹·K·L⁻ᵀ`.
    fn modal_damper(&self, stiffness: &DMatrix<f64>, ratio: impl Fn(usize) -> f64) -> DMatrix<f64> {
        let half = self.forward(stiffness);
        let symmetric = self.forward(&half.transpose());
        let eigen = ((&symmetric + symmetric.transpose()) * 0.5).symmetric_eigen();
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let size = order.len();
        let mut damper = DMatrix::zeros(size, size);
        for (k, &column) in order.iter().enumerate() {
            let omega = eigen.eigenvalues[column].max(0.0).sqrt();
            let q = eigen.eigenvectors.column(column);
            damper += q * q.transpose() * (2.0 * ratio(k) * omega);
        }
        // L·X·Lᵀ.
        let (root, beside) = self.factor();
        let lower = DMatrix::from_fn(size, size, |i, j| {
            if i == j {
                root[i]
            } else if self.turns && i == size - 1 && j + 2 == size {
                beside
            } else {
                0.0
            }
        });
        &lower * damper * lower.transpose()
    }
}

impl LumpedBeam {
    /// The equation of motion as matrices.
    ///
    /// # Errors
    /// [`BeamError::TooManyMasses`] above [`MOST_MASSES`], [`BeamError::OutOfRange`] if an
    /// element leaves the range of a double.
    pub fn dynamics(&self) -> Result<BeamDynamics, BeamError> {
        BeamDynamics::of(self)
    }

    /// M of its coordinates, angles: diagonal but for the tip's angle and slope \[kg·m²\].
    pub(crate) fn mass_matrix(&self) -> DMatrix<f64> {
        let (n, load, at) = (self.len(), self.payload(), self.position_m());
        let size = n + usize::from(load.turns());
        let mass = MassMatrix::of(self, size);
        let lever = |i: usize| at.get(i).copied().unwrap_or(1.0);
        let mut angular = DMatrix::from_fn(size, size, |i, j| {
            if i == j { mass.diagonal[i] * lever(i) * lever(i) } else { 0.0 }
        });
        if mass.turns {
            angular[(n - 1, n)] = mass.beside * at[n - 1];
            angular[(n, n - 1)] = mass.beside * at[n - 1];
        }
        angular
    }
}
