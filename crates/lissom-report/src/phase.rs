//! Phases brought to one branch.

/// The phases of one series, ascending in frequency, none of them NaN.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    /// Where the points lie along the logarithmic frequency axis.
    pub(crate) x: Vec<f64>,
    /// The phases in degrees, on any branch.
    pub(crate) degrees: Vec<f64>,
    /// Points that must not lead the branch of their neighbours.
    pub(crate) doubtful: Vec<bool>,
    /// Drawn as a line, hence dense enough to follow.
    pub(crate) dense: bool,
}

/// The branch of the first point of the leading series: above −225° and up to 135°.
///
/// −180°, where an inertia starts, and 90°, where a differentiator does, are both far from its ends, so noise does not flip them.
const BRANCH_TOP: f64 = 135.0;

/// Shifts every phase by multiples of 360° so that each series is continuous and all lie near one another.
///
/// One series leads: the line with most points or, without a line, the series with most points. It is unwrapped along
/// itself. Every other series is unwrapped in its difference from the leader, which stays continuous where the phase itself
/// falls too fast for the spacing of its points; then it is moved as a whole to the branch where the median difference is
/// within half a turn. Beyond its ends the leader counts as constant. A doubtful point takes the branch nearest to its neighbours.
pub(crate) fn unwrap_together(tracks: &mut [Track]) {
    let lead = |t: &Track| (t.dense, t.doubtful.iter().filter(|d| !**d).count(), t.x.len());
    let Some(leader) = (0..tracks.len()).rev().max_by_key(|k| lead(&tracks[*k])) else {
        return;
    };
    let mut first = tracks[leader].clone();
    unwrap(&mut first.degrees, &first.doubtful);
    let start = sure(&first.degrees, &first.doubtful).next();
    if let Some(start) = start {
        let turns = ((start - BRANCH_TOP) / 360.0).ceil();
        first.degrees.iter_mut().for_each(|d| *d -= 360.0 * turns);
    }
    for (k, track) in tracks.iter_mut().enumerate() {
        if k == leader {
            track.degrees.clone_from(&first.degrees);
            continue;
        }
        let course: Vec<f64> = track.x.iter().map(|x| interpolate(&first, *x)).collect();
        let mut apart: Vec<f64> = track.degrees.iter().zip(&course).map(|(d, c)| d - c).collect();
        unwrap(&mut apart, &track.doubtful);
        let turns =
            median(sure(&apart, &track.doubtful).collect()).map_or(0.0, |m| (m / 360.0).round());
        track.degrees = apart.iter().zip(&course).map(|(d, c)| d + c - 360.0 * turns).collect();
    }
}

/// The degrees that are not doubtful, or all where every one is.
fn sure<'a>(degrees: &'a [f64], doubtful: &'a [bool]) -> impl Iterator<Item = f64> + 'a {
    let none = doubtful.iter().all(|d| *d);
    degrees.iter().zip(doubtful).filter(move |(_, doubtful)| none || !**doubtful).map(|(d, _)| *d)
}

/// Makes consecutive sure points differ by at most 180°, and doubtful ones by at most that from the sure point before them.
fn unwrap(degrees: &mut [f64], doubtful: &[bool]) {
    let none = doubtful.iter().all(|d| *d);
    let mut last = sure(degrees, doubtful).next();
    for (degree, doubtful) in degrees.iter_mut().zip(doubtful) {
        if let Some(last) = last {
            *degree -= 360.0 * ((*degree - last) / 360.0).round();
        }
        if none || !doubtful {
            last = Some(*degree);
        }
    }
}

/// The phase of a track at `x`, constant beyond its ends.
fn interpolate(track: &Track, x: f64) -> f64 {
    let after = track.x.partition_point(|known| *known < x);
    match (after.checked_sub(1), track.x.get(after)) {
        (None, _) => track.degrees.first().copied().unwrap_or(0.0),
        (Some(before), None) => track.degrees[before],
        (Some(before), Some(next)) => {
            let part = (x - track.x[before]) / (next - track.x[before]);
            track.degrees[before] + part * (track.degrees[after] - track.degrees[before])
        }
    }
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wrapped(degrees: f64) -> f64 {
        degrees - 360.0 * (degrees / 360.0).round()
    }

    fn track(phase: impl Fn(f64) -> f64, count: u32, dense: bool) -> Track {
        let x: Vec<f64> = (0..count).map(|k| f64::from(k) / f64::from(count - 1) * 3.0).collect();
        let degrees = x.iter().map(|x| wrapped(phase(*x))).collect();
        Track { degrees, doubtful: vec![false; x.len()], x, dense }
    }

    fn near(found: &[f64], expected: impl Iterator<Item = f64>) {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "{found} against {expected}");
        }
    }

    #[test]
    fn a_lag_of_many_turns_is_continuous() {
        let lag = |x: f64| -10.0 - 400.0 * x;
        let mut tracks = [track(lag, 200, true)];
        unwrap_together(&mut tracks);
        near(&tracks[0].degrees, tracks[0].x.iter().map(|x| lag(*x)));
    }

    #[test]
    fn sparse_points_follow_the_line() {
        // 7 points, 200 degrees apart: unwrapped alone they would rise.
        let lag = |x: f64| -10.0 - 400.0 * x;
        let mut tracks = [track(|x| lag(x) + 25.0, 7, false), track(lag, 200, true)];
        unwrap_together(&mut tracks);
        near(&tracks[0].degrees, tracks[0].x.iter().map(|x| lag(*x) + 25.0));
    }

    #[test]
    fn both_sides_of_minus_180_share_a_branch() {
        let mut tracks = [
            track(|_| 178.0, 5, false),
            track(|_| -179.0, 5, false),
            track(|x| -180.0 + x, 50, true),
        ];
        unwrap_together(&mut tracks);
        near(&tracks[0].degrees, [-182.0; 5].into_iter());
        near(&tracks[1].degrees, [-179.0; 5].into_iter());
        assert!((tracks[2].degrees[0] + 180.0).abs() < 1e-9);
    }

    #[test]
    fn a_doubtful_point_leads_nobody() {
        let mut one = track(|_| 0.0, 5, false);
        (one.degrees[1], one.doubtful[1]) = (170.0, true);
        one.degrees[2] = -20.0;
        unwrap_together(std::slice::from_mut(&mut one));
        near(&one.degrees, [0.0, 170.0, -20.0, 0.0, 0.0].into_iter());
    }

    #[test]
    fn nothing_and_single_points_are_fine() {
        unwrap_together(&mut []);
        let empty = Track { x: vec![], degrees: vec![], doubtful: vec![], dense: true };
        let single =
            Track { x: vec![1.0], degrees: vec![350.0], doubtful: vec![true], dense: false };
        let mut tracks = [empty, single];
        unwrap_together(&mut tracks);
        assert!((wrapped(tracks[1].degrees[0]) + 10.0).abs() < 1e-9);
    }
}
