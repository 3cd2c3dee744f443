//! The samples of a channel for a screen: at most four points for each pixel, among them the smallest and the largest
//! value.

use std::ops::Range;

/// Values of a block whose extremes are kept.
const BLOCK: usize = 256;
/// Points for each pixel.
pub(crate) const PER_PIXEL: usize = 4;

/// The smallest and the largest value of each block of a channel: a part of it is then searched in few steps.
#[derive(Debug)]
pub(crate) struct Extremes {
    blocks: Vec<[f64; 2]>,
}

const NOTHING: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

fn joined(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

/// The smallest and the largest value; missing values do not count.
fn extremes(values: &[f64]) -> [f64; 2] {
    values.iter().fold(NOTHING, |found, value| joined(found, [*value, *value]))
}

impl Extremes {
    pub(crate) fn of(values: &[f64]) -> Self {
        Self { blocks: values.chunks(BLOCK).map(extremes).collect() }
    }

    /// Those of a part of the channel.
    fn within(&self, values: &[f64], rows: Range<usize>) -> [f64; 2] {
        let (first, last) = (rows.start.div_ceil(BLOCK), rows.end / BLOCK);
        if first >= last {
            return extremes(&values[rows]);
        }
        let whole = self.blocks[first..last].iter().copied().fold(NOTHING, joined);
        let head = extremes(&values[rows.start..first * BLOCK]);
        let tail = extremes(&values[last * BLOCK..rows.end]);
        joined(joined(head, whole), tail)
    }
}

/// Points of a line; where a value is missing the line stops.
#[derive(Debug, Default, PartialEq, serde::Serialize)]
pub(crate) struct Points {
    pub(crate) x: Vec<f64>,
    pub(crate) y: Vec<Option<f64>>,
    /// Number of samples in the part that is shown.
    pub(crate) samples: usize,
}

/// The stamps of a channel, or its rows.
pub(crate) enum Abscissa<'a> {
    /// Increasing stamps.
    Stamps(&'a [f64]),
    /// Rows, from 0, where there are no stamps that increase.
    Rows,
}

impl Abscissa<'_> {
    fn at(&self, row: usize) -> f64 {
        match self {
            Self::Stamps(stamps) => stamps[row],
            Self::Rows => row as f64,
        }
    }

    /// The first row that is not before a place.
    fn row(&self, place: f64, rows: usize) -> usize {
        match self {
            Self::Stamps(stamps) => stamps[..rows].partition_point(|stamp| *stamp < place),
            Self::Rows => (place.ceil().max(0.0) as usize).min(rows),
        }
    }
}

/// The points of a channel between two places, for so many pixels.
pub(crate) fn thinned(
    x: &Abscissa<'_>,
    values: &[f64],
    known: &Extremes,
    [from, to]: [f64; 2],
    pixels: usize,
) -> Points {
    let rows = values.len();
    // One sample more on each side: the line goes on to the edge.
    let first = x.row(from, rows).saturating_sub(1);
    let last = (x.row(to, rows) + 1).min(rows);
    if first >= last {
        return Points::default();
    }
    let mut points = Points { samples: last - first, ..Points::default() };
    let mut put = |place: f64, value: f64| {
        points.x.push(place);
        points.y.push(Some(value).filter(|value| value.is_finite()));
    };
    if last - first <= PER_PIXEL * pixels {
        (first..last).for_each(|row| put(x.at(row), values[row]));
        return points;
    }
    let (start, end) = (x.at(first), x.at(last - 1));
    let mut row = first;
    for pixel in 1..=pixels {
        let place = start + (end - start) * pixel as f64 / pixels as f64;
        let next = if pixel == pixels { last } else { x.row(place, rows).clamp(row, last) };
        if next - row <= PER_PIXEL {
            (row..next).for_each(|row| put(x.at(row), values[row]));
        } else {
            let [low, high] = known.within(values, row..next);
            let middle = x.at(row + (next - row) / 2);
            put(x.at(row), values[row]);
            put(middle, low);
            put(middle, high);
            put(x.at(next - 1), values[next - 1]);
        }
        row = next;
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(k: usize) -> f64 {
        if k == 123_456 { 9.0 } else { (k as f64 * 0.01).sin() }
    }

    #[test]
    fn few_points_show_the_extremes() {
        let values: Vec<f64> = (0..1_000_000).map(wave).collect();
        let stamps: Vec<f64> = (0..1_000_000).map(|k| 1e-3 * f64::from(k)).collect();
        let known = Extremes::of(&values);
        for x in [Abscissa::Stamps(&stamps), Abscissa::Rows] {
            let whole = [x.at(0), x.at(999_999)];
            let points = thinned(&x, &values, &known, whole, 800);
            assert!(points.x.len() <= PER_PIXEL * 800 && points.samples == 1_000_000);
            assert!(points.y.contains(&Some(9.0)) && points.x.is_sorted());
            let zoomed = thinned(&x, &values, &known, [x.at(123_400), x.at(123_500)], 800);
            assert_eq!(zoomed.samples, 102);
            assert!(zoomed.y.contains(&Some(9.0)));
        }
    }

    #[test]
    fn missing_values_and_empty_parts() {
        let mut values: Vec<f64> = (0..10_000).map(wave).collect();
        values[5000..6000].fill(f64::NAN);
        let known = Extremes::of(&values);
        let points = thinned(&Abscissa::Rows, &values, &known, [0.0, 1e9], 50);
        assert!(points.y.contains(&None) && points.x.len() <= 200);
        let nothing = thinned(&Abscissa::Rows, &values, &known, [2e4, 3e4], 50);
        assert_eq!(nothing.samples, 1);
        assert_eq!(thinned(&Abscissa::Rows, &[], &Extremes::of(&[]), [0.0, 1.0], 50).samples, 0);
    }

    #[test]
    fn blocks_give_the_same_as_all_values() {
        let values: Vec<f64> = (0..3000).map(|k| wave(7 * k)).collect();
        let known = Extremes::of(&values);
        for rows in [0..3000, 1..2, 255..257, 256..512, 100..2999, 2900..3000] {
            let all = extremes(&values[rows.clone()]);
            assert_eq!(known.within(&values, rows).map(f64::to_bits), all.map(f64::to_bits));
        }
    }
}
