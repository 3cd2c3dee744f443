//! Logs that hold every reading several times, because they were polled faster than the device measured.

use super::thresholds::{REPEATS_BROKEN, REPEATS_REGULARLY};

/// Fewest rows with a changed angle from which a pattern is seen.
const LEAST_CHANGES: usize = 100;
/// Longest distance of readings in rows that is looked for.
const LONGEST: usize = 64;
/// Where readings come at uneven times, command and angle change together in at least this share of them, …
const TOGETHER: f64 = 0.9;
/// … a reading is several rows long on the whole, …
const LEAST_REPEATS: f64 = 1.5;
/// … and only one that stays for more than so many usual distances is that of a motor at rest.
const UNEVEN_STAY: f64 = 4.0;
/// Share of equal steps of the angle from which they are counts of a coarse encoder.
const ONE_COUNT: f64 = 0.95;

/// Rows that hold a reading for the first time, and the mean number of rows of a reading.
///
/// `None` where readings are not repeated: rows change next to each other, or the angle at irregular distances without the
/// command. While the motor rests, rows are kept at the distance of the readings.
pub(super) fn first_readings(
    command: &[f64],
    motor: &[f64],
    tips: &[Vec<f64>],
) -> Option<(Vec<usize>, f64)> {
    let channels = || [command, motor].into_iter().chain(tips.iter().map(Vec::as_slice));
    let rows = motor.len();
    let differs = |x: &[f64], k: usize| (x[k] - x[k - 1]).abs() > 0.0;
    let changed: Vec<bool> =
        (0..rows).map(|k| k == 0 || channels().any(|channel| differs(channel, k))).collect();
    let turned: Vec<usize> = (1..rows).filter(|&k| differs(motor, k)).collect();
    if turned.len() < LEAST_CHANGES {
        return None;
    }
    let beside =
        turned.iter().filter(|&&k| changed[k - 1] && k > 1 || changed.get(k + 1) == Some(&true));
    if beside.count() as f64 > REPEATS_BROKEN * turned.len() as f64 {
        return None;
    }
    let starts: Vec<usize> = (0..rows).filter(|&k| changed[k]).collect();
    let regular = distance(&starts);
    let (per_reading, stays) = if let Some(per_reading) = regular {
        (per_reading, 1.5)
    } else {
        // Polled at uneven times: command and angle change together, which no encoder makes them do.
        let both = turned.iter().filter(|&&k| differs(command, k)).count();
        if (both as f64) < TOGETHER * turned.len() as f64 {
            return None;
        }
        (usual_distance(&turned), UNEVEN_STAY)
    };
    if per_reading < LEAST_REPEATS {
        return None;
    }
    if one_count(motor, &turned) {
        let commanded = starts.iter().filter(|&&k| k > 0 && differs(command, k)).count();
        if 2 * commanded < starts.len() {
            return None;
        }
    }
    let mut kept = Vec::with_capacity((rows as f64 / per_reading) as usize + 1);
    for (index, &start) in starts.iter().enumerate() {
        let end = starts.get(index + 1).copied().unwrap_or(rows);
        let long = (end - start) as f64 / per_reading;
        let readings = if long < stays { 1 } else { long.round() as usize };
        let row = |reading: usize| start + (reading as f64 * per_reading).round() as usize;
        kept.extend((0..readings).map(row).take_while(|&row| row < end));
    }
    Some((kept, per_reading))
}

/// The median distance of rows in which the angle changed.
fn usual_distance(turned: &[usize]) -> f64 {
    let mut distances: Vec<usize> = turned.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let middle = distances.len() / 2;
    *distances.select_nth_unstable(middle).1 as f64
}

/// The mean distance of changed rows, if it is regular.
fn distance(starts: &[usize]) -> Option<f64> {
    let mut counts = [0_usize; LONGEST + 2];
    for pair in starts.windows(2) {
        counts[(pair[1] - pair[0]).min(LONGEST + 1)] += 1;
    }
    let best = (2..LONGEST).max_by_key(|&p| counts[p] + counts[p + 1])?;
    let pair = counts[best] + counts[best + 1];
    // Longer ones are of a motor at rest.
    let moving: usize = counts[..(3 * best).min(LONGEST + 1)].iter().sum();
    if pair == 0 || (pair as f64) < REPEATS_REGULARLY * moving as f64 {
        return None;
    }
    Some((best * counts[best] + (best + 1) * counts[best + 1]) as f64 / pair as f64)
}

/// Whether nearly all steps of the angle have one size.
fn one_count(motor: &[f64], turned: &[usize]) -> bool {
    let step = |&k: &usize| (motor[k] - motor[k - 1]).abs();
    let smallest = turned.iter().map(step).fold(f64::INFINITY, f64::min);
    let equal = turned.iter().filter(|&k| step(k) < 1.5 * smallest).count();
    equal as f64 > ONE_COUNT * turned.len() as f64
}
