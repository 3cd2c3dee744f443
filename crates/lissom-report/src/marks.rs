//! Data in the units of their axes, and the range they need.

use crate::scale::extent;

/// How far an error bar may stretch an axis, as a part of the span of the points.
const BAR_STRETCH: f64 = 0.35;

/// One datum in the units of its axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark {
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// The ends of the error bar.
    pub(crate) bar: Option<(f64, f64)>,
    /// The ends of the error bar of the abscissa.
    pub(crate) across: Option<(f64, f64)>,
    pub(crate) flagged: bool,
    /// A point before this one could not be drawn: lines stop there.
    pub(crate) after_gap: bool,
}

/// The range of the points, stretched by their error bars as far as those stay in proportion.
pub(crate) fn with_bars(marks: &[&Mark]) -> Option<(f64, f64)> {
    let (low, high) = extent(marks.iter().map(|m| m.y))?;
    let sure = || marks.iter().filter(|m| !m.flagged).filter_map(|m| m.bar);
    let mut sizes: Vec<f64> =
        sure().map(|(a, b)| (b - a) / 2.0).filter(|s| s.is_finite()).collect();
    sizes.sort_by(f64::total_cmp);
    let typical = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
    let stretch = (BAR_STRETCH * (high - low)).max(1.5 * typical);
    let (bottom, top) = extent(sure().flat_map(|(a, b)| [a, b])).unwrap_or((low, high));
    Some((low.min(bottom).max(low - stretch), high.max(top).min(high + stretch)))
}

/// The same picture of a long path with fewer points: of those in one pixel column the first, extremes and last are kept.
pub(crate) fn thinned(path: &[(f64, f64)]) -> Vec<(f64, f64)> {
    const SHORT: usize = 1500;
    if path.len() <= SHORT {
        return path.to_vec();
    }
    let column = f64::round;
    let mut kept = Vec::new();
    for run in path.chunk_by(|a, b| (column(a.0) - column(b.0)).abs() < 0.5) {
        let place = |best: fn(f64, f64) -> bool| {
            (0..run.len()).fold(0, |k, j| if best(run[j].1, run[k].1) { j } else { k })
        };
        let mut places = [0, place(|a, b| a < b), place(|a, b| a > b), run.len() - 1];
        places.sort_unstable();
        kept.extend(
            places
                .iter()
                .enumerate()
                .filter(|(k, p)| *k == 0 || places[k - 1] != **p)
                .map(|(_, p)| run[*p]),
        );
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wild_bars_do_not_rule_the_axis() {
        let mark = |y: f64, half: f64| Mark {
            x: 1.0,
            y,
            bar: Some((y - half, y + half)),
            across: None,
            flagged: false,
            after_gap: false,
        };
        let marks = [mark(0.0, 0.1), mark(10.0, f64::INFINITY), mark(4.0, 0.2)];
        let (low, high) = with_bars(&marks.iter().collect::<Vec<_>>()).unwrap();
        assert!((-3.6..=0.0).contains(&low) && (10.0..=13.6).contains(&high), "{low} {high}");
        let constant = [mark(5.0, 1.0), mark(5.0, 1.2)];
        assert_eq!(with_bars(&constant.iter().collect::<Vec<_>>()).unwrap(), (3.8, 6.2));
    }

    #[test]
    fn long_paths_keep_their_extremes() {
        let path: Vec<(f64, f64)> = (0..100_000)
            .map(|k| (f64::from(k) / 200.0, if k == 51_234 { 9.0 } else { f64::from(k % 7) }))
            .collect();
        let thin = thinned(&path);
        assert!(thin.len() < 2100, "{}", thin.len());
        assert!(thin.iter().any(|p| p.1 > 8.0));
        assert_eq!((thin.first(), thin.last()), (path.first(), path.last()));
    }
}
