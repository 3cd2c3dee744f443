//! Lumped arms on the way to a distributed one: three beams, two ways to lump them, and the
//! properties by which arms are compared. Beams of length, mass per length and rigidity one.

use lissom::beam::{Base, BeamError, DistributedBeam, LumpedBeam, Payload, Piece};
use num_complex::Complex64;

fn piece(length_m: f64, flexural_rigidity_n_m2: f64, mass_per_length_kg_per_m: f64) -> Piece {
    Piece {
        length_m,
        flexural_rigidity_n_m2,
        mass_per_length_kg_per_m,
        end_mass_kg: 0.0,
        end_damping_n_s_per_m: 0.0,
    }
}

/// A uniform cantilever: 1 m, 1 kg/m, EI 1 N·m².
///
/// # Panics
/// Never: the numbers make a beam.
#[expect(clippy::expect_used, reason = "a test model")]
pub fn cantilever() -> DistributedBeam {
    DistributedBeam::new(&[piece(1.0, 1.0, 1.0)]).expect("a beam")
}

/// The [`cantilever`] on a hub of 0.1 m, with a point mass of 0.5 kg at its tip.
///
/// # Panics
/// Never: the numbers make a beam.
#[expect(clippy::expect_used, reason = "a test model")]
pub fn hub_and_tip_mass() -> DistributedBeam {
    let load = Payload { mass_kg: 0.5, ..Payload::default() };
    let beam = cantilever().with_hub_radius(0.1).and_then(|b| b.with_payload(load));
    beam.expect("a beam")
}

/// 1 m whose outer half has a quarter of the rigidity and half of the mass per length.
///
/// # Panics
/// Never: the numbers make a beam.
#[expect(clippy::expect_used, reason = "a test model")]
pub fn stepped() -> DistributedBeam {
    DistributedBeam::new(&[piece(0.5, 1.0, 1.0), piece(0.5, 0.25, 0.5)]).expect("a beam")
}

/// Where a span's mass goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Masses {
    /// Half to each end: [`DistributedBeam::lumped`].
    BothEnds,
    /// All of it to the outer end.
    OuterEnds,
}

/// A lumped arm, and what of its beam does not bend.
#[derive(Debug, Clone, PartialEq)]
pub struct LumpedArm {
    /// The arm.
    pub beam: LumpedBeam,
    /// Inertia of the half mass at the clamp, which turns with the hub \[kg·m²\].
    pub clamp_inertia_kg_m2: f64,
}

impl LumpedArm {
    /// The arm of `count` masses, or a few more, in equal spans on each piece.
    ///
    /// # Errors
    /// [`BeamError`] where the masses make no beam.
    pub fn new(beam: &DistributedBeam, count: usize, masses: Masses) -> Result<Self, BeamError> {
        if masses == Masses::OuterEnds {
            let beam = masses_at_outer_ends(beam, count)?;
            return Ok(Self { beam, clamp_inertia_kg_m2: 0.0 });
        }
        let arm = beam.lumped(count)?;
        let half = 0.5 * beam.pieces()[0].mass_per_length_kg_per_m * arm.spans()[0].length_m;
        let clamp_inertia_kg_m2 = half * beam.hub_radius_m().powi(2);
        Ok(Self { beam: arm, clamp_inertia_kg_m2 })
    }

    /// C_t/θ_m at `omega_rad_s`, the half mass at the clamp with it \[N·m/rad\].
    fn coupling_nm_per_rad(&self, omega_rad_s: f64) -> f64 {
        let torque = self.beam.response(Complex64::new(0.0, omega_rad_s)).coupling_nm_per_rad.re;
        torque - omega_rad_s.powi(2) * self.clamp_inertia_kg_m2
    }
}

fn masses_at_outer_ends(beam: &DistributedBeam, count: usize) -> Result<LumpedBeam, BeamError> {
    let halves = beam.lumped(count)?;
    let mut spans = halves.spans().to_vec();
    let mut first = 0;
    for piece in beam.pieces() {
        let cells = (piece.length_m / spans[first].length_m).round() as usize;
        let mass_kg = piece.mass_per_length_kg_per_m * spans[first].length_m;
        spans[first..first + cells].iter_mut().for_each(|span| span.mass_kg = mass_kg);
        first += cells;
        spans[first - 1].mass_kg += piece.end_mass_kg;
    }
    LumpedBeam::new(&spans)?.with_hub_radius(beam.hub_radius_m())?.with_payload(*beam.payload())
}

/// How many frequencies, zeros and torques are compared.
pub const EACH: usize = 3;

/// What an arm is compared by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Properties {
    /// The first natural frequencies with the motor clamped \[rad/s\].
    pub frequencies_rad_s: [f64; EACH],
    /// The first zeros of the tip, the positive s of each pair \[1/s\].
    pub zeros_per_s: [f64; EACH],
    /// C_t/θ_m at [`coupling_omega_rad_s`] of the distributed beam \[N·m/rad\].
    pub coupling_nm_per_rad: [f64; EACH],
    /// The inertia about the axis: C_t/(s²·θ_m) towards s = 0 \[kg·m²\].
    pub inertia_kg_m2: f64,
}

impl Properties {
    /// Those of the distributed beam, which carries no rotary inertia.
    pub fn of_distributed(beam: &DistributedBeam) -> Self {
        let frequencies_rad_s = first(&beam.frequencies_rad_s(Base::Clamped, EACH));
        // Zeros of class b lie as far apart as frequencies; the third is below the fifth of these.
        let beyond = beam.frequencies_rad_s(Base::Clamped, EACH + 2)[EACH + 1];
        let zeros = beam.zeros_below(beam.length_m(), beyond);
        let zeros: Vec<f64> =
            zeros.iter().flat_map(|found| &found.z).map(|z| z.re.sqrt()).collect();
        let torque = |w: f64| beam.response(Complex64::new(0.0, w)).coupling_nm_per_rad.re;
        Self {
            frequencies_rad_s,
            zeros_per_s: first(&zeros),
            coupling_nm_per_rad: coupling_omega_rad_s(&frequencies_rad_s).map(torque),
            inertia_kg_m2: beam.inertia_kg_m2(),
        }
    }

    /// Those of a lumped arm of that beam, which has the properties `exact`.
    pub fn of_lumped(arm: &LumpedArm, exact: &Self) -> Self {
        let omega = coupling_omega_rad_s(&exact.frequencies_rad_s);
        Self {
            frequencies_rad_s: first(&arm.beam.frequencies_rad_s(Base::Clamped, EACH)),
            zeros_per_s: first_tip_zeros(&arm.beam, exact.zeros_per_s[0]),
            coupling_nm_per_rad: omega.map(|w| arm.coupling_nm_per_rad(w)),
            inertia_kg_m2: arm.beam.inertia_kg_m2() + arm.clamp_inertia_kg_m2,
        }
    }

    /// All of them in the order of the fields.
    pub fn all(&self) -> Vec<f64> {
        let lists = [self.frequencies_rad_s, self.zeros_per_s, self.coupling_nm_per_rad];
        lists.into_iter().flatten().chain([self.inertia_kg_m2]).collect()
    }

    /// Relative differences from `exact`, with their sign, in the order of [`all`](Self::all).
    pub fn errors(&self, exact: &Self) -> Vec<f64> {
        self.all().iter().zip(exact.all()).map(|(found, e)| found / e - 1.0).collect()
    }
}

/// Where torques are compared: below the first frequency, and between it and the next ones.
pub fn coupling_omega_rad_s(frequencies_rad_s: &[f64; EACH]) -> [f64; EACH] {
    let [first, second, third] = *frequencies_rad_s;
    [0.5 * first, (first * second).sqrt(), (second * third).sqrt()]
}

/// The order of convergence: the slope of ln |error| over ln n, by least squares, sign turned.
pub fn order(counts: &[usize], errors: &[f64]) -> f64 {
    let x: Vec<f64> = counts.iter().map(|n| (*n as f64).ln()).collect();
    let y: Vec<f64> = errors.iter().map(|e| e.abs().ln()).collect();
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (at_x, at_y) = (mean(&x), mean(&y));
    let both: f64 = x.iter().zip(&y).map(|(x, y)| (x - at_x) * (y - at_y)).sum();
    -both / x.iter().map(|x| (x - at_x).powi(2)).sum::<f64>()
}

fn first(values: &[f64]) -> [f64; EACH] {
    std::array::from_fn(|k| values.get(k).copied().unwrap_or(f64::NAN))
}

/// Steps of the search for zeros, as a ratio, and how many at most.
const STEP: f64 = 1.08;
const STEPS_MOST: usize = 120;
/// Halvings of an interval: to rounding.
const HALVINGS: usize = 60;

/// The first zeros of the tip on the real axis, as changes of sign of θ_n/θ_m at real s.
fn first_tip_zeros(beam: &LumpedBeam, near: f64) -> [f64; EACH] {
    let tip = beam.len() - 1;
    let positive = |s: f64| beam.response(Complex64::new(s, 0.0)).angles[tip].re > 0.0;
    let (mut low, mut side, mut found) = (0.5 * near, positive(0.5 * near), Vec::new());
    for _ in 0..STEPS_MOST {
        let high = STEP * low;
        if positive(high) != side {
            let (mut a, mut b) = (low, high);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (a + b);
                if positive(middle) == side { a = middle } else { b = middle }
            }
            found.push(0.5 * (a + b));
            side = !side;
            if found.len() == EACH {
                break;
            }
        }
        low = high;
    }
    first(&found)
}
