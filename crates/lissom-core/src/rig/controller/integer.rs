//! PD control in the short integers of the control computer of the 1989 report.

use super::{Controller, Pd, Sensed};
use crate::rig::error::positive;
use crate::rig::{Quantiser, RigError};

/// Length of the integers that hold products.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Word {
    /// 16 bits; "short integer" in the 1989 report.
    Short,
    /// 32 bits; "integer" in the 1989 report.
    Long,
}

impl Word {
    /// Number of bits.
    pub fn bits(self) -> u32 {
        match self {
            Self::Short => 16,
            Self::Long => 32,
        }
    }

    fn most(self) -> i64 {
        (1 << (self.bits() - 1)) - 1
    }

    /// Keeps a number within the word.
    fn saturated(self, value: i64) -> i64 {
        value.clamp(-self.most() - 1, self.most())
    }
}

/// [`Pd`] control in integer arithmetic.
///
/// Angles are counts of the A/D converter, currents counts of the D/A converter. The gains `P` and `D` are integers
/// with b bits after the binary point, and `sat` saturates at the range of a word:
///
/// ```text
/// e_k = sat(r_k − y_k)       d_k = sat(e_k − e_{k−1})
/// u_k = sat(sat(P·e_k) + sat(D·d_k)) >> b        i_k = u_k counts of the D/A, within its range
/// ```
///
/// The shift is the arithmetic shift of the MC 68000: it rounds towards −∞.
///
/// # Source
/// `[Feliu1989, Section 6.1]`: "real-time computations were done in integer or short integer mode". The source gives no
/// details. Saturation instead of overflow is usual in such code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntegerPd {
    input: Quantiser,
    output: Quantiser,
    word: Word,
    binary_point: u32,
    proportional: i64,
    derivative: i64,
    before: Option<i64>,
    memory_s: f64,
}

impl IntegerPd {
    /// Rounds the gains of a [`Pd`] that acts every `period_s` \[s\] to integers. A
    /// filter of the derivative is ignored.
    ///
    /// `input` is the A/D converter of the motor's angle \[rad\], `output` the D/A converter \[A\]. The gains are
    /// `P = k_p·s·2^b` and `D = k_d/T·s·2^b`, with s the step of the input over the step of the output.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] for the period; [`RigError::BinaryPoint`] for more bits after the binary point than a
    /// word has; [`RigError::Gain`] if a gain does not fit into the word.
    pub fn new(
        pd: &Pd,
        period_s: f64,
        input: Quantiser,
        output: Quantiser,
        word: Word,
        binary_point: u32,
    ) -> Result<Self, RigError> {
        positive("period_s", period_s)?;
        if binary_point >= word.bits() {
            return Err(RigError::BinaryPoint { found: binary_point, most: word.bits() - 1 });
        }
        let scale = input.step() / output.step() * f64::from(binary_point).exp2();
        let gain = |quantity, gain: f64| {
            let (found, most) = ((gain * scale).round(), word.most() as f64);
            if found <= most {
                Ok(found as i64)
            } else {
                Err(RigError::Gain { quantity, found, most })
            }
        };
        Ok(Self {
            input,
            output,
            word,
            binary_point,
            proportional: gain("the proportional gain", pd.proportional_a_per_rad())?,
            derivative: gain("the derivative gain", pd.derivative_a_s_per_rad() / period_s)?,
            before: None,
            memory_s: pd.memory_s(),
        })
    }

    /// P and D, in D/A counts per A/D count times `2^b`.
    pub fn gains(&self) -> (i64, i64) {
        (self.proportional, self.derivative)
    }

    /// Computes the D/A count from the counts of reference and motor.
    pub fn output_count(&mut self, reference: i64, motor: i64) -> i64 {
        let sat = |value: i64| self.word.saturated(value);
        // Counts of 64 bits may be anything; a difference of two words cannot overflow.
        let error = sat(sat(reference) - sat(motor));
        let change = sat(error - self.before.unwrap_or(error));
        let sum = sat(sat(self.proportional * error) + sat(self.derivative * change));
        self.before = Some(error);
        sum >> self.binary_point
    }
}

impl Controller for IntegerPd {
    fn current_a(&mut self, now: &Sensed<'_>) -> f64 {
        let reference = (now.reference_rad / self.input.step()).round() as i64;
        let motor = self.input.count(now.motor_rad);
        let count = self.output_count(reference, motor);
        self.output.value(count)
    }

    fn reset(&mut self) {
        self.before = None;
    }

    fn memory_s(&self) -> f64 {
        self.memory_s
    }
}
