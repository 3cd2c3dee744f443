//! What a reader would write without lissom: each in its plain form, with care but no tricks.

use lissom::Matrix;
use lissom::beam::{BeamMatrices, LumpedBeam};
use nalgebra::DVector;

/// θ_n/θ_m by the recursion of compliance and motion from base to tip, one frequency at a time.
pub(crate) fn recursion(beam: &LumpedBeam, omega_rad_s: f64) -> f64 {
    let z = -omega_rad_s * omega_rad_s;
    let [mut c11, mut c12, mut c22, mut d1] = [0.0; 4];
    let mut d2 = 1.0;
    for span in beam.spans() {
        let (l, ei) = (span.length_m, span.flexural_rigidity_n_m2);
        c11 += 2.0 * l * c12 + l * l * c22 + l * l * l / (3.0 * ei);
        c12 += l * c22 + l * l / (2.0 * ei);
        c22 += l / ei;
        d1 += l * d2;
        let g = 1.0 / (1.0 + z * span.mass_kg * c11);
        let q = z * span.mass_kg * g;
        c22 -= q * c12 * c12;
        d2 -= q * c12 * d1;
        c12 *= g;
        c11 *= g;
        d1 *= g;
    }
    d1 / beam.position_m()[beam.len() - 1]
}

/// Natural frequencies below ω: negative pivots of the same recursion.
fn count(beam: &LumpedBeam, omega_rad_s: f64) -> usize {
    let z = -omega_rad_s * omega_rad_s;
    let [mut c11, mut c12, mut c22] = [0.0; 3];
    let mut below = 0;
    for span in beam.spans() {
        let (l, ei) = (span.length_m, span.flexural_rigidity_n_m2);
        c11 += 2.0 * l * c12 + l * l * c22 + l * l * l / (3.0 * ei);
        c12 += l * c22 + l * l / (2.0 * ei);
        c22 += l / ei;
        let pivot = 1.0 + z * span.mass_kg * c11;
        let g = 1.0 / pivot;
        c22 -= z * span.mass_kg * g * c12 * c12;
        c12 *= g;
        c11 *= g;
        below += usize::from(pivot < 0.0);
    }
    below
}

/// The lowest `wanted` natural frequencies by halving alone, down to neighbouring doubles.
///
/// Every count serves all frequencies that it tells something about.
pub(crate) fn bisection(beam: &LumpedBeam, wanted: usize) -> Vec<f64> {
    let mut top = 1.0;
    while count(beam, top) < wanted {
        top *= 2.0;
    }
    let mut brackets = vec![(0.0, top); wanted];
    for k in 0..wanted {
        loop {
            let (low, high) = brackets[k];
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high || high - low <= f64::EPSILON * high {
                break;
            }
            let below = count(beam, middle);
            for (index, bracket) in brackets.iter_mut().enumerate().skip(k) {
                if index < below {
                    bracket.1 = middle.min(bracket.1);
                } else {
                    bracket.0 = middle.max(bracket.0);
                }
            }
        }
    }
    brackets.iter().map(|(low, high)| 0.5 * (low + high)).collect()
}

/// The shape of the mode at ω, the largest deflection being 1: the load of a unit deflection of the
/// tip carried inwards through the same recursion.
pub(crate) fn shape(beam: &LumpedBeam, omega_rad_s: f64) -> Vec<f64> {
    let z = -omega_rad_s * omega_rad_s;
    let [mut c11, mut c12, mut c22] = [0.0; 3];
    let mut passed = Vec::with_capacity(beam.len());
    for span in beam.spans() {
        let (l, ei) = (span.length_m, span.flexural_rigidity_n_m2);
        c11 += 2.0 * l * c12 + l * l * c22 + l * l * l / (3.0 * ei);
        c12 += l * c22 + l * l / (2.0 * ei);
        c22 += l / ei;
        let g = 1.0 / (1.0 + z * span.mass_kg * c11);
        c22 -= z * span.mass_kg * g * c12 * c12;
        c12 *= g;
        c11 *= g;
        passed.push((c11, c12));
    }
    let last = beam.len() - 1;
    let mut moves = vec![1.0; beam.len()];
    let (mut force, mut torque) = (0.0, 0.0);
    for (i, span) in beam.spans().iter().enumerate().rev() {
        if i < last {
            moves[i] = passed[i].0 * force + passed[i].1 * torque;
        }
        force -= z * span.mass_kg * moves[i];
        torque += span.length_m * force;
    }
    let largest = moves.iter().fold(0.0, |m: f64, w| if w.abs() > m.abs() { *w } else { m });
    moves.iter().map(|w| w / largest).collect()
}

/// Entries of a row on and left of the diagonal: two unknowns a mass, coupled to their neighbours.
const BAND: usize = 4;

/// The beam's stiffness in deflection and slope of each mass, lower band by rows, and its
/// product with the base's slope.
pub(crate) struct Banded {
    stiffness: Vec<[f64; BAND]>,
    masses: Vec<f64>,
    load: [f64; 2],
    length: f64,
    // Work of one frequency, kept so that nothing is allocated.
    factor: Vec<[f64; BAND]>,
    unknown: Vec<f64>,
}

impl Banded {
    pub(crate) fn new(beam: &LumpedBeam) -> Self {
        let n = beam.len();
        // Row r, column r − 3 + k.
        let mut rows = vec![[0.0; BAND]; 2 * n];
        let mut load = [0.0; 2];
        for (i, span) in beam.spans().iter().enumerate() {
            let (l, ei) = (span.length_m, span.flexural_rigidity_n_m2);
            let (k11, k12) = (12.0 * ei / (l * l * l), 6.0 * ei / (l * l));
            let (near, far) = (4.0 * ei / l, 2.0 * ei / l);
            let (w, phi) = (2 * i, 2 * i + 1);
            rows[w][3] += k11;
            rows[phi][2] -= k12;
            rows[phi][3] += near;
            if i == 0 {
                load = [k12, -far];
            } else {
                // Inner end: deflection w − 2, slope w − 1.
                rows[w - 2][3] += k11;
                rows[w - 1][2] += k12;
                rows[w - 1][3] += near;
                rows[w][1] -= k11;
                rows[w][2] -= k12;
                rows[phi][0] += k12;
                rows[phi][1] += far;
            }
        }
        Self {
            factor: rows.clone(),
            unknown: vec![0.0; 2 * n],
            stiffness: rows,
            masses: beam.spans().iter().map(|s| s.mass_kg).collect(),
            load,
            length: beam.position_m()[n - 1],
        }
    }

    /// θ_n/θ_m by LDLᵀ of the band without exchange of rows.
    pub(crate) fn tip(&mut self, omega_rad_s: f64) -> f64 {
        let z = -omega_rad_s * omega_rad_s;
        let (factor, x) = (&mut self.factor, &mut self.unknown);
        for (r, stiff) in self.stiffness.iter().enumerate() {
            let mut row = *stiff;
            if r % 2 == 0 {
                row[3] += z * self.masses[r / 2];
            }
            let mut value = self.load.get(r).copied().unwrap_or(0.0);
            // L·D, then L: the rows before hold L left of the diagonal and D on it.
            for k in BAND - 1 - r.min(BAND - 1)..BAND - 1 {
                let column = r + k + 1 - BAND;
                for j in 0..k {
                    let other = BAND - 1 + j - k;
                    row[k] -= row[j] * factor[column][other];
                }
            }
            for k in BAND - 1 - r.min(BAND - 1)..BAND - 1 {
                let column = r + k + 1 - BAND;
                let scaled = row[k] / factor[column][BAND - 1];
                row[BAND - 1] -= row[k] * scaled;
                row[k] = scaled;
                value -= scaled * x[column];
            }
            factor[r] = row;
            x[r] = value;
        }
        // The last two unknowns are all that is asked for.
        let last = x.len() - 1;
        let slope = x[last] / factor[last][BAND - 1];
        let tip = x[last - 1] / factor[last - 1][BAND - 1] - factor[last][BAND - 2] * slope;
        tip / self.length
    }
}

/// θ_n/θ_m by LU of (13), `(m_i·s² − EI·A)·θ = EI·B·θ_m`.
pub(crate) fn dense(beam: &LumpedBeam, m: &BeamMatrices, omega_rad_s: f64) -> f64 {
    let mut system = -m.ei_a.clone();
    for (i, span) in beam.spans().iter().enumerate() {
        system[(i, i)] -= span.mass_kg * omega_rad_s * omega_rad_s;
    }
    let load = DVector::from_column_slice(m.ei_b.as_slice());
    system.lu().solve(&load).map_or(f64::NAN, |theta| theta[beam.len() - 1])
}

/// `M^(−1/2)·K·M^(−1/2)` in deflections, from (13).
pub(crate) fn symmetric(beam: &LumpedBeam, m: &BeamMatrices) -> Matrix {
    let (l, spans) = (beam.position_m(), beam.spans());
    let n = beam.len();
    let entry = |i: usize, j: usize| {
        let root = (spans[i].mass_kg * spans[j].mass_kg).sqrt();
        -m.ei_a[(i, j)] * l[i] / (l[j] * root)
    };
    Matrix::from_fn(n, n, |i, j| entry(i.max(j), i.min(j)))
}

/// All natural frequencies, ascending, by nalgebra's eigenvalues of that matrix.
pub(crate) fn eigenvalues(matrix: &Matrix) -> Vec<f64> {
    let mut squares: Vec<f64> = matrix.symmetric_eigenvalues().iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    squares.iter().map(|s| s.max(0.0).sqrt()).collect()
}
