//! Times of logs, in names and tables.

use chrono::{DateTime, NaiveDate, NaiveDateTime};

/// Forms of a date with time, without a zone: UTC.
const DATE_TIMES: [&str; 9] = [
    "%Y-%m-%dT%H:%M:%S%.f",
    "%Y-%m-%d %H:%M:%S%.f",
    "%Y-%m-%dT%H-%M-%S",
    "%Y-%m-%d_%H-%M-%S",
    "%Y-%m-%dT%H:%M",
    "%Y-%m-%d %H:%M",
    "%Y%m%dT%H%M%S",
    "%Y%m%d_%H%M%S",
    "%Y%m%d-%H%M%S",
];
/// Forms of a date.
const DATES: [&str; 3] = ["%Y-%m-%d", "%Y%m%d", "%Y_%m_%d"];
/// Counts from here on are milliseconds since 1970: as seconds they would be after the year 5000.
const MILLISECONDS: f64 = 1e11;
/// Smallest count of seconds, in 2001: smaller numbers are no times.
const SECONDS_LEAST: f64 = 1e9;

/// Reads a time, in microseconds since 1970 UTC: a date, a date with time (UTC if no zone is given), seconds or
/// milliseconds since 1970.
///
/// ```
/// use lissom_fleet::time_us;
/// assert_eq!(time_us("2026-11-27T08:15:00+01:00"), time_us("20261127T071500"));
/// assert_eq!(time_us("1795763700"), time_us("2026-11-27 07:15:00"));
/// assert_eq!(time_us("0815"), None);
/// ```
pub fn time_us(text: &str) -> Option<i64> {
    let text = text.trim();
    let zoned = DateTime::parse_from_rfc3339(text);
    if let Ok(time) = zoned.or_else(|_| DateTime::parse_from_str(text, "%Y-%m-%dT%H:%M:%S%.f%z")) {
        return Some(time.timestamp_micros());
    }
    let basic = text.strip_suffix('Z').unwrap_or(text);
    for form in DATE_TIMES {
        if let Ok(time) = NaiveDateTime::parse_from_str(basic, form) {
            return Some(time.and_utc().timestamp_micros());
        }
    }
    // chrono takes years of any number of digits: `%Y%m%d` would take counts of seconds.
    for form in DATES.iter().filter(|_| basic.len() <= 10 && !is_count(basic)) {
        if let Ok(date) = NaiveDate::parse_from_str(basic, form) {
            return Some(date.and_time(chrono::NaiveTime::MIN).and_utc().timestamp_micros());
        }
    }
    let count = text.parse::<f64>().ok().filter(|count| *count >= SECONDS_LEAST)?;
    let seconds = if count >= MILLISECONDS { 1e-3 * count } else { count };
    (seconds < MILLISECONDS).then(|| (1e6 * seconds).round() as i64)
}

/// The date of a time in microseconds since 1970, UTC, as in 2026-11-27.
pub fn date(time_us: i64) -> String {
    let time = DateTime::from_timestamp_micros(time_us);
    time.map_or_else(String::new, |time| time.format("%Y-%m-%d").to_string())
}

/// Whether a text is a number with more digits than a date.
fn is_count(text: &str) -> bool {
    text.len() > 8 && text.bytes().all(|b| b.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::time_us;

    /// 2026-11-27T07:15:00Z, from `date -u -d 2026-11-27T07:15:00 +%s`.
    const SECONDS: i64 = 1_795_763_700;

    #[test]
    fn forms_of_a_time() {
        for text in [
            "2026-11-27T07:15:00Z",
            "2026-11-27T08:15:00+01:00",
            "2026-11-27 07:15:00",
            "2026-11-27T07:15",
            "2026-11-27 07:15",
            "2026-11-27T08:15:00+0100",
            "2026-11-27T07-15-00",
            "20261127T071500",
            "20261127T071500Z",
            "20261127_071500",
            "1795763700",
            "1795763700000",
        ] {
            assert_eq!(time_us(text), Some(1_000_000 * SECONDS), "{text}");
        }
        assert_eq!(time_us("1795763700.25"), Some(1_000_000 * SECONDS + 250_000));
        let day = 1_000_000 * (SECONDS - 7 * 3600 - 15 * 60);
        assert_eq!(time_us("2026-11-27"), Some(day));
        assert_eq!(time_us("20261127"), Some(day));
    }

    #[test]
    fn what_is_no_time() {
        for text in ["", "0815", "run 3", "2026-13-01", "-1795763700", "nan", "1e300", "12345"] {
            assert_eq!(time_us(text), None, "{text}");
        }
    }
}
