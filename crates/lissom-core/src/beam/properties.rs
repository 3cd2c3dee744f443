//! The properties of Section 3 of the 1989 report, as checks that run on a beam.

use nalgebra::DMatrix;
use num_complex::Complex64;

use super::{BeamError, Damping, LumpedBeam, RootClass, Zeros};

/// The result of checking one property.
#[derive(Debug, Clone, PartialEq)]
pub struct Property {
    /// Short name.
    pub name: &'static str,
    /// The statement that is checked.
    pub statement: &'static str,
    /// The measured value; the note says how it was measured.
    pub measured: f64,
    /// Largest value at which the property holds (smallest value, for a degree).
    pub bound: f64,
    /// Whether the property holds.
    pub holds: bool,
    /// How it was measured; if it does not hold, the reason.
    pub note: String,
}

impl Property {
    fn at_most(
        name: &'static str,
        statement: &'static str,
        measured: f64,
        bound: f64,
        note: impl Into<String>,
    ) -> Self {
        Self { name, statement, measured, bound, holds: measured <= bound, note: note.into() }
    }

    /// Of a law of every beam: where it seems broken, the check is.
    fn or_lost_in_rounding(mut self) -> Self {
        if !self.holds {
            self.note.push_str(
                ". This is a law of every beam: masses or spans that differ by so many orders \
                 leave the check no digits",
            );
        }
        self
    }
}

/// Largest number of masses for which the checks run: some of them solve dense systems.
pub const MOST_CHECKED: usize = 200;

/// Estimates that are exact but for rounding.
const ROUNDING: f64 = 1e-12;
/// Against dense solvers, whose error grows with the spread of frequencies.
const DENSE: f64 = 1e-6;

/// Checks the properties of Section 3 of the 1989 report on this beam, without damping.
///
/// Each property is measured by a computation in which it is not built in: dense eigenvalues are compared
/// with counted frequencies, equation (13) with the recursion, and the zeros of this beam with those of
/// the beam with another payload.
///
/// # Source
/// `[Feliu1989, Section 3]`
///
/// # Errors
/// [`BeamError::TooManyMasses`] above [`MOST_CHECKED`]; [`BeamError::OutOfRange`] if an element of a matrix leaves the
/// range of a double.
pub fn properties(beam: &LumpedBeam) -> Result<Vec<Property>, BeamError> {
    if beam.len() > MOST_CHECKED {
        return Err(BeamError::TooManyMasses { found: beam.len(), most: MOST_CHECKED });
    }
    let beam = undamped(beam)?;
    let frequencies = beam.natural_frequencies_rad_s();
    let highest = frequencies[frequencies.len() - 1];
    let tip = beam.len() - 1;
    let zeros = beam.zeros(tip).unwrap_or(Zeros { z: Vec::new(), missing: 0 });
    Ok(vec![
        poles_on_the_axis(&beam, &frequencies)?,
        relative_degree(&beam, highest),
        separation(&beam, &frequencies)?,
        zeros_stand(&beam, &zeros)?,
        tip_loads(&beam)?,
        rigid_turn(&beam)?,
        classes(&beam, &zeros),
    ])
}

fn undamped(beam: &LumpedBeam) -> Result<LumpedBeam, BeamError> {
    let mut spans = beam.spans().to_vec();
    for span in &mut spans {
        span.damping_n_s_per_m = 0.0;
    }
    LumpedBeam::new(&spans)?
        .with_hub_radius(beam.hub_radius_m())?
        .with_payload(*beam.payload())?
        .with_damping(Damping::None)
}

fn poles_on_the_axis(beam: &LumpedBeam, frequencies: &[f64]) -> Result<Property, BeamError> {
    let dynamics = beam.dynamics()?;
    let k = dynamics.len();
    let state = DMatrix::from_fn(2 * k, 2 * k, |i, j| match (i < k, j < k) {
        (true, false) if j - k == i => 1.0,
        (false, true) => dynamics.elastic[(i - k, j)],
        _ => 0.0,
    });
    let highest = frequencies[frequencies.len() - 1];
    let values = state.complex_eigenvalues();
    let off = values.iter().map(|s| s.re.abs()).fold(0.0, f64::max) / highest;
    Ok(Property::at_most(
        "even powers",
        "only even powers of s: poles are undamped pairs ±jω (class a)",
        off,
        DENSE,
        "largest real part among the eigenvalues of the dense state matrix, over the highest \
         frequency",
    )
    .or_lost_in_rounding())
}

fn relative_degree(beam: &LumpedBeam, highest: f64) -> Property {
    let at = |factor: f64| beam.response(Complex64::new(0.0, factor * highest)).angles;
    let (near, far) = (at(1e3), at(1e4));
    let fall = near.iter().zip(&far).map(|(a, b)| (a.norm() / b.norm()).log10());
    let least = fall.fold(f64::INFINITY, f64::min);
    Property {
        name: "relative degree",
        statement: "two more poles than zeros at least: no point moves at once with the motor",
        measured: least,
        bound: 2.0,
        holds: least > 2.0 - 1e-4,
        note: "decades that the slowest falling response falls per decade of frequency, at 1000 \
               times the highest natural frequency"
            .to_owned(),
    }
}

fn separation(beam: &LumpedBeam, frequencies: &[f64]) -> Result<Property, BeamError> {
    // The same matrices must explain the motion of arms with other masses.
    let matrices = beam.matrices()?;
    let omega = 0.5 * (frequencies[0] + frequencies.get(1).unwrap_or(&(3.0 * frequencies[0])));
    let mut worst = 0.0_f64;
    for turn in 0..3_usize {
        let mut spans = beam.spans().to_vec();
        for (i, span) in spans.iter_mut().enumerate() {
            span.mass_kg *= [1.0, 3.0, 0.4][(i + turn) % 3];
        }
        let other = LumpedBeam::new(&spans)?.with_hub_radius(beam.hub_radius_m())?;
        let response = other.response(Complex64::new(0.0, omega));
        let theta: Vec<f64> = response.angles.iter().map(|a| a.re).collect();
        for (i, span) in spans.iter().enumerate() {
            let inertial = -span.mass_kg * omega * omega * theta[i];
            let terms = (0..theta.len()).map(|j| matrices.ei_a[(i, j)] * theta[j]);
            let elastic: f64 = terms.clone().sum::<f64>() + matrices.ei_b[i];
            let size: f64 = terms.map(f64::abs).sum::<f64>() + matrices.ei_b[i].abs();
            worst = worst.max((inertial - elastic).abs() / size.max(inertial.abs()));
        }
    }
    Ok(Property::at_most(
        "separation",
        "the masses stand in M alone; EI·A and EI·B are those of the geometry",
        worst,
        1e-9,
        "what (13) leaves, with these matrices, of the recursion's motion of arms with three \
         other sets of masses",
    ))
}

fn zeros_stand(beam: &LumpedBeam, zeros: &Zeros) -> Result<Property, BeamError> {
    let name = "zeros and payload";
    let statement = "the zeros of the tip's response do not depend on the payload";
    let tip = beam.len() - 1;
    let mut worst = 0.0_f64;
    for factor in [0.5, 2.0, 5.0] {
        let other = beam.with_load_times(factor)?;
        for z in &zeros.z {
            // Newton's step from this arm's zero on the other arm's response, centred.
            let at = |z: Complex64| other.response(z.sqrt()).angles[tip];
            let h = 1e-4;
            let slope = (at(z * (1.0 + h)) - at(z * (1.0 - h))) / (2.0 * h);
            worst = worst.max((at(*z) / slope).norm());
        }
    }
    let (bound, note) = (
        1e-9,
        "largest relative step from this arm's zeros to those of the arm with 0.5, 2 and 5 times the payload",
    );
    let note = if beam.payload().turns() {
        format!(
            "{note}. The payload has rotary inertia or an offset: at a zero the tip stands still \
             but turns, so the payload's torque moves the zero. A point mass would not"
        )
    } else {
        note.to_owned()
    };
    let mut property = Property::at_most(name, statement, worst, bound, note);
    property.holds &= zeros.missing == 0;
    Ok(property)
}

fn tip_loads(beam: &LumpedBeam) -> Result<Property, BeamError> {
    // Statics, EI·A·Θ + P·T_n + Q·F_n = 0, with Θ from the bending moments span by span.
    let matrices = beam.matrices()?;
    let n = beam.len();
    let mut worst = 0.0_f64;
    for (force_n, torque_nm, by) in [(1.0, 0.0, &matrices.q), (0.0, 1.0, &matrices.p)] {
        let mut forces_n = vec![0.0; n];
        forces_n[n - 1] = force_n;
        let shape = beam.shape_under(&forces_n, torque_nm);
        let angle = |x: &f64| shape.deflection_m(*x) / x;
        let angles: Vec<f64> = beam.position_m().iter().map(angle).collect();
        for (row, load) in matrices.ei_a.row_iter().zip(by) {
            let terms = row.iter().zip(&angles).map(|(a, angle)| a * angle);
            let (sum, size) =
                terms.fold((*load, load.abs()), |(sum, size), t| (sum + t, size + t.abs()));
            worst = worst.max((sum / size).abs());
        }
    }
    Ok(Property::at_most(
        "tip loads",
        "F_n and T_n act linearly through P and Q; F_n does not stand in (15)",
        worst,
        ROUNDING,
        "what (13) at rest leaves of the shape that such a load bends the beam to, over its terms",
    )
    .or_lost_in_rounding())
}

fn rigid_turn(beam: &LumpedBeam) -> Result<Property, BeamError> {
    let m = beam.matrices()?;
    let mut worst = 0.0_f64;
    for (i, row) in m.ei_a.row_iter().enumerate() {
        let size: f64 = row.iter().map(|v| v.abs()).sum();
        worst = worst.max((row.sum() + m.ei_b[i]).abs() / size);
    }
    let size: f64 = m.h.iter().map(|v| v.abs()).sum();
    worst = worst.max((m.h.sum() + m.h_motor).abs() / size);
    Ok(Property::at_most(
        "rigid turn",
        "turning the arm as one body strains nothing: A·1 + B = 0 and ΣH + h = 0",
        worst,
        ROUNDING,
        "largest of these sums over the sum of their terms' sizes",
    ))
}

fn classes(beam: &LumpedBeam, tip: &Zeros) -> Property {
    let n = beam.len();
    let count =
        |zeros: &Zeros, class: RootClass| zeros.classes().iter().filter(|c| **c == class).count();
    // Mass i (from 1) of a beam without payload: n − i zeros of class a, i − 1 of class b.
    let plain = !beam.payload().turns();
    let expected = |i: usize| (n - i, i - 1);
    let found = |zeros: &Zeros| (count(zeros, RootClass::Imaginary), count(zeros, RootClass::Real));
    let masses = if n <= CLASSES_EACH { 1 } else { n };
    let mut off = 0_usize;
    for i in masses..=n {
        let here = if i == n { Some(tip.clone()) } else { beam.zeros(i - 1) };
        off += usize::from(here.is_none_or(|z| found(&z) != expected(i)));
    }
    let (a, b) = found(tip);
    let c = count(tip, RootClass::Quadruple);
    let phase = if tip.minimum_phase() { "minimum phase" } else { "non-minimum phase" };
    let mut note = format!(
        "number of masses whose zeros are others. The tip has {a} of class a, {b} of class b, {c} of \
         class c: {phase}"
    );
    if !plain {
        note.push_str(
            ". The rule is that of point masses; the payload's rotary inertia adds a zero",
        );
    }
    Property {
        name: "classes of zeros",
        statement: "point masses: the zeros of mass i of n are n − i of class a and i − 1 of class b",
        measured: off as f64,
        bound: 0.0,
        holds: off == 0,
        note,
    }
}

/// Up to this many masses the zeros of each are looked at, beyond it those of the tip.
const CLASSES_EACH: usize = 30;
