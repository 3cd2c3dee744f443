//! What the values of a channel show by themselves.

/// Values that are looked at for the resolution.
const LOOKED_AT: usize = 50_000;
/// A channel has a step if so many of its values differ at least, …
const DISTINCT: usize = 8;
/// … and its range has at most so many steps.
const MOST_STEPS: f64 = 2e6;
/// A difference may be off a multiple of the step by this share of the step.
const OFF_MULTIPLE: f64 = 0.1;
/// Samples before and after a jump in which an angle moves.
const NEAR: usize = 3;
/// A channel jumps by a turn if it changes by more than this share of its range, …
const JUMP: f64 = 0.8;
/// … where it usually changes by less than this share.
const CALM: f64 = 0.05;
/// Share of values at an end of the range that is reported, with a run of so many in sequence.
const AT_END: (f64, usize) = (0.02, 10);

/// What the values of a channel show by themselves, in the unit of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct ChannelFacts {
    /// Number of values.
    pub values: usize,
    /// Number of values that are missing, among them.
    pub missing: usize,
    /// Smallest and largest value.
    pub range: [f64; 2],
    /// Smallest difference of two values, of which all differences are multiples: the step of an encoder or converter.
    pub step: Option<f64>,
    /// Whether the value never changes.
    pub constant: bool,
    /// Share of the values that are equal to the smallest, or to the largest, for long: a limit, or a rest.
    pub at_end_share: [Option<f64>; 2],
    /// Number of jumps by about the whole range: an angle that starts again after a turn.
    pub wraps: usize,
}

impl ChannelFacts {
    /// Those of some values; NaN are missing ones.
    pub(super) fn of(values: &[f64]) -> Self {
        let present: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        let low = present.iter().copied().fold(f64::INFINITY, f64::min);
        let high = present.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let range = if present.is_empty() { [f64::NAN; 2] } else { [low, high] };
        let constant = high <= low;
        Self {
            values: values.len(),
            missing: values.len() - present.len(),
            range,
            step: (!constant).then(|| step(&present, high - low)).flatten(),
            constant,
            at_end_share: if constant {
                [None; 2]
            } else {
                [at_end(&present, low), at_end(&present, high)]
            },
            wraps: if constant { 0 } else { wraps(&present, high - low) },
        }
    }

    /// Bits of the range in steps, rounded up.
    pub fn bits(&self) -> Option<u32> {
        let steps = (self.range[1] - self.range[0]) / self.step?;
        // At most log2 of `MOST_STEPS`.
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "small and positive"
        )]
        let bits = (steps + 1.0).log2().ceil() as u32;
        Some(bits)
    }
}

fn step(present: &[f64], range: f64) -> Option<f64> {
    let mut sorted = present[..present.len().min(LOOKED_AT)].to_vec();
    sorted.sort_by(f64::total_cmp);
    let rounding = 1e-9 * range;
    let mut gaps: Vec<f64> =
        sorted.windows(2).map(|w| w[1] - w[0]).filter(|gap| *gap > rounding).collect();
    if gaps.len() + 1 < DISTINCT {
        return None;
    }
    // From the smallest gap on, each gap makes the step more precise.
    gaps.sort_by(f64::total_cmp);
    let (mut sum, mut count) = (gaps[0], 1.0);
    for gap in &gaps[1..] {
        let steps = gap * count / sum;
        if (steps - steps.round()).abs() > OFF_MULTIPLE {
            return None;
        }
        sum += gap;
        count += steps.round();
    }
    let step = sum / count;
    (range / step <= MOST_STEPS).then_some(step)
}

fn at_end(present: &[f64], end: f64) -> Option<f64> {
    let (mut count, mut streak, mut longest) = (0_usize, 0, 0);
    for value in present {
        let same = (value - end).abs() <= 0.0;
        streak = if same { streak + 1 } else { 0 };
        longest = longest.max(streak);
        count += usize::from(same);
    }
    let share = count as f64 / present.len() as f64;
    (share > AT_END.0 && longest >= AT_END.1).then_some(share)
}

fn wraps(present: &[f64], range: f64) -> usize {
    let mut changes: Vec<f64> = present.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
    // Before and after the jump of an angle it moves against the jump; a square wave rests.
    let goes_on = |k: usize| {
        let jump = present[k + 1] - present[k];
        let before = present[k] - present[k.saturating_sub(NEAR)];
        let after = present[(k + 1 + NEAR).min(present.len() - 1)] - present[k + 1];
        before * jump < 0.0 && after * jump < 0.0
    };
    let jumps = (0..changes.len()).filter(|k| changes[*k] > JUMP * range && goes_on(*k)).count();
    if jumps == 0 || 20 * jumps > changes.len() {
        return 0;
    }
    changes.sort_by(f64::total_cmp);
    let usual = changes[changes.len() * 9 / 10];
    if usual < CALM * range { jumps } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_encoder_has_a_step_and_wraps() {
        let angle = |k: i32| (f64::from(k) * 7.3).rem_euclid(4096.0).floor() * 0.087_890_625;
        let facts = ChannelFacts::of(&(0..4000).map(angle).collect::<Vec<_>>());
        assert!((facts.step.unwrap() - 0.087_890_625).abs() < 1e-9, "{facts:?}");
        assert_eq!(facts.bits(), Some(12));
        assert_eq!(facts.wraps, 7);
    }

    #[test]
    fn a_square_wave_does_not_wrap() {
        let square = |k: i32| if (k / 500) % 2 == 0 { 1.0 } else { -1.0 };
        assert_eq!(ChannelFacts::of(&(0..4000).map(square).collect::<Vec<_>>()).wraps, 0);
    }

    #[test]
    fn a_limit_a_dead_channel_and_missing_values() {
        let clipped = |k: i32| (f64::from(k) * 0.01).sin().min(0.5);
        let facts = ChannelFacts::of(&(0..4000).map(clipped).collect::<Vec<_>>());
        assert!(facts.at_end_share[1].unwrap() > 0.3 && facts.at_end_share[0].is_none());
        assert!(facts.step.is_none(), "{facts:?}");
        let dead = ChannelFacts::of(&[2.0, 2.0, f64::NAN]);
        assert!(dead.constant && dead.missing == 1);
        let nothing = ChannelFacts::of(&[f64::NAN; 3]);
        assert!(nothing.constant && nothing.range[0].is_nan());
    }
}
