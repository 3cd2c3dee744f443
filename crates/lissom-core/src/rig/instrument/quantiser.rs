//! Converters that round to steps.

use crate::rig::RigError;
use crate::rig::error::positive;

/// A converter between a value and counts.
///
/// `count = round(value/step)`, limited to the range if there is one; half a step is rounded away from zero.
///
/// ```
/// # use lissom::rig::Quantiser;
/// let converter = Quantiser::new(3, 8.0)?; // counts −4 to 3, steps of 1
/// assert_eq!((converter.read(1.4), converter.read(9.0), converter.read(-9.0)), (1.0, 3.0, -4.0));
/// assert_eq!(Quantiser::encoder(4)?.count(std::f64::consts::TAU * 10.0), 40);
/// # Ok::<(), lissom::rig::RigError>(())
/// ```
///
/// # Source
/// `[Feliu1989, Section 6.1]`: 12-bit A/D and D/A boards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantiser {
    step: f64,
    /// Lowest and highest count.
    least: f64,
    most: f64,
}

impl Quantiser {
    /// An A/D or D/A converter with `bits` bits over `range`, in the unit of the range, centred at zero.
    ///
    /// The step is `range/2^bits`. Counts are in two's complement, from `−2^(bits−1)` to
    /// `2^(bits−1) − 1`, and saturate there.
    ///
    /// # Errors
    /// [`RigError`] unless the range is positive and there are 1 to 32 bits.
    pub fn new(bits: u32, range: f64) -> Result<Self, RigError> {
        positive("range of a converter", range)?;
        if !(1..=32).contains(&bits) {
            return Err(RigError::Bits { found: bits });
        }
        let half = (1_u64 << (bits - 1)) as f64;
        let step = positive("step of a converter", range / (2.0 * half))?;
        Ok(Self { step, least: -half, most: half - 1.0 })
    }

    /// An encoder with the given number of counts per turn. It counts over many turns and never saturates.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] for zero counts.
    pub fn encoder(counts_per_turn: u32) -> Result<Self, RigError> {
        let counts = positive("counts_per_turn", f64::from(counts_per_turn))?;
        Ok(Self {
            step: std::f64::consts::TAU / counts,
            least: f64::NEG_INFINITY,
            most: f64::INFINITY,
        })
    }

    /// Value after rounding and limiting.
    pub fn read(&self, value: f64) -> f64 {
        (value / self.step).round().clamp(self.least, self.most) * self.step
    }

    /// Count of a value; 0 for NaN.
    pub fn count(&self, value: f64) -> i64 {
        (value / self.step).round().clamp(self.least, self.most) as i64
    }

    /// Value of a count, limited to the range.
    pub fn value(&self, count: i64) -> f64 {
        (count as f64).clamp(self.least, self.most) * self.step
    }

    /// Step, in the unit of the range.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Lowest and highest value; infinite for an encoder.
    pub fn ends(&self) -> (f64, f64) {
        (self.least * self.step, self.most * self.step)
    }

    /// Whether a value is outside the range.
    pub fn exceeded(&self, value: f64) -> bool {
        let count = (value / self.step).round();
        count < self.least || count > self.most
    }
}
