//! Long lines in few bytes.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

use crate::marks::Mark;

/// The number that stands for a missing value; values are from 0 to the one below.
const MISSING: u16 = u16::MAX;
/// Shortest line that is packed.
const SHORT: usize = 50;
/// Largest deviation of an abscissa from a regular grid, in steps.
const IRREGULAR: f64 = 0.01;
/// Largest distance of a point from the line between those that are kept, as a part of the span.
const SMOOTH: f64 = 0.004;
/// Parts of the points asked for that are tried, the smallest first.
const FEWER: [usize; 4] = [8, 4, 2, 1];
/// Largest share of missing values: a line with more is no sampled signal.
const GAPS_MOST: f64 = 0.9;

/// A line over regular abscissae, its ordinates as 16-bit numbers between the smallest and the largest one.
///
/// Of a line with more points than asked for, every so many are kept, if straight lines between them are near the others. If
/// not, the smallest and the largest value of equal intervals are kept, in their order, at one and three quarters of the
/// interval.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Packed {
    /// First abscissa.
    pub from: f64,
    /// Distance between abscissae.
    pub step: f64,
    /// Smallest ordinate.
    pub low: f64,
    /// Largest ordinate.
    pub high: f64,
    /// The ordinates: 16-bit numbers, low byte first, in Base64; 65535 for a missing one.
    pub y: String,
}

impl Packed {
    /// Packs a line; none if it is short or its abscissae are not regular. Also says whether all points are in it.
    pub(crate) fn of(marks: &[Mark], most: usize) -> Option<(Self, bool)> {
        let (first, step, count) = grid(marks)?;
        let mut values = vec![None; count];
        for mark in marks {
            let place = ((mark.x - first) / step).round() as usize;
            *values.get_mut(place)? = Some(mark.y);
        }
        let known = || values.iter().flatten().copied();
        let (low, high) = known()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
        let whole = count <= most;
        let (from, step, kept) = if whole {
            (first, step, values)
        } else if let Some((stride, some)) =
            FEWER.iter().find_map(|fewer| sampled(&values, most / fewer, SMOOTH * (high - low)))
        {
            (first, step * stride as f64, some)
        } else {
            let intervals = (most / 2).max(1);
            let width = step * count as f64 / intervals as f64;
            (first + 0.25 * width, 0.5 * width, extremes(&values, intervals))
        };
        let span = if high > low { high - low } else { 1.0 };
        let scaled = |y: f64| (f64::from(MISSING - 1) * (y - low) / span).round() as u16;
        let bytes: Vec<u8> =
            kept.iter().flat_map(|y| y.map_or(MISSING, scaled).to_le_bytes()).collect();
        Some((Self { from, step, low, high: low + span, y: STANDARD.encode(bytes) }, whole))
    }
}

/// First abscissa, distance and number of the places of a regular grid on which all marks are; none if there is none.
fn grid(marks: &[Mark]) -> Option<(f64, f64, usize)> {
    if marks.len() < SHORT || marks.iter().any(|mark| mark.bar.is_some() || mark.flagged) {
        return None;
    }
    let mut steps: Vec<f64> = marks.windows(2).map(|pair| pair[1].x - pair[0].x).collect();
    steps.sort_by(f64::total_cmp);
    let typical = *steps.get(steps.len() / 2)?;
    if typical.is_nan() || typical <= 0.0 {
        return None;
    }
    let (first, last) = (marks.first()?.x, marks.last()?.x);
    let places = ((last - first) / typical).round();
    if places < 1.0 || marks.len() as f64 / places < 1.0 - GAPS_MOST {
        return None;
    }
    // The mean of all steps is more exact than one of them.
    let step = (last - first) / places;
    let is_regular = marks.iter().enumerate().all(|(k, mark)| {
        let place = (mark.x - first) / step;
        (place - place.round()).abs() < IRREGULAR && (k == 0 || mark.x > marks[k - 1].x)
    });
    is_regular.then_some((first, step, places as usize + 1))
}

/// Every so many of the values, and how many that are; none if straight lines between them are further from another value than
/// this.
fn sampled(values: &[Option<f64>], most: usize, near: f64) -> Option<(usize, Vec<Option<f64>>)> {
    let stride = values.len().div_ceil(most.max(2));
    let kept: Vec<Option<f64>> = values.iter().step_by(stride).copied().collect();
    let is_near = |(k, value): (usize, &Option<f64>)| {
        let (before, part) = (k / stride, (k % stride) as f64 / stride as f64);
        match (value, kept[before], kept.get(before + 1).copied().flatten()) {
            (None, None, _) => true,
            (Some(y), Some(a), Some(b)) => (y - (a + part * (b - a))).abs() <= near,
            // The end of the line is left out.
            (Some(_), Some(_), None) => before + 1 == kept.len(),
            (None, Some(_), _) | (Some(_), None, _) => false,
        }
    };
    values.iter().enumerate().all(is_near).then_some((stride, kept))
}

/// Two values of each interval: the smallest and the largest, in their order.
fn extremes(values: &[Option<f64>], intervals: usize) -> Vec<Option<f64>> {
    let mut kept = Vec::with_capacity(2 * intervals);
    for k in 0..intervals {
        let part = &values[k * values.len() / intervals..(k + 1) * values.len() / intervals];
        let known: Vec<(usize, f64)> =
            part.iter().enumerate().filter_map(|(i, y)| Some((i, (*y)?))).collect();
        let by_size = |a: &&(usize, f64), b: &&(usize, f64)| a.1.total_cmp(&b.1);
        match (known.iter().min_by(by_size), known.iter().max_by(by_size)) {
            (Some(least), Some(most)) if least.0 <= most.0 => {
                kept.extend([Some(least.1), Some(most.1)]);
            }
            (Some(least), Some(most)) => kept.extend([Some(most.1), Some(least.1)]),
            _ => kept.extend([None, None]),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marks(count: u32, y: impl Fn(u32) -> f64) -> Vec<Mark> {
        let mark = |k| {
            let x = 1.0 + f64::from(k) * 1e-3;
            Mark { x, y: y(k), bar: None, across: None, flagged: false, after_gap: false }
        };
        (0..count).map(mark).collect()
    }

    fn ordinates(packed: &Packed) -> Vec<Option<f64>> {
        let bytes = STANDARD.decode(&packed.y).unwrap();
        let number = |pair: &[u8]| u16::from_le_bytes([pair[0], pair[1]]);
        let value = |n: u16| {
            let part = f64::from(n) / f64::from(MISSING - 1);
            (n != MISSING).then_some(packed.low + part * (packed.high - packed.low))
        };
        bytes.chunks(2).map(|pair| value(number(pair))).collect()
    }

    #[test]
    fn short_lines_are_whole_and_long_ones_keep_their_extremes() {
        let (packed, whole) = Packed::of(&marks(100, |k| f64::from(k).sin()), 200).unwrap();
        assert!(whole && (packed.step - 1e-3).abs() < 1e-12);
        for (k, y) in ordinates(&packed).into_iter().enumerate() {
            assert!((y.unwrap() - (k as f64).sin()).abs() < 2.0 / 65_000.0);
        }
        let long = marks(100_000, |k| if k == 51_234 { 9.0 } else { f64::from(k % 7) });
        let (packed, whole) = Packed::of(&long, 1000).unwrap();
        let y = ordinates(&packed);
        assert!(!whole && y.len() == 1000);
        let largest = y.iter().position(|y| y.unwrap() > 8.5).unwrap();
        let at = packed.from + packed.step * largest as f64;
        assert!((at - (1.0 + 51.234)).abs() < 2.0 * packed.step, "{at}");
    }

    #[test]
    fn of_smooth_lines_points_are_kept_as_they_are() {
        let smooth = marks(10_000, |k| (f64::from(k) * 0.01).sin());
        let (packed, whole) = Packed::of(&smooth, 1000).unwrap();
        let y = ordinates(&packed);
        // Chords over 0.2 rad are within 0.0025 of the span.
        assert!(!whole && y.len() == 500 && (packed.step - 0.02).abs() < 1e-9);
        for (k, y) in y.into_iter().enumerate() {
            assert!((y.unwrap() - (k as f64 * 0.2).sin()).abs() < 2.0 / 65_000.0);
        }
    }

    #[test]
    fn gaps_stay_and_irregular_lines_are_not_packed() {
        let mut gap = marks(100, f64::from);
        gap.drain(40..60);
        let y = ordinates(&Packed::of(&gap, 200).unwrap().0);
        assert_eq!((y.len(), y[45], y[39].map(f64::round)), (100, None, Some(39.0)));
        let mut odd = marks(100, f64::from);
        odd[50].x += 0.4e-3;
        assert_eq!(Packed::of(&odd, 200), None);
        let constant = Packed::of(&marks(60, |_| 3.0), 200).unwrap().0;
        assert_eq!(ordinates(&constant)[7], Some(3.0));
    }
}
