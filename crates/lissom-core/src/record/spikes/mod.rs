//! Single wrong readings of a position.

pub(crate) mod thresholds;

use self::thresholds::{SPIKE_AT_END_LEAST, SPIKE_SHAPE, SPIKE_SIZE, SPIKES_REPLACED};
use super::extent::step;

/// A reading that was replaced.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReplacedReading {
    /// Its sample, from 0.
    pub sample: usize,
    /// What it was, in the unit of the channel.
    pub value: f64,
}

/// Replaces readings of a position that differ from both of their neighbours, which agree, by the mean of these.
///
/// A reading is such a spike if its second difference is 20 times what 95 % of the others stay below, and those around it
/// have half of that with the other sign. The first and the last reading are kept, and so are all of them if more than one
/// of a thousand is a spike.
///
/// ```
/// let mut angle_rad: Vec<f64> = (0..500).map(|k| (0.02 * f64::from(k)).sin()).collect();
/// let true_rad = angle_rad[200];
/// angle_rad[200] = 1e3;
/// let replaced = lissom_core::record::replace_spikes(&mut angle_rad);
/// assert_eq!(replaced[0].sample, 200);
/// assert!((angle_rad[200] - true_rad).abs() < 1e-3);
/// ```
pub fn replace_spikes(samples: &mut [f64]) -> Vec<ReplacedReading> {
    let found = spikes(samples);
    let most = (SPIKES_REPLACED * samples.len() as f64).max(1.0);
    if found.len() as f64 > most {
        return Vec::new();
    }
    let last = samples.len().saturating_sub(1);
    let mut replaced = Vec::new();
    for sample in found.into_iter().filter(|sample| (1..last).contains(sample)) {
        replaced.push(ReplacedReading { sample, value: samples[sample] });
        samples[sample] = 0.5 * (samples[sample - 1] + samples[sample + 1]);
    }
    replaced
}

/// Second differences of a channel, and what all but a twentieth of those that are not zero stay below.
pub(crate) fn bends(samples: &[f64]) -> Option<(Vec<f64>, f64)> {
    let bend: Vec<f64> = samples.windows(3).map(|w| w[0] - 2.0 * w[1] + w[2]).collect();
    let mut sizes: Vec<f64> = bend.iter().map(|b| b.abs()).filter(|b| *b > 0.0).collect();
    if sizes.is_empty() {
        return None;
    }
    let rank = sizes.len() * 19 / 20;
    let (_, usual, _) = sizes.select_nth_unstable_by(rank, f64::total_cmp);
    Some((bend, *usual))
}

/// Samples that stand alone: one reading off those before and after it, which agree, by far more than the motion
/// bends elsewhere.
///
/// A knock bends the motion too, but leaves its velocity changed; a lone reading has second differences of 1, −2, 1.
/// Of the first and the last reading there is one, as of a knock: it must be twice as large as all others but those of
/// readings that stand alone.
pub(crate) fn spikes(samples: &[f64]) -> Vec<usize> {
    let Some((bend, usual)) = bends(samples) else { return Vec::new() };
    let least = (SPIKE_SIZE * usual).max(SPIKE_SIZE * step(samples));
    let halved = |side: f64, middle: f64| (side / middle + 0.5).abs() < SPIKE_SHAPE;
    let alone = |(k, w): (usize, &[f64])| {
        let spike = w[1].abs() > least && halved(w[0], w[1]) && halved(w[2], w[1]);
        // The middle of three second differences is that of the sample two on.
        spike.then_some(k + 2)
    };
    let mut found: Vec<usize> = bend.windows(3).enumerate().filter_map(alone).collect();
    if bend.len() < SPIKE_AT_END_LEAST {
        return found;
    }
    let last = bend.len() - 1;
    let near_one = |k: usize| found.iter().any(|s| (k + 1).abs_diff(*s) <= 1);
    let inner = (2..last - 1).filter(|k| !near_one(*k));
    let most = 2.0 * inner.map(|k| bend[k].abs()).fold(0.5 * least, f64::max);
    // Bends from an end inwards: one of the reading at the end, −2 and 1 of the one beside it.
    let at_end = |[outer, inner]: [f64; 2]| {
        let large = outer.abs() > most;
        match (large && halved(inner, outer), large && inner.abs() < SPIKE_SHAPE * outer.abs()) {
            (true, _) => Some(1),
            (_, true) => Some(0),
            _ => None,
        }
    };
    let first = at_end([bend[0], bend[1]]);
    let end = at_end([bend[last], bend[last - 1]]).map(|k| samples.len() - 1 - k);
    found.splice(0..0, first);
    found.extend(end);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sine(limit: f64) -> Vec<f64> {
        (0..4000).map(|k| (0.02 * f64::from(k)).sin().clamp(-limit, limit)).collect()
    }

    #[test]
    fn a_lone_reading_is_a_spike_and_a_knock_is_none() {
        // It bounces at zero.
        let bounced: Vec<f64> = sine(2.0).iter().map(|v| v.abs()).collect();
        assert!(spikes(&bounced).is_empty());
        for step in [0.0, 1e-3] {
            let mut x = sine(2.0);
            x[700] += 0.3;
            x[2500] -= 0.5;
            if step > 0.0 {
                for v in &mut x {
                    *v = (*v / step).round() * step;
                }
            }
            assert_eq!(spikes(&x), [700, 2500]);
        }
        assert!(spikes(&[0.0, 1.0]).is_empty());
    }

    #[test]
    fn the_first_and_the_last_reading_may_be_spikes() {
        assert!(spikes(&sine(2.0)).is_empty());
        for (at, by) in [0, 1, 2, 3997, 3998, 3999].into_iter().flat_map(|k| [(k, 0.3), (k, -0.3)])
        {
            let mut x = sine(2.0);
            x[at] += by;
            assert_eq!(spikes(&x), [at]);
            // Beside a larger one.
            x[2000] -= 0.7;
            assert_eq!(spikes(&x).len(), 2);
        }
        // A motion that is knocked as hard elsewhere may be knocked there.
        let mut bounced: Vec<f64> = sine(2.0).iter().map(|v| v.abs()).collect();
        bounced.truncate(3927 + 2);
        assert!(spikes(&bounced).is_empty());
    }

    #[test]
    fn few_spikes_are_replaced_and_many_are_kept() {
        let mut x = sine(2.0);
        x[700] += 0.3;
        x[2500] -= 50.0;
        let replaced = replace_spikes(&mut x);
        assert_eq!(replaced.iter().map(|r| r.sample).collect::<Vec<_>>(), [700, 2500]);
        assert!((replaced[1].value + 50.0).abs() < 1.0);
        assert!(x.iter().zip(sine(2.0)).all(|(a, b)| (a - b).abs() < 1e-3));
        let mut many = sine(2.0);
        (100..4000).step_by(400).for_each(|k| many[k] += 0.4);
        let before = many.clone();
        assert!(spikes(&many).len() > 4 && replace_spikes(&mut many).is_empty());
        assert_eq!(many, before);
        let mut at_end = sine(2.0);
        at_end[0] += 0.3;
        assert!(replace_spikes(&mut at_end).is_empty());
        assert!(replace_spikes(&mut []).is_empty());
    }
}
