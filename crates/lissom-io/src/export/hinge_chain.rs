//! A beam as a chain of rigid segments between elastic hinges.

use lissom_core::Matrix;
use lissom_core::beam::{Base, Damping, DistributedBeam, LumpedBeam, Payload, Piece};

/// Modes that the chain keeps to a few parts in a thousand; a convention, as many as a model of an arm may have.
const KEPT_MODES: usize = 4;
/// The limit of the chain's frequencies over the highest kept one: it lowers that one by 1/(2·20²) = 0.13 %.
const LIMIT_RATIO: f64 = 20.0;
/// Lowest limit \[rad/s\]: a lower one would not allow a longer time step than the longest one of a model.
const LIMIT_LEAST_RAD_S: f64 = STEP_RADIANS / STEP_S;
/// Longest time step of a chain \[s\].
pub(super) const STEP_S: f64 = 1e-4;
/// Time step times the limit of the frequencies \[rad\]: MuJoCo's integrators are stable below 2.
pub(super) const STEP_RADIANS: f64 = 0.5;
/// Longest cell, as a phase of the bending wave of the highest kept mode \[rad\]; measured: 1 keeps it to 0.02 %.
const CELL_RADIANS: f64 = 1.0;
/// A segment whose rotary inertia is below this part of m·x² is damped as a point.
const POINT_SHARE: f64 = 1e-3;

/// A chain of rigid segments on the motor, joined by elastic hinges: for small deflections the beam.
///
/// The beam is cut into cells: a span between two point masses, or a part of a piece with mass along it that is short
/// compared with the bending wave. A cell of length h has two hinges of stiffness 2·EI/h at the Gauss points
/// `h/2·(1 ± 1/√3)`. The static deflection under loads at the ends of cells is `∫ M·m/EI dx` with M and m linear in a
/// cell, and two Gauss points integrate such a product exactly: the chain has the exact flexibility matrix of the
/// masses, and the tip's `L³/(3·EI)`. Of mass along the beam each segment carries its part, with its centre and rotary
/// inertia; the error of a natural frequency falls with h⁴.
///
/// Links between hinges without mass would have no finite frequency. Each hinge therefore has an armature of k/ω_c², with
/// its stiffness k: all modes keep their shapes, ω becomes `ω/√(1 + ω²/ω_c²)`, and no frequency is above ω_c.
#[derive(Debug, Clone)]
pub(super) struct HingeChain {
    /// Hinges, from base to tip.
    pub(super) hinges: Vec<Hinge>,
    /// Segments: that of the motor, then one beyond each hinge.
    pub(super) segments: Vec<Segment>,
    /// Distance of the outer end of each span from the axis \[m\].
    pub(super) ends_m: Vec<f64>,
    /// Place of the payload's centre \[m\], if it is not at the tip.
    pub(super) payload_m: Option<f64>,
    /// Limit ω_c of the frequencies \[rad/s\].
    pub(super) limit_rad_s: f64,
    /// Natural frequencies that the chain keeps, with the motor held \[rad/s\].
    pub(super) held_rad_s: Vec<f64>,
    /// The same with the motor free to turn, without the rigid motion \[rad/s\].
    pub(super) free_rad_s: Vec<f64>,
    /// Damping of each hinge over its stiffness \[s\].
    pub(super) damping_s: f64,
    /// Dampers between the frame and points of the chain, and those of single modes.
    pub(super) dampers: Vec<Damper>,
}

/// An elastic hinge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hinge {
    /// Distance from the motor's axis \[m\].
    pub(super) at_m: f64,
    /// Stiffness \[N·m/rad\].
    pub(super) stiffness_nm_per_rad: f64,
}

/// A rigid segment.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Segment {
    /// Inner end, distance from the axis \[m\].
    pub(super) from_m: f64,
    /// Outer end \[m\].
    pub(super) to_m: f64,
    /// Mass \[kg\].
    pub(super) mass_kg: f64,
    /// Centre of mass, distance from the axis \[m\].
    pub(super) centre_m: f64,
    /// Rotary inertia about it \[kg·m²\].
    pub(super) inertia_kg_m2: f64,
}

/// A damper with the torque `−c_j·d·Σ c_i·q̇_i` on joint j.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Damper {
    /// What it is.
    pub(super) kind: DamperKind,
    /// d: N·s/m if the c_j are levers.
    pub(super) damping: f64,
    /// Joint (0 is the motor, then the hinges) and c_j: its lever \[m\], or its share of a mode \[1\].
    pub(super) levers: Vec<(usize, f64)>,
}

/// What a damper is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum DamperKind {
    /// Between a point and the fixed frame.
    Ground,
    /// Of a mode.
    Mode,
}

/// A beam of either kind.
struct Outline<'a> {
    pieces: Vec<Piece>,
    hub_radius_m: f64,
    payload: &'a Payload,
    damping: &'a Damping,
    held_rad_s: Vec<f64>,
    free_rad_s: Vec<f64>,
}

impl HingeChain {
    /// The chain of a beam with point masses, on a motor of inertia J \[kg·m²\].
    pub(super) fn of_lumped(beam: &LumpedBeam, motor_kg_m2: f64) -> Self {
        let piece = |s: &lissom_core::beam::Span| Piece {
            length_m: s.length_m,
            flexural_rigidity_n_m2: s.flexural_rigidity_n_m2,
            mass_per_length_kg_per_m: 0.0,
            end_mass_kg: s.mass_kg,
            end_damping_n_s_per_m: s.damping_n_s_per_m,
        };
        Self::of(&Outline {
            pieces: beam.spans().iter().map(piece).collect(),
            hub_radius_m: beam.hub_radius_m(),
            payload: beam.payload(),
            damping: beam.damping(),
            held_rad_s: beam.frequencies_rad_s(Base::Clamped, KEPT_MODES),
            free_rad_s: beam.frequencies_rad_s(Base::Rotor(motor_kg_m2), KEPT_MODES),
        })
    }

    /// The chain of a beam with mass along it, on a motor of inertia J \[kg·m²\].
    pub(super) fn of_distributed(beam: &DistributedBeam, motor_kg_m2: f64) -> Self {
        Self::of(&Outline {
            pieces: beam.pieces().to_vec(),
            hub_radius_m: beam.hub_radius_m(),
            payload: beam.payload(),
            damping: beam.damping(),
            held_rad_s: beam.frequencies_rad_s(Base::Clamped, KEPT_MODES),
            free_rad_s: beam.frequencies_rad_s(Base::Rotor(motor_kg_m2), KEPT_MODES),
        })
    }

    fn of(beam: &Outline<'_>) -> Self {
        let kept = beam.held_rad_s.iter().chain(&beam.free_rad_s);
        let highest = kept.copied().fold(0.0, f64::max);
        let mut hinges = Vec::new();
        let mut ends_m = Vec::new();
        let mut at = beam.hub_radius_m;
        for piece in &beam.pieces {
            let cells = cells(piece, highest);
            let h = piece.length_m / cells as f64;
            for cell in 0..cells {
                for place in [0.5 - GAUSS, 0.5 + GAUSS] {
                    hinges.push(Hinge {
                        at_m: at + h * (cell as f64 + place),
                        stiffness_nm_per_rad: 2.0 * piece.flexural_rigidity_n_m2 / h,
                    });
                }
            }
            at += piece.length_m;
            ends_m.push(at);
        }
        let payload = beam.payload;
        let mut chain = Self {
            segments: segments(beam, &hinges, &ends_m),
            payload_m: (payload.mass_kg > 0.0 && payload.offset_m.abs() > 0.0)
                .then_some(at + payload.offset_m),
            limit_rad_s: (LIMIT_RATIO * highest).max(LIMIT_LEAST_RAD_S),
            held_rad_s: beam.held_rad_s.clone(),
            free_rad_s: beam.free_rad_s.clone(),
            damping_s: 0.0,
            dampers: Vec::new(),
            hinges,
            ends_m,
        };
        chain.add_damping(beam);
        chain
    }

    /// Number of the segment in which a point lies: 0 is on the motor.
    pub(super) fn segment_at(&self, x_m: f64) -> usize {
        self.hinges.partition_point(|h| h.at_m < x_m)
    }

    fn add_damping(&mut self, beam: &Outline<'_>) {
        let mut points: Vec<(f64, f64, usize)> = Vec::new();
        for (piece, end) in beam.pieces.iter().zip(&self.ends_m) {
            points.push((*end, piece.end_damping_n_s_per_m, self.segment_at(*end)));
        }
        let (alpha, beta) = beam.damping.proportional();
        for (number, s) in self.segments.iter().enumerate() {
            let c = alpha * s.mass_kg;
            if s.inertia_kg_m2 > POINT_SHARE * s.mass_kg * s.centre_m * s.centre_m {
                // Two halves with the same centre and rotary inertia.
                let r = (s.inertia_kg_m2 / s.mass_kg).sqrt();
                points.extend([s.centre_m - r, s.centre_m + r].map(|x| (x, 0.5 * c, number)));
            } else {
                points.push((s.centre_m, c, number));
            }
        }
        self.damping_s = beta;
        for (x, damping, segment) in points.into_iter().filter(|p| p.1 > 0.0) {
            let hinges = self.hinges[..segment].iter().enumerate();
            let levers = hinges.map(|(j, h)| (j + 1, x - h.at_m));
            let levers = std::iter::once((0, x)).chain(levers).collect();
            self.dampers.push(Damper { kind: DamperKind::Ground, damping, levers });
        }
        if let Damping::Modal { .. } = beam.damping {
            self.add_modal(beam.damping);
        }
    }

    /// Damping ratios by mode: each hinge takes the least `2ζ/ω` of all modes times its stiffness, and a damper on each
    /// mode's own coordinate `uᵀ·√K·q` takes the rest. u are the eigenvectors of `K^−½·M·K^−½`, with the eigenvalues
    /// 1/ω²; a link without mass has zero and no damper of its own.
    fn add_modal(&mut self, damping: &Damping) {
        let root: Vec<f64> = self.hinges.iter().map(|h| h.stiffness_nm_per_rad.sqrt()).collect();
        let n = root.len();
        let scaled = Matrix::from_fn(n, n, |j, k| self.mass(j, k) / (root[j] * root[k]));
        let eigen = scaled.symmetric_eigen();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        let largest = order.first().map_or(0.0, |k| eigen.eigenvalues[*k]);
        order.retain(|k| eigen.eigenvalues[*k] > f64::EPSILON * n as f64 * largest);
        let limit = self.limit_rad_s.powi(-2);
        let rate = |mode: usize, k: usize| {
            2.0 * damping.ratio(mode).unwrap_or(0.0) * (eigen.eigenvalues[k] + limit).sqrt()
        };
        let rates: Vec<f64> = order.iter().enumerate().map(|(mode, k)| rate(mode, *k)).collect();
        self.damping_s = rates.iter().copied().fold(f64::INFINITY, f64::min);
        for (k, rate) in order.iter().zip(&rates).filter(|(_, rate)| **rate > self.damping_s) {
            let shares: Vec<f64> = (0..n).map(|j| root[j] * eigen.eigenvectors[(j, *k)]).collect();
            let most = shares.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
            self.dampers.push(Damper {
                kind: DamperKind::Mode,
                damping: (rate - self.damping_s) * most * most,
                levers: shares.iter().enumerate().map(|(j, s)| (j + 1, s / most)).collect(),
            });
        }
    }

    /// Element of the mass matrix of the hinges, motor held, without armature \[kg·m²\].
    fn mass(&self, j: usize, k: usize) -> f64 {
        let (a, b) = (self.hinges[j].at_m, self.hinges[k].at_m);
        let beyond = self.segments[j.max(k) + 1..].iter();
        beyond.map(|s| s.mass_kg * (s.centre_m - a) * (s.centre_m - b) + s.inertia_kg_m2).sum()
    }
}

/// Distance of a Gauss point from the middle of its cell over the cell's length, 1/(2·√3).
const GAUSS: f64 = 0.288_675_134_594_812_9;

/// Cells of a piece: one without mass along it; otherwise so many that each is short compared with the bending wave.
fn cells(piece: &Piece, highest_rad_s: f64) -> usize {
    let ratio = piece.mass_per_length_kg_per_m * highest_rad_s * highest_rad_s;
    let phase = piece.length_m * (ratio / piece.flexural_rigidity_n_m2).powf(0.25);
    (phase / CELL_RADIANS).ceil().max(1.0) as usize
}

/// The segments with their masses.
fn segments(beam: &Outline<'_>, hinges: &[Hinge], ends_m: &[f64]) -> Vec<Segment> {
    let tip = ends_m.last().copied().unwrap_or(beam.hub_radius_m);
    let inner = std::iter::once(0.0).chain(hinges.iter().map(|h| h.at_m));
    let outer = hinges.iter().map(|h| h.at_m).chain([tip]);
    let last = hinges.len();
    let one = |(number, (from_m, to_m)): (usize, (f64, f64))| {
        // Mass, centre and own inertia of each part.
        let mut parts: Vec<[f64; 3]> = Vec::new();
        let mut start = beam.hub_radius_m;
        for (piece, &end) in beam.pieces.iter().zip(ends_m) {
            let (low, high) = (start.max(from_m), end.min(to_m));
            if high > low && piece.mass_per_length_kg_per_m > 0.0 {
                let (length, mass) = (high - low, piece.mass_per_length_kg_per_m * (high - low));
                parts.push([mass, 0.5 * (low + high), mass * length * length / 12.0]);
            }
            let here = (end > from_m && end < to_m) || (number == last && end >= to_m);
            if here && piece.end_mass_kg > 0.0 {
                parts.push([piece.end_mass_kg, end, 0.0]);
            }
            start = end;
        }
        let payload = beam.payload;
        if number == last && (payload.mass_kg > 0.0 || payload.inertia_kg_m2 > 0.0) {
            parts.push([payload.mass_kg, tip + payload.offset_m, payload.inertia_kg_m2]);
        }
        let mass_kg: f64 = parts.iter().map(|p| p[0]).sum();
        let moment: f64 = parts.iter().map(|p| p[0] * p[1]).sum();
        let centre_m = if mass_kg > 0.0 { moment / mass_kg } else { from_m };
        let about = |p: &[f64; 3]| p[0] * (p[1] - centre_m).powi(2) + p[2];
        let inertia_kg_m2 = parts.iter().map(about).sum();
        Segment { from_m, to_m, mass_kg, centre_m, inertia_kg_m2 }
    };
    inner.zip(outer).enumerate().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lissom_core::beam::Span;

    /// Rounding of sums over a chain \[1\].
    const ROUNDING: f64 = 1e-12;

    #[test]
    fn the_hinges_have_the_exact_flexibility_matrix_of_the_masses() {
        let span = |length, rigidity| Span::new(length, rigidity).mass_kg(0.3);
        let spans = [span(0.4, 3.0), span(0.7, 1.0), span(0.2, 8.0)];
        let beam = LumpedBeam::new(&spans).unwrap().with_hub_radius(0.1).unwrap();
        let chain = HingeChain::of_lumped(&beam, 1e-3);
        for load in 0..3 {
            let mut forces = [0.0; 3];
            forces[load] = 1.0;
            let shape = beam.shape_under(&forces, 0.0);
            for &x in beam.position_m() {
                let a = beam.position_m()[load];
                let arm = |h: &Hinge, x: f64| (x - h.at_m).max(0.0);
                let bent = chain.hinges.iter();
                let y: f64 = bent.map(|h| arm(h, x) * arm(h, a) / h.stiffness_nm_per_rad).sum();
                assert!((y / shape.deflection_m(x) - 1.0).abs() < ROUNDING, "{load} {x}");
            }
        }
    }

    #[test]
    fn mass_and_inertia_of_the_segments_are_those_of_the_beam() {
        let piece = |length_m, end_mass_kg| Piece {
            length_m,
            flexural_rigidity_n_m2: 2.0,
            mass_per_length_kg_per_m: 0.4,
            end_mass_kg,
            end_damping_n_s_per_m: 0.0,
        };
        let payload = Payload { mass_kg: 0.2, inertia_kg_m2: 1e-3, offset_m: 0.05 };
        let beam = DistributedBeam::new(&[piece(0.3, 0.1), piece(0.2, 0.0)]).unwrap();
        let beam = beam.with_hub_radius(0.05).unwrap().with_payload(payload).unwrap();
        let chain = HingeChain::of_distributed(&beam, 1e-3);
        let mass: f64 = chain.segments.iter().map(|s| s.mass_kg).sum();
        let about = |s: &Segment| s.mass_kg * s.centre_m * s.centre_m + s.inertia_kg_m2;
        let inertia: f64 = chain.segments.iter().map(about).sum();
        assert!((mass / (0.4 * 0.5 + 0.1 + 0.2) - 1.0).abs() < ROUNDING);
        assert!((inertia / beam.inertia_kg_m2() - 1.0).abs() < ROUNDING);
    }

    #[test]
    fn modal_ratios_are_those_of_the_modes() {
        let span = Span::new(0.3, 2.0).mass_kg(0.2);
        let ratios = [0.01, 0.03, 0.02];
        let damping = Damping::Modal { ratios: ratios.to_vec() };
        let beam = LumpedBeam::new(&[span, span, span]).unwrap().with_damping(damping).unwrap();
        let chain = HingeChain::of_lumped(&beam, 1e-3);
        let omega = beam.natural_frequencies_rad_s();
        let least = 2.0 * (0.01 / omega[0]).min(0.03 / omega[1]).min(0.02 / omega[2]);
        // The limit of the frequencies changes the highest by 0.13 %.
        assert!((chain.damping_s / least - 1.0).abs() < 2e-3, "{} {least}", chain.damping_s);
        assert_eq!(chain.dampers.len(), 2);
    }
}
