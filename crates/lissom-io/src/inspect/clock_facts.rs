//! What the time stamps of a log show.

/// A step longer than this times the usual one is a gap.
const GAP: f64 = 1.5;

/// What the time stamps of a log show, in the unit of the stamps.
#[derive(Debug, Clone, PartialEq)]
pub struct ClockFacts {
    /// Usual step, the median.
    pub step: f64,
    /// Smallest and largest step.
    pub steps: [f64; 2],
    /// Steps that are more than half longer than the usual one.
    pub gaps: usize,
    /// Stamps that are equal to the one before.
    pub repeated: usize,
    /// Stamps that are earlier than the one before.
    pub back: usize,
    /// From the first to the last stamp.
    pub length: f64,
}

impl ClockFacts {
    /// Those of some stamps; `None` if there are fewer than three or they never grow.
    pub(super) fn of(stamps: &[f64]) -> Option<Self> {
        let present: Vec<f64> = stamps.iter().copied().filter(|t| t.is_finite()).collect();
        let all: Vec<f64> = present.windows(2).map(|w| w[1] - w[0]).collect();
        let mut forward: Vec<f64> = all.iter().copied().filter(|step| *step > 0.0).collect();
        if all.len() < 2 || forward.is_empty() {
            return None;
        }
        forward.sort_by(f64::total_cmp);
        let step = forward[forward.len() / 2];
        Some(Self {
            step,
            steps: [forward[0], forward[forward.len() - 1]],
            gaps: forward.iter().filter(|s| **s > GAP * step).count(),
            repeated: all.iter().filter(|s| s.abs() <= 0.0).count(),
            back: all.iter().filter(|s| **s < 0.0).count(),
            length: present[present.len() - 1] - present[0],
        })
    }

    /// Whether the stamps may be those of a log: almost all grow.
    pub(super) fn grows(&self, stamps: usize) -> bool {
        10 * (self.back + self.repeated) <= 6 * stamps && self.back * 20 <= stamps
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_and_repeated_stamps() {
        let facts = ClockFacts::of(&[0.0, 2.0, 4.0, 4.0, 6.0, 12.0, 14.0]).unwrap();
        assert!((facts.step - 2.0).abs() < 1e-12);
        assert_eq!((facts.gaps, facts.repeated, facts.back), (1, 1, 0));
        assert!(ClockFacts::of(&[1.0, 1.0, 1.0]).is_none());
    }
}
