//! Signals in continuous time with known Taylor coefficients: torques and loads at the tip.

use super::RigError;
use crate::lti::first_root::ORDER_MOST;

/// A sine, `amplitude·sin(ω·t + phase)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// Amplitude, in the unit of the signal.
    pub amplitude: f64,
    /// ω \[rad/s\].
    pub omega_rad_s: f64,
    /// Phase at t = 0 \[rad\].
    pub phase_rad: f64,
}

/// A quantity as a function of time, for example a torque \[N·m\] or a force \[N\].
///
/// ```
/// use lissom::rig::Signal;
/// let push = Signal::steps(&[(0.0, 0.0), (1.0, 0.2)])?; // 0.2 from 1 s on
/// assert_eq!((push.at(0.5), push.at(1.5)), (0.0, 0.2));
/// # Ok::<(), lissom::rig::RigError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Signal(Kind);

#[derive(Debug, Clone, PartialEq)]
enum Kind {
    Constant(f64),
    /// Times, values from each on, slopes after it.
    Table(Vec<[f64; 3]>),
    Harmonics(Vec<Harmonic>),
}

impl Default for Signal {
    fn default() -> Self {
        Self(Kind::Constant(0.0))
    }
}

impl Signal {
    /// A constant signal.
    ///
    /// # Errors
    /// [`RigError::NotFinite`] if the value is not finite.
    pub fn constant(value: f64) -> Result<Self, RigError> {
        finite("value of a signal", value)?;
        Ok(Self(Kind::Constant(value)))
    }

    /// A table of (time \[s\], value). Each value is constant until the next time; before the first time the signal has
    /// the first value.
    ///
    /// # Errors
    /// [`RigError`] for an empty table, times that do not increase, or numbers that are not finite.
    pub fn steps(table: &[(f64, f64)]) -> Result<Self, RigError> {
        check(table)?;
        Ok(Self(Kind::Table(table.iter().map(|&(t, v)| [t, v, 0.0]).collect())))
    }

    /// A table of (time \[s\], value), joined by straight lines. Before the first and after the
    /// last time the signal is constant.
    ///
    /// # Errors
    /// Those of [`steps`](Self::steps).
    pub fn lines(table: &[(f64, f64)]) -> Result<Self, RigError> {
        check(table)?;
        let slope = |k: usize| match table.get(k + 1) {
            Some(next) => (next.1 - table[k].1) / (next.0 - table[k].0),
            None => 0.0,
        };
        Ok(Self(Kind::Table(
            table.iter().enumerate().map(|(k, &(t, v))| [t, v, slope(k)]).collect(),
        )))
    }

    /// A sum of sines.
    ///
    /// # Errors
    /// [`RigError::NotFinite`] if a number is not finite.
    pub fn harmonics(sines: &[Harmonic]) -> Result<Self, RigError> {
        for s in sines {
            finite("amplitude of a sine", s.amplitude)?;
            finite("omega_rad_s", s.omega_rad_s)?;
            finite("phase_rad", s.phase_rad)?;
        }
        Ok(Self(Kind::Harmonics(sines.to_vec())))
    }

    /// Whether the signal is zero at all times.
    pub fn is_zero(&self) -> bool {
        match &self.0 {
            Kind::Constant(value) => *value == 0.0,
            Kind::Table(rows) => rows.iter().all(|row| row[1] == 0.0),
            Kind::Harmonics(sines) => sines.iter().all(|s| s.amplitude == 0.0),
        }
    }

    /// Value at `time_s`.
    pub fn at(&self, time_s: f64) -> f64 {
        let mut c = [0.0; ORDER_MOST + 1];
        self.add_taylor(time_s, &mut c);
        c[0]
    }

    /// The next time after `time_s` at which it is not smooth.
    pub(super) fn next_break_s(&self, time_s: f64) -> Option<f64> {
        let Kind::Table(rows) = &self.0 else { return None };
        rows.get(rows.partition_point(|row| row[0] <= time_s)).map(|row| row[0])
    }

    /// A bound on its own rates \[1/s\].
    pub(super) fn rate_rad_s(&self) -> f64 {
        let Kind::Harmonics(sines) = &self.0 else { return 0.0 };
        sines.iter().fold(0.0, |m, s| m.max(s.omega_rad_s.abs()))
    }

    /// Adds its Taylor coefficients about `time_s`, valid to the next break.
    pub(super) fn add_taylor(&self, time_s: f64, out: &mut [f64; ORDER_MOST + 1]) {
        match &self.0 {
            Kind::Constant(value) => out[0] += value,
            Kind::Table(rows) => {
                let at = rows.partition_point(|row| row[0] <= time_s);
                let Some([t, value, slope]) = at.checked_sub(1).and_then(|k| rows.get(k)) else {
                    out[0] += rows[0][1];
                    return;
                };
                out[0] += value + slope * (time_s - t);
                out[1] += slope;
            }
            Kind::Harmonics(sines) => {
                for s in sines {
                    let (sine, cosine) = (s.omega_rad_s * time_s + s.phase_rad).sin_cos();
                    let mut factor = s.amplitude;
                    for (k, c) in out.iter_mut().enumerate() {
                        *c += factor * [sine, cosine, -sine, -cosine][k % 4];
                        factor *= s.omega_rad_s / (k as f64 + 1.0);
                    }
                }
            }
        }
    }
}

fn finite(quantity: &'static str, found: f64) -> Result<(), RigError> {
    if found.is_finite() { Ok(()) } else { Err(RigError::NotFinite { quantity, found }) }
}

fn check(table: &[(f64, f64)]) -> Result<(), RigError> {
    if table.is_empty() {
        return Err(RigError::EmptyTable);
    }
    for (row, &(t, v)) in table.iter().enumerate() {
        finite("time of a table", t)?;
        finite("value of a table", v)?;
        if row > 0 && t <= table[row - 1].0 {
            return Err(RigError::TableOrder { row, before_s: table[row - 1].0, after_s: t });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn summed(signal: &Signal, from: f64, t: f64) -> f64 {
        let mut c = [0.0; ORDER_MOST + 1];
        signal.add_taylor(from, &mut c);
        crate::lti::first_root::value(&c, t)
    }

    #[test]
    fn series_give_the_signal() {
        let sine = Harmonic { amplitude: 2.0, omega_rad_s: 3.0, phase_rad: 0.4 };
        let signal = Signal::harmonics(&[sine]).unwrap();
        let exact = 2.0 * (3.0 * 0.9_f64 + 0.4).sin();
        assert!((summed(&signal, 0.7, 0.2) - exact).abs() < 1e-14);
        let lines = Signal::lines(&[(1.0, 2.0), (3.0, 6.0)]).unwrap();
        assert!((summed(&lines, 1.5, 0.5) - 4.0).abs() < 1e-15);
        assert_eq!((lines.at(0.0), lines.at(9.0)), (2.0, 6.0));
        assert_eq!((lines.next_break_s(0.0), lines.next_break_s(1.0)), (Some(1.0), Some(3.0)));
        assert_eq!(lines.next_break_s(3.0), None);
    }

    #[test]
    fn bad_tables_are_refused() {
        assert_eq!(Signal::steps(&[]), Err(RigError::EmptyTable));
        let back = Signal::lines(&[(0.0, 1.0), (0.0, 2.0)]);
        assert_eq!(back, Err(RigError::TableOrder { row: 1, before_s: 0.0, after_s: 0.0 }));
        assert!(Signal::constant(f64::NAN).is_err());
        assert!(Signal::steps(&[(0.0, f64::INFINITY)]).is_err());
    }
}
